#!/usr/bin/python3
"""The bench of numbers that decide: which it changes, how, and what it takes for a decision."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bench"))

import bench_decisions  # noqa: E402

HEADER = """#pragma once

namespace bemcal::loop::decisions {
inline constexpr double least_gain = 2;
inline constexpr std::size_t most_refitted = 36;
inline constexpr std::array sizes = {1.0, -0.25};
}  // namespace bemcal::loop::decisions
"""
PROGRAM = """#include <array>
#include <cstdio>
#include "header.hpp"
int main() {
    using namespace bemcal::loop::decisions;
    std::printf("%g %zu %g %g", least_gain, most_refitted, sizes[0], sizes[1]);
}
"""


class Numbers(unittest.TestCase):
    def test_all_of_the_headers_are_changed(self):
        for folder in bench_decisions.FOLDERS:
            text = (ROOT / "src" / folder / "decisions.hpp").read_text()
            names = bench_decisions.numbers_of(folder)
            made = bench_decisions.changeable(text, folder)
            self.assertEqual(len({name.partition("[")[0] for name in names}) + made.count("inline constexpr"),
                             text.count("inline constexpr"))
            self.assertLessEqual(made.count("inline constexpr"), len(bench_decisions.LENGTHS))
            self.assertEqual(made.count("changed_number<") + made.count("changed_number("), len(names))

    # A quarter more or less; a whole number by one at least; all others as they are.
    def test_a_program_has_another_number_where_it_is_told_so(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "base").mkdir()
            (folder / "base" / "changed_number.hpp").write_text(bench_decisions.CHANGED)
            (folder / "header.hpp").write_text(bench_decisions.changeable(HEADER, "loop"))
            (folder / "main.cpp").write_text(PROGRAM)
            subprocess.run(["c++", "-std=c++20", f"-I{folder}", folder / "main.cpp", "-o", folder / "main"], check=True)
            for said, printed in ((None, "2 36 1 -0.25"), ("loop.least_gain 1.25", "2.5 36 1 -0.25"),
                                  ("loop.most_refitted 0.75", "2 27 1 -0.25"),
                                  ("loop.most_refitted 1.001", "2 37 1 -0.25"), ("loop.sizes[1] 2", "2 36 1 -0.5")):
                done = subprocess.run([folder / "main"], env={"BEMCAL_NUMBER": said} if said else {},
                                      capture_output=True, text=True, check=True)
                self.assertEqual(done.stdout, printed)

    def test_constants_that_follow_one_are_read_later(self):
        text = "constexpr double least = 2 * least_gain;\nconstexpr int day = 24;\n"
        self.assertEqual(bench_decisions.with_later_constants(text),
                         "const double least = 2 * least_gain;\nconstexpr int day = 24;\n")


class Decisions(unittest.TestCase):
    def test_what_changes_is_counted_over_what_there_is_in_either(self):
        self.assertEqual(bench_decisions.share_changed({1, 2, 3}, {1, 2, 3}), 0)
        self.assertEqual(bench_decisions.share_changed({1, 2, 3}, {1, 2, 4}), 0.5)
        self.assertEqual(bench_decisions.share_changed(set(), set()), 0)

    def test_a_case_is_cut_to_its_first_weeks(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "case.toml"
            path.write_text('[periods]\ntraining = ["2021-01-01", "2021-12-31"]\n'
                            'held_out = ["2022-01-01", "2022-12-31"]\n')
            bench_decisions.cut(path, 2)
            self.assertEqual(path.read_text(), '[periods]\ntraining = ["2021-01-01", "2021-01-14"]\n'
                                               'held_out = ["2022-01-01", "2022-01-14"]\n')


if __name__ == "__main__":
    unittest.main()
