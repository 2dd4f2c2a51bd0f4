"""The office that the generator builds: what its modeller knows, and what stands there.

`Office` holds design values. `as_built` draws the true ones around them. Schedules are 24 values
for weekdays, Saturdays and Sundays, value k from hour k to k + 1.
"""
from dataclasses import dataclass, field, replace

import numpy as np

from construction import MATERIALS, Element, Window

FACADES = ("south", "west", "north", "east")
AZIMUTH = {"south": 180.0, "west": 270.0, "north": 0.0, "east": 90.0}
CLOSED = [0.0] * 24


def hours(*spans):
    """24 values from (first hour, last hour, value) spans; 0 elsewhere."""
    day = [0.0] * 24
    for first, last, value in spans:
        day[first:last] = [value] * (last - first)
    return day


def _schedules():
    at_work = hours((7, 8, 0.1), (8, 9, 0.6), (9, 12, 1.0), (12, 14, 0.7), (14, 18, 1.0),
                    (18, 20, 0.25))
    lights = hours((0, 7, 0.05), (7, 8, 0.4), (8, 18, 1.0), (18, 20, 0.4), (20, 24, 0.05))
    devices = hours((0, 7, 0.2), (7, 8, 0.3), (8, 9, 0.7), (9, 12, 1.0), (12, 14, 0.8),
                    (14, 18, 1.0), (18, 20, 0.4), (20, 24, 0.2))
    idle = {"people": CLOSED, "lights": [0.05] * 24, "equipment": [0.2] * 24,
            "plant": CLOSED, "fresh_air": CLOSED}
    open_day = {"people": at_work, "lights": lights, "equipment": devices,
                "plant": hours((7, 19, 1.0)), "fresh_air": hours((7, 19, 1.0))}
    return {use: (open_day[use], idle[use], idle[use]) for use in open_day}


@dataclass
class Office:
    length: float = 48.0            # east-west [m]
    width: float = 18.0
    floors: int = 5
    storey_height: float = 3.4
    window_share: dict = field(default_factory=lambda: {
        "south": 0.42, "west": 0.25, "north": 0.42, "east": 0.25})
    u_wall: float = 1.5             # [W/(m2 K)]
    u_roof: float = 0.9
    u_window: float = 5.2
    g_window: float = 0.52
    absorptance_wall: float = 0.6
    absorptance_roof: float = 0.7
    slab_thickness: float = 0.14    # [m]
    infiltration: float = 0.45      # [1/h] at the mean wind
    people: float = 8.0             # sensible [W/m2]
    lights: float = 9.0             # [W/m2]
    equipment: float = 11.0         # [W/m2]
    fresh_air: float = 1.1          # [1/h]
    fan_power: float = 1.8          # [W/(l/s)]
    heating_set: float = 20.0       # [degC]
    heating_setback: float = 12.0
    cooling_set: float = 25.0
    cooling_setback: float = 34.0
    heating_capacity: float = 70.0  # [W/m2]
    cooling_capacity: float = 130.0
    cooling_cop: float = 3.6
    heat_source: str = "heat pump"  # or "boiler"
    heating_cop: float = 3.0        # of the heat pump
    heating_efficiency: float = 0.9  # of the boiler
    base_load: float = 0.8          # lifts, pumps, outdoor lights [W/m2]
    holidays: tuple = ()            # dates "2021-10-01"
    air_system: object = None       # an AirSystem; None: fresh air comes to the zone as it is
    schedules: dict = field(default_factory=_schedules)

    @property
    def footprint(self):
        return self.length * self.width

    @property
    def floor_area(self):
        return self.footprint * self.floors

    @property
    def volume(self):
        return self.floor_area * self.storey_height

    def facade_area(self, facade):
        side = self.length if facade in ("south", "north") else self.width
        return side * self.storey_height * self.floors

    def opaque_elements(self, conductance=1.0):
        return opaque_elements(self, conductance)

    def windows(self):
        return windows(self)


SPREAD = {  # standard deviation of the truth around the design, relative
    "u_wall": 0.15, "u_roof": 0.15, "u_window": 0.08, "g_window": 0.10, "infiltration": 0.20,
    "people": 0.10, "lights": 0.10, "equipment": 0.10, "fresh_air": 0.12, "fan_power": 0.10,
    "absorptance_wall": 0.10, "absorptance_roof": 0.10, "slab_thickness": 0.10,
    "cooling_cop": 0.08, "heating_cop": 0.08, "base_load": 0.20,
}
SET_POINT_SPREAD = 0.4  # [K]


def as_built(design, seed):
    """The design with its numbers drawn anew, within two standard deviations."""
    rng = np.random.default_rng([seed, 2])
    draw = lambda: float(np.clip(rng.standard_normal(), -2, 2))
    numbers = {name: getattr(design, name) * (1 + s * draw()) for name, s in SPREAD.items()}
    for name in ("heating_set", "cooling_set"):
        numbers[name] = getattr(design, name) + SET_POINT_SPREAD * draw()
    return replace(design, **numbers)


def insulated(u_value, layers, place):
    """The layers with insulation put in at `place` so that the whole has the U-value."""
    bare = sum(d / MATERIALS[m][0] for m, d in layers) + 0.05 + 0.13
    thickness = max(0.001, (1 / u_value - bare) * MATERIALS["insulation"][0])
    return layers[:place] + [("insulation", thickness)] + layers[place:]


def opaque_elements(office, conductance=1.0):
    """Walls, roof, ground floor, inner slabs and partitions; `conductance` of walls and roof."""
    brick = [("plaster", 0.02), ("brick", 0.2), ("plaster", 0.02)]
    roof = [("screed", 0.04), ("concrete", office.slab_thickness), ("plaster", 0.01)]
    ground = [("soil", 2.0), ("concrete", office.slab_thickness), ("screed", 0.04)]
    slab = [("plaster", 0.01), ("concrete", office.slab_thickness), ("screed", 0.04)]
    walls = [Element(f, office.facade_area(f) * (1 - office.window_share[f]),
                     insulated(office.u_wall, brick, 1), (90.0, AZIMUTH[f]),
                     absorptance=office.absorptance_wall, sun_share=0.03, conductance=conductance) for f in FACADES]
    return walls + [
        Element("roof", office.footprint, insulated(office.u_roof, roof, 1), (0.0, 0.0),
                absorptance=office.absorptance_roof, h_inside=1.5, conductance=conductance),
        Element("ground", office.footprint, ground, ground=True, h_inside=1.5, sun_share=0.13),
        Element("slabs", office.footprint * (office.floors - 1), slab, h_inside=1.5,
                sun_share=0.42),
        Element("partitions", 0.8 * office.floor_area, [("gypsum", 0.025)], sun_share=0.1),
        Element("furniture", 0.6 * office.floor_area, [("wood", 0.02)], sun_share=0.1)]


def windows(office):
    return [Window("window " + f, office.facade_area(f) * office.window_share[f],
                   (90.0, AZIMUTH[f]), office.u_window, office.g_window) for f in FACADES]
