/// Lays readings on the drive's steps, and finds what has to be shown for a request:
/// nothing, powers, or the air too. Totals come from the kernel's sums where shares are
/// constant.
/// Follows from Request (batch) and the calendar's intervals. Sums are left to reduction;
/// a reading is needed for each interval, NaN where it is missing.
#include "kernel/request_plan.hpp"

#include "base/error.hpp"
#include "kernel/plain_answer.hpp"

#include <cmath>

namespace bemcal::kernel {

namespace {

/// What the sums contain of the readings: their number, total (in product's place: of
/// squares).
void count_reading(double measured, ErrorSums& sums) {
    if (std::isnan(measured)) return;
    sums.n += 1;
    sums.simulated += measured;
    sums.product += measured * measured;
    if (measured != 0) sums.n_relative += 1;
}

void lay_interval(ReadingPlan& plan, const BatchPlan& batch, int begin, int end,
                  double reading) {
    const bool is_mean = plan.quantity == physics::Quantity::air_temperature;
    const auto last = static_cast<std::size_t>(batch.drive.n_warm_up + end - 1);
    plan.every_step = plan.every_step && end - begin == 1;
    plan.closes[last] = static_cast<int>(plan.measured.size());
    plan.measured.push_back(reading);
    plan.inverse.push_back(reading == 0 ? 0 : 1 / std::fabs(reading));
    plan.factor.push_back(is_mean ? 1.0 / (end - begin) : kWh_per_W(batch.drive));
}

ReadingPlan plan_reading(const Readings& readings, const BatchPlan& batch) {
    ReadingPlan plan;
    plan.quantity = readings.quantity;
    plan.by_month = is_finer_than_month(readings.interval);
    plan.closes.assign(static_cast<std::size_t>(batch.drive.n_steps()), -1);
    const std::vector<int> bounds = batch.bounds_of(readings.interval);
    require(readings.values.size() + 1 == bounds.size(), "a reading for each interval");
    for (std::size_t k = 0; k + 1 < bounds.size(); ++k)
        lay_interval(plan, batch, bounds[k], bounds[k + 1], readings.values[k]);
    plan.months.resize(static_cast<std::size_t>(batch.n_months()));
    for (const Span& month : batch.months)
        for (int step = month.begin; step < month.end; ++step) {
            const int interval = plan.closes[static_cast<std::size_t>(step)];
            if (interval >= 0)
                count_reading(plan.measured[static_cast<std::size_t>(interval)],
                              plan.months[static_cast<std::size_t>(month.month)]);
        }
    return plan;
}

/// The sums of a quantity that cannot be made from those of the powers: its steps are
/// shown.
bool is_summed(physics::Quantity quantity, const BatchPlan& batch) {
    return quantity == physics::Quantity::air_temperature || batch.supplied ||
           batch.meter(quantity).shares_vary;
}

std::vector<std::vector<double>> count_rows(const Partition& rows,
                                            const std::vector<Span>& months) {
    std::vector<std::vector<double>> all;
    all.reserve(months.size());
    for (const Span& month : months) {
        std::vector<double>& counts =
            all.emplace_back(static_cast<std::size_t>(rows.size()));
        for (int step = month.begin; step < month.end; ++step)
            counts[static_cast<std::size_t>(
                rows.class_of[static_cast<std::size_t>(step)])] += 1;
    }
    return all;
}

}  // namespace

double kWh_per_W(const physics::Drive& drive) {
    return drive.axis.step_s / 3.6e6;
}

RequestPlan::RequestPlan(const Request& wanted, const BatchPlan& batch)
    : request(wanted) {
    for (const Readings& each : request.readings) {
        readings.push_back(plan_reading(each, batch));
        need(show_for(each.quantity));
    }
    for (const auto* quantities : {&request.annual, &request.monthly})
        for (physics::Quantity quantity : *quantities) add_total(quantity, batch);
    compared = summed.empty() && readings.size() == 1 && readings[0].every_step &&
               batch.is_metered_in_one_pass(readings[0].quantity);
}

void RequestPlan::need(Show more) {
    show = std::max(show, more);
}

void RequestPlan::add_total(physics::Quantity quantity, const BatchPlan& batch) {
    if (!is_summed(quantity, batch)) {
        row_counts[static_cast<std::size_t>(quantity)] =
            count_rows(batch.meter(quantity).rows, batch.months);
        return;
    }
    if (std::find(summed.begin(), summed.end(), quantity) == summed.end())
        summed.push_back(quantity);
    need(show_for(quantity));
}

}  // namespace bemcal::kernel
