/// Reads the time of a cell: ISO 8601 without a form, or whatever form the job gives.
/// Source: ISO 8601; other texts with the year first and a clock, which cannot be meant
/// otherwise.
/// Leaves out days or months in front, which need a form; drops fractions of a second.
#include "input/time_text.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::input {

namespace {

using std::chrono::seconds;

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
        "\"{}\" is not a time; expected one like 2021-03-05 14:00, or its form as "
        "time_format",
        text.substr(0, 40)));
}

/// The part after "HH:MM": seconds and their fraction, then an offset.
seconds seconds_part(std::string_view& rest) {
    if (rest.size() < 3 || rest[0] != ':') return seconds(0);
    const int value = digits(rest, 1, 2);
    rest.remove_prefix(3);
    if (!rest.empty() && (rest[0] == '.' || rest[0] == ',')) {
        rest.remove_prefix(1);
        while (!rest.empty() && rest[0] >= '0' && rest[0] <= '9') rest.remove_prefix(1);
    }
    return seconds(value);
}

/// 2021-03-05, 2021-03-05 14:00[:00[.000]], with T between, an offset behind.
std::optional<Stamp> parse_iso(std::string_view text) {
    using namespace std::chrono;
    const int y = digits(text, 0, 4), m = digits(text, 5, 2), d = digits(text, 8, 2);
    if (y < 0 || m < 0 || d < 0 || text[4] != '-' || text[7] != '-') return std::nullopt;
    const year_month_day date{year(y), month(static_cast<unsigned>(m)),
                              day(static_cast<unsigned>(d))};
    if (!date.ok()) return std::nullopt;
    Stamp stamp{sys_days(date), std::nullopt};
    if (text.size() == 10) return stamp;
    const int hours = digits(text, 11, 2), minutes = digits(text, 14, 2);
    if ((text[10] != ' ' && text[10] != 'T') || hours < 0 || hours > 24 || minutes < 0 ||
        minutes > 59 || text[13] != ':')
        return std::nullopt;
    std::string_view rest = text.substr(16);
    const seconds second = seconds_part(rest);
    if (second < seconds(0) || second > seconds(59)) return std::nullopt;
    const seconds clock = seconds(hours * 3600 + minutes * 60) + second;
    if (clock > std::chrono::hours(24)) return std::nullopt;
    stamp.face += clock;
    stamp.is_24 = hours == 24;
    if (rest.empty()) return stamp;
    stamp.offset = read_offset(rest);
    stamp.is_zone = is_zone_name(rest);
    return stamp.offset ? std::optional(stamp) : std::nullopt;
}

/// Other forms with the year first and a clock, which cannot be meant otherwise.
std::optional<Stamp> parse_year_first(std::string_view text) {
    if (text.size() < 8 || digits(text, 0, 4) < 0) return std::nullopt;
    for (const char* form :
         {"%Y-%m-%d %H:%M", "%Y-%m-%d %H:%M:%S", "%Y/%m/%d", "%Y/%m/%d %H:%M",
          "%Y/%m/%d %H:%M:%S", "%Y%m%dT%H%M", "%Y%m%dT%H%M%S", "%Y%m%dT%H%M%z",
          "%Y%m%dT%H%M%S%z", "%Y%m%d:%H%M", "%Y%m%d %H:%M"})
        if (auto stamp = read_time(text, form)) return stamp;
    return std::nullopt;
}

bool is_usual_year(const Stamp& stamp) {
    const int year = physics::calendar_step(stamp.face).year;
    return year >= 1800 && year <= 2500;
}

Stamp parse_format(std::string_view text, const std::string& format) {
    const auto stamp = read_time(text, format);
    if (stamp && is_usual_year(*stamp)) return *stamp;
    throw std::invalid_argument(fmt::format("\"{}\" is not a time of the form \"{}\"",
                                            text.substr(0, 40), format));
}

}  // namespace

Stamp parse_stamp(std::string_view text, const std::string& format) {
    if (!format.empty()) return parse_format(text, format);
    auto stamp = parse_iso(text);
    if (!stamp) stamp = parse_year_first(text);
    if (!stamp || !is_usual_year(*stamp)) fail_stamp(text);
    return *stamp;
}

}  // namespace bemcal::input
