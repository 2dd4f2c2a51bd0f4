#!/usr/bin/python3
"""Four real retrofits, of which nothing is known but monthly bills and outdoor temperatures: what they
saved, and which of the calibrated parameters still hold.

    bench_nyc_bills.py [--folder DIR] [--ranks R]

For each building with a retrofit in ../shared/data/nyc_bills: a posterior learns from the bills before it
and predicts those after it under their own weather, had nothing been done; the saving is what was
predicted less what was billed. Its interval takes the months' errors as one (that of a level that has
changed is), so it is on the wide side. A second posterior learns from the bills afterwards, and
scripts/still_holds compares the two. Beside the saving stands that of a regression on outdoor temperature
(bench_level_change.py), fitted to the same bills.

Floor areas and hourly weather are not published. A building is a box whose area follows from its bills
(200 kWh/m2 of fuel a year, or 150 of electricity where there is no fuel); only its parameters' shares tell
anything. Temperatures are the months' means with a daily swing and a made course of days; the sky is half
covered. Prints a line for each building and fuel, and `name value unit reference ratio`: the buildings'
total saving in each fuel, beside the regression's.
"""
import argparse
import os
import pathlib
import subprocess
import sys

import h5py
import numpy as np
import pandas

import large_job
from bench_level_change import regression

BILLS = large_job.ROOT.parent / "shared" / "data" / "nyc_bills" / "retrofit_monthly.csv"
UNIT = {"Elec": 1.0, "Fuel": 1 / 3412.14}  # kWh of a published one: electricity in kWh, fuel in BTU
METER = {"Elec": "electricity", "Fuel": "gas"}
BEFORE, AFTER = 1, 3  # the column prepost; 2 = while it was done
SEED = 1

JOB = """
name = "b{name}"
seed = 1

[site]
latitude = 40.75
longitude = -73.95
utc_offset = -5
[weather]
files = ["weather.csv"]
format = "csv"
temperature = "as_read"
[weather.columns]
outdoor_temperature = "T_out_C"
cloud_cover = "cloud_cover"
[periods]
training = {training}
held_out = {held_out}

[[schedule]]
name = "occupied"
weekdays = [0.2, 0.2, 0.2, 0.2, 0.2, 0.3, 0.5, 0.8, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0.8, 0.6, 0.5, 0.4, 0.3, 0.2]
weekend = 0.4

[[construction]]
name = "wall"
u_value = 1.2
[[glazing]]
name = "window"
u_value = 3.0
solar_transmittance = 0.6

[[zone]]
name = "building"
floor_area = {area:.1f}
volume = {volume:.1f}
class = "heavy"
heating_set_point = 21
cooling_set_point = 25
[[zone.surface]]
construction = "wall"
area = {wall:.1f}
azimuth = 180
[[zone.window]]
glazing = "window"
area = {window:.1f}
azimuth = 180
[[zone.window]]
glazing = "window"
area = {window:.1f}
azimuth = 0
[[zone.flow]]
name = "air"
air_change = 0.6
[[zone.load]]
name = "devices"
density = {{value = {devices:.2f}, schedule = "occupied"}}
carrier = "electricity"
[[zone.load]]
name = "hot_water"
density = {hot_water}
heat_fraction = 0
carrier = "gas"

[plant]
heating_carrier = "{heating}"
heating_efficiency = 0.75
cooling_cop = 3

{meters}
{parameters}

[[study]]
kind = "posterior"
autocorrelated = false
level_change = 0.1
warm_up = 300
draws_per_round = 200
most_draws = 2000
target_rhat = 1.02
"""

METER_TEXT = """
[[meter]]
name = "{meter}"
quantity = "{meter}"
interval = "monthly"
file = "bills.csv"
column = "{meter}"
unit = "kWh"
"""

# name, target, mode, least, most, mean, standard deviation
PARAMETERS = [
    ("envelope", ["construction.wall.u_value", "glazing.window.u_value"], "factor", 0.2, 3, 1, 0.6),
    ("air_change", ["zone.building.flow.air.air_change"], "value", 0.1, 3, 0.6, 0.5),
    ("heating_set_point", ["zone.building.heating_set_point"], "value", 16, 24, 21, 1.5),
    ("cooling_set_point", ["zone.building.cooling_set_point"], "value", 24.5, 32, 26, 2),
    ("devices", ["zone.building.load.devices.density"], "factor", 0.3, 3, 1, 0.5)]
OF_FUEL = [("hot_water", ["zone.building.load.hot_water.density"], "value", 0, 12, 2, 2)]


def days_in(months):
    return months.dt.days_in_month.to_numpy()


def bills_of(table, name):
    """{energy: [months] prepost, OAT_C, usage [kWh of the month]}; a month's index is its first day."""
    found = {}
    for energy, rows in table[table.bdbid == name].groupby("energy_type"):
        ends = pandas.to_datetime(rows.end_date)
        rows = rows.assign(usage=rows.usage * UNIT[energy] * days_in(ends))
        found[energy] = rows.set_index(ends.dt.to_period("M").dt.start_time)[["prepost", "OAT_C", "usage"]].sort_index()
    return found


def write_weather(path, means):
    """Hours whose months have these means [degC]: a daily swing, and days that follow one another."""
    rng = np.random.default_rng(SEED)
    hours = pandas.date_range(means.index[0], means.index[-1] + pandas.offsets.MonthBegin(1), freq="h",
                              inclusive="left")
    course = np.zeros(len(hours) // 24)
    for day in range(1, len(course)):
        course[day] = 0.7 * course[day - 1] + rng.normal(0, 2.5)
    outdoor = np.repeat(course, 24) - 4 * np.cos(2 * np.pi * (hours.hour.to_numpy() - 3) / 24)
    frame = pandas.DataFrame({"time": hours, "T_out_C": outdoor, "cloud_cover": 0.5})
    months = hours.to_period("M").start_time
    of_month = frame.groupby(months).T_out_C.transform("mean").to_numpy()
    frame.T_out_C += means.reindex(months).to_numpy() - of_month
    frame.to_csv(path, index=False, float_format="%.2f", date_format="%Y-%m-%d %H:%M")


def period_of(bills, state):
    months = bills.index[bills.prepost == state]
    return [f"{months[0]:%Y-%m-%d}", f"{months[-1] + pandas.offsets.MonthEnd(0):%Y-%m-%d}"]


def parameter_text(name, target, mode, least, most, mean, sd):
    mode_line = "" if mode == "value" else f'mode = "{mode}"\n'
    return (f'[[parameter]]\nname = "{name}"\ntarget = {target}\n{mode_line}min = {least}\nmax = {most}\n'
            f'prior = {{kind = "normal", mean = {mean}, sd = {sd}}}\n')


def job_text(name, bills, training, held_out):
    first = next(iter(bills.values()))
    year = {energy: rows.usage[rows.prepost == BEFORE].sum() for energy, rows in bills.items()}
    area = year["Fuel"] / 200 if "Fuel" in year else year["Elec"] / 150
    parameters = PARAMETERS + (OF_FUEL if "Fuel" in year else [])
    text = JOB.format(
        name=name, training=period_of(first, training), held_out=period_of(first, held_out), area=area,
        volume=3 * area, wall=0.5 * area, window=0.05 * area, devices=year["Elec"] / area / 8.76 / 0.6,
        heating="gas" if "Fuel" in year else "electricity", hot_water=2 if "Fuel" in year else 0,
        meters="".join(METER_TEXT.format(meter=METER[energy]) for energy in bills),
        parameters="\n".join(parameter_text(*row) for row in parameters))
    return text.replace("'", '"')


def write_jobs(folder, name, bills):
    """The jobs before and after."""
    folder.mkdir(parents=True, exist_ok=True)
    first = next(iter(bills.values()))
    write_weather(folder / "weather.csv", first.OAT_C)
    columns = pandas.DataFrame({METER[energy]: rows.usage for energy, rows in bills.items()})
    columns.to_csv(folder / "bills.csv", index_label="time", float_format="%.1f", date_format="%Y-%m-%d %H:%M")
    jobs = []
    for word, training, held_out in (("before", BEFORE, AFTER), ("after", AFTER, BEFORE)):
        jobs.append(folder / f"{word}.toml")
        jobs[-1].write_text(job_text(name, bills, training, held_out))
    return jobs


def run(job, ranks):
    result = job.with_suffix(".h5")
    done = subprocess.run(["mpirun", "-np", str(ranks), "--oversubscribe", large_job.PROGRAM, "run", job, "-o",
                           result, "--force", "--threads", "1"], capture_output=True, text=True)
    if done.returncode not in (0, 1):  # 1: not converged, as its first line says
        sys.exit(f"{job}: exit code {done.returncode}: {done.stderr}")
    if done.returncode:
        print(f"{job.parent.name}: {done.stdout.splitlines()[0]}")
    return result


def savings(result, name, energy, rows):
    """(measured after, saving, its 5 and 95 %, the regression's saving) [MWh]"""
    with h5py.File(result) as file:
        months = file[f"b{name}/posterior/held_out/{METER[energy]}"]
        measured, mean, low, high = (np.nansum(months[key][:]) for key in
                                     ("measured", "predicted_mean", "predicted_q05", "predicted_q95"))
    after = rows[rows.prepost == AFTER]
    by_day = rows[rows.prepost == BEFORE].assign(usage=lambda r: r.usage / r.index.days_in_month)
    expected = (regression(by_day)(after.OAT_C.to_numpy()) * after.index.days_in_month.to_numpy()).sum()
    return [value / 1e3 for value in (measured, mean - measured, low - measured, high - measured,
                                      expected - after.usage.sum())]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--ranks", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--folder", type=pathlib.Path, default=large_job.ROOT / "build" / "bench" / "nyc_bills")
    options = parser.parse_args()
    if not BILLS.exists():
        print(f"skipped: no bills in {BILLS}")
        return
    table = pandas.read_csv(BILLS, dtype={"bdbid": str})
    totals = {energy: np.zeros(2) for energy in UNIT}
    for name in sorted(table.bdbid.unique(), key=int):
        bills = bills_of(table, name)
        before, after = (run(job, options.ranks) for job in write_jobs(options.folder / f"b{name}", name, bills))
        for energy, rows in bills.items():
            billed, saving, low, high, of_regression = savings(before, name, energy, rows)
            print(f"b{name} {METER[energy]}: billed {billed:.0f} MWh, saving {saving:.0f} ({low:.0f} to "
                  f"{high:.0f}), by regression {of_regression:.0f}", flush=True)
            totals[energy] += saving, of_regression
        subprocess.run([large_job.ROOT / "scripts" / "still_holds", before, after])
    for energy, (saving, of_regression) in totals.items():
        print(f"saving_{METER[energy]} {saving:.0f} MWh {of_regression:.0f} {saving / of_regression:.2f}")


if __name__ == "__main__":
    main()
