/// Clocks from the shape of days: the lag between two mean weekdays is where their edges
/// correlate best; and sunshine against the sun on the clearest days.
/// Our own rules, without a source; thresholds are in data_clock.hpp. Left out: schedules
/// that follow the season, drifting clocks; what is done about it is the caller's.
#include "checks/data_clock.hpp"

#include <algorithm>
#include <numeric>

namespace bemcal::checks {

namespace {

constexpr int clock_window_d = 21;
constexpr double least_correlation = 0.75, least_amplitude = 0.05;
constexpr double most_of_one = 0.4, most_of_mean = 0.25, most_natural = 0.25;  ///< [h]

/// Rises from step to step, of length 1: edges tell the time, and seasons change them
/// less than the levels between them.
std::vector<double> edges_of(const std::vector<double>& profile) {
    std::vector<double> edges(profile.size());
    double squares = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        edges[i] = profile[i] - profile[(i + edges.size() - 1) % edges.size()];
        squares += edges[i] * edges[i];
    }
    for (double& edge : edges) edge /= squares > 0 ? std::sqrt(squares) : 1;
    return edges;
}

double sd_of(const std::vector<double>& profile, double mean) {
    double squares = 0;
    for (const double value : profile) squares += (value - mean) * (value - mean);
    return std::sqrt(squares / static_cast<double>(profile.size()));
}

double correlation(const std::vector<double>& a, const std::vector<double>& b,
                   std::size_t lag) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[(i + lag) % a.size()];
    return sum;
}

/// Lag of the days after a step behind those before it; false where days are flat or
/// unlike.
bool lag_at(const DataSeries& series, int at, double& hours) {
    const int window = clock_window_d * series.per_day;
    if (at < window || at + window > series.size()) return false;
    const auto before = weekday_profile(series, at - window, at);
    const auto after = weekday_profile(series, at, at + window);
    if (before.empty() || after.empty()) return false;
    const Lag lag = lag_of(before, after);
    hours = lag.hours;
    return lag.correlation >= least_correlation;
}

double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) /
           static_cast<double>(values.size());
}

bool all_near(const std::vector<double>& lags, double hours) {
    return std::abs(mean_of(lags) - hours) <= most_of_mean &&
           std::all_of(lags.begin(), lags.end(),
                       [&](double lag) { return std::abs(lag - hours) <= most_of_one; });
}

SummerTime verdict_on(const std::vector<double>& lags) {
    if (all_near(lags, -1)) return SummerTime::moves;
    if (all_near(lags, 0)) return SummerTime::stands;
    const auto clear = [](double lag) {
        return std::min(std::abs(lag), std::abs(lag + 1)) <= most_of_mean;
    };
    return std::all_of(lags.begin(), lags.end(), clear) ? SummerTime::mixed
                                                        : SummerTime::unknown;
}

}  // namespace

std::vector<double> weekday_profile(const DataSeries& series, int from, int to) {
    const auto n = static_cast<std::size_t>(series.per_day);
    std::vector<double> sums(n);
    std::vector<int> counts(n);
    for (int k = std::max(from, 0); k < std::min(to, series.size()); ++k) {
        if (std::isnan(series.at(k)) || series.weekday(k) > 4) continue;
        const auto slot = static_cast<std::size_t>(series.slot(k));
        sums[slot] += series.at(k);
        ++counts[slot];
    }
    for (std::size_t i = 0; i < n; ++i) {
        if (counts[i] < 8) return {};
        sums[i] /= counts[i];
    }
    const double mean = mean_of(sums);
    return sd_of(sums, mean) < least_amplitude * std::abs(mean) ? std::vector<double>{}
                                                                : sums;
}

Lag lag_of(const std::vector<double>& first, const std::vector<double>& second) {
    const std::vector<double> a = edges_of(first), b = edges_of(second);
    const std::size_t n = a.size();
    std::vector<double> of(n);
    for (std::size_t lag = 0; lag < n; ++lag) of[lag] = correlation(a, b, lag);
    const auto best =
        static_cast<std::size_t>(std::max_element(of.begin(), of.end()) - of.begin());
    const double left = of[(best + n - 1) % n], top = of[best],
                 right = of[(best + 1) % n];
    const double curve = left - 2 * top + right;
    double steps =
        static_cast<double>(best) + (curve < 0 ? (left - right) / 2 / curve : 0);
    if (steps > static_cast<double>(n) / 2) steps -= static_cast<double>(n);
    return {steps * 24 / static_cast<double>(n), top, of[0]};
}

SummerShift summer_shift(const DataSeries& series,
                         const std::vector<ClockChange>& changes) {
    SummerShift shift;
    std::vector<double> lags, natural;
    bool both_ways[2] = {false, false};
    for (const ClockChange& change : changes) {
        double hours = 0;
        if (!lag_at(series, change.at, hours)) continue;
        lags.push_back(change.to_summer ? hours : -hours);
        shift.changes.push_back({change, lags.back()});
        both_ways[change.to_summer ? 1 : 0] = true;
        for (const int days : {-42, -28, 28, 42})
            if (lag_at(series, change.at + days * series.per_day, hours))
                natural.push_back(std::abs(hours));
    }
    if (natural.size() < 2) return shift;
    shift.hours = mean_of(lags);
    shift.natural = mean_of(natural);
    if (shift.natural <= most_natural) shift.verdict = verdict_on(lags);
    if (shift.verdict != SummerTime::stands && !(both_ways[0] && both_ways[1]))
        shift.verdict = SummerTime::unknown;
    return shift;
}

NoonOffset noon_offset(const DataSeries& measured, std::span<const double> sun) {
    struct Day {
        double clearness, offset;
    };
    std::vector<Day> days;
    const int first = (measured.per_day - measured.first_slot) % measured.per_day;
    for (int from = first; from + measured.per_day <= measured.size();
         from += measured.per_day) {
        double got = 0, got_moment = 0, sent = 0, sent_moment = 0;
        for (int k = from; k < from + measured.per_day; ++k) {
            const double s = sun[static_cast<std::size_t>(k)];
            got += measured.at(k);
            got_moment += measured.at(k) * (k - from);
            sent += s;
            sent_moment += s * (k - from);
        }
        if (got > 0 && sent > 0)  // NaN fails as well
            days.push_back(
                {got / sent, measured.hours(got_moment / got - sent_moment / sent)});
    }
    std::sort(days.begin(), days.end(),
              [](const Day& a, const Day& b) { return a.clearness > b.clearness; });
    days.resize((days.size() + 9) / 10);
    std::vector<double> offsets;
    offsets.reserve(days.size());
    for (const Day& day : days) offsets.push_back(day.offset);
    return {static_cast<int>(days.size()), quantile_of(std::move(offsets), 0.5)};
}

}  // namespace bemcal::checks
