/// Puts together what each building's readings say of effects that come with the weather,
/// and asks which of them all have: is their mean further from nothing than models are by
/// themselves?
/// Source: Huber 1964 (Annals of Mathematical Statistics 35) for the mean, of which a few
/// buildings are far off; a Bayes factor of two normal laws for each effect.
/// A model that is wrong alike in every building looks like such an effect: its share is
/// `bias_of_models`. Left out: several stations in a stock.
#include "stock/place.hpp"

#include "effects/catalogue.hpp"
#include "effects/job_section.hpp"
#include "stats/quantile.hpp"
#include "study/columns.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace bemcal::stock {

namespace {

constexpr std::size_t least_buildings = 10;  ///< of fewer nothing is common
/// Typical sizes by which the mean of a stock is off that has no such effect: 40 made
/// offices have 0.2, by bench_common.py --off 0.
constexpr double bias_of_models = 0.2;
constexpr double least_probability = 0.5;  ///< of what is advised
constexpr double of_normal = 1.4826;  ///< standard deviations in a median absolute one
constexpr double far = 1.5;           ///< deviations from which a building counts less
constexpr int sweeps = 30;
constexpr double reach = 3;  ///< typical sizes that a template allows on either side

struct Mean {
    double at = 0, sd = 0, spread = 0;
};

double median_of(std::vector<double> values) {
    std::ranges::sort(values);
    return stats::quantile_of_sorted(values, 0.5);
}

/// Of true sizes that differ, each found with an error.
Mean mean_of(const std::vector<double>& found, const std::vector<double>& sd) {
    Mean mean{median_of(found)};
    std::vector<double> apart, errors;
    for (std::size_t k = 0; k < found.size(); ++k) {
        apart.push_back(std::abs(found[k] - mean.at));
        errors.push_back(sd[k] * sd[k]);
    }
    const double seen = of_normal * median_of(apart);
    mean.spread = std::sqrt(std::max(0.0, seen * seen - median_of(errors)));
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        double sum = 0, weights = 0;
        for (std::size_t k = 0; k < found.size(); ++k) {
            const double own = std::hypot(sd[k], mean.spread),
                         off = std::abs(found[k] - mean.at) / own,
                         w = std::min(1.0, far / std::max(off, far)) / (own * own);
            sum += w * found[k];
            weights += w;
        }
        mean.at = sum / weights;
        mean.sd = std::sqrt(1 / weights);
    }
    return mean;
}

/// Logarithm of the mean's likelihood if there is such an effect, over that if there is
/// none.
double log_bayes_factor(const Mean& mean, double typical) {
    const double none = std::hypot(mean.sd, bias_of_models * typical),
                 some = std::hypot(none, typical);
    const auto square = [&](double sd) { return std::pow(mean.at / sd, 2); };
    return std::log(none / some) + 0.5 * (square(none) - square(some));
}

/// What the structure has taken of it no mean knows: the prior is as wide as its size.
/// Empty of an effect that another version's catalogue had.
std::string section_of(const std::string& name, double mean, double typical) {
    const effects::Entry* entry = effects::entry_named(name);
    if (entry == nullptr) return "";
    const double size = std::abs(typical);
    return effects::job_section_of(
        entry->effect, {mean, size, mean - reach * size, mean + reach * size}, {});
}

template <class R, class See>
void visit_all(R& row, See&& see) {
    see("stock_all_effect", row.name);
    see("stock_all_unit", row.unit);
    see("stock_all_n", row.n);
    see("stock_all_mean", row.mean);
    see("stock_all_sd", row.sd);
    see("stock_all_spread", row.spread);
    see("stock_all_probability", row.probability);
    see("stock_all_section", row.section);
}

}  // namespace

void PlaceEffects::add(const StockRecord& record) {
    for (const study::PlaceEffect& effect : record.of_the_place) {
        const bool says_something = effect.sd > 0 && std::isfinite(effect.sd) &&
                                    std::isfinite(effect.coefficient) &&
                                    std::abs(effect.typical) > 0;
        if (!says_something) continue;
        Found& found = found_[effect.name];
        found.unit = effect.unit;
        found.typical = effect.typical;
        found.coefficients.push_back(effect.coefficient);
        found.sd.push_back(effect.sd);
    }
}

std::vector<OfAll> PlaceEffects::of_all() const {
    std::vector<OfAll> all;
    double most = 0;  // that there is none has a factor of 1
    for (const auto& [name, found] : found_) {
        if (found.sd.size() < least_buildings) continue;
        const Mean mean = mean_of(found.coefficients, found.sd);
        const double log_factor = log_bayes_factor(mean, found.typical);
        most = std::max(most, log_factor);
        all.push_back({name, found.unit, static_cast<double>(found.sd.size()), mean.at,
                       mean.sd, mean.spread, log_factor, ""});
    }
    double sum = std::exp(-most);
    for (OfAll& one : all) {
        one.probability = std::exp(one.probability - most);
        sum += one.probability;
    }
    for (OfAll& one : all) {
        one.probability /= sum;
        if (one.probability > least_probability)
            one.section = section_of(one.name, one.mean, found_.at(one.name).typical);
    }
    std::ranges::stable_sort(all, std::greater(), &OfAll::probability);
    return all;
}

std::vector<study::Dataset> datasets_of(const std::vector<OfAll>& all) {
    std::vector<study::Dataset> datasets;
    if (all.empty()) return datasets;
    study::add_rows(
        "stock", "stock_all", all, [](auto& row, auto&& see) { visit_all(row, see); },
        datasets);
    return datasets;
}

}  // namespace bemcal::stock
