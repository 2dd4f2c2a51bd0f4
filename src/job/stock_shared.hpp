/// Meters of several buildings that are one, or shares of one, from their daily sums.
///
/// Weather moves two buildings alike, but neither to nearly one ratio on most days nor by
/// the same steps from day to day: both together show one meter, also where its share
/// changes slowly. Leaves out meters that are the sum of several others.
#pragma once

#include "job/stock_record.hpp"

namespace bemcal::job {

/// Adds a finding to both. Two buildings that nothing was done with keep what an earlier
/// night found of them.
void find_shared_meters(std::vector<StockRecord>& records);

}  // namespace bemcal::job
