/// Puts effects into a building: changes of its inputs, profiles of its drive, and a
/// parameter for each coefficient.
#pragma once

#include "effects/surroundings.hpp"
#include "physics/parameters.hpp"

#include <optional>
#include <span>

namespace bemcal::effects {

/// A building with effects. Coefficients are 0 in `building`, so that without values for
/// `parameters` it is the building before.
struct Placed {
    physics::Building building;
    physics::Drive drive;  ///< with the effects' profiles appended
    /// [effects] one coefficient each, named as its effect (with its sentence where two
    /// have one name). Range: twice as wide as what is plausible, both signs, cut where
    /// physics ends (openings, conductances and shares of 1 + coefficient x profile stay
    /// above 0).
    std::vector<physics::Parameter> parameters;
};

/// Throws CannotSimulate where an effect cannot enter this building (no cooling,
/// no such facade), saying why.
Placed place(std::span<const Effect> effects, const Surroundings& surroundings);

/// The drive with the hours of effects that are other hours than declared; what other
/// effects follow and move are then these, too.
physics::Drive with_other_hours(std::span<const Effect> effects,
                                const physics::Drive& declared);

class Placer;
/// Puts an effect beside those that a placer has; throws as `place` does.
void put(const Effect& effect, Placer& placer);

/// Why the effect cannot enter, or that it has no say at any step of this period (which
/// `place` accepts); none: it can.
std::optional<std::string> objection(const Effect& effect,
                                     const Surroundings& surroundings);

}  // namespace bemcal::effects
