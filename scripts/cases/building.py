"""building.json as the sections of one building: a 5R1C of one zone with what the case declares."""
import calendar
import os
from dataclasses import dataclass
from datetime import datetime
from typing import Callable

from cases.folder import days_of, ground_temperatures, mean_outdoor_temperature
from cases.meters import meters
from cases.toml import numbers, scheduled, section, texts

AIR_CHANGE_PER_FLOW = 3.6  # l/s in m3/h
CONCRETE_CAPACITY = 2.3e6  # J/(m3 K), 2300 kg/m3 of 1000 J/(kg K)
SENSIBLE_SHARE = 0.7       # of a cooling capacity that also dries
SUPPLY = 13                # degC
SUPPLY_BELOW_ROOM = 11     # K, into a room of 24 degC
LEAST_FLOW = 0.3           # of a varying flow's largest (ASHRAE 90.1-2004, 6.5.2.1)
TYPICAL_FLOW = 0.4         # of a varying flow's largest, over the hours of a year
MOISTURE = 60              # g/h that a person gives off at a desk (ASHRAE Fundamentals 2017, 18.1)
RHO_C_AIR = 1200           # J/(m3 K)
BASE_LOAD = 0.5            # W/m2 of electricity that no case declares
ALWAYS_USED = ("occ", "equip", "light", "hvac", "vent")  # schedules


@dataclass(frozen=True)
class Manner:
    """How a case is written."""
    files: tuple            # paths of the readings
    place: Callable         # name in the case folder -> path that the job writes
    name: str = ""          # of the building; default: the case's
    heat_by_month: bool = False  # heat of few hours is held against its months
    for_loop: bool = False  # with a base load, and the ground's months
    interval: str = None    # of all meters, where it is not the readings' own


def schedules(case):
    for name in ALWAYS_USED:
        case["schedules"][name]  # refuses the case where it is not there
    for name, days in case["schedules"].items():
        if isinstance(days, dict) and "hours" in days:  # "learn"
            yield section("[[schedule]]", name=name, hours=days["hours"], use=days.get("use"))
        elif isinstance(days, dict):
            yield section("[[schedule]]", name=name, weekdays=numbers(days["wd"]),
                          saturday=numbers(days["sat"]), sunday=numbers(days["sun"]))
    hot_water = case.get("domestic_hot_water")
    if hot_water:
        for name, key in (("hot_water", "hourly_shares"), ("cooking", "cooking_shares")):
            yield section("[[schedule]]", name=name, every_day=numbers(hot_water[key]))
    if heating_season(case):
        first, last = heating_season(case)
        yield section("[[schedule]]", name="heating_season", every_day=0, holidays="[]")
        yield section("[[schedule.period]]", dates=f"{first}/{last}", every_day=1)


def heating_season(case):
    """("10-15", "04-15") of "15 Oct - 15 Apr"; None for all year."""
    words = case["plant"]["heating_available"]
    if " - " not in words:
        return None
    try:
        first, last = (datetime.strptime(day + " 2001", "%d %b %Y").strftime("%m-%d")
                       for day in words.split(" - "))
    except ValueError:
        raise case["plant"].error("heating_available",
                                  '"all year", or days as "15 Oct - 15 Apr"') from None
    return first, last


def envelope(case):
    e = case["envelope"]
    yield section("[[construction]]", name="wall", u_value=e["U_wall"],
                  solar_absorptance=e["solar_absorptance_wall"])
    if case["geometry"]["roof_area_exposed_m2"] > 0:
        yield section("[[construction]]", name="roof", u_value=e["U_roof"],
                      solar_absorptance=e["solar_absorptance_roof"])
    if case["geometry"]["ground_floor_area_m2"] > 0:
        yield section("[[construction]]", name="floor",
                      u_value=e["U_ground_floor_with_1p2m_soil"])
    yield section("[[glazing]]", name="window", u_value=e["U_window"],
                  solar_transmittance=e["SHGC_normal"], frame_fraction=e["frame_fraction"])


def elements(case):
    g = case["geometry"]
    for facade in g["facades"]:
        if facade["adiabatic"]:
            continue
        window = facade["area_m2"] * facade["window_to_wall"]
        azimuth = facade["azimuth_deg_from_north"]
        if facade["area_m2"] > window:
            yield section("[[zone.surface]]", name=f"facade_{facade['id']}", construction="wall",
                          area=facade["area_m2"] - window, azimuth=azimuth)
        if window > 0:
            yield section("[[zone.window]]", name=f"facade_{facade['id']}", glazing="window",
                          area=window, azimuth=azimuth)
    if g["roof_area_exposed_m2"] > 0:
        yield section("[[zone.surface]]", name="roof", construction="roof", tilt=0,
                      area=g["roof_area_exposed_m2"])
    if g["ground_floor_area_m2"] > 0:
        yield section("[[zone.surface]]", name="floor", construction="floor", boundary="ground",
                      area=g["ground_floor_area_m2"])


def thinner(case):
    """The air's density over that at the sea, whose heat capacity the method has for all heights:
    standard pressure (ASHRAE Fundamentals 2021, chapter 1)."""
    return (1 - 2.25577e-5 * case["site"]["elevation_m"]) ** 5.2559


def air_flows(case):
    """As flows of sea-level air that carry the same heat."""
    yield section("[[zone.flow]]", name="infiltration",
                  air_change=case["envelope"]["infiltration_ACH"] * thinner(case))
    if reheats(case):
        least = air_change(case, LEAST_FLOW * design_flow(case))
        yield section("[[zone.flow]]", name="ventilation", supply="supply", air_change=scheduled(least, "hvac"))
    else:
        yield section("[[zone.flow]]", name="ventilation", air_change=scheduled(outdoor_air(case), "vent"),
                      heat_recovery=case["ventilation"]["heat_recovery"] or None)


def air_change(case, flow):
    """[1/h] of a flow in m3/(h m2)"""
    return flow * case["geometry"]["gross_floor_area_m2"] / case["geometry"]["air_volume_m3"]


def outdoor_air(case):
    """[1/h] in use."""
    return air_change(case, case["ventilation"]["flow_l_s_m2_peak"] * AIR_CHANGE_PER_FLOW) * thinner(case)


def loads(case, base_load):
    i = case["internal"]
    area = case["geometry"]["gross_floor_area_m2"]
    yield section("[[zone.load]]", name="people",
                  density=scheduled(i["people_per_m2"] * i["sensible_W_per_person"], "occ"))
    for name, key, schedule in (("lights", "lighting_W_m2", "light"),
                                ("equipment", "equipment_W_m2", "equip")):
        yield section("[[zone.load]]", name=name, density=scheduled(i[key], schedule),
                      carrier="electricity")
    fans = fan_power(case)
    if fans > 0 and not reheats(case):
        blows = heats_by_air(case)
        yield section("[[zone.load]]", name="fans",
                      density=scheduled(fans, "hvac" if blows else "vent"),
                      carrier="electricity", heat_fraction=1 if blows else 0)
    if base_load:
        yield section("[[zone.load]]", name="base", density=BASE_LOAD, carrier="electricity",
                      heat_fraction=0)
    hot_water = case.get("domestic_hot_water")
    if hot_water:
        # Shares of a day's energy: an hour with share s has the power s x energy / 1 h.
        density = hot_water["kWh_per_day_useful"] * 1000 / area
        yield section("[[zone.load]]", name="hot_water", density=scheduled(density, "hot_water"),
                      carrier="gas", heat_fraction=0,
                      efficiency=case["plant"]["heating_efficiency"])
        yield section("[[zone.load]]", name="cooking", carrier="gas",
                      density=scheduled(hot_water["cooking_gas_W_peak"] / area, "cooking"))


def fan_power(case):
    """W/m2 while the ventilation runs."""
    v = case["ventilation"]
    return v["flow_l_s_m2_peak"] * v["specific_fan_power_W_per_l_s"]


def heats_by_air(case):
    """Whether the fan moves the room's air through a furnace: it runs with the plant, and its heat
    stays in the room. Other fans change outdoor air, and what they draw leaves with it."""
    return "furnace" in case["plant"]["heat_source"].lower()


def reheats(case):
    """Whether terminals reheat what one unit has cooled: a system of variable volume."""
    return "reheat" in case["plant"]["heat_source"].lower() and has_cooling(case)


def design_flow(case):
    """[m3/(h m2)] that carries the cooling capacity."""
    return SENSIBLE_SHARE * case["plant"]["cooling_capacity_W_m2"] / SUPPLY_BELOW_ROOM / RHO_C_AIR * 3600


def air_system(case):
    """The unit of a building whose terminals reheat. Its flow is what carries its cooling capacity;
    the fan's declared power is that of a typical hour."""
    design = design_flow(case)
    yield section("[[boundary]]", name="supply", temperature=SUPPLY)
    fan = fan_power(case) / TYPICAL_FLOW ** 2 / (design / AIR_CHANGE_PER_FLOW)
    yield section("[[air_system]]", name="unit", flow="ventilation", volume="variable",
                  available=scheduled(1, "hvac"), design_flow=design, fan_power=fan,
                  fan_exponent=2, outdoor_air_change=scheduled(outdoor_air(case), "vent"),
                  people_moisture=scheduled(case["internal"]["people_per_m2"] * MOISTURE, "occ"))


def has_cooling(case):
    return case["plant"]["cooling_available"] != "none" and \
        case["plant"]["cooling_capacity_W_m2"] > 0


def cooling_keys(plant):
    setback = plant["cooling_setback_C"]
    if isinstance(setback, (int, float)):
        return dict(cooling_set_point=scheduled(plant["cooling_set_C"], "hvac", setback),
                    cooling_capacity=plant["cooling_capacity_W_m2"])
    return dict(cooling_set_point=plant["cooling_set_C"],
                cooling_capacity=plant["cooling_capacity_W_m2"],
                cooling_available=scheduled(1, "hvac"))


def heat_capacity(case):
    """C_m of the slabs [J/(m2 K)], both faces to the depth that ISO 13790 (12.3.1) lets count,
    0.1 m or half the slab; None, the class's, where they are not of concrete."""
    e = case["envelope"]
    if e.get("slab") != "concrete" or not e.get("slab_thickness_m"):
        return None
    return CONCRETE_CAPACITY * min(e["slab_thickness_m"], 2 * 0.1)


def heating_carrier(plant):
    words = plant["heat_source"].lower()
    return "gas" if "gas" in words else "electricity" if "heat pump" in words or \
        "electric" in words else "none"


def is_heat_pump(plant):
    """Of electric heating; wires turn all into heat, so that nothing is left to calibrate."""
    return "heat pump" in plant["heat_source"].lower() or plant.get("heating_COP", 1) > 1


def zone(case, base_load):
    p, g = case["plant"], case["geometry"]
    cooling = cooling_keys(p) if has_cooling(case) else \
        dict(cooling_set_point=60, cooling_capacity=0)
    yield section("[[zone]]", name="zone", floor_area=g["gross_floor_area_m2"],
                  volume=g["air_volume_m3"], **{"class": case["envelope"]["construction"]},
                  heat_capacity=heat_capacity(case),
                  heating_set_point=scheduled(p["heating_set_C"], "hvac", p["heating_setback_C"]),
                  heating_capacity=p["heating_capacity_W_m2"],
                  heating_available=scheduled(1, "heating_season")
                  if heating_season(case) else None, **cooling)
    yield from elements(case)
    yield from air_flows(case)
    yield from loads(case, base_load)
    if reheats(case):
        yield from air_system(case)
    carrier = heating_carrier(p)
    yield section("[plant]", heating_carrier=carrier,
                  heating_efficiency=p["heating_COP" if carrier == "electricity" and
                                       "heating_COP" in p else "heating_efficiency"],
                  cooling_cop=p["cooling_COP"] if has_cooling(case) else None)


def ground_months(case, case_dir):
    """{year: months} of what each weather file says of the ground; {} where one says nothing."""
    files = [os.path.join(case_dir, case["site"][key]) for key in ("weather_train", "weather_test")]
    months = {days_of(file)[0].year: ground_temperatures(file) for file in files}
    return months if all(months.values()) else {}


def ground(months, epw):
    """Below the floor: the months of each year, else the air's yearly mean."""
    if not months:
        yield section("[[boundary]]", name="ground", temperature=mean_outdoor_temperature(epw))
        return
    first, *_ = months.values()
    yield section("[[schedule]]", name="ground", every_day=first[0])
    for year, thetas in months.items():
        for month, theta in enumerate(thetas, 1):
            last = calendar.monthrange(year, month)[1]
            yield section("[[schedule.period]]", every_day=theta,
                          dates=f"{year}-{month:02}-01/{year}-{month:02}-{last}")
    yield section("[[boundary]]", name="ground", temperature=scheduled(1, "ground"))


def building_parts(case, case_dir, manner):
    """What one building is: all but periods, parameters and studies."""
    closed = case["declared_closed_days"].get("list_mm_dd", [])
    site = case["site"]
    weather = [manner.place(site[key]) for key in ("weather_train", "weather_test")]
    yield section("", name=manner.name or case["case"],
                  structure=texts(["one unit for all"]) if reheats(case) else None,
                  holidays=texts(closed) if closed else None).lstrip()
    yield section("[site]", latitude=site["latitude"], longitude=site["longitude"],
                  utc_offset=site["utc_offset_h"], elevation=site["elevation_m"])
    yield section("[weather]", files=texts(weather))
    yield from schedules(case)
    yield from envelope(case)
    if case["geometry"]["ground_floor_area_m2"] > 0:
        yield from ground(ground_months(case, case_dir) if manner.for_loop else {},
                          os.path.join(case_dir, site["weather_train"]))
    yield from zone(case, manner.for_loop)
    yield from meters(case, manner)
