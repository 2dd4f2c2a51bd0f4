/// A zone in the standard's symbols at one step: conductances summed over elements, each
/// by the boundary behind it; apertures, sky loss, set-points, gains.
/// Source: ISO 13790:2008, 7.2.2, 8.3, 9.3, 11.3, 11.4, 12.2.2. Left out: unheated spaces
/// other than by b_tr, movable shading by the sun's position, temperatures (hour).
#include "physics/network.hpp"

#include "base/error.hpp"
#include "physics/season.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::physics {

namespace {

[[noreturn]] void reject(const Zone& zone, int step, const std::string& what) {
    throw CannotSimulate(fmt::format("zone {}, step {}: {}", zone.name, step, what));
}

/// Everything that the sums below read.
struct Place {
    const Building& building;
    const Zone& zone;
    const Drive& drive;
    int step;
    double at(const Input& input) const { return drive.at(input, step); }
};

double not_negative(const Place& place, double value, const char* what) {
    if (!(value >= 0) || !std::isfinite(value))
        reject(place.zone, place.step,
               fmt::format("{} = {} is not a number >= 0", what, value));
    return value;
}

double positive(const Place& place, double value, const char* what) {
    if (!(value > 0) || !std::isfinite(value))
        reject(place.zone, place.step,
               fmt::format("{} = {} is not a number > 0", what, value));
    return value;
}

/// Share of the sky that a plane sees: the standard's 1 (flat) and 0.5 (vertical)
/// (11.3.2).
double form_factor(double tilt) {
    return 0.5 * (1 + std::cos(tilt));
}

/// Phi_r F_r of an element [W] (eq. 46), with h_r = 5 epsilon (eq. 51 at about 10 degC).
double sky_loss(const Place& place, double external_resistance, double u_value,
                double area, double emissivity, int plane) {
    const double tilt = place.building.planes[static_cast<std::size_t>(plane)].tilt;
    return form_factor(tilt) * external_resistance * u_value * area * 5 * emissivity *
           place.zone.sky_temperature_difference;
}

/// Starts a boundary table: n_boundaries + 1 zeros.
void clear(std::vector<double>& shares, const Building& building) {
    shares.assign(building.boundaries.size() + 1, 0.0);
}

double& of_boundary(std::vector<double>& shares, int boundary) {
    return shares[static_cast<std::size_t>(boundary + 1)];
}

/// Turns conductances by boundary into shares of their sum; returns the sum.
double share_out(std::vector<double>& shares) {
    double sum = 0;
    for (double share : shares) sum += share;
    if (sum > 0)
        for (double& share : shares) share /= sum;
    else
        shares[0] = 1;
    return sum;
}

/// b_tr U A of the opaque elements (8.3) into em_share; their apertures (eq. 45), sky
/// loss.
void add_surface(const Place& place, const Surface& surface, Network& network) {
    const Construction& construction =
        place.building.constructions[static_cast<std::size_t>(surface.construction)];
    const double area = not_negative(place, surface.area, "area of a surface");
    const double u_value = not_negative(place, place.at(construction.u_value), "u_value");
    const double b_tr = not_negative(place, surface.adjustment, "adjustment");
    of_boundary(network.em_share, surface.boundary) += b_tr * u_value * area;
    if (!surface.in_sun || surface.boundary != outdoors) return;
    network.aperture[static_cast<std::size_t>(surface.plane)] +=
        construction.solar_absorptance * construction.external_resistance * u_value *
        area * place.at(surface.shading);
    network.phi_sky += sky_loss(place, construction.external_resistance, u_value, area,
                                construction.emissivity, surface.plane);
}

/// H_tr_w, the glazed aperture F_sh g_gl (1 - F_F) A with g_gl = F_w g_n (eq. 44, 47),
/// sky loss.
void add_window(const Place& place, const Window& window, Network& network) {
    const Glazing& glazing =
        place.building.glazings[static_cast<std::size_t>(window.glazing)];
    const double area = not_negative(place, window.area, "area of a window");
    const double u_value = not_negative(place, place.at(glazing.u_value), "u_value");
    const double g_gl = glazing.incidence_factor * place.at(glazing.solar_transmittance);
    network.H_tr_w += u_value * area;
    network.aperture[static_cast<std::size_t>(window.plane)] +=
        place.at(window.shading) * g_gl * (1 - glazing.frame_fraction) * area;
    network.phi_sky += sky_loss(place, glazing.external_resistance, u_value, area,
                                glazing.emissivity, window.plane);
}

/// rho c b_ve q_ve (eq. 21), b_ve = 1 - eta where heat is recovered (eq. 27); with a
/// supply temperature of its own b_ve = 1.
void add_flow(const Place& place, const AirFlow& flow, Network& network) {
    const double q = air_change_at(place.drive, flow.air_change, place.step) *
                     place.zone.volume / 3600;
    const double b_ve = flow.supply == outdoors ? 1 - place.at(flow.heat_recovery) : 1;
    of_boundary(network.ve_share, flow.supply) +=
        not_negative(place, rho_c_air * b_ve * q, "heat carried by an air flow");
}

/// Areas and classes (7.2.2.2, 12.2.2) and the films (eq. 9, 64).
void set_capacity(const Place& place, Network& network) {
    const Zone& zone = place.zone;
    network.A_f = positive(place, zone.floor_area, "floor_area");
    network.A_m = positive(place, zone.mass_area_ratio, "mass_area_ratio") * network.A_f;
    network.A_tot =
        positive(place, zone.surface_area_ratio, "surface_area_ratio") * network.A_f;
    network.C_m = positive(place, zone.heat_capacity, "heat_capacity") * network.A_f;
    network.H_tr_is = positive(place, zone.surface_film, "surface_film") * network.A_tot;
    network.H_tr_ms = positive(place, zone.mass_film, "mass_film") * network.A_m;
    network.gains_air_share =
        not_negative(place, zone.gains_air_share, "gains_air_share");
    network.sun_air_share = not_negative(place, zone.sun_air_share, "sun_air_share");
}

void set_structure(const Place& place, Network& network) {
    const Structure& structure = place.zone.structure;
    const double A_f = network.A_f;
    network.air_capacity =
        not_negative(place, structure.air_capacity, "air_capacity") * A_f;
    network.H_2 = not_negative(place, structure.second_mass_conductance,
                               "second_mass_conductance") *
                  A_f;
    network.C_2 =
        not_negative(place, structure.second_mass_capacity, "second_mass_capacity") * A_f;
    network.tau_emitter =
        not_negative(place, structure.emitter_time_constant, "emitter_time_constant");
    network.radiant_share =
        not_negative(place, structure.emitter_radiant_share, "emitter_radiant_share");
    network.band = not_negative(place, structure.proportional_band, "proportional_band");
}

void add_elements(const Place& place, Network& network) {
    clear(network.em_share, place.building);
    network.aperture.assign(place.building.planes.size(), 0.0);
    network.H_tr_w = network.phi_sky = 0;
    for (const Surface& surface : place.zone.surfaces)
        add_surface(place, surface, network);
    for (const Window& window : place.zone.windows) add_window(place, window, network);
}

/// H_tr_em in series with H_tr_ms makes H_tr_op (eq. 63): 1 / (1 / H_tr_op - 1 /
/// H_tr_ms).
double conductance_to_mass(const Place& place, double H_tr_op, double H_tr_ms) {
    if (!(H_tr_op < H_tr_ms))
        reject(
            place.zone, place.step,
            fmt::format("transmission of the opaque elements H_tr_op = {:.6g} W/K is not "
                        "below H_tr_ms = {:.6g} W/K, the film of the mass: smaller "
                        "u_values or areas, or a larger mass_area_ratio, are needed",
                        H_tr_op, H_tr_ms));
    return H_tr_op * H_tr_ms / (H_tr_ms - H_tr_op);
}

/// \param shift  of the outdoor air
double weighted(const Building& building, const Drive& drive, int step,
                const std::vector<double>& shares, const Input& shift) {
    double theta = shares[0] * (drive.theta_e[static_cast<std::size_t>(step)] +
                                drive.at(shift, step));
    for (std::size_t b = 0; b < building.boundaries.size(); ++b)
        if (shares[b + 1] != 0)
            theta += shares[b + 1] * drive.at(building.boundaries[b].temperature, step);
    return theta;
}

double capacity_at(const Zone& zone, const Drive& drive, int step, const Input& capacity,
                   const Input& available) {
    const double share = drive.at(available, step);
    const double limit = drive.at(capacity, step);
    return share > 0 && limit > 0 ? share * limit * zone.floor_area : 0;
}

double spread_at(const Zone& zone, const Drive& drive, int step) {
    const double spread = drive.at(zone.thermostat.room_spread, step);
    if (!(spread >= 0) || !std::isfinite(spread))
        reject(zone, step, fmt::format("room_spread = {:.6g} K is not >= 0", spread));
    return spread;
}

double together_at(const Zone& zone, const Drive& drive, int step) {
    const double share = drive.at(zone.thermostat.cooled_together, step);
    if (!(share >= 0 && share <= 1))
        reject(zone, step, fmt::format("cooled_together = {:.6g} is not a share", share));
    return share;
}

/// Whether an effect moves a set-point.
bool is_moved(const Thermostat& thermostat) {
    return thermostat.heating_set_point.is_changed() ||
           thermostat.cooling_set_point.is_changed();
}

/// Where both work, at least the band is between their set-points.
void hold_apart(const Zone& zone, int step, Control& control) {
    if (control.phi_H_max <= 0 || control.phi_C_max <= 0) return;
    const double gap = control.theta_C_set - control.theta_H_set;
    if (gap >= zone.structure.proportional_band) return;
    if (std::isnan(gap) || !is_moved(zone.thermostat))
        reject(zone, step,
               fmt::format(
                   "heating_set_point = {:.6g} degC and cooling_set_point = {:.6g} "
                   "degC cross, or lie closer than the proportional_band of {:.6g} K",
                   control.theta_H_set, control.theta_C_set,
                   zone.structure.proportional_band));
    control.held_apart = true;
    control.theta_C_set = control.theta_H_set + zone.structure.proportional_band;
}

}  // namespace

void reject_ringing(const Zone& zone, int step, const Network& network, double dt) {
    const double H_1 = network.H_tr_is * network.H_ve / (network.H_tr_is + network.H_ve);
    const double H_2 = H_1 + network.H_tr_w;
    const double H_3 = H_2 * network.H_tr_ms / (H_2 + network.H_tr_ms);
    const double H_mass = 0.5 * (H_3 + network.H_tr_em + network.H_2);
    if (!(network.C_m / dt >= H_mass))
        reject(zone, step,
               fmt::format(
                   "the mass would ring: C_m / dt = {:.6g} W/K is below half of what "
                   "is tied to it, {:.6g} W/K: a larger heat_capacity or a shorter "
                   "step is needed",
                   network.C_m / dt, H_mass));
    if (!(network.C_2 / dt >= 0.5 * network.H_2))
        reject(
            zone, step,
            fmt::format("the second mass would ring: its capacity / dt = {:.6g} W/K is "
                        "below half of second_mass_conductance, {:.6g} W/K",
                        network.C_2 / dt, 0.5 * network.H_2));
}

void make_network(const Building& building, const Zone& zone, const Drive& drive,
                  int step, Network& network) {
    make_elements(building, zone, drive, step, network);
    make_air_flows(building, zone, drive, step, network);
}

void make_elements(const Building& building, const Zone& zone, const Drive& drive,
                   int step, Network& network) {
    const Place place{building, zone, drive, step};
    set_capacity(place, network);
    set_structure(place, network);
    positive(place, zone.venting.band, "venting_band");
    add_elements(place, network);
    of_boundary(network.em_share, outdoors) += zone.bridge_conductance;
    const double H_tr_op = not_negative(place, share_out(network.em_share), "H_tr_op");
    network.H_tr_em = conductance_to_mass(place, H_tr_op, network.H_tr_ms);
}

void make_air_flows(const Building& building, const Zone& zone, const Drive& drive,
                    int step, Network& network) {
    const Place place{building, zone, drive, step};
    clear(network.ve_share, building);
    for (const AirFlow& flow : zone.flows) add_flow(place, flow, network);
    network.H_ve = not_negative(place, share_out(network.ve_share), "H_ve");
    reject_ringing(zone, step, network, drive.axis.step_s);
}

Control control_at(const Zone& zone, const Drive& drive, int step) {
    const Thermostat& thermostat = zone.thermostat;
    Control control;
    control.imposed = thermostat.imposed;
    if (control.imposed) {
        control.phi_imposed = drive.at(thermostat.imposed_power, step) * zone.floor_area;
        return control;
    }
    control.theta_H_set = drive.at(thermostat.heating_set_point, step);
    control.theta_C_set = drive.at(thermostat.cooling_set_point, step);
    if (zone.radiator)
        control.phi_H_max = 0;
    else
        control.phi_H_max = capacity_at(zone, drive, step, thermostat.heating_capacity,
                                        thermostat.heating_available);
    control.phi_C_max = capacity_at(zone, drive, step, thermostat.cooling_capacity,
                                    thermostat.cooling_available);
    control.room_spread = spread_at(zone, drive, step);
    control.together = together_at(zone, drive, step);
    hold_apart(zone, step, control);
    if (zone.structure.is_seasonal()) {
        const double theta_rm = drive.theta_rm[static_cast<std::size_t>(step)];
        control.heated = heated_share(zone.structure, theta_rm);
        control.cooled = cooled_share(zone.structure, theta_rm);
    }
    return control;
}

HourDrive hour_drive(const Building& building, const Zone& zone, const Network& network,
                     const Drive& drive, int step) {
    HourDrive hour;
    const OutdoorShift& shift = zone.outdoor_shift;
    hour.theta_e =
        drive.theta_e[static_cast<std::size_t>(step)] + drive.at(shift.windows, step);
    hour.theta_em = weighted(building, drive, step, network.em_share, shift.opaque);
    hour.theta_sup = weighted(building, drive, step, network.ve_share, shift.supply);
    for (const Load& load : zone.loads)
        hour.phi_int += network.A_f * drive.at(load.density, step) * load.heat_fraction;
    for (std::size_t plane = 0; plane < network.aperture.size(); ++plane)
        if (network.aperture[plane] != 0)
            hour.phi_sol += network.aperture[plane] *
                            drive.irradiance(plane, static_cast<std::size_t>(step));
    hour.phi_sol -= network.phi_sky;
    return hour;
}

double venting_conductance(const Zone& zone, const Drive& drive, int step) {
    const double n = air_change_at(drive, zone.venting.air_change, step);
    if (!(n >= 0) || !std::isfinite(n))
        reject(zone, step,
               fmt::format("venting_air_change = {} is not a number >= 0", n));
    return rho_c_air * zone.volume * n / 3600;
}

double venting_power(const Zone& zone, const Drive& drive, int step, double theta_air) {
    const double theta_e = drive.theta_e[static_cast<std::size_t>(step)];
    const double H = venting_conductance(zone, drive, step);
    if (!(H > 0) || !(theta_air > theta_e)) return 0;
    const Venting& venting = zone.venting;
    const double open =
        std::clamp((theta_air - venting.opens_above) / venting.band, 0.0, 1.0);
    return H * open * (theta_air - theta_e);
}

}  // namespace bemcal::physics
