#!/usr/bin/python3
"""Does an effect do in the patched EnergyPlus model, hour by hour, what the twin foretells of it?

    bench_energyplus_patch.py [--only NAME ...] [--folder DIR]

The small office of jobs/energyplus_office. Its twin (the job's own building) is fitted to EnergyPlus's run by a loop
that seeks no effects, and adopted. Each row of the hooks' table (scripts/energyplus/effects.py) then has an effect that
enters both: as an hourly series by scripts/energyplus_hours, and as an [[effect]] of the twin, or as other hours in its
[[schedule]]. What the meters do more or less than without it is compared over the hours of two years. Prints for each
row the correlation at the meter that moves most, by its standard deviation, and the size that EnergyPlus shows for one
of the twin (least squares through 0); then `name value unit reference ratio` lines. The patched model as it is
handed over (--patch-only, IDF) is run, too: severe errors are counted. Left out: rows that this office cannot show.
Needs EnergyPlus 25.2 on PATH or in ENERGYPLUS_DIR; without it nothing is measured. It takes some minutes.
"""
import argparse
import csv
import datetime
import gzip
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from dataclasses import dataclass, field

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "scripts"))
sys.dont_write_bytecode = True

from energyplus import effects, program as energyplus  # noqa: E402  (found above)

JOB = ROOT / "jobs" / "energyplus_office"
RUNNER = ROOT / "scripts" / "energyplus_hours"
PROGRAM = os.environ.get("BEMCAL_PROGRAM", str(ROOT / "build" / "release" / "bemcal-batch"))
METERS = ("electricity", "gas", "room")
COLUMNS = {"electricity_kwh": "electricity", "gas_kwh": "gas", "room_degc": "room"}   # the job's, and ours
BEGIN, N_HOURS = datetime.datetime(2021, 1, 1), 2 * 8760
ASKED = 0.9                     # correlation over the hours
TIMES = [BEGIN + datetime.timedelta(hours=k) for k in range(N_HOURS)]
CLOCK = np.array([time.hour for time in TIMES])


@dataclass(frozen=True)
class Case:
    """An effect of a hook: its size in some hours of every day, as EnergyPlus and as the twin has it."""
    hook: str
    size: float
    hours: tuple = ()           # from, until; () = all
    more: dict = field(default_factory=dict)    # of its section in effects.toml
    twin: dict = field(default_factory=dict)    # of its [[effect]]
    days: tuple = ()            # first and last (month, day) of every year
    of: str = ""                # schedule of the job: a size times what stands there
    schedule: str = ""          # of the job, which changes by `size` in `hours` of workdays instead
    lacks: str = ""             # what the twin has not, where both cannot agree

    def series(self):
        if self.schedule:
            return self.size * np.array([is_on(time, self.hours) for time in TIMES])
        acts = (CLOCK >= self.hours[0]) & (CLOCK < self.hours[1]) if self.hours else np.ones(N_HOURS)
        if self.days:
            acts = acts * np.array([self.days[0] <= (time.month, time.day) <= self.days[1] for time in TIMES])
        return self.size * acts * (declared(self.of) if self.of else 1)


def is_on(time, hours):
    """Whether a schedule by the wall clock of the EU is within these hours of a workday."""
    wall = time + datetime.timedelta(hours=last_sunday(time.year, 3) <= time < last_sunday(time.year, 10))
    return wall.weekday() < 5 and hours[0] <= wall.hour < hours[1]


def declared(schedule):
    """Hours of one of the job's schedules, which is 0 at weekends."""
    job = tomllib.loads((JOB / "energyplus_office.toml").read_text())
    of_day = next(each["weekdays"] for each in job["schedule"] if each["name"] == schedule)
    return sum(value * np.array([is_on(time, (hour, hour + 1)) for time in TIMES])
               for hour, value in enumerate(of_day) if value)


def last_sunday(year, month):
    """2:00 of standard time in Central Europe, when clocks change."""
    last = datetime.datetime(year, month, 31, 2)
    return last - datetime.timedelta(days=(last.weekday() + 1) % 7)


EVENING, DAY, NIGHT, WINTER = (18, 22), (8, 18), (0, 6), ((1, 1), (3, 31))
# Where both cannot agree.
STORAGE = "walls of EnergyPlus pass heat on hours later; the twin's at once"
SUN_LATER = "the twin's walls let the sun in eight hours later, EnergyPlus's follow the hours that act"
ONE_ROOM = "two rooms with a thermostat each are one room in the twin"
CASES = {
    "outdoor_air": Case("outdoor air", 2, DAY),
    "supply_air": Case("supply air", 3, DAY),
    "opaque_boundary": Case("opaque boundary", 4, DAY),
    "window_boundary": Case("window boundary", 3, DAY),
    "infiltration": Case("infiltration", 0.5, EVENING),
    "infiltration_less": Case("infiltration", -0.2, EVENING),
    "leakage": Case("leakage", 0.5, EVENING),
    "ventilation": Case("ventilation", 0.4, of="ventilation"),
    "ventilation_less": Case("ventilation", -0.4, of="ventilation"),
    "venting": Case("venting", 2, more={"opens_above": 23}, twin={"at": 23}),
    "opaque_conductance": Case("opaque conductance", 0.2, lacks=STORAGE),
    "opaque_conductance_winter": Case("opaque conductance", 0.2, days=WINTER),
    "opaque_conductance_hours": Case("opaque conductance", 0.2, DAY, lacks=SUN_LATER),
    "window_conductance": Case("window conductance", 0.2),
    "window_conductance_winter": Case("window conductance", -0.3, days=WINTER),
    "window_conductance_hours": Case("window conductance", -0.3, (18, 24), lacks=ONE_ROOM),
    "neighbour": Case("neighbour", 0.2, more={"temperature": 16}, twin={"driver": "constant temperature", "at": 16}),
    "aperture": Case("aperture", -0.3),
    "aperture_south": Case("aperture", -0.3, more={"facade": "south facade"}, twin={"facade": "south"}),
    "heat_recovery": Case("heat recovery", 0.5),
    "gains": Case("gains", 5, EVENING),
    "gains_less": Case("gains", -3, DAY),
    "loads": Case("loads", -0.3),
    "lights_and_equipment": Case("lights and equipment", 4, EVENING),
    "lights_and_equipment_less": Case("lights and equipment", -2, DAY),
    "heating_set_point": Case("heating set-point", 2, EVENING),
    "cooling_set_point": Case("cooling set-point", -1.5, DAY),
    "heating_available": Case("heating available", -0.9, NIGHT),
    "cooling_available": Case("cooling available", -0.9, (12, 15)),
    "operation": Case("operation", 1, EVENING, schedule="heating"),
    "occupation": Case("occupation", 0.5, EVENING, schedule="equipment"),
    "occupation_of_people": Case("occupation", 0.5, EVENING, schedule="people"),
    "plant_operation": Case("plant operation", 1, EVENING, schedule="ventilation"),
    "heating_efficiency": Case("heating efficiency", -0.1),
    "cooling_cop": Case("cooling COP", -0.1),
    "meter_addition": Case("meter addition", 2, EVENING, more={"meter": "gas"}, twin={"meter": "gas"}),
    "meter_factor": Case("meter factor", 0.1, more={"meter": "gas"}, twin={"meter": "gas"}),
}
NOT_SHOWN = {"second mass": "it is no hourly series", "economiser": "ideal loads without a limit of cooling air",
             "supply temperature": "the office has no air loop"}


def toml_lines(keys):
    return "".join(f"{key} = {json.dumps(value)}\n" for key, value in keys.items())


# EnergyPlus

def write_run(folder, case):
    """run.json of the model as it is, and the effect beside it."""
    job = tomllib.loads((JOB / "energyplus_office.toml").read_text())
    for name in job["simulator"]["files"]:
        if not (folder / name).exists():
            (folder / name).symlink_to((JOB / name).resolve())
    text = (JOB / "run.json.in").read_text()
    for each in job["simulator"]["parameter"]:
        text = text.replace(f"@{each['name']}@", str(each["nominal"]))
    (folder / "run.json").write_text(text)
    if case is None:
        return
    section = {"name": "it", "hook": case.hook, "unit": "-", "enters": "add", "column": "c", **case.more,
               **({"schedule": case.schedule} if case.schedule else {})}
    (folder / "effects.toml").write_text("[[effect]]\n" + toml_lines(section))
    (folder / "effects.csv").write_text("c\n" + "".join(f"{value:g}\n" for value in case.series()))


def call(folder, *words):
    done = subprocess.run([RUNNER, folder / "run.json", *words], capture_output=True, text=True, check=False)
    if done.returncode or (folder / "effects_left_out.txt").exists():
        raise SystemExit(f"{folder.name}: {done.stdout}{done.stderr}")
    return done.stdout


def simulate(folder, case=None):
    """({meter: hours}, count of severe errors) with the effect of a case."""
    folder.mkdir(parents=True)
    write_run(folder, case)
    severe = "severe error" in call(folder)
    with open(folder / "hours.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in METERS}, severe + severe_as_handed(folder)


def severe_as_handed(folder):
    """Severe errors of the patched IDF of one year, run as it lies there."""
    call(folder, "--patch-only")
    weather = folder / "weather.epw"
    weather.write_bytes(gzip.decompress((JOB / "weather_2021.epw.gz").read_bytes()))
    run = folder / "run_2021"
    idf = folder / "office-effects-2021.idf"
    done = energyplus.run([energyplus.find_program(), "-d", run, "-w", weather, idf], folder)
    return bool(done.returncode) or bool(energyplus.severe_of(run))


# The twin

def bemcal(folder, *words):
    done = subprocess.run([PROGRAM, *map(str, words)], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode > 1:
        raise SystemExit(f"{' '.join(map(str, words))}: {done.stdout[-500:]}{done.stderr}")


def fit_twin(folder, hours):
    """Text of the job's building, fitted to these hours."""
    folder.mkdir()
    for name in JOB.glob("weather_*.epw.gz"):
        (folder / name.name).symlink_to(name.resolve())
    with open(folder / "hours.csv", "w", encoding="ascii") as file:
        file.write(f"time,{','.join(COLUMNS)}\n")
        for k, time in enumerate(TIMES):
            values = ",".join(f"{hours[name][k]:.6g}" for name in COLUMNS.values())
            file.write(f"{time:%Y-%m-%d %H:%M},{values}\n")
    text = (JOB / "energyplus_office.toml").read_text().partition("\n[simulator]")[0]
    text = re.sub(r'file = "measured\S+"', 'file = "hours.csv"', text)
    text = text.replace('kind = "loop"', 'kind = "loop"\nmost_effects = 0\nfunctions = false')
    (folder / "twin.toml").write_text(text)
    bemcal(folder, "run", "twin.toml", "-o", "twin.h5", "--no-report")
    bemcal(folder, "adopt", "twin.h5", "twin.toml", "-o", "fitted.toml")
    fitted = re.sub(r"\[\[study\]\]\n(\w+ = .*\n)+", "", (folder / "fitted.toml").read_text())
    return re.sub(r"^seed = .*\n", "", fitted, flags=re.MULTILINE)   # those two are of a job, not of a building


def with_other_hours(text, case):
    """The twin's text, one of its schedules changed on workdays."""
    start = text.index(f'name = "{case.schedule}"')
    line = re.compile(r"weekdays = \[(.*?)\]").search(text, start)
    values = [float(value) for value in line[1].split(",")]
    first, until = case.hours
    values[first:until] = [value + case.size for value in values[first:until]]
    return text[:line.start()] + f"weekdays = {values}" + text[line.end():]


def twin_of(text, case):
    if case.schedule:
        return with_other_hours(text, case)
    keys = {"name": "it", "hook": case.hook, "coefficient": case.size, **case.twin}
    if case.days:
        keys["days"] = ["/".join(f"{month:02}-{day:02}" for month, day in case.days)]
    return text + "\n[[effect]]\n" + toml_lines(keys | ({"hours": list(case.hours)} if case.hours else {}))


def foretell(folder, text, cases):
    """{case: {meter: hours}} of the twin; None: without an effect."""
    files = {"plain": text, **{name: twin_of(text, case) for name, case in cases.items()}}
    for name, of_twin in files.items():
        (folder / f"{name}.toml").write_text(of_twin)
    listed = json.dumps([f"{name}.toml" for name in files])
    (folder / "all.toml").write_text(f'seed = 1\nbuildings = {listed}\n\n[[study]]\nkind = "screening"\nn_points = 1\n')
    bemcal(folder, "run", "all.toml", "-o", "all.h5", "--no-report")
    with h5py.File(folder / "all.h5") as file:
        return {name: {meter: np.concatenate([file[f"{name}/screening/{period}/{meter}/simulated"][0]
                                              for period in ("training", "held_out")]) for meter in METERS}
                for name in files}


# Both

def compare(name, case, before, after, twin_before, twin_after):
    """The row's correlation at the meter that moves most, and sizes at all."""
    moved = {meter: (after[meter] - before[meter], twin_after[meter] - twin_before[meter]) for meter in METERS}
    most = max(METERS, key=lambda meter: np.sqrt(np.mean(moved[meter][0] ** 2)) / before[meter].std())
    told = {}
    for meter, (ours, theirs) in moved.items():
        if ours.std() > 0 and theirs.std() > 0:
            size = (ours @ theirs) / (theirs @ theirs)
            told[meter] = (np.corrcoef(ours, theirs)[0, 1], size, ours.sum(), theirs.sum())
    rest = ", ".join(f"{meter}{'*' if meter == most else ''} r {r:.3f} size {size:.2f} sums {a:.0f} {b:.0f}"
                     for meter, (r, size, a, b) in told.items())
    print(f"# {name}: {rest}" + (f"; {case.lacks}" if case.lacks else ""), flush=True)
    return told[most][:2]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--only", nargs="*", default=list(CASES), choices=list(CASES))
    parser.add_argument("--folder", type=pathlib.Path)
    args = parser.parse_args()
    shown = {case.hook.lower() for case in CASES.values()} | set(NOT_SHOWN)
    assert shown == {hook for hook in effects.HOOKS if not hook.startswith("schedule of")}, shown
    folder = args.folder or pathlib.Path(tempfile.mkdtemp())
    try:
        measure({name: CASES[name] for name in args.only}, folder)
    finally:
        if not args.folder:
            shutil.rmtree(folder)


def measure(cases, folder):
    before, n_severe = simulate(folder / "energyplus" / "plain")
    twins = foretell(folder / "twin", fit_twin(folder / "twin", before), cases)
    found = {}
    for name, case in cases.items():
        after, severe = simulate(folder / "energyplus" / name, case)
        n_severe += severe
        found[name] = compare(name, case, before, after, twins["plain"], twins[name])
    for name, (r, size) in found.items():
        print(f"energyplus_patch_{name} {r:.3f} r {ASKED} {r / ASKED:.2f}")
    print(f"energyplus_patch_size {np.median([size for _, size in found.values()]):.2f} - 1 -")
    print(f"energyplus_patch_severe {n_severe} runs 0 -")
    n_agree = sum(r >= ASKED for r, _ in found.values())
    print(f"energyplus_patch_agree {n_agree} of_{len(found)} {len(found)} {n_agree / len(found):.2f}")
    for hook, why in NOT_SHOWN.items():
        print(f"# not shown: {hook}: {why}")


if __name__ == "__main__":
    main()
