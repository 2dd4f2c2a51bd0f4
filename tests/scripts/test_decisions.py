#!/usr/bin/python3
"""The table 'Numbers that decide' of src/loop/README.md says what the headers `decisions.hpp` say.

Names and values agree, each number is used by its name, each test that a row names is there, and no number that decides
stands elsewhere. Whether a test stands at the number's edge is for a reviewer to judge.
"""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ["functions", "effects", "loop"]
CONSTANT = re.compile(r"constexpr\s+(?:double|int|long|std::size_t|std::array)\s+(\w+\s*=[^;]+);")

# Constants that decide nothing: of nature, of the calendar, of a calculation; places in a list.
ELSEWHERE = {"stefan_boltzmann", "kelvin", "year_h", "elapsed_year_s", "days_of_year", "seconds_of_year",
             "hours_of_day", "fortnights_of_year", "day_classes", "kinds_of_day", "n_hours", "n_months", "day",
             "day_end", "n_week", "n_year", "least_change", "moved_by", "small_amplitude", "most_together", "hours_at_once"}
# Keys of the job, whose defaults are written where they are read.
KEYS = {"most_effects": "most_effects", "block_days": "block_days", "least_gain": "least_gain",
        "most_loss": "most_loss", "alpha": "alpha", "runs": "simulator_runs"}


def numbers_in(text):
    """[value, ...] of "{1.0, -1.0}" or "36"; an error where it is no number."""
    return [float(word) for word in text.strip(" {}").split(",")]


def of_header(text):
    """{name: values}"""
    pairs = (constant.split("=") for constant in CONSTANT.findall(text))
    return {name.strip(): numbers_in(value) for name, value in pairs}


def of_table(text):
    """{folder: {name: values}} and {name: test} of the rows below 'Numbers that decide'."""
    section = text.split("\n## Numbers that decide\n")[1].split("\n## ")[0]
    values, tests, folder = {}, {}, None
    for line in section.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if heading := re.fullmatch(r"\*\*.+\*\* \(`(\w+)`\)", cells[0]):
            folder = heading[1]
        elif row := re.fullmatch(r"`(\w+)`", cells[0]):
            assert len(cells) == 6 and all(cells), line
            assert row[1] not in tests, f"{row[1]} has two rows"
            values.setdefault(folder, {})[row[1]] = numbers_in(cells[1])
            tests[row[1]] = cells[5].strip("`")
    return values, tests


def differences(headers, table):
    """What one says and the other does not, in words. Both {folder: {name: values}}."""
    for folder in sorted(headers.keys() | table.keys()):
        header, rows = headers.get(folder, {}), table.get(folder, {})
        for name in sorted(header.keys() | rows.keys()):
            if header.get(name) != rows.get(name):
                yield f"{folder}: {name}: {header.get(name)} in the header, {rows.get(name)} in the table"


def sources():
    """{path: text} of the three folders, their decisions.hpp apart."""
    return {path: path.read_text(encoding="utf-8") for folder in FOLDERS
            for path in sorted((ROOT / "src" / folder).glob("*.?pp")) if path.name != "decisions.hpp"}


def literals_elsewhere(text):
    """Names of constants of a source that begin with a number, several of one line too."""
    for constants in CONSTANT.findall(text):
        yield from (name for name in re.findall(r"(\w+)\s*=\s*\{?-?\d", constants) if name not in ELSEWHERE)


class Decisions(unittest.TestCase):
    def setUp(self):
        self.headers = {folder: of_header((ROOT / "src" / folder / "decisions.hpp").read_text(encoding="utf-8"))
                        for folder in FOLDERS}
        self.table, self.tests = of_table((ROOT / "src/loop/README.md").read_text(encoding="utf-8"))

    def test_table_and_headers_agree(self):
        self.assertEqual(list(differences(self.headers, self.table)), [])
        self.assertGreater(len(self.tests), 100)

    def test_another_value_or_a_lost_row_is_seen(self):
        self.table["loop"]["most_refitted"] = [35.0]
        del self.table["loop"]["most_judged"]
        self.table["effects"]["new"] = [1.0]
        self.assertEqual([line.split(":")[1].strip() for line in differences(self.headers, self.table)],
                         ["new", "most_judged", "most_refitted"])

    def test_all_numbers_of_a_header_are_read(self):
        for folder in FOLDERS:
            text = (ROOT / "src" / folder / "decisions.hpp").read_text(encoding="utf-8")
            self.assertEqual(len(self.headers[folder]), text.count("inline constexpr"), folder)

    def test_each_is_used_by_its_name(self):
        used = set(re.findall(r"\w+", "\n".join(re.sub(r"///?.*", "", text) for text in sources().values())))
        names = {name for header in self.headers.values() for name in header}
        self.assertEqual(sorted(names - used), [])

    def test_tests_that_rows_name_are_there(self):
        written = {f"{suite}.{name}" for path in (ROOT / "tests").rglob("test_*.cpp")
                   for suite, name in re.findall(r"TEST\(\s*(\w+),\s*(\w+)\)", path.read_text(encoding="utf-8"))}
        named = set(self.tests.values()) - {"none"}
        self.assertEqual(sorted(named - written), [])

    def test_none_stands_elsewhere(self):
        found = [f"{path.name}: {name}" for path, text in sources().items() for name in literals_elsewhere(text)]
        self.assertEqual(found, [])
        text = "constexpr double least_share = 0.5, most = -2;  ///< of it\nconstexpr std::array sizes = {1, 2};\n"
        self.assertEqual(list(literals_elsewhere(text)), ["least_share", "most", "sizes"])

    def test_defaults_of_keys_are_those(self):
        text = (ROOT / "src/job/loop_kind.cpp").read_text(encoding="utf-8")
        keys = dict(re.findall(r'\{"study", "(\w+)", Type::\w+, "[^"]*", "([^"]*)"', text))
        for key, name in KEYS.items():
            self.assertEqual(numbers_in(keys[key]), self.headers["loop"][name], key)


if __name__ == "__main__":
    unittest.main()
