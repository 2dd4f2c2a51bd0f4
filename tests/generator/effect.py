"""What an effect is, and the ways in which effects change the drives."""
from dataclasses import dataclass
from typing import Callable

import numpy as np

from drives import by_calendar

LOADS = ("people", "lights", "equipment")
PLANT = ("fresh_air", "heating_set", "cooling_set")
NO_HANDLER = "no air handler"    # of an effect that a handler brings with it
IDLE = {"people": 0.0, "lights": 0.05, "equipment": 0.2}  # of the density, on days off


@dataclass(frozen=True)
class Effect:
    """`size` is a middling one, in the effect's own unit; a draw is uniform on [least, most]."""
    meaning: str
    size: float
    unit: str
    apply: Callable             # (drives, office, size): changes the drives in place
    least: float = None
    most: float = None
    either_sign: bool = False
    needs: str = ""             # "boiler", "heat pump" or NO_HANDLER, where it takes one
    details: Callable = None    # (drives, office, size): {what it drew}, where a size does not tell

    def draw(self, rng):
        """A size from the plausible range."""
        size = rng.uniform(self.least, self.most)
        return float(size * rng.choice([-1, 1])) if self.either_sign else float(size)

    def fits(self, office):
        return self.needs in ("", office.heat_source, NO_HANDLER if not office.air_system else "")


def night(d):
    return (d.hour < 7) | (d.hour >= 19)


def days_of_year(d, first, last):
    """Days first .. last - 1 of the year, through New Year where last is before first."""
    day = d.season_day
    return (day >= first) & (day < last) if first < last else (day >= first) | (day < last)


def density(d, office, use):
    """Full power [W]."""
    return getattr(office, use) * office.floor_area


def close(d, office, on, share=1.0):
    """Empty rooms, plant set back, as a share."""
    for use in LOADS:
        series = getattr(d, use)
        series[on] += share * (IDLE[use] * density(d, office, use) - series[on])
    for name, value in (("fresh_air", 0.0), ("heating_set", office.heating_setback),
                        ("cooling_set", office.cooling_setback)):
        series = getattr(d, name)
        series[on] += share * (value - series[on])


def workday(d, office, use):
    """What the schedule says of a weekday, at every step's hour."""
    everywhere = np.ones(len(d.hour), bool)
    return by_calendar(office.schedules[use], np.zeros(len(d.hour), int), d.hour, everywhere)


def run_plant(d, office, on):
    """Set-points and fresh air as on weekdays by day."""
    d.heating_set[on], d.cooling_set[on] = office.heating_set, office.cooling_set
    d.fresh_air[on] = office.fresh_air * office.volume / 3600


def add_neighbour(d, conductance, theta):
    """Heat exchange with another temperature, beside what is there [W/K, degC]."""
    total = d.neighbour + conductance
    there = total > 0
    d.theta_neighbour[there] = ((d.neighbour * d.theta_neighbour + conductance * theta)
                                / np.where(there, total, 1))[there]
    d.neighbour = total


def shift(d, steps, names, when=None):
    """The schedules come so many 5-minute steps later, where `when`."""
    for name in names:
        later = np.roll(getattr(d, name), steps)
        setattr(d, name, later if when is None else np.where(when, later, getattr(d, name)))


def rng_of(d):
    return np.random.default_rng([d.seed, 7])


def stepped(d):
    """Whether the day is past on which things changed, some months into the first year."""
    return d.years > rng_of(d).uniform(0.3, 0.7)


def scale_meter(d, meter, factor):
    d.meter_factor[meter] = d.meter_factor.get(meter, 1.0) * factor
