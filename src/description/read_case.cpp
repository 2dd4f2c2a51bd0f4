/// A whole building from its sections: each by its reader, in an order in which it finds
/// what it needs.
/// The sections' keys are the readers' (`read_*`). A mistake in one section does not keep
/// the others from being read; what takes the whole building is left out then.
/// Studies are not read here.
#include "base/error.hpp"
#include "description/building_readers.hpp"
#include "description/read_holidays.hpp"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

namespace bemcal::description {

namespace {

void read_run(const Sources& sources, study::Case& building) {
    if (!sources.has("run")) return;
    const schema::Section section = sources.with("run").table("run", "run");
    building.step_s = static_cast<int>(section.integer("step"));
    if (3600 % building.step_s != 0)
        section.fail_value("step",
                           "expected a number of seconds that divides an hour: 3600, "
                           "1800, 1200, 900, 600, ...");
    building.warm_up_hours =
        static_cast<int>(std::lround(section.number("warm_up_days") * 24));
}

void check_meter_steps(const Sources& sources, const study::Case& building) {
    for (const study::Meter& meter : building.meters)
        if (meter.interval == physics::Interval::step &&
            meter.axis.step_s != building.step_s)
            sources.with("meter").fail(
                "meter",
                fmt::format("{} has interval = \"step\" and a reading every {} s, but "
                            "[run] step = {}; make them equal, or set interval",
                            meter.name, meter.axis.step_s, building.step_s));
}

/// What is called held out should have no day that was trained on.
void note_overlap(study::Case& building) {
    const study::Period& training = building.periods.front();
    for (const study::Period& period : building.periods) {
        if (period.name != "held_out") continue;
        const auto from = std::max(period.from, training.from);
        const auto to = std::min(period.to, training.to);
        if (from < to)
            building.decisions.push_back(
                {period.name,
                 fmt::format(
                     "shares {:.0f} days with {}, from {} to {}",
                     std::chrono::duration<double>(to - from).count() / physics::day_s,
                     training.name, physics::format_time(from), physics::format_time(to)),
                 "kept; its errors are not those of unseen readings",
                 study::DecisionKind::period});
    }
}

/// \return whether periods and the site's clock are known: readings need them
bool read_time_and_place(const Sources& sources, input::InputFiles& files,
                         study::Case& building) {
    const bool has_periods = sources.attempt(
        [&] {
            building.periods = read_periods(sources);
            note_overlap(building);
        },
        {"periods"});
    sources.attempt([&] { read_run(sources, building); }, {"run"});
    const bool has_weather = sources.attempt(
        [&] { read_weather(sources, files, building); }, {"site", "weather"});
    return has_periods && has_weather;
}

/// Schedules, series, and the building that follows them.
void read_what_is_there(const Sources& sources, input::InputFiles& files, bool is_placed,
                        study::Case& building) {
    DaysOff days_off;
    sources.attempt([&] { days_off = read_days_off(sources, building.periods); },
                    {"holidays"});
    building.school_holidays = days_off.school;
    sources.attempt(
        [&] { read_schedules(sources, days_off.holidays, files, building.profiles); },
        {"schedule"});
    sources.attempt([&] { read_series(sources, files, is_placed, building); },
                    {"series"});
    building.building = read_building(sources, building.profiles);
}

/// What takes the building as a whole: unknown hours, structure, effects.
void read_what_changes_it(const Sources& sources, study::Case& building) {
    read_unknown_hours(sources, building);
    read_structure(sources, building);
    check_building(sources, building);
    read_effects(sources, building);
}

/// The same where there is none: their keys and values alone.
void look_at_what_changes_it(const Sources& sources) {
    sources.attempt([&] { sources.each("effect", [](const auto&) {}); });
    sources.skip({"structure", "effect"});
}

}  // namespace

study::Case read_case(const Sources& sources, input::InputFiles& files) {
    study::Case building;
    const schema::Section& own = sources.own;
    building.name = own.has("name") ? own.text("name")
                                    : std::filesystem::path(own.file()).stem().string();
    const std::size_t n_before = own.n_failures();
    const auto is_whole = [&] { return own.n_failures() == n_before && own.is_known(); };
    const bool is_placed = read_time_and_place(sources, files, building);
    sources.attempt(
        [&] { read_what_is_there(sources, files, is_placed, building); },
        {"construction", "glazing", "boundary", "zone", "air_system", "plant", "link"});
    building.building.name = building.name;
    bool can_be = true;
    if (is_whole())
        can_be = sources.attempt([&] { read_what_changes_it(sources, building); },
                                 {"structure", "effect"});
    else
        look_at_what_changes_it(sources);
    if (can_be)
        sources.attempt([&] { read_parameters(sources, building); }, {"parameter"});
    else
        sources.skip({"parameter"});
    if (is_whole()) {
        add_parameters_of_structure(sources, building);
        sources.attempt([&] { check_loads(sources, building); });
    } else if (sources.has("structure"))
        own.mistakes()->lose("parameter");  // it brings some that no section names
    sources.attempt([&] { read_meters(sources, files, is_placed, building); }, {"meter"});
    if (is_whole()) sources.attempt([&] { check_meter_steps(sources, building); });
    return building;
}

}  // namespace bemcal::description
