"""What an EnergyPlus file draws outside of its zones: lights and equipment outdoors and hot water, which no room feels.

Source: EnergyPlus Input Output Reference, Exterior:Lights and FuelEquipment, WaterUse:Equipment, WaterHeater:Mixed;
Engineering Reference, Water Mains Temperatures (Christensen and Burch). Lights of an astronomical clock burn while the
sun is down. Leaves out pumps, parasitic power of another fuel than the tank's, and heaters other than mixed tanks.
"""
import math

import numpy as np

from new_job import idf_plant, idf_schedules
from new_job.idf_schedules import DAYS, HOURS, KINDS, MONTH_DAYS
from new_job.profile import Profile

OUTSIDE_LIGHTS, HOT_WATER = "outside_lights", "hot_water"
# {carrier: load} of lifts, car chargers, snow melting and other things outdoors.
OUTSIDE_EQUIPMENT = {"electricity": "outside_equipment", "gas": "outside_gas_equipment",
                     "district": "outside_district_equipment"}
SUMMER_MONTHS = range(4, 11)   # whose clocks are an hour ahead, where there is summer time
USUAL_NIGHT = (6, 18)          # its end and begin, where the place is not known
WATER = 4.18e6                 # J/(m3 K)
USUAL_MAINS = 10               # degC, EnergyPlus's where the file has none
USUAL_EFFICIENCY = 0.8
ROOM = 20                      # degC around a tank that stands in one
CARRIERS = idf_plant.IDEAL_FUELS | {"districtheating": "district"}
HEATER, DRAW = "WaterHeater:Mixed", "WaterUse:Equipment"


def by_month(values):
    """A profile of [12 or 12 x 24]."""
    each = np.repeat(np.asarray(values, dtype=float), MONTH_DAYS, axis=0)
    return np.zeros((DAYS, KINDS, HOURS)) + (each[:, None, :] if each.ndim == 2 else each[:, None, None])


def night(day, latitude, longitude, utc_offset):
    """(end of the night, its begin) [h of standard time] of a day of the year from 1, by declination and equation of
    time (Spencer 1971)."""
    angle = 2 * math.pi * (day - 1) / DAYS
    turns = [(math.cos(k * angle), math.sin(k * angle)) for k in (1, 2, 3)]
    (c1, s1), (c2, s2), (c3, s3) = turns
    declination = 0.006918 - 0.399912 * c1 + 0.070257 * s1 - 0.006758 * c2 + 0.000907 * s2 - 0.002697 * c3 + \
        0.00148 * s3
    minutes = 229.18 * (0.000075 + 0.001868 * c1 - 0.032077 * s1 - 0.014615 * c2 - 0.04089 * s2)
    half = math.acos(min(1, max(-1, -math.tan(math.radians(latitude)) * math.tan(declination)))) * 12 / math.pi
    noon = 12 + utc_offset - longitude / 15 - minutes / 60
    return noon - half, noon + half


def dark_share(site, has_summer_time):
    """Profile: share of each hour of the clock without sun, the mean of each month.

    `site`: (latitude, longitude, UTC offset [h]), or None, where the night is the usual one."""
    days = np.empty((DAYS, HOURS))
    for day in range(DAYS):
        end, begin = night(day + 1, *site) if site else USUAL_NIGHT
        sunny = [min(hour + 1, begin) - max(hour, end) for hour in range(HOURS)]
        days[day] = 1 - np.clip(sunny, 0, 1)
    firsts = np.cumsum([0, *MONTH_DAYS])
    dark = np.array([days[a:b].mean(axis=0) for a, b in zip(firsts, firsts[1:])])
    for month in SUMMER_MONTHS if has_summer_time else ():
        dark[month - 1] = np.roll(dark[month - 1], 1)
    return by_month(dark)


def lights(model, schedules, dark):
    """[W]"""
    total = idf_schedules.constant(0)
    for thing in model.all("Exterior:Lights"):
        by_clock = thing.word("control_option") == "astronomicalclock"
        total += thing.number("design_level", 0, 0, 1e9) * schedules.of(thing, "schedule_name") * (
            dark if by_clock else 1)
    return total


def equipment(model, schedules, left_out):
    """{carrier: [W]}; other fuels are told."""
    found = {}
    for thing in model.all("Exterior:FuelEquipment"):
        carrier = CARRIERS.get(thing.word("fuel_use_type"))
        if carrier is None:
            left_out.append(f'{thing.kind} "{thing.name}" by {thing.text("fuel_use_type", "no fuel")}, of which a job '
                            "has no meter")
            continue
        found[carrier] = found.get(carrier, 0) + thing.number("design_level", 0, 0, 1e9) * \
            schedules.of(thing, "schedule_name")
    return found


def mains(model, schedules):
    """Temperature of cold water [degC]."""
    found = next(iter(model.all("Site:WaterMainsTemperature")), None)
    if found is None:
        return idf_schedules.constant(USUAL_MAINS)
    if found.word("calculation_method") == "schedule":
        return schedules.of(found, "temperature_schedule_name")
    mean = 1.8 * found.number("annual_average_outdoor_air_temperature", USUAL_MAINS, -60, 60) + 32
    span = 1.8 * found.number("maximum_difference_in_monthly_average_outdoor_air_temperatures", 0, 0, 60)
    day = np.cumsum([0, *MONTH_DAYS[:-1]]) + 15
    lag, ratio = 35 - (mean - 44), 0.4 + 0.01 * (mean - 44)      # degF
    return by_month((mean + 6 + ratio * span / 2 * np.sin(np.radians(0.986 * (day - 15 - lag) - 90)) - 32) / 1.8)


def on_loops(model):
    """Names of the equipment that a loop brings hot water to."""
    return {cell.lower() for connection in model.all("WaterUse:Connections") for group in connection.rest
            for cell in group}


def temperature_drawn(thing, schedules, supplied):
    """[degC] of the water that is drawn; None where all of it is cold. `supplied`: names of those on a loop, and its
    temperature. Without a target it is all hot."""
    for key in ("target_temperature_schedule_name", "hot_water_supply_temperature_schedule_name"):
        if thing.text(key):
            return schedules.of(thing, key)
    names, hot = supplied
    return hot if thing.name.lower() in names else None


def drawn(model, schedules, zones, heaters):
    """Heat of the water that is drawn [W]; a zone that stands for several draws for them."""
    cold, total = mains(model, schedules), idf_schedules.constant(0)
    hot = sum(schedules.of(heater, "setpoint_temperature_schedule_name") for heater in heaters) / len(heaters)
    for thing in model.all(DRAW):
        temperature = temperature_drawn(thing, schedules, (on_loops(model), hot))
        if temperature is None:
            continue
        zone = zones.get(thing.word("zone_name"))
        flow = thing.number("peak_flow_rate", 0, 0, 10) * (zone.multiplier if zone else 1) * \
            schedules.of(thing, "flow_rate_fraction_schedule_name")
        own = thing.text("cold_water_supply_temperature_schedule_name")
        from_cold = schedules.of(thing, "cold_water_supply_temperature_schedule_name") if own else cold
        total += WATER * flow * np.maximum(temperature - from_cold, 0)
    for heater in heaters:     # a tank without a loop has its own use
        flow = heater.number("peak_use_flow_rate", 0, 0, 10) * \
            schedules.of(heater, "use_flow_rate_fraction_schedule_name")
        total += WATER * flow * np.maximum(schedules.of(heater, "setpoint_temperature_schedule_name") - cold, 0)
    return total


def kept_warm(heater, schedules):
    """What a tank, in the middle of its dead band, loses to air of its own schedule or of a room [W]."""
    key = "ambient_temperature_schedule_name"
    air = schedules.of(heater, key) if heater.text(key) else ROOM
    water = schedules.of(heater, "setpoint_temperature_schedule_name") - \
        heater.number("deadband_temperature_difference", 0, 0, 50) / 2
    return heater.number("off_cycle_loss_coefficient_to_ambient_temperature", 0, 0, 1e4) * np.maximum(water - air, 0)


def parasitic(heaters, carrier):
    """Fuel of that kind which tanks take while they do not heat, taken as that of all hours, and its heat to the water
    [W]."""
    taken = given = 0.0
    for heater in heaters:
        if CARRIERS.get(heater.word("off_cycle_parasitic_fuel_type")) == carrier:
            rate = heater.number("off_cycle_parasitic_fuel_consumption_rate", 0, 0, 1e6)
            taken += rate
            given += rate * heater.number("off_cycle_parasitic_heat_fraction_to_tank", 0, 0, 1)
    return taken, given


def fuel_of(heater):
    return CARRIERS.get(heater.word("heater_fuel_type"), "")


def largest_fuel(heaters):
    """The fuel of the meters by which tanks together heat most, whatever their order; "" without any. A size that
    EnergyPlus finds counts as 1 W."""
    sizes = {}
    for heater in heaters:
        if fuel_of(heater):
            sizes[fuel_of(heater)] = sizes.get(fuel_of(heater), 0) + \
                heater.number("heater_maximum_capacity", 1, 0, 1e9)
    return max(sorted(sizes), key=lambda fuel: sizes[fuel], default="")


def hot_water(model, schedules, zones, left_out):
    """(fuel or power [W], its carrier); the tanks of several fuels are taken to have that of most of them."""
    heaters = [heater for heater in model.all(HEATER) if heater.text("setpoint_temperature_schedule_name")]
    fuels, carrier = sorted(set(map(fuel_of, heaters))), largest_fuel(heaters)
    if not carrier:
        if model.all(DRAW):
            left_out.append(f"{DRAW}: hot water without a {HEATER} that burns a fuel of the meters; a load may stand "
                            "for it")
        return idf_schedules.constant(0), ""
    if len(fuels) > 1:
        left_out.append(f"{HEATER} by {' and '.join(fuel or 'other fuels' for fuel in fuels)}: {carrier}, which heats "
                        "most, was taken for all")
    total = drawn(model, schedules, zones, heaters) + sum(kept_warm(heater, schedules) for heater in heaters)
    efficiency = np.mean([heater.number("heater_thermal_efficiency", USUAL_EFFICIENCY, 0.05, 10) for heater in heaters])
    taken, given = parasitic(heaters, carrier)
    return taken + np.maximum(total - given, 0) / efficiency, carrier


def loads_of(model, use, zones, dark, area, left_out):
    """{name: Profile by floor area, in W/m2}, of what there is. `use`: the idf_use.Reader of the rooms; what stands in
    zones without a thermostat draws as things outdoors do."""
    schedules = use.schedules
    water, carrier = hot_water(model, schedules, zones, left_out)
    found = {OUTSIDE_LIGHTS: Profile(lights(model, schedules, dark) / area, 0, "electricity"),
             HOT_WATER: Profile(water / area, 0, carrier)}
    unfelt = equipment(model, schedules, left_out)
    for fuel, power in use.without_thermostat().items():
        unfelt[fuel] = unfelt.get(fuel, 0) + power
    found |= {OUTSIDE_EQUIPMENT[fuel]: Profile(power / area, 0, fuel) for fuel, power in unfelt.items()}
    return {name: profile for name, profile in found.items() if profile.values.any()}
