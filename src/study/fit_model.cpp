/// Fits a building to its readings by least squares: Levenberg-Marquardt within the
/// ranges, four damped steps simulated at once and the best taken. Derivatives are by
/// one-sided differences once, then by what the steps show, as long as these help.
/// Source: Marquardt 1963 (J. SIAM 11); Madsen, Nielsen and Tingleff 2004 (Methods for
/// non-linear least squares problems), 3.5, for steps by secants; `least_squares`.
/// It ends in the nearest minimum. How errors hang together is left to the weights.
#include "study/fit_model.hpp"

#include "base/nan.hpp"
#include "stats/least_squares.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace bemcal::study {
namespace {

constexpr double difference = 0.05;  ///< of an unknown, for its derivative [prior sd]

/// The unknowns' values, in the parameters' units.
void write_values(std::span<const FitUnknown> unknowns, std::span<const double> x,
                  std::span<double> values) {
    for (std::size_t k = 0; k < x.size(); ++k) values[k] = unknowns[k].within(x[k]);
}

/// Away from the end of the range.
double step_of(const FitUnknown& unknown, double x) {
    return x + difference > unknown.highest() ? -difference : difference;
}

double objective_of(std::span<const FitUnknown> unknowns, std::span<const double> x,
                    std::span<const double> measured, std::span<const double> weights,
                    std::span<const double> predicted) {
    double sum = 0;
    for (std::size_t k = 0; k < measured.size(); ++k) {
        if (weights[k] == 0) continue;
        const double r = measured[k] - predicted[k];
        sum += weights[k] * r * r;
    }
    for (std::size_t k = 0; k < x.size(); ++k)
        if (unknowns[k].has_prior) sum += x[k] * x[k];
    return std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum;
}

/// A point with one unknown moved.
struct Moved {
    std::size_t unknown;
    double by;
};

/// Simulates the moves and writes the derivatives of those that could be; returns the
/// others, to be moved the other way.
std::vector<Moved> write_derivatives(const FitModel& model,
                                     std::span<const FitUnknown> unknowns,
                                     const std::vector<Moved>& moves, Linearised& at) {
    Matrix points(moves.size(), at.x.size());
    for (std::size_t k = 0; k < moves.size(); ++k) {
        std::vector<double> moved = at.x;
        moved[moves[k].unknown] += moves[k].by;
        write_values(unknowns, moved, points.row(k));
    }
    std::vector<Moved> again;
    model.predict_each(points, [&](std::size_t k, std::span<const double> moved) {
        const auto& [unknown, by] = moves[k];
        if (std::isnan(moved[0])) {
            again.push_back({unknown, -by});
            return;
        }
        const auto to = at.derivatives.row(unknown);
        for (std::size_t i = 0; i < to.size(); ++i)
            to[i] = (moved[i] - at.predicted[i]) / by;
    });
    return again;
}

/// A fit on its way.
struct Descent {
    const FitModel& model;
    std::span<const FitUnknown> unknowns;
    std::span<const double> measured, weights;
    std::vector<double> prior;

    double objective(std::span<const double> x, std::span<const double> predicted) const {
        return objective_of(unknowns, x, measured, weights, predicted);
    }

    stats::NormalEquations equations(const Linearised& at) const {
        auto all = stats::normal_equations(at.derivatives,
                                           residuals_of(measured, at.predicted), weights);
        for (std::size_t k = 0; k < at.x.size(); ++k) all.right[k] -= prior[k] * at.x[k];
        return all;
    }

    /// Those at an end of their range that the objective pushes further.
    std::vector<char> held(const Linearised& at, std::span<const double> right) const {
        std::vector<char> held(at.x.size(), 0);
        for (std::size_t k = 0; k < at.x.size(); ++k) {
            constexpr double tolerance = 1e-9;
            held[k] = (at.x[k] <= unknowns[k].lowest() + tolerance && right[k] < 0) ||
                      (at.x[k] >= unknowns[k].highest() - tolerance && right[k] > 0);
        }
        return held;
    }

    /// These, and those that the readings say less of here than their priors: a prior
    /// leads on where readings would deny it.
    std::vector<char> with_prior_led(std::vector<char> held,
                                     const stats::NormalEquations& all) const {
        for (std::size_t k = 0; k < held.size(); ++k)
            if (all.matrix(k, k) < prior[k]) held[k] = 1;
        return held;
    }

    /// The damped step within the ranges: what would leave its range stays at the end of
    /// it, and the others move as fits that.
    std::vector<double> moved(const Linearised& at, const stats::NormalEquations& all,
                              std::span<const char> at_ends, double damping) const {
        std::vector<double> diagonal = prior, right = all.right, x = at.x;
        std::vector<char> fixed(at_ends.begin(), at_ends.end());
        for (std::size_t k = 0; k < diagonal.size(); ++k)
            diagonal[k] += damping * (all.matrix(k, k) + prior[k]) + 1e-9;
        for (bool is_within = false; !is_within;) {
            const std::vector<double> step =
                stats::solve(all.matrix, diagonal, right, fixed);
            is_within = true;
            for (std::size_t k = 0; k < x.size(); ++k) {
                if (fixed[k] != 0) continue;
                x[k] = std::clamp(at.x[k] + step[k], unknowns[k].lowest(),
                                  unknowns[k].highest());
                if (x[k] == at.x[k] + step[k]) continue;
                is_within = false;
                fixed[k] = 1;
                for (std::size_t j = 0; j < right.size(); ++j)
                    right[j] -= all.matrix(j, k) * (x[k] - at.x[k]);
            }
        }
        return x;
    }
};

constexpr std::array dampings = {0.0, 0.05, 0.6, 6.0};

/// Broyden's update: derivatives that foretell what a step has shown, and change as
/// little as that needs. Its x and predictions are the step's.
void learn_from(Linearised&& step, Linearised& at) {
    std::vector<double> moved(at.x.size()), missed(at.predicted.size());
    double square = 0;
    for (std::size_t j = 0; j < moved.size(); ++j) {
        moved[j] = step.x[j] - at.x[j];
        square += moved[j] * moved[j];
    }
    if (square > 0) {
        for (std::size_t i = 0; i < missed.size(); ++i)
            missed[i] = (step.predicted[i] - at.predicted[i]) / square;
        for (std::size_t j = 0; j < moved.size(); ++j) {
            const auto row = at.derivatives.row(j);
            const double share = moved[j] / square;
            for (std::size_t i = 0; i < missed.size(); ++i) missed[i] -= share * row[i];
        }
        for (std::size_t j = 0; j < moved.size(); ++j) {
            if (moved[j] == 0) continue;
            const auto row = at.derivatives.row(j);
            for (std::size_t i = 0; i < missed.size(); ++i)
                row[i] += moved[j] * missed[i];
        }
    }
    at.x = std::move(step.x);
    at.predicted = std::move(step.predicted);
    at.by_secants = true;
}

/// The best of the damped steps.
struct Tried {
    Linearised at;
    double objective = std::numeric_limits<double>::infinity();
};

Tried best_step(const Descent& descent, const Linearised& at, std::span<const char> fixed,
                const stats::NormalEquations& all) {
    Matrix points(dampings.size(), at.x.size());
    std::vector<std::vector<double>> tried;
    tried.reserve(dampings.size());
    for (std::size_t k = 0; k < dampings.size(); ++k) {
        tried.push_back(descent.moved(at, all, fixed, dampings[k]));
        write_values(descent.unknowns, tried.back(), points.row(k));
    }
    Tried best;
    descent.model.predict_each(points, [&](std::size_t k, std::span<const double> row) {
        const double objective = descent.objective(tried[k], row);
        if (objective < best.objective)
            best = {{tried[k], {row.begin(), row.end()}, {}}, objective};
    });
    return best;
}

}  // namespace

FitUnknown unknown_of(const physics::Parameter& parameter, const stats::Prior& prior) {
    FitUnknown unknown{parameter.name,  parameter.unit, 0,   1,
                       parameter.least, parameter.most, true};
    const double width = parameter.most - parameter.least;
    if (prior.kind == stats::PriorKind::uniform) {
        unknown.centre = parameter.least + 0.5 * width;
        unknown.scale = width / std::sqrt(12.0);
        unknown.has_prior = false;
        return unknown;
    }
    unknown.centre = prior.mean();
    unknown.scale = prior.sd() > 0 ? prior.sd() : 1e-9;
    return unknown;
}

FitModel::FitModel(const physics::Building& building,
                   std::vector<physics::Parameter> parameters,
                   const physics::Drive& drive, std::vector<kernel::Channel> channels)
    : parameters_(std::move(parameters)),
      batch_(std::make_unique<kernel::Batch>(building, parameters_, drive)),
      response_(std::make_unique<kernel::Response>(*batch_, std::move(channels))),
      first_{0},
      run_(response_->make_run(kernel::Way::there)) {
    for (std::size_t c = 0; c < response_->channels().size(); ++c)
        first_.push_back(first_.back() + response_->n_readings(c));
}

Matrix FitModel::predict(const Matrix& points) const {
    Matrix all(points.rows, n_readings());
    predict_each(points, [&](std::size_t point, std::span<const double> row) {
        std::ranges::copy(row, all.row(point).begin());
    });
    return all;
}

void FitModel::predict_each(const Matrix& points, const Take& take) const {
    const auto lanes = static_cast<std::size_t>(response_->lanes());
    const std::size_t n = n_readings();
    const auto of_lanes = std::make_unique_for_overwrite<double[]>(lanes * n);
    for (std::size_t first = 0; first < points.rows; first += lanes) {
        const std::size_t count = std::min(lanes, points.rows - first);
        const auto failures = response_->predict(points, first, count, *run_);
        for (std::size_t c = 0; c + 1 < first_.size(); ++c) {
            const double* from = response_->readings(*run_, c);
            for (std::size_t i = first_[c]; i < first_[c + 1]; ++i, from += lanes)
                for (std::size_t k = 0; k < count; ++k) of_lanes[k * n + i] = from[k];
        }
        for (std::size_t k = 0; k < count; ++k) {
            const std::span row(of_lanes.get() + k * n, n);
            if (!failures[k].empty()) std::ranges::fill(row, nan);
            take(first + k, row);
        }
    }
}

std::vector<double> residuals_of(std::span<const double> measured,
                                 std::span<const double> predicted) {
    std::vector<double> r(measured.size());
    for (std::size_t k = 0; k < r.size(); ++k)
        r[k] = std::isnan(measured[k]) ? 0 : measured[k] - predicted[k];
    return r;
}

std::vector<double> prior_diagonal(std::span<const FitUnknown> unknowns) {
    std::vector<double> diagonal;
    diagonal.reserve(unknowns.size());
    for (const FitUnknown& unknown : unknowns)
        diagonal.push_back(unknown.has_prior ? 1 : 0);
    return diagonal;
}

void predict_at(const FitModel& model, std::span<const FitUnknown> unknowns,
                Linearised& at) {
    if (!at.predicted.empty()) return;
    Matrix point(1, at.x.size());
    write_values(unknowns, at.x, point.row(0));
    at.predicted = model.predict(point).values;
}

void linearise(const FitModel& model, std::span<const FitUnknown> unknowns,
               Linearised& at) {
    predict_at(model, unknowns, at);
    if (at.has_derivatives() && !at.by_secants) return;
    at.by_secants = false;
    at.derivatives = Matrix(at.x.size(), at.predicted.size());
    std::vector<Moved> moves;
    moves.reserve(at.x.size());
    for (std::size_t k = 0; k < at.x.size(); ++k)
        moves.push_back({k, step_of(unknowns[k], at.x[k])});
    const auto again = write_derivatives(model, unknowns, moves, at);
    if (!again.empty()) write_derivatives(model, unknowns, again, at);
}

Fit fit(const FitModel& model, std::span<const FitUnknown> unknowns,
        std::span<const double> measured, std::span<const double> weights,
        std::vector<double> start, const FitOptions& options) {
    return fit(model, unknowns, measured, weights, Linearised{std::move(start)}, options);
}

Fit fit(const FitModel& model, std::span<const FitUnknown> unknowns,
        std::span<const double> measured, std::span<const double> weights,
        Linearised start, const FitOptions& options) {
    const Descent descent{model, unknowns, measured, weights, prior_diagonal(unknowns)};
    for (std::size_t k = 0; k < start.x.size(); ++k)
        start.x[k] = std::clamp(start.x[k], unknowns[k].lowest(), unknowns[k].highest());
    Fit result;
    result.at = std::move(start);
    predict_at(model, unknowns, result.at);
    result.objective = descent.objective(result.at.x, result.at.predicted);
    result.failed = std::isinf(result.objective);
    result.bound.assign(unknowns.size(), 0);
    for (int step = 0; step < options.most_steps && !result.failed; ++step) {
        if (!result.at.has_derivatives()) linearise(model, unknowns, result.at);
        const bool was_by_secants = result.at.by_secants;
        const stats::NormalEquations all = descent.equations(result.at);
        const std::vector<char> held = descent.held(result.at, all.right);
        result.bound = held;
        Tried best = best_step(descent, result.at, held, all);
        if (!(best.objective < result.objective) && !was_by_secants) {
            const std::vector<char> others_held = descent.with_prior_led(held, all);
            if (others_held != held)
                best = best_step(descent, result.at, others_held, all);
        }
        const double gained = result.objective - best.objective;
        if (gained > 0) {
            learn_from(std::move(best.at), result.at);
            result.objective = best.objective;
        }
        if (gained >= options.tolerance * result.objective) continue;
        // Differences that foretold next to nothing hold where that has led.
        if (!was_by_secants) result.at.by_secants = false;
        // What secants foretold may be wrong: no end before differences say the same.
        if (!was_by_secants || (gained > 0 && !options.derivatives)) break;
        result.at.derivatives = {};
    }
    if (options.derivatives && !result.failed) linearise(model, unknowns, result.at);
    if (result.at.by_secants) result.at = {result.at.x, result.at.predicted};
    return result;
}

}  // namespace bemcal::study
