#!/usr/bin/python3
"""Savings of a retrofit, foretold from a year of meters before it, against the generator's house
after it.

    bench_retrofit.py [--only N] [--seed S] [--ranks R] [--folder DIR]

For each of N houses (default 20), drawn by seed: 0.1 m of insulation on the walls, other windows, 40 %
less infiltration. The posterior learns from the meters of the first year; the saving of all meters
together in the second is foretold, and compared with the generator's own, before and after under the
same weather and the same days. Prints a line for each house and then
`name value unit reference ratio`: how many savings lie inside the 90 % interval, and the interval's
median width over the saving.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
from dataclasses import replace

import h5py
import numpy as np

import large_job
import loop_scores  # also finds the generator and scripts/cases  # noqa: F401
from case import Recipe, weather_of
from case_folder import COLUMNS, YEAR, true_channels, write_case
from cases import running
from cases.folder import CaseError
from designs import drawn_design
from drives import DayNoise
from office import as_built

THICKNESS, CONDUCTIVITY = 0.1, 0.035
U_WINDOW, G_WINDOW, TIGHTER = 1.1, 0.45, 0.6

# The generator is another kind of simulator, and its meters are rounded: what the README says of
# models that are not right in shape holds.
STUDIES = f"""
[[scenario]]
name = "retrofit"
    [[scenario.change]]
    target = "construction.wall.u_value"
    insulation = {THICKNESS}
    conductivity = {CONDUCTIVITY}
    [[scenario.change]]
    target = "glazing.window.u_value"
    value = {U_WINDOW}
    [[scenario.change]]
    target = "glazing.window.solar_transmittance"
    value = {G_WINDOW}
    [[scenario.change]]
    target = "zone.zone.flow.infiltration.air_change"
    factor = {TIGHTER}

[[study]]
kind = "posterior"
autocorrelated = false
proportional = false
reading_weight = 0.006
n_chains = 4
warm_up = 200
draws_per_round = 100
most_draws = 300

[[study]]
kind = "retrofit"
of = "posterior"
period = "held_out"
"""


def recipe_of(seed, number):
    rng = np.random.default_rng([seed, number, 7])
    climate, design = drawn_design(rng)
    return Recipe(climate, "2021-01-01", 730, int(rng.integers(2 ** 31)), design)


def after_retrofit(built):
    return replace(built, u_wall=1 / (1 / built.u_wall + THICKNESS / CONDUCTIVITY),
                   u_window=U_WINDOW, g_window=G_WINDOW, infiltration=TIGHTER * built.infiltration)


def true_saving(recipe):
    """[kWh] of all meters in the second year."""
    built, weather = as_built(recipe.design, recipe.seed), weather_of(recipe)

    def total(office):
        channels = true_channels(recipe, office, weather, DayNoise(), {})
        return sum(channels[COLUMNS[meter]][YEAR:].sum() for meter in ("electricity", "gas")
                   if COLUMNS[meter] in channels)
    return float(total(built) - total(after_retrofit(built)))


def write_job(case):
    """The case's job with this bench's studies in place of the screening."""
    folder = case / "job"
    if (folder / "job.toml").exists():
        return folder / "job.toml"
    subprocess.run([large_job.ROOT / "scripts" / "case_to_job", case, folder], check=True,
                   stdout=subprocess.DEVNULL)
    job = folder / "job.toml"
    text = job.read_text()
    job.write_text(text[:text.rindex("[[study]]")] + STUDIES)
    return job


def foretold(result):
    """[draws] saving of all meters [kWh]."""
    with h5py.File(result) as file:
        study = next(group["retrofit"] for group in file.values() if "retrofit" in group)
        meters = [name in (b"electricity", b"gas", b"district")
                  for name in study["output"][:]]
        saving = (study["before"][:] - study["after"][0])[:, meters].sum(axis=1)
    return saving[~np.isnan(saving)]


def score(case, recipe, ranks):
    """(true saving, 5, 50 and 95 % quantiles) [MWh]"""
    truth = case / "saving.json"
    if not truth.exists():
        write_case(case, recipe)
        truth.write_text(json.dumps(true_saving(recipe)))
    result = case / "result.h5"
    if not result.exists():
        try:
            running.run(large_job.PROGRAM, write_job(case), result, ranks, ["--resume"],
                        stdout=subprocess.DEVNULL)
        except CaseError as error:
            sys.exit(f"bench_retrofit: {error}; the same command goes on with it")
    return json.loads(truth.read_text()) / 1e3, *np.quantile(foretold(result),
                                                            (0.05, 0.5, 0.95)) / 1e3


def line(name, value, unit, reference):
    print(f"{name} {value:.3f} {unit} {reference} {value / reference:.3f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--only", type=int, default=20, help="the first so many houses")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--ranks", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--folder", type=pathlib.Path, help="default: build/bench/retrofit_SEED")
    options = parser.parse_args()
    folder = (options.folder or large_job.ROOT / "build" / "bench" /
              f"retrofit_{options.seed}").absolute()
    inside, widths = [], []
    print("house | true saving | 5 % | 50 % | 95 % [MWh]")
    for number in range(options.only):
        true, low, middle, high = score(folder / f"case_{number:03}",
                                        recipe_of(options.seed, number), options.ranks)
        inside.append(low <= true <= high)
        widths.append((high - low) / abs(true))
        print(f"{number} | {true:.1f} | {low:.1f} | {middle:.1f} | {high:.1f}", flush=True)
    line("retrofit_saving_inside_the_interval", 100 * np.mean(inside), "%", 80)
    line("retrofit_width_over_saving", float(np.median(widths)), "-", 1)


main()
