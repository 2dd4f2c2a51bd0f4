"""Exports that are no table of readings, as CSV files beside the job: ENERGY STAR Portfolio Manager's meter entries
(one row a bill) and Green Button XML (ESPI).

Source: Portfolio Manager's columns (Start Date, End Date, Usage/Quantity, Usage Units, Estimation, Meter Type, Meter
Name); NAESB REQ.21 ESPI (ReadingType: uom, powerOfTenMultiplier, commodity, flowDirection; IntervalReading: start in
seconds since 1970 UTC, duration). A block of readings is of the reading type to which the links of its MeterReading
lead; where there are none, of the one before it. Leaves out demand, costs, and of Green Button what is fed in.
"""
import csv
import datetime as dt
import itertools
import os
import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass

from new_job import tables, times, workbook
from new_job.refused import EXISTS, IO, Refused
from new_job.words import quantity_of, says, spaced, unit_of

DAY = 86400
PORTFOLIO = {                  # what a column is: its names
    "kind": r"type|energy type|fuel type|fuel", "name": r"name|id|portfolio manager meter id",
    "start": r"start date|start", "end": r"end date|end", "units": r"usage units?|units?|unit of measure|uom",
    "usage": r"usage quantity|usage|quantity|consumption|use|amount",
    "estimated": r"estimation|estimated|estimate|is estimated"}
COMMODITIES = {"0": "electricity", "1": "electricity", "2": "electricity", "7": "gas", "8": "gas", "10": "district",
               "12": "district", "13": "cooling"}
# uom of ESPI: the job's unit, factor.
UOMS = {"72": ("Wh", 1), "38": ("W", 1), "169": ("therm", 1), "119": ("ft3", 1), "42": ("m3", 1), "132": ("kBtu", 1e-3),
        "31": ("J", 1)}
MADE_HERE = "solar|wind"       # Electric - Solar: what panels give, in part to the grid
FED_IN = "19"                  # flowDirection: reverse


@dataclass
class Converted:
    """One meter of an export, written as a CSV file."""
    file: str
    column: str
    quantity: str
    unit: str
    factor: float
    says: str                  # what it was
    doubt: str = ""


def is_green_button(path):
    return tables.bytes_of(path).lstrip(b"\xef\xbb\xbf \r\n\t")[:1] == b"<"


def is_portfolio_manager(table):
    return None not in [column_of(table, PORTFOLIO[key]) for key in ("start", "end", "units", "usage")]


def portfolio_sheet(path):
    """The sheet of a workbook that is Portfolio Manager's; its names are in the first row that has all of them."""
    for rows in workbook.sheets_in(path):
        for k, names in enumerate(rows[:tables.LOOKED_AT]):
            whole = [row + [""] * (len(names) - len(row)) for row in rows[k + 1:] if any(row)]
            table = tables.Table(path, names, whole, ",")
            if is_portfolio_manager(table):
                return table
    raise Refused(f"{path}: is a workbook, and no sheet of it has Start Date, End Date, Usage and Usage Units as "
                  "Portfolio Manager's meter entries do; save its sheet as CSV")


def column_of(table, pattern):
    return next((name for name in table.names if re.fullmatch(rf"(?:meter )?(?:{pattern})", spaced(name))), None)


class Place:
    """Where converted readings go: beside the job; never over an input, nor over another meter's of the same run."""

    def __init__(self, job, inputs, force):
        self.stem, self.inputs, self.force, self.taken = os.path.splitext(job)[0], inputs, force, set()

    def file(self, *words):
        name = "_".join(re.sub(r"[^a-z0-9]+", "_", word.lower()).strip("_") for word in words if word)
        names = (f"{self.stem}_{name}{f'_{k}' if k > 1 else ''}.csv" for k in itertools.count(1))
        path = next(path for path in names if path not in self.taken)
        self.taken.add(path)
        return path

    def write(self, path, names, rows):
        """Over another file with --force only."""
        if os.path.exists(path):
            if any(os.path.samefile(path, other) for other in self.inputs if os.path.exists(other)):
                raise Refused(f"{path}: is an input, over which the converted readings would be written; give the job "
                              "another name", EXISTS)
            if not self.force:
                raise Refused(f"{path}: is there already, and the converted readings go there; --force writes over it",
                              EXISTS)
        try:
            with open(path, "w", newline="", encoding="utf-8") as file:
                csv.writer(file, lineterminator="\n").writerows([names, *rows])
        except OSError as error:
            raise Refused(f"{path}: {error.strerror}; the converted readings go there", IO) from None


def bills_in(table):
    """{(kind, name, units): [(begin, end, use, whether estimated)]}; dates have the month first."""
    cells = {key: table.column(name) if (name := column_of(table, pattern)) else [""] * len(table.rows)
             for key, pattern in PORTFOLIO.items()}
    uses = tables.numbers_in(table, column_of(table, PORTFOLIO["usage"]))
    begins, ends = (times.read_times(cells[key], "US") for key in ("start", "end"))
    if uses is None or not begins or not ends or not len(begins[1]) == len(ends[1]) == len(table.rows):
        raise Refused(f"{table.path}: has rows whose dates or usage cannot be read; expected one row for each bill, "
                      "with its start, end, usage and unit")
    groups = {}
    for kind, name, units, estimated, *bill in zip(*(cells[key] for key in ("kind", "name", "units", "estimated")),
                                                   begins[1], ends[1], uses.values):
        if bill[-1] is not None:
            groups.setdefault((kind, name, units), []).append((*bill, int(says("yes|true|1|e", estimated))))
    return groups


def check_bills(path, bills):
    """None begins before the end of the one before it. The same row twice has been taken once."""
    for (begin, end, *_), (later, *_) in zip(bills, bills[1:]):
        if later < end:
            raise Refused(f"{path}: a bill begins on {later:%Y-%m-%d}, before the end of the one from "
                          f"{begin:%Y-%m-%d} to {end:%Y-%m-%d}; take one of them out")


def of_portfolio_manager(table, place):
    """Its bills, one file for each meter; water, waste and wood are left out, and a meter of a single bill."""
    groups, found, left = bills_in(table), [], set()
    for (kind, name, units), bills in groups.items():
        quantity = quantity_of(f"{kind} {name}" if kind or name else os.path.basename(table.path))
        if says(MADE_HERE, kind):
            left.add(kind)
            continue
        if not quantity or len(bills) < 2:
            continue
        unit = unit_of(units)
        if not unit:
            raise Refused(f"{table.path}: {units!r} is no unit that is known; expected kWh, therms, ccf, kBtu, ...")
        bills = sorted(set(bills))
        check_bills(table.path, bills)
        are_estimated = all(estimated for *_, estimated in bills)
        path = place.file(quantity, name if len(groups) > 1 else "")
        lines = [[f"{begin:%Y-%m-%d}", f"{end:%Y-%m-%d}", use, 0 if are_estimated else estimated]
                 for begin, end, use, estimated in bills]
        place.write(path, ["start", "end", "usage", "estimated"], lines)
        what = ", ".join(filter(None, (kind, name, units)))
        doubt = f"{table.path}: all bills of {what} are estimated; they were taken as read" if are_estimated else ""
        found.append(Converted(path, "usage", quantity, *unit, f"{len(bills)} bills of {table.path} ({what})", doubt))
    if found and left:
        found[0].doubt = " ".join(filter(None, (f"{table.path}: left out: {', '.join(sorted(left))}, which does not "
                                                "say what the building used of it", found[0].doubt)))
    if not found:
        raise Refused(f"{table.path}: has no bills of gas, electricity or district energy")
    return found


def local(element):
    """A tag without its namespace."""
    return element.tag.rsplit("}", 1)[-1]


def child(element, *path):
    """Text of a descendant, tag by tag; None where it is not there."""
    for tag in path:
        element = next((each for each in element if local(each) == tag), None)
        if element is None:
            return None
    return element.text.strip() if element.text else ""


def of_green_button(path, place):
    """Its interval blocks. Each reading type has its unit; a file of one feed has one mostly."""
    try:
        root = ElementTree.fromstring(tables.bytes_of(path))
    except ElementTree.ParseError as error:
        raise Refused(f"{path}: is no XML that can be read: {error}; expected Green Button (ESPI)") from None
    groups, kind = {}, None
    linked = linked_kinds(path, root)
    for entry in entries_of(root):
        for element in entry.iter():
            if local(element) == "ReadingType":
                kind = kind_of(path, element)
            if local(element) == "IntervalBlock":
                own = next((linked[up] for up in links_of(entry, "up") if up in linked), kind)
                groups.setdefault(own, []).extend(readings_of(path, element))
    late = kind if len({key for key in groups if key}) <= 1 else None
    found = []
    for key, readings in groups.items():
        commodity, uom, power, direction = key or late or ("1", "72", 0, "1")
        if direction == FED_IN or uom not in UOMS or commodity not in COMMODITIES or not readings:
            continue
        found.append(written(path, place, COMMODITIES[commodity], uom, power, readings))
    if not found:
        raise Refused(f"{path}: has no readings of energy in IntervalBlock; expected Green Button (ESPI)")
    return found


def entries_of(root):
    """Those of a feed; a file without is one entry."""
    return [element for element in root.iter() if local(element) == "entry"] or [root]


def links_of(entry, rel):
    return [each.get("href", "") for each in entry if local(each) == "link" and each.get("rel") == rel]


def kind_of(path, element):
    """(commodity, unit, power of ten, direction) of a ReadingType."""
    return (child(element, "commodity") or "1", child(element, "uom") or "72",
            number_of(path, child(element, "powerOfTenMultiplier"), 0), child(element, "flowDirection") or "1")


def linked_kinds(path, root):
    """{address of a collection of blocks: kind}, by way of its MeterReading."""
    types, readings = {}, []
    for entry in entries_of(root):
        for element in entry.iter():
            if local(element) == "ReadingType":
                types |= {href: kind_of(path, element) for href in links_of(entry, "self")}
            if local(element) == "MeterReading":
                readings.append(links_of(entry, "related"))
    return {href: types[of_type] for related in readings for of_type in related if of_type in types
            for href in related if href not in types}


def number_of(path, text, usual, kind=int):
    """A number of the feed; `usual` where there is none."""
    try:
        return kind(text) if text else usual
    except ValueError:
        raise Refused(f"{path}: {text[:40]!r} stands where Green Button (ESPI) has a "
                      f"{'whole ' if kind is int else ''}number") from None


def readings_of(path, block):
    """(begin [s since 1970 UTC], duration [s], value)"""
    for reading in block:
        if local(reading) != "IntervalReading":
            continue
        begin, duration, value = (child(reading, *tag) for tag in (("timePeriod", "start"), ("timePeriod", "duration"),
                                                                  ("value",)))
        if begin and value:
            yield number_of(path, begin, 0), number_of(path, duration, 3600), number_of(path, value, 0, float)


def written(path, place, quantity, uom, power, readings):
    unit, factor = UOMS[uom]
    n_twice = len(set(readings)) - len({begin for begin, _, _ in readings})
    readings = sorted(dict((begin, (duration, value)) for begin, duration, value in readings).items())
    durations = [duration for _, (duration, _) in readings]
    at = place.file(quantity)

    def time(seconds):
        return dt.datetime(1970, 1, 1) + dt.timedelta(seconds=seconds)
    if sorted(durations)[len(durations) // 2] > DAY:
        lines = [[f"{time(b):%Y-%m-%d}", f"{time(b + d):%Y-%m-%d}", f"{v * 10 ** power:.10g}", 0]
                 for b, (d, v) in readings]
        place.write(at, ["start", "end", "usage", "estimated"], lines)
    else:
        lines = [[f"{time(b):%Y-%m-%dT%H:%M:%SZ}", f"{v * 10 ** power:.10g}"] for b, (_, v) in readings]
        place.write(at, ["time", "usage"], lines)
    doubt = f"{path}: {n_twice} of its times have two readings; the later in the file was taken" if n_twice else ""
    return Converted(at, "usage", quantity, unit, factor, f"{len(readings)} readings of Green Button {path}", doubt)
