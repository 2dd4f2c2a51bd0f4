/// Lays rows of a CSV file on an even axis, absent ones as gaps; joins files in time;
/// fills short gaps by straight lines.
/// Follows from the commonest distance of the stamps (`stamps`).
/// A row off that grid is an error. Rows of two steps meet at the longer one; steps that
/// begin beside those of the day are shared out. Gaps at the ends stay.
#include "input/series.hpp"

#include "base/error.hpp"
#include "base/nan.hpp"
#include "input/steps.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include <fmt/format.h>

namespace bemcal::input {

namespace {

constexpr long long most_steps = 20'000'000;

[[noreturn]] void fail_row(const Csv& csv, std::size_t row, const std::string& message) {
    throw UserError(ExitCode::data,
                    fmt::format("{}:{}: {}", csv.file, csv.lines[row], message));
}

/// Rows [first, last) of one step.
struct Rows {
    const Csv& csv;
    const Stamps& stamps;
    std::size_t first, last;
    int step_s;

    /// Steps since the first row; an error where that is not whole.
    long long step_of(std::size_t row) const {
        const long long seconds = (stamps.begins[row] - stamps.begins[first]).count();
        if (seconds % step_s != 0)
            fail_row(
                csv, row,
                fmt::format(
                    "{} is not a multiple of {} s after the first row; time steps must "
                    "be even",
                    physics::format_time(stamps.begins[row]), step_s));
        if (seconds / step_s > most_steps)
            fail_row(csv, row, "is too far from the first row; check the years");
        return seconds / step_s;
    }
};

RegularSeries lay_rows(const Rows& rows, const std::vector<double>& values) {
    RegularSeries series;
    series.axis = {rows.stamps.begins[rows.first], rows.step_s,
                   static_cast<int>(rows.step_of(rows.last - 1)) + 1};
    series.values.assign(static_cast<std::size_t>(series.axis.n_steps), nan);
    int expected = 0;
    for (std::size_t row = rows.first; row < rows.last; ++row) {
        const int step = static_cast<int>(rows.step_of(row));
        if (step > expected) series.gaps.push_back({expected, step - expected, row});
        series.values[static_cast<std::size_t>(step)] = values[row];
        expected = step + 1;
    }
    return series;
}

/// Where rows of one step end and those of another begin.
std::vector<Rows> parts_of(const Csv& csv, const Stamps& stamps) {
    std::vector<Rows> parts;
    for (std::size_t row = 0; row < stamps.steps.size(); ++row) {
        if (row == 0 || stamps.steps[row] != stamps.steps[row - 1])
            parts.push_back({csv, stamps, row, row, stamps.steps[row]});
        parts.back().last = row + 1;
    }
    return parts;
}

/// The begin of a series, on whole steps after it.
physics::Seconds whole_step_after(physics::Seconds time, int step_s) {
    const long long phase = phase_of(time, step_s);
    return phase == 0 ? time : time + std::chrono::seconds(step_s - phase);
}

double folded(std::span<const double> fine, Fold fold) {
    if (fold == Fold::first) return fine.front();
    double sum = 0;
    for (const double value : fine) sum += value;
    return fold == Fold::sum ? sum : sum / static_cast<double>(fine.size());
}

/// A gap of the fine steps as one of the longer steps that it touches.
Gap coarsened(const Gap& gap, int skipped, int per_step, int n_steps) {
    const int first = std::max(gap.first - skipped, 0) / per_step;
    const int last = (gap.first + gap.n - skipped + per_step - 1) / per_step;
    return {first, std::min(last, n_steps) - first, gap.row};
}

}  // namespace

RegularSeries lay(const Csv& csv, const Stamps& stamps, const std::vector<double>& values,
                  Fold fold) {
    if (stamps.steps.empty())
        return lay_rows({csv, stamps, 0, stamps.begins.size(), stamps.step_s}, values);
    int step_s = 1;
    for (const int step : stamps.steps) step_s = std::lcm(step_s, step);
    RegularSeries series;
    for (const Rows& part : parts_of(csv, stamps)) {
        const RegularSeries next =
            coarsened(on_whole_steps(lay_rows(part, values)), step_s, fold);
        if (next.axis.n_steps == 0) continue;
        if (series.values.empty())
            series = next;
        else
            append(series, next, fmt::format("{}:{}", csv.file, csv.lines[part.first]),
                   part.first);
    }
    return series;
}

RegularSeries coarsened(const RegularSeries& fine, int step_s, Fold fold) {
    if (fine.axis.step_s == step_s) return fine;
    const int per_step = step_s / fine.axis.step_s;
    RegularSeries coarse;
    coarse.axis = {whole_step_after(fine.axis.start, step_s), step_s, 0};
    const int skipped = fine.axis.step_of(coarse.axis.start);
    coarse.axis.n_steps = std::max(0, fine.axis.n_steps - skipped) / per_step;
    for (int k = 0; k < coarse.axis.n_steps; ++k) {
        const auto first = fine.values.begin() + skipped + k * per_step;
        coarse.values.push_back(folded({first, first + per_step}, fold));
    }
    for (const Gap& gap : fine.gaps)
        if (const Gap whole = coarsened(gap, skipped, per_step, coarse.axis.n_steps);
            whole.n > 0)
            coarse.gaps.push_back(whole);
    return coarse;
}

RegularSeries on_whole_steps(RegularSeries series) {
    const int step_s = series.axis.step_s;
    if (3600 % step_s != 0 || phase_of(series.axis.start, step_s) == 0) return series;
    RegularSeries shared;
    shared.axis = {whole_step_after(series.axis.start, step_s), step_s,
                   std::max(0, series.axis.n_steps - 1)};
    const double of_next =
        static_cast<double>((shared.axis.start - series.axis.start).count()) / step_s;
    for (std::size_t k = 0; k + 1 < series.values.size(); ++k)
        shared.values.push_back((1 - of_next) * series.values[k] +
                                of_next * series.values[k + 1]);
    for (const Gap& gap : series.gaps)
        shared.gaps.push_back({gap.first - 1, gap.n + 1, gap.row});
    return shared;
}

void append(RegularSeries& series, const RegularSeries& next, const std::string& file,
            std::size_t row) {
    const auto fail = [&](const std::string& what) {
        throw UserError(ExitCode::data, fmt::format("{}: {}", file, what));
    };
    if (next.axis.step_s != series.axis.step_s)
        fail(fmt::format("its rows are {} s apart, those of the file before it {} s",
                         next.axis.step_s, series.axis.step_s));
    const long long seconds = (next.axis.start - series.axis.end()).count();
    if (seconds < 0)
        fail(fmt::format(
            "begins at {}, before the end of the file before it, {}; expected "
            "files in the order of time",
            physics::format_time(next.axis.start),
            physics::format_time(series.axis.end())));
    if (seconds % series.axis.step_s != 0 || seconds / series.axis.step_s > most_steps)
        fail(
            fmt::format("begins {} s after the file before it, not a number of its steps "
                        "of {} s",
                        seconds, series.axis.step_s));
    const int between = static_cast<int>(seconds / series.axis.step_s);
    const int begin = series.axis.n_steps + between;
    if (between > 0) series.gaps.push_back({series.axis.n_steps, between, row});
    series.values.resize(static_cast<std::size_t>(begin), nan);
    series.values.insert(series.values.end(), next.values.begin(), next.values.end());
    for (const Gap& gap : next.gaps)
        series.gaps.push_back({begin + gap.first, gap.n, gap.row});
    series.axis.n_steps = begin + next.axis.n_steps;
}

std::string words_of(const Gap& gap, const physics::TimeAxis& axis) {
    const double hours = gap.n * axis.step_s / 3600.0;
    return fmt::format("{:g} h from {}", hours,
                       physics::format_time(axis.begin_of(gap.first)));
}

void refuse_gaps(const Csv& csv, const RegularSeries& series) {
    if (series.gaps.empty()) return;
    const std::size_t n = series.gaps.size();
    fail_row(csv, series.gaps[0].row,
             fmt::format(
                 "rows are missing before this one: {}{}; set gaps = \"missing\" to take "
                 "them as missing",
                 words_of(series.gaps[0], series.axis),
                 n > 1 ? fmt::format(", and {} more gaps", n - 1) : ""));
}

int fill_gaps(std::vector<double>& values, int longest) {
    int filled = 0;
    std::size_t before = values.size();  // last step with a number, or none
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (std::isnan(values[k])) continue;
        const std::size_t n = before < k ? k - before - 1 : 0;
        if (n > 0 && n <= static_cast<std::size_t>(longest)) {
            const double slope =
                (values[k] - values[before]) / static_cast<double>(n + 1);
            for (std::size_t i = 1; i <= n; ++i)
                values[before + i] = values[before] + slope * static_cast<double>(i);
            filled += static_cast<int>(n);
        }
        before = k;
    }
    return filled;
}

}  // namespace bemcal::input
