/// Finds days on which irradiance is 0 from midnight to midnight, though the sun stands
/// well above the horizon at noon: gaps that somebody filled.
/// Plain geometry, by `sun_position`; the thickest cloud lets some light through.
/// They are stated and kept: nothing else says what the sun was.
#include "checks/series.hpp"
#include "physics/sun.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace bemcal::checks {
namespace {

/// cos zenith at noon, 5 degrees above the horizon: below it a day may be all dark.
constexpr double least_height = 0.087;

/// An hour without temperature is one that the file lacks.
bool is_lit_or_lacking(const physics::Weather& weather, std::size_t k) {
    return weather.global_horizontal[k] > 0 || weather.direct_normal[k] > 0 ||
           weather.diffuse_horizontal[k] > 0 || std::isnan(weather.theta_e[k]);
}

bool is_dark(const physics::Weather& weather, int first, int n_steps) {
    for (int k = first; k < first + n_steps; ++k)
        if (is_lit_or_lacking(weather, static_cast<std::size_t>(k))) return false;
    const auto noon = weather.axis.begin_of(first + n_steps / 2);
    return std::cos(physics::sun_position(weather.site, noon).zenith) > least_height;
}

}  // namespace

void check_weather_sun(study::Case& building) {
    const physics::Weather& weather = building.weather;
    const int day = physics::day_s / weather.axis.step_s;
    const auto midnight = std::chrono::ceil<std::chrono::days>(weather.axis.start);
    std::vector<int> dark;
    for (int first = weather.axis.step_of(midnight); first + day <= weather.axis.n_steps;
         first += day)
        if (is_dark(weather, first, day)) dark.push_back(first);
    if (dark.empty()) return;
    building.decisions.push_back(
        {"weather",
         fmt::format("{} day{} without any sun, the first {}", dark.size(),
                     dark.size() == 1 ? "" : "s",
                     physics::format_date(weather.axis.begin_of(dark.front()))),
         "kept; if they were gaps, other files or periods would mend it"});
}

}  // namespace bemcal::checks
