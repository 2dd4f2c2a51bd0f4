/// Stages of a calibration: each one's parameters before and after, and errors on its
/// periods and on those that no stage has seen.
/// Source: the form of paper 2's Tables 2 to 6. Errors are computed again from the stored
/// series, standard deviations are as stored; "do not constrain" is above 0.8 of a flat
/// range.
#include "base/nan.hpp"
#include "report/sections.hpp"
#include "report/simulator_tables.hpp"
#include "report/text_table.hpp"
#include "stats/metrics.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::report {
namespace {

constexpr double half_unit = 0.5;

/// One version of a meter over all periods of a comparison.
struct Pairs {
    std::vector<double> simulated, measured;
};

Pairs pairs_of(const Group& comparison, const std::string& meter, std::size_t version) {
    Pairs pairs;
    for (const std::string& period : comparison.texts("period")) {
        const Group group = comparison.inner("periods").inner(period).inner(meter);
        const auto &measured = group.values("measured"),
                   &simulated = group.values("simulated");
        const auto n = static_cast<std::ptrdiff_t>(measured.size());
        const auto first = static_cast<std::ptrdiff_t>(version) * n;
        if (static_cast<std::ptrdiff_t>(simulated.size()) < first + n) continue;
        pairs.measured.insert(pairs.measured.end(), measured.begin(), measured.end());
        pairs.simulated.insert(pairs.simulated.end(), simulated.begin() + first,
                               simulated.begin() + first + n);
    }
    return pairs;
}

/// Absolute errors, rising.
std::vector<double> errors_of(const Pairs& pairs) {
    std::vector<double> errors;
    errors.reserve(pairs.measured.size());
    for (std::size_t k = 0; k < pairs.measured.size(); ++k) {
        const double error = std::abs(pairs.simulated[k] - pairs.measured[k]);
        if (!std::isnan(error)) errors.push_back(error);
    }
    std::ranges::sort(errors);
    return errors;
}

std::string share_within(const std::vector<double>& errors, double limit) {
    if (errors.empty()) return "-";
    const auto n = std::ranges::upper_bound(errors, limit) - errors.begin();
    return fmt::format("{:.1f}",
                       100 * static_cast<double>(n) / static_cast<double>(errors.size()));
}

std::string error_below(const std::vector<double>& errors, double share) {
    if (errors.empty()) return "-";
    const auto last = static_cast<double>(errors.size() - 1);
    return fmt::format("{:.2f}", errors[static_cast<std::size_t>(share * last)]);
}

void add_row(TextTable& table, const Group& comparison, std::size_t meter,
             std::size_t version, double accuracy) {
    const std::string& name = comparison.texts("meter")[meter];
    const Pairs pairs = pairs_of(comparison, name, version);
    const stats::FitMetrics fit = stats::metrics_of(pairs.simulated, pairs.measured);
    const std::vector<double> errors = errors_of(pairs);
    const std::string mean =
        fmt::format("{:.2f}", fit.nmbe == 0 ? 0.0 : fit.nmbe * fit.rmse / fit.cv_rmse);
    table.add({fmt::format("{}", fmt::join(comparison.texts("period"), " + ")), name,
               comparison.texts("version")[version], fmt::format("{:.3f}", fit.rmse),
               fmt::format("{:.2f}", 100 * fit.cv_rmse), fmt::format("{:.3f}", fit.r2),
               mean, share_within(errors, half_unit), share_within(errors, accuracy),
               error_below(errors, 0.5), error_below(errors, 0.9)});
}

/// As Table 6 of paper 2, with the distribution of the errors; the groups of one kind.
std::string comparison_table(const Group& study, const std::string& kind) {
    const double accuracy = study.value("accuracy");
    TextTable table({"period", "meter", "values", "RMSD", "CV %", "R2", "mean",
                     "% <= 0.5", fmt::format("% <= {}", in_short(accuracy)),
                     "50 % <=", "90 % <="});
    for (const Group& comparison : study.inner(kind).groups_below("version_fit"))
        for (std::size_t m = 0; m < comparison.texts("meter").size(); ++m)
            for (std::size_t v = 0; v < comparison.texts("version").size(); ++v)
                add_row(table, comparison, m, v, accuracy);
    return table.is_empty() ? "" : table.text(24);
}

/// A parameter that a stage calibrated; of flat ranges the spread is at most
/// (most - least) / sqrt(12).
struct Calibrated {
    double least, most, start, value, sd, end;
};

std::string remark_on(const Calibrated& it) {
    std::string text;
    if (it.end != 0) text = it.end < 0 ? "at its lower end" : "at its upper end";
    const double flat = (it.most - it.least) / std::sqrt(12.0);
    if (it.sd > 0.8 * flat)
        text += (text.empty() ? "" : ", ") + std::string("data do not constrain it");
    return text;
}

/// As Tables 2 to 5: initial value, range, calibrated value.
std::string parameter_table(const Group& study, std::size_t stage) {
    const auto &names = study.texts("parameter"), &units = study.texts("parameter_unit");
    TextTable table(
        {"parameter", "unit", "initial", "from", "to", "calibrated", "+-", "remark"});
    const auto at = [&](const char* leaf, std::size_t k) {
        const auto& values = study.values(leaf);
        const std::size_t index = stage * names.size() + k;
        return index < values.size() ? values[index] : nan;
    };
    for (std::size_t k = 0; k < names.size(); ++k) {
        const Calibrated it{at("calibration_least", k), at("calibration_most", k),
                            at("calibration_start", k), at("calibration_value", k),
                            at("calibration_sd", k),    at("calibration_at_bound", k)};
        if (std::isnan(it.least)) continue;
        table.add({names[k], units[k], in_short(it.start), in_short(it.least),
                   in_short(it.most), in_short(it.value), in_short(it.sd),
                   remark_on(it)});
    }
    return table.text(28);
}

std::string stage_tables(const Group& study) {
    const auto &stages = study.texts("calibration_stage"),
               &from = study.texts("calibration_from");
    std::string text;
    for (std::size_t s = 0; s < stages.size(); ++s)
        text +=
            fmt::format("  {}, from {}: {:.0f} evaluations, objective {}\n", stages[s],
                        from[s], study.values("calibration_evaluations")[s],
                        in_short(study.values("calibration_objective")[s])) +
            parameter_table(study, s);
    return text;
}

}  // namespace

std::string staged_section(const Group& study) {
    std::string text = fmt::format("\n{}: stages of calibration\n", study.path()) +
                       stage_tables(study) + comparison_table(study, "calibration");
    const std::string unseen = comparison_table(study, "validation");
    if (!unseen.empty()) text += "  periods that no stage has seen\n" + unseen;
    return text + simulator_run_lines(study) + failure_lines(study);
}

}  // namespace bemcal::report
