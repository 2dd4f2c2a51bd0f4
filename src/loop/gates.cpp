/// Judges whether a candidate may join the model, the cheap gates first: evidence,
/// coefficient, errors of unseen blocks, the last quarter of training.
/// Follows from the job's limits, and from how much energy use changes in a year anyhow
/// (`bench_level_change`, 232 buildings).
/// Evidence comes from `search`. Other periods than training decide nothing.
#include "loop/gates.hpp"

#include "loop/decisions.hpp"
#include "loop/level_change.hpp"
#include "loop/moves.hpp"
#include "stats/distributions.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::loop {
namespace {

physics::Seconds last_quarter_of(const LoopData& data) {
    const auto [first, last] = std::ranges::minmax(data.begins);
    return first + 3 * (last - first) / 4;
}

/// Whether the effect acts in the last quarter: what it changes there, of all, counts.
bool acts_in_last_quarter(const LoopData& data, const Standing& before,
                          const Standing& after) {
    const auto from = last_quarter_of(data);
    const auto weights = weights_of(data.targets, before.noise);
    double sum = 0, all = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
        const double moved = after.fit.at.predicted[k] - before.fit.at.predicted[k];
        all += weights[k] * moved * moved;
        if (data.begins[k] >= from) sum += weights[k] * moved * moved;
    }
    return sum > decisions::share_acting_last * all;
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
    if (candidate.effect.driver != effects::Driver::elapsed ||
        data.targets.n_channels() > 1 || usual == 0)
        return false;
    return change_of_level(data, candidate.standing) < stats::z_90_two_sided * usual;
}

/// Relative changes of the left-out errors of the meters that count.
struct ErrorChange {
    double mean = 0;  ///< NaN where none counts
    double highest = 0, lowest = 0;
};

ErrorChange error_change_of(const Standing& before, const Refitted& candidate) {
    ErrorChange change;
    double n = 0;
    for (std::size_t c = 0; c < candidate.error.size(); ++c) {
        if (before.noise[c].share < decisions::least_share_in_mean) continue;
        change.mean += candidate.error[c];
        n += 1;
        change.highest = std::max(change.highest, candidate.error[c]);
        change.lowest = std::min(change.lowest, candidate.error[c]);
    }
    change.mean /= n;
    return change;
}

/// Whether the error of a meter that carries little falls by much: it says nothing of the
/// mean, but what happens there is seen there alone.
bool mends_small_meter(const Standing& before, const Refitted& candidate) {
    if (!candidate.effect.is_named()) return false;
    for (std::size_t c = 0; c < candidate.error.size(); ++c)
        if (before.noise[c].share < decisions::least_share_in_mean &&
            candidate.error[c] < -decisions::fall_of_small_meter)
            return true;
    return false;
}

/// Whether what enters at a meter lowers the error there by much: the others do not see
/// it, and a mean over all would ask for more the more there are.
bool mends_its_meter(const Refitted& candidate, double threshold, double lowest) {
    return candidate.effect.is_named() && effects::is_at_a_meter(candidate.effect.hook) &&
           is_overwhelming(candidate.gain, threshold) &&
           lowest < -decisions::fall_of_own_meter;
}

/// Whether an effect with a name has so much evidence that what it brings may be small,
/// where no meter that counts has a larger error with it.
bool is_certain_if_small(const Refitted& candidate, double threshold, double highest) {
    return candidate.effect.is_named() && candidate.gain > decisions::certain_evidence &&
           is_overwhelming(candidate.gain, threshold) && highest <= 0;
}

/// What is asked of a candidate, by how far its evidence is above what noise shows.
struct Demand {
    Demand(const LoopOptions& options, const Refitted& candidate, double threshold,
           const ErrorChange& change)
        : is_far_above(is_overwhelming(candidate.gain, threshold)),
          is_foretold(
              candidate.score >
              std::max(candidate.gain, decisions::foretold_thresholds * threshold)),
          is_seen_often(candidate.consistency >= decisions::seen_often),
          is_certain(candidate.gain > decisions::certain_thresholds * threshold) {
        least = options.least_gain *
                (candidate.effect.is_named() ? 1 : decisions::more_of_grammar);
        if (is_certain_if_small(candidate, threshold, change.highest))
            least *= decisions::less_if_certain;
        const double in_exchange = (is_certain ? decisions::exchange_if_certain : 1) *
                                   decisions::share_in_exchange;
        most_loss = std::max(options.most_loss, -100 * in_exchange * change.lowest);
    }
    /// A season may be a wrong one, and do harm where it is: but nothing else does as
    /// well.
    bool is_far_above;
    /// Unseen fortnights fall by more than the evidence, which has paid for its freedom.
    bool is_foretold;
    bool is_seen_often;  ///< in more of them than chance shows
    /// What noise never shows is there, though another effect beside it may still be
    /// missing, or the season in which it acts be over.
    bool is_certain;
    double least = 0, most_loss = 0;  ///< of the left-out error's fall and rise [%]
};

/// What the last quarter of training objects to; empty: nothing.
const char* objection_of_time(const LoopData& data, const Standing& before,
                              const Refitted& candidate, const Demand& demand,
                              LastQuarter& last_quarter) {
    const double change = 100 * last_quarter.change_to(candidate.standing);
    const bool is_of_another_season =
        demand.is_far_above || (demand.is_foretold && demand.is_seen_often);
    if (change > demand.most_loss && !is_of_another_season)
        return "last quarter is foretold worse";
    if (candidate.effect.driver == effects::Driver::elapsed &&
        change >
            (demand.is_certain || !acts_in_last_quarter(data, before, candidate.standing)
                 ? demand.most_loss
                 : -demand.least))
        return "follows time, but does not foretell the last quarter";
    if (is_within_usual_change(data, candidate))
        return "no more than use changes in a year, on one meter";
    return "";
}

/// What drifts without a known cause is not carried on beyond the training period.
bool is_nameless_drift(const effects::Effect& effect) {
    return !effect.is_named() && effect.driver == effects::Driver::elapsed &&
           effect.shape.form == effects::Form::linear;
}

}  // namespace

LastQuarter::LastQuarter(const LoopData& data, const Standing& before)
    : data_(data),
      before_(before),
      weights_(weights_of(data.targets, before.noise)),
      is_last_(weights_.size(), 0.0) {
    const auto from = last_quarter_of(data);
    for (std::size_t k = 0; k < weights_.size(); ++k)
        if (data.begins[k] >= from) std::swap(is_last_[k], weights_[k]);
}

double LastQuarter::change_to(const Standing& after) {
    if (!error_before_) error_before_ = error_of(before_);
    return std::sqrt(error_of(after) / *error_before_) - 1;
}

double LastQuarter::error_of(const Standing& standing) const {
    const study::Fit fitted = study::fit(
        *standing.built.fit_model, standing.built.unknowns, data_.targets.measured,
        weights_, standing.fit.at, {4, 1e-3, study::without_derivatives});
    const auto residuals =
        study::residuals_of(data_.targets.measured, fitted.at.predicted);
    double sum = 0;
    for (std::size_t k = 0; k < residuals.size(); ++k)
        sum += is_last_[k] * residuals[k] * residuals[k];
    return sum;
}

std::string objection_to(const LoopData& data, const Standing& before,
                         const Refitted& candidate, double threshold,
                         LastQuarter& last_quarter) {
    if (candidate.standing.fit.failed) return "cannot be simulated";
    if (candidate.gain <= threshold) return "evidence below what noise shows";
    if (!is_plausible(candidate.effect, candidate.coefficient))
        return "coefficient not plausible";
    if (is_at_an_end(data, candidate.effect))
        return "begins in the first or last two weeks";
    if (is_nameless_drift(candidate.effect))
        return "a drift without a name: it may not go on";
    const ErrorChange change = error_change_of(before, candidate);
    const Demand demand(data.options, candidate, threshold, change);
    if (!(100 * change.mean <= -demand.least) && !mends_small_meter(before, candidate) &&
        !mends_its_meter(candidate, threshold, change.lowest))
        return "left-out error falls too little";
    if (100 * change.highest > demand.most_loss) return "left-out error of a meter rises";
    if (candidate.score <= 0) return "left-out score falls";
    if (!demand.is_seen_often && !demand.is_far_above && !demand.is_foretold)
        return "too few unseen fortnights gain";
    if (candidate.standing.fit.bound.back() != 0)
        return "coefficient at the end of its range";
    return objection_of_time(data, before, candidate, demand, last_quarter);
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
