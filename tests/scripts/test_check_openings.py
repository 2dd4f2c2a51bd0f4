#!/usr/bin/python3
"""scripts/dev/check_openings finds sources without an opening, and nothing in sound trees."""
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "dev" / "check_openings"


def check(files):
    """(exit code, messages) over a tree {path: text}."""
    with tempfile.TemporaryDirectory() as folder:
        for path, text in files.items():
            file = pathlib.Path(folder, path)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
        run = subprocess.run([PROGRAM, folder], capture_output=True, text=True)
        return run.returncode, run.stderr


class CheckOpenings(unittest.TestCase):
    def test_sources_with_two_lines_and_headers_with_one_pass(self):
        self.assertEqual(check({"a/b.cpp": "/// Idea.\n/// Limits.\nint x;\n", "a/b.hpp": "/// Idea.\n"}), (0, ""))

    def test_a_source_that_opens_with_an_include_fails(self):
        code, text = check({"a/b.cpp": '#include "a/b.hpp"\n'})
        self.assertEqual(code, 1)
        self.assertIn("a/b.cpp:1: opens without a comment", text)

    def test_a_source_with_one_line_fails(self):
        self.assertIn("a/b.inl:1: opens with one line", check({"a/b.inl": "/// Idea.\nint x;\n"})[1])

    def test_a_source_with_a_page_of_comment_fails(self):
        self.assertIn("opens with 15 lines, at most 14", check({"a/b.cpp": "/// More.\n" * 15 + "int x;\n"})[1])

    def test_a_header_without_comment_fails(self):
        self.assertIn("a/b.hpp:1: opens without", check({"a/b.hpp": "#pragma once\n"})[1])

    def test_a_folder_without_sources_fails(self):
        self.assertEqual(check({"a/b.txt": "x"})[0], 1)


if __name__ == "__main__":
    unittest.main()
