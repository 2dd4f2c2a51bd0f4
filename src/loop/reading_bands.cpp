/// Takes the 5 and 95 % quantiles of residuals where the prediction is as high, by day
/// and by night apart; a month's standard deviation from the months of training. Source:
/// Lei, G'Sell, Rinaldo, Tibshirani and Wasserman 2018 (JASA 113, 1094) for intervals
/// from residuals of what was left out. A month's variance in proportion to its sum is
/// judgement. Levels that change from year to year are left out: what training has not
/// seen, no residual shows.
#include "loop/reading_bands.hpp"

#include "base/nan.hpp"
#include "loop/decisions.hpp"
#include "loop/months.hpp"
#include "stats/distributions.hpp"
#include "stats/quantile.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::loop {
namespace {

using decisions::band_levels, decisions::band_tail, decisions::least_residuals;

bool is_day(physics::Seconds begin) {
    const int hour = physics::calendar_step(begin).hour;
    return hour >= decisions::band_day_begins && hour < decisions::band_day_ends;
}

std::vector<double> known_of(const UnseenHours& hours) {
    std::vector<double> known;
    for (const double residual : hours.residuals)
        if (!std::isnan(residual)) known.push_back(residual);
    return known;
}

Band band_of(std::vector<double> residuals) {
    std::ranges::sort(residuals);
    return {stats::quantile_of_sorted(residuals, band_tail),
            stats::quantile_of_sorted(residuals, 1 - band_tail)};
}

/// Between levels that hold equally many hours; of many that are equal one.
std::vector<double> edges_of(const UnseenHours& hours) {
    std::vector<double> sorted;
    for (std::size_t k = 0; k < hours.predicted.size(); ++k)
        if (!std::isnan(hours.residuals[k])) sorted.push_back(hours.predicted[k]);
    std::ranges::sort(sorted);
    std::vector<double> edges;
    for (std::size_t level = 1; level < band_levels && !sorted.empty(); ++level) {
        const double edge = sorted[level * sorted.size() / band_levels];
        if (edges.empty() || edge > edges.back()) edges.push_back(edge);
    }
    return edges;
}

/// Of months from what was read as the unseen model has it.
double month_deviation(const UnseenHours& hours, bool is_mean) {
    std::vector<double> read = hours.predicted;
    for (std::size_t k = 0; k < read.size(); ++k) read[k] += hours.residuals[k];
    const Months months = months_of(hours.begins, hours.predicted, read, is_mean);
    double squares = 0, per = 0;
    for (std::size_t m = 0; m < months.measured.size(); ++m) {
        squares += std::pow(months.measured[m] - months.simulated[m], 2);
        per += is_mean ? 1 : std::max(months.simulated[m], 0.0);
    }
    return per > 0 ? std::sqrt(squares / per) : nan;
}

}  // namespace

ReadingBands::ReadingBands(const UnseenHours& hours, bool is_mean)
    : edges_(edges_of(hours)),
      is_mean_(is_mean),
      month_(month_deviation(hours, is_mean)) {
    std::vector<std::vector<double>> of_kind(2 * (edges_.size() + 1));
    for (std::size_t k = 0; k < hours.residuals.size(); ++k)
        if (!std::isnan(hours.residuals[k]))
            of_kind[kind_of(hours.predicted[k], hours.begins[k])].push_back(
                hours.residuals[k]);
    const std::vector<double> all = known_of(hours);
    if (all.size() < least_residuals) return;
    for (const auto& residuals : of_kind)
        of_kind_.push_back(band_of(residuals.size() < least_residuals ? all : residuals));
}

std::size_t ReadingBands::kind_of(double predicted, physics::Seconds begin) const {
    const auto level = std::ranges::upper_bound(edges_, predicted) - edges_.begin();
    return 2 * static_cast<std::size_t>(level) + (is_day(begin) ? 1 : 0);
}

Band ReadingBands::hour(double predicted, physics::Seconds begin, double level) const {
    if (of_kind_.empty()) return {nan, nan};
    const Band& own = of_kind_[kind_of(predicted, begin)];
    const double of_level = stats::z_90_two_sided * level * predicted;
    // About the prediction; of residuals that all have one sign, about the least of them.
    const double middle = std::clamp(0.0, own.least, own.most);
    return {predicted + middle - std::hypot(middle - own.least, of_level),
            predicted + middle + std::hypot(own.most - middle, of_level)};
}

Band ReadingBands::month(double predicted, double level) const {
    const double of_errors =
        is_mean_ ? month_ : month_ * std::sqrt(std::max(predicted, 0.0));
    const double half = stats::z_90_two_sided * std::hypot(of_errors, level * predicted);
    return {predicted - half, predicted + half};
}

std::vector<Band> ReadingBands::hours(std::span<const double> predicted,
                                      std::span<const physics::Seconds> begins,
                                      double level) const {
    std::vector<Band> bands;
    bands.reserve(predicted.size());
    for (std::size_t k = 0; k < predicted.size(); ++k)
        bands.push_back(hour(predicted[k], begins[k], level));
    return bands;
}

std::vector<Band> ReadingBands::months(std::span<const double> predicted,
                                       double level) const {
    std::vector<Band> bands;
    bands.reserve(predicted.size());
    for (const double one : predicted) bands.push_back(month(one, level));
    return bands;
}

double share_within(std::span<const Band> bands, std::span<const double> measured) {
    double inside = 0, n = 0;
    for (std::size_t k = 0; k < measured.size(); ++k) {
        if (std::isnan(measured[k]) || std::isnan(bands[k].least)) continue;
        inside += measured[k] >= bands[k].least && measured[k] <= bands[k].most ? 1 : 0;
        n += 1;
    }
    return n > 0 ? inside / n : nan;
}

}  // namespace bemcal::loop
