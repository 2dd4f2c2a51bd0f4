/// [[study]]: read by the rows of their kinds, then checked against the buildings.
#pragma once

#include "input/input_files.hpp"
#include "job/job.hpp"
#include "schema/section.hpp"

#include <vector>

namespace bemcal::job {

/// \param simulator  of the job, or nullptr
/// Where mistakes are kept, the studies without one.
std::vector<StudySpec> read_studies(const schema::Section& root, input::InputFiles& files,
                                    std::uint64_t seed,
                                    const SimulatorPointer& simulator);

/// What the studies need of a job's buildings or simulator; throws UserError. Completes
/// what depends on them. All studies must have been read.
void check_studies_of(const schema::Section& root, Job& job);

}  // namespace bemcal::job
