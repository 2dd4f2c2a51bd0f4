"""Schedules of an EnergyPlus file as numbers by day of the year, kind of day and hour.

A profile is an array (365, 8, 24): days of the year, Monday to Sunday and holidays, hours. Source: EnergyPlus Input
Output Reference, Group Schedules. Leaves out design days, custom days and 29 February.
"""
import re

import numpy as np

from new_job import idf_files
from new_job.idf import number_of
from new_job.idf_fields import MONTHS
from new_job.idf_files import MONTH_DAYS

DAYS, KINDS, HOURS = 365, 8, 24
MOST_RUNS = 26                 # parts of the year with schedules of their own; more are one mean
KIND_OF = {"monday": 0, "tuesday": 1, "wednesday": 2, "thursday": 3, "friday": 4, "saturday": 5, "sunday": 6,
           "holiday": 7}
GROUPS = {"weekdays": range(5), "weekday": range(5), "weekends": (5, 6), "weekend": (5, 6), "alldays": range(KINDS)}
NOT_USED = ("summerdesignday", "winterdesignday", "customday1", "customday2")
MINUTES = 24 * 60


def constant(value):
    return np.full((DAYS, KINDS, HOURS), float(value))


def day_of_year(thing, key, month, day):
    """From 0; 29 February is the 28th."""
    if not 1 <= month <= 12 or not 1 <= day <= 31:
        thing.refuse(key, f"{month}/{day} is no date; expected month/day")
    return sum(MONTH_DAYS[:month - 1]) + min(day, MONTH_DAYS[month - 1]) - 1


def date_of(thing, key, said):
    """Day of the year from 0 of month/day, or of a day and a month's name in any order."""
    numbers = re.match(r"\s*(\d+)\s*/\s*(\d+)", said)
    if numbers:
        return day_of_year(thing, key, int(numbers[1]), int(numbers[2]))
    words = re.fullmatch(r"\s*(?:(\d+)\s*([a-z]{3,})|([a-z]{3,})\s*(\d+))\s*", said.lower())
    month = next((k for k, name in enumerate(MONTHS, 1) if words and name.startswith(words[2] or words[3])), None)
    if month is None:
        thing.refuse(key, f"Through: {said!r} is no date; expected month/day, as 3/31, or 31 March")
    return day_of_year(thing, key, month, int(words[1] or words[4]))


def days_between(first, last):
    """Days of the year from one to another, both included, over New Year where the last comes before."""
    return np.arange(first, last + 1 if last >= first else last + 1 + DAYS) % DAYS


def minute(thing, key, said):
    match = re.fullmatch(r"(\d{1,2}):(\d{1,2})", said.strip())
    if not match or int(match[1]) * 60 + int(match[2]) > MINUTES:
        thing.refuse(key, f"{said!r} is no time; expected hours:minutes up to 24:00")
    return int(match[1]) * 60 + int(match[2])


def kinds_of(thing, key, said, taken):
    """Kinds of day that a "For:" names; AllOtherDays are those that none named before. Words that are no kind beside
    one that is are passed over, as EnergyPlus does: DOE's small office of ASHRAE 90.1 has "Weedends WinterDesignDay".
    """
    found, unknown = set(), []
    words = said.lower().replace(",", " ").split()
    for word in words:
        if word == "allotherdays":
            found |= set(range(KINDS)) - taken
        elif word in GROUPS:
            found |= set(GROUPS[word])
        elif word.removesuffix("s") in KIND_OF:
            found.add(KIND_OF[word.removesuffix("s")])
        elif word not in NOT_USED:
            unknown.append(word)
    if unknown and len(unknown) == len(words):
        thing.refuse(key, f"{unknown[0]!r} is no kind of day; expected AllDays, Weekdays, Weekends, Monday, ...")
    return found


def hours_until(thing, key, steps):
    """24 means of [(minute, value until it)]."""
    values, begin = np.zeros(MINUTES), 0
    for end, value in steps:
        values[begin:end] = value
        begin = max(begin, end)
    if begin < MINUTES:
        thing.refuse(key, f"ends at {begin // 60}:{begin % 60:02}; expected values until 24:00")
    return values.reshape(HOURS, 60).mean(axis=1)


class CompactReader:
    """Through, For and Until lines, one after the other."""

    def __init__(self, thing):
        self.thing, self.profile = thing, constant(np.nan)
        self.days, self.next = np.arange(0), 0
        self.kinds, self.taken, self.steps, self.until = set(), set(), [], None

    def close_day(self):
        if self.steps and self.kinds:
            hours = hours_until(self.thing, "data", self.steps)
            self.profile[np.ix_(self.days, sorted(self.kinds))] = hours
        self.steps = []

    def read(self, said):
        word, _, rest = said.partition(":")
        word = word.strip().lower()
        if word.startswith("through"):
            self.through(said[len("through"):].lstrip(": "))
        elif word.startswith("for"):
            self.close_day()
            self.kinds = kinds_of(self.thing, said, said[len("for"):].lstrip(": "), self.taken)
            self.taken |= self.kinds
        elif word.startswith("until"):
            self.until = minute(self.thing, said, said[len("until"):].lstrip(": "))
        elif word.startswith("interpolate"):
            pass
        elif self.until is None:
            self.thing.refuse("data", f"{said!r} stands where Through:, For: or Until: is expected")
        else:
            self.steps.append((self.until, number_of(self.thing, "data", said)))
            self.until = None

    def through(self, said):
        self.close_day()
        last = date_of(self.thing, "data", said)
        self.days, self.next = days_between(self.next, last), (last + 1) % DAYS
        self.kinds, self.taken = set(), set()


def without_holes(thing, profile):
    """Holidays that none names are Sundays; other days have to be there."""
    profile[:, 7] = np.where(np.isnan(profile[:, 7]), profile[:, 6], profile[:, 7])
    if np.isnan(profile).any():
        day = int(np.argwhere(np.isnan(profile).any(axis=(1, 2)))[0, 0])
        thing.refuse("data", f"has no values on day {day + 1} of the year for some kind of day; expected all days, "
                             "as by For: AllOtherDays")
    return profile


def compact(model, thing):
    reader = CompactReader(thing)
    if any(said.lower().replace(" ", "") == "interpolate:linear" for (said,) in thing.rest):
        model.checks.append(f'{thing.kind} "{thing.name}": Interpolate: Linear: its values were taken to hold until '
                            "their times")
    for (said,) in thing.rest:
        if said:
            reader.read(said)
    reader.close_day()
    return without_holes(thing, reader.profile)


def year(model, thing):
    profile = constant(np.nan)
    for week_name, *dates in (group for group in thing.rest if group[0]):
        if len(dates) != 4:
            thing.refuse("schedule_weeks", f"{week_name!r} has no four numbers of dates behind it; expected start "
                                           "month and day, end month and day")
        begin_month, begin_day, end_month, end_day = (int(number_of(thing, "schedule_weeks", said)) for said in dates)
        first = day_of_year(thing, "schedule_weeks", begin_month, begin_day)
        last = day_of_year(thing, "schedule_weeks", end_month, end_day)
        week = model.find(week_name, "Schedule:Week:Daily", "Schedule:Week:Compact")
        if week is None:
            thing.refuse("schedule_weeks", f"names {week_name!r}, which is not in the file; expected the name of a "
                                           "Schedule:Week:Daily or Schedule:Week:Compact")
        profile[days_between(first, last)] = week_of(model, week)
    return without_holes(thing, profile)


def week_of(model, week):
    """(8, 24)"""
    values = np.full((KINDS, HOURS), np.nan)
    if week.kind.lower() == "schedule:week:daily":
        for word in KIND_OF:
            key = f"{word}_schedule_day_name"
            values[KIND_OF[word]] = day_of(model, model.need(week, key, *DAY_CLASSES))
        return values
    taken = set()
    for said, name in week.rest:
        kinds = kinds_of(week, "daytype_list", re.sub(r"^\s*for\b:?", "", said, flags=re.I), taken)
        taken |= kinds
        day = model.find(name, *DAY_CLASSES)
        if day is None:
            week.refuse("data", f"names {name!r}, which is not in the file; expected the name of a Schedule:Day:Hourly")
        values[sorted(kinds)] = day_of(model, day)
    return values


DAY_CLASSES = ("Schedule:Day:Hourly", "Schedule:Day:Interval", "Schedule:Day:List")


def day_of(_, day):
    """24 values."""
    kind = day.kind.lower()
    if kind == "schedule:day:hourly":
        return [day.number(f"hour_{hour}", 0) for hour in range(1, HOURS + 1)]
    if kind == "schedule:day:list":
        step = int(day.number("minutes_per_item", 60, 1, 60))
        return hours_until(day, "values", [(step * (k + 1), number_of(day, "values", said))
                                           for k, (said,) in enumerate(day.rest)])
    flat = [said for group in day.rest for said in group]
    times = [re.sub(r"^\s*until\s*:?\s*", "", said, flags=re.I) for said in flat[::2]]
    return hours_until(day, "data", [(minute(day, "time", time), number_of(day, "data", value))
                                     for time, value in zip(times, flat[1::2])])


def of_file(model, thing):
    """None where the file is not there. A year whose weeks differ too often has the mean week of each month."""
    if not idf_files.path_of(thing).is_file():
        return None
    profile = idf_files.profile_of(model, thing)
    n_runs = len(runs_of(profile))
    if n_runs <= MOST_RUNS:
        return profile
    model.checks.append(f'{thing.kind} "{thing.name}": its weeks change {n_runs - 1} times a year; the mean week of '
                        "each month was taken")
    return idf_files.by_month(profile)


READERS = {"Schedule:Compact": compact, "Schedule:Year": year, "Schedule:File": of_file,
           "Schedule:Constant": lambda _, thing: constant(thing.number("hourly_value", 0))}
# What a schedule is taken for whose file is not there, in degC, W (a person who sits and works: 1.1 met of ISO 7730)
# and types of control (both set-points); others are 1. Set-points are the use's.
USUAL = {("people", "activity_level_schedule_name"): 120,
         ("zonecontrol:thermostat", "control_type_schedule_name"): 4,
         ("waterheater:mixed", "setpoint_temperature_schedule_name"): 60,
         ("waterheater:mixed", "ambient_temperature_schedule_name"): 20,
         ("wateruse:equipment", "target_temperature_schedule_name"): 43,
         ("wateruse:equipment", "hot_water_supply_temperature_schedule_name"): 60,
         ("wateruse:equipment", "cold_water_supply_temperature_schedule_name"): 10,
         ("site:watermainstemperature", "temperature_schedule_name"): 10}
HEATING_OF = (("thermostatsetpoint:dualsetpoint", "heating_setpoint_temperature_schedule_name"),
              ("thermostatsetpoint:singleheating", "setpoint_temperature_schedule_name"),
              ("thermostatsetpoint:singleheatingorcooling", "setpoint_temperature_schedule_name"),
              ("hvactemplate:thermostat", "heating_setpoint_schedule_name"))
COOLING_OF = (("thermostatsetpoint:dualsetpoint", "cooling_setpoint_temperature_schedule_name"),
              ("thermostatsetpoint:singlecooling", "setpoint_temperature_schedule_name"),
              ("hvactemplate:thermostat", "cooling_setpoint_schedule_name"))
USUAL_SET_POINTS = (20, 26)    # degC, EnergyPlus's of its templates


class Schedules:
    """Profiles by name, each read once; one whose file is not there is as usual, and told."""

    def __init__(self, model, set_points=USUAL_SET_POINTS):
        """`set_points`: heating's and cooling's, usual of the use."""
        self.model, self.known = model, {}
        self.shares_controlled = {}    # {name: what idf_use finds of a schedule of types of control}
        self.usual = USUAL | dict.fromkeys(HEATING_OF, set_points[0]) | dict.fromkeys(COOLING_OF, set_points[1])

    def of(self, thing, key):
        """1 at all hours where the field is empty."""
        name = thing.text(key)
        if not name:
            return constant(1)
        if name.lower() not in self.known:
            self.known[name.lower()] = self.read(thing, key, name)
        found = self.known[name.lower()]
        return self.without_file(thing, key, name) if found is None else found

    def without_file(self, thing, key, name):
        field = thing.kind.lower(), key
        usual = self.usual.get(field, 1)
        says = ", usual of the use," if field in (*HEATING_OF, *COOLING_OF) else ""
        path = idf_files.path_of(self.model.find(name, "Schedule:File"))
        self.model.checks.append(f'{thing.kind}: {key}: {path}, which Schedule:File "{name}" reads, is no file; '
                                 f"{usual:g}{says} was taken")
        return constant(usual)

    def read(self, thing, key, name):
        found = self.model.find(name, *READERS)
        if found is not None:
            return next(read for kind, read in READERS.items() if kind.lower() == found.kind.lower())(self.model, found)
        thing.refuse(key, f"names {name!r}, which is not in the file; expected the name of a schedule")


def runs_of(profile):
    """[(first day, last day, (8, 24))] of alike days, from 0."""
    changes = [day for day in range(1, DAYS) if not np.allclose(profile[day], profile[day - 1], atol=1e-6)]
    return [(a, b - 1, profile[a]) for a, b in zip([0, *changes], [*changes, DAYS])]
