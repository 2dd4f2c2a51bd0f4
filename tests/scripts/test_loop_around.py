#!/usr/bin/python3
"""A loop around a small program: an effect is found and given to it; the same bits on any ranks and after a stop."""
import gzip
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ["BEMCAL_PROGRAM"]
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMP_WAIT_POLICY": "passive", "OMP_NUM_THREADS": "1"}
WEATHER = "weather_2021.epw.gz"
N_HOURS = 24 * 120            # January to April
BY_WIND = 0.05                # 1/h per m/s: what no description has
STOPPED = 75

HOUSE = '''
"""A house of one temperature: heat by transmission and air, less gains, by a boiler."""
import csv, gzip, json, os, sys
values = json.load(open("run.json"))
with gzip.open("weather_2021.epw.gz", "rt") as file:
    rows = [line.split(",") for line in file.readlines()[8:8 + N_HOURS]]
air = [0.0] * N_HOURS
if os.path.exists("effects.csv"):
    sections = open("effects.toml").read()
    if 'hook = "infiltration"' in sections:
        air = [float(row["effect_1"]) for row in csv.DictReader(open("effects.csv"))]
    else:
        open("effects_left_out.txt", "w").write("only air is known\\n")
if int(1e6 * values["u"]) % 17 == 0:
    sys.exit("the solver gave up")
mass = 20.0
with open("hours.csv", "w") as out:
    out.write("gas\\n")
    for row, more in zip(rows, air):
        outdoor, sun = float(row[6]), float(row[13])
        loss = (values["u"] * 240 + 0.34 * 500 * (values["leaks"] + more)) * (20 - outdoor)
        mass += 0.02 * (20 - mass)
        gain = 600 + 4 * sun
        out.write(f"{max(loss - gain, 0) / 900:.6f}\\n")
'''

JOB = """seed = 5

[weather]
files = ["weather_2021.epw.gz"]

[periods]
training = ["2021-01-01", "2021-03-31"]
held_out = ["2021-04-01", "2021-04-30"]

[[construction]]
name = "wall"
u_value = 1

[[glazing]]
name = "glass"
u_value = 2
solar_transmittance = 0.5

[[zone]]
name = "house"
floor_area = 200
volume = 500
heating_set_point = 20

[[zone.surface]]
construction = "wall"
area = 220
azimuth = 180

[[zone.window]]
glazing = "glass"
area = 10
azimuth = 180

[[zone.flow]]
name = "infiltration"
air_change = 0.5

[[zone.load]]
name = "people"
density = 3

[plant]
heating_carrier = "gas"
heating_efficiency = 0.9

[[meter]]
name = "gas"
quantity = "gas"
file = "measured.csv"
column = "gas"
unit = "kWh"

[[parameter]]
name = "walls"
target = "construction.wall.u_value"
min = 0.3
max = 2
prior = {kind = "normal", mean = 1, sd = 0.3}

[[parameter]]
name = "air"
target = "zone.house.flow.infiltration.air_change"
min = 0
max = 2
prior = {kind = "normal", mean = 0.5, sd = 0.3}

[simulator]
command = ["/usr/bin/python3", "house.py"]
files = ["house.py", "weather_2021.epw.gz"]

[[simulator.template]]
file = "run.json.in"

[[simulator.parameter]]
name = "u"
min = 0.5
max = 2
nominal = 1

[[simulator.parameter]]
name = "leaks"
min = 0
max = 1.5
nominal = 0.5

[[simulator.hourly]]
meter = "gas"

[[study]]
kind = "loop"
runs = 36
try_structures = false
generic = false
functions = false

[output]
file = "house.h5"
max_failed_share = 0.5
"""


class LoopAroundAProgram(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        (cls.folder / WEATHER).write_bytes((ROOT / "jobs" / "energyplus_office" / WEATHER).read_bytes())
        (cls.folder / "house.py").write_text(HOUSE.replace("N_HOURS", str(N_HOURS)))
        (cls.folder / "run.json.in").write_text('{"u": @u@, "leaks": @leaks@}')
        (cls.folder / "job.toml").write_text(JOB)
        cls.write_readings()
        cls.result = cls.run_job("one.h5")

    @classmethod
    def write_readings(cls):
        """Of the house as it stands: other values, and air that follows the wind."""
        with gzip.open(cls.folder / WEATHER, "rt") as file:
            wind = [float(line.split(",")[21]) for line in file.readlines()[8:8 + N_HOURS]]
        truth = cls.folder / "truth"
        truth.mkdir()
        (truth / WEATHER).symlink_to(cls.folder / WEATHER)
        (truth / "run.json").write_text('{"u": 1.25, "leaks": 0.3}')
        (truth / "effects.toml").write_text('[[effect]]\nhook = "infiltration"\n')
        (truth / "effects.csv").write_text("effect_1\n" + "".join(f"{BY_WIND * speed}\n" for speed in wind))
        subprocess.run(["/usr/bin/python3", cls.folder / "house.py"], cwd=truth, check=True)
        gas = np.loadtxt(truth / "hours.csv", skiprows=1)
        gas = np.maximum(gas + 0.03 * gas.mean() * np.random.default_rng(3).standard_normal(gas.size), 0)
        begin = np.datetime64("2021-01-01T00:00")
        (cls.folder / "measured.csv").write_text("time,gas\n" + "".join(
            f"{str(begin + np.timedelta64(k, 'h')).replace('T', ' ')},{value:.4f}\n" for k, value in enumerate(gas)))

    @classmethod
    def run_job(cls, name, *words, ranks=1, codes=(0,)):
        launch = ["mpirun", "-np", str(ranks), "--oversubscribe", "--bind-to", "none"] if ranks > 1 else []
        done = subprocess.run([*launch, PROGRAM, "run", "job.toml", "-o", name, *words], cwd=cls.folder,
                              env=ENVIRONMENT, capture_output=True, text=True)
        assert done.returncode in codes, f"exit code {done.returncode}: {done.stderr}{done.stdout[-2000:]}"
        return cls.folder / name

    def texts(self, name):
        with h5py.File(self.result) as file:
            return [text.decode() for text in file[f"job/loop/{name}"][:]]

    def hash_of(self, result):
        done = subprocess.run([PROGRAM, "status", result], capture_output=True, text=True, check=True)
        return next(line for line in done.stdout.splitlines() if "result hash" in line)

    def test_the_effect_is_found_and_the_program_runs_with_it(self):
        self.assertEqual(self.texts("effect"), ["wind infiltration"])
        self.assertEqual(self.texts("simulator_given_hooks"), ["infiltration"])
        with h5py.File(self.result) as file:
            loop = file["job/loop"]
            before, after = loop["fit"][1:3, :, 0, 0, list(self.texts("metric")).index("cv_rmse")]
            coefficient = loop["effect_coefficient"][0]
        self.assertAlmostEqual(coefficient, BY_WIND, delta=0.01)
        self.assertLess(after[0], 0.75 * before[0])
        self.assertLess(after[1], before[1])     # the month that was held out, mostly noise

    def test_runs_that_fail_are_told(self):
        failures = [text for text in self.texts("simulator_run_failure") if text]
        self.assertGreater(len(failures), 0)
        self.assertTrue(all("the solver gave up" in text for text in failures), failures)

    def test_ranks_and_a_stop_change_no_bit(self):
        whole = self.hash_of(self.result)
        for ranks in (2, 3):
            self.assertEqual(self.hash_of(self.run_job(f"ranks-{ranks}.h5", ranks=ranks)), whole)
        stopped = self.run_job("stopped.h5", "--stop-after", "0.03", codes=(STOPPED,))
        self.assertFalse(stopped.exists())
        self.assertEqual(self.hash_of(self.run_job("stopped.h5", "--resume")), whole)


if __name__ == "__main__":
    unittest.main()
