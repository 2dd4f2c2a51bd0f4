/// Refinements of the standard's zone: what buildings have in some measure and the
/// standard's hour leaves out. A structure is a list of them, indices into the table.
#pragma once

#include "effects/effect.hpp"
#include "physics/parameters.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bemcal::effects {

struct Refinement {
    const char* name;
    const char* what;  ///< it refines
    struct Number {
        const char* name;
        const char* path;  ///< of physics::resolve
        double mean, sd, least, most;
    };
    std::vector<Number> numbers;
    /// What every building has in some measure: an effect with a prior.
    struct Always {
        Effect effect;
        double mean, sd, least, most;
    };
    std::vector<Always> effects{};
    /// Changes the building as described; whether there was anything to change.
    bool (*change)(physics::Building&) = nullptr;
    const char* kind = "";  ///< of one kind a structure has one
};
const std::vector<Refinement>& refinements();

/// `describe structure`: the table as text.
std::string describe_structure();

/// "surfaces + sky"; "standard" without any.
std::string name_of(const std::vector<std::size_t>& structure);

/// Whether a structure cannot have both.
bool are_of_one_kind(std::size_t one, std::size_t other);

/// A structure that a refinement joins, in place of one of its kind; nothing where it is
/// there, or where its kind is declared, which stays.
std::optional<std::vector<std::size_t>> joined_by(
    std::size_t refinement, std::vector<std::size_t> structure,
    const std::vector<std::size_t>& declared);

/// All planes that any structure asks for, in every one of them: they share one drive.
void add_planes_of_refinements(physics::Building& building);

/// Where a number stands in every zone, but what other parameters write to: that keeps
/// its prior.
std::vector<physics::Target> free_targets(
    const physics::Building& building, const char* path,
    const std::vector<physics::Parameter>& taken_by);

/// Sets a refinement's number to its mean where others do not write. The parameter that
/// it is from there on; nothing where others write to all of it.
std::optional<physics::Parameter> add_number(
    const Refinement::Number& number, const std::vector<physics::Parameter>& others,
    physics::Building& building);

/// A number of the structure ends where it would be something else: a second mass as slow
/// as the ground, a sky that stands for a station's offset.
std::pair<double, double> limits_of(double mean, double sd, double least, double most);

}  // namespace bemcal::effects
