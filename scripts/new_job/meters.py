"""Which columns of the files are meters: quantity, unit, interval, and the keys that a job needs to read them.

The program looks at stamps, gaps and codes by itself (jobs/README.md); here it is chosen what it cannot know. Quantity
and unit follow from the names of column, file and unit; a unit that nothing says is the one in which the use of a year
is most like a building's. What was guessed is told. FILE:COLUMN:QUANTITY:UNIT overrules all of it.
"""
import datetime as dt
import itertools
import math
import os
from dataclasses import dataclass, field

from new_job import exports, tables, times, workbook
from new_job.refused import NO_INPUT, USAGE, Refused
from new_job.weather import keys_of
from new_job.words import (OF_GAS, POWERS, QUANTITY_NAMES, READ_DATE, TEMPERATURES, UNIT_NAMES, is_other,
                           kwh_per_unit, named_unit, quantity_of, says, unit_of)

DAY, YEAR = 86400, 365.25 * 86400
USUAL = {"gas": 150, "electricity": 100, "district": 120, "cooling": 80, "heating": 120}  # kWh/(m2 a), middling
ABSURD = 6                     # times more or less than that, and it is asked about
CANDIDATES = {"gas": ("kWh", "m3", "MWh"), "electricity": ("kWh", "MWh", "Wh"),
              "district": ("kWh", "MWh", "GJ", "kBtu"), "cooling": ("kWh", "MWh", "kBtu"), "heating": ("kWh", "MWh")}
OF_COUNTRY = {"US": ("therm", "CCF"), "GB": ("100 ft3",)}  # more of gas
ZERO_RUN = 12                  # h, of zeros that are gaps
MOST_FILLED, MOST_SHORT = 0.1, 0.002  # of the readings, that stand for gaps, and that are other zeros
LEAST_RISES, MOST_FALLS = 0.3, 0.01  # of a register's readings; of its rises
MOST_APART, MOST_CHANGE = dt.timedelta(hours=14), dt.timedelta(hours=2)   # of the same times by another clock
RISES_OF_BILLS = 9             # without a fall: perhaps a register
OFFSET, MOST_BELOW = 0.01, 0.01    # of what a meter reaches, and of its readings, that may be below 0 by faults
SPIKE = 20                     # times what 98 % of the readings reach
LEAST_FACTOR = 3               # a unit but kWh is guessed only where kWh is so far off
DAYS_OF_BILLS = r"(?:avg|average|mean) (?:daily|per day)|per day|day average"    # not the whole bill
PER_AREA = r"(?:kwh|mwh|mj|gj) (?:per )?(?:m2|sqm)|kbtu (?:per )?(?:ft2|sqft|sq ft|sf)"
M2_PER_FT2 = 0.09290304
IS_READ = {"1", "0", "true", "false", "yes", "no", "y", "n", "e", "est", "estimate", "estimated", "a", "actual", "r",
           "read", "m", "measured", ""}      # as the program takes them
NAMES = {"district": "heat", "air_temperature": "room"}  # of a meter, where the quantity's own says less


@dataclass(eq=False)           # a meter is itself
class Meter:
    """`series`: (begin, reading in the job's unit or None), by the file's clock, in the order of time."""
    name: str
    quantity: str
    file: str
    column: str
    unit: str
    factor: float
    interval: str
    step: float                # s
    series: list
    keys: dict = field(default_factory=dict)
    comments: list = field(default_factory=list)
    ends: list = field(default_factory=list)  # of bills
    more: list = field(default_factory=list)  # files that go on where `file` ends

    @property
    def files(self):
        return [self.file, *self.more]

    @property
    def is_energy(self):
        return self.quantity != "air_temperature"

    @property
    def is_hourly(self):
        return self.step <= 3600

    @property
    def is_regular(self):
        """Of equal steps, not bills."""
        return self.step <= DAY

    def read(self):
        return [(begin, value) for begin, value in self.series if value is not None]

    @property
    def first(self):
        return self.read()[0][0]

    @property
    def last(self):
        """End of the last interval that was read; of months by the calendar."""
        last = self.read()[-1][0]
        if self.ends:
            return self.ends[-1]
        if self.interval == "monthly" and all(begin.day == 1 for begin, _ in self.series):
            return (last.replace(day=1) + dt.timedelta(days=32)).replace(day=1)
        return last + dt.timedelta(seconds=self.step)

    def kwh(self):
        """[(begin, kWh)] of an energy, without codes such as -9999 and spikes, which the program masks."""
        one = self.factor * kwh_per_unit(self.unit, self.step / 3600)
        read = [row for row in self.read() if row[1] >= 0]
        most = SPIKE * sorted(value for _, value in read)[int(0.98 * (len(read) - 1))] if read else 0
        return [(begin, value * one) for begin, value in read if value <= most or not most]


@dataclass(frozen=True)
class Request:
    """--meter FILE[:COLUMN[:QUANTITY[:UNIT]]]"""
    file: str
    column: str = ""
    quantity: str = ""
    unit: str = ""


def read_request(text):
    """The file is the longest part before a colon that exists."""
    parts = text.split(":")
    for n in range(len(parts), 0, -1):
        path = ":".join(parts[:n])
        if os.path.isfile(path) and len(parts) - n <= 3:
            request = Request(path, *parts[n:])
            check_request(text, request)
            return request
    raise Refused(f"--meter {text}: {parts[0]}: no such file; expected FILE or FILE:COLUMN:QUANTITY:UNIT", NO_INPUT)


def check_request(text, request):
    if request.quantity and request.quantity not in QUANTITY_NAMES:
        raise Refused(f"--meter {text}: {request.quantity} is no quantity; expected one of {', '.join(QUANTITY_NAMES)}",
                      USAGE)
    if request.unit and request.unit not in UNIT_NAMES:
        raise Refused(f"--meter {text}: {request.unit} is no unit; expected one of {', '.join(UNIT_NAMES)}", USAGE)


def is_candidate(table, name):
    return not is_other(name) and tables.numbers_in(table, name) is not None


def chosen_columns(table, request):
    """[(column, quantity)] that are meters."""
    if request.column:
        if request.column not in table.names:
            raise Refused(f"{table.path}: has no column {request.column}; it has {', '.join(table.values)}")
        words = f"{request.column} {os.path.basename(table.path)}"
        return [(request.column, request.quantity or quantity_of(request.column) or quantity_of(words))]
    if table.per_day:
        return [(table.values[0], request.quantity or quantity_of(os.path.basename(table.path)))]
    there = [name for name in table.values if is_candidate(table, name)]
    named = [(name, quantity_of(name)) for name in there if quantity_of(name)]
    if request.quantity:
        named = [row for row in named if row[1] == request.quantity] or [(name, request.quantity) for name in there[:1]]
    if named:
        return named
    there = [name for name in there if any(table.column(name))]
    if len(there) == 1:
        said = tables.said_beside(table)
        return [(there[0], quantity_of(os.path.basename(table.path)) or quantity_of(said) or of_unit(there[0]))]
    for name in table.values:
        if quantity_of(name) and not is_other(name):
            refuse_texts(table, name)
    columns = ", ".join(table.values[:20]) + (", ..." if len(table.values) > 20 else "")
    raise Refused(f"{table.path}: has no column whose name says what it is, such as gas_kwh, among {columns}; write "
                  f"--meter {table.path}:COLUMN:QUANTITY:UNIT, or {table.path}::QUANTITY:UNIT")


def refuse_texts(table, column):
    """Of a column that would be a meter, were all its cells numbers."""
    found = tables.text_among(table, column)
    if found:
        line, text = found
        raise Refused(f"{table.path}:{line}: {column}: {text!r} is no number; expected numbers, and where nothing was "
                      "read an empty cell or NA")


def of_unit(name):
    """The quantity that a unit alone says."""
    found = named_unit(name)
    return "gas" if found and found[0] in OF_GAS else None


def interval_of(step):
    """(interval of the job, how it is said)"""
    if step <= 3600:
        return "hourly", f"{step / 60:g} min" if step < 3600 else "hours"
    if step <= DAY:
        return "daily", "days" if step == DAY else f"{step / 3600:g} h"
    return ("monthly", f"bills of {step / DAY:.0f} days") if step < 300 * DAY else ("annual", "years")


def bill_columns(table):
    """(from, to) of a table of bills, by the names of its columns of dates; None of others."""
    if table.step <= DAY:
        return None
    dates = [name for name in table.names if says("start|from|begin|end|to|until|von|bis|date|read", name) and
             tables.times_like(table, name)]
    begin = next((name for name in dates if says("start|from|begin|von", name)), None)
    end = next((name for name in dates if name != begin and says("end|to|until|bis", name)), None)
    return (begin, end) if begin and end else None


def year_use(meter, area):
    """[kWh/(m2 a)] of an energy."""
    read = meter.kwh()
    if not read:
        return 0
    if meter.ends:
        seconds = sum((end - begin).total_seconds() for (begin, _), end in zip(meter.read(), meter.ends))
    else:
        seconds = len(read) * meter.step
    return sum(value for _, value in read) / area * YEAR / max(seconds, 1)


def ends_of_bills(begins, ends):
    """Where most bills begin on the day after the end of the one before, an end is the last day."""
    one = dt.timedelta(days=1)
    follow = [begin - end for begin, end in zip(sorted(begins)[1:], sorted(ends))]
    return [end + one for end in ends] if sum(gap == one for gap in follow) * 2 > len(follow) else ends


def are_last_days(stamps):
    return all((time + dt.timedelta(days=1)).day == 1 for time in stamps)


def begins_of_months(begins):
    """Of stamps that are the last days of months."""
    return [begin.replace(day=1) for begin in begins]


def begins_of_reads(reads):
    """Of bills, each until its read; the first is as long as a month, as the program takes it."""
    month = (reads[0].replace(day=1) - dt.timedelta(days=1)).day
    return [reads[0] - dt.timedelta(days=month), *reads[:-1]]


def tell_reads(table, keys, told):
    """Dates of reads and bills, which close what they stand beside."""
    if "stamp" in keys or not says(READ_DATE, table.time[0]) or says("month|period", table.time[0]):
        return
    keys["stamp"] = "end"
    told.check(f"{table.path}: {table.time[0]}: was taken for the end of what stands beside it; with the begin of each "
               "bill there, name the column Start")


def estimated_column(table):
    """That says of each bill whether it was read."""
    for name in table.names:
        words = {cell.lower() for cell in table.column(name)}
        if says("estimat|read(?:ing)? type|type", name) and words <= IS_READ and len(words) > 1:
            return name
    return None


def scale_by_area(column, unit, area):
    """Of kWh/m2, the building's."""
    if not unit or not says(PER_AREA, column):
        return unit
    return unit[0], unit[1] * (area / M2_PER_FT2 if says("ft2|sqft|sq ft|sf", column, whole=True) else area)


def guess_unit(meter, options, told):
    """Where nothing says it: kWh, unless another of its candidates is far more like a building's use."""
    def distance(unit):
        meter.unit = unit
        use = year_use(meter, options.area)
        return abs(math.log(use / USUAL[meter.quantity])) if use > 0 else math.inf
    more = OF_COUNTRY.get(options.country, ()) if meter.quantity == "gas" else ()
    best = min(CANDIDATES[meter.quantity] + more, key=distance)
    meter.unit = best if distance("kWh") > math.log(LEAST_FACTOR) else "kWh"
    line = f"{meter.file}: {meter.column}: nothing says its unit; {meter.unit} was taken, which is " \
           f"{year_use(meter, options.area):.0f} kWh/(m2 a)"
    told.check(line)
    meter.comments.append("check this: nothing says the unit; taken by the use of a year per m2")


def check_use(meter, area, told):
    use = year_use(meter, area)
    if use and not 1 / ABSURD <= use / USUAL[meter.quantity] <= ABSURD:
        told.check(f"{meter.file}: {meter.column}: {use:.0f} kWh/(m2 a) of {meter.quantity} is far from usual "
                   f"({USUAL[meter.quantity]}): unit or floor area may be another")


def is_of_ends(table, keys):
    """Whether stamps close their steps: where names say it, or where they close whole days, as the program sees it."""
    midnight = dt.timedelta(0)
    since = [time - dt.datetime.combine(time, dt.time()) for time in (table.times[0], table.times[-1])]
    return keys.get("stamp", "end") == "end" and ("stamp" in keys or (
        since == [dt.timedelta(seconds=table.step), midnight] and not table.has_offset))


def is_register_of_bills(meter):
    """As the program sees it (src/checks/data_values.cpp)."""
    values = [value for _, value in meter.read()]
    return len(values) > RISES_OF_BILLS and all(a <= b for a, b in zip(values, values[1:])) and \
        sum(a < b for a, b in zip(values, values[1:])) >= RISES_OF_BILLS


def is_register(meter):
    values = [value for _, value in meter.read()]
    rises = sum(b > a for a, b in zip(values, values[1:]))
    falls = sum(b < a for a, b in zip(values, values[1:]))
    return rises > LEAST_RISES * len(values) and falls < MOST_FALLS * rises


def differences(meter):
    """What a register counts until the next reading."""
    read = meter.read()
    return [(begin, max(b - a, 0)) for (begin, a), (_, b) in zip(read, read[1:])]


def refuse_other_times(table, column):
    """Of trends side by side, "time, a, time, b", as the program sees it (src/input/time_columns.cpp)."""
    first, at = table.names.index(table.time[0]), table.names.index(column)
    if len(table.time) > 1 or table.per_day or table.step > DAY or at < first + 3:
        return
    own = tables.times_like(table, table.names[at - 1])
    if not own or tables.times_like(table, table.names[first + 1]):
        return
    apart = [b - a for a, b in zip(table.times, own)]
    if any(abs(one) > MOST_APART or abs(one - apart[0]) > MOST_CHANGE for one in apart):
        raise Refused(f"{table.path}: {column}: stands behind a time of its own, {table.names[at - 1]}, whose times "
                      f"are not those of {table.time[0]}; put each time and what belongs to it into a file of its own")


def take_reads(meter, table):
    """Makes uses of a register's reads, months apart or so, each from one to the next."""
    meter.keys["register"] = "difference"
    meter.keys.pop("stamp", None)
    meter.series = list(zip(sorted(table.times), (value for _, value in meter.series)))
    meter.ends = [time for time, _ in meter.read()[1:]]
    meter.series = differences(meter)


def has_filled_gaps(meter):
    """Whether nearly all zeros stand for half a day and more, and are few; a plant that is off shows short ones."""
    values = [value for _, value in meter.read()]
    longest = round(ZERO_RUN * 3600 / meter.step)
    runs = [len(list(run)) for is_zero, run in itertools.groupby(values, lambda value: value == 0) if is_zero]
    in_gaps = sum(run for run in runs if run >= longest)
    return 0 < in_gaps <= MOST_FILLED * len(values) and sum(runs) - in_gaps <= MOST_SHORT * len(values)


def tell_negatives(meter, told):
    """More than a fault or an offset: what is fed in, where electricity is. The program asks about it."""
    values = [value for _, value in meter.read()]
    reach = sorted(values)[int(0.99 * (len(values) - 1))] if values else 0
    n_below = sum(value < -OFFSET * reach for value in values)
    if n_below > max(1, MOST_BELOW * len(values)):
        meter.keys["negative"] = "missing"
        told.check(f"{meter.file}: {meter.column}: {n_below} of {len(values)} readings are below 0, and were taken as "
                   "missing; a meter of what a building takes less what it feeds in is too low by day at other times, "
                   "too: expected one of what it takes alone")


def likely_numbers(table, column, quantity, unit, area):
    """Of 1,234 that may be a thousand or one: what is more like a year's use of a building."""
    numbers = tables.numbers_in(table, column)
    if numbers is None:
        refuse_texts(table, column)
        raise Refused(f"{table.path}: column {column}: has cells that are no numbers; expected numbers, or the name of "
                      f"another column, among {', '.join(table.values)}")
    unit = unit or unit_of(column, quantity) or ("kWh", 1)
    if not numbers.is_guess or quantity not in USUAL:
        return numbers

    def distance(read):
        meter = Meter("", quantity, "", "", *unit, "", table.step, list(zip(table.times, read.values)))
        use = year_use(meter, area)
        return abs(math.log(use / USUAL[quantity])) if use > 0 else math.inf
    return min(numbers, tables.numbers_in(table, column, tables.other_form(numbers)), key=distance)


def steps_of(table, keys, bills, told):
    """(begins of what the rows show, ends of bills that have their reads alone), by the file's clock."""
    stamps, step = table.times, dt.timedelta(seconds=table.step)
    if table.per_day:
        return [day + k * step for k in range(table.per_day) for day in stamps], []
    if table.step > DAY and keys.get("stamp") == "end" and not bills:
        return (begins_of_months(stamps), []) if are_last_days(stamps) else (begins_of_reads(stamps), stamps)
    if table.step < DAY and is_of_ends(table, keys):
        if "stamp" not in keys:
            told.say(f"{table.path}: {table.time[0]}: stamps are taken for the ends of their steps, for they close "
                     "whole days; stamp = \"start\" overrules it")
        return [time - step for time in stamps], []
    return stamps, []


def quantity_by_unit(table, column, told):
    """Of a column of which nothing else says what it measures."""
    if not (found := unit_of(column)) or found[0] in TEMPERATURES:
        raise Refused(f"{table.path}: column {column}: neither it nor the file's name says what it measures; write "
                      f"--meter {table.path}:{column}:QUANTITY (one of {', '.join(QUANTITY_NAMES)})")
    told.check(f"{table.path}: {column}: nothing says what it measures; electricity was taken for its unit {found[0]}")
    return "electricity"


def of_country(unit, country):
    """Cubic feet are the USA's there alone."""
    return ("100 ft3", unit[1]) if unit and unit[0] == "CCF" and country != "US" else unit


def unit_said(table, column, quantity):
    """(unit, factor) by the name of the column, the line of units, the file's name and what stands beside; None where
    they do not say it."""
    said = (column, table.units.get(column, ""), os.path.basename(table.path), tables.said_beside(table))
    return next(filter(None, (unit_of(text, quantity) for text in said)), None)


def make_meter(table, column, quantity, unit, options, told):
    """`unit`: (unit, factor), or None where the names say it."""
    tables.check_order(table)
    refuse_other_times(table, column)
    numbers, bills = likely_numbers(table, column, quantity, unit, options.area), bill_columns(table)
    keys = keys_of_meter(table, numbers, bills, told)
    begins, ends = steps_of(table, keys, bills, told)
    quantity = quantity or quantity_by_unit(table, column, told)
    unit = scale_by_area(column, unit or of_country(unit_said(table, column, quantity), options.country), options.area)
    if table.step > DAY and says(DAYS_OF_BILLS, column):
        told.check(f"{table.path}: {column}: says to be of a day, and was taken for that of the whole bill; expected "
                   "the use of each bill")
    interval, _ = interval_of(table.step)
    meter = Meter(NAMES.get(quantity, quantity), quantity, table.path, column, *(unit or ("", 1)), interval, table.step,
                  sorted(zip(begins, numbers.values), key=lambda row: row[0]), keys=keys)
    if table.step <= DAY and meter.is_energy and is_register(meter):
        meter.keys["register"] = "difference"
        meter.series = differences(meter)
        told.check(f"{table.path}: {column}: rises from reading to reading, and was taken for a register")
    if meter.is_hourly and meter.is_energy and has_filled_gaps(meter):
        meter.keys |= {"zeros": "missing", "zero_run": ZERO_RUN}
        meter.series = [(begin, value or None) for begin, value in meter.series]
        told.check(f"{table.path}: {column}: zeros of {ZERO_RUN} h and more were taken for gaps that were filled, "
                   "for it hardly shows a zero otherwise")
    if meter.is_energy:
        tell_negatives(meter, told)
    if meter.is_energy and table.step > DAY and is_register_of_bills(meter):
        if bills or interval == "annual":
            told.check(f"{table.path}: {column}: rises from bill to bill: perhaps what a register shows; expected the "
                       "use of each bill")
        else:
            take_reads(meter, table)
            told.check(f"{table.path}: {column}: rises from read to read, and was taken for a register; register = "
                       "\"keep\" makes each a use")
    if bills:
        ends = ends_of_bills(begins, tables.times_like(table, bills[1]))
        meter.keys |= {"from": bills[0], "to": bills[1]}
        meter.keys.pop("time", None)
        meter.keys.pop("stamp", None)
        if estimated := estimated_column(table):
            meter.keys["estimated"] = estimated
    if ends and not meter.ends:
        meter.ends = [end for end, value in sorted(zip(ends, numbers.values)) if value is not None]
    if not meter.read():
        raise Refused(f"{table.path}: column {column}: has no readings")
    finish_unit(meter, options, told)
    told.say(f"{table.path}: {column}: {quantity} [{meter.unit}{'' if meter.factor == 1 else f' x {meter.factor:g}'}], "
             f"{interval_of(table.step)[1]}, {times.span(meter.first, meter.last)}" +
             (f", {year_use(meter, options.area):.0f} kWh/(m2 a)" if meter.is_energy else ""))
    return meter


def finish_unit(meter, options, told):
    if not meter.is_energy:
        meter.unit = meter.unit or "degC"
        return
    if meter.unit in POWERS and meter.interval in ("monthly", "annual"):
        raise Refused(f"{meter.file}: column {meter.column}: {meter.unit} is a power, but its rows are "
                      f"{meter.interval} bills; write the unit of the energy, --meter FILE:COLUMN:QUANTITY:kWh", USAGE)
    if not meter.unit:
        guess_unit(meter, options, told)
    check_use(meter, options.area, told)


def keys_of_meter(table, numbers, bills, told):
    keys = keys_of(table)
    if numbers.decimal != ".":
        keys["decimal"] = numbers.decimal
    if numbers.thousands:
        keys["thousands"] = numbers.thousands
    if numbers.is_guess:
        told.check(f"{table.path}: numbers such as {numbers.example} were read as "
                   f"{'decimals' if numbers.thousands == 'none' else 'thousands'}")
    if table.is_guess:
        told.check(f"{table.path}: its dates were read as {table.form}, but day and month cannot be told apart")
    if table.step <= DAY:
        keys["gaps"] = "missing"
    elif "stamp" not in keys and are_last_days(table.times):
        keys["stamp"] = "end"                        # last days of months
    elif not bills:
        tell_reads(table, keys, told)
    return keys


def of_converted(made, options, told):
    """The meter of an export's CSV file."""
    if made.doubt:
        told.check(made.doubt)
    table = tables.read_table(made.file, options.country, options.utc_offset)
    meter = make_meter(table, made.column, made.quantity, (made.unit, made.factor), options, told)
    meter.comments.append(f"from {made.says}")
    if "from" in meter.keys:
        meter.keys["estimated"] = "estimated"
    return meter


def meters_in(request, options, told):
    """All of one --meter."""
    if exports.is_green_button(request.file):
        made = exports.of_green_button(request.file, options.converted)
        return [of_converted(each, options, told) for each in made]
    is_workbook = workbook.is_workbook(request.file)
    table = exports.portfolio_sheet(request.file) if is_workbook else \
        tables.read_table(request.file, options.country, options.utc_offset)
    if exports.is_portfolio_manager(table) and (is_workbook or not request.column):
        made = exports.of_portfolio_manager(table, options.converted)
        return [of_converted(each, options, told) for each in made]
    unit = (request.unit, 1) if request.unit else None
    chosen = chosen_columns(table, request)
    if not request.column:
        tell_left_out(table, chosen, told)
    return [make_meter(table, column, quantity, unit, options, told) for column, quantity in chosen]


def tell_left_out(table, chosen, told):
    """Columns with a unit of energy that are no meter of the job."""
    taken = {column for column, _ in chosen}
    left = [name for name in table.values if name not in taken and not table.per_day and
            (unit_of(name) or ("degC",))[0] not in (*TEMPERATURES, *POWERS)]
    if left and len(taken) < len(table.values):
        told.check(f"{table.path}: left out: {', '.join(left)}; --meter {table.path}:COLUMN:QUANTITY:UNIT takes one")


def one_of_each(meters, told):
    """Of an energy one meter, the largest: each is held against all that the building takes of it."""
    kept = []
    for meter in meters:
        if not meter.is_energy:
            kept.append(meter)
            continue
        like = [other for other in meters if other.quantity == meter.quantity]
        largest = max(like, key=lambda other: year_use(other, 1))
        if meter is largest:
            kept.append(meter)
        else:
            told.check(f"{meter.file}: {meter.column}: left out, for {largest.column} of {largest.file} shows more of "
                       f"{meter.quantity}; add them up if both are the building's")
    for k, meter in enumerate(room for room in kept if not room.is_energy):
        meter.name = f"room_{k + 1}" if k else "room"
    return kept
