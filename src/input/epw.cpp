/// Makes one weather of one EPW file or a chain of them. Files are chained as read; then
/// gaps are filled, irradiance is completed, and the temperature becomes hourly means, so
/// that a chain has no seams.
/// Source: EnergyPlus Auxiliary Programs, EPW Data Dictionary.
/// Gaps over 3 h, or what is asked for, are an error. Fields are parsed by `epw_table`.
#include "input/epw.hpp"

#include "base/error.hpp"
#include "base/nan.hpp"
#include "input/epw_table.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace bemcal::input {
namespace {

using physics::Weather;

constexpr int longest_line = EpwOptions{}.longest_gap;  ///< of irradiance [h]

struct Chain {
    Weather weather;
    std::vector<EpwTable> tables;
    std::vector<std::string> decisions;
    int longest_gap;  ///< that is interpolated [h]

    /// Where a step's row stands: the table, and its line there.
    std::pair<const EpwTable*, int> origin(int step) const {
        auto k = static_cast<std::size_t>(step);
        auto table = tables.begin();
        for (; k >= table->lines.size(); ++table) k -= table->lines.size();
        return {&*table, table->lines[k]};
    }
    std::string place_of(int step, int field) const {
        const auto [table, line] = origin(step);
        return fmt::format("{}:{}:{}", table->name, line, field);
    }
};

/// Consecutive steps.
struct Run {
    int begin, end;
    int length() const { return end - begin; }
};

std::vector<Run> runs_of(const std::vector<int>& steps) {
    std::vector<Run> runs;
    for (int step : steps) {
        if (runs.empty() || runs.back().end != step) runs.push_back({step, step});
        ++runs.back().end;
    }
    return runs;
}

std::vector<int> missing_steps(const std::vector<double>& series) {
    std::vector<int> steps;
    for (std::size_t k = 0; k < series.size(); ++k)
        if (std::isnan(series[k])) steps.push_back(static_cast<int>(k));
    return steps;
}

/// Linear between the neighbours of the run; at an end of the series the one neighbour.
void interpolate(std::vector<double>& series, const Run& run) {
    const auto at = [&](int k) { return series[static_cast<std::size_t>(k)]; };
    const bool has_before = run.begin > 0;
    const bool has_after = run.end < static_cast<int>(series.size());
    if (!has_before && !has_after) return;
    const double before = has_before ? at(run.begin - 1) : at(run.end);
    const double after = has_after ? at(run.end) : before;
    for (int k = run.begin; k < run.end; ++k)
        series[static_cast<std::size_t>(k)] =
            before + (after - before) * (k - run.begin + 1) / (run.length() + 1);
}

[[noreturn]] void fail_gap(const Chain& chain, const Run& run, int field,
                           const char* what) {
    const auto [table, line] = chain.origin(run.begin);
    fail_epw(table->name, line, field,
             fmt::format(
                 "{} missing for {} h from {} on: expected a value, or a gap of at most "
                 "{} h; fill_gaps bridges up to 48 h, another station more",
                 what, run.length(),
                 physics::format_time(chain.weather.axis.begin_of(run.begin)),
                 chain.longest_gap));
}

void report_gaps(Chain& chain, const std::vector<Run>& gaps, int field,
                 const char* what) {
    if (gaps.empty()) return;
    const int n =
        std::accumulate(gaps.begin(), gaps.end(), 0,
                        [](int sum, const Run& gap) { return sum + gap.length(); });
    chain.decisions.push_back(
        fmt::format("{}: {}: {} h in {} gap(s) of at most {} h interpolated, "
                    "the first here",
                    chain.place_of(gaps.front().begin, field), what, n, gaps.size(),
                    chain.longest_gap));
}

void fill_temperature(Chain& chain) {
    const std::vector<Run> gaps = runs_of(missing_steps(chain.weather.theta_e));
    for (const Run& gap : gaps) {
        if (gap.length() > chain.longest_gap)
            fail_gap(chain, gap, dry_bulb_field, "dry bulb temperature");
        interpolate(chain.weather.theta_e, gap);
    }
    report_gaps(chain, gaps, dry_bulb_field, "dry bulb temperature");
}

/// What is missing, from the same hour of the nearest day: a line knows nothing of the
/// sun's way, and beside a night without rows there is none.
void take_from_days_around(std::vector<double>& series, const Run& run) {
    constexpr int hours_a_day = 24, most_days = 3;  // over gaps of 48 h
    const auto value_at = [&](int k) {
        return k < 0 || k >= static_cast<int>(series.size())
                   ? nan
                   : series[static_cast<std::size_t>(k)];
    };
    for (int k = run.begin; k < run.end; ++k)
        for (int days = 1; days <= most_days; ++days) {
            double& value = series[static_cast<std::size_t>(k)];
            if (std::isnan(value)) value = value_at(k - days * hours_a_day);
            if (std::isnan(value)) value = value_at(k + days * hours_a_day);
        }
}

constexpr std::vector<double> Weather::* irradiances[] = {
    &Weather::global_horizontal, &Weather::direct_normal, &Weather::diffuse_horizontal};

void fill_irradiance(Chain& chain) {
    const std::vector<Run> gaps = runs_of(physics::unknown_irradiance(chain.weather));
    for (const Run& gap : gaps) {
        if (gap.length() > chain.longest_gap)
            fail_gap(chain, gap, global_field, "all irradiance");
        if (gap.length() <= longest_line)
            for (auto series : irradiances) interpolate(chain.weather.*series, gap);
    }
    for (const Run& gap : runs_of(physics::unknown_irradiance(chain.weather)))
        for (auto series : irradiances) take_from_days_around(chain.weather.*series, gap);
    const std::vector<Run> left = runs_of(physics::unknown_irradiance(chain.weather));
    if (!left.empty())
        fail_gap(chain, left.front(), global_field,
                 "all irradiance of these hours and of the same hours of days around");
    report_gaps(chain, gaps, global_field, "all irradiance");
}

void complete(Chain& chain) {
    const Weather before = chain.weather;
    physics::complete_irradiance(chain.weather);
    for (const EpwColumn& column : epw_columns) {
        if (std::find(std::begin(irradiances), std::end(irradiances), column.series) ==
            std::end(irradiances))
            continue;
        const std::vector<double>&then = before.*column.series,
              &now = chain.weather.*column.series;
        int n = 0;
        for (std::size_t k = 0; k < now.size(); ++k)
            n += std::isnan(then[k]) && now[k] > 0;
        if (n > 0)
            chain.decisions.push_back(fmt::format(
                "{}: {} derived for {} h", chain.tables.front().name, column.name, n));
    }
}

void append(Chain& chain, EpwTable table) {
    Weather& to = chain.weather;
    const Weather& from = table.weather;
    if (chain.tables.empty()) {
        to = from;
    } else {
        for (const EpwColumn& column : epw_columns) {
            const std::vector<double>& more = from.*column.series;
            (to.*column.series)
                .insert((to.*column.series).end(), more.begin(), more.end());
        }
        to.axis.n_steps += from.axis.n_steps;
    }
    chain.decisions.insert(chain.decisions.end(), table.decisions.begin(),
                           table.decisions.end());
    table.weather = Weather{};
    chain.tables.push_back(std::move(table));
}

/// Steps of the chain that the next file has, too, from its first one on.
int n_shared(const Chain& chain, const EpwTable& table) {
    const auto behind = chain.weather.axis.end() - table.weather.axis.start;
    return std::clamp(static_cast<int>(behind.count() / 3600), 0,
                      table.weather.axis.n_steps);
}

/// Takes the hours off a file that the chain has already; a value that is missing in one
/// of them is taken from the other.
void merge_shared(Chain& chain, EpwTable& table) {
    const int n = n_shared(chain, table);
    if (n == 0 || table.weather.axis.start < chain.weather.axis.start) return;
    const int first = chain.weather.axis.step_of(table.weather.axis.start);
    for (const EpwColumn& column : epw_columns) {
        std::vector<double>&before = chain.weather.*column.series,
        &after = table.weather.*column.series;
        for (int k = 0; k < n; ++k) {
            double& old = before[static_cast<std::size_t>(first + k)];
            const double now = after[static_cast<std::size_t>(k)];
            if (std::isnan(old)) old = now;
            if (std::isnan(now) || now == old) continue;
            fail_epw(
                table.name, table.lines[static_cast<std::size_t>(k)], column.field,
                fmt::format("{} is {:g} here, but {:g} at {}, for the same hour ({}): "
                            "leave one of them out",
                            column.name, now / column.scale, old / column.scale,
                            chain.place_of(first + k, column.field),
                            physics::format_time(table.weather.axis.begin_of(k))));
        }
        after.erase(after.begin(), after.begin() + n);
    }
    table.lines.erase(table.lines.begin(), table.lines.begin() + n);
    table.weather.axis.start += std::chrono::hours(n);
    table.weather.axis.n_steps -= n;
    chain.decisions.push_back(fmt::format(
        "{}: {} h that the files before it have, too, alike: taken once", table.name, n));
}

/// Hours between two files are as those without a row within one.
void bridge(Chain& chain, const EpwTable& table) {
    const auto apart = table.weather.axis.start - chain.weather.axis.end();
    const int n = static_cast<int>(apart.count() / 3600);
    if (n <= 0 || n > longest_epw_gap || table.weather.axis.n_steps == 0) return;
    chain.decisions.push_back(
        fmt::format("{}: {} h before it are in no file, from {} on: taken as missing",
                    table.name, n, physics::format_time(chain.weather.axis.end())));
    add_missing_hours(n, chain.weather);
    std::vector<int>& lines = chain.tables.back().lines;
    lines.insert(lines.end(), static_cast<std::size_t>(n), lines.back());
}

void check_follows(const Chain& chain, const EpwTable& table) {
    const Weather &before = chain.weather, &after = table.weather;
    if (after.axis.n_steps > 0 && after.axis.start != before.axis.end())
        fail_epw(table.name, table.lines.front(), 1,
                 fmt::format(
                     "begins at {}, but the file before it ends at {}: give the files in "
                     "the order of their years, without a gap",
                     physics::format_time(after.axis.start),
                     physics::format_time(before.axis.end())));
}

void check_place(const Chain& chain, const EpwTable& table) {
    const Weather &before = chain.weather, &after = table.weather;
    constexpr double same_place = 0.1;  // [deg]
    if (std::abs(after.site.latitude - before.site.latitude) > same_place ||
        std::abs(after.site.longitude - before.site.longitude) > same_place ||
        after.site.utc_offset_h != before.site.utc_offset_h)
        fail_epw(table.name, 1, 7,
                 fmt::format(
                     "another place or time zone than {}: a chain must be of one place",
                     chain.tables.front().name));
}

void drop_empty_series(Weather& weather) {
    for (const EpwColumn& column : epw_columns) {
        std::vector<double>& series = weather.*column.series;
        if (!column.needed && missing_steps(series).size() == series.size())
            series.clear();
    }
}

EpwFile finish(Chain chain, const EpwOptions& options) {
    fill_temperature(chain);
    physics::drop_absent_parts(chain.weather);  // `complete` tells what it derives
    fill_irradiance(chain);
    complete(chain);
    if (options.temperature == TemperatureConvention::hour_mean)
        chain.weather.theta_e = physics::hour_means(chain.weather.theta_e);
    drop_empty_series(chain.weather);
    return {std::move(chain.weather), chain.tables.front().place,
            std::move(chain.decisions)};
}

}  // namespace

EpwFile parse_epw_chain(const std::vector<EpwText>& files, const EpwOptions& options) {
    require(!files.empty(), "a chain of EPW files has at least one");
    Chain chain{{}, {}, {}, options.longest_gap};
    int year = options.year;
    for (const EpwText& file : files) {
        EpwTable table = parse_epw_table(file.text, file.name, year);
        if (!chain.tables.empty()) {
            check_place(chain, table);
            merge_shared(chain, table);
            bridge(chain, table);
            check_follows(chain, table);
        }
        append(chain, std::move(table));
        if (year != 0) year = physics::calendar_step(chain.weather.axis.end()).year;
    }
    return finish(std::move(chain), options);
}

}  // namespace bemcal::input
