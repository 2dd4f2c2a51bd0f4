/// The kind "kennedy_ohagan": measurements and runs of a simulator, priors, model,
/// chains. Source: Kennedy and O'Hagan 2001; hyperpriors of paper 1, Table 7, or of
/// bc-stan. Data are read by `koh_data`, the posterior is in `koh_posterior`; runs of a
/// command are made in `koh_runs`.
#include "description/read_prior.hpp"
#include "description/result_names.hpp"
#include "description/words.hpp"
#include "input/suggest.hpp"
#include "job/chains.hpp"
#include "job/kind.hpp"
#include "job/koh_data.hpp"
#include "job/office_hour_inputs.hpp"
#include "posterior/koh_posterior.hpp"
#include "posterior/koh_runs.hpp"
#include "posterior/office_hour_runs.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

using posterior::KohOptions;
using schema::Type;

using schema::required;

constexpr schema::SectionInfo sections[] = {
    {"study", "[[study]] kind = \"kennedy_ohagan\"", "",
     "A posterior by an emulator of a simulator's runs, with the simulator's own error; "
     "it needs no building."},
    {"study.prior", "[study.prior]", "",
     "Of calibrated inputs, NAME = {kind = \"normal\", mean = 0.5, sd = 0.2, normalised "
     "= true}; fixed, uniform, normal and beta, the others normalised only.",
     true},
    {"study.fixed", "[study.fixed]", "",
     "With simulator = \"office_hour\": a number for each input that is neither known "
     "nor calibrated.",
     true}};

constexpr schema::Key keys[] = {
    {"study", "field", Type::text, "", required, 0, 0,
     "CSV file of measurements, a row for each, with their known inputs."},
    {"study", "field_output", Type::text, "", required, 0, 0,
     "Column of the measurements."},
    {"study", "inputs", Type::texts, "", required, 0, 0,
     "Columns of the known inputs x, in both files."},
    {"study", "calibrated", Type::texts, "", required, 0, 0,
     "The calibrated inputs t, columns of the runs; uniform over the runs' range where "
     "[study.prior] does not say."},
    {"study", "runs", Type::text, "", "", 0, 0,
     "CSV file of simulator runs: output, inputs, calibrated; cheapest where every "
     "design of the calibrated is run at all field points."},
    {"study", "runs_output", Type::text, "", "", 0, 0,
     "Column of the runs' output; default: field_output."},
    {"study", "output_factor", Type::number, "-", "1", -1e9, 1e9,
     "On both outputs: value x factor + offset."},
    {"study", "output_offset", Type::number, "", "0", -1e9, 1e9, ""},
    {"study", "output_unit", Type::text, "", "kWh", 0, 0, "Of the output, for tables."},
    {"study", "simulator", Type::choice, "office_hour|command", "", 0, 0,
     "In place of runs: designs are simulated at all field points. office_hour: paper "
     "1's hour; inputs, calibrated and [study.fixed] name its 19 inputs. command: the "
     "job's [simulator]; parameters that are neither in inputs nor calibrated stay "
     "nominal, runs_output is one of its outputs."},
    {"study", "n_designs", Type::integer, "", "100", 2, 10000,
     "With a simulator: scrambled Sobol points."},
    {"study", "prior", Type::table, "", "", 0, 0, "[study.prior]"},
    {"study", "fixed", Type::table, "", "", 0, 0, "[study.fixed]"},
    {"study", "hyperpriors", Type::choice, "chong|paper", "chong", 0, 0,
     "chong: correlations Beta(1, 0.3), as bc-stan has them; paper: Beta(1, 0.5) of the "
     "emulator and Beta(1, 0.4) of the discrepancy, paper 1, Table 7. Precisions "
     "Gamma(10, 10), Gamma(10, 0.3), Gamma(10, 0.03) in both."},
    {"study", "regression_factor", Type::flag, "", "false", 0, 0,
     "The emulator is multiplied by an unknown rho ~ N(1, 0.25)."},
    {"study", "mean", Type::choice, "none|constant|linear", "none", 0, 0,
     "Of emulator and discrepancy, with flat priors; linear in x."},
    {"study", "mean_coefficients", Type::choice, "integrated|sampled", "integrated", 0, 0,
     "With a mean: integrated out, or unknowns as all others."},
    {"study", "form", Type::choice, "auto|dense|kronecker", "auto", 0, 0,
     "Of the covariance; auto: kronecker where the runs are a full grid."},
    {"study", "n_predictive", Type::integer, "", "1000", 1, 1000000,
     "Draws that predictions are made of."},
    {"study", "temperatures", Type::numbers, "", "", 1, 1e9,
     "[1, 2, 4, 8] runs each chain at all of these and swaps between them; default: [1, "
     "1.82, 3.33]."},
};

struct KohStudy {
    KohOptions options;
    std::optional<posterior::KohRuns> runs;  ///< to be made by the job's simulator
};

/// Inputs of the office hour that are neither known nor calibrated.
std::vector<std::pair<std::string, double>> read_constants(
    const schema::Section& section) {
    std::vector<std::pair<std::string, double>> values;
    if (!section.has("fixed")) return values;
    const schema::Section table = section.table("fixed", "study.fixed");
    for (const schema::Entry& entry : table.root().entries) {
        const schema::Key row =
            office_hour_row(office_hour_input(table, entry.key), schema::Type::number);
        values.emplace_back(entry.key, schema::checked_number(table.node(entry.key), row,
                                                              table.where(entry.key)));
    }
    return values;
}

void simulate_runs(const schema::Section& section, std::uint64_t seed,
                   KohOptions& options) {
    posterior::OfficeHourDesign design{
        static_cast<std::size_t>(section.integer("n_designs")), seed,
        read_constants(section)};
    description::at_key(section, "simulator", [&] {
        options.calibrated =
            posterior::office_hour_coordinates(options.observations.t_names);
        posterior::add_office_hour_runs(design, options.observations);
    });
}

/// The job's [simulator], which will run the designs when the job does.
posterior::KohRuns runs_to_make(const schema::Section& section, const OutputScale& scale,
                                std::uint64_t seed, const SimulatorPointer& simulator,
                                KohOptions& options) {
    if (!simulator && section.is_lost("simulator")) throw schema::Follows();
    if (!simulator)
        section.fail_value("simulator",
                           "the job has none; expected a section [simulator]");
    const std::string output = section.text(key_of_output(section));
    const std::vector<std::string> names = description::names_of(simulator->outputs());
    description::check_word(section, key_of_output(section), output, names,
                            "output of the simulator");
    posterior::KohRuns runs{
        simulator,
        static_cast<std::size_t>(std::ranges::find(names, output) - names.begin()),
        scale.factor,
        scale.offset,
        static_cast<std::size_t>(section.integer("n_designs")),
        seed};
    description::at_key(section, "calibrated", [&] {
        options.calibrated =
            posterior::simulator_coordinates(*simulator, options.observations.t_names);
    });
    description::at_key(section, "inputs", [&] {
        posterior::simulator_coordinates(*simulator, options.observations.x_names);
    });
    return runs;
}

/// [study.prior]: what is believed of calibrated inputs.
void read_priors(const schema::Section& section, KohOptions& options) {
    if (!section.has("prior")) return;
    const schema::Section table = section.table("prior", "study.prior");
    for (const schema::Entry& entry : table.root().entries) {
        const auto found =
            std::ranges::find(options.calibrated, entry.key, &study::Coordinate::name);
        if (found == options.calibrated.end())
            table.fail(
                entry.key,
                fmt::format("is not calibrated{}",
                            input::suggestion(entry.key, options.observations.t_names)));
        physics::Parameter parameter;
        parameter.name = found->name;
        parameter.least = found->prior.least;
        parameter.most = found->prior.most;
        const schema::Section prior = table.table(entry.key, "prior");
        found->prior = description::read_distribution(prior, parameter);
        description::at_key(prior, "kind",
                            [&] { posterior::on_unit_scale(found->prior); });
    }
}

emulator::ModelOptions read_model(const schema::Section& section) {
    emulator::ModelOptions model;
    model.priors = section.choice("hyperpriors") == "paper" ? emulator::table_7_priors()
                                                            : emulator::bc_stan_priors();
    if (section.flag("regression_factor"))
        model.priors.regression = {stats::PriorKind::normal, 1, 0.25};
    model.emulator_mean = model.discrepancy_mean =
        section.choice_as<emulator::Mean>("mean");
    if (model.emulator_mean != emulator::Mean::none)
        model.coefficients =
            section.choice_as<emulator::Coefficients>("mean_coefficients");
    return model;
}

/// Tempered and careful, so that no chain is trapped in a mode of its own: on bc-stan's
/// example 2 of 124 chains were, and none of 60 at these temperatures.
void read_koh_chains(const schema::Section& section, std::uint64_t seed,
                     posterior::ChainOptions& chains) {
    chains.seed = seed;
    chains.chains_per_item = 1;
    chains.sampler.inverse_temperatures = {1, 0.55, 0.3};
    read_chains(section, chains);
    if (chains.sampler.method == sampling::Method::nuts)
        chains.sampler.target_acceptance = 0.9;
}

void read_data(const StudySource& source, KohStudy& study) {
    const schema::Section& section = source.section;
    KohOptions& options = study.options;
    const OutputScale scale{section.number("output_factor"),
                            section.number("output_offset")};
    options.output_unit = section.text("output_unit");
    read_field(section, source.files, scale, options.observations);
    if (section.has("runs") == section.has("simulator"))
        section.fail("kind",
                     "needs the simulator's runs: expected either runs, a file, "
                     "or simulator = \"office_hour\" or \"command\"");
    if (section.has("runs"))
        read_runs(section, source.files, scale, options);
    else if (section.choice("simulator") == "command")
        study.runs = runs_to_make(section, scale, source.seed, source.simulator, options);
    else
        simulate_runs(section, source.seed, options);
}

void read(const StudySource& source, StudySpec& spec) {
    const schema::Section& section = source.section;
    description::check_name(section, "name", description::Named::building, spec.name);
    KohStudy study;
    KohOptions& options = study.options;
    read_koh_chains(section, source.seed, options.chains);
    read_data(source, study);
    read_priors(section, options);
    options.model = read_model(section);
    options.form = section.choice_as<posterior::KohForm>("form");
    options.n_predictive = static_cast<int>(section.integer("n_predictive"));
    if (!study.runs)
        description::at_key(section, section.has("form") ? "form" : "kind",
                            [&] { posterior::make_koh_posterior(options); });
    spec.options = std::move(study);
}

Stages stages(const StudySpec& spec, const Job& job) {
    auto [options, runs] = spec.as<KohStudy>();
    options.chains.first_chain = job.first_chain;
    return only(runs ? posterior::make_koh_stage_with_runs(spec.name, options, *runs)
                     : posterior::make_koh_stage(spec.name, options));
}

/// Chains alone; runs of a command are not timed, nor the chains after them.
void cost(const StudyStage& stage, Effort& effort) {
    const auto& [options, runs] = stage.study.as<KohStudy>();
    effort.rounds = rounds_of(options.chains);
    effort.seconds = runs ? 0 : posterior::koh_seconds(options);
}

}  // namespace

extern const Kind kennedy_ohagan_kind{.word = "kennedy_ohagan",
                                      .sections = {sections},
                                      .keys = {keys, chain_keys},
                                      .is_of_buildings = false,
                                      .takes_simulator = true,
                                      .has_chains = true,
                                      .read = read,
                                      .stages = stages,
                                      .cost = cost};

}  // namespace bemcal::job
