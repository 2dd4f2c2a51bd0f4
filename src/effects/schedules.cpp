/// Schedules as on another day or at another hour: days are cut out of the row by the
/// calendar, and the most frequent of the nine nearest of a weekday stands for it.
/// Our own rules, without a source: a row is a schedule where 70 % of its steps repeat
/// after a week. Left out: schedules that repeat over another span than a week.
#include "effects/schedules.hpp"

#include "effects/decisions.hpp"
#include "physics/calendar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace bemcal::effects {
namespace {

using Row = std::span<const double>;
using std::chrono::days;

using decisions::nearest_days;

std::size_t index(int step) {
    return static_cast<std::size_t>(step);
}

int per_day(const physics::Drive& drive) {
    return physics::day_s / drive.axis.step_s;
}

int day_of(const physics::Drive& drive, int step) {
    const auto begin = drive.axis.begin_of(step);
    return static_cast<int>(std::chrono::floor<days>(begin).time_since_epoch().count());
}

/// Begin of a day as a step of the drive; it may lie outside.
int first_step_of(const physics::Drive& drive, int day) {
    return drive.axis.step_of(std::chrono::sys_days(days(day)));
}

/// A whole day of a row. Those with the same values have one pattern.
struct WholeDay {
    int day, first_step;
    std::size_t pattern = 0;
};

/// The whole days from a step on that are this weekday.
std::vector<WholeDay> whole_days(const physics::Drive& drive, int weekday, int from) {
    std::vector<WholeDay> found;
    const int last = day_of(drive, drive.n_steps() - 1);
    for (int day = day_of(drive, from); day <= last; ++day) {
        const int first = first_step_of(drive, day);
        const bool whole = first >= from && first + per_day(drive) <= drive.n_steps();
        const int found_weekday =
            physics::calendar_step(std::chrono::sys_days(days(day))).weekday;
        if (whole && found_weekday == weekday) found.push_back({day, first});
    }
    return found;
}

/// A pattern is numbered as the first day that has it.
void find_patterns(const physics::Drive& drive, Row row, std::vector<WholeDay>& all) {
    const auto values = [&](const WholeDay& day) {
        return row.subspan(index(day.first_step), index(per_day(drive)));
    };
    for (std::size_t k = 0; k < all.size(); ++k) {
        const auto is_alike = [&](const WholeDay& other) {
            return std::ranges::equal(values(other), values(all[k]));
        };
        all[k].pattern =
            index(static_cast<int>(std::ranges::find_if(all, is_alike) - all.begin()));
    }
}

/// The nearest of days in their order, the nearest first; of two as near the earlier one.
std::span<const WholeDay> nearest(const std::vector<WholeDay>& all, int day,
                                  std::array<WholeDay, nearest_days>& found) {
    auto after = std::ranges::lower_bound(all, day, {}, &WholeDay::day);
    auto before = after;  // one behind it
    std::size_t n = 0;
    for (; n < std::min(all.size(), found.size()); ++n) {
        const bool is_earlier =
            after == all.end() ||
            (before != all.begin() && day - std::prev(before)->day <= after->day - day);
        found[n] = is_earlier ? *--before : *after++;
    }
    return std::span(found).first(n);
}

/// The most frequent of the nearest candidates; of equally frequent ones the nearest.
WholeDay usual_day(const std::vector<WholeDay>& candidates, int day) {
    std::array<WholeDay, nearest_days> room{};
    const auto near = nearest(candidates, day, room);
    const auto frequency = [&](const WholeDay& one) {
        return std::ranges::count(near, one.pattern, &WholeDay::pattern);
    };
    return *std::ranges::max_element(near, {}, frequency);
}

}  // namespace

bool is_schedule(Row row, const physics::Drive& drive) {
    const int week = 7 * per_day(drive);
    // Of a period shorter than two weeks the last one, beside that before it.
    const int first =
        std::max(week, std::min(drive.n_warm_up + week, drive.n_steps() - week));
    int n = 0, n_equal = 0;
    for (int step = first; step < drive.n_steps(); ++step, ++n)
        n_equal += row[index(step)] == row[index(step - week)] ? 1 : 0;
    return n > 0 && n_equal >= decisions::least_repeated * n;
}

std::vector<double> as_on(int weekday, Row row, const physics::Drive& drive) {
    std::vector<double> other(row.begin(), row.end());
    std::vector<WholeDay> candidates = whole_days(drive, weekday, drive.n_warm_up);
    if (candidates.empty()) candidates = whole_days(drive, weekday, 0);  // a short period
    if (candidates.empty()) return other;
    find_patterns(drive, row, candidates);
    const int last = day_of(drive, drive.n_steps() - 1);
    for (int day = day_of(drive, 0); day <= last; ++day) {
        const int from = usual_day(candidates, day).first_step;
        const int to = first_step_of(drive, day);
        for (int k = std::max(0, -to); k < per_day(drive); ++k)
            if (to + k < drive.n_steps()) other[index(to + k)] = row[index(from + k)];
    }
    return other;
}

std::vector<double> later_by(double hours, Row row, const physics::Drive& drive) {
    const double shift = hours * 3600 / drive.axis.step_s;
    const double whole = std::floor(shift), part = shift - whole;
    const auto at = [&](int step) {
        return row[index(std::clamp(step, 0, drive.n_steps() - 1))];
    };
    std::vector<double> other;
    other.reserve(row.size());
    for (int step = 0; step < drive.n_steps(); ++step) {
        const int from = step - static_cast<int>(whole);
        const double here = at(from);
        other.push_back(part == 0 ? here : here + part * (at(from - 1) - here));
    }
    return other;
}

}  // namespace bemcal::effects
