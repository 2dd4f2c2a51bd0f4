"""What stands in a CSV file: separator, line of names, time columns and their form, decimal mark.

It looks as the program does (src/input/csv.hpp), so that a job has to say only what a file does not show. A file is
read as a whole, gzipped or not.
"""
import csv
import datetime as dt
import gzip
import io
import os
import re
import zlib
from dataclasses import dataclass, field

from new_job import times
from new_job.refused import NO_INPUT, Refused
from new_job.words import END, PER_HOUR, START, UNITS, says, spaced

SEPARATORS = ";\t|,"         # a comma may be a decimal mark, and comes last
LOOKED_AT = 60                 # lines before the table
DAY_COLUMNS = (24, 48, 96)     # a day a line
MISSING = {"", "na", "n/a", "nan", "null", "none", "-", "missing", "#n/a", "#value!", "#div/0!", "#ref!"}
PARTS = (("year", "yyyy", "yr"), ("month", "mo", "mon"), ("day", "dd", "dy"), ("hour", "hr", "hh"),
         ("minute", "mn", "min"))
UNIT_CELLS = ("yyyy mm dd hh mm", "h", "-")
# Numbers that count a time, of 1980 to 2100.
COUNTED = ((29221, 73051, "perhaps a workbook's days since 1900; give its cells a format of date and clock before you "
                          "save them as CSV"),
           (315532800, 4102444800, "perhaps seconds since 1970; write them as dates and clock of standard time, or the "
                                   "meter by hand with time_format = \"%s\""))
NO_YEAR = re.compile(r"\d\d?[/-]\d\d? +\d\d?:\d\d(:\d\d)?$")  # EnergyPlus writes them
BLANK, BLANK_GROUP = re.compile(r"\s"), re.compile(r"\d\s\d{3}(\D|$)")
APOSTROPHE_GROUP = re.compile(r"\d'\d{3}(\D|$)")   # of Switzerland
CLOCKS_APART = ("%H:%M", "%H:%M:%S", "%I:%M %p", "%I:%M:%S %p")   # in a column beside that of dates
HOURS = ("hour", "hr", "hh", "he", "hour ending", "hour beginning", "stunde", "heure", "hora", "ora")
TIME_COLUMNS = 10              # a time is in one of the first ones: exports begin with names and numbers of meters
YEARS = (1900, 2100)           # of readings: a sum such as 20480115 is no date


def bytes_of(path):
    try:
        with open(path, "rb") as file:
            data = file.read()
    except FileNotFoundError:
        raise Refused(f"{path}: no such file; expected the name of one", NO_INPUT) from None
    except OSError as error:
        raise Refused(f"{path}: {error.strerror}; expected a file that can be read", NO_INPUT) from None
    if data[:2] == b"\x1f\x8b":
        try:
            data = gzip.decompress(data)
        except (OSError, EOFError, zlib.error) as error:
            raise Refused(f"{path}: is a damaged gzip file ({error}); pack it again") from None
    return data


def text_of(path):
    data = bytes_of(path)
    if data[:2] == b"PK":
        raise Refused(f"{path}: is a workbook or a zip; save its sheet as CSV, or unpack it")
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise Refused(f"{path}: is UTF-16; save it as CSV in UTF-8")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", errors="replace")


def lines_of(path):
    """Lines with something in them, and the separator."""
    text = text_of(path).replace("\r\n", "\n").replace("\r", "\n")
    if text.lstrip()[:1] == "<":
        raise Refused(f"{path}: is a web page or XML, no CSV; of XML, Green Button is read")
    said = re.match(r"sep=(.)\n", text)
    if said:
        text = text[said.end():]
    lines = [line for line in text.split("\n") if line.strip(" ,;\t")]
    if not lines:
        raise Refused(f"{path}: is empty; expected a line of names and rows of readings")
    if said:
        return lines, said.group(1)
    some = [*lines[:LOOKED_AT // 10], lines[len(lines) // 2], lines[-1]]
    separator = next((mark for mark in SEPARATORS if sum(mark in line for line in some) * 2 > len(some)), ",")
    n = lines[len(lines) // 2].count(separator)      # names may stand behind a #, comments do
    return [line for line in lines if not line.startswith("#") or line.count(separator) == n], separator


@dataclass
class Table:
    """Of one file."""
    path: str
    names: list
    rows: list                 # of cells
    separator: str
    time: list = field(default_factory=list)  # names of the time's columns
    form: str = ""             # of strptime; "" = as the program reads it
    times: list = None         # [row] of the stamps' own clock
    is_guess: bool = False     # day and month
    has_offset: bool = False   # stamps say theirs; times are then of standard time
    per_day: int = 0           # readings of a line that is a day
    units: dict = field(default_factory=dict)  # {name: cell} of a line below the names

    def column(self, name):
        k = self.names.index(name)
        return [row[k].strip() if k < len(row) else "" for row in self.rows]

    @property
    def values(self):
        """Names of the columns that are no time."""
        return [name for name in self.names if name and name not in self.time]

    @property
    def step(self):
        return times.step_of(self.times) if not self.per_day else 86400 / self.per_day


def cells_of(lines, separator):
    return list(csv.reader(io.StringIO("\n".join(lines)), delimiter=separator, skipinitialspace=True))


def part_columns(names):
    """Indices of year, month, day and perhaps hour and minute; None without the first three."""
    found = [next((k for k, name in enumerate(names) if name.strip().lower() in part), None) for part in PARTS]
    return [k for k in found if k is not None] if None not in found[:3] else None


def of_parts(rows, columns):
    def time(row):
        numbers = [int(float(row[k])) for k in columns]
        return dt.datetime(*numbers[:3]) + dt.timedelta(hours=numbers[3] if len(numbers) > 3 else 0,
                                                        minutes=numbers[4] if len(numbers) > 4 else 0)
    try:
        return [time(row) for row in rows]
    except (ValueError, IndexError, OverflowError):
        return None


def is_time(cell):
    cell = cell.strip()
    reads = (times.read_iso, *map(times.read_form, (*times.YEAR_FIRST, *times.OTHER_FORMS)))
    found = (times.all_read(read, [cell]) for read in reads) if re.search(r"\d", cell) else ()
    return any(read and YEARS[0] <= read[0].year <= YEARS[1] for read in found)


def header_at(path, cells):
    """(index of the names, of the first row): the first row is the first line with a time or the parts of one."""
    for k, row in enumerate(cells[:LOOKED_AT]):
        if part_columns(row) and len(cells) > k + 1:
            return k, k + 1
        if len(row) > 1 and is_row_of_times(row, cells[k + 1] if k + 1 < len(cells) else row):
            names = next((j for j in range(k - 1, -1, -1) if len(cells[j]) > 1 and
                          re.search(r"[^\W\d]", "".join(cells[j])) and not is_line_of_units(cells[j])), None)
            if names is not None:
                return names, k
            raise Refused(f"{path}:1: has no line with the names of its columns above the first reading; write one, "
                          "time,gas_kwh")
    raise Refused(f"{path}: has no time column{counted_time(cells)}; expected one like 2021-03-05 14:00, or date and "
                  "clock in two columns")


def counted_time(cells):
    """What a first column may be that is not read: days or seconds since an origin, times without a year."""
    last = cells[-1][0].strip() if cells[-1] else ""
    if NO_YEAR.match(last):
        return f" that is read: its first has times such as {last}, which have no year; write it"
    try:
        values = [float(row[0]) for row in cells[-2:]]
    except (ValueError, IndexError):
        return ""
    said = next((says for least, most, says in COUNTED if all(least <= value <= most for value in values)), "")
    return said and f" that is read: its first has numbers such as {cells[-1][0]}, {said}"


def is_row_of_times(row, next_row):
    """Whether both have a time in one of the first columns."""
    return any(is_time(cell) and is_time(other) for cell, other in zip(row[:TIME_COLUMNS], next_row))


def is_line_of_units(row):
    """-, kWh, [degC], m3/h: nothing but units and dashes."""
    words = [spaced(PER_HOUR.sub("", cell)) for cell in row]
    return any(words) and all(not word or word in UNIT_CELLS or any(re.fullmatch(pattern, word)
                                                                    for pattern, _, _ in UNITS) for word in words)


def set_time(table, country):
    """Finds the time's columns; Refused where no column is a time in all rows."""
    parts = part_columns(table.names)
    if parts and (read := of_parts(table.rows, parts)):
        table.time, table.times = [table.names[k] for k in parts], read
        return
    if len(table.rows) < 2:
        raise Refused(f"{table.path}: has {len(table.rows)} row of readings; expected those of some months at least")
    for name in table.names[:TIME_COLUMNS]:
        cells = table.column(name)
        read = times.read_times(cells, country)
        if not read or len(read[1]) < len([cell for cell in cells if cell]):
            continue
        table.time, (table.form, table.times, table.is_guess) = [name], as_other_dates(table, name, read)
        table.has_offset = times.has_offset(cells[0]) or "%z" in table.form.lower()
        add_clock(table)
        return
    names = ", ".join(table.names[:TIME_COLUMNS])
    raise Refused(f"{table.path}: has no time column: in none of {names} is every cell a time; expected times like "
                  "2021-03-05 14:00; a note or a total between the rows is taken out by hand")


def as_other_dates(table, name, read):
    """Where day and month cannot be told apart, as in another column of dates where they can."""
    form, found, is_guess = read
    for other in table.names[:TIME_COLUMNS] if is_guess else ():
        sure = times.read_times(table.column(other)) if other != name else None
        if sure and not sure[2] and (again := times.all_read(times.read_form(sure[0] or form), table.column(name))):
            return sure[0] or form, again, False
    return form, found, is_guess


def times_like(table, name):
    """Times of another column than that of the time, day and month in its order; None where they are none."""
    read = times.all_read(times.read_form(table.form), table.column(name)) if table.form else None
    found = (table.form, read, table.is_guess) if read else times.read_times(table.column(name))
    return found[1] if found else None


def add_clock(table):
    """A column of the clock beside that of dates."""
    if any(time.hour or time.minute for time in table.times[:LOOKED_AT]):
        return
    for name in table.names:
        cells = table.column(name) if name not in table.time else []
        found = clock_in(cells)
        if found:
            form, clocks = found
            iso = "%Y/%m/%d" if "/" in table.column(table.time[0])[0] else "%Y-%m-%d"
            table.times = [day + clock for day, clock in zip(table.times, clocks)]
            table.form = f"{table.form or iso} {form}" if table.form or "%I" in form else ""
            table.time.append(name)
            return
    add_hour(table)


def add_hour(table):
    """A column of whole hours beside that of dates, from 0 to 23 or from 1 to 24."""
    name = next((name for name in table.names if spaced(name) in HOURS and name not in table.time), None)
    cells = table.column(name) if name else []
    if not cells or not all(cell.isdigit() and int(cell) <= 24 for cell in cells):
        return
    table.times = [day + int(cell) * times.HOUR for day, cell in zip(table.times, cells)]
    table.form = table.form and f"{table.form} %H"
    table.time.append(name)


def clock_in(cells):
    """(form, times since midnight) of cells that are all clocks; None where they are not."""
    for form in CLOCKS_APART:
        read = times.read_form(form)
        if cells and times.all_read(read, cells[:LOOKED_AT]) and (found := times.all_read(read, cells)):
            return form, [time - dt.datetime(1900, 1, 1) for time in found]
    return None


def read_table(path, country="", utc_offset=0):
    """Refused where it is none. `utc_offset`: of the site's standard time [h], in which times are that say theirs."""
    lines, separator = lines_of(path)
    cells = cells_of(lines, separator)
    names_at, first = header_at(path, cells)
    names = [name.strip().lstrip("#").strip() for name in cells[names_at]]
    rows = [row for row in cells[first:] if len(row) > 1]
    while len(rows) > 2 and not rows_begin_with_time(rows[-1]):
        rows.pop()                                    # a total, a note
    check_widths(path, names, rows, separator)
    table = Table(os.fspath(path), names, rows, separator)
    table.units = next((dict(zip(names, row)) for row in cells[names_at + 1:first] if is_line_of_units(row)), {})
    set_time(table, country)
    if table.has_offset:
        table.times = [time + dt.timedelta(hours=utc_offset) for time in table.times]
    n_values = len(table.values)
    if n_values in DAY_COLUMNS and table.step == 86400:
        table.per_day = n_values
    return table


def line_of(path, row, separator):
    """Number of the first line with these cells."""
    lines = text_of(path).splitlines()
    return next((k for k, line in enumerate(lines, 1) if cells_of([line], separator) == [row]), 1)


def line_behind(path, before, row, separator):
    """Number of the first line with these cells behind one with those of the row before."""
    first = line_of(path, before, separator)
    rows = cells_of(text_of(path).splitlines()[first:], separator)
    return first + next((k for k, cells in enumerate(rows, 1) if cells == row), 0)


def check_widths(path, names, rows, separator):
    """Decimal commas between separators that are commas, too, make two cells of a number."""
    for row in rows:
        if any(cell.strip() for cell in row[len(names):]):
            raise Refused(f"{path}:{line_of(path, row, separator)}: has {len(row)} cells; expected {len(names)} as in "
                          "the line of names; if commas are decimal marks, put such cells into quotes or separate "
                          "cells by semicolons")


def check_order(table):
    """The program takes rows in the order of time alone, each once; only a wall clock has an hour twice, in autumn."""
    has_clock = table.step <= 3600 and times.clock_of(table.times) is not None
    back = times.HOUR if has_clock else dt.timedelta(0)
    for k, (one, other) in enumerate(zip(table.times, table.times[1:]), 1):
        if one - other > back or one == other and not has_clock:
            clock = "; if the clock goes back here, write standard time, for its rule is neither the EU's nor that " \
                "of the US" if one - other == times.HOUR and table.step <= 3600 else ""
            line = line_behind(table.path, table.rows[k - 1], table.rows[k], table.separator)
            raise Refused(f"{table.path}:{line}: {table.time[0]}: {other:%Y-%m-%d %H:%M} is not later than the row "
                          f"before ({one:%Y-%m-%d %H:%M}); sort the rows by time, each time once; meters below each "
                          f"other go into columns or files of their own{clock}")


def rows_begin_with_time(row):
    return any(is_time(cell) for cell in row[:TIME_COLUMNS]) or all(cell.strip().isdigit() for cell in row[:3])


def text_among(table, name):
    """(line, text) of a cell that is no number, where others are or it begins as one; else None."""
    cells = [cell for cell in table.column(name) if cell.lower() not in MISSING]
    texts = [cell for cell in cells if not re.fullmatch(r"[-+]?[\d.,\s]+([eE][-+]?\d+)?", cell)]
    if not texts or 2 * len(texts) > len(cells) and not texts[0][:1].isdigit():
        return None
    row = table.rows[table.column(name).index(texts[0])]
    return line_of(table.path, row, table.separator), texts[0]


def said_beside(table):
    """What columns say that have the same text in all rows: "Electric usage kWh"."""
    said = {name: set(table.column(name)) for name in table.values}
    return " ".join(texts.pop() for texts in said.values() if len(texts) == 1)


@dataclass
class Numbers:
    """A column as numbers, and how they are written."""
    values: list               # None where nothing is read
    decimal: str = "."
    thousands: str = ""        # "" where nothing looks so, "none" where it could
    is_guess: bool = False
    example: str = ""          # as it is written


def form_of(cells, separator):
    """(decimal, thousands, whether it was guessed). A mark before three digits everywhere is one of thousands where
    numbers from 1 to 999 stand among them, which have none; one of decimals where a longer one has none. A zero or a
    code such as -99 says nothing."""
    if any(BLANK_GROUP.search(cell) for cell in cells):
        return ("," if any("," in cell for cell in cells) else "."), " ", False
    if any(APOSTROPHE_GROUP.search(cell) for cell in cells):
        return ("," if any("," in cell for cell in cells) else "."), "'", False
    both = [cell for cell in cells if "," in cell and "." in cell]
    if both:
        return (",", ".", False) if both[0].rfind(",") > both[0].rfind(".") else (".", ",", False)
    for mark, other in ((",", "."), (".", ",")):
        marked = [cell for cell in cells if mark in cell]
        if not marked:
            continue
        if not all(re.fullmatch(rf"-?[1-9]\d{{0,2}}(\{mark}\d{{3}})+", cell) for cell in marked):
            return mark, "", False
        if any(cell.count(mark) > 1 for cell in marked):
            return other, mark, False
        unmarked = {cell for cell in cells if mark not in cell}
        if any(re.fullmatch(r"-?\d{4,}", cell) for cell in unmarked):
            return mark, "none", False
        if any(re.fullmatch(r"0*[1-9]\d{0,2}", cell) for cell in unmarked):
            return other, mark, False
        return (other, mark, True) if mark == separator else (mark, "none", True)
    return ".", "", False


def other_form(numbers):
    """Of a guess: what it is otherwise."""
    if numbers.thousands == "none":
        return ("." if numbers.decimal == "," else ","), numbers.decimal, True
    return numbers.thousands, "none", True


def numbers_in(table, name, form=None):
    """None where the column has other texts than missing ones. `form`: as of form_of."""
    columns = [name] if not table.per_day else table.values
    cells = [cell for column in columns for cell in table.column(column)]
    there = [cell for cell in cells if cell.lower() not in MISSING]
    decimal, thousands, is_guess = form or form_of(there, table.separator)
    values = []
    for cell in cells:
        if cell.lower() in MISSING:
            values.append(None)
            continue
        plain = "".join(cell.split()) if thousands != " " else BLANK.sub("", cell)
        plain = plain.replace(thousands, "") if thousands in (",", ".", "'") else plain
        try:
            values.append(float(plain.replace(decimal, ".")))
        except ValueError:
            return None
    return Numbers(values, decimal, thousands, is_guess, next((cell for cell in there if not cell.isdigit()), ""))


def stamp_of(table):
    """"start" or "end" where the names of the time's columns say so; else None, and the program looks."""
    name = " ".join(table.time)
    if says(END, name, whole=True):
        return "end"
    return "start" if says(START, name, whole=True) else None
