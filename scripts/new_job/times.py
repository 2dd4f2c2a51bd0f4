"""Forms of time stamps: which one all cells have, and the times that they say.

Without a form the program reads ISO 8601 and what else has its year first; every other form is written into the job as
`time_format` (strptime). Day and month are told apart by days above 12, else by the country.
"""
import datetime as dt
import re

ISO = re.compile(r"(\d{4}-\d\d-\d\d)(?:[ T](\d\d):(\d\d)(?::(\d\d)(?:[.,]\d+)?)?)?\s*(Z|[+-]\d\d(?::?\d\d)?)?$")
YEAR_FIRST = ("%Y-%m-%d %H:%M", "%Y-%m-%d %H:%M:%S", "%Y/%m/%d", "%Y/%m/%d %H:%M", "%Y/%m/%d %H:%M:%S",
              "%Y%m%dT%H%M", "%Y%m%dT%H%M%S", "%Y%m%d:%H%M", "%Y%m%d %H:%M")
DATES = ("%d.%m.%Y", "%d/%m/%Y", "%m/%d/%Y", "%d-%m-%Y", "%m-%d-%Y", "%d-%b-%Y", "%d %b %Y", "%b %d, %Y", "%d.%m.%y",
         "%d/%m/%y", "%m/%d/%y", "%Y.%m.%d", "%Y%m%d")
CLOCKS = ("", " %H:%M", " %H:%M:%S", " %I:%M %p", " %I:%M:%S %p", "T%H:%M", ", %H:%M", " %H:%M %z", " %H:%M%z",
          " %H:%M:%S %z", " %H:%M:%S%z")
MONTHS = ("%Y-%m", "%Y/%m", "%m/%Y", "%m.%Y", "%b %Y", "%B %Y", "%b-%Y", "%b-%y", "%b %y")
NAMED_ZONES = ("%Y-%m-%d %H:%M %Z", "%Y-%m-%d %H:%M:%S %Z")   # UTC and GMT, which Python knows anywhere
OTHER_FORMS = (*(date + clock for date in DATES for clock in CLOCKS), *MONTHS, *NAMED_ZONES)
MONTH_FIRST = ("US", "PH")
HOUR = dt.timedelta(hours=1)
SAMPLE = 60                    # cells that have to have a form before all are asked


def read_iso(text):
    match = ISO.match(text)
    if not match:
        raise ValueError(text)
    day, hour, minute, second, offset = match.groups()
    time = dt.datetime.fromisoformat(day) + dt.timedelta(hours=int(hour or 0), minutes=int(minute or 0),
                                                         seconds=int(second or 0))
    if offset and offset != "Z":
        sign = -1 if offset[0] == "-" else 1
        digits = offset[1:].replace(":", "").ljust(4, "0")
        time -= sign * dt.timedelta(hours=int(digits[:2]), minutes=int(digits[2:]))
    return time


def read_form(form):
    """24:00 is the next day's begin, as the program reads it."""
    def read(text):
        late = re.search(r"\b24:00", text)
        time = dt.datetime.strptime(text.replace("24:00", "00:00") if late else text, form)
        if time.tzinfo:
            time = time.astimezone(dt.timezone.utc).replace(tzinfo=None)
        return time + dt.timedelta(days=1) if late else time
    return read


def has_offset(text):
    match = ISO.match(text.strip())
    return bool(match and match.group(5))


def all_read(read, cells):
    try:
        return [read(cell.strip()) for cell in cells]
    except ValueError:
        return None


def read_times(cells, country=""):
    """(form, times, whether day and month were guessed) of cells that are all times; None where they are not. The form
    is "" where the program needs none."""
    cells = [cell for cell in cells if cell.strip()]
    if len(cells) < 2:
        return None
    for form, read in (("", read_iso), *(("", read_form(form)) for form in YEAR_FIRST)):
        if all_read(read, cells[:SAMPLE]) and (times := all_read(read, cells)):
            return form, times, False
    possible = []
    for form in OTHER_FORMS:
        read = read_form(form)
        if all_read(read, cells[:SAMPLE]) and (times := all_read(read, cells)):
            possible.append((form, times))
    if not possible:
        return None
    first_is_month = country in MONTH_FIRST
    possible.sort(key=lambda row: row[0].startswith("%m") != first_is_month)
    return *possible[0], len(possible) > 1


def step_of(times):
    """Median step [s], of whole minutes: clocks of loggers wander."""
    ordered = sorted(set(times))
    steps = sorted((b - a).total_seconds() for a, b in zip(ordered, ordered[1:]))
    return max(60, round(steps[len(steps) // 2] / 60) * 60) if steps else 0


def span(first, last):
    """First and last day, from a begin and an end."""
    return f"{first:%Y-%m-%d} to {last - dt.timedelta(seconds=1):%Y-%m-%d}"


def change_days(rule, year):
    """Day in spring on which clocks go forward, in the European Union or the United States."""
    if rule == "eu":
        last = dt.date(year, 3, 31)
        return last - dt.timedelta(days=(last.weekday() + 1) % 7)
    first = dt.date(year, 3, 1)
    return first + dt.timedelta(days=(6 - first.weekday()) % 7 + 7)


def clock_of(times):
    """"eu" or "us" where an hour is absent in spring by that rule, which only a wall clock does; else None. Times of
    whole hours or finer."""
    days = {}
    for time in times:
        days.setdefault(time.date(), set()).add(time.hour)
    for rule in ("eu", "us"):
        seen = [days[day] for year in range(min(days).year, max(days).year + 1)
                if (day := change_days(rule, year)) in days]
        short = sum(len(hours) == 23 and bool({1, 2, 3} - hours) for hours in seen)
        if short and short * 2 > len(seen):
            return rule
    return None
