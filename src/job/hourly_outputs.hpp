/// What studies of a [simulator] with a building beside it ask of a job: the loop, the
/// posterior.
#pragma once

#include "job/kind.hpp"

#include <string>
#include <vector>

namespace bemcal::job {

inline constexpr schema::Key emulated_hours_keys[] = {
    {"study", "runs", schema::Type::integer, "", "80", 20, 100000,
     "Of a [simulator], and one more: five eighths are spread over its parameters' ranges, "
     "the others come near the optimum, in three rounds. The study then goes on an "
     "emulator of all runs; the last run is where it ends."}};

/// One building, whose meters the simulator has hours of. \param meters  that the study
/// names. Throws UserError.
void check_hourly_outputs(const StudyPlace& place,
                          const std::vector<std::string>& meters);

/// The nominal point is run, and lies in the ranges that an emulator knows. Throws
/// UserError. \param why  "a loop runs it first"
void check_nominal(const StudyPlace& place, const char* why);

/// Where the job has no [simulator], a number of its runs is a mistake.
void check_no_runs(const schema::Section& section);

}  // namespace bemcal::job
