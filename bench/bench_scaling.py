#!/usr/bin/python3
"""How much faster two ranks, or two threads, simulate than one: medians of alternating runs.

Prints `name value unit reference ratio`: seconds of the simulation phase, with those of 1 rank x 1
thread as the reference; the ratio is reference / value. The quickstart first, then the job of
large_job.py. Wants two idle cores.
BEMCAL_BENCH_RUNS overrides the number of runs.
"""
import os
import pathlib
import statistics
import tempfile

import large_job

SHAPES = {"1x1": (1, 1), "2x1": (2, 1), "1x2": (1, 2)}  # ranks x threads
RUNS = int(os.environ.get("BEMCAL_BENCH_RUNS", 5))


def measure(name, job):
    """Runs every shape in turn, RUNS times, and prints the medians."""
    seconds = {shape: [] for shape in SHAPES}
    idle = {shape: [] for shape in SHAPES}
    for _ in range(RUNS):
        for shape, (ranks, threads) in SHAPES.items():
            took = large_job.run(job, ranks, threads)
            seconds[shape].append(took["simulate"])
            idle[shape].append(took["idle_share"])
    reference = statistics.median(seconds["1x1"])
    for shape in SHAPES:
        median = statistics.median(seconds[shape])
        print(f"{name}_{shape} {median:.3f} s {reference:.3f} {reference / median:.3f}")
        print(f"{name}_{shape}_idle_share {statistics.median(idle[shape]):.4f} - - -")


def main():
    for name, write in (("quickstart", large_job.copy_quickstart), ("large", large_job.write_job)):
        with tempfile.TemporaryDirectory() as folder:
            measure(name, write(pathlib.Path(folder)))


if __name__ == "__main__":
    main()
