#!/usr/bin/python3
"""`new --idf FILE --simulator` writes a job and the files by which it runs that EnergyPlus model, and its command runs
them as they stand, beside a stand-in for EnergyPlus; the user's own file stays as it is; what is wrong ends in one
message."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests" / "generator"), str(ROOT / "tests" / "scripts")]

import energyplus_office as office  # noqa: E402  (found above)
import test_new as usual  # noqa: E402
import test_new_idf  # noqa: E402
from energyplus import effects  # noqa: E402

NEW = ROOT / "scripts" / "new"
STUB = ROOT / "tests" / "energyplus" / "stub.py"
USAGE, DATA, NO_INPUT, EXISTS = 64, 65, 66, 73
N_HOURS = 2 * 8760


class Simulator(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = pathlib.Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.made)
        for year in (2021, 2022):
            usual.write_epw(cls.made / f"{year}.epw", year)
        for name, value in (("gas", usual.gas), ("electricity", usual.electricity)):
            (cls.made / f"{name}.csv").write_text("\n".join([f"time,{name}_kwh", *usual.rows(value)]) + "\n")

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.model = self.folder / "mine.epJSON"
        self.write(office.model())

    def write(self, given):
        self.model.write_text(json.dumps(given))

    def new(self, *more, code=0, energyplus=STUB, weather=("2021.epw", "2022.epw"), job="house.toml"):
        environment = {**os.environ, "ENERGYPLUS_DIR": str(energyplus or ""), "PATH": "/usr/bin:/bin"}
        words = [NEW, self.folder / job, "--idf", self.model, "--place", "GB", "--simulator", *more]
        for name in weather:
            words += ["--weather", self.made / name]
        for name in ("gas", "electricity"):
            words += ["--meter", self.made / f"{name}.csv"]
        done = subprocess.run(list(map(str, words)), capture_output=True, text=True, check=False, env=environment)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        return done.stdout + done.stderr

    def job(self):
        return tomllib.loads((self.folder / "house.toml").read_text())

    def template(self):
        return (self.folder / "house_run.json.in").read_text()

    def point(self, values):
        """A folder as the program makes one for each point, and the command's run in it."""
        simulator, point = self.job()["simulator"], self.folder / "point"
        point.mkdir()
        for file in simulator["files"]:
            path = self.folder / file
            (point / path.name).symlink_to(path.resolve())
        text = re.sub("@([a-z_]+)@", lambda match: str(values[match[1]]), self.template())
        (point / simulator["template"][0]["as"]).write_text(text)
        return point, subprocess.run(simulator["command"], cwd=point, capture_output=True, text=True, check=False)

    def test_the_command_runs_as_it_stands(self):
        before = self.model.read_bytes()
        self.new()
        self.assertEqual(self.model.read_bytes(), before)
        simulator = self.job()["simulator"]
        names = [each["name"] for each in simulator["parameter"]]
        self.assertEqual(names, re.findall("@([a-z_]+)@", self.template()))
        self.assertEqual(names, ["infiltration", "outdoor_air", "lights", "equipment", "people", "u_walls", "u_roof",
                                 "u_windows", "g_windows", "heating_set_point", "cooling_set_point",
                                 "heating_efficiency", "cooling_cop"])
        for each in simulator["parameter"]:
            self.assertLess(each["min"], each["nominal"])
            self.assertLess(each["nominal"], each["max"])
        point, done = self.point({each["name"]: each["nominal"] for each in simulator["parameter"]})
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = (point / "hours.csv").read_text().splitlines()
        columns = [each["column"] for each in simulator["hourly"]]
        self.assertEqual((lines[0].split(","), len(lines)), (columns, 1 + N_HOURS))
        self.assertEqual(columns, [each["name"] for each in self.job()["meter"]])

    def test_schedules_say_what_they_drive(self):
        self.new()
        run = json.loads(re.sub("@[a-z_]+@", "1", self.template()))
        names = {each["name"] for each in self.job()["schedule"]}
        self.assertEqual(set(run["schedules"]), names)
        self.assertTrue(all(each["hook"] in effects.HOOKS for each in run["schedules"].values()))
        self.assertEqual((run["schedules"]["heating"]["span"], run["schedules"]["cooling"]["span"]), (5, -5))
        self.assertEqual(run["plant"]["heating_carrier"], "gas")

    def test_fuels_of_ideal_loads_are_energyplus_s(self):
        """The run's plant does not say them again, and their parameters stay."""
        given = office.model()
        given["Schedule:Constant"]["Good"] = {"hourly_value": 0.9}
        for system in given["ZoneHVAC:IdealLoadsAirSystem"].values():
            system |= {"heating_fuel_type": "NaturalGas", "heating_fuel_efficiency_schedule_name": "Good"}
        self.write(given)
        self.new()
        run = json.loads(re.sub("@[a-z_]+@", "1", self.template()))
        self.assertEqual(run["plant"], {"cooling_carrier": "electricity", "cooling_cop": 3})
        self.assertLess({"heating_efficiency", "cooling_cop"}, set(run["parameters"]))
        self.assertEqual((self.job()["plant"]["heating_carrier"], self.job()["plant"]["heating_efficiency"]),
                         ("gas", 0.9))

    def test_what_the_model_lacks_is_no_parameter(self):
        given = office.model()
        del given["Lights"]
        given["Construction"]["Double glazing"]["outside_layer"] = "Odd"
        given["WindowMaterial:SimpleGlazingSystem"] = {"Odd": {"u_factor": 2, "solar_heat_gain_coefficient": 0.5}}
        self.write(given)
        said = self.new()
        self.assertIn(f"left out: simulator's parameter lights: {self.model} has nothing that it changes\n", said)
        self.assertNotIn("@lights@", self.template())
        self.assertIn("@u_windows@", self.template())

    def test_the_calendar_is_compared(self):
        self.assertIn("no RunPeriodControl:SpecialDays", self.new())

    def test_files_of_schedules_come_along(self):
        given = office.model()
        desks = {"file_name": "data/desks.csv", "column_number": 1, "rows_to_skip_at_top": 0}
        given["Schedule:File"] = {"Desks": desks}
        self.write(given)
        self.assertIn("desks.csv is no file", self.new(code=NO_INPUT))
        self.assertFalse((self.folder / "house.toml").exists())
        (self.folder / "data").mkdir()
        (self.folder / "data" / "desks.csv").write_text("1\n")
        self.new()
        self.assertIn("data/desks.csv", self.job()["simulator"]["files"])
        copy = json.loads((self.folder / "house_model.epJSON").read_text())
        self.assertEqual(copy["Schedule:File"]["Desks"]["file_name"], "desks.csv")

    def test_without_energyplus(self):
        """An epJSON needs none to be read."""
        said = self.new(energyplus=None)
        self.assertIn("check this: --simulator: EnergyPlus was not found", said)
        self.assertEqual(json.loads(re.sub("@[a-z_]+@", "1", self.template()))["energyplus"], "")

    def test_another_version(self):
        given = office.model()
        given["Version"]["Version 1"]["version_identifier"] = "24.1"
        self.write(given)
        said = self.new(code=DATA)
        for word in ("24.1", "25.2", "IDFVersionUpdater"):
            self.assertIn(word, said)
        given["BuildingSurface:Detailed"] = {"Odd": {}}      # is called a mistake by no means before that
        self.write(given)
        self.assertIn("IDFVersionUpdater", self.new(code=DATA))
        self.model = self.folder / "mine.idf"
        for text, words in (("Version, 9.4;\n", ("mine.idf", "9.4", "Transition-V9-4-0")),
                            ("Version, 25;\n", ("mine.idf", "no object Version with a number")),
                            ("Zone, a;\n", ("mine.idf", "no object Version"))):
            self.model.write_text(text)
            said = self.new(code=DATA)
            for word in words:
                self.assertIn(word, said)

    def test_a_newer_version_is_told_with_its_own_folder(self):
        """The run file, in which the program may be named, is not there yet."""
        given = office.model()
        given["Version"]["Version 1"]["version_identifier"] = "26.1"
        self.write(given)
        said = self.new(code=DATA)
        for words in ("use EnergyPlus 26.1: set ENERGYPLUS_DIR to its folder", "/usr/local/EnergyPlus-26-1-0,"):
            self.assertIn(words, said)
        self.assertNotIn("run.json.in", said)
        self.assertNotIn("25-2-0", said)

    def test_messages_name_the_user_s_file(self):
        """Of an IDF, of which EnergyPlus makes a copy."""
        given = office.model()
        del given["People"]
        program = self.folder / "program"
        program.mkdir()
        shutil.copy(STUB, program / "energyplus")
        (program / "model.epJSON").write_text(json.dumps(given))
        self.model = self.folder / "mine.idf"
        self.model.write_text(test_new_idf.BOX)
        said = self.new(energyplus=program)
        self.assertIn(f"left out: simulator's parameter people: {self.model} has nothing that it changes\n", said)
        self.assertNotIn(tempfile.gettempdir() + "/tmp", said.replace(str(self.folder), "").replace(str(self.made), ""))

    def test_what_is_no_energyplus(self):
        self.assertIn("is not EnergyPlus", self.new(code=DATA, energyplus="/usr/bin/ls"))
        self.assertIn("is no program that can be run", self.new(code=DATA, energyplus=self.folder))

    def test_nothing_is_written_over(self):
        self.new()
        self.assertIn("is there already", self.new(code=EXISTS))
        (self.folder / "house.toml").unlink()
        self.assertIn("is there already", self.new(code=EXISTS))
        self.new("--force")
        self.model = self.model.rename(self.folder / "other_model.epJSON")
        before = self.model.read_bytes()
        self.assertIn("is an input", self.new("--force", code=EXISTS, job="other.toml"))
        self.assertEqual(self.model.read_bytes(), before)

    def test_it_needs_a_model(self):
        done = subprocess.run([NEW, self.folder / "a.toml", "--simulator", "--weather", "a", "--meter", "b", "--place",
                               "GB", "--area", "100", "--use", "office", "--built", "1990"], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, USAGE)
        self.assertIn("expected --idf FILE", done.stderr)


if __name__ == "__main__":
    unittest.main()
