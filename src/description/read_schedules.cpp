/// Reads [[schedule]] and [[series]] into profiles: hours of a week, periods of a year, a
/// register of days, a CSV column. The more exact key of a day wins.
/// Follows from the schema; the register is paper 2's class register.
/// Schedules are evaluated by `values_of`. Gaps in a period are found by
/// `check_building`.
#include "base/error.hpp"
#include "description/building_readers.hpp"
#include "description/read_holidays.hpp"
#include "description/timed_csv.hpp"
#include "physics/week_hours.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::description {

namespace {

using physics::Day;

Day read_day(const schema::Section& section, const char* key) {
    const schema::Node& value = section.node(key);
    const schema::Key& row = *schema::find_key(section.schema(), key);
    const std::string where = section.where(key);
    Day day{};
    if (value.kind == schema::Node::Kind::number) {
        day.fill(schema::checked_number(value, row, where));
        return day;
    }
    if (value.kind != schema::Node::Kind::array || value.entries.size() != day.size())
        section.fail(key, fmt::format("has {} values; expected {}", value.entries.size(),
                                      schema::expectation(row)));
    for (std::size_t hour = 0; hour < day.size(); ++hour)
        day[hour] = schema::checked_number(value.entries[hour].node, row, where);
    return day;
}

struct DayKey {
    const char* key;
    int first, last;  ///< weekdays, 0 = Monday
};
/// The more exact key stands later and wins.
constexpr DayKey day_keys[] = {
    {"every_day", 0, 6}, {"weekdays", 0, 4},  {"weekend", 5, 6},  {"monday", 0, 0},
    {"tuesday", 1, 1},   {"wednesday", 2, 2}, {"thursday", 3, 3}, {"friday", 4, 4},
    {"saturday", 5, 5},  {"sunday", 6, 6}};

std::array<Day, 7> read_week(const schema::Section& section) {
    constexpr const char* names[] = {"monday", "tuesday",  "wednesday", "thursday",
                                     "friday", "saturday", "sunday"};
    std::array<Day, 7> week{};
    std::array<bool, 7> known{};
    section.attempt_each(day_keys, [&](const DayKey& key) {
        if (!section.has(key.key)) return;
        const Day day = read_day(section, key.key);
        for (int d = key.first; d <= key.last; ++d) {
            week[static_cast<std::size_t>(d)] = day;
            known[static_cast<std::size_t>(d)] = true;
        }
    });
    for (std::size_t d = 0; d < week.size(); ++d)
        if (!known[d])
            section.fail(
                "", fmt::format("has no values for {}; give {}, weekdays, weekend or "
                                "every_day",
                                names[d], names[d]));
    return week;
}

/// The days of a register with their numbers; a day may stand in it once.
std::map<std::chrono::sys_days, double> read_register(const schema::Section& section,
                                                      input::InputFiles& files) {
    const input::Csv& csv =
        files.csv(section.path(section.text("register")), section.where("register"));
    const std::size_t column = csv.column(section.text("register_column"));
    std::map<std::chrono::sys_days, double> days;
    for (std::size_t row = 0; row < csv.n_rows(); ++row) {
        const std::string date(csv.cell(row, 0)),
            where = fmt::format("{}:{}", csv.file, csv.lines[row]);
        const double number = input::number_in(csv, row, column);
        if (!(number >= 0))
            throw UserError(ExitCode::data,
                            where + ": expected a number of persons, 0 or more");
        try {
            const auto day =
                std::chrono::floor<std::chrono::days>(physics::parse_time(date));
            if (!days.emplace(day, number).second)
                throw UserError(ExitCode::data, fmt::format("{}: {} stands there twice; "
                                                            "expected one row a day",
                                                            where, date));
        } catch (const std::invalid_argument& error) {
            throw UserError(ExitCode::data, fmt::format("{}: {}", where, error.what()));
        }
    }
    return days;
}

bool has_unknown_hours(const schema::Section& section) {
    return section.choice("hours") == "learn";
}

physics::WeekHours usual_hours_of(const schema::Section& section) {
    const auto usual = physics::usual_hours(section.choice("use"));
    if (!usual) section.fail_value("use", "has no usual hours");
    return *usual;
}

/// Of a schedule without hours those of its use, which a loop starts from.
void read_usual_hours(const schema::Section& section, physics::Schedule& schedule) {
    std::vector<const char*> keys = {"holiday", "register", "register_column", "period"};
    for (const DayKey& key : day_keys) keys.push_back(key.key);
    section.refuse(keys,
                   "has no place beside hours = \"learn\", which says that nobody knows "
                   "the hours; remove one of the two");
    physics::set_hours(usual_hours_of(section), schedule);
}

void read_hours(const schema::Section& section, physics::Schedule& schedule) {
    if (has_unknown_hours(section)) return read_usual_hours(section, schedule);
    section.attempt_all(
        [&] {
            section.refuse({"use"},
                           "has no effect on hours that are given; remove it, or write "
                           "hours = \"learn\" in their place");
        },
        [&] { schedule.week = read_week(section); },
        [&] {
            if (section.has("holiday")) schedule.holiday = read_day(section, "holiday");
        });
    if (!section.has("holiday")) schedule.holiday = schedule.week[6];
}

/// A name that no other schedule or series has.
std::string new_name(const schema::Section& section,
                     const std::vector<physics::Profile>& others) {
    std::string name = section.text("name");
    if (std::ranges::find(others, name, &physics::Profile::name) != others.end())
        section.fail_value("name", "another schedule or series has this name");
    return name;
}

void read_season(const schema::Section& section, physics::Schedule& schedule) {
    physics::Schedule::Period season;
    section.attempt_all(
        [&] {
            season.dates = at_key(section, "dates", [&] {
                return physics::parse_date_range(section.text("dates"));
            });
        },
        [&] { season.week = read_week(section); });
    schedule.periods.push_back(season);
}

void read_days(const schema::Section& section, input::InputFiles& files,
               physics::Schedule& schedule) {
    if (section.has("register"))
        schedule.days = read_register(section, files);
    else
        section.refuse({"register_column"}, "has no effect without register");
}

void read_schedule(const schema::Section& section,
                   const std::vector<physics::DateRange>& holidays,
                   input::InputFiles& files, std::vector<physics::Profile>& profiles) {
    physics::Profile profile;
    physics::Schedule& schedule = profile.schedule;
    section.attempt_all(
        [&] { profile.name = schedule.name = new_name(section, profiles); },
        [&] {
            schedule.holidays =
                section.has("holidays") ? read_dates(section, "holidays") : holidays;
        },
        [&] { schedule.summer_time = section.choice("summer_time"); },
        [&] { read_hours(section, schedule); },
        [&] { read_days(section, files, schedule); },
        [&] {
            const auto read = [&](const auto& part) { read_season(part, schedule); };
            if (!section.each("period", "schedule.period", read)) throw schema::Follows();
        });
    profiles.push_back(std::move(profile));
}

physics::Profile profile_of(const schema::Section& section, input::InputFiles& files,
                            const physics::Site& site,
                            std::vector<study::DataDecision>& decisions) {
    const TimedCsv source = open_csv(section, "file", section.text("file"), files, site);
    note_stamps(source, section.text("name"), decisions);
    state_lines(source, decisions);
    const input::RegularSeries series = series_of(source, section.text("column"));
    physics::Profile profile;
    profile.name = section.text("name");
    profile.is_series = true;
    profile.axis = series.axis;
    profile.values = series.values;
    const double factor = section.number("factor"), offset = section.number("offset");
    for (double& value : profile.values) value = value * factor + offset;
    input::fill_gaps(profile.values, static_cast<int>(section.integer("fill_gaps") *
                                                      3600 / series.axis.step_s));
    return profile;
}

}  // namespace

void read_schedules(const Sources& sources,
                    const std::vector<physics::DateRange>& holidays,
                    input::InputFiles& files, std::vector<physics::Profile>& profiles) {
    sources.each("schedule", [&](const schema::Section& section) {
        read_schedule(section, holidays, files, profiles);
    });
}

void read_series(const Sources& sources, input::InputFiles& files, bool is_placed,
                 study::Case& building) {
    sources.each("series", [&](const schema::Section& section) {
        section.attempt_all(
            [&] { new_name(section, building.profiles); },
            [&] { check_files(section, "file", {section.text("column")}, files); });
        if (!is_placed) throw schema::Follows();
        building.profiles.push_back(
            profile_of(section, files, building.weather.site, building.decisions));
        building.columns.push_back({section.text("name"), section.has("unit")
                                                              ? section.text("unit")
                                                              : std::string()});
    });
}

void read_unknown_hours(const Sources& sources, study::Case& building) {
    const auto sections = sources.with("schedule").tables("schedule", "schedule");
    for (std::size_t k = 0; k < sections.size(); ++k) {
        const schema::Section& section = sections[k];
        if (!has_unknown_hours(section)) continue;
        if (physics::inputs_that_follow(building.building, static_cast<int>(k)).empty())
            section.fail_value("hours",
                               "nothing follows this schedule, so that no reading shows "
                               "its hours; remove it, or name it in an input: {value = "
                               "20, low = 16, schedule = \"" +
                                   section.text("name") + "\"}");
        const std::string use = section.choice("use");
        const physics::WeekHours usual = usual_hours_of(section);
        building.unknown_hours.push_back({k, use, usual});
        building.decisions.push_back(
            {"schedule " + section.text("name"), "its hours are not given",
             fmt::format("those that are usual for its use ({}): {}; a study of kind "
                         "\"loop\" learns them",
                         use, physics::sentence_of(usual))});
    }
}

}  // namespace bemcal::description
