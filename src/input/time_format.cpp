/// Reads a time by a form of strptime: one table of numbers, one of abbreviations, and a
/// few conversions of their own. No locale, no clock and no zone of the machine is asked.
/// Source: POSIX strptime, with glibc's %s, %z and %Z and Python's %f.
/// Leaves out weeks of the year (%U, %W, %V), months in other languages than English, and
/// names of zones that several zones have.
#include "input/time_format.hpp"

#include "input/data_text.hpp"

#include <array>
#include <cctype>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::input {

namespace {

using std::chrono::seconds;

/// What the conversions have read; -1 = nothing.
struct Parts {
    int year = -1, short_year = -1, century = -1, month = -1, day = -1, day_of_year = -1;
    int hour = 0, minute = 0, second = 0, ignored = 0;
    int half = -1;  ///< of the day: 0 = AM, 1 = PM
    std::optional<long long> epoch_s;
    std::optional<seconds> offset;
    bool is_zone = false;
};

struct Number {
    char conversion;
    int digits, least, most;
    int Parts::* to;
};
constexpr Number numbers[] = {
    {'Y', 4, 0, 9999, &Parts::year},       {'C', 2, 0, 99, &Parts::century},
    {'y', 2, 0, 99, &Parts::short_year},   {'m', 2, 1, 12, &Parts::month},
    {'d', 2, 1, 31, &Parts::day},          {'e', 2, 1, 31, &Parts::day},
    {'j', 3, 1, 366, &Parts::day_of_year}, {'H', 2, 0, 24, &Parts::hour},
    {'k', 2, 0, 24, &Parts::hour},         {'I', 2, 1, 12, &Parts::hour},
    {'l', 2, 1, 12, &Parts::hour},         {'M', 2, 0, 59, &Parts::minute},
    {'S', 2, 0, 60, &Parts::second},       {'u', 1, 1, 7, &Parts::ignored},
    {'w', 1, 0, 6, &Parts::ignored}};

struct Abbreviation {
    char conversion;
    const char* form;
};
constexpr Abbreviation abbreviations[] = {
    {'D', "%m/%d/%y"},    {'F', "%Y-%m-%d"},
    {'T', "%H:%M:%S"},    {'R', "%H:%M"},
    {'r', "%I:%M:%S %p"}, {'x', "%m/%d/%y"},
    {'X', "%H:%M:%S"},    {'n', " "},
    {'t', " "},           {'c', "%a %b %e %H:%M:%S %Y"}};

constexpr std::string_view others = "aAbBhpPzZsf%";

constexpr std::array<std::string_view, 12> months = {
    "january", "february", "march",     "april",   "may",      "june",
    "july",    "august",   "september", "october", "november", "december"};
constexpr std::array<std::string_view, 7> weekdays = {
    "monday", "tuesday", "wednesday", "thursday", "friday", "saturday", "sunday"};

struct Zone {
    std::string_view name;
    double hours;
};
/// Of clocks in use; "CST" is that of America, and looked at by who knows the site.
constexpr Zone zones[] = {
    {"WET", 0},   {"WEST", 1},  {"BST", 1},   {"CET", 1},    {"CEST", 2},    {"MEZ", 1},
    {"MESZ", 2},  {"EET", 2},   {"EEST", 3},  {"MSK", 3},    {"SAST", 2},    {"EST", -5},
    {"EDT", -4},  {"CST", -6},  {"CDT", -5},  {"MST", -7},   {"MDT", -6},    {"PST", -8},
    {"PDT", -7},  {"AKST", -9}, {"AKDT", -8}, {"HST", -10},  {"JST", 9},     {"KST", 9},
    {"HKT", 8},   {"SGT", 8},   {"AWST", 8},  {"ACST", 9.5}, {"ACDT", 10.5}, {"AEST", 10},
    {"AEDT", 11}, {"NZST", 12}, {"NZDT", 13}};

constexpr char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Whether `text` begins with `word`, which is in small letters.
bool begins_with(std::string_view text, std::string_view word) {
    if (text.size() < word.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i)
        if (lower(text[i]) != word[i]) return false;
    return true;
}

/// Blanks of a keyboard, and the narrow and fixed ones that programs write before PM.
void skip_blanks(std::string_view& text) {
    for (bool again = true; again;) {
        again = false;
        for (const std::string_view blank :
             {" ", "\t", "\r", "\n", "\xC2\xA0", "\xE2\x80\xAF"})
            if (text.starts_with(blank)) {
                text.remove_prefix(blank.size());
                again = true;
            }
    }
}

/// Up to `most` digits; nothing where there is none.
std::optional<long long> take_digits(std::string_view& text, int most) {
    long long value = 0;
    int n = 0;
    for (; n < most && !text.empty() && is_digit(text.front()); ++n) {
        value = 10 * value + (text.front() - '0');
        text.remove_prefix(1);
    }
    return n > 0 ? std::optional(value) : std::nullopt;
}

bool take_number(std::string_view& text, const Number& row, Parts& parts) {
    skip_blanks(text);
    const auto value = take_digits(text, row.digits);
    if (!value || *value < row.least || *value > row.most) return false;
    parts.*row.to = static_cast<int>(*value);
    return true;
}

/// A name or its first three letters; its place in the list, or -1.
template <std::size_t n>
int take_name(std::string_view& text, const std::array<std::string_view, n>& names) {
    for (std::size_t k = 0; k < n; ++k)
        for (const std::string_view name : {names[k], names[k].substr(0, 3)})
            if (begins_with(text, name)) {
                text.remove_prefix(name.size());
                return static_cast<int>(k);
            }
    return -1;
}

bool take_month(std::string_view& text, Parts& parts) {
    skip_blanks(text);
    const int month = take_name(text, months);
    if (month >= 0) parts.month = month + 1;
    return month >= 0;
}

bool take_weekday(std::string_view& text) {
    skip_blanks(text);
    return take_name(text, weekdays) >= 0;
}

/// "AM", "p.m.", "a. m."
bool take_half(std::string_view& text, Parts& parts) {
    skip_blanks(text);
    constexpr std::string_view words[] = {"a. m.", "a.m.", "am", "p. m.", "p.m.", "pm"};
    for (std::size_t k = 0; k < std::size(words); ++k)
        if (begins_with(text, words[k])) {
            text.remove_prefix(words[k].size());
            parts.half = k < 3 ? 0 : 1;
            return true;
        }
    return false;
}

/// The letters, digits and signs that may be an offset.
bool take_offset(std::string_view& text, Parts& parts) {
    skip_blanks(text);
    std::size_t end = 0;
    while (end < text.size() &&
           (std::isalnum(static_cast<unsigned char>(text[end])) != 0 ||
            text[end] == '+' || text[end] == '-' || text[end] == ':'))
        ++end;
    parts.offset = read_offset(text.substr(0, end));
    parts.is_zone = is_zone_name(text.substr(0, end));
    text.remove_prefix(end);
    return parts.offset.has_value();
}

void skip_fraction(std::string_view& text) {
    if (text.size() < 2 || (text[0] != '.' && text[0] != ',') || !is_digit(text[1]))
        return;
    text.remove_prefix(1);
    take_digits(text, 18);
}

/// Seconds since 1970, or as many digits as make it thousandths or millionths.
bool take_epoch(std::string_view& text, Parts& parts) {
    skip_blanks(text);
    const bool is_before = text.starts_with('-');
    if (is_before) text.remove_prefix(1);
    const std::size_t size = text.size();
    auto value = take_digits(text, 18);
    if (!value) return false;
    const std::size_t n = size - text.size();
    const long long per_second = n >= 16 ? 1'000'000 : n >= 13 ? 1000 : 1;
    parts.epoch_s = (is_before ? -*value : *value) / per_second;
    skip_fraction(text);
    return true;
}

bool take(std::string_view& text, std::string_view format, Parts& parts);

bool take_conversion(std::string_view& text, char conversion, Parts& parts) {
    for (const Number& row : numbers)
        if (row.conversion == conversion) return take_number(text, row, parts);
    for (const Abbreviation& row : abbreviations)
        if (row.conversion == conversion) return take(text, row.form, parts);
    switch (conversion) {
        case 'a':
        case 'A':
            return take_weekday(text);
        case 'b':
        case 'B':
        case 'h':
            return take_month(text, parts);
        case 'p':
        case 'P':
            return take_half(text, parts);
        case 'z':
        case 'Z':
            return take_offset(text, parts);
        case 's':
            return take_epoch(text, parts);
        case 'f':
            return take_digits(text, 9).has_value();
        default:
            if (conversion != '%' || !text.starts_with('%')) return false;
            text.remove_prefix(1);
            return true;
    }
}

/// The letter of the conversion at the start of `format`, past its flags; 0 = none.
char next_conversion(std::string_view& format) {
    format.remove_prefix(1);
    while (!format.empty() &&
           std::string_view("-_0^#EO").find(format.front()) != std::string_view::npos)
        format.remove_prefix(1);
    if (format.empty()) return 0;
    const char conversion = format.front();
    format.remove_prefix(1);
    return conversion;
}

bool take(std::string_view& text, std::string_view format, Parts& parts) {
    while (!format.empty()) {
        const std::string_view before = format;
        skip_blanks(format);
        if (format.size() < before.size()) {
            skip_blanks(text);
        } else if (format.front() == '%') {
            if (!take_conversion(text, next_conversion(format), parts)) return false;
        } else {
            if (text.empty() || text.front() != format.front()) return false;
            text.remove_prefix(1);
            format.remove_prefix(1);
        }
    }
    return true;
}

/// Of two digits: 69 to 99 are of the last century.
int year_of(const Parts& parts) {
    if (parts.short_year < 0) return parts.year;
    if (parts.century >= 0) return 100 * parts.century + parts.short_year;
    return parts.short_year + (parts.short_year < 69 ? 2000 : 1900);
}

std::optional<std::chrono::sys_days> day_of(const Parts& parts) {
    using namespace std::chrono;
    const year y(year_of(parts));
    if (parts.month < 0 && parts.day < 0 && parts.day_of_year > 0) {
        if (parts.day_of_year == 366 && !y.is_leap()) return std::nullopt;
        return sys_days(y / January / 1) + days(parts.day_of_year - 1);
    }
    const year_month_day date{y, month(static_cast<unsigned>(std::max(parts.month, 1))),
                              day(static_cast<unsigned>(std::max(parts.day, 1)))};
    return date.ok() ? std::optional(sys_days(date)) : std::nullopt;
}

/// Of 12 hours where the text has AM or PM; nothing where the two disagree.
std::optional<seconds> clock_of(const Parts& parts) {
    int hour = parts.hour;
    if (parts.half >= 0 && hour <= 12) hour = hour % 12 + 12 * parts.half;
    if (parts.half == 0 && hour > 12) return std::nullopt;
    const seconds clock(3600 * hour + 60 * parts.minute + parts.second);
    return clock > std::chrono::hours(24) ? std::nullopt : std::optional(clock);
}

bool is_known(char conversion) {
    for (const Number& row : numbers)
        if (row.conversion == conversion) return true;
    for (const Abbreviation& row : abbreviations)
        if (row.conversion == conversion) return true;
    return conversion != 0 && others.find(conversion) != std::string_view::npos;
}

/// Calls `see` with every conversion of a form.
template <class F>
void for_conversions(std::string_view format, F see) {
    while (!format.empty()) {
        if (format.front() == '%')
            see(next_conversion(format));
        else
            format.remove_prefix(1);
    }
}

bool has_any(const std::string& format, std::string_view conversions) {
    bool found = false;
    for_conversions(format, [&](char c) {
        found = found || (c != 0 && conversions.find(c) != std::string_view::npos);
    });
    return found;
}

/// "+01:00", "-0530", "+01", "+1" [s]
std::optional<seconds> signed_offset(std::string_view text) {
    const bool is_west = text.front() == '-';
    text.remove_prefix(1);
    const std::size_t size = text.size();
    const auto hours = take_digits(text, 2);
    if (!hours || (size - text.size() < 2 && !text.empty())) return std::nullopt;
    const bool has_colon = text.starts_with(':');
    if (has_colon) text.remove_prefix(1);
    const bool has_minutes = has_colon || !text.empty();
    const std::size_t rest = text.size();
    const auto minutes = take_digits(text, 2);
    if (has_minutes && (!minutes || rest != 2)) return std::nullopt;
    if (*hours > 14 || minutes.value_or(0) > 59) return std::nullopt;
    const seconds offset(*hours * 3600 + minutes.value_or(0) * 60);
    return is_west ? -offset : offset;
}

const Zone* zone_named(std::string_view text) {
    for (const Zone& zone : zones)
        if (zone.name == text) return &zone;
    return nullptr;
}

}  // namespace

void check_time_format(const std::string& format) {
    for_conversions(format, [](char conversion) {
        if (is_known(conversion)) return;
        throw std::invalid_argument(fmt::format(
            "%{} is no conversion that is known here; expected those of strptime: %Y %m "
            "%d %H %M %S, %y %b %j %I %p, %z %Z %s",
            conversion == 0 ? std::string() : std::string(1, conversion)));
    });
    if (!has_any(format, "YyDFxcs"))
        throw std::invalid_argument(
            "reads no year; expected %Y, %y or %s in it, as in \"%d/%m/%Y %H:%M\"");
}

bool has_clock(const std::string& format) {
    return has_any(format, "HIklTRrXcs");
}

std::optional<Stamp> read_time(std::string_view text, std::string_view format) {
    Parts parts;
    if (!take(text, format, parts) || !text.empty()) return std::nullopt;
    if (parts.epoch_s)
        return Stamp{physics::Seconds(seconds(*parts.epoch_s)), seconds(0)};
    const auto day = day_of(parts);
    const auto clock = clock_of(parts);
    if (!day || !clock) return std::nullopt;
    return Stamp{*day + *clock, parts.offset, parts.hour == 24, parts.is_zone};
}

std::optional<seconds> read_clock(std::string_view text) {
    for (const std::string_view form :
         {"%H:%M", "%H:%M:%S", "%H:%M %p", "%H:%M:%S %p", "%I %p", "%H:%M:%S.%f", "%H"}) {
        Parts parts;
        std::string_view rest = text;
        if (take(rest, form, parts) && rest.empty()) return clock_of(parts);
    }
    // 0015, 1400, 140000: as numbers they may have lost their leading zeros.
    std::string_view rest = text;
    const auto number = take_digits(rest, 6);
    if (!number || !rest.empty() || text.size() < 3) return std::nullopt;
    const long long hhmm = text.size() > 4 ? *number / 100 : *number;
    Parts parts;
    parts.hour = static_cast<int>(hhmm / 100);
    parts.minute = static_cast<int>(hhmm % 100);
    parts.second = text.size() > 4 ? static_cast<int>(*number % 100) : 0;
    if (parts.minute > 59 || parts.second > 59) return std::nullopt;
    return clock_of(parts);
}

std::optional<seconds> read_offset(std::string_view text) {
    skip_blanks(text);
    if (text == "Z" || text == "z") return seconds(0);
    if (const Zone* zone = zone_named(text))
        return seconds(static_cast<long long>(zone->hours * 3600));
    for (const std::string_view name : {"utc", "gmt"})
        if (begins_with(text, name)) {
            text.remove_prefix(name.size());
            if (text.empty()) return seconds(0);
            break;
        }
    if (text.empty() || (text[0] != '+' && text[0] != '-')) return std::nullopt;
    return signed_offset(text);
}

bool is_zone_name(std::string_view text) {
    skip_blanks(text);
    return zone_named(text) != nullptr;
}

}  // namespace bemcal::input
