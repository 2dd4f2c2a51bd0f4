"""A job with what its loop found.

Effects become sections [[effect]], each with a [[parameter]] for its coefficient; so do functions, which have values
in its place. The structure that was chosen stands in `structure`, hours in their [[schedule]]. What the loop made of
a parameter becomes its value and its prior. Left out, and told: an effect that its result has no section of.
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
    """The building's name, and some parameter of the job is one of that loop, which may have calibrated some alone."""
    if str(job.get("name", loop.building)) != loop.building:
        raise Mismatch(f"is of \"{job['name']}\", and the result of \"{loop.building}\"; expected the job that the "
                       "result is of")
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


def put_after(before, key, value, table):
    """tomlkit's own way would put it behind comments of the section that follows."""
    if key in table:
        table[key] = value
    else:
        table.value._insert_after(before, key, tomlkit.item(value))


def adopt_parameter(loop, row, keeps_priors):
    """Its value where the loop left it, and its posterior as its prior."""
    k = loop.parameters.index(str(row["name"]))
    mean, sd = loop.value_of(result.AFTER, k), loop.sd_of(result.AFTER, k)
    if not math.isfinite(mean):
        return
    put_after("values" if "values" in row else "max", "value", mean, row)
    row["value"].comment("as the loop left it")
    if keeps_priors or not sd > 0 or "values" in row:
        return
    row["prior"] = prior_of(mean, sd, float(row["min"]), float(row["max"]))
    row["prior"].comment("as the loop left it")


def adopt_hours(section, job):
    """Lines of its schedule, whose name stands between quotes in the first of them."""
    head, *lines = section.splitlines()
    name = head.split('"')[1]
    schedule = named(job, "schedule").get(name)
    if schedule is None:
        raise Mismatch(f"has no schedule \"{name}\"")
    for key, values in tomlkit.parse("\n".join(lines)).items():
        put_after("name", key, list(values), schedule)
        schedule[key].comment("found by the loop")
    for key in ("hours", "use"):
        schedule.pop(key, None)
    return f"hours of schedule {name}"


def what_is_said(loop, effect):
    doubt = "" if effect.is_adequate else f"; NOT adequate: {effect.doubt or 'the nearest name'}"
    refute = f"; what would tell: {effect.separates}" if effect.separates else ""
    return f"found by the loop, evidence {words.number(effect.gain)}{doubt}{refute}"


def append(job, section, found, comment):
    """A table of a list at the end of the job."""
    if section not in job:
        job.append(section, tomlkit.aot())
    row = tomlkit.table()
    row.add(tomlkit.comment(comment))
    for key, value in found.items():
        row.add(key, value)
    row.add(tomlkit.nl())
    job[section].append(row)


OF_STRUCTURE = "of the structure that the loop chose"
STRIKES = "; to strike it, set its coefficient to 0 and strike its parameter: without this section structure brings it"


def adopt_sections(section, comment, job):
    """All tables of a section. The names of its effects."""
    tables = tomlkit.parse(section)
    for kind in ("effect", "parameter"):
        for found in tables.get(kind, []):
            if found["name"] in named(job, kind):
                raise Mismatch(f"has {'an' if kind == 'effect' else 'a'} {kind} \"{found['name']}\" already")
            more = STRIKES if kind == "effect" and comment == OF_STRUCTURE else ""
            append(job, kind, found, comment + more)
    return [str(effect["name"]) for effect in tables.get("effect", [])]


def adopt_effect(loop, effect, job):
    if effect.section.startswith("#"):
        return f"{adopt_hours(effect.section, job)}: {effect.shape}"
    name, = adopt_sections(effect.section, what_is_said(loop, effect), job)
    return f"effect {name}: {effect.shape}"


def believe_as_before(loop, row):
    """The structure's prior in place of its posterior."""
    before = {parameter.name: parameter for parameter in loop.of_parameters}.get(str(row["name"]))
    if before is not None:
        row["prior"].update({"mean": before.mean, "sd": before.sd})


def parameter_in(section):
    return str(tomlkit.parse(section)["parameter"][0]["name"])


def adopt_structure(loop, job, keeps_priors):
    """The refinements by name, their numbers as parameters, their effects."""
    names = [refinement.name for refinement in loop.refinements]
    if not names:
        return []
    own = named(job, "parameter")
    job["structure"] = names
    job["structure"].comment("chosen by the loop")
    for part in loop.job_parts:
        if part.of == "structure" and parameter_in(part.section) not in own:   # else its value is set
            adopt_sections(part.section, OF_STRUCTURE, job)
    for row in job["parameter"] if keeps_priors else []:
        if str(row["name"]) not in own:
            believe_as_before(loop, row)
    return [f"structure: {' + '.join(names)}"]


def adopt_functions(loop, job):
    return [f"{name}: without a name, as values at points"
            for part in loop.job_parts if part.of == "functions"
            for name in adopt_sections(part.section, "found by the loop: it says where and when, not why", job)]


def left_out(loop):
    """What an older result found and has no section of: effects and functions of the model's own loads."""
    said = "".join(part.section for part in loop.job_parts if part.of == "functions")
    lines = [f"effect {effect.name}" for effect in loop.effects if not effect.section]
    lines += [f"function {function.name}" for function in loop.functions
              if function.driver in ("heating load", "cooling load") and f'"{function.driver}"' not in said]
    return [f"left out: {line}: the result has no section of it; run its loop again" for line in lines]


def adopt_parameters(loop, job, keeps_priors):
    rows = [row for row in job["parameter"] if str(row["name"]) in loop.parameters]
    for row in rows:
        adopt_parameter(loop, row, keeps_priors)
    if keeps_priors:
        return f"values of {len(rows)} parameters"
    return f"values and priors of {len(rows)} parameters: for new readings, since these are in them"


def adopt(loop, job, keeps_priors=False):
    """Changes the job. What was adopted and what was left out, a line each. Functions stand first among the effects, as
    they did in the loop: where effects do not add up, each acts on what stands before it."""
    check_same(loop, job)
    functions = adopt_functions(loop, job)
    lines = [adopt_parameters(loop, job, keeps_priors)]
    lines += adopt_structure(loop, job, keeps_priors)
    lines += [adopt_hours(part.section, job) for part in loop.job_parts if part.of == "hours"]
    lines += [adopt_effect(loop, effect, job) for effect in loop.effects if effect.section]
    return lines + functions + left_out(loop)
