/// An effect in words: driver, shape, gate and place, from the names of its parts; and
/// the unit of its coefficient.
/// Plain text without a source. Dates of a year are those of 2021, no leap year. What an
/// effect means is left to the catalogue's sentences.
#include "effects/drivers.hpp"
#include "effects/hooks.hpp"
#include "physics/calendar.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace bemcal::effects {
namespace {

constexpr const char* weekdays[] = {"Monday", "Tuesday",  "Wednesday", "Thursday",
                                    "Friday", "Saturday", "Sunday"};

const char* weekday_of(double number) {
    return weekdays[static_cast<std::size_t>(std::clamp(number, 0.0, 6.0))];
}

/// "3 m/s", "24".
std::string with_unit(double value, const char* unit) {
    if (*unit == '\0') return fmt::format("{:.6g}", value);
    return fmt::format("{:.6g} {}", value, unit);
}

/// A day of the year as a date of a year that is no leap year: "1 May".
std::string date_of(double day_of_year) {
    using namespace std::chrono;
    const auto step = physics::calendar_step(sys_days(year(2021) / January / 1) +
                                             days(static_cast<int>(day_of_year) % 365));
    return fmt::format("{} {}", step.day, physics::name_of_month(step.month));
}

std::string window_of(const Effect& effect) {
    const Shape& shape = effect.shape;
    if (effect.driver == Driver::hour)
        return fmt::format("from {:.6g} to {:.6g} h", shape.at, shape.until);
    if (effect.driver == Driver::day_of_year)
        return fmt::format("from {} to {}", date_of(shape.at), date_of(shape.until));
    return fmt::format("{} from {:.6g} to {}", name_of(effect.driver), shape.at,
                       with_unit(shape.until, unit_of_values(effect.driver)));
}

std::string words_of_driver(const Effect& effect) {
    return effect.driver == Driver::column ? fmt::format("'{}'", effect.column)
                                           : name_of(effect.driver);
}

/// Drivers whose shape is what they are themselves.
std::string named_driver(const Effect& effect) {
    const double at = effect.shape.at;
    switch (effect.driver) {
        case Driver::one:
            return effect.hook == Hook::venting && at > 0
                       ? fmt::format("in rooms above {:.6g} degC", at)
                       : "constant";
        case Driver::another_day:
            return fmt::format("as on {}", weekday_of(at));
        case Driver::shifted_hours:
            return fmt::format("{:.6g} h {}", std::abs(at), at < 0 ? "earlier" : "later");
        case Driver::constant_temperature:
            return fmt::format("to {:.6g} degC", at);
        default:
            return words_of_driver(effect);
    }
}

std::string shape_of(const Effect& effect) {
    const Shape& shape = effect.shape;
    const std::string at = with_unit(shape.at, unit_of_values(effect.driver));
    switch (shape.form) {
        case Form::linear:
            return named_driver(effect);
        case Form::within:
            return window_of(effect);
        case Form::lagged:
            return fmt::format("{} lagged by {:.6g} h", words_of_driver(effect),
                               shape.at);
        case Form::over:
            if (effect.driver == Driver::elapsed)
                return fmt::format("after {:.3g} years", shape.at);
            return fmt::format("where {} is above {}", words_of_driver(effect), at);
        case Form::under:
            return fmt::format("where {} is below {}", words_of_driver(effect), at);
        default:
            return fmt::format("{} {} {}", words_of_driver(effect), name_of(shape.form),
                               at);
    }
}

/// "2021-03-05", or of every year "03-05".
std::string date_of(int day, bool yearly) {
    const auto date = physics::format_date(std::chrono::sys_days(std::chrono::days(day)));
    return yearly ? date.substr(5) : date;
}

std::string gate_of(const Effect& effect) {
    constexpr const char* gates[] = {"",
                                     ", while occupied",
                                     ", while not occupied",
                                     ", by day",
                                     ", at night",
                                     ", at weekends",
                                     ", on weekdays",
                                     ", in the heating season",
                                     ", in the cooling season",
                                     "",
                                     ", in EU summer time",
                                     ", in US summer time"};
    std::string text = gates[static_cast<std::size_t>(effect.gate)];
    if (!effect.calendar.empty())
        text += ", on the public holidays of " + effect.calendar;
    for (const Days& days : effect.days) {
        if (days.of_calendar) continue;
        text += ", " + date_of(days.first, days.yearly);
        if (days.last != days.first) text += " to " + date_of(days.last, days.yearly);
    }
    if (std::ranges::any_of(effect.days, &Days::yearly))
        text += " (month-day, every year)";
    if (effect.weekday >= 0) text += fmt::format(", on {}s", weekday_of(effect.weekday));
    if (effect.hours.from != 0 || effect.hours.until != 24)
        text += fmt::format(", from {:.6g} to {:.6g} h", effect.hours.from,
                            effect.hours.until);
    return text;
}

bool is_graded(Form form) {
    return form == Form::linear || form == Form::above || form == Form::below ||
           form == Form::lagged;
}

/// "plant runs Monday to Friday 9 to 21 h, Saturdays off; declared 6 to 18 h, 8 to 13 h":
/// the days that differ.
std::string sentence_of(const OtherHours& other) {
    std::string hours, declared;
    for (std::size_t kind = 0; kind < other.hours.size(); ++kind) {
        if (other.hours[kind] == other.declared[kind]) continue;
        const char* comma = hours.empty() ? "" : ", ";
        hours += fmt::format("{}{} {}", comma,
                             physics::name_of(static_cast<physics::DayKind>(kind)),
                             physics::sentence_of(other.hours[kind]));
        declared += comma + physics::sentence_of(other.declared[kind]);
    }
    return fmt::format("{} runs {}; declared {}", other.schedule, hours, declared);
}

}  // namespace

std::string sentence_of(const Effect& effect) {
    if (effect.other_hours) return sentence_of(*effect.other_hours);
    const std::string text = shape_of(effect) + gate_of(effect);
    return effect.place_name.empty() ? text : text + ", " + effect.place_name;
}

std::string unit_of(const Effect& effect) {
    std::string unit = unit_of(effect.hook);
    const std::string per = unit_of(effect.driver);
    if (per.empty() || !is_graded(effect.shape.form) ||
        !row_of(effect.hook).is_per_driver)
        return unit;
    if (unit == "-") return fmt::format("1/({})", per);
    return fmt::format("{} per {}", unit, per);
}

}  // namespace bemcal::effects
