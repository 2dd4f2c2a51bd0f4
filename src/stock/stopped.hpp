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
    /// \param is_told  false of a building whose last day is somebody's word
    void tell(StockRecord& record, bool is_told);

  private:
    std::vector<double> days_;  ///< behind the last one with readings [d since 1970]
    bool is_sorted_ = false;
};

}  // namespace bemcal::stock
