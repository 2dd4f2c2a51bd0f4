"""The job of the scaling and output benches: the quickstart's screening with as many points as give
2 million simulations (BEMCAL_BENCH_SIMULATIONS overrides), and what a run of it took."""
import os
import pathlib
import re
import shutil
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("BEMCAL_PROGRAM", ROOT / "build" / "release" / "bemcal-batch")
SIMULATIONS = int(os.environ.get("BEMCAL_BENCH_SIMULATIONS", 2_000_000))
PERIODS = 2  # every point is simulated over the training and the held-out year


def copy_quickstart(folder):
    """Copies the quickstart into folder, without its posterior and its loop, whose few long items
    say little of the distribution; returns the job file."""
    shutil.copytree(ROOT / "jobs" / "quickstart", folder / "quickstart")
    job = folder / "quickstart" / "quickstart.toml"
    job.write_text(re.sub(r"(?s)# The ten that matter.*", "", job.read_text()))
    return job


def write_job(folder):
    """The large job, with a small sensitivity study; returns the job file."""
    job = copy_quickstart(folder)
    text = re.sub(r"(?m)^(n_base *=).*", r"\1 16", job.read_text())
    text = re.sub(r"(?m)^(n_points *=).*", rf"\1 {SIMULATIONS // PERIODS}", text)
    text = re.sub(r"(?m)^(points_per_item *=).*", r"\1 1024", text)
    job.write_text(text)
    return job


def run(job, ranks, threads):
    """Runs the job; {phase: seconds} of /run, and the whole run's as "wall"."""
    import h5py
    result = job.parent / "result.h5"
    command = [PROGRAM, "run", job, "--no-report", "-o", result, "--force", "--threads", str(threads)]
    if ranks > 1:
        command = ["mpirun", "-np", str(ranks), "--oversubscribe", *command]
    begin = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    wall = time.perf_counter() - begin
    with h5py.File(result) as file:
        seconds = {name.removeprefix("seconds_"): float(value)
                   for name, value in file["run"].attrs.items() if name.startswith("seconds_")}
        seconds["idle_share"] = float(file["run"].attrs["idle_share"])
    seconds["wall"] = wall
    seconds["bytes"] = result.stat().st_size
    return seconds
