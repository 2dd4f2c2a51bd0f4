#!/usr/bin/python3
"""What scripts/change_point_baseline prints of a loop is read by bench/bench_real_loops.py, and has
the errors that the result has."""
import contextlib
import importlib.machinery
import importlib.util
import io
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "bench"), str(pathlib.Path(__file__).parent)]

import bench_real_loops  # noqa: E402
import change_of_errors  # noqa: E402
import numpy as np  # noqa: E402
import fake_loop_result  # noqa: E402
from report import result  # noqa: E402


def printed_of(file):
    """What change_point_baseline prints."""
    loader = importlib.machinery.SourceFileLoader("change_point_baseline",
                                                  str(ROOT / "scripts" / "change_point_baseline"))
    script = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(script)
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        script.compare_all(file)
    return printed.getvalue()


class RealLoops(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            file = fake_loop_result.write(pathlib.Path(folder) / "office.h5",
                                          channels={"air": "degC", "gas": "kWh"})
            cls.loop = result.read(file)
            cls.errors = bench_real_loops.errors_of(printed_of(file))

    def test_the_models_errors_are_those_of_the_stored_series(self):
        names = ("plain", "before", "after")
        for channel, unit in (("air", "K"), ("gas", "%")):
            models = self.errors["office", channel, self.loop.judged]
            row = next(row for row in self.loop.judged_errors()
                       if row.channel == channel and row.resolution == "hourly")
            for k, name in enumerate(names):
                self.assertEqual(models[name][1], unit)
                self.assertAlmostEqual(models[name][0], row.error[k], delta=0.01)

    def test_a_meter_has_a_regression_beside_it_and_a_temperature_none(self):
        period = self.loop.judged
        hourly, unit, monthly = self.errors["office", "gas", period]["regression"]
        self.assertEqual(unit, "%")
        self.assertTrue(0 < hourly < 200 and 0 < monthly < 200)
        self.assertNotIn("regression", self.errors["office", "air", period])

    def test_a_series_is_judged_by_all_its_held_out_hours_together(self):
        def models(plain, after, **others):
            return {name: (error, "%", None) for name, error in
                    dict(others, plain=plain, before=plain, after=after).items()}

        series = bench_real_loops.of_all_held_out({
            ("house", "gas", "training"): models(9, 1),
            ("house", "gas", "autumn"): models(20, 30),
            ("house", "gas", "spring"): models(40, 20),
            ("house", "gas", "all held out"): models(30, 25, regression=25),
            ("office", "gas", "held_out"): models(30, 31, regression=29),
            ("office", "air", "held_out"): models(1, 1.005)})
        self.assertEqual([of["after"] for of in series], [25, 31, 1.005])
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            bench_real_loops.print_counts(series)
        self.assertEqual(printed.getvalue().splitlines(), [
            "real_series_lower_by_10_percent 1 of_3 - -",
            "real_series_higher_by_1_percent 1 of_3 - -",
            "real_series_worse_than_before 0 of_3 - -",
            "real_series_not_above_regression 1 of_2 - -",
            "real_series_within_2_percent_of_regression 1 of_2 - -"])

    # Of 26 fortnights with equal errors none is worse; with errors that all rose by 5 %, in one more than
    # in another, it is; where one fortnight alone rose, it is not.
    def test_worse_is_what_stands_out_from_fortnight_to_fortnight(self):
        before = np.random.default_rng(1).uniform(1, 2, 26)
        for change, is_worse in ((np.ones(26), False), (1.05**2 + 0.02 * np.sin(np.arange(26)), True),
                                 (np.where(np.arange(26) == 3, 4, 1), False), (np.full(26, 1.005**2), False)):
            self.assertEqual(change_of_errors.is_worse(np.stack([before, before * change], axis=1)), is_worse)
        self.assertFalse(change_of_errors.is_worse(np.zeros((26, 2))))
        self.assertTrue(change_of_errors.is_worse(np.stack([0 * before, before], axis=1)))


if __name__ == "__main__":
    unittest.main()
