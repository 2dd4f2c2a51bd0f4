#!/usr/bin/python3
"""A made stock, night after night: broken buildings are failed items with reasons, the same hash on 1, 2
and 3 ranks and after a kill, and a second night does what has changed and nothing else."""
import csv
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import h5py

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "generator"))

import stock as made  # noqa: E402

PROGRAM = os.environ["BEMCAL_PROGRAM"]
BUILDINGS, STATIONS, POINTS = 60, 3, 32
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMP_WAIT_POLICY": "passive", "OMP_NUM_THREADS": "1"}


def command(ranks, *words):
    launch = ["mpirun", "-np", str(ranks), "--oversubscribe", "--bind-to", "none"] if ranks > 1 else []
    return [*launch, PROGRAM, *map(str, words)]


def texts(result, name):
    with h5py.File(result) as file:
        return [text.decode() for text in file[f"stock/{name}"][:]]


def hash_of(result):
    out = subprocess.run(command(1, "status", result), capture_output=True, text=True, check=True).stdout
    return re.search(r"result hash (\w+)", out).group(1)


class Nights(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.holder.name)
        cls.stock = made.make(cls.folder, BUILDINGS, STATIONS, seed=3, broken_share=10 / BUILDINGS)
        cls.job = cls.folder / "made.toml"
        cls.job.write_text(made.job_text(POINTS) + "[output]\nmax_failed_share = 0.5\n")
        cls.first = cls.run_night("night-1.h5")

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    @classmethod
    def run_night(cls, name, *words, ranks=1, code=0):
        result = cls.folder / name
        done = subprocess.run(command(ranks, "run", cls.job, "-o", result, *words), env=ENVIRONMENT,
                              capture_output=True, text=True, cwd=cls.folder)
        assert done.returncode == code, f"exit code {done.returncode}: {done.stderr}"
        return result

    def test_a_broken_building_is_a_failed_item_with_its_reason(self):
        status, reasons = texts(self.first, "stock_status"), texts(self.first, "stock_reason")
        said = ["cannot be opened", "cut off", "is empty", "has no column", "is not a number", "floor_area",
                "nowhere.csv", "Error while parsing", "another line has the name", "has no reading"]
        self.assertEqual(set(self.stock.broken.values()), set(range(len(made.WAYS))))
        for k, way in self.stock.broken.items():
            self.assertEqual(status[k], "failed", made.WAYS[way])
            self.assertIn(said[way], reasons[k], made.WAYS[way])
        for k in set(range(BUILDINGS)) - set(self.stock.broken):
            self.assertEqual((status[k], reasons[k]), ("calibrated", ""))

    def test_the_hash_is_the_same_on_any_ranks_and_after_a_kill(self):
        expected = hash_of(self.first)
        for ranks in (2, 3):
            self.assertEqual(hash_of(self.run_night(f"ranks-{ranks}.h5", ranks=ranks)), expected)
        result = self.folder / "killed.h5"
        run = subprocess.Popen(command(1, "run", self.job, "-o", result), env=ENVIRONMENT, cwd=self.folder,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        log = pathlib.Path(f"{result}.part/rank-0.log")
        while run.poll() is None and (not log.exists() or log.stat().st_size < 20000):
            time.sleep(0.002)
        run.send_signal(signal.SIGKILL)
        run.wait()
        self.assertFalse(result.exists())
        self.run_night("killed.h5", "--resume", ranks=2)
        self.assertEqual(hash_of(result), expected)

    def test_a_building_does_not_depend_on_the_others(self):
        lines = (self.folder / "buildings.csv").read_text().split("\n")
        keep = next(k for k in range(5, BUILDINGS) if not {k, k + 1} & set(self.stock.broken))
        (self.folder / "one.csv").write_text(f"{lines[0]}\n{lines[keep + 1]}\n")
        job = self.folder / "one.toml"
        job.write_text(self.job.read_text().replace("buildings.csv", "one.csv"))
        subprocess.run(command(1, "run", job, "-o", self.folder / "one.h5"), env=ENVIRONMENT, check=True,
                       capture_output=True)
        with h5py.File(self.first) as all_of, h5py.File(self.folder / "one.h5") as one:
            mine = all_of["stock/stock_values_of"][:] == keep
            self.assertEqual(list(all_of["stock/stock_value"][:][mine]), list(one["stock/stock_value"][:]))

    def test_the_table_and_the_history_have_a_line_for_each_building(self):
        with open(self.folder / "night-1.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), BUILDINGS)
        self.assertEqual(sum(row["status"] == "failed" for row in rows), len(self.stock.broken))
        with open(self.folder / "made-history.csv", newline="", encoding="utf-8") as file:
            nights = [row["night"] for row in csv.DictReader(file)]
        self.assertEqual(nights.count("night-1"), BUILDINGS)

    def test_the_page_stands_alone_and_names_the_failed(self):
        page = (self.folder / "night-1.html").read_text(encoding="utf-8")
        self.assertNotRegex(page, r"(src|href)=\"(?!data:)")
        for k, way in self.stock.broken.items():
            if way != 8:
                self.assertIn(self.stock.lines[k]["name"], page)


class ChangedSince(unittest.TestCase):
    def test_a_building_whose_file_has_changed_is_done_again_by_resume(self):
        with tempfile.TemporaryDirectory() as holder:
            folder = pathlib.Path(holder)
            stock = made.make(folder, 12, 2, seed=6, broken_share=0)
            job, result, whole = folder / "made.toml", folder / "stopped.h5", folder / "whole.h5"
            job.write_text(made.job_text(POINTS))
            run = lambda *words: subprocess.run(command(1, "run", job, "--no-report", "-o", *words), env=ENVIRONMENT,
                                                capture_output=True, text=True)
            # With a failed building the log stays; without the result the run is one that was killed at its end.
            last = folder / stock.lines[-1]["meter"]
            readings = last.read_bytes()
            last.write_bytes(b"")
            job.write_text(job.read_text() + "[output]\nmax_failed_share = 0.5\n")
            self.assertEqual(run(result).returncode, 0)
            result.unlink()
            template = folder / "building.toml"
            template.write_text(made.BUILDING + "# another\n")
            refused = run(result, "--resume")
            self.assertNotEqual(refused.returncode, 0)
            self.assertIn("building.toml has changed since", refused.stderr)
            template.write_text(made.BUILDING)

            last.write_bytes(readings)
            (changed,) = made.change(stock, 1 / 12)
            again = run(result, "--resume")
            self.assertEqual(again.returncode, 0, again.stderr)
            for k in (changed, 11):
                line = stock.lines[k]
                self.assertIn(f"doing again: {line['name']}: {line['meter']} has changed since", again.stderr)
            self.assertEqual(again.stderr.count("doing again: "), len({changed, 11}))
            self.assertEqual(run(whole).returncode, 0)
            self.assertEqual(hash_of(result), hash_of(whole))


class SecondNight(unittest.TestCase):
    def test_only_what_has_changed_is_done_again_from_where_it_was(self):
        with tempfile.TemporaryDirectory() as holder:
            folder = pathlib.Path(holder)
            stock = made.make(folder, 20, 2, seed=4, broken_share=0.1)
            job = folder / "made.toml"
            job.write_text(made.job_text(POINTS) + "[output]\nmax_failed_share = 0.5\n")
            run = lambda *words: subprocess.run(command(1, "run", job, "--no-report", *words), env=ENVIRONMENT,
                                                check=True, capture_output=True)
            first, second, third = (folder / f"night-{k}.h5" for k in (1, 2, 3))
            run("-o", first)
            changed = made.change(stock, 0.1)
            run("-o", second, "--after", first)
            status, cause = texts(second, "stock_status"), texts(second, "stock_cause")
            for k in range(20):
                if k in changed:
                    self.assertEqual(status[k], "calibrated")
                    self.assertEqual(cause[k], "data: " + stock.lines[k]["meter"])
                else:
                    self.assertEqual(status[k], "failed" if k in stock.broken else "unchanged")
                    self.assertEqual(cause[k], "")
            with h5py.File(first) as one, h5py.File(second) as two:
                of, value = one["stock/stock_values_of"][:], one["stock/stock_value"][:]
                again = two["stock/stock_values_of"][:], two["stock/stock_value"][:]
                for k in set(range(20)) - set(changed):
                    self.assertEqual(list(value[of == k]), list(again[1][again[0] == k]))
            # What starts from the night before is not worse than that on the same data.
            with h5py.File(second) as two:
                for k, before, after in zip(two["stock/stock_fits_of"][:], two["stock/stock_fit_before"][:],
                                            two["stock/stock_fit_cv_rmse"][:]):
                    if k in changed:
                        self.assertLessEqual(after, before)
            # A budget of one building: the others wait, then come first.
            made.change(stock, 0.15, seed=5)
            text = job.read_text()
            job.write_text(text.replace("[stock]", "[stock]\nbudget = 1"))
            run("-o", third, "--after", second)
            status = texts(third, "stock_status")
            self.assertEqual(status.count("calibrated") + (texts(third, "stock_cause")[
                min(stock.broken)] != "" and status[min(stock.broken)] == "failed"), 1)
            self.assertGreater(status.count("postponed"), 10)


if __name__ == "__main__":
    unittest.main()
