"""Whether a model's errors are worse than another's: by more than chance would make them.

Source: block bootstrap (Kuensch 1989), blocks of a fortnight."""
import math

import numpy as np

FORTNIGHT = 14 * 24


def by_fortnight(errors):
    """[fortnight x model] sums of squared errors, of fortnights that have any. errors: [model x hours]"""
    squares = np.nan_to_num(errors ** 2)
    rows = np.array([squares[:, k:k + FORTNIGHT].sum(axis=1) for k in range(0, squares.shape[1], FORTNIGHT)])
    return rows[rows.sum(axis=1) > 0]


def is_worse(squares):
    """Whether after is worse than before by over 1 % and two standard errors. [fortnight x (before, after)]
    sums of squared errors."""
    rng = np.random.default_rng(1)
    nothing = 1e-12 * squares.sum() + 1e-300    # of a meter that was never wrong, or in no fortnight that is drawn

    def change(rows):
        before, after = rows.sum(axis=0) + nothing
        return 0.5 * np.log(after / before)
    drawn = [change(squares[rng.integers(len(squares), size=len(squares))]) for _ in range(1000)]
    return bool(change(squares) > max(math.log(1.01), 2 * np.std(drawn)))
