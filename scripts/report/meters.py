"""Pictures of meters: what was read, beside what the models of a study say.

The energy signature is the energy of a day over its mean outdoor temperature (Fels 1986, Energy and Buildings 9); the
load-duration curve has the hours in the order of their load. Bills and months are steps. Of several periods the
first after training that has readings is shown.
"""
from dataclasses import dataclass

import numpy as np

from report import theme
from report.picture import picture
from report.pictures import DAY, DAYS, LEAST_SHARE, name_days, weeks_of
from report.staged import AFTER, BEFORE
from report.stored import join
from report.words import fixed, listed, number, unit_said

WEEK = 7 * DAY                 # [s]
BILL = 20 * DAY                # longer steps are bills
LEAST_DAYS, LEAST_STEPS = 20, 24
MOST_METERS = 6
CURVE = 200                    # points of a curve
BIN = 2                        # [K] of outdoor temperature
LEAST_OF_WEEK = 28             # steps: one in six hours
BAND = ("predicted_q05", "predicted_q95")
TRAINING, JUDGED = "training", "validation"


@dataclass
class Meter:
    """A meter in a period, with the models before and after a study."""
    name: str
    period: str
    unit: str
    time: np.ndarray           # [s since 1970] begins of steps
    measured: np.ndarray       # NaN = missing
    models: dict               # label -> values
    outdoor: np.ndarray        # [degC] at the steps, or nothing
    band: np.ndarray           # 90 % interval of the last model [2 x time], or nothing

    @property
    def step(self):
        """[s]"""
        return float(np.median(np.diff(self.time))) if self.time.size > 1 else DAY

    @property
    def last(self):
        return list(self.models.values())[-1]

    @property
    def is_temperature(self):
        return self.unit == "degC"

    @property
    def shown_unit(self):
        return unit_said(self.unit)

    @property
    def where(self):
        return self.name if self.name.endswith(f", {self.period}") else f"{self.name} in {self.period}"


COLOURS = (theme.BEFORE, theme.AFTER)


def coloured(meter):
    """(label, values, colour): measured first."""
    colours = COLOURS[-len(meter.models):]
    return [("measured", meter.measured, theme.INK),
            *((label, values, colour) for (label, values), colour in zip(meter.models.items(), colours))]


def at_steps(outdoor, time, step):
    """Mean outdoor temperature of each step; nothing where that is not known of all."""
    if outdoor is None or outdoor[0].size < 2 or outdoor[0].size != outdoor[1].size:
        return np.array([])
    sums = np.concatenate([[0.0], np.cumsum(outdoor[1])])
    begins = np.searchsorted(outdoor[0], time)
    ends = np.searchsorted(outdoor[0], time + step)
    if (ends <= begins).any():     # steps shorter than those of the weather
        places = np.clip(np.searchsorted(outdoor[0], time, side="right") - 1, 0, outdoor[1].size - 1)
        return outdoor[1][places]
    return (sums[ends] - sums[begins]) / (ends - begins)


def labels_of(study, group, n):
    """Names of the rows of `simulated`: in the group or one above."""
    while True:
        for name in ("version", "candidate", "model"):
            names = study.texts(join(group, name))
            if len(names) == n:
                return [nice(name) for name in names]
        if not group:
            return [f"model {k + 1}" for k in range(n)]
        group = group.rpartition("/")[0]


def nice(label):
    return {"nominal": "as described"}.get(label, label)


def models_of(study, group):
    """Before and after: of candidates the nominal and the best, of versions none that stands beside."""
    simulated = study.numbers(join(group, "simulated"))
    if simulated.ndim == 2 and simulated.shape[0]:
        labels = labels_of(study, group, simulated.shape[0])
        return {labels[k]: simulated[k] for k in (BEFORE, AFTER) if k < simulated.shape[0]}
    both = {"as described": "nominal", "posterior mean": "predicted_mean"}
    return {label: study.numbers(join(group, leaf)) for label, leaf in both.items() if study.has(join(group, leaf))}


def unit_of(study, group, name):
    """As the job's list of meters says it, or the dataset itself."""
    folder = group
    while folder:
        folder = folder.rpartition("/")[0]
        names = study.texts(join(folder, "meter"))
        if name in names:
            return dict(zip(names, study.texts(join(folder, "meter_unit")))).get(name, "")
    said = study.units.get(join(group, "measured"), "")
    return "" if said == "of the meter" else said


def place_of(group):
    """(what it is of: a building or a comparison, or ""; period; meter): .../PERIOD/METER."""
    *owner, period, name = ("", *group.split("/"))[-4:] if group.count("/") < 3 else group.split("/")
    return "/".join(part for part in owner if part not in ("", "periods")), period, name


def meter_in(study, group):
    owner, period, name = place_of(group)
    last = owner.rpartition("/")[2]
    shown = f"{name}, {last}" if last else name
    time, measured = study.numbers(join(group, "time")), study.numbers(join(group, "measured"))
    models = {label: values for label, values in models_of(study, group).items()
              if values.shape == time.shape and np.isfinite(values).any()}
    band = [study.numbers(join(group, leaf)) for leaf in BAND]
    has_band = all(end.shape == time.shape for end in band)
    if measured.shape != time.shape or not models or np.isfinite(measured).sum() == 0:
        return None
    meter = Meter(shown, period, unit_of(study, group, name), time, measured, models, np.array([]),
                  np.array(band) if has_band else np.array([]))
    meter.outdoor = at_steps(study.outdoor.get(period), time, meter.step)
    return meter


def meters_of(study):
    """One period of each meter: the first after training that has readings. Validations come before stages."""
    order = study.periods
    found = {}
    for group in sorted(study.groups_with("time", "measured"), key=lambda group: not group.startswith(JUDGED)):
        meter = meter_in(study, group)
        if meter is not None:
            owner, period, name = place_of(group)
            place = order.index(period) if period in order else len(order)
            is_training = period == (order[0] if order else TRAINING)
            found.setdefault((owner, name), []).append((is_training, place, meter))
    return [min(periods, key=lambda row: row[:2])[2] for periods in found.values()]


def of_loop(loop):
    """Channels as meters: before and after, in the period of judging."""
    for channel in loop.of_channels:
        series = loop.series[channel.name]
        if series.simulated.ndim != 2 or series.simulated.shape[0] != 3:
            continue
        models = {"before": series.simulated[1], "after": series.simulated[2]}
        if series.readings:
            yield by_reading(channel, loop.judged, series, models)
        elif series.is_drawn:
            yield Meter(channel.name, loop.judged, channel.unit, series.time, series.measured, models, series.outdoor,
                        series.band)


def by_reading(channel, period, series, models):
    """Of days, months or bills: what the models have in the hours of each."""
    begins, ends, measured = series.readings
    places = np.searchsorted(series.time, begins), np.searchsorted(series.time, ends)

    def of_hours(values):
        sums = np.concatenate([[0.0], np.cumsum(values)])
        total = sums[places[1]] - sums[places[0]]
        return total / np.maximum(places[1] - places[0], 1) if channel.unit == "degC" else total
    outdoor = at_steps((series.time, series.outdoor), begins, (ends - begins)) if series.outdoor.size else np.array([])
    return Meter(channel.name, period, channel.unit, begins, measured,
                 {label: of_hours(values) for label, values in models.items()}, outdoor, np.array([]))


def daily(meter, values):
    """(energy of each day that is read nearly whole, its mean outdoor temperature); the same days for all values."""
    day = (meter.time // DAY).astype(int)
    day -= day.min()
    there = np.isfinite(meter.measured) & np.isfinite(values)
    n = day.max() + 1
    count = np.bincount(day[there], minlength=n)
    whole = count >= LEAST_SHARE * DAY / meter.step
    with np.errstate(invalid="ignore", divide="ignore"):
        energy = np.bincount(day[there], values[there], minlength=n) / count * DAY / meter.step
        outdoor = np.bincount(day[there], meter.outdoor[there], minlength=n) / count
    return energy[whole], outdoor[whole]


def binned(outdoor, energy):
    """Mean in each bin of outdoor temperature: place, mean."""
    places = np.floor(outdoor / BIN).astype(int)
    return np.array([((place + 0.5) * BIN, energy[places == place].mean()) for place in np.unique(places)]).T


def signature(meter):
    """Energy of a day over outdoor temperature; None where it is not known or no energy."""
    if meter.is_temperature or meter.step > DAY or meter.outdoor.shape != meter.time.shape:
        return None
    if daily(meter, meter.measured)[0].size < LEAST_DAYS:
        return None
    figure, axis = theme.figure(2.7)
    errors = {}
    for label, values, colour in coloured(meter):
        energy, outdoor = daily(meter, values)
        if label == "measured":
            theme.dots(axis, outdoor, energy, theme.SOFT, size=2.2, alpha=0.6)
            read = energy
        elif energy.shape == read.shape:
            errors[label] = np.sqrt(np.mean((energy - read) ** 2))
        axis.plot(*binned(outdoor, energy), color=colour, label=label)
    axis.set(xlabel="mean outdoor temperature of the day [°C]", ylabel=f"energy of a day [{meter.shown_unit}]")
    axis.set_ylim(bottom=min(0, axis.get_ylim()[0]))
    theme.legend_above(axis)
    said = "; ".join(f"{label} {number(error)} {meter.shown_unit}" for label, error in errors.items())
    return picture(figure, f"Energy signature: {meter.name}",
                   f"Energy of a day over outdoor temperature of {meter.where}, measured and modelled; RMSE of the "
                   f"days: {said}.",
                   f"{meter.period}. Dots: measured days; lines: mean in {BIN} K of outdoor temperature.")


def length_of(seconds):
    """"1 h", "10 min"."""
    return f"{number(seconds / 3600)} h" if seconds >= 3600 else f"{number(seconds / 60)} min"


def duration(meter):
    """Steps in the order of their value."""
    there = np.isfinite(meter.measured)
    if meter.step > DAY or there.sum() < LEAST_STEPS:
        return None
    figure, axis = theme.figure(2.7)
    share = np.linspace(0, 1, CURVE)
    largest = {}
    for label, values, colour in coloured(meter):
        ordered = np.quantile(values[there & np.isfinite(values)], 1 - share)
        largest[label] = ordered[0]
        axis.plot(100 * share, ordered, color=colour, label=label)
    axis.set(xlabel="share of the time [%]", xlim=(0, 100), ylabel=f"[{meter.shown_unit}]")
    theme.legend_above(axis)
    title = "Duration curve" if meter.is_temperature else "Load-duration curve"
    said = ", ".join(f"{label} {number(value)} {meter.shown_unit}" for label, value in largest.items())
    return picture(figure, f"{title}: {meter.name}",
                   f"{title} of {meter.where}; the largest value: {said}.",
                   f"{meter.period}. Steps of {length_of(meter.step)} in the order of their value, each curve by "
                   "itself.")


def typical_week(meter):
    """The week whose error is in the middle of all that are read nearly whole, with the 90 % band where stored."""
    steps = int(round(WEEK / meter.step))
    if steps < LEAST_OF_WEEK:
        return None
    weeks = weeks_of(meter, steps)
    if not weeks:
        return None
    errors = [np.sqrt(np.nanmean((meter.last[part] - meter.measured[part]) ** 2)) for part in weeks]
    part = weeks[int(np.argsort(errors)[len(weeks) // 2])]
    days = (meter.time[part] - meter.time[part][0]) / DAY
    figure, axis = theme.figure(2.7)
    if meter.band.size:
        axis.fill_between(days, *meter.band[:, part], color=theme.AFTER, alpha=0.18, linewidth=0, label="90 %")
    for label, values, colour in coloured(meter):
        axis.plot(days, values[part], color=colour, label=label, linewidth=1.5 if label == "measured" else 1.1)
    axis.set(ylabel=f"[{meter.shown_unit}]", xlim=(0, 7))
    name_days(axis)
    theme.legend_above(axis)
    first = str(meter.time[part][0].astype("datetime64[s]"))[:10]
    within = share_within(meter, part)
    return picture(figure, f"A typical week: {meter.name}",
                   f"{meter.where} in the week from {first}, {DAYS[0]} to {DAYS[-1]}, measured and modelled; RMSE "
                   f"{number(sorted(errors)[len(weeks) // 2])} {meter.shown_unit}{within}.",
                   f"{meter.period}, from {first}: " + (
                       f"among {len(weeks)} weeks the one with the middle error." if len(weeks) > 1 else
                       "the only week that is read whole."))


def share_within(meter, part):
    if not meter.band.size:
        return ""
    there = np.isfinite(meter.measured[part])
    low, high, read = meter.band[0, part][there], meter.band[1, part][there], meter.measured[part][there]
    return f"; {fixed(100 * np.mean((read >= low) & (read <= high)), 0)} % of its readings lie in the 90 % band"


def bills(meter):
    """Months and bills as steps."""
    there = np.isfinite(meter.measured)
    if meter.step < BILL or there.sum() < 2:
        return None
    ends = np.append(meter.time[1:], meter.time[-1] + meter.step)
    edges = np.append(meter.time, ends[-1]).astype("datetime64[s]")
    figure, axis = theme.figure(2.5)
    if meter.band.size:
        axis.fill_between(edges, *(np.append(end, end[-1]) for end in meter.band), step="post", color=theme.AFTER,
                          alpha=0.18, linewidth=0, label="90 %")
    for label, values, colour in coloured(meter):
        axis.stairs(values, edges, baseline=None, color=colour, label=label,
                    linewidth=1.6 if label == "measured" else 1.2)
    axis.set_ylabel(f"of a bill or month [{meter.shown_unit}]")
    axis.set_ylim(bottom=min(0, axis.get_ylim()[0]))
    marked = edges[np.linspace(0, edges.size - 1, min(5, edges.size)).astype(int)]
    axis.set_xticks(marked, [str(edge)[:7] for edge in marked])
    theme.legend_above(axis)
    said = "; ".join(f"{label} {number(np.nansum(np.where(there, values, np.nan)), 4)} {meter.shown_unit}"
                     for label, values, _ in coloured(meter))
    return picture(figure, f"Bills: {meter.name}",
                   f"{meter.where} bill by bill, measured and modelled; in all: {said}.",
                   f"{meter.period}. Each step is a bill or a month.")


PICTURES = (bills, typical_week, signature, duration)


def drawn(meter):
    return [one for one in (draw(meter) for draw in PICTURES) if one]


def series(study):
    """All pictures of all meters of a study."""
    found = meters_of(study)
    for meter in found[:MOST_METERS]:
        yield from drawn(meter)
    if len(found) > MOST_METERS:
        yield f"Not drawn: {listed(meter.name for meter in found[MOST_METERS:])}."
