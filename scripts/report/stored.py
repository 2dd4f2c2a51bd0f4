"""The studies of a result as they are stored, read once, so that the file may be closed.

Here no dataset has a meaning. Left out are draws and designs that no picture shows; of very many points
every k-th is kept.
"""
from dataclasses import dataclass, field

import h5py
import numpy as np

from report import guard, studies
from report.result import Loop, functions_in

# No picture shows them, and they are large.
LEFT_OUT = {"sample_a", "sample_b", "design_output", "mape", "monthly_mape", "monthly_nmbe", "best_mape",
            "best_nmbe", "best_monthly_mape", "best_monthly_nmbe", "hourly_total_order_half_width",
            "hourly_first_order_half_width", "target_output"}
GROUPS_LEFT_OUT = {"sample_stats", "posterior_predictive", "observed_data"}
# Rows of these are points.
OF_POINTS = {"points", "score", "cv_rmse", "nmbe", "monthly_cv_rmse", "meets_guideline_14", "point_objective"}
MOST_POINTS = 20000            # enough for any picture
DATA = "data"                  # group of a building with what was found in its readings
OUTDOOR = "outdoor_temperature"
OF_ENDS = ("n_failed", "failed_reason", "failed_item_reason", "shortfall")     # how a study ended, of every kind


@dataclass
class Study:
    """A study: what lies below its group, by path; damage is why that could not be read."""
    path: str
    kind: str
    values: dict = field(default_factory=dict)
    units: dict = field(default_factory=dict)
    damage: str = ""
    loop: Loop = None
    functions: list = field(default_factory=list)  # whose values a posterior sampled
    outdoor: dict = field(default_factory=dict)    # of the building: period -> (time [s], temperature [degC])
    periods: list = field(default_factory=list)    # of the building, the first for training; [] = not known
    kinds: dict = field(default_factory=dict)      # of all studies of the result: path -> kind

    @property
    def building(self):
        return self.path.rpartition("/")[0]

    @property
    def name(self):
        return self.path.rpartition("/")[2]

    def has(self, *names):
        return all(name in self.values for name in names)

    def knows(self, *names):
        """Whether these are there and say something: where all of a study failed, its numbers are NaN."""
        return self.has(*names) and all(np.isfinite(self.values[name]).any() if
                                        isinstance(self.values[name], np.ndarray) else self.values[name]
                                        for name in names)

    def numbers(self, name):
        """An array; without an element where there is none."""
        values = self.values.get(name)
        return values if isinstance(values, np.ndarray) else np.array([])

    def number(self, name):
        """NaN where there is none."""
        values = self.numbers(name)
        return float(values) if values.ndim == 0 else np.nan

    def texts(self, name):
        values = self.values.get(name)
        return values if isinstance(values, list) else []

    def text(self, name):
        return (self.texts(name) or [""])[0]

    def groups_with(self, *names):
        """Paths below the study, "" for itself, of the groups that have all of these."""
        found = {path.rpartition("/")[0] for path in self.values}
        return sorted(group for group in found if self.has(*(join(group, name) for name in names)))

    def inner(self, group):
        """What lies in a group below, as a study of its own."""
        def below(values):
            return {path[len(group) + 1:]: value for path, value in values.items() if path.startswith(group + "/")}
        return Study(join(self.path, group), self.kind, below(self.values), below(self.units))


@dataclass
class Finding:
    series: str
    finding: str
    action: str


@dataclass
class Result:
    title: str
    attributes: dict
    studies: list
    findings: dict             # building -> its findings


def join(group, name):
    return f"{group}/{name}" if group else name


def thinned(dataset, name):
    """All of it, or every k-th point."""
    step = -(-dataset.shape[0] // MOST_POINTS) if name in OF_POINTS and dataset.ndim else 1
    return dataset[::step] if step > 1 else dataset[()]


def paths_of(group, above=""):
    """Paths of the datasets below that a picture may show; links to elsewhere do not count."""
    for name in group:
        if name in LEFT_OUT or not guard.has(group, name):
            continue
        item = group[name]
        if isinstance(item, h5py.Dataset):
            yield join(above, name)
        elif name not in GROUPS_LEFT_OUT:
            yield from paths_of(item, join(above, name))


def read_into(study, group, only=None):
    for path in only or paths_of(group):
        if only and not guard.has(group, path):
            continue
        dataset, name = guard.sound(group[path]), path.rpartition("/")[2]
        if h5py.check_string_dtype(dataset.dtype):
            study.values[path] = guard.texts(group, path)
            continue
        if dataset.dtype.kind not in "fiu":
            raise ValueError(f"dataset {dataset.name} has no numbers")
        study.values[path] = np.asarray(thinned(dataset, name), float)
        study.units[path] = str(dataset.attrs.get("units", ""))


def study_in(file, path, kind):
    """Without its numbers where they cannot be read."""
    study = Study(path, kind)
    try:
        with guard.reading(path):
            if kind == "loop":
                study.loop = Loop(file, path)
                read_into(study, file[path], OF_ENDS)
            else:
                study.functions = functions_in(file[path])
                read_into(study, file[path])
    except guard.Refused as refused:
        return Study(path, kind, damage=str(refused))
    return study


def outdoor_in(study):
    """period -> (time, outdoor temperature), of what it stores."""
    found = {}
    for group in study.groups_with("time", OUTDOOR):
        period = group.removesuffix("/hourly").rpartition("/")[2]
        found[period] = (study.numbers(join(group, "time")), study.numbers(join(group, OUTDOOR)))
    if study.loop:
        for period, channels in study.loop.all_series.items():
            found.update({period: (series.time, series.outdoor) for series in channels.values()
                          if series.outdoor.size == series.time.size})
    return found


def share(all_studies):
    """What one study stores of weather and periods holds for all of its building."""
    outdoor, periods = {}, {}
    for study in all_studies:
        outdoor.setdefault(study.building, {}).update(outdoor_in(study))
        said = study.loop.periods if study.loop else study.texts("period")
        periods[study.building] = periods.get(study.building) or said
    for study in all_studies:
        study.outdoor, study.periods = outdoor[study.building], periods[study.building]


def findings_in(file, building):
    if not building or not guard.has(file, f"{building}/{DATA}"):
        return []
    group = file[building][DATA]
    columns = [guard.texts(group, name) for name in ("series", "finding", "action")]
    return [Finding(*row) for row in zip(*columns)]


def is_of(path, stage):
    return stage in (None, path) or path.startswith(f"{stage}/")


def result_in(file, stages):
    """The studies whose path is one of the stages or lies below it; without stages all."""
    kinds = studies.kinds_in(file)
    chosen = [path for path in kinds if not stages or any(is_of(path, stage) for stage in stages)]
    for stage in stages or []:
        if not any(is_of(path, stage) for path in chosen):
            names = ", ".join(kinds) or "none"
            raise ValueError(f"{file.filename} has no study {stage}; those that it has: {names}")
    if not chosen:
        raise ValueError(f"{file.filename} has no finished study with pictures: what was not reached "
                         "has none; a stock has its page by stock_report")
    beside = {path.rpartition("/")[0] for path in chosen}      # one of the others may have the weather
    everything = [study_in(file, path, kind) for path, kind in kinds.items() if path.rpartition("/")[0] in beside]
    found = [study for study in everything if study.path in chosen]
    if all(study.damage for study in found):
        raise ValueError(found[0].damage)
    share(everything)
    for study in found:
        study.kinds = kinds
    buildings = dict.fromkeys(study.building for study in found)
    if "" in buildings:        # a study of several, or of none
        buildings.update(dict.fromkeys(name for name in file if guard.has(file, f"{name}/{DATA}/series")))
    return Result(str(file.attrs.get("title", "")), {name: str(value) for name, value in file.attrs.items()
                                                     if name != "job"}, found,
                  {building: findings_in(file, building) for building in buildings})


def read(path, stages=None):
    return guard.read_apart(path, lambda file: result_in(file, stages))
