"""What meters of real buildings showed: hours that are not the declared ones, a country's holidays,
optimum start, and plants of another size than declared.

Each row states beside its size what it drew (`details`), for a size alone does not tell it."""
import numpy as np

from calendars import COUNTRY_OF, holidays_of
from construction import RHO_C_AIR
from effect import IDLE, LOADS, Effect, close, density, rng_of
from weather import STEPS_PER_HOUR

OPENS, CLOSES = 7, 19            # [h], as declared
DAYS = ("weekday", "saturday", "sunday")
SATURDAY, SUNDAY = 5, 6
DAY = 24 * STEPS_PER_HOUR
# --- other hours
EARLIER, LATER = 0.7, 0.7        # odds that the day begins earlier, that it ends later
SATURDAYS, SUNDAYS = 0.4, 0.15   # odds that they are worked
STAFF_AT_WEEKENDS = 0.5          # share of a weekday's
OF_USE = 0.5                     # of the plant's size: people's hours differ less than the plant's
# --- optimum start
BALANCE = 15.0                   # no earlier start after a night that warm [degC]
EARLIEST = 5.0                   # [h] before the declared hour


# --- other hours

def half_hour(x):
    return round(2 * x) / 2


def drawn_span(rng, size):
    """(begin, end) of a weekday: both ends together are `size` hours off."""
    at_begin = half_hour(size * rng.uniform(0.2, 0.8))
    at_end = half_hour(size) - at_begin
    return (OPENS + at_begin * rng.choice((-1, 1), p=(EARLIER, 1 - EARLIER)),
            CLOSES + at_end * rng.choice((1, -1), p=(LATER, 1 - LATER)))


def drawn_weekend(rng, odds):
    """(begin, end), or None of a day off."""
    begin, length, is_worked = rng.integers(7, 10), rng.integers(4, 10), rng.random() < odds
    return (float(begin), float(begin + length)) if is_worked else None


def hours_of(d, size):
    """{"plant" and "use": {day class: (begin, end) or None}}; each is off by hours of its own."""
    rng = rng_of(d)
    weekend = {"saturday": drawn_weekend(rng, SATURDAYS), "sunday": drawn_weekend(rng, SUNDAYS)}
    return {who: {"weekday": drawn_span(rng, share * size), **weekend}
            for who, share in (("plant", 1.0), ("use", OF_USE))}


def of_the_day(d):
    """Row of DAYS at every step; -1 on days that are declared closed."""
    return np.where(d.weekday >= SATURDAY, d.weekday - SATURDAY + 1, np.where(d.open_day, 0, -1))


def followed(d, weekday, idle, spans, share):
    """A weekday's schedule whose open hours are stretched to each day class's span."""
    now, day = np.full(len(d.hour), idle), of_the_day(d)
    for row, name in enumerate(DAYS):
        if spans[name]:
            on = day == row
            begin, end = spans[name]
            hour = np.interp(d.hour[on], (0, begin, end, 24), (0, OPENS, CLOSES, 24))
            part = 1.0 if row == 0 else share
            now[on] = idle + part * (weekday[hour.astype(int)] - idle)
    return now


def change(d, office, use, spans, share):
    """What the new hours add to the declared ones, as a share of full."""
    weekday = np.array(office.schedules[use][0])
    idle = IDLE.get(use, 0.0)
    declared = dict(zip(DAYS, ((OPENS, CLOSES), None, None)))
    return followed(d, weekday, idle, spans, share) - followed(d, weekday, idle, declared, share)


def _other_hours(d, office, size):
    hours = hours_of(d, size)
    for use in LOADS:
        series = getattr(d, use)
        more = density(d, office, use) * change(d, office, use, hours["use"], STAFF_AT_WEEKENDS)
        setattr(d, use, np.maximum(series + more, 0))
    plant = change(d, office, "plant", hours["plant"], 1.0)
    d.heating_set += plant * (office.heating_set - office.heating_setback)
    d.cooling_set += plant * (office.cooling_set - office.cooling_setback)
    d.fresh_air += plant * office.fresh_air * office.volume / 3600


def _hours_details(d, office, size):
    return hours_of(d, size) | {"declared": {"weekday": (OPENS, CLOSES)}}


# --- holidays

def _moving_holidays(d, office, size):
    close(d, office, np.isin(d.date, holidays_of(d.climate)), size)


def _holidays_details(d, office, size):
    days = holidays_of(d.climate)
    there = days[np.isin(days, d.date[d.years >= 0])]
    return {"country": COUNTRY_OF[d.climate], "days": [str(day) for day in there]}


# --- optimum start

def lead(d, size):
    """Hours before the declared one at which the day's heating begins: by the night's mean [h]."""
    night = d.theta_e.reshape(-1, DAY)[:, :4 * STEPS_PER_HOUR].mean(axis=1)
    return np.repeat(np.clip(size / 60 * (BALANCE - night), 0, EARLIEST), DAY)


def _optimum_start(d, office, size):
    on = d.open_day & (d.hour >= OPENS - lead(d, size)) & (d.hour < OPENS)
    d.heating_set[on] = np.maximum(d.heating_set[on], office.heating_set)


def _start_details(d, office, size):
    return {"minutes_per_K": size, "below_C": BALANCE, "at_most_h": EARLIEST}


# --- a plant of another size

def steady_load(d, office):
    """Heat lost at the set-point on the coldest day, without any gain [W/m2]."""
    walls = sum(office.facade_area(f) * ((1 - share) * office.u_wall + share * office.u_window)
                for f, share in office.window_share.items())
    air = RHO_C_AIR * (office.infiltration + office.fresh_air) * office.volume / 3600
    coldest = d.theta_e.reshape(-1, DAY).mean(axis=1).min()
    loss = walls + office.footprint * office.u_roof + air
    return float(max(loss * (office.heating_set - coldest), 0) / office.floor_area)


def oversized(d, office, size):
    return size * max(office.heating_capacity, steady_load(d, office))


def undersized(d, office, size):
    return (1 - size) * min(office.heating_capacity, steady_load(d, office))


def _oversized_plant(d, office, size):
    d.heating_size *= oversized(d, office, size) / office.heating_capacity
    d.cooling_size *= size


def _undersized_plant(d, office, size):
    d.heating_size *= undersized(d, office, size) / office.heating_capacity


def sized(capacity):
    """[declared, true] in W/m2."""
    def details(d, office, size):
        return {"heating_capacity": [office.heating_capacity, capacity(d, office, size)]}
    return details


EFFECTS = {
    "other_hours": Effect("plant and use run other hours than declared: begin and end of the plant's "
                          "weekday are together so many hours off, weekends may be worked", 3.0, "h",
                          _other_hours, 1.5, 5, details=_hours_details),
    "moving_holidays": Effect("closed on a country's public holidays, of which most move from year "
                              "to year, as a share", 1.0, "-", _moving_holidays, 0.8, 1,
                              details=_holidays_details),
    "optimum_start": Effect("heating begins earlier the colder the night", 8.0, "min/K",
                            _optimum_start, 5, 15, details=_start_details),
    "oversized_plant": Effect("capacities are so many times what is declared or needed, whichever "
                              "is more: they never bind", 2.5, "-", _oversized_plant, 2, 4,
                              details=sized(oversized)),
    "undersized_plant": Effect("heating capacity lacks so much of the declared one or of the loss on "
                               "the coldest day, whichever is less: it binds on cold days", 0.4,
                               "-", _undersized_plant, 0.25, 0.5, details=sized(undersized)),
}
