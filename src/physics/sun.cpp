/// Where the sun is: solar coordinates of low accuracy (about 0.01 deg), seen from the
/// Earth's surface (parallax); for a step, at its middle or that of its sunlit part.
/// Source: Meeus, Astronomical Algorithms, 2nd ed., chapters 12, 22 and 25; air mass:
/// Kasten and Young 1989, Applied Optics 28(22).
/// Left out: refraction (irradiance models expect the geometric sun), the Earth's
/// oblateness, and the 70 s between dynamical and universal time (0.001 deg).
#include "physics/sun.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bemcal::physics {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double solar_constant = 1366.1;  // [W/m2], as in the sky models' sources
constexpr long long j2000 = 946728000;     // 2000-01-01 12:00 UTC [s since 1970]

struct Equatorial {
    double declination;      // [rad]
    double right_ascension;  // [rad]
    double distance;         // [AU]
    double sidereal;         // apparent sidereal time at Greenwich [rad]
};

/// \param d  days since 2000-01-01 12:00 UTC
Equatorial equatorial(double d) {
    const double t = d / 36525;
    const double mean_longitude = 280.46646 + t * (36000.76983 + t * 0.0003032);
    const double anomaly = (357.52911 + t * (35999.05029 - t * 0.0001537)) * deg;
    const double eccentricity = 0.016708634 - t * (0.000042037 + t * 0.0000001267);
    const double s = std::sin(anomaly), c = std::cos(anomaly);
    const double center = (1.914602 - t * 0.004817) * s +
                          (0.019993 - t * 0.000101) * 2 * s * c +
                          0.000289 * s * (3 - 4 * s * s);  // [deg]
    const double node = (125.04 - 1934.136 * t) * deg;
    const double nutation = -0.00478 * std::sin(node);  // in longitude [deg]
    const double longitude = (mean_longitude + center - 0.00569 + nutation) * deg;
    const double obliquity = (23.439291 - 0.0130042 * t + 0.00256 * std::cos(node)) * deg;
    const double sin_longitude = std::sin(longitude), cos_obliquity = std::cos(obliquity);
    return {
        std::asin(std::sin(obliquity) * sin_longitude),
        std::atan2(cos_obliquity * sin_longitude, std::cos(longitude)),
        1.000001018 * (1 - eccentricity * eccentricity) /
            (1 + eccentricity * std::cos(anomaly + center * deg)),
        std::fmod(280.46061837 + 360.98564736629 * d + nutation * cos_obliquity, 360) *
            deg};
}

double height(const SunPosition& sun) {
    return std::cos(sun.zenith);
}

/// The sunlit part of a half step, by the height of the sun (cos of zenith) at both ends
/// [0..1].
struct Part {
    double from, to;
};
Part sunlit_part(double before, double after) {
    if (before <= 0 && after <= 0) return {0.5, 0.5};
    if (before > 0 && after > 0) return {0, 1};
    const double crossing = before / (before - after);
    return before > 0 ? Part{0, crossing} : Part{crossing, 1};
}

/// The sun of a step whose ends and middle are known.
StepSun sunlit_sun(const Site& site, Seconds begin, int step_s, double at_begin,
                   const SunPosition& middle, double at_end) {
    const double at_middle = height(middle);
    if (at_begin > 0 && at_middle > 0 && at_end > 0) return {middle, 1};
    if (at_begin <= 0 && at_middle <= 0 && at_end <= 0) return {middle, 0};
    const Part first = sunlit_part(at_begin, at_middle),
               second = sunlit_part(at_middle, at_end);
    const double lit_first = first.to - first.from, lit_second = second.to - second.from;
    // Middle of the light: the two halves' middles, each with the weight of its length.
    const double center = (lit_first * (first.from + first.to) / 2 +
                           lit_second * (1 + (second.from + second.to) / 2)) /
                          (lit_first + lit_second);
    const auto after = static_cast<long long>(std::lround(center * step_s / 2));
    return {sun_position(site, begin + std::chrono::seconds(after)),
            (lit_first + lit_second) / 2};
}

}  // namespace

SunPosition sun_position(const Site& site, Seconds local_standard) {
    const double since =
        static_cast<double>(local_standard.time_since_epoch().count() - j2000);
    const Equatorial sun = equatorial((since - site.utc_offset_h * 3600) / day_s);
    const double hour_angle = sun.sidereal + site.longitude * deg - sun.right_ascension;
    const double sin_phi = std::sin(site.latitude * deg),
                 cos_phi = std::cos(site.latitude * deg);
    const double sin_dec = std::sin(sun.declination), cos_dec = std::cos(sun.declination);
    const double cos_hour = std::cos(hour_angle);
    const double up = sin_phi * sin_dec + cos_phi * cos_dec * cos_hour;
    const double north = cos_phi * sin_dec - sin_phi * cos_dec * cos_hour;
    const double east = -cos_dec * std::sin(hour_angle);
    const double horizontal = std::hypot(east, north);
    constexpr double parallax = 8.794 / 3600 * deg;
    const double azimuth = std::atan2(east, north);
    return {std::atan2(horizontal, up) + parallax * horizontal,
            azimuth < 0 ? azimuth + 2 * pi : azimuth,
            solar_constant / (sun.distance * sun.distance)};
}

std::vector<StepSun> step_suns(const Site& site, const TimeAxis& axis, SunOfStep which) {
    std::vector<StepSun> suns;
    suns.reserve(static_cast<std::size_t>(std::max(axis.n_steps, 0)));
    double at_begin = height(sun_position(site, axis.start));
    for (int k = 0; k < axis.n_steps; ++k) {
        const Seconds begin = axis.begin_of(k);
        const SunPosition middle =
            sun_position(site, begin + std::chrono::seconds(axis.step_s / 2));
        if (which == SunOfStep::middle) {
            suns.push_back({middle, height(middle) > 0 ? 1.0 : 0.0});
            continue;
        }
        const double at_end = height(sun_position(site, axis.begin_of(k + 1)));
        suns.push_back(sunlit_sun(site, begin, axis.step_s, at_begin, middle, at_end));
        at_begin = at_end;
    }
    return suns;
}

double air_mass(double zenith) {
    const double z = std::min(zenith / deg, 90.0);
    return 1 / (std::cos(z * deg) + 0.50572 * std::pow(96.07995 - z, -1.6364));
}

double cos_incidence(const SunPosition& sun, double tilt, double azimuth) {
    return std::cos(sun.zenith) * std::cos(tilt) +
           std::sin(sun.zenith) * std::sin(tilt) * std::cos(sun.azimuth - azimuth);
}

}  // namespace bemcal::physics
