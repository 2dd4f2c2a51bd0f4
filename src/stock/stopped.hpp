/// Buildings whose readings end well before those of most others of the stock.
#pragma once

#include "stock/record.hpp"

#include <vector>

namespace bemcal::stock {

class LastDays {
  public:
    /// Of all buildings, before any is told.
    void add(const StockRecord& record);
    /// Puts a finding where its readings have stopped, in place of an earlier night's.
    void tell(StockRecord& record) const;

  private:
    std::vector<double> days_;  ///< behind the last one with readings [d since 1970]
};

}  // namespace bemcal::stock
