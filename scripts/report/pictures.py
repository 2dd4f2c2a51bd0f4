"""The pictures of a loop: each gives its SVG, what it shows in words, and its caption."""
import numpy as np

from report import theme
from report.picture import bare_unit, picture, short, unit_words
from report.regression import HOURS_OF_WEEK, hour_of_week
from report.result import AFTER, BEFORE, PLAIN
from report.words import fixed, number, percent

LAGS, LEAST_SHARE = 200, 0.9
DAY = 86400                    # [s]
SEASONS = ("winter", "spring", "summer", "autumn")     # from December on
DAYS = ["Mo", "Tu", "We", "Th", "Fr", "Sa", "Su"]
CLASSES_OF_DAYS = ("working days", "Saturdays", "Sundays, holidays")
YEAR = 365.25 * 86400          # [s]
MODELS = {PLAIN: ("plain", theme.PLAIN), BEFORE: ("before", theme.BEFORE),
          AFTER: ("after", theme.AFTER)}
MONTHS = "JFMAMJJASOND"


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
    theme.legend_above(axis)
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
    theme.legend_above(axis)
    return picture(figure, "Autocorrelation",
                   f"Autocorrelation of the residual of {channel} at 1 to {LAGS} hours; at 24 "
                   f"hours it is {fixed(at_a_day[0], 2)} before and {fixed(at_a_day[1], 2)} after.",
                   "How far a residual goes on. Grey: where chance alone would leave it.")


def weeks_of(series, steps=HOURS_OF_WEEK):
    """Weeks that begin on a Monday, have all of their steps and are nearly all measured, as slices."""
    monday = ((series.time // DAY + 3) % 7 == 0) & (series.time % DAY == 0)
    return [slice(k, k + steps) for k in np.flatnonzero(monday) if k + steps <= series.time.size and
            np.isfinite(series.measured[k:k + steps]).mean() >= LEAST_SHARE and
            series.time[k + steps - 1] - series.time[k] < 7 * DAY]


def rmse(residual):
    return np.sqrt(np.nanmean(residual**2))


def good_and_bad(series, is_temperature):
    """Among weeks in which as much happens as in a middling one: the smallest and the largest
    error after (relative to the mean where it is no temperature)."""
    parts = weeks_of(series)
    if len(parts) < 2:
        return []
    means = np.array([1.0 if is_temperature else np.nanmean(np.abs(series.measured[part]))
                      for part in parts])
    errors = np.array([rmse(series.residual(AFTER)[part]) for part in parts])
    busy = np.flatnonzero((means >= np.median(means)) & (means > 0))
    if busy.size < 2:
        return []
    order = busy[np.argsort(errors[busy] / means[busy])]
    return [("good", parts[order[0]]), ("bad", parts[order[-1]])]


def name_days(axis):
    axis.set_xticks(np.arange(7) + 0.5, DAYS)
    axis.set_xticks(range(8), minor=True)
    axis.tick_params(axis="x", which="major", length=0)
    axis.grid(False, axis="x")
    axis.grid(True, axis="x", which="minor")


def season_and_hour(time):
    """The place of each hour among four seasons times the hours of a week, from winter's Monday on."""
    month = time.astype("datetime64[s]").astype("datetime64[M]").astype(int) % 12
    return ((month + 1) % 12 // 3 * HOURS_OF_WEEK + hour_of_week(time, "none")).astype(int)


def typical_weeks(series, channel, unit):
    """The mean week of each season, of hours with a reading."""
    places, there = season_and_hour(series.time), np.isfinite(series.measured)
    n = HOURS_OF_WEEK * len(SEASONS)
    means = {name: means_of(np.where(there, values, np.nan), places, n).reshape(len(SEASONS), -1)
             for name, values in (("measured", series.measured),
                                  *((MODELS[m][0], series.simulated[m]) for m in (BEFORE, AFTER)))}
    colours = {"measured": theme.INK, **{MODELS[m][0]: MODELS[m][1] for m in (BEFORE, AFTER)}}
    shown = [s for s in range(len(SEASONS)) if np.isfinite(means["measured"][s]).mean() >= LEAST_SHARE]
    if not shown:
        return None
    figure, axes = theme.figure(0.5 + 1.05 * len(shown), nrows=len(shown), sharex=True, sharey=True,
                                squeeze=False)
    for axis, s in zip(axes[:, 0], shown):
        for name, values in means.items():
            axis.plot(np.arange(HOURS_OF_WEEK) / 24, values[s], color=colours[name], label=name,
                      linewidth=1.5 if name == "measured" else 1.1)
        axis.set(ylabel=SEASONS[s], xlim=(0, 7))
        name_days(axis)
    axes[0, 0].legend(loc="lower left", bbox_to_anchor=(0, 1), borderaxespad=0.2, ncols=3)
    said = "; ".join(f"{SEASONS[s]} {number(rmse(means['before'][s] - means['measured'][s]))} {unit} before, "
                     f"{number(rmse(means['after'][s] - means['measured'][s]))} {unit} after" for s in shown)
    return picture(figure, "A typical week of each season",
                   f"Mean week of {channel} in each season, measured and simulated; RMSE of the means: {said}.",
                   f"Mean of each hour of the week [{unit}], of hours with a reading; winter from December on.")


def points_of(function):
    """Its points' at, and_at, value, least and most, as arrays."""
    return [np.array([getattr(point, name) for point in function.points])
            for name in ("at", "and_at", "value", "least", "most")]


def steps_of_hours(values):
    """24 values as a line of steps."""
    return np.repeat(np.arange(25), 2)[1:-1], np.repeat(values, 2)


def by_hour(axis, points):
    at, _, value, least, most = points
    for c, (name, colour) in enumerate(zip(CLASSES_OF_DAYS, (theme.AFTER, theme.BEFORE, theme.PLAIN))):
        own = at // 24 == c
        if own.sum() != 24:
            continue
        hours, middle = steps_of_hours(value[own])
        axis.fill_between(hours, steps_of_hours(least[own])[1], steps_of_hours(most[own])[1], color=colour,
                          alpha=0.18, linewidth=0)
        axis.plot(hours, middle, color=colour, label=name)
    axis.set(xlabel="hour of the day", xticks=range(0, 25, 6), xlim=(0, 24))
    axis.legend(loc="lower left", bbox_to_anchor=(0, 1), borderaxespad=0.2, ncols=3, columnspacing=0.9,
                handlelength=1, handletextpad=0.4)


def along(axis, points, place, label):
    """A line with its band; at `place` of each point."""
    _, _, value, least, most = points
    axis.fill_between(place, least, most, color=theme.AFTER, alpha=0.18, linewidth=0)
    axis.plot(place, value, color=theme.AFTER)
    axis.set(xlabel=label)


def of_time(axis, points, begin):
    dates = (begin + points[0] * YEAR).astype("datetime64[s]")
    along(axis, points, dates, "")
    axis.set_xticks(*thinned(dates, 5))


def thinned(dates, n):
    shown = dates[np.linspace(0, dates.size - 1, min(n, dates.size)).astype(int)]
    return shown, [str(date.astype("datetime64[D]"))[:7] for date in shown]


def by_hour_and_more(figure, axes, points, function):
    at, more, value, *_ = points
    knots = np.unique(more)
    cells = value.reshape(-1, knots.size)
    most = max(np.abs(cells).max(), 1e-12)
    for axis, first, title in zip(axes, (0, 24), ("working days", "Saturdays, Sundays, holidays")):
        image = axis.pcolormesh(np.arange(24) + 0.5, knots, cells[first:first + 24].T, cmap=theme.diverging(),
                                vmin=-most, vmax=most, shading="nearest", rasterized=True)
        axis.set(title=title, xlabel="hour of the day", xticks=range(0, 25, 6))
        axis.grid(False)
    axes[0].set_ylabel(unit_words(function.driver_unit).strip())
    bar = figure.colorbar(image, ax=list(axes), shrink=0.9, aspect=30)
    bar.set_label(unit_words(function.unit).strip())
    bar.outline.set_visible(False)


def function(one, begin):
    """A function without a name over what it follows; None where that is nothing."""
    if not one.points:
        return None
    points = points_of(one)
    _, more, value, least, most = points
    is_map = np.isfinite(more).all()
    figure, axes = theme.figure(2.5, ncols=2, sharey=True) if is_map else theme.figure(2.4)
    if is_map:
        by_hour_and_more(figure, axes, points, one)
    elif one.driver.startswith("hour of the week"):
        by_hour(axes, points)
    elif one.driver == "time":
        of_time(axes, points, begin)
    else:
        along(axes, points, points[0], one.driver + unit_words(one.driver_unit))
    if not is_map:
        axes.axhline(0, color=theme.SOFT, linewidth=0.8)
        axes.set_ylabel(unit_words(one.unit).strip())
    k = int(np.argmax(np.abs(value)))
    return picture(figure, one.name[0].upper() + one.name[1:],
                   f"{one.name}: from {number(value.min())} to {number(value.max())} {bare_unit(one.unit)}".rstrip() +
                   "; where it is "
                   f"largest, {number(value[k])}, its 90 % interval is {number(least[k])} to {number(most[k])}.",
                   "What it brings more (orange) or less (blue) than the description." if is_map else
                   "Line: what it brings beyond the description; band: 90 % interval.")


def drawn(all_functions, begin):
    """\param begin  [s] of training"""
    return [one for one in (function(each, begin) for each in all_functions) if one]


def functions(loop):
    begin = min((series.time[0] for series in loop.all_series[loop.periods[0]].values()), default=0)
    return drawn(loop.functions, begin)


def week(series, channel, unit, kind, part):
    hours = np.arange(HOURS_OF_WEEK) / 24
    figure, axis = theme.figure(2.7)
    axis.plot(hours, series.measured[part], color=theme.INK, label="measured", linewidth=1.6)
    for model in (BEFORE, AFTER):
        name, colour = MODELS[model]
        axis.plot(hours, series.simulated[model][part], color=colour, label=name, linewidth=1.1)
    if series.band.size:
        axis.fill_between(hours, *series.band[:, part], color=MODELS[AFTER][1], alpha=0.18, linewidth=0,
                          label="90 %")
    axis.set(ylabel=f"{channel} [{unit}]", xlim=(0, 7))
    name_days(axis)
    axis.legend(loc="lower left", bbox_to_anchor=(0, 1), borderaxespad=0.2, ncols=4)
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
    theme.legend_above(axis)
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
    drawn = [typical_weeks(series, channel, unit), residual_map(series, channel, unit.replace("°C", "K")),
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
    axis.set_yticks(range(len(shown)), [short(loop.parameters[p]) for p in shown])
    axis.set(xlabel="from its mean [prior sd]",
             ylim=(len(shown) - 0.5, -0.5))
    axis.grid(False, axis="y")
    axis.legend(loc="lower right", bbox_to_anchor=(1, 1), borderaxespad=0.2, ncols=3)
    words = "; ".join(f"{loop.parameters[p]} {fixed(said[0][k], 1)} before, "
                      f"{fixed(said[1][k], 1)} after" for k, p in enumerate(shown))
    return picture(figure, "Parameters",
                   f"Parameters in standard deviations of their priors: {words}.",
                   "Calibrated values with 90 % intervals against their priors. Where before and "
                   "after lie apart, the parameter may have taken over the effect that was missing.")


def patterns(loop):
    """Hook x driver maps before and after, of the hooks and drivers with the strongest patterns."""
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
                   f"Patterns of the residual by place and driver: {counts[0]} before, {counts[1]} after; the "
                   f"strongest before is {loop.hooks[h]} by {loop.drivers[d]}, "
                   f"{fixed(maps[0][h, d], 1)}.",
                   "How much of a pattern the residual, seen from each place of the model, has over what may "
                   "drive it. 1 is what chance exceeds in one of 100; numbers stand above 1."
                   + others)
