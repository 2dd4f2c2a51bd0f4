#!/usr/bin/python3
"""A smaller sweep of scripts/bench attacks: nothing is lost, nothing is false, every end has its code."""
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def main():
    done = subprocess.run(["/usr/bin/python3", ROOT / "bench" / "bench_attacks.py", "--stride", "17", "--every", "8", "--damage",
                           "60", "--mixed", "14", "--kills", "12"], capture_output=True, text=True, check=False)
    rows = [line.split() for line in done.stdout.splitlines()]
    wrong = [row for row in rows if row[3] == "0" and row[1] != "0"]
    if done.returncode or len(rows) != 35 or wrong:
        sys.exit(f"{wrong}\n{done.stdout}\n{done.stderr}")


if __name__ == "__main__":
    os.environ.setdefault("BEMCAL_PROGRAM", str(ROOT / "build" / "release" / "bemcal-batch"))
    main()
