/// Turns time stamps of a CSV file into begins of intervals in local standard time. A
/// clock change that the job does not explain is an error that says what to set.
/// Source: summer time of the EU or the USA; texts are read by `time_text`.
/// Stamps that close whole days are ends, unless somebody says otherwise. Leaves out
/// other rules of summer time.
#include "input/stamps.hpp"

#include "base/error.hpp"
#include "input/steps.hpp"
#include "physics/calendar.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::input {

namespace {

using physics::day_s;
using physics::Seconds;
using std::chrono::seconds;

constexpr seconds hour{3600};
constexpr seconds half_day{12 * 3600};

const char* rule_of(Clock clock) {
    return clock == Clock::us ? "us" : "eu";
}

seconds of_hours(double hours) {
    return seconds(std::llround(hours * 3600));
}

/// "1 h", "15 min", "30 s"
std::string words_of(long long s) {
    return s % 3600 == 0 ? fmt::format("{} h", s / 3600)
           : s % 60 == 0 ? fmt::format("{} min", s / 60)
                         : fmt::format("{} s", s);
}

/// "00:15"
std::string clock_words(long long s) {
    return fmt::format("{:02}:{:02}", s / 3600, s / 60 % 60);
}

/// One file's stamps on their way.
class Reader {
  public:
    Reader(const Csv& csv, const TimeColumns& time, const StampRules& rules)
        : csv_(csv), time_(time), rules_(rules) {}

    Stamps read(int fallback_step_s) {
        read_raw();
        find_steps(fallback_step_s);
        if (!time_.found.empty())
            note(time_.found, time_.per_day > 0 ? "each read as of its part of the day"
                                                : "read so; the key time overrules it");
        if (!rules_.is_said) infer_end();
        if (rules_.clock == Clock::unstated) check_clock_change();
        std::vector<Seconds> times = standard_times();
        settle_all(times);
        for (std::size_t row = 0; row < times.size(); ++row) {
            if (rules_.at_end) times[row] = begin_of(row, times[row]);
            check_order(times, row);
        }
        found_.at_end = rules_.at_end;
        found_.begins = std::move(times);
        found_.faces.reserve(raw_.size());
        for (const Stamp& stamp : raw_) found_.faces.push_back(stamp.face);
        return std::move(found_);
    }

  private:
    [[noreturn]] void fail(std::size_t row, const std::string& message) const {
        throw UserError(ExitCode::data,
                        fmt::format("{}:{}:{}: {}", csv_.file, csv_.lines[row],
                                    names_of(csv_, time_), message));
    }

    /// The row's time as it stands there.
    std::string shown(std::size_t row) const {
        if (time_.form == TimeColumns::Form::text)
            return std::string(csv_.cell(row, time_.columns[0]));
        return physics::format_time(raw_[row].face);
    }

    void note(std::string finding, std::string action) {
        found_.notes.push_back({std::move(finding), std::move(action)});
    }

    /// A cell that does not begin as any time does may stand in no row at all.
    std::string advice_on(std::size_t row) const {
        const std::string_view cell = csv_.cell(row, time_.columns[0]);
        if (!cell.empty() && cell[0] >= '0' && cell[0] <= '9') return {};
        return "; name lines that are no rows in skip, and the line of names in "
               "header_line";
    }

    void read_raw() {
        raw_.reserve(csv_.n_rows());
        for (std::size_t row = 0; row < csv_.n_rows(); ++row) {
            try {
                raw_.push_back(stamp_in(csv_, row, time_, rules_.format));
            } catch (const std::invalid_argument& error) {
                csv_.check_is_whole(row);
                fail(row, error.what() + hint_of_column(row) + advice_on(row));
            }
            check_zone(row);
        }
        found_.first = shown(0);
        found_.last = shown(raw_.size() - 1);
    }

    /// A column that holds a time where the one that was looked at holds none.
    std::string hint_of_column(std::size_t row) const {
        if (row > 0) return {};
        for (std::size_t column = 0; column < csv_.columns.size(); ++column) {
            try {
                stamp_in(csv_, row, TimeColumns(column), rules_.format);
                return fmt::format("; the column {} holds one: set time = \"{}\"",
                                   csv_.columns[column], csv_.columns[column]);
            } catch (const std::invalid_argument&) {
                continue;
            }
        }
        return {};
    }

    /// CST is of America and of China; a name far from the site is another one.
    void check_zone(std::size_t row) const {
        const Stamp& stamp = raw_[row];
        if (!stamp.is_zone || !stamp.offset) return;
        const seconds off = *stamp.offset - of_hours(rules_.site_offset_h);
        if (std::abs(off.count()) <= 3 * 3600) return;
        fail(row,
             fmt::format("{}: the zone is {:+g} h from UTC, the site's clock {:+g} h; "
                         "write the offset as +01:00, or leave the zone out and set "
                         "utc_offset",
                         shown(row), static_cast<double>(stamp.offset->count()) / 3600,
                         rules_.site_offset_h));
    }

    /// Distances of rows are those of their instants, as far as offsets tell them.
    void find_steps(int fallback_step_s) {
        std::vector<Seconds> instants;
        instants.reserve(raw_.size());
        for (const Stamp& stamp : raw_)
            instants.push_back(stamp.face - stamp.offset.value_or(seconds(0)));
        RowSteps steps = row_steps(instants, rules_.at_end);
        found_.step_s = steps.step_s > 0 ? steps.step_s : fallback_step_s;
        found_.steps = std::move(steps.steps);
        for (std::size_t row = 1; row < found_.steps.size(); ++row)
            if (found_.steps[row] != found_.steps[row - 1])
                note(fmt::format("its rows are {} apart up to {}, then {}",
                                 words_of(found_.steps[row - 1]), shown(row),
                                 words_of(found_.steps[row])),
                     "both read");
    }

    int step_at(std::size_t row) const {
        return found_.steps.empty() ? found_.step_s : found_.steps[row];
    }

    /// A stamp at the end of a month or year is brought inside it; calendars do the rest.
    Seconds begin_of(std::size_t row, Seconds stamp) const {
        if (!rules_.at_end) return stamp;
        const int step = step_at(row);
        return step > day_s ? stamp - seconds(1) : stamp - seconds(step);
    }

    /// The first and the last stamp close whole days, or midnight is written as 24:00.
    void infer_end() {
        if (rules_.at_end || step_at(0) > 3600 || raw_.size() == 1) return;
        const bool is_24 = std::ranges::any_of(raw_, &Stamp::is_24);
        if (is_24 && has_midnight()) return;
        const std::string finding =
            is_24 ? "its midnights are written as 24:00" : words_of_closed_days();
        if (finding.empty()) return;
        rules_.at_end = true;
        refind_steps();
        note(
            finding,
            fmt::format("read as ends of their intervals, which begin {} before; stamp = "
                        "\"start\" overrules it",
                        words_of(step_at(0))));
    }

    /// Days by the clock of the stamps or of the site; "" where none are closed.
    std::string words_of_closed_days() const {
        const bool as_shown = close_days([](const Stamp& stamp) { return stamp.face; });
        const auto by_site = [&](const Stamp& stamp) {
            return stamp.face - offset_of(stamp) + of_hours(rules_.site_offset_h);
        };
        if (begin_whole_days() || (!as_shown && !close_days(by_site))) return {};
        return fmt::format(
            "its first stamp is {}, its last 00:00{}: they close whole days",
            clock_words(step_at(0)), as_shown ? "" : " by the site's clock");
    }

    /// Which row a change of the step begins at depends on what a stamp is.
    void refind_steps() {
        if (found_.steps.empty()) return;
        found_.notes.erase(
            std::remove_if(found_.notes.begin(), found_.notes.end(),
                           [](const TimeNote& n) { return n.action == "both read"; }),
            found_.notes.end());
        find_steps(found_.step_s);
    }

    /// Whether the first is a step after midnight and the last at one, as `shown`.
    template <class Shown>
    bool close_days(Shown shown) const {
        return near_clock(0, shown(raw_.front()), step_at(0)) &&
               near_clock(raw_.size() - 1, shown(raw_.back()), 0);
    }

    /// Whether the row stands at this time of day, or a little beside.
    bool near_clock(std::size_t row, Seconds time, long long clock_s) const {
        const long long step = step_at(row);
        long long beside = phase_of(time, day_s) - clock_s;
        if (2 * beside > day_s) beside -= day_s;
        return part_of_step * std::abs(beside) <= step;
    }

    bool has_midnight() const {
        return std::ranges::any_of(raw_, [](const Stamp& stamp) {
            return !stamp.is_24 && phase_of(stamp.face, day_s) == 0;
        });
    }

    /// As begins they may be whole days: as written, of the site's clock, or of UTC where
    /// an offset stands in them.
    bool begin_whole_days() const {
        return begin_days_of(offset_of(raw_.front())) ||
               begin_days_of(of_hours(rules_.site_offset_h)) ||
               (raw_.front().offset && begin_days_of(seconds(0)));
    }

    bool begin_days_of(seconds clock) const {
        const auto shown_by = [&](const Stamp& stamp) {
            return stamp.face - offset_of(stamp) + clock;
        };
        return phase_of(shown_by(raw_.front()), day_s) == 0 &&
               phase_of(shown_by(raw_.back()), day_s) == day_s - step_at(raw_.size() - 1);
    }

    seconds offset_of(const Stamp& stamp) const {
        return stamp.offset.value_or(of_hours(rules_.file_offset_h));
    }

    bool follows_wall_clock() const {
        return (rules_.clock == Clock::eu || rules_.clock == Clock::us) &&
               found_.step_s < day_s;
    }

    /// What the stamps say, in the site's local standard time. Ends by the wall clock are
    /// instants, 01:45 then 03:00 in spring; some meters add a step to the wall clock's
    /// begin, 02:00 then 03:15, which then has to hold for the whole file.
    std::vector<Seconds> standard_times() {
        if (!follows_wall_clock() || !rules_.at_end) return converted(seconds(0));
        try {
            return converted(seconds(0));
        } catch (const UserError& first) {
            try {
                return converted(seconds(found_.step_s));
            } catch (const UserError&) {
                throw first;
            }
        }
    }

    /// \param ahead  of the wall clock: taken off before it is read, put on after it
    std::vector<Seconds> converted(seconds ahead) const {
        std::vector<Seconds> times;
        times.reserve(raw_.size());
        Seconds last{};  // by the file's standard time
        for (std::size_t row = 0; row < raw_.size(); ++row) {
            const Stamp& stamp = raw_[row];
            Seconds standard = stamp.face;
            if (!stamp.offset && follows_wall_clock()) {
                const seconds back = ahead > seconds(0) ? seconds(step_at(row)) : ahead;
                standard = from_wall_clock(row, stamp.face - back, last);
                last = standard;
                standard += back;
            }
            times.push_back(standard - offset_of(stamp) + of_hours(rules_.site_offset_h));
            if (follows_wall_clock()) check_order(times, row);
        }
        return times;
    }

    bool is_summer(Seconds standard, Clock clock) const {
        return physics::is_summer_time(standard, rule_of(clock), rules_.file_offset_h);
    }

    /// Of a repeated hour, the first pass is summer time and the second is not.
    Seconds from_wall_clock(std::size_t row, Seconds wall, Seconds last) const {
        const bool summer = is_summer(wall - hour, rules_.clock);
        const bool winter = !is_summer(wall, rules_.clock);
        if (!summer && !winter)
            fail(row, fmt::format(
                          "{} does not exist on the wall clock (\"{}\" summer time "
                          "begins then); set clock = \"standard\" if the file has none",
                          physics::format_time(wall), rule_of(rules_.clock)));
        const bool repeated = row > 0 && wall - hour <= last;
        return summer && !(winter && repeated) ? wall - hour : wall;
    }

    void check_order(const std::vector<Seconds>& times, std::size_t row) const {
        if (row == 0 || times[row] > times[row - 1]) return;
        const bool same = times[row] == times[row - 1];
        fail(row, fmt::format(
                      "{} {} the row before ({}); rows must be in order of time, each "
                      "time once",
                      shown(row), same ? "repeats" : "is earlier than", shown(row - 1)));
    }

    /// Whether the clock changes within half a day of `time`; if so, by which rule.
    std::optional<Clock> change_near(Seconds time, bool to_summer) const {
        for (const Clock clock : {Clock::eu, Clock::us})
            if (is_summer(time + half_day, clock) == to_summer &&
                is_summer(time - half_day, clock) != to_summer)
                return clock;
        return std::nullopt;
    }

    void check_clock_change() const {
        for (std::size_t row = 1; row < raw_.size(); ++row) {
            if (raw_[row].offset || raw_[row - 1].offset) continue;
            const seconds distance = raw_[row].face - raw_[row - 1].face;
            const seconds step(step_at(row));
            const bool skipped = distance == step + hour;
            const bool repeated = distance == step - hour;
            if (!skipped && !repeated) continue;
            const auto clock = change_near(raw_[row].face, skipped);
            if (!clock || physics::calendar_step(begin_of(row, raw_[row].face)).hour > 4)
                continue;
            fail(row, fmt::format(
                          "an hour is {} before {}: the clock changes {} summer time "
                          "here; set clock = \"{}\" if the file follows the wall clock, "
                          "or clock = \"standard\" if it does not",
                          skipped ? "skipped" : "repeated", shown(row),
                          skipped ? "to" : "from", rule_of(*clock)));
        }
    }

    /// Rows of one step after the other.
    void settle_all(std::vector<Seconds>& times) {
        for (std::size_t first = 0; first < times.size();) {
            const int step = step_at(first);
            std::size_t last = first;
            while (last < times.size() && step_at(last) == step) ++last;
            settle_rows(times, first, last, step);
            first = last;
        }
    }

    /// Readings of days, each written just before midnight, are those of the days that
    /// they stand in.
    bool are_last_minutes(const std::vector<Seconds>& times, std::size_t first,
                          std::size_t last, int step) const {
        constexpr int last_minutes = 1800;  // [s]
        return step == day_s && !rules_.is_said && !rules_.at_end && !rules_.is_count &&
               std::all_of(times.begin() + static_cast<std::ptrdiff_t>(first),
                           times.begin() + static_cast<std::ptrdiff_t>(last),
                           [](Seconds time) {
                               return phase_of(time, day_s) >= day_s - last_minutes;
                           });
    }

    void settle_rows(std::vector<Seconds>& times, std::size_t first, std::size_t last,
                     int step) {
        if (are_last_minutes(times, first, last, step)) {
            for (std::size_t row = first; row < last; ++row)
                times[row] -= seconds(phase_of(times[row], day_s));
            note("its stamps are the last minutes of days",
                 "each read as of the day that it stands in; stamp overrules it");
            return;
        }
        const Phase phase = settle(times, first, last, step);
        if (phase.n_moved > 0)
            note(fmt::format("{} of {} stamps lie up to {} beside their step of {}",
                             phase.n_moved, last - first, words_of(phase.furthest_s),
                             words_of(step)),
                 "moved to the nearest step");
        if (phase.offset_s == 0 || step > 3600) return;
        const std::string finding = fmt::format("its stamps lie {} after the steps of {}",
                                                words_of(phase.offset_s), words_of(step));
        if (!stands_inside(phase, first, step)) {
            note(finding + " in local standard time",
                 "readings shared out between the steps that they lie in");
            return;
        }
        for (std::size_t row = first; row < last; ++row)
            if (phase_of(times[row], step) == phase.offset_s)
                times[row] -= seconds(phase.offset_s);
        note(finding, "each read as of the step that it stands in; stamp overrules it");
    }

    /// A stamp in the middle of its step, or of an instant in it, and no begin or end.
    bool stands_inside(const Phase& phase, std::size_t first, int step) const {
        const long long on_face = phase_of(raw_[first].face, step);
        const bool is_on_step = part_of_step * std::min(on_face, step - on_face) <= step;
        const bool is_middle =
            part_of_step * std::abs(2 * phase.offset_s - step) <= 2LL * step;
        return !rules_.is_said && !rules_.at_end && !is_on_step &&
               (rules_.is_mean || is_middle);
    }

    const Csv& csv_;
    const TimeColumns& time_;
    StampRules rules_;
    std::vector<Stamp> raw_;
    Stamps found_;
};

}  // namespace

Stamps stamps_in(const Csv& csv, const TimeColumns& time, const StampRules& rules,
                 int fallback_step_s) {
    return Reader(csv, time, rules).read(fallback_step_s);
}

}  // namespace bemcal::input
