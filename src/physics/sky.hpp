/// Irradiance on a plane: the sky of Perez 1990 (others: isotropic, Hay and Davies), and
/// ground reflection.
#pragma once

#include "physics/sun.hpp"
#include "physics/weather.hpp"

#include <optional>
#include <vector>

namespace bemcal::physics {

struct PlaneIrradiance {
    double beam, sky, ground;  ///< [W/m2]
    double total() const { return beam + sky + ground; }
};

enum class SkyModel { perez, isotropic, hay_davies };

/// A plane that irradiance is asked for. The window's solar transmittance may depend on
/// the angle of incidence of the beam: sum_k modifier[k] theta^k, theta in rad; 1 where
/// empty. Light from the sky and the ground comes from all angles: a mean of it. What an
/// opaque element takes up reaches the room later: through two stores of heat in a row,
/// each with half of the lag (0: at once, as in the standard).
struct Plane {
    double tilt = 0;                ///< [rad]
    double azimuth = 0;             ///< [rad], clockwise from north
    std::vector<double> modifier;   ///< polynomial in the angle of incidence, beam only
    double lag_hours = 0;           ///< [h]
    double diffuse_modifier = 1;    ///< of light from sky and ground [-]
    std::optional<SkyModel> sky{};  ///< in place of the one asked for
    bool operator==(const Plane&) const = default;
};

/// One instant. With the sun below the horizon there is no beam and the sky is isotropic.
/// \param global  horizontal irradiance [W/m2] (for ground reflection)
PlaneIrradiance irradiance_on(const Plane& plane, const SunPosition& sun,
                              double direct_normal, double diffuse_horizontal,
                              double global, double albedo,
                              SkyModel model = SkyModel::perez);

/// Perez' diffuse irradiance from the sky on a plane [W/m2]; the 3-decimal coefficients.
double perez_sky(double tilt, double cos_theta, double zenith, double direct_normal,
                 double diffuse_horizontal, double extraterrestrial, double air_mass);

/// Hay and Davies' diffuse irradiance from the sky on a plane [W/m2]: as much of it comes
/// from the sun's direction as of the extraterrestrial beam reaches the ground, the rest
/// from all of the sky.
double hay_davies_sky(double tilt, double cos_theta, double zenith, double direct_normal,
                      double diffuse_horizontal, double extraterrestrial);

/// Total irradiance on a plane for every step of the weather [W/m2], the sun standing
/// where `suns` say. Throws std::invalid_argument where direct, diffuse or global
/// irradiance is not there (complete_irradiance makes it).
/// \param suns  from step_suns for the weather's axis: the same for all planes
std::vector<double> irradiance_series(const Weather& weather,
                                      const std::vector<StepSun>& suns,
                                      const Plane& plane,
                                      SkyModel model = SkyModel::perez);
/// The same with the sun at the middle of each step.
std::vector<double> irradiance_series(const Weather& weather, const Plane& plane,
                                      SkyModel model = SkyModel::perez);

}  // namespace bemcal::physics
