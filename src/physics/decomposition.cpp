/// Irradiance from less than its parts: diffuse from global, global of a clear sky, and
/// of a cloudy one.
/// Source: Erbs, Klein and Duffie 1982, eq. 1; Ineichen and Perez 2002; Kasten and
/// Czeplak 1980. The Linke turbidity is always 3. Which of them a weather file needs is
/// left to weather.cpp.
#include "physics/decomposition.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::physics {
namespace {

/// Diffuse fraction by the clearness index k (Erbs et al. 1982, eq. 1).
double diffuse_fraction(double k) {
    if (k <= 0.22) return 1 - 0.09 * k;
    if (k > 0.8) return 0.165;
    return 0.9511 + k * (-0.1604 + k * (4.388 + k * (-16.638 + k * 12.336)));
}

}  // namespace

double diffuse_from_global(double global, const StepSun& sun) {
    const double outside = sun.sunlit * sun.position.extraterrestrial *
                           std::max(std::cos(sun.position.zenith), 0.0);
    return outside > 0 ? global * diffuse_fraction(global / outside) : global;
}

double clear_sky_global(double zenith, double extraterrestrial, double air_mass,
                        double elevation) {
    constexpr double linke_turbidity = 3;
    const double clean = std::exp(-elevation / 8000),
                 aerosol = std::exp(-elevation / 1250);
    const double a = 5.09e-5 * elevation + 0.868, b = 3.92e-5 * elevation + 0.0387;
    return a * extraterrestrial * std::max(std::cos(zenith), 0.0) *
           std::exp(-b * air_mass * (clean + aerosol * (linke_turbidity - 1)));
}

double cloudy_sky_global(double clear_sky, double cloud_cover) {
    return clear_sky * (1 - 0.75 * std::pow(std::clamp(cloud_cover, 0.0, 1.0), 3.4));
}

}  // namespace bemcal::physics
