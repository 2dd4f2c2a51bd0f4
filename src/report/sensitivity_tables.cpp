/// Parameters by total-order index, for each output or for a whole series, with intervals
/// and a mark above the threshold.
/// Indices are estimated again from the stored design (Saltelli et al. 2010); their
/// intervals, and all of a series, are as stored. The hours themselves are not shown.
#include "report/sections.hpp"
#include "report/simulator_tables.hpp"
#include "report/text_table.hpp"
#include "stats/saltelli.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace bemcal::report {
namespace {

/// Rows of a table of indices, one value for each parameter.
struct Indices {
    std::vector<double> total, total_half_width, first, first_half_width;
};

std::vector<double> row_of(const std::vector<double>& values, std::size_t row,
                           std::size_t n) {
    if (values.size() < (row + 1) * n) return std::vector<double>(n, 0.0 / 0.0);
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(row * n);
    return {first, first + static_cast<std::ptrdiff_t>(n)};
}

std::string with_half_width(double value, double half_width) {
    if (!(value == value)) return "-";
    if (!(half_width == half_width)) return fmt::format("{:.3f}", value);
    return fmt::format("{:.3f} +- {:.3f}", value, half_width);
}

std::string table_of(const Group& study, const Indices& indices, double threshold) {
    const auto &names = study.texts("parameter"), &units = study.texts("parameter_unit");
    const auto &least = study.values("parameter_least"),
               &most = study.values("parameter_most");
    std::vector<std::size_t> order(names.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto key = [&](std::size_t p) {
        return indices.total[p] == indices.total[p] ? indices.total[p] : -1e300;
    };
    std::ranges::stable_sort(order, std::greater<>{}, key);
    TextTable table({"parameter", "range", "unit", "total order", "first order", ""});
    for (const std::size_t p : order)
        table.add(
            {names[p], fmt::format("{} to {}", in_short(least[p]), in_short(most[p])),
             units[p], with_half_width(indices.total[p], indices.total_half_width[p]),
             with_half_width(indices.first[p], indices.first_half_width[p]),
             indices.total[p] > threshold ? "*" : ""});
    return table.text(32);
}

/// Indices estimated again from the stored outputs of the design; the stored intervals
/// stay.
void estimate_again(const Group& study, std::size_t output, Indices& indices) {
    const auto& design = study.values("design_output");
    const std::size_t n_outputs = study.texts("output").size();
    const std::size_t d = study.texts("parameter").size();
    if (design.empty()) return;
    if (design.size() % (n_outputs * (d + 2)) != 0)
        design.refuse(fmt::format("{} outputs of {} parameters take whole base points",
                                  n_outputs, d));
    std::vector<double> column(design.size() / n_outputs);
    for (std::size_t row = 0; row < column.size(); ++row)
        column[row] = design[row * n_outputs + output];
    const auto estimated = stats::sobol_indices(column, static_cast<int>(d), 0, 0);
    indices.total = estimated.total_order;
    indices.first = estimated.first_order;
}

}  // namespace

std::string sensitivity_section(const Group& study) {
    const auto &outputs = study.texts("output"), &units = study.texts("output_unit");
    const std::size_t d = study.texts("parameter").size();
    const double threshold = study.value("threshold");
    std::string text;
    for (std::size_t k = 0; k < outputs.size(); ++k) {
        Indices indices{row_of(study.values("total_order"), k, d),
                        row_of(study.values("total_order_half_width"), k, d),
                        row_of(study.values("first_order"), k, d),
                        row_of(study.values("first_order_half_width"), k, d)};
        estimate_again(study, k, indices);
        text += fmt::format(
            "\n{}: Sobol indices of {} [{}], mean {}; * total order above {}\n",
            study.path(), outputs[k], units[k],
            in_short(row_of(study.values("output_mean"), k, 1)[0]), threshold);
        text += table_of(study, indices, threshold);
    }
    return text + simulator_run_lines(study) + failure_lines(study);
}

std::string hourly_section(const Group& study) {
    const std::size_t d = study.texts("parameter").size();
    const Indices indices{row_of(study.values("series_total_order"), 0, d),
                          row_of(study.values("series_total_order_half_width"), 0, d),
                          row_of(study.values("series_first_order"), 0, d),
                          row_of(study.values("series_first_order_half_width"), 0, d)};
    const auto& quantity = study.texts("quantity");
    return fmt::format(
               "\n{}: Sobol indices of {} over {} steps, weighted by their variance\n",
               study.path(), quantity.empty() ? "a quantity" : quantity[0],
               study.values("time").size()) +
           table_of(study, indices,
                    study.has("threshold") ? study.value("threshold") : 0.05) +
           failure_lines(study);
}

}  // namespace bemcal::report
