/// Says how far the unknowns of a model may be off: by the normal equations or a
/// jackknife over twelfths of training, whichever is more; a coefficient also by shape,
/// by what may be missing, and by 8 % for the model itself.
/// Source: weighted least squares; delete-a-block jackknife.
/// Intervals are symmetric: curvature is left out.
#include "loop/intervals.hpp"

#include "loop/decisions.hpp"
#include "physics/calendar.hpp"
#include "stats/least_squares.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::loop {
namespace {

double days_of(const study::Period& period) {
    return static_cast<double>((period.to - period.from).count()) / physics::day_s;
}

/// What priors add to the normal equations.
std::vector<double> diagonal_of(const Standing& standing) {
    auto diagonal = study::prior_diagonal(standing.built.unknowns);
    for (double& entry : diagonal) entry += 1e-6;
    // A set-point where nothing heats any more could be anything: no more is said than
    // that it is plausible.
    for (std::size_t k = 0; k < standing.model.effects.size(); ++k) {
        const effects::Effect& effect = standing.model.effects[k];
        const std::size_t at = standing.built.first_effect() + k;
        diagonal[at] +=
            std::pow(standing.built.unknowns[at].scale /
                         std::max(std::abs(effect.least), std::abs(effect.most)),
                     2);
    }
    return diagonal;
}

std::vector<double> weights_by(const LoopData& data, const Standing& standing,
                               double misfit) {
    auto weights = weights_of(data.targets, standing.noise);
    for (double& weight : weights) weight /= misfit;
    return weights;
}

Matrix information_by(const Standing& standing, const std::vector<double>& weights) {
    return stats::normal_equations(standing.fit.at.derivatives, standing.residuals,
                                   weights)
        .matrix;
}

/// Of unknowns in their scales.
Matrix covariance_of(const Standing& standing, const std::vector<double>& weights,
                     const std::vector<double>& diagonal) {
    return stats::inverse(information_by(standing, weights), diagonal,
                          std::vector<char>(diagonal.size(), 0));
}

}  // namespace

Matrix information_of(const LoopData& data, const Standing& standing, double misfit) {
    return information_by(standing, weights_by(data, standing, misfit));
}

Matrix correlations_of(const LoopData& data, const Standing& standing, double misfit) {
    Matrix all = covariance_of(standing, weights_by(data, standing, misfit),
                               diagonal_of(standing));
    std::vector<double> sd(all.rows);
    for (std::size_t k = 0; k < sd.size(); ++k) sd[k] = std::sqrt(all(k, k));
    for (std::size_t i = 0; i < all.rows; ++i)
        for (std::size_t k = 0; k < all.cols; ++k) all(i, k) /= sd[i] * sd[k];
    return all;
}

std::vector<double> deviations_of(const LoopData& data, const Standing& standing,
                                  double misfit) {
    const auto weights = weights_by(data, standing, misfit);
    const auto diagonal = diagonal_of(standing);
    const Matrix covariance = covariance_of(standing, weights, diagonal);
    const std::vector<char> none(diagonal.size(), 0);
    std::vector<double> sd = stats::jackknife_deviations(
        standing.fit.at.derivatives, standing.residuals, weights,
        data.blocks_of(days_of(data.training()) / decisions::jackknife_parts), diagonal,
        none);
    for (std::size_t k = 0; k < diagonal.size(); ++k)
        sd[k] = std::max(sd[k], std::sqrt(std::max(0.0, covariance(k, k)))) *
                standing.built.unknowns[k].scale;
    // Hours are there or not.
    for (std::size_t k = 0; k < standing.model.effects.size(); ++k)
        if (standing.model.effects[k].other_hours)
            sd[standing.built.first_effect() + k] = 0;
    return sd;
}

double deviation_of(const Found& found, double of_noise, double coefficient) {
    return std::hypot(std::hypot(of_noise, decisions::error_of_model * coefficient),
                      found.of_shape, found.of_missing);
}

}  // namespace bemcal::loop
