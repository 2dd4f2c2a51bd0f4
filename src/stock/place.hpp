/// What all buildings of a stock have of their place: a weather station that reads high,
/// which each building's readings alone say little of.
#pragma once

#include "stock/record.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace bemcal::stock {

/// An effect that comes with the weather, by all buildings together.
struct OfAll {
    std::string name, unit;
    double n = 0;  ///< buildings of which the readings say something of it
    double mean = nan, sd = nan;
    double spread = nan;       ///< from building to building, errors of each taken off
    double probability = nan;  ///< that it is what they have in common
    std::string section;       ///< of a template; empty where it is not probable
};

class PlaceEffects {
  public:
    void add(const StockRecord& record);
    /// One of them at most is what the buildings have in common: the most probable first.
    /// Nothing of fewer than ten buildings.
    std::vector<OfAll> of_all() const;

  private:
    struct Found {
        std::string unit;
        double typical = nan;
        std::vector<double> coefficients, sd;
    };
    std::map<std::string, Found> found_;
};

/// stock_all*: an effect a row.
std::vector<study::Dataset> datasets_of(const std::vector<OfAll>& all);

}  // namespace bemcal::stock
