/// Studies of a [simulator] by few runs of it: their key, and the stage.
#pragma once

#include "job/job.hpp"
#include "job/kind.hpp"
#include "study/emulated_study.hpp"

namespace bemcal::job {

inline constexpr schema::Key emulated_keys[] = {
    {"study", "runs", schema::Type::integer, "", "", 2, 100000,
     "Of a [simulator]: it runs so many times, at Sobol points, and an emulator of its "
     "outputs answers all points of the study. If left out, each point is a run."}};

/// 0 where each point is a run.
int read_runs(const StudySource& source);

/// Of a study that asks at the nominal point, too: throws UserError where the emulator
/// has no runs about it.
void check_emulated(const StudyPlace& place, int n_runs);

/// The study of the job's simulator, or of its emulator.
Stages stages_of_simulator(const StudySpec& spec, const Job& job, int n_runs,
                           const study::StudyOf& study);

}  // namespace bemcal::job
