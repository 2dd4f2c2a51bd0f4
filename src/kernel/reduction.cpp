/// A group's sums over the period. Where powers alone are wanted the kernel's own sums
/// are enough; all else is shown chunk by chunk and reduced while in the first-level
/// cache.
/// Follows from ErrorSums: simulated^2 = e^2 + 2 e measured + measured^2. What has to be
/// shown is request_plan's; the reference is plain_answer.
#include "kernel/reduction.hpp"

#include "kernel/plain_answer.hpp"

namespace bemcal::kernel {

namespace {

bool is_mean(physics::Quantity quantity) {
    return physics::is_temperature(quantity);
}

double steps_in(const BatchPlan& batch, std::size_t month) {
    return batch.months[month].end - batch.months[month].begin;
}

}  // namespace

Reduction::Reduction(const RequestPlan& request, const BatchPlan& batch)
    : request_(request),
      batch_(batch),
      powers_(2 * months(), batch.table.lanes),
      summed_(request.summed.size() * months(), batch.table.lanes),
      error_(request.readings.size() * months(), batch.table.lanes) {
    for (std::size_t k = 0; k < request.readings.size(); ++k)
        sums_.emplace_back(ErrorColumn::count, batch.table.lanes);
}

void Reduction::run(BatchGroup& group) {
    for (LaneArray* array : {&powers_, &summed_, &error_}) array->clear();
    for (LaneArray& sums : sums_) sums.clear();
    const bool in_chunks = request_.show != Show::sums && !request_.compared;
    const std::vector<Span>& spans = in_chunks ? batch_.chunks : batch_.months;
    for (std::size_t k = 0; k < spans.size(); ++k) {
        run_span(spans[k], group);
        if (k + 1 == spans.size() || spans[k + 1].month != spans[k].month)
            close_month(static_cast<std::size_t>(spans[k].month), group);
    }
}

PointAnswer Reduction::answer(int lane, BatchGroup& group) const {
    PointAnswer answer;
    for (physics::Quantity quantity : request_.request.annual)
        answer.annual.push_back(total(quantity, {0, months()}, lane, group));
    for (physics::Quantity quantity : request_.request.monthly)
        for (std::size_t month = 0; month < months(); ++month)
            answer.monthly.push_back(total(quantity, {month, month + 1}, lane, group));
    for (std::size_t k = 0; k < sums_.size(); ++k) {
        answer.errors.push_back(errors(k, lane));
        answer.monthly_errors.push_back(monthly_errors(k, lane));
    }
    return answer;
}

void Reduction::run_span(const Span& span, BatchGroup& group) {
    if (request_.compared) return run_compared(span, group);
    const auto [begin, end, month] = span;
    const PowerRows rows = group.run(begin, end, request_.show);
    for (std::size_t k = 0; k < request_.summed.size(); ++k)
        batch_.table.add_up(
            group.show(request_.summed[k], rows, begin, end), end - begin,
            summed_.column(k * months() + static_cast<std::size_t>(month)));
    for (std::size_t k = 0; k < sums_.size(); ++k) {
        const ReadingPlan& reading = request_.readings[k];
        batch_.table.compare(reading.time(),
                             group.show(reading.quantity, rows, begin, end), begin, end,
                             sums_[k].data());
    }
}

void Reduction::run_compared(const Span& span, BatchGroup& group) {
    const ReadingPlan& reading = request_.readings.front();
    const int segment = batch_.zones[0].segment_of[static_cast<std::size_t>(span.begin)];
    batch_.table.run_compared(group.zones[0].time, group.zones[0].lanes(), segment,
                              span.begin, span.end, group.meter(reading.quantity),
                              reading.time(), sums_.front().data());
}

/// Moves the sums that are wanted by month to their month.
void Reduction::close_month(std::size_t month, BatchGroup& group) {
    const auto lanes = static_cast<std::size_t>(batch_.table.lanes);
    for (BatchGroup::Zone& zone : group.zones) {
        for (std::size_t k = 0; k < 2 * lanes; ++k)
            powers_.column(2 * month)[k] += zone.sums.data()[k];
        zone.sums.clear();
    }
    for (std::size_t k = 0; k < sums_.size(); ++k) {
        double* error = sums_[k].column(ErrorColumn::error);
        std::copy_n(error, lanes, error_.column(k * months() + month));
        std::fill_n(error, lanes, 0.0);
    }
}

/// [W steps]: shares of the powers, and every row of loads as often as it occurs.
double Reduction::total_of_powers(physics::Quantity quantity, Months span, int lane,
                                  BatchGroup& group) const {
    const int lanes = batch_.table.lanes;
    const double* form = group.meter(quantity).rows + lane;
    const auto& counts = request_.row_counts[static_cast<std::size_t>(quantity)];
    double heating = 0, cooling = 0, loads = 0;
    for (std::size_t month = span.begin; month < span.end; ++month) {
        heating += powers_.at(2 * month, lane);
        cooling += powers_.at(2 * month + 1, lane);
        const double* source = form;
        for (double steps : counts[month]) {
            loads += steps * *source;
            source += 3 * lanes;
        }
    }
    return form[lanes] * heating + form[2 * lanes] * cooling + loads;
}

double Reduction::total(physics::Quantity quantity, Months span, int lane,
                        BatchGroup& group) const {
    const std::vector<physics::Quantity>& summed = request_.summed;
    const auto place = std::find(summed.begin(), summed.end(), quantity);
    if (place == summed.end())
        return total_of_powers(quantity, span, lane, group) * kWh_per_W(batch_.drive);
    const auto first = static_cast<std::size_t>(place - summed.begin()) * months();
    double sum = 0, steps = 0;
    for (std::size_t month = span.begin; month < span.end; ++month) {
        sum += summed_.at(first + month, lane);
        steps += steps_in(batch_, month);
    }
    return is_mean(quantity) ? sum / steps : sum * kWh_per_W(batch_.drive);
}

/// From sums over e = simulated - measured: simulated^2 = e^2 + 2 e measured +
/// measured^2.
ErrorSums Reduction::errors(std::size_t reading, int lane) const {
    ErrorSums sums;
    double measured = 0, squares = 0;
    for (std::size_t month = 0; month < months(); ++month) {
        const ErrorSums& read = request_.readings[reading].months[month];
        sums.n += read.n;
        sums.n_relative += read.n_relative;
        sums.error += error_.at(reading * months() + month, lane);
        measured += read.simulated;
        squares += read.product;
    }
    const double product = sums_[reading].at(ErrorColumn::product, lane);
    sums.square = sums_[reading].at(ErrorColumn::square, lane);
    sums.relative = sums_[reading].at(ErrorColumn::relative, lane);
    sums.simulated = sums.error + measured;
    sums.product = product + squares;
    sums.simulated_square = sums.square + 2 * product + squares;
    return sums;
}

ErrorSums Reduction::monthly_errors(std::size_t reading, int lane) const {
    ErrorSums sums;
    const ReadingPlan& plan = request_.readings[reading];
    for (std::size_t month = 0; month < months() && plan.by_month; ++month) {
        const ErrorSums& read = plan.months[month];
        if (read.n == 0) continue;
        const double divisor = is_mean(plan.quantity) ? read.n : 1;
        const double measured = read.simulated / divisor;
        const double error = error_.at(reading * months() + month, lane) / divisor;
        compare_one(measured + error, measured, sums);
    }
    return sums;
}

}  // namespace bemcal::kernel
