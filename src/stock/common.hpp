/// Effects that many buildings of a stock have, from the records of all.
#pragma once

#include "stock/record.hpp"

#include <map>
#include <string>
#include <vector>

namespace bemcal::stock {

/// Sums of all records, one after the other.
class CommonEffects {
  public:
    void add(const StockRecord& record);
    /// stock_common*: an effect a row, those of most buildings first; nothing where no
    /// building was searched.
    std::vector<study::Dataset> datasets() const;

  private:
    struct Key {
        std::string name, unit;
        auto operator<=>(const Key&) const = default;
    };
    std::map<Key, std::vector<double>> coefficients_;
    double n_searched_ = 0;
};

}  // namespace bemcal::stock
