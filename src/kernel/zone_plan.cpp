/// Which inputs of a zone make regimes, rows and drivers, and where segments are cut.
/// Loads with more distinct values than fit a table of 512 rows become drivers.
/// Follows from what network and regime read. What a parameter may turn on is on for all
/// points. Not for coupled zones and radiators; values are left to affine.
#include "kernel/input_profiles.hpp"
#include "kernel/linear_input.hpp"
#include "kernel/plan.hpp"

#include <algorithm>

namespace bemcal::kernel {

namespace {

constexpr int most_rows = 512;  ///< more distinct gains than this become drivers

void add_element_profiles(const physics::Building& building, const physics::Zone& zone,
                          std::vector<int>& profiles) {
    for (const physics::Surface& surface : zone.surfaces) {
        add_profiles(
            profiles,
            building.constructions[static_cast<std::size_t>(surface.construction)]
                .u_value);
        add_profiles(profiles, surface.shading);
    }
    for (const physics::Window& window : zone.windows) {
        const physics::Glazing& glazing =
            building.glazings[static_cast<std::size_t>(window.glazing)];
        for (const physics::Input* input :
             {&glazing.u_value, &glazing.solar_transmittance, &window.shading})
            add_profiles(profiles, *input);
    }
}

void add_flow_profiles(const physics::Zone& zone, std::vector<int>& profiles) {
    for (const physics::AirFlow& flow : zone.flows) {
        add_profiles(profiles, flow.air_change);
        add_profiles(profiles, flow.heat_recovery);
    }
}

/// Profiles of all that shapes the network and the control.
std::vector<int> regime_profiles(const physics::Building& building,
                                 const physics::Zone& zone) {
    std::vector<int> profiles;
    add_element_profiles(building, zone, profiles);
    add_flow_profiles(zone, profiles);
    const physics::Thermostat& control = zone.thermostat;
    if (!control.imposed)
        for (const physics::Input* input :
             {&control.heating_set_point, &control.cooling_set_point,
              &control.heating_capacity, &control.cooling_capacity,
              &control.heating_available, &control.cooling_available,
              &control.room_spread, &control.cooled_together})
            add_profiles(profiles, *input);
    return profiles;
}

bool elements_vary(const physics::Building& building, const physics::Zone& zone) {
    std::vector<int> profiles;
    add_element_profiles(building, zone, profiles);
    return !profiles.empty();
}

std::vector<int> planes_of(const physics::Zone& zone) {
    std::vector<int> planes;
    for (const physics::Surface& surface : zone.surfaces)
        if (surface.in_sun && surface.boundary == physics::outdoors)
            planes.push_back(surface.plane);
    for (const physics::Window& window : zone.windows) planes.push_back(window.plane);
    std::sort(planes.begin(), planes.end());
    planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
    return planes;
}

std::vector<int> used_boundaries(const physics::Zone& zone) {
    std::vector<int> used;
    used.reserve(zone.surfaces.size() + zone.flows.size());
    for (const physics::Surface& surface : zone.surfaces)
        used.push_back(surface.boundary);
    for (const physics::AirFlow& flow : zone.flows) used.push_back(flow.supply);
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::erase(used, physics::outdoors);
    return used;
}

/// Of the boundaries' temperatures, and of what outdoors differs by.
LinearProfiles temperature_profiles(const physics::Building& building,
                                    const physics::Zone& zone) {
    LinearProfiles profiles;
    for (int boundary : used_boundaries(zone))
        profiles.add(building.boundaries[static_cast<std::size_t>(boundary)].temperature);
    const physics::OutdoorShift& shift = zone.outdoor_shift;
    for (const physics::Input* input : {&shift.supply, &shift.opaque, &shift.windows})
        profiles.add(*input);
    return profiles;
}

/// Of the loads that heat the zone, or may, and of what else a row holds.
LinearProfiles gain_profiles(const Nominal& nominal, std::size_t index) {
    LinearProfiles profiles;
    at_range_ends(nominal.building, nominal.parameters,
                  [&](const physics::Building& building) {
                      for (const physics::Load& load : building.zones[index].loads)
                          if (load.heat_fraction != 0) profiles.add(load.density);
                  });
    const physics::Zone& zone = nominal.building.zones[index];
    add_profiles(profiles.tabled, zone.venting.air_change);
    const physics::Thermostat& control = zone.thermostat;
    if (control.imposed && control.imposed_power.is_changed())
        add_profiles(profiles.tabled, control.imposed_power);
    return profiles;
}

/// What a zone has or may have beyond the standard's hour.
struct Options {
    physics::Structure widest;
    SeasonLimits season;
    bool shifted = false, vented = false, rooms_differ = false;
};

Options options_of(const Nominal& nominal, std::size_t index) {
    Options options;
    at_range_ends(
        nominal.building, nominal.parameters, [&](const physics::Building& building) {
            const physics::Zone& zone = building.zones[index];
            for (double physics::Structure::* field :
                 {&physics::Structure::air_capacity,
                  &physics::Structure::proportional_band,
                  &physics::Structure::emitter_time_constant,
                  &physics::Structure::emitter_radiant_share,
                  &physics::Structure::second_mass_conductance,
                  &physics::Structure::second_mass_capacity})
                options.widest.*field =
                    std::max(options.widest.*field, zone.structure.*field);
            options.season.add(zone.structure);
            const physics::OutdoorShift& shift = zone.outdoor_shift;
            options.shifted |= is_active(shift.supply) || is_active(shift.opaque) ||
                               is_active(shift.windows);
            options.vented |= is_active(zone.venting.air_change);
            options.rooms_differ |= zone.thermostat.rooms_differ();
        });
    return options;
}

std::vector<physics::Term> states_of(const Options& options, bool imposed) {
    const physics::Structure& structure = options.widest;
    if (!structure.any() && !options.season.is_seasonal() && !imposed &&
        !options.vented && !options.rooms_differ)
        return {};
    std::vector<physics::Term> states{physics::Term::theta_m};
    if (structure.second_mass_conductance > 0) states.push_back(physics::Term::theta_m2);
    if (structure.air_capacity > 0 || options.vented)
        states.push_back(physics::Term::theta_air);
    if (structure.emitter_time_constant > 0) states.push_back(physics::Term::phi_emitter);
    return states;
}

/// Of the profiles, the first with the most distinct values.
std::vector<int>::iterator widest_of(std::vector<int>& profiles,
                                     ProfileClasses& classes) {
    return std::max_element(profiles.begin(), profiles.end(), [&](int a, int b) {
        return classes.of(a).size() < classes.of(b).size();
    });
}

/// Fills the rows and load_drivers: the profile with the most distinct values becomes a
/// driver until the rows fit a table.
void plan_rows(ZonePlan& plan, const LinearProfiles& gains, ProfileClasses& classes) {
    const Partition least = classes.refine(plan.regimes, gains.tabled);
    const int most = std::max(most_rows, least.size());
    std::vector<int> tabled = gains.drivers();
    const auto fits = [&] {
        if (!tabled.empty() && classes.of(*widest_of(tabled, classes)).size() > most)
            return false;
        plan.rows = classes.refine(least, tabled);
        return plan.rows.size() <= most || tabled.empty();
    };
    while (!fits()) {
        const auto widest = widest_of(tabled, classes);
        plan.load_drivers.push_back(*widest);
        tabled.erase(widest);
    }
    plan.rows_of_regime.resize(static_cast<std::size_t>(plan.regimes.size()));
    for (int row = 0; row < plan.rows.size(); ++row) {
        const auto step =
            static_cast<std::size_t>(plan.rows.first[static_cast<std::size_t>(row)]);
        plan.rows_of_regime[static_cast<std::size_t>(plan.regimes.class_of[step])]
            .push_back(row);
    }
}

/// Outdoor air, profiles, irradiance: the columns of the drivers.
std::vector<std::span<const double>> driver_columns(const ZonePlan& plan,
                                                    const physics::Building& building,
                                                    const physics::Drive& drive) {
    std::vector<int> profiles = plan.temperature_drivers;
    profiles.insert(profiles.end(), plan.load_drivers.begin(), plan.load_drivers.end());
    if (plan.imposed_driver)
        profiles.push_back(building.zones[plan.zone].thermostat.imposed_power.profile);
    std::vector<std::span<const double>> columns{drive.theta_e};
    columns.reserve(1 + profiles.size() + plan.planes.size());
    for (int profile : profiles)
        columns.push_back(drive.profiles.row(static_cast<std::size_t>(profile)));
    for (int plane : plan.planes)
        columns.push_back(drive.irradiance.row(static_cast<std::size_t>(plane)));
    return columns;
}

void lay_drivers(ZonePlan& plan, const physics::Building& building,
                 const physics::Drive& drive) {
    const auto columns = driver_columns(plan, building, drive);
    const auto n_steps = static_cast<std::size_t>(drive.n_steps());
    plan.drivers.resize(n_steps * columns.size());
    double* to = plan.drivers.data();
    for (std::size_t step = 0; step < n_steps; ++step)
        for (const auto& column : columns) *to++ = column[step];
}

bool in_sun(const ZonePlan& plan, std::size_t step) {
    const double* end =
        plan.drivers.data() +
        (step + 1) * (static_cast<std::size_t>(plan.n_drivers()) + plan.planes.size());
    return std::any_of(end - plan.planes.size(), end,
                       [](double sun) { return sun != 0; });
}

void cut_segments(ZonePlan& plan, std::size_t n_steps) {
    plan.segment_of.resize(n_steps);
    for (std::size_t step = 0; step < n_steps; ++step) {
        const int here = static_cast<int>(step), regime = plan.regimes.class_of[step],
                  sun = in_sun(plan, step) ? 1 : 0;
        if (step == 0 || plan.segments.back().regime != regime ||
            plan.segments.back().in_sun != sun)
            plan.segments.push_back({here, here, regime, sun});
        plan.segments.back().end = here + 1;
        plan.segment_of[step] = static_cast<int>(plan.segments.size()) - 1;
    }
}

}  // namespace

ZonePlan plan_zone(const Nominal& nominal, std::size_t zone, ProfileClasses& classes) {
    const auto& [building, parameters, drive, lanes] = nominal;
    const physics::Zone& description = building.zones[zone];
    const physics::Thermostat& control = description.thermostat;
    const Options options = options_of(nominal, zone);
    const LinearProfiles temperatures = temperature_profiles(building, description);
    ZonePlan plan;
    plan.zone = zone;
    plan.states = states_of(options, control.imposed);
    plan.planes = planes_of(description);
    plan.shifted = options.shifted;
    plan.vented = options.vented;
    plan.elements_vary = elements_vary(building, description);
    plan.temperature_drivers = temperatures.drivers();
    plan.imposed_driver = control.imposed && control.imposed_power.profile >= 0 &&
                          !control.imposed_power.is_changed();
    plan.regimes = classes.refine(classes.refine(one_class(drive.n_steps()),
                                                 regime_profiles(building, description)),
                                  temperatures.tabled);
    plan.season = options.season;
    if (plan.season.is_seasonal() && !control.imposed)
        plan.regimes = both(plan.regimes, plan.season.classes(drive.theta_rm));
    plan_rows(plan, gain_profiles(nominal, zone), classes);
    plan.row_offset = offsets_of(plan.rows, plan.row_columns() * lanes);
    lay_drivers(plan, building, drive);
    cut_segments(plan, static_cast<std::size_t>(drive.n_steps()));
    return plan;
}

}  // namespace bemcal::kernel
