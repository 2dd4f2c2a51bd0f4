/// Goes through steps and lanes and asks physics/air_system and physics/cycling for each:
/// the one step of the kernel that is not the same for all instruction sets' tables, and
/// needs none.
/// Follows from air_hour, supply and losses_of. Hours that ask for nothing while the fan
/// is off are passed over.
#include "kernel/supply.hpp"

#include "adjoint/air_hour_adjoint.hpp"
#include "adjoint/meters_adjoint.hpp"
#include "adjoint/network_adjoint.hpp"
#include "physics/air_hour.hpp"
#include "physics/cycling.hpp"
#include "physics/meters.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace bemcal::kernel {

namespace {

constexpr auto electricity = static_cast<std::size_t>(physics::Quantity::electricity);

/// One lane of a zone that has an air system.
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

/// Calls visit(step, row in the arrays) for the lane's steps.
template <class Visit>
void each_step(const SupplyPlace& place, std::size_t lane, Visit visit) {
    const std::size_t lanes = place.buildings.size();
    for (int step = place.begin; step < place.end; ++step)
        visit(step, static_cast<std::size_t>(step - place.begin) * lanes + lane);
}

/// The loads of a zone's coils, in place.
void supply_lane(const SupplyPlace& place, std::size_t k, const PowerRows& rows,
                 LaneArray& fan, std::vector<char>& is_broken) {
    const Lane lane(place, k);
    double sum = 0;
    each_step(place, k, [&](int step, std::size_t at) {
        double &heating = rows.heating[at], &cooling = rows.cooling[at];
        if (lane.is_passive(step, cooling)) return;
        const physics::AirLoads loads =
            physics::supply(lane.kind, lane.hour(step, heating, cooling, rows.air[at]));
        heating = loads.heating;
        cooling = loads.cooling;
        fan.data()[at] += loads.fan;
        sum += loads.heating + loads.cooling + loads.fan;
    });
    if (!std::isfinite(sum)) is_broken[k] = 1;
}

/// Of a zone whose coils' loads the rows are.
void add_losses(const SupplyPlace& place, std::size_t k, const PowerRows& rows,
                Extras& extras) {
    const physics::Building& building = place.buildings[k];
    const double floor_area = building.zones[place.zone].floor_area;
    each_step(place, k, [&](int, std::size_t at) {
        const physics::Losses losses = physics::losses_of(
            building.plant, floor_area, rows.heating[at], rows.cooling[at]);
        extras.lost_heating.data()[at] += losses.heating;
        extras.lost_cooling.data()[at] += losses.cooling;
    });
}

/// What coils take for what the zone asks for.
physics::AirLoads taken(const std::optional<Lane>& lane, const PowerRows& asked, int step,
                        std::size_t at) {
    const double heating = asked.heating[at], cooling = asked.cooling[at];
    if (!lane || lane->is_passive(step, cooling)) return {heating, cooling};
    return physics::supply(lane->kind, lane->hour(step, heating, cooling, asked.air[at]));
}

/// Adds to the adjoints of the coils' loads.
void pull_losses(const SupplyPlace& place, std::size_t k, const PowerRows& asked,
                 const PowerRows& adjoints, const Extras& of_extras,
                 physics::Building& of_building) {
    const physics::Building& building = place.buildings[k];
    std::optional<Lane> lane;
    if (place.has_system()) lane.emplace(place, k);
    each_step(place, k, [&](int step, std::size_t at) {
        const physics::AirLoads loads = taken(lane, asked, step, at);
        const physics::Losses of_loads = physics::pull_losses(
            building.plant, building.zones[place.zone].floor_area,
            {loads.heating, loads.cooling},
            {of_extras.lost_heating.data()[at], of_extras.lost_cooling.data()[at]},
            of_building.plant, of_building.zones[place.zone].floor_area);
        adjoints.heating[at] += of_loads.heating;
        adjoints.cooling[at] += of_loads.cooling;
    });
}

void pull_supply_lane(const SupplyPlace& place, std::size_t k, const PowerRows& asked,
                      const PowerRows& adjoints, const LaneArray& of_fan,
                      physics::Building& of_building) {
    const Lane lane(place, k);
    each_step(place, k, [&](int step, std::size_t at) {
        if (lane.is_passive(step, asked.cooling[at])) return;
        const physics::AirHour of_hour = physics::pull_supply(
            lane.kind,
            lane.hour(step, asked.heating[at], asked.cooling[at], asked.air[at]),
            {adjoints.heating[at], adjoints.cooling[at], of_fan.data()[at]});
        adjoints.heating[at] = of_hour.heating;
        adjoints.cooling[at] = of_hour.cooling;
        adjoints.air[at] += of_hour.theta_air;
        adjoint::pull_air_hour(lane.building, place.zone, lane.drive, step, of_hour,
                               of_building);
    });
}

void add_fans(const SupplyPlace& place, const LaneArray& fan, double* shown) {
    const double* power = fan.data();
    for (int step = place.begin; step < place.end; ++step)
        for (const physics::Building& building : place.buildings)
            *shown++ +=
                place.drive.at(building.meter_factor[electricity], step) * *power++;
}

void pull_fans(const SupplyPlace& place, const LaneArray& fan, const double* of_shown,
               LaneArray& of_fan, std::span<physics::Building> of_buildings) {
    const double* power = fan.data();
    double* of_power = of_fan.data();
    for (int step = place.begin; step < place.end; ++step)
        for (std::size_t k = 0; k < place.buildings.size();
             ++k, ++power, ++of_shown, ++of_power) {
            const physics::Input& factor = place.buildings[k].meter_factor[electricity];
            *of_power += place.drive.at(factor, step) * *of_shown;
            adjoint::pull_input(factor, place.drive, step, *power * *of_shown,
                                of_buildings[k].meter_factor[electricity]);
        }
}

void show_losses(const SupplyPlace& place, std::size_t k, physics::Quantity quantity,
                 const Extras& extras, double* shown) {
    each_step(place, k, [&](int step, std::size_t at) {
        const physics::MeterForm form =
            physics::meter_form(place.buildings[k], place.drive, quantity, step);
        shown[at] += form.per_lost_heating * extras.lost_heating.data()[at] +
                     form.per_lost_cooling * extras.lost_cooling.data()[at];
    });
}

void pull_shown_losses(const SupplyPlace& place, std::size_t k,
                       physics::Quantity quantity, const Extras& extras,
                       const double* of_shown, Extras& of_extras,
                       physics::Building& of_building) {
    const physics::Building& building = place.buildings[k];
    each_step(place, k, [&](int step, std::size_t at) {
        const physics::MeterForm form =
            physics::meter_form(building, place.drive, quantity, step);
        of_extras.lost_heating.data()[at] += form.per_lost_heating * of_shown[at];
        of_extras.lost_cooling.data()[at] += form.per_lost_cooling * of_shown[at];
        physics::MeterForm of_form;
        of_form.per_lost_heating = extras.lost_heating.data()[at] * of_shown[at];
        of_form.per_lost_cooling = extras.lost_cooling.data()[at] * of_shown[at];
        adjoint::pull_meter_form(
            building, place.drive, quantity, step,
            adjoint::pull_meter_factor(building, place.drive, quantity, step, of_form,
                                       of_building),
            of_building);
    });
}

/// Whether a meter shows more than heat and cold by its form.
bool shows_losses(const physics::Plant& plant, physics::Quantity quantity) {
    const physics::Carrier carrier = physics::carrier_of(quantity);
    return plant.cycles() && carrier != physics::Carrier::none &&
           (carrier == plant.heating_carrier || carrier == plant.cooling_carrier);
}

}  // namespace

void supply_rows(const SupplyPlace& place, const PowerRows& rows, Extras& extras,
                 std::vector<char>& is_broken) {
    for (std::size_t k = 0; k < place.buildings.size(); ++k) {
        if (place.has_system()) supply_lane(place, k, rows, extras.fan, is_broken);
        if (place.buildings[k].plant.cycles()) add_losses(place, k, rows, extras);
    }
}

void pull_supply_rows(const SupplyPlace& place, const PowerRows& asked,
                      const PowerRows& adjoints, const Extras& of_extras,
                      std::span<physics::Building> of_buildings) {
    for (std::size_t k = 0; k < place.buildings.size(); ++k) {
        if (place.buildings[k].plant.cycles())
            pull_losses(place, k, asked, adjoints, of_extras, of_buildings[k]);
        if (place.has_system())
            pull_supply_lane(place, k, asked, adjoints, of_extras.fan, of_buildings[k]);
    }
}

bool shows_extras(const SupplyPlace& place, physics::Quantity quantity) {
    return quantity == physics::Quantity::electricity ||
           std::ranges::any_of(place.buildings, [&](const physics::Building& building) {
               return shows_losses(building.plant, quantity);
           });
}

void add_extras(const SupplyPlace& place, physics::Quantity quantity,
                const Extras& extras, double* shown) {
    if (quantity == physics::Quantity::electricity) add_fans(place, extras.fan, shown);
    for (std::size_t k = 0; k < place.buildings.size(); ++k)
        if (shows_losses(place.buildings[k].plant, quantity))
            show_losses(place, k, quantity, extras, shown);
}

void pull_extras(const SupplyPlace& place, physics::Quantity quantity,
                 const Extras& extras, const double* of_shown, Extras& of_extras,
                 std::span<physics::Building> of_buildings) {
    if (quantity == physics::Quantity::electricity)
        pull_fans(place, extras.fan, of_shown, of_extras.fan, of_buildings);
    for (std::size_t k = 0; k < place.buildings.size(); ++k)
        if (shows_losses(place.buildings[k].plant, quantity))
            pull_shown_losses(place, k, quantity, extras, of_shown, of_extras,
                              of_buildings[k]);
}

}  // namespace bemcal::kernel
