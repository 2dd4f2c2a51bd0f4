/// Says how far the unknowns of a model may be off: by the normal equations or a
/// jackknife over twelfths of training, whichever is more; a coefficient also by shape,
/// by what may be missing, and by the model itself:
///
///     8 % of the coefficient, and
///     3 % of it / sqrt(share of what it does that no other unknown can do)
///
/// Of an effect that parameters can imitate only that share speaks, and what the model's
/// hours are off counts against it. The other unknowns follow the coefficient there.
/// Source: weighted least squares; delete-a-block jackknife. The last terms are our own.
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

/// Of unknowns in their scales. [unknowns x unknowns]
struct Covariances {
    Matrix of_noise, of_model;
};

/// Adds what the model leaves open of one unknown; the others follow it.
void add_error(double variance, std::size_t of, Covariances& sum) {
    const Matrix& c = sum.of_noise;
    for (std::size_t i = 0; i < c.rows; ++i)
        for (std::size_t k = 0; k < c.cols; ++k)
            sum.of_model(i, k) += variance * c(i, of) / c(of, of) * c(k, of) / c(of, of);
}

Covariances covariances_of(const Standing& standing, const std::vector<double>& weights,
                           const std::vector<double>& diagonal) {
    const Matrix information = information_by(standing, weights);
    Covariances sum{
        stats::inverse(information, diagonal, std::vector<char>(diagonal.size(), 0)),
        Matrix(diagonal.size(), diagonal.size())};
    for (std::size_t k = 0; k < standing.model.effects.size(); ++k) {
        if (standing.model.effects[k].other_hours) continue;
        const std::size_t at = standing.built.first_effect() + k;
        const double visible =
            1 / ((information(at, at) + diagonal[at]) * sum.of_noise(at, at));
        const double size = standing.coefficient(k) / standing.built.unknowns[at].scale,
                     own = decisions::error_of_model * size,
                     beside = decisions::error_beside_others * size;
        add_error(own * own + beside * beside / visible, at, sum);
    }
    return sum;
}

}  // namespace

Matrix information_of(const LoopData& data, const Standing& standing, double misfit) {
    return information_by(standing, weights_by(data, standing, misfit));
}

Matrix correlations_of(const LoopData& data, const Standing& standing, double misfit) {
    const Covariances sum = covariances_of(standing, weights_by(data, standing, misfit),
                                           diagonal_of(standing));
    Matrix all = sum.of_noise;
    for (std::size_t k = 0; k < all.values.size(); ++k)
        all.values[k] += sum.of_model.values[k];
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
    const Covariances sum = covariances_of(standing, weights, diagonal);
    const std::vector<char> none(diagonal.size(), 0);
    std::vector<double> sd = stats::jackknife_deviations(
        standing.fit.at.derivatives, standing.residuals, weights,
        data.blocks_of(days_of(data.training()) / decisions::jackknife_parts), diagonal,
        none);
    for (std::size_t k = 0; k < diagonal.size(); ++k)
        sd[k] = std::hypot(std::max(sd[k], std::sqrt(std::max(0.0, sum.of_noise(k, k)))),
                           std::sqrt(sum.of_model(k, k))) *
                standing.built.unknowns[k].scale;
    // Hours are there or not.
    for (std::size_t k = 0; k < standing.model.effects.size(); ++k)
        if (standing.model.effects[k].other_hours)
            sd[standing.built.first_effect() + k] = 0;
    return sd;
}

double deviation_of(const Found& found, double of_last) {
    return std::hypot(of_last, found.of_shape, found.of_missing);
}

}  // namespace bemcal::loop
