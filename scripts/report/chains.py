"""Pictures of a posterior: densities beside priors, pairs, chains, ranks of the readings.

Sources: rank histograms and R-hat of Vehtari et al. 2021, Bayesian Analysis 16; densities are Gaussian kernels of
Scott's width. The log density is no unknown.
"""
import numpy as np

from report import pictures, theme
from report.picture import LONGEST_OF_THREE, Table, and_more, bare_unit, picture, short, unit_words
from report.stored import join
from report.words import beside, fixed, listed, number, percent

LOG_DENSITY, ALL = "log_density", "all"
MOST_DENSITIES, MOST_PAIRS, MOST_TRACES = 12, 5, 6
MOST_DRAWS, TRACE, PLACES = 2000, 640, 48      # of a density; of all chains in a trace; of a curve
PAIR_DOTS, BINS = 200, 20
TICKS = 12                     # characters that the numbers of a small axis have room for
MOST_METERS, MOST_FAILED = 6, 20


def told(study):
    """The unknowns without the columns that functions are made of, "evenings by hour of the week 12"."""
    columns = [f"{function.name} " for function in study.functions]
    return [name for name in study.texts("unknown") if name.rstrip("0123456789") not in columns]


def names_of(study):
    """Unknowns with draws that are told, in the result's order."""
    return [name for name in told(study) if name != LOG_DENSITY and draws_of(study, name).size]


def draws_of(study, name, group="posterior"):
    """[chain x draw]"""
    draws = study.numbers(f"{group}/{name}")
    return draws if draws.ndim == 2 and np.isfinite(draws).all() else np.empty((0, 0))


def of_unknowns(study, name):
    """{unknown: value}"""
    return dict(zip(study.texts("unknown"), study.numbers(name).ravel()))


def units_of(study):
    """As stored; the size of a temperature's residuals, stored without a unit, is in kelvins."""
    units = dict(zip(study.texts("unknown"), study.texts("unknown_unit")))
    for group in study.groups_with("measured"):
        name = f"{group.rpartition('/')[2]}_constant"
        if name in units and study.units.get(join(group, "measured")) == "degC":
            units[name] = "K"
    return units


def some(values, most=MOST_DRAWS):
    flat = values.ravel()
    return flat[np.linspace(0, flat.size - 1, min(most, flat.size)).astype(int)]


def density(values, places):
    """Of Gaussian kernels; None where all are the same."""
    width = np.std(values) * values.size ** -0.2       # Scott's
    if not width > 0:
        return None
    return np.exp(-((places[:, None] - values) / width) ** 2 / 2).mean(axis=1) / (width * np.sqrt(2 * np.pi))


def draw_density(axis, posterior, prior):
    """Both, over where the posterior lies and most of the prior's middle."""
    everything = [values for values in (posterior, prior) if values.size]
    low, high = (float(f([np.quantile(values, q) for values in everything])) for f, q in ((np.min, 0.005),
                                                                                        (np.max, 0.995)))
    if posterior.size and prior.size:      # a wide prior would make the posterior a needle
        reach = 4 * max(np.ptp(np.quantile(posterior, [0.005, 0.995])), 1e-300)
        middle = np.median(posterior)
        low, high = max(low, middle - reach), min(high, middle + reach)
    places = np.linspace(low, high, PLACES) if high > low else np.array([low - 0.5, low + 0.5])
    for values, colour, alpha in ((prior, theme.PLAIN, 0.3), (posterior, theme.AFTER, 0.35)):
        curve = density(values, places) if values.size else None
        if curve is not None:
            axis.fill_between(places, curve, color=colour, alpha=alpha, linewidth=0)
            axis.plot(places, curve, color=colour, linewidth=1)
    axis.set(yticks=[], xlim=(places[0], places[-1]))
    axis.set_ylim(bottom=0)
    axis.grid(False)
    axis.locator_params(axis="x", nbins=3)
    if sum(len(theme.thousands(tick)) for tick in axis.get_xticks() if places[0] <= tick <= places[-1]) > TICKS:
        axis.locator_params(axis="x", nbins=1)
    theme.compact(axis)


def densities(study):
    """Posterior beside prior, those that the data narrow most first."""
    names, units = names_of(study), units_of(study)
    contraction = of_unknowns(study, "contraction")
    shown = sorted(names, key=lambda name: -np.nan_to_num(contraction.get(name, 0)))[:MOST_DENSITIES]
    if not shown:
        return
    figure, axes = theme.panels(len(shown), 3, 1.05)
    for axis, name in zip(axes, shown):
        draw_density(axis, some(draws_of(study, name)), some(draws_of(study, name, "prior")))
        axis.set_title(short(name, LONGEST_OF_THREE), fontsize=7.5)
        axis.set_xlabel(unit_words(units.get(name, "")).strip(), fontsize=7)
    theme.legend_on_top(figure, (("posterior", theme.AFTER), ("prior", theme.PLAIN)))
    said = "; ".join(f"{name} {number(np.mean(draws_of(study, name)))} ± {number(np.std(draws_of(study, name)), 2)}"
                     for name in shown)
    yield picture(figure, "Before and after the data",
                  f"Densities of prior and posterior; posterior means with standard deviations: {said}.",
                  "Ordered by how much the data tell. Where both are alike, they tell nothing."
                  + and_more(len(names), len(shown), "unknowns"))


def strongest(correlation):
    """Both of each pair, the strongest pairs first, in the order of the unknowns."""
    shown = set()
    for place in np.argsort(-np.triu(correlation, 1), axis=None, kind="stable"):
        pair = {int(k) for k in np.unravel_index(place, correlation.shape)}
        if len(shown | pair) <= MOST_PAIRS:
            shown |= pair
    return np.array(sorted(shown))


def pairs(study):
    """Joint draws of the unknowns that are correlated most."""
    names = names_of(study)
    if len(names) < 2:
        return
    draws = np.array([draws_of(study, name).ravel() for name in names])
    if len({row.size for row in draws}) > 1:
        return
    with np.errstate(invalid="ignore", divide="ignore"):
        correlation = np.nan_to_num(np.corrcoef(draws))
    np.fill_diagonal(correlation, 0)
    shown = strongest(np.abs(correlation))
    n = len(shown)
    figure, axes = theme.figure(0.3 + 0.85 * n, nrows=n, ncols=n, squeeze=False, sharex="col")
    for (row, column), axis in np.ndenumerate(axes):
        axis.grid(False)
        axis.tick_params(labelleft=False, left=False, labelsize=6)
        axis.locator_params(axis="x", nbins=2)
        theme.compact(axis)
        if row < column:
            axis.text(0.5, 0.5, fixed(correlation[shown[row], shown[column]], 2), ha="center", va="center",
                      transform=axis.transAxes, color=theme.SOFT)
            axis.axis("off")
        elif row == column:
            values = some(draws[shown[row]])
            places = np.linspace(values.min(), values.max(), PLACES)
            curve = density(values, places)
            if curve is not None:
                axis.fill_between(places, curve, color=theme.AFTER, alpha=0.35, linewidth=0)
        else:
            theme.dots(axis, some(draws[shown[column]], PAIR_DOTS), some(draws[shown[row]], PAIR_DOTS), theme.AFTER,
                       size=1.8, alpha=0.5)
        if row == column:      # the last one's words go to the left, where there is room
            axis.set_title(short(names[shown[row]], LONGEST_OF_THREE), fontsize=7,
                           loc="right" if row == n - 1 else "left")
    pair = np.unravel_index(np.abs(correlation).argmax(), correlation.shape)
    yield picture(figure, "Pairs", f"Pairs of {listed(names[k] for k in shown)}. The strongest correlation is "
                  f"{fixed(correlation[pair], 2)}, of {names[pair[0]]} and {names[pair[1]]}.",
                  "Joint draws of the unknowns with the strongest correlations, which stand above the diagonal: the "
                  "data tell such numbers only together." + and_more(len(names), n, "unknowns"))


def worst(study):
    """Unknowns that converge worst, by R-hat."""
    rhat = of_unknowns(study, "rhat_rank")
    return sorted(names_of(study), key=lambda name: -np.nan_to_num(rhat.get(name, 0)))[:MOST_TRACES]


def colour_of(chain):
    return theme.SERIES[chain % len(theme.SERIES)]


def traces(study):
    """Draws of each chain in their order."""
    shown, rhat = worst(study), of_unknowns(study, "rhat_rank")
    if not shown:
        return
    figure, axes = theme.panels(len(shown), 2, 1.2, sharex=True)
    for axis, name in zip(axes, shown):
        draws = draws_of(study, name)
        places = np.linspace(0, draws.shape[1] - 1, min(TRACE // len(draws) + 1, draws.shape[1])).astype(int)
        for chain, values in enumerate(draws):
            axis.plot(places + 1, values[places], color=colour_of(chain), linewidth=0.6, alpha=0.8)
        axis.set_title(f"{short(name)} {fixed(rhat.get(name, np.nan), 3)}", fontsize=7.5)
        axis.locator_params(nbins=3)
    for axis in axes[-2:]:
        axis.set_xlabel("draw")
    said = listed(f"{name} {fixed(rhat.get(name, np.nan), 3)}" for name in shown)
    yield picture(figure, "Traces", f"Traces of {len(draws_of(study, shown[0]))} chains; R-hat: {said}.",
                  "Names with R-hat. Chains that have converged mix and lie in one band."
                  + and_more(len(names_of(study)), len(shown), "unknowns") + " Those that converge worst are shown.")


def ranks(study):
    """How often each chain has the small, middling and large draws of all."""
    shown = worst(study)
    if not shown or len(draws_of(study, shown[0])) < 2:
        return
    figure, axes = theme.panels(len(shown), 2, 1.2, sharex=True, sharey=True)
    most = {}
    for axis, name in zip(axes, shown):
        draws = draws_of(study, name)
        places = (np.argsort(np.argsort(draws, axis=None, kind="stable")) + 0.5).reshape(draws.shape) / draws.size
        counts = np.array([np.histogram(row, BINS, (0, 1))[0] for row in places]) * BINS / draws.shape[1]
        for chain, row in enumerate(counts):
            axis.stairs(row, np.linspace(0, 1, BINS + 1), color=colour_of(chain), linewidth=0.8)
        axis.axhline(1, color=theme.SOFT, linewidth=0.8, linestyle=":")
        axis.set_title(short(name), fontsize=7.5)
        most[name] = counts.max()
    axes[0].set_ylim(0, min(max(most.values()) * 1.05, BINS))
    for axis in axes[-2:]:
        axis.set_xlabel("rank among all draws")
        axis.set_xticks([0, 0.5, 1], ["least", "", "most"])
    said = listed(f"{name} {fixed(value, 1)}" for name, value in most.items())
    yield picture(figure, "Rank histograms",
                  f"Rank histograms of the chains, 1 = as often as expected; the highest bar: {said}.",
                  "Chains that have converged lie about the dotted line. A chain that leans to one side has seen "
                  "another part.")


def table(study):
    """Every unknown: what is known of it, and whether the chains agree."""
    columns = [of_unknowns(study, name) for name in ("posterior_mean", "posterior_sd", "posterior_q05",
                                                      "posterior_q95", "rhat_rank", "ess_bulk", "ess_tail")]
    units, words = units_of(study), dict(zip(study.texts("unknown"), study.texts("data_words")))
    rows = []
    for name in told(study):
        mean, sd, low, high, rhat, bulk, tail = (column.get(name, np.nan) for column in columns)
        unit = units.get(name, "")
        rows.append([name, beside(mean, sd), beside(sd, sd), f"{beside(low, sd)} to {beside(high, sd)}",
                     bare_unit(unit), fixed(rhat, 3), number(bulk), number(tail), words.get(name, "")])
    yield Table("Unknowns", [("unknown", False), ("mean", True), ("sd", True), ("90 % interval", True),
                             ("unit", False), ("R-hat", True), ("ESS bulk", True), ("ESS tail", True),
                             ("what the data tell", False)], rows)
    yield from meanings(study.texts("unknown"))
    if np.isfinite(study.number("target_rhat")):
        yield f"Aim: R-hat of at most {number(study.number('target_rhat'))} and at least " \
              f"{number(study.number('target_ess'))} effective draws (ESS)."


def meanings(names):
    """What the unknowns are that no line of the job names."""
    if any(name.startswith(("rho_eta_", "rho_delta_")) for name in names):
        yield "The names rho and lambda are of the statistical model: rho of an input near 1 says that it hardly " \
              "matters there, a large lambda that the part varies little. The parts: eta is the simulator, delta " \
              "what it lacks (the discrepancy), e the error of a measurement."
    if any(name.endswith("_constant") for name in names):
        of_mean = "as a share of the mean reading (of several buildings together, of the mean that each description " \
                  "predicts), of a temperature in K"
        slow = "" if not any(name.endswith("_timescale") for name in names) else \
            "; METER_share is the share of their variance that is slow, METER_timescale for about how many readings " \
            "that lasts"
        yield "Of a meter's residuals, reading less prediction: METER_constant is the standard deviation of their " \
              f"constant part, {of_mean}; METER_proportional that of the part in proportion to the prediction, as a " \
              f"share of it; METER_phi their correlation from one step to the next{slow}."


def functions(study):
    """Functions whose values were sampled, with their bands."""
    begin = min((study.numbers(join(group, "time"))[0] for group in study.groups_with("time")
                 if group.split("/")[0] in study.periods[:1]), default=0)
    yield from pictures.drawn(study.functions, begin)


def program(study):
    """Of a study on an emulator of another program: how many runs it is from, which failed."""
    of, failures = np.array(study.texts("simulator_run")), np.array(study.texts("simulator_run_failure"))
    names, at = study.texts("simulator_parameter"), study.numbers("simulator_run_value")
    shares = ", ".join(f"{(of == one).sum()} {one}" for one in dict.fromkeys(of))
    failed = failures != ""
    errors = dict(zip(study.texts("simulator_channel"), study.numbers("simulator_emulator_error")))
    foretold = "; ".join(f"{meter} within {fixed(error, 1)} %" for meter, error in errors.items())
    yield f"{of.size} runs of the program: {shares}; {failed.sum()} failed. " + (
        f"An emulator of {'the others' if failed.any() else 'them'} stands in for the program. It foretells runs that "
        f"it has not seen (CV(RMSE)): {foretold}." if foretold else "")
    rows = zip(study.texts("best_run_output"), study.texts("best_run_unit"),
               study.numbers("best_run_value"), study.numbers("best_run_foretold"))
    best = "; ".join(f"{name} {number(value)} {unit}, foretold {number(said)}" for name, unit, value, said in rows)
    if best:
        yield f"The program was run at the best point: {best}."
    if failed.any():
        yield Table("Runs that failed", [(name, True) for name in names] + [("why", False)],
                    [[*map(number, at[k]), failures[k]] for k in np.flatnonzero(failed)[:MOST_FAILED]])


def judged(group):
    """"gas, held_out": the meter and period, .../PERIOD/METER/PART; of single hours that were held out their part."""
    *where, meter, part = ("", *group.split("/"))
    return meter, " ".join([name for name in where if name] + ([] if part == ALL else [part]))


def fit_table(study):
    """Errors of every meter and period, as described and with the posterior's mean."""
    rows = []
    for group in study.groups_with("validation_fit", "metric"):
        fit, metrics = study.numbers(join(group, "validation_fit")), study.texts(join(group, "metric"))
        if fit.ndim != 3 or "cv_rmse" not in metrics or fit.shape[0] != 2:
            continue
        inside = study.numbers(join(group, "coverage")).ravel()
        met = study.numbers(join(group, "guideline_14_met"))
        errors = fit[:, :, metrics.index("cv_rmse")]
        finest = next((k for k in range(errors.shape[1]) if np.isfinite(errors[:, k]).all()), None)
        months = errors[:, -1]
        if finest is None:
            continue
        bias = fit[1, finest, metrics.index("nmbe")] if "nmbe" in metrics else np.nan
        rows.append([*judged(group), percent(errors[0, finest], 1), percent(errors[1, finest], 1),
                     percent(months[0], 1), percent(months[1], 1), percent(bias, 1),
                     *(percent(inside[k]) if inside.size > k else "" for k in (1, 3)), verdict(met, errors[1])])
    if rows:
        yield Table("Errors: CV(RMSE)", [("meter", False), ("period", False), ("as described", True),
                                         ("posterior", True), ("months: as described", True), ("posterior", True),
                                         ("bias of it", True), ("in 90 % intervals", True), ("months in them", True),
                                         ("Guideline 14 met", False)], rows)


def verdict(met, errors):
    """Of the posterior, by ASHRAE Guideline 14's hourly and monthly limits: "hourly no, monthly yes"."""
    if met.shape != (2, 2):
        return ""
    return ", ".join(f"{name} {'yes' if value > 0 else 'no'}"
                     for name, value, error in zip(("hourly", "monthly"), met[1], (errors[0], errors[-1]))
                     if np.isfinite(error))


def reading_ranks(study):
    """Readings by their rank among the draws: are the intervals as wide as they should be?"""
    groups = [group for group in study.groups_with("pit") if study.numbers(join(group, "pit")).sum() > 0]
    groups = groups[:MOST_METERS]
    if not groups:
        return
    figure, axes = theme.panels(len(groups), 2, 1.2, sharex=True)
    said = []
    for axis, group in zip(axes, groups):
        counts = study.numbers(join(group, "pit"))
        name = ", ".join(judged(group))
        axis.stairs(counts * counts.size / counts.sum(), np.linspace(0, 1, counts.size + 1), fill=True,
                    color=theme.AFTER, alpha=0.5)
        axis.axhline(1, color=theme.SOFT, linewidth=0.8, linestyle=":")
        axis.set_title(short(name), fontsize=7.5)
        said.append(f"{name} {fixed(study.number(join(group, 'pit_distance')), 2)}")
    for axis in axes[-2:]:
        axis.set_xticks([0, 0.5, 1], ["below", "middle", "above"])
    yield picture(figure, "Readings among the draws",
                  f"Histograms of the readings' ranks among the posterior's draws; distance from uniform: "
                  f"{listed(said)}.",
                  "Level: intervals as wide as they should be. A hill: too wide; a valley: too narrow; a slope: "
                  "predictions too high or too low.")
