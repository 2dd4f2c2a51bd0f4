#!/usr/bin/python3
"""First jobs of real buildings: how many `bemcal-batch new` writes that check and run take as they are, and how well
their loops predict what is held out, beside a regression on outdoor temperature and hour of the week.

    bench_new.py [--loops N] [--folder DIR] [BUILDING...]

Each building's readings are put into files as a user has them, cut to the years of jobs/cambridge_loops and the like.
`new` is told area, use, year and country, no more; storeys where they are published. Where no year is published, 1970
is said; where no area is, that of the job by hand. The loops of the first N buildings (default: none) run on one thread
each. Prints `name value unit reference ratio`: CV(RMSE) after, with the regression's as the reference. Of bills it is
one of months on outdoor temperature with two change points. Needs ../shared.
"""
import argparse
import os
import pathlib
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass

import h5py
import large_job
import pandas
from bench_level_change import regression
from bench_nyc_bills import write_weather
from bench_real_loops import errors_of

sys.path.insert(0, str(large_job.ROOT / "scripts"))
from report.beside import cv_rmse  # noqa: E402

SHARED = large_job.ROOT.parent / "shared"
DATA, METERS = SHARED / "data", SHARED / "meters"
UNKNOWN = 1970                 # year, where none is published
UNIT_KWH = {"usage_kWh": 1, "usage_kBtu": 1 / 3.41214}
MONTHS = 12                    # of training, and held out
SOME_GAS = 50                  # kWh/(m2 a), of a building that gas heats
M2 = 10000                     # of a building whose bills are per area
M2_PER_FT2 = 0.09290304


@dataclass
class Building:
    """`meters`: {file: (table, column)}; `years` that are kept, None: all."""
    name: str
    meters: dict
    weather: pathlib.Path
    area: float
    use: str
    place: str
    site: str
    years: tuple = None
    built: int = UNKNOWN
    storeys: int = None


def cambridge():
    """Those of jobs/cambridge_loops, of ../shared/meters, and b35."""
    loops = pandas.read_csv(large_job.ROOT / "jobs" / "cambridge_loops" / "buildings.csv")
    more = pandas.read_csv(METERS / "buildings.csv")
    rows = [(row.name_, row.floor_area, round(row.floor_area / row.storey), row.training, row.held_out,
             DATA / "cambridge" / "gas_as_published.csv.gz")
            for row in loops.rename(columns={"name": "name_"}).itertuples()]
    rows += [(row.id, row.floor_area_m2, row.floors, row.training, row.held_out, METERS / "cambridge_gas.csv.gz")
             for row in more.itertuples()]
    rows.append(("b35", 7029.8, 6, 2018, 2019, DATA / "cambridge" / "gas_as_published.csv.gz"))
    electricity = DATA / "cambridge" / "electricity_kwh.csv.gz"
    metered = pandas.read_csv(electricity, nrows=0).columns
    for name, area, storeys, training, held_out, gas in rows:
        meters = {"gas.csv": (gas, name)}
        if name in metered:
            meters["electricity.csv"] = (electricity, name)
        use = "laboratory" if name == "b35" else "university"
        yield Building(name, meters, DATA / "cambridge" / "weather.csv.gz", area, use, "GB", "52.20,0.12",
                       (training, held_out), storeys=storeys)


def others():
    for name, area, use in (("b10045", 1000, "apartments"), ("b11491", 2500, "apartments")):
        table = DATA / "tartu" / f"{name}.csv.gz"
        yield Building(f"tartu_{name}", {"heat.csv": (table, "heat_kW")}, table, area, use, "EE", "58.38,26.72")
    yield Building("tartu_bPr01", {"heat.csv": (METERS / "tartu_bPr01_heat.csv.gz", "heat_kW")},
                   METERS / "tartu_bPr01_weather.csv.gz", 2500, "other", "EE", "58.38,26.72")
    table = DATA / "phoenix_office" / "office_abigail.csv.gz"
    yield Building("phoenix_office", {"electricity.csv": (table, "elec_kWh")}, table, 901.4, "office", "US-AZ",
                   "33.4,-112.1", built=1940)
    yield Building("orlando_hannah", {"electricity.csv": (METERS / "orlando_hannah.csv.gz", "Panther_office_Hannah")},
                   METERS / "orlando_weather.csv.gz", 375.1, "office", "US-FL", "28.52,-81.38")
    yield Building("hong_kong", {"cooling.csv": (METERS / "hong_kong_cooling.csv.gz", "Q_cool_kW")},
                   METERS / "hong_kong_weather.csv.gz", 12000, "office", "HK", "22.30,114.17")
    home = DATA / "uk_home"
    yield Building("uk_home", {"gas.csv": (home / "gas.csv.gz", "gas_kWh"),
                               "electricity.csv": (home / "electricity.csv.gz", "electricity_kWh")},
                   home / "gas.csv.gz", 90, "house", "GB", "52.5,-1.5")


def write_inputs(building, folder):
    """Files of one building; [(option, value)] of `new`."""
    words = []
    for file, (table, column) in building.meters.items():
        rows = pandas.read_csv(table, usecols=lambda name, c=column: name == c or name[:4] in ("time", "t", "date"))
        if building.years:
            year = rows.iloc[:, 0].str[:4].astype(int)
            rows = rows[(year >= building.years[0]) & (year <= building.years[1])]
        if rows[column].notna().sum() == 0:
            continue
        rows.to_csv(folder / file, index=False)
        words.append(("--meter", folder / file))
    return [*words, ("--weather", building.weather)]


def nyc(folder, n=2):
    """The first buildings of nyc_bills that have two years of both fuels and are heated by one, with M2, for the bills
    are per area; a file of bills for each fuel, weather by the hour made of the months' temperatures."""
    table = pandas.read_csv(DATA / "nyc_bills" / "unretrofit_monthly_per_ft2.csv.gz")
    for name, rows in table.groupby("bdbid"):
        fuels = {fuel: part.sort_values("end_date") for fuel, part in rows.groupby("energy_type")}
        if n == 0 or len(fuels) < 2 or any(len(part) < 24 for part in fuels.values()):
            continue
        if fuels["Fuel"].usage.mean() * 365 * UNIT_KWH["usage_kBtu"] / 1000 / M2_PER_FT2 < SOME_GAS:
            continue
        n -= 1
        at = folder / f"nyc_{name}"
        at.mkdir(parents=True, exist_ok=True)
        words = [("--weather", at / "weather.csv")]
        for fuel, part in fuels.items():
            end = pandas.to_datetime(part.end_date)
            use = part.usage * end.dt.days_in_month * M2 / M2_PER_FT2
            file, unit = ("electricity.csv", "kWh") if fuel == "Elec" else ("gas.csv", "kBtu")
            pandas.DataFrame({"start": end.dt.to_period("M").dt.start_time, "end": end,
                              f"usage_{unit}": use / (1 if fuel == "Elec" else 1000)}).to_csv(
                at / file, index=False, float_format="%.1f", date_format="%Y-%m-%d")
            words.append(("--meter", at / file))
        means = fuels["Elec"].set_index(end.dt.to_period("M").dt.start_time).OAT_C
        write_weather(at / "weather.csv", means)
        yield f"nyc_{name}", at, [*words, ("--area", M2), ("--use", "office"), ("--built", UNKNOWN),
                                  ("--place", "US-NY"), ("--site", "40.75,-73.95")]


def all_of(folder):
    """(name, folder, options of `new`)"""
    for building in [*cambridge(), *others()]:
        at = folder / building.name
        at.mkdir(parents=True, exist_ok=True)
        words = write_inputs(building, at)
        words += [("--area", building.area), ("--use", building.use), ("--built", building.built),
                  ("--place", building.place), ("--site", building.site)]
        words += [("--storeys", building.storeys)] if building.storeys else []
        yield building.name, at, words
    yield from nyc(folder)


def run(*words):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False,
                          env={**os.environ, "OMP_NUM_THREADS": "1"})


def write_and_check(name, folder, words):
    """The job, or None where new or check refused."""
    job = folder / f"{name}.toml"
    made = run(large_job.PROGRAM, "new", job, *(word for pair in words for word in pair), "--force")
    print(made.stdout + made.stderr, end="")
    if made.returncode:
        return None
    checked = run(large_job.PROGRAM, "check", job)
    if checked.returncode:
        print(f"{name}: check: {checked.returncode}: {checked.stderr}")
    return None if checked.returncode else job


def print_months(name, folder, result):
    """Of nyc_bills, whose meters are bills: beside the regression of a year's bills on outdoor temperature."""
    outdoor = pandas.read_csv(folder / "weather.csv", parse_dates=["time"]).set_index("time").T_out_C
    outdoor = outdoor.groupby(outdoor.index.to_period("M")).mean().to_numpy()
    for channel in ("gas", "electricity"):
        bills = pandas.read_csv(folder / f"{channel}.csv")
        days = (pandas.to_datetime(bills.end) - pandas.to_datetime(bills.start)).dt.days.to_numpy() + 1
        use = bills.iloc[:, 2].to_numpy() * UNIT_KWH[bills.columns[2]]
        year, measured = pandas.DataFrame({"OAT_C": outdoor, "usage": use / days})[:MONTHS], use[MONTHS:]
        by_temperature = regression(year)(outdoor[MONTHS:]) * days[MONTHS:]
        with h5py.File(result) as file:
            after = file[f"{name}/loop/held_out/{channel}/month_predicted"][:]
        error, reference = cv_rmse(after, measured), cv_rmse(by_temperature, measured)
        print(f"{name}_{channel}_bills_after {error:.1f} % {reference:.1f} {error / reference:.3f}", flush=True)


def loop_errors(name, job):
    """Prints and returns the ratios of after to the regression, by the hour."""
    result = job.with_suffix(".h5")
    begin = time.perf_counter()
    done = run(large_job.PROGRAM, "run", job, "-o", result, "--force", "--no-report")
    print(f"{name}_seconds {time.perf_counter() - begin:.0f} s - -", flush=True)
    if done.returncode not in (0, 1):
        print(f"{name}: run: {done.returncode}: {done.stderr}")
        return []
    if name.startswith("nyc"):
        return print_months(name, job.parent, result) or []
    table = run(large_job.ROOT / "scripts" / "change_point_baseline", result, job).stdout
    ratios = []
    for (_, channel, period), models in errors_of(table).items():
        if period == "training" or "regression" not in models:
            continue
        for k, resolution in ((0, "hourly"), (2, "monthly")):
            after, reference = models["after"][k], models["regression"][k]
            print(f"{name}_{channel}_{resolution}_after {after:.1f} % {reference:.1f} {after / reference:.3f}",
                  flush=True)
        ratios.append(models["after"][0] / models["regression"][0])
    return ratios


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("buildings", nargs="*", help="default: all")
    parser.add_argument("--loops", type=int, default=0, help="so many buildings' loops are run")
    parser.add_argument("--folder", type=pathlib.Path, default=large_job.ROOT / "build" / "bench" / "new")
    options = parser.parse_args()
    if not DATA.exists():
        print(f"skipped: no readings in {DATA}")
        return
    names, ratios, done, n = options.buildings, [], 0, 0
    for name, folder, words in all_of(options.folder):
        if names and name not in names:
            continue
        n += 1
        job = write_and_check(name, folder, words)
        done += job is not None
        if job and n <= options.loops:
            ratios += loop_errors(name, job)
    print(f"new_and_check {done} of_{n} - -")
    if ratios:
        middle = statistics.median(ratios)
        print(f"hourly_after_over_regression_median {middle:.3f} - 1 {middle:.3f}")


if __name__ == "__main__":
    sys.exit(main())
