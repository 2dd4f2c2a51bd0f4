#!/usr/bin/python3
"""A whole night of a stock in which a quarter of the buildings show one meter, beside one in which each has its
own: `check` and `run`, time and memory.

Usage: bench_shared_meters.py [--buildings 10000] [--folder FOLDER]

90 days of hourly gas a building, since meters are compared by 60 daily sums at least, and the cheapest
screening, on one core. Prints `name value unit reference ratio`; the reference is the stock of different
meters. The search alone is bench_shared_meters.cpp's. Ends with 1 where the meter is not found at each of its
buildings.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np
from large_job import PROGRAM, ROOT

sys.path.insert(0, str(ROOT / "tests" / "generator"))

import stock as made  # noqa: E402
import weather  # noqa: E402

FIRST, LAST, DAYS = "2022-01-01", "2022-03-31", 90
JOB = 'seed = 5\n[stock]\ntable = "{}.csv"\ntemplate = "building.toml"\n[[study]]\nkind = "screening"\nn_points = 16\n'


def gas_of(rng, area, theta_e):
    """By the hour [kWh], with days of a building's own, as people have them."""
    day = np.repeat(np.exp(rng.normal(0, 0.2, DAYS)), 24)
    return np.round(area / 400 * (np.maximum(rng.uniform(14, 18) - theta_e, 0) + 1) * day, 2)


def make(folder, n):
    """Tables different.csv and alike.csv: in the second, the first quarter shows the first building's meter."""
    rng = np.random.default_rng(7)
    year = weather.synthetic_weather("continental", FIRST, DAYS, seed=3)
    weather.write_weather(folder / "station.csv", year)
    theta_e = weather.hour_means(year.theta_e)
    (folder / "building.toml").write_text(made.BUILDING.replace("2022-12-31", LAST))
    lines = [made.line_of(rng, k, ("station.csv", year.climate, theta_e)) for k in range(n)]
    stamps = made.stamps()[:24 * DAYS]
    for line in lines:
        made.write_readings(folder / line["meter"], stamps, gas_of(rng, line["floor_area"], theta_e))
    made.Stock(folder, lines).write_table()
    (folder / "buildings.csv").rename(folder / "different.csv")
    for line in lines[:n // 4]:  # files of their own, with one content
        os.link(folder / lines[0]["meter"], folder / f"same_{line['meter']}")
        line["meter"] = f"same_{line['meter']}"
    made.Stock(folder, lines).write_table()
    (folder / "buildings.csv").rename(folder / "alike.csv")


# A small process starts the program: memory that ours has would count as the program's.
METER = """import resource, subprocess, sys
code = subprocess.run(sys.argv[1:], stdout=sys.stderr).returncode
use = resource.getrusage(resource.RUSAGE_CHILDREN)
print(use.ru_utime + use.ru_stime, use.ru_maxrss / 1024)
sys.exit(code)"""


def cost_of(*words):
    """Processor seconds and the most memory [MB] of the program."""
    done = subprocess.run([sys.executable, "-S", "-c", METER, PROGRAM, *words], capture_output=True, text=True,
                          env={**os.environ, "OMP_NUM_THREADS": "1"}, check=False)
    if done.returncode != 0:
        raise SystemExit(f"{words}: exit code {done.returncode}: {done.stderr[-2000:]}")
    return tuple(map(float, done.stdout.split()))


def n_shared(result):
    """Buildings of which it is said that their meter is shared."""
    with h5py.File(result) as file:
        if "stock/stock_finding" not in file:
            return 0
        return len({int(k) for k, text in zip(file["stock/stock_findings_of"][:], file["stock/stock_finding"][:])
                    if b"shared with" in text})


def costs_of(folder, name):
    """{command: (seconds, MB)}, and how many shared meters are said."""
    job, result = folder / f"{name}.toml", folder / f"{name}.h5"
    job.write_text(JOB.format(name))
    costs = {"check": cost_of("check", job),
             "run": cost_of("run", job, "-o", result, "--threads", "1", "--no-report")}
    return costs, n_shared(result)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--buildings", type=int, default=10_000)
    parser.add_argument("--folder", help="where the stock is made; default: one that goes at the end")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=options.folder) as name:
        folder = pathlib.Path(name)
        make(folder, options.buildings)
        different, n_false = costs_of(folder, "different")
        alike, n_found = costs_of(folder, "alike")
    n_alike = options.buildings // 4
    for command in different:
        for what, unit, of, reference in zip(("time", "memory"), ("s", "MB"), alike[command], different[command]):
            print(f"stock_{command}_{what} {of:.4g} {unit} {reference:.4g} {of / reference:.2f}")
    print(f"stock_shared_said {n_found} - {n_alike} {n_found / n_alike:.2f}\nstock_false_said {n_false} - 0 -")
    return 0 if (n_found, n_false) == (n_alike, 0) else 1


if __name__ == "__main__":
    sys.exit(main())
