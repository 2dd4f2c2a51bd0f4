/// Tables of the program in a loop or a posterior: parameters at the runs that count,
/// runs by what they are of, effects as they were given.
/// Made from stored datasets alone.
#include "report/simulator_tables.hpp"

#include "report/loop_parts.hpp"
#include "report/text_table.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::report {
namespace {

using loop::StoredSimulator;

std::string parameters_of_program(const StoredSimulator& simulator) {
    TextTable table(
        {"parameter of the program", "unit", "range", "plain", "before", "after"});
    for (const StoredSimulator::Parameter& parameter : simulator.parameters)
        table.add({parameter.name, parameter.unit,
                   fmt::format("{} to {}", three_digits(parameter.least),
                               three_digits(parameter.most)),
                   three_digits(parameter.plain), three_digits(parameter.before),
                   three_digits(parameter.after)});
    return text_of(table, 30);
}

/// " (62 annual runs)"; nothing where years are not stored.
std::string annual_runs(const StoredSimulator& simulator) {
    double years = 0;
    for (const StoredSimulator::Run& run : simulator.runs) years += run.years;
    return std::isnan(years) ? "" : fmt::format(" ({:.0f} annual runs)", years);
}

/// "62 runs: 45 design, 12 calibration, 5 effects; 1 failed"
std::string run_line(const StoredSimulator& simulator) {
    std::vector<std::string> kinds;
    long n_failed = 0;
    for (const StoredSimulator::Run& run : simulator.runs) {
        if (std::ranges::find(kinds, run.of) == kinds.end()) kinds.push_back(run.of);
        if (!run.failure.empty()) ++n_failed;
    }
    std::vector<std::string> parts;
    parts.reserve(kinds.size());
    for (const std::string& kind : kinds)
        parts.push_back(fmt::format(
            "{} {}", std::ranges::count(simulator.runs, kind, &StoredSimulator::Run::of),
            kind));
    std::string line = fmt::format("{} runs of the program{}: {}", simulator.runs.size(),
                                   annual_runs(simulator), fmt::join(parts, ", "));
    if (n_failed > 0) line += fmt::format("; {} failed", n_failed);
    return wrapped(line);
}

std::string emulator_line(const StoredSimulator& simulator) {
    std::vector<std::string> parts;
    parts.reserve(simulator.channels.size());
    for (const StoredSimulator::Channel& channel : simulator.channels)
        parts.push_back(
            fmt::format("{} {} %", channel.name, three_digits(channel.emulator_error)));
    if (parts.empty()) return "";
    return wrapped(
        fmt::format("runs that the emulator had not seen are foretold within "
                    "(CV(RMSE)): {}",
                    fmt::join(parts, ", ")));
}

/// What the program says at the best point, beside the emulator that found it.
std::string best_run_line(const Group& study) {
    const Texts names = study.texts("best_run_output"),
                units = study.texts("best_run_unit");
    const Numbers values = study.values("best_run_value"),
                  foretold = study.values("best_run_foretold");
    std::vector<std::string> parts;
    parts.reserve(names.size());
    for (std::size_t k = 0; k < names.size(); ++k)
        parts.push_back(fmt::format("{} {} {}, foretold {}", names[k],
                                    in_short(values[k]), units[k],
                                    in_short(foretold[k])));
    if (parts.empty()) return "";
    return wrapped(
        fmt::format("the program at the best point: {}", fmt::join(parts, "; ")));
}

}  // namespace

std::string simulator_tables(const StoredSimulator& simulator) {
    if (simulator.parameters.empty()) return "";
    return parameters_of_program(simulator) + simulator_run_lines(simulator);
}

std::string simulator_run_lines(const StoredSimulator& simulator) {
    if (simulator.runs.empty()) return "";
    return run_line(simulator) + emulator_line(simulator);
}

std::string simulator_run_lines(const Group& study) {
    return simulator_run_lines(
               loop::stored_simulator(study.result().datasets, study.path())) +
           best_run_line(study);
}

std::string simulator_given_table(const StoredSimulator& simulator) {
    TextTable table({"given to the program", "changes", "times what was found"});
    for (const StoredSimulator::Given& given : simulator.given)
        table.add({given.name, given.hooks.empty() ? "nothing it knows" : given.hooks,
                   three_digits(given.scale)});
    std::string text = text_of(table, 40);
    for (const StoredSimulator::LeftOut& left_out : simulator.left_out)
        text += wrapped("it could not take: " + left_out.why);
    return text.empty() ? text : "\n" + text;
}

}  // namespace bemcal::report
