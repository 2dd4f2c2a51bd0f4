#!/usr/bin/python3
"""Loops on DOE's buildings as `new --idf` reads them, beside those on a description by hand, on the same readings.

    bench_idf_loads.py [--folder DIR] [CASE...]

The readings are those of ../shared/energyplus/so_null and ap_null: EnergyPlus made them of DOE's small office and
mid-rise apartments, without summer time and holidays, which are taken out of the job. By hand: scripts/run_case.
Prints `name value unit reference ratio`: the held-out error of `after` by the hour, CV(RMSE) or K, with that of the
description by hand as the reference. Needs pyenergyplus-lbnl (tests/energyplus/reports.py) and ../shared.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys

import h5py
import large_job
import pandas

sys.path[:0] = [str(large_job.ROOT / "scripts"), str(large_job.ROOT / "tests" / "energyplus")]
import idf        # noqa: E402  (found above)
import reports    # noqa: E402
from cases.meters import CHANNELS    # noqa: E402
from report import result as stored  # noqa: E402

CASES = large_job.ROOT.parent / "shared" / "energyplus"
MODELS = {"so_null": "RefBldgSmallOfficeNew2004_Chicago.idf", "ap_null": "RefBldgMidriseApartmentNew2004_Chicago.idf"}
PLACE = "US"
QUANTITY_OF_NAME = {"room": "air_temperature"}    # names of meters that `new` gives, others are quantities
SKIPPED = 77


def run(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False,
                          env={**os.environ, "OMP_NUM_THREADS": "1", "BEMCAL_PROGRAM": str(large_job.PROGRAM)})
    if done.returncode not in (0, 1):    # 1: a target is missed
        sys.exit(f"{words[0]} ended with {done.returncode}: {done.stdout[-2000:]}{done.stderr}")


def both_years(case, path):
    """Readings of both years in one file; returns its columns."""
    rows = [(CASES / case / name).read_text().splitlines() for name in ("measured.csv", "measured_test.csv")]
    path.write_text("\n".join([*rows[0], *rows[1][1:]]) + "\n")
    return rows[0][0].split(",")[1:]


def from_file(case, folder):
    """{quantity: error} of the job that `new --idf` writes."""
    energyplus = idf.program()
    model = energyplus and reports.file_like(energyplus, MODELS[case])
    if model is None:
        print(f"skipped: {reports.HOW}")
        sys.exit(SKIPPED)
    job, table = folder / f"{case}.toml", folder / f"{case}.csv"
    words = [f"{table}:{column}:{CHANNELS[column][1]}:{CHANNELS[column][2]}" for column in both_years(case, table)]
    words = [word for meter in words for word in ("--meter", meter)]
    words += [word for year in ("train", "test") for word in ("--weather", CASES / case / f"weather_{year}.epw")]
    run(large_job.PROGRAM, "new", job, "--force", "--idf", model, "--place", PLACE, *words)
    text = re.sub(r"(?m)^summer_time.*\n", "", job.read_text())
    job.write_text(re.sub(r"(?m)^\[holidays\]\n(.+\n)*", "", text))
    result = job.with_suffix(".h5")
    run(large_job.PROGRAM, "run", job, "-o", result, "--force", "--no-report")
    with h5py.File(result) as file:
        loop = stored.Loop(file, f"{case}/loop")
    quantity = {name: QUANTITY_OF_NAME.get(name, name) for name in loop.channels}
    return {quantity[row.channel]: row.error[stored.AFTER] for row in loop.judged_errors()
            if row.resolution == "hourly"}


def by_hand(case, folder):
    """The same of the case's building.json."""
    run(large_job.ROOT / "scripts" / "run_case", CASES / case, folder / case, "--ranks", 1, "--force")
    measured = pandas.read_csv(CASES / case / "measured_test.csv", index_col=0)
    after = pandas.read_csv(folder / case / "after.csv", index_col=0)
    return {CHANNELS[column][1]: error(after[column], measured[column], CHANNELS[column][2]) for column in after}


def error(predicted, measured, unit):
    """RMSE in K, or CV(RMSE) [%]; rows are matched by their stamps."""
    left = (predicted - measured).dropna()
    rmse = float((left**2).mean())**0.5
    return rmse if unit == "degC" else 100 * rmse / float(measured.mean())


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("cases", nargs="*", metavar="CASE", default=list(MODELS))
    parser.add_argument("--folder", type=pathlib.Path, default=large_job.ROOT / "build" / "idf_loads")
    options = parser.parse_args()
    if not CASES.exists():
        print(f"skipped: no {CASES}")
        return SKIPPED
    folder = options.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    for case in options.cases:
        ours, reference = from_file(case, folder), by_hand(case, folder)
        for quantity, value in ours.items():
            unit = "K" if quantity == "air_temperature" else "%"
            other = reference[quantity]
            print(f"{case}_{quantity} {value:.2f} {unit} {other:.2f} {value / other:.2f}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
