/// The one table of what a result may hold: name, dimensions, unit and meaning of each
/// dataset, and the check of a dataset against it.
/// ArviZ's InferenceData for the groups of a posterior, else our own. Sizes and values
/// are not checked; writing is result_file's.
#include "store/layout.hpp"

#include "base/error.hpp"
#include "physics/quantities.hpp"
#include "store/dataset_path.hpp"

#include <iterator>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::store {
namespace {

constexpr auto number = Kind::number;
constexpr auto text = Kind::text;
constexpr const char* seconds = "seconds since 1970-01-01 00:00:00";
constexpr const char* own = "of the parameter";

constexpr LayoutRow own_rows[] = {
    // inputs
    {"input_file", "input_file", text, "", "files read, the job's own first"},
    {"content_hash", "input_file", text, "", "XXH3 hash of each file's content"},
    // what was found in the data of a building
    {"series", "decision", text, "", "meter or column with a finding"},
    {"finding", "decision", text, "", "what was found in it"},
    {"action", "decision", text, "", "what was done about it"},
    {"range_meter", "range", text, "", "meters of energy that a study fits"},
    {"range_period", "range", text, "", "the period of each"},
    {"range_measured", "range", number, "kWh", "what it shows there in all"},
    {"range_nominal", "range", number, "kWh",
     "what the building as described shows over the same readings"},
    {"range_least", "range", number, "kWh",
     "least that the model shows at points over its parameters' ranges"},
    {"range_most", "range", number, "kWh", "most that it shows there"},
    {"range_points", "range", number, "1", "so many points"},
    // every study
    {"parameter", "parameter", text, "", "names of the varied parameters"},
    {"parameter_unit", "parameter", text, "", "their units"},
    {"parameter_least", "parameter", number, own, "lower end of the range"},
    {"parameter_most", "parameter", number, own, "upper end of the range"},
    {"kind", "", text, "",
     "what kind of study it is, by the word of the job; stock: many buildings"},
    {"n_failed", "", number, "1", "simulations that failed"},
    {"failed_point", "failure", number, "1", "index in the study of each that failed"},
    {"failed_reason", "failure", text, "", "why it failed"},
    {"failed_item", "failed_item", number, "1",
     "items that failed as a whole, counted from 0; absent where none did"},
    {"failed_item_reason", "failed_item", text, "", "why, or that it took too long"},
    {"shortfall", "", text, "", "the target that was missed; absent where none was"},
    // a stock: its buildings, then lists of all of them; *_of is the building's index
    {"stock_building", "stock_building", text, "", "names of the buildings"},
    {"stock_status", "stock_building", text, "",
     "calibrated in this night; unchanged: kept from an earlier one; postponed: due, but "
     "the budget was spent; failed"},
    {"stock_cause", "stock_building", text, "",
     "why it was due: new, line, job, data: FILE; empty = it was not"},
    {"stock_reason", "stock_building", text, "", "why it failed"},
    {"stock_drift", "stock_building", text, "", "what drifts; empty = nothing"},
    {"stock_line_hash", "stock_building", text, "", "hash of its line and the template"},
    {"stock_job_hash", "stock_building", text, "", "hash of job and version"},
    {"stock_age", "stock_building", number, "1", "nights since it was worked on"},
    {"stock_simulations", "stock_building", number, "1",
     "of its last calibration, about"},
    {"stock_daily_start", "stock_building", number, "days since 1970-01-01",
     "first day of its daily sums"},
    {"stock_daily_n", "stock_building", number, "1", "how many daily sums it has"},
    {"stock_daily", "stock_days", number, "kWh",
     "daily sums of one meter of each building, one building after the other"},
    {"stock_files_of", "stock_files", number, "1", "index of the building"},
    {"stock_file", "stock_files", text, "", "a file it was read from"},
    {"stock_file_hash", "stock_files", text, "", "of its content; empty = missing"},
    {"stock_fits_of", "stock_fits", number, "1", "index of the building"},
    {"stock_fit_meter", "stock_fits", text, "", "the meter"},
    {"stock_fit_unit", "stock_fits", text, "", "its unit"},
    {"stock_fit_period", "stock_fits", text, "", "the period; the first is for training"},
    {"stock_fit_measured", "stock_fits", number, "of the meter", "sum of the readings"},
    {"stock_fit_n", "stock_fits", number, "1", "their number"},
    {"stock_fit_before", "stock_fits", number, "1",
     "CV(RMSE) where the calibration started: as described, or as of the last night"},
    {"stock_fit_cv_rmse", "stock_fits", number, "1", "CV(RMSE) where it ended"},
    {"stock_fit_nmbe", "stock_fits", number, "1", "NMBE where it ended"},
    {"stock_values_of", "stock_values", number, "1", "index of the building"},
    {"stock_value_parameter", "stock_values", text, "", "the parameter"},
    {"stock_value_unit", "stock_values", text, "", "its unit"},
    {"stock_value_least", "stock_values", number, own, "lower end of the range"},
    {"stock_value_most", "stock_values", number, own, "upper end of the range"},
    {"stock_value", "stock_values", number, own,
     "best point, posterior mean, or the loop's last fit"},
    {"stock_value_low", "stock_values", number, own,
     "least of the best points, or 5 % quantile"},
    {"stock_value_high", "stock_values", number, own,
     "largest of the best points, or 95 % quantile"},
    {"stock_value_moved", "stock_values", number, "1",
     "since the night before, of the range"},
    {"stock_findings_of", "stock_findings", number, "1", "index of the building"},
    {"stock_finding_series", "stock_findings", text, "", "meter or column"},
    {"stock_finding", "stock_findings", text, "", "what was found in it"},
    {"stock_finding_action", "stock_findings", text, "", "what was done about it"},
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
    // grid: the study, then each stage in a group of its own
    {"target", "target", text, "", "names of the outputs held against a measured value"},
    {"target_unit", "target", text, "", "their units"},
    {"target_measured", "target", number, "of the target", "their measured values"},
    {"target_scale", "target", number, "%",
     "error that counts as 1 in a scaled distance; 1 in a Euclidean one"},
    {"grid_distance", "", text, "", "euclidean or scaled"},
    {"stage_points", "grid_stage", number, "1", "points of each stage's grid"},
    {"stage_distance", "grid_stage", number, "% (1 where scaled)",
     "distance of the stage's nearest point"},
    {"stage_error", "grid_stage", number, "%", "its Euclidean error"},
    {"stage_target_error", "grid_stage target", number, "%", "its errors"},
    {"nearest_parameters", "parameter", number, own, "the nearest point of all"},
    {"nearest_target_error", "target", number, "%", "its errors"},
    {"ended_by", "", text, "", "why there is no further stage"},
    {"target_error_wanted", "", number, "%", "error at which it ends; 0 = none"},
    {"budget", "", number, "1", "points of all stages together at most"},
    {"grid_value", "grid_value", number, own, "values of the grid, by parameter"},
    {"grid_parameter", "grid_value", number, "1", "index of the parameter of each"},
    {"grid_points", "grid_point parameter", number, own, "the grid's points"},
    {"target_output", "grid_point target", number, "of the target",
     "what each gives; NaN = failed"},
    {"target_error", "grid_point target", number, "%",
     "simulated minus measured, of measured"},
    {"distance", "grid_point", number, "% (1 where scaled)",
     "distance to the reference point"},
    {"is_high_density", "grid_point", number, "1", "1 where density avoidance passes it"},
    {"neighbour", "neighbour", number, "1",
     "the k nearest with density avoidance: points of the stage, nearest first"},
    {"plain_neighbour", "plain_neighbour", number, "1", "the k nearest without it"},
    {"crowding_radius", "", number, "% (1 where scaled)",
     "radius in which density avoidance counts points"},
    {"crowding_threshold", "", number, "1 / radius^targets",
     "share of the points per volume above which it passes one"},
    {"n_values", "parameter", number, "1", "values of each parameter in the grid"},
    {"n_surviving", "parameter", number, "1", "of them, those that the k nearest keep"},
    {"parameter_role", "parameter", text, "",
     "open: several values survive; determined: one does, and the parameter matters; "
     "insensitive: one does, and it does not; held: it had one from the start"},
    {"grid_total_order", "target parameter", number, "1",
     "total-order Sobol index of the target's error over the stage's grid"},
    {"distance_total_order", "parameter", number, "1", "the same of the distance"},
    // screening
    {"meter", "meter", text, "", "names of the meters"},
    {"meter_unit", "meter", text, "", "their units"},
    {"period", "period", text, "", "names of the periods; the first is for training"},
    {"candidate", "candidate", text, "",
     "nominal and best; of a loop the effects that its last step ranked"},
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
    // optimisation
    {"objective", "objective", text, "", "f, or the meters whose errors are minimised"},
    {"objective_unit", "objective", text, "", "their units"},
    {"point_objective", "point objective", number, "of the objective",
     "of every point; NaN = failed or not admitted"},
    {"round_end", "round", number, "1", "points evaluated by the end of each round"},
    {"round_best", "round", number, "1", "the best objective by then"},
    {"front_parameters", "front parameter", number, own,
     "the best point, or those of the last generation that none dominates"},
    {"front_objective", "front objective", number, "of the objective",
     "their objectives"},
    {"at_bound", "parameter", number, "1",
     "-1 or 1 where the best point lies at the lower or upper end of the range"},
    {"measured", "time", number, "of the meter", "readings; NaN = missing or masked"},
    {"simulated", "candidate time", number, "of the meter",
     "the nominal and the best point"},
    // stages: the study, then for every stage and validation period a group of its own
    {"accuracy", "", number, "of the meter", "of the sensor, as the job says"},
    {"calibration_stage", "calibration_stage", text, "",
     "the stages, then at_once: all of their parameters on all of their periods"},
    {"calibration_from", "calibration_stage", text, "", "whose values each starts from"},
    {"calibration_objective", "calibration_stage", number, "1", "the best it found"},
    {"calibration_evaluations", "calibration_stage", number, "1", "points simulated"},
    {"calibration_start", "calibration_stage parameter", number, own,
     "values carried over"},
    {"calibration_value", "calibration_stage parameter", number, own,
     "values after the stage"},
    {"calibration_least", "calibration_stage parameter", number, own,
     "its range; NaN = not calibrated by it"},
    {"calibration_most", "calibration_stage parameter", number, own, "its upper end"},
    {"calibration_at_bound", "calibration_stage parameter", number, "1",
     "-1 or 1 where the value lies at the lower or upper end of the range"},
    {"calibration_sd", "calibration_stage parameter", number, own,
     "standard deviation of the estimate, from residuals that follow each other, the "
     "range included; NaN = none"},
    {"version", "version", text, "",
     "values that the periods are simulated with: of the building as described, before "
     "and after a stage, of all parameters at once, of a study beside"},
    {"version_fit", "version meter metric", number, "1 (rmse: of the meter)",
     "errors over the periods taken together"},
    {"share_within_half", "version meter", number, "1",
     "share of the readings whose error is at most 0.5"},
    {"share_within_accuracy", "version meter", number, "1",
     "the same for the sensor's accuracy"},
    {"error_level", "error_level", number, "of the meter", "absolute errors"},
    {"error_share", "version meter error_level", number, "1",
     "share of the readings whose error is at most that: its cumulative distribution"},
    {"simulated", "version time", number, "of the meter", "each version's series"},
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
    {"calibrated_input", "calibrated_input", text, "",
     "names of the calibrated inputs, where the runs were made by the job"},
    {"design_values", "design calibrated_input", number, "of the input", "their values"},
    {"design_run", "design field_point", number, "of the output",
     "the simulator's answers; NaN = failed"},
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
    {"month", "month", number, seconds, "begins of months"},
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
    // loop: its channels are the meters it learns from
    {"channel", "channel", text, "", "names of the measured channels"},
    {"channel_unit", "channel", text, "", "their units"},
    {"model", "model", text, "",
     "plain: the calibrated standard; before: with its structure chosen; after: with the "
     "effects found"},
    {"fit", "model period resolution channel metric", number, "1 (rmse: of the channel)",
     "errors of the three models; NaN where nothing is measured"},
    {"parameter_prior_mean", "parameter", number, own, "NaN = no prior"},
    {"parameter_prior_sd", "parameter", number, own, "its standard deviation"},
    {"parameter_value", "model parameter", number, own, "calibrated values"},
    {"parameter_sd", "model parameter", number, own, "their standard deviation"},
    {"structure", "structure", text, "", "refinements of the model that were tried"},
    {"structure_score", "structure", number, "1",
     "their cross-validated score in training; smaller is better"},
    {"structure_chosen", "", text, "", "the one that the search starts from"},
    {"decision_series", "decision", text, "",
     "channel with a finding, or effect of one class with parameters"},
    {"decision_finding", "decision", text, "", "what was found in it, or the class"},
    {"decision_action", "decision", text, "", "what was done about it"},
    {"decision_kind", "decision", text, "",
     "data: of readings or weather; class: an effect that they cannot tell from "
     "parameters; period: what was not predicted there; parameter: where a calibration "
     "ended"},
    {"function", "function", text, "", "a function without a name: where, and of what"},
    {"function_hook", "function", text, "", "where it enters"},
    {"function_driver", "function", text, "", "what it follows"},
    {"function_unit", "function", text, "", "unit of its size"},
    {"function_driver_unit", "function", text, "",
     "of what it follows; of hours and another that of the other"},
    {"function_size", "function", number, "of the function",
     "root mean square over the training period"},
    {"function_evidence", "function", number, "1",
     "log marginal likelihood that it brings"},
    {"function_point_of", "function_point", number, "1", "index of the function"},
    {"function_point_at", "function_point", number, "of what it follows",
     "where that is; of the hour of the week 24 hours of working days, of Saturdays, of "
     "Sundays and holidays; of time years since training began"},
    {"function_point_and_at", "function_point", number, "of what it follows",
     "the same of the other thing that it follows; NaN = none"},
    {"function_point_value", "function_point", number, "of the function",
     "its value there; straight between points"},
    {"function_point_least", "function_point", number, "of the function",
     "begin of its 90 % interval"},
    {"function_point_most", "function_point", number, "of the function",
     "end of its 90 % interval"},
    {"learned_schedule", "learned_schedule", text, "",
     "schedules whose hours nobody wrote down (hours = \"learn\")"},
    {"learned_schedule_use", "learned_schedule", text, "",
     "the use whose usual hours the search began from, and plain has"},
    {"learned_schedule_sentence", "learned_schedule", text, "", "its hours in words"},
    {"learned_schedule_evidence", "learned_schedule", number, "1",
     "fall of -2 log likelihood from the usual hours to the learned ones, of all "
     "schedules together"},
    {"learned_hours_of", "learned_hours", number, "1", "index of the schedule"},
    {"learned_hours_days", "learned_hours", text, "", "kind of days"},
    {"learned_hours_from", "learned_hours", number, "h",
     "the schedule is 1 from here on"},
    {"learned_hours_until", "learned_hours", number, "h",
     "until here; both 0: never on such days"},
    {"learned_hours_probability", "learned_hours", number, "1",
     "of just these hours, among all pairs"},
    {"learned_hours_from_least", "learned_hours", number, "h",
     "begin of its 90 % interval, of pairs that are not off"},
    {"learned_hours_from_most", "learned_hours", number, "h", "end of it"},
    {"learned_hours_until_least", "learned_hours", number, "h",
     "begin of its 90 % interval, of pairs that are not off"},
    {"learned_hours_until_most", "learned_hours", number, "h", "end of it"},
    {"learned_hours_usual_from", "learned_hours", number, "h", "of its use"},
    {"learned_hours_usual_until", "learned_hours", number, "h", "of its use"},
    {"power_effect", "power", text, "", "effects that could be sought in these data"},
    {"power_detectability", "power", number, "1",
     "of a middling one, in standard errors: below least_detectability it cannot be "
     "seen"},
    {"power_visibility", "power", number, "1",
     "share of its signature, where it is small, that no parameter can take over"},
    {"power_alias", "power", text, "", "the effect or parameter that is most like it"},
    {"power_alias_kind", "power", text, "",
     "effect: another effect; same: a parameter, in every reading; parameters: other "
     "values of those that are calibrated"},
    {"power_alias_correlation", "power", number, "1",
     "of their signatures; from same_signature on they cannot be told apart"},
    {"power_bias_parameter", "power", text, "", "the parameter that it would bias most"},
    {"power_bias", "power", number, "1",
     "by so much, in standard deviations of that parameter's prior, if left out"},
    {"least_detectability", "", number, "1", "below it an effect cannot be seen"},
    {"same_signature", "", number, "1",
     "correlation from which two signatures cannot be told apart"},
    {"hook", "hook", text, "", "places where an effect can enter"},
    {"driver", "driver", text, "", "what an effect can follow"},
    {"localisation", "hook driver", number, "1",
     "fluctuation of the residual seen from the hook, ordered by the driver, over its "
     "99 % quantile without effects: above 1 is more than chance shows"},
    {"localisation_after", "hook driver", number, "1", "the same with the effects found"},
    {"step_effect", "step", text, "", "effects that were judged, in this order"},
    {"step_verdict", "step", text, "",
     "accepted, or why not; the last says why the search ended"},
    {"step_gain", "step", number, "1", "gain of evidence, in -2 log"},
    {"step_threshold", "step", number, "1", "the gain that was needed"},
    {"step_score", "step", number, "1", "change of the cross-validated log score"},
    {"step_error", "step channel", number, "1",
     "relative change of the error in blocks of training that were left out"},
    {"effect", "effect", text, "", "names of the effects found"},
    {"effect_hook", "effect", text, "", "where each enters"},
    {"effect_driver", "effect", text, "", "what it follows"},
    {"effect_shape", "effect", text, "", "that, how and when, in words"},
    {"effect_gate", "effect", text, "", "when"},
    {"effect_unit", "effect", text, "", "unit of its coefficient"},
    {"effect_coefficient", "effect", number, "of the effect", "as calibrated"},
    {"effect_least", "effect", number, "of the effect", "begin of its 90 % interval"},
    {"effect_most", "effect", number, "of the effect", "end of its 90 % interval"},
    {"effect_gain", "effect", number, "1", "gain of evidence, in -2 log"},
    {"effect_adequate", "effect", number, "1",
     "1 where its evidence is three times what noise shows, nothing comes near it and "
     "the pattern that pointed to it is gone with it; 0 = the name is the nearest one"},
    {"effect_doubt", "effect", text, "", "why it is not adequate"},
    {"effect_class", "effect", text, "",
     "itself and effects that these data cannot tell it from, parted by semicolons"},
    {"effect_class_of", "class_member", number, "1", "index of the effect"},
    {"effect_class_member", "class_member", text, "",
     "itself or an effect that these data cannot tell it from"},
    {"effect_separates", "effect", text, "", "the measurement that would"},
    {"effect_section", "effect", text, "", "the section that declares it in a job"},
    {"effect_value_of", "effect_value", text, "",
     "a meter, cost or CO2: what it is counted in"},
    {"effect_value_effect", "effect_value", number, "1", "index of the effect"},
    {"effect_value_unit", "effect_value", text, "",
     "per year where training is about one"},
    {"effect_value", "effect_value", number, "of effect_value_unit",
     "with the effect less without it, all else as it is"},
    {"effect_value_least", "effect_value", number, "of effect_value_unit",
     "lower end of its 90 % interval"},
    {"effect_value_most", "effect_value", number, "of effect_value_unit", "upper end"},
    {"coverage", "period resolution channel", number, "1",
     "share of the readings within the 90 % intervals of after"},
    {"job_part", "job_part", text, "",
     "what else of the model a job can have: its structure, hours, functions"},
    {"job_part_section", "job_part", text, "", "the section that says it"},
    {"measurement", "measurement", text, "",
     "what to read by the hour, beside the meters that there are"},
    {"measurement_question", "measurement", text, "",
     "what the readings leave open: two names, or a parameter"},
    {"measurement_kind", "measurement", text, "", "name or parameter"},
    {"measurement_from", "measurement", text, "",
     "first day of the weeks of the year that tell most"},
    {"measurement_weeks", "measurement", number, "weeks", "for how long"},
    {"measurement_now", "measurement", number, "1",
     "of a name the chance that the likelier one is right; of a parameter its standard "
     "deviation, as a share of its prior's"},
    {"measurement_then", "measurement", number, "1", "the same after the measurement"},
    {"measurement_advised", "measurement", number, "1",
     "1: the cheapest that is enough for the question, or else the one that tells most"},
    {"candidate_gain", "candidate", number, "1",
     "gain of evidence of each, in the last step's ranking"},
    {"unexplained", "channel", number, "1",
     "share of the squared residual that hour of the week and hour of the day by month "
     "predict, in every other block of training from the blocks between"},
    {"unexplained_where", "channel", text, "", "month and hour where most of it lies"},
    {"misfit", "", number, "1",
     "evidence of the best candidate that did not pass over what noise alone would show, "
     "at least 1: the factor on the variances of parameters and coefficients"},
    {"simulated", "model time", number, "of the channel", "every hour, measured or not"},
    // loop around another program
    {"simulator_parameter", "simulator_parameter", text, "",
     "parameters of the program, which its runs are calibrated in"},
    {"simulator_parameter_unit", "simulator_parameter", text, "", "their units"},
    {"simulator_parameter_least", "simulator_parameter", number,
     "of simulator_parameter_unit", "lower end of the range"},
    {"simulator_parameter_most", "simulator_parameter", number,
     "of simulator_parameter_unit", "upper end"},
    {"simulator_parameter_plain", "simulator_parameter", number,
     "of simulator_parameter_unit", "in the run that is plain: nominal"},
    {"simulator_parameter_before", "simulator_parameter", number,
     "of simulator_parameter_unit", "in the best run without effects"},
    {"simulator_parameter_after", "simulator_parameter", number,
     "of simulator_parameter_unit", "in the best run of all"},
    {"simulator_given", "simulator_given", text, "",
     "effects that were given to the program; functions are one"},
    {"simulator_given_hooks", "simulator_given", text, "", "what they change"},
    {"simulator_given_scale", "simulator_given", number, "1",
     "in the run that is after, times what was found; 0 = without it"},
    {"simulator_series_of", "simulator_series", text, "",
     "the effect of which it is, as it was given in the run that is after"},
    {"simulator_series_hook", "simulator_series", text, "", "what it changes"},
    {"simulator_series_unit", "simulator_series", text, "", "of its values"},
    {"simulator_series_enters", "simulator_series", text, "",
     "add: it is added; factor: what is there is multiplied by 1 + value"},
    {"simulator_series_facade", "simulator_series", text, "", "where it is at one"},
    {"simulator_series_meter", "simulator_series", text, "", "where it is at one"},
    {"simulator_series_value", "simulator_series simulator_hour", number,
     "of simulator_series_unit", "hours of all periods, one period after the other"},
    {"simulator_left_out", "simulator_left_out", text, "",
     "what the program could not take, in its own words"},
    {"simulator_run", "simulator_run", text, "",
     "runs in their order: design, calibration, effects, refinement"},
    {"simulator_run_failure", "simulator_run", text, "",
     "why it failed; empty = it did not"},
    {"simulator_run_distance", "simulator_run", number, "1",
     "from the readings of training: deviance less that of the best run"},
    {"simulator_channel", "simulator_channel", text, "", "meters that are learned from"},
    {"simulator_emulator_error", "simulator_channel", number, "%",
     "CV(RMSE) of readings in runs that the emulator had not seen"},
    {"month_predicted", "month", number, "of the channel",
     "of all hours of a month, read or not: their sum, of a temperature their mean"},
    {"month_q05", "month", number, "of the channel", "its 90 % interval"},
    {"month_q95", "month", number, "of the channel", "upper end"},
    // retrofit: its outputs are energies [kWh] and hours too cold or too warm [h]
    {"scenario", "scenario", text, "", "names of the scenarios"},
    {"points_of", "", text, "", "the study whose points they are applied to"},
    {"comfort_limit", "limit", number, "degC", "too cold below, too warm above"},
    {"described", "variant output", number, "of the output",
     "the building as described: before, then after each scenario"},
    {"before", "point output", number, "of the output", "each point; NaN = failed"},
    {"after", "scenario point output", number, "of the output", "the same afterwards"},
    {"quantile", "quantile", number, "1", "levels of the quantiles over the points"},
    {"before_quantile", "quantile output", number, "of the output", "before"},
    {"after_quantile", "scenario quantile output", number, "of the output", "after"},
    {"saving_quantile", "scenario quantile output", number, "of the output",
     "before less after, point by point"},
    {"saving_share_quantile", "scenario quantile output", number, "1",
     "the same over before"},
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
};

/// With the quantities by step.
std::vector<LayoutRow> all_rows() {
    std::vector<LayoutRow> all(std::begin(own_rows), std::end(own_rows));
    for (const physics::QuantityRow& row : physics::quantity_rows)
        all.push_back({row.name, "candidate time", number, row.unit, row.meaning});
    return all;
}

/// A * at the end of a pattern stands for anything but another level.
bool matches(std::string_view pattern, std::string_view name) {
    if (!pattern.ends_with('*')) return pattern == name;
    pattern.remove_suffix(1);
    return name.starts_with(pattern) &&
           name.find('/', pattern.size()) == std::string_view::npos;
}

std::string dims_of(const study::Dataset& dataset) {
    return fmt::format("{}", fmt::join(dataset.dims, " "));
}

bool is_of_kind(const study::Dataset& dataset, const LayoutRow& row) {
    return row.kind == text ? dataset.values.empty() : dataset.texts.empty();
}

}  // namespace

std::span<const LayoutRow> layout() {
    static const std::vector<LayoutRow> rows = all_rows();
    return rows;
}

const LayoutRow* known_layout(const study::Dataset& dataset) {
    const std::string leaf = leaf_of(dataset.path);
    const std::string inner = leaf_of(group_of(dataset.path)) + "/" + leaf;
    const std::string dims = dims_of(dataset);
    const LayoutRow* row = nullptr;
    for (const LayoutRow& each : layout()) {
        if (!matches(each.leaf, leaf) && !matches(each.leaf, inner)) continue;
        row = &each;
        if (matches(each.dims, dims)) break;
    }
    return row;
}

bool is_as(const study::Dataset& dataset, const LayoutRow& row) {
    return matches(row.dims, dims_of(dataset)) && is_of_kind(dataset, row);
}

const LayoutRow& layout_of(const study::Dataset& dataset) {
    const LayoutRow* row = known_layout(dataset);
    if (row == nullptr)
        throw std::logic_error("no row in the layout table for dataset " + dataset.path);
    if (!matches(row->dims, dims_of(dataset)))
        throw std::logic_error(fmt::format("dataset {} has dimensions '{}', not '{}'",
                                           dataset.path, dims_of(dataset), row->dims));
    if (!is_of_kind(dataset, *row))
        throw std::logic_error("dataset " + dataset.path + " is of the wrong kind");
    return *row;
}

std::string describe_results() {
    std::string out = fmt::format("{:<30} {:<30} {:<18} {}\n", "dataset", "dimensions",
                                  "unit", "meaning");
    for (const LayoutRow& row : layout())
        out += fmt::format("{:<30} {:<30} {:<18} {}\n", row.leaf, row.dims,
                           row.kind == text ? "text" : row.unit, row.meaning);
    return out +
           "\n/run holds times, ranks, threads, host and dates; the result hash covers "
           "all "
           "but /run.\n";
}

}  // namespace bemcal::store
