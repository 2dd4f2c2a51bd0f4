/// Makes the stages that a job's studies ask for: one for each building, or one for all
/// of them; a mistake that only shows here becomes one of the job file.
/// Follows from the studies' kinds, in the order of the file.
/// A stock is one stage of its own (`make_stock_stage`). What stages cost is in
/// `plan_cost`.
#include "job/stages.hpp"

#include "base/error.hpp"
#include "calibration/target_simulator.hpp"
#include "job/readers.hpp"
#include "loop/loop.hpp"
#include "posterior/koh_posterior.hpp"
#include "sensitivity/simulators.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

using study::Case;
using study::Stage;

std::unique_ptr<Stage> stage_of(const StudySpec& study, const Case& building) {
    const std::string name = building.name + "/" + study.name;
    if (study.kind == StudyKind::screening)
        return calibration::make_screening(name, building, study.screening);
    const study::Period& period = period_of(building, study.period);
    if (study.kind == StudyKind::grid)
        return calibration::make_grid(
            name,
            calibration::make_target_simulator(building, period, outputs_of(study.grid)),
            options_for(study.grid, building, period));
    if (study.kind == StudyKind::hourly_sensitivity)
        return sensitivity::make_hourly_sensitivity(
            name, building, period, study.quantities.at(0), study.sensitivity);
    return sensitivity::make_sensitivity(
        name, sensitivity::make_batch_simulator(building, period, study.quantities),
        study.sensitivity);
}

/// One stage, or one for each case of fixed inputs: "sobol/case_01", ...
Stages office_hour_stages(const StudySpec& study) {
    using Fixed = std::vector<std::pair<std::string, double>>;
    Stages stages;
    const auto add = [&](const std::string& name, const Fixed& fixed) {
        stages.push_back(sensitivity::make_sensitivity(
            name, sensitivity::make_office_hour_simulator(fixed), study.sensitivity));
    };
    if (study.fixed.empty()) add(study.name, {});
    const std::size_t n_cases = study.fixed.empty() ? 0 : study.fixed[0].second.size();
    for (std::size_t c = 0; c < n_cases; ++c) {
        Fixed fixed;
        for (const auto& [input, values] : study.fixed)
            fixed.emplace_back(input, values[c]);
        add(fmt::format("{}/case_{:02}", study.name, c + 1), fixed);
    }
    return stages;
}

/// One stage for each building, or one for all.
Stages posterior_stages(const StudySpec& study, const Job& job) {
    Stages stages;
    if (study.posterior.pooling != posterior::Pooling::none) {
        stages.push_back(
            posterior::make_posterior(study.name, job.buildings, study.posterior));
        return stages;
    }
    for (const Case& building : job.buildings)
        stages.push_back(posterior::make_posterior(building.name + "/" + study.name,
                                                   {building}, study.posterior));
    return stages;
}

/// One stage, an item for each building.
Stages loop_stages(const StudySpec& study, const Job& job) {
    Stages stages;
    stages.push_back(loop::make_loop(study.name, job.buildings, study.loop));
    return stages;
}

/// What an optimisation against targets aims at, of a building.
calibration::TargetAim aim_of(const StudySpec& study, const Case& building) {
    const study::Period& period = period_of(building, study.period);
    calibration::TargetAim aim{
        calibration::make_target_simulator(building, period, outputs_of(study.grid)),
        options_for(study.grid, building, period).targets,
        {}};
    aim.values.reserve(building.priors.size());
    for (const study::ParameterPrior& prior : building.priors)
        aim.values.push_back(prior.values);
    return aim;
}

Stages optimisation_stages(const StudySpec& study, const Job& job) {
    Stages stages;
    if (job.simulator) {
        const auto targets = options_for(study.grid, *job.simulator).targets;
        stages.push_back(calibration::make_optimisation(
            study.name, {job.simulator, targets, {}}, study.optimisation));
        return stages;
    }
    for (const Case& building : job.buildings) {
        const std::string name = building.name + "/" + study.name;
        stages.push_back(
            study.grid.targets.empty()
                ? calibration::make_optimisation(name, building, study.optimisation)
                : calibration::make_optimisation(name, aim_of(study, building),
                                                 study.optimisation));
    }
    return stages;
}

Stages staged_stages(const StudySpec& study, const Job& job) {
    Stages stages;
    for (const Case& building : job.buildings)
        stages.push_back(calibration::make_staged(building.name + "/" + study.name,
                                                  building, study.staged));
    return stages;
}

Stages retrofit_stages(const StudySpec& study, const Job& job) {
    Stages stages;
    for (std::size_t b = 0; b < job.buildings.size(); ++b) {
        const Case& building = job.buildings[b];
        stages.push_back(retrofit::make_retrofit(
            building.name + "/" + study.name, building, period_of(building, study.period),
            study.retrofits[b]));
    }
    return stages;
}

/// What only shows when a stage is put together is a mistake in the job.
template <class Make>
Stages checked_stages(Make make, const StudySpec& study, const Job& job) {
    try {
        return make(study, job);
    } catch (const std::invalid_argument& error) {
        throw UserError(ExitCode::config,
                        fmt::format("{}: the study {}: {}", job.file.string(), study.name,
                                    error.what()));
    }
}

}  // namespace

Stages stages_of(const StudySpec& study, const Job& job) {
    if (study.kind == StudyKind::office_hour_sensitivity)
        return office_hour_stages(study);
    if (study.kind == StudyKind::posterior)
        return checked_stages(posterior_stages, study, job);
    if (study.kind == StudyKind::loop) return checked_stages(loop_stages, study, job);
    if (study.kind == StudyKind::optimisation)
        return checked_stages(optimisation_stages, study, job);
    if (study.kind == StudyKind::stages) return checked_stages(staged_stages, study, job);
    Stages stages;
    if (job.simulator && study.kind == StudyKind::sensitivity) {
        stages.push_back(
            sensitivity::make_sensitivity(study.name, job.simulator, study.sensitivity));
        return stages;
    }
    if (job.simulator && study.kind == StudyKind::grid) {
        stages.push_back(calibration::make_grid(study.name, job.simulator,
                                                options_for(study.grid, *job.simulator)));
        return stages;
    }
    if (study.kind == StudyKind::kennedy_ohagan) {
        const KohStudy& koh = study.koh;
        stages.push_back(koh.runs ? posterior::make_koh_stage_with_runs(
                                        study.name, koh.options, *koh.runs)
                                  : posterior::make_koh_stage(study.name, koh.options));
        return stages;
    }
    if (study.kind == StudyKind::retrofit) return retrofit_stages(study, job);
    for (const Case& building : job.buildings)
        stages.push_back(stage_of(study, building));
    return stages;
}

/// A job without studies can be read, but there is nothing to plan.
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
        for (auto& stage : stages_of(study, job)) stages.push_back(std::move(stage));
    return stages;
}

}  // namespace bemcal::job
