#!/usr/bin/python3
"""Errors on periods held out, on real meters, of the three models of a loop: the calibrated
standard (plain), with its structure chosen (before), with the effects found (after); beside a
regression on outdoor temperature and hour of the week (scripts/change_point_baseline), fitted to
the same readings.

Prints `name value unit reference ratio`: CV(RMSE), hourly and by month, with the regression's as
the reference; a temperature's RMSE with plain's. Before that the effects found, and the seconds
that a job took on two ranks. At the end of how many series (a meter's or a room's held-out hours,
all of them) the hourly error fell or rose from plain to after, and lies at or below the regression's.
Needs the readings in ../shared.

jobs/cambridge_loops is a stock, which keeps errors only: here its template is filled in, and its
buildings are run as those of another job.
"""
import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import h5py
import large_job

sys.path.insert(0, str(large_job.ROOT / "scripts"))
from report import studies  # noqa: E402

JOBS = large_job.ROOT / "jobs"
STOCK = JOBS / "cambridge_loops"
SHARED = large_job.ROOT.parent / "shared"
DATA = SHARED / "data"
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


def filled_in(folder):
    """A job of the stock's buildings; paths in the template are those of its own folder."""
    template = (STOCK / "building.toml").read_text().replace("../../../shared", str(SHARED))
    names = []
    with open(STOCK / "buildings.csv", encoding="utf-8") as table:
        for line in csv.DictReader(table):
            text = template
            for column, cell in line.items():
                text = text.replace(f"@{column}@", cell)
            names.append(f"{line['name']}.toml")
            (folder / names[-1]).write_text(text)
    job = folder / f"{STOCK.name}.toml"
    job.write_text(f'seed = 1\nbuildings = {json.dumps(names)}\n[[study]]\nkind = "loop"\n')
    return job


def run(job, result):
    """Runs the job; exit code 65, a building that failed, is the table's matter."""
    begin = time.perf_counter()
    done = subprocess.run(["mpirun", "-np", "2", "--oversubscribe", large_job.PROGRAM, "run", job,
                           "-o", result, "--no-report"], check=False, stdout=subprocess.DEVNULL)
    if done.returncode not in (0, 65):
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


def of_all_held_out(errors):
    """[{model: hourly error}] of each series, over all its held-out hours."""
    series = {}
    for (building, channel, period), models in errors.items():
        if period != "training":     # "all held out" is printed after the periods that it joins
            series[building, channel] = {model: error[0] for model, error in models.items()}
    return list(series.values())


def print_counts(series):
    change = [of["after"] / of["plain"] - 1 for of in series]
    beside = [of["after"] <= of["regression"] for of in series if "regression" in of]
    for name, n, of in (("lower_by_10_percent", sum(c <= -0.10 for c in change), len(change)),
                        ("higher_by_1_percent", sum(c > 0.01 for c in change), len(change)),
                        ("not_above_regression", sum(beside), len(beside))):
        print(f"real_series_{name} {n} of_{of} - -")


def main():
    if not DATA.exists():
        print(f"skipped: no readings in {DATA}")
        return
    series = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for job in (JOBS / "twin_house_n2", JOBS / "real_loops", filled_in(folder)):
            result = folder / f"{job.stem}.h5"
            run(job, result)
            print_effects(result)
            errors = errors_of(subprocess.run(
                [large_job.ROOT / "scripts" / "change_point_baseline", result], check=True,
                stdout=subprocess.PIPE, text=True).stdout)
            print_errors(errors)
            series += of_all_held_out(errors)
    print_counts(series)


if __name__ == "__main__":
    sys.exit(main())
