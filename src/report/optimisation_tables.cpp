/// What an optimisation found: the objective at first and at the end, the front, errors
/// of targets or meters, and parameters that ended at an end of their range.
/// Made from stored datasets alone; metrics of meters are computed again
/// (screening_tables). Ten rows of a front are shown at most.
#include "report/sections.hpp"
#include "report/simulator_tables.hpp"
#include "report/text_table.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::report {
namespace {

std::string objective_lines(const Group& study) {
    const auto& best = study.values("round_best");
    if (best.empty()) return {};
    return fmt::format("  f: {} at first, {} at the end\n", in_short(best.front()),
                       in_short(best.back()));
}

/// A front's rows by its first objective, ten of them at most.
std::string front_table(const Group& study) {
    const auto &names = study.texts("objective"), &units = study.texts("objective_unit");
    const auto& values = study.values("front_objective");
    const std::size_t n = names.size(), n_rows = n == 0 ? 0 : values.size() / n;
    if (n < 2) return {};
    std::vector<std::string> header;
    header.reserve(n);
    for (std::size_t k = 0; k < n; ++k)
        header.push_back(fmt::format("{} [{}]", names[k], units[k]));
    std::vector<std::size_t> rows(n_rows);
    for (std::size_t r = 0; r < n_rows; ++r) rows[r] = r;
    std::ranges::stable_sort(rows, {}, [&](std::size_t r) { return values[r * n]; });
    TextTable table(header);
    const std::size_t n_shown = std::min<std::size_t>(n_rows, 10);
    for (std::size_t k = 0; k < n_shown; ++k) {
        const std::size_t r = n_shown < 2 ? 0 : rows[k * (n_rows - 1) / (n_shown - 1)];
        std::vector<std::string> cells;
        cells.reserve(n);
        for (std::size_t j = 0; j < n; ++j) cells.push_back(in_short(values[r * n + j]));
        table.add(std::move(cells));
    }
    return fmt::format("  front of {} points; best is the one of smallest error\n",
                       n_rows) +
           table.text(24);
}

/// What targets were aimed at, the errors of the best point, and what it is.
std::string target_tables(const Group& study) {
    const auto &targets = study.texts("target"), &units = study.texts("target_unit");
    if (targets.empty()) return {};
    const auto &measured = study.values("target_measured"),
               &errors = study.values("nearest_target_error");
    std::vector<std::string> head{"target", "measured", "unit"};
    if (!errors.empty()) head.emplace_back("error of best %");
    TextTable aims(head);
    for (std::size_t t = 0; t < targets.size(); ++t) {
        std::vector<std::string> cells{targets[t], in_short(measured[t]), units[t]};
        if (!errors.empty()) cells.push_back(fmt::format("{:+.4f}", errors[t]));
        aims.add(std::move(cells));
    }
    const auto &names = study.texts("parameter"), &own = study.texts("parameter_unit");
    TextTable best({"parameter", "best", "unit"});
    for (std::size_t p = 0; p < names.size(); ++p)
        best.add({names[p], in_short(study.values("nearest_parameters")[p]), own[p]});
    return aims.text() + best.text();
}

/// Parameters that ended at the end of their range: it may be too narrow.
std::string bound_lines(const Group& study) {
    const auto& names = study.texts("parameter");
    const auto& ends = study.values("at_bound");
    std::string text;
    for (std::size_t p = 0; p < std::min(names.size(), ends.size()); ++p)
        if (ends[p] != 0)
            text += fmt::format("  {} ended at the {} end of its range\n", names[p],
                                ends[p] < 0 ? "lower" : "upper");
    return text;
}

}  // namespace

std::string optimisation_section(const Group& study) {
    if (study.values("at_bound").empty())
        return fmt::format("\n{}: none of {:.0f} evaluations could be simulated\n",
                           study.path(), study.value("n_points")) +
               failure_lines(study);
    const bool has_targets = !study.texts("target").empty();
    return fmt::format("\n{}: {}best of {:.0f} evaluations\n", study.path(),
                       has_targets ? "" : "nominal -> ", study.value("n_points")) +
           objective_lines(study) + front_table(study) +
           (has_targets ? target_tables(study) : candidate_tables(study)) +
           bound_lines(study) + simulator_run_lines(study) + failure_lines(study);
}

}  // namespace bemcal::report
