/// Compares the last model with the same without one of its effects, input by input, in
/// every period.
/// Follows from `effects::changes_between`.
/// Effects of the structure stay: they say how the standard's hour falls short, not what
/// the building does.
#include "loop/given_effects.hpp"

#include "loop/period_hours.hpp"

#include <algorithm>
#include <memory>

namespace bemcal::loop {
namespace {

/// What the model does at its hooks because of one effect. Other hours than declared are
/// there or not; every other effect is taken out by a coefficient of 0, which leaves all
/// parts where they are.
std::vector<effects::HookSeries> changes_by(const Place& place, const BuiltModel& with,
                                            const std::vector<double>& values,
                                            const std::vector<effects::Effect>& all,
                                            std::size_t effect) {
    const physics::Building whole = building_at(with, values);
    const std::size_t k = with.first_effect() + effect;
    std::vector<double> fewer_values = values;
    if (!all[effect].other_hours) {
        fewer_values[k] = 0;
        const physics::Building less = building_at(with, fewer_values);
        return effects::changes_between({less, with.placed->drive},
                                        {whole, with.placed->drive});
    }
    auto fewer = all;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(effect));
    fewer_values.erase(fewer_values.begin() + static_cast<std::ptrdiff_t>(k));
    const BuiltModel without = place_only(place, fewer);
    const physics::Building less = building_at(without, fewer_values);
    return effects::changes_between({less, without.placed->drive},
                                    {whole, with.placed->drive});
}

/// The same because of all functions. Where these are 0, all parts stay where they are.
std::vector<effects::HookSeries> changes_by_functions(const Place& place,
                                                      const BuiltModel& with,
                                                      const std::vector<double>& values,
                                                      const LoopModel& model) {
    Place fewer = place;
    fewer.surroundings = std::make_shared<effects::Surroundings>(*place.surroundings);
    for (const effects::Effect& function : place.functions)
        std::ranges::fill(fewer.surroundings->columns[function.column], 0.0);
    const BuiltModel without = place_only(fewer, model.effects);
    return effects::changes_between({building_at(without, values), without.placed->drive},
                                    {building_at(with, values), with.placed->drive});
}

}  // namespace

std::vector<study::GivenEffect> given_effects(const LoopData& data,
                                              const LoopResult& result) {
    const auto& found = result.last.model.effects;
    std::vector<study::GivenEffect> given(found.size());
    for (std::size_t k = 0; k < found.size(); ++k) given[k].name = found[k].name;
    if (!result.functions.empty()) given.push_back({"functions", {}});
    std::size_t n_before = 0;
    for (const study::Period& period : data.building.periods) {
        const Place place =
            place_in(data, result.last, result.functions, data.drive_over(period));
        const BuiltModel built = place_only(place, found);
        const std::vector<double> values = values_in(built, result.last);
        const auto n_hours = static_cast<std::size_t>(study::hours_of(period));
        for (std::size_t k = 0; k < found.size(); ++k)
            effects::append(given[k].at, n_before,
                            changes_by(place, built, values, found, k), n_hours);
        if (!result.functions.empty())
            effects::append(given.back().at, n_before,
                            changes_by_functions(place, built, values, result.last.model),
                            n_hours);
        n_before += n_hours;
    }
    return given;
}

}  // namespace bemcal::loop
