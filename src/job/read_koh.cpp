/// Reads a [[study]] of kind "kennedy_ohagan" and its data: measurements, runs of a
/// simulator, priors, model, chains. Missing cells and repeated runs are errors.
/// Source: Kennedy and O'Hagan 2001; hyperpriors of paper 1, Table 7, or of bc-stan.
/// The posterior is in `koh_posterior`; runs of a command are made in `koh_runs`.
#include "base/error.hpp"
#include "input/suggest.hpp"
#include "job/readers.hpp"
#include "job/result_names.hpp"
#include "physics/office_hour.hpp"
#include "posterior/koh_posterior.hpp"
#include "posterior/koh_runs.hpp"
#include "posterior/office_hour_runs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

using emulator::Observations;
using posterior::KohOptions;

/// From the files' output to the reported unit.
struct OutputScale {
    double factor = 1, offset = 0;
};

[[noreturn]] void fail_row(const input::Csv& csv, std::size_t row,
                           const std::string& message) {
    throw UserError(ExitCode::data,
                    fmt::format("{}:{}: {}", csv.file, csv.lines[row], message));
}

/// A column of numbers, none missing.
std::vector<double> full_column(const input::Csv& csv, const std::string& name) {
    const std::size_t column = csv.column(name);
    std::vector<double> values = input::numbers_in(csv, column);
    for (std::size_t row = 0; row < values.size(); ++row)
        if (std::isnan(values[row]))
            fail_row(csv, row,
                     fmt::format("{} is missing; expected a number, or leave the row out",
                                 name));
    return values;
}

Matrix full_columns(const input::Csv& csv, const std::vector<std::string>& names) {
    Matrix made(csv.n_rows(), names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
        const std::vector<double> column = full_column(csv, names[k]);
        for (std::size_t row = 0; row < made.rows; ++row) made(row, k) = column[row];
    }
    return made;
}

std::vector<double> output_of(const input::Csv& csv, const std::string& name,
                              const OutputScale& scale) {
    std::vector<double> values = full_column(csv, name);
    for (double& value : values) value = scale.factor * value + scale.offset;
    return values;
}

/// A column that the job does not know may be an input that the runs differ in.
void check_columns(const input::Csv& runs, const Observations& o,
                   const std::string& output) {
    for (const std::string& column : runs.columns)
        if (column != output && std::ranges::count(o.x_names, column) == 0 &&
            std::ranges::count(o.t_names, column) == 0)
            throw UserError(
                ExitCode::data,
                fmt::format("{}:1: the column \"{}\" is neither the output {} nor one of "
                            "the study's inputs or calibrated; expected it in one of "
                            "them, or another file without it",
                            runs.file, column, output));
}

/// A simulator has one answer to a question.
void check_repetition(const input::Csv& runs, const Observations& o) {
    std::map<std::vector<double>, std::size_t> first;
    for (std::size_t row = 0; row < o.simulated.size(); ++row) {
        const auto t = o.simulated_t.row(row), x = o.simulated_x.row(row);
        std::vector<double> point(t.begin(), t.end());
        point.insert(point.end(), x.begin(), x.end());
        const auto [found, is_new] = first.emplace(std::move(point), row);
        if (is_new) continue;
        const std::size_t other = found->second;
        fail_row(runs, row,
                 fmt::format("is at the same inputs as line {}, with {}; expected each "
                             "point once: leave one out",
                             runs.lines[other],
                             o.simulated[row] == o.simulated[other]
                                 ? "the same output"
                                 : fmt::format("another output ({} there, {} here)",
                                               o.simulated[other], o.simulated[row])));
    }
}

void check_designs(const schema::Section& section, const Observations& o) {
    std::set<std::vector<double>> designs;
    for (std::size_t row = 0; row < o.simulated_t.rows; ++row) {
        const auto t = o.simulated_t.row(row);
        designs.emplace(t.begin(), t.end());
    }
    if (designs.size() < 2)
        section.fail_value("runs",
                           "has one design of the calibrated inputs only; "
                           "expected at least 2");
}

/// Each calibrated input uniform over the runs' range.
std::vector<study::Coordinate> ranges_of(const Observations& o) {
    std::vector<study::Coordinate> made;
    made.reserve(o.t_names.size());
    for (std::size_t k = 0; k < o.t_names.size(); ++k) {
        stats::Prior prior;
        prior.least = prior.most = o.simulated_t(0, k);
        for (std::size_t row = 1; row < o.simulated_t.rows; ++row) {
            prior.least = std::min(prior.least, o.simulated_t(row, k));
            prior.most = std::max(prior.most, o.simulated_t(row, k));
        }
        made.push_back({o.t_names[k], "of the runs", prior});
    }
    return made;
}

void read_runs(const schema::Section& section, input::InputFiles& files,
               const OutputScale& scale, KohOptions& options) {
    const input::Csv& runs =
        files.csv(section.path(section.text("runs")), section.where("runs"));
    const std::string output =
        section.text(section.has("runs_output") ? "runs_output" : "field_output");
    Observations& o = options.observations;
    check_columns(runs, o, output);
    o.simulated = output_of(runs, output, scale);
    o.simulated_x = full_columns(runs, o.x_names);
    o.simulated_t = full_columns(runs, o.t_names);
    check_repetition(runs, o);
    check_designs(section, o);
    options.calibrated = ranges_of(o);
}

/// Inputs of the office hour that are neither known nor calibrated.
std::vector<std::pair<std::string, double>> read_constants(
    const schema::Section& section) {
    std::vector<std::pair<std::string, double>> values;
    if (!section.has("fixed")) return values;
    const schema::Section table = section.table("fixed", "study.fixed");
    for (const schema::Entry& entry : table.root().entries) {
        const physics::OfficeHourInput& input = office_hour_input(table, entry.key);
        const schema::Key row{"study.fixed", input.name,    schema::Type::number,
                              input.unit,    nullptr,       -1e9,
                              1e9,           input.sentence};
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
    at_key(section, "simulator", [&] {
        options.calibrated =
            posterior::office_hour_coordinates(options.observations.t_names);
        posterior::add_office_hour_runs(design, options.observations);
    });
}

/// The job's [simulator], which will run the designs when the job does.
posterior::KohRuns runs_to_make(const schema::Section& section, const OutputScale& scale,
                                std::uint64_t seed, const SimulatorPointer& simulator,
                                KohOptions& options) {
    if (!simulator)
        section.fail_value("simulator",
                           "the job has none; expected a section [simulator]");
    const std::string output =
        section.text(section.has("runs_output") ? "runs_output" : "field_output");
    std::vector<std::string> names;
    for (const study::Output& each : simulator->outputs()) names.push_back(each.name);
    check_word(section, section.has("runs_output") ? "runs_output" : "field_output",
               output, names, "output of the simulator");
    posterior::KohRuns runs{
        simulator,
        static_cast<std::size_t>(std::ranges::find(names, output) - names.begin()),
        scale.factor,
        scale.offset,
        static_cast<std::size_t>(section.integer("n_designs")),
        seed};
    at_key(section, "calibrated", [&] {
        options.calibrated =
            posterior::simulator_coordinates(*simulator, options.observations.t_names);
    });
    at_key(section, "inputs", [&] {
        posterior::simulator_coordinates(*simulator, options.observations.x_names);
    });
    return runs;
}

/// Names that are needed, each once.
std::vector<std::string> read_names(const schema::Section& section, std::string_view key,
                                    const std::vector<std::string>& taken) {
    std::vector<std::string> names = section.texts(key);
    if (names.empty()) section.fail(key, "is empty; expected the names of columns");
    for (auto name = names.begin(); name != names.end(); ++name)
        if (std::ranges::count(taken, *name) > 0 ||
            std::find(names.begin(), name, *name) != name)
            section.fail(key, fmt::format("\"{}\" stands in inputs and calibrated, or "
                                          "twice; expected it once",
                                          *name));
    return names;
}

void read_field(const schema::Section& section, input::InputFiles& files,
                const OutputScale& scale, Observations& o) {
    const input::Csv& field =
        files.csv(section.path(section.text("field")), section.where("field"));
    o.x_names = read_names(section, "inputs", {});
    o.t_names = read_names(section, "calibrated", o.x_names);
    for (const std::string& name : o.t_names)
        if (const std::string refusal = refusal_of_name(Named::meter, name);
            !refusal.empty() || name == "chain" || name == "draw")
            section.fail("calibrated", fmt::format("\"{}\": draws cannot be stored under "
                                                   "this name; expected another one",
                                                   name));
    o.measured = output_of(field, section.text("field_output"), scale);
    o.measured_x = full_columns(field, o.x_names);
    if (o.measured.size() < 2)
        section.fail_value("field", "has one row only; expected at least 2 measurements");
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
        found->prior = read_distribution(prior, parameter);
        at_key(prior, "kind", [&] { posterior::on_unit_scale(found->prior); });
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

}  // namespace

KohStudy read_koh(const schema::Section& section, input::InputFiles& files,
                  std::uint64_t seed, const SimulatorPointer& simulator) {
    KohStudy study;
    KohOptions& options = study.options;
    read_koh_chains(section, seed, options.chains);
    const OutputScale scale{section.number("output_factor"),
                            section.number("output_offset")};
    options.output_unit = section.text("output_unit");
    read_field(section, files, scale, options.observations);
    if (section.has("runs") == section.has("simulator"))
        section.fail("kind",
                     "needs the simulator's runs: expected either runs, a file, "
                     "or simulator = \"office_hour\" or \"command\"");
    if (section.has("runs")) {
        read_runs(section, files, scale, options);
    } else if (section.choice("simulator") == "command") {
        study.runs = runs_to_make(section, scale, seed, simulator, options);
    } else {
        simulate_runs(section, seed, options);
    }
    read_priors(section, options);
    options.model = read_model(section);
    options.form = section.choice_as<posterior::KohForm>("form");
    section.number_if("n_predictive", options.n_predictive);
    if (!study.runs)
        at_key(section, section.has("form") ? "form" : "kind",
               [&] { posterior::make_koh_posterior(options); });
    return study;
}

}  // namespace bemcal::job
