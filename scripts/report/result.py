"""What a loop wrote to a result file. Here alone are its datasets called by their names, which
`bemcal-batch describe results` lists.

Residuals are simulated - measured. A temperature's errors are in K, the others' in %.
"""
import math
from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np

from report import guard, studies

PLAIN, BEFORE, AFTER = range(3)
HOURLY, MONTHLY = range(2)
LEAST_READINGS = 168           # fewer make no picture
OF_CLASS = "class"             # a kind of decisions: effects that are one with parameters
OF_ENDS = "parameter"          # another: where a calibration ended
OF_PARAMETERS = "parameters"   # a kind of aliases: other values of what is calibrated
# What results of 0.1.0 have in words only, and the limits that they do not say.
CLASS_OF_0_1_0, PARAMETERS_OF_0_1_0 = "one class with ", "the calibrated parameters themselves"
LIMITS_OF_0_1_0 = {"least_detectability": 5.0, "same_signature": 0.98}


@dataclass(frozen=True)
class Column:
    """A dataset of a list, and what stands for its elements where a result lacks it."""
    name: str
    missing: object

    def read(self, group):
        if self.missing == "":
            return texts_of(group, self.name)
        if not guard.has(group, self.name):
            return []
        return [float(value) for value in np.atleast_1d(guard.sound(group[self.name])[()])]


def text(name):
    return Column(name, "")


def number(name):
    return Column(name, math.nan)


# The lists of a loop: fields of their rows. The first tells how many there are.
EFFECT = {"name": text("effect"), "hook": text("effect_hook"), "driver": text("effect_driver"),
          "shape": text("effect_shape"), "gate": text("effect_gate"), "unit": text("effect_unit"),
          "coefficient": number("effect_coefficient"), "least": number("effect_least"),
          "most": number("effect_most"), "gain": number("effect_gain"),
          "adequate": number("effect_adequate"), "doubt": text("effect_doubt"),
          "separates": text("effect_separates"), "section": text("effect_section"),
          "class_in_words": text("effect_class")}
EFFECT_VALUE = {"value": number("effect_value"), "of": text("effect_value_of"),
                "effect": number("effect_value_effect"), "unit": text("effect_value_unit"),
                "least": number("effect_value_least"), "most": number("effect_value_most")}
SETTING = {"name": text("setting"), "parameter": text("setting_parameter"), "unit": text("setting_unit"),
           "described": number("setting_described"), "found": number("setting_found"),
           "least": number("setting_least"), "most": number("setting_most"), "distance": number("setting_distance")}
FUNCTION = {"name": text("function"), "hook": text("function_hook"), "driver": text("function_driver"),
            "driver_unit": text("function_driver_unit"), "size": number("function_size"),
            "unit": text("function_unit"), "evidence": number("function_evidence")}
POINT = {"value": number("function_point_value"), "function": number("function_point_of"),
         "at": number("function_point_at"), "and_at": number("function_point_and_at"),
         "least": number("function_point_least"), "most": number("function_point_most")}
SCHEDULE = {"name": text("learned_schedule"), "use": text("learned_schedule_use"),
            "sentence": text("learned_schedule_sentence"),
            "evidence": number("learned_schedule_evidence")}
HOURS = {"schedule": number("learned_hours_of"), "days": text("learned_hours_days"),
         "from": number("learned_hours_from"), "until": number("learned_hours_until"),
         "probability": number("learned_hours_probability"),
         "from_least": number("learned_hours_from_least"), "from_most": number("learned_hours_from_most"),
         "until_least": number("learned_hours_until_least"), "until_most": number("learned_hours_until_most"),
         "usual_from": number("learned_hours_usual_from"), "usual_until": number("learned_hours_usual_until")}
JOB_PART = {"of": text("job_part"), "section": text("job_part_section")}
MEASUREMENT = {"measure": text("measurement"), "question": text("measurement_question"),
               "kind": text("measurement_kind"), "begin": text("measurement_from"),
               "weeks": number("measurement_weeks"), "now": number("measurement_now"),
               "then": number("measurement_then"), "advised": number("measurement_advised")}
MEMBER = {"name": text("effect_class_member"), "effect": number("effect_class_of"),
          "probability": number("effect_class_probability")}
POWER = {"effect": text("power_effect"), "detectability": number("power_detectability"),
         "visibility": number("power_visibility"), "alias": text("power_alias"),
         "alias_kind": text("power_alias_kind"), "correlation": number("power_alias_correlation"),
         "parameter": text("power_bias_parameter"), "bias": number("power_bias")}
DECISION = {"series": text("decision_series"), "finding": text("decision_finding"),
            "action": text("decision_action"), "kind": text("decision_kind")}
STEP = {"effect": text("step_effect"), "verdict": text("step_verdict"), "gain": number("step_gain"),
        "threshold": number("step_threshold"), "score": number("step_score")}
CANDIDATE = {"name": text("candidate"), "gain": number("candidate_gain")}
SIMULATOR_PARAMETER = {"name": text("simulator_parameter"), "unit": text("simulator_parameter_unit"),
                       "least": number("simulator_parameter_least"), "most": number("simulator_parameter_most"),
                       "plain": number("simulator_parameter_plain"), "before": number("simulator_parameter_before"),
                       "after": number("simulator_parameter_after")}
GIVEN = {"name": text("simulator_given"), "hooks": text("simulator_given_hooks"),
         "scale": number("simulator_given_scale")}
GIVEN_SERIES = {"of": number("simulator_series_of"), "hook": text("simulator_series_hook"),
                "unit": text("simulator_series_unit"), "enters": text("simulator_series_enters"),
                "facade": text("simulator_series_facade"), "meter": text("simulator_series_meter"),
                "opens_above": number("simulator_series_opens_above")}
SIMULATOR_RUN = {"of": text("simulator_run"), "failure": text("simulator_run_failure"),
                 "distance": number("simulator_run_distance"), "years": number("simulator_run_years")}
EMULATED = {"name": text("simulator_channel"), "error": number("simulator_emulator_error")}
NUMBERS = ("fit", "step_error", "localisation", "localisation_after", "parameter_value", "parameter_sd", "coverage")
TRIED = {"name": text("structure"), "score": number("structure_score")}
REFINEMENT = {"name": text("refinement"), "what": text("refinement_is")}
PARAMETER = {"name": text("parameter"), "unit": text("parameter_unit"),
             "mean": number("parameter_prior_mean"), "sd": number("parameter_prior_sd")}
CHANNEL = {"name": text("channel"), "unit": text("channel_unit"),
           "unexplained": number("unexplained"), "where": text("unexplained_where")}


def texts_of(group, name):
    """A list of texts; [] where the dataset is not there."""
    return guard.texts(group, name)


def rows_in(group, columns):
    """An object for each element of the first column, with the fields of `columns`."""
    lists = {field: column.read(group) for field, column in columns.items()}
    n = len(next(iter(lists.values())))
    return [SimpleNamespace(**{field: values[k] if k < len(values) else columns[field].missing
                               for field, values in lists.items()}) for k in range(n)]


def overlap(first, second):
    """Whether two periods have time in common; of each the times of its series [s]."""
    first, second = (np.concatenate([np.empty(0), *series]) for series in (first, second))
    return bool(first.size and second.size and max(first.min(), second.min()) <= min(first.max(), second.max()))


def effects_in(group):
    """The effects found, each with the members of its class and what it brings."""
    effects, members, values = (rows_in(group, columns) for columns in (EFFECT, MEMBER, EFFECT_VALUE))
    for k, effect in enumerate(effects):
        effect.brings = [value for value in values if value.effect == k and math.isfinite(value.value)]
        own = [member for member in members if member.effect == k]
        effect.members = [member.name for member in own] or effect.class_in_words.split("; ")
        effect.others = [name for name in effect.members if name not in ("", effect.name)]
        effect.probabilities = {member.name: member.probability for member in own}
        effect.probability = effect.probabilities.get(effect.name, math.nan)
        effect.is_adequate = effect.adequate == 1
    return effects


def schedules_in(group):
    """The schedules whose hours were learned, each with these."""
    schedules, hours = rows_in(group, SCHEDULE), rows_in(group, HOURS)
    for k, schedule in enumerate(schedules):
        schedule.hours = [row for row in hours if row.schedule == k]
    return schedules


def settings_in(group):
    """Set-points and set-backs that the readings deny."""
    return rows_in(group, SETTING)


def functions_in(group):
    """The functions without a name, each with its points."""
    functions, points = rows_in(group, FUNCTION), rows_in(group, POINT)
    for k, function in enumerate(functions):
        function.points = [point for point in points if point.function == k]
    return functions


def decisions_in(group):
    decisions = rows_in(group, DECISION)
    for decision in decisions:
        if not decision.kind and decision.finding.startswith(CLASS_OF_0_1_0):
            decision.kind = OF_CLASS
    return decisions


def power_in(group):
    power = rows_in(group, POWER)
    for effect in power:
        if not effect.alias_kind and effect.alias == PARAMETERS_OF_0_1_0:
            effect.alias_kind = OF_PARAMETERS
    return power


def simulator_in(group):
    """The program that a loop was around; without parameters of another loop."""
    return SimpleNamespace(
        parameters=rows_in(group, SIMULATOR_PARAMETER), given=rows_in(group, GIVEN),
        series=rows_in(group, GIVEN_SERIES), series_values=numbers_in(group, "simulator_series_value"),
        left_out=texts_of(group, "simulator_left_out"), runs=rows_in(group, SIMULATOR_RUN),
        emulated=rows_in(group, EMULATED))


def numbers_in(group, name):
    return guard.sound(group[name])[()] if guard.has(group, name) else np.array([])


def limit_in(group, name):
    return float(guard.sound(group[name])[()]) if guard.has(group, name) else LIMITS_OF_0_1_0[name]


@dataclass
class Series:
    """A channel in a period, hour by hour."""
    time: np.ndarray        # begins of hours [s since 1970]
    measured: np.ndarray    # NaN = missing or masked
    simulated: np.ndarray   # [model x time]
    outdoor: np.ndarray     # outdoor temperature [degC], or nothing
    # ends of the 90 % intervals of after [2 x time], or nothing
    band: np.ndarray = field(default_factory=lambda: np.array([]))
    # of a meter by the day, month or bill: (begins, ends [s since 1970], measured), or nothing
    readings: tuple = ()

    def residual(self, model):
        return self.simulated[model] - self.measured

    @property
    def n_readings(self):
        return int(np.isfinite(self.measured).sum())

    @property
    def is_drawn(self):
        return self.n_readings >= LEAST_READINGS


@dataclass
class Error:
    """Errors of the three models for a channel in a period, by the hour or month."""
    channel: str
    period: str
    resolution: str
    n: float
    error: np.ndarray       # [model] CV(RMSE) [%], or RMSE [K]
    bias: np.ndarray        # [model] NMBE [%], or mean error [K]
    unit: str
    within: float           # share of readings in the 90 % intervals of after [%]; NaN = not known

    @property
    def is_measured(self):
        return self.n > 0

    @property
    def is_better(self):
        return self.error[AFTER] < self.error[BEFORE]

    def removed(self, since, until):
        """Share of the error that is gone from one model to a later one."""
        return 1 - self.error[until] / self.error[since]


def series_in(period, channel):
    def values(name):
        return guard.sound(guard.inner(period, name))[()]
    outdoor, ends = "outdoor_temperature", [f"{channel}/predicted_{q}" for q in ("q05", "q95")]
    readings = [f"{channel}/reading_{leaf}" for leaf in ("begin", "end", "measured")]
    return Series(values("time"), values(f"{channel}/measured"), values(f"{channel}/simulated"),
                  values(outdoor) if guard.has(period, outdoor) else np.array([]),
                  np.array([values(end) for end in ends]) if guard.has(period, ends[0]) else np.array([]),
                  tuple(map(values, readings)) if guard.has(period, readings[0]) else ())


class Loop:
    """One stage of a result: all of it that is shown, so that the file may be closed."""

    def __init__(self, file, stage):
        group = file[stage]
        self.stage = stage
        self.attributes = {name: str(value) for name, value in file.attrs.items()}
        self.building = stage.split("/")[0]
        rows = [rows_in(group, columns) for columns in
                (CHANNEL, PARAMETER, STEP, CANDIDATE, TRIED)]
        self.of_channels, self.of_parameters, self.steps, self.candidates, self.structures = rows
        self.power, self.decisions = power_in(group), decisions_in(group)
        self.channels = [channel.name for channel in self.of_channels]
        self.parameters = [parameter.name for parameter in self.of_parameters]
        self.effects, self.functions = effects_in(group), functions_in(group)
        self.schedules, self.job_parts = schedules_in(group), rows_in(group, JOB_PART)
        self.measurements, self.settings = rows_in(group, MEASUREMENT), settings_in(group)
        self.simulator = simulator_in(group)
        self.periods, self.resolutions, self.metrics, self.hooks, self.drivers = (
            texts_of(group, name)
            for name in ("period", "resolution", "metric", "hook", "driver"))
        self.numbers = {name: numbers_in(group, name) for name in NUMBERS}
        self.structure = (texts_of(group, "structure_chosen") or [""])[0]
        self.refinements = rows_in(group, REFINEMENT)
        self.least_detectability = limit_in(group, "least_detectability")
        self.same_signature = limit_in(group, "same_signature")
        self.judged = self._judged()
        self.all_series = {
            period: {channel: series_in(guard.inner(group, period), channel)
                     for channel in self.channels} for period in self.periods}

    def value(self, name, *place):
        """An element; NaN where it is not there."""
        values = np.asarray(self.numbers[name])
        inside = values.ndim == len(place) and all(p < n for p, n in zip(place, values.shape))
        return float(values[place]) if inside else np.nan

    def value_of(self, model, parameter):
        return self.value("parameter_value", model, parameter)

    def sd_of(self, model, parameter):
        return self.value("parameter_sd", model, parameter)

    def error_of_step(self, step, channel):
        return self.value("step_error", step, channel)

    @property
    def series(self):
        """In the period of judging."""
        return self.all_series[self.judged]

    @property
    def has_held_out(self):
        return self.judged != self.periods[0]

    @property
    def saw_judged(self):
        """Whether the period of judging has days of training."""
        first, second = ([series.time for series in self.all_series.get(period, {}).values()]
                         for period in (self.periods[0], self.judged))
        return overlap(first, second)

    def _judged(self):
        """The period that pictures show: the first with readings after training."""
        later = (period for p, period in enumerate(self.periods) if p > 0
                 and any(self.fit(p, r, c).is_measured for r in range(len(self.resolutions))
                         for c in range(len(self.channels))))
        return next(later, self.periods[0])

    def fit(self, period, resolution, channel):
        def metric(name):
            return np.array([self.value("fit", m, period, resolution, channel,
                                        self.metrics.index(name)) for m in range(3)])
        of_channel = self.of_channels[channel]
        is_temperature = of_channel.unit == "degC"
        with np.errstate(invalid="ignore", divide="ignore"):
            mean = metric("rmse") / metric("cv_rmse")
        error = metric("rmse") if is_temperature else 100 * metric("cv_rmse")
        bias = metric("nmbe") * (mean if is_temperature else 100)
        return Error(of_channel.name, self.periods[period], self.resolutions[resolution],
                     np.fmax.reduce(metric("n")), error, bias, "K" if is_temperature else "%",
                     100 * self.value("coverage", period, resolution, channel))

    def errors(self):
        """Of all channels, periods and resolutions that are measured."""
        fits = (self.fit(p, r, c) for p in range(len(self.periods))
                for c in range(len(self.channels)) for r in range(len(self.resolutions)))
        return [fit for fit in fits if fit.is_measured]

    def judged_errors(self):
        """One for each channel in the period of judging: by the hour, else by the month."""
        p = self.periods.index(self.judged)
        both = ([self.fit(p, r, c) for r in (HOURLY, MONTHLY)] for c in range(len(self.channels)))
        return [fit for fits in both for fit in [f for f in fits if f.is_measured][:1]]


def loop_in(file, stage):
    """The loop of that name; without a name the only one."""
    stages = studies.of_kind(file, "loop")
    if not stages and "stock" in file:
        raise ValueError(f"{file.filename} is of a stock, whose next nights carry on what they found by themselves "
                         "(--after); expected the result of a job of one building")
    if stage is None and len(stages) == 1:
        stage = stages[0]
    if stage not in stages:
        names = ", ".join(stages)
        raise ValueError(f"{file.filename} has " + (f"the loops {names}; choose one by --stage"
                                           if stages else "no finished study of kind \"loop\"; expected one "
                                           "that found its models: where it could not, the run says NOT REACHED"))
    return Loop(file, stage)


def inputs_of(path):
    """Names of the files that its run has read, beside the job."""
    return guard.read_apart(path, lambda file: guard.texts(file["inputs"], "input_file") if "inputs" in file else [])


def read(path, stage=None):
    return guard.read_apart(path, lambda file: loop_in(file, stage))
