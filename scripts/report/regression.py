"""A regression of hourly readings on outdoor temperature and the hour of the week.

For every group of hours it is piecewise linear in temperature, with change points at quantiles of
the training temperatures, and has one level for each hour of the week (Mathieu et al. 2011, IEEE
Trans. Smart Grid 2(3), "time of week and temperature"; Coughlin et al. 2009). How the hours are
grouped, how many change points there are, whether the week follows summer time, and a ridge are
chosen by cross-validation over blocks of 14 days of the training period. Predictions are not below
zero. It knows neither the sun nor holidays.
"""
import copy
import itertools

import numpy as np

HOUR, HOURS_OF_WEEK = 3600, 168
GROUPINGS = {                  # hours that share a curve over temperature
    "one": lambda week: np.zeros_like(week),
    "weekend": lambda week: (week >= 120).astype(int),
    "hour of day": lambda week: week % 24,
    "hour of day, weekend": lambda week: week % 24 + 24 * (week >= 120),
    "hour of week": lambda week: week,
}
CHANGE_POINTS = (1, 3, 6)
CLOCKS = ("none", "eu")
RIDGES = (0.01, 10.0)
BLOCK_DAYS, FOLDS = 14, 5


def last_sunday(years, month):
    """Midnight of the last Sunday of the month in each year [s since 1970]."""
    last = (np.datetime64("1970", "M") + (years - 1970) * 12 + month).astype("datetime64[D]") - 1
    return (last - (last.astype(int) + 4) % 7).astype("datetime64[s]").astype(np.int64)


def hour_of_week(times, clock):
    """0 = Monday 00:00 to 168, by standard time or with European summer time."""
    if clock == "eu":
        years = times.astype("datetime64[s]").astype("datetime64[Y]").astype(int) + 1970
        summer = ((times >= last_sunday(years, 3) + HOUR)
                  & (times < last_sunday(years, 10) + HOUR))
        times = times + HOUR * summer
    return (times // HOUR + 72) % 168


def change_points(n, theta):
    return np.quantile(theta, np.arange(1, n + 1) / (n + 1))


class Rows:
    """Of each reading: its block (group of hours), its level in the block, and its hinges. Blocks have no
    column in common."""

    def __init__(self, form, knots, times, theta):
        grouping, _, clock = form
        week = hour_of_week(times, clock)
        group = GROUPINGS[grouping](np.arange(HOURS_OF_WEEK))
        level = np.array([(group[:hour] == group[hour]).sum() for hour in range(HOURS_OF_WEEK)])
        self.block, self.level = group[week], level[week]
        self.n_blocks, self.n_levels = group.max() + 1, level.max() + 1
        self.hinges = np.column_stack([theta / 10] + [np.maximum(theta - k, 0) / 10 for k in knots])

    def where(self, there):
        part = copy.copy(self)
        part.block, part.level, part.hinges = self.block[there], self.level[there], self.hinges[there]
        return part

    def of_blocks(self, values):
        """Their sum in each block."""
        return np.bincount(self.block, values, self.n_blocks)

    def of_levels(self, values=None):
        """Their sum at each level. [block x level]"""
        at = self.block * self.n_levels + self.level
        return np.bincount(at, values, self.n_blocks * self.n_levels).reshape(self.n_blocks, self.n_levels)

    def times(self, weights):
        return weights[self.block, self.level] + \
            (weights[self.block, self.n_levels:] * self.hinges).sum(axis=1)


class Equations:
    """Normal equations of each block, which add up over parts of the readings."""

    def __init__(self, matrix, right):
        self.matrix, self.right = matrix, right

    @classmethod
    def of(cls, rows, values):
        n_levels, n = rows.n_levels, rows.n_levels + rows.hinges.shape[1]
        matrix, right = np.zeros((rows.n_blocks, n, n)), np.zeros((rows.n_blocks, n))
        levels = np.arange(n_levels)
        matrix[:, levels, levels], right[:, :n_levels] = rows.of_levels(), rows.of_levels(values)
        for i, hinge in enumerate(rows.hinges.T, n_levels):
            matrix[:, i, :n_levels] = matrix[:, :n_levels, i] = rows.of_levels(hinge)
            right[:, i] = rows.of_blocks(hinge * values)
            for j, other in enumerate(rows.hinges.T, n_levels):
                matrix[:, i, j] = rows.of_blocks(hinge * other)
        return cls(matrix, right)

    def solved(self, ridge):
        identity = np.eye(self.matrix.shape[1])
        return np.linalg.solve(self.matrix + ridge * identity, self.right[..., None])[..., 0]

    def without(self, part):
        return Equations(self.matrix - part.matrix, self.right - part.right)


class Regression:
    """Least squares with a ridge; `plan` = (grouping, change points, clock, ridge)."""

    def __init__(self, plan, times, theta, measured):
        *self.form, ridge = plan
        self.knots = change_points(plan[1], theta)
        self.mean = measured.mean()
        rows = Rows(self.form, self.knots, times, theta)
        self.weights = Equations.of(rows, measured - self.mean).solved(ridge)

    def predict(self, times, theta):
        rows = Rows(self.form, self.knots, times, theta)
        return np.maximum(self.mean + rows.times(self.weights), 0)


def cross_validated(form, times, theta, measured):
    """{ridge: mean squared error over blocks that the fit has not seen}, of a plan without its ridge."""
    fold = (times // (BLOCK_DAYS * 24 * HOUR)) % FOLDS
    rows, values = Rows(form, change_points(form[1], theta), times, theta), measured - measured.mean()
    every, squares = Equations.of(rows, values), dict.fromkeys(RIDGES, 0.0)
    for k in np.unique(fold):
        part = rows.where(fold == k)
        rest = every.without(Equations.of(part, values[fold == k]))
        for ridge in RIDGES:
            predicted = np.maximum(part.times(rest.solved(ridge)), -measured.mean())
            squares[ridge] += ((predicted - values[fold == k]) ** 2).sum()
    return {ridge: summed / len(values) for ridge, summed in squares.items()}


def choose_plan(times, theta, measured):
    """(grouping, change points, clock, ridge) that foretells unseen blocks best."""
    errors = {(*form, ridge): error
              for form in itertools.product(GROUPINGS, CHANGE_POINTS, CLOCKS)
              for ridge, error in cross_validated(form, times, theta, measured).items()}
    return min(errors, key=errors.get)
