#!/usr/bin/python3
"""How soon a newcomer sees results: `mpirun -np 2 bemcal-batch` without an argument, until the first
line of a table stands on the terminal and until the program ends; and what a second core gives.

Prints `name value unit reference ratio`: seconds, what is asked, and their ratio; then the lines of
bench_scaling for the quickstart without its loop. Wants two idle cores. BEMCAL_BENCH_RUNS overrides the number of runs.
"""
import pathlib
import statistics
import subprocess
import tempfile
import time

import bench_scaling
import large_job

FIRST_TABLE_S, END_S = 20, 180


def newcomer(folder):
    """Seconds until the first line of a table is read, and until the end."""
    begin = time.perf_counter()
    with subprocess.Popen(["mpirun", "-np", "2", "--oversubscribe", large_job.PROGRAM], cwd=folder,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as run:
        run.stdout.readline()
        first = time.perf_counter() - begin
        for _ in run.stdout:
            pass
    if run.returncode != 0:
        raise SystemExit(f"the quickstart ended with exit code {run.returncode}")
    return first, time.perf_counter() - begin


def measure_waits():
    with tempfile.TemporaryDirectory() as folder:
        waits = [newcomer(folder) for _ in range(bench_scaling.RUNS)]
    for name, seconds, asked in zip(("first_table", "end"), zip(*waits), (FIRST_TABLE_S, END_S)):
        median = statistics.median(seconds)
        print(f"quickstart_{name} {median:.2f} s {asked} {median / asked:.3f}", flush=True)


def main():
    measure_waits()
    with tempfile.TemporaryDirectory() as folder:
        bench_scaling.measure("quickstart", large_job.copy_quickstart(pathlib.Path(folder)))


if __name__ == "__main__":
    main()
