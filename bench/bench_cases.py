#!/usr/bin/python3
"""Loops on the cases of ../shared/cases/dev: what is found, and how much of the held-out error it
closes.

Prints `name value unit reference ratio`: for each case the share of the reducible held-out error that
is closed from the plain model to the one with effects, and from the one without effects, as
../shared/tools/score_case.py has it (the held-out readings and the truth are read by it alone); the
effects found; and the medians. BEMCAL_BENCH_CASES names other folders, separated by colons.
"""
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHARED = ROOT.parent / "shared"
SCORE = SHARED / "tools" / "score_case.py"


def case_folders():
    named = os.environ.get("BEMCAL_BENCH_CASES")
    if named:
        return [pathlib.Path(path) for path in named.split(":")]
    return sorted(path for path in (SHARED / "cases" / "dev").glob("*") if path.is_dir())


def closed(case, after, before):
    """Percent, over the affected channels; None where there is none."""
    text = subprocess.run([sys.executable, str(SCORE), str(case), str(after), str(before)],
                          check=True, capture_output=True, text=True).stdout
    share = re.search(r"closed over affected channels: (-?\d+) %", text)
    return int(share.group(1)) if share else None


def results_of(case, folder):
    """Percent closed by structure and effects, by effects alone; the effects' names."""
    effects = json.loads((folder / "effects.json").read_text())
    names = [f"{effect['name']}{'' if effect['adequate'] else ' (not adequate)'}"
             for effect in effects]
    return (closed(case, folder / "after.csv", folder / "plain.csv"),
            closed(case, folder / "after.csv", folder / "before.csv"), names)


def main():
    cases = case_folders()
    if not cases or not SCORE.exists():
        print(f"{SHARED / 'cases'} is not here: nothing is measured")
        return
    whole, by_effects = [], []
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        subprocess.run([ROOT / "scripts" / "run_case", *cases, out, "--ranks", "2"], check=True,
                       stdout=subprocess.DEVNULL)
        for case in cases:
            of_case = out / case.name if len(cases) > 1 else out
            all_of_it, effects_alone, names = results_of(case, of_case)
            print(f"# {case.name}: {'; '.join(names) or 'no effect'}")
            if all_of_it is None:
                continue
            whole.append(all_of_it)
            by_effects.append(effects_alone)
            print(f"{case.name}_closed {all_of_it} % 60 {all_of_it / 60:.2f}")
            print(f"{case.name}_closed_by_effects {effects_alone} % - -")
    if whole:
        median = statistics.median(whole)
        print(f"cases_closed_median {median} % 60 {median / 60:.2f}")
        print(f"cases_closed_by_effects_median {statistics.median(by_effects)} % - -")


if __name__ == "__main__":
    main()
