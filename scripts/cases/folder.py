"""What stands in a case folder. It reads the files that it is asked for, and no others."""
import csv
import json
import os
from datetime import date, datetime, timedelta

EPW_HEADER_LINES = 8


class CaseError(Exception):
    """Where, what, and what was expected instead."""


def read_case(case_dir):
    path = os.path.join(case_dir, "building.json")
    try:
        with open(path) as text:
            return json.load(text)
    except (OSError, ValueError) as error:
        raise CaseError(f"{path}: {error}; expected a case folder") from None


def epw_rows(epw):
    with open(epw) as lines:
        return [line.split(",") for line in lines.readlines()[EPW_HEADER_LINES:] if line.strip()]


def days_of(epw):
    """First and last day of an EPW file."""
    rows = epw_rows(epw)
    return [date(*(int(part) for part in rows[i][:3])) for i in (0, -1)]


def mean_outdoor_temperature(epw):
    readings = [float(row[6]) for row in epw_rows(epw)]
    return sum(readings) / len(readings)


def ground_temperatures(epw):
    """Monthly means of the shallowest depth in the file's header [degC]; [] where there are
    none."""
    with open(epw) as lines:
        header = [next(lines, "").strip().split(",") for _ in range(EPW_HEADER_LINES)]
    for words in header:
        if words[0] == "GROUND TEMPERATURES" and len(words) >= 6 + 12:
            return [float(word) for word in words[6:6 + 12]]
    return []


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
