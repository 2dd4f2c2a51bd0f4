/// Paper 1's sensitivity model: heating plus cooling energy of ONE hour of a box-shaped
/// office, from 19 numbers (its Table 2).
///
/// The geometry follows from gross floor area, length, width and storey height; the
/// irradiance on the four facades and the roof from DNI, DHI, the day, the hour and the
/// site (Guangzhou).
#pragma once

#include <span>
#include <string>
#include <vector>

namespace bemcal::physics {

struct OfficeHourInput {
    const char* name;
    const char* unit;
    double least, most;  ///< Table 2, its misprints mended
    const char* sentence;
};
/// The 19 inputs in Table 2's order; GFA and theta_prev are numbers 1 and 14 there.
std::span<const OfficeHourInput> office_hour_inputs();
/// The place of an input among them. Throws std::invalid_argument for another name.
std::size_t office_hour_input_number(const std::string& name);

/// What paper 1 leaves open. Its ventilation is taken to recover heat, as in the most
/// used open implementation of the method: 6 air changes of outdoor air without recovery
/// would make Ven_M a leading input, which the paper says it is not.
struct OfficeHourAssumptions {
    double heat_recovery = 0.6;      ///< of the mechanical ventilation [-]
    double g_value = 0.75;           ///< double glazing, ISO 13790 Table G.2 [-]
    double frame_fraction = 0.2;     ///< [-]
    double solar_absorptance = 0.6;  ///< of walls and roof [-]
};

/// \param inputs  19 values in that order
/// \return heating + cooling energy of the hour [kWh]; NaN where the box is impossible
double office_hour_energy(std::span<const double> inputs,
                          const OfficeHourAssumptions& assumptions = {});

}  // namespace bemcal::physics
