#include "study/loop_search.hpp"

#include "effects/catalogue.hpp"
#include "study/loop_consistency.hpp"
#include "study/loop_days.hpp"
#include "study/loop_moves.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

namespace bemcal::study {
namespace {

constexpr std::size_t most_refitted = 36, most_of_a_kind = 3;
constexpr double generic_penalty = 4.6;  ///< -2 log 0.1: the grammar's prior weight
constexpr double slack = 1.5;  ///< how far beyond the plausible range a coefficient goes

bool is_among(const std::vector<std::string>& names, const effects::Effect& effect) {
    return std::ranges::find(names, effect.name) != names.end();
}

std::vector<effects::Effect> candidates_of(const LoopData& data, const Place& place,
                                           const Standing& standing,
                                           const std::vector<std::string>& barred) {
    const auto meters = data.quantities();
    auto all = effects::named_candidates(*place.surroundings, meters);
    if (data.options.generic) {
        const auto generic = effects::generic_candidates(*place.surroundings, meters);
        all.insert(all.end(), generic.begin(), generic.end());
    }
    if (auto days = closed_days(data, place, standing)) all.push_back(*days);
    std::erase_if(all, [&](const effects::Effect& effect) {
        return is_among(data.options.exclude, effect) || is_among(barred, effect) ||
               std::ranges::any_of(standing.model.effects, [&](const auto& there) {
                   return effects::are_equal(effect, there);
               });
    });
    return all;
}

/// The best by gain, a few of each name only.
std::vector<const Screened*> shortlist(const std::vector<Screened>& screened) {
    std::vector<const Screened*> sorted;
    sorted.reserve(screened.size());
    for (const Screened& candidate : screened) sorted.push_back(&candidate);
    std::ranges::stable_sort(
        sorted, [](const Screened* a, const Screened* b) { return a->gain > b->gain; });
    std::map<std::pair<int, std::string>, std::size_t> of_kind;
    std::vector<const Screened*> list;
    for (const Screened* candidate : sorted) {
        const auto& effect = candidate->effect;
        const std::pair key{
            effect.number != 0 ? effect.number : -1 - static_cast<int>(effect.hook),
            effect.number != 0 ? effect.name : ""};
        if (list.size() >= most_refitted || candidate->gain <= 0) break;
        if (++of_kind[key] <= most_of_a_kind) list.push_back(candidate);
    }
    return list;
}

/// A model with one more effect, from where the other stands. The tangent may lead to
/// where nothing can be simulated (air flows below 0): then less of it.
Standing with_effect(const LoopData& data, const Place& place, const Standing& from,
                     const Screened& screened) {
    Standing next;
    next.model = from.model;
    next.model.effects.push_back(screened.effect);
    next.noise = from.noise;
    next.built = build(place, next.model.effects);
    for (const double part : {1.0, 0.7, 0.4}) {
        std::vector<double> start = from.fit.at.x;
        start.push_back(part * screened.coefficient / next.built.unknowns.back().scale);
        refit(data, next, std::move(start), {4, 1e-3});
        if (!next.fit.failed) break;
    }
    return next;
}

/// What freedom costs: the logarithm of how far the data narrow the coefficient; of runs
/// of days that were picked among all of a year, the choice of each.
double occam(const Screened& screened) {
    static const double of_a_run = 2 * std::log(365.0);
    const double typical = screened.effect.typical;
    return std::log1p(screened.information * typical * typical) +
           of_a_run * static_cast<double>(screened.effect.days.size()) +
           (screened.effect.number == 0 ? generic_penalty : 0);
}

/// Residuals of unseen blocks of the model before, found once for all candidates.
class Unseen {
  public:
    Unseen(const LoopData& data, const Standing& before) : data_(data), before_(before) {}

    /// The blocks over which an effect is tested: shorter where it acts on few days.
    struct Blocks {
        std::vector<int> of_readings;
        std::vector<double> left;  ///< residuals
    };
    const Blocks& blocks_for(const effects::Effect& effect) {
        constexpr double days = 2;
        if (effect.gate != effects::Gate::on_days) return filled(long_, data_.blocks);
        return filled(short_, data_.blocks_of(days));
    }

  private:
    const Blocks& filled(Blocks& blocks, std::vector<int> of_readings) {
        if (!blocks.left.empty()) return blocks;
        blocks.left =
            left_out_of(data_, before_.built, before_.fit, before_.noise, of_readings);
        blocks.of_readings = std::move(of_readings);
        return blocks;
    }

    const LoopData& data_;
    const Standing& before_;
    Blocks long_, short_;
};

/// The blocks' losses and predictions under both models, weighted.
std::vector<BlockChange> changes_of(std::span<const double> weights,
                                    std::span<const int> blocks,
                                    std::span<const double> old_left,
                                    std::span<const double> left) {
    std::map<int, BlockChange> changes;
    for (std::size_t k = 0; k < left.size(); ++k) {
        if (weights[k] <= 0) continue;
        BlockChange& change = changes[blocks[k]];
        const double moved = old_left[k] - left[k];
        change.fall += weights[k] * (old_left[k] * old_left[k] - left[k] * left[k]);
        change.moved += weights[k] * moved * moved;
    }
    std::vector<BlockChange> list;
    list.reserve(changes.size());
    for (const auto& [block, change] : changes) list.push_back(change);
    return list;
}

/// Left-out errors before and after, and what they say.
void judge_left_out(const LoopData& data, const Standing& before, Unseen& unseen,
                    Refitted& candidate) {
    const auto& [blocks, old_left] = unseen.blocks_for(candidate.effect);
    candidate.left_out = left_out_of(data, candidate.standing.built,
                                     candidate.standing.fit, before.noise, blocks);
    candidate.score = deviance(data.targets, before.noise, old_left) -
                      deviance(data.targets, before.noise, candidate.left_out);
    candidate.consistency = consistency_of(changes_of(
        weights_of(data.targets, before.noise), blocks, old_left, candidate.left_out));
    const auto old_squares = mean_squares(data.targets, old_left),
               squares = mean_squares(data.targets, candidate.left_out);
    for (std::size_t c = 0; c < squares.size(); ++c) {
        const bool nothing_to_change = squares[c] == old_squares[c];  // 0 and 0
        candidate.error.push_back(
            nothing_to_change ? 0 : std::sqrt(squares[c] / old_squares[c]) - 1);
    }
}

physics::Seconds last_quarter_of(const LoopData& data) {
    const auto [first, last] = std::ranges::minmax(data.begins);
    return first + 3 * (last - first) / 4;
}

/// The weighted error in the last quarter of training under fits to the first three: what
/// follows time must foretell what comes.
class LastQuarter {
  public:
    LastQuarter(const LoopData& data, const Standing& before)
        : data_(data),
          before_(before),
          weights_(weights_of(data.targets, before.noise)),
          is_last_(weights_.size(), 0.0) {
        const auto from = last_quarter_of(data);
        for (std::size_t k = 0; k < weights_.size(); ++k)
            if (data.begins[k] >= from) std::swap(is_last_[k], weights_[k]);
    }

    /// Relative change from the model before.
    double change_to(const Standing& after) {
        if (!error_before_) error_before_ = error_of(before_);
        return std::sqrt(error_of(after) / *error_before_) - 1;
    }

  private:
    double error_of(const Standing& standing) const {
        const Fit fitted =
            fit(*standing.built.fit_model, standing.built.unknowns,
                data_.targets.measured, weights_, standing.fit.at.x, {4, 1e-3});
        const auto residuals = residuals_of(data_.targets.measured, fitted.at.predicted);
        double sum = 0;
        for (std::size_t k = 0; k < residuals.size(); ++k)
            sum += is_last_[k] * residuals[k] * residuals[k];
        return sum;
    }

    const LoopData& data_;
    const Standing& before_;
    std::vector<double> weights_, is_last_;
    std::optional<double> error_before_;  ///< few candidates come so far
};

/// Whether the effect acts in the last quarter: what it changes there, of all, counts.
bool acts_in_last_quarter(const LoopData& data, const Standing& before,
                          const Standing& after) {
    constexpr double at_all = 0.05;
    const auto from = last_quarter_of(data);
    const auto weights = weights_of(data.targets, before.noise);
    double sum = 0, all = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
        const double moved = after.fit.at.predicted[k] - before.fit.at.predicted[k];
        all += weights[k] * moved * moved;
        if (data.begins[k] >= from) sum += weights[k] * moved * moved;
    }
    return sum > at_all * all;
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
/// in a year everywhere (standard deviations of 232 buildings' weather-corrected energy,
/// bench/bench_level_change.py): a meter alone cannot tell the two apart.
bool is_within_usual_change(const LoopData& data, const Refitted& candidate) {
    using physics::Quantity;
    constexpr double of_electricity = 0.06, of_fuel = 0.18, one_of_ten = 1.645;
    const Quantity quantity = data.targets.channels[0].quantity;
    if (candidate.effect.driver != effects::Driver::elapsed ||
        data.targets.n_channels() > 1 || quantity == Quantity::air_temperature)
        return false;
    const double usual = quantity == Quantity::electricity ? of_electricity : of_fuel;
    return change_of_level(data, candidate.standing) < one_of_ten * usual;
}

/// Relative changes of the left-out errors of the meters that count.
struct ErrorChange {
    double mean = 0;  ///< NaN where none counts
    double highest = 0, lowest = 0;
};

ErrorChange error_change_of(const Standing& before, const Refitted& candidate) {
    constexpr double matters = 0.5;
    ErrorChange change;
    double n = 0;
    for (std::size_t c = 0; c < candidate.error.size(); ++c) {
        if (before.noise[c].share < matters) continue;
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
    constexpr double matters = 0.5, much = 0.15;
    if (candidate.effect.number == 0) return false;
    for (std::size_t c = 0; c < candidate.error.size(); ++c)
        if (before.noise[c].share < matters && candidate.error[c] < -much) return true;
    return false;
}

/// Whether an effect with a name has so much evidence that what it brings may be small,
/// where no meter that counts has a larger error with it.
bool is_certain_if_small(const Refitted& candidate, double threshold, double highest) {
    constexpr double much = 150;  ///< of evidence: half of it is seen in buildings that
                                  ///< lack nothing
    return candidate.effect.number != 0 && candidate.gain > much &&
           is_overwhelming(candidate.gain, threshold) && highest <= 0;
}

/// What is asked of a candidate, by how far its evidence is above what noise shows.
struct Demand {
    Demand(const LoopOptions& options, const Refitted& candidate, double threshold,
           const ErrorChange& change)
        : is_far_above(is_overwhelming(candidate.gain, threshold) ||
                       candidate.score > std::max(candidate.gain, 2 * threshold)),
          is_certain(candidate.gain > 8 * threshold) {
        constexpr double more_of_grammar = 3, less_if_certain = 0.7;
        least = options.least_gain * (candidate.effect.number == 0 ? more_of_grammar : 1);
        if (is_certain_if_small(candidate, threshold, change.highest))
            least *= less_if_certain;
        const double in_exchange = is_certain ? 0.3 : 0.15;  // of the best meter's gain
        most_loss = std::max(options.most_loss, -100 * in_exchange * change.lowest);
    }
    /// A season may be a wrong one, and do harm where it is: but nothing else does as
    /// well, or unseen fortnights gain as much as those that were fitted.
    bool is_far_above;
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
    if (change > demand.most_loss && !demand.is_far_above)
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
    return effect.number == 0 && effect.driver == effects::Driver::elapsed &&
           effect.shape.form == effects::Form::linear;
}

/// The first gate that is not passed.
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
    if (!(100 * change.mean <= -demand.least) && !mends_small_meter(before, candidate))
        return "left-out error falls too little";
    if (100 * change.highest > demand.most_loss) return "left-out error of a meter rises";
    if (candidate.score <= 0) return "left-out score falls";
    constexpr double seldom = 2;  ///< standard errors
    if (candidate.consistency < seldom && !demand.is_far_above)
        return "too few unseen fortnights gain";
    if (candidate.standing.fit.bound.back() != 0)
        return "coefficient at the end of its range";
    return objection_of_time(data, before, candidate, demand, last_quarter);
}

/// Dozens of candidates stand beside each other; only one is fitted on, from its start.
void drop_derivatives(Standing& standing) {
    standing.fit.at.derivatives = {};
}

void sort_by_gain(std::vector<Refitted>& ranking, std::size_t first_so_many) {
    std::stable_sort(
        ranking.begin(), ranking.begin() + static_cast<std::ptrdiff_t>(first_so_many),
        [](const Refitted& a, const Refitted& b) { return a.gain > b.gain; });
}

std::vector<Refitted> refit_all(const LoopData& data, const Place& place,
                                const Standing& standing,
                                const std::vector<const Screened*>& list) {
    std::vector<Refitted> ranking;
    for (const Screened* screened : list) {
        try {
            Refitted candidate{screened->effect,
                               with_effect(data, place, standing, *screened)};
            if (candidate.standing.fit.failed) continue;
            candidate.gain =
                evidence(data, standing, candidate.standing) - occam(*screened);
            drop_derivatives(candidate.standing);
            ranking.push_back(std::move(candidate));
        } catch (const std::exception&) {
            continue;  // It cannot enter together with the others: no candidate.
        }
    }
    sort_by_gain(ranking, ranking.size());
    return ranking;
}

constexpr std::size_t most_judged = 14;

/// Takes a quick refit to its end.
void finish(const LoopData& data, const Standing& before, Refitted& candidate) {
    Standing& standing = candidate.standing;
    const double was = evidence(data, before, standing);
    refit(data, standing, standing.fit.at.x, {10, 2e-4});
    candidate.gain += evidence(data, before, standing) - was;
    drop_derivatives(standing);
}

/// Whether other dates may make a candidate the best.
bool may_lead_by_dates(const Refitted& candidate, double best_gain) {
    constexpr double share = 0.3, enough = 100;
    return candidate.effect.number != 0 && is_dated(candidate.effect) &&
           candidate.gain > std::max(share * best_gain, enough);
}

/// Moves the dates of what may lead by others, once for each name: the catalogue has a
/// few dates only, where runs of days are picked to the day.
void move_dates(const LoopData& data, const Place& place, const Standing& before,
                std::vector<Refitted>& ranking, std::size_t n_judged) {
    constexpr std::size_t most = 3;
    static const double of_dates = 2 * 2 * std::log(28.0);  ///< two, of four weeks' days
    std::vector<std::string> done;
    const double best_gain = ranking.empty() ? 0 : ranking[0].gain;
    for (std::size_t k = 0; k < n_judged && done.size() < most; ++k) {
        Refitted& candidate = ranking[k];
        if (!may_lead_by_dates(candidate, best_gain) ||
            std::ranges::find(done, candidate.effect.name) != done.end())
            continue;
        done.push_back(candidate.effect.name);
        const std::size_t newest = before.model.effects.size();
        Standing moved = with_best_shape(data, place, candidate.standing, newest);
        const double more = evidence(data, candidate.standing, moved) - of_dates;
        if (more <= 0) continue;
        candidate.gain += more;
        candidate.effect = moved.model.effects[newest];
        candidate.standing = std::move(moved);
        drop_derivatives(candidate.standing);
    }
    sort_by_gain(ranking, n_judged);
}

/// What the search would gain from noise: from what the best candidate leaves, for what
/// is there to be found is no noise.
double threshold_of(const LoopData& data, const Place& place, const Standing& standing,
                    const Step& step) {
    if (step.ranking.empty()) return 0;
    std::vector<effects::Effect> effects;
    effects.reserve(step.ranking.size());
    for (const Refitted& candidate : step.ranking) effects.push_back(candidate.effect);
    Standing rest = standing;
    rest.residuals = step.ranking[0].standing.residuals;
    return null_gain(screen(data, place, rest, effects, Keep::gains), data.options.alpha,
                     data.options.seed);
}

/// The first that passes; one of the grammar only where nothing with a name comes near.
/// None where what does not pass explains clearly more: then it is the model's misfit
/// that they all take a part of.
int choice_of(std::vector<Refitted>& ranking) {
    constexpr double near = 0.6;  ///< of the gain
    constexpr double clearly = 1.25;
    int first = -1;
    for (std::size_t k = 0; k < ranking.size(); ++k) {
        if (!ranking[k].objection.empty()) continue;
        if (first < 0 && ranking[0].gain > clearly * ranking[k].gain) {
            ranking[k].objection = "others that do not pass explain more";
            continue;
        }
        if (first < 0) first = static_cast<int>(k);
        const double best = ranking[static_cast<std::size_t>(first)].gain;
        if (ranking[k].effect.number != 0 && ranking[k].gain > near * best)
            return static_cast<int>(k);
    }
    return first;
}

}  // namespace

bool is_plausible(const effects::Effect& effect, double c) {
    const double least = std::min(effect.least, effect.most),
                 most = std::max(effect.least, effect.most);
    const double from = least >= 0 ? least / slack : least * slack,
                 to = most <= 0 ? most / slack : most * slack;
    return c >= from && c <= to;
}

Step search(const LoopData& data, const Place& place, const Standing& standing,
            const std::vector<std::string>& barred) {
    Step step;
    const auto screened = screen(
        data, place, standing, candidates_of(data, place, standing, barred), Keep::gains);
    step.ranking = refit_all(data, place, standing, shortlist(screened));
    const std::size_t n_judged = std::min(most_judged, step.ranking.size());
    for (std::size_t k = 0; k < n_judged; ++k) finish(data, standing, step.ranking[k]);
    sort_by_gain(step.ranking, n_judged);
    move_dates(data, place, standing, step.ranking, n_judged);
    step.threshold = threshold_of(data, place, standing, step);
    Unseen unseen(data, standing);
    LastQuarter last_quarter(data, standing);
    for (std::size_t k = 0; k < step.ranking.size(); ++k) {
        Refitted& candidate = step.ranking[k];
        if (k >= n_judged) {
            candidate.objection = "not judged";
            continue;
        }
        candidate.coefficient =
            candidate.standing.coefficient(candidate.standing.model.effects.size() - 1);
        if (candidate.gain > of_a_rival * step.threshold)
            judge_left_out(data, standing, unseen, candidate);
        candidate.objection =
            objection_to(data, standing, candidate, step.threshold, last_quarter);
    }
    step.chosen = choice_of(step.ranking);
    if (step.chosen >= 0)
        settle(data, step.ranking[static_cast<std::size_t>(step.chosen)].standing);
    return step;
}

}  // namespace bemcal::study
