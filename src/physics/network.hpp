/// A building's zone as ISO 13790's network: from words to the standard's symbols.
///
/// ISO 13790:2008, 7.2.2 (areas and classes), 8.3 (transmission), 9.3 (ventilation), 11.3
/// to 11.4 (solar gains, sky loss), 12.2.2 (capacity). Leaves out: unheated spaces other
/// than by b_tr, and the standard's monthly method.
#pragma once

#include "physics/building.hpp"
#include "physics/drive.hpp"

#include <vector>

namespace bemcal::physics {

constexpr double rho_c_air = 1200;  ///< volumetric heat capacity of air [J/(m3 K)]

/// All that the hour's equations need of a zone, for the steps at which its inputs hold.
/// Shares of a boundary temperature: index 0 is the outdoor air, 1 + b is boundary b.
struct Network {
    double A_f = 0, A_m = 0, A_tot = 0;                                  ///< [m2]
    double C_m = 0;                                                      ///< [J/K]
    double H_tr_w = 0, H_tr_em = 0, H_tr_ms = 0, H_tr_is = 0, H_ve = 0;  ///< [W/K]
    std::vector<double> em_share;  ///< [1 + n_boundaries] of H_tr_op; sums to 1
    std::vector<double> ve_share;  ///< [1 + n_boundaries] of H_ve; sums to 1
    std::vector<double> aperture;  ///< [n_planes] effective collecting area A_sol [m2]
    double gains_air_share = 0.5;  ///< of phi_int to the air node [-]
    double sun_air_share = 0;      ///< of phi_sol to the air node [-]
    double phi_sky = 0;        ///< F_r Phi_r, long-wave loss to the sky [W], subtracted
    double air_capacity = 0;   ///< [J/K]
    double H_2 = 0, C_2 = 0;   ///< second mass [W/K], [J/K]
    double tau_emitter = 0;    ///< [s]
    double radiant_share = 0;  ///< [-]
    double band = 0;           ///< [K]
};

/// The network at one step. Throws CannotSimulate with a sentence where the building
/// is outside the method: H_tr_op >= H_tr_ms, a negative area or conductance, not finite.
/// Writes into `network` so that its vectors are reused from call to call.
void make_network(const Building& building, const Zone& zone, const Drive& drive,
                  int step, Network& network);

/// The two parts of make_network, in this order: all but the air flows; and these. Where
/// no input of surfaces and windows varies, the first part holds for all steps.
void make_elements(const Building& building, const Zone& zone, const Drive& drive,
                   int step, Network& network);
void make_air_flows(const Building& building, const Zone& zone, const Drive& drive,
                    int step, Network& network);

/// Throws CannotSimulate where Crank-Nicolson would ring: C_m / dt < (H_3 + H_tr_em +
/// H_2) / 2, or the second mass alike. make_air_flows calls it; a caller that changes
/// H_ve calls it again.
void reject_ringing(const Zone& zone, int step, const Network& network, double dt);

/// Set-points and limits at one step.
struct Control {
    double theta_H_set = 20, theta_C_set = 26;  ///< [degC]
    double phi_H_max = unlimited;               ///< [W], >= 0
    double phi_C_max = unlimited;               ///< [W], >= 0 (a size)
    bool imposed = false;
    double phi_imposed = 0;         ///< [W]
    double heated = 1, cooled = 1;  ///< shares of rooms, by the season [-]
    double room_spread = 0;         ///< [K]
    double together = 0;            ///< cooled_together [-]
    bool held_apart = false;  ///< theta_C_set is theta_H_set and the proportional band
};
/// Throws CannotSimulate where heating and cooling are both there and their set-points
/// cross or lie closer than the proportional band; where an effect moves them so near,
/// cooling gives way, as thermostats hold a dead band. A zone with a radiator has no
/// other heating.
Control control_at(const Zone& zone, const Drive& drive, int step);

/// Temperatures and gains of one step.
struct HourDrive {
    double theta_e = 0;               ///< at windows [degC]
    double theta_em = 0;              ///< behind the opaque elements [degC]
    double theta_sup = 0;             ///< supply air [degC]
    double phi_int = 0, phi_sol = 0;  ///< [W]
    double phi_vent = 0;              ///< taken from the air node by openings [W]
    /// Of a radiator: to the air node, and radiant [W].
    double phi_convective = 0, phi_radiant = 0;
};
HourDrive hour_drive(const Building& building, const Zone& zone, const Network& network,
                     const Drive& drive, int step);

/// What the openings that follow the room carry when wide open [W/K]. Throws
/// CannotSimulate where it is not a number >= 0.
double venting_conductance(const Zone& zone, const Drive& drive, int step);
/// Heat that they take from the air node (physics::Venting) [W].
/// \param theta_air  of the step before [degC]
double venting_power(const Zone& zone, const Drive& drive, int step, double theta_air);

}  // namespace bemcal::physics
