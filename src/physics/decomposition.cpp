/// Statistical models for weather whose irradiance was not measured in full.
#include "physics/decomposition.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace bemcal::physics {
namespace {

/// Mean irradiance of the step on a horizontal plane outside the atmosphere [W/m2].
double extraterrestrial_horizontal(const StepSun& sun) {
    return sun.sunlit * sun.position.extraterrestrial *
           std::max(std::cos(sun.position.zenith), 0.0);
}

double clearness(double global, double outside) {
    return outside > 0 ? std::clamp(global / outside, 0.0, 1.0) : 0;
}

/// Each step's clearness of its whole day.
std::vector<double> daily_clearness(const TimeAxis& axis,
                                    const std::vector<double>& global,
                                    const std::vector<double>& outside) {
    struct Sums {
        double global = 0, outside = 0;
    };
    const auto day = [&](std::size_t k) {
        return std::chrono::floor<std::chrono::days>(axis.begin_of(static_cast<int>(k)));
    };
    std::map<std::chrono::sys_days, Sums> days;
    for (std::size_t k = 0; k < global.size(); ++k) {
        Sums& sums = days[day(k)];
        sums.global += global[k];
        sums.outside += outside[k];
    }
    std::vector<double> result(global.size());
    for (std::size_t k = 0; k < global.size(); ++k)
        result[k] = clearness(days[day(k)].global, days[day(k)].outside);
    return result;
}

/// Mean clearness of the neighbours; at sunrise and sunset that of the sunlit one.
double persistence(const std::vector<double>& hourly, const std::vector<double>& outside,
                   std::size_t k) {
    double sum = 0, n = 0;
    const auto add = [&](std::size_t neighbour) {
        if (neighbour >= hourly.size() || outside[neighbour] <= 0) return;
        sum += hourly[neighbour];
        n += 1;
    };
    add(k - 1);
    add(k + 1);
    return n > 0 ? sum / n : hourly[k];
}

}  // namespace

std::vector<double> diffuse_from_global(const Site& site, const TimeAxis& axis,
                                        const std::vector<StepSun>& suns,
                                        const std::vector<double>& global) {
    const std::size_t n = global.size();
    std::vector<double> outside(n), hourly(n), diffuse(n);
    for (std::size_t k = 0; k < n; ++k) {
        outside[k] = extraterrestrial_horizontal(suns[k]);
        hourly[k] = clearness(global[k], outside[k]);
    }
    const std::vector<double> daily = daily_clearness(axis, global, outside);
    for (std::size_t k = 0; k < n; ++k) {
        const double altitude = 90 - suns[k].position.zenith * 180 / std::numbers::pi;
        const double exponent =
            -5.32 + 7.28 * hourly[k] - 0.03 * solar_time(site, suns[k].position) -
            0.0047 * altitude + 1.72 * daily[k] + 1.08 * persistence(hourly, outside, k);
        diffuse[k] = outside[k] > 0 ? global[k] / (1 + std::exp(exponent)) : global[k];
    }
    return diffuse;
}

double clear_sky_global(double zenith, double extraterrestrial, double air_mass,
                        double elevation) {
    constexpr double linke_turbidity = 3;
    const double near_ground = std::exp(-elevation / 8000),
                 aerosol = std::exp(-elevation / 1250);
    const double a = 5.09e-5 * elevation + 0.868, b = 3.92e-5 * elevation + 0.0387;
    return a * extraterrestrial * std::max(std::cos(zenith), 0.0) *
           std::exp(-b * air_mass * (near_ground + aerosol * (linke_turbidity - 1)));
}

double cloudy_sky_global(double clear_sky, double cloud_cover) {
    return clear_sky * (1 - 0.75 * std::pow(std::clamp(cloud_cover, 0.0, 1.0), 3.4));
}

}  // namespace bemcal::physics
