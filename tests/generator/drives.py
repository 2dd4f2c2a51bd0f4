"""What acts on the building in every 5-minute step: weather, people, machines, controls.

Everything is an array of [n_steps], so that an effect (effects.py) is a change of some of them.
"""
from dataclasses import dataclass, field

import numpy as np

import sun
from office import AZIMUTH, FACADES
from weather import CLIMATES, STEPS_PER_HOUR, season


@dataclass(frozen=True)
class DayNoise:
    """How much days and hours differ from the schedule, as standard deviations of logarithms."""
    people: float = 0.10
    lights: float = 0.04
    equipment: float = 0.06
    hourly: float = 0.05


AVERAGE_DAYS = DayNoise(0, 0, 0, 0)


@dataclass
class Drives:
    theta_e: np.ndarray           # air at the building [degC]
    humidity_ratio: np.ndarray    # [kg/kg]
    open_day: np.ndarray          # whether the calendar's day is a working day
    hour: np.ndarray              # 0 to 24, fractional
    weekday: np.ndarray           # 0 = Monday
    date: np.ndarray              # datetime64[D]
    season_day: np.ndarray        # day of the year, from 0
    bright: np.ndarray            # whether a facade has over 250 W/m2 [n_facades x n_steps]
    elapsed: np.ndarray           # 0 to 1 over the measured period (negative before)
    years: np.ndarray             # since the first measured step (negative before)
    ghi: np.ndarray               # global horizontal irradiance [W/m2]
    theta_ground: np.ndarray      # follows the year a month and a half late [degC]
    seed: int                     # of effects that draw
    climate: str                  # its name
    people: np.ndarray            # [W]
    lights: np.ndarray
    equipment: np.ndarray
    base_load: np.ndarray         # electric, outside the zone [W]
    unmetered: np.ndarray         # heat in the zone that no meter sees [W]
    fresh_air: np.ndarray         # mechanical [m3/s]
    infiltration: np.ndarray      # at no wind and no temperature difference [1/h]
    wind_share: np.ndarray        # added by wind [1/h]
    stack: float                  # added [1/h per K^0.5]
    extra_air: np.ndarray         # outdoor air beside both [1/h]
    recovery: np.ndarray          # heat recovery of the mechanical air [-]
    neighbour: np.ndarray         # conductance to another temperature [W/K]
    theta_neighbour: np.ndarray   # [degC]
    opening: np.ndarray           # windows, when the room is warm and it is cooler outside [1/h]
    opening_above: float          # [degC]
    blinds: np.ndarray            # share of the transmitted sun kept [n_facades x n_steps]
    heating_set: np.ndarray
    cooling_set: np.ndarray
    heating_on: np.ndarray        # 0..1 of the capacity
    cooling_on: np.ndarray
    cop_factor: np.ndarray
    efficiency_factor: np.ndarray  # of the boiler
    gas_use: np.ndarray           # beside heating [W]
    sensor_drift: np.ndarray      # of the air temperature [K]
    sky_factor: float = 1.0       # on the difference of sky and air temperature
    roof_sun: float = 1.0         # on the sun that the roof absorbs
    envelope_factor: float = 1.0  # on the conductance of walls and roof ...
    envelope_from: int = 0        # ... from this step on
    part_load_loss: float = 0.0   # of the boiler at no load [-]
    cop_slope: float = 0.0        # COP lost per kelvin outdoors above 27 degC [1/K]
    reheat: float = 0.0           # heating per cooling [-]
    heating_size: float = 1.0     # on the plant's declared capacity
    cooling_size: float = 1.0
    hours_late: int = 0           # of the meters' clocks
    latent_share: float = 0.0     # of the fresh air's moisture that the cooling coil removes
    meter_factor: dict = field(default_factory=dict)  # meter -> [n_steps]


def by_calendar(schedule, weekday, hour, open_day):
    """A schedule's value for every step; days that are not open count as Sundays."""
    table = np.array([schedule[0]] * 5 + [schedule[1], schedule[2]])
    day = np.where(open_day | (weekday >= 5), weekday, 6)
    return table[day, hour.astype(int)]


def humidity_ratio(theta, relative_humidity):
    pressure = 611.2 * np.exp(17.62 * theta / (243.12 + theta)) * relative_humidity / 100
    return 0.622 * pressure / (101325 - pressure)


def wobble(rng, n_steps, daily, hourly):
    """A factor around 1 for every step: one draw a day times one an hour."""
    n_hours = n_steps // STEPS_PER_HOUR
    logs = np.repeat(daily * rng.standard_normal(n_hours // 24), 24)
    logs = logs + hourly * rng.standard_normal(n_hours)
    return np.repeat(np.exp(logs), STEPS_PER_HOUR)


def ground_temperature(weather):
    """Soil near the surface: the climate's year, 45 days late and weaker [degC]."""
    climate = weather.climate
    winter, _ = season(weather.times - np.timedelta64(45, "D"))
    return climate.t_mean - 0.6 * climate.t_annual * winter


def make_drives(office, weather, noise, seed, measured_from):
    """The drives of an office without any effect."""
    times, n = weather.times, len(weather.times)
    rng = np.random.default_rng([seed, 3])
    days = times.astype("datetime64[D]")
    weekday = (days.astype(int) + 3) % 7
    open_day = (weekday < 5) & ~np.isin(days, np.array(office.holidays, "datetime64[D]"))
    hour = ((times - days) / np.timedelta64(3600, "s")).astype(float)
    follow = lambda use: by_calendar(office.schedules[use], weekday, hour, open_day)
    lively = lambda use, sd: follow(use) * wobble(rng, n, sd, noise.hourly * (sd > 0))
    plant = follow("plant")
    area, still = office.floor_area, np.zeros(n)
    bright = [sum(sun.plane_irradiance(weather, 90.0, AZIMUTH[f])[:2]) > 250 for f in FACADES]
    start = np.datetime64(measured_from, "s")
    return Drives(
        theta_e=weather.theta_e.copy(), hour=hour, weekday=weekday, open_day=open_day,
        date=days, season_day=(days - times.astype("datetime64[Y]")).astype(int),
        bright=np.array(bright),
        humidity_ratio=humidity_ratio(weather.theta_e, weather.relative_humidity),
        elapsed=((times - start) / (times[-1] - start)).astype(float),
        years=(times - start) / np.timedelta64(365 * 24, "h"), ghi=weather.ghi,
        theta_ground=ground_temperature(weather), seed=seed,
        climate=next(name for name, c in CLIMATES.items() if c == weather.climate),
        people=area * office.people * lively("people", noise.people),
        lights=area * office.lights * lively("lights", noise.lights),
        equipment=area * office.equipment * lively("equipment", noise.equipment),
        base_load=np.full(n, area * office.base_load), unmetered=still.copy(),
        fresh_air=follow("fresh_air") * office.fresh_air * office.volume / 3600,
        infiltration=np.full(n, 0.6 * office.infiltration),
        wind_share=0.3 * office.infiltration * weather.wind / weather.climate.wind_mean,
        stack=0.04 * office.infiltration, extra_air=still.copy(), opening=still.copy(),
        recovery=still.copy(), neighbour=still.copy(), theta_neighbour=still.copy(),
        efficiency_factor=np.ones(n), gas_use=still.copy(), sensor_drift=still.copy(),
        opening_above=24.0, blinds=np.ones((4, n)),
        heating_set=office.heating_setback + plant * (office.heating_set - office.heating_setback),
        cooling_set=office.cooling_setback + plant * (office.cooling_set - office.cooling_setback),
        heating_on=np.ones(n), cooling_on=np.ones(n), cop_factor=np.ones(n))
