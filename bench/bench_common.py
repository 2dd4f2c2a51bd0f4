#!/usr/bin/python3
"""A weather station that is off, over a stock of buildings: whether the stock finds that all share it, and names it in
more buildings than these do by themselves.

    bench_common.py [--buildings 40] [--off 1.5] [--seeds 1 [SEED ...]] [--ranks R] [--folder DIR] [--no-search]
                    [--declared]

The buildings are the test generator's offices with a year of readings; half of them have an effect of the generator
beside. All weather files are warmer by --off K than the weather was. One night searches all of them; with --no-search
each is calibrated, its structure is chosen, and nothing is sought. With --declared a second night has the lines in its
template that the first one advised, and it is counted in how many of the buildings with an effect the search names it.
Prints `name value unit reference ratio`: of each seed what all share, buildings named by themselves and by the stock,
and in how many seeds the station is what all share.
"""
import argparse
import os
import pathlib
import types

import bench_nights
import h5py
import large_job
from loop_names import RIGHT

NAME = "urban heat island or station offset"
DRY_BULB, HEADER = 6, 8     # column and lines of a weather file
ONE_WEEK = 1                # of nights: the search alone
NO_SEARCH = "most_effects = 0\nfunctions = false\n"


def read_warmer(path, by):
    """A weather file whose thermometer reads so much more; once."""
    done = path.with_suffix(".off")
    if done.exists():
        return
    lines = path.read_text().splitlines()
    for k in range(HEADER, len(lines)):
        fields = lines[k].split(",")
        fields[DRY_BULB] = f"{float(fields[DRY_BULB]) + by:.2f}"
        lines[k] = ",".join(fields)
    path.write_text("\n".join(lines) + "\n")
    done.touch()


def make(folder, options, seed):
    drawn = types.SimpleNamespace(seed=seed, buildings=options.buildings, changing=0, weeks=ONE_WEEK)
    buildings = [bench_nights.make(folder, k, drawn) for k in range(options.buildings)]
    for made in buildings:
        for part in ("train", "test"):
            read_warmer(folder / made.name / f"weather_{part}.epw", options.off)
    return buildings


def names_in(result):
    """({building: names by itself}, {building: names by the stock}, [(of all, mean, probability, section)])"""
    with h5py.File(result) as file:
        stock = file["stock"]
        words = lambda name: [text.decode() for text in stock[name][:]] if name in stock else []
        numbers = lambda name: stock[name][:] if name in stock else []
        alone, by_stock = ({k: set() for k in range(len(words("stock_building")))} for _ in range(2))
        for building, own, other in zip(numbers("stock_effects_of"), words("stock_effect"),
                                        words("stock_effect_by_stock")):
            alone[int(building)].add(own)
            by_stock[int(building)].add(other)
        for building, name in enumerate(words("stock_undecided")):
            by_stock[building].add(name)
        of_all = list(zip(words("stock_all_effect"), numbers("stock_all_mean"), numbers("stock_all_probability"),
                          words("stock_all_section")))
    return alone, by_stock, of_all


def right_names(buildings, alone):
    """(in how many of those with an effect the search names it, of how many)"""
    planted = [(k, effect) for k, made in enumerate(buildings) for effect in made.effects]
    return sum(bool(alone[k] & set(RIGHT[effect].names)) for k, effect in planted), len(planted)


def declare(folder, buildings, section):
    """Into every building's file."""
    for made in buildings:
        path = folder / f"{made.name}.toml"
        path.write_text(path.read_text() + "\n" + section)


def night(folder, buildings, options):
    bench_nights.write_job(folder, options)
    if options.no_search:
        with open(folder / "job.toml", "a") as job:
            job.write(NO_SEARCH)
    bench_nights.write_night(folder, buildings, ONE_WEEK)
    seconds = bench_nights.run(folder, ONE_WEEK, options)
    return seconds, *names_in(folder / "night_01.h5")


def print_right(seed, which, buildings, alone):
    right, of = right_names(buildings, alone)
    bench_nights.line(f"common_seed_{seed}_right_names_{which}", right, f"of_{of}", 0)


def judge(seed, options):
    """Whether the station is what all share."""
    folder = options.folder.absolute() / f"{seed}_{options.off:g}"
    folder.mkdir(parents=True, exist_ok=True)
    buildings = make(folder, options, seed)
    seconds, alone, by_stock, of_all = night(folder, buildings, options)
    print(f"# seed {seed}: {'; '.join(f'{name} {mean:.3g} ({p:.2f})' for name, mean, p, _ in of_all)}; "
          f"{seconds / options.buildings:.0f} core s a building", flush=True)
    n_alone, n_by_stock = (sum(NAME in names for names in of.values()) for of in (alone, by_stock))
    bench_nights.line(f"common_seed_{seed}_named_by_themselves", n_alone, f"of_{options.buildings}", 0)
    bench_nights.line(f"common_seed_{seed}_named_by_the_stock", n_by_stock, f"of_{options.buildings}", n_alone)
    section = next((section for name, _, _, section in of_all if name == NAME), "")
    if options.declared and section:
        print_right(seed, "without", buildings, alone)
        declare(folder, buildings, section)
        print_right(seed, "with", buildings, night(folder, buildings, options)[1])
    return bool(section)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--buildings", type=int, default=40)
    parser.add_argument("--off", type=float, default=1.5, help="K that the station reads too much")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1])
    parser.add_argument("--ranks", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--folder", type=pathlib.Path, default=large_job.ROOT / "build" / "bench" / "common")
    parser.add_argument("--no-search", action="store_true", help="half the time: what all share needs no search")
    parser.add_argument("--declared", action="store_true", help="a second night that has what the first one advised")
    options = parser.parse_args()
    options.false_alarms, options.quick = 0.001, False
    found = sum(judge(seed, options) for seed in options.seeds)
    n = len(options.seeds)
    bench_nights.line("common_found", found, f"of_{n}", 0.9 * n if options.off else 0)


if __name__ == "__main__":
    main()
