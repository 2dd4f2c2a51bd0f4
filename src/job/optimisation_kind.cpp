/// The kind "optimisation": method, objective, budget, meters or targets; checked against
/// each building or the [simulator].
/// Source: paper 2 for the objective's weights; NSGA-II as paper 3 compares with it.
/// Targets are read by `read_targets`; objectives are in `meter_goal` and `target_goal`.
#include "job/optimisation_kind.hpp"

#include "job/emulated.hpp"
#include "job/fit_keys.hpp"
#include "job/kind.hpp"
#include "job/learning.hpp"
#include "job/names.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::job {
namespace {

using calibration::OptimisationMethod;
using calibration::OptimisationOptions;
using schema::Type;

constexpr schema::SectionInfo sections[] = {
    {"study", "[[study]] kind = \"optimisation\"", "",
     "The parameters that fit the meters best, or come nearest to given targets."}};

constexpr schema::Key keys[] = {
    {"study", "target", Type::tables, "", "", 0, 0,
     "[[study.target]], in place of the meters: f is then the distance to them [%], and "
     "nsga2 has the error of each."},
    {"study", "method", Type::choice, "swarm_then_pattern|swarm|pattern|nsga2",
     "swarm_then_pattern", 0, 0,
     "Particle swarm with constriction on a mesh, then Hooke-Jeeves pattern search; one "
     "of them alone; or NSGA-II, with the error of each meter as an objective."},
    {"study", "errors", Type::choice, "absolute|signed|cv_rmse", "absolute", 0, 0,
     "Of nsga2: of each meter's total over the period; signed: minimised among points "
     "that are not below the measured total; cv_rmse: of its readings."},
    {"study", "n_population", Type::integer, "", "100", 4, 100000, "Of nsga2; even."},
    {"study", "n_generations", Type::integer, "", "50", 1, 1000000,
     "Of nsga2, in place of evaluations."},
};

/// What is minimised of the meters.
void read_objective(const schema::Section& section, OptimisationOptions& options) {
    options.objective = section.choice_as<calibration::Objective>("objective");
    if (options.objective == calibration::Objective::percent ||
        options.objective == calibration::Objective::fraction) {
        options.cv_weight = section.number("cv_weight");
        options.r2_weight = section.number("r2_weight");
    }
    options.meter_weights = section.numbers("meter_weights");
}

void read_nsga2(const schema::Section& section, OptimisationOptions& options) {
    options.errors = section.choice_as<calibration::MeterError>("errors");
    options.n_population = static_cast<int>(section.integer("n_population"));
    options.n_generations = static_cast<int>(section.integer("n_generations"));
    if (options.n_population % 2 != 0)
        section.fail_value("n_population", "expected an even number");
}

void read_budget(const schema::Section& section, OptimisationOptions& options) {
    options.evaluations = static_cast<std::size_t>(section.integer("evaluations"));
    if (options.method != OptimisationMethod::pattern)
        options.n_particles = static_cast<int>(section.integer("n_particles"));
    if (options.method == OptimisationMethod::swarm_then_pattern)
        options.restart = section.flag("restart");
}

OptimisationOptions read_options(const schema::Section& section) {
    OptimisationOptions options;
    options.method = section.choice_as<OptimisationMethod>("method");
    options.period = section.text("period");
    options.parameters = section.texts("parameters");
    const bool is_of_meters = !section.has("target");
    if (is_of_meters) {
        options.meters = section.texts("meters");
        options.resolution =
            section.choice_as<calibration::ObjectiveResolution>("resolution");
    }
    if (options.method == OptimisationMethod::nsga2) {
        read_nsga2(section, options);
        return options;
    }
    if (is_of_meters) read_objective(section, options);
    read_budget(section, options);
    return options;
}

void read(const StudySource& source, StudySpec& study) {
    OptimisationStudy made{read_options(source.section), read_targets(source.section),
                           read_runs(source)};
    made.options.seed = source.seed;
    study.period = made.options.period;
    study.options = std::move(made);
}

void check_names(const NamePlace& place) {
    check_target_meters(place.section, place.names);
}

void check(const StudyPlace& place, StudySpec& study) {
    const auto& [options, targets, n_runs] = study.as<OptimisationStudy>();
    const schema::Section& section = place.section;
    if (place.job.simulator) {
        check_parameters(section, options.parameters, place.job.simulator->parameters(),
                         "parameter of the simulator");
        check_targets(section, targets, *place.job.simulator);
        check_emulated(place, n_runs);
        return;
    }
    const bool is_of_meters = targets.empty();
    const Learning learning{options.period, options.parameters, options.meters};
    for (const study::Case& building : place.job.buildings) {
        check_parameters(section, learning, building);
        if (is_of_meters) check_meters(section, learning, building);
    }
    if (is_of_meters)
        check_weights(section, options);
    else
        check_targets(section, targets, study.period, place.job.buildings);
}

/// What an optimisation against targets aims at, of a building.
calibration::TargetAim aim_of(const TargetSpecs& targets, const study::Case& building,
                              const study::Period& period) {
    calibration::TargetAim aim{target_simulator(targets, building, period),
                               targets_of(targets, building, period),
                               {}};
    aim.values.reserve(building.priors.size());
    for (const study::ParameterPrior& prior : building.priors)
        aim.values.push_back(prior.values);
    return aim;
}

Stages stages(const StudySpec& study, const Job& job) {
    const auto& [as_read, targets, n_runs] = study.as<OptimisationStudy>();
    auto options = as_read;
    options.hourly_outputs = job.hourly_outputs;
    if (job.simulator)
        return stages_of_simulator(study, job, n_runs, [&, options](auto simulator) {
            auto aimed = targets_of(targets, *simulator);
            return calibration::make_optimisation(
                study.name, {std::move(simulator), std::move(aimed), {}}, options);
        });
    return for_each_building(study, job, [&](std::string name, const auto& building) {
        return targets.empty()
                   ? calibration::make_optimisation(std::move(name), building, options)
                   : calibration::make_optimisation(
                         std::move(name),
                         aim_of(targets, building, period_of(building, study.period)),
                         options);
    });
}

void cost(const StudyStage& stage, Effort& effort) {
    const auto points = stage.study.as<OptimisationStudy>().options.points_per_item;
    effort.rounds =
        effort.simulations / static_cast<double>(points) / stage.stage.n_items();
}

std::vector<Fitted> fitted(const StudySpec& study, const study::Case& building) {
    const auto& [options, targets, n_runs] = study.as<OptimisationStudy>();
    if (targets.empty()) return {{options.period, options.meters}};
    return fitted_by(targets, study.period, building);
}

}  // namespace

extern const Kind optimisation_kind{
    .word = "optimisation",
    .sections = {sections, target_sections},
    .keys = {learning_keys, keys, fit_keys, target_keys, emulated_keys},
    .takes_simulator = true,
    .read = read,
    .check_names = check_names,
    .check = check,
    .stages = stages,
    .cost = cost,
    .fitted = fitted};

}  // namespace bemcal::job
