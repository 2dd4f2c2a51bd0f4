/// Effects that many buildings of a stock have, from the records of all: how often each
/// is there, how large it is, and what that says of each building's own.
#pragma once

#include "stock/place.hpp"
#include "stock/record.hpp"
#include "study/summary.hpp"

#include <map>
#include <string>
#include <vector>

namespace bemcal::stock {

/// Sums of all records, one after the other.
class CommonEffects {
  public:
    void add(const StockRecord& record);
    /// What all records say of each other; after the last one.
    /// \param of_all  what each building has of its place; a name of these is likelier
    void compare(const std::vector<OfAll>& of_all = {});
    /// Writes what the stock makes of a record's effects. \param k  it was added as k-th
    void write(std::size_t k, StockRecord& record) const;
    /// stock_common*: an effect a row, those of most buildings first; nothing where no
    /// building was searched.
    std::vector<study::Dataset> datasets() const;

  private:
    struct Key {
        std::string name, unit;
        auto operator<=>(const Key&) const = default;
    };
    /// An effect of a building, or what did not join.
    struct Said {
        std::size_t building = 0, effect = 0;
        std::vector<study::PossibleName> names;
        Key key{};  ///< as it was found
        double coefficient = nan, sd = nan;
        bool has_joined = false;
    };
    /// Sizes of an effect over the buildings that have it.
    struct Sizes {
        std::vector<double> coefficients;
        double mean = nan, spread = nan;  ///< of the true ones; NaN of fewer than three
    };

    void compare_names(const std::vector<OfAll>& of_all);
    void compare_sizes();

    std::vector<Said> said_;
    std::map<std::string, double> expected_;  ///< buildings that have a name
    std::map<Key, Sizes> sizes_;
    std::size_t n_added_ = 0;
    double n_searched_ = 0;
};

}  // namespace bemcal::stock
