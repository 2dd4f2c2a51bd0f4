"""One run of the user's model: run.json and effects in, hours.csv out; a run of EnergyPlus for each calendar year.

run.json holds `model`, `weather`, `periods` (files), `meters` (name and quantity), `parameters` (name and value), and
perhaps `energyplus`, `rows` (parameters of the user's own), `plant` (of ideal loads) and `schedules` (of the job).
Periods of one year are run periods of one run. Leaves out summer time of meters: hours are the weather's.
"""
import json
import pathlib
import shutil
import tempfile
import time

import numpy as np

from energyplus import effects, hours, parameters, patched, program, weather
from energyplus.changes import Changes
from energyplus.failed import Failed, read_text

RUN, HOURS_FILE, LEFT_OUT = "run.json", "hours.csv", "effects_left_out.txt"
KEYS = {"model": str, "weather": list, "periods": str, "meters": list, "parameters": dict}
MORE = {"energyplus": str, "rows": list, "plant": dict, "schedules": dict}
WORDS = {str: "text", list: "list", dict: "object"}       # of JSON
SCHEMA = "Energy+.schema.epJSON"
KEPT = ("eplusout.err",)       # of what EnergyPlus writes
FILES = ("Schedule:File", "Schedule:File:Shading")
RUN_PERIOD = ("use_weather_file_holidays_and_special_days", "use_weather_file_daylight_saving_period",
              "apply_weekend_holiday_rule", "use_weather_file_rain_indicators", "use_weather_file_snow_indicators")


def read_run(path):
    try:
        given = json.loads(read_text(path, "a run as `bemcal-batch new --simulator` writes it"))
    except ValueError as error:
        raise Failed(f"{path}: {error}; expected JSON") from None
    if not isinstance(given, dict):
        raise Failed(f"{path}: is no object; expected keys {', '.join(KEYS)}")
    for key, kind in {**KEYS, **MORE}.items():
        if key in MORE and key not in given:
            given[key] = kind()
        if not isinstance(given.get(key), kind):
            found = repr(given[key]) if key in given else "missing"
            raise Failed(f"{path}: {key}: is {found}; expected {'an' if kind is dict else 'a'} {WORDS[kind]}")
    for key in given:
        if key not in KEYS and key not in MORE:
            raise Failed(f"{path}: {key}: is not known; expected one of {', '.join([*KEYS, *MORE])}")
    for key, kind in (("weather", str), ("rows", dict)):
        if not all(isinstance(each, kind) for each in given[key]):
            raise Failed(f"{path}: {key}: is {given[key]!r}; expected a list of {WORDS[kind]}s")
    if not all(isinstance(each, dict) and isinstance(each.get("span", 1), (int, float))
               for each in given["schedules"].values()):
        raise Failed(f"{path}: schedules: expected {{schedule: {{hook, span}}}}")
    for meter in given["meters"]:
        if not isinstance(meter, dict) or meter.get("quantity") not in hours.QUANTITIES or "name" not in meter:
            raise Failed(f"{path}: meters: {meter!r}: expected name and quantity, one of {', '.join(hours.QUANTITIES)}")
    return given


class Year:
    """The spans of one calendar year, its weather, and where each hour lies."""

    def __init__(self, year, spans, files):
        self.year, self.spans = year, spans
        self.epw, self.rows = weather.rows_of_year(files, year)
        self.begin = weather.datetime.datetime(year, 1, 1)
        self.n_hours = (weather.datetime.datetime(year + 1, 1, 1) - self.begin).days * 24
        self.shift = {}

    def values(self, series):
        """Of all hours of the year, 0 outside the periods."""
        made = np.zeros(self.n_hours)
        for span in self.spans:
            first = int((span.begin - self.begin) / weather.HOURS)
            made[first:first + span.n_hours] = series[span.at:span.at + span.n_hours]
        return made

    def warm(self, values):
        """Adds K to the outdoor temperature, of hours of the year."""
        for k in np.flatnonzero(values):
            stamp = self.begin + int(k) * weather.HOURS
            self.shift[stamp] = self.shift.get(stamp, 0) + float(values[k])


def set_periods(model, spans):
    """Run periods of exactly these days, with what the model says of holidays and rain."""
    own = next((fields for _, fields in model.all("RunPeriod")), {})
    kept = {key: own[key] for key in RUN_PERIOD if key in own}
    model.remove_beginning("RunPeriod:CustomRange")
    model.remove("RunPeriod")
    for k, span in enumerate(spans, 1):
        last = span.last_day
        model.add("RunPeriod", f"period {k}", {
            **kept, "begin_month": span.begin.month, "begin_day_of_month": span.begin.day,
            "begin_year": span.begin.year, "end_month": last.month, "end_day_of_month": last.day,
            "end_year": last.year})
    model.set_all("SimulationControl", run_simulation_for_sizing_periods="No",
                  run_simulation_for_weather_file_run_periods="Yes")


def distinct(spans):
    """Without days that stand in two periods: they are simulated once."""
    found = []
    for span in sorted(spans, key=lambda each: (each.begin, each.n_hours)):
        end = span.begin + span.n_hours * weather.HOURS
        if found and span.begin <= found[-1][1]:
            found[-1][1] = max(found[-1][1], end)
        else:
            found.append([span.begin, end])
    return [weather.Span(begin, int((end - begin) / weather.HOURS), 0) for begin, end in found]


class Job:
    """What one call works on; `folder` is where run.json lies."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        self.folder = self.path.resolve().parent
        self.given = read_run(self.path)
        self.program = program.find_program(self.given["energyplus"])
        periods = weather.read_periods(self.folder / self.given["periods"])
        self.spans, self.n_hours = weather.spans_of(periods)
        files = [weather.read_epw(self.folder / name) for name in self.given["weather"]]
        self.years = [Year(year, [span for span in self.spans if span.begin.year == year], files)
                      for year in dict.fromkeys(span.begin.year for span in self.spans)]
        self.effects = effects.read_effects(self.folder, self.n_hours)
        self.left_out, self.severe = {}, ""

    def read_model(self):
        """With the files that its schedules read named as they lie in the point's folder."""
        model = program.read_model(self.program, self.folder / self.given["model"], self.folder / "model")
        model.schema = self.program.parent / SCHEMA
        for kind in FILES:
            for _, fields in model.all(kind):
                path = self.folder / fields.get("file_name", "")
                if path.is_file():
                    fields["file_name"] = str(path)
        return model

    def year_of(self, model, year):
        """(model, changes, plant) of a calendar year."""
        model = model.copy()
        changes, plant = Changes(model, year.n_hours), hours.plant_of(model, self.given["plant"])
        try:
            parameters.apply(model, self.given["parameters"], self.given["rows"], changes, plant)
        except Failed as error:
            raise Failed(f"{self.path}: {error}") from None
        effects.enter(self.effects, model, changes, year.values, year.warm, self.given["schedules"], self.left_out)
        changes.finish()
        return model, changes, plant

    def run_year(self, model, year, read):
        folder = self.folder / f"run_{year.year}"
        folder.mkdir(exist_ok=True)
        model, changes, plant = self.year_of(model, year)
        spans = distinct(year.spans)
        set_periods(model, spans)
        hours.ask(model)
        changes.write_series(folder)
        (folder / "in.epJSON").write_text(model.text(), encoding="utf-8")
        weather.write_epw(folder / "in.epw", year.epw, year.rows, year.year, year.shift)
        program.simulate(self.program, folder / "in.epJSON", folder / "in.epw", folder)
        self.severe = self.severe or program.severe_of(folder)
        for span in year.spans:
            read.read(folder / "eplusout.sql", [span])
        clear(folder)
        return plant

    def write_left_out(self):
        path = self.folder / LEFT_OUT
        path.unlink(missing_ok=True)
        if self.left_out:
            path.write_text("".join(f"{line}\n" for line in self.lines_left_out()), encoding="utf-8")

    def lines_left_out(self):
        return [f"{name}: {why}" for (name, _), why in self.left_out.items()]


def clear(folder):
    """Removes what EnergyPlus wrote, which is some 10 MB a run."""
    for path in folder.iterdir():
        if path.is_file() and path.name.startswith(("eplus", "sqlite", "in.", "effects_series")) and \
                path.name not in KEPT:
            path.unlink()


def run(path):
    """All of a point: returns the count of rows written and the seconds that EnergyPlus took."""
    job = Job(path)
    model, read, begin = job.read_model(), hours.Hours(job.n_hours), time.monotonic()
    for year in job.years:
        plant = job.run_year(model, year, read)
    made = hours.energies(read, plant)
    hours.check(read, job.given["meters"], made)
    effects.change_hours(job.effects, made, job.given["meters"], read.floor_area(), job.left_out)
    hours.write(job.folder / HOURS_FILE, job.given["meters"], made)
    job.write_left_out()
    shutil.rmtree(job.folder / "model", ignore_errors=True)
    return job, time.monotonic() - begin


def as_idf(job, model_file):
    """The same model as EnergyPlus writes it as text, beside it."""
    idf = model_file.with_suffix(".idf")
    with tempfile.TemporaryDirectory() as folder:
        shutil.copyfile(program.convert(job.program, model_file, pathlib.Path(folder)), idf)
    return idf


def patch(path):
    """Writes what EnergyPlus would receive beside run.json, and its difference from the user's model."""
    job = Job(path)
    model, made = job.read_model(), []
    for year in job.years:
        changed, changes, _ = job.year_of(model, year)
        made += patched.write(job.folder, model, changed, changes, year, len(job.years) > 1)
        made.append(as_idf(job, made[-1]))
    job.write_left_out()
    return job, made
