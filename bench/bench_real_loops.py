#!/usr/bin/python3
"""Errors on periods held out, on real meters, of the three models of a loop: the calibrated
standard (plain), with its structure chosen (before), with the effects found (after); beside a
regression on outdoor temperature and hour of the week (scripts/change_point_baseline), fitted to
the same readings.

    bench_real_loops.py [JOB...]

runs all, or the jobs named: `twin_house_n2` is the room temperature of six weeks, in seconds.
Prints `name value unit reference ratio`: CV(RMSE), hourly and by month, with the regression's as
the reference; a temperature's RMSE with plain's. Before that the effects found, and the seconds
that a job took on two ranks. At the end, over series (a meter's or a room's held-out hours, all of
them): in how many the hourly error fell or rose from plain to after, is higher than before by over
1 % and two standard errors (of a bootstrap of fortnights), and lies at or near the regression's; and
the median of after over the regression; and the share of held-out hours and months within the 90 % intervals of after,
as a mean over series and periods. Needs the readings in ../shared.

jobs/cambridge_loops is a stock, which keeps errors only: here its template is filled in, and its
buildings, and those of ../shared/meters, are run as those of another job.
"""
import argparse
import csv
import gzip
import json
import math
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

import h5py
import large_job
import numpy as np
from change_of_errors import by_fortnight, is_worse

sys.path.insert(0, str(large_job.ROOT / "scripts"))
from report import result as stored, studies  # noqa: E402

JOBS = large_job.ROOT / "jobs"
STOCK = JOBS / "cambridge_loops"
SHARED = large_job.ROOT.parent / "shared"
DATA, METERS = SHARED / "data", SHARED / "meters"
HEAD = re.compile(r"(\S+)/\S+, (\S+): ")
LINE = re.compile(r"  (\S.*?)\s+(plain|before|after|regression)\s+(?:RMSE|CV\(RMSE\)) "
                  r"hourly\s+(\S+) (\S+)(?:\s+monthly\s+(\S+) %)?")


def errors_of(table):
    """{(building, channel, period): {model: (hourly, unit, monthly or None)}} of what
    change_point_baseline prints."""
    errors, place = {}, None
    for text in table.splitlines():
        if head := HEAD.match(text):
            place = head.groups()
        elif line := LINE.match(text):
            period, model, hourly, unit, monthly = line.groups()
            errors.setdefault((*place, period), {})[model] = (
                float(hourly), unit, float(monthly) if monthly else None)
    return errors


def rows_of(table):
    with open(table, encoding="utf-8") as rows:
        return list(csv.DictReader(rows))


def unit_of_gas(row):
    """The unit of kWh, m3 and 100 ft3 that makes the year's use most like a building's."""
    usual = 150                 # [kWh/(m2 a)]
    with gzip.open(METERS / "cambridge_gas.csv.gz", "rt") as rows:
        read = [line[row["id"]] for line in csv.DictReader(rows)
                if line["time_utc_hour_start"].startswith(row["training"])]
    use = sum(float(value) for value in read if value) / float(row["floor_area_m2"])
    units = {"kWh": 1, "m3": 10.7, "100 ft3": 30.4}
    return min(units, key=lambda unit: abs(math.log(use * units[unit] / usual)))


def as_box(row):
    """A building of ../shared/meters in the columns of the stock: square, 3.5 m a storey, 30 % glass."""
    storey, floors = float(row["roof_area_m2"]), int(row["floors"])
    facade = math.sqrt(storey) * 3.5 * floors
    return {"name": row["id"], "floor_area": row["floor_area_m2"], "storey": storey,
            "volume": 3.5 * storey * floors, "wall": round(0.7 * facade, 1), "window": round(0.3 * facade, 1),
            "training": row["training"], "held_out": row["held_out"], "unit": unit_of_gas(row)}


def template_of(readings=None):
    """The stock's, whose paths are those of its own folder; of other readings, which have gaps of years."""
    text = (STOCK / "building.toml").read_text()
    if readings:
        text = text.replace('file = "../../../shared/data/cambridge/gas_as_published.csv.gz"',
                            f'file = "{readings}"\ngaps = "missing"')
    return text.replace("../../../shared", str(SHARED))


def filled_in(folder, name, rows, template):
    """A job of buildings made from a template."""
    names = []
    for row in rows:
        text = template
        for column, cell in row.items():
            text = text.replace(f"@{column}@", str(cell))
        names.append(f"{row['name']}.toml")
        (folder / names[-1]).write_text(text)
    job = folder / f"{name}.toml"
    job.write_text(f'seed = 1\nbuildings = {json.dumps(names)}\n[[study]]\nkind = "loop"\n')
    return job


def run(job, result):
    """Runs the job; a building that failed (65) or has a bias (1) is the table's matter."""
    begin = time.perf_counter()
    done = subprocess.run(["mpirun", "-np", "2", "--oversubscribe", large_job.PROGRAM, "run", job,
                           "-o", result, "--no-report"], check=False, stdout=subprocess.DEVNULL)
    if done.returncode not in (0, 1, 65):
        raise SystemExit(f"{job} ended with exit code {done.returncode}")
    print(f"{job.stem}_seconds {time.perf_counter() - begin:.1f} s - -", flush=True)


def print_effects(result):
    """Lines that no reader of numbers takes for one."""
    with h5py.File(result) as file:
        for path in studies.of_kind(file, "loop"):
            loop = file[path]
            print(f"{path}: structure: {loop['structure_chosen'].asstr()[()]}; effects: "
                  f"{'; '.join(loop['effect'].asstr()[:]) or 'none'}")


def print_errors(errors):
    for (building, channel, period), models in errors.items():
        if period == "training":
            continue
        for k, resolution in ((0, "hourly"), (2, "monthly")):
            reference = models.get("regression", models["plain"])[k]
            for model in ("plain", "before", "after"):
                value, unit = models[model][k], models[model][1]
                if value is not None:
                    print(f"{building}_{channel}_{period.replace(' ', '_')}_{resolution}_{model} "
                          f"{value:.3f} {unit} {reference:.3f} {value / reference:.3f}", flush=True)


def of_all_held_out(errors, resolution=0):
    """[{model: error}] of each series, over all its held-out hours; by the hour (0) or the month (2)."""
    series = {}
    for (building, channel, period), models in errors.items():
        if period != "training":     # "all held out" is printed after the periods that it joins
            series[building, channel] = {model: error[resolution] for model, error in models.items()}
    return list(series.values())


def squares_of(loop, channel):
    """Of the fortnights of all held-out periods."""
    rows = []
    for period in loop.periods[1:]:
        series = loop.all_series[period][channel]
        rows.append(by_fortnight(series.simulated[[stored.BEFORE, stored.AFTER]] - series.measured))
    return np.concatenate(rows)


def loops_in(result):
    with h5py.File(result) as file:
        return [stored.loop_in(file, path) for path in studies.of_kind(file, "loop")]


def worse_of(loops):
    """Names of the series that are worse after than before."""
    return [f"{loop.building} {channel}" for loop in loops for channel in loop.channels
            if is_worse(squares_of(loop, channel))]


def coverage_of(loops):
    """[(resolution, percent of held-out readings within the 90 % interval of `after`)], of each series and period."""
    return [(fit.resolution, fit.within) for loop in loops for fit in loop.errors()
            if fit.period != loop.periods[0] and math.isfinite(fit.within)]


def print_coverage(shares):
    for resolution in ("hourly", "monthly"):
        of_resolution = [share for of, share in shares if of == resolution]
        if of_resolution:
            mean = statistics.mean(of_resolution)
            print(f"real_series_{resolution}_coverage {mean:.1f} %_of_{len(of_resolution)} 90 {mean / 90:.3f}")


def print_counts(series, worse=()):
    change = [of["after"] / of["plain"] - 1 for of in series]
    ratio = [of["after"] / of["regression"] for of in series if "regression" in of]
    for name, n, of in (("lower_by_10_percent", sum(c <= -0.10 for c in change), len(change)),
                        ("higher_by_1_percent", sum(c > 0.01 for c in change), len(change)),
                        ("worse_than_before", len(worse), len(change)),
                        ("not_above_regression", sum(r <= 1 for r in ratio), len(ratio)),
                        ("within_2_percent_of_regression", sum(r <= 1.02 for r in ratio), len(ratio))):
        print(f"real_series_{name} {n} of_{of} - -")
    if worse:
        print(f"worse than before: {', '.join(worse)}")


def print_medians(hourly, monthly):
    """Of after over the regression."""
    for name, series in (("hourly", hourly), ("monthly", monthly)):
        ratios = [of["after"] / of["regression"] for of in series if "regression" in of]
        if not ratios:
            continue
        print(f"real_series_{name}_after_over_regression_median {statistics.median(ratios):.3f} - 1 "
              f"{statistics.median(ratios):.3f}")


def jobs_in(folder, names):
    """All, or those named."""
    jobs = [JOBS / "twin_house_n2", JOBS / "real_loops",
            filled_in(folder, STOCK.name, rows_of(STOCK / "buildings.csv"), template_of()),
            filled_in(folder, "more_cambridge", map(as_box, rows_of(METERS / "buildings.csv")),
                      template_of(METERS / "cambridge_gas.csv.gz")),
            *sorted((METERS / "jobs").iterdir())]
    known = {job.stem: job for job in jobs}
    if unknown := [name for name in names if name not in known]:
        sys.exit(f"bench_real_loops: no job named {', '.join(unknown)}; there are: "
                 f"{', '.join(known)}")
    return [known[name] for name in names or known]


def jobs_asked(says):
    parser = argparse.ArgumentParser(description=says, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("jobs", nargs="*", metavar="JOB", help="default: all")
    return parser.parse_args().jobs


def main():
    asked = jobs_asked(__doc__)
    if not DATA.exists():
        print(f"skipped: no readings in {DATA}")
        return
    hourly, monthly, worse, within = [], [], [], []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for job in jobs_in(folder, asked):
            result = folder / f"{job.stem}.h5"
            run(job, result)
            print_effects(result)
            errors = errors_of(subprocess.run(
                [large_job.ROOT / "scripts" / "change_point_baseline", result], check=True,
                stdout=subprocess.PIPE, text=True).stdout)
            print_errors(errors)
            hourly += of_all_held_out(errors)
            monthly += of_all_held_out(errors, 2)
            loops = loops_in(result)
            worse += worse_of(loops)
            within += coverage_of(loops)
    print_counts(hourly, worse)
    print_medians(hourly, monthly)
    print_coverage(within)


if __name__ == "__main__":
    sys.exit(main())
