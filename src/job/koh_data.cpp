/// Reads the data of a Kennedy-O'Hagan calibration: measurements and runs. Missing cells
/// and repeated runs are errors.
/// Source: Kennedy and O'Hagan 2001, for what the two files are.
/// Runs that are still to be made are in `koh_runs`.
#include "job/koh_data.hpp"

#include "base/error.hpp"
#include "description/result_names.hpp"
#include "input/csv_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

using emulator::Observations;
using posterior::KohOptions;

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

}  // namespace

const char* key_of_output(const schema::Section& section) {
    return section.has("runs_output") ? "runs_output" : "field_output";
}

void read_runs(const schema::Section& section, input::InputFiles& files,
               const OutputScale& scale, KohOptions& options) {
    const input::Csv& runs =
        files.csv(section.path(section.text("runs")), section.where("runs"));
    const std::string output = section.text(key_of_output(section));
    Observations& o = options.observations;
    check_columns(runs, o, output);
    o.simulated = output_of(runs, output, scale);
    o.simulated_x = full_columns(runs, o.x_names);
    o.simulated_t = full_columns(runs, o.t_names);
    check_repetition(runs, o);
    check_designs(section, o);
    options.calibrated = ranges_of(o);
}

void read_field(const schema::Section& section, input::InputFiles& files,
                const OutputScale& scale, Observations& o) {
    const input::Csv& field =
        files.csv(section.path(section.text("field")), section.where("field"));
    o.x_names = read_names(section, "inputs", {});
    o.t_names = read_names(section, "calibrated", o.x_names);
    for (const std::string& name : o.t_names)
        if (const std::string refusal =
                description::refusal_of_name(description::Named::meter, name);
            !refusal.empty() || name == "chain" || name == "draw")
            section.fail("calibrated", fmt::format("\"{}\": draws cannot be stored under "
                                                   "this name; expected another one",
                                                   name));
    o.measured = output_of(field, section.text("field_output"), scale);
    o.measured_x = full_columns(field, o.x_names);
    if (o.measured.size() < 2)
        section.fail_value("field", "has one row only; expected at least 2 measurements");
}

}  // namespace bemcal::job
