/// Learns over a stock how frequent each name is and how large its effects are, and says
/// by that again what each building has: a name that others have too is likelier, and a
/// coefficient that is uncertain is drawn to theirs.
/// Source: Asuncion, Welling, Smyth and Teh 2009 (On smoothing and inference for topic
/// models), collapsed variational inference of order zero, for frequencies with a
/// Dirichlet prior; DerSimonian and Laird 1986 (Controlled Clinical Trials 7) for sizes.
/// A building's own search does not learn from the others: its probabilities, all names
/// alike beforehand, are what the stock starts from. Left out: effects that have ended,
/// and changes of a meter without a name.
#include "stock/common.hpp"

#include "stats/distributions.hpp"
#include "stats/quantile.hpp"
#include "study/columns.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace bemcal::stock {

namespace {

/// Of every name before any building is known: as if one building had it (Laplace).
constexpr double beforehand = 1;
constexpr int most_sweeps = 200;
constexpr double least_move = 1e-6;     ///< of a probability, in a sweep that goes on
constexpr double least_expected = 0.5;  ///< buildings; of less no row is made
constexpr std::size_t few = 3;          ///< buildings; of fewer no spread is told
const std::string none_of_these = "";   ///< of all other causes

/// An effect's row of the table.
struct Row {
    std::string name, unit;
    double n = 0, of = 0, expected = 0, q25 = 0, median = 0, q75 = 0;
    double mean = 0, spread = 0;
};

template <class R, class See>
void visit(R& row, See&& see) {
    see("stock_common_effect", row.name);
    see("stock_common_unit", row.unit);
    see("stock_common_n", row.n);
    see("stock_common_of", row.of);
    see("stock_common_expected", row.expected);
    see("stock_common_q25", row.q25);
    see("stock_common_median", row.median);
    see("stock_common_q75", row.q75);
    see("stock_common_mean", row.mean);
    see("stock_common_spread", row.spread);
}

/// A pattern of a meter has only been told by a night.
bool has_name(const StockRecord& record, const StockRecord::Effect& effect) {
    return !effect.section.empty() ||
           std::ranges::find(record.changes, effect.name, &StockRecord::Change::of) ==
               record.changes.end();
}

using Names = std::vector<study::PossibleName>;

/// Of an effect, with what is left for all others; of one that nobody asked it is sure.
Names names_of(const StockRecord& record, double effect, const std::string& own) {
    Names names;
    double left = 1;
    for (const StockRecord::Name& one : record.names) {
        if (one.effect != effect) continue;
        const double p = std::clamp(one.probability, 0.0, left);
        names.push_back({one.name, p});
        left -= p;
    }
    if (names.empty()) return own.empty() ? names : Names{{own, 1.0}};
    names.push_back({none_of_these, left});
    return names;
}

/// Mean and spread of true sizes, of which each was found with an error.
std::pair<double, double> mean_and_spread(const std::vector<double>& found,
                                          const std::vector<double>& sd) {
    const auto mean_by = [&](double variance) {
        double sum = 0, weights = 0;
        for (std::size_t k = 0; k < found.size(); ++k) {
            const double w = 1 / (sd[k] * sd[k] + variance);
            sum += w * found[k];
            weights += w;
        }
        return sum / weights;
    };
    const double fixed = mean_by(0);
    double weights = 0, squares = 0, q = 0;
    for (std::size_t k = 0; k < found.size(); ++k) {
        const double w = 1 / (sd[k] * sd[k]);
        weights += w;
        squares += w * w;
        q += w * std::pow(found[k] - fixed, 2);
    }
    const double free = static_cast<double>(found.size()) - 1,
                 variance = std::max(0.0, (q - free) / (weights - squares / weights));
    return {mean_by(variance), std::sqrt(variance)};
}

}  // namespace

void CommonEffects::add(const StockRecord& record) {
    const std::size_t building = n_added_++;
    if (!(record.known_to > record.known_from)) return;
    n_searched_ += 1;
    for (std::size_t k = 0; k < record.effects.size(); ++k) {
        const StockRecord::Effect& effect = record.effects[k];
        if (effect.state == "ended" || !has_name(record, effect)) continue;
        Names names = names_of(record, static_cast<double>(k), effect.name);
        if (names.empty()) continue;  // of a damaged result
        const double sd = (effect.high - effect.low) / (2 * stats::z_90_two_sided);
        said_.push_back({building,
                         k,
                         std::move(names),
                         {effect.name, effect.unit},
                         effect.coefficient,
                         sd,
                         true});
    }
    if (Names undecided = names_of(record, of_what_did_not_join, ""); !undecided.empty())
        said_.push_back({building, 0, std::move(undecided)});
}

void CommonEffects::compare(const std::vector<OfAll>& of_all) {
    compare_names(of_all);
    compare_sizes();
}

/// Each effect sees how many others have a name; its own say is left out.
void CommonEffects::compare_names(const std::vector<OfAll>& of_all) {
    const std::vector<Said> alone = said_;
    std::map<std::string, double> by_place;  // buildings that have it
    for (const OfAll& one : of_all)
        if (!one.section.empty()) by_place[one.name] = one.probability * n_searched_;
    for (const Said& one : said_)
        for (const auto& [name, p] : one.names) expected_[name] += p;
    double moved = 1;
    for (int sweep = 0; sweep < most_sweeps && moved > least_move; ++sweep) {
        moved = 0;
        for (std::size_t i = 0; i < said_.size(); ++i) {
            Names& names = said_[i].names;
            Names now = alone[i].names;
            double sum = 0;
            for (std::size_t k = 0; k < now.size(); ++k) {
                now[k].probability *= beforehand + by_place[now[k].name] +
                                      expected_[now[k].name] - names[k].probability;
                sum += now[k].probability;
            }
            for (std::size_t k = 0; k < now.size(); ++k) {
                const double was = names[k].probability,
                             p = sum > 0 ? now[k].probability / sum : was;
                expected_[names[k].name] += p - was;
                moved = std::max(moved, std::abs(p - was));
                names[k].probability = p;
            }
        }
    }
}

void CommonEffects::compare_sizes() {
    std::map<Key, std::vector<double>> found, sd;
    for (const Said& one : said_) {
        if (!one.has_joined) continue;
        sizes_[one.key].coefficients.push_back(one.coefficient);
        if (!(one.sd > 0)) continue;  // hours, which have no size
        found[one.key].push_back(one.coefficient);
        sd[one.key].push_back(one.sd);
    }
    for (const auto& [key, coefficients] : found)
        if (coefficients.size() >= few)
            std::tie(sizes_[key].mean, sizes_[key].spread) =
                mean_and_spread(coefficients, sd[key]);
}

void CommonEffects::write(std::size_t k, StockRecord& record) const {
    record.undecided = "";
    record.undecided_probability = nan;
    for (StockRecord::Effect& effect :
         record.effects) {  // what the last night made of it
        effect.by_stock = "";
        effect.by_stock_probability = effect.by_stock_coefficient = nan;
    }
    const auto first = std::ranges::lower_bound(said_, k, {}, &Said::building);
    for (auto one = first; one != said_.end() && one->building == k; ++one) {
        const auto best =
            std::ranges::max_element(one->names, {}, &study::PossibleName::probability);
        if (!one->has_joined) {
            record.undecided = best->name;
            record.undecided_probability = best->probability;
            continue;
        }
        StockRecord::Effect& effect = record.effects[one->effect];
        effect.by_stock = best->name;
        effect.by_stock_probability = best->probability;
        const Sizes& sizes = sizes_.at(one->key);
        if (std::isnan(sizes.mean) || !(one->sd > 0)) continue;
        const double own = one->sd * one->sd, of_stock = sizes.spread * sizes.spread;
        effect.by_stock_coefficient =
            (of_stock * one->coefficient + own * sizes.mean) / (of_stock + own);
    }
}

std::vector<study::Dataset> CommonEffects::datasets() const {
    std::vector<Row> rows;
    for (const auto& [key, sizes] : sizes_) {
        std::vector<double> sorted = sizes.coefficients;
        std::ranges::sort(sorted);
        const auto at = [&](double p) { return stats::quantile_of_sorted(sorted, p); };
        const auto expected = expected_.find(key.name);
        rows.push_back({key.name, key.unit, static_cast<double>(sorted.size()),
                        n_searched_, expected == expected_.end() ? 0 : expected->second,
                        at(0.25), at(0.5), at(0.75), sizes.mean, sizes.spread});
    }
    for (const auto& [name, expected] : expected_)
        if (name != none_of_these && expected >= least_expected &&
            std::ranges::find(rows, name, &Row::name) == rows.end())
            rows.push_back({name, "", 0, n_searched_, expected, nan, nan, nan, nan, nan});
    std::ranges::stable_sort(rows, std::greater(), &Row::expected);
    study::ColumnWriter columns("stock", "stock_common");
    for (const Row& row : rows)
        columns.add(row, [](auto& one, auto&& see) { visit(one, see); });
    std::vector<study::Dataset> datasets;
    if (!rows.empty()) columns.take(datasets);
    return datasets;
}

}  // namespace bemcal::stock
