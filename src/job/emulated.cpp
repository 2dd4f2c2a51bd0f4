/// Reads how many runs of a [simulator] a study has, and makes its stage.
/// Follows from study/emulated_study.
/// A loop and a posterior have emulators of hours, and read their runs themselves.
#include "job/emulated.hpp"

#include "job/hourly_outputs.hpp"

#include <fmt/format.h>

namespace bemcal::job {

int read_runs(const StudySource& source) {
    const schema::Section& section = source.section;
    if (!section.has("runs")) return 0;
    if (!source.simulator)
        section.fail("runs", "is of a [simulator], and the job has none");
    const auto runs = static_cast<int>(section.integer("runs"));
    const std::size_t n_parameters = source.simulator->parameters().size();
    const int least = study::least_runs_of_study(n_parameters);
    if (runs < least)
        section.fail_value(
            "runs", fmt::format("is too few for {} parameter{}; expected "
                                "{} or more",
                                n_parameters, n_parameters == 1 ? "" : "s", least));
    return runs;
}

void check_emulated(const StudyPlace& place, int n_runs) {
    if (n_runs > 0) check_nominal(place, "an emulator knows the ranges alone");
}

Stages stages_of_simulator(const StudySpec& spec, const Job& job, int n_runs,
                           const study::StudyOf& study) {
    if (n_runs == 0) return only(study(job.simulator));
    return only(
        study::make_emulated_study(spec.name, job.simulator, n_runs, job.seed, study));
}

}  // namespace bemcal::job
