/// Air systems of the zones of a group: rows of what zones ask for become rows of what
/// coils and fans take, lane by lane; and back.
#pragma once

#include "kernel/kernel.hpp"
#include "physics/drive.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace bemcal::kernel {

/// A zone of all lanes' buildings over steps [begin, end) of the drive.
struct SupplyPlace {
    std::span<const physics::Building> buildings;  ///< [lanes]
    std::size_t zone;
    const physics::Drive& drive;
    int begin, end;

    bool has_system() const { return buildings[0].zones[zone].air_system >= 0; }
};

/// In place; adds the fans' power to `fan` [steps x lanes]. Marks lanes whose loads are
/// not finite. Nothing where the zone has no system.
void supply_rows(const SupplyPlace& place, const PowerRows& rows, double* fan,
                 std::vector<char>& is_broken);

/// From adjoints of what coils and fans take to those of what the zone asks for, in
/// place, and of its air, added to; and to the numbers of each lane's building.
/// \param asked  rows of the zone before supply_rows
void pull_supply_rows(const SupplyPlace& place, const PowerRows& asked,
                      const PowerRows& adjoints, const double* of_fan,
                      std::span<physics::Building> of_buildings);

/// shown += what fans add to the electricity meter; nothing to other meters.
void add_fans(const SupplyPlace& place, physics::Quantity quantity, const double* fan,
              double* shown);

/// The way back: adds to of_fan, and to the adjoints of the meter's factor.
void pull_fans(const SupplyPlace& place, const double* fan, const double* of_shown,
               double* of_fan, std::span<physics::Building> of_buildings);

}  // namespace bemcal::kernel
