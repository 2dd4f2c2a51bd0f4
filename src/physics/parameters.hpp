/// The numbers of a building that a job may vary, by their paths, and points written into
/// a building.
#pragma once

#include "physics/building.hpp"
#include "physics/numbers.hpp"

#include <span>
#include <string>
#include <vector>

namespace bemcal::physics {

/// How the parameter's value enters: it replaces the number, or multiplies or shifts what
/// stands in the nominal building.
enum class Effect { replace, factor, offset };

struct Parameter {
    std::string name;
    std::string unit;
    double least = 0, most = 1;  ///< range
    Effect effect = Effect::replace;
    std::vector<Target> targets;  ///< several = linked
    /// Value in the nominal building: of a factor 1 and of an offset 0, if that has the
    /// numbers as described.
    double nominal = 0;
};

/// Places named by a path: "zone.office.flow.infiltration.air_change",
/// "construction.*.u_value", "plant.cooling_cop", "zone.*.heating_set_point.low". A
/// star stands for every name, never for a part or a number. Thermostat and structure
/// fields belong to their zone. A number that the structure has elsewhere is found there
/// (Building::moved). Throws std::invalid_argument that lists what would have
/// matched.
std::vector<Target> resolve(const Building& building, const std::string& path);

/// The path of a number that is no change of an input, as `resolve` takes it:
/// "zone.office.mass_area_ratio".
std::string path_of(const Building& building, const Target& target);

/// Places of all inputs.
std::vector<Target> inputs_of(const Building& building);

/// Places of the inputs that follow a row of Drive::profiles.
std::vector<Target> inputs_that_follow(const Building& building, int profile);

/// Writes a point into `building`, which must be a copy of `nominal` (its other numbers
/// are left as they are), and what follows from it (derived.hpp). Where two parameters
/// have the same target the last one holds. No allocation, no look-up by name.
void apply(const Building& nominal, std::span<const Parameter> parameters,
           std::span<const double> point, Building& building);

/// The building has this value from here on, where no point says another: the parameter
/// means what it did. A factor of 0 is one of 1e-9, for it would leave nothing to change.
void set_nominal(double value, Parameter& parameter, Building& building);

}  // namespace bemcal::physics
