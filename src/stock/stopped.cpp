/// Tells of meters that no longer send: their last day against the middle one of the
/// stock. Follows from the daily sums that a night keeps of each building's first meter
/// by the hour. Leaves out meters by the month, and what was not worked on: failed, or
/// put off.
#include "stock/stopped.hpp"

#include "physics/calendar.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace bemcal::stock {

namespace {

/// Files come late by days, and a fortnight is half of what a night looks at.
constexpr double most_behind = 14;
constexpr std::string_view action =
    "kept; later days say nothing of it: see whether the meter still sends";

/// Behind the last day with a reading; 0 = none is known.
double end_of(const StockRecord& record) {
    if (record.is_failed() || record.status == "postponed") return 0;
    std::size_t n = record.daily.size();
    while (n > 0 && std::isnan(record.daily[n - 1])) --n;
    return n == 0 ? 0 : record.daily_start + static_cast<double>(n);
}

}  // namespace

void LastDays::add(const StockRecord& record) {
    if (end_of(record) > 0) days_.push_back(end_of(record));
}

void LastDays::tell(StockRecord& record, bool is_told) {
    if (!is_sorted_) std::ranges::sort(days_);
    is_sorted_ = true;
    std::erase_if(record.findings, [](const study::DataDecision& finding) {
        return finding.action == action;
    });
    if (!is_told || days_.empty() || end_of(record) == 0) return;
    const double behind = days_[days_.size() / 2] - end_of(record);
    if (behind <= most_behind) return;
    const std::chrono::days last(static_cast<int>(end_of(record)) - 1);
    record.findings.push_back(
        {"daily readings",
         fmt::format("end on {}, {:.0f} days before those of most of the stock",
                     physics::format_date(physics::Seconds(last)), behind),
         std::string(action)});
}

}  // namespace bemcal::stock
