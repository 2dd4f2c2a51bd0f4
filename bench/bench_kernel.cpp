/// What the fast kernel costs, beside the same code one point at a time.
///
/// The building: 4 facades, 3 gain schedules, 2 regimes of ventilation and set-points,
/// limited capacities; a year of hours, annual heating and cooling. Instructions are
/// counted by callgrind (which knows AVX2, not AVX-512) as the difference of two runs of
/// this program, so that start-up and plan cancel; everything else counts: coefficients,
/// time loop, answers. Times are medians of alternating runs. Lines: name value unit
/// reference ratio.
#include "physics/plain_answer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

#include <fmt/format.h>
#include <time.h>

namespace bemcal::physics {

namespace {

constexpr int hours = 8760;

/// Office hours, plug loads and lights; profile 3 is day and night for flows and
/// set-points.
double profile_at(int profile, int hour, int weekday) {
    const bool open = hour >= 8 && hour < 18 && weekday < 5;
    switch (profile) {
        case 0:
            return open ? (hour < 12 ? 1 : 0.8) : 0;
        case 1:
            return open ? 1 : 0.2;
        case 2:
            return hour >= 7 && hour < 20 ? 0.6 : 0.05;
        default:
            return open ? 1 : 0;
    }
}

Drive bench_drive() {
    Drive drive;
    drive.axis = {parse_time("2021-01-01"), 3600, hours};
    drive.irradiance = Matrix(4, hours);
    drive.profiles = Matrix(4, hours);
    for (int k = 0; k < hours; ++k) {
        const auto step = static_cast<std::size_t>(k);
        const double day = k / 24.0;
        drive.theta_e.push_back(10 - 10 * std::cos(day / 365 * 6.2832) +
                                4 * std::sin((day - 0.4) * 6.2832));
        const double height =
            std::sin((day - 0.25) * 6.2832) - 0.3 * std::cos(day / 365 * 6.2832);
        for (std::size_t plane = 0; plane < 4; ++plane)
            drive.irradiance(plane, step) =
                height > 0 ? 350 * height * (1 + 0.3 * static_cast<double>(plane)) : 0;
        for (int p = 0; p < 4; ++p)
            drive.profiles(static_cast<std::size_t>(p), step) =
                profile_at(p, k % 24, k / 24 % 7);
    }
    return drive;
}

Building bench_building() {
    Building building;
    building.constructions.push_back({"wall", {0.6, 0, -1}});
    building.glazings.push_back(
        {"double", {1.4, 0, -1}, {0.6, 0, -1}, 0.9, 0.2, 0.9, 0.04, {}});
    Zone zone;
    zone.name = "office";
    zone.floor_area = 500;
    zone.volume = 1500;
    for (int plane = 0; plane < 4; ++plane) {
        building.planes.push_back({1.5708, 1.5708 * plane, {}});
        Surface wall{"wall", 0, 80};
        wall.plane = plane;
        wall.shading = {1, 0, -1};
        zone.surfaces.push_back(wall);
        zone.windows.push_back({"window", 0, 30, plane, {0.8, 0, -1}});
    }
    zone.flows.push_back({"infiltration", {0.3, 0, -1}, {}, outdoors});
    zone.flows.push_back({"ventilation", {1.2, 0.1, 3}, {}, outdoors});
    for (int profile = 0; profile < 3; ++profile)
        zone.loads.push_back({"load", {6, 0, profile}, 1, Carrier::electricity});
    zone.thermostat.heating_set_point = {21, 16, 3};
    zone.thermostat.cooling_set_point = {25, 28, 3};
    zone.thermostat.heating_capacity = {50, 0, -1};
    zone.thermostat.cooling_capacity = {40, 0, -1};
    building.zones.push_back(zone);
    return building;
}

std::vector<Parameter> bench_parameters(const Building& building) {
    std::vector<Parameter> parameters;
    for (const char* path :
         {"construction.wall.u_value", "glazing.double.u_value",
          "glazing.double.solar_transmittance", "zone.office.flow.ventilation.air_change",
          "zone.office.flow.infiltration.air_change", "zone.office.heat_capacity",
          "zone.office.heating_capacity", "zone.office.load.*.density"})
        parameters.push_back(
            {path, "-", 0.8, 1.2, Effect::factor, resolve(building, path), 1});
    return parameters;
}

/// Spread over the ranges by the golden section.
Matrix bench_points(std::size_t n, std::size_t d) {
    Matrix points(n, d);
    for (std::size_t k = 0; k < n * d; ++k) {
        const double position = 0.618033988749895 * static_cast<double>(k);
        points.values[k] = 0.8 + 0.4 * (position - std::floor(position));
    }
    return points;
}

struct Bench {
    Building building = bench_building();
    Drive drive = bench_drive();
    std::vector<Parameter> parameters = bench_parameters(building);
    Request annual{{Quantity::heating, Quantity::cooling}, {}, {}};
    Request hourly_meter{annual.annual, {}, {readings()}};

    Matrix points(std::size_t n) const { return bench_points(n, parameters.size()); }
    Batch batch(InstructionSet set) const { return {building, parameters, drive, set}; }
    Readings readings() const {
        return {Quantity::gas, Interval::hourly,
                predict(building, drive, simulate(building, drive), Quantity::gas)};
    }
};

/// Processor time, so that a busy machine disturbs less [us].
double now() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e6 * static_cast<double>(time.tv_sec) +
           1e-3 * static_cast<double>(time.tv_nsec);
}

double microseconds(const std::function<void()>& work) {
    const double begin = now();
    work();
    return now() - begin;
}

/// Medians of several pieces of work that take turns [us].
template <std::size_t n>
std::array<double, n> medians(const std::array<std::function<void()>, n>& works) {
    constexpr std::size_t rounds = 15;
    std::array<std::vector<double>, n> times;
    for (std::size_t round = 0; round < rounds; ++round)
        for (std::size_t k = 0; k < n; ++k) times[k].push_back(microseconds(works[k]));
    std::array<double, n> result;
    for (std::size_t k = 0; k < n; ++k) {
        std::sort(times[k].begin(), times[k].end());
        result[k] = times[k][rounds / 2];
    }
    return result;
}

void print(const std::string& name, double value, const char* unit, double reference) {
    fmt::print("{} {:.4g} {} {:.4g} {:.3g}\n", name, value, unit, reference,
               value / reference);
    std::fflush(stdout);
}

void print(const std::string& name, double value, const char* unit) {
    fmt::print("{} {:.4g} {} - -\n", name, value, unit);
    std::fflush(stdout);
}

/// Work of this program under callgrind.
long long instructions(const std::string& self, const std::string& arguments) {
    const std::string command =
        fmt::format("valgrind --tool=callgrind --callgrind-out-file=/dev/null {} {} 2>&1",
                    self, arguments);
    FILE* pipe = popen(command.c_str(), "r");
    std::string text;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe))
        text += static_cast<char>(c);
    const int status = pclose(pipe);
    const std::size_t at = text.find("Collected : ");
    if (status != 0 || at == std::string::npos) return -1;
    return std::atoll(text.c_str() + at + 12);
}

/// Per simulated hour and point; each run evaluates whole groups.
double instructions_per_hour(const std::string& self, InstructionSet set,
                             const char* request) {
    const int few = 32, many = 96;
    const auto count = [&](int n) {
        return instructions(self, fmt::format("{} {} {}", name_of(set), request, n));
    };
    const long long a = count(few), b = count(many);
    return a < 0 || b < 0
               ? std::nan("")
               : static_cast<double>(b - a) / (static_cast<double>(many - few) * hours);
}

void print_instructions(const std::string& self) {
    const struct {
        const char* name;
        InstructionSet set;
        const char* request;
        double reach;
    } lines[] = {
        {"instructions_per_hour", InstructionSet::v3, "annual", 7.5},
        {"instructions_per_hour_scalar", InstructionSet::scalar, "annual", 40},
        {"instructions_per_hour_sse_fused", InstructionSet::v3, "hourly_meter", 7.5}};
    for (const auto& line : lines) {
        const double count = instructions_per_hour(self, line.set, line.request);
        if (std::isnan(count))
            fmt::print("{}: valgrind is not there or failed\n", line.name);
        else
            print(line.name, count, "1/h", line.reach);
    }
}

void print_times(const Bench& bench) {
    constexpr std::size_t n = 160;
    const Matrix points = bench.points(n);
    const Batch scalar = bench.batch(InstructionSet::scalar),
                v3 = bench.batch(InstructionSet::v3);
    const auto group = v3.make_group();
    const auto lanes = static_cast<std::size_t>(v3.lanes());
    const auto [one, annual, compared, prepared] =
        medians<4>({[&] { scalar.evaluate(points, bench.annual); },
                    [&] { v3.evaluate(points, bench.annual); },
                    [&] { v3.evaluate(points, bench.hourly_meter); },
                    [&] {
                        for (std::size_t k = 0; k < n; k += lanes)
                            v3.prepare(points, k, lanes, *group);
                    }});
    print("speedup_v3_over_scalar", one / annual, "-", 4.5);
    print("simulations_per_second_per_core", n / annual * 1e6, "1/s");
    print("sse_fused_ratio", compared / annual, "-", 1.1);
    print("year_scalar", one / n, "us");
    print("year_v3", annual / n, "us");
    print("preparation_v3", prepared / n, "us", annual / n);
}

void print_v4(const Bench& bench) {
    if (!is_supported(InstructionSet::v4)) {
        fmt::print("v4: this processor has no AVX-512, so its kernel cannot run here\n");
        return;
    }
    const Matrix points = bench.points(160);
    const Batch scalar = bench.batch(InstructionSet::scalar),
                v4 = bench.batch(InstructionSet::v4);
    const auto [one, annual] = medians<2>({[&] { scalar.evaluate(points, bench.annual); },
                                           [&] { v4.evaluate(points, bench.annual); }});
    print("speedup_v4_over_scalar", one / annual, "-", 9);
}

void print_plain(const Bench& bench) {
    const auto [plain] = medians<1>({[&] { simulate(bench.building, bench.drive); }});
    print("year_plain_version", plain, "us");
}

InstructionSet set_named(const std::string& name) {
    return name == "scalar" ? InstructionSet::scalar : InstructionSet::v3;
}

}  // namespace

/// What callgrind counts: bench_kernel SET REQUEST POINTS.
int run_counted(char** arguments) {
    const Bench bench;
    const bool metered = std::string(arguments[1]) == "hourly_meter";
    bench.batch(set_named(arguments[0]))
        .evaluate(bench.points(static_cast<std::size_t>(std::atoi(arguments[2]))),
                  metered ? bench.hourly_meter : bench.annual);
    return 0;
}

int run_all(const std::string& self) {
    const Bench bench;
    print_instructions(self);
    print_times(bench);
    print_v4(bench);
    print_plain(bench);
    return 0;
}

}  // namespace bemcal::physics

int main(int argc, char** argv) {
    return argc == 4 ? bemcal::physics::run_counted(argv + 1)
                     : bemcal::physics::run_all(argv[0]);
}
