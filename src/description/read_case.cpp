/// A whole building from its sections: each by its reader, in an order in which it finds
/// what it needs.
/// The sections' keys are the readers' (`read_*`).
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

}  // namespace

study::Case read_case(const Sources& sources, input::InputFiles& files) {
    study::Case building;
    const schema::Section& own = sources.own;
    building.name = own.has("name") ? own.text("name")
                                    : std::filesystem::path(own.file()).stem().string();
    building.periods = read_periods(sources);
    read_run(sources, building);
    read_weather(sources, files, building);
    const DaysOff days_off = read_days_off(sources, building.periods);
    building.school_holidays = days_off.school;
    building.profiles = read_profiles(sources, days_off.holidays, files,
                                      building.weather.site, building.decisions);
    building.columns = read_columns(sources);
    building.building = read_building(sources, building.profiles);
    building.building.name = building.name;
    read_unknown_hours(sources, building);
    read_structure(sources, building);
    check_building(sources, building);
    read_effects(sources, building);
    read_parameters(sources, building);
    add_parameters_of_structure(building);
    read_meters(sources, files, building);
    check_meter_steps(sources, building);
    return building;
}

}  // namespace bemcal::description
