"""What a loop found, from the result file into the files of a case."""
import csv
import io
import json
import math
import os
import pathlib

import h5py
import numpy as np

from cases.folder import CaseError
from cases.meters import CHANNELS
from report import guard, result as stored

HOUR = 3600
HELD_OUT = "held_out"
COLUMNS = {meter: column for column, (meter, _, _) in CHANNELS.items()}


def texts(group, name):
    return list(group[name].asstr()[:])


def value_record(value):
    return {"of": value.of, "unit": value.unit, "value": value.value, "interval": (value.least, value.most)}


def known(number):
    """None in place of NaN, which JSON has not."""
    return None if math.isnan(number) else number


def effect_record(effect):
    return {"name": effect.name, "hook": effect.hook, "driver": effect.driver, "shape": effect.shape,
            "gate": effect.gate, "coefficient": effect.coefficient,
            "interval": (effect.least, effect.most), "unit": effect.unit, "class": effect.members,
            "probability": known(effect.probability),
            "class_probabilities": [known(effect.probabilities.get(name, math.nan)) for name in effect.members],
            "adequate": effect.is_adequate, "gain": effect.gain, "separates": effect.separates,
            "doubt": effect.doubt, "brings": [value_record(value) for value in effect.brings]}


def setting_record(setting):
    """A setting that the readings deny, as an effect on what is described: before has it, too."""
    change = [value - setting.described for value in (setting.found, setting.least, setting.most)]
    return {"name": f"{setting.name}: {setting.found:.3g} {setting.unit}, described {setting.described:.3g}",
            "hook": setting.name, "driver": "always", "shape": "constant", "gate": "always", "coefficient": change[0],
            "interval": (change[1], change[2]), "unit": "K", "class": [setting.name], "probability": None,
            "class_probabilities": [None], "adequate": True, "gain": None,
            "separates": "a reading of it at the controller", "doubt": "", "brings": []}


def effects(loop):
    """What was found, as effects.json has it: effects, and settings that are not as described."""
    return [effect_record(effect) for effect in stored.effects_in(loop)] + \
        [setting_record(setting) for setting in stored.settings_in(loop)]


def finite(value):
    """What JSON can hold."""
    return value if math.isfinite(value) else None


def function_record(function):
    points = [{name: finite(getattr(point, name)) for name in ("at", "and_at", "value", "least", "most")}
              for point in function.points]
    return {"name": function.name, "hook": function.hook, "driver": function.driver,
            "driver_unit": function.driver_unit, "unit": function.unit, "size": finite(function.size),
            "evidence": finite(function.evidence), "points": points}


def functions(loop):
    """What was laid to functions without a name, as functions.json has it: each with its value and its
    90 % interval over what it follows."""
    return [function_record(function) for function in stored.functions_in(loop)]


def schedule_record(schedule):
    days = [{name: getattr(row, name) for name in (
        "days", "from", "until", "probability", "from_least", "from_most", "until_least", "until_most",
        "usual_from", "usual_until")} for row in schedule.hours]
    return {"name": schedule.name, "use": schedule.use, "sentence": schedule.sentence,
            "evidence": finite(schedule.evidence), "days": days}


def schedules(loop):
    """Hours that nobody wrote down, as hours.json has it."""
    return [schedule_record(schedule) for schedule in stored.schedules_in(loop)]


def decisions(loop, keys=("series", "finding", "action")):
    """What was found in the data, as decisions.json has it."""
    return [{key: getattr(decision, key) for key in keys}
            for decision in stored.decisions_in(loop)]


def stamps(begins):
    """Ends of the hours, as measured.csv writes them."""
    return np.datetime_as_string((begins.astype(np.int64) + HOUR).astype("datetime64[s]"))


def predictions(loop, model):
    """Time stamps, and {column: [n_hours]} of the held-out period."""
    row, period = texts(loop, "model").index(model), loop[HELD_OUT]
    return stamps(period["time"][:]), {
        COLUMNS.get(channel, channel): period[channel]["simulated"][row]
        for channel in texts(loop, "channel")}


def write_predictions(path, times, columns):
    with open(path, "w", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(["timestamp", *columns])
        writer.writerows([time, *(f"{value:.6g}" for value in row)]
                         for time, *row in zip(times, *columns.values()))


def write_json(path, rows):
    with open(path, "w") as out:
        json.dump(rows, out, indent=1)
        out.write("\n")


def loop_of(file, building, study):
    if not guard.has(file, f"{building}/{study}"):
        raise guard.Refused(f"{file.filename}: {building}/{study} is not there; expected the result of a loop")
    return file[building][study]


def failures(file, study):
    """{item: why it failed}; the items of a loop are its buildings, in their order."""
    group = file.get(study, ())
    if "failed_item" not in group:
        return {}
    return dict(zip(group["failed_item"][:].astype(int), texts(group, "failed_item_reason")))


def of_result(path, read):
    """What `read` makes of the open file."""
    try:
        return guard.read_apart(path, read)
    except guard.Refused as refused:
        error = CaseError(str(refused))
        error.code = refused.code
        raise error from None


def without_result(result, names, study="loop"):
    """{building: why} of those that a result lacks. `names`: of all, in the job's order."""
    def lacking(file):
        why = failures(file, study)
        return {name: why.get(item, "the run gave no reason") for item, name in enumerate(names)
                if not guard.has(file, f"{name}/{study}/model")}
    return of_result(result, lacking)


def write_files(result, building, folder, study="loop"):
    """plain.csv, before.csv, after.csv, effects.json, functions.json and decisions.json of one building; and hours.json
    where hours were learned."""
    def read(file):
        loop = loop_of(file, building, study)
        return ({model: predictions(loop, model) for model in texts(loop, "model")}, effects(loop),
                functions(loop), decisions(loop), schedules(loop))
    predicted, found, unnamed, decided, hours = of_result(result, read)
    for model, columns in predicted.items():
        write_predictions(os.path.join(folder, f"{model}.csv"), *columns)
    write_json(os.path.join(folder, "effects.json"), found)
    write_json(os.path.join(folder, "functions.json"), unnamed)
    write_json(os.path.join(folder, "decisions.json"), decided)
    if hours:
        write_json(os.path.join(folder, "hours.json"), hours)


def cut_out(result, building, others, path):
    """The result with this building only."""
    def copied(whole):
        image = io.BytesIO()
        with h5py.File(image, "w") as part:
            part.attrs.update(whole.attrs)
            for name in whole:
                if name == building or name not in others:
                    whole.copy(name, part)
        return image.getvalue()
    pathlib.Path(path).write_bytes(of_result(result, copied))
