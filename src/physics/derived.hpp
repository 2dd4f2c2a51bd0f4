/// Numbers of a building that follow from others: links, U-values from layers, a zone's
/// capacity from the layers of its surfaces.
///
/// U = 1 / (R_si + sum d / lambda + R_se) (ISO 6946, layers in a row). The capacity of a
/// surface is that of its inner layers by ISO 13786's effective thickness for a day: 0.1
/// m, half of the construction, or what lies before the first insulation, the least of
/// them; C_m and A_m follow by ISO 13790, 12.2.2 and 12.3.1. Left out: air gaps, and
/// capacities at other periods than a day, for which a second mass stands.
#pragma once

#include "physics/building.hpp"

namespace bemcal::physics {

/// Writes all of them: links in their order, then what follows from layers. No
/// allocation.
void derive(Building& building);

/// Whether `derive` writes the number.
bool is_derived(const Building& building, const Target& target);

/// Whether the number follows from layers (which are seen after the links).
bool follows_from_layers(const Building& building, const Target& target);

/// Whether any number of the building is derived.
bool has_derived(const Building& building);

double u_value_of(const Construction& construction);  ///< from its layers [W/(m2 K)]
/// kappa_m, of the inner face [J/(m2 K)]
double areal_capacity(const Construction& construction);

}  // namespace bemcal::physics
