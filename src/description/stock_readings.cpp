/// Looks at a column before it is read as a meter: first and last day, hours, total, and
/// a step that readings are whole multiples of.
/// Follows from rounded pulses: the step is sought by least squares around the usual
/// distance of frequent values, and taken where it is no round number.
/// Leaves out gaps, and steps below 20 of the finest ones.
#include "description/stock_readings.hpp"

#include "checks/data_values.hpp"
#include "checks/values.hpp"
#include "input/intervals.hpp"
#include "physics/calendar.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::description {

namespace {

using physics::Seconds;

constexpr double least_multiples = 0.9, half_width = 0.08;

/// 1, 2, 2.5 or 5 times a power of ten, within a hundredth.
bool is_round(double value) {
    const double scaled = value / std::pow(10, std::floor(std::log10(value)));
    return std::ranges::any_of(std::initializer_list<double>{1, 2, 2.5, 5, 10},
                               [&](double r) { return std::abs(scaled / r - 1) < 0.01; });
}

/// Readings in finest steps.
std::map<long long, int> counts_of(const std::vector<double>& values, double finest) {
    std::map<long long, int> counts;
    for (const double value : values)
        if (value > 0) ++counts[std::llround(value / finest)];
    return counts;
}

/// The power of ten that all readings are multiples of, 0.001 at least.
double finest_step(const std::vector<double>& values) {
    const auto are_multiples = [&](double step) {
        return std::ranges::all_of(values, [&](double value) {
            return std::isnan(value) ||
                   std::abs(value / step - std::round(value / step)) < 1e-6;
        });
    };
    for (const double step : {10.0, 1.0, 0.1, 0.01})
        if (are_multiples(step)) return step;
    return 0.001;
}

struct Multiples {
    double share = 0;     ///< of the readings, near a multiple
    double distance = 0;  ///< of all readings from the next one, squared mean, of q
};

/// In finest steps. Of any readings a share of 2 (half_width q + 1) / q is near.
Multiples multiples_of(const std::map<long long, int>& counts, double q) {
    Multiples found;
    double all = 0;
    for (const auto& [value, n] : counts) {
        const auto reading = static_cast<double>(value);
        const double off = std::abs(reading - q * std::round(reading / q));
        all += n;
        found.distance += n * off * off / (q * q);
        if (off <= 1 + half_width * q) found.share += n;
    }
    return {found.share / all, found.distance / all};
}

/// The middle distance between values that are often read, at least 5 finest steps.
double usual_distance(const std::map<long long, int>& counts, std::size_t n_readings) {
    std::vector<double> distances;
    long long before = 0;
    for (const auto& [value, n] : counts) {
        if (1000 * static_cast<std::size_t>(n) < n_readings) continue;
        if (value - before >= 5) distances.push_back(static_cast<double>(value - before));
        before = value;
    }
    if (distances.size() < 8) return 0;
    std::ranges::nth_element(
        distances, distances.begin() + static_cast<std::ptrdiff_t>(distances.size()) / 2);
    return distances[distances.size() / 2];
}

/// The last day that is whole at this time.
std::string day_before(Seconds end) {
    return physics::format_date(std::chrono::floor<std::chrono::days>(end) -
                                std::chrono::days(1));
}

}  // namespace

ReadingsLook look_for_quantum(const std::vector<double>& values) {
    ReadingsLook look;
    const double finest = finest_step(values);
    const auto counts = counts_of(values, finest);
    const double start = usual_distance(counts, values.size());
    if (start < 20) return look;
    double least = 1;
    for (double q = start - 1.5; q <= start + 1.5; q += 0.01) {
        const Multiples found = multiples_of(counts, q);
        if (found.distance >= least) continue;
        least = found.distance;
        look.quantum_share = found.share;
        look.quantum = q * finest;
    }
    if (look.quantum_share < least_multiples || is_round(look.quantum))
        return ReadingsLook{};
    return look;
}

namespace {

/// Of the months that are whole between two days.
std::vector<Seconds> months_between(Seconds from, Seconds to,
                                    physics::Interval interval) {
    std::vector<Seconds> bounds;
    for (Seconds at = input::interval_begin(from, interval); at <= to;
         at = input::next_interval(at, interval))
        if (at >= from) bounds.push_back(at);
    return bounds;
}

/// Days that are whole, from the first reading to the last.
void look_at_rows(const LookRows& rows, physics::Interval interval, ReadingsLook& look) {
    const auto has_reading = [](double value) { return !std::isnan(value); };
    const auto first = std::ranges::find_if(rows.values, has_reading);
    if (first == rows.values.end()) return;
    std::size_t last = rows.values.size() - 1;
    while (std::isnan(rows.values[last])) --last;
    const std::vector<Seconds>& begins = rows.stamps.begins;
    const std::chrono::seconds step(rows.stamps.step_s);
    look.hours = static_cast<double>(std::ranges::count_if(rows.values, has_reading)) *
                 static_cast<double>(step.count()) / 3600;
    const Seconds from = begins[static_cast<std::size_t>(first - rows.values.begin())],
                  to = begins[last] + step;
    look.first_day = physics::format_date(from);
    look.last_day = day_before(to);
    look.hours_each = static_cast<double>(step.count()) / 3600;
    if (interval >= physics::Interval::monthly)
        look.bounds = months_between(from, to, interval);
}

std::vector<input::Bill> bills_of(const LookRows& rows, const LookColumns& columns) {
    std::vector<input::TimeNote> notes;
    if (!columns.counts)
        return input::bills_in(rows.csv, columns.bills, rows.stamps, rows.rules,
                               rows.values, columns.interval, false, notes);
    auto bills = input::reads_of_register(rows.csv, columns.bills, rows.stamps,
                                          rows.values, notes);
    checks::take_differences(bills);
    return bills;
}

void look_at_bills(std::vector<input::Bill> bills, ReadingsLook& look) {
    std::erase_if(bills, [](const input::Bill& bill) { return std::isnan(bill.value); });
    if (bills.empty()) return;
    look.bounds = input::bounds_of(bills);
    for (const input::Bill& bill : bills)
        look.hours += static_cast<double>((bill.to - bill.from).count()) / 3600;
    look.first_day = physics::format_date(bills.front().from);
    look.last_day = day_before(bills.back().to);
}

/// What was used: as it was read, or from one read of a register to the next.
std::vector<double> uses_of(const LookRows& rows, bool counts,
                            const std::vector<input::Bill>& bills) {
    if (!counts) return rows.values;
    if (bills.empty()) return checks::differences_of(rows.values);
    std::vector<double> uses;
    uses.reserve(bills.size());
    for (const input::Bill& bill : bills) uses.push_back(bill.value);
    return uses;
}

/// Of the readings that are no codes for missing.
double total_of(const std::vector<double>& values) {
    double total = 0, of_codes = 0;
    for (const double value : values)
        if (!std::isnan(value)) total += value;
    for (const checks::Code& code : checks::codes_in({values}))
        of_codes += code.value * static_cast<double>(code.at.size());
    return total - of_codes;
}

}  // namespace

ReadingsLook look_at(const LookRows& rows, const LookColumns& columns) {
    const bool is_by_bill = rows.stamps.step_s > physics::day_s;
    const auto bills = is_by_bill ? bills_of(rows, columns) : std::vector<input::Bill>();
    const std::vector<double> uses = uses_of(rows, columns.counts, bills);
    ReadingsLook look = look_for_quantum(uses);
    look.total = total_of(uses);
    if (is_by_bill)
        look_at_bills(bills, look);
    else
        look_at_rows(rows, columns.interval, look);
    return look;
}

}  // namespace bemcal::description
