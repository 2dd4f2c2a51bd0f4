/// An effect on every facade, meter, weekday or rule of summer time that it may have.
/// Facades are planes with windows, once for each direction that they face.
/// Plain enumeration without a source. Facades of a building with fewer than two are not
/// split. Days that are found, and data, have no variants here.
#include "effects/variants.hpp"

#include "effects/sites.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace bemcal::effects {
namespace {

using physics::Quantity;

std::vector<int> facades_of(const physics::Building& building) {
    std::vector<int> facades;
    for (const physics::Zone& zone : building.zones)
        for (const physics::Window& window : zone.windows) {
            const bool seen = std::any_of(facades.begin(), facades.end(), [&](int plane) {
                return same_facade(building, plane, window.plane);
            });
            if (!seen) facades.push_back(window.plane);
        }
    return facades;
}

std::vector<Effect> on_facades(const Effect& effect, const physics::Building& building) {
    std::vector<Effect> all{effect};
    const std::vector<int> facades = facades_of(building);
    if (facades.size() < 2) return all;
    for (const int plane : facades) {
        all.push_back(effect);
        all.back().facade = plane;
        all.back().place_name =
            name_of_facade(building.planes[static_cast<std::size_t>(plane)]);
    }
    return all;
}

std::vector<Effect> on_meters(const Effect& effect, std::span<const Quantity> meters) {
    std::vector<Effect> all;
    for (const Quantity meter : meters) {
        all.push_back(effect);
        all.back().meter = meter;
        all.back().place_name = fmt::format("{} meter", physics::name_of(meter));
    }
    return all;
}

std::vector<Effect> on_weekdays(const Effect& effect) {
    std::vector<Effect> all(5, effect);
    for (int weekday = 0; weekday < 5; ++weekday)
        all[static_cast<std::size_t>(weekday)].weekday = weekday;
    return all;
}

std::vector<Effect> in_summer_time(const Effect& effect) {
    std::vector<Effect> all(2, effect);
    all[0].gate = Gate::eu_summer_time;
    all[1].gate = Gate::us_summer_time;
    return all;
}

/// The meter of cooling, where it is measured.
std::vector<Effect> on_cooling(const Effect& effect, std::span<const Quantity> meters) {
    std::vector<Effect> all = on_meters(effect, meters);
    std::erase_if(all, [](const Effect& one) { return one.meter != Quantity::cooling; });
    return all;
}

}  // namespace

std::vector<Effect> variants(const Effect& effect, Each each, const Surroundings& around,
                             std::span<const physics::Quantity> meters) {
    switch (each) {
        case Each::once:
            return {effect};
        case Each::facade:
            return on_facades(effect, *around.building);
        case Each::meter:
            return on_meters(effect, meters);
        case Each::cooling_meter:
            return on_cooling(effect, meters);
        case Each::weekday:
            return on_weekdays(effect);
        case Each::summer_time:
            return in_summer_time(effect);
        default:
            return {};
    }
}

std::string name_of_facade(const physics::Plane& plane) {
    constexpr double pi = std::numbers::pi;
    constexpr const char* sides[] = {"north", "north-east", "east", "south-east",
                                     "south", "south-west", "west", "north-west"};
    if (plane.tilt < pi / 8) return "roof";
    const auto sector = std::lround(plane.azimuth / (pi / 4)) % 8;
    return fmt::format("{} facade", sides[(sector + 8) % 8]);
}

}  // namespace bemcal::effects
