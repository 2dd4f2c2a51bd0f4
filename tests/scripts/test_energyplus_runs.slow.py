#!/usr/bin/python3
"""EnergyPlus itself runs the shipped office: every parameter and every hook moves its meters the right way and brings
no severe error; what ought to be the same is the same. Of DOE's small office effects size no plant. Skipped where
EnergyPlus or the office is not installed (tests/energyplus/idf.py and reports.py say how).
"""
import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests" / "energyplus")]

import idf as installed  # noqa: E402  (found above)
import reports  # noqa: E402
from energyplus import effects, parameters, program  # noqa: E402

JOB = ROOT / "jobs" / "energyplus_office"
RUNNER = ROOT / "scripts" / "energyplus_hours"
SKIPPED = 77
WINTER, SUMMER = "2021-01-11,2021-01-31", "2021-07-05,2021-07-25"
SMALL_OFFICE = "RefBldgSmallOfficeNew2004_Chicago.idf"
N_WINTER = 21 * 24
N_HOURS = 2 * N_WINTER
METERS = {"electricity": "electricity", "gas": "gas", "cold": "cooling", "room": "air_temperature"}
NOTICED = 2e-4                 # of a meter, or K: from which it moves
HOUR = np.arange(N_HOURS) % 24
EVENING = ((HOUR >= 18) & (HOUR < 22)) * 1.0
IN_WINTER = (np.arange(N_HOURS) < N_WINTER) * 1.0
IN_SUMMER = 1 - IN_WINTER
# Value, and the signs of what gas, cold and the room's temperature do; 0: nothing; None: either.
PARAMETERS = {
    "infiltration": (1.5, 1, -1, -1), "outdoor_air": (1.5, 1, -1, None), "lights": (1.3, -1, 1, 1),
    "equipment": (1.3, -1, 1, 1), "people": (1.5, -1, 1, 1), "heating_efficiency": (0.9, 1, 0, 0),
    "cooling_cop": (1.2, 0, 0, 0), "heating_set_point": (1, 1, None, 1), "cooling_set_point": (1, None, -1, 1),
    "u_walls": (1.3, 1, None, -1), "u_roof": (1.3, 1, None, None), "u_windows": (1.3, 1, -1, -1),
    "g_windows": (0.8, 1, -1, -1),
}
BY = {"enters": "factor"}
# Hook, values, more of its section, signs.
HOOKS = (
    ("outdoor air", 1, {}, -1, 1, 1), ("supply air", 2, {}, -1, 1, 1), ("opaque boundary", 2, {}, -1, 1, 1),
    ("window boundary", 2, {}, -1, 1, 1), ("infiltration", 0.3 * EVENING + 0.1, {}, 1, -1, -1),
    ("infiltration", -0.2 * EVENING, {}, -1, 1, 1), ("leakage", 0.5, {}, 1, -1, -1),
    ("ventilation", 0.5, BY, 1, -1, None), ("ventilation", -0.5, BY, -1, 1, None),
    ("ventilation", 0.5 * EVENING, {}, None, -1, -1), ("venting", 2, {}, None, -1, -1),
    ("opaque conductance", 0.2, {}, 1, None, -1), ("opaque conductance", 0.2 * IN_WINTER, {}, 1, 0, -1),
    ("window conductance", 0.2, {}, 1, -1, -1), ("window conductance", 0.2 * IN_WINTER, {}, 1, 0, -1),
    ("neighbour", 0.2, {"temperature": 16}, 1, -1, -1), ("aperture", -0.4, {}, 1, -1, -1),
    ("aperture", -0.4, {"facade": "south facade"}, 1, -1, -1), ("heat recovery", 0.5, {}, -1, None, None),
    ("gains", 3, {}, -1, 1, 1), ("gains", -3 * EVENING, {}, 1, -1, -1), ("loads", -0.3, {}, 1, -1, -1),
    ("lights", -0.3, {}, 1, -1, -1), ("equipment", 0.3, {}, -1, 1, 1),
    ("lights and equipment", 4 * EVENING, {}, -1, 1, 1), ("lights and equipment", -2 * EVENING, {}, 1, -1, -1),
    ("heating set-point", 2 * EVENING, {}, 1, 0, 1), ("heating set-point", 12 * EVENING, {}, 1, None, 1),
    ("cooling set-point", -1.5, {}, None, 1, -1), ("cooling set-point", -15 * EVENING, {}, None, 1, -1),
    ("heating available", -1, {}, -1, None, -1), ("cooling available", -1, {}, None, -1, 1),
    ("operation", 0.5 * EVENING, {"schedule": "heating"}, 1, 0, 1),
    ("occupation", 0.5 * EVENING, {"schedule": "lights"}, -1, 1, 1),
    ("plant operation", EVENING, {"schedule": "ventilation"}, None, -1, -1),
    ("heating efficiency", -0.1, {}, 1, 0, 0), ("cooling COP", -0.1, {}, 0, 0, 0),
    ("meter addition", 2, {"meter": "gas"}, 1, 0, 0), ("meter factor", 0.1, {"meter": "gas"}, 1, 0, 0),
)
LEFT_OUT = {"second mass", "ground", "economiser", "supply temperature", "room spread"}   # of this model


def energyplus():
    """ENERGYPLUS_DIR, or what other tests use."""
    if os.environ.get("ENERGYPLUS_DIR"):
        return os.environ["ENERGYPLUS_DIR"]
    found = installed.program()
    return str(found) if found else None


class Runs:
    """Of a model, in winter and summer weeks."""
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.plain = cls.simulate({})

    @classmethod
    def simulate(cls, values, given=()):
        """{meter: hours} of the winter and the summer weeks; `given`: (section, series) of effects."""
        folder = pathlib.Path(tempfile.mkdtemp())
        try:
            return cls.in_folder(folder, values, given)
        finally:
            shutil.rmtree(folder)

    @classmethod
    def prepare(cls, folder, values):
        run = cls.run_file() | {"energyplus": energyplus(), "parameters": values, "weather": ["weather_2021.epw.gz"],
                                "meters": [{"name": name, "quantity": of} for name, of in METERS.items()]}
        for path in (cls.model_file(), JOB / "weather_2021.epw.gz"):
            (folder / path.name).symlink_to(path)
        (folder / "run.json").write_text(json.dumps(run))
        (folder / "periods.csv").write_text(f"period,first,last\nwinter,{WINTER}\nsummer,{SUMMER}\n")

    @staticmethod
    def call(folder):
        return subprocess.run([RUNNER, folder / "run.json"], capture_output=True, text=True, check=False)

    @classmethod
    def in_folder(cls, folder, values, given):
        cls.prepare(folder, values)
        cls.write_effects(folder, given)
        done = cls.call(folder)
        if done.returncode:
            raise AssertionError(done.stderr)
        errors = (folder / "run_2021" / "eplusout.err").read_text()
        if "** Severe" in errors or (folder / "effects_left_out.txt").exists():
            raise AssertionError(done.stdout + errors[-2000:])
        with open(folder / "hours.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return {name: np.array([float(row[name]) for row in rows]) for name in METERS}

    @staticmethod
    def run_file():
        return json.loads(re.sub(r"@(\w+)@", "null", (JOB / "run.json.in").read_text()))

    @staticmethod
    def model_file():
        return JOB / "office.epJSON"

    @staticmethod
    def write_effects(folder, given):
        if not given:
            return
        columns = [np.broadcast_to(np.asarray(series, float), N_HOURS) for _, series in given]
        with open(folder / "effects.toml", "w", encoding="utf-8") as file:
            for k, (section, _) in enumerate(given):
                keys = {"name": f"effect {k}", "unit": "-", "enters": "add", "column": f"c{k}", **section}
                file.write("[[effect]]\n" + "".join(f"{key} = {json.dumps(value)}\n" for key, value in keys.items()))
        np.savetxt(folder / "effects.csv", np.transpose(columns), delimiter=",", comments="",
                   header=",".join(f"c{k}" for k in range(len(given))))


class Office(Runs, unittest.TestCase):
    """The shipped one, with ideal loads."""

    def check_signs(self, found, signs):
        for meter, sign in zip(("gas", "cold", "room"), signs):
            change = found[meter].mean() - self.plain[meter].mean()
            noticed = NOTICED if meter == "room" else NOTICED * self.plain[meter].mean()
            moved = 0 if abs(change) < noticed else np.sign(change)
            if sign is not None:
                self.assertEqual(moved, sign, f"{meter}: {change:+.4g} of {self.plain[meter].mean():.4g}")

    def test_fields_are_known_by_the_schema(self):
        """One that no object of the model has may be set; one that the class lacks is told with the nearest."""
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        self.prepare(folder, {"sight": 0.1})
        run = json.loads((folder / "run.json").read_text())
        row = {"parameter": "sight", "class": "Lights", "field": "return_air_fraction", "how": "value"}
        for field, code in (("return_air_fraction", 0), ("return_air_fractoin", 65)):
            (folder / "run.json").write_text(json.dumps(run | {"rows": [{**row, "field": field}]}))
            done = subprocess.run([RUNNER, folder / "run.json", "--patch-only"], capture_output=True, text=True,
                                  check=False)
            self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn("nearest: 'return_air_fraction'", done.stderr)

    def test_severe_errors_are_quoted(self):
        """A schedule and a construction that objects name are not there."""
        for change, words in ((lambda model: model["Schedule:Compact"].pop("Plugs"), ("ROOM PLUGS", "schedule_name")),
                              (lambda model: model["Construction"].pop("Roof"), ("SOUTH ROOM ROOF",))):
            folder = pathlib.Path(tempfile.mkdtemp())
            self.addCleanup(shutil.rmtree, folder)
            self.prepare(folder, {})
            model = json.loads((folder / "office.epJSON").read_text())
            change(model)
            (folder / "office.epJSON").unlink()          # a link to the job's
            (folder / "office.epJSON").write_text(json.dumps(model))
            done = self.call(folder)
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (65, 1), done.stderr)
            for word in (*words, "run_2021/eplusout.err"):
                self.assertIn(word, done.stderr)
            self.assertTrue((folder / "run_2021" / "eplusout.err").is_file())

    def test_parameters(self):
        self.assertEqual(set(PARAMETERS), set(parameters.USUAL))
        for name, (value, *signs) in PARAMETERS.items():
            with self.subTest(name):
                found = self.simulate({name: value})
                self.check_signs(found, signs)
                self.assertTrue(any(np.any(found[meter] != self.plain[meter]) for meter in METERS))

    def test_hooks(self):
        self.assertEqual({hook.lower() for hook, *_ in HOOKS} | LEFT_OUT,
                         {hook for hook in effects.HOOKS if not hook.startswith("schedule of")})
        for hook, series, more, *signs in HOOKS:
            with self.subTest(f"{hook} {np.mean(series):g} {more}"):
                found = self.simulate({}, [({"hook": hook, **more}, series)])
                self.check_signs(found, signs)
                self.assertTrue(any(np.any(found[meter] != self.plain[meter]) for meter in METERS))

    def test_what_changes_nothing_changes_nothing(self):
        found = self.simulate({"infiltration": 1, "heating_set_point": 0, "u_walls": 1, "g_windows": 1},
                              [({"hook": hook}, 0) for hook in ("loads", "ventilation", "heating set-point",
                                                                "aperture")])
        for meter in METERS:
            np.testing.assert_allclose(found[meter], self.plain[meter], rtol=1e-4, atol=1e-4)

    def test_two_ways_to_the_same(self):
        for values, given in (({"infiltration": 1.5}, ({"hook": "leakage"}, 0.5)),
                              ({"infiltration": 1.5}, ({"hook": "infiltration"}, 0.2)),
                              ({"heating_set_point": 1.0}, ({"hook": "heating set-point"}, 1.0)),
                              ({"outdoor_air": 0.7}, ({"hook": "ventilation", **BY}, -0.3)),
                              ({"heating_efficiency": 0.8}, ({"hook": "heating efficiency"}, -0.2))):
            with self.subTest(given[0]["hook"]):
                one, other = self.simulate(values), self.simulate({}, [given])
                for meter in METERS:
                    np.testing.assert_allclose(other[meter], one[meter], rtol=1e-3, atol=2e-3)

    def test_effects_at_one_hook_add_up(self):
        for hook in ("opaque boundary", "supply air", "heating set-point", "outdoor air", "infiltration"):
            with self.subTest(hook):
                one = self.simulate({}, [({"hook": hook}, 1.5)])
                two = self.simulate({}, [({"hook": hook}, 1.0), ({"hook": hook}, 0.5)])
                for meter in METERS:
                    np.testing.assert_allclose(two[meter], one[meter], rtol=2e-3, atol=5e-3)

    def test_a_share_of_the_sun_is_nearly_that_of_the_glass(self):
        """As heat it comes a step late, and without what panes absorb."""
        glass, sun = self.simulate({"g_windows": 0.8}), self.simulate({}, [({"hook": "aperture"}, -0.2)])
        for meter in ("gas", "cold"):
            one, other = (found[meter].sum() - self.plain[meter].sum() for found in (glass, sun))
            self.assertLess(abs(other / one - 1), 0.25, meter)

    def test_a_set_point_acts_in_its_hours(self):
        found = self.simulate({}, [({"hook": "heating set-point"}, 3 * EVENING)])
        moved = (found["gas"] - self.plain["gas"]).reshape(-1, 24).mean(axis=0)
        self.assertGreater(moved[18:22].sum(), 3 * abs(moved[6:17]).sum())
        self.assertGreater(moved[18], 0.1)
        self.assertLessEqual(moved[17], 1e-3)      # less, for the room is warmer still


def small_office():
    return reports.file_like(program.find_program(energyplus()), SMALL_OFFICE)


class SmallOffice(Runs, unittest.TestCase):
    """DOE's, whose air systems EnergyPlus sizes by design days in January and July."""

    @staticmethod
    def run_file():
        return {"model": SMALL_OFFICE, "periods": "periods.csv"}

    @staticmethod
    def model_file():
        return small_office()

    @classmethod
    def setUpClass(cls):
        if small_office() is None:
            raise unittest.SkipTest(reports.HOW)
        super().setUpClass()

    def test_effects_size_no_plant(self):
        """What a building does in summer leaves its winter as it was."""
        for hook, size in (("lights and equipment", 5), ("gains", 5), ("loads", 0.5), ("cooling set-point", -1.5),
                           ("infiltration", 1), ("schedule of lights", 0.5)):
            with self.subTest(hook):
                found = self.simulate({}, [({"hook": hook}, size * IN_SUMMER)])
                for meter in METERS:
                    np.testing.assert_allclose(found[meter][:N_WINTER], self.plain[meter][:N_WINTER], rtol=1e-6)
                self.assertGreater(abs(found["electricity"] - self.plain["electricity"])[N_WINTER:].max(), 0.05)

    def test_supply_air_is_that_of_air_systems(self):
        """Whose fans bring far more outdoor air than leaks do."""
        leaks = self.simulate({"infiltration": 0.01}, [({"hook": "supply air"}, 5)])
        cold = self.simulate({"infiltration": 0.01})
        self.assertLess(leaks["gas"][:N_WINTER].sum(), 0.93 * cold["gas"][:N_WINTER].sum())


if __name__ == "__main__":
    if energyplus() is None:
        print(f"skipped: {installed.HOW}, or ENERGYPLUS_DIR")
        sys.exit(SKIPPED)
    unittest.main()
