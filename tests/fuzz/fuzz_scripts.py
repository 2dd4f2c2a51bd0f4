#!/usr/bin/python3
"""Throws damaged files at the scripts: each ends with a message and a known code, never with a traceback.

    fuzz_scripts.py [--seconds 60] [--attempts N] [--seed 1] [--only case_to_job]

Cases (building.json and its files) for case_to_job; results for result_report, stock_report and still_holds, with
bytes changed, or datasets taken away, cut, of other types or no numbers; weather, readings, exports, options and
EnergyPlus files for new. The first fault ends it with code 1; what broke a script stays in build/fuzz/found.
"""
import argparse
import copy
import datetime
import importlib.machinery
import json
import os
import pathlib
import random
import shutil
import signal
import sys
import tempfile
import time

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests" / "scripts")]

import fake_loop_result  # noqa: E402
import fake_results  # noqa: E402
import test_case_to_job  # noqa: E402
import test_new  # noqa: E402
import test_new_idf  # noqa: E402

DAY = datetime.timedelta(days=1)
LIMIT = 60                     # seconds of one attempt
CODES = {0, 1, 64, 65, 66, 74}
VALUES = [None, True, -1, 0, 1e308, float("nan"), float("inf"), "", "x", "off", [], {}, [[]], [1, "a"], {"a": 1},
          "01-01/13-45", 10**30, "\ud800", "\"\"\"\n[x]", {"wd": [1]}]
NUMBERS = [np.nan, np.inf, -1, 0, 1e300, 7, 1e9]


def script(name):
    return importlib.machinery.SourceFileLoader(name, str(ROOT / "scripts" / name)).load_module()


def outcome(module, words, log):
    """(how it ended, what it said), of the script's main in a process of its own."""
    child = os.fork()
    if child == 0:
        os.setpgid(0, 0)
        said = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
        os.dup2(said, 1)
        os.dup2(said, 2)
        sys.argv = [module.__name__, *map(str, words)]
        code = 70
        try:
            module.main()
            code = 0
        except SystemExit as end:
            if isinstance(end.code, str):
                print(end.code, file=sys.stderr)
            code = end.code if isinstance(end.code, int) else int(end.code is not None)
        except BaseException:
            sys.excepthook(*sys.exc_info())
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)
    end = time.monotonic() + LIMIT
    while (done := os.waitpid(child, os.WNOHANG))[0] == 0:
        if time.monotonic() > end:
            os.killpg(child, signal.SIGKILL)
            os.waitpid(child, 0)
            return "too long", ""
        time.sleep(0.002)
    return os.waitstatus_to_exitcode(done[1]), pathlib.Path(log).read_text(errors="replace")


def is_sound(code, said):
    return code in CODES and "Traceback" not in said and (code in (0, 1) or bool(said.strip()))


def places(value, path=()):
    """Every place in what JSON holds."""
    yield path
    if isinstance(value, (dict, list)):
        for key in (value if isinstance(value, dict) else range(len(value))):
            yield from places(value[key], (*path, key))


def changed(case, rng):
    case = json.loads(json.dumps(case))
    for _ in range(rng.choice((1, 1, 2, 4))):
        path = rng.choice([p for p in places(case) if p])
        owner = case
        for key in path[:-1]:
            owner = owner[key]
        if rng.random() < 0.2:
            del owner[path[-1]]
        else:
            owner[path[-1]] = copy.deepcopy(rng.choice(VALUES))
        if not case:
            break
    return case


def with_bytes_changed(text, rng):
    text = bytearray(text)
    for _ in range(rng.choice((1, 2, 8))):
        at = rng.randrange(len(text) + 1)
        kind = rng.randrange(3)
        if kind == 0:
            text[at:at + rng.randrange(20)] = b""
        elif kind == 1:
            text[at:at] = rng.choice((b"nan", b",", b"\n", b"\xff", b"9" * 30, b"{", b"]"))
        elif at < len(text):
            text[at] = rng.randrange(256)
    return bytes(text)


class Cases:
    """case_to_job on a folder whose description or one of whose files is damaged."""
    def __init__(self, folder):
        self.folder, self.module = folder, script("case_to_job")
        self.files = {"weather_train.epw": test_case_to_job.epw(2017),
                      "weather_test.epw": test_case_to_job.epw(2018),
                      "measured.csv": test_case_to_job.readings(2017, 5)}

    def attempt(self, rng, log):
        place, target = self.folder / "case", self.folder / "job"
        for each in (place, target):
            shutil.rmtree(each, ignore_errors=True)
        place.mkdir()
        texts = {name: text.encode() for name, text in self.files.items()}
        texts["building.json"] = json.dumps(test_case_to_job.OFFICE).encode()
        if rng.random() < 0.7:
            texts["building.json"] = json.dumps(changed(test_case_to_job.OFFICE, rng)).encode()
        else:
            name = rng.choice(sorted(texts))
            texts[name] = with_bytes_changed(texts[name], rng)
        for name, text in texts.items():
            (place / name).write_bytes(text)
        words = [place, target / "b.toml", "--building"] if rng.random() < 0.3 else [place, target]
        return outcome(self.module, words, log), place


class News:
    """new, with one of its files or of its options damaged."""
    WEATHER, METERS = "2021.epw", ("gas.csv", "daily.csv", "entries.csv", "entries.xlsx", "usage.xml")
    OPTIONS = {"--area": "1200", "--use": "office", "--built": "1975", "--place": "GB", "--site": "52.2,0.1",
               "--storeys": "2", "--height": "3"}
    HOURS = 24 * 70

    def __init__(self, folder):
        self.folder, self.module, self.files = folder, script("new"), self.seeds(folder)

    def seeds(self, folder):
        """{name: bytes}, short ones where that is enough."""
        times = list(test_new.hours(2021, 2021))
        days = [time for time in times[:100 * 24] if time.hour == 0]
        test_new.write_epw(folder / self.WEATHER, 2021)
        test_new.write_workbook(folder / "entries.xlsx", test_new.months(2021, 2021))
        lines = {"gas.csv": ["time,gas_kwh", *test_new.rows(test_new.gas, 2021, 2021)[:self.HOURS]],
                 "daily.csv": ["Day;gas (kWh)", *(f"{day:%d.%m.%Y};{test_new.total(test_new.gas, day, day + DAY):.1f}"
                                                  for day in days)],
                 "entries.csv": test_new.portfolio(test_new.months(2021, 2021)),
                 "usage.xml": test_new.green_button(times[:self.HOURS])}
        return {name: (folder / name).read_bytes() for name in (self.WEATHER, "entries.xlsx")} | \
            {name: "\n".join([*several, ""]).encode() for name, several in lines.items()}

    def options(self, rng):
        """Those of a good call, sometimes with a bad value or one too few."""
        options = dict(self.OPTIONS)
        if rng.random() < 0.1:
            options[rng.choice(sorted(options))] = str(rng.choice(VALUES)).replace("\ud800", "?")
        if rng.random() < 0.1:
            del options[rng.choice(sorted(options))]
        return options

    def description(self, rng, place):
        """Words that describe the building, and the files that they name."""
        return [word for pair in self.options(rng).items() for word in pair], {}

    def attempt(self, rng, log):
        place = self.folder / "new"
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir()
        words, texts = self.description(rng, place)
        meters = rng.sample(self.METERS, min(rng.choice((1, 1, 2)), len(self.METERS)))
        texts |= {name: self.files[name] for name in (self.WEATHER, *meters)}
        if rng.random() < 0.8:
            name = rng.choice(sorted(texts))
            texts[name] = with_bytes_changed(texts[name], rng)
        for name, text in texts.items():
            (place / name).write_bytes(text)
        words = [place / "job.toml", "--weather", place / self.WEATHER, *words]
        return outcome(self.module, [*words, *(word for name in meters for word in ("--meter", place / name))],
                       log), place


class Idfs(News):
    """The same with the building of an EnergyPlus file, whose words or bytes are damaged."""
    METERS = ("gas.csv",)
    BOX = test_new_idf.BOX
    WORDS = ("", "x", "-1", "1e99", ";", "nan", "autosize", "Zone", "0", "9" * 400)

    def description(self, rng, place):
        return ["--place", "GB", "--idf", place / "box.idf"], {"box.idf": self.damaged(rng)}

    def damaged(self, rng):
        words = self.BOX.split(",")
        for _ in range(rng.choice((1, 1, 3))):
            words[rng.randrange(len(words))] = rng.choice((rng.choice(words), rng.choice(self.WORDS)))
        return ",".join(words).encode()


class Jsons(Idfs):
    """The same as epJSON."""
    def __init__(self, folder):
        super().__init__(folder)
        path = folder / "box.idf"
        path.write_text(self.BOX)
        self.json = json.loads(test_new_idf.as_json(path))

    def description(self, rng, place):
        return ["--place", "GB", "--idf", place / "box.epJSON"], \
            {"box.epJSON": json.dumps(changed(self.json, rng)).encode()}


def all_datasets(file):
    found = []
    file.visititems(lambda name, item: found.append(name) if isinstance(item, h5py.Dataset) and
                    item.shape is not None and item.size < 10**6 else None)
    return found


def damage_dataset(file, rng):
    name = rng.choice(all_datasets(file))
    data = file[name]
    attributes, values = dict(data.attrs), data[()]
    kind = rng.randrange(7)
    if kind == 1 and data.dtype.kind == "f":
        data[...] = rng.choice(NUMBERS)
        return
    del file[name]
    if kind == 0:
        return
    if kind == 2:
        values = values[:rng.randrange(3)] if np.ndim(values) else values
    elif kind == 3:
        values = np.zeros(rng.choice(((), (0,), (2,), (3, 3), (1, 2, 2))))
    elif kind == 4:
        file.create_dataset(name, data=["a"] * rng.randrange(1, 4), dtype=h5py.string_dtype())
        return
    elif kind == 5:
        file.create_dataset(name, (1 << 40,), "f8", chunks=(1024,))
        return
    else:
        file[name] = rng.choice((h5py.SoftLink("/"), h5py.ExternalLink("other.h5", "/x"), np.zeros(2, "i4,f8"),
                                 h5py.Empty("f8"), np.bytes_("text")))
        return
    made = file.create_dataset(name, data=values)
    for key in ("units",):
        if key in attributes:
            made.attrs[key] = attributes[key]


class Results:
    """A script on a result that is damaged, by its bytes or by datasets."""
    def __init__(self, folder, name, write):
        self.folder, self.module, self.name = folder, script(name), name
        self.good = folder / f"{name}.h5"
        write(self.good)

    def words(self, bad):
        return [bad, self.good] if self.name == "still_holds" else [bad, self.folder / "out.html"]

    def attempt(self, rng, log):
        bad = self.folder / "bad.h5"
        if rng.random() < 0.4:
            text = bytearray(self.good.read_bytes())
            for _ in range(rng.choice((1, 4, 16))):
                text[rng.randrange(min(len(text), rng.choice((3000, 30000, len(text)))))] = rng.randrange(256)
            bad.write_bytes(text[:rng.choice((len(text), len(text), rng.randrange(len(text))))])
        else:
            shutil.copy(self.good, bad)
            with h5py.File(bad, "r+") as file:
                for _ in range(rng.choice((1, 2, 5))):
                    damage_dataset(file, rng)
        return outcome(self.module, self.words(bad), log), bad


def posterior(path):
    rng = np.random.default_rng(1)
    with h5py.File(path, "w") as file:
        for name in "abc":
            file.create_dataset(f"house/p/posterior/{name}", data=rng.normal(size=(2, 50))).attrs["units"] = "1/h"
            file[f"house/p/prior/{name}"] = rng.normal(size=(1, 60))
        file["house/p/posterior/draw"] = np.arange(50)


def stock(path):
    with h5py.File(path, "w") as file:
        group = file.create_group("stock")
        def text(name, values):
            group.create_dataset(name, data=values, dtype=h5py.string_dtype())
        for name in ("building", "status", "cause", "reason", "drift"):
            text(f"stock_{name}", ["calibrated", "failed", "x"])
        group["stock_age"] = np.zeros(3)
        for prefix, texts, numbers in (
                ("stock_fits", ("fit_meter", "fit_period"), ("fit_before", "fit_cv_rmse", "fit_nmbe")),
                ("stock_values", ("value_parameter", "value_unit"),
                 ("value", "value_low", "value_high", "value_moved")),
                ("stock_findings", ("finding_series", "finding", "finding_action"), ())):
            group[f"{prefix}_of"] = np.array([0., 1, 1, 2])
            for name in texts:
                text(f"stock_{name}", ["a", "b", "a", "masked"])
            for name in numbers:
                group[f"stock_{name}"] = np.arange(4.0)
        group["stock_daily_start"], group["stock_daily_n"] = np.full(3, 18993.0), np.array([2.0, 0, 3])
        group["stock_daily"] = np.array([1.0, np.nan, 3, 2, -1])
        kept = file.create_group("calibrated/screening")        # of the building of that name
        kept["training/a/time"] = 18993 * 86400 + 3600 * np.arange(72.0)
        kept["training/a/measured"], kept["training/a/simulated"] = np.full(72, 1 / 24), np.ones((2, 72))


def targets(folder):
    """Made when they are first asked for, by name."""
    return {"case_to_job": lambda: Cases(folder),
            "new": lambda: News(folder), "new_idf": lambda: Idfs(folder), "new_json": lambda: Jsons(folder),
            "still_holds": lambda: Results(folder, "still_holds", posterior),
            "stock_report": lambda: Results(folder, "stock_report", stock),
            "result_report": lambda: Results(folder, "result_report", fake_results.write),
            "result_report_loop": lambda: Results(folder, "result_report", fake_loop_result.write)}


def fault(name, number, what, ended):
    found = ROOT / "build" / "fuzz" / "found"
    found.mkdir(parents=True, exist_ok=True)
    kept = found / f"{name}-{number}{what.suffix}"
    (shutil.copytree if what.is_dir() else shutil.copy)(what, kept)
    print(f"{name}: attempt {number} ended with {ended[0]}:\n{ended[1][-3000:]}\n{kept}", file=sys.stderr)
    return 1


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--seconds", type=float, default=60, help="shared by the scripts")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--attempts", type=int, default=10**9, help="of each script, at most")
    parser.add_argument("--only", help="one of the scripts")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        makers = targets(pathlib.Path(name))
        names = [options.only] if options.only else list(makers)
        for target in names:
            attempts, number = makers[target](), 0
            end = time.monotonic() + options.seconds / len(names)
            while time.monotonic() < end and number < options.attempts:
                number += 1
                ended, what = attempts.attempt(random.Random(f"{options.seed}/{number}"), f"{name}/log")
                if not is_sound(*ended):
                    return fault(target, number, what, ended)
            print(f"fuzz_scripts {target}: {number} inputs, no fault", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
