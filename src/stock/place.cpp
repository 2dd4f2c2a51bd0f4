/// Puts together what each building's readings say of effects that come with the weather,
/// and asks which of them all have: is their mean further from nothing than models are by
/// themselves?
/// Source: Huber 1964 (Annals of Mathematical Statistics 35) for the mean, of which a few
/// buildings are far off; a Bayes factor of two normal laws for each effect.
/// A model that is wrong alike in every building looks like such an effect: its share is
/// `bias_of_models`. Left out: several stations in a stock.
#include "stock/place.hpp"

#include "stats/quantile.hpp"
#include "study/columns.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

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

/// Of the mean, if there is such an effect, over the same if there is none.
double bayes_factor(const Mean& mean, double typical) {
    const double none = std::hypot(mean.sd, bias_of_models * typical),
                 some = std::hypot(none, typical);
    const auto square = [&](double sd) { return std::pow(mean.at / sd, 2); };
    return none / some * std::exp(0.5 * (square(none) - square(some)));
}

/// What the structure has taken of it no mean knows: the prior is as wide as its size.
std::string section_of(const std::string& name, double mean, double typical) {
    const double size = std::abs(typical);
    return fmt::format(
        "[[effect]]\nname = \"{0}\"\ncoefficient = {1:.3g}\n\n[[parameter]]\nname = "
        "\"{0}\"\ntarget = \"effect.{0}\"\nmin = {2:.3g}\nmax = {3:.3g}\nprior = {{kind "
        "= \"normal\", mean = {1:.3g}, sd = {4:.3g}}}\n",
        name, mean, mean - reach * size, mean + reach * size, size);
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
        if (!(effect.sd > 0) || !std::isfinite(effect.coefficient)) continue;
        Found& found = found_[effect.name];
        found.unit = effect.unit;
        found.typical = effect.typical;
        found.coefficients.push_back(effect.coefficient);
        found.sd.push_back(effect.sd);
    }
}

std::vector<OfAll> PlaceEffects::of_all() const {
    std::vector<OfAll> all;
    double sum = 1;  // that there is none
    for (const auto& [name, found] : found_) {
        if (found.sd.size() < least_buildings) continue;
        const Mean mean = mean_of(found.coefficients, found.sd);
        const double factor = bayes_factor(mean, found.typical);
        sum += factor;
        all.push_back({name, found.unit, static_cast<double>(found.sd.size()), mean.at,
                       mean.sd, mean.spread, factor, ""});
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
    study::add_rows(
        "stock", "stock_all", all, [](auto& row, auto&& see) { visit_all(row, see); },
        datasets);
    return all.empty() ? std::vector<study::Dataset>{} : datasets;
}

}  // namespace bemcal::stock
