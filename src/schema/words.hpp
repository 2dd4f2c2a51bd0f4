/// Words of choices that a table below the schema lists: a row of the schema names the
/// list. Their order is that of the enum that `Section::choice_as` makes of them.
#pragma once

#include "base/joined.hpp"
#include "physics/quantities.hpp"

namespace bemcal::schema {

inline constexpr const char* quantities = joined<physics::quantity_names>.data();
inline constexpr const char* carriers = joined<physics::carrier_names>.data();

}  // namespace bemcal::schema
