#!/usr/bin/python3
"""A weather station that is off, over a stock of buildings: whether the stock finds it as common, and names it in more
buildings than these do by themselves.

    bench_common.py [--buildings 40] [--off 1.5] [--seeds 1 [SEED ...]] [--ranks R] [--folder DIR] [--quick]

The buildings are the test generator's offices with a year of readings; half of them have an effect of the generator
beside. All weather files are warmer by --off K than the weather was. One night searches all of them.
Prints `name value unit reference ratio`: of each seed buildings named by themselves and by the stock, and of how many
seeds it is the first of the effects in common, in half of the buildings or more.
"""
import argparse
import os
import pathlib
import types

import bench_nights
import h5py
import large_job

NAME = "urban heat island or station offset"
DRY_BULB, HEADER = 6, 8     # column and lines of a weather file
ONE_WEEK = 1                # of nights: the search alone


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
    """({building: names by itself}, {building: names by the stock}, [(common name, expected)])"""
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
        common = list(zip(words("stock_common_effect"), numbers("stock_common_expected")))
    return alone, by_stock, common


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--buildings", type=int, default=40)
    parser.add_argument("--off", type=float, default=1.5, help="K that the station reads too much")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1])
    parser.add_argument("--ranks", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--folder", type=pathlib.Path, default=large_job.ROOT / "build" / "bench" / "common")
    parser.add_argument("--quick", action="store_true", help="as of bench_nights.py")
    options = parser.parse_args()
    options.false_alarms = 0.001
    found = 0
    for seed in options.seeds:
        folder = options.folder.absolute() / str(seed)
        folder.mkdir(parents=True, exist_ok=True)
        bench_nights.write_job(folder, options)
        bench_nights.write_night(folder, make(folder, options, seed), ONE_WEEK)
        seconds = bench_nights.run(folder, ONE_WEEK, options)
        alone, by_stock, common = names_in(folder / "night_01.h5")
        n_alone, n_by_stock = (sum(NAME in names for names in of.values()) for of in (alone, by_stock))
        is_found = bool(common) and common[0][0] == NAME and common[0][1] >= options.buildings / 2
        found += is_found
        print(f"# seed {seed}: {'; '.join(f'{name} {expected:.1f}' for name, expected in common[:5])}; "
              f"{seconds / options.buildings:.0f} core s a building", flush=True)
        bench_nights.line(f"common_seed_{seed}_named_by_themselves", n_alone, f"of_{options.buildings}", 0)
        bench_nights.line(f"common_seed_{seed}_named_by_the_stock", n_by_stock, f"of_{options.buildings}", n_alone)
    bench_nights.line("common_found", found, f"of_{len(options.seeds)}", 0.9 * len(options.seeds))


if __name__ == "__main__":
    main()
