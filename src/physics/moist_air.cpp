/// Moist air as an ideal mixture.
/// Source: ASHRAE Handbook Fundamentals 2017, chapter 1, eq. 20 (humidity ratio) and 30
/// (enthalpy). Saturation is what its table 3 is made of: over water IAPWS-IF97, eq. 30;
/// over ice IAPWS R14-08, eq. 6. The handbook's own fits (eq. 5 and 6) miss that table by
/// 3e-4. ISO 2533 for the atmosphere. Left out: the enhancement factor (0.4 %).
#include "physics/moist_air.hpp"

#include <cmath>

namespace bemcal::physics {

namespace {

constexpr double kelvin = 273.15;
constexpr double triple_point = 273.16;      // [K]
constexpr double triple_pressure = 611.657;  // [Pa]
constexpr double water_per_air = 0.621945;   // molar masses [-]
constexpr double n[] = {0,
                        0.11670521452767e4,
                        -0.72421316703206e6,
                        -0.17073846940092e2,
                        0.12020824702470e5,
                        -0.32325550322333e7,
                        0.14915108613530e2,
                        -0.48232657361591e4,
                        0.40511340542057e6,
                        -0.23855557567849,
                        0.65017534844798e3};

/// A pressure [Pa] and how it grows with temperature [Pa/K].
struct Pressure {
    double p, per_kelvin;
};

/// IAPWS-IF97, eq. 30: a quadratic equation in the fourth root of the pressure [MPa].
Pressure over_water(double T) {
    const double t = T + n[9] / (T - n[10]);
    const double of_t = 1 - n[9] / ((T - n[10]) * (T - n[10]));
    const double A = (t + n[1]) * t + n[2], B = (n[3] * t + n[4]) * t + n[5],
                 C = (n[6] * t + n[7]) * t + n[8];
    const double of_A = 2 * t + n[1], of_B = 2 * n[3] * t + n[4],
                 of_C = 2 * n[6] * t + n[7];
    const double root = std::sqrt(B * B - 4 * A * C);
    const double of_root = (B * of_B - 2 * (of_A * C + A * of_C)) / root;
    const double x = 2 * C / (root - B);
    const double of_x = (2 * of_C - x * (of_root - of_B)) / (root - B);
    const double x3 = x * x * x;
    return {1e6 * x3 * x, 1e6 * 4 * x3 * of_x * of_t};
}

/// IAPWS R14-08, eq. 6.
Pressure over_ice(double T) {
    constexpr double a[] = {-0.212144006e2, 0.273203819e2, -0.610598130e1};
    constexpr double b[] = {0.333333333e-2, 0.120666667e1, 0.170333333e1};
    const double t = T / triple_point;
    double sum = 0, of_sum = 0;
    for (int k = 0; k < 3; ++k) {
        sum += a[k] * std::pow(t, b[k]);
        of_sum += a[k] * b[k] * std::pow(t, b[k] - 1);
    }
    const double p = triple_pressure * std::exp(sum / t);
    return {p, p * (of_sum - sum / t) / t / triple_point};
}

Pressure saturation(double theta) {
    const double T = theta + kelvin;
    return T < triple_point ? over_ice(T) : over_water(T);
}

}  // namespace

double standard_pressure(double elevation) {
    return 101325 * std::pow(1 - 2.25577e-5 * elevation, 5.25588);
}

double saturation_pressure(double theta) {
    return saturation(theta).p;
}

double humidity_ratio(double vapour, double pressure) {
    return water_per_air * vapour / (pressure - vapour);
}

Saturated saturated_air(double theta, double pressure) {
    const auto [p, per_kelvin] = saturation(theta);
    const double dry = pressure - p;
    return {water_per_air * p / dry, water_per_air * pressure / (dry * dry) * per_kelvin};
}

double enthalpy(double theta, double w) {
    return 1006 * theta + w * (heat_of_vapour + 1860 * theta);
}

}  // namespace bemcal::physics
