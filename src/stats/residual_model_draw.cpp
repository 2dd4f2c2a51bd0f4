#include "stats/residual_model.hpp"
#include "stats/residual_model_parameters.hpp"

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

}  // namespace

std::size_t ResidualModel::n_normals() const {
    return n_readings() * (options_.discrepancy ? 3 : 1);
}

std::vector<double> ResidualModel::draw(std::span<const double> prediction,
                                        std::span<const double> parameters,
                                        std::span<const double> normals) const {
    const Values values = values_of(options_, parameters);
    std::vector<double> path =
        short_memory(values[phi], normals.first(prediction.size()));
    for (std::size_t t = 0; t < path.size(); ++t) {
        const double f = prediction[t];
        path[t] =
            f + path[t] * std::hypot(values[constant] * scale_, values[proportional] * f);
    }
    return path;
}

}  // namespace bemcal::stats
