/// Checks that a [simulator] has hours of a building's meters.
/// Follows from the job's sections. Whether the hours are right only a run shows.
#include "job/hourly_outputs.hpp"

#include "description/words.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

/// Hours of the program are sums over meters' intervals, and no parts of one.
void check_intervals(const schema::Section& section, const study::Case& twin) {
    constexpr int hour_s = 3600;
    for (const study::Meter& meter : twin.meters)
        if (meter.interval == physics::Interval::step && twin.step_s < hour_s)
            section.fail_value(
                "kind",
                fmt::format("takes hours of the program, and the meter {} is read every "
                            "{} s; expected interval = \"hourly\" there",
                            meter.name, twin.step_s));
}

void check_days_of_periods(const StudyPlace& place, const study::Case& twin) {
    const auto is_within_a_day = [](const study::Period& period) {
        return period.from != std::chrono::floor<std::chrono::days>(period.from) ||
               period.to != std::chrono::floor<std::chrono::days>(period.to);
    };
    if (place.job.hourly_simulator->takes_periods() &&
        std::ranges::any_of(twin.periods, is_within_a_day))
        place.root.table("simulator", "simulator")
            .fail("periods",
                  "the file has days, and a period begins or ends within one; "
                  "expected whole days in [periods], or no periods here");
}

}  // namespace

void check_hourly_outputs(const StudyPlace& place,
                          const std::vector<std::string>& meters) {
    const schema::Section& section = place.section;
    if (place.job.buildings.size() != 1)
        section.fail("kind",
                     "is of a [simulator], which has one building beside it as its "
                     "twin; expected the building's sections in this file");
    if (!place.job.hourly_simulator)
        section.fail_value("kind",
                           "needs hours of the [simulator]; expected a "
                           "[[simulator.hourly]] for each meter");
    const study::Case& twin = place.job.buildings[0];
    const auto& known = place.job.hourly_simulator->meters();
    const auto hours =
        place.root.table("simulator", "simulator").tables("hourly", "simulator.hourly");
    for (std::size_t k = 0; k < known.size(); ++k)
        description::check_word(hours[k], "meter", known[k],
                                description::names_of(twin.meters),
                                "meter of " + twin.name);
    check_intervals(section, twin);
    check_days_of_periods(place, twin);
    for (const std::string& meter : meters)
        description::check_word(section, "meters", meter, known,
                                "meter of a [[simulator.hourly]]");
}

void check_nominal(const StudyPlace& place, const char* why) {
    const auto lines = place.root.table("simulator", "simulator")
                           .tables("parameter", "simulator.parameter");
    const auto& parameters = place.job.simulator->parameters();
    for (std::size_t k = 0; k < parameters.size(); ++k)
        if (parameters[k].nominal < parameters[k].least ||
            parameters[k].nominal > parameters[k].most)
            lines[k].fail_value(
                "nominal",
                fmt::format("{}; expected it between min = {:g} and max = {:g}", why,
                            parameters[k].least, parameters[k].most));
}

void check_no_runs(const schema::Section& section) {
    if (section.has("runs"))
        section.fail("runs", "is of a [simulator], and the job has none");
}

}  // namespace bemcal::job
