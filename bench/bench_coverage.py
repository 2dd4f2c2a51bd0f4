#!/usr/bin/python3
"""Do the 90 % intervals of `after` hold readings that a loop has not seen? Cases of ../shared/energyplus and
../shared/cases/dev, by the hour and by the month, over the year that each case holds out.

    bench_coverage.py [CASE...]

BEMCAL_BENCH_LOOPS names a folder that scripts/run_case has written for these cases already. Prints
`name value unit reference ratio`: of each case and meter, then of all meters of a folder of cases, each case's meter
counting once. A month is the sum of its hours with a reading, a room's temperature their mean.
"""
import pathlib
import statistics
import sys
import tempfile

import h5py
import numpy as np
import pandas

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "bench"), str(ROOT / "scripts")]
from bench_adopt import first_loops      # noqa: E402
from cases.meters import CHANNELS        # noqa: E402
from loop_scores import held_out         # noqa: E402

SHARED = ROOT.parent / "shared"
FOLDERS = (SHARED / "energyplus", SHARED / "cases" / "dev")
WANTED = 90
IS_TEMPERATURE = "air"


def cases_in(folders):
    return [path for folder in folders if folder.exists() for path in sorted(folder.iterdir())
            if (path / "measured_test.csv").exists()]


def hours_within(series, readings):
    """Percent; the hours of the series come first in both."""
    low, high = series["predicted_q05"][:], series["predicted_q95"][:]
    n = min(len(low), len(readings))
    known = np.isfinite(readings[:n]) & np.isfinite(low[:n])
    inside = (readings[:n] >= low[:n]) & (readings[:n] <= high[:n])
    return 100 * inside[known].mean()


def months_within(period, series, readings, is_mean):
    """Percent of the months in which nearly all hours were read."""
    hours = pandas.to_datetime(period["time"][:], unit="s")
    n = min(len(hours), len(readings))
    months = pandas.Series(readings[:n], hours[:n].to_period("M")).groupby(level=0)
    read = (months.mean() if is_mean else months.mean() * months.size())[months.count() > 0.9 * months.size()]
    bands = pandas.DataFrame({"low": series["month_q05"][:], "high": series["month_q95"][:]},
                             pandas.to_datetime(period["month"][:], unit="s").to_period("M"))
    both = bands.join(read.rename("read"), how="inner").dropna()
    return 100 * both.read.between(both.low, both.high).mean()


def coverage_of(loop, case):
    """{meter: (percent of hours, of months)}"""
    meters = {CHANNELS[column][0]: readings for column, readings in held_out(case).items() if column in CHANNELS}
    period = loop["held_out"]
    return {meter: (hours_within(period[meter], readings),
                    months_within(period, period[meter], readings, meter == IS_TEMPERATURE))
            for meter, readings in meters.items() if meter in period and np.isfinite(readings).any()}


def line(name, value):
    print(f"{name} {value:.1f} % {WANTED} {value / WANTED:.3f}", flush=True)


def print_all(folder, rows):
    for k, resolution in enumerate(("hours", "months")):
        known = [row[k] for row in rows if np.isfinite(row[k])]
        if known:
            line(f"coverage_{folder}_{resolution}", statistics.mean(known))


def main():
    cases = [pathlib.Path(path) for path in sys.argv[1:]] or cases_in(FOLDERS)
    if not cases:
        print(f"skipped: no cases in {SHARED}")
        return
    rows = {}
    with tempfile.TemporaryDirectory() as folder, \
            h5py.File(next(first_loops(cases, pathlib.Path(folder)).glob("*.h5"))) as file:
        for case in cases:
            for meter, (hours, months) in coverage_of(file[case.name]["loop"], case).items():
                line(f"coverage_{case.name}_{meter}_hours", hours)
                line(f"coverage_{case.name}_{meter}_months", months)
                rows.setdefault(case.parent.name, []).append((hours, months))
    for name, of_folder in rows.items():
        print_all(name, of_folder)


if __name__ == "__main__":
    main()
