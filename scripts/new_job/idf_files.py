"""Schedule:File of an EnergyPlus file: a column of numbers by the hour as a week of each part of the year.

Its items have dates and no weekdays: those are the run period's, else such that Monday to Friday are alike. Items of
less than an hour are put together. Source: EnergyPlus Input Output Reference, Schedule:File. Leaves out interpolation,
and whether its hours have summer time.
"""
import datetime
import pathlib

import numpy as np

SEPARATORS = {"comma": ",", "semicolon": ";", "tab": "\t", "space": None}
MONTH_DAYS = (31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31)
WEEKDAYS = ("monday", "tuesday", "wednesday", "thursday", "friday", "saturday", "sunday")
WORKING = 5                    # of them
HOURS, DAYS = 24, 365
LEAP_HOURS, FEBRUARY_29 = 8784, 59   # hours of data of a leap year, and its day from 0


def path_of(thing):
    """Beside the EnergyPlus file, where it is no whole path."""
    return pathlib.Path(thing.file).parent / thing.text("file_name")


def cells_of(thing, n_items):
    """Texts of the column."""
    path, column = path_of(thing), int(thing.number("column_number", 1, 1, 1e6))
    separator = SEPARATORS.get(thing.word("column_separator", "comma"))
    rows = path.read_text(encoding="utf-8-sig", errors="replace").splitlines()
    rows = rows[int(thing.number("rows_to_skip_at_top", 0, 0, 1e6)):][:n_items]
    if len(rows) < n_items:
        thing.refuse("file_name", f"{path} has {len(rows)} rows of numbers; expected {n_items}")
    for row in rows:
        cells = row.split(separator)
        if len(cells) < column:
            thing.refuse("column_number", f"{path}: {row[:60]!r} has no column {column}")
        yield cells[column - 1].strip()


def days_of(thing):
    """(365 or 366, 24) means of each hour."""
    minutes = int(thing.number("minutes_per_item", 60, 1, 60))
    if 60 % minutes:
        thing.refuse("minutes_per_item", f"{minutes} is no part of an hour; expected 60, 30, 15, ...")
    is_leap = thing.number("number_of_hours_of_data", DAYS * HOURS) >= LEAP_HOURS
    n_items = (LEAP_HOURS if is_leap else DAYS * HOURS) * 60 // minutes
    try:
        values = np.array([float(cell) for cell in cells_of(thing, n_items)])
    except OSError as error:
        thing.refuse("file_name", f"{path_of(thing)}: {error.strerror}; expected a file that can be read")
    except ValueError as error:
        thing.refuse("file_name", f"{path_of(thing)}: {error}; expected a number, with a point, in each row")
    if not np.isfinite(values).all():
        thing.refuse("file_name", f"{path_of(thing)} has an item that is no finite number")
    return values.reshape(-1, HOURS, 60 // minutes).mean(axis=2)


def first_weekday(model, days):
    """From Monday, 0: of the run period where it says it, else that by which Monday to Friday are most alike."""
    period = next(iter(model.all("RunPeriod")), None)
    if period and period.text("begin_year"):
        return datetime.date(int(period.number("begin_year", None, 1, 9999)), 1, 1).weekday()
    if period and period.word("day_of_week_for_start_day") in WEEKDAYS:
        before = sum(MONTH_DAYS[:int(period.number("begin_month", 1, 1, 12)) - 1]) + \
            int(period.number("begin_day_of_month", 1, 1, 31)) - 1
        return (WEEKDAYS.index(period.word("day_of_week_for_start_day")) - before) % len(WEEKDAYS)
    return min(range(len(WEEKDAYS)), key=lambda first: unlike(days, first))


def unlike(days, first):
    """How far the means of Monday to Friday are apart."""
    kinds = (first + np.arange(len(days))) % len(WEEKDAYS)
    means = np.array([days[kinds == kind].mean(axis=0) for kind in range(WORKING)])
    return round(float(means.var(axis=0).sum()), 6)


def profile_of(model, thing):
    """(365, 8, 24): of each day the week around it; a holiday is its Sunday."""
    days = days_of(thing)
    kinds = (first_weekday(model, days) + np.arange(len(days))) % len(WEEKDAYS)
    week = np.arange(len(days))[:, None] - kinds[:, None] + np.arange(len(WEEKDAYS))
    week += len(WEEKDAYS) * ((week < 0).astype(int) - (week >= len(days)))   # of the year's ends, the week beside
    profile = days[np.concatenate([week, week[:, -1:]], axis=1)]
    return np.delete(profile, FEBRUARY_29, axis=0) if len(days) > DAYS else profile


def by_month(profile):
    """The mean week of each month."""
    ends = np.cumsum(MONTH_DAYS)
    return np.concatenate([np.broadcast_to(profile[end - n:end].mean(axis=0), (n, *profile.shape[1:]))
                           for end, n in zip(ends, MONTH_DAYS)])
