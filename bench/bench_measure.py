#!/usr/bin/python3
"""Does the measurement that a loop advises tell the name? Cases of the generator with one effect.

    bench_measure.py [--only N] [--seed S] [--ranks R] [--folder DIR]

The first loop sees what a utility sees: hourly electricity, and gas where there is any. Where the planted effect is
in a class of several names and a measurement is advised for it, the case's own readings of it, in the advised weeks
alone, join for a second loop; beside that, for a third one, those of another kind or month, drawn at random, for as
many weeks. A name is told where it is right and alone in its class. Of parameters the one whose deviation is foretold
to fall most is measured as advised: its deviation in the loop that has these readings, over the foretold one. Prints
`name value unit reference ratio`.
"""
import argparse
import calendar
import copy
import csv
import pathlib
import sys
from types import SimpleNamespace

import numpy as np

sys.dont_write_bytecode = True
import bench_loop                   # noqa: E402  (also finds the generator and scripts/cases)
import loop_scores                  # noqa: E402
from cases.meters import CHANNELS   # noqa: E402
from loop_names import names_of     # noqa: E402
from report.result import AFTER, read as read_loop   # noqa: E402

CARRIERS = ("electricity", "gas")
CHANNEL_OF = {"room temperature by the hour": "air", "heat meter of the rooms' heating": "heat",
              "heat meter of the rooms' cooling": "cold"}
MONTHS = tuple(calendar.month_name)[1:]


def meters_in(case):
    """{meter of the job: column of the readings}"""
    with open(case / "measured.csv", newline="") as file:
        columns = next(csv.reader(file))
    return {CHANNELS[column][0]: column for column in columns if column in CHANNELS}


def run_loops(cases, meters, folder, ranks):
    """{case's name: Scored} and the result's path; `meters` are those of all cases."""
    listed = "[" + ", ".join(f'"{meter}"' for meter in meters) + "]"
    done = folder.parent / f"job_{folder.name}_{len(cases)}" / "result.h5"
    options = SimpleNamespace(ranks=ranks, score_only=done.exists())
    bench_loop.LADDER[folder.name] = ({"meters": listed}, None)
    result, _ = bench_loop.run(cases, folder.parent, options, folder.name)
    return {scored.name: scored for scored in loop_scores.scores(result, cases)}, result


def rows_of(result, case):
    """What the loop says of every measurement that a case has readings of."""
    return [row for row in read_loop(result, f"{case}/loop").measurements if row.measure in CHANNEL_OF]


def question_of(rows, names):
    """The rows of the first open question about one of these names; [] = none."""
    asked = [row.question for row in rows if row.kind == "name" and any(name in row.question for name in names)]
    return [row for row in rows if asked and row.question == asked[0]]


def widest_of(rows):
    """The advised row of the parameter whose deviation falls most; None where there is none."""
    advised = [row for row in rows if row.kind == "parameter" and row.advised == 1]
    return min(advised, key=lambda row: row.then / row.now, default=None)


def deviation_of(result, case, parameter):
    """Of the last model, as a share of the prior's."""
    loop = read_loop(result, f"{case}/loop")
    at = loop.parameters.index(parameter)
    return loop.sd_of(AFTER, at) / loop.of_parameters[at].sd


def drawn(row, offered, rng):
    """Another kind or month, for as many weeks."""
    choices = [(measure, f"1 {month}") for measure in offered for month in MONTHS
               if (measure, f"1 {month}") != (row.measure, row.begin)
               and MONTHS.index(month) * 30 + 7 * row.weeks <= 360]   # within the year
    other = copy.copy(row)
    other.measure, other.begin = choices[rng.integers(len(choices))]
    return other


def with_readings(case, row, folder):
    """A copy of the case whose readings of the added meter are those of these weeks alone."""
    own = folder / case.name
    own.mkdir(parents=True, exist_ok=True)
    for path in case.iterdir():
        if path.name != "measured.csv" and not (own / path.name).exists():
            (own / path.name).symlink_to(path.resolve())
    column = meters_in(case)[CHANNEL_OF[row.measure]]
    month = MONTHS.index(row.begin.split()[1]) + 1
    with open(case / "measured.csv", newline="") as file:
        lines = list(csv.reader(file))
    at, stamps = lines[0].index(column), np.array([line[0] for line in lines[1:]], dtype="datetime64[h]")
    first = np.datetime64(f"{str(stamps[0])[:4]}-{month:02}-01T00")
    inside = (stamps > first) & (stamps <= first + np.timedelta64(int(7 * 24 * row.weeks), "h"))
    for line, is_inside in zip(lines[1:], inside):
        if not is_inside:
            line[at] = ""
    with open(own / "measured.csv", "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(lines)
    return own


def is_told(scored, planted):
    """Right, and no other name beside it."""
    return any(loop_scores.class_size(effect) == 1
               and loop_scores.is_right(effect, planted, scored.details.get(planted)) for effect in scored.found)


def loop_with(case, row, folder, ranks):
    """The loop that has the readings of a measurement, too: its score (None where it failed) and its result."""
    own = with_readings(case, row, folder / case.name)
    meters = [*(m for m in CARRIERS if m in meters_in(case)), CHANNEL_OF[row.measure]]
    scored, result = run_loops({own: "single"}, meters, folder / case.name / "run", ranks)
    return scored.get(case.name), result


def said(case, row, outcome):
    print(f"# {case.name}: {row.question}: {row.measure}, {row.weeks:.0f} weeks from {row.begin}: {outcome}",
          flush=True)


def tried_names(open_cases, rows, folder, ranks):
    """Whether each name is told with these measurements. {case: row}"""
    told = []
    for case, planted in open_cases.items():
        scored, _ = loop_with(case, rows[case], folder, ranks)
        told.append(scored is not None and is_told(scored, planted))
        said(case, rows[case], "told" if told[-1] else "not told")
    return told


def tried_parameters(rows, folder, ranks):
    """Deviations over those foretold. {case: row}"""
    ratios = []
    for case, row in rows.items():
        scored, result = loop_with(case, row, folder, ranks)
        if scored is None:
            continue
        then = deviation_of(result, case.name, row.question)
        ratios.append(then / row.then)
        said(case, row, f"deviation {row.now:.2f}, foretold {row.then:.2f}, was {then:.2f} of the prior's")
    return ratios


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--only", type=int, default=40, help="cases with one effect; default 40")
    parser.add_argument("--seed", type=int, default=711)
    parser.add_argument("--parameters", type=int, default=10, help="cases whose widest parameter is measured")
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("build/bench/measure"))
    options = parser.parse_args()
    numbers = [k for k, kind in enumerate(bench_loop.kinds(8 * bench_loop.TURNS)) if kind == "single"][:options.only]
    cases = {}
    for number in numbers:
        case = options.folder.resolve() / f"case_{number:03}"
        bench_loop.make_case(case, options.seed, number, "single", "usual", None)
        cases[case] = "single"
    first = {}
    for carriers in {tuple(m for m in CARRIERS if m in meters_in(case)) for case in cases}:
        own = {case: kind for case, kind in cases.items()
               if tuple(m for m in CARRIERS if m in meters_in(case)) == carriers}
        scored, result = run_loops(own, carriers, options.folder.resolve() / "_".join(carriers), options.ranks)
        first |= {case: (scored[case.name], result) for case in own if case.name in scored}
    open_cases, advised, other, wide = {}, {}, {}, {}
    rng = np.random.default_rng(options.seed)
    for case, (scored, result) in first.items():
        planted = next(iter(scored.planted))
        rows = rows_of(result, case.name)
        if widest_of(rows):
            wide[case] = widest_of(rows)
        asked = question_of(rows, names_of(planted, scored.details.get(planted)))
        best = [row for row in asked if row.advised == 1]
        if best:
            open_cases[case], advised[case] = planted, best[0]
            other[case] = drawn(best[0], sorted({row.measure for row in asked}), rng)
    bench_loop.line("measure_open_names", len(open_cases), f"of_{len(first)}", 40)
    for name, rows, reference in (("advised", advised, 75), ("random", other, 0)):
        told = tried_names(open_cases, rows, options.folder.resolve() / name, options.ranks)
        bench_loop.line(f"measure_told_by_the_{name}", bench_loop.share(told), f"%_of_{len(told)}", reference)
    wide = dict(list(wide.items())[:options.parameters])
    ratios = tried_parameters(wide, options.folder.resolve() / "parameter", options.ranks)
    bench_loop.line("measure_deviation_over_foretold", float(np.median(ratios)) if ratios else np.nan,
                    f"of_{len(ratios)}", 1)


if __name__ == "__main__":
    main()
