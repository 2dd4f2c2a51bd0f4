"""Result files of every kind of study but the loop, with random numbers of the right shape: the datasets that
`bemcal-batch describe results` lists, as far as a page draws them."""
import h5py
import numpy as np

from fake_loop_result import text, truth, weather

HOUR = 3600
PERIODS = {"training": "2022-01-01", "held_out": "2023-01-01"}
METERS = {"gas": 8760, "bills": 12}            # readings in a period
METRICS = ("n", "nmbe", "cv_rmse", "cv_rmse_n1", "mape", "n_left_out", "r2", "rmse")
NAMES = ("infiltration", "set_point", "heat_capacity_of_the_second_mass")
UNITS = ("1/h", "degC", "J/(m2 K)")
LEAST, MOST = np.array([0.1, 19.0, 1e5]), np.array([1.0, 23.0, 5e5])


def parameters(study):
    text(study, "parameter", NAMES)
    text(study, "parameter_unit", UNITS)
    study["parameter_least"], study["parameter_most"] = LEAST, MOST


def points_in(random, n):
    return LEAST + (MOST - LEAST) * random.random((n, len(NAMES)))


def end(study, kind, n_failed=0.0):
    text(study, "kind", kind)
    study["n_failed"] = n_failed


def indices(study, random, prefix, shape):
    first = 0.4 * random.random(shape)
    study[f"{prefix}first_order"], study[f"{prefix}total_order"] = first, first + 0.1
    study[f"{prefix}first_order_half_width"] = study[f"{prefix}total_order_half_width"] = np.full(shape, 0.05)


def sensitivity(study, random, outputs=("heating", "electricity"), kind="sensitivity"):
    end(study, kind, 2.0)
    parameters(study)
    text(study, "output", outputs)
    text(study, "output_unit", ["kWh"] * len(outputs))
    indices(study, random, "", (len(outputs), len(NAMES)))
    study["threshold"] = 0.05


def office_hour_sensitivity(study, random):
    sensitivity(study, random, ("Q_HC",), "office_hour_sensitivity")


def hourly_sensitivity(study, random):
    end(study, "hourly_sensitivity")
    parameters(study)
    text(study, "quantity", "heating")
    study["time"] = times("training", 8760)
    indices(study, random, "hourly_", (8760, len(NAMES)))
    indices(study, random, "series_", (len(NAMES),))
    study["hourly_mean"], study["hourly_variance"] = random.random(8760), random.random(8760)


def times(period, n):
    begin = np.datetime64(PERIODS[period], "s")
    if n == 12:
        return (begin.astype("datetime64[M]") + np.arange(12)).astype("datetime64[s]").astype(float)
    return begin.astype(float) + HOUR * np.arange(float(n))


def readings(group, random, period, n):
    """Time, measured, and what two models say."""
    time = times(period, n)
    hours = times(period, 8760)
    temperature, _ = weather(hours, random)
    real = truth("gas", hours, temperature)
    if n == 12:
        real = np.add.reduceat(real, np.searchsorted(hours, time))
    group["time"], group["measured"] = time, real * (1 + 0.05 * random.normal(size=n))
    return temperature, np.stack([1.2 * real, 1.02 * real])


def series(study, random):
    """Of nominal and best, with the outdoor temperature."""
    for period in PERIODS:
        for meter, n in METERS.items():
            temperature, both = readings(study.create_group(f"{period}/{meter}"), random, period, n)
            study[f"{period}/{meter}/simulated"] = both
        study[f"{period}/hourly/time"] = times(period, 8760)
        study[f"{period}/hourly/outdoor_temperature"] = temperature


def fits(study, random):
    text(study, "meter", list(METERS))
    text(study, "meter_unit", ["kWh"] * len(METERS))
    text(study, "period", list(PERIODS))
    text(study, "candidate", ("nominal", "best"))
    text(study, "metric", METRICS)
    shape = (2, len(PERIODS), len(METERS), len(METRICS))
    study["fit"], study["monthly_fit"] = random.random(shape), random.random(shape)


def screening(study, random, n=400):
    end(study, "screening")
    parameters(study)
    fits(study, random)
    text(study, "resolution", ("hourly", "monthly"))
    points = points_in(random, n)
    shape = (n, len(PERIODS), len(METERS))
    errors = 0.1 + np.abs(points[:, :1, None] - 0.4) + 0.05 * random.random(shape)
    study["points"], study["cv_rmse"] = points, errors
    score = (errors[:, 0] ** 2).sum(axis=1)
    score[5] = np.nan
    study["score"] = score
    study["meets_guideline_14"] = (errors.max(axis=2)[:, :, None] < [0.3, 0.15]).astype(float)
    best = np.argsort(score)[:20]
    study["best_point"], study["best_score"], study["best_parameters"] = best.astype(float), score[best], points[best]
    study["best_cv_rmse"], study["n_points"] = errors[best], float(n)
    series(study, random)


def grid(study, random):
    end(study, "grid")
    parameters(study)
    targets = ("electricity", "gas")
    text(study, "target", targets)
    text(study, "target_unit", ("kWh", "kWh"))
    study["target_measured"] = [2500.0, 12000.0]
    text(study, "grid_distance", "euclidean")
    text(study, "ended_by", "the target error is reached")
    study["stage_points"], study["stage_distance"] = [27.0, 27.0, 27.0], [3.0, 0.4, 0.7]
    study["stage_target_error"] = [[2.0, -2.2], [0.25, -0.31], [-0.5, 0.49]]
    study["target_error_wanted"] = 0.5
    study["nearest_parameters"] = (LEAST + MOST) / 2
    for k in (1, 2, 3):
        stage = study.create_group(f"stage_{k}")
        values = [low + (high - low) * np.array([0.2, 0.5, 0.8]) for low, high in zip(LEAST, MOST)]
        stage["grid_value"], stage["grid_parameter"] = np.concatenate(values), np.repeat(np.arange(3.0), 3)
        stage["grid_points"] = np.stack(np.meshgrid(*values), axis=-1).reshape(-1, 3)
        stage["target_error"] = random.normal(size=(27, 2)) * 5 / k
        stage["neighbour"] = np.argsort(np.linalg.norm(stage["target_error"][:], axis=1))[:4].astype(float)
        stage["distance_total_order"] = random.random(3)
        text(stage, "parameter_role", ("open", "determined", "held"))


def optimisation(study, random, n=600):
    """A front of two objectives."""
    end(study, "optimisation")
    parameters(study)
    text(study, "objective", ("electricity", "gas"))
    text(study, "objective_unit", ("%", "%"))
    study["points"] = points_in(random, n)
    study["point_objective"] = 0.1 + random.random((n, 2)) * 3
    along = np.linspace(0.1, 1, 20)
    study["front_objective"] = np.stack([along, 0.1 / along], axis=1)
    study["front_parameters"] = points_in(random, 20)
    study["at_bound"] = [0.0, 1.0, -1.0]
    text(study, "target", ("electricity", "gas"))
    text(study, "target_unit", ("kWh", "kWh"))
    study["target_measured"], study["nearest_target_error"] = [2500.0, 12000.0], [0.01, -0.2]


def one_objective(study, random):
    """A best point, round by round, with its meters."""
    end(study, "optimisation")
    parameters(study)
    fits(study, random)
    text(study, "objective", ["f"])
    text(study, "objective_unit", ["-"])
    study["round_end"], study["round_best"] = np.arange(1.0, 11) * 60, 50 / np.arange(1.0, 11)
    study["front_objective"], study["front_parameters"] = [[5.0]], points_in(random, 1)
    study["at_bound"] = np.zeros(3)
    series(study, random)


def comparison(study, random, path, period):
    group = study.create_group(path)
    for name, values in (("meter", ["air"]), ("meter_unit", ["degC"]), ("period", [period]),
                         ("version", ("before", "after", "at_once", "posterior")), ("metric", METRICS)):
        text(group, name, values)
    group["version_fit"] = np.array([0.6, 0.3, 0.25, 0.45])[:, None, None] * np.ones((4, 1, len(METRICS)))
    group["error_level"] = np.array([0.1, 0.2, 0.5, 1, 2, 5])
    group["error_share"] = np.array([[[0.1, 0.3, 0.6, 0.9, 1, 1]], [[0.3, 0.6, 0.9, 1, 1, 1]],
                                     [[0.4, 0.7, 0.9, 1, 1, 1]], [[0.1, 0.2, 0.4, 0.6, 0.8, 1]]])
    group["share_within_half"] = group["share_within_accuracy"] = [[0.5], [0.8], [0.9], [0.65]]
    air = group.create_group(f"periods/{period}/air")
    _, both = readings(air, random, "training", 8760)
    air["measured"][:] = air["measured"][:] / 50 + 18
    air["simulated"] = np.concatenate([both, 3 * both]) / 50 + 18


def stages(study, random):
    end(study, "stages")
    parameters(study)
    names = ("envelope", "occupied")
    text(study, "calibration_stage", (*names, "at_once"))
    text(study, "calibration_from", ("initial", "envelope", "initial"))
    value = np.stack([LEAST, MOST, MOST]) * [[1.2], [0.8], [0.9]]
    study["calibration_start"], study["calibration_value"] = value * 0.99, value
    study["calibration_sd"] = np.stack([(MOST - LEAST) / 20] * 3)
    study["calibration_least"] = np.array([LEAST, [np.nan, *LEAST[1:]], LEAST])
    study["calibration_most"] = np.array([MOST, [np.nan, *MOST[1:]], MOST])
    study["calibration_at_bound"] = np.array([[0, 1, 0], [0, 0, -1.0], [0, 0, 0]])
    study["accuracy"] = 0.35
    for name in names:
        comparison(study, random, f"calibration/{name}", "training")
    comparison(study, random, "validation/may", "may")


def unknowns(study, random, names, n_chains=4, n_draws=60):
    unknown = [*names, "log_density"]
    text(study, "unknown", unknown)
    text(study, "unknown_unit", [*UNITS, "1", "1", "-"][:len(names)] + ["-"])
    for k, name in enumerate(names):
        study[f"posterior/{name}"] = k + random.normal(size=(n_chains, n_draws))
        study[f"prior/{name}"] = k + 3 * random.normal(size=(1, 200))
    for name in ("posterior_mean", "posterior_sd", "posterior_q05", "posterior_q95", "contraction"):
        study[name] = random.random(len(unknown))
    study["rhat_rank"], study["ess_bulk"], study["ess_tail"] = (
        value + random.random(len(unknown)) for value in (1.0, 300.0, 200.0))
    text(study, "data_finding", ["determined", "as_before", "confounded", *["determined"] * 9][:len(names)] + [""])
    text(study, "data_words", ["the data determine it: 13 % of the prior's spread is left"] * len(names) + [""])
    study["target_rhat"], study["target_ess"] = 1.01, 400.0
    text(study, "convergence", "not converged")
    text(study, "shortfall", "not converged: rank R-hat is up to 1.9")


def posterior(study, random):
    end(study, "posterior")
    unknowns(study, random, NAMES)
    for period in PERIODS:
        for meter, n in METERS.items():
            group = study.create_group(f"{period}/{meter}")
            _, (group["nominal"], mean) = readings(group, random, period, n)
            group["predicted_mean"], group["predicted_q05"], group["predicted_q95"] = mean, 0.8 * mean, 1.2 * mean
            judged = group.create_group("all")
            text(judged, "metric", METRICS)
            judged["validation_fit"] = random.random((2, 3, len(METRICS)))
            judged["coverage"] = [0.5, 0.9, 0.5, 0.9]
            judged["pit"], judged["pit_distance"] = np.arange(1.0, 21), 0.2


def kennedy_ohagan(study, random, n=12, n_runs=8):
    end(study, "kennedy_ohagan")
    calibrated = ("u_value", "air_change")
    unknowns(study, random, (*calibrated, "lambda_e"))
    text(study, "calibrated_input", calibrated)
    text(study, "known_input", ["outdoor"])
    outdoor = np.linspace(0, 18, n)
    study["field_input"] = outdoor[:, None]
    mean = 3000 - 150 * outdoor
    study["field_measured"] = mean + 30 * random.normal(size=n)
    study["design_values"] = random.random((n_runs, 2))
    study["design_run"] = mean + 500 * random.normal(size=(n_runs, 1))
    study["process_mean"], study["process_q05"], study["process_q95"] = mean, mean - 60, mean + 60
    study["measurement_q05"], study["measurement_q95"] = mean - 90, mean + 90
    study["process_coverage"], study["measurement_coverage"] = [0.4, 0.8], [0.5, 0.9]
    study["field_cv_rmse"], study["field_cv_rmse_n1"], study["field_nmbe"] = 0.03, 0.031, 0.001


def retrofit(study, random):
    end(study, "retrofit")
    text(study, "scenario", ("as is", "new windows", "heat pump", "warmer"))
    text(study, "output", ("heating", "electricity", "gas", "too_cold"))
    text(study, "output_unit", ("kWh", "kWh", "kWh", "h"))
    text(study, "points_of", "office/posterior")
    study["quantile"], study["comfort_limit"] = [0.05, 0.5, 0.95], [19.0, 26.0]
    study["simulated_period"] = [1420070400.0, 1451606400.0]     # 2015
    levels = np.array([0.9, 1.0, 1.1])[:, None]
    before = np.array([20000, 8000, 22000, 40])
    after = np.array([before, [15000, 8010, 16500, 30], [20000, 13000, 0, 45], [21000, 8000, 23100, 40]])
    study["before_quantile"], study["after_quantile"] = levels * before, after[:, None] * levels
    saving = (before - after)[:, None] * levels
    study["saving_quantile"] = np.sort(saving + (saving == 0) * 3.4e-10, axis=1)     # as rounding leaves it
    study["saving_share_quantile"] = study["saving_quantile"][:] / study["before_quantile"][:]


# In a result's order. Two of a kind have names of their own.
STUDIES = {"sensitivity": sensitivity, "office_hour_sensitivity": office_hour_sensitivity,
           "hourly_sensitivity": hourly_sensitivity, "screening": screening, "grid": grid,
           "optimisation": optimisation, "one_objective": one_objective, "stages": stages, "posterior": posterior,
           "kennedy_ohagan": kennedy_ohagan, "retrofit": retrofit}


def write(path, names=tuple(STUDIES), building="office"):
    with h5py.File(path, "w") as file:
        file.attrs.update(program="bemcal-batch", title="made", seed="1")
        for k, name in enumerate(names):
            STUDIES[name](file.create_group(f"{building}/{name}"), np.random.default_rng(k))
        data = file.create_group(f"{building}/data")
        text(data, "series", ["gas"])
        text(data, "finding", ["60 h of the same value"])
        text(data, "action", ["masked"])
    return path
