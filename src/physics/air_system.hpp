/// What an air system makes of a zone's hour: from the heat that the zone asks for to the
/// energy of coils and fan.
#pragma once

namespace bemcal::physics {

/// All that a zone's part of an air system sees in a step. Its adjoints have the same
/// type.
struct AirHour {
    double heating = 0, cooling = 0;  ///< that the zone asks for [W]
    double theta_air = 0;             ///< of the zone, and of what it returns [degC]
    double theta_e = 0;               ///< outdoor air as the system takes it [degC]
    double w_e = 0;                   ///< its humidity ratio [kg/kg]
    double q_e = 0;                   ///< its least flow [m3/s]
    double q_supplied = 0;            ///< supply air of the zone's own balance [m3/s]
    double q_inf = 0;                 ///< other outdoor air in the zone's water [m3/s]
    double moisture = 0;              ///< that people give off [kg/s]
    double heat_recovery = 0;         ///< as the zone's flow has it [-]
    double available = 0;             ///< share of the fan that runs by the clock [-]
    double q_design = 0;              ///< largest flow of supply air [m3/s]
    double least_flow = 0;            ///< of q_design, where the flow varies [-]
    double fan_power = 0;             ///< at q_design [W]
    double fan_exponent = 0;          ///< of the flow in the fan's power [-]
    double fan_heat = 0;              ///< share of the fan's power in the air [-]
    double theta_supply = 0;          ///< leaving coil and fan [degC]
    double bypass_factor = 0;         ///< of the cooling coil [-]
    double coil_enthalpy = 0;         ///< of rated air, when on [J/kg]; 0: modulates
    double economiser = 0;            ///< largest share of outdoor air now [-]
    double frost_limit = 0;           ///< coldest exhaust air after recovery [degC]
    double least_w = 0;               ///< humidity ratio that is kept [kg/kg]
};

/// What does not change from step to step.
struct AirKind {
    bool variable = true;      ///< the flow follows the load
    bool is_moist = false;     ///< w_e is known
    double pressure = 101325;  ///< of the air [Pa]
    bool supplies = false;     ///< the zone's own balance has the least supply air
};

/// What coils and fan take [W].
struct AirLoads {
    double heating = 0, cooling = 0, fan = 0;
};

AirLoads supply(const AirKind& kind, const AirHour& hour);

/// The way back through `supply`: d objective / d (numbers of the hour).
AirHour pull_supply(const AirKind& kind, const AirHour& hour, const AirLoads& of_loads);

}  // namespace bemcal::physics
