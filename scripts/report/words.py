"""Numbers and findings in words."""
import math
import re

from report.result import AFTER, BEFORE, OF_ENDS, OF_PARAMETERS, PLAIN

DASH = "–"
SMALL = 0.005                  # changes below this share are none
LARGE = 0.02                   # unexplained shares below it are not listed
NEAR_NOTHING = 300             # CV(RMSE) [%] of a meter that shows hardly anything in the mean


def number(value, digits=3):
    """With so many digits; a dash for what is not known."""
    if not math.isfinite(value):
        return DASH
    if min(1000, 10**digits) <= abs(value) < 1e9:
        return f"{value:.0f}".replace("-", "−")
    return f"{value:.{digits}g}".replace("-", "−")


def fixed(value, decimals):
    text = f"{value:.{decimals}f}".replace("-", "−") if math.isfinite(value) else DASH
    return text.lstrip("−") if text.strip("−0.") == "" else text


def signed(value, decimals):
    return ("+" if value > 0 else "") + fixed(value, decimals)


def percent(share, decimals=0):
    return f"{fixed(100 * share, decimals)} %" if math.isfinite(share) else DASH


def error_of(row, model, kind="error"):
    """"12.3" or, of a temperature, "0.41"."""
    return fixed(getattr(row, kind)[model], 2 if row.unit == "K" else 1)


def beside(value, sd):
    """As many digits as its standard deviation makes known: two of the latter's."""
    if not (math.isfinite(value) and math.isfinite(sd) and 1e-6 < sd < 1e9):
        return number(value)
    decimals = 1 - math.floor(math.log10(float(f"{sd:.1e}")))
    return fixed(round(value, decimals), max(decimals, 0))


def plus_minus(value, sd):
    """"0.84 ± 0.05" with two digits of the latter; what is nothing beside its standard deviation is 0."""
    if not (math.isfinite(sd) and math.isfinite(value)):
        return number(value)
    return f"{beside(value if abs(value) > 1e-6 * sd else 0, sd)} ± {beside(sd, sd) if sd > 1e-6 else number(sd, 2)}"


def unit_said(unit):
    """"W/(m² K)" of "W/(m2 K)", "1/K" of "1/(K)"."""
    unit = re.sub(r"\((\w+)\)", r"\1", unit.replace("degC", "°C"))
    return re.sub(r"\bm([23])\b", lambda power: "m" + "²³"[int(power.group(1)) - 2], unit)


def said(text):
    """A text of the program with the signs of a page: −0.96, 15 °C, 400 W/m²."""
    text = re.sub(r"(?<=\d )degC\b", "°C", text)
    text = re.sub(r"(?<=[WJ]/)m2\b", "m²", text)
    text = re.sub(r"(?<![\w.)\]-])-(?=\d)", "−", text)
    return re.sub(r"(?<=\d) %", "\u00a0%", text)


def listed(texts, last="and"):
    """"a, b and c"."""
    texts = list(texts)
    return texts[0] if len(texts) == 1 else f"{', '.join(texts[:-1])} {last} {texts[-1]}" \
        if texts else ""


def is_choice(effect):
    """Whether it is there or not, without a size: hours, for instance."""
    return effect.least == effect.most


def size(effect):
    """"0.083 1/h per m/s"; of a choice what was chosen."""
    if is_choice(effect):
        return effect.shape
    return number(effect.coefficient) + ("" if effect.unit in ("", "-") else " " + unit_said(effect.unit))


def coefficient(effect):
    """"0.083 1/h per m/s, 90 % interval 0.079 to 0.087"."""
    if is_choice(effect):
        return "none: it is there or not"
    return f"{size(effect)}, 90 % interval {number(effect.least)} to {number(effect.most)}"


def in_words(count):
    few = ("No", "One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight", "Nine")
    return few[count] if count < len(few) else str(count)


def with_probability(effect, name):
    """"snow (0.12)"; results of versions before have no probabilities."""
    probability = effect.probabilities.get(name, math.nan)
    return name if math.isnan(probability) else f"{name} ({probability:.2f})"


def others(effect, word):
    """What it may be in its place, each with its probability."""
    return listed([with_probability(effect, name) for name in effect.others], word)


def found_one(effect):
    sure = "" if math.isnan(effect.probability) else f"; probability {effect.probability:.2f}"
    return f"{effect.name} ({size(effect)}{sure}" + \
        (f"; or else {others(effect, 'or')}" if effect.others else "") + ")"


def functions(loop):
    """What is laid to functions without a name, the one with the most evidence first."""
    if not loop.functions:
        return ""
    names = [function.name for function in sorted(loop.functions, key=lambda one: -one.evidence)]
    shown = listed(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")
    return f" Of what is left, a part follows {shown}: that says where and when, not why."


def settings(loop):
    """Set-points and set-backs that the readings deny."""
    each = [f"the {setting.name} is {number(setting.found)} ({number(setting.least)} to {number(setting.most)}) "
            f"{setting.unit.replace('degC', '°C')} and not the {number(setting.described)} that are described"
            for setting in loop.settings]
    return f"By the readings {listed(each)}. " if each else ""


def learned(loop):
    """Hours that nobody wrote down."""
    return ". ".join(schedule.sentence[:1].upper() + schedule.sentence[1:] for schedule in loop.schedules) + "." \
        if loop.schedules else ""


def brought(value):
    """"gas 1200 kWh/a (900 to 1500)"."""
    return f"{value.of} {number(value.value, 4)} {value.unit} ({number(value.least, 4)} to {number(value.most, 4)})"


def size_of_what_it_brings(effect):
    """What it costs; where no tariff is known, its largest energy."""
    costs = [abs(value.value) for value in effect.brings if value.of == "cost" or value.of.startswith("cost of ")]
    return costs[0] if costs else max((abs(value.value) for value in effect.brings), default=0)


def program_runs(loop):
    """How many runs of the program, of what, and how well an emulator foretold them."""
    simulator = loop.simulator
    if not simulator.parameters:
        return ""
    kinds = list(dict.fromkeys(run.of for run in simulator.runs))
    parts = ", ".join(f"{sum(run.of == kind for run in simulator.runs)} {kind}" for kind in kinds)
    n_failed = sum(bool(run.failure) for run in simulator.runs)
    failed = f"; {n_failed} failed" if n_failed else ""
    errors = ", ".join(f"{row.name} {number(row.error)} %" for row in simulator.emulated)
    foretold = f" Unseen ones were foretold within (CV(RMSE)): {errors}." if errors else ""
    years = sum(run.years for run in simulator.runs)
    annual = "" if math.isnan(years) else f" ({years:.0f} annual runs)"
    return f"It ran {len(simulator.runs)} times{annual}: {parts}{failed}.{foretold}"


def why_none(loop):
    """Why no candidate joined: none stood out, or the verdict on the one that stood out most."""
    out = [step for step in loop.steps if step.effect and step.gain > step.threshold]
    if not out:
        return "no candidate stood out from noise"
    most = max(out, key=lambda step: step.gain)
    those = "the candidate that stood out from noise did not pass" if len(out) == 1 else \
        f"{in_words(len(out)).lower()} candidates stood out from noise, and none of them stayed"
    why = " (it passed at first)" if most.verdict == "accepted" else f" ({most.verdict})"
    return f"{those}; most evidence had {said(most.effect)}{why}"


def found(loop):
    """What was found."""
    if not loop.effects and not loop.candidates and not any(step.effect for step in loop.steps):
        return settings(loop) + f"No effect that the description of {loop.building} lacks was looked for: " \
               "most_effects is 0, or the readings are too few." + functions(loop)
    if not loop.effects:
        return settings(loop) + f"No effect was found that the description of {loop.building} lacks: " \
               f"{why_none(loop)}." + functions(loop)
    n = len(loop.effects)
    text = settings(loop) + ("One effect was" if n == 1 else f"{in_words(n)} effects were") + \
        f" found that the description of {loop.building} lacks: " + \
        listed(found_one(effect) for effect in loop.effects) + "."
    if any(effect.others for effect in loop.effects):
        text += " Where it says or else, these data cannot tell for sure."
    unsure = [effect.name + (f" ({effect.doubt})" if effect.doubt else "")
              for effect in loop.effects if not effect.is_adequate]
    return text + (f" Not adequate, the name only the nearest one: {listed(unsure)}."
                   if unsure else "") + functions(loop)


def change_of(row, since, until):
    """"gas by 49 % (from 24.1 to 12.3 %)"."""
    by_month = "" if row.resolution == "hourly" else f"{row.resolution} "
    little = ", of readings whose mean is near 0" if row.unit == "%" and error_of_nothing(row, until) else ""
    return f"{row.channel} by {percent(abs(row.removed(since, until)))} " \
           f"({by_month}from {error_of(row, since)} to {error_of(row, until)} {row.unit}{little})"


def error_of_nothing(row, model):
    return row.error[model] > NEAR_NOTHING


def is_change(row, since, until):
    """Whether it is large enough, and shows in the digits that are told."""
    return abs(row.removed(since, until)) >= SMALL and error_of(row, since) != error_of(row, until)


def changes(rows, since, until):
    """"gas fell by ...; electricity stayed the same"; the largest falls first."""
    known = [row for row in rows if math.isfinite(row.removed(since, until))]
    known.sort(key=lambda row: -row.removed(since, until))
    parts = []
    moved = [row for row in known if is_change(row, since, until)]
    for verb, those in (("the error fell", [row for row in moved if row.removed(since, until) > 0]),
                        ("it rose", [row for row in moved if row.removed(since, until) < 0])):
        if those:
            parts.append(f"{verb} for {listed(change_of(row, since, until) for row in those)}")
    same = [row.channel for row in known if not is_change(row, since, until)]
    if same:
        parts.append(f"it stayed the same for {listed(same)}" if parts
                     else f"the error stayed the same for {listed(same)}")
    return "; ".join(parts)


def seen(loop):
    """What the search has seen of the period of judging."""
    if not loop.has_held_out:
        return "was calibrated on"
    return f"overlaps {loop.periods[0]}" if loop.saw_judged else "the search has not seen"


def judged(loop):
    """What the effects did to the errors where the model was judged."""
    rows = loop.judged_errors()
    n = len(loop.effects) + len(loop.functions)
    if not rows or n == 0:
        return "" if rows else "Nothing is measured there, so that there is no error."
    where = f"With {'it' if n == 1 else 'them'}, in {loop.judged}, which {seen(loop)}, " if loop.has_held_out else \
        "No readings were held out, so that nothing here shows how well the model predicts; in " \
        "training, where any effect lowers it, "
    return f"{where}{changes(rows, BEFORE, AFTER)}."


def evidence(loop, effect):
    """"1060 times what chance shows", by the step that accepted it."""
    needed = next((step.threshold for step in loop.steps if step.verdict == "accepted"
                   and step.effect.startswith(effect.name)), math.nan)
    if math.isfinite(effect.gain) and needed > 0:
        return f"{number(effect.gain / needed)} times what chance shows"
    return number(effect.gain)


def regression(loop, errors):
    """What a regression does in the period of judging."""
    rows = [row for row in loop.judged_errors() if (row.channel, row.period, row.resolution) in errors]
    if not rows:
        return ""
    said = [f"{row.channel} {fixed(errors[row.channel, row.period, row.resolution], 1)} % "
            f"(after: {error_of(row, AFTER)} %)" for row in rows]
    return "A regression on outdoor temperature and the hour of the week, fitted to the same readings, has these " \
           f"errors in {loop.judged}: {listed(said)}."


def structure(loop):
    """What the choice of the structure had done to them."""
    rows = loop.judged_errors()
    since = "from the program's nominal run to its best one" if loop.simulator.parameters else \
        f"from the plain model to the structure chosen ({loop.structure})"
    return f"Before any effect, {since}, in {loop.judged} {changes(rows, PLAIN, BEFORE)}." if rows else ""


def models(loop):
    """What plain, before and after are."""
    if loop.simulator.parameters:
        return ("the program's nominal run", "its best run without effects", "its best run with the effects found")
    return ("the calibrated standard model", "its structure chosen",
            "with the effects found and functions of what they leave")


def unexplained(loop):
    """What is left."""
    known = [channel for channel in loop.of_channels if math.isfinite(channel.unexplained)]
    known.sort(key=lambda channel: -channel.unexplained)
    large = [f"{percent(channel.unexplained)} for {channel.name}"
             + (f" ({channel.where})" if channel.where else "")
             for channel in known if channel.unexplained >= LARGE]
    if large:
        return "Not explained: of the variance that remains, hour, weekday and season still predict " + \
            listed(large) + "."
    return "Of what remains, hour, weekday and season predict less than 2 % of the variance." \
        if known else ""


def unusual_ends(loop):
    """Parameters at an end of their range, or far from their prior."""
    ends = [f"{decision.series} ({decision.finding.replace('-', '−')})" for decision in loop.decisions
            if decision.kind == OF_ENDS]
    if not ends:
        return ""
    return f"{'One ends' if len(ends) == 1 else in_words(len(ends)) + ' end'} at an end of the range or far from " \
           f"the prior: {listed(ends)}. Such a number may stand for what the description lacks, or its range " \
           "or declared value is wrong."


def can_be_seen(loop, effect):
    """Whether the data can show it."""
    return effect.detectability >= loop.least_detectability


def unseen(loop):
    return [effect.effect for effect in loop.power if not can_be_seen(loop, effect)]


def same_signatures(loop):
    return [effect for effect in loop.power if abs(effect.correlation) >= loop.same_signature]


def aliases(loop):
    """Pairs with the same signature, each once."""
    pairs = [(effect.effect, effect.alias) for effect in same_signatures(loop)
             if effect.alias_kind != OF_PARAMETERS]
    return [f"{a} and {b}" for k, (a, b) in enumerate(pairs)
            if (b, a) not in pairs[:k] and (a, b) not in pairs[:k]]


def followed(loop):
    """Effects that could be seen, and that other values of the parameters do nearly the same as."""
    return [effect.effect for effect in same_signatures(loop)
            if effect.alias_kind == OF_PARAMETERS and can_be_seen(loop, effect)]
