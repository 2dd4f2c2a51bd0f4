"""The first sentence of a study on a page: what it answers, in numbers that the result has.

It says what was found, and where it holds; pictures and tables below it have the rest. A loop has words of its own.
Leaves out what a study does not store: then there is no sentence.
"""
import numpy as np

from report import chains, savings, staged
from report.picture import bare_unit
from report.result import overlap
from report.screening import METRIC
from report.sobol import order_of
from report.stored import join
from report.words import fixed, listed, number, percent

MOST, LEAST_SHARE = 4, 0.05            # outputs, parameters, scenarios in a sentence; a share that is told
LEAST_RISE = 0.01                      # of a scenario's largest change: a smaller rise is not told
CURRENCY = "currency"          # unit of a cost
BOUGHT = ("electricity", "gas", "district")    # outputs that are bought; others are what rooms ask for
# What the data say of unknowns, by the words of their findings.
OF_FINDINGS = (("the data narrow these", ("determined", "narrowed")),
               ("the data tell these only together with others", ("confounded",)),
               ("the data move these, but leave them as uncertain", ("moved",)),
               ("prior and data disagree on these", ("wider",)),
               ("the data say nothing of these", ("as_before",)),
               ("these lie at an end of their range: it is too narrow, or they make up for what the model lacks",
                ("at_edge",)))
# Unknowns that no line of the job names: of a meter's residuals; of the stand-in.
OF_RESIDUALS = ("constant", "proportional", "phi", "share", "timescale")
OF_STATISTICS = ("log_density", "lambda_", "beta_", "rho")


def shares(names, total):
    """"infiltration 31 % and heating_set_point 29 %": at most two, those that count."""
    told = [f"{names[p]} {percent(total[p])}" for p in order_of(total)[:2] if total[p] >= LEAST_SHARE]
    return listed(told) or "no input alone"


def of_indices(study):
    """Of totals."""
    total, names = study.numbers("total_order"), study.texts("parameter")
    outputs = study.texts("output")
    told = [f"for {output}, {shares(names, total[k])}" for k, output in enumerate(outputs[:MOST])
            if np.isfinite(total[k]).any()]
    more = f"; {len(outputs) - MOST} more outputs are below" if len(outputs) > MOST + 1 else ""
    return f"What matters most, as a share of the variance over the given ranges, interactions with others " \
           f"included: {'; '.join(told)}{more}." if told else ""


def of_series(study):
    """Of a whole series."""
    total = study.numbers("series_total_order")
    return f"What matters most for {study.text('quantity')} over all hours, as a share of the variance over the " \
           f"given ranges, interactions with others included: {shares(study.texts('parameter'), total)}." \
        if np.isfinite(total).any() else ""


def of_candidates(study):
    """Errors as described and of the best point, in the last period."""
    fit, metrics, periods = study.numbers("fit"), study.texts("metric"), study.texts("period")
    if fit.ndim != 4 or METRIC not in metrics or not periods:
        return ""
    last, words = len(periods) - 1, seen(study, periods)
    errors = fit[:, last, :, metrics.index(METRIC)]
    told = [f"{meter} from {percent(errors[0, m], 1)} to {percent(errors[-1, m], 1)}"
            for m, meter in enumerate(study.texts("meter")) if np.isfinite(errors[[0, -1], m]).all()]
    return f"From the description to the best point, CV(RMSE) in {periods[last]}{words} went so: " \
           f"{listed(told[:MOST])}." if told else ""


def seen(study, periods):
    """", which it has not seen,": how the last period lies to training; "" where that is not known."""
    training, last = ([study.numbers(join(group, "time")) for group in study.groups_with("time")
                       if period in group.split("/")] for period in (periods[0], periods[-1]))
    if len(periods) == 1:
        return ", which chose it: no readings were held out,"
    if not training or not last:
        return ""
    return f", which overlaps {periods[0]}," if overlap(training, last) else ", which it has not seen,"


def of_front(study):
    """Where an optimisation has targets and no meters."""
    of_meters = of_candidates(study) if study.knows("fit", "metric", "meter", "period") else ""
    if of_meters:
        return of_meters
    missed = [f"{target} by {fixed(abs(error), 2)} %" for target, error in
              zip(study.texts("target"), study.numbers("nearest_target_error").ravel()) if np.isfinite(error)]
    n = len(study.numbers("front_parameters"))
    front = f" {n} points are a front: none is better than another in all." if n > 1 else ""
    return f"The nearest point misses {listed(missed)}.{front}" if missed else ""


def of_aims(study):
    """How near the nearest point of a grid comes; it need not be of the last stage."""
    errors = study.numbers("stage_target_error")[np.nanargmin(study.numbers("stage_distance"))]
    targets, units = study.texts("target"), study.texts("parameter_unit")
    values = [f"{name} {number(value, 4)} {bare_unit(unit)}".strip() for name, value, unit in
              zip(study.texts("parameter"), study.numbers("nearest_parameters"), units)]
    missed = listed(f"{target} by {fixed(abs(error), 2)} %" for target, error in zip(targets, errors))
    return f"The nearest point misses {missed}. It has {listed(values)}."


def of_stages(study):
    """Root mean square errors of the validations, else of the stages, before and after."""
    found = staged.comparisons(study)
    judged = [row for row in found if row[1].startswith("validation")]
    told = []
    for name, group in judged or found:
        fit, metrics = study.numbers(join(group, "version_fit")), study.texts(join(group, "metric"))
        unit = (study.texts(join(group, "meter_unit")) or [""])[0].replace("degC", "K")
        both = fit[[staged.BEFORE, staged.AFTER], 0, metrics.index(staged.RMSE)]
        if np.isfinite(both).all():
            told.append(f"in {name} from {fixed(both[0], 2)} to {fixed(both[1], 2)} {bare_unit(unit)}".strip())
    where = "on periods that were not calibrated on" if judged else "on the periods that were calibrated on"
    return f"The root mean square error of the first meter went, {where}, {listed(told[:MOST])}." if told else ""


def meters_of(study):
    return {chains.judged(group)[0] for group in study.groups_with("validation_fit", "metric")}


def of_unknowns(study):
    """What the data tell of the inputs; the unknowns of the statistical model are left out."""
    own = [f"{meter}_{part}" for meter in meters_of(study) for part in OF_RESIDUALS]
    names = [name for name in chains.told(study)
             if name not in own and not name.startswith(OF_STATISTICS)]
    finding = dict(zip(study.texts("unknown"), study.texts("data_finding")))
    told = [(words, [name for name in names if finding.get(name) in of]) for words, of in OF_FINDINGS]
    return f"Of {len(names)} calibrated input{'s' if len(names) > 1 else ''} " + "; ".join(
        f"{words}: {some(found)}" for words, found in told if found) + "." if any(found for _, found in told) else ""


def some(names):
    left = len(names) - MOST
    return listed(names[:MOST] + [f"{left} more"]) if left > 1 else listed(names)


def of_savings(study):
    """What each scenario saves of what it saves most of, and what rises; without those that change nothing."""
    shown, hours = savings.outputs(study, False), savings.outputs(study, True)
    if not shown:
        return ""
    saved = np.nan_to_num(savings.saved(study))
    told = [f"{scenario} {of_scenario(study, saved[:, s], shown, hours)}"
            for s, scenario in enumerate(study.texts("scenario")) if saved[:, s, shown + hours].any()]
    if not told:
        return f"No scenario changes anything{savings.period_words(study)}."
    sure = "" if savings.is_one_point(study) else f", with the {savings.intervals_words(study)}"
    return f"Saved{savings.period_words(study)}{sure}: {'; '.join(told[:MOST])}."


def of_scenario(study, saved, shown, hours):
    """"20005 kWh of gas (19971 to 20036), but electricity rises by 5626 kWh (5617 to 5635)". What rooms ask for is told
    where no energy that is bought changes.

    saved  lowest, middle and highest saving [3 x output]
    """
    low, middle, high = saved
    names, units = study.texts("output"), study.texts("output_unit")
    loads = [k for k in shown if units[k] == "kWh" and names[k] not in BOUGHT]
    bought = [k for k in shown if names[k] in BOUGHT]
    energies = bought if np.any(middle[bought]) else loads or shown
    shown = [k for k in shown if k in energies or k not in loads and k not in bought]
    best = max(energies, key=lambda k: middle[k])
    falls = [k for k in shown if k == best or k not in energies and middle[k] > 0] if middle[best] > 0 else []
    text = listed([f"{amount(middle[k], units[k])} of {names[k]}{span(study, low[k], high[k])}" for k in falls]) or \
        "nothing"
    rises = [f"{names[k]} {'' if n else 'rises '}by {amount(-middle[k], units[k])}{span(study, -high[k], -low[k])}"
             for n, k in enumerate(rising(middle, units, shown + hours)[:MOST])]
    return f"{text}, but {listed(rises)}" if rises else text


def amount(value, unit):
    """"20005 kWh"; money has no unit, for no job says its currency."""
    return number(value, 3) + ("" if unit == CURRENCY else f" {unit}")


def span(study, least, most):
    return "" if savings.is_one_point(study) else f" ({number(least, 3)} to {number(most, 3)})"


def rising(middle, units, outputs):
    """The outputs that rise by what counts beside the scenario's largest change in the same unit."""
    def largest(unit):
        return max(abs(middle[k]) for k in outputs if units[k] == unit)
    return [k for k in outputs if middle[k] < 0 and -middle[k] >= LEAST_RISE * largest(units[k])]


BY_KIND = {"sensitivity": (of_indices, "parameter output total_order"),
           "office_hour_sensitivity": (of_indices, "parameter output total_order"),
           "hourly_sensitivity": (of_series, "parameter series_total_order"),
           "screening": (of_candidates, "fit metric meter period"),
           "optimisation": (of_front, ""),
           "grid": (of_aims, "target parameter parameter_unit nearest_parameters stage_distance stage_target_error"),
           "stages": (of_stages, ""),
           "posterior": (of_unknowns, "unknown data_finding"),
           "kennedy_ohagan": (of_unknowns, "unknown data_finding"),
           "retrofit": (of_savings, "scenario output output_unit quantile saving_quantile before_quantile "
                                    "after_quantile")}


def answer(study):
    """Its sentences; "" where it stores nothing to say them of."""
    make, needs = BY_KIND.get(study.kind, (None, ""))
    return make(study) if make and study.knows(*needs.split()) else ""
