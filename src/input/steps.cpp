/// Finds the step of rows by their commonest distance, each taken as the usual step next
/// to it, and moves rows that lie a little beside it.
/// Follows from clocks of loggers: they lose seconds, write :59:59, or start late; what
/// is within a twelfth of a step is meant as the step. Steps above a day are the
/// calendar's matter; steps that do not divide a day stay.
#include "input/steps.hpp"

#include "physics/calendar.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <map>

namespace bemcal::input {

namespace {

using physics::day_s;
using physics::Seconds;

constexpr long long usual[] = {1,     2,     3,     4,     5,     6,    10,   12,
                               15,    20,    30,    60,    120,   180,  240,  300,
                               360,   600,   720,   900,   1200,  1800, 3600, 7200,
                               10800, 14400, 21600, 28800, 43200, 86400};
constexpr long long hour_s = 3600;
/// A run that makes another step more than a gap here and there.
constexpr std::size_t least_rows = 24;
constexpr long long least_span_s = 2 * day_s;

/// Usual distances of each row from the one before it; 0 for the first and unordered.
std::vector<long long> distances_of(const std::vector<Seconds>& times) {
    std::vector<long long> distances(times.size(), 0);
    for (std::size_t row = 1; row < times.size(); ++row)
        if (const auto d = (times[row] - times[row - 1]).count(); d > 0)
            distances[row] = usual_step(d);
    return distances;
}

long long commonest(const std::vector<long long>& values) {
    std::map<long long, int> counts;
    for (const long long value : values)
        if (value > 0) ++counts[value];
    const auto most = std::max_element(
        counts.begin(), counts.end(),
        [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == counts.end() ? 0 : most->first;
}

/// Rows [first, last] that follow each other by one step.
struct StepRun {
    std::size_t first, last;
    long long step_s;
};

/// Those of two days and more, by steps that divide an hour, or days.
bool is_run(long long step_s, std::size_t n_rows) {
    const bool is_step = step_s > 0 && (hour_s % step_s == 0 || step_s == day_s);
    return is_step && n_rows >= least_rows &&
           static_cast<long long>(n_rows) * step_s >= least_span_s;
}

std::vector<StepRun> runs_of(const std::vector<long long>& distances) {
    std::vector<StepRun> runs;
    for (std::size_t row = 1; row < distances.size();) {
        const std::size_t begin = row;
        const long long step = distances[row];
        while (row < distances.size() && distances[row] == step) ++row;
        if (!is_run(step, row - begin + 1)) continue;
        if (!runs.empty() && runs.back().step_s == step)
            runs.back().last = row - 1;
        else
            runs.push_back({begin - 1, row - 1, step});
    }
    return runs;
}

/// Every row gets the step of its run; those between two runs belong to the first.
std::vector<int> steps_by_row(const std::vector<StepRun>& runs, std::size_t n_rows,
                              bool at_end) {
    std::vector<int> steps(n_rows, static_cast<int>(runs[0].step_s));
    for (std::size_t k = 1; k < runs.size(); ++k) {
        // The row that two runs share begins the second, or ends the first.
        const std::size_t begin = runs[k].first + (at_end ? 1 : 0);
        std::fill(steps.begin() + static_cast<std::ptrdiff_t>(begin), steps.end(),
                  static_cast<int>(runs[k].step_s));
    }
    return steps;
}

/// The distance of a phase from another around the step, in (-step / 2, step / 2].
long long apart(long long phase, long long from, long long step_s) {
    long long d = (phase - from) % step_s;
    if (d < 0) d += step_s;
    return 2 * d > step_s ? d - step_s : d;
}

struct StepRows {
    std::vector<Seconds>& times;
    std::size_t first, last;
    long long step_s;

    long long beside(std::size_t row, long long offset) const {
        return apart(phase_of(times[row], step_s), offset, step_s);
    }
    bool is_near(std::size_t row, long long offset) const {
        return part_of_step * std::abs(beside(row, offset)) <= step_s;
    }
    bool are_near(long long offset) const {
        for (std::size_t row = first; row < last; ++row)
            if (!is_near(row, offset)) return false;
        return true;
    }
    /// Days that all begin at the same full hour: by another clock, or those of gas.
    bool are_days_of_an_hour() const {
        const long long hour = phase_of(times[first], step_s);
        if (step_s != day_s || hour % 3600 != 0) return false;
        for (std::size_t row = first; row < last; ++row)
            if (beside(row, hour) != 0) return false;
        return true;
    }
    long long commonest_phase() const {
        std::map<long long, int> counts;
        for (std::size_t row = first; row < last; ++row)
            ++counts[phase_of(times[row], step_s)];
        return std::max_element(
                   counts.begin(), counts.end(),
                   [](const auto& a, const auto& b) { return a.second < b.second; })
            ->first;
    }
};

}  // namespace

long long usual_step(long long distance_s) {
    if (distance_s > day_s + day_s / part_of_step) return distance_s;
    const auto* above = std::lower_bound(std::begin(usual), std::end(usual), distance_s);
    long long nearest = above == std::end(usual) ? day_s : *above;
    if (above != std::begin(usual) && distance_s - above[-1] < nearest - distance_s)
        nearest = above[-1];
    return part_of_step * std::abs(nearest - distance_s) <= nearest ? nearest
                                                                    : distance_s;
}

RowSteps row_steps(const std::vector<Seconds>& times, bool at_end) {
    const std::vector<long long> distances = distances_of(times);
    RowSteps found;
    const long long step = commonest(distances);
    if (step <= 0 || step > 400 * day_s) return found;
    found.step_s = static_cast<int>(step);
    const std::vector<StepRun> runs = runs_of(distances);
    if (runs.size() > 1) found.steps = steps_by_row(runs, times.size(), at_end);
    return found;
}

long long phase_of(Seconds time, long long step_s) {
    const long long phase = time.time_since_epoch().count() % step_s;
    return phase < 0 ? phase + step_s : phase;
}

Phase settle(std::vector<Seconds>& times, std::size_t first, std::size_t last,
             long long step_s) {
    Phase phase;
    if (first >= last || step_s <= 0 || day_s % step_s != 0) return phase;
    const StepRows rows{times, first, last, step_s};
    if (rows.are_days_of_an_hour()) {
        phase.offset_s = phase_of(times[first], step_s);
        return phase;
    }
    if (!rows.are_near(0)) phase.offset_s = rows.commonest_phase();
    if (part_of_step * std::abs(apart(phase.offset_s, 0, step_s)) <= step_s)
        phase.offset_s = 0;
    for (std::size_t row = first; row < last; ++row) {
        const long long beside = rows.beside(row, phase.offset_s);
        if (beside == 0 || !rows.is_near(row, phase.offset_s)) continue;
        times[row] -= std::chrono::seconds(beside);
        ++phase.n_moved;
        phase.furthest_s = std::max(phase.furthest_s, std::abs(beside));
    }
    return phase;
}

}  // namespace bemcal::input
