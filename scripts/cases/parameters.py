"""The parameters of a case: factors on what it declares, or offsets from it, with the same names in
every case, so that buildings can share them.

A prior holds what the case's notes say: U-values +-20 %, windows, solar transmittance and gains
+-15 %, infiltration +-30 %, ventilation +-20 %, set-points +-0.5 K, hot water +-30 %. The ranges
are wider, for what a 5R1C makes of a wall or a window is not what was declared; heat capacity and
what a case does not say have wide priors too.
"""
import json
from dataclasses import dataclass, field
from typing import Callable

from cases.building import fan_power, has_cooling, heating_carrier, is_heat_pump, reheats
from cases.toml import number, section


@dataclass(frozen=True)
class Row:
    """One parameter. `share` gives the declared value where it is a share, at most 1."""
    name: str
    mode: str
    least: float
    most: float
    mean: float             # of the normal prior; None: all alike
    sd: float
    targets: list = field(default_factory=list)
    needs: str = ""         # part that not every case has
    share: Callable = None


def factor(name, least, most, sd, *targets, **more):
    return Row(name, "factor", least, most, 1, sd, list(targets), **more)


def offset(name, width, sd, *targets, **more):
    return Row(name, "offset", -width, width, 0, sd, list(targets), **more)


ROWS = [
    factor("u_wall", 0.4, 1.8, 0.2, "construction.wall.u_value"),
    factor("u_roof", 0.4, 1.8, 0.2, "construction.roof.u_value", needs="roof"),
    factor("u_floor", 0.4, 1.8, 0.2, "construction.floor.u_value", needs="floor"),
    factor("u_window", 0.4, 1.5, 0.15, "glazing.window.u_value"),
    factor("solar_transmittance", 0.4, 1.4, 0.15, "glazing.window.solar_transmittance",
           share=lambda case: case["envelope"]["SHGC_normal"]),
    factor("absorptance", 0.4, 1.6, 0.2, "construction.wall.solar_absorptance",
           share=lambda case: case["envelope"]["solar_absorptance_wall"]),
    factor("people", 0.5, 1.5, 0.15, "zone.zone.load.people.density"),
    factor("lights", 0.5, 1.5, 0.15, "zone.zone.load.lights.density"),
    factor("equipment", 0.5, 2, 0.15, "zone.zone.load.equipment.density"),
    factor("fans", 0.4, 1.8, 0.2, "zone.zone.load.fans.density", needs="fans"),
    Row("base_load", "replace", 0, 2, 0.5, 0.5, ["zone.zone.load.base.density"], needs="base"),
    factor("infiltration", 0.2, 2.5, 0.3, "zone.zone.flow.infiltration.air_change"),
    factor("ventilation", 0.4, 1.6, 0.2, "zone.zone.flow.ventilation.air_change", needs="own air"),
    factor("ventilation", 0.4, 1.6, 0.2, "air_system.unit.outdoor_air_change", needs="reheat"),
    factor("heat_recovery", 0.4, 1.6, 0.2, "zone.zone.flow.ventilation.heat_recovery",
           needs="recovery", share=lambda case: case["ventilation"]["heat_recovery"]),
    offset("heating_set_point", 2, 0.5, "zone.zone.heating_set_point"),
    offset("heating_setback", 4, 1, "zone.zone.heating_set_point.low"),
    offset("cooling_set_point", 2, 0.5, "zone.zone.cooling_set_point", needs="cooling"),
    offset("cooling_setback", 4, 1, "zone.zone.cooling_set_point.low", needs="cooling setback"),
    factor("heat_capacity", 0.2, 4, 0.5, "zone.zone.heat_capacity"),
    factor("heating_capacity", 0.4, 2, 0.15, "zone.zone.heating_capacity"),
    factor("cooling_capacity", 0.4, 2, 0.15, "zone.zone.cooling_capacity", needs="cooling"),
    factor("heating_efficiency", 0.8, 1.2, 0.1, "plant.heating_efficiency", needs="gas"),
    factor("heating_efficiency", 0.8, 1.2, 0.1, "plant.heating_efficiency",
           "zone.zone.load.hot_water.efficiency", needs="gas and hot water"),
    factor("heating_cop", 0.6, 1.5, 0.2, "plant.heating_efficiency", needs="heat pump"),
    factor("supply_flow", 0.4, 2, 0.25, "air_system.unit.design_flow", needs="reheat"),
    factor("least_flow", 0.2, 2.5, 0.33, "zone.zone.flow.ventilation.air_change", needs="reheat"),
    factor("unit_fan", 0.3, 2.5, 0.4, "air_system.unit.fan_power", needs="reheat"),
    offset("supply_temperature", 5, 1.5, "boundary.supply.temperature", needs="reheat"),
    Row("bypass_factor", "replace", 0, 0.5, 0.1, 0.05, ["air_system.unit.bypass_factor"],
        needs="reheat"),
    factor("moisture", 0, 3, 0.4, "air_system.unit.people_moisture", needs="reheat"),
    factor("cooling_cop", 0.6, 2, 0.2, "plant.cooling_cop", needs="cooling"),
    factor("hot_water", 0.4, 1.6, 0.3, "zone.zone.load.hot_water.density", needs="hot water"),
    factor("cooking", 0.4, 1.6, 0.3, "zone.zone.load.cooking.density", needs="hot water"),
]

# Refinements of the standard's hour (a loop chooses them itself).
STRUCTURE = [
    Row("thermostat_band", "replace", 0, 2, None, None, ["zone.zone.proportional_band"]),
    Row("air_capacity", "replace", 0, 50000, None, None, ["zone.zone.air_capacity"]),
    Row("emitter_lag", "replace", 0, 7200, None, None, ["zone.zone.emitter_time_constant"]),
]


def parts_of(case, base_load):
    """Those of the parts in Row.needs that the case has."""
    g, plant, v = case["geometry"], case["plant"], case["ventilation"]
    cooled, carrier = has_cooling(case), heating_carrier(plant)
    gas = carrier == "gas"
    hot_water = bool(case.get("domestic_hot_water"))
    there = {"": True, "roof": g["roof_area_exposed_m2"] > 0, "base": base_load,
             "floor": g["ground_floor_area_m2"] > 0, "cooling": cooled,
             "cooling setback": cooled and isinstance(plant["cooling_setback_C"], (int, float)),
             "fans": fan_power(case) > 0 and not reheats(case), "reheat": reheats(case),
             "own air": not reheats(case),
             "recovery": v["heat_recovery"] > 0, "hot water": hot_water,
             "gas": gas and not hot_water, "gas and hot water": gas and hot_water,
             "heat pump": carrier == "electricity" and is_heat_pump(plant)}
    return {part for part, is_there in there.items() if is_there}


def parameters(case, rows, base_load=False):
    parts = parts_of(case, base_load)
    for row in rows:
        if row.needs not in parts:
            continue
        most = min(row.most, 0.9999 / row.share(case)) if row.share else row.most
        prior = None if row.mean is None else \
            f'{{kind = "normal", mean = {number(row.mean)}, sd = {number(row.sd)}}}'
        yield section("[[parameter]]", name=row.name, mode=row.mode, min=row.least, max=most,
                      prior=prior, target=json.dumps(row.targets))
