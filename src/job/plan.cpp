#include "job/plan.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

using study::Case;
using study::Stage;
using Stages = std::vector<std::unique_ptr<Stage>>;

const study::Period& period_of(const Case& building, const std::string& name) {
    for (const study::Period& period : building.periods)
        if (period.name == name) return period;
    return building.periods.at(0);
}

std::unique_ptr<Stage> stage_of(const StudySpec& study, const Case& building) {
    const std::string name = building.name + "/" + study.name;
    if (study.kind == StudyKind::screening)
        return make_screening(name, building, study.screening);
    const study::Period& period = period_of(building, study.period);
    if (study.kind == StudyKind::hourly_sensitivity)
        return make_hourly_sensitivity(name, building, period, study.quantities.at(0),
                                       study.sensitivity);
    return make_sensitivity(name,
                            make_batch_simulator(building, period, study.quantities),
                            study.sensitivity);
}

/// One stage, or one for each case of fixed inputs: "sobol/case_01", ...
void add_office_hours(const StudySpec& study, Stages& stages) {
    const std::size_t n_cases = study.fixed.empty() ? 0 : study.fixed[0].second.size();
    if (n_cases == 0)
        stages.push_back(make_sensitivity(
            study.name, study::make_office_hour_simulator({}), study.sensitivity));
    for (std::size_t c = 0; c < n_cases; ++c) {
        std::vector<std::pair<std::string, double>> fixed;
        for (const auto& [input, values] : study.fixed)
            fixed.emplace_back(input, values[c]);
        stages.push_back(make_sensitivity(
            fmt::format("{}/case_{:02}", study.name, c + 1),
            study::make_office_hour_simulator(std::move(fixed)), study.sensitivity));
    }
}

}  // namespace

Stages make_plan(const Job& job) {
    Stages stages;
    for (const StudySpec& study : job.studies) {
        if (study.kind == StudyKind::office_hour_sensitivity)
            add_office_hours(study, stages);
        else
            for (const Case& building : job.buildings)
                stages.push_back(stage_of(study, building));
    }
    return stages;
}

}  // namespace bemcal::job
