/// The kind "posterior": a calibration by chains, of each building or of several
/// together; checked for names, parameters and meters.
/// Of a [simulator] it is a calibration of that program, by an emulator of its runs.
/// Source: Vehtari et al. 2021 for the targets of chains (`read_chains`).
/// Priors are in `read_prior`. Whether buildings can be pooled is checked by
/// `make_posterior`.
#include "description/words.hpp"
#include "job/chains.hpp"
#include "job/hourly_outputs.hpp"
#include "job/kind.hpp"
#include "job/learning.hpp"
#include "posterior/building_model.hpp"
#include "posterior/posterior.hpp"
#include "posterior/simulator_posterior.hpp"
#include "study/sampled_shapes.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

using posterior::Pooling;
using posterior::PosteriorOptions;
using schema::Type;
using study::Case;

constexpr schema::SectionInfo sections[] = {
    {"study", "[[study]] kind = \"posterior\"", "",
     "What is believed of the parameters after the readings: chains of draws, with "
     "predictions of every period."}};

constexpr schema::Key keys[] = {
    {"study", "pooling", Type::choice, "none|full|partial", "none", 0, 0,
     "none: each building by itself; full: one value of each parameter for all; partial: "
     "each building has its own, drawn from a common population."},
    {"study", "unseen", Type::texts, "", "", 0, 0,
     "With pooling: buildings that are predicted, but not learned from."},
    {"study", "hold_out_weeks", Type::number, "-", "0", 0, 0.9,
     "Share of the training period's whole weeks kept for judging."},
    {"study", "hold_out_hours", Type::number, "-", "0", 0, 0.9,
     "Share of its other readings, drawn at random, kept for judging."},
    {"study", "n_predictive", Type::integer, "", "200", 1, 1000000,
     "Draws that are simulated for predictions."},
    {"study", "autocorrelated", Type::flag, "", "true", 0, 0,
     "Residuals remember the one before, AR(1); false: white noise."},
    {"study", "proportional", Type::flag, "", "true", 0, 0,
     "Residuals have a part in proportion to the prediction, beside the constant one; "
     "false: where a model wrong in shape would predict too little, as that makes the "
     "residuals' scale small."},
    {"study", "discrepancy", Type::flag, "", "false", 0, 0,
     "A share of the residuals is slow: the model's own error."},
    {"study", "level_change", Type::number, "-", "0", 0, 1,
     "Use and operation change from year to year. In other periods than the training one "
     "energies are predicted times an unknown factor; this is the standard deviation of "
     "its logarithm after a year, growing with the root of time."},
    {"study", "lasting_weeks", Type::number, "weeks", "0", 0, 26,
     "Without discrepancy: predictions of other periods have errors that last for about "
     "so long, beside short ones; their share is what the training period's residuals "
     "show; 0: none."},
    {"study", "reading_weight", Type::number, "-", "1", 1e-6, 1,
     "The likelihood is raised to this power; 0.006, a week of hours for one, where "
     "errors last for long in ways that the residuals do not know."},
    {"study", "runs", Type::integer, "", "80", 20, 100000,
     "Of a [simulator], at most: five eighths are spread over its parameters' ranges, the "
     "others are drawn from the posterior so far, in three rounds. Chains then go on an "
     "emulator of all runs."},
    {"study", "temperatures", Type::numbers, "", "", 1, 1e9,
     "[1, 2, 4, 8] runs each chain at all of these and swaps between them; default: 1 "
     "alone."},
};

void read_residuals(const schema::Section& section, PosteriorOptions& options) {
    options.residuals.autocorrelated = section.flag("autocorrelated");
    options.residuals.proportional = section.flag("proportional");
    options.residuals.discrepancy = section.flag("discrepancy");
    options.level_change = section.number("level_change");
    options.lasting_weeks = section.number("lasting_weeks");
    options.reading_weight = section.number("reading_weight");
}

void read(const StudySource& source, StudySpec& study) {
    const schema::Section& section = source.section;
    PosteriorOptions options;
    read_chains(section, options.chains);
    options.chains.seed = source.seed;
    read_residuals(section, options);
    options.period = study.period = section.text("period");
    options.parameters = section.texts("parameters");
    options.meters = section.texts("meters");
    options.hold_out_weeks = section.number("hold_out_weeks");
    options.hold_out_hours = section.number("hold_out_hours");
    options.n_predictive = static_cast<int>(section.integer("n_predictive"));
    options.pooling = section.choice_as<Pooling>("pooling");
    if (options.pooling != Pooling::none) options.unseen = section.texts("unseen");
    options.simulator_runs = static_cast<int>(section.integer("runs"));
    study.options = std::move(options);
}

/// Names that draws have beside those of the parameters: their dimensions, their density,
/// and the residuals of a building's meters.
std::vector<std::string> taken_names(const PosteriorOptions& options,
                                     const Case& building) {
    std::vector<std::string> names = {"chain", "draw", "log_density", ".", ".."};
    for (const study::Meter& meter : building.meters)
        for (const auto& unknown : posterior::residual_unknowns(meter, options.residuals))
            names.push_back(unknown.name);
    return names;
}

/// Draws are stored under the parameter's name.
void check_parameter_names(const schema::Section& section,
                           const std::vector<physics::Parameter>& parameters,
                           const std::vector<std::string>& taken) {
    for (const physics::Parameter& parameter : parameters)
        if (parameter.name.find('/') != std::string::npos ||
            std::ranges::find(taken, parameter.name) != taken.end())
            section.fail("kind",
                         fmt::format("stores draws by parameter, and cannot for one "
                                     "called \"{}\"; expected another name",
                                     parameter.name));
}

bool is_unseen(const PosteriorOptions& options, const Case& building) {
    return std::ranges::find(options.unseen, building.name) != options.unseen.end();
}

/// Residuals that were learnt from a meter are drawn for the same one of another
/// building.
void check_meters_of_unseen(const schema::Section& section,
                            const PosteriorOptions& options, const Case& unseen,
                            const Case& seen) {
    for (const study::Meter& meter : seen.meters) {
        const bool is_used =
            options.meters.empty() ||
            std::ranges::find(options.meters, meter.name) != options.meters.end();
        if (!is_used || !has_reading(seen, period_of(seen, options.period), meter.name))
            continue;
        if (std::ranges::none_of(unseen.meters, [&](const study::Meter& other) {
                return other.name == meter.name && other.quantity == meter.quantity &&
                       other.interval == meter.interval;
            }))
            section.fail(
                "unseen",
                fmt::format("{0} has no {1} meter \"{2}\" of {3}, and {4}, which is "
                            "learned from, has; expected it in {0} too (it may be "
                            "without readings)",
                            unseen.name, physics::name_of(meter.interval), meter.name,
                            physics::name_of(meter.quantity), seen.name));
    }
}

void check_unseen(const schema::Section& section, const PosteriorOptions& options,
                  const std::vector<Case>& buildings) {
    if (options.unseen.empty()) return;
    for (const std::string& name : options.unseen)
        description::check_word(section, "unseen", name, description::names_of(buildings),
                                "building of this job");
    if (options.unseen.size() >= buildings.size())
        section.fail("unseen", "has every building: none is left to learn from");
    const auto seen = std::ranges::find_if(
        buildings, [&](const Case& building) { return !is_unseen(options, building); });
    for (const Case& building : buildings)
        if (is_unseen(options, building))
            check_meters_of_unseen(section, options, building, *seen);
}

/// Of its parameters, and of the building's meters that it has hours of.
void check_simulator(const StudyPlace& place, const PosteriorOptions& options) {
    const schema::Section& section = place.section;
    check_hourly_outputs(place, options.meters);
    if (options.pooling != Pooling::none)
        section.fail("pooling", "is of several buildings, and a [simulator] is one");
    const auto& parameters = place.job.hourly_simulator->parameters();
    check_parameters(section, options.parameters, parameters, "[[simulator.parameter]]");
    check_parameter_names(section, parameters,
                          taken_names(options, place.job.buildings[0]));
    check_meters(section, {options.period, options.parameters, options.meters},
                 place.job.buildings[0]);
}

/// With the shapes that it samples.
Case with_shapes(const PosteriorOptions& options, const Case& building) {
    std::vector<study::SampledFunction> functions;
    return study::with_sampled_shapes(
        building, study::period_of(building, options.period), functions);
}

/// Shapes of effects that it would sample.
void check_shapes(const StudyPlace& place, const PosteriorOptions& options,
                  const Case& building) {
    if (!study::has_sampled_shapes(building)) return;
    if (options.pooling != Pooling::none)
        place.section.fail_value(
            "pooling",
            fmt::format("{} has an effect with spread or since_within, which is "
                        "of one building alone; expected \"none\"",
                        building.name));
    description::at_key(place.section, "kind",
                        [&] { return with_shapes(options, building); });
}

void check(const StudyPlace& place, StudySpec& study) {
    const auto& options = study.as<PosteriorOptions>();
    if (place.job.simulator) return check_simulator(place, options);
    check_no_runs(place.section);
    check_unseen(place.section, options, place.job.buildings);
    const Learning learning{options.period, options.parameters, options.meters};
    for (const Case& building : place.job.buildings) {
        check_parameters(place.section, learning, building);
        check_parameter_names(place.section, building.parameters,
                              taken_names(options, building));
    }
    for (const Case& building : place.job.buildings)
        if (!is_unseen(options, building))
            check_meters(place.section, learning, building);
    for (const Case& building : place.job.buildings)
        check_shapes(place, options, building);
}

bool is_pooled(const StudySpec& study) {
    return study.as<PosteriorOptions>().pooling != Pooling::none;
}

/// One stage for each building, or one for all.
Stages stages(const StudySpec& study, const Job& job) {
    auto options = study.as<PosteriorOptions>();
    options.chains.first_chain = job.first_chain;
    if (job.hourly_simulator)
        return only(posterior::make_simulator_posterior(
            stage_name(study, job.buildings.at(0)), job.buildings.at(0),
            job.hourly_simulator, options));
    if (is_pooled(study))
        return only(posterior::make_posterior(study.name, job.buildings, options));
    return for_each_building(study, job, [&](std::string name, const Case& building) {
        return posterior::make_posterior(std::move(name), {building}, options);
    });
}

/// Rough numbers of simulations for one transition of a chain: a nuts trajectory has
/// about 2^4 gradients, at three times the cost of a simulation.
double simulations_per_transition(sampling::Method method, std::size_t n_parameters) {
    switch (method) {
        case sampling::Method::nuts:
            return 48;
        case sampling::Method::random_walk:
            return 1;
        case sampling::Method::gibbs:
            return static_cast<double>(n_parameters);
    }
    return 1;
}

/// With its whole budget.
void cost(const StudyStage& stage, Effort& effort) {
    const posterior::ChainOptions& chains = stage.study.as<PosteriorOptions>().chains;
    if (stage.job.simulator) return;  // its runs are what takes time
    const sampling::SamplerOptions& sampler = chains.sampler;
    const double transitions =
        sampler.n_warm_up + static_cast<double>(chains.most_draws) * sampler.thin;
    const std::size_t n_buildings =
        is_pooled(stage.study) ? stage.job.buildings.size() : 1;
    effort.simulations = chains.n_chains * transitions *
                         static_cast<double>(sampler.inverse_temperatures.size()) *
                         static_cast<double>(n_buildings) *
                         simulations_per_transition(
                             sampler.method, stage.job.buildings.at(0).parameters.size());
    effort.rounds = rounds_of(chains);
}

std::string points_of(const StudySpec& study, const Case& building) {
    return is_pooled(study) ? study.name : stage_name(study, building);
}

Case case_of(const StudySpec& study, const Case& building) {
    return with_shapes(study.as<PosteriorOptions>(), building);
}

std::vector<Fitted> fitted(const StudySpec& study, const Case& building) {
    const auto& options = study.as<PosteriorOptions>();
    if (is_unseen(options, building)) return {};
    return {{options.period, options.meters}};
}

}  // namespace

extern const Kind posterior_kind{.word = "posterior",
                                 .sections = {sections},
                                 .keys = {learning_keys, keys, chain_keys},
                                 .takes_twin = true,
                                 .takes_stock = true,
                                 .has_chains = true,
                                 .read = read,
                                 .check = check,
                                 .stages = stages,
                                 .cost = cost,
                                 .points_of = points_of,
                                 .points_around = stage_name,
                                 .case_of = case_of,
                                 .fitted = fitted};

}  // namespace bemcal::job
