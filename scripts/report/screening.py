"""Pictures of a screening: each parameter against the error, points beside the readings they have not seen, the
errors of the nominal and the best point, where the best points lie.

ASHRAE Guideline 14's verdict is the result's own.
"""
import numpy as np

from report import theme
from report.picture import and_more, picture, short, unit_words
from report.words import fixed, listed, number, percent, signed

MOST_PANELS, MOST_DOTS = 6, 300        # parameters; points of each verdict in a panel
BINS = 10                              # of a parameter's range, to see how the error follows it
WORST = 0.9                            # worse points lie beyond the picture
METRIC, BIAS = "cv_rmse", "nmbe"
BY = {"hourly": "by the hour", "monthly": "by the month"}
LIMITS = {"hourly": (0.30, 0.10), "monthly": (0.15, 0.05)}    # CV(RMSE) and bias of ASHRAE Guideline 14


def spread(mask, most=MOST_DOTS):
    """At most so many of these points, evenly among them."""
    places = np.flatnonzero(mask)
    return places if places.size <= most else places[np.linspace(0, places.size - 1, most).astype(int)]


def verdicts(study):
    """(words, colour, points) of each verdict on training, the best last; [] where nothing is judged."""
    meets, resolutions = study.numbers("meets_guideline_14"), study.texts("resolution")
    if meets.ndim != 3 or meets.shape[2] != len(resolutions):
        return []
    by = {name: meets[:, 0, r] > 0 for r, name in enumerate(resolutions)}
    nothing = np.zeros(meets.shape[0], bool)
    hourly, monthly = by.get("hourly", nothing), by.get("monthly", nothing)
    return [("beyond Guideline 14", theme.PLAIN, ~(hourly | monthly)),
            ("by the month within", theme.GREEN, monthly & ~hourly), ("by the hour within", theme.AFTER, hourly)]


def errors_of(study):
    """Root mean square over the meters of their CV(RMSE) in training [%]."""
    return 100 * np.sqrt(study.numbers("score") / max(len(study.texts("meter")), 1))


def followed(x, error):
    """How much of the error's variance its mean in bins of a parameter has."""
    there = np.isfinite(error) & np.isfinite(x)
    if there.sum() < 2 * BINS or np.ptp(x[there]) == 0:
        return 0.0
    x, error = x[there], error[there]
    bins = np.minimum((BINS * (x - x.min()) / np.ptp(x)).astype(int), BINS - 1)
    means = np.array([error[bins == b].mean() if (bins == b).any() else np.nan for b in range(BINS)])
    return float(np.var(means[bins]) / max(np.var(error), 1e-300))


def all_verdicts(study, n):
    return verdicts(study) or [("points", theme.AFTER, np.ones(n, bool))]


def parameters(study):
    """The parameters that the error follows most, each against it."""
    points, error, names = study.numbers("points"), errors_of(study), study.texts("parameter")
    units = dict(zip(names, study.texts("parameter_unit")))
    there = np.isfinite(error)
    if points.ndim != 2 or not there.any():
        return
    top = np.quantile(error[there], WORST)
    shares = np.array([followed(points[:, p], np.minimum(error, top)) for p in range(len(names))])
    shown = np.argsort(-shares, kind="stable")[:MOST_PANELS]
    figure, axes = theme.panels(len(shown), 2, 1.75, sharey=True)
    groups = all_verdicts(study, error.size)
    for axis, p in zip(axes, shown):
        for words, colour, which in groups:
            some = spread(which & there & (error <= top))
            theme.dots(axis, points[some, p], error[some], colour)
        axis.set_xlabel(f"{short(names[p])}{unit_words(units.get(names[p], ''))}")
        axis.locator_params(axis="x", nbins=4)
        theme.compact(axis)
    for axis in axes[::2]:
        axis.set_ylabel("error [%]")
    theme.legend_on_top(figure, [(words, colour) for words, colour, _ in groups], "o")
    counts = ", ".join(f"{words} {int(which.sum())}" for words, _, which in groups)
    yield picture(figure, "Parameters against the error",
                  f"Error of the points over each of {len(shown)} parameters. Points {counts}. The error follows "
                  f"{listed(f'{names[p]} ({percent(shares[p])} of its variance)' for p in shown[:3])} most.",
                  f"Error: root mean square of the meters' CV(RMSE) in training. At most {MOST_DOTS} points of each "
                  f"colour; the worst tenth is left out." + sample_words(study)
                  + and_more(len(names), len(shown), "parameters"))


def best_errors(study, m):
    """Of the best point in the first two periods [%]; it need not be in a sample of very many points."""
    best = study.numbers("best_cv_rmse")
    return 100 * best[0, :2, m] if best.ndim == 3 and best.shape[1] > 1 and len(best) else np.full(2, np.nan)


def sample_words(study):
    """Where not all points were read."""
    n, shown = study.number("n_points"), len(study.numbers("points"))
    return f" Of {number(n, 7)} points {shown} were read, evenly." if n > shown > 0 else ""


def held_out(study):
    """Each point's error in training and in the period after it."""
    errors, meters, periods = study.numbers("cv_rmse"), study.texts("meter"), study.texts("period")
    if errors.ndim != 3 or len(periods) < 2:
        return
    for m, meter in enumerate(meters):
        first, second = 100 * errors[:, 0, m], 100 * errors[:, 1, m]
        there = np.isfinite(first) & np.isfinite(second)
        if there.sum() < BINS:
            continue
        top = [np.quantile(values[there], WORST) for values in (first, second)]
        inside = there & (first <= top[0]) & (second <= top[1])
        figure, axis = theme.figure(2.7)
        for words, colour, which in all_verdicts(study, first.size):
            some = spread(which & inside)
            theme.dots(axis, first[some], second[some], colour, label=words)
        ends = [min(first[inside].min(), second[inside].min()), max(top)]
        axis.plot(ends, ends, color=theme.SOFT, linewidth=0.8, linestyle=":")
        best = best_errors(study, m)
        axis.plot(*best, "D", color=theme.BEFORE, markersize=5, label="best point")
        axis.set(xlabel=f"CV(RMSE) in {periods[0]} [%]", ylabel=f"in {periods[1]} [%]")
        theme.legend_above(axis)
        yield picture(figure, f"{meter}: {periods[0]} and {periods[1]}",
                      f"CV(RMSE) of each point for {meter} in {periods[0]} against {periods[1]}: correlation "
                      f"{fixed(np.corrcoef(first[inside], second[inside])[0, 1], 2)}; the best point has "
                      f"{fixed(best[0], 1)} and {fixed(best[1], 1)} %.",
                      "Dotted: the same error in both. The worst tenths are left out.")


def candidates(study):
    """Nominal and best of every meter and period, at the meter's interval and by the month."""
    metrics, meters, periods = study.texts("metric"), study.texts("meter"), study.texts("period")
    if METRIC not in metrics:
        return
    for name, words in (("fit", "at the meter's interval"), ("monthly_fit", "by the month")):
        fit = study.numbers(name)
        if fit.ndim != 4:
            continue
        errors = 100 * fit[..., metrics.index(METRIC)]
        biases = 100 * fit[1, ..., metrics.index(BIAS)] if BIAS in metrics else np.full(errors.shape[1:], np.nan)
        rows = [(p, m) for m in range(len(meters)) for p in range(len(periods)) if np.isfinite(errors[:, p, m]).all()]
        if rows:
            yield of_candidates(study, errors, biases, rows, words)


def guideline_words(study):
    """What ASHRAE Guideline 14 asks for, and how many points give that."""
    asked = " and ".join(f"at most {percent(error)} {BY[resolution]} with a bias (NMBE) within {percent(bias)}"
                         for resolution, (error, bias) in LIMITS.items())
    counts, periods = study.numbers("guideline_14_count"), study.texts("period")
    resolutions = study.texts("resolution")
    met = "" if counts.shape != (len(periods), len(resolutions)) else " Of the points " + listed(
        f"{number(counts[p, r], 7)} meet{'s' if counts[p, r] == 1 else ''} that {BY[resolution]} in {period}"
        for p, period in enumerate(periods) for r, resolution in enumerate(resolutions) if resolution in BY) + "."
    return f"Guideline 14 asks every meter for {asked}, counted with n − 1.{met}"


def of_candidates(study, errors, biases, rows, words):
    meters, periods = study.texts("meter"), study.texts("period")
    figure, axis = theme.figure(0.85 + 0.3 * len(rows))
    for y, (p, m) in enumerate(rows):
        axis.plot(errors[:, p, m], [y, y], color=theme.GRID, linewidth=3, zorder=1)
        for k, (label, colour) in enumerate((("as described", theme.BEFORE), ("best point", theme.AFTER))):
            axis.scatter(errors[k, p, m], y, s=36, color=colour, label=label if y == 0 else None)
    axis.set_yticks(range(len(rows)), [short(f"{meters[m]}, {periods[p]}") for p, m in rows])
    axis.set(xlabel="CV(RMSE) [%]", ylim=(len(rows) - 0.5, -0.5))
    axis.set_xlim(left=0)
    axis.grid(False, axis="y")
    theme.legend_above(axis)
    said = "; ".join(f"{meters[m]} in {periods[p]} from {fixed(errors[0, p, m], 1)} to {fixed(errors[1, p, m], 1)} %"
                     for p, m in rows)
    bias = listed(f"{meters[m]} in {periods[p]} {signed(biases[p, m], 1)} %" for p, m in rows
                  if np.isfinite(biases[p, m]))
    return picture(figure, f"Errors {words}", f"CV(RMSE) {words}, as described and of the best point: {said}.",
                   f"CV(RMSE) {words}." + (f" The best point's bias (NMBE): {bias}." if bias else "") +
                   f" {guideline_words(study)}")


def in_range(study, values):
    """As a share of each parameter's range."""
    least, most = study.numbers("parameter_least"), study.numbers("parameter_most")
    with np.errstate(invalid="ignore", divide="ignore"):
        return (values - least) / (most - least)


def best_points(study):
    """Where in the ranges the best points lie."""
    values, names = in_range(study, study.numbers("best_parameters")), study.texts("parameter")
    yield over_ranges(study, values, names, study.numbers("best_parameters"),
                      f"the {len(values)} best points", "Where the best points lie")


def over_ranges(study, shares, names, values, what, title, first="best point"):
    """Dots of points over the parameters' ranges; the first is marked."""
    figure, axis = theme.figure(0.85 + 0.24 * len(names))
    for p in range(len(names)):
        axis.plot([0, 1], [p, p], color=theme.GRID, linewidth=3, zorder=1, solid_capstyle="round")
    rows = np.broadcast_to(np.arange(len(names)), shares.shape)
    theme.dots(axis, shares.ravel(), rows.ravel(), theme.AFTER, size=4, alpha=0.45)
    if first:
        axis.scatter(shares[0], np.arange(len(names)), s=32, marker="D", color=theme.BEFORE, label=first, zorder=3)
        theme.legend_above(axis)
    axis.set_yticks(range(len(names)), [short(name) for name in names])
    axis.set(xlabel="from the lower to the upper end of the range", ylim=(len(names) - 0.4, -0.6),
             xlim=(-0.03, 1.03))
    axis.set_xticks([0, 0.5, 1], ["least", "middle", "most"])
    axis.grid(False, axis="y")
    wide = np.nanmax(shares, axis=0) - np.nanmin(shares, axis=0)
    narrow = np.argsort(wide, kind="stable")[:3]
    said = listed(f"{names[p]} ({number(np.nanmin(values[:, p]))} to {number(np.nanmax(values[:, p]))})"
                  for p in narrow)
    return picture(figure, title, f"Values of {what} in the ranges of the parameters; they agree most on {said}.",
                   "Each line is a parameter's range" + (
                       f", each dot one of {what}. Where dots lie all over a line, the readings do not tell that "
                       "parameter." if len(shares) > 1 else "."))
