"""Pictures of a retrofit: what each scenario saves, with intervals, and what it does to comfort."""
import numpy as np

from report import theme
from report.picture import Table, picture, short, unit_words
from report.words import fixed, listed, number, percent

HOURS = "h"                    # unit of what is counted for comfort
SMALL = 1e-9
NOISE = 1e-6                   # of an output: a smaller saving is what rounding leaves
OF_DRAWS = "posterior"
DAY = 86400                    # [s]


def outputs(study, is_comfort):
    """Energies, or hours of comfort, that are above 0 anywhere."""
    units = study.texts("output_unit")
    before = study.numbers("before_quantile")
    after = study.numbers("after_quantile")
    there = [k for k, unit in enumerate(units) if (unit == HOURS) == is_comfort]
    return [k for k in there if max(np.nanmax(np.abs(before[:, k])), np.nanmax(np.abs(after[..., k]))) > SMALL]


def ends_and_middle(study, name):
    """The lowest, the middle and the highest quantile stored [3 x ...]."""
    values = np.moveaxis(study.numbers(name), 1 if study.numbers(name).ndim == 3 else 0, 0)
    return values[[0, len(values) // 2, -1]]


def saved(study):
    """The lowest, the middle and the highest saving [3 x scenario x output]; what rounding leaves is 0."""
    values = ends_and_middle(study, "saving_quantile")
    before, after = (np.nan_to_num(np.abs(study.numbers(f"{name}_quantile"))) for name in ("before", "after"))
    sizes = np.maximum(before.max(axis=0), after.max(axis=(0, 1)))
    return np.where(np.abs(values) <= NOISE * sizes, 0.0, values)


def is_of_draws(study):
    """Draws of a posterior give probabilities; the best points of a screening or grid only a range."""
    return study.kinds.get(study.text("points_of"), OF_DRAWS) == OF_DRAWS


def is_one_point(study):
    """A loop around another program ends at one point, which has no spread."""
    return study.has("points") and len(study.numbers("points")) == 1


def period_words(study):
    """" over 2015-01-01 to 2015-12-31 (365 days)"; "" where a result does not say."""
    ends = study.numbers("simulated_period").ravel() if study.has("simulated_period") else []
    if len(ends) != 2 or not np.isfinite(ends).all():
        return ""
    first, last = (str(np.datetime64(int(end), "s").astype("datetime64[D]")) for end in (ends[0], ends[1] - 1))
    return f" over {first} to {last} ({(ends[1] - ends[0]) / DAY:.0f} days)"


def intervals_words(study):
    if is_one_point(study):
        return "one point, without an interval"
    levels = study.numbers("quantile").ravel()
    what = "quantile" if is_of_draws(study) else "of the best points"
    return f"{fixed(100 * levels[0], 0)} to {fixed(100 * levels[-1], 0)} % {what}" if levels.size else "interval"


def savings(study):
    """Absolute savings of each output, by scenario."""
    scenarios, names, units = (study.texts(name) for name in ("scenario", "output", "output_unit"))
    low, middle, high = saved(study)
    share = ends_and_middle(study, "saving_share_quantile") if study.has("saving_share_quantile") else None
    shown = [k for k in outputs(study, False) if np.nanmax(np.abs(middle[:, k])) > SMALL]
    if not shown:
        return
    figure, axes = theme.panels(len(shown), 1, 0.62 + 0.24 * len(scenarios))
    place = np.arange(len(scenarios))
    for axis, k in zip(axes, shown):
        axis.barh(place, middle[:, k], height=0.55, color=theme.AFTER, alpha=0.35)
        axis.hlines(place, low[:, k], high[:, k], color=theme.AFTER, linewidth=1.6)
        axis.plot(middle[:, k], place, "o", color=theme.AFTER, markersize=4)
        axis.axvline(0, color=theme.SOFT, linewidth=0.8)
        axis.set_yticks(place, [short(name) for name in scenarios])
        axis.set_title(f"{names[k]}{unit_words(units[k])}")
        axis.set_ylim(len(scenarios) - 0.5, -0.5)
        axis.grid(False, axis="y")
        axis.locator_params(axis="x", nbins=5)
        theme.compact(axis)
    said = "; ".join(f"{scenario}: " + listed(
        f"{names[k]} {number(middle[s, k])} ({number(low[s, k])} to {number(high[s, k])}) {units[k]}"
        + (f", {percent(share[1][s, k])}" if share is not None else "") for k in shown)
        for s, scenario in enumerate(scenarios))
    yield picture(figure, "Energy saved", f"Savings of each scenario{period_words(study)}: {said}.",
                  f"Before less after{period_words(study)}, point by point of the study {study.text('points_of')}. "
                  f"Bars: middle; lines: {intervals_words(study)}. Below 0: more than before.")


def before_and_after(study):
    """Energies before, and after each scenario."""
    yield from beside(study, outputs(study, False), "Energy before and after", "energy")


def comfort(study):
    """Hours too cold and too warm."""
    limits = study.numbers("comfort_limit").ravel()
    said = f" Too cold: below {number(limits[0])} °C; too warm: above {number(limits[1])} °C." \
        if limits.size == 2 else ""
    yield from beside(study, outputs(study, True), "Comfort", "hours", said)


def beside(study, shown, title, what, more=""):
    if not shown:
        return
    scenarios, names, units = (study.texts(name) for name in ("scenario", "output", "output_unit"))
    before, after = (ends_and_middle(study, f"{name}_quantile") for name in ("before", "after"))
    figure, axes = theme.panels(len(shown), 1, 0.62 + 0.22 * (len(scenarios) + 1))
    labels = ["before", *scenarios]
    for axis, k in zip(axes, shown):
        rows = np.vstack([before[:, k][None], after[:, :, k].T])       # [label x low, middle, high]
        colours = [theme.BEFORE] + [theme.AFTER] * len(scenarios)
        for y, ((low, middle, high), colour) in enumerate(zip(rows, colours)):
            axis.plot([low, high], [y, y], color=colour, linewidth=1.6)
            axis.plot(middle, y, "o", color=colour, markersize=4.5)
        axis.set_yticks(range(len(labels)), [short(label) for label in labels])
        axis.set(title=f"{names[k]}{unit_words(units[k])}", ylim=(len(labels) - 0.5, -0.5))
        axis.set_xlim(left=0)
        axis.grid(False, axis="y")
        axis.locator_params(axis="x", nbins=5)
        theme.compact(axis)
    over = period_words(study)
    sums = f" Sums{over}." if over else ""
    said = "; ".join(f"{names[k]} {number(before[1, k])} before, " + listed(
        f"{number(after[1, s, k])} with {scenario}" for s, scenario in enumerate(scenarios)) for k in shown)
    yield picture(figure, title, f"{what[:1].upper() + what[1:]} before and after: {said}.",
                  f"Dots: middle; lines: {intervals_words(study)}.{sums}{more}")


def table(study):
    scenarios, names, units = (study.texts(name) for name in ("scenario", "output", "output_unit"))
    low, middle, high = saved(study)
    share = ends_and_middle(study, "saving_share_quantile")[1]
    told = [k for k in outputs(study, False) if np.nanmax(np.abs(middle[:, k])) > 0]
    told += [k for k, unit in enumerate(units) if unit == HOURS]
    rows = [[scenario, names[k], number(middle[s, k], 4), f"{number(low[s, k], 4)} to {number(high[s, k], 4)}",
             units[k], percent(share[s, k], 1)] for s, scenario in enumerate(scenarios) for k in told]
    yield Table("What each scenario saves", [("scenario", False), ("of", False), ("saving", True),
                                             (intervals_words(study), True), ("unit", False),
                                             ("share of before", True)],
                rows)
    if len(told) < sum(units[k] != HOURS for k in outputs(study, False)) + units.count(HOURS):
        yield "Energies that no scenario changes are left out."
    if not is_one_point(study) and is_of_draws(study):
        yield f"The intervals hold how little {study.text('points_of')} knows of its parameters, and not what the " \
              "model gets wrong: where it misses the readings, or a parameter lies at an end of its range, the " \
              "saving may lie outside."
    if is_one_point(study):
        yield f"{study.text('points_of')} has one point: how sure the savings are, it does not say."
    elif not is_of_draws(study):
        yield f"The points are the best ones of {study.text('points_of')}. They give a range, not a probability: the " \
              "saving may lie outside it more often than the percentages say."
