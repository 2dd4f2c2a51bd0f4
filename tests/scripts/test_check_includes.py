#!/usr/bin/python3
"""scripts/dev/check_includes finds each kind of broken rule, and nothing in sound trees."""
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "dev" / "check_includes"


def check(files):
    """Runs the check over a tree {path: [included headers]}; returns (exit code, messages)."""
    with tempfile.TemporaryDirectory() as folder:
        for path, headers in files.items():
            file = pathlib.Path(folder, path)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text("".join(f'#include "{header}"\n' for header in headers))
        run = subprocess.run([PROGRAM, folder], capture_output=True, text=True)
        return run.returncode, run.stderr


class CheckIncludes(unittest.TestCase):
    def assert_fails(self, files, message):
        code, text = check(files)
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
