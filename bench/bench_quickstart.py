#!/usr/bin/python3
"""How soon a newcomer sees results: `mpirun -np 2 bemcal-batch` without an argument, until the first
line of a table stands on the terminal and until the program ends; its posterior alone; and what a
second core gives.

Prints `name value unit reference ratio`: seconds, what is asked, and their ratio; of the posterior also
the effective draws of its worst unknown per second; then the lines of
bench_scaling for the quickstart without its loop. Wants two idle cores. BEMCAL_BENCH_RUNS overrides the number of runs.
"""
import pathlib
import re
import shutil
import statistics
import subprocess
import tempfile
import time

import h5py

import bench_scaling
import large_job

FIRST_TABLE_S, END_S, POSTERIOR_S = 20, 180, 20


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


def measure_posterior(folder):
    """Ten parameters, three meters by the hour of a year, on two ranks."""
    shutil.copytree(large_job.ROOT / "jobs" / "quickstart", folder / "quickstart")
    job, result = folder / "quickstart" / "quickstart.toml", folder / "posterior.h5"
    head, *studies = re.split(r"(?m)^(?=\[\[study\]\])", job.read_text())
    job.write_text(head + next(study for study in studies if 'kind = "posterior"' in study))
    begin = time.perf_counter()
    subprocess.run(["mpirun", "-np", "2", "--oversubscribe", large_job.PROGRAM, "run", job, "--no-report",
                    "-o", result], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    seconds = time.perf_counter() - begin
    with h5py.File(result) as file:
        least = file["quickstart/posterior/ess_bulk"][:].min()
    print(f"quickstart_posterior {seconds:.1f} s {POSTERIOR_S} {seconds / POSTERIOR_S:.3f}")
    print(f"quickstart_posterior_draws_per_second {least / seconds:.0f} 1/s - -", flush=True)


def main():
    measure_waits()
    with tempfile.TemporaryDirectory() as folder:
        measure_posterior(pathlib.Path(folder))
    with tempfile.TemporaryDirectory() as folder:
        bench_scaling.measure("quickstart", large_job.copy_quickstart(pathlib.Path(folder)))


if __name__ == "__main__":
    main()
