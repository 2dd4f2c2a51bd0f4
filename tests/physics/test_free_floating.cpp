/// A room without heating or cooling in Chicago's weather, against a continuous 5R1C.
///
/// Modelica Buildings library, ThermalZones.ISO13790.Examples.FreeFloating: days 100 to
/// 110, 20 degC at the start, no warm-up.
#include "physics/bestest_cases.hpp"
#include "physics/simulate.hpp"
#include "support/csv_table.hpp"
#include "support/epw_files.hpp"
#include "support/measured.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

constexpr double start_s = 8640000;  ///< of the reference, after the year's begin

Building chicago_room() {
    Building building;
    building.constructions.resize(2);
    building.constructions[0].u_value.value = 1.3;
    building.constructions[1].u_value.value = 1.0;
    Glazing& glazing = building.glazings.emplace_back();
    glazing.u_value.value = 1.8;
    glazing.solar_transmittance.value = 0.5;
    glazing.incidence_factor = 1;
    glazing.frame_fraction = 0.001;
    Zone& zone = building.zones.emplace_back();
    zone.name = "room";
    zone.floor_area = 16;
    zone.volume = 48;
    zone.heat_capacity = 110000;
    zone.surface_area_ratio = 80.0 / 16;
    const double areas[] = {12, 12, 9, 12};  // N, E, S, W
    for (int k = 0; k < 4; ++k)
        zone.surfaces.push_back(test::bestest_surface(
            "wall", 0, areas[k], building.plane_index(test::vertical(90 * k))));
    zone.surfaces.push_back(
        test::bestest_surface("roof", 0, 16, building.plane_index(Plane{})));
    zone.surfaces.push_back(test::bestest_surface("floor", 1, 16, 0));
    zone.surfaces.back().in_sun = false;
    zone.surfaces.back().adjustment = 0.5;
    Window& window = zone.windows.emplace_back();
    window.area = 3;
    window.plane = building.plane_index(test::vertical(180));
    zone.flows.push_back(test::bestest_flow("air", {0.5, 0, -1}));
    zone.loads.emplace_back().density.value = 10 / zone.floor_area;
    zone.thermostat.heating_capacity.value = zone.thermostat.cooling_capacity.value = 0;
    return building;
}

/// The hour means, linear between the hours' middles.
double at_time(const std::vector<double>& hours, double after_start_s) {
    const double position = std::max(after_start_s / 3600 - 0.5, 0.0);
    const auto before = std::min(static_cast<std::size_t>(position), hours.size() - 2);
    const double weight = std::min(position - static_cast<double>(before), 1.0);
    return (1 - weight) * hours[before] + weight * hours[before + 1];
}

double rmse(const test::CsvTable& table, const std::vector<double>& theta_air) {
    double sum = 0;
    int n = 0;
    for (std::size_t row = 0; row < table.n_rows(); ++row) {
        if (table.text(row, "model") != "Examples_FreeFloating") continue;
        const double own = at_time(theta_air, table.number(row, "time_s") - start_s);
        const double error = own - (table.number(row, "value") - 273.15);
        sum += error * error;
        ++n;
    }
    EXPECT_EQ(n, 101);
    return std::sqrt(sum / n);
}

TEST(FreeFloating, FollowsTheContinuousNetworkThroughTenDaysOfChicago) {
    const auto epw =
        test::shared_file("weather/USA_IL_Chicago-OHare.Intl.AP.725300_TMY3.epw");
    const auto reference = test::shared_file("thermal/modelica_5r1c_trajectories.csv");
    if (test::is_absent(epw)) GTEST_SKIP() << epw;
    if (test::is_absent(reference)) GTEST_SKIP() << reference;
    const Weather weather =
        test::read_epw(epw, {input::TemperatureConvention::hour_mean, 2021}).weather;
    const Building building = chicago_room();
    const Seconds from =
        weather.axis.start + std::chrono::seconds(static_cast<long long>(start_s));
    const Drive drive =
        make_drive(weather, building, {}, from, from + std::chrono::hours(240), 3600, 0);
    const Trajectory trajectory = simulate(building, drive);
    const double error = rmse(test::CsvTable(reference), trajectory.zones[0].theta_air);
    test::print_measured("free-floating room against the continuous network, RMSE", error,
                         "K", "0.25");
    EXPECT_LE(error, 0.25);
}

}  // namespace
}  // namespace bemcal::physics
