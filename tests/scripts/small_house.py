"""A small program of a house, with a job around it that a test completes by its study."""
import gzip
import json
import os
import pathlib
import subprocess
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
TRUTH = {"u": 1.25, "leaks": 0.3}
STOPPED = 75
PERIODS = "period,first,last\ntraining,2021-01-01,2021-03-31\nheld_out,2021-04-01,2021-04-30\n"

HOUSE = '''
"""A house of one temperature: heat by transmission and air, less gains, by a boiler."""
import csv, datetime, gzip, json, os, sys
values = json.load(open("run.json"))
with gzip.open("weather_2021.epw.gz", "rt") as file:
    year = [line.split(",") for line in file.readlines()[8:]]
rows, day = [], datetime.date.fromisoformat
for period in csv.DictReader(open("periods.csv")):
    first, last = (24 * (day(period[key]) - day("2021-01-01")).days for key in ("first", "last"))
    rows += year[first:last + 24]
air = [0.0] * len(rows)
if os.path.exists("effects.csv"):
    sections = open("effects.toml").read()
    if 'hook = "infiltration"' in sections:
        air = [float(row["effect_1"]) for row in csv.DictReader(open("effects.csv"))]
        assert len(air) == len(rows)
    else:
        open("effects_left_out.txt", "w").write("only air is known\\n")
if os.path.exists("air.dat"):
    air = [float(line) for line in open("air.dat")]
    assert len(air) == len(rows)
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
files = ["house.py", "weather_2021.epw.gz", "periods.csv"]
periods = "periods.csv"

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

STUDY
[output]
file = "house.h5"
max_failed_share = 0.5
"""


class SmallHouse(unittest.TestCase):
    """Makes readings and runs the job. A test class has `STUDY`, a [[study]], and may have air that follows wind."""
    STUDY = ""
    NAME = ""                     # of the study that is looked at; "" = the only one
    JOB = JOB
    BY_WIND = 0.0                 # 1/h per m/s: what no description has
    PROGRAM_TEXT = HOUSE
    TEMPLATES = {"run.json.in": '{"u": @u@, "leaks": @leaks@}'}   # the first one is the job's
    SIMULATOR = ""                # sections of the job beside those that all have

    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        (cls.folder / WEATHER).write_bytes((ROOT / "jobs" / "energyplus_office" / WEATHER).read_bytes())
        (cls.folder / "house.py").write_text(cls.PROGRAM_TEXT)
        (cls.folder / "periods.csv").write_text(PERIODS)
        for name, text in cls.TEMPLATES.items():
            (cls.folder / name).write_text(text)
        (cls.folder / "job.toml").write_text(cls.JOB.replace("STUDY", cls.SIMULATOR + cls.STUDY))
        cls.write_readings()
        cls.result = cls.run_job("one.h5")

    @classmethod
    def write_readings(cls):
        """Of the house as it stands: other values, and air that follows the wind."""
        with gzip.open(cls.folder / WEATHER, "rt") as file:
            wind = [float(line.split(",")[21]) for line in file.readlines()[8:8 + N_HOURS]]
        gas = cls.gas_of(TRUTH, PERIODS, [cls.BY_WIND * speed for speed in wind])
        gas = np.maximum(gas + 0.03 * gas.mean() * np.random.default_rng(3).standard_normal(gas.size), 0)
        begin = np.datetime64("2021-01-01T00:00")
        (cls.folder / "measured.csv").write_text("time,gas\n" + "".join(
            f"{str(begin + np.timedelta64(k, 'h')).replace('T', ' ')},{value:.4f}\n" for k, value in enumerate(gas)))

    @classmethod
    def gas_of(cls, values, periods, air=()):
        """By a run of the program made by hand, each hour [kWh]. `air`: more of it each hour [1/h]."""
        with tempfile.TemporaryDirectory(dir=cls.folder) as name:
            folder = pathlib.Path(name)
            (folder / WEATHER).symlink_to(cls.folder / WEATHER)
            (folder / "periods.csv").write_text(periods)
            (folder / "run.json").write_text(json.dumps(values))
            if len(air):
                (folder / "effects.toml").write_text('[[effect]]\nhook = "infiltration"\n')
                (folder / "effects.csv").write_text("effect_1\n" + "".join(f"{each}\n" for each in air))
            subprocess.run(["/usr/bin/python3", cls.folder / "house.py"], cwd=folder, check=True)
            return np.loadtxt(folder / "hours.csv", skiprows=1)

    @classmethod
    def run_job(cls, name, *words, ranks=1, codes=(0,)):
        launch = ["mpirun", "-np", str(ranks), "--oversubscribe", "--bind-to", "none"] if ranks > 1 else []
        done = subprocess.run([*launch, PROGRAM, "run", "job.toml", "-o", name, *words], cwd=cls.folder,
                              env=ENVIRONMENT, capture_output=True, text=True)
        assert done.returncode in codes, f"exit code {done.returncode}: {done.stderr}{done.stdout[-2000:]}"
        return cls.folder / name

    def stored(self):
        """The job's study, open."""
        file = h5py.File(self.result)
        self.addCleanup(file.close)
        if self.NAME:
            return file["job"][self.NAME]
        (study,) = (group for name, group in file["job"].items() if name != "data")
        return study

    def texts(self, name):
        return [text.decode() for text in self.stored()[name][:]]

    def hash_of(self, result):
        done = subprocess.run([PROGRAM, "status", result], capture_output=True, text=True, check=True)
        return next(line for line in done.stdout.splitlines() if "result hash" in line)

    def check_failures_are_told(self):
        failures = [text for text in self.texts("simulator_run_failure") if text]
        self.assertGreater(len(failures), 0)
        self.assertTrue(all("the solver gave up" in text for text in failures), failures)

    def check_same_bits(self, stop_after):
        """On ranks 2 and 3, and when a run is stopped after so many minutes and goes on."""
        whole = self.hash_of(self.result)
        for ranks in (2, 3):
            self.assertEqual(self.hash_of(self.run_job(f"ranks-{ranks}.h5", ranks=ranks)), whole)
        stopped = self.run_job("stopped.h5", "--stop-after", str(stop_after), codes=(STOPPED,))
        self.assertFalse(stopped.exists())
        self.assertEqual(self.hash_of(self.run_job("stopped.h5", "--resume")), whole)
