/// Days on which a building was closed and nobody said so: working days whose hours look
/// like a Sunday's.
#pragma once

#include "loop/baseline.hpp"
#include "loop/calendar_days.hpp"

#include <optional>
#include <vector>

namespace bemcal::loop {

/// Operation as on Sunday on the days that show it, and use as on Sunday, with the plant
/// running, on those that show that; none: no such day. Each day is held against what
/// closing it would do to the meters, simulated for every third day at a time, since the
/// response of a day has died before the third.
std::vector<effects::Effect> closed_days(const LoopData& data, const Place& place,
                                         const Standing& standing);

/// Closed beyond doubt by itself, on no day of the calendar that is kept. By day since
/// 1970.
std::vector<int> days_alone(const DayShares& days,
                            const std::optional<KeptCalendar>& calendar);
/// Days that were closed, with the weekends between them; a longer run takes in the
/// weekends at its ends, whose dates are working days in another year.
std::vector<effects::Days> runs_of(const std::vector<int>& days);

}  // namespace bemcal::loop
