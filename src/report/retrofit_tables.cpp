/// What each scenario would save: medians with 5 and 95 % over the points, before, after
/// and the difference, and hours too cold or too warm.
/// Made from stored quantiles alone, which are not computed again. Outputs that are
/// nothing before and after are left out.
#include "physics/calendar.hpp"
#include "report/sections.hpp"
#include "report/simulator_tables.hpp"
#include "report/text_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::report {
namespace {

/// "2021-03-05" of seconds since 1970.
std::string date_of(double seconds) {
    return physics::format_date(
        physics::Seconds(std::chrono::seconds(static_cast<long long>(seconds))));
}

/// Quantiles of 5, 50 and 95 %.
using Three = std::array<double, 3>;

Three quantiles_before(const Group& study, std::size_t output) {
    const Numbers values = study.values("before_quantile");
    return {values.at({0, output}), values.at({1, output}), values.at({2, output})};
}

Three quantiles_of(const Group& study, const char* leaf, std::size_t scenario,
                   std::size_t output) {
    const Numbers values = study.values(leaf);
    return {values.at({scenario, 0, output}), values.at({scenario, 1, output}),
            values.at({scenario, 2, output})};
}

/// "120 (110 to 133)": the 50 % quantile between those of 5 and 95 %; "120" where all
/// points agree, or there is one.
std::string middle_and_ends(const Three& quantiles, double factor = 1) {
    const auto& [low, middle, high] = quantiles;
    if (std::isnan(low)) return "-";
    if (low == high) return in_short(factor * middle);
    return fmt::format("{} ({} to {})", in_short(factor * middle), in_short(factor * low),
                       in_short(factor * high));
}

/// How many, and what is told of them.
std::string points_words(std::size_t n, const std::string& of) {
    return n == 1 ? "the point of " + of
                  : fmt::format("{} points of {}: medians (5 % to 95 %)", n, of);
}

/// Whether it says how many hours are too cold or too warm.
bool counts_hours(const Group& study) {
    const Texts units = study.texts("output_unit");
    return std::ranges::find(units, "h") != units.end();
}

std::string scenario_table(const Group& study, std::size_t scenario) {
    const auto &outputs = study.texts("output"), &units = study.texts("output_unit");
    const Numbers described = study.values("described");
    TextTable table({"", "unit", "described", "before", "after", "saving", "saving %"});
    for (std::size_t k = 0; k < outputs.size(); ++k) {
        const double before = described.at({0, k}),
                     after = described.at({scenario + 1, k});
        const Three all_before = quantiles_before(study, k),
                    all_after = quantiles_of(study, "after_quantile", scenario, k);
        const Three nothing{};
        if (before == 0 && after == 0 && all_before == nothing && all_after == nothing)
            continue;
        const auto shown = [&](const char* leaf, double factor = 1) {
            return middle_and_ends(quantiles_of(study, leaf, scenario, k), factor);
        };
        table.add({outputs[k], units[k],
                   fmt::format("{} to {}", in_short(before), in_short(after)),
                   middle_and_ends(all_before), middle_and_ends(all_after),
                   shown("saving_quantile"),
                   units[k] != "h" ? shown("saving_share_quantile", 100) : ""});
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
        text += fmt::format("\n{}: {}, applied to {}\n", study.path(), scenarios[s],
                            points_words(shape.empty() ? 0 : shape[0],
                                         of.empty() ? "?" : of[0])) +
                scenario_table(study, s);
    const auto& ends = study.values("simulated_period");
    if (ends.size() == 2)
        text += fmt::format("  energies, hours and costs are of {} to {}, {:.0f} days\n",
                            date_of(ends[0]), date_of(ends[1] - 1),
                            (ends[1] - ends[0]) / physics::day_s);
    if (const Texts given = study.texts("simulator_given"); !given.empty())
        text += wrapped("the program has, before and after, what a loop found: " +
                        fmt::format("{}", fmt::join(given, ", ")));
    text += simulator_run_lines(study);
    const auto& limits = study.values("comfort_limit");
    if (limits.size() == 2 && counts_hours(study))
        text += fmt::format(
            "  too_cold, too_warm: hours below {:g} degC, above {:g} degC; those of "
            "`occupied`, where the study has it\n",
            limits[0], limits[1]);
    return text + failure_lines(study);
}

}  // namespace bemcal::report
