/// From adjoints of a zone's network and control to those of the building's numbers.
/// Follows from network.cpp: each sum and product in reverse; an input's adjoint goes to
/// its value, low and changes. Planes' tilts and boundaries' temperatures are not reached
/// here: the first are no parameters, the second belong to regime_adjoint.
#include "adjoint/network_adjoint.hpp"

#include "physics/season.hpp"

#include <cmath>

namespace bemcal::adjoint {

namespace {

double of_boundary(const std::vector<double>& adjoints, int boundary) {
    return adjoints[static_cast<std::size_t>(boundary + 1)];
}

/// Of share_out: from adjoints of the shares, and of their sum, to those of the parts.
void pull_shares(const std::vector<double>& shares, double sum, double of_sum,
                 std::vector<double>& of_shares) {
    if (sum <= 0) {
        of_shares.assign(of_shares.size(), of_sum);
        return;
    }
    double mean = 0;
    for (std::size_t k = 0; k < shares.size(); ++k) mean += shares[k] * of_shares[k];
    for (double& of_share : of_shares) of_share = of_sum + (of_share - mean) / sum;
}

/// 0.5 (1 + cos tilt) 5 Delta theta_er: what an element's R U A epsilon is multiplied by
/// (eq. 46, 51).
double sky_factor(const PlaceBack& place, int plane) {
    const double tilt = place.building.planes[static_cast<std::size_t>(plane)].tilt;
    return 0.5 * (1 + std::cos(tilt)) * 5;
}

/// Adjoints of the factors of a sky loss.
struct SkyBack {
    double external_resistance, u_value, area, emissivity;
};

SkyBack pull_sky(const PlaceBack& place, int plane, const SkyBack& factors,
                 double of_loss) {
    const auto [R, U, A, epsilon] = factors;
    const double delta = place.here().sky_temperature_difference;
    const double per_kelvin = sky_factor(place, plane) * of_loss;
    const double g = per_kelvin * delta;
    place.of_here().sky_temperature_difference += per_kelvin * R * U * A * epsilon;
    return {g * U * A * epsilon, g * R * A * epsilon, g * R * U * epsilon, g * R * U * A};
}

/// The sunlit side of an opaque element: alpha R U A F_sh and the sky loss. Returns the
/// adjoint of the u_value.
double pull_sunlit(const PlaceBack& place, std::size_t index,
                   const physics::Network& of_network) {
    const physics::Surface& surface = place.here().surfaces[index];
    physics::Surface& of_surface = place.of_here().surfaces[index];
    const auto type = static_cast<std::size_t>(surface.construction);
    const physics::Construction& construction = place.building.constructions[type];
    physics::Construction& of_construction = place.of_building.constructions[type];
    const double g = of_network.aperture[static_cast<std::size_t>(surface.plane)];
    const double alpha = construction.solar_absorptance,
                 R = construction.external_resistance, A = surface.area,
                 U = place.at(construction.u_value), F = place.at(surface.shading);
    const SkyBack sky = pull_sky(place, surface.plane, {R, U, A, construction.emissivity},
                                 of_network.phi_sky);
    of_construction.solar_absorptance += g * R * U * A * F;
    of_construction.external_resistance +=
        g * alpha * U * A * F + sky.external_resistance;
    of_construction.emissivity += sky.emissivity;
    of_surface.area += g * alpha * R * U * F + sky.area;
    place.pull(surface.shading, g * alpha * R * U * A, of_surface.shading);
    return g * alpha * R * A * F + sky.u_value;
}

void pull_surface(const PlaceBack& place, std::size_t index,
                  const physics::Network& of_network) {
    const physics::Surface& surface = place.here().surfaces[index];
    physics::Surface& of_surface = place.of_here().surfaces[index];
    const auto type = static_cast<std::size_t>(surface.construction);
    const physics::Input& u_value = place.building.constructions[type].u_value;
    const double U = place.at(u_value);
    const double g = of_boundary(of_network.em_share, surface.boundary);
    of_surface.adjustment += g * U * surface.area;
    of_surface.area += g * surface.adjustment * U;
    double of_u_value = g * surface.adjustment * surface.area;
    if (surface.in_sun && surface.boundary == physics::outdoors)
        of_u_value += pull_sunlit(place, index, of_network);
    place.pull(u_value, of_u_value, place.of_building.constructions[type].u_value);
}

void pull_window(const PlaceBack& place, std::size_t index,
                 const physics::Network& of_network) {
    const physics::Window& window = place.here().windows[index];
    physics::Window& of_window = place.of_here().windows[index];
    const auto type = static_cast<std::size_t>(window.glazing);
    const physics::Glazing& glazing = place.building.glazings[type];
    physics::Glazing& of_glazing = place.of_building.glazings[type];
    const double g = of_network.aperture[static_cast<std::size_t>(window.plane)];
    const double A = window.area, U = place.at(glazing.u_value),
                 g_n = place.at(glazing.solar_transmittance),
                 F_sh = place.at(window.shading), F_w = glazing.incidence_factor,
                 clear = 1 - glazing.frame_fraction;
    const SkyBack sky = pull_sky(place, window.plane,
                                 {glazing.external_resistance, U, A, glazing.emissivity},
                                 of_network.phi_sky);
    of_glazing.external_resistance += sky.external_resistance;
    of_glazing.emissivity += sky.emissivity;
    of_glazing.incidence_factor += g * F_sh * g_n * clear * A;
    of_glazing.frame_fraction -= g * F_sh * F_w * g_n * A;
    of_window.area += of_network.H_tr_w * U + g * F_sh * F_w * g_n * clear + sky.area;
    place.pull(glazing.u_value, of_network.H_tr_w * A + sky.u_value, of_glazing.u_value);
    place.pull(glazing.solar_transmittance, g * F_sh * F_w * clear * A,
               of_glazing.solar_transmittance);
    place.pull(window.shading, g * F_w * g_n * clear * A, of_window.shading);
}

/// rho c b_ve n V / 3600
void pull_flow(const PlaceBack& place, std::size_t index,
               const physics::Network& of_network) {
    const physics::AirFlow& flow = place.here().flows[index];
    physics::AirFlow& of_flow = place.of_here().flows[index];
    const bool recovers = flow.supply == physics::outdoors;
    const double g =
        of_boundary(of_network.ve_share, flow.supply) * physics::rho_c_air / 3600;
    const double b_ve = recovers ? 1 - place.at(flow.heat_recovery) : 1;
    const double n = place.air_change(flow.air_change), V = place.here().volume;
    place.pull_air_change(flow.air_change, g * b_ve * V, of_flow.air_change);
    place.of_here().volume += g * b_ve * n;
    if (recovers) place.pull(flow.heat_recovery, -g * n * V, of_flow.heat_recovery);
}

/// 1 / H_tr_op = 1 / H_tr_em + 1 / H_tr_ms; returns the adjoint of H_tr_op.
double pull_conductance_to_mass(const physics::Network& network,
                                physics::Network& of_network) {
    const double q = network.H_tr_em / network.H_tr_ms;
    of_network.H_tr_ms -= q * q * of_network.H_tr_em;
    return (1 + q) * (1 + q) * of_network.H_tr_em;
}

void pull_elements(const PlaceBack& place, const physics::Network& network,
                   physics::Network& of_network) {
    const double of_H_tr_op = pull_conductance_to_mass(network, of_network);
    const double H_tr_op = network.H_tr_em / (1 + network.H_tr_em / network.H_tr_ms);
    pull_shares(network.em_share, H_tr_op, of_H_tr_op, of_network.em_share);
    pull_shares(network.ve_share, network.H_ve, of_network.H_ve, of_network.ve_share);
    const physics::Zone& zone = place.here();
    place.of_here().bridge_conductance +=
        of_boundary(of_network.em_share, physics::outdoors);
    for (std::size_t k = 0; k < zone.surfaces.size(); ++k)
        pull_surface(place, k, of_network);
    for (std::size_t k = 0; k < zone.windows.size(); ++k)
        pull_window(place, k, of_network);
    for (std::size_t k = 0; k < zone.flows.size(); ++k) pull_flow(place, k, of_network);
}

void pull_structure(const PlaceBack& place, physics::Network& of_network) {
    const physics::Structure& structure = place.here().structure;
    physics::Structure& of = place.of_here().structure;
    const double A_f = place.here().floor_area;
    of.air_capacity += of_network.air_capacity * A_f;
    of.second_mass_conductance += of_network.H_2 * A_f;
    of.second_mass_capacity += of_network.C_2 * A_f;
    of.emitter_time_constant += of_network.tau_emitter;
    of.emitter_radiant_share += of_network.radiant_share;
    of.proportional_band += of_network.band;
    of_network.A_f += of_network.air_capacity * structure.air_capacity +
                      of_network.H_2 * structure.second_mass_conductance +
                      of_network.C_2 * structure.second_mass_capacity;
}

void pull_capacity(const PlaceBack& place, const physics::Network& network,
                   physics::Network& of_network) {
    const physics::Zone& zone = place.here();
    physics::Zone& of = place.of_here();
    of.mass_film += of_network.H_tr_ms * network.A_m;
    of_network.A_m += of_network.H_tr_ms * zone.mass_film;
    of.gains_air_share += of_network.gains_air_share;
    of.sun_air_share += of_network.sun_air_share;
    of.surface_film += of_network.H_tr_is * network.A_tot;
    of_network.A_tot += of_network.H_tr_is * zone.surface_film;
    of.heat_capacity += of_network.C_m * network.A_f;
    of.surface_area_ratio += of_network.A_tot * network.A_f;
    of.mass_area_ratio += of_network.A_m * network.A_f;
    of.floor_area += of_network.A_f + of_network.C_m * zone.heat_capacity +
                     of_network.A_tot * zone.surface_area_ratio +
                     of_network.A_m * zone.mass_area_ratio;
}

/// share times limit times the floor, where both are above 0.
void pull_limit(const PlaceBack& place, double of_limit,
                physics::Input physics::Thermostat::* capacity,
                physics::Input physics::Thermostat::* available) {
    const physics::Thermostat& control = place.here().thermostat;
    physics::Thermostat& of_control = place.of_here().thermostat;
    const double limit = place.at(control.*capacity),
                 share = place.at(control.*available), A_f = place.here().floor_area;
    if (of_limit == 0 || !(share > 0) || !(limit > 0)) return;
    place.pull(control.*capacity, of_limit * share * A_f, of_control.*capacity);
    place.pull(control.*available, of_limit * limit * A_f, of_control.*available);
    place.of_here().floor_area += of_limit * share * limit;
}

/// 1/2 + (limit - theta_rm) / ramp, where that is within 0 and 1.
void pull_season(const PlaceBack& place, const physics::Control& of_control) {
    const physics::Structure& structure = place.here().structure;
    if (!structure.is_seasonal()) return;
    const double theta_rm = place.drive.theta_rm[static_cast<std::size_t>(place.step)];
    const auto slope = [](double share) {
        return share > 0 && share < 1 ? 1 / physics::season_ramp : 0;
    };
    physics::Structure& of = place.of_here().structure;
    of.heating_limit +=
        of_control.heated * slope(physics::heated_share(structure, theta_rm));
    of.cooling_limit -=
        of_control.cooled * slope(physics::cooled_share(structure, theta_rm));
}

}  // namespace

/// (low + span profile) factor + shift
void pull_changed_input(const physics::Input& input, const physics::Drive& drive,
                        int step, double of_value, physics::Input& of_input) {
    const double span = input.value - input.low;
    double profile = input.profile < 0 ? 1 : drive.profile_at(input.profile, step);
    double factor = 1;
    for (const physics::Change& change : input.changes) {
        const double brought = change.amount * drive.profile_at(change.profile, step);
        if (change.kind == physics::ChangeKind::factor) factor += brought;
        if (change.kind == physics::ChangeKind::schedule) profile += brought;
    }
    const double of_base = of_value * factor, base = input.low + span * profile;
    of_input.value += of_base * profile;
    of_input.low += of_base * (1 - profile);
    for (std::size_t k = 0; k < input.changes.size(); ++k) {
        const auto [amount, row, kind] = input.changes[k];
        const double per_amount = kind == physics::ChangeKind::shift    ? of_value
                                  : kind == physics::ChangeKind::factor ? of_value * base
                                                                        : of_base * span;
        of_input.changes[k].amount += per_amount * drive.profile_at(row, step);
    }
}

void clear_adjoints(const physics::Network& network, physics::Network& of_network) {
    std::vector<double> em = std::move(of_network.em_share),
                        ve = std::move(of_network.ve_share),
                        aperture = std::move(of_network.aperture);
    em.assign(network.em_share.size(), 0.0);
    ve.assign(network.ve_share.size(), 0.0);
    aperture.assign(network.aperture.size(), 0.0);
    of_network = {};
    of_network.gains_air_share = 0;  // the one whose default is not
    of_network.em_share = std::move(em);
    of_network.ve_share = std::move(ve);
    of_network.aperture = std::move(aperture);
}

void pull_network(const PlaceBack& place, const physics::Network& network,
                  physics::Network& of_network) {
    pull_elements(place, network, of_network);
    pull_structure(place, of_network);
    pull_capacity(place, network, of_network);
}

void pull_control(const PlaceBack& place, const physics::Control& control,
                  physics::Control of_control) {
    const physics::Thermostat& thermostat = place.here().thermostat;
    physics::Thermostat& of = place.of_here().thermostat;
    if (thermostat.imposed) return;
    if (control.held_apart) {
        of_control.theta_H_set += of_control.theta_C_set;
        place.of_here().structure.proportional_band += of_control.theta_C_set;
        of_control.theta_C_set = 0;
    }
    place.pull(thermostat.heating_set_point, of_control.theta_H_set,
               of.heating_set_point);
    place.pull(thermostat.cooling_set_point, of_control.theta_C_set,
               of.cooling_set_point);
    pull_limit(place, of_control.phi_H_max, &physics::Thermostat::heating_capacity,
               &physics::Thermostat::heating_available);
    pull_limit(place, of_control.phi_C_max, &physics::Thermostat::cooling_capacity,
               &physics::Thermostat::cooling_available);
    place.pull(thermostat.room_spread, of_control.room_spread, of.room_spread);
    place.pull(thermostat.cooled_together, of_control.together, of.cooled_together);
    pull_season(place, of_control);
}

}  // namespace bemcal::adjoint
