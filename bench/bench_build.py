#!/usr/bin/python3
"""What a bare build costs: the processor time, user's and system's, of configuring and compiling the
program in a new folder without ccache, and that of the program with all its tests.

Prints `name value unit reference ratio`: seconds, what is asked, and their ratio. It works that long,
shared by the cores; BEMCAL_BENCH_JOBS overrides how many compilers run at once.
"""
import os
import pathlib
import resource
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM_S, WITH_TESTS_S = 480, 1200
JOBS = os.environ.get("BEMCAL_BENCH_JOBS", str(len(os.sched_getaffinity(0))))


def processor_seconds():
    """Of all processes that were started here and have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run(*command):
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env={**os.environ, "CCACHE_DISABLE": "1"})


def report(name, asked):
    seconds = processor_seconds()
    print(f"build_{name}_cpu {seconds:.0f} s {asked} {seconds / asked:.3f}", flush=True)


def main():
    with tempfile.TemporaryDirectory() as folder:
        run("cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DBEMCAL_BENCH=OFF")
        build = ("cmake", "--build", folder, "--parallel", JOBS)
        run(*build, "--target", "bemcal-batch")
        report("program", PROGRAM_S)
        run(*build)
        report("with_tests", WITH_TESTS_S)


if __name__ == "__main__":
    main()
