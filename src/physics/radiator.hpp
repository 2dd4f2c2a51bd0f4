/// A dynamic radiator: water and metal as elements in a row, each at one temperature.
///
/// Element i of n with capacity C/n, fed by the one before:
///   C/n dT_i/dt = m c (T_(i-1) - T_i) - q_i,
///   q_i = UA/n [(1 - f) d(T_i - T_air) + f d(T_i - T_rad)],   d(x) = |x|^e sign(x)
/// as in modelica-buildings' RadiatorEN442_2; the parameters are those that TRNSYS
/// Type 362 (Holst 1996) is known by. A radiator colder than the room takes heat from it.
/// Steps are divided into sub-steps of Heun's method, which keeps the energy balance
/// exactly. Left out: heat conducted between elements, and what the pipes lose.
///
/// The supply temperature of paper 2 (eq. 10-12): a theta_e + b below a limit, c above
/// it; outside the schedule off, or d where the room is cold.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace bemcal::physics {

struct Radiator {
    double exponent = 1.3;
    double power_60 = 2000;           ///< at 60 K above the room [W]
    double capacity = 50000;          ///< of water and metal [J/K]
    double radiative_fraction = 0.3;  ///< of the heat, at equal temperatures
    double most_flow = 0.03;          ///< of water, with open valve [kg/s]
    int n_elements = 5;
};

/// What is wrong with it, in words; empty = nothing.
const char* complaint_about(const Radiator& radiator);

/// UA = power_60 / 60^exponent [W/K^exponent]
double transmittance_of(const Radiator& radiator);

/// Around a radiator during a step.
struct RadiatorSurroundings {
    double supply = 0;    ///< temperature of the water that flows in [degC]
    double opening = 1;   ///< of the valve: 0 to 1 of most_flow
    double air = 20;      ///< [degC]
    double radiant = 20;  ///< mean radiant temperature [degC]
};

/// Means over a step.
struct RadiatorHeat {
    double convective = 0, radiative = 0;  ///< to the room [W]
    double from_water = 0;                 ///< m c (T_supply - T_return) [W]
};

/// Moves the elements' temperatures [n_elements, degC] on by a step of any length; the
/// last of them is the return temperature while water flows.
RadiatorHeat advance(const Radiator& radiator, const RadiatorSurroundings& around,
                     double seconds, std::span<double> elements);

struct HeatingCurve {
    double a = -1.1, b = 54, c = 43, d = 22;  ///< [-], [degC], [degC], [degC]
    double limit = 10;     ///< outdoor temperature above which c holds [degC]
    double set_back = 14;  ///< outside the schedule on below this in the room [degC]
};

/// Supply temperature [degC]; none: the heating is off.
std::optional<double> supply_temperature(const HeatingCurve& curve, bool is_scheduled,
                                         double outdoor, double room);

}  // namespace bemcal::physics
