/// Numbers of a building by target: part, index, field, slot.
#pragma once

#include "physics/building.hpp"
#include "physics/fields.hpp"

namespace bemcal::physics {

const Field& field_of(const Target& target);

/// The input that a target lies in; nullptr where it is a constant.
Input* input_at(Building& building, const Target& target);
double& number_at(Building& building, const Target& target);
double number_at(const Building& building, const Target& target);

}  // namespace bemcal::physics
