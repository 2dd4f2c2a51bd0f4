/// Puts declared effects into their building once, and their profiles into the drive of
/// every period: rows that the case keeps for them.
/// Follows from physics::Change. What an effect is rounded to (levels) is found in each
/// period by itself, as a loop finds it. An effect that follows loads leaves them as they
/// are, so that one simulation without it tells what it follows.
/// Left out: other hours than declared, which a schedule can say; loads of a sample,
/// which follow from the nominal building.
#include "effects/declared.hpp"

#include "base/error.hpp"
#include "effects/loads.hpp"
#include "effects/make_surroundings.hpp"
#include "effects/placement.hpp"
#include "effects/placer.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace bemcal::effects {
namespace {

/// All of them, each input's profile in a row of its own.
Placer placed_in(const Surroundings& around, const DeclaredEffects& declared) {
    Placer placer(around, declared.first_row);
    for (const Effect& effect : declared.effects) put(effect, placer);
    return placer;
}

physics::Coefficient coefficient_of(const physics::Parameter& parameter) {
    return {parameter.name, parameter.unit, parameter.least, parameter.most,
            parameter.targets};
}

}  // namespace

bool DeclaredEffects::Functions::follow_loads() const {
    return std::ranges::any_of(functions, [](const DriverFunction& function) {
        return follows_loads(function.driver);
    });
}

bool DeclaredEffects::follow_loads() const {
    return std::ranges::any_of(
               effects,
               [](const Effect& effect) { return follows_loads(effect.driver); }) ||
           std::ranges::any_of(functions, &Functions::follow_loads);
}

void add_columns(const std::vector<DeclaredEffects::Functions>& functions,
                 Surroundings& around) {
    if (functions.empty()) return;
    const FunctionDrivers drivers = function_drivers(around);
    for (const DeclaredEffects::Functions& one : functions) {
        for (const DriverFunction& function : one.functions)
            if (!drivers.contains(function.driver))
                throw CannotSimulate(fmt::format(
                    "the weather of the period from {} lacks what {} follows: {}",
                    physics::format_time(around.drive->period().start), one.column,
                    function.driver));
        around.columns[one.column] = one.is_part
                                         ? sum_of(one.functions, drivers)
                                         : column_of(one.hook, one.functions, drivers);
    }
}

Surroundings surroundings_of(const DeclaredEffects& declared, const physics::Drive& drive,
                             const physics::Weather& weather) {
    return surroundings_of(declared, no_loads(drive), drive, weather);
}

Surroundings surroundings_of(const DeclaredEffects& declared, const ModelSeries& loads,
                             const physics::Drive& drive,
                             const physics::Weather& weather) {
    Surroundings around =
        make_surroundings(declared.building, drive, weather, declared.from);
    for (const DeclaredEffects::Column& column : declared.columns) {
        const auto row = drive.profiles.row(column.row);
        around.columns[column.name].assign(row.begin(), row.end());
    }
    around.clock = declared.clock;
    around.model = loads;
    add_columns(declared.functions, around);
    return around;
}

namespace {

/// The building with effects at their coefficients.
physics::Building building_of(Placer placer, const DeclaredEffects& declared) {
    physics::Building building = std::move(placer.building());
    for (const physics::Parameter& parameter : placer.parameters())
        building.effects.push_back(coefficient_of(parameter));
    const physics::Building at_zero = building;
    physics::apply(at_zero, placer.parameters(), declared.coefficients, building);
    return building;
}

ModelSeries loads_or_none(const physics::Building& building,
                          const physics::Drive& drive) {
    try {
        return loads_of(building, drive);
    } catch (const CannotSimulate&) {
        return no_loads(drive);
    }
}

}  // namespace

physics::Building building_with(const DeclaredEffects& declared,
                                const physics::Drive& drive,
                                const physics::Weather& weather, std::size_t& n_rows) {
    const Surroundings around = surroundings_of(declared, drive, weather);
    const Placer placer = placed_in(around, declared);
    n_rows = placer.rows().size();
    physics::Building building = building_of(placer, declared);
    if (!declared.follow_loads()) return building;
    // Limits of a coefficient come from what its effect follows.
    const Surroundings loaded = surroundings_of(
        declared, loads_or_none(building, placer.drive()), drive, weather);
    return building_of(placed_in(loaded, declared), declared);
}

physics::Profile empty_row(const physics::Weather& weather) {
    physics::Profile row;
    row.name = "of an effect";
    row.is_series = true;
    row.axis = weather.axis;
    row.values.assign(static_cast<std::size_t>(row.axis.n_steps), 0.0);
    return row;
}

void write_profiles(const DeclaredEffects& declared, const ModelSeries& loads,
                    const physics::Weather& weather, physics::Drive& drive) {
    const Surroundings around = surroundings_of(declared, loads, drive, weather);
    const Placer placer = placed_in(around, declared);
    if (placer.rows().size() != declared.n_rows)
        throw CannotSimulate(fmt::format(
            "declared effects enter {} inputs in the period from {}, and {} in training",
            placer.rows().size(), physics::format_time(drive.period().start),
            declared.n_rows));
    for (std::size_t k = 0; k < declared.n_rows; ++k)
        std::ranges::copy(placer.rows()[k],
                          drive.profiles.row(declared.first_row + k).begin());
}

void write_profiles(const DeclaredEffects& declared, const physics::Building& building,
                    const physics::Weather& weather, physics::Drive& drive) {
    write_profiles(declared, no_loads(drive), weather, drive);
    if (declared.follow_loads())
        write_profiles(declared, loads_of(building, drive), weather, drive);
}

}  // namespace bemcal::effects
