"""Pictures of a calibration in stages: values with standard deviations stage by stage, errors before and after."""
import numpy as np

from report import theme
from report.picture import LONGEST_OF_THREE, Table, and_more, bare_unit, picture, short, unit_words
from report.stored import join
from report.words import beside, fixed, listed, number, unit_said

Z_90 = 1.645                   # half of a 90 % interval, in standard deviations
MOST_PANELS, MOST_CURVES = 24, 8
NEARLY_ALL = 0.99              # of the readings: larger errors are not drawn
RMSE = "rmse"
# Of the versions stored. Those behind them stand beside: all parameters calibrated at once, and other studies.
BEFORE, AFTER = 0, 1
AT_ONCE = "at_once"            # behind the stages


def is_calibrated(study):
    """[stage x parameter]"""
    return np.isfinite(study.numbers("calibration_least"))


def values(study):
    """Each parameter's value after the stages that calibrate it, side by side."""
    found, sd = study.numbers("calibration_value"), study.numbers("calibration_sd")
    stages, names, units = (study.texts(name) for name in ("calibration_stage", "parameter", "parameter_unit"))
    calibrated = is_calibrated(study)
    if found.shape != (len(stages), len(names)) or calibrated.shape != found.shape:
        return
    all_shown = [p for p in range(len(names)) if calibrated[:, p].any()]
    shown = all_shown[:MOST_PANELS]
    least, most = study.numbers("calibration_least"), study.numbers("calibration_most")
    figure, axes = theme.panels(len(shown), 3, 0.75 + 0.11 * len(stages), sharey=True)
    for axis, p in zip(axes, shown):
        for s in np.flatnonzero(calibrated[:, p]):
            axis.plot([least[s, p], most[s, p]], [s, s], color=theme.GRID, linewidth=3, zorder=1)
            half = Z_90 * sd[s, p] if sd.shape == found.shape and np.isfinite(sd[s, p]) else 0
            low, high = (np.clip(found[s, p] + side * half, least[s, p], most[s, p]) for side in (-1, 1))
            axis.plot([low, high], [s, s], color=theme.AFTER, linewidth=1.4)
            axis.plot(found[s, p], s, "o", color=theme.AFTER, markersize=4)
        axis.set_title(short(names[p], LONGEST_OF_THREE), fontsize=6.5)
        axis.set_xlabel(unit_words(units[p]).strip(), fontsize=6.5)
        axis.tick_params(labelsize=6.5)
        axis.locator_params(axis="x", nbins=3)
        theme.compact(axis)
        axis.grid(False, axis="y")
    axes[0].set(yticks=range(len(stages)), yticklabels=[short(stage) for stage in stages],
                ylim=(len(stages) - 0.5, -0.5))
    said = "; ".join(f"{names[p]} {number(found[s, p])}" for p in shown for s in last_stage(stages, calibrated[:, p]))
    yield picture(figure, "Values by stage", f"Calibrated values in the last stage that has each parameter: {said}.",
                  "Dots: values; lines: 90 % intervals (1.645 standard deviations), cut at the range; grey: the range."
                  + and_more(len(all_shown), len(shown), "parameters"))


def last_stage(stages, calibrated):
    """The last that calibrates a parameter, as a list; all parameters at once are no stage."""
    return [s for s, stage in enumerate(stages) if calibrated[s] and stage != AT_ONCE][-1:]


def table(study):
    """Every stage and parameter: from, range, value, standard deviation."""
    stages, names, units = (study.texts(name) for name in ("calibration_stage", "parameter", "parameter_unit"))
    start, found, sd, least, most, bound = (study.numbers(f"calibration_{name}") for name in
                                            ("start", "value", "sd", "least", "most", "at_bound"))
    rows = []
    for s, p in np.argwhere(is_calibrated(study)):
        remark = {-1: "lower end", 1: "upper end"}.get(bound[s, p], "") if bound.shape == found.shape else ""
        rows.append([stages[s], names[p], number(start[s, p], 4), beside(found[s, p], sd[s, p]),
                     beside(sd[s, p], sd[s, p]),
                     f"{number(least[s, p])} to {number(most[s, p])}", bare_unit(units[p]), remark])
    yield Table("Values", [("stage", False), ("parameter", False), ("from", True), ("value", True), ("sd", True),
                           ("range", True), ("unit", False), ("remark", False)], rows)


def comparisons(study):
    """(name, group) of stages, in their order, and validations with their errors."""
    order = study.texts("calibration_stage")
    groups = sorted(study.groups_with("version_fit", "version", "metric"),
                    key=lambda group: order.index(group.rpartition("/")[2]) if not group.startswith("validation") and
                    group.rpartition("/")[2] in order else len(order))
    return [(group.rpartition("/")[2], group) for group in groups
            if RMSE in study.texts(join(group, "metric")) and study.knows(join(group, "version_fit"))]


def errors(study):
    """RMSE before and after each stage, and on the periods of validation."""
    rows = []
    for name, group in comparisons(study):
        fit, metrics = study.numbers(join(group, "version_fit")), study.texts(join(group, "metric"))
        for m, meter in enumerate(study.texts(join(group, "meter"))):
            if fit.ndim == 3 and m < fit.shape[1]:
                rows.append((f"{name}, {meter}", fit[[BEFORE, AFTER], m, metrics.index(RMSE)],
                             study.texts(join(group, "version")), study.texts(join(group, "meter_unit"))[m]))
    if not rows:
        return
    figure, axis = theme.figure(0.85 + 0.28 * len(rows))
    for y, (_, both, _, _) in enumerate(rows):
        axis.plot(both, [y, y], color=theme.GRID, linewidth=3, zorder=1)
        for value, colour, label in zip(both, (theme.BEFORE, theme.AFTER), ("before", "after")):
            axis.scatter(value, y, s=36, color=colour, label=label if y == 0 else None)
    axis.set_yticks(range(len(rows)), [short(name) for name, *_ in rows])
    units = {unit for *_, unit in rows}
    axis.set(xlabel="RMSE" + (unit_words(units.pop().replace("degC", "K")) if len(units) == 1 else ""),
             ylim=(len(rows) - 0.5, -0.5))
    axis.set_xlim(left=0)
    axis.grid(False, axis="y")
    theme.legend_above(axis)
    said = "; ".join(f"{name} from {number(both[0])} ({versions[BEFORE]}) to {number(both[1])} ({versions[AFTER]})"
                     for name, both, versions, _ in rows)
    yield picture(figure, "Errors before and after", f"Root mean square errors: {said}.",
                  "Of stages before and after them, of periods of validation with the building as it was and as "
                  "calibrated.")


def distributions(study):
    """Share of the readings whose error is at most so large, on the periods of validation, else of the stages."""
    found = [(name, group) for name, group in comparisons(study) if group.startswith("validation")] \
        or comparisons(study)
    found = [(name, group) for name, group in found if study.has(join(group, "error_share"))][:MOST_CURVES]
    if not found:
        return
    figure, axes = theme.panels(len(found), 2, 1.5, sharey=True)
    said = []
    for axis, (name, group) in zip(axes, found):
        shares, level = study.numbers(join(group, "error_share")), study.numbers(join(group, "error_level"))
        for version, colour in ((BEFORE, theme.BEFORE), (AFTER, theme.AFTER)):
            axis.plot(level, 100 * shares[version, 0], color=colour)
        axis.set_title(short(name), fontsize=7.5)
        accuracy = study.number("accuracy")
        if np.isfinite(accuracy):
            axis.axvline(accuracy, color=theme.SOFT, linewidth=0.8, linestyle=":")
        said.append(f"{name} {half_below(shares[AFTER, 0], level)}")
        unit = (study.texts(join(group, "meter_unit")) or [""])[0].replace("degC", "K")
        reached = np.flatnonzero((shares[[BEFORE, AFTER], 0] >= NEARLY_ALL).all(axis=0))
        axis.set(ylim=(0, 100), xlim=(0, level[reached[0]] if reached.size else level[-1]),
                 xlabel=f"absolute error{unit_words(unit)}")
    for axis in axes[::2]:
        axis.set_ylabel("readings [%]")
    theme.legend_on_top(figure, (("before", theme.BEFORE), ("after", theme.AFTER)))
    yield picture(figure, "How large the errors are",
                  f"Cumulative distributions of absolute errors, after: {listed(said)}.",
                  "Share of the readings whose error is at most that; of the first meter."
                  + (" Dotted: the sensor's accuracy." if np.isfinite(study.number("accuracy")) else ""))


def half_below(shares, level):
    """Where the distribution reaches a half."""
    reached = np.flatnonzero(shares >= 0.5)
    return f"half below {number(level[reached[0]])}" if reached.size else f"fewer than half below {number(level[-1])}"


def share_table(study):
    rows, units = [], []
    for name, group in comparisons(study):
        half, own = (study.numbers(join(group, f"share_within_{leaf}")) for leaf in ("half", "accuracy"))
        units += study.texts(join(group, "meter_unit"))
        for m, meter in enumerate(study.texts(join(group, "meter"))):
            if half.ndim == own.ndim == 2 and m < half.shape[1]:
                rows.append([name, meter, *(fixed(100 * within[version, m], 0) for within in (half, own)
                                            for version in (BEFORE, AFTER))])
    unit = unit_said(units[0].replace("degC", "K")) if len(set(units)) == 1 else "of the unit"
    accuracy = study.number("accuracy")
    own_words = f"{number(accuracy)} {unit} (accuracy)" if np.isfinite(accuracy) else "the accuracy"
    if rows:
        yield Table("Readings within an error [%]", [
            ("stage or validation", False), ("meter", False), (f"0.5 {unit}: before", True), ("after", True),
            (f"{own_words}: before", True), ("after", True)], rows)
