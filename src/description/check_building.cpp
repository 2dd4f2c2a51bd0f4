/// Refuses before the first simulation what the method cannot simulate: heating above
/// cooling set-points, a gap in a series, conductances that make no network.
/// Source: ISO 13790, eq. 63 (H_tr,op below H_tr,ms), by `make_network`.
/// Set-points are checked hour by hour, conductances at a period's first step only.
/// Weather and the ranges of parameters are left to their readers.
#include "description/building_readers.hpp"
#include "physics/air_hour.hpp"
#include "physics/network.hpp"
#include "physics/stepper.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::description {

namespace {

using study::Case;

/// Schedules and series over a period, and no weather: all that set-points and
/// conductances need.
physics::Drive profiles_of(const Sources& sources, const Case& building,
                           const study::Period& period) {
    physics::Drive drive;
    drive.axis = {period.from, 3600,
                  static_cast<int>((period.to - period.from).count() / 3600)};
    const auto n_steps = static_cast<std::size_t>(drive.axis.n_steps);
    drive.profiles = Matrix(building.profiles.size(), n_steps);
    drive.irradiance = Matrix(building.building.planes.size(), n_steps);
    drive.theta_e.assign(n_steps, 0);
    for (std::size_t row = 0; row < building.profiles.size(); ++row) {
        const physics::Profile& profile = building.profiles[row];
        if (!profile.is_series) {
            const std::vector<double> values = physics::values_of(
                profile.schedule, drive.axis, building.weather.site.utc_offset_h);
            std::copy(values.begin(), values.end(), drive.profiles.row(row).begin());
            continue;
        }
        for (std::size_t k = 0; k < n_steps; ++k) {
            const int step =
                profile.axis.step_of(drive.axis.begin_of(static_cast<int>(k)));
            const bool inside = step >= 0 && step < profile.axis.n_steps;
            const double value =
                inside ? profile.values[static_cast<std::size_t>(step)] : std::nan("");
            if (std::isnan(value))
                sources.with("series").fail(
                    "series",
                    fmt::format(
                        "{} has no value at {}, which is in the period {}; set fill_gaps "
                        "to bridge a few hours, or choose other periods",
                        profile.name,
                        physics::format_time(drive.axis.begin_of(static_cast<int>(k))),
                        period.name));
            drive.profiles(row, k) = value;
        }
    }
    return drive;
}

void check_set_points(const schema::Section& section, const physics::Zone& zone,
                      const physics::Drive& drive) {
    if (zone.thermostat.imposed || zone.radiator) return;
    for (int step = 0; step < drive.n_steps(); ++step) {
        const double heating = drive.at(zone.thermostat.heating_set_point, step);
        const double cooling = drive.at(zone.thermostat.cooling_set_point, step);
        if (heating <= cooling) continue;
        section.fail(
            "heating_set_point",
            fmt::format("is {:g} degC at {}, above the cooling set-point of {:g} degC; "
                        "heating and cooling would work against each other",
                        heating, physics::format_time(drive.axis.begin_of(step)),
                        cooling));
    }
}

/// Air that is to cool must be colder than the room, and what follows moisture needs it.
void check_air_systems(const Sources& sources, const Case& building) {
    const std::vector<schema::Section> sections =
        sources.with("air_system").tables("air_system", "air_system");
    for (const physics::Zone& zone : building.building.zones) {
        const auto row = static_cast<std::size_t>(zone.air_system);
        if (zone.air_system < 0 || row >= sections.size()) continue;  // of a structure
        const physics::AirSystem& system = building.building.air_systems[row];
        const schema::Section& section = sections[row];
        const int supply = physics::supply_boundary(zone);
        const auto& boundaries = building.building.boundaries;
        const physics::Input& temperature =
            supply == physics::outdoors
                ? system.supply_temperature
                : boundaries[static_cast<std::size_t>(supply)].temperature;
        if (temperature.value >= zone.thermostat.cooling_set_point.value)
            section.fail(supply == physics::outdoors ? "supply_temperature" : "flow",
                         fmt::format("is {:g} degC, not below the cooling set-point of "
                                     "zone \"{}\", {:g} degC; expected less",
                                     temperature.value, zone.name,
                                     zone.thermostat.cooling_set_point.value));
        if (!building.weather.relative_humidity.empty()) continue;
        if (system.limited_by == physics::EconomiserLimit::enthalpy)
            section.fail_value("economiser_by",
                               "the weather has no relative humidity; expected a file "
                               "with it, or \"dry_bulb\"");
        if (section.has("least_humidity"))
            section.fail("least_humidity",
                         "asks for the relative humidity of outdoor air, "
                         "which the weather lacks; expected a file "
                         "with it");
    }
}

}  // namespace

void check_building(const Sources& sources, const Case& building) {
    check_air_systems(sources, building);
    const std::vector<schema::Section> sections =
        sources.with("zone").tables("zone", "zone");
    for (const study::Period& period : building.periods) {
        const physics::Drive drive = profiles_of(sources, building, period);
        for (std::size_t z = 0; z < sections.size(); ++z) {
            const physics::Zone& zone = building.building.zones[z];
            check_set_points(sections[z], zone, drive);
            physics::Network network;
            at_key(sections[z], "name", [&] {
                physics::make_network(building.building, zone, drive, 0, network);
                physics::reject_tight_coupling(building.building, drive, z, 0,
                                               network.H_tr_is);
            });
        }
    }
}

}  // namespace bemcal::description
