#include "job/data_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bemcal::job {

namespace {

struct UnitRatio {
    double ratio;
    const char* units;
};
/// Of two units that gas, heat and electricity are published in. Below 5 the seasons make
/// such steps too, so those are left out.
constexpr UnitRatio ratios[] = {{11.2, "m3 and kWh"},    {31.7, "100 ft3 and kWh"},
                                {10, "a decimal place"}, {100, "two decimal places"},
                                {1000, "Wh and kWh"},    {277.8, "GJ and kWh"},
                                {35.3, "ft3 and m3"}};
constexpr double tolerance = 0.2;  ///< a week of weather changes the level as well

double median(std::vector<double> values) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Median of each day's non-zero readings; NaN for a day without.
std::vector<double> daily_levels(const std::vector<double>& readings,
                                 std::size_t per_day) {
    std::vector<double> levels;
    for (std::size_t begin = 0; begin + per_day <= readings.size(); begin += per_day) {
        std::vector<double> day;
        for (std::size_t i = begin; i < begin + per_day; ++i)
            if (readings[i] > 0) day.push_back(readings[i]);
        levels.push_back(median(std::move(day)));
    }
    return levels;
}

/// Median of the days with a level among `n` from `first` on; NaN with fewer than half of
/// them.
double level_of(const std::vector<double>& levels, std::size_t first, std::size_t n) {
    std::vector<double> days;
    for (std::size_t d = first; d < std::min(first + n, levels.size()); ++d)
        if (!std::isnan(levels[d])) days.push_back(levels[d]);
    return days.size() * 2 < n ? std::numeric_limits<double>::quiet_NaN() : median(days);
}

/// The nearest known ratio, if any is near.
const UnitRatio* known_ratio(double ratio) {
    const auto distance = [&](const UnitRatio& known) {
        return std::abs(std::abs(std::log(ratio)) - std::log(known.ratio));
    };
    const UnitRatio* best = &ratios[0];
    for (const UnitRatio& known : ratios)
        if (distance(known) < distance(*best)) best = &known;
    return distance(*best) < std::log(1 + tolerance) ? best : nullptr;
}

/// The ratio of the levels around day d over `n` days on either side.
double step_ratio(const std::vector<double>& levels, std::size_t d, std::size_t n) {
    if (d < n || d + n > levels.size()) return std::numeric_limits<double>::quiet_NaN();
    return level_of(levels, d, n) / level_of(levels, d - n, n);
}

/// A step is there at once and stays: about the same ratio over three days, a week and
/// three weeks. The season changes the level meanwhile; the ratio is carried back to the
/// day itself, as if its logarithm grew evenly with the days.
const UnitRatio* step_at(const std::vector<double>& levels, std::size_t d,
                         double& ratio) {
    const double week = step_ratio(levels, d, 7), three_weeks = step_ratio(levels, d, 21);
    ratio = week * std::sqrt(week / three_weeks);
    if (!std::isfinite(ratio) || ratio <= 0) return nullptr;
    for (const double other : {step_ratio(levels, d, 3), three_weeks})
        if (!(other / ratio > 0.5 && other / ratio < 2)) return nullptr;
    return known_ratio(ratio);
}

}  // namespace

std::vector<Run> constant_runs(const std::vector<double>& readings, int least,
                               bool zeros) {
    std::vector<Run> runs;
    std::size_t first = 0;
    for (std::size_t i = 1; i <= readings.size(); ++i) {
        if (i < readings.size() && readings[i] == readings[first]) continue;
        const int n = static_cast<int>(i - first);
        const double value = readings[first];
        if (n >= least && !std::isnan(value) && (value == 0) == zeros)
            runs.push_back({static_cast<int>(first), n, value});
        first = i;
    }
    return runs;
}

std::vector<UnitStep> unit_steps(const std::vector<double>& readings,
                                 int readings_per_day) {
    const auto per_day = static_cast<std::size_t>(readings_per_day);
    const std::vector<double> levels = daily_levels(readings, per_day);
    std::vector<UnitStep> steps;
    for (std::size_t d = 1; d < levels.size(); ++d) {
        double ratio = 1;
        const UnitRatio* known = step_at(levels, d, ratio);
        if (known == nullptr) continue;
        // Of neighbouring days the one with the sharpest step from day to day is meant.
        const double sharp = std::abs(std::log(levels[d] / levels[d - 1]));
        if (!(sharp > 0.5 * std::abs(std::log(ratio)))) continue;
        const UnitStep step{static_cast<int>(d * per_day), ratio, known->ratio,
                            known->units};
        if (steps.empty() || step.at - steps.back().at > 7 * readings_per_day)
            steps.push_back(step);
    }
    return steps;
}

}  // namespace bemcal::job
