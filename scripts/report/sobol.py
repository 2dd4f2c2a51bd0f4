"""Pictures of Sobol indices: bars of a total, and of a quantity by hour and month.

Source: Saltelli et al. 2010, Computer Physics Communications 181. An index of many hours is their mean, weighted by
the variance of each hour, as that of the whole series is.
"""
import numpy as np

from report import theme
from report.picture import and_more, picture, short
from report.pictures import MONTHS
from report.words import fixed, listed

MOST_BARS, MOST_OUTPUTS, MOST_MAPS, MOST_ROWS = 15, 8, 4, 10
SAID = 3                       # parameters that the words name
LEAST_MONTHS = 6               # fewer make no map by month


def order_of(total):
    """Parameters by total order; those without an index last."""
    return np.argsort(-np.nan_to_num(total, nan=-1.0), kind="stable")


def named(names, order, values):
    return listed(f"{names[p]} {fixed(values[p], 2)}" for p in order[:SAID] if np.isfinite(values[p]))


def bars(names, first, total, halves, threshold, what):
    """First and total order of each parameter, the largest on top; halves: of their intervals."""
    order = order_of(total)[:MOST_BARS]
    figure, axis = theme.figure(0.8 + 0.27 * order.size)
    place = np.arange(order.size)
    for values, half, shift, colour, label in ((total, halves[1], -0.19, theme.AFTER, "total order"),
                                               (first, halves[0], 0.19, theme.BEFORE, "first order")):
        axis.barh(place + shift, np.nan_to_num(values[order]), height=0.36, color=colour, label=label)
        if half.shape == values.shape:
            axis.errorbar(values[order], place + shift, xerr=half[order], fmt="none", color=theme.INK, elinewidth=0.8)
    if np.isfinite(threshold):
        axis.axvline(threshold, color=theme.SOFT, linewidth=0.8, linestyle=":")
    axis.set_yticks(place, [short(names[p]) for p in order])
    axis.set(ylim=(order.size - 0.4, -0.6), xlabel="share of the variance")
    axis.set_xlim(left=min(0, axis.get_xlim()[0]))
    axis.grid(False, axis="y")
    theme.legend_above(axis)
    intervals = " Lines: 95 % intervals." if halves[0].size else ""
    noise = " Below 0: scatter of the samples; take it as 0." if (first[order] < -0.005).any() else ""
    dotted = " Dotted: above it a parameter counts as sensitive." if np.isfinite(threshold) else ""
    return picture(figure, what, f"Sobol indices of {what}: largest total order {named(names, order, total)}; first "
                   f"order there {named(names, order, first)}.",
                   f"First order: the parameter alone; total order: with its interactions.{intervals}{dotted}{noise}"
                   + and_more(len(names), order.size, "parameters"))


def half_widths(study, prefix=""):
    return [study.numbers(f"{prefix}{order}_half_width") for order in ("first_order", "total_order")]


def indices(study):
    """Of each output."""
    first, total = study.numbers("first_order"), study.numbers("total_order")
    for k, output in list(enumerate(study.texts("output")))[:MOST_OUTPUTS]:
        if not np.isfinite(total[k]).any():        # all of it failed
            continue
        halves = [half[k] if half.ndim == 2 else half for half in half_widths(study)]
        yield bars(study.texts("parameter"), first[k], total[k], halves, study.number("threshold"), output)


def outputs_map(study):
    """Total order of all outputs at one sight, where there are several."""
    total, outputs, names = study.numbers("total_order"), study.texts("output"), study.texts("parameter")
    if len(outputs) < 2:
        return
    order = order_of(np.nanmax(np.nan_to_num(total), axis=0))[:MOST_BARS]
    figure, axis = theme.figure(1.3 + 0.24 * order.size)
    cells = total[:, order].T
    axis.imshow(cells, cmap=theme.rising(), vmin=0, vmax=1, aspect="auto", interpolation="nearest")
    if len(outputs) <= 10:
        for row, column in zip(*np.nonzero(np.nan_to_num(cells) >= 0.05)):
            axis.text(column, row, fixed(cells[row, column], 2), ha="center", va="center", fontsize=7)
    axis.set_yticks(range(order.size), [short(names[p]) for p in order])
    axis.set_xticks(range(len(outputs)), [short(name) for name in outputs], rotation=30, ha="right",
                    rotation_mode="anchor")
    axis.grid(False)
    said = "; ".join(f"{output}: {named(names, order_of(total[k])[:1], total[k])}" for k, output in enumerate(outputs))
    yield picture(figure, "Total order of all outputs", f"Heat map of total-order indices; the largest of {said}.",
                  "Numbers stand from 0.05 on." + and_more(len(names), order.size, "parameters"))


def series_indices(study):
    """Of a whole series."""
    yield bars(study.texts("parameter"), study.numbers("series_first_order"), study.numbers("series_total_order"),
               half_widths(study, "series_"), np.nan, f"{study.text('quantity')}, whole series")


def weighted(indices_of_steps, variance, groups, n):
    """Mean index in each of n groups of steps, weighted by their variance [n x parameters]; NaN = no variance."""
    weights = np.nan_to_num(variance)[:, None] * np.isfinite(indices_of_steps)
    sums, all_weights = np.zeros((2, n, indices_of_steps.shape[1]))
    np.add.at(sums, groups, np.nan_to_num(indices_of_steps) * weights)
    np.add.at(all_weights, groups, weights)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(all_weights > 0, sums / all_weights, np.nan)


def hours_and_months(study):
    """Hour of the day and month (from 0) of each step."""
    time = study.numbers("time")
    return (time // 3600 % 24).astype(int), time.astype("datetime64[s]").astype("datetime64[M]").astype(int) % 12


def varies(study):
    """Whether the quantity varies in any hour."""
    return np.nanmax(study.numbers("hourly_variance")) > 0


def by_hour(study):
    """Total order of each parameter over the hours of the day."""
    if not varies(study):
        return
    total, variance, names = (study.numbers("hourly_total_order"), study.numbers("hourly_variance"),
                              study.texts("parameter"))
    hour, _ = hours_and_months(study)
    cells = weighted(total, variance, hour, 24)
    order = order_of(np.nanmax(np.nan_to_num(cells), axis=0))[:MOST_ROWS]
    figure, axes = theme.figure(1.6 + 0.24 * order.size, nrows=2, sharex=True,
                                height_ratios=[0.24 * order.size, 0.7])
    axes[0].imshow(cells[:, order].T, cmap=theme.rising(), vmin=0, vmax=1, aspect="auto", interpolation="nearest",
                   extent=(0, 24, order.size - 0.5, -0.5))
    axes[0].set_yticks(range(order.size), [short(names[p]) for p in order])
    axes[0].grid(False)
    steps = np.array([np.nanmean(variance[hour == h]) if (hour == h).any() else np.nan for h in range(24)])
    deviation = np.sqrt(steps / max(np.nanmax(steps), 1e-300))
    axes[1].fill_between(np.repeat(np.arange(25), 2)[1:-1], np.repeat(deviation, 2), color=theme.AFTER, alpha=0.5,
                         linewidth=0)
    axes[1].set(xlabel="hour of the day", xlim=(0, 24), xticks=range(0, 25, 3), ylabel="spread", ylim=(0, 1.05),
                yticks=[0, 1])
    p, h = order[0], int(np.nanargmax(np.nan_to_num(cells[:, order[0]])))
    yield picture(figure, f"{study.text('quantity')} by hour of the day",
                  f"Heat map of total-order indices by hour of the day: the largest is {names[p]} with "
                  f"{fixed(cells[h, p], 2)} at {h} h.",
                  "Colour: total order from 0 to 1, hours of all days weighted by their variance. Below: standard "
                  "deviation over the inputs, of its largest." + and_more(len(names), order.size, "parameters"))


def by_month(study):
    """Total order by hour and month, of the parameters that matter most."""
    if not varies(study):
        return
    total, variance, names = (study.numbers("hourly_total_order"), study.numbers("hourly_variance"),
                              study.texts("parameter"))
    hour, month = hours_and_months(study)
    if np.unique(month).size < LEAST_MONTHS:
        return
    cells = weighted(total, variance, hour * 12 + month, 24 * 12).reshape(24, 12, -1)
    shown = order_of(study.numbers("series_total_order") if study.has("series_total_order")
                     else np.nanmax(np.nan_to_num(cells), axis=(0, 1)))[:MOST_MAPS]
    figure, axes = theme.panels(len(shown), 2, 1.9, sharex=True, sharey=True)
    for axis, p in zip(axes, shown):
        image = axis.imshow(cells[:, :, p], cmap=theme.rising(), vmin=0, vmax=1, aspect="auto", origin="lower",
                            extent=(0.5, 12.5, 0, 24), interpolation="nearest")
        axis.set(title=short(names[p]), yticks=range(0, 25, 6))
        axis.set_xticks(range(1, 13), MONTHS)
        axis.grid(False)
    for axis in axes[::2]:
        axis.set_ylabel("hour of the day")
    bar = figure.colorbar(image, ax=axes, shrink=0.7, aspect=30)
    bar.set_label("total order")
    bar.outline.set_visible(False)
    said = listed(largest(cells[:, :, p], names[p]) for p in shown)
    yield picture(figure, f"{study.text('quantity')} by hour and month",
                  f"Heat maps of total-order indices by hour and month: {said}.",
                  "Steps weighted by their variance; no colour: nothing varies there.")


def largest(cells, name):
    if not np.isfinite(cells).any():
        return f"{name} nowhere"
    hour, month = np.unravel_index(np.nanargmax(cells), cells.shape)
    return f"{name} at most {fixed(cells[hour, month], 2)} at {hour} h in month {month + 1}"
