/// Numbers of a building by target: part, index, field, slot.
#pragma once

#include "physics/building.hpp"
#include "physics/fields.hpp"

namespace bemcal::physics {

const Field& field_of(const Target& target);

/// What is said of a number, and its range: by its field, or by the declared effect whose
/// coefficient it is.
struct NumberInfo {
    const char* name;
    const char* unit;
    double least, most;
    const char* sentence;
};
NumberInfo info_of(const Building& building, const Target& target);
/// The effect whose coefficient stands there; nullptr of every other number.
const Coefficient* coefficient_at(const Building& building, const Target& target);

/// Where a number of the description stands now (Building::moved).
Target where_now(const Building& building, Target target);
/// An input goes to another place, and nothing stays; effects and links that lead to it
/// follow.
void move_input(Building& building, const Target& from, const Target& to);

/// The input that a target lies in; nullptr where it is a constant.
Input* input_at(Building& building, const Target& target);
double& number_at(Building& building, const Target& target);
double number_at(const Building& building, const Target& target);

}  // namespace bemcal::physics
