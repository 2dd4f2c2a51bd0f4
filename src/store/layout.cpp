#include "store/layout.hpp"

#include "base/error.hpp"

#include <algorithm>

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
    const auto row =
        std::ranges::find_if(rows, [&](const LayoutRow& r) { return r.leaf == leaf; });
    const std::string dims = fmt::format("{}", fmt::join(dataset.dims, " "));
    if (row == std::end(rows))
        throw std::logic_error("no row in the layout table for dataset " + dataset.path);
    if (dims != row->dims)
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
