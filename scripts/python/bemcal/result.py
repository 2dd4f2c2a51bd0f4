"""A result file: its studies as xarray, its tables as pandas, its page with pictures.

A study is called by its path, BUILDING/STUDY, or STUDY where it is of all buildings. Datasets, units and meanings are
those of `bemcal-batch describe results`. Times are begins of steps in local standard time. A file is read in a process
of its own, because HDF5 crashes on some that are damaged; whether its numbers are those that were written is checked by
bemcal.status.
Leaves out results of version 0.1.0, whose studies do not say their kind.
"""
from __future__ import annotations

import contextlib
import importlib
import importlib.util
import multiprocessing
import os
import pathlib
import re
import shutil
import sys
import tempfile
import warnings
from dataclasses import dataclass
from typing import Any, Callable, Dict, Iterator, List, Literal, Optional, Tuple, TypeVar, Union

import h5py
import numpy as np
import pandas as pd
import xarray

from . import _guard, program
from .errors import Error, ExitCode
from .refused import Refused

LOOP, SCREENING, POSTERIOR, KENNEDY_OHAGAN = "loop", "screening", "posterior", "kennedy_ohagan"
DRAWS = ("posterior", "sample_stats", "prior", "observed_data", "posterior_predictive")     # ArviZ's groups
NO_VARIABLE = b"This is a netCDF dimension but not a netCDF variable"
NOT_OF_THE_USER = ("CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "_Netcdf4Dimid", "_Netcdf4Coordinates")
TIMES: Dict[str, Literal["s", "D"]] = {     # units of times, and what pandas calls them
    "seconds since 1970-01-01 00:00:00": "s", "days since 1970-01-01": "D"}
PYARROW = "pip install \"pyarrow<26\", the last for Debian 12's NumPy 1.24, or any with NumPy 2 (Debian's own Python " \
          "asks for --break-system-packages, too)"
FIRST = ("measured", "nominal", "plain", "before", "best", "after")     # columns of a series, others behind

Path = Union[str, "os.PathLike[str]"]
T = TypeVar("T")
Tables = Iterator[Tuple[Tuple[str, ...], pd.DataFrame]]     # (names of folders and table, table)


@dataclass(frozen=True)
class Stored:
    """A dataset as it is read: its dimensions by the paths of their scales."""
    name: str
    dims: Tuple[str, ...]
    values: Any
    attributes: Dict[str, str]


@dataclass(frozen=True)
class Group:
    """The datasets and attributes of a group as they are read."""
    parts: List[Stored]
    attributes: Dict[str, str]


@dataclass(frozen=True)
class Head:
    """What a file says of itself."""
    groups: Tuple[str, ...]
    kinds: Dict[str, str]
    shortfalls: Dict[str, List[str]]
    attributes: Dict[str, str]
    run: Dict[str, str]


@contextlib.contextmanager
def refusing(path: pathlib.Path) -> Iterator[None]:
    """What is wrong with the content is an Error."""
    try:
        with _guard.reading(path):
            yield
    except Refused as refused:
        raise Error(str(refused), refused.code) from None


def read_apart(path: pathlib.Path, read: Callable[[h5py.File], T]) -> T:
    with refusing(path):
        if multiprocessing.current_process().daemon:        # which may have no process of its own
            _guard.size_of(path)
            with h5py.File(path, "r") as file:
                return read(file)
        with warnings.catch_warnings():     # a notebook has threads, of which none is in HDF5
            warnings.filterwarnings("ignore", ".*fork", DeprecationWarning)
            found: T = _guard.read_apart(path, read)
        return found


def text_of(value: Any) -> str:
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def attributes_of(item: Any) -> Dict[str, str]:
    """Those that are for the reader, and say something."""
    given = {name: text_of(item.attrs[name]) for name in item.attrs if name not in NOT_OF_THE_USER}
    return {name: text for name, text in given.items() if text}


def is_variable(item: Any) -> bool:
    return isinstance(item, h5py.Dataset) and not bytes(item.attrs.get("NAME", b"")).startswith(NO_VARIABLE)


def kind_of(group: Any) -> str:
    """The word of the job file; "" where the group is no study."""
    kinds = _guard.texts(group, "kind") if isinstance(group.get("kind"), h5py.Dataset) else []
    return kinds[0] if len(kinds) == 1 else ""


def read_head(file: h5py.File) -> Head:
    groups: List[str] = []
    file.visititems(lambda name, item: groups.append(name) if isinstance(item, h5py.Group) else None)
    kinds = {name: kind_of(file[name]) for name in groups}
    shortfalls = {name: _guard.texts(file[name], "shortfall") for name in groups}
    return Head(tuple(groups), {name: kind for name, kind in kinds.items() if kind},
                {name: texts for name, texts in shortfalls.items() if texts}, attributes_of(file),
                attributes_of(file["run"]) if _guard.has(file, "run") else {})


def values_of(dataset: h5py.Dataset) -> Any:
    is_text = h5py.check_string_dtype(_guard.sound(dataset).dtype) is not None
    return dataset.asstr()[()] if is_text else dataset[()]


def stored(dataset: h5py.Dataset) -> Stored:
    """A scale is its own dimension."""
    is_scale = h5py.h5ds.is_scale(dataset.id)
    dims = tuple(dataset.name if is_scale else axis[0].name if len(axis) else f"{dataset.name}_{k}"
                 for k, axis in enumerate(dataset.dims))
    return Stored(dataset.name, dims, values_of(dataset), attributes_of(dataset))


def read_group(file: h5py.File, path: str) -> Group:
    """With the coordinates that lie in groups above."""
    group = _guard.inner(file, path)
    own = [stored(group[name]) for name in group if _guard.has(group, name) and is_variable(group[name])]
    names = {each.name for each in own}
    scales = {dim for each in own for dim in each.dims} - names
    above = [stored(file[dim]) for dim in sorted(scales) if dim in file and is_variable(file[dim])]
    return Group(own + above, attributes_of(group))


def leaf(path: str) -> str:
    return path.rsplit("/", 1)[-1]


def variable_of(part: Stored) -> xarray.Variable:
    """With names in place of paths; numbers since 1970 become times."""
    dims, attributes = [leaf(dim) for dim in part.dims], dict(part.attributes)
    unit = TIMES.get(attributes.get("units", ""))
    if unit is None:
        return xarray.Variable(dims, part.values, attributes)
    del attributes["units"]
    times = pd.to_datetime(np.asarray(part.values, float).ravel(), unit=unit)
    return xarray.Variable(dims, times.to_numpy().reshape(np.shape(part.values)), attributes)


def dataset_of(group: Group) -> xarray.Dataset:
    variables = {leaf(part.name): variable_of(part) for part in group.parts}
    coordinates = [name for name, variable in variables.items() if variable.dims == (name,)]
    return xarray.Dataset(variables, attrs=group.attributes).set_coords(coordinates)


def is_installed(module: str) -> bool:
    return importlib.util.find_spec(module) is not None


def check_pyarrow() -> None:
    """Whether it is there and starts: each of its versions takes a least one of NumPy."""
    if not is_installed("pyarrow"):
        raise Error(f"Parquet takes pyarrow, which {sys.executable} has not: {sys.executable} -m {PYARROW}; CSV does "
                    "without", ExitCode.NO_INPUT)
    try:
        importlib.import_module("pyarrow")
    except ImportError as error:
        raise Error(f"Parquet takes pyarrow, which does not start ({error}): {PYARROW}; CSV does without",
                    ExitCode.NO_INPUT) from None


def by_step(group: xarray.Dataset) -> pd.DataFrame:
    """What a group has over time, a column each; of several models, candidates or versions one each."""
    columns: Dict[str, Any] = {}
    for name, variable in group.data_vars.items():
        if variable.dims == ("time",):
            columns[str(name)] = variable.to_numpy()
        elif variable.dims[1:] == ("time",) and name == "simulated":
            labels = variable[variable.dims[0]].to_numpy()
            columns.update({str(label): row for label, row in zip(labels, variable.to_numpy())})
    order = sorted(columns, key=lambda name: FIRST.index(name) if name in FIRST else len(FIRST))
    return pd.DataFrame(columns, index=pd.DatetimeIndex(group["time"].to_numpy(), name="time"))[order]


def by_dimensions(group: xarray.Dataset) -> Iterator[Tuple[str, pd.DataFrame]]:
    """A table for each set of dimensions: a row for each place, a column for each dataset."""
    names: Dict[Tuple[str, ...], List[str]] = {}
    for name, variable in group.data_vars.items():
        names.setdefault(tuple(map(str, variable.dims)), []).append(str(name))
    for dims, variables in names.items():
        if not dims:
            yield "values", pd.DataFrame([{name: group[name].item() for name in variables}])
        else:
            yield "_by_".join(dims), group[variables].to_dataframe().reset_index()


def new_folder(path: Path, force: bool) -> pathlib.Path:
    place = pathlib.Path(path)
    if place.exists() and not force:
        raise Error(f"{place}: is there already; force=True writes into it", ExitCode.CANNOT_CREATE)
    return place


@contextlib.contextmanager
def writing_into(folder: pathlib.Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise Error(f"{folder}: cannot be written: {error.strerror or error}", ExitCode.IO) from None


def folder_name(name: str) -> str:
    """Of a building or study, which may be called anything."""
    return re.sub(r"^\.+", "_", re.sub(r"[/\\\0]", "_", name)) or "_"


class Result:
    """What a run wrote. `bemcal.open(path)` makes one; `stages` are its studies, with the kind of each.

        result["office/loop"]                       the datasets of a study, an xarray.Dataset
        result["office/loop/held_out/gas"]          those of a group below it
        result["loop"]                              the only study of that name or kind
        result["loop/held_out/gas"]                 a group below it
    """

    def __init__(self, path: Path) -> None:
        self.path = pathlib.Path(path)
        head = read_apart(self.path, read_head)
        if head.attributes.get("COMPLETE") != "yes":
            raise Error(f"{self.path}: is no complete result of bemcal-batch; bemcal.status says how far a run is",
                        ExitCode.DATA)
        self._head = head
        self._mark = self._file_mark()
        self._read: Dict[str, xarray.Dataset] = {}

    @property
    def stages(self) -> Dict[str, str]:
        """{BUILDING/STUDY: kind}, kinds as in a job: "loop", "posterior", ..."""
        return dict(self._head.kinds)

    @property
    def attributes(self) -> Dict[str, str]:
        """Of the file: title, seed, version, job (its text), hashes."""
        return dict(self._head.attributes)

    @property
    def run(self) -> Dict[str, str]:
        """Of the run: times, ranks, threads, host, dates."""
        return dict(self._head.run)

    @property
    def shortfalls(self) -> Dict[str, List[str]]:
        """{group: targets that were missed}"""
        return dict(self._head.shortfalls)

    def __repr__(self) -> str:
        stages = "".join(f"\n  {stage}: {kind}" for stage, kind in self.stages.items())
        return f"<bemcal.Result {self.path}>{stages}"

    def __iter__(self) -> Iterator[str]:
        return iter(self.stages)

    def __contains__(self, path: object) -> bool:
        return path in self._head.groups

    def __getitem__(self, stage: str) -> xarray.Dataset:
        """The datasets of a study or another group, with coordinates (parameter, period, meter, time, ...), units and
        meanings (attributes units and long_name), and the group's own attributes (those of "run")."""
        path = self._group(stage)
        if path not in self._read:
            if self._file_mark() != self._mark:
                raise Error(f"{self.path}: was written anew since it was opened; open it again", ExitCode.DATA)
            group = read_apart(self.path, lambda file: read_group(file, path))
            with refusing(self.path):
                self._read[path] = dataset_of(group)
        return self._read[path].copy()

    @property
    def effects(self) -> pd.DataFrame:
        """`effects_of` the only loop."""
        return self.effects_of()

    @property
    def errors(self) -> pd.DataFrame:
        """`errors_of` the only loop."""
        return self.errors_of()

    def effects_of(self, stage: Optional[str] = None) -> pd.DataFrame:
        """The effects that a loop found, a row each, by name. Several may have the same one ("other hours than
        declared"): `follows` tells them apart, and reset_index() numbers them as `row` of `effect_values_of` does.

        coefficient, least, most   as calibrated, and its 90 % interval, in `unit`; NaN of what is there or not
        hook, follows, gate        where it enters, what it follows and how, when
        gain                       of evidence, in -2 log
        probability                that it is the cause; what is missing to 1 is others, or none that has a name
        adequate, doubt            False: the name is only the nearest one, and why
        not_told_from              effects that may be the cause in its place
        separates                  the measurement that would
        brings ... [unit]          what each meter, cost and CO2 has more with it (`effect_values_of`: with intervals)
        """
        loop = self._loop(stage)
        names = {"coefficient": "coefficient", "least": "least", "most": "most", "unit": "unit", "hook": "hook",
                 "follows": "shape", "gate": "gate", "gain": "gain", "adequate": "adequate", "doubt": "doubt",
                 "separates": "separates"}
        table = pd.DataFrame({name: loop[f"effect_{own}"].to_numpy() for name, own in names.items()},
                             index=pd.Index(loop["effect"].to_numpy(), name="effect"))
        table["adequate"] = table["adequate"] == 1
        is_choice = table["least"] == table["most"]       # there or not, without a size
        table.loc[is_choice, ["coefficient", "least", "most"]] = np.nan
        of, members = loop["effect_class_of"].to_numpy().astype(int), loop["effect_class_member"].to_numpy()
        probabilities = loop["effect_class_probability"].to_numpy() if "effect_class_probability" in loop \
            else np.full(len(of), np.nan)
        others: List[List[str]] = [[] for _ in table.index]
        own = np.full(len(table), np.nan)
        for k, member, probability in zip(of, members, probabilities):
            if member == table.index[k]:
                own[k] = probability
            else:
                others[k].append(member)
        table.insert(list(table).index("adequate"), "probability", own)
        table.insert(list(table).index("separates"), "not_told_from", ["; ".join(each) for each in others])
        for (of, unit), rows in self.effect_values_of(stage).groupby(["of", "unit"], sort=False):
            table[f"brings {of} [{unit}]"] = rows.set_index("row")["value"].reindex(range(len(table))).to_numpy()
        return table

    def effect_values_of(self, stage: Optional[str] = None) -> pd.DataFrame:
        """What each effect brings: effect, of (a meter, cost or CO2), unit, value, least, most (90 % interval), and
        what tells effects of the same name apart: follows, and row, the effect's place in `effects_of`, counted from 0.
        The value is with the effect less without it, per year where training is about one."""
        loop = self._loop(stage)
        row = loop["effect_value_effect"].to_numpy().astype(int)
        return pd.DataFrame({"effect": loop["effect"].to_numpy()[row],
                             "of": loop["effect_value_of"].to_numpy(), "unit": loop["effect_value_unit"].to_numpy(),
                             "value": loop["effect_value"].to_numpy(), "least": loop["effect_value_least"].to_numpy(),
                             "most": loop["effect_value_most"].to_numpy(),
                             "follows": loop["effect_shape"].to_numpy()[row], "row": row})

    def measurements_of(self, stage: Optional[str] = None) -> pd.DataFrame:
        """What to measure next: question (two names, or a parameter), kind (name, parameter), measure, start (the first
        day of the weeks that tell most), weeks, now and then (of a name the chance that the likelier one is right, of a
        parameter its standard deviation as a share of its prior's), advised (the cheapest that is enough, or else the
        one that tells most)."""
        loop = self._loop(stage)
        names = {"question": "_question", "kind": "_kind", "measure": "", "start": "_from", "weeks": "_weeks",
                 "now": "_now", "then": "_then", "advised": "_advised"}
        table = pd.DataFrame({name: loop[f"measurement{own}"].to_numpy() for name, own in names.items()})
        table["advised"] = table["advised"] == 1
        return table

    def errors_of(self, stage: Optional[str] = None) -> pd.DataFrame:
        """Errors of a loop's three models. Rows: period, meter, resolution (hourly, monthly), metric (n: readings;
        cv_rmse, nmbe as fractions; rmse in the meter's unit). Columns: plain (the calibrated standard), before (with
        its structure chosen), after (with the effects found). What is not measured is left out.

        Of a screening: nominal and best; its first resolution is the meter's own (interval), with more metrics."""
        fit = self._fit(self._stage(stage or LOOP))
        fit = fit.where(fit.sel(metric="n") > 0)
        places = ["period", "meter", "resolution", "metric"]
        table = fit.transpose(*places, "model").to_series().unstack("model")
        order = pd.MultiIndex.from_product([fit[name].to_numpy() for name in places], names=places)
        return table.reindex(order)[list(fit["model"].to_numpy())].dropna(how="all")

    def hours(self, meter: str, period: str, stage: Optional[str] = None) -> pd.DataFrame:
        """A meter in a period, over the begins of its steps (DatetimeIndex, local standard time), in its unit.

        Of a loop: measured (NaN = missing or masked), plain, before, after, predicted_q05 and predicted_q95 (the 90 %
        interval of after). Of a posterior: measured, nominal, predicted_mean and its interval. Of other studies
        measured, and what each candidate or version shows. Default: of the only loop.
        """
        path = f"{self._stage(stage or LOOP)}/{period}/{meter}"
        if path not in self or "time" not in self[path].coords:
            there = [group for group in self._head.groups
                     if group.startswith(self._stage(stage or LOOP) + "/") and group.count("/") == path.count("/")]
            raise Error(f"{path} is not in {self.path}; expected a meter and a period of: {', '.join(there) or 'none'}",
                        ExitCode.USAGE)
        return by_step(self[path])

    def posterior(self, stage: Optional[str] = None) -> Any:
        """Draws of a posterior: its groups posterior, sample_stats, prior, observed_data, posterior_predictive, with
        dimensions chain and draw first. With arviz installed they are its InferenceData (of arviz 1 and later a
        DataTree), else a dictionary of xarray.Datasets. Default: the only posterior or kennedy_ohagan."""
        kinds = [kind for kind in (POSTERIOR, KENNEDY_OHAGAN) if kind in self.stages.values()]
        path = self._stage(stage or (kinds or [POSTERIOR])[0])
        groups = {name: self[f"{path}/{name}"] for name in DRAWS if f"{path}/{name}" in self}
        if not groups:
            raise Error(f"{path} in {self.path} has no draws; expected a posterior", ExitCode.USAGE)
        if not is_installed("arviz"):
            return groups
        import arviz
        if hasattr(arviz, "InferenceData"):
            return arviz.InferenceData(**groups)
        return xarray.DataTree.from_dict(groups)  # type: ignore[attr-defined]

    def report(self) -> str:
        """The tables that the program prints: `bemcal-batch report`."""
        return program.asked(["report", os.fspath(self.path)])

    def page(self, path: Path, stage: Optional[str] = None, force: bool = False) -> pathlib.Path:
        """Writes the page with pictures (HTML, one file) and returns its path. It takes matplotlib and jinja2.

        stage  BUILDING/STUDY, where the page is to be of that study alone
        force  writes over a file that is there
        """
        file = pathlib.Path(path)
        if file.exists() and (not force or file.samefile(self.path)):
            raise Error(f"{file}: " + ("is there already; force=True writes over it" if not force else
                                       "is the result itself"), ExitCode.CANNOT_CREATE)
        words = [os.fspath(self.path), os.fspath(file), *program.options(stage=stage)]
        program.run_script(program.script("result_report"), words)
        return file

    def plot(self, folder: Path, stage: Optional[str] = None, force: bool = False) -> List[pathlib.Path]:
        """Writes the pictures of the page as SVG files into a folder and returns these.

        folder  is made; one that is there is an Error (CANNOT_CREATE) unless force, which writes over its pictures
        """
        place, script = new_folder(folder, force), program.script("result_report")
        with tempfile.TemporaryDirectory() as made:
            pictures = pathlib.Path(made, "pictures")
            program.run_script(script, [os.fspath(self.path), os.path.join(made, "page.html"), "--figures",
                                        os.fspath(pictures), *program.options(stage=stage)])
            with writing_into(place):
                shutil.copytree(pictures, place, dirs_exist_ok=True)
            return sorted(place / picture.name for picture in pictures.iterdir())

    def tables(self) -> Tables:
        """Everything as tables: (path, DataFrame). A path names building, study, groups below it and the dimensions;
        "hours" are the series of a meter in a period."""
        for stage in (path for path, kind in self.stages.items() if kind == LOOP):
            yield (*stage.split("/"), "effects"), self.effects_of(stage).reset_index()
            yield (*stage.split("/"), "errors"), self.errors_of(stage).reset_index()
        for group in self._head.groups:
            names = tuple(group.split("/"))
            content = self[group]
            if "time" in content.coords and "measured" in content:
                yield (*names, "hours"), by_step(content).reset_index()
                content = content.drop_dims("time")
            for name, table in by_dimensions(content):
                yield (*names, name), table

    def to_csv(self, folder: Path, force: bool = False) -> List[pathlib.Path]:
        """Writes every dataset as `bemcal-batch report --csv` does: folders by building and study, a file for each
        leading dimension with a row for each place on it, units in the headings.

        folder  is made; one that is there is an Error (CANNOT_CREATE) unless force. Returns the files.
        """
        place = new_folder(folder, force)
        with tempfile.TemporaryDirectory() as made:
            csv = pathlib.Path(made, "csv")
            program.asked(["report", os.fspath(self.path), "--csv", os.fspath(csv)])
            with writing_into(place):
                shutil.copytree(csv, place, dirs_exist_ok=True)
            return sorted(place / file.relative_to(csv) for file in csv.rglob("*.csv"))

    def to_parquet(self, folder: Path, force: bool = False) -> List[pathlib.Path]:
        """Writes `tables` as Parquet files in folders by building and study, and columns.csv, which says the unit and
        meaning of each column. It takes pyarrow.

        folder  is made; one that is there is an Error (CANNOT_CREATE) unless force. Returns the files.
        """
        check_pyarrow()
        place, files, columns = new_folder(folder, force), [], []
        with writing_into(place):
            for names, table in self.tables():
                file = place.joinpath(*map(folder_name, names[:-1]), names[-1] + ".parquet")
                file.parent.mkdir(parents=True, exist_ok=True)
                table.to_parquet(file, index=False, engine="pyarrow")
                files.append(file)
                columns.append(self._columns(names, table, file.relative_to(place).as_posix()))
            pd.concat(columns).to_csv(place / "columns.csv", index=False)
        return [*files, place / "columns.csv"]

    def _file_mark(self) -> Tuple[int, int, int]:
        with refusing(self.path):
            state = os.stat(self.path)
        return state.st_ino, state.st_size, state.st_mtime_ns

    def _stage(self, name: str) -> str:
        """The study of that path; else the only one of that name or kind."""
        if name in self.stages:
            return name
        found = [path for path, kind in self.stages.items() if name in (kind, leaf(path))]
        if len(found) == 1:
            return found[0]
        what = f"several studies {name!r}: {', '.join(found)}" if found else \
            f"no study or group {name!r}; its studies are {', '.join(self.stages) or 'none'}"
        raise Error(f"{self.path} has {what}", ExitCode.USAGE)

    def _group(self, name: str) -> str:
        """The path of a study or group; one below a study may begin with the study's name or kind alone."""
        head, slash, rest = name.partition("/")
        is_short = name not in self and slash and any(head in (kind, leaf(path)) for path, kind in self.stages.items())
        if not is_short:
            return name if name in self else self._stage(name)
        stage = self._stage(head)
        path = f"{stage}/{rest}"
        if path not in self:
            below = [group for group in self._head.groups if group.startswith(stage + "/")]
            raise Error(f"{path} is not in {self.path}; expected one of: {', '.join(below) or 'none'}", ExitCode.USAGE)
        return path

    def _loop(self, stage: Optional[str]) -> xarray.Dataset:
        """That loop, or the only one."""
        path = self._stage(stage or LOOP)
        if self.stages[path] != LOOP:
            raise Error(f"{path} is a study of kind {self.stages[path]!r}; expected a loop", ExitCode.USAGE)
        return self[path]

    def _fit(self, path: str) -> xarray.DataArray:
        """Errors by model, period, meter, resolution and metric."""
        study, kind = self[path], self.stages[path]
        if kind == LOOP:
            return study["fit"].rename(channel="meter")
        if kind == SCREENING:
            both = [study[name].expand_dims(resolution=[resolution])
                    for resolution, name in (("interval", "fit"), ("monthly", "monthly_fit"))]
            return xarray.concat(both, "resolution").rename(candidate="model")
        raise Error(f"{path} is a study of kind {kind!r}; expected a loop or a screening; result[{path!r}] has what it "
                    "stores", ExitCode.USAGE)

    def _columns(self, names: Tuple[str, ...], table: pd.DataFrame, file: str) -> pd.DataFrame:
        """Rows of columns.csv."""
        group = "/".join(names[:-1])
        content = self[group] if group in self else xarray.Dataset()
        known = {str(column): content[column].attrs if column in content.variables else {} for column in table}
        return pd.DataFrame({"file": file, "column": list(known),
                             "unit": [each.get("units", "") for each in known.values()],
                             "meaning": [each.get("long_name", "") for each in known.values()]})


def open_result(path: Path) -> Result:
    """Opens the result file of a run. Error: NO_INPUT where there is none, DATA where it is damaged or not complete."""
    return Result(path)
