/// Declares the schema's rows that say what is to be done: studies with their parts,
/// scenarios, output, another program as simulator.
/// Follows from papers 1 to 3 where they give a default (0.05, 0.7 and 0.3, k = 7).
/// Leaves out rows of the job and its buildings (`key_table`), and rules between keys,
/// which the readers check.
#include "schema/schema.hpp"
#include "schema/words.hpp"

namespace bemcal::schema {

namespace {

constexpr const char* required = nullptr;

constexpr Key table[] = {
    // studies
    {"study", "kind", Type::choice,
     "sensitivity|hourly_sensitivity|office_hour_sensitivity|screening|posterior|"
     "kennedy_ohagan|loop|optimisation|retrofit|grid|stages",
     required, 0, 0, ""},
    {"study", "name", Type::text, "", "", 0, 0, "Default: the kind."},
    {"study", "period", Type::text, "", "", 0, 0,
     "Of a sensitivity, posterior, loop or grid; default: the first period."},
    {"study", "quantities", Type::texts, "", "", 0, 0,
     "Of a sensitivity: totals (means) over the period; default: heating and cooling."},
    {"study", "quantity", Type::choice, quantities, "heating", 0, 0,
     "Of an hourly sensitivity."},
    {"study", "n_base", Type::integer, "", "1024", 2, 1 << 24,
     "Base points N of Saltelli's N (d + 2); a power of two is best."},
    {"study", "scramble", Type::flag, "", "true", 0, 0, "Of the Sobol sequence."},
    {"study", "n_bootstrap", Type::integer, "", "1000", 0, 100000, "For the intervals."},
    {"study", "threshold", Type::number, "-", "0.05", 0, 1,
     "Total-order index above which an input counts as sensitive; of a grid, above which "
     "a fixed parameter counts as determined."},
    {"study", "n_points", Type::integer, "", "4096", 1, 1 << 30, "Of a screening."},
    {"study", "points_per_item", Type::integer, "", "1024", 1, 1 << 20,
     "Of a screening: points that are handed out together; of a grid 128."},
    {"study", "keep_points", Type::flag, "", "true", 0, 0,
     "Of a screening: store every point, not the best only."},
    {"study", "n_best", Type::integer, "", "20", 1, 100000, "Of a screening."},
    {"study", "fixed", Type::table, "", "", 0, 0, "[study.fixed]"},
    {"study", "parameters", Type::texts, "", "", 0, 0,
     "Of a posterior, loop or optimisation: names of the parameters that it calibrates, "
     "the others "
     "stay nominal; default: all."},
    {"study", "meters", Type::texts, "", "", 0, 0,
     "Of a posterior, loop or optimisation: names of the meters it learns from; default: "
     "all with "
     "readings."},
    {"study", "sampler", Type::choice, "nuts|random_walk|gibbs", "nuts", 0, 0,
     "Of a posterior. nuts: Hamiltonian, with derivatives; the others: Metropolis steps "
     "of "
     "all parameters together, or of one after the other."},
    {"study", "n_chains", Type::integer, "", "16", 1, 100000, "Of a posterior."},
    {"study", "warm_up", Type::integer, "", "500", 1, 1000000,
     "Of a posterior: first transitions of a chain, which adapt it and are not kept."},
    {"study", "draws_per_round", Type::integer, "", "100", 2, 1000000,
     "Of a posterior: draws of each chain between two looks at the targets."},
    {"study", "most_draws", Type::integer, "", "4000", 2, 100000000,
     "Of a posterior: per chain; the budget."},
    {"study", "thin", Type::integer, "", "1", 1, 100000,
     "Of a posterior: transitions per draw that is kept."},
    {"study", "target_rhat", Type::number, "-", "1.01", 1, 100,
     "Of a posterior: rank R-hat of every unknown is to be at most this."},
    {"study", "target_ess", Type::number, "", "400", 0, 1e9,
     "Of a posterior: effective draws, bulk and tail, of every unknown at least."},
    {"study", "temperatures", Type::numbers, "", "", 1, 1e9,
     "Of a posterior: [1, 2, 4, 8] runs each chain at all of these and swaps between "
     "them; "
     "default: 1 alone; of a kennedy_ohagan [1, 1.82, 3.33]."},
    {"study", "autocorrelated", Type::flag, "", "true", 0, 0,
     "Of a posterior: residuals remember the one before, AR(1); false: white noise."},
    {"study", "proportional", Type::flag, "", "true", 0, 0,
     "Of a posterior: residuals have a part in proportion to the prediction, beside the "
     "constant one; false: where a model wrong in shape would predict too little, as "
     "that "
     "makes the residuals' scale small."},
    {"study", "discrepancy", Type::flag, "", "false", 0, 0,
     "Of a posterior: a share of the residuals is slow: the model's own error."},
    {"study", "hold_out_weeks", Type::number, "-", "0", 0, 0.9,
     "Of a posterior: share of the training period's whole weeks kept for judging."},
    {"study", "hold_out_hours", Type::number, "-", "0", 0, 0.9,
     "Of a posterior: share of its other readings, drawn at random, kept for judging."},
    {"study", "level_change", Type::number, "-", "0", 0, 1,
     "Of a posterior: use and operation change from year to year. In other periods than "
     "the training one energies are predicted times an unknown factor; this is the "
     "standard deviation of its logarithm after a year, growing with the root of time."},
    {"study", "lasting_weeks", Type::number, "weeks", "0", 0, 26,
     "Of a posterior without discrepancy: predictions of other periods have errors that "
     "last for about so long, beside short ones; their share is what the training "
     "period's residuals show; 0: none."},
    {"study", "reading_weight", Type::number, "-", "1", 1e-6, 1,
     "Of a posterior: the likelihood is raised to this power; 0.006, a week of hours for "
     "one, where errors last for long in ways that the residuals do not know."},
    {"study", "n_predictive", Type::integer, "", "200", 1, 1000000,
     "Of a posterior: draws that are simulated for predictions; of a kennedy_ohagan "
     "1000."},
    {"study", "pooling", Type::choice, "none|full|partial", "none", 0, 0,
     "Of a posterior. none: each building by itself; full: one value of each parameter "
     "for "
     "all; partial: each building has its own, drawn from a common population."},
    {"study", "unseen", Type::texts, "", "", 0, 0,
     "Of a pooled posterior: buildings that are predicted, but not learned from."},
    {"study", "field", Type::text, "", required, 0, 0,
     "Of a kennedy_ohagan: CSV file of measurements, a row for each, with their known "
     "inputs."},
    {"study", "field_output", Type::text, "", required, 0, 0,
     "Of a kennedy_ohagan: column of the measurements."},
    {"study", "inputs", Type::texts, "", required, 0, 0,
     "Of a kennedy_ohagan: columns of the known inputs x, in both files."},
    {"study", "calibrated", Type::texts, "", required, 0, 0,
     "Of a kennedy_ohagan: the calibrated inputs t, columns of the runs; uniform over "
     "the runs' range where [study.prior] does not say."},
    {"study", "runs", Type::text, "", "", 0, 0,
     "Of a kennedy_ohagan: CSV file of simulator runs: output, inputs, calibrated; "
     "cheapest where every design of the calibrated is run at all field points."},
    {"study", "runs_output", Type::text, "", "", 0, 0,
     "Of a kennedy_ohagan: column of the runs' output; default: field_output."},
    {"study", "output_factor", Type::number, "-", "1", -1e9, 1e9,
     "Of a kennedy_ohagan: on both outputs: value x factor + offset."},
    {"study", "output_offset", Type::number, "", "0", -1e9, 1e9, ""},
    {"study", "output_unit", Type::text, "", "kWh", 0, 0,
     "Of a kennedy_ohagan: of the output, for tables."},
    {"study", "simulator", Type::choice, "office_hour|command", "", 0, 0,
     "Of a kennedy_ohagan, in place of runs: designs are simulated at all field points. "
     "office_hour: paper 1's hour; inputs, calibrated and [study.fixed] name its 19 "
     "inputs. command: the job's [simulator]; parameters that are neither in inputs nor "
     "calibrated stay nominal, runs_output is one of its outputs."},
    {"study", "n_designs", Type::integer, "", "100", 2, 10000,
     "Of a kennedy_ohagan with a simulator: scrambled Sobol points."},
    {"study", "prior", Type::table, "", "", 0, 0, "[study.prior]"},
    {"study", "hyperpriors", Type::choice, "chong|paper", "chong", 0, 0,
     "Of a kennedy_ohagan. chong: correlations Beta(1, 0.3), as bc-stan has them; paper: "
     "Beta(1, 0.5) of the emulator and Beta(1, 0.4) of the discrepancy, paper 1, Table "
     "7. "
     "Precisions Gamma(10, 10), Gamma(10, 0.3), Gamma(10, 0.03) in both."},
    {"study", "regression_factor", Type::flag, "", "false", 0, 0,
     "Of a kennedy_ohagan: the emulator is multiplied by an unknown rho ~ N(1, 0.25)."},
    {"study", "mean", Type::choice, "none|constant|linear", "none", 0, 0,
     "Of a kennedy_ohagan: of emulator and discrepancy, with flat priors; linear in x."},
    {"study", "mean_coefficients", Type::choice, "integrated|sampled", "integrated", 0, 0,
     "Of a kennedy_ohagan with a mean: integrated out, or unknowns as all others."},
    {"study", "form", Type::choice, "auto|dense|kronecker", "auto", 0, 0,
     "Of a kennedy_ohagan: of the covariance; auto: kronecker where the runs are a full "
     "grid."},
    {"study", "most_effects", Type::integer, "", "6", 0, 20,
     "Of a loop: so many effects are accepted at most; 0 only shows what could be seen."},
    {"study", "try_structures", Type::flag, "", "true", 0, 0,
     "Of a loop: before effects are sought, refinements of the model's structure are "
     "tried, and the one that predicts best is kept; false: the structure as described."},
    {"study", "block_days", Type::number, "d", "14", 2, 90,
     "Of a loop: the training period is cut into blocks of this length; what is accepted "
     "must predict blocks that were kept from it."},
    {"study", "least_gain", Type::number, "%", "2", 0, 100,
     "Of a loop: by so much an effect must lower the errors of the meters in those "
     "blocks, as their mean; three times as much where it is not of the catalogue."},
    {"study", "most_loss", Type::number, "%", "1", 0, 100,
     "Of a loop: by so much it may raise the error of any meter there; by 15 % of what "
     "the best meter gains, where that is more (30 % with evidence of eight times what "
     "noise shows)."},
    {"study", "alpha", Type::number, "-", "0.01", 0.0001, 0.5,
     "Of a loop: chance that noise alone shows as much evidence as is asked for, in any "
     "of the effects that one step refits (the best by the tangent, 36 at most), not of "
     "all that it screens."},
    {"study", "exclude", Type::texts, "", "", 0, 0,
     "Of a loop: names of effects that are not to be tried (describe effects)."},
    {"study", "generic", Type::flag, "", "true", 0, 0,
     "Of a loop: effects beside the catalogue's are tried, too: any place, what it "
     "follows, how and when."},
    {"study", "columns", Type::texts, "", "", 0, 0,
     "Of a loop: names of [[series]] that an effect beside the catalogue's may follow: "
     "rain, carbon dioxide, a tariff."},
    {"study", "of", Type::text, "", required, 0, 0,
     "Of a retrofit: name of a posterior, screening or grid above, whose draws or best "
     "points the scenarios are applied to (n_predictive of them at most)."},
    {"study", "occupied", Type::text, "", "", 0, 0,
     "Of a retrofit: [[schedule]] by which hours count as too cold or too warm, from 0.5 "
     "on; default: all hours."},
    {"study", "too_cold", Type::number, "degC", "19", -50, 100,
     "Of a retrofit: an occupied hour below it (by 0.05 K) is too cold."},
    {"study", "too_warm", Type::number, "degC", "26", -50, 100,
     "Of a retrofit: an occupied hour above it (by 0.05 K) is too warm."},
    // retrofit
    {"scenario", "name", Type::text, "", required, 0, 0, ""},
    {"scenario", "change", Type::tables, "", "", 0, 0,
     "[[scenario.change]]; none: the building stays as it is."},
    {"scenario", "heating_carrier", Type::choice, carriers, "", 0, 0,
     "Another plant: the meter that heating is on afterwards."},
    {"scenario.change", "target", Type::texts, "", required, 0, 0,
     "As of a [[parameter]]: \"construction.wall.u_value\", "
     "\"glazing.*.solar_transmittance\", \"zone.*.flow.infiltration.air_change\", "
     "\"zone.*.flow.ventilation.heat_recovery\", \"plant.heating_efficiency\", "
     "\"zone.*.heating_set_point\"."},
    {"scenario.change", "value", Type::number, "", "", -1e9, 1e9, "It becomes this."},
    {"scenario.change", "factor", Type::number, "-", "", 0, 1e6,
     "What is there is multiplied by it."},
    {"scenario.change", "offset", Type::number, "", "", -1e9, 1e9,
     "Is added to what is there."},
    {"scenario.change", "insulation", Type::number, "m", "", 0, 5,
     "Of a u_value: thickness of a layer that is added."},
    {"scenario.change", "conductivity", Type::number, "W/(m K)", "", 0.001, 10,
     "Of that layer."},
    // optimisations
    {"study", "method", Type::choice, "swarm_then_pattern|swarm|pattern|nsga2",
     "swarm_then_pattern", 0, 0,
     "Of an optimisation: particle swarm with constriction on a mesh, then Hooke-Jeeves "
     "pattern search; one of them alone; or NSGA-II, with the error of each meter as an "
     "objective."},
    {"study", "objective", Type::choice, "percent|fraction|likelihood|rmsd", "percent", 0,
     0,
     "Of an optimisation, summed over the meters: cv_weight CV(RMSE) + r2_weight (1 - "
     "R2), CV(RMSE) in per cent (as paper 2 prints it) or as a fraction; likelihood: "
     "minus the log likelihood of independent normal errors; rmsd: root mean square."},
    {"study", "cv_weight", Type::number, "-", "0.7", 0, 1e6, "Of an optimisation."},
    {"study", "r2_weight", Type::number, "-", "0.3", 0, 1e6, "Of an optimisation."},
    {"study", "meter_weights", Type::numbers, "-", "", 0, 1e9,
     "Of an optimisation: one for each name in meters; default: 1."},
    {"study", "resolution", Type::choice, "own|monthly", "own", 0, 0,
     "Of an optimisation: readings are compared as they are, or by calendar month."},
    {"study", "errors", Type::choice, "absolute|signed|cv_rmse", "absolute", 0, 0,
     "Of nsga2: of each meter's total over the period; signed: minimised among points "
     "that are not below the measured total; cv_rmse: of its readings."},
    {"study", "evaluations", Type::integer, "", "5000", 1, 1e9,
     "Of an optimisation: the budget; not of nsga2."},
    {"study", "n_particles", Type::integer, "", "32", 2, 100000, "Of a swarm."},
    {"study", "restart", Type::flag, "", "true", 0, 0,
     "Of swarm_then_pattern: goes on from the best point with some parameters drawn "
     "anew, again and again until the budget is spent; false: ends after the first "
     "pattern search, as GenOpt does."},
    {"study", "n_population", Type::integer, "", "100", 4, 100000, "Of nsga2; even."},
    {"study", "n_generations", Type::integer, "", "50", 1, 1000000, "Of nsga2."},
    // stages
    {"study", "validation", Type::tables, "", "", 0, 0, "[[study.validation]]"},
    {"study", "at_once", Type::flag, "", "true", 0, 0,
     "Of stages: beside them all of their parameters are calibrated at once, on all of "
     "their periods."},
    {"study", "at_once_evaluations", Type::integer, "", "", 1, 1e9,
     "Its budget; default: that of all stages together."},
    {"study", "accuracy", Type::number, "", "0.35", 0, 1e9,
     "Of stages: of the sensor, in the meter's unit; the share of readings within it is "
     "told."},
    {"study", "independent_hours", Type::number, "h", "0", 0, 8760,
     "Of stages with objective = \"likelihood\": errors nearer than this count as one, "
     "and the priors of what is calibrated count beside them; 0: every reading counts, "
     "and no prior does."},
    {"study", "beside", Type::texts, "", "", 0, 0,
     "Of stages: names of studies above (posterior, optimisation, screening) whose mean "
     "or best point is judged on the same periods."},
    {"study.calibration_stage", "name", Type::text, "", required, 0, 0, ""},
    {"study.calibration_stage", "periods", Type::texts, "", required, 0, 0,
     "It calibrates on these, taken together."},
    {"study.calibration_stage", "parameters", Type::texts, "", required, 0, 0,
     "It calibrates these; the others keep the values carried over."},
    {"study.calibration_stage", "from", Type::text, "", "", 0, 0,
     "Stage whose values it starts from, or \"initial\"; default: the one before."},
    {"study.calibration_stage", "around", Type::number, "-", "", 0, 100,
     "Range: this share of the value carried over, up and down, within the parameter's; "
     "default: the parameter's."},
    {"study.calibration_stage", "ranges", Type::table, "", "", 0, 0, "[study.ranges]"},
    {"study.calibration_stage", "set", Type::table, "", "", 0, 0, "[study.set]"},
    {"study.calibration_stage", "evaluations", Type::integer, "", "", 1, 1e9,
     "These and the following default to the study's."},
    {"study.calibration_stage", "seed", Type::integer, "", "", 0, 1e15, ""},
    {"study.calibration_stage", "meters", Type::texts, "", "", 0, 0, ""},
    {"study.calibration_stage", "meter_weights", Type::numbers, "-", "", 0, 1e9, ""},
    {"study.calibration_stage", "objective", Type::choice,
     "percent|fraction|likelihood|rmsd", "", 0, 0, ""},
    {"study.validation", "period", Type::text, "", required, 0, 0,
     "That no stage calibrates on."},
    {"study.validation", "stage", Type::text, "", "", 0, 0,
     "Whose values it is judged with; default: the last."},
    // output
    {"output", "file", Type::text, "", "", 0, 0,
     "Result file, from the working folder; default: the job's name with .h5."},
    // grids
    {"study", "grid", Type::table, "", "", 0, 0, "[study.grid]"},
    {"study", "stage", Type::tables, "", "", 0, 0, "[[study.stage]]"},
    {"study", "target", Type::tables, "", "", 0, 0,
     "[[study.target]]: of a grid; of an optimisation, in place of its meters: f is then "
     "the distance to them [%], and nsga2 has the error of each."},
    {"study", "k", Type::integer, "", "7", 1, 1e9,
     "Of a grid: so many nearest points are kept."},
    {"study", "k_rule", Type::choice, "given|sqrt_n", "given", 0, 0,
     "Of a grid; sqrt_n: the square root of the stage's points, in place of k."},
    {"study", "radius", Type::number, "", "", 0, 1e300,
     "Of a grid: of the surroundings in which points are counted, in the distance's "
     "unit; "
     "default: half the distance of the k-th nearest."},
    {"study", "density_threshold", Type::number, "", "", 0, 1e300,
     "Of a grid: share of the stage's points per volume of the surroundings, above which "
     "their nearest is left out; default: that of the k nearest in the ball that they "
     "fill around the reference."},
    {"study", "distance", Type::choice, "euclidean|scaled", "euclidean", 0, 0,
     "Of a grid: of the errors in per cent, or of the errors over their scales."},
    {"study", "target_error", Type::number, "%", "0", 0, 1e6,
     "Of a grid: it ends where the nearest point is no further off (Euclidean, in per "
     "cent)."},
    {"study", "most_stages", Type::integer, "", "", 1, 1000,
     "Of a grid; default: those given, or 10 where only the first is."},
    {"study", "budget", Type::integer, "", "100000", 1, 1e12,
     "Of a grid: points of all stages together at most."},
    {"study.target", "quantity", Type::choice, quantities, required, 0, 0, ""},
    {"study.target", "statistic", Type::choice, "period|months|peak", "period", 0, 0,
     "Total over the period (of a temperature its mean), the same of each calendar "
     "month, "
     "or the highest hour."},
    {"study.target", "measured", Type::number, "", "", -1e300, 1e300,
     "Default: what the meter shows."},
    {"study.target", "measured_months", Type::numbers, "", "", -1e300, 1e300,
     "The same where the statistic is months, one for each."},
    {"study.target", "unit", Type::text, "", "", 0, 0,
     "Of measured; default: kWh, of a peak kW, of a temperature degC."},
    {"study.target", "meter", Type::text, "", "", 0, 0,
     "Name of the meter; default: the first of the quantity with readings."},
    {"study.target", "output", Type::text, "", "", 0, 0,
     "In place of a quantity where the job has a [simulator]: one of its outputs."},
    {"study.target", "scale", Type::number, "%", "", 1e-9, 1e9,
     "With distance = \"scaled\": the error that counts as 1; default: the standard "
     "deviation over the first grid."},
    {"output", "hourly", Type::texts, "", "", 0, 0,
     "Quantities of nominal and best to be stored by hour."},
    {"output", "max_failed_share", Type::number, "-", "0.05", 0, 1,
     "A larger share of failed points fails the batch."},
    // simulator
    {"simulator", "command", Type::texts, "", required, 0, 0,
     "The program and its arguments, run without a shell: [\"energyplus\", \"-w\", "
     "\"site.epw\", \"house.idf\"]. A name with a slash lies beside the job, another one "
     "is "
     "found on PATH."},
    {"simulator", "shell", Type::flag, "", "false", 0, 0,
     "The command is one text for /bin/sh."},
    {"simulator", "time_limit", Type::number, "s", "600", 0.01, 1e7,
     "Of one point: then the command is ended, with all that it started."},
    {"simulator", "template", Type::tables, "", "", 0, 0, "[[simulator.template]]"},
    {"simulator", "files", Type::texts, "", "", 0, 0,
     "Other files that it reads: they are linked into the folder of every point."},
    {"simulator", "parameter", Type::tables, "", required, 0, 0,
     "[[simulator.parameter]]"},
    {"simulator", "output", Type::tables, "", required, 0, 0, "[[simulator.output]]"},
    {"simulator", "keep", Type::choice, "failed|all|none", "failed", 0, 0,
     "The folders of which points stay."},
    {"simulator", "folder", Type::text, "", "", 0, 0,
     "They lie in it, from the working folder; default: the job's name with .points."},
    {"simulator.template", "file", Type::text, "", required, 0, 0, "Beside the job."},
    {"simulator.template", "as", Type::text, "", "", 0, 0,
     "What the program knows it as; default: its name without .in or .template at the "
     "end."},
    {"simulator.parameter", "name", Type::text, "", required, 0, 0,
     "Letters, digits and underscores."},
    {"simulator.parameter", "unit", Type::text, "", "-", 0, 0, ""},
    {"simulator.parameter", "min", Type::number, "", required, -1e300, 1e300, ""},
    {"simulator.parameter", "max", Type::number, "", required, -1e300, 1e300, ""},
    {"simulator.parameter", "nominal", Type::number, "", "", -1e300, 1e300,
     "Where a study leaves it alone; default: the middle of the range."},
    {"simulator.output", "name", Type::text, "", required, 0, 0, ""},
    {"simulator.output", "unit", Type::text, "", "-", 0, 0, ""},
    {"simulator.output", "file", Type::text, "", "", 0, 0,
     "That the program writes, in its folder; default: what it prints."},
    {"simulator.output", "column", Type::text, "", "", 0, 0,
     "Of a CSV file, or one with columns between blanks, by its name in the header; "
     "empty "
     "cells are left out."},
    {"simulator.output", "pattern", Type::text, "", "", 0, 0,
     "In place of a column: a regular expression as of grep -E, sought in each line (its "
     "first 4,000 characters); its first group is the number: \"heating: *([0-9.]+) "
     "kWh\"."},
    {"simulator.output", "take", Type::choice, "only|first|last|sum|mean|least|most",
     "only", 0, 0, "Which of the numbers found; only: more than one is a failure."},
    {"simulator.output", "row", Type::integer, "", "", 1, 1e9,
     "In place of take: the number in that place, from 1."},
    {"simulator.output", "header", Type::integer, "", "1", 1, 1e6,
     "Line of the file with the names of its columns."},
    {"simulator.output", "skip", Type::integer, "", "0", 0, 1e6,
     "Lines below the header that are left out (units)."},
    {"simulator.output", "factor", Type::number, "-", "1", -1e300, 1e300,
     "value x factor + offset."},
    {"simulator.output", "offset", Type::number, "", "0", -1e300, 1e300, ""},
};

}  // namespace

std::span<const Key> study_keys() {
    return table;
}

}  // namespace bemcal::schema
