/// Hourly Sobol indices of a year against the simulations alone, on one thread, and
/// memory at two sample sizes. Lines: name value unit reference ratio.
#include "sensitivity/sensitivity.hpp"
#include "stats/saltelli.hpp"
#include "study/points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <fmt/format.h>
#include <sys/resource.h>

namespace {

using namespace bemcal;
using physics::Input;

/// User and system time of the process.
double processor_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) +
               1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double seconds_of(auto&& work) {
    const double begin = processor_seconds();
    work();
    return processor_seconds() - begin;
}

double peak_memory_mb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

physics::Weather made_up_year() {
    using namespace std::chrono;
    physics::Weather weather;
    weather.site = {23, 113, 8, 20, 0.2};
    weather.axis = {sys_days{year{2021} / January / 1}, 3600, 8760};
    for (int k = 0; k < weather.axis.n_steps; ++k) {
        const double up = std::sin((k % 24 - 5.5) / 12 * std::numbers::pi);
        weather.theta_e.push_back(20 - 10 * std::cos(k / 8760.0 * 2 * std::numbers::pi) +
                                  4 * up);
        weather.direct_normal.push_back(up > 0 ? 500 * up : 0);
        weather.diffuse_horizontal.push_back(up > 0 ? 200 * up : 0);
        weather.global_horizontal.push_back(up > 0 ? 500 * up * up + 200 * up : 0);
    }
    return weather;
}

physics::Profile working_days(const char* name, std::size_t from, std::size_t to) {
    physics::Profile profile;
    profile.name = name;
    for (std::size_t d = 0; d < 5; ++d)
        for (std::size_t h = from; h < to; ++h) profile.schedule.week[d][h] = 1;
    return profile;
}

/// Four facades, three gain schedules, two regimes of ventilation and set-points, limits.
physics::Building office() {
    physics::Building building;
    building.constructions.resize(2);
    building.constructions[0] = {"wall", {0.8, 0, -1}, 0.6, 0.9, 0.04};
    building.constructions[1] = {"roof", {0.5, 0, -1}, 0.6, 0.9, 0.04};
    building.glazings.resize(1);
    building.glazings[0].name = "window";
    building.glazings[0].u_value.value = 2.7;
    building.glazings[0].solar_transmittance.value = 0.5;
    physics::Zone zone;
    zone.name = "office";
    zone.floor_area = 1000;
    zone.volume = 3000;
    for (int side = 0; side < 4; ++side) {
        const int plane =
            building.plane_index({std::numbers::pi / 2, side * std::numbers::pi / 2, {}});
        zone.surfaces.push_back(
            {"wall", 0, 90, physics::outdoors, 1, true, plane, {1, 0, -1}});
        zone.windows.push_back(
            {fmt::format("window_{}", side), 0, 60, plane, {0.9 - 0.1 * side, 0, -1}});
    }
    zone.flows.push_back({"fresh", {1.2, 0.2, 0}, {0, 0, -1}, physics::outdoors});
    zone.loads.push_back({"people", {6, 0, 0}});
    zone.loads.push_back({"lights", {9, 1, 1}});
    zone.loads.push_back({"equipment", {10, 3, 2}});
    zone.thermostat.heating_set_point = {21, 16, 0};
    zone.thermostat.cooling_set_point = {25, 30, 0};
    zone.thermostat.heating_capacity.value = 60;
    zone.thermostat.cooling_capacity.value = 80;
    building.zones.push_back(zone);
    return building;
}

struct Range {
    const char* path;
    double least, most;
};
constexpr Range ranges[] = {
    {"construction.wall.u_value", 0.4, 1.2},
    {"construction.roof.u_value", 0.3, 0.8},
    {"glazing.window.u_value", 1.5, 4},
    {"glazing.window.solar_transmittance", 0.3, 0.7},
    {"zone.office.window.window_0.shading_factor", 0.5, 1},
    {"zone.office.window.window_1.shading_factor", 0.5, 1},
    {"zone.office.window.window_2.shading_factor", 0.5, 1},
    {"zone.office.window.window_3.shading_factor", 0.5, 1},
    {"zone.office.flow.fresh.air_change", 0.6, 2},
    {"zone.office.flow.fresh.air_change.low", 0.1, 0.4},
    {"zone.office.load.people.density", 3, 9},
    {"zone.office.load.lights.density", 5, 13},
    {"zone.office.load.equipment.density", 5, 15},
    {"zone.office.heating_set_point", 20, 22},
    {"zone.office.cooling_set_point", 24, 26},
    {"zone.office.heating_capacity", 40, 80},
    {"zone.office.cooling_capacity", 50, 110},
    {"zone.office.heat_capacity", 110000, 260000},
    {"plant.cooling_cop", 2.5, 4},
};

study::Case year_of_an_office() {
    using namespace std::chrono;
    study::Case made;
    made.building = office();
    made.weather = made_up_year();
    made.profiles = {working_days("work", 8, 18), working_days("lights", 7, 20),
                     working_days("equipment", 6, 22)};
    for (const Range& range : ranges) {
        physics::Parameter parameter;
        parameter.name = range.path;
        parameter.least = range.least;
        parameter.most = range.most;
        parameter.targets = physics::resolve(made.building, range.path);
        parameter.nominal = (range.least + range.most) / 2;
        made.parameters.push_back(parameter);
    }
    made.periods = {{"year", made.weather.axis.start, made.weather.axis.end()}};
    return made;
}

sensitivity::SensitivityOptions options_of(std::size_t n_base) {
    sensitivity::SensitivityOptions options;
    options.n_base = n_base;
    return options;
}

/// The same rows of the design as an item's, annual electricity only.
class Simulations {
  public:
    explicit Simulations(const study::Case& made)
        : made_(made),
          drive_(study::drive_of(made, made.periods[0])),
          batch_(made_.building, made_.parameters, drive_) {}

    void run(std::size_t first, std::size_t n) const {
        constexpr std::size_t block = 64;
        const int dimension = static_cast<int>(made_.parameters.size());
        for (std::size_t at = 0; at < n; at += block)
            batch_.evaluate(study::in_ranges(stats::saltelli_points(
                                                 first + at, std::min(block, n - at),
                                                 dimension, true, 0),
                                             made_.parameters),
                            {{physics::Quantity::electricity}, {}, {}});
    }

  private:
    study::Case made_;
    physics::Drive drive_;
    kernel::Batch batch_;
};

struct Times {
    double items = 0, conclude = 0, simulations = 0;
};

/// Items and the simulations alone in turn, so that a busy machine slows both.
Times time_both(const study::Case& made, std::size_t n_base) {
    const auto stage = sensitivity::make_hourly_sensitivity(
        "hourly", made, made.periods[0], physics::Quantity::electricity,
        options_of(n_base));
    const Simulations simulations(made);
    const std::size_t n = n_base / static_cast<std::size_t>(stage->n_items());
    Times times;
    std::vector<study::ItemAnswer> answers;
    for (int item = 0; item < stage->n_items(); ++item) {
        times.items += seconds_of([&] { answers.push_back(stage->run(item)); });
        times.simulations +=
            seconds_of([&] { simulations.run(static_cast<std::size_t>(item) * n, n); });
    }
    times.conclude = seconds_of([&] { stage->conclude(answers); });
    return times;
}

void print(const char* name, double value, const char* unit, double reference,
           double ratio) {
    fmt::print("{} {:.4g} {} {:.4g} {:.4g}\n", name, value, unit, reference, ratio);
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t n = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 16384;
    const study::Case made = year_of_an_office();
    time_both(made, n / 16);
    const double memory_small = peak_memory_mb();
    const Times times = time_both(made, n);
    const double memory = peak_memory_mb(), whole = times.items + times.conclude,
                 simulations = times.simulations;
    print("hourly_sobol_simulations_alone", simulations, "s", simulations, 1);
    print("hourly_sobol_items", times.items, "s", simulations, times.items / simulations);
    print("hourly_sobol_conclude", times.conclude, "s", simulations,
          times.conclude / simulations);
    print("hourly_sobol_whole", whole, "s", simulations, whole / simulations);
    print("hourly_sobol_peak_memory_n_over_16", memory_small, "MB", memory_small, 1);
    print("hourly_sobol_peak_memory", memory, "MB", memory_small, memory / memory_small);
}
