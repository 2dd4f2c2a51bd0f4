#!/usr/bin/python3
"""Nights over a made stock: what is told of effects that begin or end, what is told falsely, and what a quiet night costs.

    bench_nights.py [--buildings 20] [--weeks 26] [--changing 0.1] [--seed 1] [--ranks R] [--folder DIR]
                    [--false-alarms 0.001] [--quick] [--cases-only]

The buildings are the test generator's offices with a year of readings, in which a loop seeks effects, and `--weeks`
weekly nights after it. In a share of them an effect of the generator begins or ends on a day of the first 22 weeks, by
turns: its meters are those with the effect on one side of that day and those without it on the other, with the same
errors. Half of the others have an effect all the time.

Prints a line for each that changes, then `name value unit reference ratio`. Detectability d is of the four weeks behind
the day, by the readings' own errors: sqrt(sum (x / s)^2) over all hours and meters, x the change less what the hour
before it explains (lag-1 correlation of the errors), s their spread. What changes counts as told in time if a night
within four weeks of the day tells a step; every other step is false, but those that follow one in the same building
within four weeks. Those before any change stand in a line of their own: the others are of a model that a change has made
wrong.
"""
import argparse
import collections
import dataclasses
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import time

import h5py
import numpy as np

import large_job

sys.path[:0] = [str(large_job.ROOT / "scripts"), str(large_job.ROOT / "tests" / "generator")]

from case import SETTLING_DAYS, Recipe, weather_of                      # noqa: E402
from case_folder import (YEAR, building, measured_of, true_channels,   # noqa: E402
                         write_epw, write_readings)
from cases import loop_job                                              # noqa: E402
from designs import drawn_design, drawn_effects                         # noqa: E402
from drives import AVERAGE_DAYS, DayNoise                               # noqa: E402
from effects import INSIDE                                              # noqa: E402
from office import as_built                                             # noqa: E402
from simulate import part_of                                            # noqa: E402
from weather import STEPS_PER_HOUR                                      # noqa: E402

FIRST, WEEK, DAY = np.datetime64("2022-01-01"), 7, 24
IN_TIME = 4 * WEEK        # [d]
STRONG = 8                # of d
QUICK = "most_effects = 2\ntry_structures = false\ngeneric = false\nfunctions = false\n"
COUNTED = ("new", "ended", "changed")


@dataclasses.dataclass
class Made:
    name: str
    kind: str             # begins, ends, has, null
    effects: dict
    day: int = -1         # of the change, behind the first year
    d: float = np.nan
    told: list = dataclasses.field(default_factory=list)   # (night's last day, words)


def kind_of(k, n, share):
    """Those that change stand evenly among the others."""
    n_changing = round(n * share)
    if n_changing and (k * n_changing) // n != ((k + 1) * n_changing) // n:
        return ("begins", "ends")[((k + 1) * n_changing // n) % 2]
    return ("null", "has")[k % 2]


def detectability(change, errors):
    """Over all meters, by the readings' own errors."""
    total = 0.0
    for column, x in change.items():
        error = errors[column]
        sound = np.isfinite(error[1:]) & np.isfinite(error[:-1])
        keep = np.corrcoef(error[1:][sound], error[:-1][sound])[0, 1]
        spread = np.sqrt((1 - keep ** 2) * np.nanvar(error))
        total += np.sum((x[1:] - keep * x[:-1]) ** 2) / spread ** 2 if spread > 0 else 0.0
    return float(np.sqrt(total))


def readings_of(recipe, made):
    """The two years' readings, spliced on the day of the change; sets its d."""
    built, weather = as_built(recipe.design, recipe.seed), weather_of(recipe)
    true = lambda effects, noise=DayNoise(): true_channels(recipe, built, weather, noise, effects)
    shown = part_of(weather, SETTLING_DAYS * DAY * STEPS_PER_HOUR, len(weather.times))
    times = shown.times[::STEPS_PER_HOUR]
    with_it = true(made.effects)
    if made.day < 0:
        return times, measured_of(recipe, with_it)
    without = true({})
    before, after = (with_it, without) if made.kind == "ends" else (without, with_it)
    at = YEAR + made.day * DAY
    spliced = {column: np.concatenate([before[column][:at], after[column][at:]]) for column in before}
    measured = measured_of(recipe, spliced)
    expected = true({}, AVERAGE_DAYS)
    weeks = slice(at, at + IN_TIME * DAY)
    errors = {column: (measured_of(recipe, without)[column] - expected[column])[:YEAR] for column in before}
    made.d = detectability({c: (after[c] - before[c])[weeks] for c in before}, errors)
    return times, measured


def write_made(case, recipe, made):
    """building.json, two years' weather, all readings."""
    case.mkdir(exist_ok=True)
    (case / "building.json").write_text(json.dumps(building(recipe, case.name), indent=1))
    shown = part_of(weather_of(recipe), SETTLING_DAYS * DAY * STEPS_PER_HOUR, 2 * YEAR * STEPS_PER_HOUR
                    + SETTLING_DAYS * DAY * STEPS_PER_HOUR)
    for name, first in (("train", 0), ("test", YEAR)):
        write_epw(case / f"weather_{name}.epw", shown, first, first + YEAR)
    times, measured = readings_of(recipe, made)
    np.savez(case / "readings.npz", d=made.d, times=times, **measured)


def make(folder, k, options):
    rng = np.random.default_rng([options.seed, k])
    climate, design = drawn_design(rng)
    kind = kind_of(k, options.buildings, options.changing)
    effects = {} if kind == "null" else drawn_effects(rng, design, INSIDE, 1)
    made = Made(f"b{k:04}", kind, effects)
    if kind in ("begins", "ends"):
        made.day = int(rng.integers(WEEK, WEEK * max(options.weeks - 4, 2)))
    recipe = Recipe(climate, "2021-01-01", 730, int(rng.integers(2 ** 31)), design, effects)
    case = folder / made.name
    if not (case / "readings.npz").exists():
        write_made(case, recipe, made)
    with np.load(case / "readings.npz") as kept:
        made.d, times = float(kept["d"]), kept["times"]
        measured = {column: kept[column] for column in kept.files if column not in ("d", "times")}
    write_readings(case / "measured.csv", times[:YEAR], {c: v[:YEAR] for c, v in measured.items()})
    text = loop_job.building_text(str(case), made.name)
    text = re.sub(r"^held_out = .*$", f'since = ["{FIRST}", "@to@"]', text, flags=re.M)
    (folder / f"{made.name}.toml").write_text(text)
    return made


def write_night(folder, buildings, night):
    """Readings up to the night, and the table."""
    n_days = WEEK * night
    last = FIRST + n_days - 1
    rows = ["name,file,to"]
    for made in buildings:
        with np.load(folder / made.name / "readings.npz") as kept:
            n = YEAR + n_days * DAY
            write_readings(folder / made.name / "measured.csv", kept["times"][:n],
                           {c: kept[c][:n] for c in kept.files if c not in ("d", "times")})
        rows.append(f"{made.name},{made.name}.toml,{last}")
    (folder / "stock.csv").write_text("\n".join(rows) + "\n")


def write_job(folder, options):
    (folder / "job.toml").write_text(
        f'seed = 1\n[stock]\ntable = "stock.csv"\nfalse_alarms = {options.false_alarms}\n[[study]]\nkind = "loop"\n'
        + (QUICK if options.quick else ""))


def run(folder, night, options):
    """Processor seconds."""
    result = folder / f"night_{night:02}.h5"
    words = ["--after", folder / f"night_{night - 1:02}.h5"] if night > 1 else []
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(["mpirun", "-np", str(options.ranks), "--oversubscribe", large_job.PROGRAM, "run", folder / "job.toml",
                    "-o", result, "--force", "--threads", "1", "--no-report", *words], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def read(folder, night, buildings):
    """Adds what is told to the buildings. (statuses, searches)"""
    with h5py.File(folder / f"night_{night:02}.h5") as file:
        stock = file["stock"]
        words = lambda name: [text.decode() for text in stock[name][:]]
        for made, told in zip(buildings, words("stock_told"), strict=True):
            if night > 1 and told:
                made.told.append((WEEK * night, told))
        return words("stock_status"), stock["stock_searches"][:]


def is_step(words):
    return any(part.startswith(COUNTED) for part in words.split("; "))


def judged(made):
    """(told in time, false alarms)"""
    nights = [day for day, words in made.told if is_step(words)]
    in_time = [day for day in nights if made.day >= 0 and made.day < day <= made.day + IN_TIME + WEEK]
    follows = lambda day: any(first < day <= first + IN_TIME for first in in_time[:1])
    return bool(in_time), sum(day not in in_time and not follows(day) for day in nights)


def quiet_weeks(made, options):
    """(nights that tell a step, nights) before anything has changed in the building."""
    last = made.day if made.day >= 0 else WEEK * options.weeks
    return sum(day <= last and is_step(words) for day, words in made.told), last // WEEK - 1


def line(name, value, unit, reference):
    ratio = f"{value / reference:.3f}" if reference else "-"
    print(f"{name} {value:.4g} {unit} {reference if reference else '-'} {ratio}", flush=True)


def score(buildings, options, core_seconds):
    changing = [made for made in buildings if made.day >= 0]
    for made in buildings:
        if made.day >= 0 or made.told:
            print(made.name, made.kind, *(f"{name} {size:.3g}" for name, size in made.effects.items()), f"day {made.day}",
                  f"d {made.d:.1f}", made.told, sep=" | ")
    strong = [made for made in changing if made.d >= STRONG]
    told = [judged(made)[0] for made in strong]
    false, weeks = sum(judged(made)[1] for made in buildings), len(buildings) * (options.weeks - 1)
    line("nights_changing", len(changing), f"of_{len(buildings)}", 0)
    line("nights_told_in_four_weeks", 100 * np.mean(told) if told else np.nan, f"%_of_{len(told)}_with_d_8", 80)
    for kind in ("begins", "ends"):
        of_kind = [judged(made)[0] for made in strong if made.kind == kind]
        line(f"nights_{kind}_told", 100 * np.mean(of_kind) if of_kind else np.nan, f"%_of_{len(of_kind)}", 0)
    told, quiet = map(sum, zip(*(quiet_weeks(made, options) for made in buildings)))
    line("nights_false_before_any_change", told, f"of_{quiet}_building_weeks", quiet / 500)
    line("nights_false", false, f"of_{weeks}_building_weeks", weeks / 500)
    line("nights_quiet", np.median(core_seconds) if core_seconds else np.nan, "core_s_a_building", 0.5)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--buildings", type=int, default=20)
    parser.add_argument("--weeks", type=int, default=26)
    parser.add_argument("--changing", type=float, default=0.1, help="share of the buildings")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--ranks", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--false-alarms", type=float, default=0.001, help="of a building in a week")
    parser.add_argument("--folder", type=pathlib.Path, help="default: build/bench/nights_SEED")
    parser.add_argument("--first", type=int, default=1, help="the night to go on from")
    parser.add_argument("--quick", action="store_true",
                        help="the catalogue alone, two effects at most, the structure as described")
    parser.add_argument("--cases-only", action="store_true")
    options = parser.parse_args()
    folder = (options.folder or large_job.ROOT / "build" / "bench" / f"nights_{options.seed}").absolute()
    folder.mkdir(parents=True, exist_ok=True)
    buildings = [make(folder, k, options) for k in range(options.buildings)]
    if options.cases_only:
        return
    write_job(folder, options)
    quiet, n_searches = [], collections.Counter()
    for night in range(1, options.weeks + 1):
        begin = time.perf_counter()
        if night >= options.first:
            write_night(folder, buildings, night)
            seconds = run(folder, night, options)
        status, searches = read(folder, night, buildings)
        n_searches["first" if night == 1 else "later"] += int(searches.sum())
        if night >= options.first and not searches.sum():
            quiet.append(seconds / len(buildings))
        print(f"night {night}: {collections.Counter(status)}, {int(searches.sum())} searches, "
              f"{time.perf_counter() - begin:.1f} s", file=sys.stderr, flush=True)
    score(buildings, options, quiet)
    line("nights_searches_later", n_searches["later"], f"of_{len(buildings) * (options.weeks - 1)}_building_weeks", 0)


if __name__ == "__main__":
    main()
