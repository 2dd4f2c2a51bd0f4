/// Meters of several buildings that are one, or shares of one, from their daily sums.
///
/// Weather moves two buildings alike, but neither to nearly one ratio on most days nor by
/// the same steps from day to day: both together show one meter, also where its share
/// changes slowly. Leaves out meters that are the sum of several others.
#pragma once

#include "stock/record.hpp"

namespace bemcal::stock {

/// Adds a finding to both; of more than AlikeGroups::most_listed buildings that show one
/// meter, one to each, with the first names and how many they are. Two buildings that
/// nothing was done with keep what an earlier night found of them.
void find_shared_meters(std::vector<StockRecord>& records);

/// Of a record, what find_shared_meters looks at and what it found: little, as those of
/// all buildings are there at once.
StockRecord shared_part(const StockRecord& record);
/// Puts what was found into the whole record, in place of what an earlier night found.
void take_shared(const StockRecord& part, StockRecord& record);

}  // namespace bemcal::stock
