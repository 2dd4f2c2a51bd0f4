/// Checks that a building has the parameters and meters that a study names, and readings
/// in the period that it learns from.
/// Follows from the building's description and its meters.
/// Whether the readings are enough is not asked.
#include "job/learning.hpp"

#include "description/words.hpp"

#include <fmt/format.h>

namespace bemcal::job {

using study::Case;

bool has_reading(const Case& building, const study::Period& period,
                 const std::string& meter) {
    const auto readings = study::readings_of(building, period);
    for (std::size_t m = 0; m < building.meters.size(); ++m) {
        if (!meter.empty() && building.meters[m].name != meter) continue;
        if (study::has_reading(readings[m].values)) return true;
    }
    return false;
}

void check_parameters(const schema::Section& section,
                      const std::vector<std::string>& asked,
                      const std::vector<physics::Parameter>& known,
                      const std::string& what) {
    const std::vector<std::string> names = description::names_of(known);
    for (const std::string& parameter : asked)
        description::check_word(section, "parameters", parameter, names, what);
}

void check_parameters(const schema::Section& section, const Learning& learning,
                      const Case& building) {
    check_parameters(section, learning.parameters, building.parameters,
                     "parameter of " + building.name);
}

void check_meters(const schema::Section& section, const Learning& learning,
                  const Case& building) {
    const std::vector<std::string> names = description::names_of(building.meters);
    const study::Period& period = period_of(building, learning.period);
    for (const std::string& meter : learning.meters) {
        description::check_word(section, "meters", meter, names,
                                "meter of " + building.name);
        if (!has_reading(building, period, meter))
            section.fail("meters",
                         fmt::format("{} of {} has no reading in the period {}; expected "
                                     "a meter with data",
                                     meter, building.name, period.name));
    }
    if (learning.meters.empty() && !has_reading(building, period, ""))
        section.fail("kind", fmt::format("needs readings, and no meter of {} has one in "
                                         "the period {}",
                                         building.name, period.name));
}

}  // namespace bemcal::job
