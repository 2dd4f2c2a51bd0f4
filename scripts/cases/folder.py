"""What stands in a case folder. It reads the files that it is asked for, and no others."""
import csv
import functools
import json
import os
from datetime import date, datetime, timedelta

from cases.kinds import kind_of

EPW_HEADER_LINES = 8


class CaseError(Exception):
    """Where, what, and what was expected instead."""


class Description(dict):
    """An object of building.json. To read a key that is missing, or whose value is of another
    kind, is a CaseError."""

    def __init__(self, items, file, place):
        super().__init__(items)
        self.file, self.place = file, place

    def __getitem__(self, key):
        kind = kind_of(key)
        if key not in self or not kind.fits(super().__getitem__(key)):
            raise self.error(key, kind.words)
        return super().__getitem__(key)

    def get(self, key, default=None):
        """null is as good as nothing."""
        return default if super().get(key) is None else self[key]

    def error(self, key, expected):
        what = json.dumps(super().get(key))[:60] if key in self else "is not there"
        return CaseError(f"{self.file}: {self.place}{key}: {what}; expected {expected}")


def described(value, file, place=""):
    """What JSON holds, its objects as descriptions. `place`: the keys to it, each with its dot."""
    if isinstance(value, dict):
        return Description({key: described(each, file, f"{place}{key}.")
                            for key, each in value.items()}, file, place)
    if isinstance(value, list):
        return [described(each, file, f"{place[:-1]}[{k}].") for k, each in enumerate(value)]
    return value


def read_case(case_dir):
    path = os.path.join(case_dir, "building.json")
    try:
        with open(path) as text:
            case = described(json.load(text), path)
    except OSError as error:
        raise CaseError(f"{path}: {error.strerror}; expected a case folder") from None
    except ValueError as error:
        raise CaseError(f"{path}: {error}; expected JSON") from None
    if not isinstance(case, Description):
        raise CaseError(f"{path}: is no object; expected the description of a building")
    return case


def file_of(expected):
    """Makes what a function cannot read in its file a CaseError."""
    def checked(read):
        @functools.wraps(read)
        def of(file):
            try:
                return read(file)
            except OSError as error:
                what = error.strerror
            except (OverflowError, ValueError) as error:
                what = error
            except (IndexError, ZeroDivisionError):
                what = "has too few rows or columns"
            raise CaseError(f"{file}: {what}; expected {expected}")
        return of
    return checked


of_weather = file_of("a year of EPW weather")


def epw_rows(epw):
    with open(epw) as lines:
        return [line.split(",") for line in lines.readlines()[EPW_HEADER_LINES:] if line.strip()]


@of_weather
def days_of(epw):
    """First and last day of an EPW file."""
    rows = epw_rows(epw)
    return [date(*(int(part) for part in rows[i][:3])) for i in (0, -1)]


@of_weather
def mean_outdoor_temperature(epw):
    readings = [float(row[6]) for row in epw_rows(epw)]
    return sum(readings) / len(readings)


@of_weather
def ground_temperatures(epw):
    """Monthly means of the shallowest depth in the file's header [degC]; [] where there are
    none."""
    with open(epw) as lines:
        header = [next(lines, "").strip().split(",") for _ in range(EPW_HEADER_LINES)]
    for words in header:
        if words[0] == "GROUND TEMPERATURES" and len(words) >= 6 + 12:
            return [float(word) for word in words[6:6 + 12]]
    return []


@file_of("readings, a column each")
def columns_of(file):
    """The measured columns, in their order."""
    with open(file) as lines:
        return lines.readline().strip().split(",")[1:]


def numbers_in(files, column):
    """The readings of a column in all files; empty cells left out."""
    for file in files:
        with open(file) as lines:
            rows = csv.reader(lines)
            k = next(rows).index(column)
            yield from (float(row[k]) for row in rows if row[k])


def is_measured(files, first, last):
    """Whether one of the files covers the days; a stamp is the end of its hour."""
    for file in files:
        with open(file) as lines:
            stamps = [line[:19] for line in lines.readlines()[1:]]
        begins = [(datetime.fromisoformat(stamps[i]) - timedelta(hours=1)).date()
                  for i in (0, -1)]
        if begins[0] <= first and last <= begins[1]:
            return True
    return False
