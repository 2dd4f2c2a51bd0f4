#!/usr/bin/python3
"""scripts/run_case reads a case's description, weather and training readings and nothing else, makes
one job of several cases, and writes what a loop found as tables."""
import copy
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest

import h5py
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "scripts")]

import fake_loop_result  # noqa: E402
from cases import loop_job, loop_result, running  # noqa: E402
from test_case_to_job import OFFICE, epw, readings  # noqa: E402

PROGRAM = HERE.parents[1] / "scripts" / "run_case"
KEPT_BACK = ("measured_test.csv", "truth.json")
HOURS = 48
# keys, the value that is put there or GONE, what is said of it
GONE = object()
WRONG = ((["envelope", "U_wall"], GONE, "envelope.U_wall: is not there; expected a number"),
         (["envelope", "U_wall"], "1.2", 'envelope.U_wall: "1.2"; expected a number'),
         (["site", "latitude"], float("nan"), "site.latitude: NaN; expected a number"),
         (["geometry", "air_volume_m3"], 0, "air_volume_m3: 0; expected a number above 0"),
         (["geometry", "facades", 0, "area_m2"], None,
          "geometry.facades[0].area_m2: null; expected a number"),
         (["geometry", "facades"], [3], "geometry.facades: [3]; expected a list of objects"),
         (["plant"], [], "plant: []; expected an object"),
         (["plant", "heating_available"], "winter - spring", "heating_available: "
          '"winter - spring"; expected "all year", or days as "15 Oct - 15 Apr"'),
         (["schedules", "occ"], GONE, "schedules.occ: is not there; expected an object"),
         (["schedules", "occ", "sat"], [0] * 23, "expected 24 numbers"),
         (["domestic_hot_water"], {"kWh_per_day_useful": 1}, "domestic_hot_water.hourly_shares"),
         (["declared_closed_days", "list_mm_dd"], "01-01", "expected a list of texts"))


def changed(keys, value):
    """The office with another value at the keys."""
    case = copy.deepcopy(OFFICE)
    *path, last = keys
    place = case
    for key in path:
        place = place[key]
    if value is GONE:
        del place[last]
    else:
        place[last] = value
    return case


def write_case(folder, case=OFFICE):
    folder.mkdir(parents=True)
    for name, text in {"building.json": json.dumps(case), "weather_train.epw": epw(2017),
                       "weather_test.epw": epw(2018), "measured.csv": readings(2017, 5)}.items():
        (folder / name).write_text(text)
    return folder


class Folders(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


class Jobs(Folders):
    def run_script(self, *arguments):
        return subprocess.run([PROGRAM, *arguments, self.folder / "out", "--job-only"],
                              capture_output=True, text=True)

    def job(self, *cases):
        done = self.run_script(*cases)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.folder / "out" / "job"

    def building(self, case=OFFICE):
        self.job(write_case(self.folder / "a", case))
        return tomllib.loads((self.folder / "out/job/a.toml").read_text())

    def test_what_is_kept_back_is_neither_needed_nor_opened(self):
        case = write_case(self.folder / "a")
        without = (self.job(case) / "a.toml").read_text()
        for name in KEPT_BACK:
            (case / name).mkdir()  # opening a folder fails, also for root
        self.assertEqual((self.job(case) / "a.toml").read_text(), without)
        for name in KEPT_BACK:
            self.assertNotIn(name, without)

    def test_the_held_out_year_is_that_of_the_weather(self):
        building = self.building()
        self.assertEqual(building["periods"], {"training": ["2017-01-01", "2017-12-31"],
                                               "held_out": ["2018-01-01", "2018-12-31"]})
        self.assertEqual([pathlib.Path(meter["file"]).name for meter in building["meter"]],
                         ["measured.csv"] * 2)

    def test_declared_closed_days_stay_declared(self):
        self.assertEqual(self.building()["holidays"], ["01-01/01-03"])

    def test_hours_may_be_left_to_the_loop(self):
        building = self.building(changed(["schedules", "hvac"], {"hours": "learn", "use": "school"}))
        schedule, = (each for each in building["schedule"] if each["name"] == "hvac")
        self.assertEqual(schedule, {"name": "hvac", "hours": "learn", "use": "school"})

    def test_structure_is_left_to_the_loop(self):
        targets = str([p["target"] for p in self.building()["parameter"]])
        for number in ("proportional_band", "air_capacity", "emitter", "second_mass"):
            self.assertNotIn(number, targets)

    def test_every_parameter_has_a_prior_within_its_range(self):
        for p in self.building()["parameter"]:
            self.assertTrue(p["min"] <= p["prior"]["mean"] <= p["max"], p)
            self.assertGreater(p["prior"]["sd"], 0)

    def test_the_ground_is_that_of_each_years_weather(self):
        place = write_case(self.folder / "a")
        self.job(place)
        text = self.folder / "out/job/a.toml"
        self.assertEqual(tomllib.loads(text.read_text())["boundary"][0]["temperature"], 20)
        months = {2017: [6, 4, 5, 8, 10, 12, 15, 16, 14, 12, 10, 8]}
        months[2018] = [theta - 1 for theta in months[2017]]
        for year, name in ((2017, "weather_train.epw"), (2018, "weather_test.epw")):
            lines = (place / name).read_text().splitlines()
            lines[3] = "GROUND TEMPERATURES,1,1.5,,,," + ",".join(map(str, months[year]))
            (place / name).write_text("\n".join(lines) + "\n")
        self.job(place)
        ground, = (each for each in tomllib.loads(text.read_text())["schedule"]
                   if each["name"] == "ground")
        self.assertEqual([part["every_day"] for part in ground["period"]],
                         months[2017] + months[2018])
        self.assertEqual(ground["period"][13]["dates"], "2018-02-01/2018-02-28")

    def test_factors_on_shares_keep_them_below_one(self):
        case = json.loads(json.dumps(OFFICE))
        case["envelope"]["solar_absorptance_wall"] = 0.9
        found = {p["name"]: p["max"] for p in self.building(case)["parameter"]}
        self.assertLess(0.9 * found["absorptance"], 1)

    def test_cases_become_buildings_of_one_job(self):
        cases = [write_case(self.folder / name) for name in ("a", "b")]
        job = tomllib.loads((self.job(*cases) / "job.toml").read_text())
        self.assertEqual(job["buildings"], ["a.toml", "b.toml"])
        self.assertEqual(job["study"], [{"kind": "loop"}])
        names = [tomllib.loads((self.folder / "out/job" / file).read_text())["name"]
                 for file in job["buildings"]]
        self.assertEqual(names, ["a", "b"])

    def test_what_is_wrong_is_said_in_a_line(self):
        case = write_case(self.folder / "a")
        (case / "measured.csv").unlink()
        for arguments, words in (([case], "measured.csv: is not there"),
                                 ([self.folder / "none"], "expected a case folder"),
                                 ([write_case(self.folder / "c/b"),
                                   write_case(self.folder / "d/b")], "two folders")):
            done = self.run_script(*arguments)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(words, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def assert_refused(self, case, words):
        with self.assertRaises(loop_result.CaseError) as raised:
            loop_job.write_job([case], self.folder / "job")
        self.assertIn(words, str(raised.exception))
        self.assertFalse((self.folder / "job").exists())

    def test_what_is_wrong_in_a_description_is_said_by_file_and_key(self):
        for number, (keys, value, words) in enumerate(WRONG):
            with self.subTest(words):
                case = write_case(self.folder / str(number), changed(keys, value))
                self.assert_refused(case, f"{number}/building.json: {keys[0]}")
                self.assert_refused(case, words)

    def test_what_a_case_does_not_use_may_be_missing(self):
        for number, keys in enumerate((["plant", "cooling_COP"], ["envelope", "slab_thickness_m"],
                                       ["declared_closed_days", "list_mm_dd"], ["channels"])):
            case = changed(keys, GONE)
            case["plant"]["cooling_available"] = "none"
            loop_job.write_job([write_case(self.folder / str(number), case)], self.folder / "job")

    def test_files_that_cannot_be_read_are_named(self):
        for number, (file, text, words) in enumerate((
                ("building.json", "{,", "expected JSON"), ("building.json", "[]", "is no object"),
                ("weather_train.epw", None, "No such file"), ("weather_test.epw", None, "No such"),
                ("weather_train.epw", "header\n", "too few rows"),
                ("weather_train.epw", epw(2017).replace(",20,", ",warm,"), "'warm'"),
                ("measured.csv", "timestamp,steam_kWh\n", "no column that is a meter"))):
            case = write_case(self.folder / str(number))
            (case / file).unlink()
            if text is not None:
                (case / file).write_text(text)
            with self.subTest(file=file, words=words):
                self.assert_refused(case, f"{case / file}: ")
                self.assert_refused(case, words)

    def test_a_case_cannot_be_called_as_the_job(self):
        self.assert_refused(write_case(self.folder / "cases" / "job"), "cannot be called job")

    def test_bad_cases_stop_no_others(self):
        good, bad, worse = (write_case(self.folder / name) for name in ("good", "bad", "worse"))
        (bad / "weather_train.epw").unlink()
        (worse / "building.json").write_text("{")
        done = self.run_script(bad, good, worse)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stdout, f"{self.folder / 'out/job/job.toml'}\n")
        self.assertEqual([line.split(": ")[1] for line in done.stderr.splitlines()],
                         [str(bad / "weather_train.epw"), str(worse / "building.json")])
        job = tomllib.loads((self.folder / "out/job/job.toml").read_text())
        self.assertEqual(job["buildings"], ["good.toml"])

    def test_without_a_good_case_there_is_no_job(self):
        bad = write_case(self.folder / "bad", changed(["site"], GONE))
        done = self.run_script(bad, self.folder / "none")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertEqual(done.stderr.count("\n"), 2, done.stderr)
        self.assertFalse((self.folder / "out").exists())


def write_result(path):
    """A loop's result of two buildings with the datasets that are read."""
    words = {"model": ["plain", "before", "after"], "channel": ["air", "cold"],
             "effect": ["heat island"], "effect_hook": ["outdoor air"],
             "effect_driver": ["constant"], "effect_shape": ["linear"],
             "effect_gate": ["always"], "effect_unit": ["K"],
             "effect_class": ["heat island; sky loss"],
             "effect_class_member": ["heat island", "sky loss"], "effect_separates": ["a logger"],
             "effect_doubt": ["its probability is below 0.9"],
             "function": ["gains by wind"], "function_hook": ["gains"], "function_driver": ["wind"],
             "function_driver_unit": ["m/s"], "function_unit": ["W/m2"],
             "learned_schedule": ["hvac"], "learned_schedule_use": ["office"],
             "learned_schedule_sentence": ["schedule hvac: Saturdays off"],
             "learned_hours_days": ["Saturdays"],
             "decision_series": ["cold"], "decision_finding": ["zeros"],
             "decision_action": ["kept"], "decision_kind": ["data"]}
    numbers = {"effect_class_of": [0.0, 0.0], "effect_coefficient": [1.5], "effect_least": [1.2], "effect_most": [1.8],
               "effect_adequate": [0.0], "effect_gain": [200.0],
               "function_size": [0.4], "function_evidence": [20.0], "function_point_of": [0.0, 0.0],
               "function_point_at": [1.0, 5.0], "function_point_and_at": [np.nan, np.nan],
               "function_point_value": [-0.2, 0.3], "function_point_least": [-0.4, 0.1],
               "function_point_most": [0.0, 0.5]}
    numbers |= {"learned_schedule_evidence": [90.0], "learned_hours_probability": [0.97]} | {
        f"learned_hours_{name}": [0.0] for name in (
            "of", "from", "until", "from_least", "from_most", "until_least", "until_most", "usual_from",
            "usual_until")}
    words |= {"setting": ["heating set-back"], "setting_parameter": ["heating_setback"], "setting_unit": ["degC"]}
    numbers |= {"setting_described": [16.0], "setting_found": [19.25], "setting_least": [19.0], "setting_most": [19.5],
                "setting_distance": [3.25]}
    begin = np.datetime64("2018-01-01T00", "s").astype(np.int64)
    with h5py.File(path, "w") as file:
        for building in ("a", "b"):
            loop = file.create_group(f"{building}/loop")
            for name, values in words.items():
                loop[name] = np.array(values, h5py.string_dtype())
            for name, values in numbers.items():
                loop[name] = values
            loop["held_out/time"] = begin + 3600.0 * np.arange(HOURS)
            for k, channel in enumerate(words["channel"]):
                loop[f"held_out/{channel}/simulated"] = \
                    100 * k + np.arange(3)[:, None] + np.zeros(HOURS)
        file["input_file"] = np.array(["a.toml"], h5py.string_dtype())


class Results(Folders):
    def setUp(self):
        super().setUp()
        self.result = self.folder / "result.h5"
        write_result(self.result)
        loop_result.write_files(str(self.result), "a", str(self.folder))

    def test_every_hour_is_predicted_and_stamped_at_its_end(self):
        for value, model in enumerate(("plain", "before", "after")):
            with open(self.folder / f"{model}.csv") as text:
                rows = list(csv.reader(text))
            self.assertEqual(rows[0], ["timestamp", "T_air_C", "cool_kWh"])
            self.assertEqual(rows[1], ["2018-01-01T01:00:00", str(value), str(100 + value)])
            self.assertEqual(len(rows), 1 + HOURS)
            self.assertEqual(rows[-1][0], "2018-01-03T00:00:00")

    def test_an_effect_is_a_record(self):
        effect, setting = json.loads((self.folder / "effects.json").read_text())
        self.assertEqual(effect["class"], ["heat island", "sky loss"])
        self.assertEqual(effect["interval"], [1.2, 1.8])
        self.assertIs(effect["adequate"], False)
        self.assertEqual(effect["doubt"], "its probability is below 0.9")
        self.assertEqual((effect["name"], effect["hook"], effect["coefficient"], effect["unit"]),
                         ("heat island", "outdoor air", 1.5, "K"))
        self.assertEqual((setting["name"], setting["coefficient"], setting["interval"], setting["unit"]),
                         ("heating set-back: 19.2 degC, described 16", 3.25, [3.0, 3.5], "K"))

    def test_a_function_is_a_record_with_its_points(self):
        function, = json.loads((self.folder / "functions.json").read_text())
        self.assertEqual((function["name"], function["driver_unit"], function["unit"], function["size"]),
                         ("gains by wind", "m/s", "W/m2", 0.4))
        self.assertEqual(function["points"], [
            {"at": 1.0, "and_at": None, "value": -0.2, "least": -0.4, "most": 0.0},
            {"at": 5.0, "and_at": None, "value": 0.3, "least": 0.1, "most": 0.5}])

    def test_hours_that_were_learned_are_a_record_with_its_days(self):
        schedule, = json.loads((self.folder / "hours.json").read_text())
        self.assertEqual((schedule["name"], schedule["use"], schedule["sentence"], schedule["evidence"]),
                         ("hvac", "office", "schedule hvac: Saturdays off", 90.0))
        day, = schedule["days"]
        self.assertEqual((day["days"], day["from"], day["until"], day["probability"]),
                         ("Saturdays", 0.0, 0.0, 0.97))

    def test_a_decision_is_a_record(self):
        self.assertEqual(json.loads((self.folder / "decisions.json").read_text()),
                         [{"series": "cold", "finding": "zeros", "action": "kept"}])

    def test_each_case_gets_its_own_part_of_the_result(self):
        part = str(self.folder / "part.h5")
        loop_result.cut_out(str(self.result), "a", ["a", "b"], part)
        with h5py.File(part) as file:
            self.assertEqual(set(file), {"a", "input_file"})

    def test_a_result_without_the_loop_is_refused(self):
        with self.assertRaisesRegex(loop_result.CaseError, "expected the result of a loop"):
            loop_result.write_files(str(self.result), "c", str(self.folder))


class Runs(Folders):
    def run_program(self, code, writes=True, may_fail=False, words=()):
        """A program that writes its result, or does not, and ends with `code`."""
        program, result = self.folder / "program", self.folder / "result.h5"
        program.write_text(f"#!/bin/sh\n{'echo > $4' if writes else ':'}\nexit {code}\n")
        program.chmod(0o755)
        return running.run(program, "job.toml", result, 1, words, may_fail=may_fail)

    def test_a_missed_target_has_a_result(self):
        self.run_program(0)
        self.run_program(1)

    def test_without_a_new_result_there_is_an_error(self):
        self.run_program(0)
        for code, writes in ((70, True), (65, True), (1, False), (0, False)):
            with self.assertRaises(loop_result.CaseError) as raised:
                self.run_program(code, writes)
            self.assertEqual(raised.exception.code, code)

    def test_a_whole_result_that_is_gone_on_with_is_one(self):
        with self.assertRaises(loop_result.CaseError):
            self.run_program(0, writes=False, words=["--resume"])
        self.run_program(0)
        self.run_program(0, writes=False, words=["--resume"])
        with self.assertRaises(loop_result.CaseError):
            self.run_program(1, writes=False, words=["--resume"])

    def test_where_items_may_fail_the_others_are_a_result(self):
        self.assertEqual(self.run_program(65, may_fail=True), 65)
        with self.assertRaises(loop_result.CaseError) as raised:
            self.run_program(65, writes=False, may_fail=True)
        self.assertEqual(raised.exception.code, 65)

    def run_script(self, cases, code, result, unreadable="none"):
        """run_case with a program that leaves `result` and ends with `code`; it cannot read a job
        with the building `unreadable`."""
        program = self.folder / "program"
        program.write_text(f"#!/bin/sh\n[ $1 = run ] || {{\n  grep -q {unreadable}.toml $2 || exit 0\n"
                           f"  echo {unreadable} is wrong >&2\n  exit 78\n}}\n"
                           f"cp {result} $4\nexit {code}\n")
        program.chmod(0o755)
        return subprocess.run([PROGRAM, *cases, self.folder / "out", "--ranks", "1"],
                              capture_output=True, text=True,
                              env={**os.environ, "BEMCAL_PROGRAM": str(program)})

    def result_without(self, item, stage="a/loop"):
        """A result of a loop of which that building failed."""
        path = fake_loop_result.write(self.folder / "made.h5", stage=stage)
        with h5py.File(path, "a") as file:
            file["loop/failed_item"] = [float(item)]
            file["loop/failed_item_reason"] = np.array(["it is too cold"], h5py.string_dtype())
        return path

    def test_cases_that_have_a_result_get_their_files(self):
        cases = [write_case(self.folder / name) for name in ("a", "b")]
        result = self.result_without(1)
        done = self.run_script(cases, 65, result)
        self.assertEqual(done.returncode, 65)
        self.assertEqual(done.stderr, "run_case: b has no result: it is too cold\n")
        self.assertEqual(done.stdout, f"{self.folder / 'out/a'}\n")
        self.assertEqual({path.name for path in (self.folder / "out/a").iterdir()},
                         {"plain.csv", "before.csv", "after.csv", "effects.json",
                          "functions.json", "decisions.json", "hours.json", "report.html",
                          "result.h5"})
        self.assertFalse((self.folder / "out/b").exists())

    def test_the_only_good_case_of_several_has_its_folder(self):
        bad = write_case(self.folder / "bad", changed(["site"], GONE))
        result = fake_loop_result.write(self.folder / "made.h5", stage="a/loop")
        done = self.run_script([bad, write_case(self.folder / "a")], 0, result)
        self.assertEqual(done.returncode, 1)
        self.assertIn("bad/building.json: site: is not there", done.stderr)
        self.assertTrue((self.folder / "out/a/effects.json").exists())

    def test_cases_that_the_program_cannot_read_stop_no_others(self):
        cases = [write_case(self.folder / name) for name in ("a", "b")]
        result = fake_loop_result.write(self.folder / "made.h5", stage="a/loop")
        done = self.run_script(cases, 0, result, unreadable="b")
        self.assertEqual((done.returncode, done.stderr), (1, "b is wrong\n"))
        job = tomllib.loads((self.folder / "out/job/job.toml").read_text())
        self.assertEqual(job["buildings"], ["a.toml"])
        self.assertTrue((self.folder / "out/a/effects.json").exists())

    def test_where_the_program_can_read_none_there_is_no_result(self):
        case, result = write_case(self.folder / "a"), fake_loop_result.write(self.folder / "made.h5")
        done = self.run_script([case], 0, result, unreadable="a")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, "a is wrong\nrun_case: " + str(self.folder / "out/job/job.toml") +
                         ": no case that can be read; no result\n")
        self.assertFalse((self.folder / "out/result.h5").exists())

    def test_a_case_that_fails_alone_is_said_to(self):
        case, result = write_case(self.folder / "b"), self.result_without(0)
        for code in (65, 0):  # 0: so few failed that the program is content
            done = self.run_script([case], code, result)
            self.assertEqual((done.returncode, done.stdout), (65, ""))
            self.assertEqual(done.stderr, "run_case: b has no result: it is too cold\n")
            (self.folder / "out" / "result.h5").unlink()

    def test_a_folder_with_a_result_keeps_its_job(self):
        case, out = write_case(self.folder / "a"), self.folder / "out"
        (out / "job").mkdir(parents=True)
        (out / "job" / "job.toml").write_text("another")
        (out / "result.h5").touch()
        done = subprocess.run([PROGRAM, case, out], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("exists already", done.stderr)
        self.assertIn("--resume", done.stderr)
        self.assertEqual((out / "job" / "job.toml").read_text(), "another")


if __name__ == "__main__":
    unittest.main()
