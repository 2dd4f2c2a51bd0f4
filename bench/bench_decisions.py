#!/usr/bin/python3
"""How much each number that decides in a loop decides: all loops again with the number a quarter larger and smaller.

    bench_decisions.py [--cases N] [--weeks N] [--only NAME ...] [--part K/N] [--seed N] [--folder DIR]

The numbers are those of src/{loop,effects,functions}/decisions.hpp. A copy of the project is built in which each may be
changed when the program starts; unchanged it does what the project does. A whole number moves by one at least.
The cases are the generator's (bench_loop.py), cut to some weeks of each year, for a loop on a year takes half a minute.
Decisions of a case are the effects that have joined and the refinements that are left; what of these
changes is counted over what there is in one or the other. Functions are counted apart: they have no
names, and one easily takes another's place.
A finished loop stands in --folder, and the same command goes on. Parts are for several cores: 1/2 and 2/2.
Prints `number factor changed_% changed_functions_% before after`, then how many change more than 2 % of decisions.
"""
import argparse
import datetime
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import bench_loop
import h5py
import large_job
from cases import loop_job, running    # found by bench_loop

FOLDERS = ("loop", "effects", "functions")
LENGTHS = ("nearest_days",)    # of arrays: the compiler must know them, and they stay as they are
FACTORS = (1.25, 0.75)
LEAST_SHARE = 0.02        # of decisions: what decides changes more
WEEKS = 9
CONSTANT = re.compile(r"inline constexpr (\w+(?:::\w+)?) (\w+) = ([^;]+);")
CHANGED = """#pragma once
#include <cmath>
#include <cstdlib>
#include <string>
#include <type_traits>

/// value, or what the environment's BEMCAL_NUMBER = "name factor" makes of it.
template <class T>
T changed_number(const char* name, T value) {
    const char* said = std::getenv("BEMCAL_NUMBER");
    if (said == nullptr) return value;
    const std::string all = said;
    const auto space = all.find(' ');
    if (all.substr(0, space) != name) return value;
    const double factor = std::stod(all.substr(space));
    if constexpr (std::is_integral_v<T>) {
        const auto by = std::lround((factor - 1) * static_cast<double>(value));
        return static_cast<T>(static_cast<long>(value) + (by != 0 ? by : factor > 1 ? 1 : -1));
    } else {
        return value * factor;
    }
}
"""


def numbers_of(folder):
    """[name] of a folder's header, of lists their elements: name[0], ..."""
    text = (large_job.ROOT / "src" / folder / "decisions.hpp").read_text()
    names = []
    for of, name, value in CONSTANT.findall(text):
        if name in LENGTHS:
            continue
        places = [f"[{k}]" for k in range(value.count(",") + 1)] if of == "std::array" else [""]
        names += [f"{folder}.{name}{place}" for place in places]
    return names


def changeable(text, folder):
    """A header whose numbers are read when the program starts."""
    def one(match):
        of, name, value = match.groups()
        if name in LENGTHS:
            return match.group()
        if of != "std::array":
            return f'inline const {of} {name} = changed_number<{of}>("{folder}.{name}", {value});'
        parts = [part.strip() for part in value.strip("{} \n").split(",")]
        return f"inline const std::array {name} = {{" + ", ".join(
            f'changed_number("{folder}.{name}[{k}]", {part})' for k, part in enumerate(parts)) + "};"
    made = CONSTANT.sub(one, text)
    return made.replace("#include", '#include "base/changed_number.hpp"\n#include', 1) if "#include" in made else \
        made.replace("#pragma once", '#pragma once\n\n#include "base/changed_number.hpp"', 1)


def with_later_constants(text):
    """A source in which what follows from a number is read when the program starts, too."""
    names = "|".join(name.partition(".")[2].partition("[")[0] for folder in FOLDERS for name in numbers_of(folder))
    text = re.sub(rf"\bstatic constexpr\b(?=[^;]*\b(?:{names})\b)", "static inline const", text)    # of a class
    return re.sub(rf"\bconstexpr\b(?=[^;]*\b(?:{names})\b)", "const", text)


def build(folder):
    """The program whose numbers may be changed."""
    tree = folder / "project"
    listed = subprocess.run(["git", "ls-files"], cwd=large_job.ROOT, capture_output=True, text=True, check=True)
    for name in listed.stdout.splitlines():
        source, to = large_job.ROOT / name, tree / name
        if not source.is_file():
            continue
        to.parent.mkdir(parents=True, exist_ok=True)
        if name.startswith("src/") and source.suffix in (".cpp", ".hpp"):
            text = source.read_text()
            of = source.parent.name
            is_header = source.name == "decisions.hpp" and of in FOLDERS
            text = changeable(text, of) if is_header else with_later_constants(text)
            if not to.exists() or to.read_text() != text:
                to.write_text(text)
        elif not to.exists() or to.stat().st_mtime < source.stat().st_mtime:
            shutil.copy2(source, to)
    (tree / "src" / "base" / "changed_number.hpp").write_text(CHANGED)
    environment = {**os.environ, "CXXFLAGS": "-Wno-narrowing"}    # constants may be narrowed, others not
    subprocess.run(["scripts/build", "release", "bemcal-batch"], cwd=tree, env=environment, check=True)
    return tree / "build" / "release" / "bemcal-batch"


def cut(path, weeks):
    """Periods of a building's file, to their first weeks."""
    def shorter(match):
        name, year = match.groups()
        last = datetime.date(int(year), 1, 1) + datetime.timedelta(days=7 * weeks - 1)
        return f'{name} = ["{year}-01-01", "{last}"]'
    path.write_text(re.sub(r'(training|held_out) = \["(\d{4})-[^"]*", "[^"]*"\]', shorter, path.read_text()))


def write_job(options):
    numbers = range(options.cases)
    kinds = bench_loop.kinds(len(bench_loop.TURN) * bench_loop.TURNS)
    cases = [options.folder / f"case_{number:03}" for number in numbers]
    for case, number in zip(cases, numbers):
        bench_loop.make_case(case, options.seed, number, kinds[number], "usual", None)
    folder = options.folder / f"job_{options.weeks}"
    job, _ = loop_job.write_job(cases, folder, options={})
    for case in cases:
        cut(folder / f"{case.name}.toml", options.weeks)
    return pathlib.Path(job)


def said_by(result):
    """({decision}, {function}) of all cases."""
    decided, functions = set(), set()
    with h5py.File(result) as file:
        for case in file:
            if "loop" not in file[case]:
                continue
            loop = file[case]["loop"]
            texts = lambda name: loop[name].asstr()[:]
            decided |= {(case, name) for kind in ("effect", "refinement") for name in texts(kind)}
            functions |= {(case, *pair) for pair in zip(texts("function_hook"), texts("function_driver"))}
    return decided, functions


def share_changed(one, other):
    return len(one ^ other) / max(len(one | other), 1)


def decisions_with(program, job, folder, number, factor):
    """What is decided with a number changed; nothing where the program cannot work with it."""
    name = f"{number} {factor}" if number else "unchanged"
    kept = folder / "decided" / f"{re.sub(r'[^A-Za-z0-9.]', '_', name)}.json"
    if not kept.exists():
        kept.parent.mkdir(exist_ok=True)
        result = kept.with_suffix(".h5")
        result.unlink(missing_ok=True)
        environment = {**running.environment(), "OMP_NUM_THREADS": "1"} | ({"BEMCAL_NUMBER": name} if number else {})
        subprocess.run([program, "run", job, "-o", result, "--no-report", "--force"], env=environment, check=False,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        said = said_by(result) if result.exists() else (None, None)
        kept.write_text(json.dumps([sorted(each) if each is not None else None for each in said]))
        result.unlink(missing_ok=True)
    return [None if each is None else set(map(tuple, each)) for each in json.loads(kept.read_text())]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--cases", type=int, default=8)
    parser.add_argument("--weeks", type=int, default=WEEKS)
    parser.add_argument("--only", nargs="*", metavar="NAME")
    parser.add_argument("--part", default="1/1")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder", type=pathlib.Path, default=large_job.ROOT / "build" / "bench" / "decisions")
    options = parser.parse_args()
    options.folder = options.folder.absolute()
    options.folder.mkdir(parents=True, exist_ok=True)
    numbers = options.only or [name for folder in FOLDERS for name in numbers_of(folder)]
    part, of = map(int, options.part.split("/"))
    program = pathlib.Path(os.environ.get("BEMCAL_CHANGEABLE") or build(options.folder))
    job = write_job(options)
    base = decisions_with(program, job, options.folder, "", 1)
    deciding = set()
    for number in numbers[part - 1::of]:
        for factor in FACTORS:
            with_it = decisions_with(program, job, options.folder, number, factor)
            if with_it[0] is None:
                print(f"# {number} {factor}: the program refuses it", flush=True)
                continue
            share, of_functions = map(share_changed, base, with_it)
            if share > LEAST_SHARE:
                deciding.add(number)
            print(f"{number} {factor} {100 * share:.1f} {100 * of_functions:.1f} {len(base[0])} {len(with_it[0])}",
                  flush=True)
    print(f"numbers_that_decide {len(deciding)} of_{len(numbers[part - 1::of])} 15 {len(deciding) / 15:.2f}")
    if deciding:
        print("# " + ", ".join(sorted(deciding)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
