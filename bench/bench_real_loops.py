#!/usr/bin/python3
"""Errors on periods held out, on real meters, of the three models of a loop: the calibrated
standard (plain), with its structure chosen (before), with the effects found (after); beside a
regression on outdoor temperature and hour of the week (scripts/change_point_baseline), fitted to
the same readings.

Prints `name value unit reference ratio`: CV(RMSE), hourly and by month, with the regression's as
the reference; a temperature's RMSE with plain's. Before that the effects found, and the seconds
that a job took on two ranks. Needs the readings in ../shared.
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import h5py
import large_job

JOBS = ("twin_house_n2", "real_loops")
DATA = large_job.ROOT.parent / "shared" / "data"
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


def run(name, result):
    """Runs the job of that name; exit code 65, a building that failed, is the table's matter."""
    begin = time.perf_counter()
    done = subprocess.run(["mpirun", "-np", "2", "--oversubscribe", large_job.PROGRAM, "run",
                           large_job.ROOT / "jobs" / name, "-o", result, "--no-report"],
                          check=False, stdout=subprocess.DEVNULL)
    if done.returncode not in (0, 65):
        raise SystemExit(f"{name} ended with exit code {done.returncode}")
    print(f"{name}_seconds {time.perf_counter() - begin:.1f} s - -", flush=True)


def print_effects(result):
    """Lines that no reader of numbers takes for one."""
    with h5py.File(result) as file:
        found = []
        file.visititems(lambda name, item: found.append(item)
                        if name.endswith("/structure_chosen") else None)
        for chosen in found:
            names = chosen.parent["effect"].asstr()[:]
            print(f"{chosen.parent.name[1:]}: structure: {chosen.asstr()[()]}; effects: "
                  f"{'; '.join(names) or 'none'}")


def print_errors(errors):
    for (building, channel, period), models in errors.items():
        if period == "training":
            continue
        for k, resolution in ((0, "hourly"), (2, "monthly")):
            reference = models.get("regression", models["plain"])[k]
            for model in ("plain", "before", "after"):
                value, unit = models[model][k], models[model][1]
                if value is not None:
                    print(f"{building}_{channel}_{period}_{resolution}_{model} {value:.3f} {unit} "
                          f"{reference:.3f} {value / reference:.3f}", flush=True)


def main():
    if not DATA.exists():
        print(f"skipped: no readings in {DATA}")
        return
    with tempfile.TemporaryDirectory() as folder:
        for name in JOBS:
            result = pathlib.Path(folder) / f"{name}.h5"
            run(name, result)
            print_effects(result)
            print_errors(errors_of(subprocess.run(
                [large_job.ROOT / "scripts" / "change_point_baseline", result], check=True,
                stdout=subprocess.PIPE, text=True).stdout))


if __name__ == "__main__":
    sys.exit(main())
