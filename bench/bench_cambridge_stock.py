#!/usr/bin/python3
"""The stock of fifteen Cambridge buildings, night by night over simulated weeks.

Usage: bench_cambridge_stock.py [--weeks 6]

The table jobs/cambridge_stock/cambridge_stock.csv is run as it stands, with readings that end some weeks
before they do; each night appends a week to every meter, and the last night appends nothing. Prints what
the first page names, then `name value unit reference ratio`: seconds of a night, buildings done, failed
and drifting, the middle CV(RMSE) of gas in training and in the 28 days that the calibration has not seen
(as it started, and calibrated). Needs the readings in ../shared.
"""
import argparse
import pathlib
import shutil
import statistics
import subprocess
import tempfile
import time

import h5py
import large_job
import pandas as pd

TABLE = large_job.ROOT / "jobs" / "cambridge_stock" / "cambridge_stock.csv"
DATA = large_job.ROOT.parent / "shared" / "data" / "cambridge"
METERS = ("gas_as_published.csv.gz", "electricity_kwh.csv.gz")


def write_meters(folder, weeks_before_end):
    """Readings of each building up to so many weeks before its last."""
    for name in METERS:
        meter = pd.read_csv(DATA / name, index_col=0, parse_dates=True)
        for column in meter:
            last = meter[column].last_valid_index()
            if last is not None:
                meter.loc[meter.index > last - pd.Timedelta(weeks=weeks_before_end), column] = float("nan")
        meter.to_csv(folder / name, compression={"method": "gzip", "compresslevel": 1, "mtime": 0})


def run_night(folder, number, before):
    result = folder / f"night-{number:02}.h5"
    words = ["mpirun", "-np", "2", "--oversubscribe", large_job.PROGRAM, "run", folder / TABLE.name, "-o", result]
    begin = time.perf_counter()
    done = subprocess.run([*words, *(["--after", before] if before else [])], check=False, capture_output=True,
                          text=True)
    if done.returncode not in (0, 65):
        raise SystemExit(f"night {number}: exit code {done.returncode}: {done.stderr}")
    return result, time.perf_counter() - begin


def texts(group, name):
    return [text.decode() for text in group[name][:]]


def middle(group, period, leaf):
    values = [value for value, meter, of in zip(group[leaf][:], texts(group, "stock_fit_meter"),
                                                texts(group, "stock_fit_period"))
              if meter == "gas" and of == period and value == value]
    return 100 * statistics.median(values) if values else float("nan")


def print_night(number, result, seconds):
    with h5py.File(result) as file:
        group = file["stock"]
        status, drift = texts(group, "stock_status"), texts(group, "stock_drift")
        print(f"night_{number:02}_seconds {seconds:.1f} s - -")
        for name in ("calibrated", "unchanged", "failed"):
            print(f"night_{number:02}_{name} {status.count(name)} - - -")
        print(f"night_{number:02}_drifting {sum(map(bool, drift))} - - -")
        for period in ("training", "recent"):
            started, ended = (middle(group, period, leaf) for leaf in ("stock_fit_before", "stock_fit_cv_rmse"))
            print(f"night_{number:02}_{period}_cv_rmse {ended:.1f} % {started:.1f} {ended / started:.3f}",
                  flush=True)


def print_first_page(result):
    """The findings that its sections Shared meters, Zeros and Units list."""
    with h5py.File(result) as file:
        group = file["stock"]
        names, of = texts(group, "stock_building"), group["stock_findings_of"][:]
        rows = [(names[int(k)], finding, action) for k, finding, action in
                zip(of, texts(group, "stock_finding"), texts(group, "stock_finding_action"))]
    kinds = {"shared": [r for r in rows if "shared" in r[2]],
             "zeros": [r for r in rows if "zeros" in r[1] and r[2].startswith("masked")],
             "units": [r for r in rows if "unit" in r[2] or "a step by" in r[1]]}
    page = result.with_suffix(".html").read_text(encoding="utf-8")
    for kind, found in kinds.items():
        print(f"{kind}: " + ", ".join(sorted({name for name, *_ in found})))
        for name, finding, action in found:
            print(f"  {name}: {finding}: {action}")
            if f"<th>{name}<td>" not in page:
                raise SystemExit(f"the first page does not name {name}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--weeks", type=int, default=6)
    weeks = parser.parse_args().weeks
    if not DATA.exists():
        raise SystemExit(f"{DATA} is not here")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        text = TABLE.read_text().replace("../../../shared/data/cambridge/", "")
        (folder / TABLE.name).write_text(text)
        shutil.copy(DATA / "weather.csv.gz", folder)
        before = None
        for number in range(weeks + 1):
            if number < weeks:
                write_meters(folder, weeks - 1 - number)
            result, seconds = run_night(folder, number, before)
            if number == 0:
                print_first_page(result)
            print_night(number, result, seconds)
            before = result


if __name__ == "__main__":
    main()
