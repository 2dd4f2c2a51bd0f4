"""Offices drawn by seed: what their modellers know, and the climate."""
from dataclasses import replace

import numpy as np

from air_system import SINGLE_ZONE, VAV, AirSystem
from office import FACADES, Office
from weather import CLIMATES

RANGES = {
    "length": (24, 70), "width": (12, 20), "storey_height": (3.0, 3.8), "u_wall": (0.35, 1.5),
    "u_roof": (0.25, 1.0), "u_window": (1.3, 4.5), "g_window": (0.35, 0.65),
    "slab_thickness": (0.12, 0.24), "infiltration": (0.2, 0.6), "people": (4, 9),
    "lights": (5, 11), "equipment": (5, 13), "fresh_air": (0.5, 1.3), "fan_power": (1.0, 2.2),
    "heating_set": (19.5, 21.5), "cooling_set": (24, 26), "heating_capacity": (45, 80),
    "cooling_capacity": (50, 110), "cooling_cop": (2.8, 4.6), "heating_cop": (2.6, 3.8),
    "heating_efficiency": (0.8, 0.93), "base_load": (0.3, 1.0)}
YEARS = (2020, 2021, 2022)   # of a case of two years from 2021, and its settling days
CLOSED = ("01-01", "12-24", "12-25", "12-26", "12-31")


def drawn_design(rng):
    """(climate, Office); half of them with a boiler, half with declared holidays."""
    numbers = {name: round(float(rng.uniform(*ends)), 3) for name, ends in RANGES.items()}
    shares = {facade: round(float(rng.uniform(0.2, 0.5)), 2) for facade in FACADES}
    climate = str(rng.choice(sorted(CLIMATES)))
    boiler, declared = rng.random(2) < 0.5
    days = tuple(f"{year}-{day}" for year in YEARS for day in CLOSED) if declared else ()
    set_backs = {"heating_setback": numbers["heating_set"] - round(float(rng.uniform(3, 7)), 1),
                 "cooling_setback": numbers["cooling_set"] + round(float(rng.uniform(2, 5)), 1)}
    return climate, replace(Office(), **numbers, **set_backs, floors=int(rng.integers(2, 8)),
                            window_share=shares, holidays=days,
                            heat_source="boiler" if boiler else "heat pump")


def drawn_air_system(rng, is_declared):
    """A handler that serves the whole building."""
    cold = round(float(rng.uniform(12.5, 14.5)), 1)
    return AirSystem(
        kind=str(rng.choice((SINGLE_ZONE, VAV))), supply=round(float(rng.uniform(3, 6)), 2),
        supply_cold=cold, supply_warm=cold + round(float(rng.uniform(1, 5)), 1),
        fan_heat=round(float(rng.uniform(0.7, 1)), 2), economiser=bool(rng.random() < 0.5),
        least_flow=round(float(rng.uniform(0.25, 0.5)), 2), is_declared=is_declared)


def drawn_effects(rng, design, effects, n):
    """{name: size} of n different effects that fit the design."""
    fitting = sorted(name for name, effect in effects.items() if effect.fits(design))
    chosen = rng.choice(fitting, n, replace=False)
    return {str(name): round(effects[name].draw(rng), 5) for name in chosen}
