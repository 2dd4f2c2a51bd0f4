/// What a job of buildings will cost: the stages' own counts times rough costs of a
/// zone-step with AVX2.
/// Follows from the time loops of kernel/ and physics/, as `bench kernel` measures them.
/// A posterior is counted with its whole budget; a stage over several buildings is timed
/// by the first; runs of a command are not timed.
#include "plan/cost.hpp"

#include "job/stages.hpp"
#include "posterior/koh_posterior.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::plan {

namespace {

using study::Case;
using study::Stage;

double hours_of(const study::Period& period) {
    return static_cast<double>((period.to - period.from).count()) / 3600;
}

/// Zone-steps that one simulation of a building takes, on average over the study's
/// periods.
double steps_of(const job::StudySpec& study, const Case& building) {
    double hours = 0;
    if (study.kind == job::StudyKind::screening) {
        for (const study::Period& period : building.periods) hours += hours_of(period);
        hours /= static_cast<double>(building.periods.size());
    } else {
        hours = hours_of(period_of(building, study.period));
    }
    return (hours + building.warm_up_hours) * 3600 / building.step_s *
           static_cast<double>(building.building.zones.size());
}

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

/// Rough numbers of simulations for one transition of a chain: a nuts trajectory has
/// about 2^4 gradients, at three times the cost of a simulation.
double simulations_per_transition(const job::StudySpec& study, const Case& building) {
    switch (study.posterior.chains.sampler.method) {
        case sampling::Method::nuts:
            return 48;
        case sampling::Method::random_walk:
            return 1;
        case sampling::Method::gibbs:
            return static_cast<double>(building.parameters.size());
    }
    return 1;
}

/// Of a posterior, where it uses its whole budget; else what the stage says.
double most_simulations(const job::StudySpec& study, const job::Job& job,
                        const Stage& stage) {
    if (study.kind != job::StudyKind::posterior)
        return static_cast<double>(stage.n_simulations());
    const posterior::ChainOptions& chains = study.posterior.chains;
    const double transitions =
        chains.sampler.n_warm_up +
        static_cast<double>(chains.most_draws) * chains.sampler.thin;
    const std::size_t n_buildings =
        study.posterior.pooling == posterior::Pooling::none ? 1 : job.buildings.size();
    return chains.n_chains * transitions *
           static_cast<double>(chains.sampler.inverse_temperatures.size()) *
           static_cast<double>(n_buildings) *
           simulations_per_transition(study, job.buildings.at(0));
}

/// A posterior keeps the answers of all its rounds; the first one is the warm-up.
double rounds_of(const job::StudySpec& study, const Stage& stage) {
    if (study.kind == job::StudyKind::optimisation)
        return static_cast<double>(stage.n_simulations()) /
               static_cast<double>(study.optimisation.points_per_item) / stage.n_items();
    if (study.kind == job::StudyKind::stages)
        return static_cast<double>(stage.n_simulations()) /
               (stage.n_items() * calibration::points_per_staged_item);
    if (!has_chains(study)) return 1;
    const posterior::ChainOptions& chains = study.kind == job::StudyKind::posterior
                                                ? study.posterior.chains
                                                : study.koh.options.chains;
    return 1 + std::ceil(static_cast<double>(chains.most_draws) / chains.draws_per_round);
}

double seconds_of(const job::StudySpec& study, const Case* building, double n) {
    if (study.kind == job::StudyKind::kennedy_ohagan)
        return study.koh.runs ? 0 : posterior::koh_seconds(study.koh.options);
    if (building == nullptr) return n * office_hour_s;
    const double steps = n * steps_of(study, *building);
    if (has_radiator(*building)) return steps * radiator_step_s;
    if (kernel::runs_plain(building->building)) return steps * plain_step_s;
    return steps *
           (study.kind == job::StudyKind::sensitivity ? sums_step_s : errors_step_s);
}

double series_bytes(const Case& building) {
    std::size_t n = building.weather.theta_e.size() *
                    (4 + building.building.planes.size() + building.profiles.size());
    for (const study::Meter& meter : building.meters) n += meter.values.size();
    return 8.0 * static_cast<double>(n);
}

}  // namespace

bool has_chains(const job::StudySpec& study) {
    return study.kind == job::StudyKind::posterior ||
           study.kind == job::StudyKind::kennedy_ohagan;
}

std::vector<StageCost> stage_costs(const job::Job& job) {
    std::vector<StageCost> costs;
    for (const job::StudySpec& study : job.studies) {
        std::size_t number = 0;
        for (const auto& stage : job::stages_of(study, job)) {
            const Case* building = job::is_of_buildings(study.kind) && !job.simulator
                                       ? &job.buildings.at(number++)
                                       : nullptr;
            const double items = stage->n_items() * rounds_of(study, *stage);
            const double simulations = most_simulations(study, job, *stage);
            costs.push_back({stage->name(), items, simulations,
                             static_cast<double>(stage->answer_bytes()) * items,
                             seconds_of(study, building, simulations)});
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
    }
    for (const Case& building : job.buildings) total.data_bytes += series_bytes(building);
    return total;
}

PlanCost cost_of_buildings(const job::Job& job) {
    job::check_studies(job);
    return total_of(stage_costs(job), job);
}

}  // namespace bemcal::plan
