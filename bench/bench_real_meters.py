#!/usr/bin/python3
"""Errors on periods held out, on real meters: the best point of each screening beside a regression
on outdoor temperature (scripts/change_point_baseline), fitted to the same readings; and how many
readings, and months where there are twelve, the posterior's 90 % intervals hold.

Prints `name value unit reference ratio`: CV(RMSE) of the best point, hourly and by month, with the
regression's as the reference; shares of readings and months; each posterior's largest rank R-hat.
Needs the readings in ../shared.

    bench_real_meters.py [--posteriors]    without the screenings and their errors
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

import h5py

import large_job

JOBS = ("cambridge_b24", "cambridge_b13", "tartu_b10045")
DATA = large_job.ROOT.parent / "shared" / "data"
PERIODS = ("held_out", "later", "summer_and_autumn")
NOT_CONVERGED = 1  # of the program; its result is whole
LINE = re.compile(r"  (\S.*?)\s+(regression|best point)\s+CV\(RMSE\) hourly\s+(\S+) %"
                  r"\s+monthly\s+(\S+) %")


def errors_of(table):
    """{period: {model: (hourly, monthly)}} of what change_point_baseline prints."""
    errors = {}
    for period, model, hourly, monthly in LINE.findall(table):
        errors.setdefault(period, {})[model] = float(hourly), float(monthly)
    return errors


def job_of(name, folder, posteriors_only):
    """The job's file; of its posterior alone one in that folder."""
    file = large_job.ROOT / "jobs" / name / f"{name}.toml"
    if not posteriors_only:
        return file
    text = re.sub(r'(?s)\[\[study\]\]\nkind = "screening".*?\n\n', "", file.read_text())
    alone = pathlib.Path(folder) / f"{name}.toml"
    alone.write_text(text.replace('"building.toml"', f'"{file.parent / "building.toml"}"'))
    return alone


def run(name, folder, posteriors_only):
    """Runs the job of that name; a posterior that has not converged is a result too."""
    result = pathlib.Path(folder) / f"{name}.h5"
    done = subprocess.run(["mpirun", "-np", "2", "--oversubscribe", large_job.PROGRAM, "run",
                           job_of(name, folder, posteriors_only), "-o", result],
                          stdout=subprocess.DEVNULL)
    if done.returncode not in (0, NOT_CONVERGED):
        sys.exit(f"bench_real_meters: {name}: exit code {done.returncode}")
    return result


def print_errors(name, result):
    table = subprocess.run([large_job.ROOT / "scripts" / "change_point_baseline", result],
                           check=True, stdout=subprocess.PIPE, text=True).stdout
    print(table, end="", flush=True)
    for period, models in errors_of(table).items():
        if period == "training":
            continue
        for k, resolution in enumerate(("hourly", "monthly")):
            ours, theirs = models["best point"][k], models["regression"][k]
            print(f"{name}_{period.replace(' ', '_')}_{resolution} {ours:.2f} % {theirs:.2f} "
                  f"{ours / theirs:.3f}", flush=True)


def print_intervals(name, result):
    with h5py.File(result) as file:
        posterior = file[name]["posterior"]
        rhat = posterior["rhat_rank"][:].max()
        print(f"{name}_rhat {rhat:.3f} - 1.01 {rhat / 1.01:.3f}")
        for period in PERIODS:
            if period not in posterior:
                continue
            (meter,) = posterior[period].values()
            _, hours, _, months = 100 * meter["all/coverage"][:]
            print(f"{name}_{period}_hours_in_90 {hours:.1f} % 90 {hours / 90:.3f}", flush=True)
            if len(meter["all/month"]) == 12:
                print(f"{name}_{period}_months_in_90 {months:.1f} % 90 {months / 90:.3f}",
                      flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--posteriors", action="store_true", help="their intervals alone")
    options = parser.parse_args()
    if not DATA.exists():
        print(f"skipped: no readings in {DATA}")
        return
    for name in JOBS:
        with tempfile.TemporaryDirectory() as folder:
            result = run(name, folder, options.posteriors)
            if not options.posteriors:
                print_errors(name, result)
            print_intervals(name, result)


if __name__ == "__main__":
    sys.exit(main())
