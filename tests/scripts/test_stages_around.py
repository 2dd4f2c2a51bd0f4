#!/usr/bin/python3
"""Stages of a small program by an emulator of its runs: near the truth, the last run by hand, the same bits."""
import subprocess
import unittest

import numpy as np

from small_house import PERIODS, PROGRAM, TRUTH, SmallHouse
from test_posterior_around import PosteriorOfAProgram


class StagesOfAProgram(SmallHouse):
    PROGRAM_TEXT = PosteriorOfAProgram.PROGRAM_TEXT
    STUDY = """[[study]]
kind = "stages"
runs = 32
evaluations = 600
objective = "fraction"
at_once = false

[[study.stage]]
name = "walls"
periods = ["training"]
parameters = ["u"]

[[study.stage]]
name = "both"
periods = ["training"]
parameters = ["u", "leaks"]

[[study.validation]]
period = "held_out"

"""

    def test_the_last_stage_is_near_the_truth(self):
        value = self.stored()["calibration_value"][:]
        self.assertEqual(value[0, 1], 0.5)       # the first stage leaves it alone
        for k, name in enumerate(TRUTH):
            self.assertAlmostEqual(value[1, k], TRUTH[name], delta=0.05, msg=name)
        self.assertEqual(self.texts("simulator_run"), 20 * ["design"] + 12 * ["calibration"] + ["best point"])

    def test_the_best_point_was_run(self):
        study = self.stored()
        u, leaks = study["calibration_value"][1]
        gas = self.gas_of({"u": float(u), "leaks": float(leaks)}, PERIODS)
        read = np.loadtxt(self.folder / "measured.csv", skiprows=1, delimiter=",", usecols=1)
        for k, hours in enumerate((slice(0, 24 * 90), slice(24 * 90, None))):
            error = 100 * np.sqrt(np.mean((gas[hours] - read[hours]) ** 2)) / read[hours].mean()
            self.assertAlmostEqual(study["best_run_value"][k], error, delta=0.02 * error)
            self.assertAlmostEqual(study["best_run_foretold"][k], error, delta=0.2 * error)

    def test_runs_and_the_last_one_are_told(self):
        self.check_failures_are_told()
        report = subprocess.run([PROGRAM, "report", self.result], capture_output=True, text=True, check=True).stdout
        self.assertIn("33 runs of the program: 20 design, 12 calibration, 1 best point;", report)
        self.assertIn("the program at the best point: gas in training, calibrated on", report)

    def test_ranks_and_a_stop_change_no_bit(self):
        self.check_same_bits(stop_after=0.03)


del PosteriorOfAProgram, SmallHouse      # whose own tests are elsewhere

if __name__ == "__main__":
    unittest.main()
