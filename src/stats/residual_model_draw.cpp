/// Readings as the model would draw them: a short memory and a slow one from standard
/// normals, mixed by their shares and scaled by the prediction.
/// Follows from the same motion as the likelihood (residual_model_motion). Draws are not
/// conditioned on readings; the normals are the caller's.
#include "stats/residual_model.hpp"
#include "stats/residual_model_motion.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::stats {

namespace {

using namespace residual;

using Values = std::array<double, 5>;

Values values_of(const ResidualOptions& options, std::span<const double> parameters) {
    Values values{};
    std::size_t k = 0;
    for (const auto parameter : parameters_of(options))
        values[parameter] = parameters[k++];
    return values;
}

/// AR(1) with variance 1; white where phi = 0.
std::vector<double> short_memory(double correlation, std::span<const double> normals) {
    std::vector<double> path(normals.begin(), normals.end());
    const double fresh = std::sqrt((1 - correlation) * (1 + correlation));
    for (std::size_t t = 1; t < path.size(); ++t)
        path[t] = correlation * path[t - 1] + fresh * path[t];
    return path;
}

/// Matern-3/2 with variance 1, from two normals a reading.
std::vector<double> slow_memory(double timescale, std::span<const double> normals) {
    ParameterLanes p = no_effect();
    p[share] = all(1);
    p[Parameter::timescale] = all(timescale);
    const auto [move, noise] = motion_over(p, 1);
    const double mm = std::sqrt(noise.mm[0]), dm = noise.md[0] / mm;
    const double dd = std::sqrt(std::max(0.0, noise.dd[0] - dm * dm));
    std::vector<double> path{normals[0]};
    path.reserve(normals.size() / 2);
    double d = normals[1];
    for (std::size_t k = 2; k < normals.size(); k += 2) {
        const double m = path.back();
        path.push_back(move.mm[0] * m + move.md[0] * d + mm * normals[k]);
        d = move.dm[0] * m + move.dd[0] * d + dm * normals[k] + dd * normals[k + 1];
    }
    return path;
}

/// The short memory's path and the slow one's, each with its part of the variance.
void mix(double share, std::vector<double>& near, const std::vector<double>& slow) {
    for (std::size_t t = 0; t < near.size(); ++t)
        near[t] = std::sqrt(1 - share) * near[t] + std::sqrt(share) * slow[t];
}

}  // namespace

std::size_t ResidualModel::n_normals() const {
    return n_readings() * (options_.discrepancy ? 3 : 1);
}

std::vector<double> ResidualModel::draw(std::span<const double> prediction,
                                        std::span<const double> parameters,
                                        std::span<const double> normals) const {
    const Values values = values_of(options_, parameters);
    const std::size_t n = n_readings();
    std::vector<double> path = short_memory(values[phi], normals.first(n));
    if (options_.discrepancy && n > 0)
        mix(values[share], path,
            slow_memory(values[timescale], normals.subspan(n, 2 * n)));
    for (std::size_t t = 0; t < path.size(); ++t) {
        const double f = prediction[t];
        path[t] =
            f + path[t] * std::hypot(values[constant] * scale_, values[proportional] * f);
    }
    return path;
}

}  // namespace bemcal::stats
