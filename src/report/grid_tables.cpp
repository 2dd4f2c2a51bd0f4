/// Stages of a grid: how near each came, the k nearest of each with and without density
/// avoidance, and what became of every parameter.
/// Made from stored datasets alone; indices are not computed again. Errors are shown of
/// up to three targets, neighbours up to 20.
#include "report/sections.hpp"
#include "report/simulator_tables.hpp"
#include "report/text_table.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::report {
namespace {

/// Targets that a table has room for.
constexpr std::size_t most_shown = 3;

std::string signed_percent(double value) {
    return std::isfinite(value) ? fmt::format("{:+.3f}", value) : std::string("-");
}

std::vector<std::string> shown_targets(const Group& study) {
    std::vector<std::string> names = study.texts("target");
    if (names.size() > most_shown) names.clear();
    for (std::string& name : names) name += " %";
    return names;
}

void append(std::vector<std::string>& to, const std::vector<std::string>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

/// The errors of a row [rows x targets], where there is room for them.
std::vector<std::string> error_cells(const Group& study, const Numbers& errors,
                                     std::size_t row) {
    const std::size_t n = study.texts("target").size();
    std::vector<std::string> cells;
    for (std::size_t t = 0; n <= most_shown && t < n; ++t)
        cells.push_back(signed_percent(errors.at({row, t})));
    return cells;
}

std::string stages_table(const Group& study) {
    const auto &points = study.values("stage_points"),
               &errors = study.values("stage_error"),
               &target_errors = study.values("stage_target_error");
    std::vector<std::string> header{"stage", "points", "nearest %"};
    append(header, shown_targets(study));
    TextTable table(header);
    double sum = 0;
    for (std::size_t s = 0; s < points.size(); ++s) {
        sum += points[s];
        std::vector<std::string> row{
            std::to_string(s + 1), fmt::format("{:.0f}", points[s]),
            std::isfinite(errors[s]) ? fmt::format("{:.3f}", errors[s]) : "-"};
        append(row, error_cells(study, target_errors, s));
        table.add(row);
    }
    const auto& reason = study.texts("ended_by");
    return table.text() + fmt::format("  {:.0f} points; {}\n", sum,
                                      reason.empty() ? "stopped" : reason[0]);
}

std::string measured_line(const Group& study) {
    const auto &names = study.texts("target"), &units = study.texts("target_unit");
    const auto& measured = study.values("target_measured");
    std::string text = "  measured:";
    for (std::size_t t = 0; t < names.size(); ++t)
        text += fmt::format("{} {} {:.6g} {}", t == 0 ? "" : ",", names[t], measured[t],
                            units[t]);
    return cut(text, 100) + "\n";
}

/// Parameters that vary in the stage.
std::vector<std::size_t> varied(const Group& stage) {
    std::vector<std::size_t> found;
    const auto& n_values = stage.values("n_values");
    for (std::size_t p = 0; p < n_values.size(); ++p)
        if (n_values[p] > 1) found.push_back(p);
    return found;
}

/// The k nearest of a stage with the values of the parameters that vary; "*" = also one
/// of the plain nearest.
std::string neighbour_table(const Group& study, const Group& stage) {
    const auto& names = study.texts("parameter");
    const auto &points = stage.values("grid_points"),
               &errors = stage.values("target_error"),
               &distance = stage.values("distance"),
               &plain = stage.values("plain_neighbour");
    const std::vector<std::size_t> parameters = varied(stage);
    std::vector<std::string> header{"", "distance"};
    append(header, shown_targets(study));
    for (const std::size_t p : parameters) header.push_back(cut(names[p], 11));
    TextTable table(header);
    const auto& neighbours = stage.values("neighbour");
    for (std::size_t k = 0; k < std::min<std::size_t>(neighbours.size(), 20); ++k) {
        const std::size_t at = neighbours.index(k, distance.size());
        std::vector<std::string> row{
            std::ranges::count(plain, neighbours[k]) > 0 ? "*" : "",
            fmt::format("{:.3f}", distance[at])};
        append(row, error_cells(study, errors, at));
        for (const std::size_t p : parameters)
            row.push_back(fmt::format("{:g}", points.at({at, p})));
        table.add(row);
    }
    return table.text();
}

/// The largest index of a parameter over the targets.
double largest_index(const Group& stage, std::size_t parameter) {
    const auto& indices = stage.values("grid_total_order");
    const std::size_t n = stage.values("n_values").size();
    double largest = 0;
    for (std::size_t k = parameter; k < indices.size(); k += n)
        if (indices[k] > largest) largest = indices[k];
    return largest;
}

std::string parameter_table(const Group& study, const Group& stage) {
    const auto& names = study.texts("parameter");
    const auto &n_values = stage.values("n_values"),
               &n_surviving = stage.values("n_surviving"),
               &of_distance = stage.values("distance_total_order"),
               &points = stage.values("grid_points"),
               &neighbours = stage.values("neighbour");
    const auto& roles = stage.texts("parameter_role");
    TextTable table({"parameter", "values", "surviving", "index", "of distance", ""});
    for (const std::size_t p : varied(stage)) {
        const bool is_fixed = n_surviving[p] == 1 && !neighbours.empty();
        const double value =
            is_fixed ? points.at({neighbours.index(0, points.size()), p}) : 0;
        table.add(
            {names[p], fmt::format("{:.0f}", n_values[p]),
             fmt::format("{:.0f}", n_surviving[p]),
             fmt::format("{:.3f}", largest_index(stage, p)),
             std::isfinite(of_distance[p]) ? fmt::format("{:.3f}", of_distance[p]) : "-",
             is_fixed ? fmt::format("{} at {:g}", roles[p], value) : roles[p]});
    }
    return table.is_empty() ? std::string() : table.text();
}

std::string stage_section(const Group& study, std::size_t number) {
    const Group stage = study.inner(fmt::format("stage_{}", number));
    const double n_high =
        static_cast<double>(std::ranges::count(stage.values("is_high_density"), 1.0));
    return fmt::format(
               "\n  stage {}: nearest with density avoidance (radius {:.3g}, {:.0f} "
               "passed "
               "over); * plainly nearest\n",
               number, stage.value("crowding_radius"), n_high) +
           neighbour_table(study, stage) + parameter_table(study, stage);
}

std::string best_table(const Group& study) {
    const auto &names = study.texts("parameter"), &units = study.texts("parameter_unit");
    const auto& best = study.values("nearest_parameters");
    TextTable table({"parameter", "nearest of all", "unit"});
    for (std::size_t p = 0; p < names.size(); ++p)
        table.add({names[p], in_short(best[p]), units[p]});
    return "\n" + table.text();
}

}  // namespace

std::string grid_section(const Group& study) {
    std::string text =
        fmt::format(
            "\n{}: grid in stages; index = largest total-order Sobol index over "
            "the targets\n",
            study.path()) +
        measured_line(study) + stages_table(study);
    for (std::size_t s = 1; s <= study.values("stage_points").size(); ++s)
        text += stage_section(study, s);
    return text + best_table(study) + simulator_run_lines(study) + failure_lines(study);
}

}  // namespace bemcal::report
