#!/usr/bin/python3
"""Jobs that carry on what their loop found: do they predict the same, and is there nothing more to find?

Each case of ../shared/cases/dev is run as a loop; `bemcal-batch adopt --keep-priors` writes its job anew, `check`
reads it, and a second loop, on the same readings, runs on the new jobs. Prints `name value unit reference ratio`:
effects of the first loop, those that the new jobs have; of every hour of every meter that the new job, without a fit,
and the loop's last model predict, the largest difference over the meter's largest hour (of one read by the month,
the sums'); effects that the second loop finds beside them.
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

SAME = 1e-9     # of the largest hour
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


def run_study(jobs, new, kind, keys=""):
    """The result of a study of the new jobs."""
    job, result = jobs / f"{kind}.toml", jobs / f"{kind}.h5"
    job.write_text(f'seed = 1\nbuildings = {json.dumps(new)}\n\n[[study]]\nkind = "{kind}"\n{keys}\n')
    subprocess.run([PROGRAM, "check", job], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["mpirun", "-np", "2", PROGRAM, "run", job, "-o", result, "--no-report"],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return result


def difference(loop, screening):
    """Between hours of the loop's last model and of the nominal building, over the largest hour."""
    largest = 0.0
    for period in loop["period"].asstr():
        for channel in loop["channel"].asstr():
            of_loop = loop[period][channel]["simulated"][-1]
            as_it_stands = screening[period][channel]["simulated"][0]
            if of_loop.shape != as_it_stands.shape:    # a meter that is read by the month: the sums
                of_loop, as_it_stands = of_loop.sum(keepdims=True), as_it_stands.sum(keepdims=True)
            largest = max(largest, abs(of_loop - as_it_stands).max() / abs(of_loop).max())
    return largest


def differences(result, screened, buildings):
    with h5py.File(result) as loops, h5py.File(screened) as screenings:
        return {building: difference(loops[building]["loop"], screenings[f"{building}/screening"])
                for building in buildings}


def judge(result, jobs, names):
    """Adopts each building's file of a folder and runs the new jobs: {building: (found, sections of that, found by a
    second loop, difference)}, the last two None where the new job was refused."""
    new = {building: adopt(result, jobs, building) for building in names}
    adopted = [building for building in names if new[building]]
    if not adopted:
        return {building: (*effects_in(result, building), None, None) for building in names}
    jobs_of_adopted = [new[building] for building in adopted]
    differs = differences(result, run_study(jobs, jobs_of_adopted, "screening", "n_points = 1"), adopted)
    again = run_study(jobs, jobs_of_adopted, "loop")
    judged = {}
    for building in names:
        found, sections = effects_in(result, building)
        is_adopted = building in adopted
        more = effects_in(again, building)[0] if is_adopted else None
        judged[building] = found, sections, more, differs.get(building)
        if is_adopted:
            print(f"# {building}: {'; '.join(found) or 'nothing'}; then {'; '.join(more) or 'nothing more'}; "
                  f"predictions differ by {differs[building]:.1e}", flush=True)
    return judged


def print_judged(judged):
    sections = [section for _, own, _, _ in judged.values() for section in own]
    differs = [differs for *_, differs in judged.values() if differs is not None]
    quiet = sum(more == [] for _, _, more, _ in judged.values())
    n = len(differs)
    print(f"adopt_jobs_read {n} jobs {len(judged)} {n / len(judged):.2f}")
    if not n:
        return
    print(f"adopt_effects_declared {sum(map(bool, sections))} effects {len(sections)} -")
    same = sum(d <= SAME for d in differs)
    print(f"adopt_predicts_the_same {same} jobs {n} {same / n:.2f}")
    print(f"adopt_largest_difference {max(differs):.1e} - {SAME} {max(differs) / SAME:.2g}")
    print(f"adopt_nothing_more {quiet} jobs {n} {quiet / n:.2f}")


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
        print_judged(judge(next(out.glob("*.h5")), jobs, [case.name for case in cases]))


if __name__ == "__main__":
    main()
