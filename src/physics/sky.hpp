/// Irradiance on a plane: Perez 1990 anisotropic sky, ground reflection; decomposition of
/// global irradiance; clear sky.
#pragma once

#include <vector>

#include "physics/sun.hpp"

namespace bemcal::physics {

struct PlaneIrradiance {
    double beam, sky, ground;  ///< [W/m2]
    double total() const { return beam + sky + ground; }
};

enum class SkyModel { perez, isotropic };

/// A plane that irradiance is asked for. The window's solar transmittance may depend on the
/// angle of incidence of the beam: sum_k modifier[k] theta^k, theta in rad; 1 where empty.
struct Plane {
    double tilt = 0;                 ///< [rad]
    double azimuth = 0;              ///< [rad], clockwise from north
    std::vector<double> modifier;    ///< polynomial in the angle of incidence, beam only
    bool operator==(const Plane&) const = default;
};

/// One instant. \param global  horizontal irradiance [W/m2] (for ground reflection)
PlaneIrradiance irradiance_on(const Plane& plane, const SunPosition& sun, double direct_normal,
                              double diffuse_horizontal, double global, double albedo,
                              SkyModel model = SkyModel::perez);

/// Perez' diffuse irradiance from the sky on a plane [W/m2]; the 3-decimal coefficients.
double perez_sky(double tilt, double cos_theta, double zenith, double direct_normal,
                 double diffuse_horizontal, double extraterrestrial, double air_mass);

/// Relative air mass, Kasten and Young 1989. \param zenith [rad]
double air_mass(double zenith);

/// Total irradiance on a plane for every step of the weather (sun at the middle of the step;
/// steps with sunrise or sunset over their sunlit part) [W/m2].
std::vector<double> irradiance_series(const Weather& weather, const Plane& plane,
                                      SkyModel model = SkyModel::perez);

/// Diffuse horizontal from global horizontal irradiance [W/m2].
double diffuse_from_global(double global, const SunPosition& sun);

/// Global horizontal irradiance under a clear sky, then under a cloud cover [W/m2].
double clear_sky_global(double zenith, double extraterrestrial, double elevation);
double cloudy_sky_global(double clear_sky, double cloud_cover);

}  // namespace bemcal::physics
