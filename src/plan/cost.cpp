/// What a job of buildings will cost: the stages' own counts times rough costs of a
/// zone-step with AVX2.
/// Follows from the time loops of kernel/ and physics/, as `bench kernel` measures them.
/// Kinds of study correct what their stages say (`Kind::cost`); a stage over several
/// buildings is timed by the first; runs of a command are not timed.
#include "plan/cost.hpp"

#include "job/kind.hpp"
#include "job/stages.hpp"

#include <algorithm>

namespace bemcal::plan {

namespace {

using study::Case;

/// Rough costs of a zone-step on one core with AVX2 [s]: sums only, and errors against
/// meters; `bench kernel` measures the real ones.
constexpr double sums_step_s = 1e-9, errors_step_s = 2e-9, plain_step_s = 3e-7,
                 radiator_step_s = 2e-6;
constexpr double office_hour_s = 1e-6;

bool has_radiator(const Case& building) {
    return std::ranges::any_of(building.building.zones, [](const physics::Zone& zone) {
        return zone.radiator.has_value();
    });
}

/// Of a zone-step.
double step_seconds(const Case& building, const job::Effort& effort) {
    if (has_radiator(building)) return radiator_step_s;
    if (kernel::runs_plain(building.building)) return plain_step_s;
    return effort.has_errors ? errors_step_s : sums_step_s;
}

/// Zone-steps that one simulation of a building takes.
double steps_of(const Case& building, double hours) {
    return (hours + building.warm_up_hours) * 3600 / building.step_s *
           static_cast<double>(building.building.zones.size());
}

double seconds_of(const job::StudyStage& stage, const job::Effort& effort) {
    if (effort.seconds) return *effort.seconds;
    if (stage.building == nullptr) return effort.simulations * office_hour_s;
    return effort.simulations * steps_of(*stage.building, effort.hours) *
           step_seconds(*stage.building, effort);
}

job::Effort effort_of(const job::StudyStage& stage) {
    job::Effort effort;
    effort.simulations = static_cast<double>(stage.stage.n_simulations());
    if (stage.building != nullptr)
        effort.hours = study::hours_of(period_of(*stage.building, stage.study.period));
    if (stage.study.kind->cost != nullptr) stage.study.kind->cost(stage, effort);
    return effort;
}

StageCost cost_of(const job::StudyStage& stage) {
    const job::Effort effort = effort_of(stage);
    const double items = stage.stage.n_items() * effort.rounds;
    return {stage.stage.name(),
            items,
            effort.simulations,
            static_cast<double>(stage.stage.answer_bytes()) * items,
            seconds_of(stage, effort),
            effort.working_bytes};
}

double series_bytes(const Case& building) {
    std::size_t n = building.weather.theta_e.size() *
                    (4 + building.building.planes.size() + building.profiles.size());
    for (const study::Meter& meter : building.meters) n += meter.values.size();
    return 8.0 * static_cast<double>(n);
}

}  // namespace

std::vector<StageCost> stage_costs(const job::Job& job) {
    std::vector<StageCost> costs;
    for (const job::StudySpec& study : job.studies) {
        std::size_t number = 0;
        for (const auto& stage : job::stages_of(study, job)) {
            const Case* building = study.kind->is_of_buildings && !job.simulator
                                       ? &job.buildings.at(number++)
                                       : nullptr;
            costs.push_back(cost_of({study, job, *stage, building}));
        }
    }
    return costs;
}

PlanCost total_of(const std::vector<StageCost>& stages, const job::Job& job) {
    PlanCost total;
    for (const StageCost& stage : stages) {
        total.items += stage.items;
        total.simulations += stage.simulations;
        total.answer_bytes += stage.answer_bytes;
        total.core_seconds += stage.core_seconds;
        total.working_bytes = std::max(total.working_bytes, stage.working_bytes);
    }
    for (const Case& building : job.buildings) total.data_bytes += series_bytes(building);
    return total;
}

PlanCost cost_of_buildings(const job::Job& job) {
    job::check_studies(job);
    return total_of(stage_costs(job), job);
}

}  // namespace bemcal::plan
