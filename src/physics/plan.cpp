/// Which inputs make regimes, rows and drivers, and where segments are cut.
#include "physics/plan.hpp"

#include <algorithm>
#include <map>

namespace bemcal::physics {

namespace {

constexpr int most_rows = 512;   ///< more distinct gains than this become drivers
constexpr int chunk_steps = 48;  ///< rows of 16 lanes of three quantities fill 18 KiB

void add_profile(std::vector<int>& profiles, const Input& input) {
    if (input.profile < 0) return;
    if (std::find(profiles.begin(), profiles.end(), input.profile) == profiles.end())
        profiles.push_back(input.profile);
}

/// Profiles of all that shapes the network and the control.
std::vector<int> regime_profiles(const Building& building, const Zone& zone) {
    std::vector<int> profiles;
    for (const Surface& surface : zone.surfaces) {
        add_profile(profiles,
                    building.constructions[static_cast<std::size_t>(surface.construction)]
                        .u_value);
        add_profile(profiles, surface.shading);
    }
    for (const Window& window : zone.windows) {
        const Glazing& glazing =
            building.glazings[static_cast<std::size_t>(window.glazing)];
        for (const Input* input :
             {&glazing.u_value, &glazing.solar_transmittance, &window.shading})
            add_profile(profiles, *input);
    }
    for (const AirFlow& flow : zone.flows) {
        add_profile(profiles, flow.air_change);
        add_profile(profiles, flow.heat_recovery);
    }
    const Thermostat& control = zone.thermostat;
    if (!control.imposed)
        for (const Input* input :
             {&control.heating_set_point, &control.cooling_set_point,
              &control.heating_capacity, &control.cooling_capacity,
              &control.heating_available, &control.cooling_available})
            add_profile(profiles, *input);
    return profiles;
}

/// Calls visit with the nominal building and the ones at both ends of all parameters'
/// ranges.
template <class Visit>
void at_range_ends(const Building& nominal, const std::vector<Parameter>& parameters,
                   Visit visit) {
    visit(nominal);
    Building building = nominal;
    std::vector<double> point(parameters.size());
    for (double Parameter::* end : {&Parameter::least, &Parameter::most}) {
        for (std::size_t p = 0; p < point.size(); ++p) point[p] = parameters[p].*end;
        apply(nominal, parameters, point, building);
        visit(building);
    }
}

/// Profiles of the loads that heat the zone, or may.
std::vector<int> load_profiles(const Building& nominal,
                               const std::vector<Parameter>& parameters,
                               std::size_t zone) {
    std::vector<int> profiles;
    at_range_ends(nominal, parameters, [&](const Building& building) {
        for (const Load& load : building.zones[zone].loads)
            if (load.heat_fraction != 0) add_profile(profiles, load.density);
    });
    return profiles;
}

std::vector<int> planes_of(const Zone& zone) {
    std::vector<int> planes;
    for (const Surface& surface : zone.surfaces)
        if (surface.in_sun && surface.boundary == outdoors)
            planes.push_back(surface.plane);
    for (const Window& window : zone.windows) planes.push_back(window.plane);
    std::sort(planes.begin(), planes.end());
    planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
    return planes;
}

std::vector<int> varying_boundaries(const Building& building, const Zone& zone) {
    std::vector<int> used;
    used.reserve(zone.surfaces.size() + zone.flows.size());
    for (const Surface& surface : zone.surfaces) used.push_back(surface.boundary);
    for (const AirFlow& flow : zone.flows) used.push_back(flow.supply);
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::erase_if(used, [&](int boundary) {
        return boundary == outdoors ||
               building.boundaries[static_cast<std::size_t>(boundary)]
                       .temperature.profile < 0;
    });
    return used;
}

/// The refinements that a zone has or may have.
Structure widest_structure(const Building& nominal,
                           const std::vector<Parameter>& parameters, std::size_t zone) {
    Structure widest;
    at_range_ends(nominal, parameters, [&](const Building& building) {
        for (double Structure::* field :
             {&Structure::air_capacity, &Structure::proportional_band,
              &Structure::emitter_time_constant, &Structure::emitter_radiant_share,
              &Structure::second_mass_conductance, &Structure::second_mass_capacity})
            widest.*field =
                std::max(widest.*field, building.zones[zone].structure.*field);
    });
    return widest;
}

std::vector<Term> states_of(const Structure& structure, bool imposed) {
    if (!structure.any() && !imposed) return {};
    std::vector<Term> states{Term::theta_m};
    if (structure.second_mass_conductance > 0) states.push_back(Term::theta_m2);
    if (structure.air_capacity > 0) states.push_back(Term::theta_air);
    if (structure.emitter_time_constant > 0) states.push_back(Term::phi_emitter);
    return states;
}

/// Fills the rows and load_drivers: the profile with the most distinct values becomes a
/// driver until the rows fit a table.
void plan_rows(ZonePlan& plan, std::vector<int> tabled, const Drive& drive) {
    plan.rows = refine(plan.regimes, drive, tabled);
    const auto n_values = [&](int profile) {
        return refine(one_class(drive.n_steps()), drive, {profile}).size();
    };
    while (plan.rows.size() > std::max(most_rows, plan.regimes.size()) &&
           !tabled.empty()) {
        const auto widest =
            std::max_element(tabled.begin(), tabled.end(),
                             [&](int a, int b) { return n_values(a) < n_values(b); });
        plan.load_drivers.push_back(*widest);
        tabled.erase(widest);
        plan.rows = refine(plan.regimes, drive, tabled);
    }
    plan.rows_of_regime.resize(static_cast<std::size_t>(plan.regimes.size()));
    for (int row = 0; row < plan.rows.size(); ++row) {
        const auto step =
            static_cast<std::size_t>(plan.rows.first[static_cast<std::size_t>(row)]);
        plan.rows_of_regime[static_cast<std::size_t>(plan.regimes.class_of[step])]
            .push_back(row);
    }
}

/// Profiles of the drivers after the outdoor air.
std::vector<int> driver_profiles(const ZonePlan& plan, const Building& building) {
    std::vector<int> profiles;
    profiles.reserve(plan.boundary_drivers.size() + plan.load_drivers.size() + 1);
    for (int boundary : plan.boundary_drivers)
        profiles.push_back(
            building.boundaries[static_cast<std::size_t>(boundary)].temperature.profile);
    profiles.insert(profiles.end(), plan.load_drivers.begin(), plan.load_drivers.end());
    if (plan.imposed_driver)
        profiles.push_back(building.zones[plan.zone].thermostat.imposed_power.profile);
    return profiles;
}

void lay_drivers(ZonePlan& plan, const Building& building, const Drive& drive) {
    const std::vector<int> profiles = driver_profiles(plan, building);
    for (std::size_t step = 0; step < static_cast<std::size_t>(drive.n_steps()); ++step) {
        plan.drivers.push_back(drive.theta_e[step]);
        for (int profile : profiles)
            plan.drivers.push_back(
                drive.profiles(static_cast<std::size_t>(profile), step));
        for (int plane : plan.planes)
            plan.drivers.push_back(
                drive.irradiance(static_cast<std::size_t>(plane), step));
    }
}

bool in_sun(const ZonePlan& plan, const Drive& drive, int step) {
    return std::any_of(plan.planes.begin(), plan.planes.end(), [&](int plane) {
        return drive.irradiance(static_cast<std::size_t>(plane),
                                static_cast<std::size_t>(step)) != 0;
    });
}

void cut_segments(ZonePlan& plan, const Drive& drive) {
    for (int step = 0; step < drive.n_steps(); ++step) {
        const auto at = static_cast<std::size_t>(step);
        const int regime = plan.regimes.class_of[at],
                  sun = in_sun(plan, drive, step) ? 1 : 0;
        if (step == 0 || plan.segments.back().regime != regime ||
            plan.segments.back().in_sun != sun)
            plan.segments.push_back({step, step, regime, sun});
        plan.segments.back().end = step + 1;
        plan.segment_of.push_back(static_cast<int>(plan.segments.size()) - 1);
    }
}

std::vector<int> offsets_of(const Partition& rows, int doubles_per_row) {
    std::vector<int> offsets;
    offsets.reserve(rows.class_of.size());
    for (int row : rows.class_of) offsets.push_back(row * doubles_per_row);
    return offsets;
}

/// The classes in which both are constant.
Partition both(const Partition& a, const Partition& b) {
    std::map<std::pair<int, int>, int> known;
    Partition classes;
    classes.class_of.reserve(a.class_of.size());
    for (std::size_t step = 0; step < a.class_of.size(); ++step) {
        const auto [entry, is_new] =
            known.try_emplace({a.class_of[step], b.class_of[step]}, classes.size());
        if (is_new) classes.first.push_back(static_cast<int>(step));
        classes.class_of.push_back(entry->second);
    }
    return classes;
}

/// Profiles that a meter's form follows: the plant's, if the carrier is its own, and the
/// loads'.
std::vector<int> meter_profiles(const Building& building, Carrier carrier) {
    std::vector<int> profiles;
    if (carrier == Carrier::none) return profiles;
    for (const Zone& zone : building.zones)
        for (const Load& load : zone.loads)
            if (load.carrier == carrier)
                for (const Input* input : {&load.density, &load.efficiency})
                    add_profile(profiles, *input);
    return profiles;
}

std::vector<int> plant_profiles(const Building& building, Carrier carrier) {
    std::vector<int> profiles;
    if (carrier == Carrier::none) return profiles;
    const Plant& plant = building.plant;
    if (plant.heating_carrier == carrier) add_profile(profiles, plant.heating_efficiency);
    if (plant.cooling_carrier == carrier) add_profile(profiles, plant.cooling_cop);
    return profiles;
}

}  // namespace

Partition one_class(int n_steps) {
    return {std::vector<int>(static_cast<std::size_t>(n_steps), 0), {0}};
}

Partition refine(Partition classes, const Drive& drive,
                 const std::vector<int>& profiles) {
    for (int profile : profiles) {
        const auto values = drive.profiles.row(static_cast<std::size_t>(profile));
        std::map<std::pair<int, double>, int> known;
        Partition finer;
        for (std::size_t step = 0; step < classes.class_of.size(); ++step) {
            const auto [entry, is_new] =
                known.try_emplace({classes.class_of[step], values[step]}, finer.size());
            if (is_new) finer.first.push_back(static_cast<int>(step));
            finer.class_of.push_back(entry->second);
        }
        classes = std::move(finer);
    }
    return classes;
}

int ZonePlan::n_drivers() const {
    return 1 + static_cast<int>(boundary_drivers.size() + load_drivers.size()) +
           (imposed_driver ? 1 : 0);
}

int ZonePlan::regime_columns() const {
    const int n = static_cast<int>(states.size()),
              n_planes = static_cast<int>(planes.size());
    if (is_standard())
        return kernel::StandardColumn::drivers + 2 * n_drivers() + n_planes;
    return kernel::GeneralColumn::forms + (3 + n + n_drivers()) * (1 + n) + n_planes;
}

int ZonePlan::of_regime_columns() const {
    return regime_columns() + (is_standard() ? static_cast<int>(planes.size()) : 0);
}

int ZonePlan::row_columns() const {
    return is_standard() ? kernel::standard_row_columns
                         : kernel::general_row_columns(static_cast<int>(states.size()));
}

kernel::ZoneTime ZonePlan::time(int lanes) const {
    return {static_cast<int>(states.size()),
            imposed_driver ? 1 : 0,
            n_drivers(),
            static_cast<int>(planes.size()),
            regime_columns() * lanes,
            of_regime_columns() * lanes,
            drivers.data(),
            row_offset.data(),
            segments.data()};
}

ZonePlan plan_zone(const Building& nominal, const std::vector<Parameter>& parameters,
                   const Drive& drive, std::size_t zone, int lanes) {
    const Zone& description = nominal.zones[zone];
    const Thermostat& control = description.thermostat;
    ZonePlan plan;
    plan.zone = zone;
    plan.states = states_of(widest_structure(nominal, parameters, zone), control.imposed);
    plan.planes = planes_of(description);
    plan.boundary_drivers = varying_boundaries(nominal, description);
    plan.imposed_driver = control.imposed && control.imposed_power.profile >= 0;
    plan.regimes =
        refine(one_class(drive.n_steps()), drive, regime_profiles(nominal, description));
    plan_rows(plan, load_profiles(nominal, parameters, zone), drive);
    plan.row_offset = offsets_of(plan.rows, plan.row_columns() * lanes);
    lay_drivers(plan, nominal, drive);
    cut_segments(plan, drive);
    return plan;
}

std::vector<Span> plan_months(const Drive& drive) {
    std::vector<Span> months;
    int month_of_year = 0;
    for (int step = drive.n_warm_up; step < drive.n_steps(); ++step) {
        const int month = calendar_step(drive.axis.begin_of(step)).month;
        if (months.empty() || month != month_of_year)
            months.push_back({step, step, static_cast<int>(months.size())});
        months.back().end = step + 1;
        month_of_year = month;
    }
    return months;
}

std::vector<Span> cut_chunks(const std::vector<Span>& months) {
    std::vector<Span> chunks;
    for (const Span& month : months)
        for (int begin = month.begin; begin < month.end; begin += chunk_steps)
            chunks.push_back(
                {begin, std::min(begin + chunk_steps, month.end), month.month});
    return chunks;
}

MeterPlan plan_meter(const Building& nominal, const Drive& drive, Quantity quantity,
                     const std::vector<Span>& months, int lanes) {
    const Carrier carrier = carrier_of(quantity);
    const std::vector<int> of_plant = plant_profiles(nominal, carrier);
    MeterPlan plan;
    plan.plant_varies = !of_plant.empty();
    plan.rows = refine(refine(one_class(drive.n_steps()), drive, of_plant), drive,
                       meter_profiles(nominal, carrier));
    plan.row_offset = offsets_of(plan.rows, 3 * lanes);
    for (const Span& month : months) {
        std::vector<double>& counts =
            plan.row_counts.emplace_back(static_cast<std::size_t>(plan.rows.size()));
        for (int step = month.begin; step < month.end; ++step)
            counts[static_cast<std::size_t>(
                plan.rows.class_of[static_cast<std::size_t>(step)])] += 1;
    }
    return plan;
}

void plan_mixed(const ZonePlan& zone, int lanes, MeterPlan& meter) {
    meter.mixed = both(zone.rows, meter.rows);
    meter.mixed_offset = offsets_of(meter.mixed, kernel::MixedColumn::count * lanes);
}

}  // namespace bemcal::physics
