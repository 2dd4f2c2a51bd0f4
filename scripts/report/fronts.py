"""Pictures of an optimisation: how it came down, the front of trade-offs, where in their ranges its points lie."""
import itertools

import numpy as np

from report import theme
from report.picture import Table, picture, short, unit_words
from report.screening import in_range, over_ranges, spread
from report.words import fixed, listed, number

WHOLE = "what is minimised"
MOST_DOTS, MOST_FRONTS = 800, 6        # points; pairs of objectives
NEAR = 4                               # points are drawn up to so many times the front's width from it


def objective_label(study, k):
    units = study.texts("objective_unit")
    name = study.texts("objective")[k]
    return f"{WHOLE if name == 'f' else short(name)}{unit_words(units[k] if k < len(units) else '')}"


def descent(study):
    """The best objective by round."""
    ends, best = study.numbers("round_end"), study.numbers("round_best")
    figure, axis = theme.figure(2.3)
    axis.step(ends, best, where="post", color=theme.AFTER)
    if (best > 0).all():
        axis.set_yscale("log")
        axis.yaxis.set_major_formatter(lambda value, _: number(value))
        axis.yaxis.set_minor_formatter(lambda value, _: number(value))
        axis.tick_params(axis="y", which="minor", labelsize=7)
    axis.set(xlabel="points", ylabel=objective_label(study, 0), xlim=(0, None))
    yield picture(figure, "The best point so far",
                  f"Best objective over the points: from {number(best[0])} after {number(ends[0])} points to "
                  f"{number(best[-1])} after {number(ends[-1], 6)}.",
                  "A line that is level at its end says that more points would not help much.")


def fronts(study):
    """Points and front of each pair of objectives."""
    front, points, names = study.numbers("front_objective"), study.numbers("point_objective"), study.texts("objective")
    if front.ndim != 2 or len(names) < 2:
        return
    for a, b in list(itertools.combinations(range(len(names)), 2))[:MOST_FRONTS]:
        low, high = front[:, [a, b]].min(axis=0), front[:, [a, b]].max(axis=0)
        width = np.maximum(high - low, 1e-3 * np.maximum(np.abs(high), 1e-12))
        near = (np.abs(points[:, [a, b]] - (low + high) / 2) <= NEAR * width).all(axis=1)
        some = spread(near, MOST_DOTS)
        order = np.argsort(front[:, a], kind="stable")
        figure, axis = theme.figure(2.8)
        theme.dots(axis, points[some, a], points[some, b], theme.PLAIN, alpha=0.5, size=2, label="points")
        axis.plot(front[order, a], front[order, b], "o", color=theme.AFTER, markersize=4, label="front")
        axis.set(xlabel=objective_label(study, a), ylabel=objective_label(study, b))
        theme.legend_above(axis)
        yield picture(figure, f"Front: {names[a]} and {names[b]}",
                      f"Front of {len(front)} points, no other of which is better in all: {names[a]} from "
                      f"{number(low[0])} to {number(high[0])}, {names[b]} from {number(low[1])} to {number(high[1])}.",
                      "Along the front one objective falls only as the other rises. Grey: points near it.")


def parameters(study):
    """Points of the front, or the best point, in the ranges."""
    values, names = study.numbers("front_parameters"), study.texts("parameter")
    if values.ndim != 2 or not len(values):
        return
    n = len(values)
    yield over_ranges(study, in_range(study, values), names, values,
                      f"the {n} points of the front" if n > 1 else "the best point", "Where they lie in their ranges"
                      if n > 1 else "Where the best point lies in the ranges", None if n > 1 else "best point")


def ends(study):
    """Which parameters ended at an end of their range."""
    names, at = study.texts("parameter"), study.numbers("at_bound").ravel()
    at_end = [f"{name} ({'lower' if value < 0 else 'upper'} end)" for name, value in zip(names, at) if value]
    if at_end:
        yield f"At an end of its range: {listed(at_end)}. The range may be too narrow, or the description is wrong."


def aims(study):
    """Targets and the errors of the nearest point."""
    columns = [study.texts("target"), study.numbers("target_measured"), study.texts("target_unit"),
               study.numbers("nearest_target_error")]
    yield Table("Targets", [("target", False), ("measured", True), ("unit", False), ("error of the nearest point [%]",
                                                                                    True)],
                [[name, number(measured, 5), unit, fixed(error, 3)] for name, measured, unit, error in zip(*columns)])
