/// Of a Kennedy-O'Hagan calibration: measured against predicted at its field points,
/// errors, coverage, and how often jitter was needed.
/// Made from stored datasets alone; unlike other tables it does not compute them again.
/// 24 points are shown at most.
#include "report/sections.hpp"
#include "report/text_table.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::report {
namespace {

constexpr std::size_t most_points = 24;

std::string points_table(const Group& study) {
    const auto& measured = study.values("field_measured");
    TextTable table(
        {"field point", "measured", "process", "5 %", "95 %", "measurement 5 %", "95 %"});
    const std::size_t n = std::min(measured.size(), most_points);
    for (std::size_t i = 0; i < n; ++i) {
        std::vector<std::string> row{std::to_string(i + 1), in_short(measured[i])};
        for (const char* leaf : {"process_mean", "process_q05", "process_q95",
                                 "measurement_q05", "measurement_q95"})
            row.push_back(in_short(study.values(leaf)[i]));
        table.add(std::move(row));
    }
    std::string text = table.text();
    if (measured.size() > n)
        text += fmt::format("  and {} more points\n", measured.size() - n);
    return text;
}

std::string share_in_90(const Group& study, const char* leaf) {
    return percent(study.values(leaf)[1]);
}

}  // namespace

std::string field_tables(const Group& study) {
    if (!study.has("field_measured")) return {};
    return points_table(study) +
           fmt::format(
               "  posterior mean: CV(RMSE) {} (with n - 1: {}), NMBE {} (with n - 1: "
               "{})\n"
               "  single draws: CV(RMSE) with n - 1 is {} on average\n"
               "  inside 90 % intervals: {} of the process's, {} of a measurement's\n"
               "  covariance: {}; draws that needed jitter: {:.0f} of {:.0f}\n",
               percent(study.value("field_cv_rmse")),
               percent(study.value("field_cv_rmse_n1")),
               percent(study.value("field_nmbe")), percent(study.value("field_nmbe_n1")),
               percent(study.value("field_cv_rmse_n1_of_draws")),
               share_in_90(study, "process_coverage"),
               share_in_90(study, "measurement_coverage"),
               study.texts("covariance_form")[0], study.value("n_with_jitter"),
               study.value("n_predictive"));
}

}  // namespace bemcal::report
