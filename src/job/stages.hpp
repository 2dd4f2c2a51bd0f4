/// The stages that a job asks for: what its studies do with its buildings. A stock is not
/// looked at here: it is one stage, made by stock/stage.hpp.
#pragma once

#include "job/job.hpp"
#include "study/stage.hpp"

namespace bemcal::job {

using study::Stages;

/// Those of one study, over all buildings. Throws UserError (config) where the study does
/// not fit a building.
Stages stages_of(const StudySpec& study, const Job& job);

/// Those of all studies, in the order of the file.
Stages make_plan(const Job& job);

/// Throws UserError (config) where the job has no study: it can be read, but there is
/// nothing to plan.
void check_studies(const Job& job);

}  // namespace bemcal::job
