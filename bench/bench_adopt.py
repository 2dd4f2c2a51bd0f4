#!/usr/bin/python3
"""Jobs that carry on what their loop found: is there nothing more to find?

Each case of ../shared/cases/dev is run as a loop; `bemcal-batch adopt --keep-priors` writes its job anew, `check`
reads it, and a second loop, on the same readings, runs on the new jobs. Prints `name value unit reference ratio`:
effects of the first loop, those that the new jobs have, effects that the second loop finds beside them.
BEMCAL_BENCH_CASES names other folders, separated by colons; BEMCAL_BENCH_LOOPS a folder that scripts/run_case has
written for them already.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import h5py

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "bench"))
from bench_cases import case_folders  # noqa: E402

PROGRAM = os.environ.get("BEMCAL_PROGRAM", str(ROOT / "build" / "release" / "bemcal-batch"))


def effects_in(result, building):
    with h5py.File(result) as file:
        loop = next(iter(file[building][name] for name in file[building] if "effect" in file[building][name]))
        return list(loop["effect"].asstr()[:]), list(loop["effect_section"].asstr()[:])


def first_loops(cases, folder):
    """The folder of results and jobs."""
    given = os.environ.get("BEMCAL_BENCH_LOOPS")
    if given:
        return pathlib.Path(given)
    out = folder / "out"
    subprocess.run([ROOT / "scripts" / "run_case", *cases, out, "--ranks", "2"], check=True, stdout=subprocess.DEVNULL)
    return out


def adopt(result, jobs, building):
    """The new job; None where it is refused."""
    new = f"{building}_adopted.toml"
    stage = f"{building}/loop"
    done = subprocess.run([PROGRAM, "adopt", result, jobs / f"{building}.toml", "-o", jobs / new, "--stage", stage,
                           "--keep-priors"], capture_output=True, text=True)
    print(f"# {building}: {(done.stdout + done.stderr).strip()}")
    return new if done.returncode == 0 else None


def second_loops(jobs, new):
    (jobs / "again.toml").write_text('seed = 1\nbuildings = %s\n\n[[study]]\nkind = "loop"\n' % json.dumps(new))
    subprocess.run([PROGRAM, "check", jobs / "again.toml"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["mpirun", "-np", "2", PROGRAM, "run", jobs / "again.toml", "-o", jobs / "again.h5", "--no-report"],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return jobs / "again.h5"


def main():
    cases = case_folders()
    if not cases:
        print(f"{ROOT.parent / 'shared' / 'cases'} is not here: nothing is measured")
        return
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        out = first_loops(cases, folder)
        jobs = folder / "jobs"
        shutil.copytree(out / "job", jobs)
        result = next(out.glob("*.h5"))
        names = [case.name for case in cases]
        new = {building: adopt(result, jobs, building) for building in names}
        adopted = [building for building in names if new[building]]
        again = second_loops(jobs, [new[building] for building in adopted])
        first = {building: effects_in(result, building) for building in names}
        second = {building: effects_in(again, building)[0] for building in adopted}
        for building in adopted:
            print(f"# {building}: {'; '.join(first[building][0]) or 'nothing'}; then "
                  f"{'; '.join(second[building]) or 'nothing more'}")
        sections = [section for found in first.values() for section in found[1]]
        quiet = sum(not second[building] for building in adopted)
        print(f"adopt_jobs_read {len(adopted)} jobs {len(names)} {len(adopted) / len(names):.2f}")
        print(f"adopt_effects_declared {sum(map(bool, sections))} effects {len(sections)} -")
        print(f"adopt_nothing_more {quiet} jobs {len(adopted)} {quiet / len(adopted):.2f}")


if __name__ == "__main__":
    main()
