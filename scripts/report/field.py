"""Pictures of a calibration after Kennedy and O'Hagan: the true process beside measurements, and what the simulator
lacks.

Source: Kennedy and O'Hagan 2001, Journal of the Royal Statistical Society B 63. The discrepancy is drawn where the
runs were made at the field points: the process less the runs of the designs that come nearest to the posterior.
"""
import numpy as np

from report import theme
from report.picture import picture, unit_words
from report.words import fixed, number, percent

MOST_INPUTS, MOST_RUNS = 3, 40


def unit(study):
    said = study.units.get("field_measured", "")
    return "" if said.startswith("of ") else said


def predictions(study):
    """Measured against the process, with its 90 % interval and that of a measurement."""
    measured, mean = study.numbers("field_measured"), study.numbers("process_mean")
    figure, axis = theme.figure(3.0)
    for leaf, colour, width, label in (("measurement", theme.PLAIN, 1.0, "90 % of a measurement"),
                                       ("process", theme.AFTER, 2.2, "90 % of the process")):
        low, high = study.numbers(f"{leaf}_q05"), study.numbers(f"{leaf}_q95")
        if low.shape == high.shape == measured.shape:
            axis.vlines(measured, low, high, color=colour, linewidth=width, alpha=0.6, label=label)
    axis.plot(measured, mean, "o", color=theme.AFTER, markersize=3.5, label="mean")
    ends = [min(np.nanmin(measured), np.nanmin(mean)), max(np.nanmax(measured), np.nanmax(mean))]
    axis.plot(ends, ends, color=theme.SOFT, linewidth=0.8, linestyle=":")
    axis.set(xlabel=f"measured{unit_words(unit(study))}", ylabel=f"predicted{unit_words(unit(study))}")
    theme.legend_above(axis)
    inside = study.numbers("measurement_coverage").ravel()
    held = f"; {percent(inside[1])} of the measurements lie in their 90 % intervals" if inside.size > 1 else ""
    yield picture(figure, "Predictions at the field points",
                  f"Predicted against {measured.size} measured values: CV(RMSE) "
                  f"{percent(study.number('field_cv_rmse'), 1)}, NMBE {percent(study.number('field_nmbe'), 1)}{held}.",
                  "Dotted: predicted as measured. The process is what would be measured without noise.")


def runs_near(study):
    """The runs of the designs, those nearest to the posterior first; none where the job did not make them."""
    runs, values = study.numbers("design_run"), study.numbers("design_values")
    names = study.texts("calibrated_input")
    measured = study.numbers("field_measured")
    if runs.ndim != 2 or runs.shape[1] != measured.size or values.shape != (len(runs), len(names)):
        return np.empty((0, measured.size))
    known = dict(zip(study.texts("unknown"), zip(study.numbers("posterior_mean"), study.numbers("posterior_sd"))))
    distance = np.zeros(len(runs))
    for k, name in enumerate(names):
        mean, sd = known.get(name, (np.nan, np.nan))
        if sd > 0:
            distance += ((values[:, k] - mean) / sd) ** 2
    return runs[np.argsort(distance, kind="stable")]


def along(study):
    """(name, order, values) of the known inputs; the points' numbers where there is none."""
    inputs, names = study.numbers("field_input"), study.texts("known_input")
    n = study.numbers("field_measured").size
    if inputs.ndim != 2 or inputs.shape != (n, len(names)) or not names:
        return [("field point", np.arange(n), np.arange(1.0, n + 1))]
    return [(name, np.argsort(inputs[:, k], kind="stable"), inputs[:, k])
            for k, name in enumerate(names)][:MOST_INPUTS]


def over_inputs(study):
    """Process and measurements over each known input, with the runs of the simulator."""
    measured, mean = study.numbers("field_measured"), study.numbers("process_mean")
    runs = runs_near(study)
    places = along(study)
    figure, axes = theme.panels(len(places), 1, 2.1)
    for axis, (name, order, values) in zip(axes, places):
        x = values[order]
        for k, run in enumerate(runs[:MOST_RUNS]):
            axis.plot(x, run[order], color=theme.PLAIN, linewidth=0.6, alpha=0.6, label="runs" if k == 0 else None)
        axis.vlines(x, study.numbers("process_q05")[order], study.numbers("process_q95")[order], color=theme.AFTER,
                    linewidth=2.2, alpha=0.5)
        axis.plot(x, mean[order], "_", color=theme.AFTER, markersize=7, label="process, 90 %")
        axis.plot(x, measured[order], "o", color=theme.INK, markersize=3, label="measured")
        axis.set(xlabel=name, ylabel=unit_words(unit(study)).strip())
    theme.legend_above(axes[0])
    names = ", ".join(name for name, *_ in places)
    yield picture(figure, "Over the known inputs",
                  f"Process and {measured.size} measurements over {names}; the process goes from "
                  f"{number(np.nanmin(mean))} to {number(np.nanmax(mean))} {unit(study)}.",
                  "Grey: the simulator's runs." if len(runs) else
                  "The simulator's runs are not at these points, and not drawn.")


def discrepancy(study):
    """What the process has more than the nearest run."""
    runs = runs_near(study)
    if not len(runs) or not np.isfinite(runs[0]).any():
        return
    name, order, values = along(study)[0]
    low, high, mean = (study.numbers(f"process_{leaf}") - runs[0] for leaf in ("q05", "q95", "mean"))
    figure, axis = theme.figure(2.4)
    axis.axhline(0, color=theme.SOFT, linewidth=0.8)
    axis.vlines(values[order], low[order], high[order], color=theme.AFTER, linewidth=2.2, alpha=0.5)
    axis.plot(values[order], mean[order], "o", color=theme.AFTER, markersize=3.5)
    axis.set(xlabel=name, ylabel=f"process − run{unit_words(unit(study))}")
    k = int(np.nanargmax(np.abs(mean)))
    yield picture(figure, "What the simulator lacks",
                  f"Discrepancy: the process less the run nearest to the posterior means, over {name}. The largest is "
                  f"{number(mean[k])} {unit(study)} at {number(values[k])}; their mean is {number(np.nanmean(mean))}.",
                  "Process less the run whose inputs are nearest to the posterior's means. Lines: 90 % of the "
                  "process. Off the line at zero: what the simulator gets wrong.")


def errors(study):
    """A sentence of the errors, with n and n - 1."""
    yield f"CV(RMSE) at the field points {percent(study.number('field_cv_rmse'), 1)} " \
          f"({percent(study.number('field_cv_rmse_n1'), 1)} with n − 1), NMBE " \
          f"{fixed(100 * study.number('field_nmbe'), 1)} %."
