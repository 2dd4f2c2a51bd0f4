/// Moves a model that stands, each time by a refit from there: thresholds, dates and
/// hours of an effect, a rival in its place, plant apart from use, effects out, more
/// weight for a meter.
/// Follows from a search one number at a time with moves that shrink; evidence decides.
/// Two effects are never moved together. New ones are found by `search`.
#include "loop/moves.hpp"

#include "base/error.hpp"
#include "loop/decisions.hpp"
#include "loop/gates.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace bemcal::loop {
namespace {

using decisions::least_evidence_of_move, decisions::two_weeks_at_ends;

/// Where a shape begins at the earliest: readings before a date tell what changes on it.
double earliest(const effects::Effect& effect) {
    return effect.driver == effects::Driver::elapsed ? two_weeks_at_ends : -1e9;
}

double hours_within(const effects::Shape& shape) {
    return std::fmod(shape.until - shape.at + 24, 24);
}

/// The effect with one of its thresholds, dates or hours moved.
std::vector<effects::Effect> moved_shapes(const effects::Effect& effect, double part) {
    std::vector<effects::Effect> moved;
    const auto add = [&](auto change) {
        moved.push_back(effect);
        change(moved.back());
    };
    const double move = effects::first_move(effect) * part;
    for (const double sign : {1.0, -1.0}) {
        if (move > 0)
            add([&](effects::Effect& e) {
                e.shape.at = std::max(e.shape.at + sign * move, earliest(e));
            });
        if (move > 0 && effect.shape.form == effects::Form::within)
            add([&](effects::Effect& e) { e.shape.until += sign * move; });
        const double hours =
            std::max(1.0, std::round(decisions::hours_of_first_move * part));
        if (effect.hours.from > 0 || effect.hours.until < 24) {
            add([&](effects::Effect& e) {
                e.hours.from = std::max(0.0, e.hours.from + sign * hours);
            });
            add([&](effects::Effect& e) {
                e.hours.until = std::min(24.0, e.hours.until + sign * hours);
            });
        }
    }
    std::erase_if(moved, [](const effects::Effect& one) {
        return is_set_point_window(one) &&
               hours_within(one.shape) < decisions::least_window;
    });
    return moved;
}

/// Whether a moved shape is a better one.
constexpr study::FitOptions quick{2, 1e-3, study::without_derivatives};

/// Takes the moves that help; says whether any did.
bool move_shape(const LoopData& data, const Place& place, Standing& standing,
                std::size_t index, double part) {
    bool helped = false;
    for (const auto& effect : moved_shapes(standing.model.effects[index], part)) {
        Standing tried = with_in_place(data, place, standing,
                                       {index, effect, standing.fit.at.x, quick});
        if (tried.fit.failed || tried.fit.objective >= standing.fit.objective -
                                                           decisions::least_fall_of_shape)
            continue;
        standing = std::move(tried);
        helped = true;
    }
    return helped;
}

}  // namespace

Standing with_in_place(const LoopData& data, const Place& place, const Standing& standing,
                       const InPlace& change) {
    Standing tried = standing;
    tried.model.effects[change.index] = change.effect;
    try {
        tried.built = build(place, tried.model.effects);
    } catch (const CannotSimulate&) {
        tried.fit.failed = true;
        return tried;
    }
    refit(data, tried, change.start, change.options);
    return tried;
}

std::vector<double> start_of_rival(const Standing& standing, std::size_t effect,
                                   const effects::Effect& rival) {
    std::vector<double> start = standing.fit.at.x;
    start[standing.built.first_effect() + effect] = rival.most > 0 ? 0.5 : -0.5;
    return start;
}

bool is_dated(const effects::Effect& effect) {
    return effect.driver == effects::Driver::day_of_year ||
           effect.driver == effects::Driver::elapsed;
}

bool is_set_point_window(const effects::Effect& effect) {
    using effects::Hook;
    return (effect.hook == Hook::heating_set_point ||
            effect.hook == Hook::cooling_set_point) &&
           effect.driver == effects::Driver::hour &&
           effect.shape.form == effects::Form::within;
}

bool is_at_an_end(const LoopData& data, const effects::Effect& effect) {
    const study::Period& training = data.training();
    const std::chrono::duration<double, std::chrono::years::period> years =
        training.to - training.from;
    const double at = effect.shape.at;
    return effect.driver == effects::Driver::elapsed &&
           effect.shape.form == effects::Form::over &&
           (at <= two_weeks_at_ends || at >= years.count() - two_weeks_at_ends);
}

Standing with_best_shape(const LoopData& data, const Place& place, Standing standing,
                         std::size_t index) {
    constexpr double day = 1 / decisions::days_of_first_move;  ///< of a date's first move
    refit(data, standing, quick);  // the objective by its own noise
    for (const double part : {1.0, 0.5, 0.25, 2 * day, day}) {
        if (part < 0.25 && !is_dated(standing.model.effects[index])) break;
        for (int k = 0;
             k < decisions::most_moves && move_shape(data, place, standing, index, part);
             ++k) {
        }
    }
    return standing;
}

bool start_again(const LoopData& data, const Place& place, Standing& standing) {
    std::vector<double> start(standing.fit.at.x.size(), 0.0);
    // At a middling size at least: a coefficient that the parameters have left little of.
    for (std::size_t k = standing.built.first_effect(); k < start.size(); ++k)
        start[k] = std::copysign(std::max(std::abs(standing.fit.at.x[k]), 1.0),
                                 standing.fit.at.x[k]);
    Standing again = calibrate(data, place, standing.model, std::move(start));
    if (again.fit.failed || evidence(data, standing, again) <= least_evidence_of_move)
        return false;
    standing = std::move(again);
    return true;
}

Standing refine_shape(const LoopData& data, const Place& place, Standing standing,
                      std::size_t index) {
    Standing refined = with_best_shape(data, place, std::move(standing), index);
    settle(data, refined);
    return refined;
}

double deviation_over_shapes(const LoopData& data, const Place& place,
                             const Standing& standing, std::size_t effect,
                             double misfit) {
    Standing own = standing;
    refit(data, own, quick);  // the objective by its own noise
    double likely = 1, square = 0;
    for (const double part : {1.0, 0.5})
        for (const auto& moved : moved_shapes(standing.model.effects[effect], part)) {
            const Standing tried =
                with_in_place(data, place, own, {effect, moved, own.fit.at.x, quick});
            if (tried.fit.failed) continue;
            const double worse = std::max(0.0, tried.fit.objective - own.fit.objective);
            const double weight = std::exp(-0.5 * worse / misfit);
            const double change = tried.coefficient(effect) - own.coefficient(effect);
            likely += weight;
            square += weight * change * change;
        }
    return std::sqrt(square / likely);
}

int swap(const LoopData& data, const Place& place, Standing& standing, std::size_t effect,
         const std::vector<effects::Effect>& rivals) {
    int best = -1;
    double most = least_evidence_of_move;
    Standing chosen;
    const std::size_t unknown = standing.built.first_effect() + effect;
    const bool has_name = standing.model.effects[effect].is_named();
    for (std::size_t k = 0; k < rivals.size(); ++k) {
        if (has_name && !rivals[k].is_named()) continue;  // says less
        Standing tried = with_in_place(data, place, standing,
                                       {effect,
                                        rivals[k],
                                        start_of_rival(standing, effect, rivals[k]),
                                        {6, 1e-3, study::without_derivatives}});
        if (tried.fit.failed || tried.fit.bound[unknown] != 0 ||
            !is_plausible(rivals[k], tried.coefficient(effect)))
            continue;
        const double gain = evidence(data, standing, tried);
        if (gain <= most) continue;
        most = gain, best = static_cast<int>(k);
        chosen = std::move(tried);
    }
    if (best < 0) return best;
    settle(data, chosen);
    standing = std::move(chosen);
    return best;
}

namespace {

/// Where one of two halves leaves that were split, the other stands for both again.
void join_halves(const effects::Effect& gone, std::vector<effects::Effect>& all) {
    using effects::Hook;
    for (effects::Effect& half : all) {
        const bool is_plant = half.hook == Hook::plant_operation &&
                              gone.name == half.name + suffix_of_use,
                   is_use = gone.hook == Hook::plant_operation &&
                            half.name == gone.name + suffix_of_use;
        if (!is_plant && !is_use) continue;
        half.hook = Hook::operation;
        if (is_use) half.name = gone.name;
    }
}

}  // namespace

bool split(const LoopData& data, const Place& place, Standing& standing,
           std::size_t effect, double least) {
    const effects::Effect whole = standing.model.effects[effect];
    if (whole.hook != effects::Hook::operation ||
        whole.driver != effects::Driver::another_day)
        return false;
    Standing tried = standing;
    effects::Effect& plant = tried.model.effects[effect];
    plant.hook = effects::Hook::plant_operation;
    effects::Effect use = whole;
    use.hook = effects::Hook::occupation;
    use.name += suffix_of_use;
    tried.model.effects.push_back(use);
    try {
        tried.built = build(place, tried.model.effects);
    } catch (const CannotSimulate&) {
        return false;
    }
    std::vector<double> start = standing.fit.at.x;
    start.push_back(start[standing.built.first_effect() + effect]);
    refit(data, tried, std::move(start), {8, 1e-3, study::without_derivatives});
    if (tried.fit.failed ||
        evidence(data, standing, tried) < std::max(least, least_evidence_of_move))
        return false;
    // Else one name says it all.
    const std::size_t last = tried.model.effects.size() - 1;
    if (std::abs(tried.coefficient(effect) - tried.coefficient(last)) <
        decisions::least_difference_of_halves)
        return false;
    tried = refine_shape(data, place, std::move(tried), effect);
    standing = refine_shape(data, place, std::move(tried), standing.model.effects.size());
    return true;
}

namespace {

/// The model without one of its effects, from where it stands.
Standing without_effect(const LoopData& data, const Place& place,
                        const Standing& standing, std::size_t effect) {
    Standing without;
    without.model = standing.model;
    auto& left = without.model.effects;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(effect));
    join_halves(standing.model.effects[effect], left);
    without.noise = standing.noise;
    without.built = build(place, without.model.effects);
    std::vector<double> start = standing.fit.at.x;
    start.erase(start.begin() +
                static_cast<std::ptrdiff_t>(standing.built.first_effect() + effect));
    refit(data, without, std::move(start), {5, 1e-3, study::without_derivatives});
    return without;
}

/// Parameters that had moved with an effect may not find back from there: a boiler that
/// stood for a meter's scale. So they are calibrated anew, too.
void stand_without(const LoopData& data, const Place& place, Standing& standing,
                   Standing without) {
    settle(data, without);
    start_again(data, place, without);
    standing = std::move(without);
}

}  // namespace

std::optional<Gone> take_out(const LoopData& data, const Place& place, Standing& standing,
                             std::size_t effect) {
    Standing without = without_effect(data, place, standing, effect);
    if (without.fit.failed) return std::nullopt;
    Gone gone{effect, standing.model.effects[effect].name};
    stand_without(data, place, standing, std::move(without));
    return gone;
}

std::vector<Gone> prune(const LoopData& data, const Place& place, Standing& standing,
                        double least) {
    std::vector<Gone> gone;
    while (!standing.model.effects.empty()) {
        double lowest = least;
        std::size_t weakest = 0;
        Standing best;
        for (std::size_t k = 0; k < standing.model.effects.size(); ++k) {
            Standing without = without_effect(data, place, standing, k);
            if (without.fit.failed) continue;
            const double carried = evidence(data, without, standing);
            if (carried > lowest) continue;
            lowest = carried, weakest = k;
            best = std::move(without);
        }
        if (!best.built.fit_model) break;
        gone.push_back({weakest, standing.model.effects[weakest].name});
        stand_without(data, place, standing, std::move(best));
    }
    return gone;
}

std::vector<Gone> prune_implausible(const LoopData& data, const Place& place,
                                    Standing& standing) {
    std::vector<Gone> gone;
    for (std::size_t k = 0; k < standing.model.effects.size();) {
        const effects::Effect& effect = standing.model.effects[k];
        if (is_plausible(effect, standing.coefficient(k)) &&
            !is_at_an_end(data, effect)) {
            ++k;
            continue;
        }
        const auto left = take_out(data, place, standing, k);
        if (!left) return gone;
        gone.push_back(*left);
        k = 0;
    }
    return gone;
}

namespace {

/// By how much the error of each meter that counts has grown, as a ratio of mean squares;
/// 1 for the others. Errors below what a model may have are none.
std::vector<double> growth_of(const LoopData& data, const Standing& before,
                              const Standing& after) {
    const auto old = mean_squares(data.targets, before.residuals),
               now = mean_squares(data.targets, after.residuals);
    std::vector<double> growth;
    growth.reserve(old.size());
    for (std::size_t c = 0; c < old.size(); ++c) {
        const ChannelNoise& noise = before.noise[c];
        const double met =
            std::pow(std::hypot(noise.least, decisions::met_exactly * noise.sigma), 2);
        // Where next to nothing flows, nothing can be kept.
        growth.push_back(noise.share < decisions::least_share_spared
                             ? 1
                             : (now[c] + met) / (old[c] + met));
    }
    return growth;
}

/// Whether the effects are still what was found.
bool are_the_same(const Standing& found, const Standing& now) {
    for (std::size_t k = 0; k < found.model.effects.size(); ++k) {
        const double was = found.coefficient(k), is = now.coefficient(k);
        if (std::abs(is - was) > decisions::most_change_spared * std::abs(was) ||
            now.fit.bound[now.built.first_effect() + k] != 0)
            return false;
    }
    return true;
}

}  // namespace

bool spare_meters(const LoopData& data, const Standing& before, Standing& standing) {
    constexpr double most_growth = decisions::most_growth_spared;
    std::vector<double> growth = growth_of(data, before, standing);
    double least = std::ranges::max(growth);
    Standing tried = standing, best = standing;
    bool is_better = false;
    for (int round = 0;
         round < decisions::most_rounds_spared && std::ranges::max(growth) > most_growth;
         ++round) {
        for (std::size_t c = 0; c < growth.size(); ++c)
            if (growth[c] > most_growth)
                tried.noise[c].sigma /= std::min(1.5, std::pow(growth[c], 4));
        refit(data, tried, {6, 3e-4});
        if (tried.fit.failed || !are_the_same(standing, tried)) break;
        growth = growth_of(data, before, tried);
        if (std::ranges::max(growth) >= least) continue;
        least = std::ranges::max(growth);
        best = tried;
        is_better = true;
    }
    best.noise = standing.noise;  // what is known of errors has not changed
    standing = std::move(best);
    return is_better;
}

}  // namespace bemcal::loop
