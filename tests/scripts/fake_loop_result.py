"""A result file as a loop writes it, with random numbers of the right shape: two years of five
channels, of which one is read by the month, with a wind effect that the model before it lacks."""
import h5py
import numpy as np

HOUR = 3600
BEGIN = {"training": "2022-01-01", "held_out": "2023-01-01"}
CHANNELS = {"air": "degC", "heat": "kWh", "cold": "kWh", "electricity": "kWh", "gas": "kWh"}
MODELS = ("plain", "before", "after")
HOOKS = ("outdoor air", "opaque boundary", "infiltration", "venting", "aperture", "gains",
         "heating set-point", "heating efficiency", "meter factor")
DRIVERS = ("constant", "outdoor temperature", "wind", "global sun", "hour of the day", "weekend",
           "day of the year", "time elapsed")


def text(group, name, values):
    group.create_dataset(name, data=values, dtype=h5py.string_dtype())


def weather(times, random):
    day = times / 86400
    temperature = 9 - 10 * np.cos(2 * np.pi * (day - 15) / 365.25) \
        - 4 * np.cos(2 * np.pi * (times / HOUR % 24 - 3) / 24)
    slow = np.convolve(random.normal(size=times.size), np.exp(-np.arange(200) / 60))[:times.size]
    return temperature + 0.5 * slow, np.abs(3 + 0.4 * slow + random.normal(size=times.size))


def truth(channel, times, temperature):
    hour, day = times / HOUR % 24, (times // 86400 + 3) % 7
    busy = ((hour >= 7) & (hour < 18) & (day < 5)).astype(float)
    return {"air": 20 + 1.5 * busy + 0.15 * np.maximum(temperature - 15, 0),
            "heat": 4 * np.maximum(17 - temperature, 0) * (0.5 + 0.5 * busy),
            "cold": 6 * np.maximum(temperature - 18, 0) * busy,
            "electricity": 8 + 30 * busy + 2 * np.maximum(temperature - 18, 0) * busy,
            "gas": 5 + 4.4 * np.maximum(17 - temperature, 0) * (0.5 + 0.5 * busy)}[channel]


def predictions(channel, times, temperature, wind):
    """The three models; what the first two lack follows the wind."""
    real = truth(channel, times, temperature)
    lack = (wind - wind.mean()) / wind.std() * (0.12 * np.abs(real) if channel != "air" else 0.25)
    if channel == "electricity":
        lack = 0 * lack
    return real, np.stack([1.08 * real - 1.4 * lack, real - lack, real - 0.1 * lack])


def metrics(simulated, measured):
    there = np.isfinite(measured)
    if not there.any():
        return [0, np.nan, np.nan, np.nan]
    error, mean = (simulated - measured)[there], measured[there].mean()
    rmse = np.sqrt(np.mean(error**2))
    return [there.sum(), rmse / mean, error.mean() / mean, rmse]


def by_month(times, values, measured, is_mean):
    there = np.isfinite(measured)
    if not there.any():
        return np.array([np.nan])
    month = times.astype("datetime64[s]").astype("datetime64[M]")
    sums = [(values[there & (month == m)]).sum() / (max((there & (month == m)).sum(), 1)
                                                     if is_mean else 1)
            for m in np.unique(month[there])]
    return np.array(sums)


def series(file, random, period, channels, is_measured):
    """Writes a period; gives its fit [model x resolution x channel x metric]."""
    times = np.datetime64(BEGIN[period], "s").astype(float) + HOUR * np.arange(8760.0)
    temperature, wind = weather(times, random)
    group = file.create_group(period)
    group["time"], group["outdoor_temperature"] = times, temperature
    fit = np.full((3, 2, len(channels), 4), np.nan)
    for c, (channel, unit) in enumerate(channels.items()):
        real, models = predictions(channel, times, temperature, wind)
        noise = 0.1 if channel == "air" else 0.05 * np.abs(real) + 0.3
        measured = real + noise * random.normal(size=times.size)
        measured[random.integers(times.size, size=100)] = np.nan
        measured[4000:4060] = np.nan
        if not is_measured:
            measured[:] = np.nan
        group[f"{channel}/measured"], group[f"{channel}/simulated"] = measured, models
        for m in range(3):
            fit[m, 0, c] = metrics(models[m], measured)
            months = [by_month(times, v, measured, unit == "degC") for v in (models[m], measured)]
            fit[m, 1, c] = metrics(*months)
    return fit


def parameters(study, random):
    names = ("infiltration", "wall_u_value", "heating_set_point", "heat_capacity", "thermostat_band",
             "heating_efficiency")
    text(study, "parameter", names)
    text(study, "parameter_unit", ("-", "-", "K", "-", "K", "-"))
    study["parameter_prior_mean"] = [1, 1, 0, 1, np.nan, 1]
    study["parameter_prior_sd"] = [0.3, 0.2, 0.5, 0.5, np.nan, 0.1]
    value = np.array([1, 1, 0, 1, 0.5, 1.0]) + np.array([0.2, 0.1, 0.3, 0.3, 0.2, 0.05]) \
        * np.array([2.5, 2, 0.3])[:, None] * random.normal(size=6)
    study["parameter_value"], study["parameter_sd"] = value, 0.03 + 0.02 * random.random((3, 6))


def effects(study, found):
    rows = [("wind infiltration", "infiltration", "wind", "wind", "always", "1/h per m/s", 0.083,
             0.079, 0.087, 412, 1, "stack infiltration; outdoor shift",
             "calm and windy nights apart, or a tracer gas test", ""),
            ("blind control", "aperture", "brightness of the facade",
             "where brightness of the facade is above 212 W/m2, occupied", "occupied",
             "-", -0.41, -0.52, -0.30, 38, 0, "", "position of the blinds",
             "its probability is below 0.9")][:found]
    columns = list(zip(*rows)) if rows else [()] * 14
    names = ("effect", "effect_hook", "effect_driver", "effect_shape", "effect_gate", "effect_unit",
             "effect_coefficient", "effect_least", "effect_most", "effect_gain", "effect_adequate",
             "effect_class", "effect_separates", "effect_doubt")
    members = [(k, name) for k, row in enumerate(rows) for name in (row[0], *filter(None, row[11].split("; ")))]
    study["effect_class_of"] = np.array([k for k, _ in members], float)
    text(study, "effect_class_member", [name for _, name in members])
    study["effect_class_probability"] = [(0.81, 0.12, 0.06, 0.62)[k] for k in range(len(members))]
    text(study, "effect_section", ['[[effect]]\nname = "%s"\ncoefficient = %s\n' % (row[0], row[6]) for row in rows])
    for name, column in zip(names, columns):
        if name[7:] in ("coefficient", "least", "most", "gain", "adequate"):
            study[name] = np.array(column, float)
        else:
            text(study, name, list(column))


def function_rows():
    """(where, hook, driver, its unit, unit, points [(at, and_at)])"""
    hours = [(float(k), np.nan) for k in range(72)]
    both = [(float(h), 4.0 * k) for h in range(48) for k in range(5)]
    return [("gains by hour of the week", "gains", "hour of the week", "h", "W/m2", hours),
            ("infiltration by wind", "infiltration", "wind", "m/s", "1/h", [(1.5 * k, np.nan) for k in range(8)]),
            ("gains by hour and outdoor temperature of a day", "gains",
             "hour and outdoor temperature of a day", "degC", "W/m2", both),
            ("heating efficiency by time", "heating efficiency", "time", "a", "-",
             [((k + 0.5) / 26, np.nan) for k in range(26)]),
            ("meter factor of gas", "meter factor", "one", "", "-", [])]


def functions(study, random):
    """Functions without a name, of every kind; the last follows nothing."""
    rows = function_rows()
    for name, column in zip(("function", "function_hook", "function_driver", "function_driver_unit",
                             "function_unit"), list(zip(*rows))[:5]):
        text(study, name, list(column))
    study["function_size"], study["function_evidence"] = [0.6, 0.1, 0.2, 0.03, 0.01], [120, 40, 9, 8, 6.0]
    points = [(k, *point) for k, row in enumerate(rows) for point in row[5]]
    value = random.normal(size=len(points))
    study["function_point_of"], study["function_point_at"], study["function_point_and_at"] = \
        (np.array(column, float) for column in zip(*points))
    study["function_point_value"] = value
    study["function_point_least"], study["function_point_most"] = value - 0.3, value + 0.3


def steps(study, found, n_channels, random):
    rows = [("wind infiltration", 412, 24, 160, "accepted"), ("blind control", 38, 24, 9, "accepted")]
    rows = rows[:found] + [("meter drift, gas", 31, 24, -4, "rejected: the held-out score falls"),
                           ("outdoor shift", 11, 24, 1,
                            "no candidate gains as much as chance does (24)")]
    text(study, "step_effect", [row[0] for row in rows])
    text(study, "step_verdict", [row[4] for row in rows])
    for k, name in enumerate(("step_gain", "step_threshold", "step_score")):
        study[name] = [float(row[k + 1]) for row in rows]
    study["step_error"] = -0.1 * random.random((len(rows), n_channels)) + 0.005
    text(study, "candidate", [f"candidate {k}" for k in range(8)])
    study["candidate_gain"] = 11 - np.arange(8.0)


def power(study, random):
    names = [f"effect {k}" for k in range(40)]
    text(study, "power_effect", names)
    text(study, "power_alias", [names[k - 1] for k in range(38)] + ["the calibrated parameters themselves"] * 2)
    text(study, "power_alias_kind", ["effect"] * 38 + ["parameters"] * 2)
    study["least_detectability"], study["same_signature"] = 5.0, 0.98
    text(study, "power_bias_parameter", ["infiltration", "wall_u_value"] * 20)
    study["power_detectability"] = np.append(np.exp(random.normal(2, 1.5, 38)), [9, np.nan])
    study["power_visibility"] = random.random(40)
    study["power_alias_correlation"] = np.append(random.random(38) ** 0.2, [1, 1])
    study["power_bias"] = random.normal(0, 2, 40)


def background(study, channels, found, random):
    text(study, "structure", ("as described", "air capacity and proportional band", "second mass"))
    study["structure_score"] = [1.31, 0.94, 0.97]
    text(study, "structure_chosen", "air capacity and proportional band")
    text(study, "decision_series", ("gas", "effect 39", "thermostat_band"))
    text(study, "decision_finding", ("60 h of the same value from 2022-06-16 16:00",
                                     "one class with u_floor", "at the upper end of its range: 0.5 K"))
    text(study, "decision_action", ("masked", "told apart where it is large",
                                    "may stand for what the description lacks"))
    text(study, "decision_kind", ("data", "class", "parameter"))
    text(study, "setting", ["heating set-back"])
    text(study, "setting_parameter", ["heating_setback"])
    text(study, "setting_unit", ["degC"])
    for name, value in (("described", 16.0), ("found", 19.3), ("least", 18.9), ("most", 19.7), ("distance", 3.3)):
        study[f"setting_{name}"] = [value]
    text(study, "hook", HOOKS)
    text(study, "driver", DRIVERS)
    before = 0.9 * random.random((len(HOOKS), len(DRIVERS)))
    study["localisation_after"] = before.copy()
    before[2, 2], before[0, 2], before[4, 4] = 3.4, 2.1, 1.4
    study["localisation"] = before
    study["unexplained"] = np.linspace(0.01, 0.09, len(channels))
    text(study, "unexplained_where", ["weekday mornings in winter"] * len(channels))


def hours_learned(study):
    text(study, "learned_schedule", ["work"])
    text(study, "learned_schedule_use", ["office"])
    text(study, "learned_schedule_sentence",
         ["schedule work: Monday to Friday 8 to 19 h, Saturdays off; learned, nobody declared it"])
    study["learned_schedule_evidence"] = [812.0]
    text(study, "learned_hours_days", ["Monday to Friday", "Saturdays", "Sundays and holidays"])
    study["learned_hours_of"] = [0.0, 0.0, 0.0]
    for name, values in (("from", (8, 0, 0)), ("until", (19, 0, 0)), ("probability", (0.97, 1, 1)),
                         ("from_least", (7, 0, 0)), ("from_most", (8, 0, 0)), ("until_least", (19, 0, 0)),
                         ("until_most", (19, 0, 0)), ("usual_from", (7, 0, 0)), ("usual_until", (18, 0, 0))):
        study[f"learned_hours_{name}"] = np.array(values, float)


def write(path, channels=CHANNELS, held_out=True, found=2, stage="office/loop", seed=1):
    random = np.random.default_rng(seed)
    with h5py.File(path, "w") as file:
        file.attrs.update(program="bemcal-batch", title=stage.split("/")[0], seed=str(seed))
        study = file.create_group(stage)
        text(study, "kind", "loop")
        text(study, "channel", list(channels))
        text(study, "channel_unit", list(channels.values()))
        text(study, "model", MODELS)
        text(study, "period", list(BEGIN))
        text(study, "resolution", ("hourly", "monthly"))
        text(study, "metric", ("n", "cv_rmse", "nmbe", "rmse"))
        fits = [series(study, random, period, channels, held_out or period == "training")
                for period in BEGIN]
        study["fit"] = np.stack(fits, axis=1)
        parameters(study, random)
        effects(study, found)
        if found:
            functions(study, random)
            hours_learned(study)
        steps(study, found, len(channels), random)
        power(study, random)
        background(study, channels, found, random)
    return path
