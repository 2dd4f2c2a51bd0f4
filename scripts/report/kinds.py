"""What each kind of study has on a page: the one table of it.

A part has a heading, a function that gives pictures, tables and sentences of a study, and the datasets without which
it has nothing to say; all of them NaN is as none. A new picture is a function and a row here.
"""
from collections.abc import Callable
from dataclasses import dataclass

from report import chains, field, fronts, grids, meters, savings, screening, sobol, staged


@dataclass(frozen=True)
class Part:
    heading: str
    make: Callable             # (study) -> pictures, tables, sentences
    needs: tuple = ()


@dataclass(frozen=True)
class Kind:
    question: str
    parts: tuple


def part(heading, make, needs=""):
    return Part(heading, make, tuple(needs.split()))


METERS = part("Meters", meters.series)
INDICES = (part("Indices", sobol.indices, "output parameter first_order total_order"),
           part("Indices", sobol.outputs_map, "output parameter total_order"))
CONVERGENCE = (part("Convergence", chains.traces, "unknown rhat_rank"),
               part("Convergence", chains.ranks, "unknown rhat_rank"),
               part("Convergence", chains.table, "unknown posterior_mean posterior_sd rhat_rank ess_bulk ess_tail"))
PROGRAM = part("Runs of the program", chains.program, "simulator_run simulator_run_failure simulator_run_value "
                                                      "simulator_parameter")
KNOWN = (part("What is known of the unknowns", chains.densities, "unknown"),
         part("What is known of the unknowns", chains.pairs, "unknown"))

KINDS = {
    "loop": Kind("what does the building do that is not described?", ()),      # loop.html; read first
    "sensitivity": Kind("which inputs matter for a total?", (*INDICES, PROGRAM)),
    "office_hour_sensitivity": Kind("which inputs matter for one hour of an office?", INDICES),
    "hourly_sensitivity": Kind("which inputs matter in each hour?", (
        part("Indices", sobol.series_indices, "parameter series_first_order series_total_order"),
        part("By the clock", sobol.by_hour, "parameter time hourly_total_order hourly_variance"),
        part("By the clock", sobol.by_month, "parameter time hourly_total_order hourly_variance"))),
    "screening": Kind("which of many random points fit?", (
        part("Errors", screening.candidates, "metric meter period"),
        part("Points", screening.parameters, "points score parameter meter"),
        part("Points", screening.best_points, "best_parameters parameter parameter_least parameter_most"),
        part("Points", screening.held_out, "cv_rmse score meter period"),
        PROGRAM, METERS)),
    "grid": Kind("which combination of given values fits?", (
        part("Stages", grids.progress, "stage_distance stage_points ended_by"),
        part("Stages", grids.errors, "target"),
        part("Stages", grids.values, "parameter parameter_unit"),
        part("Stages", grids.indices, "parameter"),
        part("Stages", grids.roles, "parameter parameter_unit nearest_parameters"),
        PROGRAM)),
    "optimisation": Kind("which point fits best?", (
        part("Points", fronts.descent, "round_end round_best objective"),
        part("Points", fronts.fronts, "front_objective point_objective objective"),
        part("Points", fronts.parameters, "front_objective front_parameters parameter parameter_least parameter_most"),
        part("Points", fronts.ends, "at_bound parameter"),
        part("Points", fronts.aims, "target target_measured target_unit nearest_target_error"),
        part("Errors", screening.candidates, "metric meter period"),
        PROGRAM, METERS)),
    "stages": Kind("which point fits best, parameter by parameter, season by season?", (
        part("Values", staged.values, "calibration_stage parameter parameter_unit calibration_value "
                                      "calibration_least calibration_most"),
        part("Errors", staged.errors),
        part("Errors", staged.distributions),
        part("Errors", staged.share_table),
        part("Values in numbers", staged.table, "calibration_stage parameter parameter_unit calibration_start "
             "calibration_value calibration_sd calibration_least calibration_most calibration_at_bound"),
        PROGRAM, METERS)),
    "posterior": Kind("what is known after the data?", (
        *KNOWN,
        part("Functions", chains.functions, "function function_point_value"),
        part("Predictions", chains.fit_table),
        part("Predictions", chains.reading_ranks),
        *CONVERGENCE,
        PROGRAM, METERS)),
    "kennedy_ohagan": Kind("what is known after the data, by a statistical stand-in of the simulator?", (
        part("Predictions", field.errors, "field_cv_rmse field_cv_rmse_n1 field_nmbe"),
        part("Predictions", field.predictions, "field_measured process_mean"),
        part("Predictions", field.over_inputs, "field_measured process_mean process_q05 process_q95"),
        part("Predictions", field.discrepancy, "field_measured process_mean process_q05 process_q95 design_run"),
        *KNOWN, *CONVERGENCE)),
    "retrofit": Kind("what will a change save?", (
        part("Savings", savings.savings, "scenario output output_unit quantile saving_quantile before_quantile "
                                         "after_quantile"),
        part("Savings", savings.table, "scenario output output_unit saving_quantile saving_share_quantile "
                                       "before_quantile after_quantile"),
        part("Before and after", savings.before_and_after, "scenario output output_unit quantile before_quantile "
                                                           "after_quantile"),
        part("Before and after", savings.comfort, "scenario output output_unit quantile before_quantile "
                                                  "after_quantile"),
        PROGRAM)),
}
