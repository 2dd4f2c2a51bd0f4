/// Counts effects over a stock, with quartiles of their coefficients.
/// Plain statistics of what each building's own search found: a building's search does
/// not learn from the others.
/// Left out: effects that have ended, and changes of a meter without a name.
#include "stock/common.hpp"

#include "stats/quantile.hpp"
#include "study/columns.hpp"

#include <algorithm>

namespace bemcal::stock {

namespace {

/// An effect's row of the table.
struct Row {
    std::string name, unit;
    double n = 0, of = 0, q25 = 0, median = 0, q75 = 0;
};

template <class R, class See>
void visit(R& row, See&& see) {
    see("stock_common_effect", row.name);
    see("stock_common_unit", row.unit);
    see("stock_common_n", row.n);
    see("stock_common_of", row.of);
    see("stock_common_q25", row.q25);
    see("stock_common_median", row.median);
    see("stock_common_q75", row.q75);
}

/// A pattern of a meter has only been told by a night.
bool has_name(const StockRecord& record, const StockRecord::Effect& effect) {
    return !effect.section.empty() ||
           std::ranges::find(record.changes, effect.name, &StockRecord::Change::of) ==
               record.changes.end();
}

}  // namespace

void CommonEffects::add(const StockRecord& record) {
    if (!(record.known_to > record.known_from)) return;
    n_searched_ += 1;
    for (const StockRecord::Effect& effect : record.effects)
        if (effect.state != "ended" && has_name(record, effect))
            coefficients_[{effect.name, effect.unit}].push_back(effect.coefficient);
}

std::vector<study::Dataset> CommonEffects::datasets() const {
    std::vector<Row> rows;
    for (const auto& [key, coefficients] : coefficients_) {
        std::vector<double> sorted = coefficients;
        std::ranges::sort(sorted);
        const auto at = [&](double p) { return stats::quantile_of_sorted(sorted, p); };
        rows.push_back({key.name, key.unit, static_cast<double>(sorted.size()),
                        n_searched_, at(0.25), at(0.5), at(0.75)});
    }
    std::ranges::stable_sort(rows, std::greater(), &Row::n);
    study::ColumnWriter columns("stock", "stock_common");
    for (const Row& row : rows)
        columns.add(row, [](auto& one, auto&& see) { visit(one, see); });
    std::vector<study::Dataset> datasets;
    if (!rows.empty()) columns.take(datasets);
    return datasets;
}

}  // namespace bemcal::stock
