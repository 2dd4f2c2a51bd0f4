"""Paper 2's school room: walls of many nodes, a radiator and a heating curve of its own.

A room of brick between rooms of the same school, whose temperature is measured. Its radiator is
a row of elements, stepped by Euler's method; its water is at a theta_e + b in the hours of the
schedule while it is cold outside, else at c; outside these hours it is off, or at d where the
room is below 14 degC. Pupils come by the register; they open windows and draw blinds in their
own way in spring and in autumn. `drawn_school` draws what a calibration looks for.
"""
from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np

from construction import RHO_C_AIR, Element, Window, make_network
from meters import red
from simulate import Zone, source_rows
from weather import STEP_S, STEPS_PER_HOUR, synthetic_weather

FIRST_DAY, N_DAYS = "2013-03-12", 302       # until 7 January
MEASURED_FROM = np.datetime64("2013-04-11")  # the days before settle the room
FLOOR_AREA, VOLUME = 70.0, 230.0
SOUTH = (90.0, 180.0)
WALL = [("plaster", 0.02), ("brick", 0.38), ("plaster", 0.02)]
FILM = ("insulation", 0.005)                  # of the other room, about 1/8 m2 K/W
INNER_WALL = [FILM, ("plaster", 0.015), ("brick", 0.12), ("plaster", 0.015)]
CEILING = [FILM, ("screed", 0.05), ("hollow concrete", 0.24), ("plaster", 0.01)]
FLOOR = [FILM, ("plaster", 0.01), ("hollow concrete", 0.24), ("screed", 0.05)]
WATER = 4184.0                               # [J/(kg K)]
ELEMENTS, SUB_STEPS = 6, 12                  # of the radiator, in a step of the room
BRIDGES = 3.0                                # [W/K], to outdoors
CLOSED = 0.1                                 # share of the sun that drawn blinds let in
CLOSED_DAYS = (("2013-06-10", "2013-09-12"), ("2013-10-26", "2013-11-04"),
               ("2013-12-21", "2014-01-07"), ("2013-04-26", "2013-05-03"))
HEATED_DAYS = (("2013-10-15", "2014-04-16"),)
SUMMER = ("2013-04-16", "2013-10-15")        # pupils' habits of spring

RANGES = {"a": (-1.28, -0.94), "b": (47.0, 62.0), "c": (37.0, 50.0), "d": (18.5, 25.5),
          "nominal_power": (2600, 5200), "exponent": (1.29, 1.37),
          "radiator_capacity": (110e3, 400e3), "radiative_fraction": (0.25, 0.38),
          "maximum_flow": (0.03, 0.055), "infiltration": (0.2, 0.3),
          "air_change_spring": (0.9, 2.6), "air_change_autumn": (0.9, 2.6),
          "shading_spring": (0.2, 0.8), "shading_autumn": (0.2, 0.8)}


@dataclass
class School:
    """The truth by name, in the units of the job's parameters."""
    truth: dict
    seed: int
    air_multiplier: float = 8.0              # of the air's capacity, for what stands in it
    elements: list = field(default_factory=lambda: [
        Element("wall", 22.0, WALL, SOUTH, absorptance=0.4, sun_share=0.03),
        Element("inner walls", 75.0, INNER_WALL, ground=True, sun_share=0.15),
        Element("ceiling", FLOOR_AREA, CEILING, ground=True, sun_share=0.05),
        Element("floor", FLOOR_AREA, FLOOR, ground=True, sun_share=0.45)])
    windows: list = field(default_factory=lambda: [
        Window("windows", 12.0, SOUTH, 2.7, 0.7, frame=0.2)])


def drawn_school(seed):
    rng = np.random.default_rng([seed, 41])
    return School({name: float(rng.uniform(*ends)) for name, ends in RANGES.items()}, seed)


def within(days, spans):
    return np.any([(days >= np.datetime64(first)) & (days < np.datetime64(last))
                   for first, last in spans], axis=0)


@dataclass
class Calendar:
    """What a timetable says of every step."""
    days: np.ndarray
    hour: np.ndarray
    school_day: np.ndarray
    lesson: np.ndarray
    scheduled: np.ndarray       # heating
    season: np.ndarray          # whether there is heating at all
    spring: np.ndarray


def calendar_of(times):
    days = times.astype("datetime64[D]")
    weekday = (days.astype(int) + 3) % 7
    hour = ((times - days) / np.timedelta64(3600, "s")).astype(float)
    school_day = (weekday < 6) & ~within(days, CLOSED_DAYS)
    season = within(days, HEATED_DAYS)
    return Calendar(days, hour, school_day, school_day & (hour >= 8) & (hour < 13),
                    season & (weekday < 6) & (hour >= 6) & (hour < 14), season,
                    within(days, (SUMMER,)))


def register_of(calendar, rng):
    """{day: pupils} of the days with lessons."""
    days = np.unique(calendar.days[calendar.school_day])
    return dict(zip(days, rng.integers(14, 26, len(days))))


def filtered(series, hours):
    """First-order lag."""
    keep = np.exp(-STEP_S / 3600 / hours)
    out, last = np.empty(len(series)), float(series[:288].mean())
    for k, value in enumerate(series):
        out[k] = last = keep * last + (1 - keep) * value
    return out


def adjacent_temperature(weather, calendar, rng):
    """The rooms around: heated like this one, cool at night and on holidays [degC]."""
    outdoors = filtered(weather.theta_e, 72)
    free = 0.65 * outdoors + 8.0
    heated = 13.0 + 8.0 * filtered(calendar.scheduled.astype(float), 8) + 0.15 * outdoors
    level = np.where(calendar.season, np.maximum(heated, free), free)
    return filtered(level, 6) + 0.15 * red(rng, len(level), 0.999)


class RadiatorRow:
    """Elements in a row, from inlet to outlet, with the heat that they give off."""

    def __init__(self, truth, theta_start):
        self.exponent = truth["exponent"]
        self.ua = truth["nominal_power"] / 60 ** self.exponent / ELEMENTS
        self.capacity = truth["radiator_capacity"] / ELEMENTS
        self.flow = truth["maximum_flow"] * WATER
        self.elements = [theta_start] * ELEMENTS

    def step(self, supply, theta_room):
        """Mean heat of a step [W]; `supply` None: no water flows."""
        sub, flow = STEP_S / SUB_STEPS, 0.0 if supply is None else self.flow
        heat = 0.0
        for _ in range(SUB_STEPS):
            before = supply if supply is not None else 0.0
            for i, theta in enumerate(self.elements):
                above = theta - theta_room
                given = self.ua * abs(above) ** self.exponent * (1 if above > 0 else -1)
                self.elements[i] += sub / self.capacity * (flow * (before - theta) - given)
                before = theta
                heat += given
        return heat / SUB_STEPS


def supply_of(truth, scheduled, season, theta_e, theta_air):
    if scheduled:
        return truth["a"] * theta_e + truth["b"] if theta_e < 10 else truth["c"]
    return truth["d"] if season and theta_air < 14 else None


def drives_of(school, weather, calendar, register):
    pupils = np.array([register.get(day, 0) for day in calendar.days]) * calendar.lesson
    truth, still = school.truth, np.zeros(len(pupils))
    habits = lambda name: np.where(calendar.spring, truth[name + "_spring"], truth[name + "_autumn"])
    blinds = np.where(within(calendar.days, CLOSED_DAYS), CLOSED, habits("shading"))
    return SimpleNamespace(
        theta_e=weather.theta_e, sky_factor=1, roof_sun=1.0, blinds=np.array([blinds]),
        people=70.0 * pupils, lights=6.0 * FLOOR_AREA * calendar.lesson, equipment=still,
        unmetered=still, pupils=pupils,
        air_change=truth["infiltration"] + habits("air_change") * calendar.lesson)


def heat_step(zone, heat, radiant_share, sources, loss, neighbour):
    """Air and walls after a step with this heat of the radiator."""
    source, air_source, convective = sources
    total = loss[0] + neighbour[0]
    outside = (loss[0] * loss[1] + neighbour[0] * neighbour[1])
    own = zone.air_store + total + zone.air_own
    to_walls = radiant_share * heat * zone.on_star
    zone.theta_air = (zone.air_store * zone.theta_air + outside + convective + air_source
                      + zone.air_keep @ zone.x + (1 - radiant_share) * heat
                      + zone.air @ to_walls) / own
    zone.x = zone.keep @ zone.x + source + zone.b * zone.theta_air + to_walls


def run(school, weather, calendar, drives, adjacent):
    """Air temperature at the ends of the steps, supply temperature and whether it flows."""
    network = make_network(school.elements, school.windows)
    rows, convective = source_rows(network, school.elements, school.windows, weather, drives)
    rows += np.outer(adjacent - weather.climate.t_mean, network.ground)
    zone = Zone(network, school.air_multiplier * RHO_C_AIR * VOLUME, 15.0)
    zone.on_star = zone.solved[:, network.star]
    solved = rows @ zone.solved.T
    air_rows = solved @ zone.air
    truth, radiator = school.truth, RadiatorRow(school.truth, 15.0)
    n, per_change = len(rows), RHO_C_AIR * VOLUME / 3600
    theta, supply = np.empty(n), np.full(n, np.nan)
    for k in range(n):
        water = supply_of(truth, calendar.scheduled[k], calendar.season[k], weather.theta_e[k],
                          zone.theta_air)
        heat = radiator.step(water, zone.theta_air)
        heat_step(zone, heat, truth["radiative_fraction"], (solved[k], air_rows[k], convective[k]),
                  (per_change * drives.air_change[k] + BRIDGES, weather.theta_e[k]),
                  (0.15 * per_change, adjacent[k]))
        theta[k] = zone.theta_air
        supply[k] = np.nan if water is None else water
    return theta, supply


def ten_minutes(series):
    return series.reshape(-1, 2).mean(axis=1)


@dataclass
class Measured:
    """Of the measured days: begins of 10-minute steps, and what sensors show."""
    weather: object
    times: np.ndarray
    room: np.ndarray
    adjacent: np.ndarray
    supply: np.ndarray           # the room's temperature while no water flows
    flow: np.ndarray             # share of the time
    register: dict


def sensor(series, rng):
    """0.05 K white and 0.08 K slow noise, steps of 0.1 K."""
    n = len(series)
    return np.round(series + 0.05 * rng.standard_normal(n) + 0.08 * red(rng, n, 0.99), 1)


def measure(school):
    weather = synthetic_weather("continental", FIRST_DAY, N_DAYS, school.seed)
    rng = np.random.default_rng([school.seed, 42])
    calendar = calendar_of(weather.times)
    register = register_of(calendar, rng)
    adjacent = adjacent_temperature(weather, calendar, rng)
    drives = drives_of(school, weather, calendar, register)
    theta, supply = run(school, weather, calendar, drives, adjacent)
    flows = ~np.isnan(supply)
    kept = weather.times >= MEASURED_FROM
    show = lambda series: ten_minutes(series[kept])
    return Measured(weather, weather.times[kept][::2], sensor(show(theta), rng),
                    sensor(show(adjacent), rng),
                    np.round(show(np.where(flows, supply, theta)) + 0.2 * rng.standard_normal(
                        kept.sum() // 2), 1), show(flows.astype(float)), register)
