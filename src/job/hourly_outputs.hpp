/// What studies of a [simulator] with a building beside it ask of a job: the loop, the
/// posterior.
#pragma once

#include "job/kind.hpp"

#include <string>
#include <vector>

namespace bemcal::job {

/// One building, whose meters the simulator has hours of. \param meters  that the study
/// names. Throws UserError.
void check_hourly_outputs(const StudyPlace& place,
                          const std::vector<std::string>& meters);

/// Where the job has no [simulator], a number of its runs is a mistake.
void check_no_runs(const schema::Section& section);

}  // namespace bemcal::job
