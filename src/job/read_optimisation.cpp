/// Reads a [[study]] of kind "optimisation": method, objective, budget, meters or
/// targets; checks them against each building.
/// Source: paper 2 for the objective's weights; NSGA-II as paper 3 compares with it.
/// Targets are read by `read_grid`; objectives are in `meter_goal` and `target_goal`.
#include "job/readers.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::job {
namespace {

/// What is minimised of the meters.
void read_objective(const schema::Section& section,
                    calibration::OptimisationOptions& options) {
    options.objective = section.choice_as<calibration::Objective>("objective");
    if (options.objective != calibration::Objective::likelihood) {
        options.cv_weight = section.number("cv_weight");
        options.r2_weight = section.number("r2_weight");
    }
    options.meter_weights = section.numbers("meter_weights");
}

}  // namespace

calibration::OptimisationOptions read_optimisation(const schema::Section& section,
                                                   std::uint64_t seed) {
    calibration::OptimisationOptions options;
    options.method = section.choice_as<calibration::OptimisationMethod>("method");
    options.period = section.text("period");
    options.parameters = section.texts("parameters");
    options.seed = seed;
    const bool is_of_meters = !section.has("target");
    if (is_of_meters) {
        options.meters = section.texts("meters");
        options.resolution =
            section.choice_as<calibration::ObjectiveResolution>("resolution");
    }
    if (options.method == calibration::OptimisationMethod::nsga2) {
        options.errors = section.choice_as<calibration::MeterError>("errors");
        options.n_population = static_cast<int>(section.integer("n_population"));
        options.n_generations = static_cast<int>(section.integer("n_generations"));
        if (options.n_population % 2 != 0)
            section.fail_value("n_population", "expected an even number");
        return options;
    }
    if (is_of_meters) read_objective(section, options);
    options.evaluations = static_cast<std::size_t>(section.integer("evaluations"));
    if (options.method != calibration::OptimisationMethod::pattern)
        options.n_particles = static_cast<int>(section.integer("n_particles"));
    if (options.method == calibration::OptimisationMethod::swarm_then_pattern)
        options.restart = section.flag("restart");
    return options;
}

void check_optimisation(const schema::Section& section,
                        const calibration::OptimisationOptions& options,
                        const std::vector<study::Case>& buildings) {
    if (section.has("target")) {
        for (const study::Case& building : buildings)
            check_parameters(section, {options.period, options.parameters, {}}, building);
        return;
    }
    const Learning learning{options.period, options.parameters, options.meters};
    for (const study::Case& building : buildings) {
        check_parameters(section, learning, building);
        check_meters(section, learning, building);
    }
    if (options.meter_weights.empty()) return;
    if (options.meters.size() != options.meter_weights.size())
        section.fail("meter_weights",
                     fmt::format("has {} numbers, but meters has {} names; expected one "
                                 "for each",
                                 options.meter_weights.size(), options.meters.size()));
    for (const double weight : options.meter_weights)
        if (!(weight >= 0)) section.fail("meter_weights", "expected no negative number");
}

}  // namespace bemcal::job
