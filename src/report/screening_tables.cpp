/// Nominal against best for each meter and period, how many points meet Guideline 14, and
/// the best point.
/// Errors are computed again from the stored series (metrics: ASHRAE Guideline 14); the
/// counts are as stored. Days are left out: own interval and months only.
#include "physics/calendar.hpp"
#include "report/fit_words.hpp"
#include "report/interval_name.hpp"
#include "report/sections.hpp"
#include "report/text_table.hpp"
#include "stats/metrics.hpp"

#include <chrono>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace bemcal::report {
namespace {

using stats::FitMetrics;

/// A meter over a period as it is stored, with one of the candidates.
struct Series {
    std::vector<double> begins, simulated, measured;
    bool is_mean = false;  ///< a temperature: months are means, not sums
};

/// Of years that a calendar has.
void check_times(const Numbers& begins) {
    for (const double begin : begins)
        if (!(std::abs(begin) < 1e11)) begins.refuse(fmt::format("{} is no time", begin));
}

Series series_of(const Group& meter, std::size_t candidate, bool is_mean) {
    const auto &begins = meter.values("time"), &measured = meter.values("measured");
    Series series{begins, {}, measured, is_mean};
    const auto& both = meter.values("simulated");
    const std::size_t n = begins.size();
    if (both.size() < (candidate + 1) * n) return {};
    check_times(begins);
    if (measured.size() != n) measured.refuse(fmt::format("there are {} of time", n));
    const auto first = both.begin() + static_cast<std::ptrdiff_t>(candidate * n);
    series.simulated.assign(first, first + static_cast<std::ptrdiff_t>(n));
    return series;
}

std::pair<int, int> month_of(double seconds_since_1970) {
    const auto step = physics::calendar_step(physics::Seconds(
        std::chrono::seconds(static_cast<long long>(seconds_since_1970))));
    return {step.year, step.month};
}

/// Over the intervals of each month that have a reading; the calendar's months.
FitMetrics monthly_metrics(const Series& series) {
    struct Sums {
        double simulated = 0, measured = 0, n = 0;
    };
    std::map<std::pair<int, int>, Sums> months;
    for (std::size_t k = 0; k < series.begins.size(); ++k) {
        if (std::isnan(series.measured[k])) continue;
        Sums& sums = months[month_of(series.begins[k])];
        sums.simulated += series.simulated[k];
        sums.measured += series.measured[k];
        sums.n += 1;
    }
    std::vector<double> simulated, measured;
    for (const auto& [month, sums] : months) {
        simulated.push_back(sums.simulated / (series.is_mean ? sums.n : 1));
        measured.push_back(sums.measured / (series.is_mean ? sums.n : 1));
    }
    return stats::metrics_of(simulated, measured);
}

void add_row(TextTable& table, const std::string& period, const std::string& meter,
             const std::string& interval, const FitMetrics& nominal,
             const FitMetrics& best, stats::Resolution resolution) {
    table.add({period, meter, interval, in_short(best.n),
               change(nominal.cv_rmse, best.cv_rmse), change(nominal.nmbe, best.nmbe),
               change(nominal.mape, best.mape),
               verdict(meets_guideline_14(nominal, resolution),
                       meets_guideline_14(best, resolution))});
}

void add_meter(TextTable& table, const Group& study, const std::string& period,
               std::size_t meter) {
    const std::string& name = study.texts("meter")[meter];
    const bool is_mean = study.texts("meter_unit")[meter] == "degC";
    const Group group = study.inner(period).inner(name);
    const Series nominal = series_of(group, 0, is_mean),
                 best = series_of(group, 1, is_mean);
    if (nominal.begins.empty()) return;
    const bool is_finer = !is_by_month(nominal.begins);
    const auto own = is_finer ? stats::Resolution::hourly : stats::Resolution::monthly;
    add_row(table, period, name, interval_name(nominal.begins),
            stats::metrics_of(nominal.simulated, nominal.measured),
            stats::metrics_of(best.simulated, best.measured), own);
    if (is_finer)
        add_row(table, period, name, "monthly", monthly_metrics(nominal),
                monthly_metrics(best), stats::Resolution::monthly);
}

std::string fit_table(const Group& study) {
    TextTable table(
        {"period", "meter", "", "n", "CV(RMSE) %", "NMBE %", "MAPE %", "G14"});
    for (const std::string& period : study.texts("period"))
        for (std::size_t m = 0; m < study.texts("meter").size(); ++m)
            add_meter(table, study, period, m);
    return table.text(16) + (table.is_empty() ? "" : guideline_note);
}

std::string count_lines(const Group& study) {
    const auto &periods = study.texts("period"), &resolutions = study.texts("resolution");
    const auto& counts = study.values("guideline_14_count");
    std::string text;
    for (std::size_t p = 0; p < periods.size(); ++p)
        for (std::size_t r = 0; r < resolutions.size() && !counts.empty(); ++r)
            text += fmt::format(
                "  {:.0f} of {:.0f} points meet ASHRAE Guideline 14 ({}) in {}\n",
                counts.at({p, r}), study.value("n_points"), resolutions[r], periods[p]);
    return text;
}

std::string parameter_table(const Group& study) {
    const auto &names = study.texts("parameter"), &units = study.texts("parameter_unit");
    const auto &least = study.values("parameter_least"),
               &most = study.values("parameter_most");
    const auto& both = study.values("candidate_parameters");
    if (both.empty()) return {};
    TextTable table({"parameter", "nominal", "best", "unit", "range"});
    for (std::size_t p = 0; p < names.size(); ++p)
        table.add({names[p], in_short(both.at({0, p})), in_short(both.at({1, p})),
                   units[p],
                   fmt::format("{} to {}", in_short(least[p]), in_short(most[p]))});
    return table.text(48);
}

}  // namespace

std::string candidate_tables(const Group& study) {
    return fit_table(study) + parameter_table(study);
}

std::string screening_section(const Group& study) {
    const double n_points = study.value("n_points");
    return fmt::format(
               "\n{}: nominal -> best of {:.0f} points (best in {} by CV(RMSE))\n",
               study.path(), n_points > 0 ? n_points : 0,
               study.texts("period").empty() ? "training" : study.texts("period")[0]) +
           fit_table(study) + count_lines(study) + parameter_table(study) +
           simulator_run_lines(study) + failure_lines(study);
}

}  // namespace bemcal::report
