#!/usr/bin/python3
"""Loops on DOE's buildings as `new --idf` reads them, beside those on a description by hand.

    bench_idf_loads.py [--folder DIR] [CASE...]

The weather is that of ../shared/energyplus/so_null and ap_null, which EnergyPlus made of DOE's small office and mid-
rise apartments on a ground of its own. The description by hand is theirs (scripts/run_case). `new --idf` reads DOE's
file. It is judged on two sets of readings: EnergyPlus's of that file, with the noise of the cases (`file`), and those
of the case (`case`). Neither has summer time and holidays, light outdoors and hot water, which are taken out of the
file and of its job.
Prints `name value unit reference ratio`: the held-out error of `before` (no effect accepted) and of `after` by the
hour, CV(RMSE) or K, with that of the description by hand, on the case's readings, as the reference. DOE's file takes
half the heat of the case, whose ground is cold: RMSE [kWh] compare where CV(RMSE) do not. Needs pyenergyplus-lbnl
(tests/energyplus/reports.py) and ../shared.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys

import h5py
import large_job
import numpy as np
import pandas

sys.path[:0] = [str(large_job.ROOT / "scripts"), str(large_job.ROOT / "tests" / "energyplus")]
import idf        # noqa: E402  (found above)
import reports    # noqa: E402
from cases.meters import CHANNELS    # noqa: E402
from report import result as stored  # noqa: E402

CASES = large_job.ROOT.parent / "shared" / "energyplus"
MODELS = {"so_null": "RefBldgSmallOfficeNew2004_Chicago.idf", "ap_null": "RefBldgMidriseApartmentNew2004_Chicago.idf"}
PLACE = "US"
QUANTITY_OF_NAME = {"room": "air_temperature"}    # names of meters that `new` gives, others are quantities
SKIPPED = 77
PARTS = ("train", "test")
HOURS = 8760                                     # of the year that is held out
FIRST_HOUR = 8                                   # line of a weather file
ROOM = "T_air_C"
ENERGIES = {"heat_kWh": ("HeatingCoils:EnergyTransfer",), "cool_kWh": ("CoolingCoils:EnergyTransfer",),
            "elec_kWh": tuple(f"{use}:Electricity" for use in ("InteriorLights", "InteriorEquipment", "Fans", "Pumps",
                                                               "Heating", "Cooling")),
            "gas_kWh": ("Heating:NaturalGas",)}  # as the cases have them: no light outside, no hot water
OUTDOORS = "Exterior:Lights|WaterUse:Equipment|WaterHeater:"
J_OF_KWH = 3.6e6
NOISE, NOISE_K, NOISE_SEED = 0.015, 0.07, 1      # of ../shared/energyplus/README.md


def run(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False,
                          env={**os.environ, "OMP_NUM_THREADS": "1", "BEMCAL_PROGRAM": str(large_job.PROGRAM)})
    if done.returncode not in (0, 1):    # 1: a target is missed
        sys.exit(f"{words[0]} ended with {done.returncode}: {done.stdout[-2000:]}{done.stderr}")


def reason_to_skip(energyplus):
    """What such a bench lacks; "" = nothing."""
    return "; ".join(([] if energyplus else [reports.HOW]) + ([] if CASES.exists() else [f"no {CASES}"]))


def asked(says, cases, folder):
    """EnergyPlus, the cases that are asked for (default: all), and the folder of their folders; or the end."""
    parser = argparse.ArgumentParser(description=says.split("\n\n")[0])
    parser.add_argument("--only", nargs="*", metavar="CASE", choices=cases, help=f"of {', '.join(cases)}")
    parser.add_argument("--folder", type=pathlib.Path, default=large_job.ROOT / "build" / folder)
    options = parser.parse_args()
    energyplus = idf.program()
    if lacks := reason_to_skip(energyplus):
        print(f"skipped: {lacks}")
        sys.exit(SKIPPED)
    return energyplus, options.only or list(cases), options.folder.resolve()


def metered_years(energyplus, case, model, folder, energies):
    """[(year, EnergyPlus's run of it)] of both, in the case's weather."""
    meters = {meter for parts in energies.values() for meter in parts}
    for part in PARTS:
        epw = CASES / case / f"weather_{part}.epw"
        year = int(epw.read_text().splitlines()[FIRST_HOUR].split(",")[0])
        yield year, reports.MeteredYear(energyplus, model, year, epw, folder / part, meters)


def measured_in(run, energies):
    """{column: hours}: the room, and energies [kWh]."""
    return {ROOM: run.room_temperature(), **{column: sum(run.meter(part) for part in parts) / J_OF_KWH
                                             for column, parts in energies.items()}}


def years(energyplus, case, model, folder, energies=ENERGIES):
    """[(year, {column: hours})] of both, of what ../shared/energyplus has of the case."""
    header = (CASES / case / "measured.csv").read_text().splitlines()[0].split(",")
    for year, run in metered_years(energyplus, case, model, folder, energies):
        measured = measured_in(run, energies)
        yield year, {column: measured[column] for column in header[1:]}


def noisy_table(year, hours, dice):
    """A year's readings with noise, by their stamps."""
    measured = {name: values + NOISE_K * noise if name == ROOM else np.maximum(0, values * (1 + NOISE * noise))
                for name, values in hours.items() for noise in [dice.standard_normal(len(values))]}
    stamps = pandas.date_range(f"{year}-01-01T01:00", periods=len(hours[ROOM]), freq="h")
    return pandas.DataFrame(measured, index=stamps.rename("timestamp"))


def write_table(path, table):
    table.to_csv(path, date_format="%Y-%m-%dT%H:%M:%S", float_format="%.5g")


def readings(energyplus, case, model, folder):
    """A table of both years by EnergyPlus, with noise; returns its path and columns."""
    dice = np.random.default_rng(NOISE_SEED)
    table = pandas.concat([noisy_table(year, hours, dice)
                           for year, hours in years(energyplus, case, model, folder / f"{case}_years")])
    path = folder / f"{case}.csv"
    write_table(path, table)
    return path, list(table)


def readings_of_case(case, folder):
    """The same of ../shared/energyplus: training, then what is held out."""
    parts = [pandas.read_csv(CASES / case / name, index_col=0) for name in ("measured.csv", "measured_test.csv")]
    path = folder / f"{case}_readings.csv"
    pandas.concat(parts).to_csv(path)
    return path, list(parts[0])


def loop_of_file(job, model, table, columns, case):
    """The loop on the job that `new --idf` writes, without summer time and holidays, in the case's weather."""
    words = [f"{table}:{column}:{CHANNELS[column][1]}:{CHANNELS[column][2]}" for column in columns]
    words = [word for meter in words for word in ("--meter", meter)]
    words += [word for part in PARTS for word in ("--weather", CASES / case / f"weather_{part}.epw")]
    run(large_job.PROGRAM, "new", job, "--force", "--idf", model, "--place", PLACE, *words)
    text = re.sub(r"(?m)^summer_time.*\n", "", job.read_text())
    job.write_text(re.sub(r"(?m)^\[holidays\]\n(.+\n)*", "", text))
    result = job.with_suffix(".h5")
    run(large_job.PROGRAM, "run", job, "-o", result, "--force", "--no-report")
    with h5py.File(result) as file:
        return stored.Loop(file, f"{job.stem}/loop")


def from_file(case, folder, of):
    """{quantity: errors of before and after} of the job that `new --idf` writes, on readings `of` "file" or "case"."""
    energyplus = idf.program()
    model = energyplus and reports.file_like(energyplus, MODELS[case])
    if model is None:
        print(f"skipped: {reports.HOW}")
        sys.exit(SKIPPED)
    job, indoors = folder / f"{case}_{of}.toml", folder / f"{case}_{of}.idf"
    indoors.write_text(reports.with_objects(model, [], OUTDOORS))
    table, columns = readings(energyplus, case, model, folder) if of == "file" else readings_of_case(case, folder)
    loop = loop_of_file(job, indoors, table, columns, case)
    measured = pandas.read_csv(table, index_col=0).iloc[-HOURS:].mean()
    mean = {CHANNELS[column][1]: measured[column] for column in columns}
    quantity = {name: QUANTITY_OF_NAME.get(name, name) for name in loop.channels}
    return {quantity[row.channel]: ([row.error[which] for which in (stored.BEFORE, stored.AFTER)],
                                    mean[quantity[row.channel]])
            for row in loop.judged_errors() if row.resolution == "hourly"}


def by_hand(case, folder):
    """The same of the case's building.json."""
    run(large_job.ROOT / "scripts" / "run_case", CASES / case, folder / case, "--ranks", 1, "--force")
    measured = pandas.read_csv(CASES / case / "measured_test.csv", index_col=0)
    predicted = [pandas.read_csv(folder / case / f"{which}.csv", index_col=0) for which in ("before", "after")]
    return {CHANNELS[column][1]: ([error(table[column], measured[column], CHANNELS[column][2]) for table in predicted],
                                  measured[column].mean())
            for column in predicted[0]}


def error(predicted, measured, unit):
    """RMSE in K, or CV(RMSE) [%]; rows are matched by their stamps."""
    left = (predicted - measured).dropna()
    rmse = float((left**2).mean())**0.5
    return rmse if unit == "degC" else 100 * rmse / float(measured.mean())


def show(name, unit, values, others):
    for which, value, other in zip(("before", "after"), values, others):
        print(f"{name}_{which} {value:.2f} {unit} {other:.2f} {value / other:.2f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("cases", nargs="*", metavar="CASE", default=list(MODELS))
    parser.add_argument("--folder", type=pathlib.Path, default=large_job.ROOT / "build" / "idf_loads")
    options = parser.parse_args()
    if not CASES.exists():
        print(f"skipped: no {CASES}")
        return SKIPPED
    folder = options.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    for case in options.cases:
        reference = by_hand(case, folder)
        for of in ("file", "case"):
            for quantity, (values, mean) in from_file(case, folder, of).items():
                others, mean_of_other = reference[quantity]
                name = f"{case}_of_{of}_{quantity}"
                if quantity == "air_temperature":
                    show(name, "K", values, others)
                    continue
                show(name, "%", values, others)
                show(f"{name}_rmse", "kWh", [value * mean / 100 for value in values],
                     [other * mean_of_other / 100 for other in others])
    return 0


if __name__ == "__main__":
    sys.exit(main())
