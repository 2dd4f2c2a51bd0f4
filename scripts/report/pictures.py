"""The pictures of a loop: each gives its SVG, what it shows in words, and its caption."""
from dataclasses import dataclass

import numpy as np

from report import theme
from report.result import AFTER, BEFORE, HOURLY, PLAIN
from report.words import fixed, number, percent

HOURS_OF_WEEK, LAGS, LEAST_SHARE = 168, 200, 0.9
MODELS = {PLAIN: ("plain", theme.PLAIN), BEFORE: ("before", theme.BEFORE),
          AFTER: ("after", theme.AFTER)}
MONTHS = "JFMAMJJASOND"


@dataclass
class Picture:
    uri: str
    alt: str
    caption: str
    title: str


def picture(figure, title, alt, caption):
    return Picture(theme.data_uri(figure), alt, caption, title)


def means_of(values, groups, n):
    """Mean of the values in each of n groups; NaN where there is none."""
    there = np.isfinite(values)
    counts = np.bincount(groups[there], minlength=n)
    sums = np.bincount(groups[there], values[there], minlength=n)
    return np.where(counts > 0, sums / np.maximum(counts, 1), np.nan)


def hour_and_month(series, model):
    """Mean residual [24 x 12]."""
    month = series.time.astype("datetime64[s]").astype("datetime64[M]").astype(int) % 12
    hour = (series.time // 3600 % 24).astype(int)
    return means_of(series.residual(model), hour * 12 + month, 24 * 12).reshape(24, 12)


def worst_cell(cells, unit):
    """"12 kWh too low at 9 h in month 1"."""
    hour, month = np.unravel_index(np.nanargmax(np.abs(cells)), cells.shape)
    side = "low" if cells[hour, month] < 0 else "high"
    return f"{number(abs(cells[hour, month]))} {unit} too {side} at {hour} h in month {month + 1}"


def residual_map(series, channel, unit):
    cells = [hour_and_month(series, model) for model in (BEFORE, AFTER)]
    most = max(np.nanquantile(np.abs(cells[0]), 0.98), 1e-9)
    figure, axes = theme.figure(2.9, ncols=2, sharey=True)
    for axis, values, model in zip(axes, cells, (BEFORE, AFTER)):
        image = axis.imshow(values, cmap=theme.diverging(), vmin=-most, vmax=most, aspect="auto",
                            origin="lower", extent=(0.5, 12.5, 0, 24), interpolation="nearest")
        axis.set(title=MODELS[model][0], yticks=range(0, 25, 6))
        axis.set_xticks(range(1, 13), MONTHS)
        axis.grid(False)
    axes[0].set_ylabel("hour of the day")
    bar = figure.colorbar(image, ax=axes, shrink=0.9, aspect=30)
    bar.set_label(f"simulated − measured [{unit}]")
    bar.outline.set_visible(False)
    return picture(figure, "By hour and month",
                   f"Mean residual of {channel} by hour and month. Before: at most "
                   f"{worst_cell(cells[0], unit)}. After: {worst_cell(cells[1], unit)}.",
                   "Mean residual. Orange: the model is too high; blue: too low; no colour: right, "
                   "or not measured.")


def bands(outdoor, residual, edges):
    """Mean and the central 80 % of the residual in each bin of the outdoor temperature."""
    rows = []
    for low, high in zip(edges, edges[1:]):
        inside = residual[(outdoor >= low) & (outdoor < high) & np.isfinite(residual)]
        if inside.size >= 20:
            rows.append([(low + high) / 2, inside.mean(), *np.quantile(inside, [0.1, 0.9])])
    return np.array(rows).reshape(-1, 4).T


def over_temperature(series, channel, unit):
    if series.outdoor.size != series.time.size:
        return None
    edges = np.arange(np.floor(np.nanmin(series.outdoor)), np.nanmax(series.outdoor) + 2, 2)
    figure, axis = theme.figure(2.7)
    spans = []
    for model in (BEFORE, AFTER):
        name, colour = MODELS[model]
        middle, mean, low, high = bands(series.outdoor, series.residual(model), edges)
        axis.fill_between(middle, low, high, color=colour, alpha=0.18, linewidth=0)
        axis.plot(middle, mean, color=colour, label=name)
        spans.append(np.ptp(mean) if mean.size else np.nan)
    axis.axhline(0, color=theme.SOFT, linewidth=0.8)
    axis.set(xlabel="outdoor temperature [°C]", ylabel=f"residual [{unit}]")
    axis.legend(loc="best", ncols=2)
    return picture(figure, "Against outdoor temperature",
                   f"Mean residual of {channel} over outdoor temperature: it spans "
                   f"{number(spans[0])} {unit} before and {number(spans[1])} {unit} after.",
                   "Line: mean in 2 K of outdoor temperature; band: the central 80 % of hours.")


def autocorrelation(residual, lags):
    """Over pairs that are both there."""
    values = residual - np.nanmean(residual)
    there = np.isfinite(values)
    filled = np.where(there, values, 0)
    variance = (filled**2).sum() / max(there.sum(), 1)
    sums = np.array([filled[lag:] @ filled[:-lag] for lag in lags])
    pairs = np.array([(there[lag:] & there[:-lag]).sum() for lag in lags])
    return sums / np.maximum(pairs, 1) / max(variance, 1e-300)


def memory(series, channel):
    lags = np.arange(1, LAGS + 1)
    figure, axis = theme.figure(2.7)
    at_a_day = []
    for model in (BEFORE, AFTER):
        name, colour = MODELS[model]
        values = autocorrelation(series.residual(model), lags)
        axis.plot(lags, values, color=colour, label=name)
        at_a_day.append(values[23])
    limit = 2 / np.sqrt(series.n_readings)
    axis.axhspan(-limit, limit, color=theme.SOFT, alpha=0.25, linewidth=0)
    axis.set(xlabel="hours between two residuals", ylabel="correlation",
             xticks=range(0, LAGS + 1, 24), xlim=(0, LAGS))
    axis.legend(loc="upper right", ncols=2)
    return picture(figure, "Autocorrelation",
                   f"Autocorrelation of the residual of {channel} at 1 to {LAGS} hours; at 24 "
                   f"hours it is {fixed(at_a_day[0], 2)} before and {fixed(at_a_day[1], 2)} after.",
                   "How far a residual goes on. Grey: where chance alone would leave it.")


def weeks_of(series):
    """First hours of weeks that begin on a Monday and are nearly all measured."""
    day = (series.time // 86400 + 3) % 7
    starts = np.flatnonzero((day == 0) & (series.time // 3600 % 24 == 0))
    return [k for k in starts if k + HOURS_OF_WEEK <= series.time.size and
            np.isfinite(series.measured[k:k + HOURS_OF_WEEK]).mean() >= LEAST_SHARE]


def rmse(residual):
    return np.sqrt(np.nanmean(residual**2))


def good_and_bad(series, is_temperature):
    """Among weeks in which as much happens as in a middling one: the smallest and the largest
    error after (relative to the mean where it is no temperature)."""
    weeks = weeks_of(series)
    if len(weeks) < 2:
        return []
    parts = [slice(k, k + HOURS_OF_WEEK) for k in weeks]
    means = np.array([1.0 if is_temperature else np.nanmean(np.abs(series.measured[part]))
                      for part in parts])
    errors = np.array([rmse(series.residual(AFTER)[part]) for part in parts])
    busy = np.flatnonzero((means >= np.median(means)) & (means > 0))
    if busy.size < 2:
        return []
    order = busy[np.argsort(errors[busy] / means[busy])]
    return [("good", parts[order[0]]), ("bad", parts[order[-1]])]


def week(series, channel, unit, kind, part):
    hours = np.arange(HOURS_OF_WEEK) / 24
    figure, axis = theme.figure(2.7)
    axis.plot(hours, series.measured[part], color=theme.INK, label="measured", linewidth=1.6)
    for model in (BEFORE, AFTER):
        name, colour = MODELS[model]
        axis.plot(hours, series.simulated[model][part], color=colour, label=name, linewidth=1.1)
    axis.set(ylabel=f"{channel} [{unit}]", xlim=(0, 7))
    axis.set_xticks(np.arange(7) + 0.5, ["Mo", "Tu", "We", "Th", "Fr", "Sa", "Su"])
    axis.set_xticks(range(8), minor=True)
    axis.tick_params(axis="x", which="major", length=0)
    axis.grid(False, axis="x")
    axis.grid(True, axis="x", which="minor")
    axis.legend(loc="lower left", bbox_to_anchor=(0, 1), borderaxespad=0.2, ncols=3)
    errors = [rmse(series.residual(model)[part]) for model in (BEFORE, AFTER)]
    first = series.time[part][0].astype("datetime64[s]").astype("datetime64[D]")
    return picture(figure, f"A {kind} week",
                   f"{channel} in the week from {first}, measured and simulated: RMSE "
                   f"{number(errors[0])} {unit} before, {number(errors[1])} {unit} after.",
                   f"From {first}: the {'smallest' if kind == 'good' else 'largest'} error after, "
                   "among weeks with at least the median load." if unit != "°C" else
                   f"From {first}: the {'smallest' if kind == 'good' else 'largest'} error after.")


def cumulative(series, channel, unit):
    """By the day, missing hours as no error."""
    days = series.time.size // 24
    share = 1 / 24 if unit == "°C" else 1
    of = "K d" if unit == "°C" else unit
    figure, axis = theme.figure(2.7)
    ends = []
    for model, (name, colour) in MODELS.items():
        hours = np.nan_to_num(series.residual(model))[:24 * days] * share
        sums = np.cumsum(hours.reshape(days, 24).sum(axis=1))
        axis.plot(np.arange(days), sums, color=colour, label=name)
        ends.append(sums[-1])
    axis.axhline(0, color=theme.SOFT, linewidth=0.8)
    axis.set(xlabel="days since the period's begin", ylabel=f"sum of residuals [{of}]")
    axis.legend(loc="best", ncols=3)
    return picture(figure, "Cumulative sum",
                   f"Cumulative sum of the residual of {channel}; at the end {number(ends[0])} "
                   f"{of} plain, {number(ends[1])} before, {number(ends[2])} after.",
                   "A slope is a lasting error; a bend is where something changed.")


def of_channel(loop, c):
    """All pictures of a channel; none where it is not read by the hour."""
    channel, unit = loop.channels[c], loop.of_channels[c].unit.replace("degC", "°C")
    series = loop.series[channel]
    if not series.is_drawn:
        return []
    drawn = [residual_map(series, channel, unit.replace("°C", "K")),
             over_temperature(series, channel, unit.replace("°C", "K")), memory(series, channel)]
    drawn += [week(series, channel, unit, kind, part)
              for kind, part in good_and_bad(series, unit == "°C")]
    return [one for one in drawn + [cumulative(series, channel, unit)] if one]


def errors(loop):
    """Plain, before and after of every channel, relative to plain."""
    rows = [row for row in loop.judged_errors() if row.error[PLAIN] > 0]
    if not rows:
        return None
    figure, axis = theme.figure(0.75 + 0.36 * len(rows))
    for y, row in enumerate(rows):
        shares = 100 * row.error / row.error[PLAIN]
        axis.plot(shares, [y] * 3, color=theme.GRID, linewidth=3, zorder=1)
        for model, (name, colour) in MODELS.items():
            axis.scatter(shares[model], y, s=40, color=colour, label=name if y == 0 else None)
    axis.set_yticks(range(len(rows)), [row.channel for row in rows])
    axis.set(xlabel="error, plain = 100 %", ylim=(len(rows) - 0.5, -0.5))
    axis.set_xlim(left=0)
    axis.grid(False, axis="y")
    axis.legend(loc="lower right", bbox_to_anchor=(1, 1), borderaxespad=0.2, ncols=3,
                handletextpad=0.1, columnspacing=1)
    said = "; ".join(f"{row.channel} {percent(row.error[BEFORE] / row.error[PLAIN])} before, "
                     f"{percent(row.error[AFTER] / row.error[PLAIN])} after" for row in rows)
    return picture(figure, "Errors",
                   f"Error of each channel relative to the plain model's: {said}.",
                   f"Error in {loop.judged} relative to the plain model's: with the structure "
                   "chosen (before), with the effects found (after).")


def parameters(loop):
    """In standard deviations of each prior from its mean."""
    means, sds = (np.array([getattr(parameter, field) for parameter in loop.of_parameters])
                  for field in ("mean", "sd"))
    shown = [p for p in range(len(loop.parameters)) if np.isfinite(means[p]) and sds[p] > 0]
    if not shown:
        return None
    figure, axis = theme.figure(0.8 + 0.3 * len(shown))
    axis.axvspan(-1.645, 1.645, color=theme.SOFT, alpha=0.15, linewidth=0, label="prior, 90 %")
    axis.axvline(0, color=theme.SOFT, linewidth=0.8)
    said = []
    for model, shift in ((BEFORE, -0.16), (AFTER, 0.16)):
        name, colour = MODELS[model]
        middle = (loop.numbers["parameter_value"][model][shown] - means[shown]) / sds[shown]
        half = np.nan_to_num(1.645 * loop.numbers["parameter_sd"][model][shown] / sds[shown])
        axis.errorbar(middle, np.arange(len(shown)) + shift, xerr=half, fmt="o", markersize=4,
                      color=colour, label=name, elinewidth=1.6)
        said.append(middle)
    axis.set_yticks(range(len(shown)), [loop.parameters[p] for p in shown])
    axis.set(xlabel="from the prior's mean [prior sd]",
             ylim=(len(shown) - 0.5, -0.5))
    axis.grid(False, axis="y")
    axis.legend(loc="lower right", bbox_to_anchor=(1, 1), borderaxespad=0.2, ncols=3)
    words = "; ".join(f"{loop.parameters[p]} {fixed(said[0][k], 1)} before, "
                      f"{fixed(said[1][k], 1)} after" for k, p in enumerate(shown))
    return picture(figure, "Parameters",
                   f"Parameters in standard deviations of their priors: {words}.",
                   "Calibrated values with 90 % intervals against their priors. Where before and "
                   "after lie apart, the parameter had taken over the effect that was missing.")


def alarms(loop):
    """Hook x driver maps before and after, of the hooks and drivers that raise an alarm."""
    maps = [loop.numbers["localisation"], loop.numbers["localisation_after"]]
    if maps[0].ndim != 2 or maps[0].shape != maps[1].shape or not maps[0].size:
        return None
    most = np.nan_to_num(np.fmax(*maps))
    hooks = np.sort(np.argsort(-most.max(axis=1), kind="stable")[:10])
    drivers = np.sort(np.argsort(-most.max(axis=0), kind="stable")[:9])
    figure, axes = theme.figure(1.6 + 0.38 * hooks.size, nrows=2, sharex=True)
    for axis, values, model in zip(axes, maps, (BEFORE, AFTER)):
        cells = values[np.ix_(hooks, drivers)]
        axis.imshow(cells, cmap=theme.rising(), vmin=0.5, vmax=3, aspect="auto",
                    interpolation="nearest")
        for h, d in zip(*np.nonzero(cells > 1)):
            axis.text(d, h, fixed(cells[h, d], 1), ha="center", va="center", fontsize=7)
        axis.set_yticks(range(hooks.size), [loop.hooks[h] for h in hooks])
        axis.set_title(MODELS[model][0])
        axis.grid(False)
    axes[1].set_xticks(range(drivers.size), [loop.drivers[d] for d in drivers],
                       rotation=40, ha="right", rotation_mode="anchor")
    counts = [int((values > 1).sum()) for values in maps]
    others = "" if maps[0].size == hooks.size * drivers.size else " The places and drivers with " \
        "the strongest are shown."
    h, d = np.unravel_index(np.nanargmax(np.nan_to_num(maps[0])), maps[0].shape)
    return picture(figure, "Where the residual comes from",
                   f"Map of alarms by hook and driver: {counts[0]} before, {counts[1]} after; the "
                   f"strongest before is {loop.hooks[h]} by {loop.drivers[d]}, "
                   f"{fixed(maps[0][h, d], 1)}.",
                   "How the residual, seen from each place of the model, fluctuates with what may "
                   "drive it, over its 99 % quantile without effects; numbers: alarms, above 1."
                   + others)
