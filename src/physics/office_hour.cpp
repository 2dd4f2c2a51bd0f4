/// A box of GFA / (L W) storeys in Guangzhou, one hour by ISO 13790 (hour.hpp).
///
/// Beside OfficeHourAssumptions: walls of emissivity 0.9 lose heat to a sky 11 K colder,
/// thermal class medium, the ground floor adiabatic, no shading, unlimited plant, energy
/// as heat delivered and removed (no COP); theta_prev is the mass temperature before the
/// hour. Inputs are independent, as in the paper: diffuse irradiance may shine at night,
/// the beam may not. The sky is isotropic: full diffuse irradiance with the sun at the
/// horizon lies outside the fit of Perez's sky, which would give a facade tens of kW/m2.
/// DayNum and HourNum are used as they come, fractions included: the hour begins at
/// HourNum of day DayNum, and the sun stands where it is half an hour later.
#include "physics/office_hour.hpp"

#include "base/error.hpp"
#include "base/nan.hpp"
#include "physics/hour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <stdexcept>

namespace bemcal::physics {
namespace {

constexpr OfficeHourInput inputs_of_table_2[] = {
    {"GFA", "m2", 8000, 180000, "gross floor area"},
    {"L", "m", 15, 80, "length of the main facade"},
    {"W", "m", 15, 80, "width of the building"},
    {"h", "m", 3, 3.9, "storey height"},
    {"WWR", "-", 0.2, 0.8, "window share of each facade"},
    {"Orie", "deg", 0, 45,
     "angle between the main facade's normal and south, to the west"},
    {"U_window", "W/(m2 K)", 1, 6, "U-value of the windows"},
    {"U_wall", "W/(m2 K)", 0.6, 1.5, "U-value of the opaque walls"},
    {"U_roof", "W/(m2 K)", 0.6, 1.5, "U-value of the roof"},
    {"Ven_M", "1/h", 0, 6, "air changes by mechanical ventilation"},
    {"DHI", "W/m2", 0, 581, "diffuse horizontal irradiance"},
    {"DNI", "W/m2", 0, 795, "direct normal irradiance"},
    {"theta_ext", "degC", 6, 37, "outdoor air temperature"},
    {"theta_prev", "degC", 12, 35, "room temperature of the last hour"},
    {"theta_H_set", "degC", 18, 22, "heating set-point"},
    {"theta_C_set", "degC", 22, 26.7, "cooling set-point"},
    {"DayNum", "-", 1, 365, "day of the year"},
    {"HourNum", "-", 0, 23, "hour of the day"},
    {"phi_int", "W/m2", 0, 20, "internal heat gain per floor area"},
};
constexpr std::size_t n_inputs = std::size(inputs_of_table_2);

/// The inputs by name, in the table's order.
struct Office {
    double GFA, L, W, h, WWR, orientation, U_window, U_wall, U_roof, ven, DHI, DNI,
        theta_ext, theta_prev, theta_H_set, theta_C_set, day, hour, phi_int;
};

Office office_of(std::span<const double> v) {
    return {v[0],  v[1],  v[2],  v[3],  v[4],  v[5],  v[6],  v[7],  v[8], v[9],
            v[10], v[11], v[12], v[13], v[14], v[15], v[16], v[17], v[18]};
}

constexpr Site guangzhou{23.13, 113.3, 8, 20, 0.2};
constexpr double external_resistance = 0.04, emissivity = 0.9;
constexpr double incidence_factor = 0.9;           ///< F_w of eq. 44
constexpr double sky_temperature_difference = 11;  ///< [K]

struct Face {
    Plane plane;
    double window = 0, opaque = 0;  ///< areas [m2]
    double u_opaque = 0;
};

/// Main facade (normal at `orientation` from south), the other three clockwise, and the
/// roof.
std::array<Face, 5> faces_of(const Office& office) {
    const double height = office.h * office.GFA / (office.L * office.W);
    std::array<Face, 5> faces;
    for (std::size_t side = 0; side < 4; ++side) {
        const double area = (side % 2 == 0 ? office.L : office.W) * height;
        const double azimuth = 180 + office.orientation + 90 * static_cast<double>(side);
        faces[side] = {Plane{90 * deg, azimuth * deg, {}}, office.WWR * area,
                       (1 - office.WWR) * area, office.U_wall};
    }
    faces[4] = {Plane{0, 0, {}}, 0, office.L * office.W, office.U_roof};
    return faces;
}

SunPosition sun_of(const Office& office) {
    using namespace std::chrono;
    constexpr sys_days new_year = sys_days{year{2021} / January / 1};
    const double hours = 24 * (office.day - 1) + office.hour + 0.5;
    return sun_position(guangzhou, new_year + seconds(std::llround(3600 * hours)));
}

double irradiance_on_face(const Office& office, const SunPosition& sun,
                          const Plane& plane) {
    const double up = std::cos(sun.zenith);
    const double beam = up > 0 ? office.DNI : 0;
    return irradiance_on(plane, sun, beam, office.DHI,
                         office.DHI + beam * std::max(up, 0.0), guangzhou.albedo,
                         SkyModel::isotropic)
        .total();
}

/// Solar gains less the loss to the sky [W] (ISO 13790 eq. 41 to 46).
double solar_gains(const Office& office, const std::array<Face, 5>& faces,
                   const OfficeHourAssumptions& assumed) {
    const SunPosition sun = sun_of(office);
    double gains = 0;
    for (const Face& face : faces) {
        const double wall = external_resistance * face.u_opaque * face.opaque;
        const double glass = external_resistance * office.U_window * face.window;
        const double aperture = incidence_factor * assumed.g_value *
                                    (1 - assumed.frame_fraction) * face.window +
                                assumed.solar_absorptance * wall;
        const double sky_view = 0.5 * (1 + std::cos(face.plane.tilt));
        const double to_sky =
            sky_view * 5 * emissivity * sky_temperature_difference * (wall + glass);
        gains += aperture * irradiance_on_face(office, sun, face.plane) - to_sky;
    }
    return gains;
}

Network network_of(const Office& office, const std::array<Face, 5>& faces,
                   const OfficeHourAssumptions& assumed) {
    Network n;
    n.A_f = office.GFA;
    n.A_m = 2.5 * n.A_f;
    n.A_tot = 4.5 * n.A_f;
    n.C_m = 165000 * n.A_f;
    double H_op = 0;
    for (const Face& face : faces) {
        H_op += face.u_opaque * face.opaque;
        n.H_tr_w += office.U_window * face.window;
    }
    n.H_tr_ms = 9.1 * n.A_m;
    n.H_tr_em = 1 / (1 / H_op - 1 / n.H_tr_ms);
    n.H_tr_is = 3.45 * n.A_tot;
    n.H_ve = (1 - assumed.heat_recovery) * rho_c_air / 3600 * office.ven * office.GFA *
             office.h;
    return n;
}

/// At least one storey, and the walls within the method (H_op < H_ms).
bool is_possible(const Office& office, const Network& network) {
    return office.GFA >= office.L * office.W && network.H_tr_em > 0 &&
           office.theta_H_set <= office.theta_C_set;
}

}  // namespace

std::span<const OfficeHourInput> office_hour_inputs() {
    return inputs_of_table_2;
}

std::size_t office_hour_input_number(const std::string& name) {
    const auto* found = std::ranges::find_if(
        inputs_of_table_2,
        [&](const OfficeHourInput& input) { return input.name == name; });
    if (found == std::end(inputs_of_table_2))
        throw std::invalid_argument("no input of the office hour is called " + name);
    return static_cast<std::size_t>(found - std::begin(inputs_of_table_2));
}

double office_hour_energy(std::span<const double> inputs,
                          const OfficeHourAssumptions& assumed) {
    require(inputs.size() == n_inputs, "the office hour takes 19 inputs");
    const Office office = office_of(inputs);
    const auto faces = faces_of(office);
    const Network network = network_of(office, faces, assumed);
    if (!is_possible(office, network)) return nan;
    HourDrive drive;
    drive.theta_e = drive.theta_em = drive.theta_sup = office.theta_ext;
    drive.phi_int = office.phi_int * office.GFA;
    drive.phi_sol = solar_gains(office, faces, assumed);
    Control control;
    control.theta_H_set = office.theta_H_set;
    control.theta_C_set = office.theta_C_set;
    const NodeGains gains = split_gains(network, drive.phi_int, drive.phi_sol);
    return std::abs(
               power_for_set_point(network, drive, gains, control, office.theta_prev)) /
           1000;
}

}  // namespace bemcal::physics
