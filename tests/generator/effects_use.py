"""Effects of people, machines and the calendar."""
import numpy as np

from effect import (IDLE, LOADS, PLANT, Effect, close, days_of_year, density, run_plant, shift,
                    stepped, workday)
from weather import STEPS_PER_HOUR

SINGLE_DAYS = (0, 96, 120, 121, 161, 212, 226, 304, 305, 359, 360, 361)  # of the year
FRIDAY, SATURDAY = 4, 5


def _unmetered_people(d, office, size):
    d.unmetered += size * office.floor_area * d.people / max(d.people.max(), 1)


def _server_heat(d, office, size):
    d.unmetered += size * office.floor_area


def _weekend_use(d, office, size):
    on = d.weekday >= SATURDAY
    for use in LOADS:
        full = density(d, office, use)
        getattr(d, use)[on] += size * full * (workday(d, office, use) - IDLE[use])[on]


def _saturday_operation(d, office, size):
    on = (d.weekday == SATURDAY) & (d.hour >= 7) & (d.hour < 7 + size)
    run_plant(d, office, on)


def _four_day_week(d, office, size):
    close(d, office, d.weekday == FRIDAY, size)


def _single_holidays(d, office, size):
    close(d, office, np.isin(d.season_day, SINGLE_DAYS[:round(size)]))


def _closed_weeks(d, office, size):
    close(d, office, days_of_year(d, 200, 200 + int(7 * size)))


def _occupancy_trend(d, office, size):
    for use in LOADS:
        setattr(d, use, getattr(d, use) * (1 + size * np.clip(d.years, 0, None)))


def _occupancy_step(d, office, size):
    for use in LOADS:
        getattr(d, use)[stepped(d)] *= 1 + size


def _evening_load(d, office, size):
    d.equipment[(d.hour >= 18) & (d.hour < 22)] += size * office.floor_area


def _night_equipment(d, office, size):
    d.equipment[(d.hour < 7) | (d.hour >= 20)] += size * office.floor_area


def _schedule_shift(d, office, size):
    shift(d, round(size * STEPS_PER_HOUR), LOADS + PLANT)


def _summer_time(d, office, size):
    shift(d, -round(size * STEPS_PER_HOUR), LOADS + PLANT, days_of_year(d, 86, 303))


EFFECTS = {
    "unmetered_people": Effect("more people than declared, at their hours", 5.0, "W/m2",
                               _unmetered_people, 2, 8),
    "server_heat": Effect("heat of machines on somebody else's meter", 2.0, "W/m2",
                          _server_heat, 1, 6),
    "weekend_use": Effect("people at work at weekends, as a share of weekdays", 0.4, "-",
                          _weekend_use, 0.2, 0.6),
    "saturday_operation": Effect("plant runs on Saturdays from 7 h", 6.0, "h",
                                 _saturday_operation, 3, 10),
    "four_day_week": Effect("Fridays off, as a share", 0.8, "-", _four_day_week, 0.5, 1),
    "single_holidays": Effect("days off that are no declared holidays, every year", 9.0, "d",
                              _single_holidays, 4, 12),
    "closed_weeks": Effect("weeks closed from 20 July", 2.0, "weeks", _closed_weeks, 1, 4),
    "occupancy_trend": Effect("more of everybody and everything every year", 0.25, "1/a",
                              _occupancy_trend, 0.12, 0.4, True),
    "occupancy_step": Effect("more of everybody and everything from a day of the first year",
                             0.25, "-", _occupancy_step, 0.15, 0.4, True),
    "evening_load": Effect("machines on from 18 to 22 h", 3.0, "W/m2", _evening_load, 1, 5),
    "night_equipment": Effect("machines left on at night", 3.0, "W/m2", _night_equipment, 1, 4),
    "schedule_shift": Effect("everything comes later than declared", 1.0, "h", _schedule_shift,
                             0.5, 2, True),
    "summer_time": Effect("people follow summer time, which is not declared", 1.0, "h",
                          _summer_time, 1, 1),
}
