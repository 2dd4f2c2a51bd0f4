/// Moist air: water vapour at saturation, humidity ratio, enthalpy.
#pragma once

namespace bemcal::physics {

constexpr double heat_of_vapour = 2.501e6;  ///< of water at 0 degC [J/kg]

/// Pressure of the standard atmosphere [Pa] at an elevation [m] (ISO 2533).
double standard_pressure(double elevation);

/// Pressure of water vapour at saturation [Pa], over ice below the triple point.
/// -100 to 350 degC.
double saturation_pressure(double theta);

/// Water per dry air [kg/kg] from the vapour's pressure and that of all [Pa].
double humidity_ratio(double vapour, double pressure);

/// Water per dry air of saturated air [kg/kg], and how it grows with temperature [1/K].
struct Saturated {
    double w, per_kelvin;
};
Saturated saturated_air(double theta, double pressure);

/// Enthalpy of moist air per dry air [J/kg] from temperature [degC] and humidity ratio.
double enthalpy(double theta, double w);

}  // namespace bemcal::physics
