/// Tells of meters that no longer send: their last day against the middle one of the
/// stock. Follows from the daily sums that a night keeps of each building. Leaves out
/// meters by the month, and buildings whose other meter goes on.
#include "stock/stopped.hpp"

#include "physics/calendar.hpp"

#include <algorithm>
#include <chrono>
#include <string_view>

#include <fmt/format.h>

namespace bemcal::stock {

namespace {

/// Files come late by days, and a fortnight is half of what a night looks at.
constexpr double most_behind = 14;
constexpr std::string_view action =
    "kept; later days say nothing of it: see whether the meter still sends";

/// Behind the last day; 0 = it has no daily sums.
double end_of(const StockRecord& record) {
    return record.daily.empty()
               ? 0
               : record.daily_start + static_cast<double>(record.daily.size());
}

}  // namespace

void LastDays::add(const StockRecord& record) {
    if (end_of(record) > 0) days_.push_back(end_of(record));
}

void LastDays::tell(StockRecord& record) const {
    std::erase_if(record.findings, [](const study::DataDecision& finding) {
        return finding.action == action;
    });
    if (days_.empty() || end_of(record) == 0) return;
    std::vector<double> days = days_;
    const auto middle = days.begin() + static_cast<std::ptrdiff_t>(days.size() / 2);
    std::ranges::nth_element(days, middle);
    const double behind = *middle - end_of(record);
    if (behind <= most_behind) return;
    const std::chrono::days last(static_cast<int>(end_of(record)) - 1);
    const std::string meter = record.fits.empty() ? "meter" : record.fits.front().meter;
    record.findings.push_back(
        {meter,
         fmt::format("its readings end on {}, {:.0f} days before those of most of the "
                     "stock",
                     physics::format_date(physics::Seconds(last)), behind),
         std::string(action)});
}

}  // namespace bemcal::stock
