#!/usr/bin/python3
"""A loop around a small program: an effect is found and given to it; the same bits on any ranks and after a stop."""
import unittest

import numpy as np

from small_house import SmallHouse


class LoopAroundAProgram(SmallHouse):
    STUDY = """[[study]]
kind = "loop"
runs = 36
try_structures = false
generic = false
functions = false
"""
    BY_WIND = 0.05

    def test_the_effect_is_found_and_the_program_runs_with_it(self):
        self.assertEqual(self.texts("effect"), ["wind infiltration"])
        self.assertEqual(self.texts("simulator_given_hooks"), ["infiltration"])
        loop = self.stored()
        before, after = loop["fit"][1:3, :, 0, 0, list(self.texts("metric")).index("cv_rmse")]
        self.assertAlmostEqual(loop["effect_coefficient"][0], self.BY_WIND, delta=0.01)
        self.assertLess(after[0], 0.75 * before[0])
        self.assertLess(after[1], before[1])     # the month that was held out, mostly noise

    def test_only_what_is_reported_is_run_for_the_held_out_month(self):
        of, years = self.texts("simulator_run"), self.stored()["simulator_run_years"][:]
        held_out = np.array([each == "held out" for each in of])
        self.assertIn(held_out.sum(), (2, 3))
        np.testing.assert_allclose(years[held_out], 30 / 365)
        np.testing.assert_allclose(years[~held_out], 90 / 365)

    def test_runs_that_fail_are_told(self):
        self.check_failures_are_told()

    def test_ranks_and_a_stop_change_no_bit(self):
        self.check_same_bits(stop_after=0.03)


class LoopAroundAProgramWithTemplates(SmallHouse):
    """A program that reads no effects.toml: its air by the hour stands in a file of its own."""
    STUDY = LoopAroundAProgram.STUDY
    BY_WIND = LoopAroundAProgram.BY_WIND
    TEMPLATES = {**SmallHouse.TEMPLATES, "air.dat.in": "@more_air@\n"}
    SIMULATOR = """[[simulator.template]]
file = "air.dat.in"

[[simulator.effect]]
name = "more_air"
hook = "infiltration"

"""

    def test_the_effect_is_given_by_the_hour(self):
        self.assertEqual(self.texts("effect"), ["wind infiltration"])
        self.assertEqual(self.texts("simulator_given_hooks"), ["infiltration"])
        before, after = self.stored()["fit"][1:3, :, 0, 0, list(self.texts("metric")).index("cv_rmse")]
        self.assertLess(after[0], 0.75 * before[0])
        self.assertLess(after[1], before[1])


if __name__ == "__main__":
    unittest.main()
