/// Levenberg's damped Gauss-Newton steps within the bounds, from the best runs, in rounds
/// with the emulator's own variance.
/// Sources: Levenberg 1944, with Marquardt's scaling; Higdon et al. 2008 for the
/// variance. Left out: modes that no start leads to, and skewed posteriors, for which a
/// sampler on this objective would be the way.
#include "emulator/series_fit.hpp"

#include "emulator/eigen_views.hpp"
#include "emulator/refusals.hpp"
#include "emulator/score_objective.hpp"
#include "emulator/spread_points.hpp"
#include "stats/least_squares.hpp"

#include <algorithm>
#include <numeric>

namespace bemcal::emulator {
namespace {

constexpr std::size_t n_best_runs = 5;  ///< that are starts, beside the prior's mean
/// Points over which the emulator's variance is a mean: within some 10 % of it.
constexpr std::size_t n_variance_points = 64;
constexpr int most_rounds = 10;
/// Rounds end where no standard deviation changes by more than this share of it, and the
/// optimum moves by no more than this share of one.
constexpr double same_spread = 0.05;

constexpr int most_steps = 200;
constexpr double first_damping = 1e-3, least_damping = 1e-12, most_damping = 1e12;
constexpr double more_damping = 4, less_damping = 0.25;
constexpr double short_step = 1e-10;  ///< of a parameter's range: the fit has ended
/// Of a standard deviation: next runs reach at least so far in each direction, or they
/// would tell the emulator no slope. A fiftieth of a parameter's range.
constexpr double least_reach = 0.02;
/// Of a uniform distribution: points are spread no wider where priors are.
constexpr double uniform_sd = 0.2886751345948129;  // 1 / sqrt(12)

/// The objective with one variance of the emulator.
class Objective {
  public:
    Objective(const SeriesEmulator& emulator, std::span<const ScaledPrior> priors,
              MeasuredScores::Square square)
        : emulator_(emulator), priors_(priors), square_(std::move(square)) {}

    /// Without what no point changes, which would take its digits.
    double value(std::span<const double> point) const {
        const std::vector<double> scores = emulator_.scores(point);
        const auto z = eigen_view(std::span<const double>(scores));
        double twice = z.dot(square_.information * z - 2 * square_.pull);
        for (std::size_t k = 0; k < point.size(); ++k) {
            const double away = (point[k] - priors_[k].mean) / priors_[k].sd;
            twice += away * away;
        }
        return twice / 2;
    }

    double whole(double value) const { return value + square_.rest / 2; }

    /// Of the Gauss-Newton matrix, and the negative gradient; both with the priors.
    stats::NormalEquations equations(std::span<const double> point) const {
        const std::vector<double> scores = emulator_.scores(point);
        const Matrix derivatives = emulator_.score_jacobian(point);
        const auto J = eigen_view(derivatives);
        const Eigen::VectorXd pull =
            J.transpose() *
            (square_.pull -
             square_.information * eigen_view(std::span<const double>(scores)));
        stats::NormalEquations made{Matrix(point.size(), point.size()),
                                    {pull.begin(), pull.end()}};
        eigen_view(made.matrix) = J.transpose() * square_.information * J;
        for (std::size_t k = 0; k < point.size(); ++k) {
            const double precision = 1 / (priors_[k].sd * priors_[k].sd);
            made.matrix(k, k) += precision;
            made.right[k] -= precision * (point[k] - priors_[k].mean);
        }
        return made;
    }

  private:
    const SeriesEmulator& emulator_;
    std::span<const ScaledPrior> priors_;
    MeasuredScores::Square square_;
};

struct Reached {
    std::vector<double> point;
    double objective;
};

/// Parameters at a bound that the gradient pushes against.
std::vector<char> held_by_bounds(std::span<const double> point,
                                 std::span<const double> downhill) {
    std::vector<char> held(point.size());
    for (std::size_t k = 0; k < point.size(); ++k)
        held[k] =
            (point[k] <= 0 && downhill[k] <= 0) || (point[k] >= 1 && downhill[k] >= 0);
    return held;
}

std::vector<double> damped_step(const stats::NormalEquations& equations, double damping,
                                std::span<const char> held,
                                std::span<const double> point) {
    std::vector<double> diagonal(point.size());
    for (std::size_t k = 0; k < point.size(); ++k)
        diagonal[k] = damping * equations.matrix(k, k) + least_damping;
    std::vector<double> to =
        stats::solve(equations.matrix, diagonal, equations.right, held);
    for (std::size_t k = 0; k < point.size(); ++k)
        to[k] = std::clamp(point[k] + to[k], 0.0, 1.0);
    return to;
}

double furthest(std::span<const double> a, std::span<const double> b) {
    double most = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        most = std::max(most, std::abs(a[k] - b[k]));
    return most;
}

Reached descend(const Objective& objective, const std::vector<double>& start) {
    Reached here{start, objective.value(start)};
    double damping = first_damping;
    for (int step = 0; step < most_steps; ++step) {
        const stats::NormalEquations equations = objective.equations(here.point);
        const std::vector<char> held = held_by_bounds(here.point, equations.right);
        bool has_fallen = false;
        double length = 0;
        while (!has_fallen && damping < most_damping) {
            std::vector<double> to = damped_step(equations, damping, held, here.point);
            const double value = objective.value(to);
            length = furthest(to, here.point);
            has_fallen = value < here.objective;
            damping = has_fallen ? std::max(damping * less_damping, least_damping)
                                 : damping * more_damping;
            if (has_fallen) here = {std::move(to), value};
            if (length < short_step) break;
        }
        if (!has_fallen || length < short_step) break;
    }
    return here;
}

void check_fit(const SeriesEmulator& emulator, std::span<const double> measured,
               std::span<const double> weights, std::span<const ScaledPrior> priors) {
    refuse_if(measured.size() != emulator.n_numbers(),
              "{} readings for an emulator of {} numbers", measured.size(),
              emulator.n_numbers());
    refuse_if(weights.size() != measured.size(), "{} weights for {} readings",
              weights.size(), measured.size());
    refuse_not_finite(weights, weights.size(), "weights");
    refuse_if(priors.size() != emulator.n_parameters(), "{} priors for {} parameters",
              priors.size(), emulator.n_parameters());
    for (std::size_t k = 0; k < priors.size(); ++k) {
        const auto& [mean, sd] = priors[k];
        refuse_if(!std::isfinite(mean), "prior {} has the mean {}: expected a number",
                  k + 1, mean);
        refuse_if(!(sd > 0) || std::isinf(sd),
                  "prior {} has the sd {}: expected a number above 0", k + 1, sd);
    }
}

/// 0 where a reading is missing.
std::vector<double> weights_of_readings(std::span<const double> measured,
                                        std::span<const double> weights) {
    std::vector<double> made(weights.begin(), weights.end());
    bool any = false;
    for (std::size_t j = 0; j < made.size(); ++j) {
        refuse_if(made[j] < 0, "weight {} is {}: expected 0 or more", j + 1, made[j]);
        refuse_if(std::isinf(measured[j]), "reading {} is infinite", j + 1);
        if (std::isnan(measured[j])) made[j] = 0;
        any = any || made[j] > 0;
    }
    refuse_if(!any, "no reading has a weight: nothing to fit");
    return made;
}

Eigen::VectorXd mean_variance(const SeriesEmulator& emulator, const Matrix& points) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(eigen_index(emulator.n_components()));
    for (std::size_t i = 0; i < points.rows; ++i) {
        const std::vector<double> at_point = emulator.variance(points.row(i));
        sum += eigen_view(std::span<const double>(at_point));
    }
    return sum / static_cast<double>(points.rows);
}

std::vector<double> middle_of(std::span<const ScaledPrior> priors) {
    std::vector<double> made;
    made.reserve(priors.size());
    for (const ScaledPrior& prior : priors)
        made.push_back(std::clamp(prior.mean, 0.0, 1.0));
    return made;
}

Matrix spread_of(std::span<const ScaledPrior> priors) {
    Matrix made(priors.size(), priors.size());
    for (std::size_t k = 0; k < priors.size(); ++k) {
        const double sd = std::min(priors[k].sd, uniform_sd);
        made(k, k) = sd * sd;
    }
    return made;
}

/// The priors' middle, then the runs of the lowest objective, from the best on.
std::vector<Reached> starts_of(const SeriesEmulator& emulator,
                               std::span<const ScaledPrior> priors,
                               const Objective& objective) {
    std::vector<Reached> runs;
    for (std::size_t i = 0; i < emulator.n_runs(); ++i) {
        const auto row = emulator.points().row(i);
        runs.push_back({{row.begin(), row.end()}, objective.value(row)});
    }
    const std::size_t n = std::min(n_best_runs, runs.size());
    std::ranges::stable_sort(runs, {}, &Reached::objective);
    runs.resize(n);
    runs.push_back({middle_of(priors), 0});
    return runs;
}

Matrix covariance_at(const Objective& objective, std::span<const double> point) {
    const std::vector<double> nothing(point.size());
    const std::vector<char> free(point.size());
    return stats::inverse(objective.equations(point).matrix, nothing, free);
}

/// Optimum and covariance with one variance of the emulator.
SeriesFit fit_round(const SeriesEmulator& emulator, std::span<const ScaledPrior> priors,
                    const MeasuredScores& measured, const Eigen::VectorXd& variance) {
    const Objective objective(emulator, priors, measured.square(variance));
    const std::vector<Reached> starts = starts_of(emulator, priors, objective);
    Reached best = descend(objective, starts.front().point);
    for (std::size_t k = 1; k < starts.size(); ++k) {
        Reached other = descend(objective, starts[k].point);
        if (other.objective < best.objective) best = std::move(other);
    }
    SeriesFit made;
    made.point = best.point;
    made.covariance = covariance_at(objective, best.point);
    made.objective_before = objective.whole(starts.front().objective);
    made.objective_after = objective.whole(best.objective);
    made.emulator_variance = {variance.begin(), variance.end()};
    return made;
}

bool agree(const SeriesFit& before, const SeriesFit& after) {
    for (std::size_t k = 0; k < after.point.size(); ++k) {
        const double sd = std::sqrt(after.covariance(k, k)),
                     last = std::sqrt(before.covariance(k, k));
        if (std::abs(sd - last) > same_spread * sd ||
            std::abs(after.point[k] - before.point[k]) > same_spread * sd)
            return false;
    }
    return true;
}

}  // namespace

SeriesFit fit_series(const SeriesEmulator& emulator, std::span<const double> measured,
                     std::span<const double> weights,
                     std::span<const ScaledPrior> priors) {
    check_fit(emulator, measured, weights, priors);
    const MeasuredScores scores(emulator, measured,
                                weights_of_readings(measured, weights));
    Matrix about = spread_points(middle_of(priors), spread_of(priors), n_variance_points);
    SeriesFit fit = fit_round(emulator, priors, scores, mean_variance(emulator, about));
    int round = 1;
    for (bool is_done = false; !is_done && round < most_rounds; ++round) {
        about = spread_points(fit.point, fit.covariance, n_variance_points);
        SeriesFit next =
            fit_round(emulator, priors, scores, mean_variance(emulator, about));
        is_done = agree(fit, next);
        fit = std::move(next);
    }
    fit.n_rounds = round;
    return fit;
}

Matrix next_points(const SeriesFit& fit, std::size_t n) {
    Matrix made(n, fit.point.size());
    if (n == 0) return made;
    Matrix reach = fit.covariance;
    for (std::size_t k = 0; k < reach.rows; ++k) reach(k, k) += least_reach * least_reach;
    const Matrix spread = spread_points(fit.point, reach, n - 1);
    std::ranges::copy(fit.point, made.row(0).begin());
    for (std::size_t i = 1; i < n; ++i)
        std::ranges::copy(spread.row(i - 1), made.row(i).begin());
    return made;
}

}  // namespace bemcal::emulator
