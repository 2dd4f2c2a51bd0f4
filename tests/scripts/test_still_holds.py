#!/usr/bin/python3
"""scripts/still_holds: which parameters of two posteriors agree."""
import importlib.machinery
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
N = (4, 250)
sys.dont_write_bytecode = True
still_holds = importlib.machinery.SourceFileLoader(
    "still_holds", str(ROOT / "scripts" / "still_holds")).load_module()


def write(path, group, means, sds, seed):
    """A result with normal draws; the priors have a standard deviation of 1."""
    rng = np.random.default_rng(seed)
    with h5py.File(path, "a") as file:
        for name, mean, sd in zip("abc", means, sds):
            data = file.create_dataset(f"{group}/posterior/{name}",
                                       data=mean + sd * rng.standard_normal(N))
            data.attrs["units"] = "1/h"
            file[f"{group}/prior/{name}"] = rng.standard_normal((1, 1000))
        file[f"{group}/posterior/draw"] = np.arange(N[1])
        file[f"{group}/ess_bulk"] = np.ones(3)


class StillHolds(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.addCleanup(self.place.cleanup)
        self.before = pathlib.Path(self.place.name) / "before.h5"
        self.after = pathlib.Path(self.place.name) / "after.h5"

    def compare(self, *words):
        return subprocess.run([ROOT / "scripts" / "still_holds", self.before, self.after, *words],
                              capture_output=True, text=True, check=False)

    def test_what_agrees_holds(self):
        write(self.before, "house/posterior", [1, 2, 3], [0.1, 0.2, 0.95], 1)
        write(self.after, "house/posterior", [1.05, 1.9, 2.5], [0.1, 0.1, 0.5], 2)
        done = self.compare()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("3 of 3 parameters hold", done.stdout)
        self.assertRegex(done.stdout, r"(?m)^c .* holds \(little learned\)$")
        self.assertRegex(done.stdout, r"(?m)^a .* holds$")

    def test_what_moved_by_several_sds_does_not_hold(self):
        write(self.before, "house/posterior", [1, 2, 3], [0.1, 0.2, 0.3], 1)
        write(self.after, "house/posterior", [1, 3.2, 3], [0.1, 0.2, 0.3], 2)
        done = self.compare()
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"(?m)^b .* 0\.00 .* does not hold$")
        self.assertIn("2 of 3 parameters hold", done.stdout)

    def test_a_false_alarm_comes_as_often_as_the_level_says(self):
        # Posteriors of sd 1 whose means are draws of sd 1 around the truth: p is uniform. Of 300
        # sets of three parameters at 0.2, 56 +- 6.8 alarm; outside 3 sd with a chance of 0.3 %.
        rng = np.random.default_rng(5)
        draws = lambda: rng.standard_normal() + rng.standard_normal(400)
        alarms = sum(any(still_holds.chance(draws(), draws()) < 0.2 / 3 for _ in range(3))
                     for _ in range(300))
        self.assertTrue(36 <= alarms <= 77, alarms)

    def test_overlap_is_the_share_of_the_narrower_interval(self):
        self.assertAlmostEqual(still_holds.overlap((0, 1, 2), (1, 4, 9)), 0.5)
        self.assertEqual(still_holds.overlap((0, 1, 2), (3, 4, 9)), 0)
        self.assertEqual(still_holds.overlap((0, 1, 2), (1, 1, 1)), 1)

    def test_a_file_with_several_posteriors_asks_which(self):
        write(self.before, "house/posterior", [1, 2, 3], [0.1, 0.2, 0.3], 1)
        write(self.before, "flat/posterior", [9, 9, 9], [0.1, 0.2, 0.3], 1)
        write(self.after, "house/posterior", [1, 2, 3], [0.1, 0.2, 0.3], 2)
        done = self.compare()
        self.assertEqual(done.returncode, 64)
        self.assertIn("expected one of its posteriors: flat/posterior, house/posterior", done.stderr)
        self.assertEqual(self.compare("--before", "house/posterior").returncode, 0)
        self.assertEqual(self.compare("--before", "flat/posterior").returncode, 1)

    def test_a_file_without_a_posterior_is_refused(self):
        write(self.before, "house/posterior", [1, 2, 3], [0.1, 0.2, 0.3], 1)
        h5py.File(self.after, "w").close()
        done = self.compare()
        self.assertEqual(done.returncode, 64)
        self.assertIn("has no posterior", done.stderr)


if __name__ == "__main__":
    unittest.main()
