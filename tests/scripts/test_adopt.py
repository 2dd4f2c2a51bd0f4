#!/usr/bin/python3
"""scripts/adopt writes a job anew with what its loop found, and leaves all else as it was."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest

import h5py
import numpy as np

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(pathlib.Path(__file__).parent)]

import fake_loop_result  # noqa: E402
import fake_simulator  # noqa: E402
from report import adopted, result  # noqa: E402
from report.refused import NO_INPUT  # noqa: E402

JOB = """# A job.
name = "office"   # of a street

[[schedule]]
name = "plant"    # by hand
weekdays = [0, 1]
saturday = 0

[[parameter]]
name = "u_wall"   # of walls
target = "construction.wall.u_value"
min = 0.2
max = 1
prior = {kind = "normal", mean = 0.5, sd = 0.2}   # by age

[[parameter]]
name = "kept"     # not of the loop
target = "zone.office.volume"
min = 1
max = 2

[[study]]
kind = "loop"     # the last
"""
HOURS = '# in the [[schedule]] "plant", in place of what it has:\nsaturday = [1, 0]\n'
BY_WIND = '[[effect]]\nname = "wind infiltration"\ncoefficient = 0.083\n\n' \
          '[[parameter]]\nname = "wind infiltration"\ntarget = "effect.wind infiltration"\nmin = 0\nmax = 0.1\n'


OF_STRUCTURE = '[[effect]]\nname = "share by wind"\nhook = "leakage"\ncoefficient = 0.3\n\n' \
               '[[parameter]]\nname = "other_0"\ntarget = ["zone.office.mass_area_ratio"]\n' \
               'min = 1\nmax = 4\nvalue = 2.25\nprior = {kind = "normal", mean = 2.25, sd = 0.1}\n'
FUNCTIONS = '[[effect]]\nname = "functions at gains"\nhook = "gains"\ncoefficient = 1\n\n' \
            '[[effect.function]]\ndriver = "wind"\nat = [0, 9]\nvalues = [1, 2]\n'


def write_result(path, sections, parts=()):
    fake_loop_result.write(path, {"gas": "kWh"}, found=len(sections))
    with h5py.File(path, "a") as file:
        stage = file["office/loop"]
        del stage["effect_section"], stage["parameter"]
        for name in ("function", "refinement", "refinement_is"):
            stage.pop(name, None)
        refinements = ["surfaces", "wind in leaks"] if parts else []
        fake_loop_result.text(stage, "refinement", refinements)
        fake_loop_result.text(stage, "refinement_is", refinements)
        fake_loop_result.text(stage, "function", [])
        fake_loop_result.text(stage, "job_part", [part[0] for part in parts])
        fake_loop_result.text(stage, "job_part_section", [part[1] for part in parts])
        fake_loop_result.text(stage, "effect_section", sections)
        names = ["u_wall"] + [f"other_{k}" for k in range(5)]
        fake_loop_result.text(stage, "parameter", names)


class Adopt(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.job, self.new, self.result = (self.folder / name for name in ("job.toml", "new.toml", "job.h5"))
        self.job.write_text(JOB)

    def adopt(self, *options, sections=(BY_WIND,), code=0):
        if not self.result.exists():
            write_result(self.result, list(sections))
        run = subprocess.run([ROOT / "scripts/adopt", self.result, self.job, "-o", self.new, *options],
                             capture_output=True, text=True)
        self.assertEqual(run.returncode, code, run.stderr)
        return run.stdout + run.stderr

    def test_what_is_not_adopted_stays_to_the_letter(self):
        self.adopt("--keep-priors", sections=())
        lines = self.new.read_text().splitlines(keepends=True)
        self.assertEqual("".join(line for line in lines if not line.startswith("value = ")), JOB)
        self.assertEqual(self.job.read_text(), JOB)

    def test_a_calibrated_value_is_kept_to_the_digit(self):
        self.adopt("--keep-priors")
        wall, kept = tomllib.loads(self.new.read_text())["parameter"][:2]
        self.assertEqual(wall["value"], result.read(self.result).value_of(result.AFTER, 0))
        self.assertEqual(wall["prior"], {"kind": "normal", "mean": 0.5, "sd": 0.2})
        self.assertNotIn("value", kept)

    def test_an_effect_is_a_section_with_its_parameter_and_what_carried_it(self):
        self.adopt()
        text = self.new.read_text()
        job = tomllib.loads(text)
        self.assertEqual([row["name"] for row in job["effect"]], ["wind infiltration"])
        self.assertEqual(job["effect"][0]["coefficient"], 0.083)
        self.assertEqual([row["name"] for row in job["parameter"]], ["u_wall", "kept", "wind infiltration"])
        self.assertIn("# found by the loop, evidence 412", text)
        self.assertIn("calm and windy nights apart", text)
        for line in JOB.splitlines():
            if not line.startswith("prior"):
                self.assertIn(line, text)

    def test_a_posterior_is_a_prior(self):
        printed = self.adopt()
        loop = result.read(self.result)
        prior = tomllib.loads(self.new.read_text())["parameter"][0]["prior"]
        self.assertEqual(prior["kind"], "normal")
        self.assertAlmostEqual(prior["mean"], min(loop.value_of(result.AFTER, 0), 1), 3)
        self.assertAlmostEqual(prior["sd"], loop.sd_of(result.AFTER, 0), 3)
        self.assertIn("priors of 1 parameters", printed)
        self.assertNotIn("prior", tomllib.loads(self.new.read_text())["parameter"][1])

    def test_hours_go_into_their_schedule(self):
        self.adopt("--keep-priors", sections=(HOURS,))
        job = tomllib.loads(self.new.read_text())
        self.assertEqual(job["schedule"][0]["saturday"], [1, 0])
        self.assertNotIn("effect", job)
        self.assertIn('name = "plant"    # by hand', self.new.read_text())

    def test_structure_and_functions_are_sections_with_functions_before_all_effects(self):
        write_result(self.result, [BY_WIND], parts=[("structure", OF_STRUCTURE), ("functions", FUNCTIONS)])
        printed = self.adopt("--keep-priors")
        job = tomllib.loads(self.new.read_text())
        self.assertEqual(job["structure"], ["surfaces", "wind in leaks"])
        self.assertLess(self.new.read_text().index("structure = "), self.new.read_text().index("[[schedule]]"))
        self.assertEqual([row["name"] for row in job["effect"]],
                         ["functions at gains", "share by wind", "wind infiltration"])
        self.assertEqual(job["effect"][0]["function"][0]["values"], [1, 2])
        # Of a parameter of the structure its prior, not what these readings have made of it.
        other = next(row for row in job["parameter"] if row["name"] == "other_0")
        loop = result.read(self.result)
        self.assertEqual(other["prior"], {"kind": "normal", "mean": loop.of_parameters[1].mean,
                                          "sd": loop.of_parameters[1].sd})
        self.assertEqual(other["value"], 2.25)
        self.assertIn("structure: surfaces + wind in leaks", printed)
        self.assertIn("functions at gains: without a name, as values at points", printed)

    def test_numbers_of_a_structure_that_the_job_has_already_keep_their_sections(self):
        write_result(self.result, [], parts=[("structure", OF_STRUCTURE)])
        self.job.write_text(JOB + OF_STRUCTURE)
        self.adopt("--keep-priors")
        job = tomllib.loads(self.new.read_text())
        self.assertEqual([row["name"] for row in job["effect"]], ["share by wind"])
        other, = (row for row in job["parameter"] if row["name"] == "other_0")
        self.assertEqual(other["value"], result.read(self.result).value_of(result.AFTER, 1))

    def test_hours_that_were_learned_stand_in_place_of_learn(self):
        self.job.write_text(JOB.replace("weekdays = [0, 1]\nsaturday = 0\n", 'hours = "learn"\nuse = "office"\n'))
        write_result(self.result, [], parts=[("hours", HOURS)])
        self.adopt("--keep-priors")
        schedule = tomllib.loads(self.new.read_text())["schedule"][0]
        self.assertEqual(schedule, {"name": "plant", "saturday": [1, 0]})

    def test_what_the_result_has_no_section_of_is_told(self):
        self.assertIn("left out: effect wind infiltration: the result has no section of it",
                      self.adopt(sections=("",)))

    def test_nothing_is_written_over(self):
        self.new.write_text("mine")
        self.assertIn("is there already; --force writes over it", self.adopt(code=73))
        self.assertEqual(self.new.read_text(), "mine")
        self.adopt("--force")
        self.new = self.result
        self.assertIn("is the result", self.adopt("--force", code=73))
        self.new = self.job.with_name("readings.csv")
        self.new.write_text("time,gas\n")
        with h5py.File(self.result, "a") as file:
            file.require_group("inputs").create_dataset("input_file", data=["office.toml", "readings.csv"])
        self.assertIn("is an input of the job", self.adopt("--force", code=73))
        self.assertEqual(self.new.read_text(), "time,gas\n")
        self.new = self.job
        self.assertIn("is the job itself", self.adopt("--force", code=64))
        self.new = self.folder / "elsewhere" / "new.toml"
        self.assertIn("expected a name beside", self.adopt(code=64))

    def test_another_job_is_refused(self):
        self.job.write_text(JOB.replace("u_wall", "u_roof"))
        self.assertIn("has none of the parameters of office/loop", self.adopt(code=65))
        self.job.write_text("name =")
        self.assertIn("is no TOML", self.adopt(code=78))
        self.job.unlink()
        self.assertIn("no such file", self.adopt(code=66))
        self.assertFalse(self.new.exists())

    def test_twice_is_refused(self):
        self.job.write_text(JOB + '\n[[effect]]\nname = "wind infiltration"\ncoefficient = 1\n')
        self.assertIn('has an effect "wind infiltration" already', self.adopt(code=65))

    def test_a_damaged_result_is_refused(self):
        self.result.write_bytes(b"no HDF5")
        self.assertIn("damaged", self.adopt(code=65))


class Numbers(unittest.TestCase):
    def test_have_four_digits(self):
        self.assertEqual([adopted.rounded(x) for x in (0.123456, 489355.2, np.float64(2))], [0.1235, 489400, 2])


SIMULATOR = """[simulator]
command = ["COMMAND", "run.json"]
files = ["site.epw"]

[[simulator.template]]
file = "run.json.in"

[[simulator.template]]
file = "note.txt"
as = "notes"
"""
RUNNER = """#!/usr/bin/python3
import sys
if "--patch-only" in sys.argv:
    open("changed.epJSON", "w").write(open("run.json").read())
    print("wrote changed.epJSON")
else:
    sys.exit("not to be run")
"""


class OfAProgram(unittest.TestCase):
    """A loop around another program: its inputs, in a folder."""

    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.folder = pathlib.Path(held.name)
        fake_loop_result.write(self.folder / "result.h5", {"gas": "kWh"}, found=1)
        fake_simulator.add_to(self.folder / "result.h5")
        self.write("run.json.in", '{"u_wall": @u_wall@, "leaks": @leaks@, "mail": "a@b"}')
        self.write("note.txt", "plain")
        self.write("site.epw", "weather")
        self.write("energyplus_hours", RUNNER)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def adopt(self, command="house", job=SIMULATOR):
        self.write("job.toml", JOB + job.replace("COMMAND", command))
        return subprocess.run([ROOT / "scripts/adopt", "result.h5", "job.toml", "-o", "found"], cwd=self.folder,
                              capture_output=True, text=True, check=False)

    def text(self, name):
        return (self.folder / "found" / name).read_text(encoding="utf-8")

    def test_inputs_have_the_values_of_the_best_run(self):
        done = self.adopt()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.text("run.json"), '{"u_wall": 1.25, "leaks": 0.125, "mail": "a@b"}')
        self.assertEqual((self.text("notes"), self.text("site.epw")), ("plain", "weather"))
        self.assertIn("parameter leaks: 0.125", done.stdout)
        self.assertIn("effect wind infiltration: at infiltration, 0.9 times what was found", done.stdout)
        self.assertNotIn("blinds", done.stdout)

    def test_effects_are_the_files_that_a_point_has(self):
        self.adopt()
        self.assertEqual(self.text("effects.toml"), '[[effect]]\nname = "wind infiltration"\nhook = "infiltration"\n'
                         'unit = "1/h"\nenters = "add"\ncolumn = "effect_1"\n')
        self.assertEqual(self.text("effects.csv"), "effect_1\n0.1\n0.2\n0.3\n")
        self.assertEqual(tomllib.loads(self.text("effects.toml"))["effect"][0]["hook"], "infiltration")

    def test_effects_stand_in_templates_where_these_have_places(self):
        self.write("air.dat.in", "@more_air@\n")
        self.write("sun.dat.in", "@shade@\n")
        places = "".join(f'[[simulator.template]]\nfile = "{file}"\n[[simulator.effect]]\nname = "{name}"\n'
                         f'hook = "{hook}"\n' for file, name, hook in (
                             ("air.dat.in", "more_air", "infiltration"), ("sun.dat.in", "shade", "aperture")))
        done = self.adopt(job=SIMULATOR + places + '[periods]\ntraining = ["2021-01-01", 2021-01-01]\n')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.text("air.dat"), "0.1\n0.2\n0.3\n")
        self.assertEqual(self.text("sun.dat"), 24 * "0\n")
        self.assertFalse((self.folder / "found" / "effects.toml").exists())

    def test_openings_say_from_what_they_open(self):
        with h5py.File(self.folder / "result.h5", "a") as file:
            file["office/loop/simulator_series_opens_above"] = np.array([22.5])
        self.adopt()
        self.assertEqual(tomllib.loads(self.text("effects.toml"))["effect"][0]["opens_above"], 22.5)

    def test_inputs_that_are_gone_leave_no_folder(self):
        for name, key in (("site.epw", "files"), ("run.json.in", "template")):
            kept = (self.folder / name).read_text()
            (self.folder / name).unlink()
            done = self.adopt()
            self.assertEqual(done.returncode, NO_INPUT, done.stderr)
            self.assertIn(f"{name}: No such file or directory; expected the file that the job names in simulator.{key}",
                          done.stderr)
            self.write(name, kept)
        (self.folder / "run.json.in").write_bytes(b"\xff")
        self.assertIn("run.json.in: is no text in UTF-8", self.adopt().stderr)
        self.assertFalse((self.folder / "found").exists())

    def test_of_energyplus_the_changed_model_is_written(self):
        done = self.adopt("./energyplus_hours")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("wrote changed.epJSON", done.stdout)
        self.assertIn("1.25", self.text("changed.epJSON"))

    def test_a_folder_that_is_there_stays(self):
        (self.folder / "found").mkdir()
        done = self.adopt()
        self.assertEqual((done.returncode, done.stderr),
                         (73, "adopt: found: is there already; expected the name of a new folder\n"))

    def test_a_job_without_a_program_is_another_one(self):
        done = self.adopt(job="")
        self.assertEqual((done.returncode, done.stderr), (78, "adopt: job.toml: has no [simulator]; expected the job "
                                                          "that the result is of\n"))


if __name__ == "__main__":
    unittest.main()
