/// Checks that a [simulator] has hours of a building's meters.
/// Follows from the job's sections. Whether the hours are right only a run shows.
#include "job/hourly_outputs.hpp"

#include "description/words.hpp"

#include <fmt/format.h>

namespace bemcal::job {

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
    for (const std::string& meter : meters)
        description::check_word(section, "meters", meter, known,
                                "meter of a [[simulator.hourly]]");
}

void check_nominal(const StudyPlace& place, const char* why) {
    const auto lines = place.root.table("simulator", "simulator")
                           .tables("parameter", "simulator.parameter");
    const auto& parameters = place.job.hourly_simulator->parameters();
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
