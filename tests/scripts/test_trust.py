#!/usr/bin/python3
"""What a user can rely on: inputs and other files stay, damage and lost output have a code, names do nothing,
and what the machine refuses is never an answer."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bench"))

import bench_attacks  # noqa: E402

PROGRAM = os.environ["BEMCAL_PROGRAM"]


def run(*words, cwd, shell="", **options):
    """shell: redirections, as the shell writes them."""
    command = " ".join(["exec", PROGRAM, *map(str, words), shell])
    return subprocess.run(["bash", "-c", command], cwd=cwd, capture_output=True, check=False, **options)


class Trust(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        folder = pathlib.Path(cls.holder.name)
        (folder / "one").mkdir()
        (folder / "many").mkdir()
        cls.job = bench_attacks.screening(folder / "one")
        cls.stock = bench_attacks.stock(folder / "many")
        cls.folder = folder
        source, cls.failing = ROOT / "tests" / "support" / "failing.c", folder / "failing.so"
        subprocess.run(["cc", "-shared", "-fPIC", "-o", cls.failing, source, "-ldl"], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def setUp(self):
        place = tempfile.TemporaryDirectory(dir=self.folder)
        self.addCleanup(place.cleanup)
        self.place = pathlib.Path(place.name)

    def run_job(self, *words, code=0, job=None, **options):
        done = run("run", job or self.job, "--no-report", *words, cwd=self.place, **options)
        self.assertEqual(done.returncode, code, done.stderr.decode())
        return done

    def whole(self):
        self.run_job("-o", "a.h5")
        return run("status", "a.h5", cwd=self.place).stdout

    def test_a_table_that_is_the_job_is_kept(self):
        lines = (self.stock.parent / "buildings.csv").read_bytes()
        for file in self.stock.parent.glob("*"):
            if file.name != "buildings.csv":
                (self.place / file.name).symlink_to(file)
        (self.place / "made.toml").unlink()
        (self.place / "made.toml").write_text(self.stock.read_text())
        (self.place / "buildings.csv").write_bytes(lines)
        self.run_job("-o", "buildings.h5", job="made.toml")
        self.assertEqual((self.place / "buildings.csv").read_bytes(), lines)
        self.assertTrue((self.place / "buildings-table.csv").exists())
        refused = self.run_job("-o", "buildings.csv", "--force", job="made.toml", code=73)
        self.assertIn(b"is an input of this job", refused.stderr)
        self.assertEqual((self.place / "buildings.csv").read_bytes(), lines)

    def test_damage_has_a_code_everywhere(self):
        run("run", self.stock, "-o", "night.h5", "--no-report", cwd=self.place)
        with h5py.File(self.place / "night.h5", "r+") as file:
            file["stock/stock_value"][...] = 0.123
        self.assertEqual(run("status", "night.h5", cwd=self.place).returncode, 65)
        self.assertEqual(run("report", "night.h5", cwd=self.place).returncode, 65)
        before = sorted(self.place.iterdir())
        refused = self.run_job("-o", "next.h5", "--after", "night.h5", job=self.stock, code=65)
        self.assertIn(b"is damaged", refused.stderr)
        self.assertEqual(sorted(self.place.iterdir()), before)

    def test_a_reader_that_has_enough_needs_no_words(self):
        reader, writer = os.pipe()
        os.close(reader)
        done = subprocess.run([PROGRAM, "describe", "job"], stdout=writer, stderr=subprocess.PIPE, check=False)
        os.close(writer)
        self.assertEqual((done.returncode, done.stderr), (74, b""))

    def test_lost_output_is_a_code_and_the_result_is_whole(self):
        expected = self.whole()
        for number, shell in enumerate((">/dev/full", "2>/dev/full", ">/dev/full 2>/dev/full", "<&- >&- 2>&-", ">&-")):
            self.run_job("-o", f"b{number}.h5", code=74, shell=shell)
            status = run("status", f"b{number}.h5", cwd=self.place)
            self.assertEqual(status.returncode, 0)
            self.assertEqual(status.stdout.split(b"result hash")[1][:33], expected.split(b"result hash")[1][:33], shell)
        for words in (("report", "a.h5"), ("status", "a.h5"), ("check", self.job), ("describe", "job"), ("--help",)):
            for shell in (">/dev/full", ">&-"):
                self.assertEqual(run(*words, cwd=self.place, shell=shell).returncode, 74, words)

    def test_a_reader_that_goes_away_does_not_end_a_run(self):
        script = f"set -o pipefail; {PROGRAM} run {self.job} -o a.h5 --no-report 2>/dev/null | head -c 1 >/dev/null"
        done = subprocess.run(["bash", "-c", script], cwd=self.place, check=False)
        self.assertIn(done.returncode, (0, 74))
        self.assertEqual(run("status", "a.h5", cwd=self.place).returncode, 0)

    def test_names_do_nothing_on_the_terminal_and_in_a_table(self):
        lines = (self.stock.parent / "buildings.csv").read_text().splitlines()
        names = ("=cmd|calc!A1", "x\x1b[31m", "\u202egnp", "@SUM(A1)", "-1+1")
        rows = [name + line[line.index(","):] for name, line in zip(names, lines[1:])]
        (self.stock.parent / "named.csv").write_text("\n".join([lines[0], *rows]) + "\n")
        job = self.stock.parent / "named.toml"
        job.write_text(self.stock.read_text().replace("buildings.csv", "named.csv"))
        done = run("run", job, "-o", "n.h5", "--no-report", cwd=self.place)
        told = done.stdout + done.stderr + run("report", "n.h5", cwd=self.place).stdout
        for path in self.place.glob("*.csv"):
            told += path.read_bytes()
            for line in path.read_text().splitlines():
                for cell in line.split(","):
                    self.assertNotIn(cell.lstrip(" \"")[:1] if not cell[:2].lstrip("-").isdigit() else "", tuple("=+@"))
        self.assertNotIn(b"\x1b", told)
        self.assertNotIn("\u202e".encode(), told)
        self.assertIn(b"'=cmd|calc!A1", told)

    def test_long_names_get_a_message(self):
        for words in (("run", self.job, "-o", "n" * 300), ("status", "n" * 300), ("run", "n" * 300), ("check", "n" * 5000)):
            done = run(*words, cwd=self.place)
            self.assertIn(done.returncode, (66, 73), words)
            self.assertIn(b"too long", done.stderr.replace(b"cannot have a name of more", b"too long"))

    def test_no_temporary_name_follows_a_link(self):
        victim = self.place / "victim"
        victim.write_text("precious")
        for name in ("a.h5.writing", "a.h5.tmp", "a.csv.tmp", "a-changes.csv.tmp", "made-history.csv.tmp"):
            (self.place / name).symlink_to("victim")
        self.run_job("-o", "a.h5", job=self.stock)
        self.assertEqual(victim.read_text(), "precious")
        (self.place / "b.h5.part").symlink_to(self.place)
        self.run_job("-o", "b.h5", code=73)

    def test_what_the_machine_refuses_is_never_an_answer(self):
        expected = self.whole()
        for megabytes in (46, 50, 54, 58, 62, 66, 70, 80):
            done = subprocess.run(["prlimit", f"--as={megabytes}000000", PROGRAM, "run", self.job, "-o", "b.h5",
                                   "--no-report", "--force"], cwd=self.place, capture_output=True, check=False)
            self.assertIn(done.returncode, (0, 71, 74, 127), (megabytes, done.stderr))
            self.run_job("-o", "b.h5", "--resume")
            now = run("status", "b.h5", cwd=self.place).stdout
            self.assertEqual(now.split(b"result hash")[1][:33], expected.split(b"result hash")[1][:33])

    def test_a_disk_without_locks_is_said(self):
        done = self.run_job("-o", "a.h5", env={**os.environ, "LD_PRELOAD": str(self.failing), "FAIL_LOCKS": "1"})
        self.assertIn(b"keeps no locks", done.stderr)

    def test_a_second_run_is_refused_by_the_lock(self):
        (self.place / "a.h5.part").mkdir()
        with subprocess.Popen(["flock", self.place / "a.h5.part" / "lock", "sleep", "20"]) as holder:
            while not (self.place / "a.h5.part" / "lock").exists():
                pass
            refused = self.run_job("-o", "a.h5", code=73)
            holder.kill()
        self.assertIn(b"another run is writing there now", refused.stderr)


if __name__ == "__main__":
    unittest.main()
