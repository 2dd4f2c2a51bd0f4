#!/usr/bin/python3
"""Retrofits of a small program's house, after a posterior and after a loop: as runs made by hand have it."""
import subprocess
import unittest

import numpy as np

from small_house import ENVIRONMENT, JOB, PROGRAM, SmallHouse
from test_loop_around import LoopAroundAProgram
from test_posterior_around import PosteriorOfAProgram

HELD_OUT = "period,first,last\nheld_out,2021-04-01,2021-04-30\n"
TRAINING = "period,first,last\ntraining,2021-01-01,2021-03-31\n"
RESISTANCE = 0.1 / 0.04       # [m2 K/W]


class RetrofitAfterAPosterior(SmallHouse):
    PROGRAM_TEXT = PosteriorOfAProgram.PROGRAM_TEXT
    JOB = JOB.replace('name = "u"\n', 'name = "u"\nunit = "W/(m2 K)"\nlimits = [0.1, 2]\n')
    NAME = "retrofit"
    STUDY = PosteriorOfAProgram.STUDY + """
[[study]]
kind = "retrofit"
of = "posterior"
period = "held_out"
n_predictive = 4

[[scenario]]
name = "insulated"
[[scenario.change]]
target = "u"
insulation = 0.1
conductivity = 0.04

[[scenario]]
name = "tight"
[[scenario.change]]
target = "leaks"
factor = 0.5

"""

    def test_before_and_after_are_runs_of_the_program(self):
        study = self.stored()
        points, before, after = (study[name][:] for name in ("points", "before", "after"))
        self.assertEqual(points.shape, (4, 2))
        n_compared = 0
        for k, (u, leaks) in enumerate(points):
            for made, values in ((before[k], (u, leaks)), (after[0, k], (u / (1 + u * RESISTANCE), leaks)),
                                 (after[1, k], (u, leaks / 2))):
                if np.isnan(made[0]):
                    continue          # a run that failed
                gas = self.gas_of({"u": values[0], "leaks": values[1]}, HELD_OUT).sum()
                self.assertAlmostEqual(made[0], gas, delta=1e-4 * gas)
                n_compared += 1
        self.assertGreater(n_compared, 6)
        saved = before[None, :, 0] - after[..., 0]
        np.testing.assert_allclose(study["saving_quantile"][:, 1, 0], np.nanmedian(saved, axis=1))
        self.assertEqual(self.texts("output"), ["gas"])
        self.assertEqual(len(self.texts("simulator_run")), 3 * 5)

    def test_the_cost_and_the_savings_are_told(self):
        plan = subprocess.run([PROGRAM, "check", "job.toml"], cwd=self.folder, env=ENVIRONMENT, capture_output=True,
                              text=True, check=True).stdout
        self.assertRegex(plan, r"job/retrofit +15 +15 ")
        report = subprocess.run([PROGRAM, "report", self.result], capture_output=True, text=True, check=True).stdout
        self.assertIn("insulated, applied to 4 points of job/posterior", report)
        self.assertIn("15 runs of the program: 3 as described, 4 before, 8 after", report)
        self.assertNotIn("too_cold", report)

    def test_ranks_and_a_stop_change_no_bit(self):
        self.check_same_bits(stop_after=0.03)


class RetrofitAfterALoop(SmallHouse):
    NAME = "retrofit"
    BY_WIND = LoopAroundAProgram.BY_WIND
    STUDY = LoopAroundAProgram.STUDY + """
[[study]]
kind = "retrofit"
of = "loop"

[[scenario]]
name = "sealed"
[[scenario.change]]
target = "effect.wind infiltration"
value = 0

[[scenario]]
name = "tight"
[[scenario.change]]
target = ["leaks", "effect.wind infiltration"]
factor = 0.5

"""

    def test_the_effect_is_struck_and_scaled(self):
        study = self.stored()
        loop = study.file["job"]["loop"]
        ((u, leaks),) = study["points"][:]
        np.testing.assert_allclose([u, leaks], loop["simulator_parameter_after"][:])
        (air,) = loop["simulator_series_value"][:, :24 * 90]     # of training
        values = {"u": float(u), "leaks": float(leaks)}
        for made, gas in ((study["before"][0, 0], self.gas_of(values, TRAINING, air)),
                          (study["after"][0, 0, 0], self.gas_of(values, TRAINING)),
                          (study["after"][1, 0, 0],
                           self.gas_of({**values, "leaks": values["leaks"] / 2}, TRAINING, air / 2))):
            self.assertAlmostEqual(made, gas.sum(), delta=1e-4 * gas.sum())
        self.assertGreater(study["saving_quantile"][0, 1, 0], 0)
        self.assertEqual(self.texts("simulator_given"), ["wind infiltration"])

    def test_ranks_and_a_stop_change_no_bit(self):
        self.check_same_bits(stop_after=0.05)


del LoopAroundAProgram, PosteriorOfAProgram, SmallHouse      # whose own tests are elsewhere

if __name__ == "__main__":
    unittest.main()
