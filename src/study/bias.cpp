/// Words a bias beyond Guideline 14, with what was metered and what the fit reaches.
/// Source: ASHRAE Guideline 14-2014 for NMBE (with n - 1) and its limits.
/// Temperatures have no totals, and a meter whose readings add up to nothing has no
/// NMBE: both are left out.
#include "study/bias.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::study {
namespace {

/// A meter of energy over a period, as measured and as fitted [kWh].
struct MeterTotals {
    const Meter* meter;
    double n = 0;  ///< readings
    double metered = 0;
    double nmbe = 0;
    double fitted() const { return metered * (1 + nmbe); }
    double most() const { return std::max(metered, fitted()); }
};

MeterTotals totals_of(const Meter& meter, const kernel::Readings& readings, double nmbe) {
    MeterTotals totals{&meter, 0, 0, nmbe};
    for (const double value : readings.values) {
        if (std::isnan(value)) continue;
        totals.metered += value;
        totals.n += 1;
    }
    return totals;
}

/// Those that have a total and a fit.
std::vector<MeterTotals> totals_in(const Case& building, std::size_t period,
                                   std::span<const FoundFit> fits) {
    const auto readings = readings_of(building, building.periods.at(period));
    std::vector<MeterTotals> all;
    for (const FoundFit& fit : fits) {
        const Meter& meter = building.meters.at(fit.meter);
        if (fit.period != period || physics::is_temperature(meter.quantity)) continue;
        const MeterTotals totals = totals_of(meter, readings[fit.meter], fit.nmbe);
        if (totals.metered > 0 && !std::isnan(totals.nmbe)) all.push_back(totals);
    }
    return all;
}

/// The guideline divides by n - 1 and not by n.
double nmbe_n1(const MeterTotals& totals) {
    return totals.n > 1 ? totals.nmbe * totals.n / (totals.n - 1) : totals.nmbe;
}

/// ": a factor of 2.5"; nothing where the fit has no energy at all.
std::string factor_of(const MeterTotals& totals) {
    const double fitted = totals.fitted();
    if (!(fitted > 0)) return {};
    return fmt::format(": a factor of {:.3g}",
                       std::max(totals.metered / fitted, fitted / totals.metered));
}

/// Empty where the bias is within its limit.
std::string sentence_of(const MeterTotals& totals, const Period& period) {
    const double bias = nmbe_n1(totals), limit = bias_limit(totals.meter->interval);
    if (std::abs(bias) <= limit) return {};
    return fmt::format(
        "the bias of {} in {} is {:+.3g} %, beyond the {:g} % of Guideline 14 (metered "
        "{}, fitted {}{})",
        totals.meter->name, period.name, 100 * bias, 100 * limit,
        words_of_energy(totals.metered), words_of_energy(totals.fitted()),
        factor_of(totals));
}

}  // namespace

double bias_limit(physics::Interval interval) {
    return interval >= physics::Interval::monthly ? 0.05 : 0.10;
}

std::string words_of_energy(double kwh) {
    constexpr const char* units[] = {"Wh", "kWh", "MWh", "GWh", "TWh"};
    int unit = 1;
    for (; std::abs(kwh) >= 999.5 && unit < 4; ++unit) kwh /= 1000;
    if (std::abs(kwh) < 0.1 && kwh != 0 && unit == 1) kwh *= 1000, unit = 0;
    return fmt::format("{:.3g} {}", kwh, units[unit]);
}

std::string bias_beyond(const Case& building, std::size_t period,
                        std::span<const FoundFit> fits) {
    const std::vector<MeterTotals> all = totals_in(building, period, fits);
    double largest = 0;
    for (const MeterTotals& totals : all) largest = std::max(largest, totals.fitted());
    std::vector<std::string> sentences;
    for (const MeterTotals& totals : all)
        if (totals.most() >= next_to_nothing * largest)
            sentences.push_back(sentence_of(totals, building.periods[period]));
    return joined_sentences(sentences);
}

std::string joined_sentences(const std::vector<std::string>& sentences) {
    std::vector<std::string> said;
    std::ranges::copy_if(sentences, std::back_inserter(said),
                         [](const std::string& sentence) { return !sentence.empty(); });
    return fmt::format("{}", fmt::join(said, "; "));
}

}  // namespace bemcal::study
