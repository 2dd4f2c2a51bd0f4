/// Gives effects and functions of part load what they follow: heating and cooling of the
/// standing model over a period.
/// Follows from `effects::loads_of`. What follows loads leaves them as they are, so they
/// are simulated with everything placed, those of before.
/// While a search goes on, loads stay those of the model before effects, and those that
/// declared effects follow stay the nominal building's.
#include "loop/loads.hpp"

#include "base/error.hpp"
#include "effects/loads.hpp"
#include "loop/find_functions.hpp"

#include <algorithm>

namespace bemcal::loop {
namespace {

effects::ModelSeries loads_in(const Place& place, const Standing& standing) {
    try {
        const BuiltModel built = place_only(place, standing.model.effects);
        return effects::loads_of(building_at(built, values_in(built, standing)),
                                 built.placed->drive);
    } catch (const CannotSimulate&) {
        return {};
    }
}

bool follows_loads(const effects::Effect& effect) {
    return effects::follows_loads(effect.driver);
}

bool follows_loads(const FoundFunction& function) {
    return effects::follows_loads(function.basis.driver);
}

bool declares_loads(const LoopData& data) {
    return data.building.declared_effects &&
           data.building.declared_effects->follow_loads();
}

/// The model in its place with its own loads; as it is where it cannot be.
void place_with_loads(const LoopData& data, const study::FitOptions& options,
                      const std::vector<FoundFunction>& functions, Place& place,
                      Standing& last) {
    Place moved = place;
    moved.surroundings = std::make_shared<effects::Surroundings>(*place.surroundings);
    know_its_loads(data, moved, last, functions);
    Standing there = last;
    try {
        there.built = build(moved, there.model.effects);
    } catch (const CannotSimulate&) {
        return;
    }
    refit(data, there, last.fit.at.x, options);
    if (there.fit.failed) return;
    place = std::move(moved);
    last = std::move(there);
}

}  // namespace

void know_loads(Place& place, const Standing& standing,
                const std::vector<FoundFunction>& functions) {
    const effects::ModelSeries before = place.surroundings->model;
    if (before.heating.empty())
        place.surroundings->model = effects::no_loads(*place.drive);
    add_functions(place, functions);
    effects::ModelSeries series = loads_in(place, standing);
    if (before.most_heating > 0) series.most_heating = before.most_heating;
    if (before.most_cooling > 0) series.most_cooling = before.most_cooling;
    place.surroundings->model = std::move(series);
    add_functions(place, functions);
}

void know_its_loads(const LoopData& data, Place& place, const Standing& standing,
                    const std::vector<FoundFunction>& functions) {
    know_loads(place, standing, functions);
    const effects::ModelSeries& loads = place.surroundings->model;
    if (declares_loads(data) && !loads.heating.empty())
        place.drive =
            drive_with_loads(data, standing.model.structure, loads, place.drive);
}

bool follow_loads(const LoopData& data, const LoopModel& model,
                  const std::vector<FoundFunction>& functions) {
    const auto follows = [](const auto& one) { return follows_loads(one); };
    return declares_loads(data) || std::ranges::any_of(model.effects, follows) ||
           std::ranges::any_of(functions, follows);
}

void settle_loads(const LoopData& data, const std::vector<FoundFunction>& functions,
                  Place& place, Standing& last) {
    if (!follow_loads(data, last.model, functions)) return;
    const effects::ModelSeries& scale = place.surroundings->model;
    for (effects::Effect& effect : last.model.effects)
        if (effect.driver == effects::Driver::heating_load)
            effect.full_load = scale.most_heating;
        else if (effect.driver == effects::Driver::cooling_load)
            effect.full_load = scale.most_cooling;
    if (functions.empty()) {
        // Loads and parameters move each other: what the second round leaves is small.
        place_with_loads(data, to_settle, functions, place, last);
        place_with_loads(data, to_settle, functions, place, last);
    }
    place_with_loads(data, only_derivatives, functions, place, last);
    if (functions.empty()) {
        last.noise = noise_of(data, last.residuals);
        score_unseen(data, last);
    }
}

}  // namespace bemcal::loop
