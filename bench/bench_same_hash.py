#!/usr/bin/python3
"""The result hash on 1, 2, 3, 7, 16 ranks with 1 and 2 threads, on 64 ranks, and when 4, 2 and then 7
ranks go on with each other's work: of the quickstart's analyses, and of a made stock.

Usage: bench_same_hash.py [--buildings 60]

Prints each hash, then `name value unit reference ratio`: how many different ones there were, of one.
"""
import argparse
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

import large_job

sys.path.insert(0, str(large_job.ROOT / "tests" / "generator"))

import stock as made  # noqa: E402

SHAPES = [(ranks, threads) for ranks in (1, 2, 3, 7, 16) for threads in (1, 2)] + [(64, 1)]
RESUMED = (4, 2, 7)  # the last one ends it
STOPPED = 75


def small_quickstart(folder):
    job = large_job.copy_quickstart(folder)
    text = job.read_text()
    for key, value in (("n_base", 64), ("n_points", 8192), ("points_per_item", 64)):
        text = re.sub(rf"(?m)^( *{key} *=).*", rf"\1 {value}", text)
    job.write_text(text)
    return job


def small_stock(folder, n_buildings):
    made.make(folder, n_buildings, 4, seed=5)
    job = folder / "made.toml"
    job.write_text(made.job_text(64) + "[output]\nmax_failed_share = 0.2\n")
    return job


def start(job, ranks, threads, result, *words):
    return subprocess.Popen(["mpirun", "-np", str(ranks), "--oversubscribe", "--bind-to", "none", large_job.PROGRAM,
                             "run", job, "-o", result, "--threads", str(threads), "--no-report", *words],
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def ended(run, *codes):
    said = run.communicate()[1]
    if run.returncode not in codes:
        raise SystemExit(f"exit code {run.returncode}: {said}")
    return said


def hash_of(result):
    text = subprocess.run([large_job.PROGRAM, "status", result], capture_output=True, text=True, check=True).stdout
    return re.search(r"result hash (\w+)", text)[1]


def log_bytes(result):
    return sum(log.stat().st_size for log in pathlib.Path(f"{result}.part").glob("*.log"))


def stopped_and_resumed(job, folder, whole_bytes):
    """A third of the work on each of three numbers of ranks."""
    result = folder / "resumed.h5"
    for k, ranks in enumerate(RESUMED[:-1], 1):
        run = start(job, ranks, 1, result, "--resume")
        while run.poll() is None and log_bytes(result) < k * whole_bytes / len(RESUMED):
            time.sleep(0.002)
        run.send_signal(signal.SIGUSR1)
        ended(run, STOPPED)
    said = ended(start(job, RESUMED[-1], 1, result, "--resume"), 0)
    print(re.search(r"resuming: \d+ items are done", said)[0])
    return hash_of(result)


def whole_log(job, folder):
    """Bytes of the logs of a run, as it is about to end."""
    result, most = folder / "logged.h5", 0
    run = start(job, 1, 1, result)
    while run.poll() is None:
        most = max(most, log_bytes(result))
        time.sleep(0.002)
    ended(run, 0)
    return most


def measure(name, job, folder):
    hashes = set()
    for ranks, threads in SHAPES:
        result = folder / "shape.h5"
        ended(start(job, ranks, threads, result, "--force"), 0)
        print(f"{name} {ranks} x {threads}: {hash_of(result)}", flush=True)
        hashes.add(hash_of(result))
    resumed = stopped_and_resumed(job, folder, whole_log(job, folder))
    print(f"{name} {', then '.join(map(str, RESUMED))} ranks: {resumed}")
    hashes.add(resumed)
    print(f"{name}_different_hashes {len(hashes)} 1 1 {len(hashes):.3f}", flush=True)
    return len(hashes) == 1


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--buildings", type=int, default=60)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as other:
        jobs = {"quickstart": small_quickstart(pathlib.Path(one)),
                "stock": small_stock(pathlib.Path(other), options.buildings)}
        same = [measure(name, job, job.parent) for name, job in jobs.items()]
    return 0 if all(same) else 1


if __name__ == "__main__":
    sys.exit(main())
