/// Rules of drift, from one night to the next.
#pragma once

#include "job/stock.hpp"
#include "stock/record.hpp"

namespace bemcal::stock {

/// Adds to record.drift the parameters that have moved by more than the options' share of
/// their range and out of their interval of the night before. Sets how far each moved.
void find_drift(const job::StockOptions& options, const StockRecord& before,
                StockRecord& record);

/// Adds the meters of which both RMSE and CV(RMSE) of the last period are above the
/// options' factor times those of the first; with one period only, of the night before.
/// \param before  or nullptr
void find_error_drift(const job::StockOptions& options, const StockRecord* before,
                      StockRecord& record);

}  // namespace bemcal::stock
