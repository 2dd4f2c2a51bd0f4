"""A job with what its loop found.

Effects become sections [[effect]], each with a [[parameter]] for its coefficient; other hours than declared go
into their [[schedule]]; what the loop made of a parameter becomes its prior. Left out, and told: the structure that
the loop chose, which another loop chooses again, and functions.
"""
import math

import tomlkit

from . import result, words


class Mismatch(Exception):
    """The job is not the one that the result is of."""


def named(job, section):
    """The sections of a list by name."""
    return {str(row.get("name")): row for row in job.get(section, [])}


def check_same(loop, job):
    """Some parameter of the job is one of that loop, which may have calibrated some alone."""
    if not any(name in loop.parameters for name in named(job, "parameter")):
        raise Mismatch(f"has none of the parameters of {loop.stage}; expected the job that the result is of, one "
                       "building with its parameters in this file")


def rounded(number):
    """To four digits; a large one without a point."""
    number = float(f"{number:.4g}")
    return int(number) if abs(number) >= 1000 else number


def prior_of(mean, sd, least, most):
    prior = tomlkit.inline_table()
    prior.update({"kind": "normal", "mean": rounded(min(max(mean, least), most)), "sd": rounded(sd)})
    return prior


def adopt_parameter(loop, row):
    """Its posterior as its prior. Whether there is one."""
    k = loop.parameters.index(str(row["name"]))
    mean, sd = loop.value_of(result.AFTER, k), loop.sd_of(result.AFTER, k)
    if not (math.isfinite(mean) and sd > 0) or "values" in row:
        return False
    row["prior"] = prior_of(mean, sd, float(row["min"]), float(row["max"]))
    row["prior"].comment("as the loop left it")
    return True


def adopt_hours(effect, job):
    """Lines of its schedule, whose name stands between quotes in the first of them."""
    head, *lines = effect.section.splitlines()
    schedule = named(job, "schedule").get(head.split('"')[1])
    if schedule is None:
        raise Mismatch(f"has no schedule of {effect.name}: {effect.shape}")
    for key, values in tomlkit.parse("\n".join(lines)).items():
        schedule[key] = list(values)
        schedule[key].comment("found by the loop")
    return f"hours of the schedule {schedule['name']}: {effect.shape}"


def what_is_said(loop, effect):
    doubt = "" if effect.is_adequate else f"; NOT adequate: {effect.doubt or 'the nearest name'}"
    refute = f"; what would tell: {effect.separates}" if effect.separates else ""
    return f"found by the loop, evidence {words.number(effect.gain)}{doubt}{refute}"


def append(job, section, row):
    if section not in job:
        job.append(section, tomlkit.aot())
    job[section].append(row)


def adopt_effect(loop, effect, job):
    if effect.section.startswith("#"):
        return adopt_hours(effect, job)
    sections = tomlkit.parse(effect.section)
    name = str(sections["effect"][0]["name"])
    if name in named(job, "effect"):
        raise Mismatch(f"has an effect \"{name}\" already")
    for section in ("effect", "parameter"):
        for found in sections.get(section, []):
            row = tomlkit.table()
            if section == "effect":
                row.add(tomlkit.comment(what_is_said(loop, effect)))
            for key, value in found.items():
                row.add(key, value)
            row.add(tomlkit.nl())
            append(job, section, row)
    return f"effect {name}: {effect.shape}"


def left_out(loop):
    lines = [f"effect {effect.name}: it follows the model's own loads" for effect in loop.effects if not effect.section]
    if loop.structure not in ("", "standard"):
        lines.append(f"the structure {loop.structure}: another loop chooses it again")
    if loop.functions:
        lines.append(f"{len(loop.functions)} functions without a name: another loop finds them again")
    return [f"left out: {line}" for line in lines]


def adopt_parameters(loop, job):
    n = sum(adopt_parameter(loop, row) for row in job["parameter"] if str(row["name"]) in loop.parameters)
    return f"priors of {n} parameters: for new readings, since these are in them"


def adopt(loop, job, keeps_priors=False):
    """Changes the job. What was adopted and what was left out, a line each."""
    check_same(loop, job)
    lines = [] if keeps_priors else [adopt_parameters(loop, job)]
    lines += [adopt_effect(loop, effect, job) for effect in loop.effects if effect.section]
    return lines + left_out(loop)
