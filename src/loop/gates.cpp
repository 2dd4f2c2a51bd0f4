/// Judges whether a candidate may join the model, the cheap gates first: evidence,
/// coefficient, errors and score of unseen blocks; of what follows time the last readings
/// of training, too.
/// Follows from the job's limits, and from how much energy use changes in a year anyhow
/// (`bench_level_change`, 232 buildings).
/// Evidence comes from `search`, the probability of a name from `rivals`. Other periods
/// than training decide nothing.
#include "loop/gates.hpp"

#include "effects/steps.hpp"
#include "loop/decisions.hpp"
#include "loop/level_change.hpp"
#include "stats/distributions.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace bemcal::loop {
namespace {

physics::Seconds last_quarter_of(const LoopData& data) {
    const auto [first, last] = std::ranges::minmax(data.begins);
    return first + 3 * (last - first) / 4;
}

/// By how much the newest effect changes the only meter's last quarter [-].
double change_of_level(const LoopData& data, const Standing& with) {
    Matrix points(2, with.built.unknowns.size());
    for (std::size_t k = 0; k < points.cols; ++k)
        points(0, k) = points(1, k) = with.built.unknowns[k].within(with.fit.at.x[k]);
    points(1, points.cols - 1) = 0;
    const Matrix predicted = with.built.fit_model->predict(points);
    const auto from = last_quarter_of(data);
    double sum = 0, without = 0;
    for (std::size_t k = 0; k < data.begins.size(); ++k)
        if (data.begins[k] >= from) sum += predicted(0, k), without += predicted(1, k);
    return std::abs(sum / without - 1);
}

/// Whether something that follows time may be no more than what use and operation change
/// in a year everywhere: a meter alone cannot tell the two apart.
bool is_within_usual_change(const LoopData& data, const Refitted& candidate) {
    const double usual = usual_level_change(data.targets.channels[0].quantity);
    if (data.targets.n_channels() > 1 || usual == 0) return false;
    return change_of_level(data, candidate.standing) < stats::z_90_two_sided * usual;
}

/// Relative changes of the left-out errors of the meters that count.
struct ErrorChange {
    double mean = 0, highest = 0, lowest = 0;
};

ErrorChange error_change_of(const Standing& before, const Refitted& candidate) {
    ErrorChange change;
    double n = 0;
    for (std::size_t c = 0; c < candidate.error.size(); ++c) {
        if (before.noise[c].share < decisions::least_share_that_counts) continue;
        change.mean += candidate.error[c];
        n += 1;
        change.highest = std::max(change.highest, candidate.error[c]);
        change.lowest = std::min(change.lowest, candidate.error[c]);
    }
    if (n > 0) change.mean /= n;
    return change;
}

}  // namespace

LastReadings::LastReadings(const LoopData& data, const Standing& before)
    : data_(data), before_(before), weights_(weights_of(data.targets, before.noise)) {}

physics::Seconds LastReadings::begin_for(const effects::Effect& effect) const {
    const auto quarter = last_quarter_of(data_);
    if (effect.shape.form != effects::Form::over) return quarter;
    const auto last = *std::ranges::max_element(data_.begins);
    const std::chrono::seconds since(
        std::llround(effect.shape.at * effects::elapsed_year_s));
    const double left =
        static_cast<double>((last - data_.training().from - since).count());
    return std::max(
        quarter,
        last - std::chrono::seconds(std::llround(decisions::share_behind_step * left)));
}

double LastReadings::change_to(const Standing& after, const effects::Effect& effect) {
    const auto from = begin_for(effect);
    const auto [known, is_new] = errors_before_.try_emplace(from, 0);
    if (is_new) known->second = error_of(before_, from);
    return std::sqrt(error_of(after, from) / known->second) - 1;
}

double LastReadings::error_of(const Standing& standing, physics::Seconds from) const {
    std::vector<double> first = weights_;
    for (std::size_t k = 0; k < first.size(); ++k)
        if (data_.begins[k] >= from) first[k] = 0;
    const study::Fit fitted = study::fit(
        *standing.built.fit_model, standing.built.unknowns, data_.targets.measured, first,
        standing.fit.at, {4, 1e-3, study::without_derivatives});
    const auto residuals =
        study::residuals_of(data_.targets.measured, fitted.at.predicted);
    double sum = 0;
    for (std::size_t k = 0; k < residuals.size(); ++k)
        if (data_.begins[k] >= from) sum += weights_[k] * residuals[k] * residuals[k];
    return sum;
}

std::string objection_to(const LoopData& data, const Standing& before,
                         const Refitted& candidate, double threshold,
                         LastReadings& last_readings) {
    if (candidate.standing.fit.failed) return "cannot be simulated";
    if (candidate.gain <= threshold) return "evidence below what noise shows";
    if (!is_plausible(candidate.effect, candidate.coefficient))
        return "coefficient not plausible";
    const ErrorChange change = error_change_of(before, candidate);
    if (-100 * change.mean < data.options.least_gain)
        return "left-out error falls too little";
    if (100 * change.highest >
        std::max(data.options.most_loss,
                 -100 * decisions::share_in_exchange * change.lowest))
        return "left-out error of a meter rises";
    if (candidate.score < decisions::share_foretold * candidate.gain)
        return "unseen blocks show too little of it";
    if (candidate.effect.driver != effects::Driver::elapsed) return "";
    if (last_readings.change_to(candidate.standing, candidate.effect) >
        data.options.most_loss / 100)
        return "follows time, but does not foretell what comes";
    if (is_within_usual_change(data, candidate))
        return "no more than use changes in a year, on one meter";
    return "";
}

bool is_plausible(const effects::Effect& effect, double c) {
    constexpr double slack = decisions::slack_of_range;
    const double least = std::min(effect.least, effect.most),
                 most = std::max(effect.least, effect.most);
    const double from = least >= 0 ? least / slack : least * slack,
                 to = most <= 0 ? most / slack : most * slack;
    return c >= from && c <= to;
}

}  // namespace bemcal::loop
