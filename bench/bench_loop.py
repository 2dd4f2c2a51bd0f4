#!/usr/bin/python3
"""The search for missing effects on cases of the test generator: nulls, one effect, two, and effects
that the catalogue cannot express, all drawn by seed.

    bench_loop.py [--only N] [--seed S] [--ranks R] [--folder DIR] [--rungs RUNG...]
                  [--of operation] [--air declared|silent] [--cases-only | --score-only]

Writes the cases (about 10 s of a core each; those that are there stay), runs the loop on all of them
as one job, which goes on where it was stopped, and prints a line for each case and then
`name value unit reference ratio`. The cases come in turns, so that the first N are a fair sample.
With `--of operation` the single effects, and one of each pair, are of what real meters showed: other
hours, moving holidays, optimum start, a plant of another size. With `--air` every building has an air
handler, of which building.json tells or is silent.
"""
import argparse
import concurrent.futures
import csv
import dataclasses
import os
import pathlib
import subprocess
import sys
import time

import numpy as np

import large_job
import loop_scores  # also finds the generator and scripts/cases
from case import Recipe
from case_folder import write_case
from cases import loop_job, running
from cases.folder import CaseError
from designs import drawn_air_system, drawn_design, drawn_effects
from effects import INSIDE, OPERATION, OUTSIDE

TURN = ("null", "single", "null", "single", "null", "single", "pair", "outside")
TURNS = 20  # 60 nulls, 60 singles, 20 pairs, 20 outside
DRAWN = {   # kind of case: how many effects of which tables
    "usual": {"null": (), "single": ((INSIDE, 1),), "pair": ((INSIDE, 2),),
              "outside": ((OUTSIDE, 1),)},
    "operation": {"null": (), "single": ((OPERATION, 1),), "pair": ((OPERATION, 1), (INSIDE, 1)),
                  "outside": ((OUTSIDE, 1),)}}
LADDER = {"hourly": ({}, None), "electricity": ({"meters": '["electricity"]'}, None),
          "monthly": ({}, "monthly")}


def kinds(n):
    return (TURN * TURNS)[:n]


def recipe(seed, number, kind, of="usual", air=None):
    """The case of that number; the same for the same arguments. Of handlers others are drawn, so that
    the building beside them stays. `air`: what is said of a handler; None: there is none."""
    rng = np.random.default_rng([seed, number])
    climate, design = drawn_design(rng)
    own = int(rng.integers(2 ** 31))
    if air:
        handler = drawn_air_system(np.random.default_rng([seed, number, 1]), air == "declared")
        design = dataclasses.replace(design, air_system=handler)
    effects = {}
    for table, n in DRAWN[of][kind]:
        effects |= drawn_effects(rng, design, table, n)
    return Recipe(climate, "2021-01-01", 730, own, design, effects)


def make_case(folder, *which):
    if not (folder / "truth.json").exists():
        write_case(folder, recipe(*which))


def make_cases(folder, options):
    """{folder: kind} of the first cases."""
    cases = {folder / f"case_{number:03}": kind for number, kind in enumerate(kinds(options.only))}
    n = len(cases)
    with concurrent.futures.ProcessPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        done = [pool.submit(make_case, case, options.seed, number, kind, options.of, options.air)
                for number, (case, kind) in enumerate(cases.items())]
        for number, one in enumerate(concurrent.futures.as_completed(done), 1):
            one.result()
            print(f"\rcases {number}/{n}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    return cases


def run(cases, folder, options, rung):
    """The loop on all cases; the result's path and seconds. An unfinished run goes on."""
    keys, interval = LADDER[rung]
    job, _ = loop_job.write_job(list(cases), folder / f"job_{rung}_{len(cases)}", options=keys,
                                interval=interval)
    result = pathlib.Path(job).with_name("result.h5")
    if options.score_only:
        return result, np.nan
    result.unlink(missing_ok=True)
    begin = time.perf_counter()
    try:
        running.run(large_job.PROGRAM, job, result, options.ranks, ["--resume", "--no-report"],
                    may_fail=True, stdout=subprocess.DEVNULL)
    except CaseError as error:
        sys.exit(f"bench_loop: {error}; the same command goes on with it")
    return result, time.perf_counter() - begin


# --- what is printed

def line(name, value, unit, reference):
    ratio = f"{value / reference:.3f}" if reference else "-"
    print(f"{name} {value:.3f} {unit} {reference if reference else '-'} {ratio}", flush=True)


def share(flags):
    flags = list(flags)
    return 100 * sum(flags) / len(flags) if flags else np.nan


def row_of(s):
    d = ", ".join(f"{size:.0f}" for size in s.detectability.values())
    planted = ", ".join(f"{name} {size:.3g}" for name, size in s.planted.items())
    found = "; ".join(e["name"] + ("" if e["adequate"] else " (not adequate)") for e in s.found)
    step = [f"{100 * s.closed[pair]:.0f}" for pair in s.closed]
    right = all(map(lambda name: loop_scores.is_named(s, name), s.planted)) and \
        not loop_scores.false_effects(s)
    return [s.name, s.kind, planted, d, found, "yes" if right else "no", *step,
            *(f"{s.parameters[model]:.2f}" for model in ("plain", "before", "after"))]


HEAD = ["case", "kind", "planted", "d", "found", "right", "closed by structure", "by effects",
        "in all", "rms z plain", "before", "after"]


def write_table(scored, path):
    with open(path, "w", newline="") as out:
        csv.writer(out, lineterminator="\n").writerows([HEAD, *map(row_of, scored)])
    for row in [HEAD, *map(row_of, scored)]:
        print(" | ".join(row))


def of_kind(scored, *kind):
    return [s for s in scored if s.kind in kind]


def print_among(seen, where, subset, flags):
    """Shares by flag {name: of a case} among some of the cases that are detectable."""
    line(f"loop_{where}", len(subset), f"of_{len(seen)}", 0)
    for name, flag in flags.items():
        line(f"loop_{name}_where_{where}", share(map(flag, subset)), "%", 0)


def print_by_what_shows(seen, flags):
    """Of what moves no meter that matters there is nothing to see, whatever the table says of another
    season; and of an error that parameters and structure close no search can tell the cause."""
    most = 0.8
    moving = [s for s in seen if not np.isnan(s.closed["plain", "before"])]
    print_among(seen, "a_meter_moves", moving, flags)
    print_among(seen, "left_open_by_structure",
                [s for s in moving if s.closed["plain", "before"] < most], flags)


def print_false(nulls, name):
    line(f"{name}_nulls_with_a_false_effect",
         sum(bool(loop_scores.false_effects(s)) for s in nulls), f"of_{len(nulls)}",
         3 * len(nulls) / 60)


def print_names(scored):
    nulls, singles, pairs = (of_kind(scored, kind) for kind in ("null", "single", "pair"))
    seen = [s for s in singles if loop_scores.is_detectable(s)]
    unseen = [s for s in singles if not loop_scores.is_detectable(s)]
    seen_pairs = [s for s in pairs if loop_scores.is_detectable(s)]
    named = lambda s: all(loop_scores.is_named(s, name) for name in s.planted)
    classed = lambda s: all(loop_scores.is_classed(s, name) for name in s.planted)
    found = lambda s: all(loop_scores.is_in_a_found_class(s, name) for name in s.planted)
    print_false(nulls, "loop")
    line("loop_nulls_with_any_effect", sum(bool(s.found) for s in nulls), f"of_{len(nulls)}", 0)
    line("loop_detectable_singles", len(seen), f"of_{len(singles)}", 0)
    line("loop_strict_name", share(map(named, seen)), "%", 70)
    line("loop_strict_name_by_a_parameter", sum(named(s) and bool(loop_scores.by_parameter(s))
                                                for s in seen), f"of_{len(seen)}", 0)
    tellable = [s for s in seen if all(tells == 1 for tells in s.oracle.values())]
    line("loop_oracle_tells", len(tellable), f"of_{len(seen)}", 0)
    line("loop_strict_name_where_the_oracle_tells", share(map(named, tellable)), "%", 95)
    line("loop_class", share(map(classed, seen)), "%", 85)
    line("loop_class_of_found_effects", share(map(found, seen)), "%", 0)
    stated = [len(loop_scores.put_with_parameters(s)) for s in scored]
    line("loop_put_with_parameters", float(np.mean(stated)) if stated else np.nan,
         "of_a_building", 0)
    print_by_what_shows(seen, {"strict_name": named, "class": classed})
    line("loop_cannot_tell_below", share(not s.found for s in unseen), "%", 0)
    line("loop_both_of_a_pair", share(map(classed, seen_pairs)), "%", 65)
    line("loop_both_of_a_pair_found", share(map(found, seen_pairs)), "%", 0)
    line("loop_both_of_a_pair_strict", share(map(named, seen_pairs)), "%", 0)
    line("loop_adequate_but_wrong", share(map(loop_scores.is_adequate_but_wrong, of_kind(
        scored, "single", "pair", "outside"))), "%", 5)
    line("loop_adequate_but_wrong_outside", share(map(loop_scores.is_adequate_but_wrong, of_kind(
        scored, "outside"))), "%", 0)


def print_air_systems(scored):
    """That are found in buildings which have nothing of one; numbers of those that nobody declared."""
    without = list(filter(loop_scores.has_none_of_an_air_system, scored))
    line("loop_air_system_where_none_is", sum(map(loop_scores.has_found_an_air_system, without)),
         f"of_{len(without)}", 0)
    off = [abs(z) for s in scored for z in s.of_terminals]
    line("loop_terminals_within_2_prior_sd", sum(z <= 2 for z in off), f"of_{len(off)}", 0)
    line("loop_terminals_off_median", float(np.median(off)) if off else np.nan, "prior_sd", 0)


def print_classes(scored):
    sizes = [loop_scores.class_size(effect) for s in scored for effect in s.found]
    for name, at in (("median", 50), ("p90", 90)):
        line(f"loop_class_size_{name}", float(np.percentile(sizes, at)) if sizes else np.nan,
             "names", 0)


def print_reliability(scored):
    """How often what is said is so; 90 % intervals are `loop_coverage`."""
    wrong = [loop_scores.false_effects(s) for s in scored]
    adequate = [effect not in false for s, false in zip(scored, wrong) for effect in s.found
                if effect["adequate"]]
    calendars = [loop_scores.is_right_calendar(s, effect) for s in scored for effect in s.found
                 if loop_scores.calendar_of(effect)]
    line("loop_adequate_effects_right", share(adequate), f"%_of_{len(adequate)}", 95)
    line("loop_calendars_right", share(calendars), f"%_of_{len(calendars)}", 90)


BINS = (0, 0.2, 0.5, 0.9, 1)    # of probabilities


def log_score(probabilities, right):
    """Mean of -log of the probability of what is so; no probability is taken as surer than 0.995."""
    sure = np.clip(probabilities, 0.005, 0.995)
    return float(-np.mean(np.log(np.where(right, sure, 1 - sure))))


def print_probabilities(scored):
    """Of the names that are said of effects: how often they are right where so much is said."""
    said = [pair for s in scored for pair in loop_scores.names_said(s)]
    line("loop_names_with_a_probability", len(said), "names", 100)
    if not said:
        return
    p, right = (np.array(column, float) for column in zip(*said))
    place = np.clip(np.digitize(p, BINS) - 1, 0, len(BINS) - 2)
    off = []
    for k in np.unique(place):
        here = place == k
        off.append((here.sum(), abs(p[here].mean() - right[here].mean())))
        line(f"loop_right_where_said_{BINS[k]:g}_to_{BINS[k + 1]:g}", 100 * right[here].mean(),
             f"%_of_{here.sum()}", 100 * p[here].mean())
    n, by = np.array(off).T
    line("loop_probabilities_off", 100 * float(np.average(by, weights=n)), "points", 10)
    base = log_score(np.full(len(p), right.mean()), right == 1)
    line("loop_log_score", log_score(p, right == 1), "nats", base)


def print_errors(scored):
    planted = of_kind(scored, "single", "pair")
    for name, step, reference in (("structure", ("plain", "before"), 0),
                                  ("effects", ("before", "after"), 0),
                                  ("all", ("plain", "after"), 0.6)):
        shares = [s.closed[step] for s in planted if not np.isnan(s.closed[step])]
        line(f"loop_closed_by_{name}", float(np.median(shares)) if shares else np.nan, "-",
             reference)
    worse = [max(s.errors["after"][c] / s.errors["before"][c] - 1 for c in s.errors["after"])
             for s in scored]
    line("loop_a_channel_worse_by_1_percent", sum(by > 0.01 for by in worse),
         f"of_{len(scored)}", 0)
    line("loop_a_channel_worse_by_two_standard_errors_too", sum(bool(s.worse) for s in scored),
         f"of_{len(scored)}", 0)
    for begin in ("plain", "before"):
        cut = [1 - s.parameters["after"] / s.parameters[begin] for s in planted]
        line(f"loop_parameter_error_cut_from_{begin}",
             100 * float(np.median(cut)) if cut else np.nan, "%", 30)
    line("loop_coverage", share(hit for s in of_kind(scored, "single") for hit in s.covered),
         "%", 80)
    values = [hit for s in of_kind(scored, "single") for hit in s.values_covered]
    line("loop_value_coverage", share(values), f"%_of_{len(values)}", 85)


def print_rung(scored, rung):
    """Strict names on less data, in cases that these data cannot show."""
    unseen = [s for s in of_kind(scored, "single") if not loop_scores.is_detectable(s)]
    seen = len(of_kind(scored, "single")) - len(unseen)
    named = share(all(loop_scores.is_named(s, name) for name in s.planted) for s in unseen)
    line(f"loop_{rung}_detectable", seen, f"of_{seen + len(unseen)}", 0)
    line(f"loop_{rung}_named_below", named, "%", 5)
    print_false(of_kind(scored, "null"), f"loop_{rung}")


def print_lost(scored, cases, rung):
    """Of cases without a result no other figure knows."""
    name = "loop" if rung == "hourly" else f"loop_{rung}"
    line(f"{name}_cases_without_result", len(cases) - len(scored), f"of_{len(cases)}", 0)


def judge(cases, folder, options, rung):
    result, seconds = run(cases, folder, options, rung)
    scored = loop_scores.scores(result, cases)
    write_table(scored, result.with_name("cases.csv"))
    print_lost(scored, cases, rung)
    if rung != "hourly":
        print_rung(scored, rung)
        return
    print_names(scored)
    print_air_systems(scored)
    print_classes(scored)
    print_errors(scored)
    print_reliability(scored)
    print_probabilities(scored)
    line("loop_seconds_per_case", seconds * options.ranks / len(cases), "core_s", 40)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--only", type=int, default=len(TURN) * TURNS, help="the first so many")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--ranks", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--folder", type=pathlib.Path, help="default: build/bench/loop_SEED")
    parser.add_argument("--rungs", nargs="+", choices=LADDER, default=["hourly"],
                        help="of the ladder of data: also electricity alone, meters by month")
    parser.add_argument("--of", choices=DRAWN, default="usual",
                        help="operation: effects are of what real meters showed")
    parser.add_argument("--air", choices=("declared", "silent"),
                        help="all buildings have an air handler, of which building.json tells or not")
    parser.add_argument("--cases-only", action="store_true", help="write the cases, run nothing")
    parser.add_argument("--score-only", action="store_true", help="read the last run's result")
    return parser.parse_args()


def main():
    options = arguments()
    parts = [part for part in (options.of, options.air) if part not in ("usual", None)]
    folder = (options.folder or large_job.ROOT / "build" / "bench" /
              "_".join(["loop", str(options.seed), *parts])).absolute()
    cases = make_cases(folder, options)
    if options.cases_only:
        return
    for rung in options.rungs:
        judge(cases, folder, options, rung)


if __name__ == "__main__":
    main()
