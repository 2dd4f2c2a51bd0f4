/// Takes one step of the search: all candidates screened, the best 36 refitted, 14
/// judged, the first taken that passes.
/// Follows from evidence (fall of the deviance less an Occam factor) against noise.
/// Screening is left to `screen`, gates to `objection_to`. Two effects are never tried at
/// once.
#include "loop/search.hpp"

#include "base/error.hpp"
#include "effects/catalogue.hpp"
#include "loop/closed_days.hpp"
#include "loop/decisions.hpp"
#include "loop/gates.hpp"
#include "loop/moves.hpp"
#include "loop/other_hours.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

namespace bemcal::loop {
namespace {

bool is_among(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
}

/// Whether the job leaves it out, or it has left again at once.
bool is_left_out(const LoopData& data, const std::vector<std::string>& barred,
                 const std::string& name) {
    return is_among(data.options.exclude, name) || is_among(barred, name);
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
    std::ranges::move(closed_days(data, place, standing), std::back_inserter(all));
    std::erase_if(all, [&](const effects::Effect& effect) {
        return is_left_out(data, barred, effect.name) ||
               std::ranges::any_of(standing.model.effects, [&](const auto& there) {
                   return effects::are_equal(effect, there);
               });
    });
    return all;
}

}  // namespace

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
            effect.is_named() ? effect.number : -1 - static_cast<int>(effect.hook),
            effect.is_named() ? effect.name : ""};
        if (list.size() >= decisions::most_refitted || candidate->gain <= 0) break;
        if (++of_kind[key] <= decisions::most_of_a_kind) list.push_back(candidate);
    }
    return list;
}

namespace {

/// Where a model with one more effect begins: the other's derivatives, and the secant of
/// the effect. Nothing where it cannot be simulated.
std::optional<study::Linearised> one_more_from(const study::Linearised& from,
                                               const BuiltModel& built,
                                               double coefficient) {
    const study::FitUnknown& of_effect = built.unknowns.back();
    study::Linearised start{from.x};
    start.x.push_back(std::clamp(coefficient / of_effect.scale, of_effect.lowest(),
                                 of_effect.highest()));
    study::predict_at(*built.fit_model, built.unknowns, start);
    if (std::isnan(start.predicted[0])) return std::nullopt;
    const std::size_t n = start.predicted.size(), last = from.x.size();
    if (!from.has_derivatives() || start.x.back() == 0) return start;
    start.by_secants = true;
    start.derivatives = Matrix(last + 1, n);
    std::ranges::copy(from.derivatives.values, start.derivatives.values.begin());
    for (std::size_t k = 0; k < n; ++k)
        start.derivatives(last, k) =
            (start.predicted[k] - from.predicted[k]) / start.x.back();
    return start;
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
    next.fit.failed = true;
    for (const double part : {1.0, 0.7, 0.4}) {
        auto start = one_more_from(from.fit.at, next.built, part * screened.coefficient);
        if (!start) continue;
        next.fit.at = std::move(*start);
        refit(data, next, {4, 1e-3, study::without_derivatives});
        break;
    }
    return next;
}

/// Runs of days that were picked among all of a year; a calendar is one choice.
double picked(const effects::Effect& effect) {
    const auto alone =
        std::ranges::count(effect.days, false, &effects::Days::of_calendar);
    return static_cast<double>(alone) + (effect.calendar.empty() ? 0 : 1);
}

}  // namespace

double occam(const Screened& screened) {
    static const double of_a_run = 2 * std::log(decisions::days_to_pick_from);
    const double typical = screened.effect.typical;
    return std::log1p(screened.information * typical * typical) +
           of_a_run * picked(screened.effect) +
           (screened.effect.is_named() ? 0 : decisions::price_of_a_tenth) +
           (screened.effect.hook == effects::Hook::meter_factor
                ? decisions::price_of_a_tenth
                : 0);
}

namespace {

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
        if (effect.gate != effects::Gate::on_days) return filled(long_, data_.blocks);
        return filled(short_, data_.blocks_of(decisions::days_of_short_blocks));
    }

  private:
    const Blocks& filled(Blocks& blocks, std::vector<int> of_readings) {
        if (!blocks.left.empty()) return blocks;
        blocks.left =
            left_out_of(data_, before_.built, before_.fit.at, before_.noise, of_readings);
        blocks.of_readings = std::move(of_readings);
        return blocks;
    }

    const LoopData& data_;
    const Standing& before_;
    Blocks long_, short_;
};

/// Left-out errors before and after, and what they say.
void judge_left_out(const LoopData& data, const Standing& before, Unseen& unseen,
                    Refitted& candidate) {
    const auto& [blocks, old_left] = unseen.blocks_for(candidate.effect);
    candidate.left_out = left_out_of(data, candidate.standing.built,
                                     candidate.standing.fit.at, before.noise, blocks);
    candidate.score = deviance(data.targets, before.noise, old_left) -
                      deviance(data.targets, before.noise, candidate.left_out);
    const auto old_squares = mean_squares(data.targets, old_left),
               squares = mean_squares(data.targets, candidate.left_out);
    for (std::size_t c = 0; c < squares.size(); ++c) {
        const bool nothing_to_change = squares[c] == old_squares[c];  // 0 and 0
        candidate.error.push_back(
            nothing_to_change ? 0 : std::sqrt(squares[c] / old_squares[c]) - 1);
    }
}

/// Dozens of candidates stand beside each other; derivatives are kept of those alone that
/// are judged, until they are.
void know_derivatives(Standing& standing) {
    study::linearise(*standing.built.fit_model, standing.built.unknowns, standing.fit.at);
}
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
        } catch (const CannotSimulate&) {
            continue;  // It cannot enter together with the others: no candidate.
        }
    }
    sort_by_gain(ranking, ranking.size());
    return ranking;
}

/// Other hours than declared are no matter of a tangent: they are found by simulation,
/// and stand beside what was screened.
void add_other_hours(const LoopData& data, const Place& place, const Standing& standing,
                     const std::vector<std::string>& barred,
                     std::vector<Refitted>& ranking) {
    if (is_left_out(data, barred, effects::name_of_other_hours)) return;
    for (Departure& found : other_hours(data, place, standing)) {
        Screened as_found{found.effect, 0, 1, 0, {}, {}, {}, 0};
        Standing from = standing;
        from.fit.at = {std::move(found.x), {}, {}};
        Refitted candidate{found.effect, with_effect(data, place, from, as_found)};
        if (candidate.standing.fit.failed) continue;
        candidate.gain = evidence(data, standing, candidate.standing) - found.price;
        drop_derivatives(candidate.standing);
        ranking.push_back(std::move(candidate));
    }
    sort_by_gain(ranking, ranking.size());
}

/// Takes a quick refit to its end.
void finish(const LoopData& data, const Standing& before, Refitted& candidate) {
    Standing& standing = candidate.standing;
    const double was = evidence(data, before, standing);
    refit(data, standing, {10, 2e-4});
    candidate.gain += evidence(data, before, standing) - was;
}

}  // namespace

bool may_lead_by_dates(const Refitted& candidate, double best_gain) {
    return candidate.effect.is_named() &&
           (is_dated(candidate.effect) || is_set_point_window(candidate.effect)) &&
           candidate.gain > std::max(decisions::dated_share_of_best * best_gain,
                                     decisions::dated_evidence);
}

namespace {

/// Moves the dates and hours of what may lead by others, once for each name: the
/// catalogue has a few only, where runs of days are picked to the day.
void move_dates(const LoopData& data, const Place& place, const Standing& before,
                std::vector<Refitted>& ranking, std::size_t n_judged) {
    static const double price_of_dates =
        2 * 2 * std::log(decisions::places_of_date);  ///< of two
    std::vector<std::string> done;
    const double best_gain = ranking.empty() ? 0 : ranking[0].gain;
    for (std::size_t k = 0; k < n_judged && done.size() < decisions::most_dated_names;
         ++k) {
        Refitted& candidate = ranking[k];
        if (!may_lead_by_dates(candidate, best_gain) ||
            std::ranges::find(done, candidate.effect.name) != done.end())
            continue;
        done.push_back(candidate.effect.name);
        const std::size_t newest = before.model.effects.size();
        Standing moved = with_best_shape(data, place, candidate.standing, newest);
        const double more = evidence(data, candidate.standing, moved) - price_of_dates;
        if (more <= 0) continue;
        candidate.gain += more;
        candidate.effect = moved.model.effects[newest];
        candidate.standing = std::move(moved);
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
    return null_gain(screen(data, place, rest, effects, Keep::scores), data.options.alpha,
                     data.options.seed);
}

/// Whether more can be said of it than where and when: it has a name, or follows a series
/// that the job names.
bool may_join(const effects::Effect& effect) {
    return effect.is_named() || effect.driver == effects::Driver::column;
}

}  // namespace

int choice_of(std::vector<Refitted>& ranking) {
    for (std::size_t k = 0; k < ranking.size(); ++k) {
        if (!ranking[k].objection.empty()) continue;
        if (may_join(ranking[k].effect)) return static_cast<int>(k);
        ranking[k].objection = "has no name: left to functions";
    }
    return -1;
}

Step search(const LoopData& data, const Place& place, const Standing& standing,
            const std::vector<std::string>& barred) {
    Step step;
    const auto screened = screen(
        data, place, standing, candidates_of(data, place, standing, barred), Keep::gains);
    step.ranking = refit_all(data, place, standing, shortlist(screened));
    add_other_hours(data, place, standing, barred, step.ranking);
    const std::size_t n_judged = std::min(decisions::most_judged, step.ranking.size());
    for (std::size_t k = 0; k < n_judged; ++k) finish(data, standing, step.ranking[k]);
    sort_by_gain(step.ranking, n_judged);
    move_dates(data, place, standing, step.ranking, n_judged);
    step.threshold = threshold_of(data, place, standing, step);
    Unseen unseen(data, standing);
    LastReadings last_readings(data, standing);
    for (std::size_t k = 0; k < step.ranking.size(); ++k) {
        Refitted& candidate = step.ranking[k];
        if (k >= n_judged) {
            candidate.objection = "not judged";
            continue;
        }
        candidate.coefficient =
            candidate.standing.coefficient(candidate.standing.model.effects.size() - 1);
        if (candidate.gain > decisions::rival_share * step.threshold) {
            know_derivatives(candidate.standing);
            judge_left_out(data, standing, unseen, candidate);
        }
        candidate.objection =
            objection_to(data, standing, candidate, step.threshold, last_readings);
        drop_derivatives(candidate.standing);
    }
    step.chosen = choice_of(step.ranking);
    if (step.chosen >= 0)
        settle(data, step.ranking[static_cast<std::size_t>(step.chosen)].standing);
    return step;
}

}  // namespace bemcal::loop
