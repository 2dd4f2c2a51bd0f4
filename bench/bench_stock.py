#!/usr/bin/python3
"""A made stock at twenty weather stations, 3 % of it broken in ten ways: the first night and the second.

Usage: bench_stock.py [--buildings 10000] [--points 1000] [--small 20]

Screens every building on two ranks, then changes the readings of 1 % and runs the next night. Prints
`name value unit reference ratio`: the rate by processor seconds beside that of one building's screening alone, with the same
number of simulations (the kernel with its sum of squares, in the same program on the same ranks), the
memory of the larger rank beside that for a tenth of the stock, the second night's wall beside the
first's, and buildings per core-hour of a screening, a posterior and a loop (of --small buildings).
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import h5py
import large_job

sys.path.insert(0, str(large_job.ROOT / "tests" / "generator"))

import stock as made  # noqa: E402

RANKS = 2


def run(job, result, *words):
    """Wall seconds, the memory of the largest process [MB], and seconds of all processors."""
    command = ["mpirun", "-np", str(RANKS), "--oversubscribe", large_job.PROGRAM, "run", job, "-o", result, "--force",
               "--threads", "1", "--no-report", *words]
    log = result.with_suffix(".log")
    begin = time.perf_counter()
    with open(log, "w", encoding="utf-8") as out:
        child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=out)
        _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode not in (0, 65):
        raise SystemExit(f"{job}: exit code {child.returncode}: {log.read_text()}")
    return time.perf_counter() - begin, usage.ru_maxrss / 1024, usage.ru_utime + usage.ru_stime


def counts(result):
    with h5py.File(result) as file:
        status = [text.decode() for text in file["stock/stock_status"][:]]
    return {name: status.count(name) for name in ("calibrated", "unchanged", "failed")}


def write_job(folder, kind, table="buildings.csv"):
    job = folder / "job.toml"
    job.write_text(f'name = "made"\nseed = 5\n[stock]\ntable = "{table}"\ntemplate = "building.toml"\n'
                   f"[output]\nmax_failed_share = 0.2\n[[study]]\n{kind}\n")
    return job


def alone_rate(folder, points, n_buildings):
    """Simulations per processor second of one building's screening, as many as the stock's, a tenth at most."""
    stock_line = (folder / "buildings.csv").read_text().split("\n")[1].split(",")
    text = (folder / "building.toml").read_text()
    for column, cell in zip(made.COLUMNS, stock_line):
        text = text.replace(f"@{column}@", cell)
    n = max(points * n_buildings // 10, points)
    job = folder / "alone.toml"
    job.write_text(f'seed = 5\n{text}\n[[study]]\nkind = "screening"\nn_points = {n}\nkeep_points = false\n')
    return n / run(job, folder / "alone.h5")[2]


def small_rates(folder, n_small):
    """Buildings per core-hour of the dear studies."""
    lines = (folder / "buildings.csv").read_text().split("\n")
    (folder / "small.csv").write_text("\n".join(lines[:n_small + 1]) + "\n")
    kinds = {"posterior": 'kind = "posterior"\nn_chains = 8\nchains_per_item = 8\nwarm_up = 200\nmost_draws = 400\n'
                          "target_ess = 200",
             "loop": 'kind = "loop"'}
    for name, kind in kinds.items():
        kind = kind.replace("chains_per_item = 8\n", "")
        job, result = write_job(folder, kind, "small.csv"), folder / f"{name}.h5"
        seconds = run(job, result)[2]
        done = counts(result)["calibrated"]
        print(f"{name}_buildings_per_core_hour {done / (seconds / 3600):.0f} 1/h - -", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--buildings", type=int, default=10_000)
    parser.add_argument("--points", type=int, default=1000)
    parser.add_argument("--small", type=int, default=20)
    parser.add_argument("--folder", help="where the stock is made; default: one that goes at the end")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=options.folder) as name:
        folder = pathlib.Path(name)
        stock = made.make(folder, options.buildings, 20, seed=11)
        screening = f'kind = "screening"\nn_points = {options.points}'
        table = (folder / "buildings.csv").read_text().split("\n")
        tenth = max(options.buildings // 10, 20)
        (folder / "tenth.csv").write_text("\n".join(table[:tenth + 1]) + "\n")
        _, memory_of_tenth, _ = run(write_job(folder, screening, "tenth.csv"), folder / "tenth.h5")
        alone = alone_rate(folder, options.points, options.buildings)
        job, first, second = write_job(folder, screening), folder / "first.h5", folder / "second.h5"
        wall, memory, seconds = run(job, first)
        done = counts(first)
        rate = done["calibrated"] * options.points / seconds
        print(f"buildings {options.buildings} - - -\nbroken {len(stock.broken)} - - -")
        print(f"failed {done['failed']} - {len(stock.broken)} {done['failed'] / max(len(stock.broken), 1):.2f}")
        print(f"first_night {wall:.1f} s - -")
        print(f"screening_rate {rate:.0f} 1/s {alone:.0f} {rate / alone:.3f}")
        print(f"screening_buildings_per_core_hour {done['calibrated'] / (seconds / 3600):.0f} 1/h - -")
        print(f"memory {memory:.0f} MB {memory_of_tenth:.0f} {memory / memory_of_tenth:.3f}")
        changed = made.change(stock, 0.01)
        again, _, _ = run(job, second, "--after", first)
        done = counts(second)
        print(f"second_night_calibrated {done['calibrated']} - {len(changed)} "
              f"{done['calibrated'] / len(changed):.3f}")
        print(f"second_night {again:.1f} s {wall:.1f} {again / wall:.3f}", flush=True)
        if options.small > 0:
            small_rates(folder, options.small)


if __name__ == "__main__":
    main()
