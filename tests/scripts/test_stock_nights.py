#!/usr/bin/python3
"""Nights of a stock of loops on made readings: what holds is only tested, what begins is told with its day, on any
ranks and after a stop alike."""
import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "generator"))

import stock as made  # noqa: E402

PROGRAM = os.environ["BEMCAL_PROGRAM"]
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMP_WAIT_POLICY": "passive", "OMP_NUM_THREADS": "1"}
BUILDINGS, CHANGED = 3, 1
KNOWN = "2022-10-31"        # last day that the first night's search learns from
BEGIN = 320                 # day of the year on which the second building's gas rises
JOB = """seed = 5
[stock]
false_alarms = 0.001
table = "nights.csv"
template = "building.toml"
[[study]]
kind = "loop"
most_effects = 0
try_structures = false
functions = false
generic = false
"""
STOPPED = 75


class NightsOfLoops(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.holder.name)
        cls.stock = made.make(cls.folder, BUILDINGS, 1, seed=3, broken_share=0)
        template = cls.folder / "building.toml"
        template.write_text(template.read_text().replace(
            'training = ["2022-01-01", "2022-12-31"]',
            f'training = ["2022-01-01", "{KNOWN}"]\nsince = ["2022-11-01", "@to@"]'))
        cls.raise_gas()
        (cls.folder / "job.toml").write_text(JOB)
        cls.first = cls.night("first.h5", "2022-11-07")
        cls.second = cls.night("second.h5", "2022-12-05", "--after", cls.first)

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    @classmethod
    def raise_gas(cls):
        """By as much as the building's mean, from one day on."""
        path = cls.folder / cls.stock.lines[CHANGED]["meter"]
        rows = [row.split(",") for row in made.gzip.decompress(path.read_bytes()).decode().split("\n")[1:-1]]
        values = np.array([float(value) for _, value in rows])
        values[24 * BEGIN:] += values.mean()
        made.write_readings(path, [time for time, _ in rows], np.round(values, 2))

    @classmethod
    def write_table(cls, last):
        rows = [",".join((*made.COLUMNS, "to"))]
        rows += [",".join([*(str(line[c]) for c in made.COLUMNS), last]) for line in cls.stock.lines]
        (cls.folder / "nights.csv").write_text("\n".join(rows) + "\n")

    @classmethod
    def night(cls, name, last, *words, ranks=1, codes=(0,)):
        cls.write_table(last)
        launch = ["mpirun", "-np", str(ranks), "--oversubscribe", "--bind-to", "none"] if ranks > 1 else []
        result = cls.folder / name
        done = subprocess.run([*launch, PROGRAM, "run", cls.folder / "job.toml", "-o", result, *words],
                              env=ENVIRONMENT, capture_output=True, text=True)
        assert done.returncode in codes, f"exit code {done.returncode}: {done.stderr}"
        return result

    def texts(self, result, name):
        with h5py.File(result) as file:
            return [text.decode() for text in file[f"stock/{name}"][:]]

    def test_what_holds_is_tested_and_not_sought_again(self):
        self.assertEqual(self.texts(self.first, "stock_status"), ["calibrated"] * BUILDINGS)
        with h5py.File(self.second) as file:
            searches = file["stock/stock_searches"][:]
        told = self.texts(self.second, "stock_told")
        for k in set(range(BUILDINGS)) - {CHANGED}:
            self.assertEqual((told[k], searches[k]), ("", 0))
            self.assertEqual(self.texts(self.second, "stock_status")[k], "tested")

    def test_what_begins_is_told_with_its_day(self):
        told = self.texts(self.second, "stock_told")[CHANGED]
        self.assertRegex(told, r"^new: gas: .* since 2022-11-\d\d")
        begin = np.datetime64("2022-01-01") + BEGIN
        with h5py.File(self.second) as file:
            days = file["stock/stock_change_day"][:]
        self.assertLessEqual(abs(np.datetime64(int(days[0]), "D") - begin) / np.timedelta64(1, "D"), 4)

    def test_changes_have_a_line_each_and_stand_on_the_page(self):
        with open(self.folder / "second-changes.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual((rows[0]["building"], rows[0]["change"]), (self.stock.lines[CHANGED]["name"], "new"))
        self.assertTrue(rows[0]["effect"].startswith("gas: "))
        self.assertIn("Changed, or found anew", (self.folder / "second.html").read_text(encoding="utf-8"))

    def test_a_night_is_the_same_on_any_ranks_and_after_a_stop(self):
        whole = self.hash_of(self.second)
        for ranks in (2, 3):
            other = self.night(f"ranks-{ranks}.h5", "2022-12-05", "--after", self.first, ranks=ranks)
            self.assertEqual(self.hash_of(other), whole)
        words = ("stopped.h5", "2022-12-05", "--after", self.first)
        stopped = self.night(*words, "--stop-after", "0.01", codes=(0, STOPPED))
        self.assertEqual(self.hash_of(self.night(*words, "--resume") if not stopped.exists() else stopped), whole)

    def hash_of(self, result):
        done = subprocess.run([PROGRAM, "status", result], capture_output=True, text=True, check=True)
        return next(line for line in done.stdout.splitlines() if "result hash" in line)


if __name__ == "__main__":
    unittest.main()
