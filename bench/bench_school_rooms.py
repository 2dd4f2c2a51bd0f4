#!/usr/bin/python3
"""Paper 2's stages on the school rooms of ../shared/cases/dev, whose data another kind of simulator
made: calibrated on three fortnights, judged on two that no stage has seen.

    bench_school_rooms.py [--cases DIR] [--only NAME...] [--evaluations N] [--ranks R] [--folder DIR]

Prints a line for each room and version (initial, staged, all at once), and then
`name value unit reference ratio`: in how many rooms the RMSD over both fortnights is at least
halved, and in how many 77 % of the readings are within 0.5 K (paper 2: 77.3 %).
"""
import argparse
import pathlib
import sys
import tempfile
import time

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
from cases import running, school_job  # noqa: E402

ROOMS = ("dev_02", "dev_07", "dev_09")
PROGRAM = ROOT / "build" / "release" / "bemcal-batch"
WITHIN, PAPERS_SHARE = 0.5, 0.773


def errors_of(result):
    """{version: errors over all validation periods}; the stages' own versions are "staged"."""
    errors = {}
    with h5py.File(result) as file:
        study = next(group["stages"] for group in file.values() if "stages" in group)
        for comparison in study["validation"].values():
            for number, name in enumerate(comparison["version"].asstr()[:]):
                name = name if name in ("initial", "at_once") else "staged"
                for period in comparison["periods"].values():
                    series = period["air"]
                    error = series["simulated"][number] - series["measured"][:]
                    errors.setdefault(name, []).append(error[~np.isnan(error)])
    return {name: np.concatenate(parts) for name, parts in errors.items()}


def judge(room, options, folder):
    """(RMSD, share within 0.5 K) by version."""
    job = folder / f"{room}.toml"
    job.write_text(school_job.job_text(options.cases / room, {"evaluations": options.evaluations}))
    result, begin = folder / f"{room}.h5", time.monotonic()
    running.run(options.program, job, result, options.ranks, ("--force",), capture_output=True)
    seconds = time.monotonic() - begin
    numbers = {name: (float(np.sqrt(np.mean(error ** 2))), float(np.mean(abs(error) <= WITHIN)))
               for name, error in errors_of(result).items()}
    for name, (rmsd, share) in numbers.items():
        print(f"{room}  {name:<8}  RMSD {rmsd:.2f} K  within {WITHIN} K {100 * share:.1f} %")
    print(f"{room}  {seconds:.1f} s")
    return numbers


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--cases", type=pathlib.Path, default=ROOT.parent / "shared/cases/dev")
    parser.add_argument("--only", nargs="+", default=ROOMS)
    parser.add_argument("--evaluations", type=int, default=10000, help="of each stage")
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--program", type=pathlib.Path, default=PROGRAM)
    parser.add_argument("--folder", type=pathlib.Path)
    return parser.parse_args()


def main():
    options = arguments()
    if not options.cases.is_dir():
        sys.exit(f"bench_school_rooms: {options.cases} is not there")
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.folder or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        rooms = [judge(room, options, folder) for room in options.only]
    halved = sum(each["staged"][0] <= each["initial"][0] / 2 for each in rooms)
    within = sum(each["staged"][1] >= 0.77 for each in rooms)
    shares = np.median([each["staged"][1] for each in rooms])
    print(f"school_rooms_rmsd_halved {halved} of_{len(rooms)} 2 {halved / 2}")
    print(f"school_rooms_share_reached {within} of_{len(rooms)} 2 {within / 2}")
    print(f"school_rooms_median_share {shares:.3f} 1 {PAPERS_SHARE} {shares / PAPERS_SHARE:.3f}")


if __name__ == "__main__":
    main()
