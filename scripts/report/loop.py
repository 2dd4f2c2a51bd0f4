"""The numbers and words of a loop that loop.html names."""
import math
import re

from report import beside, meters, pictures, words
from report.picture import Picture, bare_unit
from report.result import AFTER, BEFORE, OF_CLASS, OF_ENDS, PLAIN

MOST_POWER_ROWS = 15
TOLD = 0.95                    # chance of a name that needs no measurement: enough_chance of src/loop/decisions.hpp


def error_rows(loop, regressions):
    """By period, that of judging first; each with the error of the regression beside it."""
    rows = loop.errors()
    for row in rows:
        row.regression = regressions.get((row.channel, row.period, row.resolution), float("nan"))
    periods = sorted(loop.periods, key=lambda period: period != loop.judged)
    return [(period, [row for row in rows if row.period == period]) for period in periods
            if any(row.period == period for row in rows)]


def power_rows(loop):
    """Of the effects that the data can show, the most clearly seen first."""
    seen = [effect for effect in loop.power if words.can_be_seen(loop, effect)]
    return sorted(seen, key=lambda effect: -effect.detectability)


def decision_rows(loop):
    """Of the data: classes of effects and parameters stand with the power table, ends with the parameters."""
    return [(decision.series, decision.finding, decision.action) for decision in loop.decisions
            if decision.kind not in (OF_CLASS, OF_ENDS)]


def parameter_rows(loop):
    def shown(p, model):
        return words.plus_minus(loop.value_of(model, p), loop.sd_of(model, p))
    rows = []
    for p, parameter in enumerate(loop.of_parameters):
        moved = loop.value_of(AFTER, p) - loop.value_of(BEFORE, p)
        sd = parameter.sd
        rows.append({"name": parameter.name, "unit": bare_unit(parameter.unit),
                     "prior": words.plus_minus(parameter.mean, sd),
                     "values": [shown(p, model) for model in (PLAIN, BEFORE, AFTER)],
                     "moved": words.signed(moved / sd if sd > 0 else float("nan"), 2)})
    return rows


def effect_rows(loop):
    """The effects, each with what is said of it; what brings most comes first."""
    return [{"name": effect.name, "hook": effect.hook, "follows": effect.shape,
             "since": since(effect), "coefficient": words.coefficient(effect), "evidence": words.evidence(loop, effect),
             "adequate": effect.is_adequate, "doubt": effect.doubt,
             "probability": "" if math.isnan(effect.probability) else f"{effect.probability:.2f}",
             "others": words.others(effect, "or"), "separates": effect.separates,
             "section": effect.section, "brings": [words.brought(value) for value in effect.brings if value.least or value.most]}
            for effect in sorted(loop.effects, key=words.size_of_what_it_brings, reverse=True)]


def since(effect):
    """The time from which it holds, by its section of a job; "" where it holds all along."""
    found = re.search(r'^since = "(\S+)', effect.section, re.M)
    return found[1] if found else ""


def function_rows(loop):
    return [{"name": function.name, "size": words.number(function.size), "unit": bare_unit(function.unit),
             "evidence": words.number(function.evidence)} for function in loop.functions]


def measurement_rows(loop):
    """What is advised: of names first, then of parameters."""
    return [{"question": row.question, "measure": row.measure,
             "when": f"{row.weeks:.0f} week{'' if row.weeks == 1 else 's'} from {row.begin}",
             "kind": row.kind, "now": words.percent(row.now), "then": words.percent(row.then)}
            for kind in ("name", "parameter") for row in loop.measurements
            if row.kind == kind and row.advised == 1]


def unanswered(loop):
    """Questions of which no measurement that was tried tells much more."""
    answered = {row.question for row in loop.measurements
                if row.advised == 1 or row.kind == "name" and row.now >= TOLD}
    return [question for question in dict.fromkeys(row.question for row in loop.measurements)
            if question not in answered]


def program_rows(loop):
    """The parameters of the program that the loop was around, at the runs that count."""
    return [{"name": row.name, "unit": bare_unit(row.unit),
             "range": f"{words.number(row.least)} to {words.number(row.most)}",
             "values": [words.number(value) for value in (row.plain, row.before, row.after)]}
            for row in loop.simulator.parameters]


def given_rows(loop):
    return [{"name": row.name, "hooks": row.hooks or "nothing that it knows",
             "scale": f"{words.number(row.scale)} times" if row.scale else "no better with it"}
            for row in loop.simulator.given]


def step_rows(loop):
    def tried(step, value):
        return words.number(value) if step.effect else words.DASH
    return [{"effect": step.effect or words.DASH, "gain": tried(step, step.gain),
             "needed": tried(step, step.threshold), "score": tried(step, step.score),
             "errors": [words.signed(100 * loop.error_of_step(k, c), 1)
                        for c in range(len(loop.channels))],
             "verdict": step.verdict} for k, step in enumerate(loop.steps)]


def contents(loop):
    """Everything that loop.html names."""
    power, regressions = power_rows(loop), beside.regression_errors(loop)
    structures = [(tried.name, words.number(tried.score), tried.name == loop.structure)
                  for tried in loop.structures]
    ranking = [(candidate.name, words.number(candidate.gain)) for candidate in loop.candidates[:10]]
    left = [(channel.name, words.percent(channel.unexplained, 1), channel.where)
            for channel in loop.of_channels]
    more = {meter.name: [draw(meter) for draw in (meters.bills, meters.signature, meters.duration)]
            for meter in meters.of_loop(loop)}
    channels = [(channel, pictures.of_channel(loop, c) + [one for one in more.get(channel, []) if one])
                for c, channel in enumerate(loop.channels)]
    return dict(
        study=loop, words=words, structure_words=words.structure(loop),
        lead=" ".join([words.found(loop), words.judged(loop), words.unexplained(loop)]),
        learned=words.learned(loop), regression=words.regression(loop, regressions),
        errors=error_rows(loop, regressions), error_picture=pictures.errors(loop), effects=effect_rows(loop),
        measurements=measurement_rows(loop), unanswered=unanswered(loop),
        program=program_rows(loop), given=given_rows(loop), left_out=loop.simulator.left_out,
        program_runs=words.program_runs(loop),
        functions=function_rows(loop), function_pictures=pictures.functions(loop),
        channels=channels, parameters=parameter_rows(loop),
        unusual_ends=words.unusual_ends(loop), parameter_picture=pictures.parameters(loop),
        pattern_picture=pictures.patterns(loop),
        steps=step_rows(loop), ranking=ranking, power=power[:MOST_POWER_ROWS],
        more_power=power[MOST_POWER_ROWS:], unseen=words.unseen(loop), aliases=words.aliases(loop),
        followed=words.followed(loop),
        structures=structures, left=left, models=range(3), models_are=words.models(loop),
        decisions=decision_rows(loop))



def pictures_in(numbers):
    """All pictures of the contents, each channel's with its name in the title."""
    found = [numbers["error_picture"], *numbers["function_pictures"], numbers["parameter_picture"]]
    for channel, drawn in numbers["channels"]:
        found += [Picture(one.svg, one.alt, one.caption, one.title if channel in one.title
                          else f"{channel}: {one.title}") for one in drawn]
    return [one for one in [*found, numbers["pattern_picture"]] if one]
