#!/usr/bin/python3
"""How soon a newcomer sees results: `mpirun -np 2 bemcal-batch` without an argument, until the first
line of a table stands on the terminal and until the program ends; its posterior alone, and with three
effects that are sampled beside; and what a second core gives.

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

FIRST_TABLE_S, END_S, POSTERIOR_S, WITH_EFFECTS_S = 20, 180, 20, 40


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


EFFECTS = (("wind infiltration", "", 0, 0.1, 0.02, 0.02), ("use at night", "", -5, 5, 0, 1),
           ("warm evenings", 'hook = "heating set-point"\ngate = "weekday"\nhours = [18, 22]\n', -3, 3, 0, 1))


def with_effects(head, study):
    """The job's parts with three effects, the coefficients of which are sampled."""
    for name, more, least, most, mean, sd in EFFECTS:
        head += (f'[[effect]]\nname = "{name}"\n{more}coefficient = {mean}\n\n[[parameter]]\nname = "{name}"\n'
                 f'target = "effect.{name}"\nmin = {least}\nmax = {most}\n'
                 f'prior = {{kind = "normal", mean = {mean}, sd = {sd}}}\n\n')
    names = ", ".join(f'"{name}"' for name, *_ in EFFECTS)
    more_draws = re.sub(r"most_draws = \d+", "most_draws = 2000", study)
    return head, more_draws.replace("parameters = [", f"parameters = [{names}, ", 1)


def measure_posterior(folder, name, asked, change=lambda *parts: parts):
    """Ten parameters, three meters by the hour of a year, on two ranks; and what else `change` makes of it."""
    shutil.copytree(large_job.ROOT / "jobs" / "quickstart", folder / name)
    job, result = folder / name / "quickstart.toml", folder / f"{name}.h5"
    head, *studies = re.split(r"(?m)^(?=\[\[study\]\])", job.read_text())
    job.write_text("".join(change(head, next(study for study in studies if 'kind = "posterior"' in study))))
    begin = time.perf_counter()
    subprocess.run(["mpirun", "-np", "2", "--oversubscribe", large_job.PROGRAM, "run", job, "--no-report",
                    "-o", result], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    seconds = time.perf_counter() - begin
    with h5py.File(result) as file:
        least = file["quickstart/posterior/ess_bulk"][:].min()
        largest = file["quickstart/posterior/rhat_rank"][:].max()
    print(f"quickstart_{name} {seconds:.1f} s {asked} {seconds / asked:.3f}")
    print(f"quickstart_{name}_r_hat {largest:.3f} 1 1.01 {largest / 1.01:.3f}")
    print(f"quickstart_{name}_draws_per_second {least / seconds:.0f} 1/s - -", flush=True)


def main():
    measure_waits()
    with tempfile.TemporaryDirectory() as folder:
        measure_posterior(pathlib.Path(folder), "posterior", POSTERIOR_S)
        measure_posterior(pathlib.Path(folder), "posterior_with_effects", WITH_EFFECTS_S, with_effects)
    with tempfile.TemporaryDirectory() as folder:
        bench_scaling.measure("quickstart", large_job.copy_quickstart(pathlib.Path(folder)))


if __name__ == "__main__":
    main()
