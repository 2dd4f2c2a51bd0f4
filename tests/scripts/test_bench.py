#!/usr/bin/python3
"""scripts/bench takes result lines, and only those, from what a bench prints."""
import importlib.machinery
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "bench"
bench = importlib.machinery.SourceFileLoader("bench", str(PROGRAM)).load_module()


class ResultLines(unittest.TestCase):
    def test_a_line_with_reference_and_ratio(self):
        self.assertEqual(
            bench.result_of("instructions_per_hour 7.25 1/h 34.0 4.69\n"),
            {"name": "instructions_per_hour", "value": 7.25, "unit": "1/h", "reference": 34.0,
             "ratio": 4.69})

    def test_a_dash_stands_for_nothing(self):
        result = bench.result_of("rate 4.1e5 1/s - -")
        self.assertIsNone(result["reference"])
        self.assertIsNone(result["ratio"])

    def test_other_lines_are_no_results(self):
        for line in ("", "five words are not enough", "name value unit reference ratio",
                     "rate 4.1e5 1/s 3 x", "rate 4.1e5 1/s - - and more"):
            self.assertIsNone(bench.result_of(line), line)


class Benches(unittest.TestCase):
    def test_one_may_be_a_program_and_a_script(self):
        commands = [[str(word) for word in command] for command in bench.benches()["shared_meters"]]
        self.assertEqual(len(commands), 2)
        self.assertTrue(commands[0][0].endswith("/bench_shared_meters"))
        self.assertTrue(commands[1][1].endswith("/bench_shared_meters.py"))

    def test_most_are_one(self):
        self.assertEqual(len(bench.benches()["stock"]), 1)


if __name__ == "__main__":
    unittest.main()
