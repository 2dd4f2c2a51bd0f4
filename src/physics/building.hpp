/// What a modeller knows of a building, in words: constructions, glazings, zones, plant.
///
/// It is plain data. ISO 13790's symbols begin where the standard's equations do
/// (network.hpp). Any input that may change with time is an `Input`; areas and capacities
/// are constants.
#pragma once

#include "physics/quantities.hpp"
#include "physics/radiator.hpp"
#include "physics/sky.hpp"
#include "physics/target.hpp"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace bemcal::physics {

/// How a change enters an input's value (Input::changes).
enum class ChangeKind {
    shift,    ///< added to the value, in its unit
    factor,   ///< the value times 1 + what it brings
    schedule  ///< added to the input's profile
};

/// What an effect brings to an input: amount times a row of Drive::profiles.
struct Change {
    double amount = 0;
    int profile = -1;  ///< row of Drive::profiles
    ChangeKind kind = ChangeKind::shift;
};

/// value(t) = (low + (value - low) (profile(t) + schedule changes)) (1 + factor changes)
/// + shift changes; without a profile, profile(t) = 1. A measured series is a profile
/// with value = 1 and low = 0.
struct Input {
    double value = 0;
    double low = 0;
    int profile = -1;  ///< row of Drive::profiles, or -1
    std::vector<Change> changes{};

    bool is_changed() const { return !changes.empty(); }
    /// Whether it is 0 at all times, but for its changes.
    bool is_off() const { return value == 0 && (profile < 0 || low == 0); }
    /// Whether it is or is changed to anything but 0.
    bool is_anything() const {
        bool any = !is_off();
        for (const Change& change : changes) any |= change.amount != 0;
        return any;
    }
};

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr int outdoors = -1;  ///< boundary index of the outdoor air

struct Layer {  ///< of one material
    std::string name;
    double thickness = 0;      ///< [m]
    double conductivity = 0;   ///< [W/(m K)]
    double density = 0;        ///< [kg/m3]
    double specific_heat = 0;  ///< [J/(kg K)]
};

struct Construction {  ///< of opaque surfaces
    std::string name;
    Input u_value;                      ///< [W/(m2 K)]; follows from layers, if any
    double solar_absorptance = 0.6;     ///< [-]
    double emissivity = 0.9;            ///< long-wave [-]
    double external_resistance = 0.04;  ///< R_se [m2 K/W]
    double internal_resistance = 0.13;  ///< R_si [m2 K/W], with layers
    std::vector<Layer> layers{};        ///< from outside to inside
};

struct Glazing {
    std::string name;
    Input u_value;                  ///< [W/(m2 K)]
    Input solar_transmittance;      ///< total, at normal incidence, g_n [-]
    double incidence_factor = 0.9;  ///< F_w of eq. 44 [-]; 1 where a modifier is given
    double frame_fraction = 0.2;    ///< F_F [-]
    double emissivity = 0.9;
    double external_resistance = 0.04;
    /// Plane::modifier of the windows with this glazing.
    std::vector<double> angle_modifier{};
    double type = 1;  ///< which row of a link's table it is
};

struct Boundary {  ///< a temperature other than that of the outdoor air
    std::string name;
    Input temperature;  ///< [degC]
};

struct Surface {  ///< an opaque element
    std::string name;
    int construction = 0;
    double area = 0;          ///< [m2]
    int boundary = outdoors;  ///< what lies behind it
    double adjustment = 1;    ///< b_tr [-]
    bool in_sun = true;       ///< counts for solar gains and sky loss
    int plane = 0;            ///< row of Building::planes (without a modifier)
    Input shading{1, 0, -1};  ///< F_sh,ob: share of the sun that arrives [-], 1 = all
};

struct Window {
    std::string name;
    int glazing = 0;
    double area = 0;          ///< with frame [m2]
    int plane = 0;            ///< row of Building::planes
    Input shading{1, 0, -1};  ///< F_sh,ob F_sh,gl: share of the sun that arrives [-]
};

struct AirFlow {
    std::string name;
    Input air_change;       ///< [1/h] of the zone's volume
    Input heat_recovery;    ///< efficiency [-]; only without a supply boundary
    int supply = outdoors;  ///< where the air comes from: outdoors or a boundary
};

/// Anything that draws power by the clock: people, lights, equipment, hot water, cooking,
/// fans, a base load. What becomes heat in the zone is ISO 13790's phi_int.
struct Load {
    std::string name;
    Input density;                    ///< [W/m2 of floor]
    double heat_fraction = 1;         ///< share that heats the zone [-]
    Carrier carrier = Carrier::none;  ///< the meter that sees it
    Input efficiency{1, 0, -1};       ///< power on the meter = density / efficiency
};

struct Thermostat {
    Input heating_set_point{20, 0, -1};        ///< [degC]
    Input cooling_set_point{26, 0, -1};        ///< [degC]
    Input heating_capacity{unlimited, 0, -1};  ///< [W/m2 of floor]; 0 = no heating
    Input cooling_capacity{unlimited, 0, -1};  ///< [W/m2 of floor]
    Input heating_available{1, 0, -1};         ///< 0 or 1, times the capacity
    Input cooling_available{1, 0, -1};
    Input room_spread;  ///< by which rooms differ, all told [K]
    /// Of what the room asks for that asks most, what each room gets at least [-].
    Input cooled_together;
    bool imposed = false;  ///< then no set-points: `imposed_power` enters the air node
    Input imposed_power;   ///< [W/m2 of floor], heating positive
    bool rooms_differ() const { return room_spread.is_anything(); }
};

/// Refinements of the standard's one-capacity hour; all off by default (structure.hpp).
struct Structure {
    double air_capacity = 0;           ///< of the air node [J/K per m2 of floor]
    double proportional_band = 0;      ///< of the thermostat [K]; needs finite capacities
    double emitter_time_constant = 0;  ///< of heating [s]
    double emitter_radiant_share = 0;  ///< of heating [-]
    double second_mass_conductance = 0;  ///< H_2 between the masses [W/K per m2 of floor]
    double second_mass_capacity = 0;     ///< C_2 [J/K per m2 of floor]
    /// Running means of the outdoor temperature above which there is no heating, and
    /// below which there is no cooling [degC] (season.hpp).
    double heating_limit = unlimited, cooling_limit = -unlimited;
    bool is_seasonal() const {
        return heating_limit < unlimited || cooling_limit > -unlimited;
    }
    bool any() const {
        return air_capacity > 0 || proportional_band > 0 || emitter_time_constant > 0 ||
               emitter_radiant_share > 0 || second_mass_conductance > 0 || is_seasonal();
    }
};

/// Openings that follow the room: air from outdoors at air_change times clamp((theta -
/// opens_above) / band, 0, 1), theta being the air temperature of the step before, and
/// only while outdoors is cooler than that. It takes rho c V air_change (theta - theta_e)
/// from the air node; theta_e is the weather's, whatever OutdoorShift says.
struct Venting {
    Input air_change;         ///< [1/h] of the zone's volume, wide open; 0 = none
    double opens_above = 24;  ///< [degC]
    double band = 1;          ///< [K] > 0, from shut to wide open
};

/// Where outdoors differs from what the weather says [K].
struct OutdoorShift {
    Input supply;   ///< of air that comes from outdoors
    Input opaque;   ///< behind opaque elements that face outdoors
    Input windows;  ///< at windows
};

/// A zone's heating by a radiator (radiator.hpp) in place of a thermostat: its water is
/// at the heating curve's temperature and flows as that says, or at temperature and flow
/// as they were measured.
struct ZoneRadiator {
    Radiator radiator;
    HeatingCurve curve;
    Input scheduled{1, 0, -1};            ///< > 0.5: hours in which the curve holds
    Input measured{0, 0, -1};             ///< > 0.5: the two below hold, not the curve
    Input supply_temperature{20, 0, -1};  ///< [degC]
    Input flow{1, 0, -1};                 ///< of the radiator's most_flow [-]
};

struct ZoneCoupling {  ///< to another zone, by its air temperature of the last step
    int zone = 0;
    Input conductance;  ///< [W/K], at the air node of both
    Input air_flow;     ///< [m3/h] from that zone into this one
};

/// What lets an economiser open, beside air outdoors that is cooler than the room.
enum class EconomiserLimit { dry_bulb, differential, enthalpy };

/// Air that a fan brings to one or more zones, and what it passes on its way
/// (air_system.hpp). Flows and powers are by floor area, each zone having its part.
struct AirSystem {
    std::string name;
    bool variable = true;  ///< flow by the load with reheat; else constant flow
    EconomiserLimit limited_by = EconomiserLimit::differential;
    Input available{1};            ///< share of the fan that runs [-]; 0 = off
    Input design_flow{15};         ///< largest, of supply air [m3/(h m2)]
    Input fan_power{1.5};          ///< at design_flow [W/(l/s)]
    Input supply_temperature{13};  ///< of air that cools [degC]
    Input outdoor_air_change;      ///< in air from a boundary [1/h of the volume]
    Input people_moisture;         ///< water that people give off [g/(h m2)]
    Input economiser;              ///< largest share of outdoor air [-]; 0 = none
    double least_flow = 0.3;       ///< of design_flow, where it varies [-]
    double fan_exponent = 2.5;     ///< power follows flow to this power [-]
    double fan_heat = 1;           ///< share of the fan's power that warms the air [-]
    double supply_reset = 0;       ///< warmer by this per K below reset_below [K/K]
    double reset_below = 20;       ///< outdoors [degC]
    double most_reset = 5;         ///< [K]
    double bypass_factor = 0.1;    ///< of the cooling coil [-]
    double coil_enthalpy = 0;      ///< of rated air, when on [kJ/kg]; 0 = modulates
    double economiser_limit = 24;  ///< it opens below: outdoor air [degC or kJ/kg]
    double frost_limit = -100;     ///< coldest exhaust air after recovery [degC]
    double least_humidity = 0;     ///< water in the room's air that is kept [g/kg]
};

struct Zone {
    std::string name;
    double floor_area = 0;                   ///< A_f [m2]
    double volume = 0;                       ///< [m3]
    double heat_capacity = 165000;           ///< C_m [J/K per m2 of floor]; class medium
    double mass_area_ratio = 2.5;            ///< A_m / A_f [-]
    double surface_area_ratio = 4.5;         ///< Lambda_at = A_tot / A_f [-]
    double surface_film = 3.45;              ///< h_is [W/(m2 K)]
    double gains_air_share = 0.5;            ///< of internal gains, at the air node [-]
    double sun_air_share = 0;                ///< of solar gains, at the air node [-]
    double mass_film = 9.1;                  ///< h_ms [W/(m2 K)]
    double bridge_conductance = 0;           ///< thermal bridges, to outdoors [W/K]
    double sky_temperature_difference = 11;  ///< Delta theta_er [K]; 0 = no sky loss
    std::vector<Surface> surfaces;
    std::vector<Window> windows;
    std::vector<AirFlow> flows;
    std::vector<Load> loads;
    Thermostat thermostat;
    Structure structure;
    Venting venting;
    OutdoorShift outdoor_shift;
    std::optional<ZoneRadiator> radiator;
    int air_system = -1;   ///< row of Building::air_systems; -1 = none
    int system_flow = -1;  ///< row of flows that it brings; -1 = none
    /// heat_capacity and mass_area_ratio follow from the layers of its surfaces.
    bool capacity_of_layers = false;
    std::vector<ZoneCoupling> couplings;
};

struct Plant {
    Carrier heating_carrier = Carrier::gas;
    Input heating_efficiency{0.9, 0,
                             -1};  ///< heat per energy metered (a COP where electric) [-]
    Carrier cooling_carrier = Carrier::electricity;
    Input cooling_cop{3, 0, -1};  ///< [-]
    /// Electricity of pumps and fans, per heat delivered or removed [-].
    double heating_auxiliary = 0, cooling_auxiliary = 0;
    /// Below its least load per floor area [W/m2] it cycles; C_D of cycling.hpp [-].
    double heating_least_load = 0, cooling_least_load = 0;
    double heating_cycling_loss = 0, cooling_cycling_loss = 0;

    bool cycles() const {
        return (heating_least_load > 0 && heating_cycling_loss > 0) ||
               (cooling_least_load > 0 && cooling_cycling_loss > 0);
    }
};

/// Numbers that follow from others: a polynomial of them, or the row of a table that one
/// of them names.
struct Link {
    struct Term {
        double factor = 0;
        std::vector<int> exponents;  ///< [sources]
    };
    struct Row {
        double key = 0;
        std::vector<double> values;  ///< [targets]
    };
    std::vector<Target> targets, sources;
    std::vector<Term> terms;  ///< of a polynomial, which all targets get
    std::vector<Row> rows;    ///< of a table: the row nearest to the only source holds
};

/// Of an effect that the building has: coefficient x profile is what its inputs gain. It
/// stands in all of its targets.
struct Coefficient {
    std::string name;  ///< of the effect
    std::string unit;
    double least = 0, most = 1;  ///< within which it can be simulated
    std::vector<Target> targets;
    /// The effect that it is a part of, by index: it is scaled as that one is.
    std::optional<std::size_t> part_of = std::nullopt;
};

/// A number that the building's structure has elsewhere: what leads to the one place
/// leads to the other.
struct Moved {
    Target from, to;
};

struct Building {
    std::string name;
    std::vector<Construction> constructions;
    std::vector<Glazing> glazings;
    std::vector<Boundary> boundaries;
    std::vector<Plane> planes;  ///< every distinct plane that a surface or window names
    std::vector<AirSystem> air_systems;
    std::vector<Zone> zones;
    Plant plant;
    std::vector<Link> links;           ///< in the order in which they are followed
    std::vector<Coefficient> effects;  ///< that the description declares
    std::vector<Moved> moved;          ///< by its structure
    /// What a meter shows per what flows through it, by Quantity; of the air temperature
    /// it must stay 1.
    std::array<Input, n_quantities> meter_factor = [] {
        std::array<Input, n_quantities> factors;
        factors.fill(Input{1});
        return factors;
    }();

    double floor_area() const {
        double sum = 0;
        for (const Zone& zone : zones) sum += zone.floor_area;
        return sum;
    }
    bool has_air_systems() const {
        for (const Zone& zone : zones)
            if (zone.air_system >= 0) return true;
        return false;
    }
    /// The row of `plane` in planes, added where it is new.
    int plane_index(const Plane& plane);
};

/// ISO 13790 Table 12: C_m / A_f [J/(K m2)] and A_m / A_f of the five classes.
struct CapacityClass {
    const char* name;
    double heat_capacity, mass_area_ratio;
};
inline constexpr CapacityClass capacity_classes[] = {{"very light", 80000, 2.5},
                                                     {"light", 110000, 2.5},
                                                     {"medium", 165000, 2.5},
                                                     {"heavy", 260000, 3.0},
                                                     {"very heavy", 370000, 3.5}};

}  // namespace bemcal::physics
