"""One self-contained HTML page of a loop: its numbers in page.html, no script, no request."""
import pathlib

import jinja2

from report import pictures, theme, words
from report.result import AFTER, BEFORE, PLAIN

MOST_POWER_ROWS = 15


def error_rows(loop):
    """By period, that of judging first."""
    rows = loop.errors()
    periods = sorted(loop.periods, key=lambda period: period != loop.judged)
    return [(period, [row for row in rows if row.period == period]) for period in periods
            if any(row.period == period for row in rows)]


def power_rows(loop):
    """Of the effects that the data can show, the most clearly seen first."""
    rows = [{"effect": name, "d": loop.value("power_detectability", k),
             "visibility": loop.value("power_visibility", k), "alias": loop.texts("power_alias")[k],
             "correlation": loop.value("power_alias_correlation", k),
             "parameter": loop.texts("power_bias_parameter")[k],
             "bias": loop.value("power_bias", k)}
            for k, name in enumerate(loop.texts("power_effect"))]
    seen = [row for row in rows if row["d"] >= words.LEAST_SEEN]
    return sorted(seen, key=lambda row: -row["d"])


def decision_rows(loop):
    """Of the data: classes of effects and parameters stand with the power table."""
    rows = side_by_side(loop, "decision_series", "decision_finding", "decision_action")
    effects = loop.texts("power_effect")
    return [row for row in rows
            if not (row[0] in effects and row[1].startswith("one class with "))]


def parameter_rows(loop):
    def shown(p, model):
        return words.plus_minus(loop.value("parameter_value", model, p),
                                loop.value("parameter_sd", model, p))
    rows = []
    for p, name in enumerate(loop.parameters):
        mean, sd = loop.value("parameter_prior_mean", p), loop.value("parameter_prior_sd", p)
        moved = loop.value("parameter_value", AFTER, p) - loop.value("parameter_value", BEFORE, p)
        rows.append({"name": name, "unit": loop.texts("parameter_unit")[p],
                     "prior": words.plus_minus(mean, sd),
                     "values": [shown(p, model) for model in (PLAIN, BEFORE, AFTER)],
                     "moved": words.signed(moved / sd if sd > 0 else float("nan"), 2)})
    return rows


def effect_rows(loop):
    """The effects, each with what is said of it."""
    return [{"name": name, "hook": loop.texts("effect_hook")[k],
             "follows": loop.texts("effect_shape")[k],
             "coefficient": words.coefficient(loop, k),
             "gain": words.number(loop.value("effect_gain", k)),
             "adequate": loop.value("effect_adequate", k) == 1, "doubt": words.doubt(loop, k),
             "others": "; ".join(words.others(loop, k)),
             "separates": loop.texts("effect_separates")[k]}
            for k, name in enumerate(loop.texts("effect"))]


def step_rows(loop):
    return [{"effect": name, "gain": words.number(loop.value("step_gain", k)),
             "needed": words.number(loop.value("step_threshold", k)),
             "score": words.number(loop.value("step_score", k)),
             "errors": [words.signed(100 * loop.value("step_error", k, c), 1)
                        for c in range(len(loop.channels))],
             "verdict": loop.texts("step_verdict")[k]}
            for k, name in enumerate(loop.texts("step_effect"))]


def side_by_side(loop, *names):
    """Rows of several lists of texts."""
    return list(zip(*(loop.texts(name) for name in names)))


def contents(loop):
    """Everything that page.html names."""
    power = power_rows(loop)
    structures = [(name, words.number(loop.value("structure_score", k)),
                   name == loop.text("structure_chosen"))
                  for k, name in enumerate(loop.texts("structure"))]
    ranking = [(name, words.number(loop.value("candidate_gain", k)))
               for k, name in enumerate(loop.texts("candidate")[:10])]
    left = [(channel, words.percent(loop.value("unexplained", c), 1),
             (loop.texts("unexplained_where") or [""] * len(loop.channels))[c])
            for c, channel in enumerate(loop.channels)]
    channels = [(channel, pictures.of_channel(loop, c)) for c, channel in enumerate(loop.channels)]
    return dict(
        study=loop, words=words, structure_words=words.structure(loop),
        lead=" ".join([words.found(loop), words.judged(loop), words.unexplained(loop)]),
        errors=error_rows(loop), error_picture=pictures.errors(loop), effects=effect_rows(loop),
        channels=channels, parameters=parameter_rows(loop),
        parameter_picture=pictures.parameters(loop), alarm_picture=pictures.alarms(loop),
        steps=step_rows(loop), ranking=ranking, power=power[:MOST_POWER_ROWS],
        more_power=power[MOST_POWER_ROWS:], unseen=words.unseen(loop), aliases=words.aliases(loop),
        followed=words.followed(loop),
        structures=structures, left=left, models=range(3),
        decisions=decision_rows(loop),
        colours={name: (light, dark) for name, light, dark in theme.COLOURS.values()})


def html_of(loop):
    """The page as text."""
    folder = pathlib.Path(__file__).parent
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(folder), autoescape=True,
                                     trim_blocks=True, lstrip_blocks=True,
                                     undefined=jinja2.StrictUndefined)
    return environment.get_template("page.html").render(contents(loop))
