/// What the benches of the physics share: an office, a year that acts on it, and how cost
/// is counted.
///
/// The building: 4 facades, 3 gain schedules, 2 regimes of ventilation and set-points,
/// limited capacities; a year of hours. Instructions are counted by callgrind (which
/// knows AVX2, not AVX-512); times are medians of works that take turns. Lines: name
/// value unit reference ratio.
#pragma once

#include "kernel/plain_answer.hpp"

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

constexpr int hours = 8760;

/// Office hours, plug loads and lights; profile 3 is day and night for flows and
/// set-points.
inline double profile_at(int profile, int hour, int weekday) {
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

inline Drive bench_drive() {
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

inline Building bench_building() {
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

/// Processor time, so that a busy machine disturbs less [us].
inline double now() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e6 * static_cast<double>(time.tv_sec) +
           1e-3 * static_cast<double>(time.tv_nsec);
}

inline double microseconds(const std::function<void()>& work) {
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

inline void print(const std::string& name, double value, const char* unit,
                  double reference) {
    fmt::print("{} {:.4g} {} {:.4g} {:.3g}\n", name, value, unit, reference,
               value / reference);
    std::fflush(stdout);
}

inline void print(const std::string& name, double value, const char* unit) {
    fmt::print("{} {:.4g} {} - -\n", name, value, unit);
    std::fflush(stdout);
}

/// Work of this program under callgrind.
inline long long instructions(const std::string& self, const std::string& arguments) {
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

}  // namespace bemcal::physics
