/// Completes irradiance: two of global, direct and diffuse give the third, global alone
/// is split, and clouds scale a clear sky. Also hourly means of values read at the hours'
/// ends.
/// Source: decomposition's models; pressure by the standard atmosphere (ISO 2533). Direct
/// light under a low sun is limited. Temperatures are not filled in.
#include "physics/weather.hpp"

#include "base/nan.hpp"
#include "physics/decomposition.hpp"
#include "physics/sun.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::physics {
namespace {

bool known(const std::vector<double>& series, std::size_t k) {
    return k < series.size() && !std::isnan(series[k]);
}

bool can_complete(const Weather& weather, const StepSun& sun, std::size_t k) {
    return sun.sunlit == 0 || known(weather.global_horizontal, k) ||
           (known(weather.direct_normal, k) && known(weather.diffuse_horizontal, k)) ||
           known(weather.cloud_cover, k);
}

std::vector<int> unknown_steps(const Weather& weather, const std::vector<StepSun>& suns) {
    std::vector<int> steps;
    for (std::size_t k = 0; k < suns.size(); ++k)
        if (!can_complete(weather, suns[k], k)) steps.push_back(static_cast<int>(k));
    return steps;
}

/// Global irradiance of a step from its cloud cover [W/m2].
double global_from_clouds(const Site& site, const StepSun& sun, double cloud_cover) {
    const double zenith = sun.position.zenith;
    const double pressure =
        std::pow(1 - 2.25577e-5 * site.elevation, 5.25588);  // of sea level's
    return sun.sunlit * cloudy_sky_global(
                            clear_sky_global(zenith, sun.position.extraterrestrial,
                                             pressure * air_mass(zenith), site.elevation),
                            cloud_cover);
}

void fill_global(Weather& weather, const std::vector<StepSun>& suns) {
    for (std::size_t k = 0; k < suns.size(); ++k) {
        double& global = weather.global_horizontal[k];
        if (!std::isnan(global)) continue;
        const double height = std::max(std::cos(suns[k].position.zenith), 0.0);
        if (known(weather.direct_normal, k) && known(weather.diffuse_horizontal, k))
            global = weather.direct_normal[k] * height + weather.diffuse_horizontal[k];
        else if (suns[k].sunlit == 0)
            global =
                known(weather.diffuse_horizontal, k) ? weather.diffuse_horizontal[k] : 0;
        else
            global = global_from_clouds(weather.site, suns[k], weather.cloud_cover[k]);
    }
}

/// The direct part that global irradiance leaves room for; low suns must not blow it up.
double direct_from_global(double global, double diffuse, const StepSun& sun) {
    constexpr double least_height = 0.0871557;  // cos 85 deg
    const double height = std::max(std::cos(sun.position.zenith), least_height);
    return std::clamp((global - diffuse) / height, 0.0,
                      sun.sunlit * sun.position.extraterrestrial);
}

void fill_parts(Weather& weather, const StepSun& sun, std::size_t k) {
    const double global = weather.global_horizontal[k];
    double& direct = weather.direct_normal[k];
    double& diffuse = weather.diffuse_horizontal[k];
    const double height = std::max(std::cos(sun.position.zenith), 0.0);
    const bool diffuse_known = !std::isnan(diffuse);
    if (std::isnan(direct)) {
        const double part = diffuse_known ? diffuse : diffuse_from_global(global, sun);
        direct = direct_from_global(global, part, sun);
    }
    // So that the parts make up the whole, also where the direct part was limited.
    if (!diffuse_known) diffuse = std::max(global - direct * height, 0.0);
}

/// A day's hours in which a series and global irradiance are known.
struct DaySums {
    double global = 0, part = 0;  ///< [Wh/m2]
    bool is_absent(double least_share) const {
        return global > 0 && part <= least_share * global;
    }
};

DaySums sums_of(const Weather& weather, const std::vector<double>& part,
                std::size_t first, std::size_t last) {
    DaySums sums;
    for (std::size_t k = first; k < last; ++k) {
        if (!known(weather.global_horizontal, k) || !known(part, k)) continue;
        sums.global += weather.global_horizontal[k];
        sums.part += part[k];
    }
    return sums;
}

void drop(std::vector<double>& series, std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) series[k] = nan;
}

/// Whether a part of the day was made missing. Of an overcast day direct irradiance is 0
/// and diffuse nearly the global.
bool drop_absent_of_day(Weather& weather, std::size_t first, std::size_t last) {
    constexpr double overcast = 0.9;  // share of the diffuse part without any direct
    auto &direct = weather.direct_normal, &diffuse = weather.diffuse_horizontal;
    const DaySums beam = sums_of(weather, direct, first, last),
                  sky = sums_of(weather, diffuse, first, last);
    const bool no_diffuse = sky.is_absent(0);
    const bool no_direct =
        beam.is_absent(0) && (sky.global == 0 || sky.is_absent(overcast));
    const bool no_global = beam.global == 0 && beam.part > 0 && sky.part > 0;
    if (no_direct) drop(direct, first, last);
    if (no_diffuse) drop(diffuse, first, last);
    if (no_global) drop(weather.global_horizontal, first, last);
    return no_direct || no_diffuse || no_global;
}

}  // namespace

std::vector<Seconds> drop_absent_parts(Weather& weather) {
    std::vector<Seconds> days;
    const auto n = static_cast<std::size_t>(weather.axis.n_steps);
    const auto day = static_cast<std::size_t>(day_s / weather.axis.step_s);
    const auto since_midnight =
        weather.axis.start - std::chrono::floor<std::chrono::days>(weather.axis.start);
    const auto start =
        static_cast<std::size_t>(since_midnight.count() / weather.axis.step_s);
    for (std::size_t first = 0; first < n;) {
        const std::size_t last = std::min(n, (first + start) / day * day + day - start);
        if (drop_absent_of_day(weather, first, last))
            days.push_back(weather.axis.begin_of(static_cast<int>(first)));
        first = last;
    }
    return days;
}

std::vector<int> unknown_irradiance(const Weather& weather) {
    return unknown_steps(weather,
                         step_suns(weather.site, weather.axis, SunOfStep::sunlit_part));
}

void complete_irradiance(Weather& weather) {
    const std::vector<StepSun> suns =
        step_suns(weather.site, weather.axis, SunOfStep::sunlit_part);
    const std::vector<int> unknown = unknown_steps(weather, suns);
    if (!unknown.empty())
        throw std::invalid_argument(
            fmt::format("no irradiance at {}: expected global, or direct and diffuse "
                        "irradiance, or cloud cover",
                        format_time(weather.axis.begin_of(unknown.front()))));
    for (auto* series : {&weather.global_horizontal, &weather.direct_normal,
                         &weather.diffuse_horizontal})
        series->resize(suns.size(), nan);
    fill_global(weather, suns);
    for (std::size_t k = 0; k < suns.size(); ++k) fill_parts(weather, suns[k], k);
}

std::vector<double> hour_means(const std::vector<double>& at_hour_end) {
    std::vector<double> means = at_hour_end;
    for (std::size_t k = 1; k < means.size(); ++k)
        means[k] = (at_hour_end[k - 1] + at_hour_end[k]) / 2;
    return means;
}

}  // namespace bemcal::physics
