"""How well a loop did on generated cases: from its result and the cases' truth to the bench's figures.

A case's record holds its kind, what was planted, what was found, and the errors of the held-out
year. Detectability is the power table's of the first name, scaled from the typical size to the planted.
"""
import json
import re
import sys
from dataclasses import dataclass, field

import h5py
import numpy as np
import pandas

import large_job
from change_of_errors import by_fortnight, is_worse

sys.path[:0] = [str(large_job.ROOT / "scripts"), str(large_job.ROOT / "tests" / "generator")]

from air_system import RESET, VAV                          # noqa: E402
from case_folder import COLUMNS as CHANNELS, YEAR, error   # noqa: E402
from cases import loop_result                              # noqa: E402
from effects import EFFECTS                                # noqa: E402
from loop_names import (AIR_SYSTEM, ALWAYS_THERE, CLOCK, CODE_OF, OF_AIR_HANDLER, RIGHT,  # noqa: E402
                        is_in_class, is_right)
from report.result import OF_CLASS                         # noqa: E402

DETECTABLE = 5
AIR = CHANNELS["air"]
EPW_WIND = 21            # column
LEAST_EFFECT = {True: 0.2, False: 3.0}   # of an affected channel: K for the air, points of CV(RMSE)
SMALL = 0.02                             # of a meter's energy in the year
LOOP_NAMES = {"heating": "heat", "cooling": "cold", "electricity": "electricity", "gas": "gas"}
LEAST_ENERGY = 5.0                       # of a material meter [kWh/m2 in the year]
# parameter: the truth's number it is a factor on (or an offset from)
FACTORS = {"u_wall": "u_wall", "u_roof": "u_roof", "u_window": "u_window",
           "solar_transmittance": "g_window", "absorptance": "absorptance_wall",
           "people": "people", "lights": "lights", "equipment": "equipment",
           "infiltration": "infiltration", "ventilation": "fresh_air", "fans": "fan_power",
           "heating_efficiency": "heating_efficiency", "heating_cop": "heating_cop",
           "cooling_cop": "cooling_cop"}
RESET_OF_SUPPLY = "supply temperature per outdoor temperature below 20 degC"
OFFSETS = {"heating_set_point": "heating_set", "cooling_set_point": "cooling_set"}


@dataclass
class Scored:
    name: str
    kind: str
    planted: dict
    found: list
    decisions: list
    errors: dict            # {model: {column: error}}
    closed: dict            # {(from, to): share}, NaN where no channel is affected
    detectability: dict     # planted effect -> d, NaN where the table lacks it
    parameters: dict        # {model: rms error in prior standard deviations}
    covered: list = field(default_factory=list)   # of right names with a coefficient
    values_covered: list = field(default_factory=list)   # energies that right names bring
    calibrated: dict = field(default_factory=dict)   # parameter: its value in the last model
    details: dict = field(default_factory=dict)   # planted effect: what it drew
    air_handler: str = ""   # its kind
    structure: tuple = ()   # refinements that the last model has
    oracle: dict = field(default_factory=dict)   # planted effect -> whether shapes and noise, if known, would tell it
    of_terminals: list = field(default_factory=list)   # numbers of a found unit, in prior standard deviations off
    worse: list = field(default_factory=list)    # columns whose errors rose by more than chance would make them


ODDS_OF_20 = 6    # 2 log 20: evidence that tells two names apart


def true_parameters(truth):
    """{parameter: its true value}; ventilation and fans differ by the air that is moved."""
    design, built = truth["design"], truth["built"]
    values = {name: built[own] / design[own] for name, own in FACTORS.items()}
    return values | {name: built[own] - design[own] for name, own in OFFSETS.items()}


def wind_air_change(case, found):
    """Yearly mean that found effects of the wind add [1/h]: the truth's infiltration has all of it."""
    wind = pandas.read_csv(case / "weather_train.epw", skiprows=8, header=None)[EPW_WIND]
    above = lambda effect: float(effect["shape"].split("above ")[1].split()[0]) \
        if "above " in effect["shape"] else 0.0
    return sum(effect["coefficient"] * float(np.maximum(wind - above(effect), 0).mean())
               for effect in found
               if (effect["hook"], effect["driver"]) == ("infiltration", "wind"))


def parameter_errors(loop, truth, case, found):
    true = true_parameters(truth)
    names, sd = loop_result.texts(loop, "parameter"), loop["parameter_prior_sd"][:]
    known = [k for k, name in enumerate(names) if name in true and sd[k] > 0]
    wanted = np.array([true[names[k]] for k in known])
    values = {model: loop["parameter_value"][row].astype(float)
              for row, model in enumerate(loop_result.texts(loop, "model"))}
    values["after"][names.index("infiltration")] += \
        wind_air_change(case, found) / truth["design"]["infiltration"]
    off = {model: (value[known] - wanted) / sd[known] for model, value in values.items()}
    return {model: float(np.sqrt(np.nanmean(z ** 2))) for model, z in off.items()}


def true_numbers_of_terminals(truth):
    """{name in the structure: the truth} of a handler with terminals that nobody declared."""
    handler = truth.get("structure", {}).get("air_handler", {})
    if handler.get("kind") != VAV or handler["is_declared"]:
        return {}
    return {"supply_flow": handler["supply"] * truth["design"]["storey_height"],
            "least_supply": handler["least_flow"] * handler["supply"],
            "supply_temperature": handler["supply_cold"],
            RESET_OF_SUPPLY: (handler["supply_warm"] - handler["supply_cold"]) / (RESET[1] - RESET[0])}


def errors_of_terminals(loop, truth):
    """Of the last model, where it has them."""
    names, values = loop_result.texts(loop, "parameter"), calibrated(loop)
    sd = dict(zip(names, loop["parameter_prior_sd"][:]))
    return [float((values[name] - true) / sd[name])
            for name, true in true_numbers_of_terminals(truth).items() if name in values]


def held_out(case):
    """{column: [n_hours]} of measured_test.csv."""
    table = pandas.read_csv(case / "measured_test.csv", index_col=0)
    return {column: table[column].to_numpy(float) for column in table}


def errors_of(loop, readings):
    found = {}
    for model in loop_result.texts(loop, "model"):
        _, predicted = loop_result.predictions(loop, model)
        found[model] = {column: error(column, series[:YEAR], readings[column])
                        for column, series in predicted.items() if column in readings}
    return found


def worse_of(loop, readings):
    """Columns that `after` explains worse than `before` by over 1 % and two standard errors."""
    before, after = (loop_result.predictions(loop, model)[1] for model in ("before", "after"))
    return [column for column in after if column in readings and is_worse(by_fortnight(np.array(
        [series[column][:YEAR] - readings[column][:YEAR] for series in (before, after)])))]


def affected(truth, errors):
    """Columns that planted effects move, and where energy flows. `errors`: of the truth without them."""
    size = {column: abs(errors[column] - best)
            for column, best in truth["expected_floor"].items()}
    return [column for column, by in size.items() if by >= LEAST_EFFECT[column == AIR] and
            (column == AIR or truth["held_out_kWh_m2"][column] >= LEAST_ENERGY)]


def closed(errors, truth, begin, end):
    """Mean over the affected channels of the share of the reducible error that is closed."""
    best = truth["expected_floor"]
    shares = [(errors[begin][c] - errors[end][c]) / (errors[begin][c] - best[c])
              for c in affected(truth, truth["without_effect"])
              if c in errors[end] and errors[begin][c] > best[c]]
    return float(np.mean(shares)) if shares else np.nan


def detectability(loop, truth):
    """{planted effect: d}, of the table's typical size scaled to the planted one. A lock-out's size is
    a day, and the table's season is another: of one that moves no meter nothing can be seen. Nor can
    of a capacity that moves none."""
    table = dict(zip(loop_result.texts(loop, "power_effect"), loop["power_detectability"][:]))

    def of_one(effect, size):
        if RIGHT[effect].parameter:   # the table has effects only
            return np.nan if affected(truth, truth["without_one"][effect]) else 0.0
        typical = next((table[row] for row in RIGHT[effect].rows() if row in table), np.nan)
        if RIGHT[effect].is_dated:
            moved = affected(truth, truth["without_one"][effect])
            return np.nan_to_num(typical) if moved else 0.0
        return typical * abs(size) / EFFECTS[effect].size
    return {effect: of_one(effect, size) for effect, size in truth["effects"].items()}


def oracle(loop, sizes):
    """{planted effect: whether one that knows shapes and noise would tell it, near the calibrated model}: its evidence,
    less that of the effect which looks most like it, is d^2 (1 - r^2). NaN where the table lacks it.
    `sizes`: their detectability."""
    rows = loop_result.texts(loop, "power_effect")
    kinds, r = loop_result.texts(loop, "power_alias_kind"), loop["power_alias_correlation"][:]
    likeness = {row: r[k] if kinds[k] == "effect" else 0.0 for k, row in enumerate(rows)}
    tells = {}
    for effect, d in sizes.items():
        near = [likeness[row] for row in RIGHT[effect].rows() if row in likeness]
        tells[effect] = d ** 2 * (1 - near[0] ** 2) > ODDS_OF_20 if near and not np.isnan(d) else np.nan
    return tells


def calibrated(loop):
    after = loop_result.texts(loop, "model").index("after")
    values = zip(loop_result.texts(loop, "parameter"), map(float, loop["parameter_value"][after]))
    return {name: value for name, value in values if not np.isnan(value)}


def coverage(found, planted, truth):
    """Whether the interval of the first found effect that is a planted one's right one holds the truth,
    as a list of one; [] where there is none."""
    return [effect["interval"][0] <= RIGHT[name].coefficient(size, truth) <= effect["interval"][1]
            for name, size in planted.items() if RIGHT[name].coefficient
            for effect in found if is_right(effect, name)][:1]


def value_coverage(found, planted, truth):
    """Whether the intervals of what a right name brings hold what the planted effect does: of each meter of which
    that is over SMALL of its energy."""
    columns, year = {of: CHANNELS[meter] for meter, of in LOOP_NAMES.items()}, truth.get("of_the_year", {})
    held = []
    for name in planted:
        for effect in [effect for effect in found if is_right(effect, name)][:1]:
            if effect["driver"] == "time elapsed":   # told of a whole year, and here it is of what is left of one
                continue
            for value in effect["brings"]:
                true = year.get("brings_kWh", {}).get(name, {}).get(columns.get(value["of"]))
                if true is not None and abs(true) > SMALL * year["kWh"][columns[value["of"]]]:
                    held.append(value["interval"][0] <= true <= value["interval"][1])
    return held


def score(file, case, kind):
    """The record of one case."""
    truth, loop = json.loads((case / "truth.json").read_text()), file[case.name]["loop"]
    found = loop_result.effects(loop)
    errors, planted = errors_of(loop, held_out(case)), truth["effects"]
    sizes = detectability(loop, truth)
    steps = (("plain", "before"), ("before", "after"), ("plain", "after"))
    return Scored(case.name, kind, planted, found,
                  loop_result.decisions(loop, ("series", "finding", "action", "kind")), errors,
                  {step: closed(errors, truth, *step) for step in steps},
                  sizes, parameter_errors(loop, truth, case, found),
                  coverage(found, planted, truth), value_coverage(found, planted, truth), calibrated(loop),
                  truth.get("details", {}),
                  truth.get("structure", {}).get("air_handler", {}).get("kind", ""),
                  tuple(loop_result.texts(loop, "refinement")),
                  oracle(loop, sizes), errors_of_terminals(loop, truth), worse_of(loop, held_out(case)))


def scores(result, cases):
    """`cases`: {folder: kind}; those that the result lacks are left out."""
    with h5py.File(result) as file:
        return [score(file, case, kind) for case, kind in cases.items()
                if "loop" in file.get(case.name, ())]


# --- what was right

def was_decided(scored):
    return any(CLOCK in decision["finding"].lower() for decision in scored.decisions)


def is_nearer_to_the_truth(scored, planted):
    """Of a factor on a declared capacity, on a logarithmic scale."""
    declared, true = scored.details[planted][RIGHT[planted].parameter]
    found, right = np.log(scored.calibrated[RIGHT[planted].parameter]), np.log(true / declared)
    return abs(found - right) < abs(found)


def by_parameter(scored):
    """Planted effects that calibration finds, and no search."""
    return [name for name in scored.planted if RIGHT[name].parameter]


def is_named(scored, planted):
    if RIGHT[planted].is_decision:
        return was_decided(scored)
    if RIGHT[planted].parameter:
        return is_nearer_to_the_truth(scored, planted)
    return any(is_right(effect, planted, scored.details.get(planted)) for effect in scored.found)


def put_with_parameters(scored):
    """Names of which a decision says that they and calibrated parameters are one class."""
    return {decision["series"] for decision in scored.decisions
            if decision["kind"] == OF_CLASS}


def is_put_with_parameters(scored, planted):
    """Where nothing false is found in its place; by the name of the planted form only."""
    return not false_effects(scored) and \
        bool(put_with_parameters(scored) & set(RIGHT[planted].rows()))


def is_in_a_found_class(scored, planted):
    return is_named(scored, planted) or any(
        is_in_class(effect, planted, scored.details.get(planted)) for effect in scored.found)


def is_classed(scored, planted):
    return is_in_a_found_class(scored, planted) or is_put_with_parameters(scored, planted)


def error_fell(scored):
    before, after = scored.errors["before"], scored.errors["after"]
    return sum(after[c] / before[c] for c in after) < len(after)


def always_there(scored):
    """Names that are right of the building, planted or not."""
    return ALWAYS_THERE | OF_AIR_HANDLER.get(scored.air_handler, set())


def false_effects(scored):
    """Found effects that are neither planted, nor in its class, nor always there."""
    excused = always_there(scored) if error_fell(scored) else set()
    return [effect for effect in scored.found if effect["name"] not in excused
            and not any(is_in_class(effect, name, scored.details.get(name))
                        for name in scored.planted)]


def names_said(scored):
    """[(probability, whether it is right)] of the names of all found effects' classes."""
    there, said = always_there(scored), []
    for effect in scored.found:
        for name, probability in zip(effect["class"], effect["class_probabilities"]):
            alone = {**effect, "name": name, "class": [name]}
            said.append((probability, name in there or any(
                is_right(alone, planted, scored.details.get(planted)) for planted in scored.planted)))
    return [(probability, right) for probability, right in said if probability is not None]


def has_none_of_an_air_system(scored):
    """Neither a handler, nor a planted effect that is a part of one, such as reheat."""
    return not scored.air_handler and not any(AIR_SYSTEM & set(RIGHT[name].names) for name in scored.planted)


def has_found_an_air_system(scored):
    """Whether structure or effects say that there is one."""
    return bool(AIR_SYSTEM & {*scored.structure, *(effect["name"] for effect in scored.found)})


def class_size(effect):
    return len({name for name in effect["class"] if name} | {effect["name"]})


def calendar_of(effect):
    """The country whose calendar closed days are said to follow, at a probability of 90 % or more; ""
    where none is named."""
    named = re.search("on the public holidays of ([A-Z]{2})", effect["shape"])
    return named[1] if named else ""


def is_right_calendar(scored, effect):
    """Days off that follow no country's calendar make any country wrong."""
    country = scored.details.get("moving_holidays", {}).get("country")
    return calendar_of(effect) == CODE_OF.get(country)


def is_detectable(scored):
    """Of several, the least; where the table lacks it, it is taken to be."""
    return all(not d < DETECTABLE for d in scored.detectability.values())


def is_adequate_but_wrong(scored):
    return any(effect["adequate"] for effect in false_effects(scored))
