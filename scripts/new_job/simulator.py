"""The sections and files by which a job also runs the user's own EnergyPlus model: `new --idf FILE --simulator`.

Beside JOB.toml lie JOB_model.epJSON (a copy; IDF is converted by EnergyPlus), JOB_run.json.in (where parameters' values
belong) and JOB_periods.csv. Parameters are those of the usual ones that move something in the model. Ranges are
judgement: how far a modeller's numbers are wrong. Leaves out runs: nothing is simulated here.
"""
import csv
import io
import json
import os
import pathlib
import tempfile
from dataclasses import dataclass

from energyplus import hours, parameters, program, runner
from energyplus.changes import Changes
from energyplus.failed import Failed
from new_job import idf_job
from new_job.job import path_from, section
from new_job.refused import DATA, EXISTS, NO_INPUT, USAGE, Refused

COMMAND = pathlib.Path(__file__).resolve().parents[1] / "energyplus_hours"
PYTHON = "/usr/bin/python3"
TIME_LIMIT = 3600              # s; a year of a large model takes minutes
HOURS_OF_YEAR = 8760
PROBE = 1.1                    # value at which a parameter is tried


@dataclass(frozen=True)
class Usual:
    unit: str
    least: float
    most: float
    nominal: float
    says: str


USUAL = {
    "infiltration": Usual("-", 0.3, 3, 1, "factor on infiltration"),
    "outdoor_air": Usual("-", 0.3, 2, 1, "factor on outdoor air and ventilation"),
    "lights": Usual("-", 0.4, 1.8, 1, "factor on lights"),
    "equipment": Usual("-", 0.3, 3, 1, "factor on equipment"),
    "people": Usual("-", 0.3, 2, 1, "factor on people"),
    "u_walls": Usual("-", 0.6, 1.8, 1, "factor on U of outer walls, by their insulating layer"),
    "u_roof": Usual("-", 0.6, 1.8, 1, "factor on U of roofs, or of ceilings below an attic"),
    "u_windows": Usual("-", 0.6, 1.5, 1, "factor on U of windows"),
    "g_windows": Usual("-", 0.5, 1.3, 1, "factor on g of windows: blinds and shade"),
    "heating_set_point": Usual("K", -3, 3, 0, "shift of heating set-points"),
    "cooling_set_point": Usual("K", -3, 3, 0, "shift of cooling set-points"),
    "heating_efficiency": Usual("-", 0.7, 1.15, 1, "factor on efficiency of boilers and coils"),
    "cooling_cop": Usual("-", 0.5, 1.5, 1, "factor on COP of coils and chillers"),
}
# What the job's schedules drive in the model: {schedule: hook of energyplus.effects}.
DRIVES = {"people": "schedule of people", "lights": "schedule of lights", "equipment": "schedule of equipment",
          "infiltration": "schedule of infiltration", "ventilation": "schedule of ventilation",
          "heating": "heating set-point", "cooling": "cooling set-point"}
IN_KELVIN = ("heating", "cooling")


def beside(job, ending):
    return pathlib.Path(job).with_name(pathlib.Path(job).stem + ending)


@dataclass
class Simulator:
    """What is written beside the job: {path: text}, and the job's sections."""
    files: dict
    sections: list


def check_version(path):
    """Before all else is read: what another version calls otherwise would be told as a mistake."""
    try:
        found = program.find_program()
    except Failed:
        return                     # is told when the model is read
    if not pathlib.Path(path).is_file():
        return                     # likewise
    try:
        program.check_version(path, program.version_in(path), found)
    except Failed as error:
        raise Refused(f"--simulator: {program.without_a_job(error)}", DATA) from None


def read_model(options, told):
    """(Model as epJSON, program); the program may be absent where nothing has to be converted."""
    try:
        found = program.find_program()
        with tempfile.TemporaryDirectory() as folder:
            model = program.read_model(found, options.idf, folder)
        model.path = options.idf       # the user's, and no copy of it
        return model, found
    except Failed as error:
        said = program.without_a_job(error)
        if not options.idf.lower().endswith(".idf") and "was not found" in said:
            told.check(f"--simulator: {said}; its version was not compared")
            return program.read_epjson(options.idf), ""
        raise Refused(f"--simulator: {said}", NO_INPUT if "not found" in said else DATA) from None


def files_of_schedules(model, source):
    """[paths] of what the model's schedules read; the model names them as they lie in a point's folder."""
    found = []
    for kind in runner.FILES:
        for name, fields in model.all(kind):
            path = pathlib.Path(source).parent / fields.get("file_name", "")
            if not path.is_file():
                raise Refused(f"{source}: {kind} {name!r}: file_name: {path} is no file; expected the one it reads",
                              NO_INPUT)
            fields["file_name"] = path.name
            found.append(str(path))
    return list(dict.fromkeys(found))


def plant_of(first, model):
    """What turns heat and cold of ideal loads into the meters' energy, but where the model says it."""
    if not any(model.all(kind) for kind in hours.IDEAL):
        return {}
    plant, own = first.plant, hours.own_fuels(model)
    said = {"heating": {"heating_carrier": plant.heating, "heating_efficiency": round(plant.efficiency, 3)},
            "cooling": {"cooling_carrier": plant.cooling or "none", "cooling_cop": round(plant.cop, 3)}}
    return {key: value for mode, keys in said.items() if mode not in own for key, value in keys.items()}


def parameters_of(model, plant, told):
    """Names of those that move something."""
    found = []
    for name in USUAL:
        tried = model.copy()
        try:
            parameters.apply(tried, {name: PROBE}, [], Changes(tried, HOURS_OF_YEAR), hours.plant_of(tried, plant))
        except parameters.NothingChanges:
            told.leave_out(f"simulator's parameter {name}: {model.path} has nothing that it changes")
            continue
        except Failed as error:
            told.leave_out(f"simulator's parameter {name}: {error}")
            continue
        found.append(name)
    return found


def schedules_of(first):
    """{schedule of the job: what it drives, and by how much from 0 to 1}"""
    made = {}
    for name, profile in idf_job.profiles(first.model.whole).items():
        if name in DRIVES and not idf_job.is_constant(profile):
            value, low = idf_job.span_of(name, profile)
            made[name] = {"hook": DRIVES[name], "span": round(value - low, 3) if name in IN_KELVIN else 1}
    return made


def run_text(first, model_file, periods_file, names, plant, found):
    """run.json, with @NAME@ where a value belongs."""
    weather = [os.path.basename(file) for file in first.weather.files]
    given = {"energyplus": str(found), "model": model_file, "weather": weather, "periods": periods_file,
             "meters": [{"name": meter.name, "quantity": meter.quantity} for meter in first.meters],
             "plant": plant, "schedules": schedules_of(first), "parameters": {name: f"@{name}@" for name in names}}
    text = json.dumps(given, indent=1)
    for name in names:
        text = text.replace(f'"@{name}@"', f"@{name}@")
    return text + "\n"


def periods_text(first):
    lines = io.StringIO()
    rows = csv.writer(lines, lineterminator="\n")
    rows.writerow(("period", "first", "last"))
    rows.writerow(("training", *map(str, first.periods.training)))
    rows.writerow(("held_out", *map(str, first.periods.held_out)))
    return lines.getvalue()


def sections_of(first, files, periods_file, template, names):
    yield section("[simulator]", ("command", [PYTHON, str(COMMAND), "run.json"], "runs the EnergyPlus model"),
                  ("files", files), ("periods", periods_file, "of them those that a run is needed for"),
                  ("time_limit", TIME_LIMIT, "s, of all periods of a point"))
    yield section("[[simulator.template]]", ("file", template), ("as", "run.json"))
    for name in names:
        usual = USUAL[name]
        yield section("[[simulator.parameter]]", ("name", name), ("unit", usual.unit, usual.says),
                      ("min", usual.least), ("max", usual.most), ("nominal", usual.nominal, "the model as it is"))
    for meter in first.meters:
        yield section("[[simulator.hourly]]", ("meter", meter.name), ("file", "hours.csv"), ("column", meter.name))


def check_names(paths):
    names = [os.path.basename(path) for path in paths]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice:
        raise Refused(f"--simulator: two files are called {twice}, and they are linked into one folder; rename one",
                      USAGE)


def simulator_of(first):
    options, told = first.options, first.told
    if not first.weather.is_epw:
        raise Refused("--simulator: EnergyPlus reads weather as EPW only; expected --weather FILE.epw", USAGE)
    model, found = read_model(options, told)
    linked = [*first.weather.files, *files_of_schedules(model, options.idf)]
    check_names(linked)
    plant = plant_of(first, model)
    moved = parameters_of(model, plant, told)
    model_file, run_file, periods_file = (beside(options.job, ending)
                                          for ending in ("_model.epJSON", "_run.json.in", "_periods.csv"))
    tell_differences(first, model)
    files = [model_file.name, periods_file.name, *(path_from(options.job, file) for file in linked)]
    return Simulator(
        {model_file: model.text(), periods_file: periods_text(first),
         run_file: run_text(first, model_file.name, periods_file.name, moved, plant, found)},
        list(sections_of(first, files, periods_file.name, run_file.name, moved)))


def tell_differences(first, model):
    """Of the calendar, which the job and the model have each of their own."""
    if not model.all("RunPeriodControl:SpecialDays"):
        first.told.check("simulator: the model has no RunPeriodControl:SpecialDays, so that it works on holidays; "
                         "the job does not")
    summer = idf_job.job.summer_time_of(first.options.country, first.options.state) != "none"
    if summer and not model.all("RunPeriodControl:DaylightSavingTime"):
        first.told.check("simulator: the model has no RunPeriodControl:DaylightSavingTime; the job's schedules have "
                         "summer time")


def check_places(options, files):
    """New files, and no inputs."""
    for path in files:
        if path.exists() and any(os.path.exists(each) and os.path.samefile(path, each) for each in options.inputs):
            raise Refused(f"{path}: is an input, too; give the job another name", EXISTS)
        if path.exists() and not options.force:
            raise Refused(f"{path}: is there already; --force writes over it", EXISTS)
