/// Time stamps of a CSV file: from whatever clock it follows to the begin of each
/// interval in the site's local standard time.
///
/// A repeated or skipped hour at a change of summer time is recognised and named. Stamps
/// a little beside their step are moved to it, and so is a step that changes inside the
/// file; both are told. Leaves out: clocks whose rule is neither the EU's nor the USA's.
#pragma once

#include "input/csv.hpp"
#include "input/time_columns.hpp"
#include "physics/calendar.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace bemcal::input {

enum class Clock { unstated, standard, eu, us };

struct StampRules {
    bool at_end = false;  ///< a stamp is the end of its interval
    Clock clock = Clock::unstated;
    double site_offset_h = 0;  ///< local standard time minus UTC at the site [h]
    double file_offset_h = 0;  ///< the same of the file's clock (its standard time) [h]
    std::string format;        ///< of strptime; empty = ISO 8601
    /// Whether at_end is somebody's word; else the file may show another one.
    bool is_said = true;
    /// Rows are means or instants: a stamp inside of its step stands for that step.
    bool is_mean = false;
    bool is_count = false;  ///< rows are what a register shows, at an instant
};

/// What was found in the stamps, and what was done about it.
struct TimeNote {
    std::string finding, action;
};

struct Stamps {
    std::vector<physics::Seconds> begins;  ///< [n_rows] increasing, local standard time
    std::vector<physics::Seconds> faces;   ///< [n_rows] as they stand there
    int step_s = 3600;                     ///< the commonest distance [s]
    std::vector<int> steps;   ///< [n_rows] where the distance changes; else empty [s]
    bool at_end = false;      ///< as said, or as found
    std::string first, last;  ///< stamps as they stand there
    std::vector<TimeNote> notes;
};

/// \param fallback_step_s  where there is one row only
/// Throws UserError (data) with file:line:column: not a time, not in order, repeated, a
/// clock change.
Stamps stamps_in(const Csv& csv, const TimeColumns& time, const StampRules& rules,
                 int fallback_step_s = 3600);

}  // namespace bemcal::input
