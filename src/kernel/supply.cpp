/// Goes through steps and lanes and asks physics/air_system for each: the one step of the
/// kernel that is not the same for all instruction sets' tables, and needs none.
/// Follows from air_hour and supply. Hours that ask for nothing while the fan is off are
/// passed over.
#include "kernel/supply.hpp"

#include "adjoint/air_hour_adjoint.hpp"
#include "adjoint/network_adjoint.hpp"
#include "physics/air_hour.hpp"

#include <cmath>

namespace bemcal::kernel {

namespace {

constexpr auto electricity = static_cast<std::size_t>(physics::Quantity::electricity);

/// One lane of a zone.
struct Lane {
    const physics::Building& building;
    const physics::Zone& zone;
    const physics::AirSystem& system;
    const physics::Drive& drive;
    physics::AirKind kind;

    Lane(const SupplyPlace& place, std::size_t lane)
        : building(place.buildings[lane]),
          zone(building.zones[place.zone]),
          system(building.air_systems[static_cast<std::size_t>(zone.air_system)]),
          drive(place.drive),
          kind(physics::air_kind(building, zone, drive)) {}

    bool is_passive(int step, double cooling) const {
        return cooling <= 0 && drive.at(system.available, step) <= 0;
    }
    physics::AirHour hour(int step, double heating, double cooling,
                          double theta_air) const {
        physics::AirHour hour = physics::air_hour(building, zone, drive, step);
        hour.heating = heating;
        hour.cooling = cooling;
        hour.theta_air = theta_air;
        return hour;
    }
};

}  // namespace

void supply_rows(const SupplyPlace& place, const PowerRows& rows, double* fan,
                 std::vector<char>& is_broken) {
    if (!place.has_system()) return;
    const std::size_t lanes = place.buildings.size();
    for (std::size_t k = 0; k < lanes; ++k) {
        const Lane lane(place, k);
        double sum = 0;
        for (int step = place.begin; step < place.end; ++step) {
            const std::size_t at =
                static_cast<std::size_t>(step - place.begin) * lanes + k;
            double &heating = rows.heating[at], &cooling = rows.cooling[at];
            if (lane.is_passive(step, cooling)) continue;
            const physics::AirLoads loads = physics::supply(
                lane.kind, lane.hour(step, heating, cooling, rows.air[at]));
            heating = loads.heating;
            cooling = loads.cooling;
            fan[at] += loads.fan;
            sum += loads.heating + loads.cooling + loads.fan;
        }
        if (!std::isfinite(sum)) is_broken[k] = 1;
    }
}

void pull_supply_rows(const SupplyPlace& place, const PowerRows& asked,
                      const PowerRows& adjoints, const double* of_fan,
                      std::span<physics::Building> of_buildings) {
    if (!place.has_system()) return;
    const std::size_t lanes = place.buildings.size();
    for (std::size_t k = 0; k < lanes; ++k) {
        const Lane lane(place, k);
        for (int step = place.begin; step < place.end; ++step) {
            const std::size_t at =
                static_cast<std::size_t>(step - place.begin) * lanes + k;
            if (lane.is_passive(step, asked.cooling[at])) continue;
            const physics::AirHour of_hour = physics::pull_supply(
                lane.kind,
                lane.hour(step, asked.heating[at], asked.cooling[at], asked.air[at]),
                {adjoints.heating[at], adjoints.cooling[at], of_fan[at]});
            adjoints.heating[at] = of_hour.heating;
            adjoints.cooling[at] = of_hour.cooling;
            adjoints.air[at] += of_hour.theta_air;
            adjoint::pull_air_hour(lane.building, place.zone, lane.drive, step, of_hour,
                                   of_buildings[k]);
        }
    }
}

void add_fans(const SupplyPlace& place, physics::Quantity quantity, const double* fan,
              double* shown) {
    if (quantity != physics::Quantity::electricity) return;
    const std::size_t lanes = place.buildings.size();
    for (int step = place.begin; step < place.end; ++step)
        for (std::size_t k = 0; k < lanes; ++k)
            *shown++ +=
                place.drive.at(place.buildings[k].meter_factor[electricity], step) *
                *fan++;
}

void pull_fans(const SupplyPlace& place, const double* fan, const double* of_shown,
               double* of_fan, std::span<physics::Building> of_buildings) {
    const std::size_t lanes = place.buildings.size();
    for (int step = place.begin; step < place.end; ++step)
        for (std::size_t k = 0; k < lanes; ++k, ++fan, ++of_shown, ++of_fan) {
            const physics::Input& factor = place.buildings[k].meter_factor[electricity];
            *of_fan += place.drive.at(factor, step) * *of_shown;
            adjoint::pull_input(factor, place.drive, step, *fan * *of_shown,
                                of_buildings[k].meter_factor[electricity]);
        }
}

}  // namespace bemcal::kernel
