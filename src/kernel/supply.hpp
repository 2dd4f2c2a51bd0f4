/// Between zones and meters of a group: air systems, by which rows of what zones ask for
/// become rows of what coils and fans take, and plants that cycle; lane by lane, and
/// back.
#pragma once

#include "base/lane_array.hpp"
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

/// What meters show beside the heat and cold of coils [steps x lanes] [W].
struct Extras {
    LaneArray fan, lost_heating, lost_cooling;  ///< of air systems; by cycling

    Extras() = default;
    Extras(std::size_t n_steps, int lanes)
        : fan(n_steps, lanes),
          lost_heating(n_steps, lanes),
          lost_cooling(n_steps, lanes) {}
    void clear() {
        for (LaneArray* rows : {&fan, &lost_heating, &lost_cooling}) rows->clear();
    }
};

/// In place where the zone has an air system; adds to `extras`. Marks lanes whose loads
/// are not finite.
void supply_rows(const SupplyPlace& place, const PowerRows& rows, Extras& extras,
                 std::vector<char>& is_broken);

/// From adjoints of what coils and fans take to those of what the zone asks for, in
/// place, and of its air, added to; and to the numbers of each lane's building.
/// \param asked  rows of the zone before supply_rows
void pull_supply_rows(const SupplyPlace& place, const PowerRows& asked,
                      const PowerRows& adjoints, const Extras& of_extras,
                      std::span<physics::Building> of_buildings);

/// Whether a meter shows anything of them.
bool shows_extras(const SupplyPlace& place, physics::Quantity quantity);

/// shown += what the meter shows of them.
void add_extras(const SupplyPlace& place, physics::Quantity quantity,
                const Extras& extras, double* shown);

/// The way back: adds to of_extras, and to the adjoints of the meter's factor and of
/// efficiencies.
void pull_extras(const SupplyPlace& place, physics::Quantity quantity,
                 const Extras& extras, const double* of_shown, Extras& of_extras,
                 std::span<physics::Building> of_buildings);

}  // namespace bemcal::kernel
