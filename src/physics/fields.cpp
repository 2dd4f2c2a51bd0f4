/// The table of a building's numbers: key, unit, default, range, sentence, and where it
/// lies.
/// Source of defaults: ISO 13790:2008 where it has them (h_is 3.45, h_ms 9.1, Lambda_at
/// 4.5, F_w 0.9, class medium). Only numbers are here: names, carriers, lists and
/// switches are left to the job's reader.
#include "physics/fields.hpp"

#include "base/nan.hpp"

namespace bemcal::physics {

namespace {

constexpr double required = nan;

template <class Owner, class Value>
Owner owner_of(Value Owner::*);

/// The member at the end of a chain of members, of a part behind a void pointer.
template <auto first, auto... rest>
auto* reach(void* part) {
    using Owner = decltype(owner_of(first));
    return &((static_cast<Owner*>(part)->*first).*....*rest);
}

/// Wraps a chain of members as the table's accessors.
struct Access {
    Input* (*input)(void* part) = nullptr;
    double* (*constant)(void* part) = nullptr;
};

template <auto... members>
constexpr Access input() {
    return {[](void* part) -> Input* { return reach<members...>(part); }, nullptr};
}

template <auto... members>
constexpr Access constant() {
    return {nullptr, [](void* part) -> double* { return reach<members...>(part); }};
}

constexpr Field row(Part part, const char* key, const char* unit, double fallback,
                    double least, double most, const char* sentence, Access access) {
    return {part, key,      unit,         fallback,       least,
            most, sentence, access.input, access.constant};
}

template <auto member>
constexpr Access of_thermostat() {
    return input<&Zone::thermostat, member>();
}

template <auto member>
constexpr Access of_structure() {
    return constant<&Zone::structure, member>();
}

template <auto member>
constexpr Access of_outdoor_shift() {
    return input<&Zone::outdoor_shift, member>();
}

template <auto member>
constexpr Access of_radiator() {
    return constant<&ZoneRadiator::radiator, member>();
}

template <auto member>
constexpr Access of_curve() {
    return constant<&ZoneRadiator::curve, member>();
}

/// The part is the input.
constexpr Access itself() {
    return {[](void* part) { return static_cast<Input*>(part); }, nullptr};
}

// clang-format off
constexpr Field table[] = {
    row(Part::construction, "u_value", "W/(m2 K)", required, 0, 10,
        "thermal transmittance, films included", input<&Construction::u_value>()),
    row(Part::construction, "solar_absorptance", "-", 0.6, 0, 1,
        "share of the sun that the outer face absorbs", constant<&Construction::solar_absorptance>()),
    row(Part::construction, "emissivity", "-", 0.9, 0, 1,
        "long-wave emissivity of the outer face", constant<&Construction::emissivity>()),
    row(Part::construction, "external_resistance", "m2 K/W", 0.04, 0, 1,
        "resistance of the outer film, R_se", constant<&Construction::external_resistance>()),

    row(Part::construction, "internal_resistance", "m2 K/W", 0.13, 0, 1,
        "with layers: resistance of the inner film, R_si", constant<&Construction::internal_resistance>()),

    row(Part::layer, "thickness", "m", required, 1e-4, 10,
        "of the layer", constant<&Layer::thickness>()),
    row(Part::layer, "conductivity", "W/(m K)", required, 1e-3, 500,
        "thermal conductivity, lambda", constant<&Layer::conductivity>()),
    row(Part::layer, "density", "kg/m3", required, 1, 20000,
        "density, rho", constant<&Layer::density>()),
    row(Part::layer, "specific_heat", "J/(kg K)", required, 100, 10000,
        "specific heat capacity, c", constant<&Layer::specific_heat>()),

    row(Part::glazing, "u_value", "W/(m2 K)", required, 0, 10,
        "thermal transmittance of the window, frame included", input<&Glazing::u_value>()),
    row(Part::glazing, "solar_transmittance", "-", required, 0, 1,
        "total solar energy transmittance at normal incidence, g_n", input<&Glazing::solar_transmittance>()),
    row(Part::glazing, "incidence_factor", "-", 0.9, 0, 1,
        "correction of g_n for non-normal sun, F_w; 1 where an angle modifier is given", constant<&Glazing::incidence_factor>()),
    row(Part::glazing, "frame_fraction", "-", 0.2, 0, 1,
        "share of the window's area that is frame, F_F", constant<&Glazing::frame_fraction>()),
    row(Part::glazing, "emissivity", "-", 0.9, 0, 1,
        "long-wave emissivity of the outer face", constant<&Glazing::emissivity>()),
    row(Part::glazing, "external_resistance", "m2 K/W", 0.04, 0, 1,
        "resistance of the outer film, R_se", constant<&Glazing::external_resistance>()),
    row(Part::glazing, "type", "-", 1, 0, 1000,
        "the row of a link's table that holds", constant<&Glazing::type>()),

    row(Part::boundary, "temperature", "degC", required, -60, 80,
        "temperature behind the elements that name this boundary", input<&Boundary::temperature>()),

    row(Part::zone, "floor_area", "m2", required, 0.1, 1e7,
        "conditioned floor area, A_f", constant<&Zone::floor_area>()),
    row(Part::zone, "volume", "m3", required, 0.1, 1e8,
        "volume of air that an air change refers to", constant<&Zone::volume>()),
    row(Part::zone, "heat_capacity", "J/(m2 K)", 165000, 1000, 2e6,
        "internal heat capacity per floor area, C_m / A_f", constant<&Zone::heat_capacity>()),
    row(Part::zone, "mass_area_ratio", "-", 2.5, 0.1, 10,
        "effective mass area per floor area, A_m / A_f", constant<&Zone::mass_area_ratio>()),
    row(Part::zone, "surface_area_ratio", "-", 4.5, 0.5, 20,
        "area of all surfaces that face the zone per floor area, Lambda_at", constant<&Zone::surface_area_ratio>()),
    row(Part::zone, "surface_film", "W/(m2 K)", 3.45, 0.1, 20,
        "heat transfer between air and surface node, h_is", constant<&Zone::surface_film>()),
    row(Part::zone, "gains_air_share", "-", 0.5, 0, 1,
        "share of the internal gains that heats the air at once; the rest is radiant", constant<&Zone::gains_air_share>()),
    row(Part::zone, "sun_air_share", "-", 0, 0, 1,
        "share of the solar gains that heats the air at once; the rest is radiant", constant<&Zone::sun_air_share>()),
    row(Part::zone, "mass_film", "W/(m2 K)", 9.1, 0.1, 50,
        "heat transfer between mass and surface node, h_ms", constant<&Zone::mass_film>()),
    row(Part::zone, "bridge_conductance", "W/K", 0, 0, 1e6,
        "thermal bridges to outdoors", constant<&Zone::bridge_conductance>()),
    row(Part::zone, "sky_temperature_difference", "K", 11, 0, 30,
        "outdoor air minus apparent sky, Delta theta_er; 0 = no long-wave loss to the sky", constant<&Zone::sky_temperature_difference>()),
    row(Part::zone, "heating_set_point", "degC", 20, -50, 100,
        "air temperature below which heating works", of_thermostat<&Thermostat::heating_set_point>()),
    row(Part::zone, "cooling_set_point", "degC", 26, -50, 100,
        "air temperature above which cooling works", of_thermostat<&Thermostat::cooling_set_point>()),
    row(Part::zone, "heating_capacity", "W/m2", unlimited, 0, unlimited,
        "largest heating power per floor area; 0 = no heating", of_thermostat<&Thermostat::heating_capacity>()),
    row(Part::zone, "cooling_capacity", "W/m2", unlimited, 0, unlimited,
        "largest cooling power per floor area; 0 = no cooling", of_thermostat<&Thermostat::cooling_capacity>()),
    row(Part::zone, "heating_available", "-", 1, 0, 1,
        "share of the heating capacity that is there; 0 = off", of_thermostat<&Thermostat::heating_available>()),
    row(Part::zone, "cooling_available", "-", 1, 0, 1,
        "share of the cooling capacity that is there; 0 = off", of_thermostat<&Thermostat::cooling_available>()),
    row(Part::zone, "cooled_together", "-", 0, 0, 1,
        "of the cooling of the room that asks most (room_spread), what every room gets: one unit that any room turns on", of_thermostat<&Thermostat::cooled_together>()),
    row(Part::zone, "imposed_power", "W/m2", 0, -10000, 10000,
        "heating (negative: cooling) power per floor area, in place of a thermostat", of_thermostat<&Thermostat::imposed_power>()),
    row(Part::zone, "air_capacity", "J/(m2 K)", 0, 0, 1e6,
        "heat capacity of air and furniture at the air node per floor area", of_structure<&Structure::air_capacity>()),
    row(Part::zone, "proportional_band", "K", 0, 0, 20,
        "temperature span over which the thermostat goes from none to all of its capacity", of_structure<&Structure::proportional_band>()),
    row(Part::zone, "room_spread", "K", 0, 0, 20,
        "from the coldest to the warmest room where nothing heats or cools; each asks for itself", of_thermostat<&Thermostat::room_spread>()),
    row(Part::zone, "emitter_time_constant", "s", 0, 0, 1e6,
        "first-order lag between heating power and heat in the zone", of_structure<&Structure::emitter_time_constant>()),
    row(Part::zone, "emitter_radiant_share", "-", 0, 0, 1,
        "share of the heating that leaves the emitter as radiation", of_structure<&Structure::emitter_radiant_share>()),
    row(Part::zone, "second_mass_conductance", "W/(m2 K)", 0, 0, 100,
        "conductance between the mass and a second mass per floor area", of_structure<&Structure::second_mass_conductance>()),
    row(Part::zone, "second_mass_capacity", "J/(m2 K)", 0, 0, 1e8,
        "heat capacity of the second mass per floor area", of_structure<&Structure::second_mass_capacity>()),
    row(Part::zone, "heating_limit", "degC", unlimited, -50, unlimited,
        "heating stops where the running mean of the outdoor temperature is above it; inf = never", of_structure<&Structure::heating_limit>()),
    row(Part::zone, "cooling_limit", "degC", -unlimited, -unlimited, 50,
        "cooling stops where the running mean of the outdoor temperature is below it; -inf = never", of_structure<&Structure::cooling_limit>()),
    row(Part::zone, "venting_air_change", "1/h", 0, 0, 50,
        "air from outdoors through openings that follow the room, wide open", input<&Zone::venting, &Venting::air_change>()),
    row(Part::zone, "venting_opens_above", "degC", 24, -50, 100,
        "air temperature above which these openings open", constant<&Zone::venting, &Venting::opens_above>()),
    row(Part::zone, "venting_band", "K", 1, 0.01, 50,
        "temperature span over which they go from shut to wide open", constant<&Zone::venting, &Venting::band>()),
    row(Part::zone, "supply_shift", "K", 0, -30, 30,
        "air that comes from outdoors minus the weather's air temperature", of_outdoor_shift<&OutdoorShift::supply>()),
    row(Part::zone, "opaque_shift", "K", 0, -30, 30,
        "outdoors behind opaque elements minus the weather's air temperature", of_outdoor_shift<&OutdoorShift::opaque>()),
    row(Part::zone, "window_shift", "K", 0, -30, 30,
        "outdoors at windows minus the weather's air temperature", of_outdoor_shift<&OutdoorShift::windows>()),

    row(Part::radiator, "nominal_power", "W", required, 1, 1e7,
        "heat given off at 60 K above the room", of_radiator<&Radiator::power_60>()),
    row(Part::radiator, "exponent", "-", 1.3, 1, 2,
        "of the temperature above the room, n", of_radiator<&Radiator::exponent>()),
    row(Part::radiator, "heat_capacity", "J/K", required, 100, 1e8,
        "of its water and metal", of_radiator<&Radiator::capacity>()),
    row(Part::radiator, "radiative_fraction", "-", 0.3, 0, 1,
        "share of the heat that leaves it as radiation", of_radiator<&Radiator::radiative_fraction>()),
    row(Part::radiator, "maximum_flow", "kg/s", required, 1e-5, 1000,
        "water through it while the heating is on", of_radiator<&Radiator::most_flow>()),
    row(Part::radiator, "curve_a", "K/K", -1.1, -10, 10,
        "supply temperature = a theta_e + b below curve_limit", of_curve<&HeatingCurve::a>()),
    row(Part::radiator, "curve_b", "degC", 54, 0, 150,
        "supply temperature = a theta_e + b below curve_limit", of_curve<&HeatingCurve::b>()),
    row(Part::radiator, "curve_c", "degC", 43, 0, 150,
        "supply temperature above curve_limit", of_curve<&HeatingCurve::c>()),
    row(Part::radiator, "curve_d", "degC", 22, 0, 150,
        "supply temperature outside the schedule, while the room is colder than set_back_below", of_curve<&HeatingCurve::d>()),
    row(Part::radiator, "curve_limit", "degC", 10, -50, 50,
        "outdoor temperature at which a and b end and c begins", of_curve<&HeatingCurve::limit>()),
    row(Part::radiator, "set_back_below", "degC", 14, -50, 50,
        "air temperature below which the heating is on outside the schedule", of_curve<&HeatingCurve::set_back>()),
    row(Part::radiator, "scheduled", "-", 1, 0, 1,
        "1 = the heating is on and the curve holds; 0 = set-back", input<&ZoneRadiator::scheduled>()),
    row(Part::radiator, "supply_measured", "-", 0, 0, 1,
        "1 = supply_temperature and flow hold, 0 = the curve; default: 1 where supply_temperature is given", input<&ZoneRadiator::measured>()),
    row(Part::radiator, "supply_temperature", "degC", 20, -20, 150,
        "of the water that flows in, as measured", input<&ZoneRadiator::supply_temperature>()),
    row(Part::radiator, "flow", "-", 1, 0, 1,
        "share of maximum_flow that flows with supply_temperature", input<&ZoneRadiator::flow>()),

    row(Part::surface, "area", "m2", required, 0, 1e7,
        "area without windows", constant<&Surface::area>()),
    row(Part::surface, "adjustment", "-", 1, 0, 2,
        "temperature adjustment factor, b_tr", constant<&Surface::adjustment>()),
    row(Part::surface, "shading_factor", "-", 1, 0, 1,
        "share of the sun that arrives, F_sh; 1 = unshaded", input<&Surface::shading>()),

    row(Part::window, "area", "m2", required, 0, 1e7,
        "area with frame", constant<&Window::area>()),
    row(Part::window, "shading_factor", "-", 1, 0, 1,
        "share of the sun that arrives, F_sh; 1 = unshaded", input<&Window::shading>()),

    row(Part::flow, "air_change", "1/h", required, 0, 20,
        "air changes per hour of the zone's volume", input<&AirFlow::air_change>()),
    row(Part::flow, "heat_recovery", "-", 0, 0, 1,
        "efficiency of heat recovery from the exhaust air", input<&AirFlow::heat_recovery>()),

    row(Part::load, "density", "W/m2", required, 0, 10000,
        "power per floor area", input<&Load::density>()),
    row(Part::load, "heat_fraction", "-", 1, 0, 1,
        "share of the power that heats the zone", constant<&Load::heat_fraction>()),
    row(Part::load, "efficiency", "-", 1, 0.01, 20,
        "power used per power metered", input<&Load::efficiency>()),

    row(Part::plant, "heating_efficiency", "-", 0.9, 0.01, 20,
        "heat delivered per energy metered; a COP where a heat pump heats", input<&Plant::heating_efficiency>()),
    row(Part::plant, "cooling_cop", "-", 3, 0.01, 50,
        "heat removed per energy metered", input<&Plant::cooling_cop>()),
    row(Part::plant, "heating_auxiliary", "-", 0, 0, 1,
        "electricity of pumps and fans per heat delivered", constant<&Plant::heating_auxiliary>()),
    row(Part::plant, "cooling_auxiliary", "-", 0, 0, 1,
        "electricity of pumps and fans per heat removed", constant<&Plant::cooling_auxiliary>()),
    row(Part::plant, "heating_least_load", "W/m2", 0, 0, 1000,
        "heat below which the plant goes on and off within the hour, per floor area; 0 = it follows the load",
        constant<&Plant::heating_least_load>()),
    row(Part::plant, "heating_cycling_loss", "-", 0, 0, 0.9,
        "share of the energy that is lost where the load is next to nothing, falling to 0 at heating_least_load",
        constant<&Plant::heating_cycling_loss>()),
    row(Part::plant, "cooling_least_load", "W/m2", 0, 0, 1000,
        "cold below which the plant goes on and off within the hour, per floor area; 0 = it follows the load",
        constant<&Plant::cooling_least_load>()),
    row(Part::plant, "cooling_cycling_loss", "-", 0, 0, 0.9,
        "share of the energy that is lost where the load is next to nothing, falling to 0 at cooling_least_load",
        constant<&Plant::cooling_cycling_loss>()),

    row(Part::air_system, "available", "-", 1, 0, 1,
        "share of the fan that runs; 0 = off", input<&AirSystem::available>()),
    row(Part::air_system, "design_flow", "m3/(h m2)", 15, 0.1, 500,
        "largest flow of supply air per floor area", input<&AirSystem::design_flow>()),
    row(Part::air_system, "fan_power", "W/(l/s)", 1.5, 0, 20,
        "power of the fan per flow, at design_flow", input<&AirSystem::fan_power>()),
    row(Part::air_system, "supply_temperature", "degC", 13, 2, 40,
        "air that cools, behind coil and fan", input<&AirSystem::supply_temperature>()),
    row(Part::air_system, "outdoor_air_change", "1/h", 0, 0, 20,
        "outdoor air in a supply that comes from a boundary, in air changes of the zone's volume",
        input<&AirSystem::outdoor_air_change>()),
    row(Part::air_system, "people_moisture", "g/(h m2)", 0, 0, 1000,
        "water that people give off, per floor area", input<&AirSystem::people_moisture>()),
    row(Part::air_system, "economiser", "-", 0, 0, 1,
        "largest share of outdoor air where that cools; 0 = none", input<&AirSystem::economiser>()),
    row(Part::air_system, "least_flow", "-", 0.3, 0, 1,
        "least share of design_flow, where the flow varies", constant<&AirSystem::least_flow>()),
    row(Part::air_system, "fan_exponent", "-", 2.5, 0, 4,
        "the fan's power follows its flow to this power", constant<&AirSystem::fan_exponent>()),
    row(Part::air_system, "fan_heat", "-", 1, 0, 1,
        "share of the fan's power that warms the air", constant<&AirSystem::fan_heat>()),
    row(Part::air_system, "supply_reset", "K/K", 0, 0, 5,
        "supply air is warmer by this per kelvin that outdoors is below reset_below", constant<&AirSystem::supply_reset>()),
    row(Part::air_system, "reset_below", "degC", 20, -40, 50,
        "outdoor temperature below which supply_reset holds", constant<&AirSystem::reset_below>()),
    row(Part::air_system, "most_reset", "K", 5, 0, 30,
        "largest reset of the supply air", constant<&AirSystem::most_reset>()),
    row(Part::air_system, "bypass_factor", "-", 0.1, 0, 0.9,
        "share of air that passes the cooling coil untouched", constant<&AirSystem::bypass_factor>()),
    row(Part::air_system, "coil_enthalpy", "kJ/kg", 0, 0, 60,
        "what the coil, being on or off, takes from rated air when on; 0 = it modulates, or with a constant flow "
        "is on or off at supply_temperature", constant<&AirSystem::coil_enthalpy>()),
    row(Part::air_system, "economiser_limit", "degC or kJ/kg", 24, -50, 150,
        "the economiser opens below: outdoor temperature, or enthalpy", constant<&AirSystem::economiser_limit>()),
    row(Part::air_system, "frost_limit", "degC", -100, -100, 20,
        "coldest exhaust air after heat recovery, which does less below it", constant<&AirSystem::frost_limit>()),
    row(Part::air_system, "least_humidity", "g/kg", 0, 0, 20,
        "water in the room's air that humidification keeps; 0 = none", constant<&AirSystem::least_humidity>()),

    row(Part::coupling, "conductance", "W/K", 0, 0, 1e6,
        "conductance between the air of both zones", input<&ZoneCoupling::conductance>()),
    row(Part::coupling, "air_flow", "m3/h", 0, 0, 1e7,
        "air that enters from the other zone", input<&ZoneCoupling::air_flow>()),

    row(Part::meter, "factor", "-", 1, 0, 1000,
        "what the meter shows per what flows through it", itself()),
};
// clang-format on

}  // namespace

std::span<const Field> fields() {
    return table;
}

}  // namespace bemcal::physics
