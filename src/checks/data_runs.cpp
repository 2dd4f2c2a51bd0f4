/// Stretches of one value: fills that last longer than chance allows where values repeat,
/// and zeros where all days around are well above 0.
/// Our own rules, without a source. Each series is seen alone. Left out: one value put
/// into many gaps, coarse meters; masking is the caller's.
#include "checks/data_runs.hpp"

#include "stats/quantile.hpp"

#include <algorithm>
#include <iterator>
#include <unordered_map>

namespace bemcal::checks {

namespace {

constexpr double chance = 1e-4;      ///< of a fill found in a series without one
constexpr double least_quanta = 50;  ///< 2 % of noise move such a value by a quantum
constexpr double least_quanta_of_month = 10;  ///< 5 % of noise do so once in a month
constexpr int month_h = 27 * 24;
constexpr int days_around = 28;      ///< on either side of a run of zeros
constexpr double most_zeros = 0.1;   ///< of a weather-driven meter's neighbours
constexpr double least_share = 0.3;  ///< of the usual reading: the lowest neighbours
constexpr int shortest_outage_h = 16, longest_outage_h = 336;  ///< of such a meter
constexpr double zero_quanta = 5;  ///< below that a reading may be rounded to 0

/// How often a reading repeats the one before it.
struct Repeats {
    double n = 0, repeats = 0;
    double share_without(const Run& run, double prior_n, double prior_share) const {
        return (repeats - (run.n - 1) + prior_n * prior_share) / (n - run.n + prior_n);
    }
};

struct RepeatTable {
    Repeats all;
    std::unordered_map<double, Repeats> of_value;
};

RepeatTable repeats_in(std::span<const double> values) {
    RepeatTable table;
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (std::isnan(values[k]) || values[k] == 0) continue;
        const double again = k > 0 && values[k] == values[k - 1] ? 1 : 0;
        for (Repeats* r : {&table.all, &table.of_value[values[k]]}) {
            r->n += 1;
            r->repeats += again;
        }
    }
    return table;
}

/// Expected number of runs as long in a series whose readings repeat independently.
double expected_by_chance(const RepeatTable& table, const Run& run) {
    constexpr double prior_n = 4;
    const double of_all = table.all.share_without(run, prior_n, 0.5);
    const double of_value =
        table.of_value.at(run.value).share_without(run, prior_n, of_all);
    return table.all.n * std::pow(std::max(of_all, of_value), run.n - 1);
}

/// Readings around a run at the hours of its own zeros, on one side of it.
struct Side {
    int n = 0, zeros = 0;
    std::vector<double> shares;  ///< of each slot: lowest reading / usual one
    std::vector<double> lowest;  ///< of each slot

    double zero_share() const { return n > 0 ? 1.0 * zeros / n : 1; }
    bool is_known(int per_day_of_run) const { return n >= 10 * per_day_of_run; }
};

Side side_of(const DataSeries& series, const Run& run, int direction) {
    Side side;
    const int n_slots = std::min(run.n, series.per_day);
    for (int i = 0; i < n_slots; ++i) {
        std::vector<double> above;
        // From the run's last day forward, from its first day back.
        const int at = direction > 0 ? run.first + run.n - 1 - i : run.first + i;
        for (int day = 1; day <= days_around; ++day) {
            const int k = at + direction * day * series.per_day;
            if (k < 0 || k >= series.size() || std::isnan(series.at(k))) continue;
            ++side.n;
            if (series.at(k) == 0)
                ++side.zeros;
            else
                above.push_back(series.at(k));
        }
        if (above.empty()) continue;
        side.lowest.push_back(quantile_of(above, 0.05));
        side.shares.push_back(side.lowest.back() / quantile_of(above, 0.5));
    }
    return side;
}

bool cuts_off(const DataSeries& series, int inside, int outside) {
    if (outside < 0 || outside >= series.size()) return false;
    if (std::isnan(series.at(outside))) return true;
    std::vector<double> usual;
    for (int day = -days_around; day <= days_around; ++day) {
        const int k = inside + day * series.per_day;
        if (k >= 0 && k < series.size() && series.at(k) > 0)
            usual.push_back(series.at(k));
    }
    return series.at(outside) > least_share * quantile_of(std::move(usual), 0.5);
}

bool is_outage_of_weather(const DataSeries& series, const Run& run, const Side& before,
                          const Side& after) {
    const double hours = series.hours(run.n);
    if (hours < shortest_outage_h || hours > longest_outage_h) return false;
    if (!cuts_off(series, run.first, run.first - 1) ||
        !cuts_off(series, run.first + run.n - 1, run.first + run.n))
        return false;
    const int slots = std::min(run.n, series.per_day);
    const auto well_above = [&](const Side& side) {
        return side.is_known(slots) && side.zero_share() <= most_zeros &&
               quantile_of(side.shares, 0.5) >= least_share;
    };
    return well_above(before) && well_above(after);
}

/// A base load: zero is no neighbour of the lowest readings.
bool is_outage_of_people(const DataSeries& series, const Run& run, const Side& before,
                         const Side& after, double quantum) {
    const int slots = std::min(run.n, series.per_day);
    const auto apart = [&](const Side& side) {
        return side.zero_share() <= 0.5 && quantile_of(side.shares, 0.5) >= 0.02 &&
               quantile_of(side.lowest, 0.5) >= zero_quanta * quantum;
    };
    if (!before.is_known(slots)) return after.is_known(slots) && apart(after);
    return apart(before) && (!after.is_known(slots) || apart(after));
}

}  // namespace

std::vector<double> known_of(std::span<const double> values) {
    std::vector<double> known;
    std::ranges::copy_if(values, std::back_inserter(known),
                         [](double value) { return !std::isnan(value); });
    return known;
}

double quantile_of(std::vector<double> sample, double p) {
    std::sort(sample.begin(), sample.end());
    return stats::quantile_of_sorted(sample, p);
}

std::vector<Run> constant_runs(std::span<const double> readings, int least, bool zeros) {
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

double quantum_of(std::span<const double> values) {
    std::vector<double> sorted;
    for (const double v : values)
        if (!std::isnan(v)) sorted.push_back(v);
    std::sort(sorted.begin(), sorted.end());
    if (sorted.empty()) return 0;
    const double rounding =
        1e-9 * std::max(std::abs(sorted.front()), std::abs(sorted.back()));
    double least = 0;
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        const double gap = sorted[i] - sorted[i - 1];
        if (gap > rounding && (least == 0 || gap < least)) least = gap;
    }
    return least;
}

std::vector<Run> constant_fills(const DataSeries& series) {
    const bool temperature = series.driver == Driver::temperature;
    const int least = temperature ? series.per_day : (series.per_day + 1) / 2;
    std::vector<Run> fills = constant_runs(series.values, std::max(least, 3), false);
    if (fills.empty()) return fills;
    const double quantum = quantum_of(series.values);
    const RepeatTable table = repeats_in(series.values);
    std::erase_if(fills, [&](const Run& run) {
        const bool month = series.hours(run.n) >= month_h;
        const bool coarse =
            !temperature &&
            run.value < (month ? least_quanta_of_month : least_quanta) * quantum;
        return coarse || expected_by_chance(table, run) > chance;
    });
    return fills;
}

std::vector<Run> missing_zeros(const DataSeries& series) {
    if (series.driver == Driver::temperature) return {};
    std::vector<Run> runs = constant_runs(series.values, 1, true);
    const double quantum = runs.empty() ? 0 : quantum_of(series.values);
    std::erase_if(runs, [&](const Run& run) {
        const Side before = side_of(series, run, -1), after = side_of(series, run, 1);
        return series.driver == Driver::weather
                   ? !is_outage_of_weather(series, run, before, after)
                   : !is_outage_of_people(series, run, before, after, quantum);
    });
    return runs;
}

}  // namespace bemcal::checks
