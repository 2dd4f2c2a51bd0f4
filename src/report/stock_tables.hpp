/// A night over a stock: what a look at it needs first, and its table as CSV.
#pragma once

#include "report/lookup.hpp"

#include <string>

namespace bemcal::report {

/// How many buildings were done, why, and which failed, drift, or predict worst.
std::string stock_section(const Group& stock);

/// A line for each building: status, cause, reason, drift, errors of its worst meter in
/// the first and last period, findings.
std::string stock_csv(const Group& stock);

/// A line for each change of an effect that the night told.
std::string stock_changes(const Group& stock);

/// A text as one cell of CSV (RFC 4180), in one line; one that a spreadsheet would take
/// for a formula gets an apostrophe in front.
std::string csv_cell(const std::string& text);

/// The same in short, for a history of nights. \param night  stands first in each line
std::string stock_history(const Group& stock, const std::string& night);

}  // namespace bemcal::report
