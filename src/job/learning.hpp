/// What a study learns, and from what: keys of the kinds that calibrate a building on its
/// meters, and their checks.
#pragma once

#include "schema/section.hpp"
#include "study/case.hpp"

#include <string>
#include <vector>

namespace bemcal::job {

inline constexpr schema::Key learning_keys[] = {
    {"study", "period", schema::Type::text, "", "", 0, 0,
     "That it learns from; default: the first."},
    {"study", "parameters", schema::Type::texts, "", "", 0, 0,
     "Names of the parameters that it calibrates, the others stay nominal; default: "
     "all."},
    {"study", "meters", schema::Type::texts, "", "", 0, 0,
     "Names of the meters that it learns from; default: all with readings."},
};

struct Learning {
    const std::string& period;
    const std::vector<std::string>& parameters;  ///< empty = all
    const std::vector<std::string>& meters;      ///< empty = all with readings
};
/// Throws UserError where one that is asked for is not known: "x" is no `what`.
void check_parameters(const schema::Section& section,
                      const std::vector<std::string>& asked,
                      const std::vector<physics::Parameter>& known,
                      const std::string& what);
/// Throw UserError where the building does not have them.
void check_parameters(const schema::Section& section, const Learning& learning,
                      const study::Case& building);
void check_meters(const schema::Section& section, const Learning& learning,
                  const study::Case& building);

/// Whether a meter, or any of them where it is "", has a reading in the period.
bool has_reading(const study::Case& building, const study::Period& period,
                 const std::string& meter);

}  // namespace bemcal::job
