/// Makes what the loop fits: training readings, a building with structure and effects,
/// noise and deviance of each meter.
/// Follows from `effects`: its refinements, and how effects are placed.
/// A structure is chosen by `make_baseline`. Errors of different meters count as
/// independent.
#include "loop/model.hpp"

#include "base/error.hpp"
#include "base/nan.hpp"
#include "effects/make_surroundings.hpp"
#include "effects/sites.hpp"
#include "loop/decisions.hpp"
#include "physics/calendar.hpp"
#include "physics/interval_hours.hpp"
#include "physics/numbers.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

using effects::Refinement;

/// Whether options name it; no names = all.
bool is_chosen(const std::vector<std::string>& names, const std::string& name) {
    return names.empty() || std::ranges::find(names, name) != names.end();
}

int block_at(physics::Seconds time, physics::Seconds from, double days) {
    const auto seconds = (time - from).count();
    return static_cast<int>(std::floor(static_cast<double>(seconds) /
                                       (days * static_cast<double>(physics::day_s))));
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

void add_structure(const std::vector<std::size_t>& structure, Place& place) {
    for (const std::size_t index : structure) {
        const Refinement& refinement = effects::refinements()[index];
        place.always.insert(place.always.end(), refinement.effects.begin(),
                            refinement.effects.end());
        for (const Refinement::Number& number : refinement.numbers) {
            auto parameter =
                effects::add_number(number, place.parameters, place.building);
            if (!parameter) continue;
            place.unknowns.push_back({parameter->name, parameter->unit, number.mean,
                                      number.sd, parameter->least, parameter->most,
                                      true});
            place.parameters.push_back(std::move(*parameter));
        }
    }
}

void add_parameters(const LoopData& data, Place& place) {
    const auto& given = data.building.parameters;
    for (std::size_t k = 0; k < given.size(); ++k) {
        if (!is_chosen(data.options.parameters, given[k].name)) continue;
        physics::Parameter& added = place.parameters.emplace_back(given[k]);
        for (physics::Target& target : added.targets)
            target = physics::where_now(place.building, target);
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
    const double largest = largest_mean(data);
    std::vector<double> shares;
    shares.reserve(data.targets.n_channels());
    for (std::size_t c = 0; c < data.targets.n_channels(); ++c)
        shares.push_back(is_air(data.targets.channels[c])
                             ? 1
                             : share_of_meter(hourly_mean(data, c), largest));
    return shares;
}

/// Of a meter whose readings, or whose errors, are all the same: they say nothing of its
/// noise. A tenth of what the largest meter shows, of a temperature 1 K.
double sigma_of_constant(const LoopData& data, std::size_t channel) {
    const kernel::Channel& read = data.targets.channels[channel];
    const double largest = largest_mean(data);
    if (is_air(read) || largest <= 0) return decisions::error_of_constant_air;
    return decisions::error_of_constant * largest *
           hours_of(read.interval, data.building.step_s);
}

bool is_hourly(const kernel::Channel& channel) {
    return channel.interval == physics::Interval::hourly;
}

/// A year of months is fewer readings than a model has numbers, and can be met better
/// than any model deserves: what is below a fifth of the limit of ASHRAE Guideline 14
/// (15 % of a month) is not evidence.
double least_sigma(const study::Targets& targets, std::size_t channel) {
    if (!is_monthly(targets.channels[channel])) return 0;
    return decisions::least_error_of_month * std::abs(mean_of_measured(targets, channel));
}

double kappa_of(const LoopData& data, std::size_t channel,
                std::span<const double> residuals) {
    const study::Targets& targets = data.targets;
    std::map<int, double> sums;
    double squares = 0;
    for (std::size_t k = targets.first[channel]; k < targets.first[channel + 1]; ++k) {
        if (std::isnan(targets.measured[k])) continue;
        sums[block_at(data.begins[k], data.training().from, decisions::days_of_noise)] +=
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
    effects::add_planes_of_refinements(building.building);
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
    constexpr std::chrono::hours first{decisions::hours_of_state};
    auto readings = study::readings_of(building, period);
    const bool is_short = period.to - period.from < decisions::least_times_state * first;
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
    const int first = physics::month_at(training().from);
    for (const physics::Seconds begin : begins)
        of_readings.push_back(by_month ? physics::month_at(begin) - first
                                       : block_at(begin, training().from, days));
    return of_readings;
}

std::vector<std::size_t> whole_structure(const LoopData& data,
                                         const std::vector<std::size_t>& structure) {
    std::vector<std::size_t> whole = data.building.structure;
    whole.insert(whole.end(), structure.begin(), structure.end());
    return whole;
}

namespace {

void change_structure(const std::vector<std::size_t>& structure,
                      physics::Building& building) {
    for (const std::size_t index : structure)
        if (const auto change = effects::refinements()[index].change)
            if (!change(building))
                throw CannotSimulate(fmt::format("nothing for '{}' to change",
                                                 effects::refinements()[index].name));
}

/// What the description declares, of a building with the structure.
effects::DeclaredEffects declared_in(const LoopData& data,
                                     const std::vector<std::size_t>& structure) {
    effects::DeclaredEffects declared = *data.building.declared_effects;
    declared.building.planes = data.building.building.planes;  // of every refinement
    change_structure(structure, declared.building);
    return declared;
}

/// \param of  a building, or its loads
template <class Of>
std::shared_ptr<const physics::Drive> with_declared(
    const LoopData& data, const std::vector<std::size_t>& structure, const Of& of,
    std::shared_ptr<const physics::Drive> drive) {
    physics::Drive changed = *drive;
    try {
        effects::write_profiles(declared_in(data, structure), of, data.building.weather,
                                changed);
    } catch (const CannotSimulate&) {
        return drive;
    }
    return std::make_shared<physics::Drive>(std::move(changed));
}

}  // namespace

std::shared_ptr<const physics::Drive> drive_with_loads(
    const LoopData& data, const std::vector<std::size_t>& structure,
    const effects::ModelSeries& loads, std::shared_ptr<const physics::Drive> drive) {
    return with_declared(data, structure, loads, std::move(drive));
}

Place make_place(const LoopData& data, const std::vector<std::size_t>& structure,
                 std::shared_ptr<const physics::Drive> drive) {
    auto described = std::make_shared<physics::Building>(data.building.building);
    change_structure(structure, *described);
    Place place;
    place.building = *described;
    place.described = described;
    place.drive = std::move(drive);
    if (data.building.declared_effects && !structure.empty())
        place.drive = with_declared(data, structure, *described, place.drive);
    add_parameters(data, place);
    add_structure(structure, place);
    place.surroundings =
        std::make_shared<effects::Surroundings>(effects::make_surroundings(
            *described, *place.drive, data.building.weather, data.training().from));
    place.surroundings->clock =
        effects::wall_clock_of(data.building.profiles, data.building.weather.site);
    add_columns_of_job(data, *place.drive, *place.surroundings);
    place.channels = data.targets.channels;
    return place;
}

effects::Surroundings surroundings_of(const Place& place) {
    effects::Surroundings surroundings = *place.surroundings;
    surroundings.building = &place.building;
    surroundings.drive = place.drive.get();
    return surroundings;
}

namespace {

/// Functions, then those of the structure.
std::vector<effects::Effect> all_effects_of(const Place& place,
                                            const std::vector<effects::Effect>& added) {
    std::vector<effects::Effect> all = place.functions;
    all.reserve(all.size() + place.always.size() + added.size());
    for (const Refinement::Always& always : place.always) all.push_back(always.effect);
    all.insert(all.end(), added.begin(), added.end());
    return all;
}

/// Functions are there as they are: their coefficients, which come first, are 1 in the
/// building and no parameters of it any more.
void hold_functions(const Place& place, physics::Building& building,
                    std::vector<physics::Parameter>& parameters) {
    const auto n = static_cast<std::ptrdiff_t>(place.functions.size());
    if (n == 0) return;
    const std::vector<physics::Parameter> held(parameters.begin(),
                                               parameters.begin() + n);
    parameters.erase(parameters.begin(), parameters.begin() + n);
    const physics::Building without = building;
    physics::apply(without, held, std::vector<double>(held.size(), 1.0), building);
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
    std::vector<effects::Effect> all = all_effects_of(place, added);
    effects::Placed placed = effects::place(all, surroundings_of(place));
    hold_functions(place, placed.building, placed.parameters);
    all.erase(all.begin(),
              all.begin() + static_cast<std::ptrdiff_t>(place.functions.size()));
    built.placed = std::make_shared<const effects::Placed>(std::move(placed));
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
                effects::limits_of(always.mean, always.sd, always.least, always.most);
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

const study::FitModel& OneMore::with(const std::vector<const effects::Effect*>& effects) {
    effects::Placer placer = placer_;
    for (const effects::Effect* effect : effects) effects::put(*effect, placer);
    n_effects_ = effects.size();
    fit_model_.reset();  // it refers to what changes now
    building_ = placer.building();
    placer.write_profiles(drive_);
    parameters_ = place_.parameters;
    std::vector<physics::Parameter> placed = placer.parameters();
    hold_functions(place_, building_, placed);
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

double share_of_meter(double mean, double largest) {
    constexpr double least_share = decisions::least_share_of_meter;
    return largest > 0 ? std::clamp(mean / (decisions::share_of_largest * largest),
                                    least_share, 1.0)
                       : least_share;
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
        const double met = decisions::met_exactly * noise[c].sigma;
        sum +=
            noise[c].share * n / noise[c].kappa *
            std::log(std::max(squares[c] + noise[c].least * noise[c].least, met * met));
    }
    return sum;
}

}  // namespace bemcal::loop
