#!/usr/bin/python3
"""The runner of a user's EnergyPlus model, beside a stand-in for EnergyPlus whose hours can be foretold: periods and
years come in the job's order; parameters and effects change the objects that the tables name; what is wrong ends in one
line.

`test_energyplus_runs.slow.py` asks EnergyPlus itself.
"""
import csv
import datetime
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
import unittest.mock

import numpy as np

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests" / "generator")]

import energyplus_office as office  # noqa: E402  (found above)
from energyplus import effects, hours, model, parameters, program, weather  # noqa: E402
from energyplus.changes import Changes, Term  # noqa: E402
from energyplus.failed import Failed  # noqa: E402

STUB = ROOT / "tests" / "energyplus" / "stub.py"
RUNNER = ROOT / "scripts" / "energyplus_hours"
HOOKS_OF_PROGRAM = ROOT / "src" / "effects" / "hooks.cpp"
WRONG = 65
YEAR = 8760
HEAD = ["LOCATION,a,b,c,d,0,47,8,1,0", "DESIGN CONDITIONS,0", "TYPICAL/EXTREME PERIODS,0", "GROUND TEMPERATURES,0",
        "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0", "COMMENTS 1,", "COMMENTS 2,", "DATA PERIODS,1,1,Data,Sunday,1/1,12/31"]


def write_epw(path, first, n_days, newline="\n"):
    """Outdoor temperature: the day of the month."""
    lines = list(HEAD)
    for k in range(24 * n_days):
        time = datetime.datetime.combine(first, datetime.time()) + k * weather.HOURS
        lines.append(f"{time.year},{time.month},{time.day},{time.hour + 1},60,x,{time.day}" + ",0" * 28)
    path.write_bytes((newline.join(lines) + newline).encode())


def number_of(time):
    return (time - datetime.datetime(time.year, 1, 1)) / weather.HOURS


class Runs(unittest.TestCase):
    """Of the whole command, beside the stand-in."""

    @classmethod
    def setUpClass(cls):
        cls.weather = pathlib.Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.weather)
        write_epw(cls.weather / "2020.epw", datetime.date(2020, 1, 1), 366)
        write_epw(cls.weather / "2021.epw", datetime.date(2021, 1, 1), 365, "\r\n")

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "model.epJSON").write_text(json.dumps(office.model()))
        for name in ("2020.epw", "2021.epw"):
            shutil.copy(self.weather / name, self.folder)
        self.run_file = {"energyplus": str(STUB), "model": "model.epJSON", "weather": ["2020.epw", "2021.epw"],
                         "periods": "periods.csv", "parameters": {"infiltration": 1.2},
                         "meters": [{"name": "power", "quantity": "electricity"},
                                    {"name": "gas, all", "quantity": "gas"},
                                    {"name": "room", "quantity": "air_temperature"}]}
        self.periods("training,2021-03-01,2021-03-02", "held_out,2020-12-30,2021-01-02", "leap,2020-02-29,2020-02-29")

    def periods(self, *lines):
        (self.folder / "periods.csv").write_text("\n".join(["period,first,last", *lines]) + "\n")

    def call(self, *words, environment=None):
        (self.folder / "run.json").write_text(json.dumps(self.run_file))
        return subprocess.run(["/usr/bin/python3", RUNNER, "run.json", *words], cwd=self.folder, capture_output=True,
                              text=True, check=False, env=environment)

    def rows(self):
        done = self.call()
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.folder / "hours.csv", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def effect(self, values, **section):
        lines = [f"{key} = {json.dumps(value)}\n" for key, value in {"unit": "-", "enters": "add", **section}.items()]
        with open(self.folder / "effects.toml", "a", encoding="utf-8") as file:
            file.write("[[effect]]\n" + "".join(lines))
        (self.folder / "effects.csv").write_text(section["column"] + "\n" + "".join(f"{value}\n" for value in values))

    def fails(self, *words):
        done = self.call()
        self.assertEqual(done.returncode, WRONG, done.stdout + done.stderr)
        last = done.stderr.strip().splitlines()[-1]
        for word in words:
            self.assertIn(word, last)
        self.assertFalse((self.folder / "hours.csv").exists())

    def test_hours_of_the_periods_in_their_order(self):
        rows = self.rows()
        begins = [datetime.datetime(2021, 3, 1) + k * weather.HOURS for k in range(48)]
        begins += [datetime.datetime(2020, 12, 30) + k * weather.HOURS for k in range(96)]
        begins += [datetime.datetime(2020, 2, 29) + k * weather.HOURS for k in range(24)]
        self.assertEqual([float(row["power"]) for row in rows], [number_of(time) for time in begins])
        for row, time in zip(rows, begins):
            self.assertAlmostEqual(float(row["gas, all"]), number_of(time) / 10, places=3)
            self.assertAlmostEqual(float(row["room"]), time.day + 4 * 300 / 400, places=4)   # mean by volume

    def test_a_day_in_two_periods_is_in_the_table_twice(self):
        self.periods("a,2021-05-01,2021-05-02", "b,2021-05-02,2021-05-03")
        rows = self.rows()
        self.assertEqual(len(rows), 96)
        self.assertEqual(rows[24:48], rows[48:72])

    def test_a_leap_year_without_its_day_has_the_day_before_again(self):
        """Outdoor temperature is the day of the month; what warms the 29th does not warm the 28th."""
        path = self.folder / "2020.epw"
        write_epw(path, datetime.date(2020, 1, 1), 366)
        lines = [line for line in path.read_text().splitlines() if not line.startswith("2020,2,29,")]
        path.write_text("\n".join(lines) + "\n")
        self.periods("leap,2020-02-28,2020-03-01")
        rooms = [float(row["room"]) - 3 for row in self.rows()]
        self.assertEqual([round(each) for each in rooms[::24]], [28, 28, 1])
        self.effect([0] * 24 + [2] * 24 + [0] * 24, name="warm", hook="outdoor air", column="w")
        self.assertEqual([round(float(row["room"]) - 3) for row in self.rows()][::24], [28, 30, 1])
        for year, days in ((2020, [(2, 28), (2, 29), (3, 1)]), (2021, [(2, 28), (3, 1)])):
            rows = [[str(year), str(month), str(day), "1"] for month, day in ((2, 28), (3, 1))]
            self.assertEqual([(int(row[1]), int(row[2])) for row in weather.with_leap_day(rows, year)], days)
        for before in (("2", "29"), ("2", "27"), ("3", "1")):
            rows = [["2020", *before, "1"], ["2020", "3", "1", "2"]]
            self.assertEqual(weather.with_leap_day(rows, 2020), rows)

    def test_a_packed_weather_file(self):
        subprocess.run(["gzip", self.folder / "2020.epw"], check=True)
        self.run_file["weather"][0] = "2020.epw.gz"
        self.assertEqual(len(self.rows()), 168)

    def test_only_errors_of_energyplus_stay(self):
        self.rows()
        self.assertEqual([path.name for path in (self.folder / "run_2020").iterdir()], [])
        self.assertFalse((self.folder / "effects_left_out.txt").exists())

    def test_words_of_energyplus(self):
        self.change_building("severe")
        self.fails("run_2021", "the roof leaks a lot")
        self.change_building("silent")
        self.fails("failed in run_2021")

    def change_building(self, name):
        given = office.model()
        given["Building"] = {name: {}}
        (self.folder / "model.epJSON").write_text(json.dumps(given))

    def test_what_is_missing_is_told(self):
        self.run_file["energyplus"] = str(self.folder / "none")
        self.fails("none is no program", "ENERGYPLUS_DIR")
        self.run_file["energyplus"] = ""
        bare = {"PATH": str(self.folder)}
        done = self.call(environment=bare)
        self.assertIn("EnergyPlus was not found", done.stderr)
        done = self.call(environment={**bare, "ENERGYPLUS_DIR": str(STUB)})
        self.assertEqual(done.returncode, 0, done.stderr)
        os.unlink(self.folder / "2021.epw")
        (self.folder / "hours.csv").unlink()
        self.run_file["energyplus"] = str(STUB)
        self.fails("2021.epw", "No such file")
        self.run_file["weather"] = ["2020.epw"]
        self.periods("a,2021-03-01,2021-03-02")
        write_epw(self.folder / "2020.epw", datetime.date(2020, 1, 1), 200)
        self.fails("no file has the year 2021", "2020.epw has 2020", "expected an EPW of 2021")
        write_epw(self.folder / "2020.epw", datetime.date(2020, 1, 1), 366)
        self.fails("no file has the year 2021")          # a whole year of other days is none of it

    def test_files_of_schedules_lie_beside_the_run_file(self):
        given = office.model()
        given["Schedule:File"] = {"Desks": {"file_name": "desks.csv", "column_number": 1, "rows_to_skip_at_top": 0}}
        (self.folder / "model.epJSON").write_text(json.dumps(given))
        (self.folder / "desks.csv").write_text("1\n" * YEAR)
        self.assertEqual(self.call("--patch-only").returncode, 0)
        made = json.loads((self.folder / "model-effects-2021.epJSON").read_text())
        self.assertEqual(made["Schedule:File"]["Desks"]["file_name"], str(self.folder / "desks.csv"))

    def test_another_version_is_told(self):
        given = office.model()
        given["Version"]["Version 1"]["version_identifier"] = "23.1"
        (self.folder / "model.epJSON").write_text(json.dumps(given))
        self.fails("23.1", "25.2", "IDFVersionUpdater", "Transition-V23-1-0")

    def test_idf_is_converted_by_energyplus(self):
        (self.folder / "house.idf").write_text("! a model\n Version,\n  25.2; ! its version\n Building, x;\n")
        program_folder = self.folder / "program"
        program_folder.mkdir()
        shutil.copy(STUB, program_folder / "energyplus")
        shutil.copy(self.folder / "model.epJSON", program_folder / "model.epJSON")
        self.run_file |= {"model": "house.idf", "energyplus": str(program_folder)}
        self.assertEqual(len(self.rows()), 168)
        (self.folder / "house.idf").write_text("Version, 9.1;\n")
        (self.folder / "hours.csv").unlink()
        self.fails("house.idf", "9.1")

    def test_idf_reaches_energyplus_in_utf_8(self):
        source = self.folder / "house.idf"
        for encoding in ("utf-8", "cp1252", "utf-16"):
            source.write_bytes("Version, 25.2;\nZone, B\u00fcro;\n".encode(encoding))
            into = self.folder / encoding
            into.mkdir()
            with unittest.mock.patch.object(program, "convert", lambda _, source, __: source), \
                    unittest.mock.patch.object(program, "read_epjson", lambda path: path):
                self.assertEqual(program.read_model(STUB, source, into).read_text(encoding="utf-8"),
                                 "Version, 25.2;\nZone, B\u00fcro;\n")

    def test_rows_that_find_nothing(self):
        good = {"parameter": "mass", "class": "Lights", "field": "watts_per_floor_area", "how": "factor"}
        self.run_file["parameters"] = {"mass": 1.1}
        for change, words in (({"class": "Light"}, ["run.json: rows: mass: class", "model.epJSON", "'Lights'"]),
                              ({"object": "South room light"}, ["object", "'South room lights'"]),
                              ({"field": "watts_per_area"},
                               ["Lights has no 'watts_per_area'", "nearest: 'watts_per_floor_area'"]),
                              ({"parameter": "mas"}, ["'mas'", "nearest: 'mass'"]), ({"feild": "x"}, ["'feild'"])):
            with self.subTest(change):
                self.run_file["rows"] = [{**good, **change}]
                self.fails(*words)
        self.run_file["rows"] = [{**good, "object": "south ROOM lights"}]
        self.assertEqual(len(self.rows()), 168)
        (self.folder / "hours.csv").unlink()
        self.run_file |= {"rows": [], "parameters": {"infiltraton": 1}}
        self.fails("run.json: parameters: infiltraton", "nearest: 'infiltration'")

    def test_bad_run_files(self):
        good = dict(self.run_file)
        for change, words in (({"weathr": []}, ["weathr", "not known"]),
                              ({"meters": [{"name": "x"}]}, ["meters", "quantity"]),
                              ({"parameters": {"colour": 1}}, ["colour", "expected one of infiltration"]),
                              ({"parameters": {"lights": "x"}}, ["lights", "no number"]),
                              ({"periods": "none.csv"}, ["none.csv"]), ({"model": 3}, ["model", "text"]),
                              ({"weather": [1]}, ["weather", "list of texts"]), ({"rows": ["x"]}, ["rows"]),
                              ({"schedules": {"a": 1}}, ["schedules", "span"]),
                              ({"meters": [{"name": "x", "quantity": "cooling"}]}, ["x", "uses no cooling"])):
            with self.subTest(change):
                self.run_file = {**good, **change}
                self.fails(*words) if "uses no cooling" not in words else self.no_cooling(words)
        self.run_file = good
        for text in ("period,first\n", "period,first,last\n", "period,first,last\na,2021-01-02,2021-01-01\n",
                     "period,first,last\na,yesterday,2021-01-01\n"):
            (self.folder / "periods.csv").write_text(text)
            self.fails("periods.csv")

    def no_cooling(self, words):
        """The model has no ideal loads, and the stand-in no cold."""
        given = office.model()
        del given["ZoneHVAC:IdealLoadsAirSystem"]
        (self.folder / "model.epJSON").write_text(json.dumps(given))
        self.fails(*words)
        (self.folder / "model.epJSON").write_text(json.dumps(office.model()))

    def test_effects_on_the_hours(self):
        """Meters, and the part of gas that heats (half of it) by an efficiency."""
        plain = self.rows()
        self.effect(range(168), name="more", hook="meter addition", column="more", meter="power")
        doubled = self.rows()
        for k, (before, after) in enumerate(zip(plain, doubled)):
            self.assertAlmostEqual(float(after["power"]), float(before["power"]) + k * 200 / 1000, places=2)
        (self.folder / "effects.toml").unlink()
        self.effect([0.25] * 168, name="factor", hook="meter factor", column="f", meter="gas", enters="factor")
        self.assertAlmostEqual(float(self.rows()[30]["gas, all"]) / float(plain[30]["gas, all"]), 1.25, places=5)
        (self.folder / "effects.toml").unlink()
        self.effect([-0.5] * 168, name="old boiler", hook="heating efficiency", column="f", enters="factor")
        self.assertAlmostEqual(float(self.rows()[30]["gas, all"]) / float(plain[30]["gas, all"]), 1.5, places=5)

    def test_outdoor_air_warms_the_weather(self):
        self.effect([2.5] * 168, name="city", hook="outdoor air", column="t")
        self.assertAlmostEqual(float(self.rows()[0]["room"]), 1 + 2.5 + 3, places=4)

    def test_what_cannot_enter_is_told_and_the_run_goes_on(self):
        plain = self.rows()
        self.effect([1] * 168, name="heavy", hook="second mass", column="m")
        self.effect([1] * 168, name="odd", hook="colour", column="m")
        self.assertEqual(self.rows(), plain)
        told = (self.folder / "effects_left_out.txt").read_text().splitlines()
        self.assertEqual([line.split(":")[0] for line in told], ["heavy", "odd"])
        (self.folder / "effects.toml").unlink()
        self.rows()
        self.assertFalse((self.folder / "effects_left_out.txt").exists())

    def test_bad_effects(self):
        self.effect([1] * 168, name="x", hook="gains", column="a")
        (self.folder / "effects.csv").write_text("b\n1\n")
        self.fails("effects.csv", "'a'")
        (self.folder / "effects.csv").write_text("a\n1\n")
        self.fails("1 rows", "expected 168")
        (self.folder / "effects.csv").write_text("a\n" + "nan\n" * 168)
        self.fails("each a number")
        (self.folder / "effects.toml").write_text("effect = 3\n")
        self.fails("[[effect]]")
        (self.folder / "effects.toml").write_text("[[effect]\n")
        self.fails("effects.toml", "expected TOML")

    def test_what_energyplus_would_receive(self):
        self.effect([1.5] * 168, name="warm", hook="heating set-point", column="w")
        before = (self.folder / "model.epJSON").read_bytes()
        done = self.call("--patch-only")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "model.epJSON").read_bytes(), before)
        made = json.loads((self.folder / "model-effects-2021.epJSON").read_text())
        self.assertIn("Schedule:File", made)
        difference = (self.folder / "model-effects-2021.diff").read_text()
        self.assertIn('+   "heating_setpoint_temperature_schedule_name": "bemcal_', difference)
        self.assertIn('-   "air_changes_per_hour": 0.4', difference)
        self.assertNotIn('"Lights"', difference)
        self.assertEqual((self.folder / "model-effects-2021.idf").read_text(), "Version, 25.2;\n")
        series = (self.folder / "model-effects-2021.csv").read_text().splitlines()
        self.assertEqual(len(series), 1 + YEAR)
        self.assertEqual((series[1], series[1 + 59 * 24], series[1 + 61 * 24]), ("1.5", "1.5", "0.0"))


class Tables(unittest.TestCase):
    """Parameters and hooks on the objects of the office."""

    def setUp(self):
        self.model = model.Model(office.model(), "office.epJSON")
        self.changes = Changes(self.model, YEAR)

    def apply(self, rows=(), plant=None, **values):
        plant = plant or hours.plant_of(self.model, {})
        parameters.apply(self.model, values, list(rows), self.changes, plant)
        return plant

    def field(self, kind, name, key):
        return self.model.find(kind, name)[key]

    def enter(self, hook, values=0.5, **more):
        series = np.broadcast_to(np.asarray(values, float), YEAR)
        left_out, moved = {}, []
        effects.enter([effects.Effect("it", hook, series, more)], self.model, self.changes, lambda s: s,
                      moved.append, {"lights": {"hook": "schedule of lights", "span": 0.5}}, left_out)
        self.changes.finish()
        return {name: why for (name, _), why in left_out.items()}, moved

    def lines(self):
        """Of all programs."""
        return [row["program_line"] for _, fields in self.model.all("EnergyManagementSystem:Program")
                for row in fields["lines"]]

    def test_factors(self):
        self.apply(infiltration=2.0, lights=0.5, equipment=1.5, people=2.0, outdoor_air=3.0)
        self.assertEqual(self.field("ZoneInfiltration:DesignFlowRate", "South room leaks", "air_changes_per_hour"), 0.8)
        self.assertEqual(self.field("Lights", "South room lights", "watts_per_floor_area"), 4.5)
        self.assertEqual(self.field("ElectricEquipment", "North room plugs", "watts_per_floor_area"), 12)
        self.assertEqual(self.field("People", "North room people", "floor_area_per_person"), 7.5)
        self.assertAlmostEqual(self.field("DesignSpecification:OutdoorAir", "fresh AIR",
                                          "outdoor_air_flow_per_zone_floor_area"), 0.0024)

    def test_u_values_by_the_layer_that_insulates(self):
        bare = 0.24 / 0.8 + parameters.FILMS
        self.apply(u_walls=1.25)
        made = self.field("Construction", "Outer wall", "outside_layer")
        self.assertNotEqual(made, "Wall insulation")
        resistance = self.field("Material:NoMass", made, "thermal_resistance")
        self.assertAlmostEqual((bare + 1.8) / (bare + resistance), 1.25)
        self.assertEqual(self.field("Construction", "Roof", "outside_layer"), "Roof insulation")
        self.assertEqual(self.field("Material:NoMass", "Wall insulation", "thermal_resistance"), 1.8)

    def test_a_layer_with_mass_changes_its_conductivity(self):
        self.model.find("Construction", "Outer wall").pop("layer_2")
        self.model.find("Construction", "Outer wall")["outside_layer"] = "Brick"
        self.apply(u_walls=0.8)
        made = self.model.find("Material", self.field("Construction", "Outer wall", "outside_layer"))
        own = 0.24 / 0.8
        self.assertAlmostEqual((own + parameters.FILMS) / (0.24 / made["conductivity"] + parameters.FILMS), 0.8)
        self.assertEqual(made["thickness"], 0.24)

    def test_windows_become_simple_glazing(self):
        self.apply(u_windows=1.5, g_windows=0.8)
        made = self.model.find("WindowMaterial:SimpleGlazingSystem",
                               self.field("Construction", "Double glazing", "outside_layer"))
        self.assertAlmostEqual(made["u_factor"], 3)
        self.assertAlmostEqual(made["solar_heat_gain_coefficient"], 0.44)

    def give_panes(self):
        """4-12-4 of clear glass."""
        pane = {"optical_data_type": "SpectralAverage", "thickness": 0.004, "conductivity": 1,
                "solar_transmittance_at_normal_incidence": 0.83,
                "front_side_solar_reflectance_at_normal_incidence": 0.075,
                "back_side_solar_reflectance_at_normal_incidence": 0.075,
                "front_side_infrared_hemispherical_emissivity": 0.84,
                "back_side_infrared_hemispherical_emissivity": 0.84}
        self.model.add("WindowMaterial:Glazing", "Clear", pane)
        self.model.add("WindowMaterial:Gas", "Gap", {"gas_type": "Air", "thickness": 0.012})
        self.model.find("Construction", "Double glazing").update(outside_layer="Clear", layer_2="Gap", layer_3="Clear")

    def test_panes_become_their_u_value_and_g(self):
        self.give_panes()
        self.apply(u_windows=1.25)
        construction = self.model.find("Construction", "Double glazing")
        self.assertEqual(list(construction), ["outside_layer"])
        made = self.model.find("WindowMaterial:SimpleGlazingSystem", construction["outside_layer"])
        self.assertAlmostEqual(made["u_factor"] / 1.25, 2.86, delta=0.06)      # EN 673 of 4-12-4
        self.assertAlmostEqual(made["solar_heat_gain_coefficient"], 0.76, delta=0.02)

    def test_panes_stay_while_nothing_scales_them(self):
        """At exactly 1 alone: the nominal model is the user's."""
        self.give_panes()
        before = self.model.text()
        self.apply(u_windows=1, g_windows=1.0)
        self.assertEqual(self.model.text(), before)
        for values in ({"u_windows": 1, "g_windows": 0.9999}, {"u_windows": 1.0001, "g_windows": 1}):
            self.setUp()
            self.give_panes()
            self.apply(**values)
            self.assertEqual(list(self.model.find("Construction", "Double glazing")), ["outside_layer"])

    def test_ideal_loads_have_their_plant_in_the_run_file(self):
        plant = self.apply(plant=hours.plant_of(self.model, {"heating_carrier": "gas", "heating_efficiency": 0.8}),
                           heating_efficiency=0.5)
        self.assertEqual(plant.efficiency, 0.4)
        with self.assertRaises(Failed):
            self.apply(plant=plant, cooling_cop=2)       # no carrier of cold

    def give_fuels(self, **heating):
        """Ideal loads that burn gas, or what is said, and cool by electricity."""
        self.model.add("Schedule:Constant", "Good", {"hourly_value": 0.9})
        for _, fields in self.model.all("ZoneHVAC:IdealLoadsAirSystem"):
            fields |= {"heating_fuel_type": "NaturalGas", "heating_fuel_efficiency_schedule_name": "Good", **heating,
                       "cooling_fuel_type": "Electricity"}

    def test_ideal_loads_with_fuels_have_schedules_of_efficiency(self):
        self.give_fuels()
        plant = self.apply(heating_efficiency=0.7, cooling_cop=2)
        self.assertEqual((plant.own, plant.efficiency, plant.cop), (("heating", "cooling"), 1, 1))
        self.changes.finish()
        lines = [line.replace("bemcal_", "") for line in self.lines()]
        at = lines.index("SET changed = Good_Schedule_Value")
        self.assertAlmostEqual(1 + float(lines[at + 1].partition("(1 + ")[2].rstrip(")")), 0.7)
        at = lines.index("SET changed = 1.0")          # no schedule, which is 1
        self.assertEqual(lines[at + 1], "SET changed = changed * (1 + 1)")
        systems = [fields for _, fields in self.model.all("ZoneHVAC:IdealLoadsAirSystem")]
        self.assertEqual(len({fields["heating_fuel_efficiency_schedule_name"] for fields in systems}), 1)
        self.assertNotEqual(systems[0]["heating_fuel_efficiency_schedule_name"], "Good")

    def test_fuels_of_ideal_loads_at_their_nominal_efficiency_stay_as_they_are(self):
        self.give_fuels()
        before = self.model.text()
        self.apply(heating_efficiency=1.0, cooling_cop=1.0)
        self.assertEqual(self.model.text(), before)

    def test_what_energyplus_counts_of_ideal_loads_is_not_counted_again(self):
        """With a fuel of the model its meters hold; district heat at 1 is heat, which the plant turns into gas."""
        said = {"heating_carrier": "gas", "heating_efficiency": 0.5}
        for heating, gas, district in (({}, 0, 2), ({"heating_fuel_type": "DistrictHeatingWater"}, 0, 2),
                                       ({"heating_fuel_type": "DistrictHeatingWater",
                                         "heating_fuel_efficiency_schedule_name": "Always"}, 4, 0)):
            self.setUp()
            self.give_fuels(**heating)
            of_run = hours.Hours(1)
            of_run.series(of_run.meters, "Heating:DistrictHeatingWater")[:] = 2
            of_run.series(of_run.meters, "DistrictHeatingWater:Facility")[:] = 2
            of_run.series(of_run.rooms, "A")[:], of_run.zones["A"] = 20, (1, 1)
            made = hours.energies(of_run, hours.plant_of(self.model, said))
            self.assertEqual((made["gas"].total[0], made["district"].total[0]), (gas, district), heating)

    def test_efficiency_stays_below_one(self):
        self.model.add("Boiler:HotWater", "Boiler", {"nominal_thermal_efficiency": 0.9})
        self.apply(heating_efficiency=1.2)
        self.assertEqual(self.field("Boiler:HotWater", "Boiler", "nominal_thermal_efficiency"), 1)

    def test_rows_of_the_users_own(self):
        row = {"parameter": "mass", "class": "Zone", "object": "South room", "field": "multiplier", "how": "add"}
        self.apply([row], mass=2)
        self.assertEqual([self.field("Zone", f"{side} room", "multiplier") for side in ("South", "North")], [3, 1])
        for change, word in (({"field": "colour"}, "colour"), ({"how": "twice"}, "twice"),
                             ({"class": "Zoo"}, "no 'Zoo'; there are: 'Version'")):
            with self.assertRaisesRegex(Failed, word):
                self.apply([{**row, **change}], mass=2)

    def test_each_parameter_moves_something_or_says_so(self):
        for name in parameters.USUAL:
            made = model.Model(office.model(), "x")
            before = made.text()
            plant = hours.plant_of(made, {"heating_carrier": "gas", "cooling_carrier": "electricity"})
            changes = Changes(made, YEAR)
            parameters.apply(made, {name: 1.1}, [], changes, plant)
            changes.finish()
            self.assertTrue(made.text() != before or 1.1 in (plant.efficiency, plant.cop), name)
        bare = model.Model({"Version": {"v": {"version_identifier": "25.2"}}}, "x")
        for name in parameters.USUAL:
            with self.assertRaisesRegex(Failed, name):
                parameters.apply(bare, {name: 1.1}, [], Changes(bare, YEAR), hours.plant_of(bare, {}))

    def test_set_points_by_a_program(self):
        self.apply(heating_set_point=0.5)
        self.assertEqual(self.enter("heating set-point", 2.0), ({}, []))
        lines = self.lines()
        self.assertEqual([line.replace("bemcal_", "") for line in lines], [
            "IF Heat_Schedule_Value == 0", "SET Heat_changed_Value = Null", "ELSE", "SET changed = Heat_Schedule_Value",
            "SET changed = changed + 0.5", "SET changed = changed + it_Schedule_Value * in_use_Schedule_Value",
            "SET limit = Cold_Schedule_Value - 0.1", "SET changed = @Min changed limit",
            "SET Heat_changed_Value = changed", "ENDIF"])
        made = self.field("ThermostatSetpoint:DualSetpoint", "Set-points", "heating_setpoint_temperature_schedule_name")
        self.assertEqual(self.field("Schedule:Constant", made, "hourly_value"), 0)
        self.assertEqual(self.field("ThermostatSetpoint:DualSetpoint", "Set-points",
                                    "cooling_setpoint_temperature_schedule_name"), "Cold")

    def test_schedules_written_in_several_ways(self):
        """A use written in capitals, with another factor: EnergyPlus sees no case."""
        self.model.add("Lights", "Sign", {**self.model.all("Lights")[0][1], "schedule_name": "LIGHT"})
        slots = [self.changes.slot("Lights", name, fields, "schedule_name") for name, fields in
                 (self.model.all("Lights")[0], ("Sign", self.model.find("Lights", "Sign")))]
        for slot, factor in zip(slots, ("0.1", "0.2")):
            slot.terms.append(Term("factor", factor))
        self.changes.finish()
        names = [slot.made.lower() for slot in slots]
        self.assertEqual(len(set(names)), 2)

    def test_fields_that_follow_one_schedule_share_what_is_made_of_it(self):
        self.model.add("ThermostatSetpoint:DualSetpoint", "Others", {
            "heating_setpoint_temperature_schedule_name": "HEAT", "cooling_setpoint_temperature_schedule_name": "Cold"})
        self.model.add("ThermostatSetpoint:DualSetpoint", "Cool", {
            "heating_setpoint_temperature_schedule_name": "Heat", "cooling_setpoint_temperature_schedule_name": "Air"})
        self.enter("heating set-point", 2.0)
        key = "heating_setpoint_temperature_schedule_name"
        made = [self.field("ThermostatSetpoint:DualSetpoint", name, key) for name in ("Set-points", "Others", "Cool")]
        self.assertEqual(made[0], made[1])
        self.assertNotEqual(made[0], made[2])           # another limit
        self.setUp()
        self.enter("loads", 0.5)
        self.assertEqual(len([line for line in self.lines() if "(1 +" in line]), 3)   # people, lights, equipment
        for hook in ("lights", "equipment"):
            self.setUp()
            self.enter(hook, 0.5)
            self.assertEqual(len([line for line in self.lines() if "(1 +" in line]), 1)

    def test_infiltration_more_and_less(self):
        self.enter("infiltration", np.where(np.arange(YEAR) < 100, 0.3, -0.2))
        added = [fields for name, fields in self.model.all("ZoneInfiltration:DesignFlowRate")
                 if name.startswith("bemcal_")]
        self.assertEqual([fields["air_changes_per_hour"] for fields in added], [1, 1])
        more, less = self.changes.series.values()
        self.assertEqual((more[0], more[200], less[0], less[200]), (0.3, 0, 0, -0.2))
        self.assertTrue(any("0.34 *" in line for line in self.lines()))

    def test_effects_at_one_hook_add_up(self):
        shift = [effects.Effect(name, hook, np.full(YEAR, value), {"column": name}) for name, hook, value in
                 (("sun", "opaque boundary", 1.0), ("sky", "opaque boundary", -0.4), ("one", "supply air", 1.0),
                  ("two", "supply air", 2.0))]
        left_out = {}
        effects.enter(shift, self.model, self.changes, lambda s: s, None, {}, left_out)
        self.changes.finish()
        self.assertEqual(left_out, {})
        sources = self.model.all("SurfaceProperty:HeatBalanceSourceTerm")
        self.assertEqual(len(sources), 8)               # of six walls and two roofs
        self.assertAlmostEqual(self.changes.series[self.changes.of_walls][0], 0.6)
        self.assertEqual(len([line for line in self.lines() if "* bemcal_sun_Schedule_Value" in line]), 8)
        first, second = [line for line in self.lines() if "South_room_Temperature" in line]
        self.assertIn("Site_Outdoor", first)
        self.assertIn("= bemcal_South_room_Temperature +", second)

    def test_supply_air_comes_in_at_listed_nodes_and_not_at_condensers(self):
        self.model.add("OutdoorAir:Node", "Roof", {})
        self.model.add("OutdoorAir:Node", "Outdoor unit", {})
        self.model.add("NodeList", "More", {"nodes": [{"node_name": "Hatch"}]})
        self.model.add("OutdoorAir:NodeList", "Lists", {"nodes": [{"node_or_nodelist_name": "More"}]})
        self.model.add("Coil:Cooling:DX:SingleSpeed", "Coil", {"condenser_air_inlet_node_name": "OUTDOOR UNIT"})
        self.enter("supply air", 1.0)
        nodes = {fields["actuated_component_unique_name"] for _, fields in
                 self.model.all("EnergyManagementSystem:Actuator")
                 if fields["actuated_component_type"] == "Outdoor Air System Node"}
        self.assertEqual(nodes, {"roof", "hatch", "south room outdoor", "north room outdoor"})

    def test_design_days_see_no_series(self):
        """Fields name schedules that a program sets, and heat by a program ends at once."""
        self.enter("gains", np.where(np.arange(YEAR) < 100, 3, -2))
        more = next(fields for _, fields in self.model.all("OtherEquipment") if fields.get("power_per_floor_area"))
        self.assertIsNotNone(self.model.find("Schedule:Constant", more["schedule_name"]))
        self.assertIn("SET bemcal_it_more_acts_Value = bemcal_it_more_Schedule_Value * bemcal_in_use_Schedule_Value",
                      self.lines())
        heat = next(fields["lines"] for name, fields in self.model.all("EnergyManagementSystem:Program")
                    if name == "bemcal_heat")
        self.assertEqual([row["program_line"] for row in heat[:3]],
                         ["IF bemcal_in_use_Schedule_Value == 0", "RETURN", "ENDIF"])
        days = [row["field"] for row in self.model.find("Schedule:Compact", "bemcal_in_use")["data"]]
        self.assertEqual(days[days.index("For: SummerDesignDay WinterDesignDay") + 2], 0)

    def test_gains_of_either_sign(self):
        self.enter("gains", np.where(np.arange(YEAR) < 100, 3, -2))
        self.assertEqual([fields.get("power_per_floor_area") for _, fields in self.model.all("OtherEquipment")],
                         [1, 1, None, None])
        self.assertEqual(self.enter("meter factor")[0], {})

    def test_supply_air_reaches_nodes_of_a_list(self):
        """Those of ideal loads stand in an OutdoorAir:NodeList alone."""
        self.enter("supply air", 2.0)
        acted = {fields["actuated_component_unique_name"] for _, fields in
                 self.model.all("EnergyManagementSystem:Actuator")}
        self.assertLessEqual({"south room outdoor", "north room outdoor", "South room", "North room"}, acted)

    def test_ventilation_by_what_flows_and_by_the_most(self):
        self.enter("ventilation", 0.4, enters="factor")
        self.assertTrue(any("* (1 + " in line for line in self.lines()))
        self.setUp()
        self.enter("ventilation", 0.4, enters="add")     # as the program writes it
        self.assertFalse(any("* (1 + " in line for line in self.lines()))
        self.setUp()
        self.model.add("Controller:OutdoorAir", "Dampers", {"minimum_outdoor_air_flow_rate": 2,
                                                            "minimum_outdoor_air_schedule_name": "Air"})
        self.enter("ventilation", 0.5, enters="add")     # EnergyPlus cuts this schedule at 1
        self.assertEqual(self.field("Controller:OutdoorAir", "Dampers", "minimum_outdoor_air_flow_rate"), 3)
        least, half = list(self.changes.series.values())[-2:]
        self.assertAlmostEqual((1 + least[0]) * 1.5, 1)
        self.assertAlmostEqual(half[0] * 1.5, 0.5)

    def test_steady_heat_of_a_conductance_in_some_hours(self):
        """A wall's from face to face: its area over the resistance of its layers."""
        self.enter("opaque conductance", np.linspace(0, 0.2, YEAR))
        conductance = 6 * 3.5 / (1.8 + 0.24 / 0.8)
        self.assertTrue(any(f"{conductance:.4f} *" in line for line in self.lines()), self.lines())

    def test_a_facade_by_its_name(self):
        self.enter("aperture", -0.3, facade="south facade")     # as the program writes it
        self.assertEqual(len([line for line in self.lines() if "Transmitted" in line]), 1)
        self.setUp()
        self.enter("aperture", -0.3, facade="south")
        suns = [fields["output_variable_or_output_meter_index_key_name"] for _, fields in
                self.model.all("EnergyManagementSystem:Sensor")
                if "Solar" in fields["output_variable_or_output_meter_name"]]
        self.assertEqual(suns, ["South room window"])
        self.setUp()
        self.assertIn("no window to the east", self.enter("aperture", -0.3, facade="east")[0]["it"])

    def test_schedules_of_the_job(self):
        self.assertEqual(self.enter("occupation", 1.0, schedule="lights")[0], {})
        self.assertEqual(set(self.changes.series.popitem()[1]), {0.5})       # times its span
        self.setUp()
        self.assertIn("'desks'", self.enter("occupation", 1.0, schedule="desks")[0]["it"])

    def test_a_constant_conductance_is_that_of_the_layers(self):
        self.enter("opaque conductance", 0.2)
        self.assertIn(" for u_walls 1.2", self.field("Construction", "Outer wall", "outside_layer"))
        self.assertEqual(self.lines(), [])
        self.enter("opaque conductance", np.linspace(0, 0.2, YEAR))
        self.assertTrue(self.lines())

    def test_every_hook_of_the_program_has_a_row(self):
        names = [line.split('"')[1].lower() for line in HOOKS_OF_PROGRAM.read_text().splitlines()
                 if ".name = \"" in line]
        self.assertGreater(len(names), 25)
        self.assertEqual([name for name in names if name not in effects.HOOKS], [])

    def test_each_hook_changes_the_model_or_the_hours(self):
        left_here = {"second mass", "ground", "neighbour", "economiser", "supply temperature", "operation",
                     "room spread", "occupation", "plant operation"}
        for hook, row in effects.HOOKS.items():
            with self.subTest(hook):
                self.setUp()
                before = self.model.text()
                left_out, moved = self.enter(hook, 0.3, meter="gas")
                self.assertEqual(bool(left_out), hook in left_here, left_out)
                self.assertTrue(left_out or moved or row.after or self.model.text() != before)

    def test_names_of_before_spaces(self):
        given = office.model()
        given["Version"]["Version 1"]["version_identifier"] = "9.4"
        self.model = model.Model(given, "old")
        self.changes = Changes(self.model, YEAR)
        self.enter("gains", 1.0)
        self.assertEqual({tuple(key for key in fields if key.startswith("zone")) for _, fields in
                          self.model.all("OtherEquipment")}, {("zone_or_zonelist_name",)})

    def test_lists_of_zones(self):
        self.model.add("ZoneList", "All", {"zones": [{"zone_name": "NORTH ROOM"}, {"zone_name": "South room"}]})
        self.model.objects["ZoneControl:Thermostat"] = {"t": {"zone_or_zonelist_name": "all"}}
        self.assertEqual(self.model.conditioned(), ["South room", "North room"])


class Shipped(unittest.TestCase):
    """The texts of jobs/energyplus_office fit together."""

    def setUp(self):
        self.folder = ROOT / "jobs" / "energyplus_office"
        self.job = tomllib.loads((self.folder / "energyplus_office.toml").read_text())
        self.template = (self.folder / "run.json.in").read_text()
        self.run = json.loads(re.sub("@[a-z_]+@", "1", self.template))

    def test_parameters_periods_and_columns(self):
        simulator = self.job["simulator"]
        names = [each["name"] for each in simulator["parameter"]]
        self.assertEqual(re.findall("@([a-z_]+)@", self.template), names)
        self.assertLessEqual(set(names), set(parameters.USUAL))
        self.assertEqual([[str(day) for day in period] for period in weather.read_periods(self.folder / "periods.csv")],
                         list(self.job["periods"].values()))
        meters = [(meter["name"], meter["quantity"]) for meter in self.job["meter"]]
        self.assertEqual([(meter["name"], meter["quantity"]) for meter in self.run["meters"]], meters)
        self.assertEqual([each["column"] for each in simulator["hourly"]], [name for name, _ in meters])
        self.assertEqual(set(self.run["schedules"]), {each["name"] for each in self.job["schedule"]})

    def test_files(self):
        simulator = self.job["simulator"]
        self.assertEqual((self.folder / simulator["command"][0]).resolve(), RUNNER.resolve())
        linked = {pathlib.Path(file).name for file in simulator["files"]}
        self.assertEqual(linked, {self.run["model"], self.run["periods"], *self.run["weather"]})
        self.assertTrue(all((self.folder / file).is_file() for file in simulator["files"]))

    def test_the_model_is_what_the_generator_writes(self):
        self.assertEqual(json.loads((self.folder / "office.epJSON").read_text()), office.model())


class Parts(unittest.TestCase):
    def test_periods_are_cut_at_the_turn_of_the_year(self):
        spans, n_hours = weather.spans_of([(datetime.date(2020, 12, 31), datetime.date(2021, 1, 1)),
                                           (datetime.date(2020, 1, 1), datetime.date(2020, 1, 1))])
        self.assertEqual([(str(span.begin.date()), span.n_hours, span.at) for span in spans],
                         [("2020-12-31", 24, 0), ("2021-01-01", 24, 24), ("2020-01-01", 24, 48)])
        self.assertEqual(n_hours, 72)

    def test_words_of_the_first_severe_error(self):
        text = "  ** Warning ** a\n  ** Severe  ** b\n  **   ~~~   ** c\n  ** Severe  ** d\n"
        self.assertEqual(program.severe_words(text), "b c; d")
        self.assertEqual(program.severe_words(text + "  ** Severe  ** e\n" * 4), "b c; d; e (and 3 more)")
        self.assertEqual(program.severe_words("  **  Fatal  ** the end\n  **   ~~~   ** of it\n"), "the end of it")
        self.assertEqual(program.severe_words(""), "")

    def test_a_typical_year_stands_for_every_year(self):
        rows = [[str(1990 + month), str(month), "1", "1", "60", "", "5"] for month in range(1, 13)] * 730
        self.assertTrue(weather.is_typical(weather.Epw("t", [], rows, {int(row[0]) for row in rows})))
        real = [["2021", "12", "31", "24"], ["2022", "1", "1", "1"]]
        self.assertFalse(weather.is_typical(weather.Epw("r", [], real, {2021, 2022})))


if __name__ == "__main__":
    unittest.main()
