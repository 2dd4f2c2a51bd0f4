/// Tells of meters that no longer send: their last day against the middle one of the
/// stock. Follows from the daily sums that a night keeps of each building's first meter
/// by the hour. Leaves out meters by the month, and what was not worked on: failed, or
/// put off.
#include "stock/stopped.hpp"

#include "job/stock.hpp"
#include "physics/calendar.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace bemcal::stock {

namespace {

constexpr std::string_view action =
    "kept; later days say nothing of it: see whether the meter still sends";

}  // namespace

double end_of_readings(const StockRecord& record) {
    if (record.is_failed() || record.status == "postponed") return 0;
    std::size_t n = record.daily.size();
    while (n > 0 && std::isnan(record.daily[n - 1])) --n;
    return n == 0 ? 0 : record.daily_start + static_cast<double>(n);
}

double middle_end(std::vector<double> ends) {
    std::erase(ends, 0);
    if (ends.empty()) return 0;
    const auto middle = ends.begin() + static_cast<std::ptrdiff_t>(ends.size() / 2);
    std::ranges::nth_element(ends, middle);
    return *middle;
}

void tell_of_end(double middle, StockRecord& record) {
    std::erase_if(record.findings, [](const study::DataDecision& finding) {
        return finding.action == action;
    });
    const double end = end_of_readings(record), behind = middle - end;
    if (end == 0 || behind <= job::most_days_late) return;
    const std::chrono::days last(static_cast<int>(end) - 1);
    record.findings.push_back(
        {"daily readings",
         fmt::format("end on {}, {:.0f} days before those of most of the stock",
                     physics::format_date(physics::Seconds(last)), behind),
         std::string(action)});
}

}  // namespace bemcal::stock
