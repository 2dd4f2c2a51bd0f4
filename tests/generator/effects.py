"""Causes that a modeller may not know of, switched on by name: each changes the drives.

None is on by default. `size` is in the effect's own unit; `apply` changes the drives in place.
"""
from dataclasses import dataclass
from typing import Callable

import numpy as np


@dataclass(frozen=True)
class Effect:
    meaning: str
    size: float
    unit: str
    apply: Callable             # (drives, office, size)


def _heat_island(d, office, size):
    night = (d.hour < 7) | (d.hour >= 19)
    d.theta_e += size * np.where(night, 1.6, 0.4)


def _wind_infiltration(d, office, size):
    d.wind_share *= 1 + size / (0.3 * office.infiltration)


def _exhaust_fan(d, office, size):
    on = d.open_day & (d.hour >= 18) & (d.hour < 21)
    d.extra_air[on] += size
    d.base_load[on] += 0.4 * size * office.volume / 3600 * 1000


def _night_ventilation(d, office, size):
    d.opening[(d.hour < 7) | (d.hour >= 20)] += size


def _window_opening(d, office, size):
    d.opening[d.open_day & (d.hour >= 8) & (d.hour < 19)] += size
    d.opening_above = 23.5


def _saturday_operation(d, office, size):
    on = (d.weekday == 5) & (d.hour >= 7) & (d.hour < 7 + size)
    d.heating_set[on], d.cooling_set[on] = office.heating_set, office.cooling_set
    d.fresh_air[on] = office.fresh_air * office.volume / 3600


def _weekend_setback_missing(d, office, size):
    on = ~d.open_day & (d.hour >= 7) & (d.hour < 19)
    d.heating_set[on] += size * (office.heating_set - d.heating_set[on])
    d.cooling_set[on] += size * (office.cooling_set - d.cooling_set[on])


def _degraded_cop(d, office, size):
    d.cop_factor *= 1 - size * np.maximum(d.elapsed, 0)


def _summer_set_point(d, office, size):
    d.cooling_set[(d.theta_e > 27) & (d.cooling_set < office.cooling_set + 1)] -= size


def _cooling_locked(d, office, size):
    year = d.season_day
    d.cooling_on[(year < size) | (year > 365 - 30)] = 0


def _night_equipment(d, office, size):
    d.equipment[(d.hour < 7) | (d.hour >= 20)] += size * office.floor_area


def _server_heat(d, office, size):
    d.unmetered += size * office.floor_area


def _blinds(d, office, size):
    d.blinds *= 1 - size * d.bright


def _closed_weeks(d, office, size):
    closed = (d.season_day >= 200) & (d.season_day < 200 + 7 * size)
    for name, floor in (("people", 0.0), ("lights", 0.1), ("equipment", 0.3)):
        getattr(d, name)[closed] *= floor
    d.cooling_set[closed] = office.cooling_setback
    d.fresh_air[closed] = 0


def _latent_load(d, office, size):
    d.latent_share = size


def _electricity_step(d, office, size):
    d.meter_factor["electricity"] = np.where(d.elapsed > 0.25, 1 + size, 1.0)


EFFECTS = {
    "heat_island": Effect("air at the building warmer than at the station, most at night", 1.0,
                          "K", _heat_island),
    "wind_infiltration": Effect("leaks that the wind drives", 0.3, "1/h at mean wind",
                                _wind_infiltration),
    "exhaust_fan": Effect("a fan on weekday evenings, 18 to 21 h", 2.0, "1/h", _exhaust_fan),
    "night_ventilation": Effect("windows left open on warm nights", 2.0, "1/h",
                                _night_ventilation),
    "window_opening": Effect("windows opened by day above 23.5 degC", 2.0, "1/h",
                             _window_opening),
    "saturday_operation": Effect("plant runs on Saturdays from 7 h", 6.0, "h",
                                 _saturday_operation),
    "weekend_setback_missing": Effect("weekday set-points on days off, as a share", 1.0, "-",
                                      _weekend_setback_missing),
    "degraded_cop": Effect("cooling COP lost by the end of the period", 0.2, "-", _degraded_cop),
    "summer_set_point": Effect("cooling set-point lowered on hot days", 1.0, "K",
                               _summer_set_point),
    "cooling_locked": Effect("no cooling before this day of the year and in December", 80.0, "d",
                             _cooling_locked),
    "night_equipment": Effect("machines left on at night", 3.0, "W/m2", _night_equipment),
    "server_heat": Effect("heat of machines on somebody else's meter", 2.0, "W/m2",
                          _server_heat),
    "blinds": Effect("blinds drawn where a facade is bright, share of the sun kept out", 0.6,
                     "-", _blinds),
    "closed_weeks": Effect("weeks closed from 20 July", 2.0, "weeks", _closed_weeks),
    "latent_load": Effect("the coil dries the fresh air: share of the moisture removed", 0.8,
                          "-", _latent_load),
    "electricity_step": Effect("electricity meter scaled after a quarter of the period", 0.1,
                               "-", _electricity_step),
}


def apply_effects(drives, office, sizes):
    """`sizes`: name -> size, None = the table's."""
    for name, size in sizes.items():
        effect = EFFECTS[name]
        effect.apply(drives, office, effect.size if size is None else size)
