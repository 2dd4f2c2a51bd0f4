/// An effect as a section of a job: its name, and what the catalogue's row does not say
/// already. Numbers are written so that they are read as the same.
/// Plain text without a source; the reader is description/read_effects.
#include "effects/job_section.hpp"

#include "base/units.hpp"
#include "effects/catalogue.hpp"
#include "effects/decisions.hpp"
#include "effects/steps.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::effects {
namespace {

/// Names part a parameter's target by dots.
std::string without_dots(std::string name) {
    std::ranges::replace(name, '.', ',');
    return name;
}

std::string line(const char* key, double value) {
    return fmt::format("{} = {}\n", key, value);
}

std::string line(const char* key, const std::string& text) {
    return fmt::format("{} = \"{}\"\n", key, text);
}

/// The first whole minute after a step's threshold: steps begin there.
std::string begin_of_step(const Effect& effect, physics::Seconds from) {
    const auto after = std::chrono::seconds(
        static_cast<long long>(std::floor(effect.shape.at * elapsed_year_s)) + 1);
    const auto minutes = std::chrono::ceil<std::chrono::minutes>(after);
    return physics::format_time(from + minutes);
}

std::string shape_lines(const Effect& effect, const Effect& row, physics::Seconds from) {
    const Shape& shape = effect.shape;
    if (effect.driver == Driver::elapsed && shape.form == Form::over)
        return line("since", begin_of_step(effect, from));
    std::string lines;
    if (shape.form != row.shape.form) lines += line("form", name_of(shape.form));
    if (shape.at != row.shape.at) lines += line("at", shape.at);
    if (shape.until != row.shape.until) lines += line("until", shape.until);
    return lines;
}

/// The load that counts as 1 [kW].
std::string load_line(const Effect& effect) {
    return follows_loads(effect.driver) ? line("full_load", effect.full_load / W_per_kW)
                                        : "";
}

/// "2021-05-03/2021-05-07", "12-24/01-02" of every year.
std::string dates_of(const Days& days) {
    const auto date = [&](int day) {
        const std::string text =
            physics::format_date(std::chrono::sys_days(std::chrono::days(day)));
        return days.yearly ? text.substr(5) : text;
    };
    if (days.first == days.last) {
        const std::string day = date(days.first);
        return days.yearly ? fmt::format("\"{0}/{0}\"", day) : fmt::format("\"{}\"", day);
    }
    return fmt::format("\"{}/{}\"", date(days.first), date(days.last));
}

std::string days_line(const Effect& effect) {
    std::string dates;
    for (const Days& days : effect.days)
        dates += (dates.empty() ? "" : ", ") + dates_of(days);
    return fmt::format("days = [{}]\n", dates);
}

std::string gate_lines(const Effect& effect, const Effect& row) {
    std::string lines;
    if (effect.gate == Gate::on_days)
        lines += days_line(effect);
    else if (effect.gate != row.gate)
        lines += line("gate", name_of(effect.gate));
    if (effect.weekday >= 0)
        lines += line("weekday", weekday_keys[static_cast<std::size_t>(effect.weekday)]);
    if (effect.hours.from != row.hours.from || effect.hours.until != row.hours.until)
        lines += fmt::format("hours = [{}, {}]\n", effect.hours.from, effect.hours.until);
    return lines;
}

std::string place_lines(const Effect& effect) {
    std::string lines;
    if (effect.meter) lines += line("meter", physics::name_of(*effect.meter));
    if (effect.facade) lines += line("facade", facade_key(effect));
    if (effect.driver == Driver::column) lines += line("series", effect.column);
    return lines;
}

/// 24 values of a day.
std::string day_line(const char* key, const physics::DailyRun& run,
                     const OtherHours& other) {
    std::string values;
    for (int hour = 0; hour < 24; ++hour)
        values +=
            fmt::format("{}{}", hour == 0 ? "" : ", ",
                        hour >= run.from && hour < run.until ? other.high : other.low);
    return fmt::format("{} = [{}]\n", key, values);
}

/// Adoption finds the schedule by the name between quotes.
std::string schedule_head(const std::string& schedule) {
    return fmt::format("# in the [[schedule]] \"{}\", in place of what it has:\n",
                       schedule);
}

constexpr const char* day_kind_keys[] = {"weekdays", "saturday", "sunday"};

std::string schedule_lines(const OtherHours& other) {
    std::string lines = schedule_head(other.schedule);
    for (std::size_t kind = 0; kind < other.hours.size(); ++kind)
        if (other.hours[kind] != other.declared[kind])
            lines += day_line(day_kind_keys[kind], other.hours[kind], other);
    return lines;
}

std::string list_of(std::span<const double> numbers) {
    return fmt::format("[{}]", fmt::join(numbers, ", "));
}

std::string function_lines(const DriverFunction& function) {
    std::string lines = "\n[[effect.function]]\n" + line("driver", function.driver);
    if (!function.points.knots.empty())
        lines += fmt::format("at = {}\n", list_of(function.points.knots));
    lines += fmt::format("values = {}\n", list_of(function.values));
    if (function.is_sampled()) lines += fmt::format("spread = {:.3g}\n", function.spread);
    return lines;
}

double four_digits(double value) {
    return std::stod(fmt::format("{:.4g}", value));
}

/// Within four standard deviations, where it can be simulated; rounding does not take
/// the coefficient out.
std::string parameter_lines(const std::string& name, const CoefficientBelief& belief) {
    constexpr double reach = decisions::reach_of_declared;
    const double least = std::max(belief.least, belief.mean - reach * belief.sd);
    const double most = std::min(belief.most, belief.mean + reach * belief.sd);
    return "\n[[parameter]]\n" + line("name", name) + line("target", "effect." + name) +
           line("min", std::min(four_digits(least), belief.mean)) +
           line("max", std::max(four_digits(most), belief.mean)) +
           fmt::format("prior = {{kind = \"normal\", mean = {:.4g}, sd = {:.4g}}}\n",
                       belief.mean, belief.sd);
}

/// The catalogue's row that says hook and driver; none of another effect.
const Effect* row_of_name(const Effect& effect) {
    const Entry* entry = entry_of(effect);
    const bool says_all = entry != nullptr && entry->effect.hook == effect.hook &&
                          entry->effect.driver == effect.driver;
    return says_all ? &entry->effect : nullptr;
}

}  // namespace

// A part of an effect of the catalogue has not all of its name.
std::string name_in_job(const Effect& effect) {
    const bool is_part = effect.is_named() && row_of_name(effect) == nullptr;
    return without_dots(is_part ? fmt::format("{}: {}", effect.name, name_of(effect.hook))
                                : effect.name);
}

std::string facade_key(const Effect& effect) {
    return effect.place_name.substr(0, effect.place_name.find(" facade"));
}

std::string job_section_of(const Effect& effect, const CoefficientBelief& coefficient,
                           physics::Seconds from, std::span<const std::string> taken) {
    if (effect.other_hours) return schedule_lines(*effect.other_hours);
    const Effect* row = row_of_name(effect);
    std::string name = name_in_job(effect);
    if (std::ranges::find(taken, name) != taken.end()) {
        name = without_dots(fmt::format("{}: {}", name, sentence_of(effect)));
        row = nullptr;
    }
    std::string lines = "[[effect]]\n" + line("name", name);
    if (row == nullptr)
        lines +=
            line("hook", name_of(effect.hook)) + line("driver", name_of(effect.driver));
    const Effect plain;
    const Effect& given = row != nullptr ? *row : plain;
    lines += shape_lines(effect, given, from) + load_line(effect) +
             gate_lines(effect, given) + place_lines(effect) +
             line("coefficient", coefficient.mean);
    return coefficient.sd > 0 ? lines + parameter_lines(name, coefficient) : lines;
}

std::string job_section_of(const Effect& at,
                           const std::vector<DriverFunction>& functions) {
    std::string lines;
    for (const DriverFunction& function : functions) lines += function_lines(function);
    return "[[effect]]\n" + line("name", "functions at " + without_dots(at.name)) +
           line("hook", name_of(at.hook)) + place_lines(at) + "coefficient = 1\n" + lines;
}

std::string parameter_section_of(const std::string& name,
                                 const std::vector<std::string>& paths,
                                 const CoefficientBelief& belief) {
    return "[[parameter]]\n" + line("name", name) +
           fmt::format("target = [\"{}\"]\n", fmt::join(paths, "\", \"")) +
           line("min", belief.least) + line("max", belief.most) +
           line("value", belief.mean) +
           fmt::format("prior = {{kind = \"normal\", mean = {}, sd = {:.4g}}}\n",
                       belief.mean, belief.sd);
}

std::string schedule_section_of(const std::string& schedule,
                                const physics::WeekHours& hours) {
    std::string lines = schedule_head(schedule);
    for (std::size_t kind = 0; kind < hours.size(); ++kind)
        lines += day_line(day_kind_keys[kind], hours[kind], {});
    return lines;
}

std::string as_tables(const std::string& section) {
    if (!section.starts_with('#')) return section;
    const std::size_t name = section.find('"');
    const std::size_t name_end = section.find('"', name + 1);
    return "[[schedule]]\n" +
           line("name", section.substr(name + 1, name_end - name - 1)) +
           section.substr(section.find('\n') + 1);
}

}  // namespace bemcal::effects
