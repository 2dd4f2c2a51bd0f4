"""A folder in which the user's own program runs with what the loop around it found.

The files of a point as the last best run had them: templates with its parameters' values and its effects' hours, the
files that they name, effects.toml and effects.csv where templates have no place for effects. Of an EnergyPlus model
also what EnergyPlus receives, and how that differs from the model.
Nothing of the job is changed.
"""
import datetime
import math
import pathlib
import re
import subprocess
import sys

from .refused import CONFIG, FAILED, NO_INPUT, Refused

RUNNER = "energyplus_hours"           # scripts/energyplus_hours, which can write the changed model alone
ENDINGS = (".in", ".template")        # of templates, which a point's files lack
SECTION_KEYS = ("hook", "unit", "enters", "facade", "meter")
PLACE_KEYS = ("hook", "facade", "meter")


def name_of_filled(path):
    ending = next((each for each in ENDINGS if path.name.endswith(each) and path.name != each), "")
    return path.name[:len(path.name) - len(ending)] if ending else path.name


def filled(text, values):
    """`values`: {place: its text}"""
    return re.sub(r"@([A-Za-z][A-Za-z0-9_]*)@", lambda place: values.get(place[1], place[0]), text)


def quoted(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def effects_text(simulator):
    """The sections of effects.toml."""
    sections = []
    for k, one in enumerate(simulator.series, 1):
        lines = [("name", simulator.given[int(one.of)].name), *((key, getattr(one, key)) for key in SECTION_KEYS),
                 ("column", f"effect_{k}")]
        above = f"opens_above = {one.opens_above:g}\n" if math.isfinite(one.opens_above) else ""
        sections.append("[[effect]]\n" + "".join(f"{key} = {quoted(value)}\n" for key, value in lines if value) + above)
    return "\n".join(sections)


def lines_of(hours):
    return "\n".join(f"{value:.9g}" for value in hours)


def texts_of_places(simulator, section, n_hours):
    """{name: hours} of [[simulator.effect]]."""
    texts = {}
    for place in section.get("effect", []):
        where = tuple(str(place.get(key, "")) for key in PLACE_KEYS)
        hours = [0.0] * n_hours
        for one, values in zip(simulator.series, simulator.series_values):
            if tuple(getattr(one, key) for key in PLACE_KEYS) == where:
                hours = [there + more for there, more in zip(hours, values)]
        texts[str(place["name"])] = lines_of(hours)
    return texts


def hours_of(job):
    """Of all its periods."""
    n_days = 0
    for period in job.get("periods", {}).values():
        first, last = (datetime.date.fromisoformat(str(day)[:10]) for day in period)
        n_days += (last - first).days + 1
    return 24 * n_days


def write_effects(simulator, folder):
    if not simulator.series:
        return
    (folder / "effects.toml").write_text(effects_text(simulator), encoding="utf-8")
    rows = [",".join(f"effect_{k}" for k in range(1, len(simulator.series) + 1))]
    rows += [",".join(f"{value:.9g}" for value in hour) for hour in simulator.series_values.T]
    (folder / "effects.csv").write_text("\n".join(rows) + "\n", encoding="ascii")


def beside(job_folder, name):
    path = pathlib.Path(name)
    return path if path.is_absolute() else job_folder / path


def read_input(path, key):
    try:
        return path.read_bytes()
    except OSError as error:
        raise Refused(f"{path}: {error.strerror}; expected the file that the job names in simulator.{key}",
                      NO_INPUT) from None


def inputs_of(section, values, job_folder):
    """{name: bytes} of templates with the values, and of the files beside them."""
    found = {}
    for template in section.get("template", []):
        source = beside(job_folder, str(template["file"]))
        name = str(template.get("as", "")) or name_of_filled(source)
        try:
            text = read_input(source, "template").decode("utf-8")
        except UnicodeDecodeError:
            raise Refused(f"{source}: is no text in UTF-8; expected a template with places such as @name@") from None
        found[name] = filled(text, values).encode("utf-8")
    for name in section.get("files", []):
        source = beside(job_folder, str(name))
        found[source.name] = read_input(source, "files")
    return found


def patch(section, job_folder, folder):
    """What EnergyPlus would receive: the lines that the runner prints; none of another program."""
    command = [str(word) for word in section["command"]]
    runner = next((word for word in command if pathlib.Path(word).name == RUNNER), None)
    if runner is None:
        return []
    done = subprocess.run([sys.executable, beside(job_folder, runner), command[-1], "--patch-only"], cwd=folder,
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or ["it said nothing"])[-1]
        raise Refused(f"{folder}: is written, but the changed model is not: {last}; mend that and run there: {runner} "
                      f"{command[-1]} --patch-only", FAILED)
    return done.stdout.splitlines()


def adopt(loop, job, job_file, folder):
    """Writes the folder, which must be new. What is in it, a line each."""
    section = job.get("simulator")
    if section is None:
        raise Refused(f"{job_file}: has no [simulator]; expected the job that the result is of", CONFIG)
    job_folder = pathlib.Path(job_file).resolve().parent
    values = {row.name: row.after for row in loop.simulator.parameters}
    folder = pathlib.Path(folder)
    texts = {name: f"{value:.17g}" for name, value in values.items()}
    texts |= texts_of_places(loop.simulator, section, hours_of(job))
    inputs = inputs_of(section, texts, job_folder)
    folder.mkdir()
    for name, content in inputs.items():
        (folder / name).write_bytes(content)
    if "effect" not in section:
        write_effects(loop.simulator, folder)
    lines = [f"parameter {name}: {value:.4g}" for name, value in values.items()]
    lines += [f"effect {row.name}: at {row.hooks}, {row.scale:.3g} times what was found"
              for row in loop.simulator.given if row.scale]
    return lines + patch(section, job_folder, folder)
