/// Makes the stages that a job's studies ask for, by the rows of their kinds; a mistake
/// that only shows here becomes one of the job file.
/// Follows from the table of kinds, in the order of the file.
/// A stock is one stage of its own (`make_stock_stage`). What stages cost is in
/// `stage_costs`.
#include "job/stages.hpp"

#include "base/error.hpp"
#include "job/kind.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::job {

Stages stages_of(const StudySpec& study, const Job& job) {
    try {
        return study.kind->stages(study, job);
    } catch (const std::invalid_argument& error) {
        throw UserError(ExitCode::config,
                        fmt::format("{}: the study {}: {}", job.file.string(), study.name,
                                    error.what()));
    }
}

void check_studies(const Job& job) {
    if (job.studies.empty())
        throw UserError(
            ExitCode::config,
            fmt::format("{}:1: study: is missing; expected sections [[study]] "
                        "with a kind, like \"screening\"",
                        job.file.string()));
}

Stages make_plan(const Job& job) {
    check_studies(job);
    Stages stages;
    for (const StudySpec& study : job.studies)
        std::ranges::move(stages_of(study, job), std::back_inserter(stages));
    return stages;
}

}  // namespace bemcal::job
