#!/usr/bin/python3
"""Six weeks of a real house's room temperature go through the loop: jobs/twin_house_n2, whose readings
are at ../shared. A week warms the model up, two and a half are learned from, and as many are held out.
Prints the three models' errors. Exits with 77 where there are no readings or no program.

Nothing was changed at this house, so an effect that is found is a false one. One house is not a
statistic: the test holds this result, it says nothing of others."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from report import result  # noqa: E402

JOB = ROOT / "jobs" / "twin_house_n2" / "twin_house_n2.toml"
READINGS = ROOT.parent / "shared" / "data" / "twinhouse_n2"
PROGRAM = os.environ.get("BEMCAL_PROGRAM", ROOT / "build" / "release" / "bemcal-batch")
MOST = 0.35        # of the held-out error after the loop [K]; measured: 0.31
MOST_OF_PLAIN = 0.6   # of the plain model's; measured: 0.38
MOST_WORSE = 1.01  # after over before


class TwinHouse(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "house.h5"
            done = subprocess.run([PROGRAM, "run", JOB, "-o", file, "--no-report"], check=False,
                                  capture_output=True, text=True)
            if done.returncode != 0:
                raise SystemExit(done.stdout + done.stderr)
            cls.loop = result.read(file)
            with h5py.File(file) as values:
                cls.n_effects = len(values["twin_house_n2/loop/effect"])
        row = next(row for row in cls.loop.judged_errors() if row.resolution == "hourly")
        cls.plain, cls.before, cls.after = row.error
        print(f"held out, air: plain {cls.plain:.3f} K, before {cls.before:.3f} K, "
              f"after {cls.after:.3f} K")

    def test_the_structure_takes_most_of_the_error_away(self):
        self.assertLess(self.before, MOST_OF_PLAIN * self.plain)
        self.assertLess(self.after, MOST)

    def test_effects_and_functions_do_no_harm(self):
        self.assertLess(self.after, MOST_WORSE * self.before)

    def test_no_effect_is_named(self):
        self.assertEqual(self.n_effects, 0)


if __name__ == "__main__":
    if not READINGS.exists() or not pathlib.Path(PROGRAM).exists():
        print(f"skipped: no readings in {READINGS}, or no program {PROGRAM}")
        sys.exit(77)
    unittest.main()
