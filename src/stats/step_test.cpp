/// Tests for a step: a pattern's coefficient over the last 7, 14, 21 or 28 days against
/// the four weeks before, of which as much is believed as months of the known days
/// differ. Follows from least squares (matched filter); the statistic is scaled by what
/// it shows over the known days, which hold no step, and judged by Student's t with
/// Bonferroni's correction over patterns and lengths (Dunn 1961, JASA 56). It must also
/// be above all that its pattern shows over those days, which need not be normal.
/// Behind a step that was told, the coefficient is a random walk (the local level of
/// Harvey 1989, Forecasting, Structural Time Series Models), followed from day to day by
/// Kalman's filter; with no wander this is the mean of the days before.
/// Left out: steps that began more than four weeks ago, and slow drifts.
#include "stats/step_test.hpp"

#include "base/nan.hpp"
#include "stats/distributions.hpp"
#include "stats/quantile.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace bemcal::stats {
namespace {

constexpr std::size_t days_before = 28;  ///< that the last days are held against
constexpr std::size_t week = 7;
constexpr std::size_t n_levels = 5;       ///< of a prediction, with a spread each
constexpr double least_of_spread = 0.25;  ///< of a feature's overall spread
/// Of the known predictions at each end: what is foretold beyond may all be wrong, for no
/// day has shown it.
constexpr double tail = 0.02;
constexpr double most_deviation = 4;  ///< spreads
/// What a model leaves of new days over what it left of those that it had learned from:
/// sqrt((1 + p / n) / (1 - p / n)) of p = 35 numbers that were fitted to n = 365 days.
constexpr double of_new_days = 1.1;
/// In which what a step leaves may become another of its size: a season, with which it
/// comes and goes.
constexpr double days_of_a_season = 91;
/// Known days for a degree of freedom of the scale: about the mean of the lengths.
constexpr double days_of_freedom = 14;
/// Of a pattern's share of information per day over the known days: less is no say.
constexpr double least_say = 0.02;

double rms(const std::vector<double>& values) {
    if (values.empty()) return 0;
    const double sum =
        std::accumulate(values.begin(), values.end(), 0.0,
                        [](double all, double value) { return all + value * value; });
    return std::sqrt(sum / static_cast<double>(values.size()));
}

/// A day that stands out further counts as there.
double held_in(double deviation) {
    return std::clamp(deviation, -most_deviation, most_deviation);
}

/// By how much the mean square of a feature, in spreads, exceeds that of known days.
double left_behind(const Matrix& residuals, const Matrix& spread,
                   const std::vector<Told>& days) {
    std::vector<double> all;
    for (std::size_t d = 0; d < days.size(); ++d)
        for (std::size_t f = 0; days[d] != Told::nothing && f < residuals.cols; ++f)
            if (!std::isnan(residuals(d, f)))
                all.push_back(held_in(residuals(d, f) / spread(d, f)));
    return std::max(0.0, rms(all) * rms(all) - 1);
}

/// Upper ends of the levels of a feature: quantiles of the known predictions.
std::vector<double> levels_of(std::vector<double> known) {
    std::ranges::sort(known);
    std::vector<double> ends;
    for (std::size_t level = 1; level < n_levels && !known.empty(); ++level)
        ends.push_back(known[level * known.size() / n_levels]);
    return ends;
}

std::size_t level_at(const std::vector<double>& ends, double predicted) {
    return static_cast<std::size_t>(
        std::distance(ends.begin(), std::ranges::upper_bound(ends, predicted)));
}

}  // namespace

Matrix spread_of(const Matrix& residuals, const Matrix& predicted, std::size_t n_known) {
    Matrix spread(residuals.rows, residuals.cols, 1.0);
    for (std::size_t f = 0; f < residuals.cols; ++f) {
        std::vector<double> all, levels;
        for (std::size_t d = 0; d < n_known; ++d)
            if (!std::isnan(residuals(d, f))) {
                all.push_back(residuals(d, f));
                levels.push_back(predicted(d, f));
            }
        const std::vector<double> ends = levels_of(levels);
        std::vector<std::vector<double>> at(n_levels), foretold(n_levels);
        for (std::size_t k = 0; k < all.size(); ++k) {
            at[level_at(ends, levels[k])].push_back(all[k]);
            foretold[level_at(ends, levels[k])].push_back(levels[k]);
        }
        const double overall = rms(all);
        std::ranges::sort(levels);
        const double least = levels.empty() ? 0 : quantile_of_sorted(levels, tail),
                     most = levels.empty() ? 0 : quantile_of_sorted(levels, 1 - tail);
        for (std::size_t d = 0; d < residuals.rows && overall > 0; ++d) {
            const std::size_t level = level_at(ends, predicted(d, f));
            const double usual = rms(foretold[level]);
            const double beyond =
                usual > 0 ? std::max(1.0, std::abs(predicted(d, f)) / usual) : 1;
            const double unseen =
                std::max({0.0, predicted(d, f) - most, least - predicted(d, f)});
            spread(d, f) =
                std::max(rms(at[level]), least_of_spread * overall) * beyond + unseen;
        }
    }
    return spread;
}

std::vector<double> wander_behind(const Matrix& residuals, const Matrix& spread,
                                  const std::vector<Told>& days) {
    const double left = left_behind(residuals, spread, days);
    std::vector<double> wander;
    wander.reserve(days.size());
    for (const Told told : days)
        wander.push_back(told == Told::nothing     ? 0
                         : told == Told::first_day ? left
                                                   : left / days_of_a_season);
    return wander;
}

StepTest::StepTest(const Matrix& residuals, const Matrix& spread,
                   const std::vector<Matrix>& patterns, const StepOptions& options)
    : n_days_(residuals.rows), options_(options) {
    for (const Matrix& pattern : patterns) {
        Sums& sums = sums_.emplace_back();
        sums.whole.assign(n_days_ + 1, 0);
        sums.product.assign(n_days_ + 1, 0);
        sums.square.assign(n_days_ + 1, 0);
        for (std::size_t d = 0; d < n_days_; ++d) {
            double whole = 0, product = 0, square = 0;
            for (std::size_t f = 0; f < residuals.cols; ++f) {
                if (std::isnan(residuals(d, f)) || std::isnan(pattern(d, f))) continue;
                const double e = residuals(d, f) / spread(d, f);
                const double g = pattern(d, f) / spread(d, f);
                whole += g * e;
                product += g * held_in(e);
                square += g * g;
            }
            sums.whole[d + 1] = sums.whole[d] + whole;
            sums.product[d + 1] = sums.product[d] + product;
            sums.square[d + 1] = sums.square[d] + square;
        }
        learn_slow(sums);
        learn_scale(sums);
    }
    const auto n_tests = static_cast<double>(patterns.size() * std::size(step_lengths));
    const double freedom =
        std::max(1.0, static_cast<double>(options.n_known) / days_of_freedom);
    threshold_ = Distribution{Family::student_t, freedom, 0}.upper_quantile(
        options.false_alarms / (2 * std::max(n_tests, 1.0)));
}

/// Months of the known days: their coefficients differ by more than chance.
void StepTest::learn_slow(Sums& sums) const {
    double excess = 0, square = 0;
    for (std::size_t d = 0; d + days_before <= options_.n_known; d += days_before) {
        const double b = sums.square[d + days_before] - sums.square[d];
        const double a = sums.product[d + days_before] - sums.product[d];
        if (b <= 0) continue;
        excess += a * a / b - 1;
        square += b;
    }
    sums.slow = square > 0 ? std::max(0.0, excess / square) : 0;
}

void StepTest::learn_scale(Sums& sums) const {
    double squares = 0, n_looks = 0, most = 0;
    for (const std::size_t n : step_lengths)
        for (std::size_t end = n + days_before; end <= options_.n_known; end += week)
            if (const auto seen = contrast(sums, end, n, sums.product)) {
                const double statistic = seen->size / seen->sd;
                squares += statistic * statistic;
                n_looks += 1;
                most = std::max(most, std::abs(statistic));
            }
    sums.scale = n_looks > 0 ? std::max(1.0, std::sqrt(squares / n_looks)) : 1;
    sums.most = most / sums.scale;
}

std::optional<StepTest::Contrast> StepTest::contrast(
    const Sums& sums, std::size_t end, std::size_t n,
    const std::vector<double>& product) const {
    const std::size_t begin = end - n;
    const std::size_t first = begin - std::min(begin, days_before);
    const double after = sums.square[end] - sums.square[begin];
    const double usual = sums.square[options_.n_known] * static_cast<double>(n) /
                         static_cast<double>(std::max<std::size_t>(options_.n_known, 1));
    if (!(after > 0) || after < least_say * usual) return std::nullopt;
    // The scale is of the readings' errors, and no part of what wanders.
    const double unit = static_cast<double>(n) / after /
                        (of_new_days * of_new_days * sums.scale * sums.scale);
    const Level was = level_at(sums, first, begin, unit, product);
    return Contrast{
        (product[end] - product[begin]) / after - was.mean,
        std::sqrt(1 / after + was.variance + wandered(sums, begin, end, unit))};
}

StepTest::Level StepTest::level_at(const Sums& sums, std::size_t first, std::size_t end,
                                   double unit,
                                   const std::vector<double>& product) const {
    Level level{0, sums.slow};
    for (std::size_t d = first; d < end; ++d) {
        if (!options_.wander.empty()) level.variance += unit * options_.wander[d];
        const double says = sums.square[d + 1] - sums.square[d];
        const double known = 1 + level.variance * says;
        level.mean +=
            level.variance * (product[d + 1] - product[d] - says * level.mean) / known;
        level.variance /= known;
    }
    return level;
}

double StepTest::wandered(const Sums& sums, std::size_t begin, std::size_t end,
                          double unit) const {
    double variance = 0;
    for (std::size_t d = begin; d < end && !options_.wander.empty(); ++d) {
        const double share =
            (sums.square[end] - sums.square[d]) / (sums.square[end] - sums.square[begin]);
        variance += unit * options_.wander[d] * share * share;
    }
    return variance;
}

bool StepTest::is_told(const Step& step) const {
    return std::abs(step.statistic) >= std::max(threshold_, sums_.at(step.pattern).most);
}

std::optional<Step> StepTest::surest(std::size_t pattern) const {
    const Sums& sums = sums_.at(pattern);
    const std::size_t n_new = n_days_ - std::min(options_.n_known, n_days_);
    std::optional<Step> best;
    const auto look = [&](std::size_t n) {
        if (n == 0 || n > n_new) return;
        const auto seen = contrast(sums, n_days_, n, sums.product);
        if (!seen) return;
        const double sd = of_new_days * sums.scale * seen->sd;
        const double statistic = seen->size / sd;
        if (!best || std::abs(statistic) > std::abs(best->statistic))
            best = Step{pattern, n_days_ - n, seen->size, sd, statistic};
    };
    for (const std::size_t n : step_lengths) look(n);
    if (!best || !is_told(*best)) return best;
    for (std::size_t n = 1; n <= most_step_days + week; ++n) look(n);  // its day
    if (const auto whole = contrast(sums, n_days_, n_days_ - best->day, sums.whole))
        best->size = whole->size;
    return best;
}

}  // namespace bemcal::stats
