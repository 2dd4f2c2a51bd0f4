#include "store/layout.hpp"

#include "base/error.hpp"

#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::store {
namespace {

constexpr auto number = Kind::number;
constexpr auto text = Kind::text;
constexpr const char* seconds = "seconds since 1970-01-01 00:00:00";
constexpr const char* own = "of the parameter";

constexpr LayoutRow rows[] = {
    // inputs
    {"input_file", "input_file", text, "", "files read, the job's own first"},
    {"content_hash", "input_file", text, "", "XXH3 hash of each file's content"},
    // what was found in the data of a building
    {"series", "decision", text, "", "meter or column with a finding"},
    {"finding", "decision", text, "", "what was found in it"},
    {"action", "decision", text, "", "what was done about it"},
    // every study
    {"parameter", "parameter", text, "", "names of the varied parameters"},
    {"parameter_unit", "parameter", text, "", "their units"},
    {"parameter_least", "parameter", number, own, "lower end of the range"},
    {"parameter_most", "parameter", number, own, "upper end of the range"},
    {"n_failed", "", number, "1", "simulations that failed"},
    {"failed_point", "failure", number, "1", "index in the study of each that failed"},
    {"failed_reason", "failure", text, "", "why it failed"},
    {"shortfall", "", text, "", "the target that was missed; absent where none was"},
    // sensitivity
    {"output", "output", text, "", "names of the outputs"},
    {"output_unit", "output", text, "", "their units"},
    {"sample_a", "base_point parameter", number, own, "matrix A of Saltelli's design"},
    {"sample_b", "base_point parameter", number, own, "matrix B of Saltelli's design"},
    {"design_output", "base_point design_row output", number, "of the output",
     "outputs of the rows A, AB_1 .. AB_d, B; NaN = failed"},
    {"first_order", "output parameter", number, "1", "first-order Sobol index"},
    {"first_order_half_width", "output parameter", number, "1",
     "half of its 95 % bootstrap interval"},
    {"total_order", "output parameter", number, "1", "total-order Sobol index"},
    {"total_order_half_width", "output parameter", number, "1",
     "half of its 95 % bootstrap interval"},
    {"sensitive", "output parameter", number, "1",
     "1 where the total-order index is above the threshold"},
    {"threshold", "", number, "1",
     "total-order index above which a parameter counts as sensitive"},
    {"output_mean", "output", number, "of the output", "mean over the design"},
    {"output_variance", "output", number, "of the output, squared",
     "variance over the rows A and B"},
    {"n_used", "output", number, "1", "base points without a failed row"},
    // hourly sensitivity
    {"time", "time", number, seconds, "begin of the step, local standard time"},
    {"hourly_first_order", "time parameter", number, "1",
     "first-order index of the quantity in the step; NaN where it does not vary"},
    {"hourly_first_order_half_width", "time parameter", number, "1",
     "half of its 95 % interval from 32 blocks of base points"},
    {"hourly_total_order", "time parameter", number, "1",
     "total-order index in the step"},
    {"hourly_total_order_half_width", "time parameter", number, "1",
     "half of its 95 % interval from 32 blocks of base points"},
    {"hourly_mean", "time", number, "W (degC for a temperature)", "mean over the design"},
    {"hourly_variance", "time", number, "W2 (K2 for a temperature)",
     "variance over the rows A and B"},
    {"series_first_order", "parameter", number, "1",
     "first-order index of the whole series: steps weighted by their variance"},
    {"series_first_order_half_width", "parameter", number, "1",
     "half of its 95 % interval"},
    {"series_total_order", "parameter", number, "1",
     "total-order index of the whole series"},
    {"series_total_order_half_width", "parameter", number, "1",
     "half of its 95 % interval"},
    {"quantity", "", text, "", "the quantity whose indices these are"},
    {"block_n_used", "block", number, "1",
     "base points of each block without a failed row"},
    // screening
    {"meter", "meter", text, "", "names of the meters"},
    {"meter_unit", "meter", text, "", "their units"},
    {"period", "period", text, "", "names of the periods; the first is for training"},
    {"candidate", "candidate", text, "", "nominal and best"},
    {"metric", "metric", text, "", "names of the error metrics"},
    {"resolution", "resolution", text, "", "hourly and monthly"},
    {"points", "point parameter", number, own,
     "every point; point 0 is the nominal building"},
    {"score", "point", number, "1",
     "sum over meters of the squared CV(RMSE) in training; NaN = failed"},
    {"cv_rmse", "point period meter", number, "1", "CV(RMSE) at the meter's interval"},
    {"nmbe", "point period meter", number, "1", "sum of errors over sum of measured"},
    {"mape", "point period meter", number, "1",
     "mean absolute relative error over non-zero readings"},
    {"monthly_cv_rmse", "point period meter", number, "1", "CV(RMSE) of calendar months"},
    {"monthly_nmbe", "point period meter", number, "1", "NMBE of calendar months"},
    {"monthly_mape", "point period meter", number, "1", "MAPE of calendar months"},
    {"meets_guideline_14", "point period resolution", number, "1",
     "1 where every meter meets ASHRAE Guideline 14"},
    {"guideline_14_count", "period resolution", number, "1", "points that meet it"},
    {"best_point", "rank", number, "1", "indices of the best points, best first"},
    {"best_score", "rank", number, "1", "their scores"},
    {"best_parameters", "rank parameter", number, own, "their values"},
    {"best_cv_rmse", "rank period meter", number, "1", "their CV(RMSE)"},
    {"best_nmbe", "rank period meter", number, "1", "their NMBE"},
    {"best_mape", "rank period meter", number, "1", "their MAPE"},
    {"best_monthly_cv_rmse", "rank period meter", number, "1", "their monthly CV(RMSE)"},
    {"best_monthly_nmbe", "rank period meter", number, "1", "their monthly NMBE"},
    {"best_monthly_mape", "rank period meter", number, "1", "their monthly MAPE"},
    {"candidate_parameters", "candidate parameter", number, own,
     "the nominal and best point"},
    {"fit", "candidate period meter metric", number, "1 (rmse: of the meter)",
     "nominal against best at the meter's interval"},
    {"monthly_fit", "candidate period meter metric", number, "1 (rmse: of the meter)",
     "the same by calendar month"},
    {"n_points", "", number, "1", "points in the sample, the nominal one included"},
    {"measured", "time", number, "of the meter", "readings; NaN = missing or masked"},
    {"simulated", "candidate time", number, "of the meter",
     "the nominal and the best point"},
    // posterior: a table of the unknowns, and of the chains
    {"unknown", "unknown", text, "", "names of the unknowns; the log density last"},
    {"unknown_unit", "unknown", text, "", "their units"},
    {"posterior_mean", "unknown", number, own, "mean of the draws"},
    {"posterior_sd", "unknown", number, own, "their standard deviation"},
    {"posterior_q05", "unknown", number, own, "their 5 % quantile"},
    {"posterior_q50", "unknown", number, own, "their median"},
    {"posterior_q95", "unknown", number, own, "their 95 % quantile"},
    {"gelman_rubin", "unknown", number, "1", "R of Gelman and Rubin 1992"},
    {"rhat_split", "unknown", number, "1", "split R-hat"},
    {"rhat_rank", "unknown", number, "1",
     "split R-hat of ranks, the larger of plain and folded: Vehtari et al. 2021"},
    {"ess_bulk", "unknown", number, "1", "effective draws in the bulk"},
    {"ess_tail", "unknown", number, "1", "effective draws of the 5 % and 95 % quantiles"},
    {"mcse_mean", "unknown", number, own, "Monte Carlo error of the mean"},
    {"convergence", "", text, "", "converged, or what is missing"},
    {"target_rhat", "", number, "1", "R-hat is to be at most this"},
    {"target_ess", "", number, "1", "effective draws are to be at least so many"},
    {"contraction", "unknown", number, "1",
     "1 - variance / variance of the prior: 1 = the data say all, 0 = nothing"},
    {"shift", "unknown", number, "1", "of the mean from the prior's, in its sd"},
    {"range_share", "unknown", number, "1", "width of the 90 % interval / the prior's"},
    {"data_finding", "unknown", text, "", "what the data could tell, in a word"},
    {"data_words", "unknown", text, "", "the same in a sentence"},
    // kennedy_ohagan: at the field points
    {"covariance_form", "", text, "", "kronecker, where the runs are a grid, or dense"},
    {"n_predictive", "", number, "1", "draws that the predictions are made of"},
    {"n_with_jitter", "", number, "1",
     "those of them whose covariance needed something on its diagonal"},
    {"known_input", "known_input", text, "", "names of the known inputs"},
    {"field_input", "field_point known_input", number, "of the input", "their values"},
    {"field_measured", "field_point", number, "of the output", "measurements"},
    {"process_mean", "field_point", number, "of the output",
     "posterior mean of the true process"},
    {"process_q05", "field_point", number, "of the output", "its 5 % quantile"},
    {"process_q95", "field_point", number, "of the output", "its 95 % quantile"},
    {"measurement_q05", "field_point", number, "of the output",
     "5 % quantile of a measurement, with its noise"},
    {"measurement_q95", "field_point", number, "of the output",
     "95 % quantile of a measurement, with its noise"},
    {"field_cv_rmse", "", number, "1", "CV(RMSE) of the posterior mean, with n"},
    {"field_cv_rmse_n1", "", number, "1", "the same with n - 1"},
    {"field_nmbe", "", number, "1", "NMBE of the posterior mean, with n"},
    {"field_nmbe_n1", "", number, "1", "the same with n - 1"},
    {"field_cv_rmse_n1_of_draws", "", number, "1",
     "CV(RMSE) of single draws of the process, with n - 1, their mean"},
    {"process_coverage", "interval", number, "1",
     "share of measurements in the process's central 50 % and 90 % intervals"},
    {"measurement_coverage", "interval", number, "1",
     "the same for intervals of a measurement"},
    // posterior: a meter in a period
    {"validation_fit", "version resolution metric", number, "1 (rmse: of the meter)",
     "before and after; by reading, day and month"},
    {"guideline_14_met", "version verdict", number, "1",
     "before and after; hourly and monthly limits of ASHRAE Guideline 14"},
    {"month", "month", number, seconds, "begins of whole months"},
    {"month_measured", "month", number, "of the meter", "their measured totals"},
    {"month_predicted", "version month", number, "of the meter", "before and after"},
    {"month_error", "version month", number, "1", "(predicted - measured) / measured"},
    {"mid_month", "mid_month", number, seconds, "the 15th of each month"},
    {"mid_month_cv_rmse", "version mid_month", number, "1", "its CV(RMSE) by hour"},
    {"design_day", "design_day", number, seconds, "21 January and 21 July"},
    {"design_day_cv_rmse", "version design_day", number, "1", "their CV(RMSE) by hour"},
    {"coverage", "interval", number, "1",
     "share of readings in the central 50 % and 90 % intervals, then of months"},
    {"pit", "pit_bin", number, "1", "readings by their rank among the draws"},
    {"pit_distance", "", number, "1", "from the uniform distribution, Kolmogorov's"},
    {"nominal", "time", number, "of the meter", "the building as described"},
    {"predicted_mean", "time", number, "of the meter", "mean of the posterior's draws"},
    {"predicted_q05", "time", number, "of the meter",
     "5 % quantile of a reading, with its residual"},
    {"predicted_q95", "time", number, "of the meter",
     "95 % quantile of a reading, with its residual"},
    // posterior: ArviZ's groups
    {"posterior/*", "chain draw", number, own, "draws of an unknown"},
    {"sample_stats/*", "chain draw", number, "1", "the sampler, draw by draw"},
    {"prior/*", "chain draw", number, own, "independent draws of its prior"},
    {"time_*", "time_*", number, seconds, "begins of the meter's readings"},
    {"observed_data/*", "time_*", number, "of the meter", "readings in training"},
    {"posterior_predictive/*", "chain draw time_*", number, "of the meter",
     "readings as the posterior would draw them"},
    // by step
    {"outdoor_temperature", "time", number, "degC",
     "mean outdoor temperature of the step"},
    {"air_temperature", "candidate time", number, "degC",
     "mean air temperature of the step"},
    {"heating", "candidate time", number, "kWh", "heat delivered in the step"},
    {"cooling", "candidate time", number, "kWh", "heat removed in the step"},
    {"electricity", "candidate time", number, "kWh", "electricity drawn in the step"},
    {"gas", "candidate time", number, "kWh", "gas drawn in the step"},
    {"district", "candidate time", number, "kWh", "district heat drawn in the step"},
};

/// A * at the end of a pattern stands for anything but another level.
bool matches(std::string_view pattern, std::string_view name) {
    if (!pattern.ends_with('*')) return pattern == name;
    pattern.remove_suffix(1);
    return name.starts_with(pattern) &&
           name.find('/', pattern.size()) == std::string_view::npos;
}

}  // namespace

std::span<const LayoutRow> layout() {
    return rows;
}

std::string leaf_of(const std::string& path) {
    return path.substr(path.rfind('/') + 1);
}

std::string group_of(const std::string& path) {
    const std::size_t end = path.rfind('/');
    return end == std::string::npos ? std::string() : path.substr(0, end);
}

const LayoutRow& layout_of(const study::Dataset& dataset) {
    const std::string leaf = leaf_of(dataset.path);
    const std::string inner = leaf_of(group_of(dataset.path)) + "/" + leaf;
    const std::string dims = fmt::format("{}", fmt::join(dataset.dims, " "));
    const LayoutRow* row = nullptr;
    for (const LayoutRow& each : rows) {
        if (!matches(each.leaf, leaf) && !matches(each.leaf, inner)) continue;
        row = &each;
        if (matches(each.dims, dims)) break;
    }
    if (row == nullptr)
        throw std::logic_error("no row in the layout table for dataset " + dataset.path);
    if (!matches(row->dims, dims))
        throw std::logic_error(fmt::format("dataset {} has dimensions '{}', not '{}'",
                                           dataset.path, dims, row->dims));
    if (row->kind == text ? !dataset.values.empty() : !dataset.texts.empty())
        throw std::logic_error("dataset " + dataset.path + " is of the wrong kind");
    return *row;
}

std::string describe_results() {
    std::string out = fmt::format("{:<30} {:<30} {:<18} {}\n", "dataset", "dimensions",
                                  "unit", "meaning");
    for (const LayoutRow& row : rows)
        out += fmt::format("{:<30} {:<30} {:<18} {}\n", row.leaf, row.dims,
                           row.kind == text ? "text" : row.unit, row.meaning);
    return out +
           "\n/run holds times, ranks, threads, host and dates; the result hash covers "
           "all "
           "but /run.\n";
}

}  // namespace bemcal::store
