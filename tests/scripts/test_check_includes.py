#!/usr/bin/python3
"""scripts/dev/check_includes finds each kind of broken rule, and nothing in sound trees."""
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "dev" / "check_includes"


def run_over(files, known, *options):
    """The program over a tree {path: [included headers]} with a list of known circles."""
    with tempfile.TemporaryDirectory() as folder:
        for path, headers in files.items():
            file = pathlib.Path(folder, "src", path)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text("".join(f'#include "{header}"\n' for header in headers))
        pathlib.Path(folder, "src").mkdir(exist_ok=True)
        pathlib.Path(folder, "known").write_text(known)
        return subprocess.run([PROGRAM, *options, f"{folder}/src", f"{folder}/known"],
                              capture_output=True, text=True)


def check(files, known=""):
    """Returns (exit code, messages)."""
    run = run_over(files, known)
    return run.returncode, run.stderr


# The header of b includes that of a, whose source includes b: no file includes itself.
CIRCLE = {"base/a.hpp": [], "base/a.cpp": ["base/a.hpp", "base/b.hpp"], "base/b.hpp": ["base/a.hpp"]}


class CheckIncludes(unittest.TestCase):
    def assert_fails(self, files, message, known=""):
        code, text = check(files, known)
        self.assertEqual(code, 1, text)
        self.assertIn(message, text)

    def test_downward_and_sideways_includes_pass(self):
        code, text = check({
            "base/a.hpp": [], "base/b.hpp": ["base/a.hpp"], "run/r.hpp": ["base/b.hpp"],
            "run/comm.cpp": ["mpi.h", "run/r.hpp"], "main.cpp": ["run/r.hpp", "CLI/CLI.hpp"]})
        self.assertEqual((code, text), (0, ""))

    def test_an_upward_include_fails(self):
        self.assert_fails({"base/a.hpp": ["run/r.hpp"], "run/r.hpp": []},
                          "base/a.hpp:1: includes run/r.hpp, which is above base")

    def test_an_upward_include_by_a_relative_path_fails(self):
        self.assert_fails({"base/a.hpp": ["../run/r.hpp"], "run/r.hpp": []}, "above base")

    def test_a_file_cycle_inside_a_folder_fails(self):
        self.assert_fails({"base/a.hpp": ["base/b.hpp"], "base/b.hpp": ["base/a.hpp"]},
                          "file cycle: base/a.hpp -> base/b.hpp -> base/a.hpp")

    def test_a_folder_cycle_without_a_file_cycle_fails(self):
        self.assert_fails({"base/a.hpp": ["run/r.hpp"], "run/r.hpp": [],
                           "run/s.hpp": ["base/b.hpp"], "base/b.hpp": []},
                          "folder cycle: base -> run -> base")

    def test_a_circle_of_units_fails_and_says_where(self):
        self.assert_fails(CIRCLE, "circle of units: base/a base/b: "
                                  "base/a.cpp:2 includes base/b.hpp, base/b.hpp:1 includes base/a.hpp")

    def test_a_circle_of_three_units_is_one(self):
        files = {"base/a.hpp": ["base/b.hpp"], "base/b.hpp": ["base/c.hpp"], "base/c.hpp": [],
                 "base/c.cpp": ["base/a.hpp"], "base/d.hpp": ["base/a.hpp"]}
        self.assert_fails(files, "circle of units: base/a base/b base/c: ")

    def test_an_inl_is_a_unit_by_its_name(self):
        self.assert_fails({"kernel/a.cpp": ["kernel/body.inl"], "kernel/a.hpp": [],
                           "kernel/body.inl": ["kernel/a.hpp"]}, "circle of units: kernel/a kernel/body")

    def test_units_of_one_name_in_two_folders_are_two(self):
        self.assertEqual(check({"base/a.hpp": [], "physics/a.hpp": ["base/a.hpp"]}), (0, ""))

    def test_a_known_circle_passes(self):
        known = "# a comment: of no account\n\nbase/b base/a: they hold each other's numbers\n"
        self.assertEqual(check(CIRCLE, known), (0, ""))

    def test_a_known_circle_without_a_reason_fails(self):
        self.assert_fails(CIRCLE, "known circle: base/a base/b: has no reason", "base/a base/b\n")

    def test_a_known_circle_that_is_opened_must_leave_the_list(self):
        self.assert_fails({"base/a.hpp": []}, "known circle: base/a base/b: is there no longer",
                          "base/a base/b: once\n")

    def test_a_known_circle_does_not_excuse_a_larger_one(self):
        files = CIRCLE | {"base/c.hpp": ["base/a.hpp"], "base/b.cpp": ["base/c.hpp"]}
        self.assert_fails(files, "circle of units: base/a base/b base/c", "base/a base/b: known\n")

    def test_it_counts_circles_when_asked(self):
        run = run_over(CIRCLE | {"run/r.hpp": ["base/a.hpp"]}, "base/a base/b: known\n", "--count")
        self.assertEqual((run.returncode, run.stdout),
                         (0, "4 files, 0 circles; 2 folders, 0 circles; 3 units, 1 circles\n"))

    def test_the_checkout_has_no_circle_beside_the_known_ones(self):
        run = subprocess.run([PROGRAM], capture_output=True, text=True)
        self.assertEqual((run.returncode, run.stderr), (0, ""))

    def test_a_folder_outside_the_ladder_fails(self):
        self.assert_fails({"utils/a.hpp": []}, "folder 'utils' is not in the ladder")

    def test_two_types_of_one_name_in_a_folder_fail(self):
        with tempfile.TemporaryDirectory() as folder:
            study = pathlib.Path(folder, "study")
            study.mkdir()
            (study / "a.hpp").write_text("struct Unknown {\n};\nclass Later;\nstruct Unknown::Part {\n};\n")
            (study / "b.cpp").write_text("namespace {\nstruct Unknown {};\n}  // namespace\nclass Later {\n};\n")
            sound = subprocess.run([PROGRAM, folder], capture_output=True, text=True)
            (study / "c.hpp").write_text("class Unknown : public Later {\n};\n")
            broken = subprocess.run([PROGRAM, folder], capture_output=True, text=True)
        self.assertEqual((sound.returncode, sound.stderr), (0, ""))
        self.assertEqual(broken.returncode, 1)
        self.assertIn("study/c.hpp:1: the type Unknown is another one in study/a.hpp:1", broken.stderr)

    def test_a_library_outside_its_file_fails(self):
        for header, file in (("mpi.h", "run/other.cpp"), ("hdf5.h", "store/layout.cpp"),
                             ("hdf5_hl.h", "store/layout.cpp"), ("toml++/toml.h", "main.cpp"),
                             ("CLI/CLI.hpp", "job/job.cpp"), ("boost/math/a.hpp", "base/a.cpp")):
            self.assert_fails({file: [header]}, f"{file}:1: includes")

    def test_toml_in_two_files_of_job_fails(self):
        self.assert_fails({"job/a.cpp": ["toml++/toml.h"], "job/b.cpp": ["toml++/toml.h"]},
                          "more than one file")

    def test_file_access_in_a_pure_folder_fails(self):
        self.assert_fails({"stats/a.cpp": ["fstream"]}, "stats knows no files")

    def test_an_empty_tree_fails(self):
        self.assert_fails({}, "no source files")


if __name__ == "__main__":
    unittest.main()
