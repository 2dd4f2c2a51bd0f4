"""The hours of a job's periods, and the EPW file of each calendar year.

A period lasts from its first day, 0 h, to the end of its last, in the weather's standard time. Every run gets a copy of
its EPW with the rows of its year alone and a header that says so; row k is the hour that ends at its time. A leap year
whose rows go from 28 February to 1 March has the 28th twice, as in the job's own model. Source: EnergyPlus, Auxiliary
Programs, EPW. Leaves out EPW files of less than an hour.
"""
import calendar
import csv
import datetime
import gzip
import zlib
from dataclasses import dataclass, field

from energyplus.failed import Failed, read_text

HEADER_LINES = 8
YEAR, MONTH, DAY, HOUR, DRY_BULB = 0, 1, 2, 3, 6   # columns
HOURS = datetime.timedelta(hours=1)


@dataclass
class Span:
    """Hours of a period in one calendar year; `at`: its first row in hours.csv."""
    begin: datetime.datetime
    n_hours: int
    at: int

    @property
    def last_day(self):
        return (self.begin + (self.n_hours - 1) * HOURS).date()


@dataclass
class Epw:
    path: str
    header: list
    rows: list                 # lists of texts
    years: set = field(default_factory=set)

    def says_years(self):
        years = sorted(self.years)
        return ", ".join(map(str, years)) if len(years) < 3 else f"{len(years)} years from {years[0]} to {years[-1]}"


def read_day(path, said):
    try:
        return datetime.date.fromisoformat(said.strip())
    except ValueError:
        raise Failed(f"{path}: {said!r} is no date; expected one such as 2021-03-05") from None


def read_periods(path):
    """[(first day, last day)] of a CSV file with the header period,first,last."""
    rows = list(csv.reader(read_text(path, "a table of periods").splitlines()))
    if not rows or [cell.strip() for cell in rows[0]] != ["period", "first", "last"]:
        raise Failed(f"{path}: line 1: is {rows[0] if rows else 'missing'}; expected period,first,last")
    periods = []
    for row in filter(None, rows[1:]):
        if len(row) != 3:
            raise Failed(f"{path}: {','.join(row)!r}: expected three cells: period,first,last")
        first, last = (read_day(path, cell) for cell in row[1:])
        if last < first:
            raise Failed(f"{path}: {row[0]}: ends {last}, before it begins {first}; expected the first day first")
        periods.append((first, last))
    if not periods:
        raise Failed(f"{path}: has no period; expected lines like training,2021-01-01,2021-12-31")
    return periods


def spans_of(periods):
    """Spans of all periods, cut at the turns of years, in their order; and the count of hours."""
    spans, at = [], 0
    for first, last in periods:
        for year in range(first.year, last.year + 1):
            begin = max(first, datetime.date(year, 1, 1))
            end = min(last, datetime.date(year, 12, 31)) + datetime.timedelta(days=1)
            n_hours = (end - begin).days * 24
            spans.append(Span(datetime.datetime.combine(begin, datetime.time()), n_hours, at))
            at += n_hours
    return spans, at


def text_of(path):
    """Of an EPW, which may be packed."""
    if str(path).endswith(".gz"):
        try:
            with gzip.open(path, "rt", encoding="latin-1") as file:
                return file.read()
        except (OSError, EOFError, zlib.error) as error:
            raise Failed(f"{path}: {error}; expected a packed weather file, EPW") from None
    return read_text(path, "a weather file, EPW", "latin-1")


def read_epw(path):
    lines = text_of(path).splitlines()
    header, rows = lines[:HEADER_LINES], [line.split(",") for line in lines[HEADER_LINES:] if line.strip()]
    if not rows or not header[0].upper().startswith("LOCATION") or any(len(row) < 20 for row in rows):
        raise Failed(f"{path}: is no EPW: expected 8 lines of header, the first LOCATION, and rows of 35 numbers")
    try:
        years = {int(row[YEAR]) for row in rows}
        [int(cell) for row in rows for cell in row[MONTH:HOUR + 1]]
    except ValueError as error:
        raise Failed(f"{path}: {error}; expected year, month, day and hour as whole numbers") from None
    return Epw(path, header, rows, years)


def is_typical(epw):
    """Months of many years, which do not follow one another."""
    years = [int(row[YEAR]) for row in epw.rows]
    return any(later - earlier not in (0, 1) for earlier, later in zip(years, years[1:]))


def rows_of_year(files, year):
    """(Epw, its rows of a year). A single file that is typical stands for every year."""
    for epw in files:
        rows = [row for row in epw.rows if int(row[YEAR]) == year]
        if rows and not is_typical(epw):
            return epw, rows
    if len(files) == 1 and len(files[0].rows) in (8760, 8784) and is_typical(files[0]):
        return files[0], files[0].rows
    names = ", ".join(f"{epw.path} has {epw.says_years()}" for epw in files)
    raise Failed(f"weather: no file has the year {year}, which the periods need: {names}; expected an EPW of {year} in "
                 "\"weather\", or other periods")


def hour_of(row, year):
    """Begin of a row's hour, None of a day that the year does not have."""
    try:
        day = datetime.datetime(year, int(row[MONTH]), int(row[DAY]))
    except ValueError:
        return None
    return day + (int(row[HOUR]) - 1) * HOURS


def with_leap_day(rows, year):
    """28 February stands for a 29th that a leap year lacks."""
    days = [(int(row[MONTH]), int(row[DAY])) for row in rows]
    at = days.index((3, 1)) if (3, 1) in days else 0
    if not calendar.isleap(year) or not at or days[at - 1] != (2, 28):
        return rows
    again = [[*row[:DAY], "29", *row[DAY + 1:]] for row, day in zip(rows, days) if day == (2, 28)]
    return [*rows[:at], *again, *rows[at:]]


def write_epw(path, epw, rows, year, shift):
    """A copy of these rows; `shift`: {begin of hour: K} on the outdoor temperature."""
    rows = [[str(year), *row[1:]] for row in with_leap_day(rows, year)]
    if shift:
        for row in rows:
            by = shift.get(hour_of(row, year), 0)
            if by:
                row[DRY_BULB] = f"{float(row[DRY_BULB]) + by:.3f}"
    is_leap = any(int(row[MONTH]) == 2 and int(row[DAY]) == 29 for row in rows)
    weekday = datetime.date(year, int(rows[0][MONTH]), int(rows[0][DAY])).strftime("%A")
    header = [of_leap(line, is_leap) if line.upper().startswith("HOLIDAYS") else
              of_data(rows, weekday) if line.upper().startswith("DATA PERIODS") else line for line in epw.header]
    with open(path, "w", encoding="latin-1", newline="\n") as file:
        file.write("\n".join([*header, *(",".join(row) for row in rows)]) + "\n")
    return is_leap


def of_leap(line, is_leap):
    cells = line.split(",")
    return ",".join([cells[0], "Yes" if is_leap else "No", *cells[2:]])


def of_data(rows, weekday):
    first, last = (f"{int(row[MONTH])}/{int(row[DAY])}" for row in (rows[0], rows[-1]))
    return f"DATA PERIODS,1,1,Data,{weekday},{first},{last}"
