#!/usr/bin/python3
"""Scripts that open a result on which HDF5 comes to no end: each is stopped soon, says so with the file's name, and
ends with the code of damaged data. What they make of a result afterwards may take as long as it likes."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import h5py

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests" / "scripts")]

import fake_loop_result  # noqa: E402
from report import guard, result  # noqa: E402
from test_run_case import write_case  # noqa: E402

# Python runs this before a script. A file that is opened to be read is one without an end.
ENDLESS = """
import h5py
class Endless(h5py.File):
    def __init__(self, *words, **more):
        while True:
            pass
h5py.File = Endless
"""
DATA = 65


def spin(_):
    while True:
        pass


def crash(_):
    os.write(2, b"what libc says of it")
    os.abort()


def seconds_of_others():
    """Of the processor, of all processes that we waited for."""
    return sum(os.times()[2:4])


class Scripts(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)
        self.result = self.folder / "made.h5"
        with h5py.File(self.result, "w") as file:
            file["a"] = 1.0

    def run_case_words(self):
        """The program leaves the result where run_case looks for it."""
        program = self.folder / "program"
        program.write_text(f"#!/bin/sh\n[ $1 = run ] || exit 0\ncp {self.result} $4\n")
        program.chmod(0o755)
        return ["run_case", write_case(self.folder / "a"), self.folder / "out", "--ranks", "1"]

    def test_a_file_without_an_end_is_refused_by_each(self):
        (self.folder / "sitecustomize.py").write_text(ENDLESS)
        environment = {**os.environ, "PYTHONPATH": str(self.folder), "BEMCAL_PROGRAM": str(self.folder / "program")}
        commands = (["stock_report", self.result, self.folder / "page.html"],
                    ["result_report", self.result, self.folder / "page.html"],
                    ["still_holds", self.result, self.result], ["change_point_baseline", self.result],
                    self.run_case_words())
        runs = [subprocess.Popen([ROOT / "scripts" / words[0], *words[1:]], env=environment, text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE) for words in commands]
        for words, run in zip(commands, runs):
            name = self.folder / "out" / "result.h5" if words[0] == "run_case" else self.result
            _, said = run.communicate(timeout=100)
            self.assertEqual(run.returncode, DATA, f"{words[0]}: {said}")
            self.assertIn(f"{words[0]}: {name}: damaged: HDF5 comes to no end with it", said)
            self.assertIn("run its job again, or take a copy", said)
            self.assertEqual(said.count("\n"), 1)

    @unittest.mock.patch.object(guard, "LEAST_SECONDS", 1)
    def test_the_limit_is_of_the_processor_and_grows_with_the_file(self):
        large = self.folder / "large.h5"
        with h5py.File(large, "w") as file:
            file["a"] = [0.0] * (int(guard.BYTES_A_SECOND) // 8)
        for path, seconds in ((self.result, 2), (large, 3)):  # the least, and what is begun of the size
            begin = seconds_of_others()
            with self.assertRaisesRegex(guard.Refused, f"was stopped after {seconds} s") as raised:
                guard.read_apart(path, spin)
            self.assertAlmostEqual(seconds_of_others() - begin, seconds, delta=0.5)
            self.assertEqual(raised.exception.code, DATA)

    def test_a_crash_is_refused_without_other_words_and_what_we_do_is_not_limited(self):
        with open(self.folder / "said", "wb") as said:
            before = os.dup(2)
            os.dup2(said.fileno(), 2)
            with self.assertRaisesRegex(guard.Refused, "HDF5 cannot read it: Aborted"):
                guard.read_apart(self.result, crash)
            os.dup2(before, 2)
        self.assertEqual((self.folder / "said").read_bytes(), b"")
        limits = guard.resource.getrlimit(guard.resource.RLIMIT_CPU)
        self.assertEqual(guard.read_apart(self.result, list), ["a"])
        self.assertEqual(guard.resource.getrlimit(guard.resource.RLIMIT_CPU), limits)

    def test_a_mistake_of_ours_is_no_damage(self):
        with self.assertRaisesRegex(guard.Refused, "AssertionError") as raised:
            guard.read_apart(self.result, lambda _: self.fail("here"))
        self.assertEqual(raised.exception.code, guard.FAILED)

    def test_a_sound_result_takes_a_small_part_of_the_limit(self):
        loop = fake_loop_result.write(self.folder / "loop.h5")
        begin = seconds_of_others()
        result.read(loop)
        self.assertLess(seconds_of_others() - begin, guard.LEAST_SECONDS / 3)


if __name__ == "__main__":
    unittest.main()
