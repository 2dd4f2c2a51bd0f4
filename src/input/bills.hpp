/// Bills: readings of a meter that stand for the time between two reads of it, of any
/// length.
#pragma once

#include "input/series.hpp"
#include "physics/meters.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bemcal::input {

struct Bill {
    physics::Seconds from{}, to{};
    double value = 0;  ///< NaN = missing
    bool is_estimated = false;
    std::size_t row = 0;
};

/// Rows of calendar months or years, each within 36 h of its begin, or of its end;
/// nothing where a row is none, or two fall into the same. Where nobody said what a stamp
/// is, last days are ends.
std::optional<std::vector<Bill>> bills_by_calendar(const Stamps& stamps,
                                                   const std::vector<double>& values,
                                                   physics::Interval interval,
                                                   bool is_said,
                                                   std::vector<TimeNote>& notes);

/// Bills as stamps in one column give them, from each to the next. What the first or the
/// last row stands for is not in the file, unless all stamps are of one day of the month.
/// \param notes  gets what was found
std::vector<Bill> bills_between(const Csv& csv, const Stamps& stamps,
                                const std::vector<double>& values,
                                std::vector<TimeNote>& notes);

/// Bills with a begin and an end of their own. An end is a bill's last day where the next
/// one begins a day after it. Throws UserError (data) where one is no time or lies before
/// the end of the bill before it.
std::vector<Bill> bills_from_to(const Csv& csv, const Stamps& from, const Stamps& to,
                                const std::vector<double>& values,
                                std::vector<TimeNote>& notes);

/// What tells of bills in a file, besides their readings.
struct BillColumns {
    std::string from, to;   ///< "" = the stamps alone
    std::string estimated;  ///< "" = none
};

/// The bills of a column, by its from and to, by the calendar or from stamp to stamp, in
/// this order; estimated ones merged.
/// \param stamps  of `from`, or of the time, or of `to` alone
/// \param rules  of the stamps  \param is_mean  of the values
std::vector<Bill> bills_in(const Csv& csv, const BillColumns& columns,
                           const Stamps& stamps, const StampRules& rules,
                           const std::vector<double>& values, physics::Interval interval,
                           bool is_mean, std::vector<TimeNote>& notes);

/// The reads of a register, each at its time (from = to); what was estimated or is
/// missing is left out, so that the time before and after it are one. \param columns
/// `from` empty
std::vector<Bill> reads_of_register(const Csv& csv, const BillColumns& columns,
                                    const Stamps& stamps,
                                    const std::vector<double>& values,
                                    std::vector<TimeNote>& notes);

/// Marks bills by a column that says yes or no, E or A. Throws UserError (data) where it
/// says something else.
void mark_estimated(const Csv& csv, const std::string& column, std::vector<Bill>& bills);

/// Estimated bills as one with the next that was read; those that nothing read follows
/// are missing. \param is_mean  of the values, weighted by time
std::vector<Bill> merged(const std::vector<Bill>& bills, bool is_mean,
                         std::vector<TimeNote>& notes);

/// Whether every bill is a month, or year, of the calendar.
bool are_of_calendar(const std::vector<Bill>& bills, physics::Interval interval);

/// Each bill at its first hour of an hourly axis; gaps between them are told.
RegularSeries series_of(const std::vector<Bill>& bills, std::vector<TimeNote>& notes);

/// Begins and ends of the bills, each once.
std::vector<physics::Seconds> bounds_of(const std::vector<Bill>& bills);

}  // namespace bemcal::input
