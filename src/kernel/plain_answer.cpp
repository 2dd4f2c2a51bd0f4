/// A batch's answer made plainly: simulate, predict, aggregate, and compare with the
/// readings interval by interval and month by month.
/// Follows from meters' functions and the definition of ErrorSums. It is slow on purpose,
/// as the reference for reduction. From sums to metrics is left to metrics.
#include "kernel/plain_answer.hpp"

#include <cmath>

namespace bemcal::kernel {

namespace {

ErrorSums compare_all(const std::vector<double>& simulated,
                      const std::vector<double>& measured) {
    ErrorSums sums;
    for (std::size_t k = 0; k < measured.size(); ++k)
        compare_one(simulated[k], measured[k], sums);
    return sums;
}

/// Sums, or means, over the intervals of each month that have a reading.
ErrorSums compare_months(const std::vector<double>& simulated, const Readings& readings,
                         const std::vector<int>& month_of_interval, int n_months) {
    ErrorSums sums;
    for (int month = 0; month < n_months; ++month) {
        double n = 0, shown = 0, read = 0;
        for (std::size_t k = 0; k < simulated.size(); ++k) {
            if (month_of_interval[k] != month || std::isnan(readings.values[k])) continue;
            n += 1;
            shown += simulated[k];
            read += readings.values[k];
        }
        const double divisor =
            readings.quantity == physics::Quantity::air_temperature ? n : 1;
        if (n > 0) compare_one(shown / divisor, read / divisor, sums);
    }
    return sums;
}

}  // namespace

void compare_one(double simulated, double measured, ErrorSums& sums) {
    if (std::isnan(measured)) return;
    const double error = simulated - measured;
    sums.n += 1;
    sums.error += error;
    sums.square += error * error;
    sums.simulated += simulated;
    sums.simulated_square += simulated * simulated;
    sums.product += simulated * measured;
    if (measured == 0) return;
    sums.n_relative += 1;
    sums.relative += std::fabs(error) / std::fabs(measured);
}

bool is_finer_than_month(physics::Interval interval) {
    return interval == physics::Interval::step || interval == physics::Interval::hourly ||
           interval == physics::Interval::daily;
}

void add_errors(const std::vector<double>& simulated, const physics::TimeAxis& period,
                const Readings& readings, PointAnswer& answer) {
    answer.errors.push_back(compare_all(simulated, readings.values));
    answer.monthly_errors.emplace_back();
    if (!is_finer_than_month(readings.interval)) return;
    const std::vector<int> bounds = physics::interval_bounds(period, readings.interval);
    const std::vector<int> months = month_of_steps(period);
    std::vector<int> month_of_interval;
    for (std::size_t k = 0; k + 1 < bounds.size(); ++k)
        month_of_interval.push_back(months[static_cast<std::size_t>(bounds[k + 1] - 1)]);
    answer.monthly_errors.back() =
        compare_months(simulated, readings, month_of_interval, months.back() + 1);
}

std::vector<int> month_of_steps(const physics::TimeAxis& period) {
    const std::vector<int> bounds =
        physics::interval_bounds(period, physics::Interval::monthly);
    std::vector<int> months;
    for (std::size_t month = 0; month + 1 < bounds.size(); ++month)
        months.resize(static_cast<std::size_t>(bounds[month + 1]),
                      static_cast<int>(month));
    return months;
}

PointAnswer plain_answer(const physics::Building& building, const physics::Drive& drive,
                         const Request& request) {
    const physics::TimeAxis period = drive.period();
    const physics::Trajectory trajectory = physics::simulate(building, drive);
    const auto shown = [&](physics::Quantity quantity) {
        return physics::predict(building, drive, trajectory, quantity);
    };
    PointAnswer answer;
    for (physics::Quantity quantity : request.annual)
        answer.annual.push_back(
            physics::aggregate(shown(quantity), {0, period.n_steps}, quantity).front());
    const std::vector<int> months =
        physics::interval_bounds(period, physics::Interval::monthly);
    for (physics::Quantity quantity : request.monthly) {
        const std::vector<double> totals =
            physics::aggregate(shown(quantity), months, quantity);
        answer.monthly.insert(answer.monthly.end(), totals.begin(), totals.end());
    }
    for (const Readings& readings : request.readings)
        add_errors(physics::aggregate(shown(readings.quantity),
                                      physics::interval_bounds(period, readings.interval),
                                      readings.quantity),
                   period, readings, answer);
    return answer;
}

}  // namespace bemcal::kernel
