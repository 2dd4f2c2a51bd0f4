/// Merges what two files of one meter both have, as exports of overlapping months do.
/// Follows from one reading a step: alike, it is taken once; else one of them is wrong.
/// Leaves out files that begin before those before them, and those of other steps:
/// `append` refuses both.
#include "description/repeated.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::description {

namespace {

void take_off_front(input::RegularSeries& series, int n) {
    series.values.erase(series.values.begin(), series.values.begin() + n);
    series.axis.start +=
        std::chrono::seconds(static_cast<long long>(n) * series.axis.step_s);
    series.axis.n_steps -= n;
    for (input::Gap& gap : series.gaps) {
        const int behind = std::max(gap.first + gap.n - n, 0);
        gap.first = std::max(gap.first - n, 0);
        gap.n = std::min(gap.n, behind);
    }
    std::erase_if(series.gaps, [](const input::Gap& gap) { return gap.n == 0; });
}

/// Gaps that another file has closed.
void forget_closed_gaps(input::RegularSeries& series) {
    std::erase_if(series.gaps, [&](const input::Gap& gap) {
        const auto first = series.values.begin() + gap.first;
        return std::none_of(first, first + gap.n, [](double v) { return std::isnan(v); });
    });
}

}  // namespace

void refuse_two_readings(std::span<const TimedCsv> sources, const std::string& of,
                         physics::Seconds begin, double before, double now) {
    const auto other = std::ranges::find_if(sources, [&](const TimedCsv& source) {
        return source.stamps.begins.front() <= begin &&
               begin <= source.stamps.begins.back();
    });
    throw UserError(
        ExitCode::data,
        fmt::format("{}: {}{:g} here, but {:g} at {}, for the same time ({}); "
                    "leave one of them out",
                    row_at(sources.back(), begin), of, now, before, row_at(*other, begin),
                    physics::format_time(begin)));
}

int drop_repeated(input::RegularSeries& series, input::RegularSeries& next,
                  std::span<const TimedCsv> sources) {
    const long long behind = (series.axis.end() - next.axis.start).count();
    const bool on_grid =
        next.axis.step_s == series.axis.step_s && behind % series.axis.step_s == 0;
    if (behind <= 0 || next.axis.start < series.axis.start || !on_grid) return 0;
    const int n = static_cast<int>(
        std::min<long long>(behind / series.axis.step_s, next.axis.n_steps));
    const int first = series.axis.step_of(next.axis.start);
    int n_both = 0;
    for (int k = 0; k < n; ++k) {
        double& before = series.values[static_cast<std::size_t>(first + k)];
        const double now = next.values[static_cast<std::size_t>(k)];
        if (std::isnan(now)) continue;
        if (std::isnan(before)) {
            before = now;
            continue;
        }
        if (now != before)
            refuse_two_readings(sources, "", next.axis.begin_of(k), before, now);
        ++n_both;
    }
    take_off_front(next, n);
    forget_closed_gaps(series);
    return n_both;
}

}  // namespace bemcal::description
