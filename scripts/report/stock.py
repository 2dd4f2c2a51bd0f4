"""A night over a stock: its numbers in stock.html, and of each building a line that stock.js draws.

`bemcal-batch describe results` names the datasets. The page makes no request, and its Content Security Policy lets no
other script run. Foretold days are known only of buildings whose whole result was kept (`keep_results`).
"""
import base64
import csv
import hashlib
import math
import pathlib
import string
from collections import Counter
from dataclasses import dataclass, field

import h5py
import jinja2
import jinja2.utils
import numpy as np

from report import guard, theme, words

HERE = pathlib.Path(__file__).parent
MOST_ROWS = 40
FOUND = "found: "              # what a finding begins with that is an effect of a loop
TABLE_HEAD = "building,status,"
# A daily sum is one character, a step of least to most: fine enough for a line of two dozen pixels.
LEVELS, GAP = string.digits + string.ascii_letters, " "
CHARACTERS = np.frombuffer((LEVELS + GAP).encode(), np.uint8)
HOUR, DAY = 3600, 86400        # [s]
SAME = 1e-4                    # the stock's daily sums are of single precision
LEAST_NAMED = 0.5              # probability from which on the stock names an effect
SHARED = "shared"              # a word of every finding of the kind
UNIT = "unit"


def no_days():
    return np.empty(0)


@dataclass
class Common:
    """What the buildings of a stock say of each other."""
    effects: list    # as of common_in
    names: list      # as of named_by_stock
    place: list      # as of place_in


@dataclass(eq=False)
class Building:
    name: str
    status: str
    cause: str
    reason: str
    drift: str
    nights_since: int
    told: str = ""
    fits: list = field(default_factory=list)      # (meter, period, before, cv_rmse, nmbe)
    values: list = field(default_factory=list)    # (parameter, unit, value, low, high, moved)
    findings: list = field(default_factory=list)  # (series, finding, action)
    first_day: int = 0                            # of both series [days since 1970]
    measured: np.ndarray = field(default_factory=no_days)  # daily sums [kWh]
    foretold: np.ndarray = field(default_factory=no_days)  # as many, or none

    def worst_meter(self):
        """The fits of that with the largest error in the last period; of alike ones the first."""
        last = {fit[0]: fit[3] for fit in self.fits}
        worst = max(last, key=lambda meter: last[meter] if math.isfinite(last[meter]) else -1, default=None)
        return [fit for fit in self.fits if fit[0] == worst]

    @property
    def training(self):
        fits = self.worst_meter()
        return fits[0][3] if fits else math.nan

    @property
    def before(self):
        fits = self.worst_meter()
        return fits[0][2] if fits else math.nan

    @property
    def recent(self):
        fits = self.worst_meter()
        return fits[-1][3] if fits else math.nan

    @property
    def effects(self):
        return [finding.removeprefix(FOUND) for _, finding, _ in self.findings if finding.startswith(FOUND)]

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


def add_daily_sums(group, buildings):
    """One list holds those of all buildings, one after the other. ValueError where it is too short."""
    counts = numbers(group, "stock_daily_n")
    days = guard.sound(group["stock_daily"])[:] if guard.has(group, "stock_daily") else no_days()
    place = 0
    for building, count, first in zip(buildings, counts, numbers(group, "stock_daily_start")):
        count = int(count)
        if not 0 <= count <= len(days) - place:
            raise ValueError(f"stock_daily_n of {building.name} is {count}, of {len(days) - place} daily sums left")
        building.first_day, building.measured = int(first), days[place:place + count]
        place += count


def sums_by_day(time, values):
    """{day since 1970: sum} of the days with all readings. time [s since 1970] in steps of an hour or less."""
    step = time[1] - time[0] if len(time) > 1 else math.inf
    if not 0 < step <= HOUR:
        return {}
    days, places = np.unique(time // DAY, return_inverse=True)
    is_whole = np.bincount(places) == round(DAY / step)
    return {int(day): total for day, total, whole in
            zip(days, np.bincount(places, weights=values), is_whole) if whole}


def read_if_there(group, *names):
    """The first of the datasets that is there; None where none is."""
    name = next((name for name in names if guard.has(group, name)), None)
    return None if name is None else guard.sound(group[name])[:]


def groups_in(group):
    """Their names."""
    return [name for name in group if guard.has(group, name) and isinstance(group[name], h5py.Group)]


def days_of(study, meter, names):
    """{day since 1970: sum} over all periods of the first of the series that is there, of its last version."""
    days = {}
    for period in groups_in(study):
        time = read_if_there(study, f"{period}/{meter}/time", f"{period}/time")
        values = read_if_there(study, *(f"{period}/{meter}/{name}" for name in names))
        if time is not None and values is not None:
            days |= sums_by_day(time, values[-1] if values.ndim > 1 else values)
    return days


def foretold_in(study, building):
    """Daily sums of the best, last or mean model, whichever is stored, of the meter that the building's sums are of."""
    def aligned(meter, *names):
        days = days_of(study, meter, names)
        return np.array([days.get(building.first_day + k, math.nan) for k in range(len(building.measured))])

    for meter in dict.fromkeys(meter for period in groups_in(study) for meter in groups_in(study[period])):
        measured = aligned(meter, "measured")
        both = np.isfinite(measured) & np.isfinite(building.measured)
        if both.any() and np.allclose(measured[both], building.measured[both], rtol=SAME):
            return aligned(meter, "predicted_mean", "simulated")
    return no_days()


def add_foretold(file, building):
    """Where the whole result was kept."""
    if not len(building.measured) or not guard.has(file, building.name):
        return
    kept = guard.inner(file, building.name)
    for name in groups_in(kept) if isinstance(kept, h5py.Group) else ():
        series = foretold_in(kept[name], building)
        if np.isfinite(series).any():
            building.foretold = series
            return


def night_in(file):
    """(title, buildings, what they have in common) of an open file."""
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
    for building, told in zip(buildings, guard.texts(group, "stock_told") if guard.has(group, "stock_told") else ()):
        building.told = told
    add_daily_sums(group, buildings)
    for building in buildings:
        add_foretold(file, building)
    return (str(file.attrs.get("title", "stock")), buildings,
            Common(common_in(group), named_by_stock(group, buildings), place_in(group)))


def columns_of(group, prefix, names):
    """Those of a table of all buildings; none where one is missing."""
    if not all(guard.has(group, f"{prefix}_{name}") for name in names):
        return []
    return [guard.texts(group, f"{prefix}_{name}") if name in ("effect", "unit", "section")
            else numbers(group, f"{prefix}_{name}") for name in names]


def common_in(group):
    """(effect, buildings, of so many, quartile, median, quartile, unit, expected buildings): those in two buildings or
    more. An older result expects those that it found."""
    columns = columns_of(group, "stock_common", ("effect", "n", "of", "q25", "median", "q75", "unit"))
    if not columns:
        return []
    columns.append(numbers(group, "stock_common_expected") or columns[1])
    return [row for row in zipped(columns) if max(row[1], row[-1]) > 1]


def place_in(group):
    """(effect, unit, buildings, mean, its sd, spread, probability, section) of effects that come with the weather."""
    return list(zipped(columns_of(group, "stock_all", ("effect", "unit", "n", "mean", "sd", "spread", "probability",
                                                       "section"))))


def named_by_stock(group, buildings):
    """(building, its own name, the stock's, how probable) of effects that the stock names otherwise, and of what no
    building could name by itself."""
    effects = [(at(buildings, owner).name, *row) for owner, *row in rows(group, "stock_effects", [
        "stock_effect", "stock_effect_by_stock", "stock_effect_by_stock_probability"])] \
        if guard.has(group, "stock_effect_by_stock") else []
    undecided = zip([building.name for building in buildings], [""] * len(buildings),
                    guard.texts(group, "stock_undecided"), numbers(group, "stock_undecided_probability")) \
        if guard.has(group, "stock_undecided") else ()
    return [row for row in (*effects, *undecided) if row[2] and row[2] != row[1] and row[3] >= LEAST_NAMED]


def table_of(result):
    """The name of the night's CSV: RESULT.csv, or RESULT-table.csv where the first is no run's."""
    result = pathlib.Path(result)
    names = [f"{result.stem}.csv", f"{result.stem}-table.csv"]
    for name in names:
        path = result.with_name(name)
        if path.is_file():
            with open(path, encoding="utf-8", errors="replace") as file:
                if file.read(len(TABLE_HEAD)) == TABLE_HEAD:
                    return name
    return names[0]


def read(path):
    """(title, night, buildings, name of the CSV, what they have in common)"""
    title, buildings, common = guard.read_apart(path, night_in)
    return title, pathlib.Path(path).stem, buildings, table_of(path), common


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


def rounded(value, decimals=0):
    """None where it is not known; JSON has no other word for it."""
    return round(float(value), decimals) if math.isfinite(value) else None


def drawn(days, least, most):
    """A character of LEVELS for each day, GAP where nothing is known."""
    step = (most - least) / (len(LEVELS) - 1) or 1
    known = np.isfinite(days)
    levels = np.full(len(days), len(LEVELS))
    levels[known] = np.round((days[known] - least) / step)
    return CHARACTERS[levels].tobytes().decode()


def sparkline(building):
    """(mean of the measured days [kWh/d], first day, least, most, measured, foretold)"""
    both = np.concatenate([building.measured, building.foretold])
    known = building.measured[np.isfinite(building.measured)]
    if not known.size:
        return None, 0, None, None, "", ""
    both = both[np.isfinite(both)]
    least, most = min(0, both.min()), both.max()
    if not math.isfinite(most - least):
        raise ValueError(f"the daily sums of {building.name} have no finite range")
    return (rounded(known.mean(), 1), building.first_day, rounded(least), rounded(most),
            drawn(building.measured, least, most), drawn(building.foretold, least, most))


# What stands in the table: column, heading, whether it is a number.
HEADS = (("name", "building", False), ("status", "status", False), ("mean", "daily [kWh/d]", True),
         ("start", "at start", True), ("training", "training", True), ("last", "last period", True),
         ("drift", "drift", False), ("nights", "nights since", True), ("findings", "findings", True),
         ("effects", "effects found", False))
COLUMNS = ("name", "status", "why", "start", "training", "last", "drift", "nights", "findings", "effects",
           "mean", "first_day", "least", "most", "measured", "foretold")


def line(building):
    """What stock.js draws of a building, in the order of COLUMNS; errors in %."""
    effects = building.effects
    return (building.name, building.status, building.reason or building.cause, rounded(100 * building.before, 1),
            rounded(100 * building.training, 1), rounded(100 * building.recent, 1), building.drift,
            building.nights_since, len(building.findings) - len(effects), "; ".join(effects), *sparkline(building))


def json_of(buildings):
    """Column by column, safe within a script element."""
    columns = zip(*map(line, buildings)) if buildings else ((),) * len(COLUMNS)
    return jinja2.utils.htmlsafe_json_dumps({"levels": LEVELS, **dict(zip(COLUMNS, columns))},
                                            separators=(",", ":"), allow_nan=False)


def hash_of(script):
    """As a Content Security Policy names it."""
    return "sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()


def data_said(zeros, units, shared):
    """What was found in the data, of what there is."""
    kinds = ((zeros, "meter with filled zeros", "meters with filled zeros"),
             (units, "meter with a unit that was chosen or changes", "meters with a unit that was chosen or changes"),
             (shared, "sign of a shared meter", "signs of shared meters"))
    return words.listed(f"{len(rows)} {one if len(rows) == 1 else many}" for rows, one, many in kinds if rows)


def contents(read_stock, nights):
    title, night, buildings, table, common = read_stock
    worst = sorted((b for b in buildings if math.isfinite(b.recent)),
                   key=lambda b: -b.recent)
    zeros = [(b.name, *f) for b in buildings for f in b.findings
             if "zeros" in f[1] and f[2].startswith("masked")]
    units = with_word(buildings, UNIT, 2) + with_word(buildings, "a step by", 1)
    shared = with_word(buildings, SHARED, 2)
    said = {*zeros, *units, *shared}
    effects = [(b.name, *f) for b in buildings for f in b.findings if f[1].startswith(FOUND)]
    said.update(effects)
    others = [(b.name, *f) for b in buildings for f in b.findings if (b.name, *f) not in said]
    script = (HERE / "stock.js").read_text(encoding="utf-8")
    return {"title": title, "night": night, "words": words, "most": MOST_ROWS,
            "counts": Counter(b.status for b in buildings), "n": len(buildings),
            "failed": [b for b in buildings if b.status == "failed"],
            "changed": [b for b in buildings if b.has_changed and b.status not in ("failed", "tested")],
            "postponed": [b for b in buildings if b.status == "postponed"],
            "told": [b for b in buildings if b.told], "common": common.effects, "by_stock": common.names,
            "place": common.place,
            "drifting": [b for b in buildings if b.drift], "worst": worst, "zeros": zeros,
            "units": units, "shared": shared, "others": others, "effects": effects,
            "data_said": data_said(zeros, units, shared), "picture": picture(nights),
            "n_nights": len(nights), "table": table, "heads": HEADS, "lines": json_of(buildings),
            "has_foretold": any(len(b.foretold) for b in buildings),
            "script": jinja2.utils.markupsafe.Markup(script), "script_hash": hash_of(script),
            "colours": {name: (light, dark) for name, light, dark in theme.COLOURS.values()}}


def html_of(read_stock, nights):
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True,
                                     trim_blocks=True, lstrip_blocks=True)
    return environment.get_template("stock.html").render(contents(read_stock, nights))
