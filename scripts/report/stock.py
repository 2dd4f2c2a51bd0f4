"""A night over a stock: its numbers in stock.html, no script, no request.

`bemcal-batch describe results` names the datasets.
"""
import csv
import math
import pathlib
from collections import Counter
from dataclasses import dataclass, field

import h5py
import jinja2
import numpy as np

from report import guard, theme, words

MOST_ROWS = 40
SHARED = "shared"              # a word of every finding of the kind
UNIT = "unit"


@dataclass
class Building:
    name: str
    status: str
    cause: str
    reason: str
    drift: str
    nights_since: int
    fits: list = field(default_factory=list)      # (meter, period, before, cv_rmse, nmbe)
    values: list = field(default_factory=list)    # (parameter, unit, value, low, high, moved)
    findings: list = field(default_factory=list)  # (series, finding, action)

    def first_meter(self):
        return [fit for fit in self.fits if fit[0] == self.fits[0][0]] if self.fits else []

    @property
    def training(self):
        fits = self.first_meter()
        return fits[0][3] if fits else math.nan

    @property
    def recent(self):
        fits = self.first_meter()
        return fits[-1][3] if fits else math.nan

    @property
    def has_changed(self):
        return bool(self.cause) and self.status != "postponed"


def numbers(group, name):
    return list(guard.sound(group[name])[:]) if guard.has(group, name) else []


def zipped(columns):
    """Row by row; no row where a column is missing."""
    return zip(*columns, strict=all(map(len, columns)))


def at(rows, owner):
    """The row that a list of all names by its index."""
    if not 0 <= owner < len(rows):
        raise ValueError(f"{owner} is no place among {len(rows)} buildings")
    return rows[int(owner)]


def rows(group, prefix, names):
    """(index of the building, fields...) of each row of a list."""
    columns = [numbers(group, f"{prefix}_of")]
    for name in names:
        is_text = guard.has(group, name) and h5py.check_string_dtype(guard.sound(group[name]).dtype)
        columns.append(guard.texts(group, name) if is_text else numbers(group, name))
    return zipped(columns)


def night_in(file):
    """(title, buildings) of an open file."""
    if not guard.has(file, "stock"):
        raise ValueError(f"{file.filename}: is no result of a stock")
    group = file["stock"]
    columns = [guard.texts(group, f"stock_{name}")
               for name in ("building", "status", "cause", "reason", "drift")]
    buildings = [Building(*row, int(age)) for *row, age in
                 zipped([*columns, numbers(group, "stock_age")])]
    for owner, *row in rows(group, "stock_fits", [
            "stock_fit_meter", "stock_fit_period", "stock_fit_before", "stock_fit_cv_rmse",
            "stock_fit_nmbe"]):
        at(buildings, owner).fits.append(tuple(row))
    for owner, *row in rows(group, "stock_values", [
            "stock_value_parameter", "stock_value_unit", "stock_value", "stock_value_low",
            "stock_value_high", "stock_value_moved"]):
        at(buildings, owner).values.append(tuple(row))
    for owner, *row in rows(group, "stock_findings", [
            "stock_finding_series", "stock_finding", "stock_finding_action"]):
        at(buildings, owner).findings.append(tuple(row))
    return str(file.attrs.get("title", "stock")), buildings


def read(path):
    title, buildings = guard.read_apart(path, night_in)
    return title, pathlib.Path(path).stem, buildings


def nights_in(path):
    """{night: {building: CV(RMSE) of the last period}}, oldest first."""
    nights = {}
    if path is None or not pathlib.Path(path).exists():
        return nights
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            error = row["cv_rmse_last_period"]
            nights.setdefault(row["night"], {})[row["building"]] = (
                float(error) if error else math.nan)
    return nights


def picture(nights):
    """Errors over the nights: middle, and 10 to 90 % of the buildings."""
    if len(nights) < 2:
        return None
    errors = [np.array([e for e in night.values() if math.isfinite(e)]) * 100
              for night in nights.values()]
    low, middle, high = ([np.percentile(e, q) if e.size else math.nan for e in errors]
                         for q in (10, 50, 90))
    drawn, axes = theme.figure(1.8)
    where = range(len(errors))
    axes.fill_between(where, low, high, color=theme.AFTER, alpha=0.2, linewidth=0)
    axes.plot(where, middle, color=theme.AFTER)
    axes.set_xlabel("night")
    axes.set_ylabel("CV(RMSE) [%]")
    axes.set_title("Error of the last days, middle and 10 to 90 % of the buildings")
    return theme.data_uri(drawn)


def with_word(buildings, word, place):
    """(building, series, finding, action) of the findings that say it."""
    return [(b.name, *finding) for b in buildings for finding in b.findings
            if word in finding[place]]


def contents(read_stock, nights):
    title, night, buildings = read_stock
    worst = sorted((b for b in buildings if math.isfinite(b.recent)),
                   key=lambda b: -b.recent)
    zeros = [(b.name, *f) for b in buildings for f in b.findings
             if "zeros" in f[1] and f[2].startswith("masked")]
    units = with_word(buildings, UNIT, 2) + with_word(buildings, "a step by", 1)
    shared = with_word(buildings, SHARED, 2)
    others = [(b.name, *f) for b in buildings for f in b.findings
              if (b.name, *f) not in zeros + units + shared]
    return {"title": title, "night": night, "words": words, "most": MOST_ROWS,
            "counts": Counter(b.status for b in buildings), "n": len(buildings),
            "failed": [b for b in buildings if b.status == "failed"],
            "changed": [b for b in buildings if b.has_changed and b.status != "failed"],
            "postponed": [b for b in buildings if b.status == "postponed"],
            "drifting": [b for b in buildings if b.drift], "worst": worst, "zeros": zeros,
            "units": units, "shared": shared, "others": others, "picture": picture(nights),
            "n_nights": len(nights),
            "colours": {name: (light, dark) for name, light, dark in theme.COLOURS.values()}}


def html_of(read_stock, nights):
    folder = pathlib.Path(__file__).parent
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(folder), autoescape=True,
                                     trim_blocks=True, lstrip_blocks=True)
    return environment.get_template("stock.html").render(contents(read_stock, nights))
