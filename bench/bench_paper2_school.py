#!/usr/bin/python3
"""Paper 2's stages on school rooms whose truth the generator drew.

    bench_paper2_school.py [--only N] [--ranks R] [--evaluations E] [--folder DIR]

Makes N rooms (default 10) by seed, calibrates each with jobs/paper2_school, and holds what was
found against the truth: within 15 %, or inside the 90 % interval of the estimate's standard
deviation. Prints a line for each number and seed, and then `name value unit reference ratio`: for
each number in how many rooms it was found (asked: 8 of 10), and of the two fortnights that no
stage has seen the middle RMSD before and after.
"""
import argparse
import json
import pathlib
import re
import sys
import tempfile
import time

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests" / "generator")]
from cases import running              # noqa: E402
from school_files import write_school  # noqa: E402

JOB = ROOT / "jobs" / "paper2_school" / "paper2_school.toml"
PROGRAM = ROOT / "build" / "release" / "bemcal-batch"
# name of the truth: (stage, parameter)
SOUGHT = {"a": ("curve", "a"), "b": ("curve", "b"), "c": ("curve", "c"), "d": ("curve", "d"),
          "nominal_power": ("radiator", "nominal_power"),
          "air_change_spring": ("spring", "air_change"),
          "air_change_autumn": ("autumn", "air_change"),
          "infiltration": ("envelope", "infiltration")}
ASKED = ("a", "b", "c", "d", "nominal_power", "air_change_spring", "air_change_autumn")
WITHIN, NORMAL_90 = 0.15, 1.6449


def make_room(folder, seed, evaluations):
    """The job with data of its own; returns the truth."""
    if not (folder / "truth.json").exists():
        write_school(folder, seed)
    text = JOB.read_text()
    if evaluations:
        text = re.sub(r"(?m)^evaluations = \d+", f"evaluations = {evaluations}", text)
    (folder / JOB.name).write_text(text)
    return json.loads((folder / "truth.json").read_text())


def found_in(study):
    """{(stage, parameter): (value, standard deviation)}."""
    stages, names = study["calibration_stage"].asstr()[:], study["parameter"].asstr()[:]
    values, spread = study["calibration_value"][:], study["calibration_sd"][:]
    return {(stage, name): (values[s, p], spread[s, p])
            for s, stage in enumerate(stages) for p, name in enumerate(names)}


def unseen_errors(study):
    """{period: (RMSD as described, RMSD calibrated)} [K]."""
    errors = {}
    for period in study["validation"].values():
        for name, series in period["periods"].items():
            error = series["air"]["simulated"][:] - series["air"]["measured"][:]
            errors[name] = np.sqrt(np.nanmean(error ** 2, axis=1))
    return errors


def judge(seed, options, folder):
    """({name: whether it was found}, errors)."""
    begin = time.monotonic()
    truth = make_room(folder, seed, options.evaluations)
    result = folder / "result.h5"
    running.run(options.program, folder / JOB.name, result, options.ranks, ("--force",),
                capture_output=True)
    with h5py.File(result) as file:
        study = file["paper2_school"]["stages"]
        found, errors = found_in(study), unseen_errors(study)
    met = {}
    for name, key in SOUGHT.items():
        value, spread = found[key]
        off = abs(value - truth[name])
        met[name] = bool(off <= WITHIN * abs(truth[name]) or off <= NORMAL_90 * spread)
        print(f"seed {seed}  {name:<18} {value:10.4g} +- {spread:8.2g}  true {truth[name]:10.4g}  "
              f"{'found' if met[name] else 'NOT FOUND'}")
    for period, rmsd in errors.items():
        print(f"seed {seed}  {period}: RMSD {rmsd[0]:.2f} K as described, {rmsd[1]:.2f} K calibrated")
    print(f"seed {seed}  {time.monotonic() - begin:.0f} s", flush=True)
    return met, errors


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--only", type=int, default=10, metavar="N")
    parser.add_argument("--evaluations", type=int, help="of each stage; default: the job's")
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--program", type=pathlib.Path, default=PROGRAM)
    parser.add_argument("--folder", type=pathlib.Path)
    return parser.parse_args()


def main():
    options = arguments()
    with tempfile.TemporaryDirectory() as temporary:
        place = options.folder or pathlib.Path(temporary)
        rooms = [judge(seed, options, place / f"school_{seed}")
                 for seed in range(1, options.only + 1)]
    asked = 0.8 * len(rooms)
    for name in ASKED + ("infiltration",):
        n = sum(met[name] for met, _ in rooms)
        print(f"paper2_school_{name} {n} of_{len(rooms)} {asked:g} {n / asked:.2f}")
    for period in ("may", "december"):
        before, after = np.median([errors[period] for _, errors in rooms], axis=0)[:2]
        print(f"paper2_school_rmsd_{period} {after:.3f} K {before:.3f} {after / before:.2f}")


if __name__ == "__main__":
    main()
