/// Irradiance on a plane from a step's means: beam, light of the sky, ground reflection.
/// Source: Perez et al. 1990, Solar Energy 44(5), 271-289 ("all sites composite 1990");
/// Hay and Davies 1980, Proc. First Canadian Solar Radiation Data Workshop, 59-72. The
/// lag is our own. Horizons are left out; shade is a factor of the element.
#include "physics/sky.hpp"

#include "physics/site.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace bemcal::physics {
namespace {

struct PerezBin {
    double clearness;  // upper bound of epsilon
    double f11, f12, f13, f21, f22, f23;
};
constexpr std::array<PerezBin, 8> perez_bins{{
    {1.065, -0.008, 0.588, -0.062, -0.060, 0.072, -0.022},
    {1.23, 0.130, 0.683, -0.151, -0.019, 0.066, -0.029},
    {1.5, 0.330, 0.487, -0.221, 0.055, -0.064, -0.026},
    {1.95, 0.568, 0.187, -0.295, 0.109, -0.152, -0.014},
    {2.8, 0.873, -0.392, -0.362, 0.226, -0.462, 0.001},
    {4.5, 1.132, -1.237, -0.412, 0.288, -0.823, 0.056},
    {6.2, 1.060, -1.600, -0.359, 0.264, -1.127, 0.131},
    {HUGE_VAL, 0.678, -0.327, -0.250, 0.156, -1.377, 0.251},
}};

const PerezBin& perez_bin(double clearness) {
    return *std::find_if(perez_bins.begin(), perez_bins.end() - 1,
                         [=](const PerezBin& bin) { return clearness < bin.clearness; });
}

double isotropic_sky(double tilt, double diffuse_horizontal) {
    return diffuse_horizontal * (1 + std::cos(tilt)) / 2;
}

/// What a plane gets of light from the sun's direction, over what the ground gets.
double toward_sun(double cos_theta, double zenith) {
    return std::max(0.0, cos_theta) / std::max(std::cos(85 * deg), std::cos(zenith));
}

/// The share of the beam that passes at an angle of incidence; see Plane.
double beam_modifier(const Plane& plane, double cos_theta) {
    if (plane.modifier.empty()) return 1;
    const double theta = std::acos(std::clamp(cos_theta, 0.0, 1.0));
    double value = 0;
    for (auto c = plane.modifier.rbegin(); c != plane.modifier.rend(); ++c)
        value = value * theta + *c;
    return std::max(value, 0.0);
}

void require_complete(const Weather& weather, const std::vector<StepSun>& suns) {
    const auto n = static_cast<std::size_t>(weather.axis.n_steps);
    if (weather.direct_normal.size() != n || weather.diffuse_horizontal.size() != n ||
        weather.global_horizontal.size() != n || suns.size() != n)
        throw std::invalid_argument(
            "direct, diffuse and global irradiance must have a value for every step");
}

/// What reaches the room of it. Starts from the first day's mean; a step without a value
/// has none, and changes nothing.
void delay(std::vector<double>& series, double lag_hours, double step_hours) {
    const double keep = std::exp(-2 * step_hours / lag_hours);
    const auto day = std::min(series.size(), static_cast<std::size_t>(24 / step_hours));
    double sum = 0, n = 0;
    for (std::size_t k = 0; k < day; ++k)
        if (!std::isnan(series[k])) sum += series[k], ++n;
    double outer = n > 0 ? sum / n : 0, inner = outer;
    for (double& value : series) {
        if (std::isnan(value)) continue;
        outer = keep * outer + (1 - keep) * value;
        inner = keep * inner + (1 - keep) * outer;
        value = inner;
    }
}

}  // namespace

double perez_sky(double tilt, double cos_theta, double zenith, double direct_normal,
                 double diffuse_horizontal, double extraterrestrial, double air_mass) {
    if (diffuse_horizontal <= 0) return 0;
    const double kappa = 1.041 * zenith * zenith * zenith;
    const double clearness =
        (1 + direct_normal / diffuse_horizontal + kappa) / (1 + kappa);
    const double brightness = diffuse_horizontal * air_mass / extraterrestrial;
    const PerezBin& f = perez_bin(clearness);
    const double circumsolar = std::max(0.0, f.f11 + f.f12 * brightness + f.f13 * zenith);
    const double horizon = f.f21 + f.f22 * brightness + f.f23 * zenith;
    const double share = (1 - circumsolar) * (1 + std::cos(tilt)) / 2 +
                         circumsolar * toward_sun(cos_theta, zenith) +
                         horizon * std::sin(tilt);
    return std::max(diffuse_horizontal * share, 0.0);
}

double hay_davies_sky(double tilt, double cos_theta, double zenith, double direct_normal,
                      double diffuse_horizontal, double extraterrestrial) {
    const double circumsolar = direct_normal / extraterrestrial;
    return circumsolar * diffuse_horizontal * toward_sun(cos_theta, zenith) +
           (1 - circumsolar) * isotropic_sky(tilt, diffuse_horizontal);
}

namespace {

/// Of the sky, with the sun above the horizon.
double light_of(SkyModel sky, const Plane& plane, double cos_theta,
                const SunPosition& sun, double direct_normal, double diffuse_horizontal) {
    switch (sky) {
        case SkyModel::isotropic:
            return isotropic_sky(plane.tilt, diffuse_horizontal);
        case SkyModel::hay_davies:
            return hay_davies_sky(plane.tilt, cos_theta, sun.zenith, direct_normal,
                                  diffuse_horizontal, sun.extraterrestrial);
        default:
            return perez_sky(plane.tilt, cos_theta, sun.zenith, direct_normal,
                             diffuse_horizontal, sun.extraterrestrial,
                             air_mass(sun.zenith));
    }
}

}  // namespace

PlaneIrradiance irradiance_on(const Plane& plane, const SunPosition& sun,
                              double direct_normal, double diffuse_horizontal,
                              double global, double albedo, SkyModel model) {
    PlaneIrradiance on{0, isotropic_sky(plane.tilt, diffuse_horizontal),
                       global * albedo * (1 - std::cos(plane.tilt)) / 2};
    if (std::cos(sun.zenith) > 0) {
        const double cos_theta = cos_incidence(sun, plane.tilt, plane.azimuth);
        on.beam =
            direct_normal * std::max(cos_theta, 0.0) * beam_modifier(plane, cos_theta);
        on.sky = light_of(plane.sky.value_or(model), plane, cos_theta, sun, direct_normal,
                          diffuse_horizontal);
    }
    on.sky *= plane.diffuse_modifier;
    on.ground *= plane.diffuse_modifier;
    return on;
}

std::vector<double> irradiance_series(const Weather& weather,
                                      const std::vector<StepSun>& suns,
                                      const Plane& plane, SkyModel model) {
    require_complete(weather, suns);
    std::vector<double> series(suns.size());
    for (std::size_t k = 0; k < series.size(); ++k)
        series[k] =
            irradiance_on(plane, suns[k].position, weather.direct_normal[k],
                          weather.diffuse_horizontal[k], weather.global_horizontal[k],
                          weather.site.albedo, model)
                .total();
    if (plane.lag_hours > 0) delay(series, plane.lag_hours, weather.axis.step_s / 3600.0);
    return series;
}

std::vector<double> irradiance_series(const Weather& weather, const Plane& plane,
                                      SkyModel model) {
    return irradiance_series(weather, step_suns(weather.site, weather.axis), plane,
                             model);
}

}  // namespace bemcal::physics
