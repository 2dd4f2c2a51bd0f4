"""A semi-detached house of two zones, lounge and rooms, and a year's bill of it.

The house of jobs/paper3_house as the finer model sees it: layers of material, a party wall to a
neighbour, air that follows wind and temperature, a boiler. `drawn_house` draws what a calibration
looks for, within the first grid of paper 3, and the rest around the description.
"""
from dataclasses import dataclass, field

import numpy as np

from case import SETTLING_DAYS
from construction import Element, Window
from drives import DayNoise, make_drives
from meters import true_meters
from office import SPREAD, insulated
from simulate import part_of, simulate
from weather import STEPS_PER_HOUR, synthetic_weather

RANGES = {"lighting": (3, 8), "appliances": (3, 10), "set_point_lounge": (16, 19),
          "set_point_rooms": (15, 18), "air_change": (1, 9)}
FIRST_DAY, N_DAYS = "2015-04-01", 366
WEST, SOUTH, NORTH = (90.0, 270.0), (90.0, 180.0), (90.0, 0.0)
HORIZONTAL = (0.0, 0.0)
BRICK = [("brick", 0.1), ("brick", 0.1), ("plaster", 0.015)]
CEILING = [("wood", 0.02), ("gypsum", 0.0125)]
GROUND = [("soil", 2.0), ("concrete", 0.1), ("wood", 0.02)]

HEATED = [0] * 6 + [1, 1] + [0] * 8 + [1] * 7 + [0]
LIT = [0, 0, 0, 0, 0, 0, 0.4, 0.6, 0.3, 0, 0, 0, 0, 0, 0, 0.1, 0.3, 0.6, 0.8, 0.9, 0.9, 0.8, 0.255, 0]
USED = [0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.25, 0.4, 0.35, 0.25, 0.2, 0.25, 0.35, 0.25, 0.2, 0.25, 0.4,
        0.6, 0.65, 0.6, 0.5, 0.45, 0.252, 0.1]
AT_HOME = [1] * 7 + [0.7, 0.3, 0.2, 0.2, 0.2, 0.3, 0.2, 0.2, 0.4, 0.7] + [1] * 7


def _schedules():
    use = {"people": AT_HOME, "lights": LIT, "equipment": USED, "plant": HEATED,
           "fresh_air": [0.0] * 24}
    return {name: (day, day, day) for name, day in use.items()}


@dataclass
class HouseZone:
    """A zone by the names that the office's drives and plant know it by."""
    floor_area: float               # [m2]
    walls: dict                     # plane -> [m2]
    glass: dict                     # plane -> [m2]
    roof: float                     # [m2]
    ground: float
    party: float
    u_wall: float = 1.0             # [W/(m2 K)]
    u_roof: float = 0.4
    u_window: float = 2.7
    g_window: float = 0.65
    u_party: float = 1.2
    theta_next_door: float = 17.0   # [degC]
    infiltration: float = 3.0       # [1/h] at the mean wind
    people: float = 3.0             # [W/m2]
    lights: float = 6.0
    equipment: float = 7.0
    hot_water: float = 0.0          # gas [W/m2], a part of it heat in the zone
    heating_set: float = 17.5       # [degC]
    heating_setback: float = 10.0
    cooling_set: float = 90.0
    cooling_setback: float = 90.0
    heating_capacity: float = 300.0  # [W/m2]
    cooling_capacity: float = 1.0    # never asked for
    heat_source: str = "boiler"
    heating_efficiency: float = 0.9
    cooling_cop: float = 3.0
    fan_power: float = 0.0
    base_load: float = 0.0
    fresh_air: float = 0.0
    holidays: tuple = ()
    schedules: dict = field(default_factory=_schedules)

    @property
    def volume(self):
        return 2.4 * self.floor_area

    def opaque_elements(self, conductance=1.0):
        outside = [Element(f"wall {plane}", area, insulated(self.u_wall, BRICK, 1), plane,
                           sun_share=0.03, conductance=conductance)
                   for plane, area in self.walls.items()]
        if self.roof > 0:
            outside.append(Element("roof", self.roof, insulated(self.u_roof, CEILING, 1),
                                   HORIZONTAL, h_inside=1.5, conductance=conductance))
        return outside + [
            Element("ground", self.ground, GROUND, ground=True, h_inside=1.5, sun_share=0.2),
            Element("partitions", self.floor_area, [("gypsum", 0.025)], sun_share=0.2),
            Element("furniture", 0.6 * self.floor_area, [("wood", 0.02)], sun_share=0.2)]

    def windows(self):
        return [Window(f"window {plane}", area, plane, self.u_window, self.g_window)
                for plane, area in self.glass.items()]


def zones_of(truth, factors):
    """Lounge and rooms. `truth` as RANGES names it; `factors` on numbers of both."""
    common = {name: factor * getattr(HouseZone, name) for name, factor in factors.items()}
    common |= {"lights": truth["lighting"], "equipment": truth["appliances"],
               "infiltration": truth["air_change"]}
    lounge = HouseZone(16.0, {SOUTH: 10.0}, {SOUTH: 3.0}, 0.0, 16.0, 9.6, **common,
                       heating_set=truth["set_point_lounge"])
    rooms = HouseZone(68.0, {SOUTH: 22.0, NORTH: 30.0, WEST: 34.0}, {SOUTH: 5.0, NORTH: 6.0}, 42.0,
                      26.0, 26.4, **common, hot_water=2.7, heating_set=truth["set_point_rooms"])
    return [lounge, rooms]


def drawn_house(seed):
    """(truth, zones): no value lies on a grid."""
    rng = np.random.default_rng([seed, 31])
    truth = {name: float(rng.uniform(*ends)) for name, ends in RANGES.items()}
    spread = ("u_wall", "u_roof", "u_window", "g_window", "people")
    return truth, zones_of(truth, {name: 1 + SPREAD[name] * float(np.clip(
        rng.standard_normal(), -2, 2)) for name in spread})


def weather_of_house(seed):
    """A maritime year with the settling days before it."""
    first = np.datetime64(FIRST_DAY) - SETTLING_DAYS
    return synthetic_weather("cool_maritime", first, N_DAYS + SETTLING_DAYS, seed)


def energies(zone, weather, noise, seed):
    """Hourly energy of a zone, settling days included [kWh]."""
    drives = make_drives(zone, weather, noise, seed, FIRST_DAY)
    drives.neighbour += zone.u_party * zone.party
    drives.theta_neighbour += zone.theta_next_door
    drives.gas_use += zone.hot_water * zone.floor_area
    drives.unmetered += 0.15 * drives.gas_use
    return true_meters(zone, drives, simulate(zone, weather, drives, 17.0))


def bill_of(zones, weather, seed, noise=DayNoise()):
    """{fuel: whole kWh} of the days after the settling ones."""
    each = [energies(zone, weather, noise, 2 * seed + k) for k, zone in enumerate(zones)]
    return {fuel: round(sum(float(e[fuel][SETTLING_DAYS * 24:].sum()) for e in each))
            for fuel in ("electricity", "gas")}


def measured_weather(weather):
    """Without the settling days."""
    return part_of(weather, SETTLING_DAYS * 24 * STEPS_PER_HOUR, len(weather.times))
