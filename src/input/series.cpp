/// Lays rows of a CSV file on an even axis, absent ones as gaps; joins files in time;
/// fills short gaps by straight lines.
/// Follows from the commonest distance of the stamps (`stamps`).
/// A row off that grid is an error. Nothing is resampled; gaps at the ends stay.
#include "input/series.hpp"

#include "base/error.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace bemcal::input {

namespace {

constexpr long long most_steps = 20'000'000;

[[noreturn]] void fail_row(const Csv& csv, std::size_t row, const std::string& message) {
    throw UserError(ExitCode::data,
                    fmt::format("{}:{}: {}", csv.file, csv.lines[row], message));
}

/// Steps since the first row; an error where that is not whole.
long long step_of_row(const Csv& csv, const Stamps& stamps, std::size_t row) {
    const long long seconds = (stamps.begins[row] - stamps.begins[0]).count();
    if (seconds % stamps.step_s != 0)
        fail_row(csv, row,
                 fmt::format(
                     "{} is not a multiple of {} s after the first row; time steps must "
                     "be even",
                     physics::format_time(stamps.begins[row]), stamps.step_s));
    if (seconds / stamps.step_s > most_steps)
        fail_row(csv, row, "is too far from the first row; check the years");
    return seconds / stamps.step_s;
}

}  // namespace

RegularSeries lay(const Csv& csv, const Stamps& stamps,
                  const std::vector<double>& values) {
    const std::size_t n_rows = stamps.begins.size();
    RegularSeries series;
    series.axis = {stamps.begins[0], stamps.step_s,
                   static_cast<int>(step_of_row(csv, stamps, n_rows - 1)) + 1};
    series.values.assign(static_cast<std::size_t>(series.axis.n_steps),
                         std::numeric_limits<double>::quiet_NaN());
    int expected = 0;
    for (std::size_t row = 0; row < n_rows; ++row) {
        const int step = static_cast<int>(step_of_row(csv, stamps, row));
        if (step > expected) series.gaps.push_back({expected, step - expected, row});
        series.values[static_cast<std::size_t>(step)] = values[row];
        expected = step + 1;
    }
    return series;
}

void append(RegularSeries& series, const RegularSeries& next, const std::string& file) {
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
    if (between > 0) series.gaps.push_back({series.axis.n_steps, between, 0});
    series.values.resize(static_cast<std::size_t>(begin),
                         std::numeric_limits<double>::quiet_NaN());
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
