/// Holds the coefficient of an effect of the place at three values, fits all parameters
/// beside it, and lays a parabola through what these fits reach.
/// Source: the profile likelihood. Tangents do not do here: parameters follow a station's
/// offset within a hundredth of it, which is less than what either bends.
/// The structure stays: what it has taken of such an effect, no profile gives back.
#include "loop/of_the_place.hpp"

#include "base/error.hpp"
#include "base/nan.hpp"
#include "loop/decisions.hpp"

#include <array>
#include <cmath>
#include <span>

namespace bemcal::loop {
namespace {

/// -2 log likelihood with priors where the coefficient is held; NaN: it cannot be.
double reached_at(double coefficient, const LoopData& data, const Standing& from,
                  std::span<const double> weights, BuiltModel& built) {
    study::FitUnknown& held = built.unknowns.back();
    held.least = held.most = coefficient;
    held.has_prior = false;
    std::vector<double> start = from.fit.at.x;
    start.push_back(held.lowest());
    const study::Fit fit =
        study::fit(*built.fit_model, built.unknowns, data.targets.measured, weights,
                   std::move(start), to_settle);
    return fit.failed ? nan : fit.objective;
}

std::optional<std::pair<double, double>> profile_of(const effects::Effect& effect,
                                                    const LoopData& data,
                                                    const Place& place,
                                                    const Standing& standing) {
    auto effects = standing.model.effects;
    effects.push_back(effect);
    const auto weights = weights_of(data.targets, standing.noise);
    try {
        BuiltModel built = build(place, effects);
        std::array<double, 3> reached{};
        for (std::size_t k = 0; k < reached.size(); ++k)
            reached[k] = reached_at((static_cast<double>(k) - 1) * effect.typical, data,
                                    standing, weights, built);
        return lowest_point(reached[0], reached[1], reached[2], effect.typical);
    } catch (const CannotSimulate&) {
        return std::nullopt;  // The weather lacks what it follows.
    }
}

}  // namespace

std::optional<std::pair<double, double>> lowest_point(double below, double at_zero,
                                                      double above, double step) {
    const double bend = (above + below - 2 * at_zero) / (step * step),
                 at = (below - above) / (2 * step * bend);
    if (!(bend > 0) || std::abs(at) > decisions::most_steps_of_place * std::abs(step))
        return std::nullopt;
    return std::pair{at, std::sqrt(2 / bend)};
}

std::vector<study::PlaceEffect> effects_of_the_place(const LoopData& data,
                                                     const Place& place,
                                                     const Standing& standing,
                                                     const PowerTable& power) {
    std::vector<study::PlaceEffect> all;
    for (const Power& row : power.rows) {
        if (row.effect.hook != effects::Hook::outdoor_air) continue;
        if (const auto found = profile_of(row.effect, data, place, standing))
            all.push_back({row.effect.name, effects::unit_of(row.effect),
                           row.effect.typical, found->first, found->second});
    }
    return all;
}

}  // namespace bemcal::loop
