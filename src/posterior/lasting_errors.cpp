/// Estimates which share of a meter's residuals lasts for weeks, from the variance of
/// block means less that of independent errors; predictions draw it as a slow part.
/// Follows from Matern-3/2: its mean over the timescale keeps 0.867 of the variance.
/// Fewer than 6 blocks give a share of 0, and 0.9 is the most. How sure a share is, is
/// left out.
#include "posterior/lasting_errors.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::posterior {
namespace {

constexpr std::size_t least_blocks = 6;
/// Variance of the mean of a Matern-3/2 process over its timescale, of its own variance:
/// the integral of 2 (1 - u) (1 + sqrt(3) u) exp(-sqrt(3) u) over u from 0 to 1.
constexpr double variance_of_mean = 0.867;
constexpr double largest_share = 0.9;

double readings_in(physics::Interval interval, double weeks) {
    return 7 * weeks * (interval == physics::Interval::daily ? 1 : 24);
}

struct Sum {
    double value = 0;
    std::size_t n = 0;
    void add(double x) {
        value += x;
        ++n;
    }
    double mean() const { return value / static_cast<double>(n); }
};

/// Residuals in units of their scale, of the mean prediction. NaN = missing
std::vector<double> scaled_residuals(const MeterModel& meter, const Matrix& simulated,
                                     double constant, double proportional) {
    std::vector<double> scaled(meter.measured.size());
    for (std::size_t t = 0; t < scaled.size(); ++t) {
        Sum predicted;
        for (std::size_t r = 0; r < simulated.rows; ++r)
            if (!std::isnan(simulated(r, t))) predicted.add(simulated(r, t));
        const double f = predicted.mean();
        scaled[t] = (meter.measured[t] - f) /
                    std::hypot(constant * meter.scale, proportional * f);
    }
    return scaled;
}

double share_in(const std::vector<double>& residuals, std::size_t block) {
    Sum squares, squared_means, inverse_counts;
    for (std::size_t first = 0; first + block <= residuals.size(); first += block) {
        Sum sum;
        for (std::size_t t = first; t < first + block; ++t)
            if (!std::isnan(residuals[t])) sum.add(residuals[t]);
        if (2 * sum.n < block) continue;
        squared_means.add(sum.mean() * sum.mean());
        inverse_counts.add(1 / static_cast<double>(sum.n));
    }
    if (squared_means.n < least_blocks) return 0;
    for (const double residual : residuals)
        if (!std::isnan(residual)) squares.add(residual * residual);
    const double lasting = squared_means.mean() / squares.mean() - inverse_counts.mean();
    return std::clamp(lasting / variance_of_mean, 0.0, largest_share);
}

double mean_of_column(const Matrix& values, std::size_t column) {
    Sum sum;
    for (std::size_t r = 0; r < values.rows; ++r) sum.add(values(r, column));
    return sum.mean();
}

}  // namespace

std::vector<double> lasting_shares(const BuildingModel& trained,
                                   const BuildingModel::Points& points, double weeks) {
    const auto simulated = trained.predict(points.parameters);
    std::vector<double> shares;
    shares.reserve(simulated.size());
    for (std::size_t m = 0; m < simulated.size(); ++m) {
        const MeterModel& meter = trained.meters()[m];
        const auto interval = trained.building().meters[meter.meter].interval;
        const std::size_t first = trained.first_residual_parameter(m);
        shares.push_back(share_in(
            scaled_residuals(meter, simulated[m], mean_of_column(points.residuals, first),
                             mean_of_column(points.residuals, first + 1)),
            static_cast<std::size_t>(readings_in(interval, weeks))));
    }
    return shares;
}

BuildingModel::Points with_lasting_errors(const BuildingModel& trained,
                                          const BuildingModel::Points& points,
                                          const BuildingModel& model,
                                          const std::vector<double>& shares,
                                          double weeks) {
    BuildingModel::Points made{
        points.parameters, Matrix(points.residuals.rows, model.n_residual_parameters())};
    for (std::size_t m = 0; m < model.meters().size(); ++m) {
        const std::size_t from = trained.first_residual_parameter(m),
                          to = model.first_residual_parameter(m),
                          n = trained.meters()[m].unknowns.size();
        const auto interval = model.building().meters[model.meters()[m].meter].interval;
        const bool is_slow = model.meters()[m].unknowns.size() > n;
        for (std::size_t r = 0; r < made.residuals.rows; ++r) {
            for (std::size_t k = 0; k < n; ++k)
                made.residuals(r, to + k) = points.residuals(r, from + k);
            if (!is_slow) continue;
            made.residuals(r, to + n) = shares[m];
            made.residuals(r, to + n + 1) = readings_in(interval, weeks);
        }
    }
    return made;
}

}  // namespace bemcal::posterior
