/// Makes what the loop fits: training readings, refinements of a zone with priors, a
/// building with structure and effects, noise and deviance of each meter.
/// Source: ISO 13790's 5R1C; ASHRAE Handbook, Fundamentals, for glass by angle.
/// Refinements are chosen by `make_baseline`. Errors of different meters count as
/// independent.
#include "loop/model.hpp"

#include "base/error.hpp"
#include "base/nan.hpp"
#include "effects/make_surroundings.hpp"
#include "effects/sites.hpp"
#include "physics/calendar.hpp"
#include "physics/interval_hours.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

constexpr double days_of_noise = 7;  ///< blocks over which errors are counted as one

/// Whether options name it; no names = all.
bool is_chosen(const std::vector<std::string>& names, const std::string& name) {
    return names.empty() || std::ranges::find(names, name) != names.end();
}

int block_at(physics::Seconds time, physics::Seconds from, double days) {
    const auto seconds = (time - from).count();
    return static_cast<int>(std::floor(static_cast<double>(seconds) /
                                       (days * static_cast<double>(physics::day_s))));
}

/// Months since year 0.
int month_at(physics::Seconds time) {
    const physics::CalendarStep step = physics::calendar_step(time);
    return 12 * step.year + step.month;
}

/// The index of the plane with something of it changed.
template <class Change>
int plane_with(Change change, int index, physics::Building& building) {
    physics::Plane plane = building.planes[static_cast<std::size_t>(index)];
    change(plane);
    return building.plane_index(plane);
}

/// Double clear glass: the polynomial in the angle of incidence is within 0.02 of its
/// solar heat gain coefficients by angle over that at normal incidence (ASHRAE Handbook,
/// Fundamentals: 0.70, 0.67, 0.64, 0.58, 0.45, 0.23 at 0, 40, 50, 60, 70, 80 degrees;
/// 0.60 of light from all sides).
/// A glazing that has a modifier keeps it.
bool glass_by_angle(physics::Building& building) {
    const std::vector<double> modifier = {1, 0, 0.0698, 0, -0.2466, 0, 0.0213};
    const double of_diffuse = 0.60 / 0.70;
    const auto change = [&](physics::Plane& plane) {
        plane.modifier = modifier;
        plane.diffuse_modifier = of_diffuse;
    };
    bool changed = false;
    for (physics::Zone& zone : building.zones)
        for (physics::Window& window : zone.windows) {
            auto& glazing = building.glazings[static_cast<std::size_t>(window.glazing)];
            if (!glazing.angle_modifier.empty() && glazing.angle_modifier != modifier)
                continue;
            glazing.angle_modifier = modifier;
            glazing.incidence_factor = 1;
            window.plane = plane_with(change, window.plane, building);
            changed = true;
        }
    return changed;
}

/// The standard lets the sun on walls and roofs heat the room at once.
bool delay_sun_on_walls(physics::Building& building, double hours) {
    bool changed = false;
    for (physics::Zone& zone : building.zones)
        for (physics::Surface& surface : zone.surfaces) {
            if (!surface.in_sun || surface.boundary != physics::outdoors) continue;
            surface.plane = plane_with([&](auto& plane) { plane.lag_hours = hours; },
                                       surface.plane, building);
            changed = true;
        }
    return changed;
}

/// Models of where the light of the sky comes from differ by several per cent of what a
/// facade gets.
bool sky_of_hay_and_davies(physics::Building& building) {
    const auto change = [](physics::Plane& plane) {
        plane.sky = physics::SkyModel::hay_davies;
    };
    for (physics::Zone& zone : building.zones) {
        for (physics::Window& window : zone.windows)
            window.plane = plane_with(change, window.plane, building);
        for (physics::Surface& surface : zone.surfaces)
            if (surface.in_sun)
                surface.plane = plane_with(change, surface.plane, building);
    }
    return true;
}

/// Air systems that nobody declared, in zones that are cooled and have none.
template <class Set>
bool add_air_systems(physics::Building& building, Set set) {
    bool changed = false;
    for (physics::Zone& zone : building.zones) {
        const physics::Thermostat& control = zone.thermostat;
        if (zone.air_system >= 0 || control.imposed ||
            !(control.cooling_capacity.value > 0))
            continue;
        physics::AirSystem system;
        system.name = "of " + zone.name;
        system.available = {0};
        system.fan_power = {0};
        set(zone, system);
        zone.air_system = static_cast<int>(building.air_systems.size());
        building.air_systems.push_back(system);
        changed = true;
    }
    return changed;
}

/// The flow from outdoors that a fan brings; -1 = none.
int flow_of_fan(const physics::Zone& zone) {
    const auto place = std::ranges::find_if(zone.flows, effects::is_fan);
    return place == zone.flows.end() ? -1 : static_cast<int>(place - zone.flows.begin());
}

/// Cooled air leaves its water on the coil. The fan's power and hours stay what they are
/// described as.
bool coil_that_dries(physics::Building& building) {
    return add_air_systems(building, [](physics::Zone& zone, physics::AirSystem& system) {
        system.variable = false;
        zone.system_flow = flow_of_fan(zone);
        for (const physics::Load& load : zone.loads)
            if (load.carrier == physics::Carrier::none && load.density.profile >= 0)
                system.people_moisture = {1, 0, load.density.profile};
    });
}

/// All planes that any structure asks for, in every one of them: they share one drive.
void add_planes(physics::Building& building) {
    std::vector<bool (*)(physics::Building&)> changes;
    for (const Refinement& refinement : refinements())
        if (refinement.change != nullptr) changes.push_back(refinement.change);
    for (std::size_t some = 0; some < std::size_t{1} << changes.size(); ++some) {
        physics::Building changed = building;
        for (std::size_t k = 0; k < changes.size(); ++k)
            if ((some >> k) % 2 == 1) changes[k](changed);
        building.planes = changed.planes;
    }
}

std::string name_of_numbered(const study::Case& building, std::size_t profile) {
    return "numbered hours of " + building.profiles[profile].name;
}

/// The hours of schedules that have one run a day, in a drive beside the schedules.
void add_numbered_hours(study::Case& building) {
    const std::size_t n = building.profiles.size();
    for (std::size_t p = 0; p < n; ++p) {
        const physics::Profile& own = building.profiles[p];
        if (own.is_series || numbered_row_of(building, p) ||
            !(has_unknown_hours(building, p) || physics::hours_of(own.schedule)))
            continue;
        physics::Profile numbered;
        numbered.name = name_of_numbered(building, p);
        numbered.schedule = physics::numbered_hours(own.schedule);
        building.profiles.push_back(std::move(numbered));
    }
}

/// Where a number stands in every zone, but what a parameter of the job calibrates: that
/// one keeps its prior.
std::vector<physics::Target> free_targets(const Place& place, const char* path) {
    std::vector<physics::Target> targets = physics::resolve(place.building, path);
    std::erase_if(targets, [&](const physics::Target& target) {
        return std::ranges::any_of(place.parameters, [&](const auto& parameter) {
            return std::ranges::any_of(parameter.targets, [&](const auto& taken) {
                return physics::is_same_number(target, taken);
            });
        });
    });
    return targets;
}

/// A number of the structure ends where it would be something else: a second mass as slow
/// as the ground, a sky that stands for a station's offset.
std::pair<double, double> limits_of(double mean, double sd, double least, double most) {
    constexpr double reach = 2.5;  ///< standard deviations of the prior
    return {std::max(least, mean - reach * sd), std::min(most, mean + reach * sd)};
}

void add_number(const Refinement::Number& number, Place& place) {
    auto targets = free_targets(place, number.path);
    if (targets.empty()) return;
    std::string name = number.name;
    if (std::ranges::find(place.unknowns, name, &study::FitUnknown::name) !=
        place.unknowns.end())
        name += " of the structure";
    for (const physics::Target& target : targets)
        physics::number_at(place.building, target) = number.mean;
    const auto [least, most] =
        limits_of(number.mean, number.sd, number.least, number.most);
    place.parameters.push_back({name, "", least, most, physics::Effect::replace,
                                std::move(targets), number.mean});
    place.unknowns.push_back({name, "", number.mean, number.sd, least, most, true});
}

void add_structure(const std::vector<std::size_t>& structure, Place& place) {
    for (const std::size_t index : structure) {
        const auto& always = refinements()[index].effects;
        place.always.insert(place.always.end(), always.begin(), always.end());
        for (const Refinement::Number& number : refinements()[index].numbers)
            add_number(number, place);
    }
}

/// The long-wave loss that all hours share.
Refinement::Number sky_difference(double mean, double sd) {
    return {"sky_difference", "zone.*.sky_temperature_difference", mean, sd, 0, 28};
}

/// An effect with its sign and size free, as the hook's name has it.
effects::Effect following(const char* name, effects::Hook hook, effects::Driver driver,
                          double typical) {
    effects::Effect effect;
    effect.name = name;
    effect.hook = hook;
    effect.driver = driver;
    effect.typical = typical;
    effect.most = 20 * typical;
    effect.least = -effect.most;
    return effect;
}

void add_parameters(const LoopData& data, Place& place) {
    const auto& given = data.building.parameters;
    for (std::size_t k = 0; k < given.size(); ++k) {
        if (!is_chosen(data.options.parameters, given[k].name)) continue;
        place.parameters.push_back(given[k]);
        const stats::Prior prior =
            data.building.priors.empty() ? stats::Prior{} : data.building.priors[k].prior;
        place.unknowns.push_back(study::unknown_of(given[k], prior));
    }
}

/// The job's series that effects may follow.
void add_columns_of_job(const LoopData& data, const physics::Drive& drive,
                        effects::Surroundings& around) {
    const auto& profiles = data.building.profiles;
    for (std::size_t p = 0; p < profiles.size(); ++p) {
        if (std::ranges::find(data.options.columns, profiles[p].name) ==
            data.options.columns.end())
            continue;
        const auto row = drive.profiles.row(p);
        around.columns[profiles[p].name].assign(row.begin(), row.end());
    }
}

bool is_monthly(const kernel::Channel& channel) {
    return channel.interval == physics::Interval::monthly;
}

/// 0 where nothing is measured.
double mean_of_measured(const study::Targets& targets, std::size_t channel) {
    double sum = 0, n = 0;
    for (const double value : targets.of(channel, targets.measured))
        if (!std::isnan(value)) sum += value, ++n;
    return n > 0 ? sum / n : 0;
}

bool is_air(const kernel::Channel& channel) {
    return physics::is_temperature(channel.quantity);
}

/// What an energy meter shows in an hour, as a mean [kWh].
double hourly_mean(const LoopData& data, std::size_t channel) {
    return mean_of_measured(data.targets, channel) /
           hours_of(data.targets.channels[channel].interval, data.building.step_s);
}

/// Of all energy meters [kWh in an hour].
double largest_mean(const LoopData& data) {
    double largest = 0;
    for (std::size_t c = 0; c < data.targets.n_channels(); ++c)
        if (!is_air(data.targets.channels[c]))
            largest = std::max(largest, hourly_mean(data, c));
    return largest;
}

/// What energy a meter carries, next to that of the largest.
std::vector<double> shares_of(const LoopData& data) {
    constexpr double share_of_largest = 0.1;  ///< from it on a meter counts whole
    constexpr double least_share = 0.01;
    const double largest = largest_mean(data);
    std::vector<double> shares;
    for (std::size_t c = 0; c < data.targets.n_channels(); ++c) {
        if (is_air(data.targets.channels[c]))
            shares.push_back(1);
        else if (largest > 0)
            shares.push_back(std::clamp(
                hourly_mean(data, c) / (share_of_largest * largest), least_share, 1.0));
        else
            shares.push_back(least_share);
    }
    return shares;
}

/// Of a meter whose readings, or whose errors, are all the same: they say nothing of its
/// noise. A tenth of what the largest meter shows, of a temperature 1 K.
double sigma_of_constant(const LoopData& data, std::size_t channel) {
    const kernel::Channel& read = data.targets.channels[channel];
    const double largest = largest_mean(data);
    if (is_air(read) || largest <= 0) return 1;
    return 0.1 * largest * hours_of(read.interval, data.building.step_s);
}

bool is_hourly(const kernel::Channel& channel) {
    return channel.interval == physics::Interval::hourly;
}

/// A year of months is fewer readings than a model has numbers, and can be met better
/// than any model deserves: what is below a fifth of the limit of ASHRAE Guideline 14
/// (15 % of a month) is not evidence.
double least_sigma(const study::Targets& targets, std::size_t channel) {
    constexpr double least_error = 0.03;  ///< of a month [-]
    if (!is_monthly(targets.channels[channel])) return 0;
    return least_error * std::abs(mean_of_measured(targets, channel));
}

double kappa_of(const LoopData& data, std::size_t channel,
                std::span<const double> residuals) {
    const study::Targets& targets = data.targets;
    std::map<int, double> sums;
    double squares = 0;
    for (std::size_t k = targets.first[channel]; k < targets.first[channel + 1]; ++k) {
        if (std::isnan(targets.measured[k])) continue;
        sums[block_at(data.begins[k], data.training().from, days_of_noise)] +=
            residuals[k];
        squares += residuals[k] * residuals[k];
    }
    double of_sums = 0;
    for (const auto& [block, sum] : sums) of_sums += sum * sum;
    return squares > 0 ? std::max(1.0, of_sums / squares) : 1;
}

}  // namespace

LoopData::LoopData(const study::Case& given, const LoopOptions& chosen)
    : building(given), options(chosen), targets{{}, {0}, {}} {
    const study::Period& period = training();
    add_planes(building.building);
    add_numbered_hours(building);
    drive = drive_over(period);
    const physics::TimeAxis axis = study::axis_of(building, period);
    const auto readings = training_readings(building, period);
    for (std::size_t m = 0; m < building.meters.size(); ++m) {
        if (!is_chosen(options.meters, building.meters[m].name) ||
            !study::has_reading(readings[m].values))
            continue;
        meters.push_back(m);
        targets.channels.push_back({readings[m].quantity, readings[m].interval});
        const auto of_meter = study::begins_of(axis, readings[m].interval);
        begins.insert(begins.end(), of_meter.begin(), of_meter.end());
        targets.measured.insert(targets.measured.end(), readings[m].values.begin(),
                                readings[m].values.end());
        targets.first.push_back(targets.measured.size());
    }
    if (meters.empty())
        throw std::invalid_argument("no meter has a reading in the training period");
    blocks = blocks_of(options.block_days);
}

bool has_unknown_hours(const study::Case& building, std::size_t profile) {
    return std::ranges::find(building.unknown_hours, profile,
                             &study::UnknownHours::profile) !=
           building.unknown_hours.end();
}

std::optional<std::size_t> numbered_row_of(const study::Case& building,
                                           std::size_t profile) {
    const auto& all = building.profiles;
    const auto found = std::ranges::find(all, name_of_numbered(building, profile),
                                         &physics::Profile::name);
    if (found == all.end()) return std::nullopt;
    return static_cast<std::size_t>(found - all.begin());
}

std::vector<kernel::Readings> training_readings(const study::Case& building,
                                                const study::Period& period) {
    // Where a building seldom heats, the first days are much of the year's heat.
    constexpr std::chrono::hours first{48};
    auto readings = study::readings_of(building, period);
    const bool is_short = period.to - period.from < 10 * first;
    if (is_short || study::knows_state_before(building, period)) return readings;
    const physics::TimeAxis axis = study::axis_of(building, period);
    for (kernel::Readings& meter : readings) {
        if (meter.interval == physics::Interval::monthly) continue;
        const auto begins = study::begins_of(axis, meter.interval);
        for (std::size_t k = 0; k < begins.size() && begins[k] < period.from + first; ++k)
            meter.values[k] = nan;
    }
    return readings;
}

const study::Period& LoopData::training() const {
    return study::period_of(building, options.period);
}

std::shared_ptr<const physics::Drive> LoopData::drive_over(
    const study::Period& period) const {
    return std::make_shared<physics::Drive>(study::drive_of(building, period));
}

std::vector<physics::Quantity> LoopData::quantities() const {
    std::vector<physics::Quantity> quantities;
    quantities.reserve(targets.n_channels());
    for (const kernel::Channel& channel : targets.channels)
        quantities.push_back(channel.quantity);
    return quantities;
}

bool LoopData::reads_months() const {
    return std::ranges::any_of(targets.channels, is_monthly);
}

bool LoopData::reads_months_only() const {
    return std::ranges::all_of(targets.channels, is_monthly);
}

std::vector<int> LoopData::blocks_of(double days) const {
    std::vector<int> of_readings;
    of_readings.reserve(begins.size());
    const bool by_month = reads_months();
    const int first = month_at(training().from);
    for (const physics::Seconds begin : begins)
        of_readings.push_back(by_month ? month_at(begin) - first
                                       : block_at(begin, training().from, days));
    return of_readings;
}

const std::vector<Refinement>& refinements() {
    static const std::vector<Refinement> table = {
        {"surfaces",
         {{"mass_area_ratio", "zone.*.mass_area_ratio", 2.5, 0.8, 1.0, 6},
          {"surface_area_ratio", "zone.*.surface_area_ratio", 4.5, 1.2, 1.5, 9}}},
        {"air and thermostat",
         {{"air_capacity", "zone.*.air_capacity", 15000, 12000, 1000, 90000},
          {"thermostat_band", "zone.*.proportional_band", 0.8, 0.6, 0.02, 3}}},
        {"emitter",
         {{"emitter_lag", "zone.*.emitter_time_constant", 1500, 1200, 60, 10000},
          {"radiant_share", "zone.*.emitter_radiant_share", 0.4, 0.25, 0, 0.95}}},
        {"gains to air",
         {{"gains_air_share", "zone.*.gains_air_share", 0.5, 0.15, 0.05, 0.95},
          {"sun_air_share", "zone.*.sun_air_share", 0.1, 0.05, 0, 0.5}}},
        {"second mass",
         {{"second_mass_conductance", "zone.*.second_mass_conductance", 2, 2, 0.05, 15},
          {"second_mass_capacity", "zone.*.second_mass_capacity", 200000, 150000, 20000,
           1.2e6}}},
        {"glass by angle", {}, {}, glass_by_angle},
        {"sky of Hay and Davies", {}, {}, sky_of_hay_and_davies},
        {"sun through walls",
         {},
         {},
         [](physics::Building& building) { return delay_sun_on_walls(building, 8); }},
        {"sky", {{sky_difference(11, 4)}}, {}, nullptr, "sky"},
        {"sky by weather",
         {{sky_difference(4, 4)}},
         {{following("opaque elements see the sky", effects::Hook::opaque_boundary,
                     effects::Driver::sky_difference, 0.06),
           -0.12, 0.12, -1, 1},
          {following("windows see the sky", effects::Hook::window_boundary,
                     effects::Driver::sky_difference, 0.06),
           -0.12, 0.12, -1, 1}},
         nullptr,
         "sky"},
        {"wind in leaks",
         {},
         {{following("share of infiltration by wind", effects::Hook::leakage,
                     effects::Driver::relative_wind, 0.3),
           0.3, 0.1, 0, 0.45}}},
        {"coil that dries",
         {{"coil_temperature", "air_system.*.supply_temperature", 12, 1.5, 6, 18},
          {"coil_bypass", "air_system.*.bypass_factor", 0.1, 0.05, 0, 0.4},
          {"moisture_of_people", "air_system.*.people_moisture", 3, 2, 0, 20}},
         {},
         coil_that_dries},
        {"auxiliaries",
         {{"heating_auxiliary", "plant.heating_auxiliary", 0.02, 0.02, 0, 0.3},
          {"cooling_auxiliary", "plant.cooling_auxiliary", 0.02, 0.02, 0, 0.3}}},
        {"COP by weather",
         {},
         {{following("COP per outdoor temperature", effects::Hook::cooling_cop,
                     effects::Driver::theta_e, 0.01),
           -0.01, 0.01, -0.2, 0.2}}},
        {"heating by weather",
         {},
         {{following("heating efficiency per outdoor temperature",
                     effects::Hook::heating_efficiency, effects::Driver::theta_e, 0.01),
           0.005, 0.01, -0.2, 0.2}}}};
    return table;
}

std::string name_of(const std::vector<std::size_t>& structure) {
    std::string name;
    for (const std::size_t index : structure)
        name += (name.empty() ? "" : " + ") + std::string(refinements()[index].name);
    return name.empty() ? "standard" : name;
}

Place make_place(const LoopData& data, const std::vector<std::size_t>& structure,
                 std::shared_ptr<const physics::Drive> drive) {
    auto described = std::make_shared<physics::Building>(data.building.building);
    for (const std::size_t index : structure)
        if (const auto change = refinements()[index].change)
            if (!change(*described))
                throw CannotSimulate(
                    fmt::format("nothing for '{}' to change", refinements()[index].name));
    Place place;
    place.building = *described;
    place.described = described;
    place.drive = std::move(drive);
    add_parameters(data, place);
    add_structure(structure, place);
    place.surroundings =
        std::make_shared<effects::Surroundings>(effects::make_surroundings(
            *described, *place.drive, data.building.weather, data.training().from));
    add_columns_of_job(data, *place.drive, *place.surroundings);
    place.channels = data.targets.channels;
    return place;
}

namespace {

/// What effects see that enter the building of a place.
effects::Surroundings surroundings_of(const Place& place) {
    effects::Surroundings surroundings = *place.surroundings;
    surroundings.building = &place.building;
    surroundings.drive = place.drive.get();
    return surroundings;
}

/// Those of the structure first.
std::vector<effects::Effect> all_effects_of(const Place& place,
                                            const std::vector<effects::Effect>& added) {
    std::vector<effects::Effect> all;
    all.reserve(place.always.size() + added.size());
    for (const Refinement::Always& always : place.always) all.push_back(always.effect);
    all.insert(all.end(), added.begin(), added.end());
    return all;
}

}  // namespace

BuiltModel build(const Place& place, const std::vector<effects::Effect>& added) {
    BuiltModel built = place_only(place, added);
    built.fit_model = std::make_shared<const study::FitModel>(
        built.placed->building, built.parameters, built.placed->drive, place.channels);
    return built;
}

BuiltModel place_only(const Place& place, const std::vector<effects::Effect>& added) {
    BuiltModel built;
    built.building = place.building;
    built.drive = place.drive;
    built.n_effects = added.size();
    const std::vector<effects::Effect> all = all_effects_of(place, added);
    built.placed = std::make_shared<const effects::Placed>(
        effects::place(all, surroundings_of(place)));
    built.parameters = place.parameters;
    built.unknowns = place.unknowns;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const physics::Parameter& parameter = built.placed->parameters[k];
        built.parameters.push_back(parameter);
        study::FitUnknown unknown{
            all[k].name,     parameter.unit, 0,    std::abs(all[k].typical),
            parameter.least, parameter.most, false};
        if (k < place.always.size()) {
            const Refinement::Always& always = place.always[k];
            unknown.centre = always.mean;
            unknown.scale = always.sd;
            unknown.has_prior = true;
            const auto [least, most] =
                limits_of(always.mean, always.sd, always.least, always.most);
            unknown.least = std::max(unknown.least, least);
            unknown.most = std::min(unknown.most, most);
        }
        built.unknowns.push_back(unknown);
    }
    return built;
}

OneMore::OneMore(const Place& place, const std::vector<effects::Effect>& effects)
    : place_(place),
      shared_(effects::with_other_hours(effects, *place.drive)),
      surroundings_(surroundings_of(place)),
      placer_(surroundings_),
      drive_(shared_) {
    surroundings_.drive = &shared_;
    for (const effects::Effect& effect : all_effects_of(place, effects))
        effects::put(effect, placer_);
}

const study::FitModel& OneMore::with(const effects::Effect& effect) {
    effects::Placer placer = placer_;
    effects::put(effect, placer);
    fit_model_.reset();  // it refers to what changes now
    building_ = placer.building();
    placer.write_profiles(drive_);
    parameters_ = place_.parameters;
    const auto& placed = placer.parameters();
    parameters_.insert(parameters_.end(), placed.begin(), placed.end());
    fit_model_ = std::make_unique<const study::FitModel>(building_, parameters_, drive_,
                                                         place_.channels);
    return *fit_model_;
}

std::vector<double> weights_of(const study::Targets& targets,
                               const std::vector<ChannelNoise>& noise) {
    std::vector<double> weights(targets.size(), 0.0);
    for (std::size_t c = 0; c < targets.n_channels(); ++c)
        for (std::size_t k = targets.first[c]; k < targets.first[c + 1]; ++k)
            if (!std::isnan(targets.measured[k])) weights[k] = noise[c].weight();
    return weights;
}

std::vector<ChannelNoise> noise_of(const LoopData& data,
                                   std::span<const double> residuals) {
    const std::vector<double> squares = mean_squares(data.targets, residuals);
    const std::vector<double> shares = shares_of(data);
    std::vector<ChannelNoise> noise;
    double logs = 0, n = 0;
    for (std::size_t c = 0; c < squares.size(); ++c) {
        const double least = least_sigma(data.targets, c);
        const double sigma = std::hypot(std::sqrt(squares[c]), least);
        noise.push_back({sigma > 1e-9 ? sigma : sigma_of_constant(data, c),
                         kappa_of(data, c, residuals), shares[c], least});
        if (!is_hourly(data.targets.channels[c])) continue;
        logs += shares[c] * std::log(noise[c].kappa);
        n += shares[c];
    }
    // One for all hourly channels, so that none is given up for the others.
    for (std::size_t c = 0; c < squares.size(); ++c)
        if (is_hourly(data.targets.channels[c]) && n > 0)
            noise[c].kappa = std::exp(logs / n);
    return noise;
}

std::vector<double> mean_squares(const study::Targets& targets,
                                 std::span<const double> residuals) {
    std::vector<double> squares;
    for (std::size_t c = 0; c < targets.n_channels(); ++c) {
        double sum = 0, n = 0;
        for (std::size_t k = targets.first[c]; k < targets.first[c + 1]; ++k)
            if (!std::isnan(targets.measured[k])) sum += residuals[k] * residuals[k], ++n;
        squares.push_back(n > 0 ? sum / n : 0);
    }
    return squares;
}

double deviance(const study::Targets& targets, const std::vector<ChannelNoise>& noise,
                std::span<const double> residuals) {
    return deviance_of_squares(targets, noise, mean_squares(targets, residuals));
}

double deviance_of_squares(const study::Targets& targets,
                           const std::vector<ChannelNoise>& noise,
                           std::span<const double> squares) {
    double sum = 0;
    for (std::size_t c = 0; c < squares.size(); ++c) {
        const auto measured = targets.of(c, targets.measured);
        const auto n = static_cast<double>(
            std::ranges::count_if(measured, [](double v) { return !std::isnan(v); }));
        const double met = 1e-3 * noise[c].sigma;  // as good as exactly
        sum +=
            noise[c].share * n / noise[c].kappa *
            std::log(std::max(squares[c] + noise[c].least * noise[c].least, met * met));
    }
    return sum;
}

}  // namespace bemcal::loop
