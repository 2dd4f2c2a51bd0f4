#!/usr/bin/python3
"""A loop around EnergyPlus: a user's model, and readings of the same with other values of parameters and one effect.

    bench_energyplus_loop.py [--model NAME] [--idf FILE] [--alone] [--only CASE ...] [--seed S] [--runs N] [--ranks R]
                             [--folder DIR]

With --alone the loop runs on the building that `new --idf` reads from the file, without EnergyPlus: a building of DOE
as another simulator has it. Models are the office of jobs/energyplus_office, whose job is the shipped one, and
buildings of DOE, of which `new --idf --simulator` writes the job; their files are in the package pyenergyplus-lbnl
beside EnergyPlus, or given by --idf. The weather is the shipped one. Readings are EnergyPlus's own, with an effect that no description has, by
scripts/energyplus_hours, with noise of 1.5 % and 0.05 K. Prints for each case what was found and
`name value unit reference ratio` lines: effects at the right place, false ones, held-out errors of `after` and of
`before` over those of the true building (EnergyPlus with the true values: noise alone), minutes of the longest case.
Needs EnergyPlus 25.2 on PATH or in ENERGYPLUS_DIR; without it nothing is measured. A case takes some minutes, of a
building of DOE around EnergyPlus an hour.
"""
import argparse
import gzip
import importlib.machinery
import importlib.util
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
for folder in (ROOT / "scripts", ROOT / "tests" / "generator", ROOT / "tests" / "energyplus", ROOT / "bench"):
    sys.path.insert(0, str(folder))
sys.dont_write_bytecode = True

import reports                                              # noqa: E402
from energyplus import program                              # noqa: E402
from report.result import AFTER, BEFORE, read as read_loop   # noqa: E402

JOB = ROOT / "jobs" / "energyplus_office"
MAKER = ROOT / "tests" / "generator" / "make_energyplus_office"
PROGRAM, NEW = ROOT / "build" / "release" / "bemcal-batch", ROOT / "scripts" / "new"
SPREAD = {"infiltration": 0.25, "lights": 0.12, "equipment": 0.15, "u_walls": 0.12, "u_windows": 0.1, "g_windows": 0.12,
          "heating_efficiency": 0.04}       # standard deviations of factors about 1
SET_POINT_SD = 0.4                          # K
JULY = 24 * 181
COLUMNS = {"electricity_kwh": "electricity", "gas_kwh": "gas", "room_degc": "air_temperature"}
IDF = "model.idf"                           # of a building of DOE, beside the job


@dataclass(frozen=True)
class Model:
    """`night`: first and last hour of the set-back, and its size [K]; `idf`: none of the shipped job."""
    name: str
    night: tuple = ()
    idf: str = ""
    place: str = ""


MODELS = {model.name: model for model in (
    Model("energyplus_office", (18, 5, 5)),
    Model("small_office", (22, 6, 5.4), "RefBldgSmallOfficeNew2004_Chicago.idf", "US-IL"),
    Model("apartments", (), "RefBldgMidriseApartmentNew2004_Chicago.idf", "US-IL"),
    Model("medium_office", (22, 6, 5.4), "RefBldgMediumOfficeNew2004_Chicago.idf", "US-IL"),
    Model("retail", (21, 7, 5.4), "RefBldgStand-aloneRetailNew2004_Chicago.idf", "US-IL"),
    Model("warehouse", (21, 6, 5.4), "RefBldgWarehouseNew2004_Chicago.idf", "US-IL"))}


@dataclass(frozen=True)
class Case:
    """One effect; `series(hours, wind)` in the hook's unit, hours counted from the begin of both years."""
    hook: str = ""
    enters: str = "add"
    series: object = None
    places: tuple = ()          # hooks of effects that count as right
    meter: str = ""


def within(first, last, size):
    """Every day from one hour to another, through midnight where it is earlier."""
    def series(hours, _):
        clock = hours % 24
        inside = (clock >= first) & (clock < last) if first < last else (clock >= first) | (clock < last)
        return size * inside
    return series


def from_hour(begin, size):
    return lambda hours, _: size * (hours >= begin)


def no_set_back(model):
    return {"no_set_back": Case("heating set-point", series=within(*model.night),
                                places=("heating set-point", "plant operation"))} if model.night else {}


CASES = {
    "null": Case(),
    "warm_evenings": Case("heating set-point", series=within(18, 22, 2.5), places=("heating set-point",)),
    "wind": Case("infiltration", series=lambda hours, wind: 0.12 * wind, places=("infiltration", "leakage")),
    "plug_step": Case("lights and equipment", series=from_hour(JULY, 3), places=("lights and equipment", "loads")),
    "boiler_step": Case("heating efficiency", "factor", from_hour(24 * 300, 0.15), ("heating efficiency",)),
    "meter_step": Case("meter factor", "factor", from_hour(24 * 240, 0.12), ("meter factor", "meter addition"),
                       "electricity"),
    "night_air": Case("infiltration", series=within(22, 6, 1.5), places=("infiltration", "ventilation", "venting")),
}


def maker():
    loader = importlib.machinery.SourceFileLoader("make_energyplus_office", str(MAKER))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def truth(seed, name):
    rng = np.random.default_rng([seed, *name.encode()])
    values = {key: round(float(np.exp(sd * rng.standard_normal())), 3) for key, sd in SPREAD.items()}
    return values | {"heating_set_point": round(float(SET_POINT_SD * rng.standard_normal()), 2)}


def wind_of(make):
    """[hours] m/s, of the shipped weather files."""
    speeds = []
    for year in make.YEARS:
        with gzip.open(JOB / make.weather_name(year), "rt") as file:
            speeds += [float(line.split(",")[21]) for line in file.readlines()[8:]]
    return np.array(speeds)


def file_of(model, given):
    """The IDF of a building of DOE."""
    found = pathlib.Path(given) if given else reports.file_like(program.find_program(), model.idf)
    if found is None or not found.is_file():
        raise SystemExit(f"{given or model.idf} was not found; {reports.HOW}, or name the file by --idf")
    return found


def simulate(make, case, values, folder, model):
    """{meter: hours} of the building as it stands; its model and weather lie in `folder`."""
    section = series = None
    if case.series is not None:
        section = {"name": "the effect", "hook": case.hook, "unit": "-", "enters": case.enters, "column": "effect",
                   **({"meter": case.meter} if case.meter else {})}
        series = case.series(np.arange(24 * make.N_DAYS), wind_of(make))
    own = {"model": IDF, "plant": {}} if model.idf else {}
    with tempfile.TemporaryDirectory() as point:
        made = make.simulate(folder, pathlib.Path(point), values, section, series, **own)
        left_out = pathlib.Path(point) / "effects_left_out.txt"
        assert not left_out.exists() or not left_out.read_text().strip(), left_out.read_text()
    return made


def copy_inputs(make, folder, model, idf):
    """What a user has but for the readings."""
    if not model.idf:
        shutil.copytree(JOB, folder, dirs_exist_ok=True)
        return
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(idf, folder / IDF)
    for year in make.YEARS:
        shutil.copyfile(JOB / make.weather_name(year), folder / make.weather_name(year))


def write_job(make, folder, model, runs, alone):
    """The shipped job, or one by `new`."""
    job = folder / f"{model.name}.toml"
    if model.idf:
        weather = [word for year in make.YEARS for word in ("--weather", make.weather_name(year))]
        meters = [word for column, quantity in COLUMNS.items()
                  for word in ("--meter", f"{make.MEASURED}:{column}:{quantity}")]
        subprocess.run([NEW, job.name, "--idf", IDF, *([] if alone else ["--simulator"]), "--place", model.place,
                        "--force", *weather, *meters], cwd=folder, check=True)
        if alone:
            return job
    text = job.read_text().replace('"../../scripts/energyplus_hours"', f'"{ROOT}/scripts/energyplus_hours"')
    assert 'kind = "loop"' in text
    job.write_text(text.replace('kind = "loop"', f'kind = "loop"\nruns = {runs}', 1))
    return job


def error(measured, simulated, is_temperature):
    rmse = float(np.sqrt(np.mean((measured - simulated) ** 2)))
    return rmse if is_temperature else 100 * rmse / float(np.mean(measured))


def noise_of(make, path, hours):
    """{meter's column: error of the true building in the second year}"""
    rows = np.genfromtxt(path, delimiter=",", names=True, dtype=None, encoding="ascii")
    half = 24 * 365
    return {column.split("_")[0]: error(rows[column][half:], hours[name][half:], name == "air_temperature")
            for column, name in COLUMNS.items()}


def run(name, case, args, make):
    model = MODELS[args.model]
    folder = pathlib.Path(args.folder or tempfile.mkdtemp()) / name
    copy_inputs(make, folder, model, model.idf and file_of(model, args.idf))
    hours = simulate(make, case, truth(args.seed, name), folder, model)
    make.write_readings(folder / make.MEASURED, hours)
    job = write_job(make, folder, model, args.runs, args.alone)
    begun = time.monotonic()
    done = subprocess.run(["mpirun", "-np", str(args.ranks), str(PROGRAM), "run", job.name, "-o", "result.h5"],
                          cwd=folder, capture_output=True, text=True, check=False)
    (folder / "said.txt").write_text(done.stdout + done.stderr)
    if not (folder / "result.h5").exists():
        raise SystemExit(f"{name}: no result: {done.stderr[-500:]}")
    loop = read_loop(folder / "result.h5", f"{model.name}/loop")
    noise = noise_of(make, folder / make.MEASURED, hours)
    return summary(name, case, loop, noise, (time.monotonic() - begun) / 60)


def held_out(loop, model):
    """{meter: error of the second year} [%; K]"""
    return {error.channel: float(error.error[model]) for error in loop.judged_errors()}


def summary(name, case, loop, noise, minutes):
    right = [effect.name for effect in loop.effects if effect.hook in case.places]
    false = [effect.name for effect in loop.effects if effect.hook not in case.places]
    ratios = {}
    for label, model in (("before", BEFORE), ("after", AFTER)):
        errors = held_out(loop, model)
        ratios[label] = float(np.exp(np.mean([np.log(errors[key] / noise[key]) for key in errors])))
    print(f"# {name}: right {right}, others {false}, errors before {held_out(loop, BEFORE)}, "
          f"after {held_out(loop, AFTER)}, of noise {noise}", flush=True)
    return {"right": bool(right), "false": len(false), **ratios, "minutes": minutes}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--model", default="energyplus_office", choices=list(MODELS))
    parser.add_argument("--idf", help="the file of a building of DOE")
    parser.add_argument("--alone", action="store_true", help="the loop on what `new --idf` reads, without EnergyPlus")
    parser.add_argument("--only", nargs="*", help=f"of {', '.join(CASES)}, no_set_back")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--runs", type=int, default=80)
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--folder")
    args = parser.parse_args()
    make = maker()
    if args.alone and not MODELS[args.model].idf:
        parser.error("--alone: expected a model of DOE")
    cases = CASES | no_set_back(MODELS[args.model])
    wrong = next((name for name in args.only or () if name not in cases), None)
    if wrong:
        parser.error(f"--only: {wrong}: expected one of {', '.join(cases)}")
    rows = {name: run(name, cases[name], args, make) for name in args.only or cases}
    seen = {name: row for name, row in rows.items() if cases[name].places}
    if seen:
        n_right = sum(row["right"] for row in seen.values())
        print(f"energyplus_loop_right {n_right} of {len(seen)} 0.8 {n_right / len(seen):.2f}")
    n_false = sum(row["false"] for row in rows.values())
    print(f"energyplus_loop_false {n_false} effects 0 {n_false / len(rows):.2f}")
    for label in ("before", "after"):
        value = float(np.median([row[label] for row in rows.values()]))
        print(f"energyplus_loop_{label}_over_truth {value:.3f} - 1.3 {value / 1.3:.2f}")
    longest = max(row["minutes"] for row in rows.values())
    print(f"energyplus_loop_longest {longest:.1f} min 25 {longest / 25:.2f}")


if __name__ == "__main__":
    main()
