/// From zones' heat to meters: divided by the plant's efficiency or COP, with auxiliary
/// power and the loads on the carrier; then summed over the calendar's intervals.
/// Follows from the definitions of efficiency and COP, and of a plant that cycles from
/// cycling.hpp. Left out: distribution and storage losses, export of power; zones are
/// summed, not metered apart.
#include "physics/meters.hpp"

#include "base/error.hpp"
#include "physics/cycling.hpp"

#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace bemcal::physics {

namespace {

/// An efficiency or COP at a step. Throws CannotSimulate where nothing can be divided
/// by it.
double efficiency_at(const Drive& drive, const Input& efficiency, int step,
                     const char* name) {
    const double value = drive.at(efficiency, step);
    if (!(value > 0))
        throw CannotSimulate(
            fmt::format("step {}: {} = {} is not above 0", step, name, value));
    return value;
}

/// What a meter shows of what flows through it [-]. Throws CannotSimulate.
double factor_at(const Drive& drive, const Input& factor, int step) {
    const double value = drive.at(factor, step);
    if (!(value >= 0) || !std::isfinite(value))
        throw CannotSimulate(fmt::format(
            "step {}: factor of a meter = {} is not a number >= 0", step, value));
    return value;
}

/// The loads that a carrier's meter sees at a step [W].
double loads_on(const Building& building, const Drive& drive, Carrier carrier, int step) {
    double power = 0;
    for (const Zone& zone : building.zones)
        for (const Load& load : zone.loads)
            if (load.carrier == carrier)
                power +=
                    zone.floor_area * drive.at(load.density, step) /
                    efficiency_at(drive, load.efficiency, step, "efficiency of a load");
    return power;
}

std::vector<int> every_step(int n_steps) {
    std::vector<int> bounds(static_cast<std::size_t>(n_steps) + 1);
    std::iota(bounds.begin(), bounds.end(), 0);
    return bounds;
}

/// Where the calendar's interval ends that a time lies in.
Seconds end_of_interval(Seconds time, Interval interval) {
    using namespace std::chrono;
    if (interval == Interval::hourly) return floor<hours>(time) + hours(1);
    const sys_days day = floor<days>(time);
    if (interval == Interval::daily) return day + days(1);
    const year_month_day date(day);
    if (interval == Interval::monthly)
        return sys_days((date.year() / date.month() + months(1)) / 1);
    return sys_days((date.year() + years(1)) / January / 1);
}

std::vector<int> own_bounds(const TimeAxis& period, const std::vector<Seconds>& times) {
    std::vector<int> bounds{0};
    for (const Seconds time : times) {
        const int step = period.step_of(time);
        if (step > bounds.back() && step < period.n_steps) bounds.push_back(step);
    }
    if (period.n_steps > 0) bounds.push_back(period.n_steps);
    return bounds;
}

double mean_air_temperature(const Building& building, const Trajectory& trajectory,
                            std::size_t step) {
    double sum = 0;
    for (std::size_t zone = 0; zone < building.zones.size(); ++zone)
        sum += building.zones[zone].floor_area * trajectory.zones[zone].theta_air[step];
    return sum / building.floor_area();
}

/// Power on the meter at a step of the period [W].
double power_on(const Building& building, const MeterForm& form,
                const Trajectory& trajectory, std::size_t step) {
    PlantPowers sum;
    for (std::size_t z = 0; z < trajectory.zones.size(); ++z) {
        const ZoneTrajectory& zone = trajectory.zones[z];
        sum.add(building.plant, building.zones[z].floor_area, zone.heating[step],
                zone.cooling[step], zone.fan.empty() ? 0 : zone.fan[step]);
    }
    return form.per_heating * sum.heating + form.per_cooling * sum.cooling + form.source +
           form.per_fan * sum.fan + form.per_lost_heating * sum.lost.heating +
           form.per_lost_cooling * sum.lost.cooling;
}

}  // namespace

const char* name_of(Interval interval) {
    constexpr const char* names[] = {"step", "hourly", "daily", "monthly", "annual"};
    return names[static_cast<std::size_t>(interval)];
}

std::vector<int> interval_bounds(const TimeAxis& period, const Intervals& intervals) {
    const Interval interval = intervals;
    if (interval == Interval::step) return every_step(period.n_steps);
    if (intervals.are_own()) return own_bounds(period, intervals.bounds);
    std::vector<int> bounds;
    Seconds end = period.start;
    for (int step = 0; step < period.n_steps; ++step) {
        const Seconds begin = period.begin_of(step);
        if (begin < end) continue;
        bounds.push_back(step);
        end = end_of_interval(begin, interval);
    }
    bounds.push_back(period.n_steps);
    return bounds;
}

std::vector<double> predict(const Building& building, const Drive& drive,
                            const Trajectory& trajectory, Quantity quantity) {
    const std::size_t n = static_cast<std::size_t>(drive.n_steps() - drive.n_warm_up);
    const double kWh_per_W = drive.axis.step_s / 3.6e6;
    std::vector<double> shown(n);
    for (std::size_t step = 0; step < n; ++step) {
        if (quantity == Quantity::air_temperature) {
            shown[step] = mean_air_temperature(building, trajectory, step);
            continue;
        }
        const MeterForm form = meter_form(building, drive, quantity,
                                          drive.n_warm_up + static_cast<int>(step));
        shown[step] = power_on(building, form, trajectory, step) * kWh_per_W;
    }
    return shown;
}

std::vector<double> aggregate(const std::vector<double>& steps,
                              const std::vector<int>& bounds, Quantity quantity) {
    std::vector<double> intervals;
    for (std::size_t k = 0; k + 1 < bounds.size(); ++k) {
        double sum = 0;
        for (int step = bounds[k]; step < bounds[k + 1]; ++step)
            sum += steps[static_cast<std::size_t>(step)];
        const bool is_mean = is_temperature(quantity);
        intervals.push_back(is_mean ? sum / (bounds[k + 1] - bounds[k]) : sum);
    }
    return intervals;
}

MeterForm true_meter_form(const Building& building, const Drive& drive, Quantity quantity,
                          int step) {
    if (quantity == Quantity::heating) return {1, 0, 0};
    if (quantity == Quantity::cooling) return {0, 1, 0};
    const Carrier carrier = carrier_of(quantity);
    if (carrier == Carrier::none) return {};
    const Plant& plant = building.plant;
    MeterForm form;
    if (plant.heating_carrier == carrier)
        form.per_heating = form.per_lost_heating =
            1 /
            efficiency_at(drive, plant.heating_efficiency, step, "heating_efficiency");
    if (plant.cooling_carrier == carrier)
        form.per_cooling = form.per_lost_cooling =
            1 / efficiency_at(drive, plant.cooling_cop, step, "cooling_cop");
    if (carrier == Carrier::electricity) {
        form.per_heating += plant.heating_auxiliary;
        form.per_cooling += plant.cooling_auxiliary;
        form.per_fan = 1;
    }
    form.source = loads_on(building, drive, carrier, step);
    return form;
}

MeterForm meter_form(const Building& building, const Drive& drive, Quantity quantity,
                     int step) {
    const Input& factor = building.meter_factor[static_cast<std::size_t>(quantity)];
    MeterForm form = true_meter_form(building, drive, quantity, step);
    const double shown = factor_at(drive, factor, step);
    for (double* part : {&form.per_heating, &form.per_cooling, &form.source,
                         &form.per_fan, &form.per_lost_heating, &form.per_lost_cooling})
        *part *= shown;
    return form;
}

}  // namespace bemcal::physics
