#!/usr/bin/python3
"""Attacks on a batch and its files: how many of ../shared/attack do no harm, and end with the right code.

Each makes its inputs in a folder of its own and prints what happened; WANTED is what has to stand there.
Prints `name value unit reference ratio`, and what the others printed. BEMCAL_PROGRAM names another program.
"""
import os
import re
import subprocess
import sys

import large_job

ATTACKS = large_job.ROOT.parent / "shared" / "attack"
HASH = r"\s*result hash (?P<hash>[0-9a-f]{32})\n"

WANTED = {
    "01": r"exit code 0\ninput kept\n",
    "02": HASH + r"exit code 0\n.*resuming: .*\na\.h5: complete\n\s*result hash (?P=hash)\n",
    "03": r"status: exit code 65\nreport: exit code 65\n",
    "05": r"full: exit code 74\na\.h5\nclosed: exit code 74\nb\.h5\n",
    "06": r"(?:.* >/dev/full: exit code 74\n){4}",
    "09": r"exit code 73\no\.h5\.part/thesis\.txt\n",
    "10": r"exit code 0\n0000000 +p +r +e +c +i +o +u +s\n",
    "11": r"0\n",  # no cell that is a formula, no line with an escape sequence
    "12": r"(?:.*: exit code 65: .*rank-0\.log: is a folder.*\n){2}",
    "14": r".*\n  DAMAGED: .*\nstatus: exit code 65\nreport: exit code 65\n--after: exit code 65, says damaged: 1\n",
    "15": HASH + r"(?:\d+ MB: exit code (?:0|71), then --resume 0, +result hash (?P=hash)\n){9}",
    "16": r"(?:write \d+ fails: exit code (?:0|74), \n){6}",  # DAMAGED would stand at a line's end
}


def attacks():
    return sorted(run.parent for run in ATTACKS.glob("[0-9]*/run.sh"))


def said_by(attack):
    environment = {**os.environ, "BEMCAL_PROGRAM": str(large_job.PROGRAM), "PY": sys.executable}
    done = subprocess.run([attack / "run.sh"], env=environment, capture_output=True, text=True, errors="replace",
                          check=False)
    return done.stdout, done.stderr


def main():
    if not ATTACKS.is_dir():
        print(f"{ATTACKS} is not here: nothing is measured")
        return 0
    n_harmless = 0
    for attack in attacks():
        out, complaints = said_by(attack)
        is_harmless = re.fullmatch(WANTED.get(attack.name[:2], ""), out) is not None
        n_harmless += is_harmless
        if not is_harmless:
            print(f"{attack.name}: harms, or ends with another code\n{out}{complaints}")
    n = len(attacks())
    print(f"attacks_harmless {n_harmless} 1 {n} {n_harmless / max(n, 1):.3g}")
    return 0 if n_harmless == n else 1


if __name__ == "__main__":
    sys.exit(main())
