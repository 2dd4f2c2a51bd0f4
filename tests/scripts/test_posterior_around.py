#!/usr/bin/python3
"""The posterior of a small program by an emulator of its runs: near the truth, told, the same bits on any ranks."""
import subprocess
import unittest

from small_house import HOUSE, PROGRAM, TRUTH, SmallHouse


class PosteriorOfAProgram(SmallHouse):
    # Air that follows the wind can be told from walls.
    PROGRAM_TEXT = HOUSE.replace('(values["leaks"] + more)', 'values["leaks"] * float(row[21]) / 4')
    STUDY = """[[study]]
kind = "posterior"
runs = 32
n_chains = 8
most_draws = 400
target_ess = 100
target_rhat = 1.05
autocorrelated = false
proportional = false
"""

    def test_it_lies_about_the_truth(self):
        study = self.stored()
        self.assertEqual(self.texts("unknown"), ["u", "leaks", "gas_constant", "log_density"])
        for k, name in enumerate(TRUTH):
            mean, sd = study["posterior_mean"][k], study["posterior_sd"][k]
            self.assertLess(abs(mean - TRUTH[name]), 3.5 * sd, name)
            self.assertLess(sd, 0.1)
        self.assertEqual(self.texts("simulator_run"), 20 * ["design"] + 12 * ["posterior"])
        self.assertLess(study["simulator_emulator_error"][0], 2)
        self.assertIn("predicted_q95", study["held_out/gas"])

    def test_runs_that_fail_are_told(self):
        self.check_failures_are_told()
        report = subprocess.run([PROGRAM, "report", self.result], capture_output=True, text=True, check=True).stdout
        self.assertIn("32 runs of the program: 20 design, 12 posterior;", report)
        self.assertIn("runs that the emulator had not seen are foretold within", report)

    def test_ranks_and_a_stop_change_no_bit(self):
        self.check_same_bits(stop_after=0.03)


if __name__ == "__main__":
    unittest.main()
