"""What a loop wrote to a result file; `bemcal-batch describe results` names the datasets.

Residuals are simulated - measured. A temperature's errors are in K, the others' in %.
"""
from dataclasses import dataclass

import numpy as np

from report import guard, studies

PLAIN, BEFORE, AFTER = range(3)
HOURLY, MONTHLY = range(2)
LEAST_READINGS = 168           # fewer make no picture


@dataclass
class Series:
    """A channel in a period, hour by hour."""
    time: np.ndarray        # begins of hours [s since 1970]
    measured: np.ndarray    # NaN = missing or masked
    simulated: np.ndarray   # [model x time]
    outdoor: np.ndarray     # outdoor temperature [degC], or nothing

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
    floor: float            # in the error's unit; NaN = unknown

    @property
    def is_measured(self):
        return self.n > 0

    @property
    def is_better(self):
        return self.error[AFTER] < self.error[BEFORE]

    def removed(self, since, until):
        """Share of the error that is gone from one model to a later one."""
        return 1 - self.error[until] / self.error[since]


class Loop:
    """One stage of a result."""

    def __init__(self, file, stage):
        self.stage, self.group = stage, file[stage]
        self.attributes = {name: str(value) for name, value in file.attrs.items()}
        self.building = stage.split("/")[0]
        self.channels, self.units = self.texts("channel"), self.texts("channel_unit")
        self.periods, self.resolutions = self.texts("period"), self.texts("resolution")
        self.metrics, self.parameters = self.texts("metric"), self.texts("parameter")
        self.judged = self._judged()

    def texts(self, name):
        """A list of texts; [] where the dataset is not there."""
        return guard.texts(self.group, name)

    def text(self, name):
        return (self.texts(name) or [""])[0]

    def values(self, name):
        return guard.sound(self.group[name])[()] if guard.has(self.group, name) else np.array([])

    def value(self, name, *place):
        """An element; NaN where it is not there."""
        values = self.values(name)
        inside = values.ndim == len(place) and all(p < n for p, n in zip(place, values.shape))
        return float(values[place]) if inside else np.nan

    @property
    def has_held_out(self):
        return self.judged != self.periods[0]

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
        is_temperature = self.units[channel] == "degC"
        with np.errstate(invalid="ignore", divide="ignore"):
            mean = metric("rmse") / metric("cv_rmse")
        error = metric("rmse") if is_temperature else 100 * metric("cv_rmse")
        bias = metric("nmbe") * (mean if is_temperature else 100)
        floor = self.value("noise_floor", channel) * (1 if is_temperature else 100)
        return Error(self.channels[channel], self.periods[period], self.resolutions[resolution],
                     metric("n")[PLAIN], error, bias, "K" if is_temperature else "%",
                     floor if resolution == HOURLY else np.nan)

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

    def series(self, channel):
        """In the period of judging."""
        def values(name):
            return guard.sound(guard.inner(self.group, f"{self.judged}/{name}"))[()]
        outdoor = "outdoor_temperature"
        return Series(values("time"), values(f"{channel}/measured"), values(f"{channel}/simulated"),
                      values(outdoor) if guard.has(self.group, f"{self.judged}/{outdoor}")
                      else np.array([]))


def read(path, stage=None):
    """The loop of that name in a file; without a name the only one."""
    file = guard.opened(path)
    stages = studies.of_kind(file, "loop")
    if stage is None and len(stages) == 1:
        stage = stages[0]
    if stage not in stages:
        names = ", ".join(stages)
        raise ValueError(f"{path} has " + (f"the loops {names}; choose one by --stage"
                                           if stages else "no study of kind \"loop\""))
    return Loop(file, stage)
