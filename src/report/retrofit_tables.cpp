/// What each scenario would save: medians with 5 and 95 % over the points, before, after
/// and the difference, and hours too cold or too warm.
/// Made from stored quantiles alone, which are not computed again. Outputs that are
/// nothing before and after are left out; costs are not known.
#include "report/sections.hpp"
#include "report/text_table.hpp"

#include <cmath>

#include <fmt/format.h>

namespace bemcal::report {
namespace {

/// "120 (110 to 133)": the 50 % quantile between those of 5 and 95 %.
std::string middle_and_ends(const std::vector<double>& values, std::size_t first,
                            std::size_t stride, double factor = 1) {
    if (values.size() <= first + 2 * stride || std::isnan(values[first])) return "-";
    return fmt::format("{} ({} to {})", in_short(factor * values[first + stride]),
                       in_short(factor * values[first]),
                       in_short(factor * values[first + 2 * stride]));
}

/// Nothing of this output is there, before or after.
bool is_empty(const Group& study, std::size_t scenario, std::size_t output) {
    const std::size_t n = study.texts("output").size();
    const auto is_zero = [&](const char* leaf, std::size_t first) {
        const auto& values = study.values(leaf);
        for (std::size_t q = 0; q < 3; ++q)
            if (values[first + q * n] != 0) return false;
        return true;
    };
    return is_zero("before_quantile", output) &&
           is_zero("after_quantile", scenario * 3 * n + output);
}

std::string scenario_table(const Group& study, std::size_t scenario) {
    const auto &outputs = study.texts("output"), &units = study.texts("output_unit");
    const std::size_t n = outputs.size();
    const auto& described = study.values("described");
    TextTable table({"", "unit", "described", "before", "after", "saving", "saving %"});
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t first = scenario * 3 * n + k;
        const double before = described[k], after = described[(scenario + 1) * n + k];
        if (before == 0 && after == 0 && is_empty(study, scenario, k)) continue;
        const bool is_energy = units[k] == "kWh";
        table.add({outputs[k], units[k],
                   fmt::format("{} to {}", in_short(before), in_short(after)),
                   middle_and_ends(study.values("before_quantile"), k, n),
                   middle_and_ends(study.values("after_quantile"), first, n),
                   middle_and_ends(study.values("saving_quantile"), first, n),
                   is_energy ? middle_and_ends(study.values("saving_share_quantile"),
                                               first, n, 100)
                             : ""});
    }
    return table.text(30);
}

}  // namespace

std::string retrofit_section(const Group& study) {
    const auto& scenarios = study.texts("scenario");
    const auto shape = study.shape("points");
    const auto& of = study.texts("points_of");
    std::string text;
    for (std::size_t s = 0; s < scenarios.size(); ++s)
        text +=
            fmt::format("\n{}: {}, applied to {} points of {}: medians (5 % to 95 %)\n",
                        study.path(), scenarios[s], shape.empty() ? 0 : shape[0],
                        of.empty() ? "?" : of[0]) +
            scenario_table(study, s);
    const auto& limits = study.values("comfort_limit");
    if (limits.size() == 2)
        text += fmt::format(
            "  too_cold, too_warm: occupied hours below {:g} degC, above {:g} degC\n",
            limits[0], limits[1]);
    return text + failure_lines(study);
}

}  // namespace bemcal::report
