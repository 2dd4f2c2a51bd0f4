/// One hour of ISO 13790:2008 Annex C: the plain version, written to be read beside the
/// standard.
///
/// Every fast version is tested against it. Leaves out what structure.hpp adds.
#pragma once

#include "physics/network.hpp"

namespace bemcal::physics {

struct NodeTemperatures {
    double theta_m_t;  ///< mass, at the end of the step [degC]
    double theta_m;    ///< mass, mean of the step (C.9)
    double theta_s;    ///< surfaces (C.10)
    double theta_air;  ///< air (C.11)
    double theta_op;   ///< operative (C.12)
};

/// Shares of a radiant gain that reach the surface and the mass node (C.2, C.3); by the
/// standard's design they do not sum to 1.
struct RadiantSplit {
    double to_m, to_st;
};
RadiantSplit radiant_split(const Network& network);

struct NodeGains {
    double phi_ia, phi_st, phi_m;  ///< to air, surface and mass node [W] (C.1 to C.3)
};
NodeGains split_gains(const Network& network, double phi_int, double phi_sol);
/// Of a step, with a radiator's heat and less what openings take from the air node.
NodeGains split_gains(const Network& network, const HourDrive& drive);

/// Temperatures for a given heating or cooling power (C.4 to C.12).
/// \param phi_hc  power at the air node [W]; positive heats, negative cools
/// \param dt      length of the step [s]; 3600 in the standard
NodeTemperatures advance_hour(const Network& network, const HourDrive& drive,
                              const NodeGains& gains, double theta_m_before,
                              double phi_hc, double dt = 3600);

/// The power that meets the set-points within the limits: the five cases of C.4.2 [W].
double power_for_set_point(const Network& network, const HourDrive& drive,
                           const NodeGains& gains, const Control& control,
                           double theta_m_before, double dt = 3600);

}  // namespace bemcal::physics
