#!/usr/bin/python3
"""The regression beside the loop: its blocks solved apart are least squares over all columns, what is left
out is not seen, and a building that is one is found again."""
import pathlib
import sys
import unittest

import numpy as np

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from report import regression  # noqa: E402

HOUR = regression.HOUR
TIMES = np.datetime64("2021-01-01", "s").astype(np.int64) + HOUR * np.arange(8760)
RANDOM = np.random.default_rng(1)
THETA = 10 - 10 * np.cos(2 * np.pi * np.arange(8760) / 8760) + 3 * RANDOM.normal(size=8760)


def columns_of(form, times, theta):
    """All columns written out: a level for each hour of the week, hinges of each group."""
    week = regression.hour_of_week(times, form[2])
    group = regression.GROUPINGS[form[0]](np.arange(168))
    knots = regression.change_points(form[1], THETA)
    hinges = [theta / 10] + [np.maximum(theta - k, 0) / 10 for k in knots]
    levels = [week == hour for hour in range(168)]
    return np.column_stack(levels + [(group[week] == g) * h for g in range(group.max() + 1) for h in hinges])


class RegressionTest(unittest.TestCase):
    def test_blocks_are_least_squares_over_all_columns(self):
        values = 20 + np.maximum(15 - THETA, 0) * (1 + (TIMES // HOUR % 24 > 7)) + RANDOM.normal(size=8760)
        for form in (("one", 3, "none"), ("weekend", 1, "eu"), ("hour of day, weekend", 3, "none")):
            fit = regression.Regression((*form, 10.0), TIMES, THETA, values)
            columns = columns_of(form, TIMES, THETA).astype(float)
            weights = np.linalg.solve(columns.T @ columns + 10 * np.eye(columns.shape[1]),
                                      columns.T @ (values - values.mean()))
            np.testing.assert_allclose(fit.predict(TIMES, THETA), np.maximum(values.mean() + columns @ weights, 0),
                                       rtol=1e-9, err_msg=str(form))

    def test_a_fold_is_judged_by_a_fit_that_has_not_seen_it(self):
        values = 20 + np.maximum(15 - THETA, 0) + RANDOM.normal(size=8760)
        form, squares = ("one", 1, "none"), 0
        fold = TIMES // (14 * 24 * HOUR) % 5
        columns, centred = columns_of(form, TIMES, THETA).astype(float), values - values.mean()
        for k in range(5):
            seen = columns[fold != k]
            weights = np.linalg.solve(seen.T @ seen + 10 * np.eye(columns.shape[1]), seen.T @ centred[fold != k])
            squares += ((columns[fold == k] @ weights - centred[fold == k])**2).sum()
        self.assertAlmostEqual(regression.cross_validated(form, TIMES, THETA, values)[10.0], squares / 8760)

    def test_a_building_that_is_one_is_found_again(self):
        by_hour = np.where((TIMES // HOUR + 72) % 168 < 120, TIMES // HOUR % 24, 0)
        truth = 5 + by_hour + np.maximum(15 - THETA, 0) * (by_hour > 8)
        fit = regression.Regression(regression.choose_plan(TIMES, THETA, truth), TIMES, THETA, truth)
        self.assertLess(np.sqrt(np.mean((fit.predict(TIMES, THETA) - truth)**2)), 0.02 * truth.mean())

    def test_hours_follow_summer_time_if_asked(self):
        july = np.array(["2021-07-05T00:00:00"], "datetime64[s]").astype(np.int64)
        self.assertEqual(regression.hour_of_week(july, "none")[0], 0)
        self.assertEqual(regression.hour_of_week(july, "eu")[0], 1)


if __name__ == "__main__":
    unittest.main()
