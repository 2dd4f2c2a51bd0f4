/// Turns time stamps of a CSV file into begins of intervals in local standard time. A
/// clock change that the job does not explain is an error that says what to set.
/// Source: ISO 8601, or a form of strptime; summer time of the EU or the USA.
/// Leaves out other rules of summer time; drops fractions of a second. Uneven steps are
/// found by `series`.
#include "input/stamps.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::input {

namespace {

using physics::Seconds;
using std::chrono::seconds;

constexpr seconds hour{3600};
constexpr seconds half_day{12 * 3600};

/// Decimal digits from `at` on, -1 where one is not a digit.
int digits(std::string_view text, std::size_t at, std::size_t n) {
    if (at + n > text.size()) return -1;
    int value = 0;
    for (const char c : text.substr(at, n)) {
        if (c < '0' || c > '9') return -1;
        value = 10 * value + (c - '0');
    }
    return value;
}

[[noreturn]] void fail_stamp(std::string_view text) {
    throw std::invalid_argument(fmt::format(
        "\"{}\" is not a time; expected one like 2021-03-05 14:00", text.substr(0, 40)));
}

/// "Z", "+01:00", "-0530", "+01" at the end of a stamp [s]; nothing where there is none.
std::optional<seconds> offset_of(std::string_view text) {
    if (text == "Z" || text == "z" || text == " UTC") return seconds(0);
    if (text.size() < 3 || (text[0] != '+' && text[0] != '-')) return std::nullopt;
    const int hours = digits(text, 1, 2);
    const bool colon = text.size() > 3 && text[3] == ':';
    const std::size_t end = text.size() > 3 ? (colon ? 6 : 5) : 3;
    const int minutes = end > 3 ? digits(text, end - 2, 2) : 0;
    if (hours < 0 || hours > 14 || minutes < 0 || minutes > 59 || end != text.size())
        return std::nullopt;
    const seconds offset(hours * 3600 + minutes * 60);
    return text[0] == '-' ? -offset : offset;
}

/// The part after "HH:MM": seconds and their fraction, then an offset.
seconds seconds_part(std::string_view& rest) {
    if (rest.size() < 3 || rest[0] != ':') return seconds(0);
    const int value = digits(rest, 1, 2);
    rest.remove_prefix(3);
    if (!rest.empty() && rest[0] == '.') {
        rest.remove_prefix(1);
        while (!rest.empty() && rest[0] >= '0' && rest[0] <= '9') rest.remove_prefix(1);
    }
    return seconds(value);
}

Stamp parse_iso(std::string_view text) {
    using namespace std::chrono;
    const int y = digits(text, 0, 4), m = digits(text, 5, 2), d = digits(text, 8, 2);
    const year_month_day date{year(y), month(static_cast<unsigned>(m)),
                              day(static_cast<unsigned>(d))};
    if (y < 1800 || y > 2500 || !date.ok() || text[4] != '-' || text[7] != '-')
        fail_stamp(text);
    Stamp stamp{sys_days(date), false};
    if (text.size() == 10) return stamp;
    const int hours = digits(text, 11, 2), minutes = digits(text, 14, 2);
    if ((text[10] != ' ' && text[10] != 'T') || hours < 0 || hours > 24 || minutes < 0 ||
        minutes > 59 || text[13] != ':')
        fail_stamp(text);
    std::string_view rest = text.substr(16);
    const seconds second = seconds_part(rest);
    if (second < seconds(0) || second > seconds(59)) fail_stamp(text);
    stamp.time += seconds(hours * 3600 + minutes * 60) + second;
    if (rest.empty()) return stamp;
    const auto offset = offset_of(rest);
    if (!offset) fail_stamp(text);
    return {stamp.time - *offset, true};
}

/// By strptime, which knows every form that a spreadsheet writes.
Stamp parse_format(std::string_view text, const std::string& format) {
    using namespace std::chrono;
    std::tm tm{};
    tm.tm_mday = 1;
    const std::string copy(text);
    const char* end = strptime(copy.c_str(), format.c_str(), &tm);
    const year_month_day date{year(tm.tm_year + 1900),
                              month(static_cast<unsigned>(tm.tm_mon + 1)),
                              day(static_cast<unsigned>(tm.tm_mday))};
    if (end == nullptr || *end != '\0' || !date.ok() || tm.tm_year < -100 ||
        tm.tm_year > 600)
        throw std::invalid_argument(fmt::format("\"{}\" is not a time of the form \"{}\"",
                                                text.substr(0, 40), format));
    return {sys_days(date) + seconds(tm.tm_hour * 3600 + tm.tm_min * 60 + tm.tm_sec),
            false};
}

const char* rule_of(Clock clock) {
    return clock == Clock::us ? "us" : "eu";
}

/// One file's stamps on their way; `line` and `column` are for messages.
class Reader {
  public:
    Reader(const Csv& csv, std::size_t column, const StampRules& rules)
        : csv_(csv), column_(column), rules_(rules) {}

    Stamps read(int fallback_step_s) {
        read_raw();
        Stamps stamps;
        stamps.step_s = commonest_step(fallback_step_s);
        step_ = seconds(stamps.step_s);
        if (rules_.clock == Clock::unstated) check_clock_change();
        for (std::size_t row = 0; row < raw_.size(); ++row) {
            stamps.begins.push_back(standard_time(row, begin_of(raw_[row].time)));
            check_order(stamps.begins, row);
        }
        return stamps;
    }

  private:
    [[noreturn]] void fail(std::size_t row, const std::string& message) const {
        throw UserError(ExitCode::data,
                        fmt::format("{}:{}:{}: {}", csv_.file, csv_.lines[row],
                                    csv_.columns[column_], message));
    }

    void read_raw() {
        raw_.reserve(csv_.n_rows());
        for (std::size_t row = 0; row < csv_.n_rows(); ++row) {
            try {
                raw_.push_back(parse_stamp(csv_.cell(row, column_), rules_.format));
            } catch (const std::invalid_argument& error) {
                fail(row, error.what());
            }
        }
    }

    int commonest_step(int fallback_step_s) const {
        std::map<long long, int> counts;
        for (std::size_t row = 1; row < raw_.size(); ++row)
            if (const auto d = (raw_[row].time - raw_[row - 1].time).count(); d > 0)
                ++counts[d];
        const auto most = std::max_element(
            counts.begin(), counts.end(),
            [](const auto& a, const auto& b) { return a.second < b.second; });
        if (most == counts.end() || most->first > 400LL * 86400) return fallback_step_s;
        return static_cast<int>(most->first);
    }

    /// A stamp at the end of a month or year is brought inside it; calendars do the rest.
    Seconds begin_of(Seconds stamp) const {
        if (!rules_.at_end) return stamp;
        return step_ > seconds(86400) ? stamp - seconds(1) : stamp - step_;
    }

    Seconds standard_time(std::size_t row, Seconds wall) {
        if (raw_[row].is_utc) return wall + hours_of(rules_.site_offset_h);
        Seconds standard = wall;
        if (rules_.clock == Clock::eu || rules_.clock == Clock::us)
            standard = from_wall_clock(row, wall);
        last_ = standard;
        return standard + hours_of(rules_.site_offset_h - rules_.file_offset_h);
    }

    static seconds hours_of(double hours) { return seconds(std::llround(hours * 3600)); }

    bool is_summer(Seconds standard, Clock clock) const {
        return physics::is_summer_time(standard, rule_of(clock), rules_.file_offset_h);
    }

    /// Of a repeated hour, the first pass is summer time and the second is not.
    Seconds from_wall_clock(std::size_t row, Seconds wall) const {
        const bool summer = is_summer(wall - hour, rules_.clock);
        const bool winter = !is_summer(wall, rules_.clock);
        if (!summer && !winter)
            fail(row, fmt::format(
                          "{} does not exist on the wall clock (\"{}\" summer time "
                          "begins then); set clock = \"standard\" if the file has none",
                          physics::format_time(wall), rule_of(rules_.clock)));
        const bool repeated = row > 0 && wall - hour <= last_;
        return summer && !(winter && repeated) ? wall - hour : wall;
    }

    void check_order(const std::vector<Seconds>& begins, std::size_t row) const {
        if (row == 0 || begins[row] > begins[row - 1]) return;
        const bool same = begins[row] == begins[row - 1];
        fail(row,
             fmt::format("{} {} the row before ({}); rows must be in order of time, each "
                         "time once",
                         csv_.cell(row, column_), same ? "repeats" : "is earlier than",
                         csv_.cell(row - 1, column_)));
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
            if (raw_[row].is_utc || raw_[row - 1].is_utc) continue;
            const seconds distance = raw_[row].time - raw_[row - 1].time;
            const bool skipped = distance == step_ + hour;
            const bool repeated = distance == step_ - hour;
            if (!skipped && !repeated) continue;
            const auto clock = change_near(raw_[row].time, skipped);
            if (!clock || physics::calendar_step(begin_of(raw_[row].time)).hour > 4)
                continue;
            fail(row, fmt::format(
                          "an hour is {} before {}: the clock changes {} summer time "
                          "here; set clock = \"{}\" if the file follows the wall clock, "
                          "or clock = \"standard\" if it does not",
                          skipped ? "skipped" : "repeated", csv_.cell(row, column_),
                          skipped ? "to" : "from", rule_of(*clock)));
        }
    }

    const Csv& csv_;
    std::size_t column_;
    const StampRules& rules_;
    std::vector<Stamp> raw_;
    seconds step_{3600};
    Seconds last_{};
};

}  // namespace

Stamp parse_stamp(std::string_view text, const std::string& format) {
    return format.empty() ? parse_iso(text) : parse_format(text, format);
}

Stamps stamps_in(const Csv& csv, std::size_t column, const StampRules& rules,
                 int fallback_step_s) {
    return Reader(csv, column, rules).read(fallback_step_s);
}

}  // namespace bemcal::input
