#!/usr/bin/python3
"""Inputs as people have them: how many of the situations of ../shared/field are read rightly, or refused
with the reason.

Prints `name value unit reference ratio`, and what fails of the others. A situation whose tools are absent
(code 77) is not counted. BEMCAL names another program.
"""
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FIELD = ROOT.parent / "shared" / "field"
PROGRAM = ROOT / "build" / "release" / "bemcal-batch"
ABSENT = 77


def situations():
    return sorted(run.parent for run in FIELD.glob("[0-9]*/run.sh"))


def result_of(folder, environment):
    """Its code, and the lines that say what fails."""
    done = subprocess.run([folder / "run.sh"], env=environment, capture_output=True, text=True,
                          errors="replace", check=False)
    lines = (done.stdout + done.stderr).splitlines()
    return done.returncode, [line for line in lines if line.startswith("FAIL")] or lines[-1:]


def main():
    if not FIELD.is_dir():
        print(f"{FIELD} is not here: nothing is measured")
        return 0
    environment = {"BEMCAL": str(PROGRAM), **os.environ}
    n_ok, n = 0, 0
    for folder in situations():
        code, lines = result_of(folder, environment)
        n += code != ABSENT
        n_ok += code == 0
        if code == 0:
            continue
        print(f"{folder.name}: {'not tried' if code == ABSENT else 'fails'}")
        for line in lines:
            print(f"  {line}")
    print(f"field_cases_ok {n_ok} 1 {n} {n_ok / max(n, 1):.3g}")
    return 0 if n_ok == n else 1


if __name__ == "__main__":
    sys.exit(main())
