#!/usr/bin/python3
"""Whether two programs give the same results: every dataset that the first one stores, bit for bit.

Usage: bench_same_results.py OLD [NEW] [--jobs quickstart,stock,...]

OLD and NEW are programs (bemcal-batch) inside their checkouts, built from two states of the sources; NEW is this
checkout's by default. Each runs its own checkout's jobs: the quickstart, paper3_printed, koh_reference, twin_house
(its data lie in ../shared), a made stock of 100 over two nights, and the ten cases of ../shared/cases/dev by
run_case. Prints what differs, what is new, what has gone (a floor that was NaN may go); then
`name value unit reference ratio`: how many datasets differ or have gone, of none. `run` (times, ranks) and `version` are left out.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHARED = ROOT.parent / "shared"
sys.path.insert(0, str(ROOT / "tests" / "generator"))

SHIPPED = ("quickstart", "paper3_printed", "koh_reference", "twin_house")
ENDED = (0, 1, 65)  # done, a target missed, too many items failed
NEVER_KNOWN = ("/noise_floor",)
OF_THE_VERSION = ("stock/stock_job_hash",)


def checkout_of(program):
    """The folder with jobs and scripts above a program that was built in it."""
    for folder in pathlib.Path(program).resolve().parents:
        if (folder / "jobs").is_dir() and (folder / "scripts").is_dir():
            return folder
    raise SystemExit(f"{program}: lies in no checkout with jobs and scripts beside it")


def run(program, job, result, *words):
    command = ["mpirun", "-np", "2", "--oversubscribe", program, "run", job, "-o", result, "--no-report", *words]
    ended = subprocess.run(command, capture_output=True, text=True)
    if ended.returncode not in ENDED:
        raise SystemExit(f"{program} {job}: exit code {ended.returncode}: {ended.stderr}")


def shipped(program, name, folder):
    job, = (checkout_of(program) / "jobs" / name).glob("*.toml")
    run(program, job, folder / f"{name}.h5")


def stock(program, folder):
    import stock as made
    made.make(folder, 100, 4, seed=5)
    (folder / "made.toml").write_text(made.job_text(64) + "[output]\nmax_failed_share = 0.2\n")
    run(program, folder / "made.toml", folder / "stock-1.h5")
    run(program, folder / "made.toml", folder / "stock-2.h5", "--after", folder / "stock-1.h5")


def cases(program, folder):
    of_cases = sorted(path for path in (SHARED / "cases" / "dev").glob("*") if path.is_dir())
    script = checkout_of(program) / "scripts" / "run_case"
    subprocess.run([script, *of_cases, folder / "cases", "--ranks", "2"], check=True, capture_output=True,
                   env={**os.environ, "BEMCAL_PROGRAM": str(program)})


def results_of(program, name, folder):
    """Runs one entry; the HDF5 files and the cases' tables that it left."""
    folder.mkdir()
    if name in SHIPPED:
        shipped(program, name, folder)
    else:
        {"stock": stock, "cases": cases}[name](program, folder)
    kept = (".h5",) if name != "cases" else (".h5", ".csv", ".json")
    return sorted(path.relative_to(folder) for path in folder.rglob("*") if path.suffix in kept)


def datasets_of(path):
    """{name: array} of all that is not of the run."""
    found = {}

    def keep(name, item):
        if isinstance(item, h5py.Dataset) and not name.startswith("run/") and name not in OF_THE_VERSION:
            found[name] = item[()]
    with h5py.File(path) as file:
        file.visititems(keep)
    return found


def is_same(old, new):
    old, new = np.asarray(old), np.asarray(new)
    if old.dtype.kind != new.dtype.kind or old.shape != new.shape:
        return False
    if old.dtype.kind in "fiu":
        return old.tobytes() == new.tobytes()
    return np.array_equal(old, new)


def compare_files(old, new, label):
    """How many datasets differ or have gone; says which."""
    if old.suffix != ".h5":
        is_equal = old.read_bytes() == new.read_bytes()
        if not is_equal:
            print(f"{label}: differs")
        return 0 if is_equal else 1
    before, after = datasets_of(old), datasets_of(new)
    wrong = 0
    for name, values in before.items():
        if name not in after and name.endswith(NEVER_KNOWN) and np.isnan(values).all():
            print(f"{label}: {name} has gone, which was NaN")
            continue
        if name not in after:
            print(f"{label}: {name} has gone")
        elif not is_same(values, after[name]):
            print(f"{label}: {name} differs")
        else:
            continue
        wrong += 1
    for name in after.keys() - before.keys():
        print(f"{label}: {name} is new")
    print(f"{label}: {len(before)} datasets before, {len(after)} now", flush=True)
    return wrong


def compare(name, programs, folder):
    folders, files = [folder / f"{name}-{age}" for age in ("old", "new")], []
    for program, place in zip(programs, folders):
        # in a folder of one name, since reasons of failures hold their files' paths
        files.append(results_of(program, name, folder / "here"))
        (folder / "here").rename(place)
    lost = [path for path in files[0] if path not in files[1]]
    for path in lost:
        print(f"{name}: {path} was not written")
    both = [path for path in files[0] if path in files[1]]
    wrong = len(lost) + sum(compare_files(folders[0] / path, folders[1] / path, f"{name}: {path}") for path in both)
    print(f"{name}_datasets_that_differ {wrong} 1 0 {wrong:.1f}", flush=True)
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("old", nargs="?", default=os.environ.get("BEMCAL_OLD_PROGRAM"))
    parser.add_argument("new", nargs="?", default=ROOT / "build" / "release" / "bemcal-batch")
    parser.add_argument("--jobs", default=",".join([*SHIPPED, "stock", "cases"]))
    options = parser.parse_args()
    if not options.old:
        print("no program to compare with was named (first argument, or BEMCAL_OLD_PROGRAM): nothing is measured")
        return 0
    names = options.jobs.split(",")
    if not SHARED.is_dir():
        names = [name for name in names if name not in ("twin_house", "cases")]
        print(f"{SHARED} is not here: twin_house and the cases are left out")
    os.environ |= {"OMP_WAIT_POLICY": "passive"}
    if os.geteuid() == 0:
        os.environ |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    with tempfile.TemporaryDirectory() as folder:
        programs = [pathlib.Path(options.old).resolve(), pathlib.Path(options.new).resolve()]
        wrong = [compare(name, programs, pathlib.Path(folder)) for name in names]
    return 1 if any(wrong) else 0


if __name__ == "__main__":
    sys.exit(main())
