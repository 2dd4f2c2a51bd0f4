/// [[study]]: read by the rows of their kinds, then checked against the buildings.
#pragma once

#include "input/input_files.hpp"
#include "job/job.hpp"
#include "job/names.hpp"
#include "schema/section.hpp"

#include <vector>

namespace bemcal::job {

/// \param simulator  of the job, or nullptr
/// Where mistakes are kept, the studies without one.
std::vector<StudySpec> read_studies(const schema::Section& root, input::InputFiles& files,
                                    std::uint64_t seed,
                                    const SimulatorPointer& simulator);

/// What the studies need of a job's buildings or simulator; throws UserError. Completes
/// what depends on them.
/// \param names  of each building
/// \param is_whole  all has been read; else the names in studies alone are checked
void check_studies_of(const schema::Section& root,
                      const std::vector<BuildingNames>& names, bool is_whole, Job& job);

}  // namespace bemcal::job
