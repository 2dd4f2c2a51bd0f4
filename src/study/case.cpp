/// Cuts a case's weather, schedules and meters to a period. A reading counts where its
/// whole interval lies within the period.
/// Follows from the calendar. A room whose air is measured starts at its mean of a day,
/// with as much warm-up as data reach back.
/// Where no hours are known before a period, `make_drive` repeats some for the warm-up.
#include "study/case.hpp"

#include "base/nan.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace bemcal::study {
namespace {

constexpr double missing = nan;
constexpr std::chrono::hours a_day{24};

/// Bounds of the intervals that lie whole within the period; a cut last one has no
/// reading.
std::vector<int> whole_intervals(physics::TimeAxis axis,
                                 const physics::Intervals& intervals) {
    std::vector<int> bounds = physics::interval_bounds(axis, intervals);
    axis.n_steps += 1;
    const bool last_is_whole =
        physics::interval_bounds(axis, intervals).size() > bounds.size();
    if (!last_is_whole) bounds.pop_back();
    return bounds;
}

double reading_at(const Meter& meter, physics::Seconds time) {
    const int step = meter.axis.step_of(time);
    if (step < 0 || step >= meter.axis.n_steps || meter.axis.begin_of(step) != time)
        return missing;
    return meter.values[static_cast<std::size_t>(step)];
}

/// Whether an interval begins with a period that begins then; days and months cut at
/// their begin have their reading before it.
bool begins_at(const physics::Intervals& intervals, physics::Seconds time) {
    return !intervals.are_own() || std::ranges::binary_search(intervals.bounds, time);
}

kernel::Readings readings_of(const Meter& meter, const physics::TimeAxis& axis) {
    if (meter.interval == physics::Interval::step && meter.axis.step_s != axis.step_s)
        throw std::invalid_argument("meter " + meter.name +
                                    " is read at another step than the simulation's");
    kernel::Readings readings{meter.quantity, meter.interval, {}};
    readings.values.assign(physics::interval_bounds(axis, meter.interval).size() - 1,
                           missing);
    const std::vector<int> bounds = whole_intervals(axis, meter.interval);
    for (std::size_t k = 0; k + 1 < bounds.size(); ++k)
        if (const physics::Seconds begin = axis.begin_of(bounds[k]);
            begins_at(meter.interval, begin))
            readings.values[k] = reading_at(meter, begin);
    return readings;
}

/// Mean of the first day's readings of the air temperature from `begin` on; NaN: none.
double measured_air(const Case& building, physics::Seconds begin) {
    for (const Meter& meter : building.meters) {
        if (meter.quantity != physics::Quantity::air_temperature) continue;
        const physics::TimeAxis day = meter.axis.between(begin, begin + a_day);
        double sum = 0, n = 0;
        for (int step = 0; step < day.n_steps; ++step) {
            const double reading = reading_at(meter, day.begin_of(step));
            if (std::isnan(reading)) continue;
            sum += reading;
            n += 1;
        }
        if (n > 0) return sum / n;
    }
    return missing;
}

/// A room whose air temperature is measured starts from that: its warm-up then needs no
/// repetition, and is shorter where the data begin later.
struct Start {
    int warm_up_hours;
    double theta;
    bool is_known;
};
Start start_of(const Case& building, const Period& period) {
    const int known = physics::known_hours_before(building.weather, building.building,
                                                  building.profiles, period.from,
                                                  building.warm_up_hours);
    const double theta = measured_air(building, period.from - std::chrono::hours(known));
    if (std::chrono::hours(known) < a_day || std::isnan(theta))
        return {building.warm_up_hours, physics::start_temperature,
                known == building.warm_up_hours};
    return {known, theta, true};
}

}  // namespace

std::vector<ParameterPrior> priors_of(const Case& building) {
    if (!building.priors.empty()) return building.priors;
    std::vector<ParameterPrior> priors;
    priors.reserve(building.parameters.size());
    for (const physics::Parameter& parameter : building.parameters)
        priors.push_back({stats::uniform_prior(parameter.least, parameter.most), {}});
    return priors;
}

physics::TimeAxis axis_of(const Case& building, const Period& period) {
    return {period.from, building.step_s,
            static_cast<int>((period.to - period.from).count() / building.step_s)};
}

std::vector<physics::Seconds> begins_of(const physics::TimeAxis& axis,
                                        const physics::Intervals& intervals) {
    const std::vector<int> bounds = physics::interval_bounds(axis, intervals);
    std::vector<physics::Seconds> begins;
    begins.reserve(bounds.size());
    for (std::size_t k = 0; k + 1 < bounds.size(); ++k)
        begins.push_back(axis.begin_of(bounds[k]));
    return begins;
}

bool knows_state_before(const Case& building, const Period& period) {
    return start_of(building, period).is_known;
}

bool has_reading(const std::vector<double>& values) {
    return !std::ranges::all_of(values, [](double value) { return std::isnan(value); });
}

double hours_of(const Period& period) {
    return static_cast<double>((period.to - period.from).count()) / 3600;
}

YearSpan years_of(const std::vector<Period>& periods) {
    YearSpan years{9999, 0};
    for (const Period& period : periods) {
        const physics::Seconds last = period.to - std::chrono::seconds(1);
        years.first = std::min(years.first, physics::calendar_step(period.from).year);
        years.last = std::max(years.last, physics::calendar_step(last).year);
    }
    return years;
}

const Period& period_of(const Case& building, const std::string& name) {
    for (const Period& period : building.periods)
        if (period.name == name) return period;
    return building.periods.at(0);
}

physics::Drive drive_of(const Case& building, const Period& period) {
    return drive_of(building, building.building, period);
}

physics::Drive drive_of(const Case& building, const physics::Building& variant,
                        const Period& period) {
    const Start start = start_of(building, period);
    physics::Drive drive = physics::make_drive(
        building.weather, variant, building.profiles, period.from, period.to,
        building.step_s, start.warm_up_hours, building.sky, building.planes.get());
    drive.theta_start = start.theta;
    if (building.declared_effects)
        effects::write_profiles(*building.declared_effects, variant, building.weather,
                                drive);
    return drive;
}

std::vector<kernel::Readings> readings_of(const Case& building, const Period& period) {
    std::vector<kernel::Readings> readings;
    readings.reserve(building.meters.size());
    for (const Meter& meter : building.meters)
        readings.push_back(readings_of(meter, axis_of(building, period)));
    return readings;
}

}  // namespace bemcal::study
