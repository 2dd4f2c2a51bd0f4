/// Buildings whose readings end well before those of most others of the stock.
#pragma once

#include "stock/record.hpp"

#include <vector>

namespace bemcal::stock {

/// Behind the last day with a reading [d since 1970]; 0 = none is known.
double end_of_readings(const StockRecord& record);

/// The middle one of those that are known; 0 = none is.
double middle_end(std::vector<double> ends);

/// Puts a finding where readings have stopped well before that day, in place of an
/// earlier night's. \param middle  0: nothing is told, as of a last day that is
/// somebody's word
void tell_of_end(double middle, StockRecord& record);

}  // namespace bemcal::stock
