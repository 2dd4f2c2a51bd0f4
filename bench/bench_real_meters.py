#!/usr/bin/python3
"""Errors on periods held out, on real meters: the best point of each screening beside a regression
on outdoor temperature (scripts/change_point_baseline), fitted to the same readings.

Prints `name value unit reference ratio`: CV(RMSE) of the best point, hourly and by month, with the
regression's as the reference; the ratio is value / reference. Needs the readings in ../shared.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

import large_job

JOBS = ("cambridge_b24", "cambridge_b13", "tartu_b10045")
DATA = large_job.ROOT.parent / "shared" / "data"
LINE = re.compile(r"  (\S.*?)\s+(regression|best point)\s+CV\(RMSE\) hourly\s+(\S+) %"
                  r"\s+monthly\s+(\S+) %")


def errors_of(table):
    """{period: {model: (hourly, monthly)}} of what change_point_baseline prints."""
    errors = {}
    for period, model, hourly, monthly in LINE.findall(table):
        errors.setdefault(period, {})[model] = float(hourly), float(monthly)
    return errors


def compare(name, folder):
    """Runs the job of that name; both models' table."""
    result = pathlib.Path(folder) / f"{name}.h5"
    subprocess.run(["mpirun", "-np", "2", "--oversubscribe", large_job.PROGRAM, "run",
                    large_job.ROOT / "jobs" / name, "-o", result], check=True,
                   stdout=subprocess.DEVNULL)
    return subprocess.run([large_job.ROOT / "scripts" / "change_point_baseline", result],
                          check=True, stdout=subprocess.PIPE, text=True).stdout


def main():
    if not DATA.exists():
        print(f"skipped: no readings in {DATA}")
        return
    for name in JOBS:
        with tempfile.TemporaryDirectory() as folder:
            table = compare(name, folder)
        print(table, end="", flush=True)
        for period, models in errors_of(table).items():
            if period == "training":
                continue
            for k, resolution in enumerate(("hourly", "monthly")):
                ours, theirs = models["best point"][k], models["regression"][k]
                print(f"{name}_{period.replace(' ', '_')}_{resolution} {ours:.2f} % {theirs:.2f} "
                      f"{ours / theirs:.3f}", flush=True)


if __name__ == "__main__":
    sys.exit(main())
