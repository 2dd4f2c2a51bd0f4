"""What fans draw, and whether outdoor air flows at all hours or only while a coil runs.

Source: EnergyPlus Input Output Reference, Supply Air Fan Operating Mode Schedule: 0 or none is a fan that cycles with
its coil; Engineering Reference, Simple Fan: power, and the share of it that warms the air. Leaves out the zones of a
unit other than the one that controls it, units not in UNITS, fans that change their flow, and that fans run by night
where a room asks for it.
"""
import numpy as np

from new_job import idf_schedules
from new_job.profile import Profile

UNITS = ("AirLoopHVAC:UnitaryHeatCool", "AirLoopHVAC:Unitary:Furnace:HeatCool", "AirLoopHVAC:UnitarySystem",
         "AirLoopHVAC:UnitaryHeatPump:AirToAir")
ROOM_UNITS = ("ZoneHVAC:PackagedTerminalAirConditioner", "ZoneHVAC:PackagedTerminalHeatPump")
VENTILATOR = "zonehvac:energyrecoveryventilator"   # which brings a zone its air without the unit
MODE = "supply_air_fan_operating_mode_schedule_name"
FAN_OF_UNIT = ("supply_fan_name", "supply_air_fan_name")
# Of a year that such a fan runs: EnergyPlus's mean of the units of DOE's mid-rise apartment building in Chicago.
SHARE_OF_TIME = 0.2

# {class of constant flow: names of its flow, pressure and motor's share in the air stream}
FANS = {"Fan:SystemModel": ("design_maximum_air_flow_rate", "design_pressure_rise", "motor_in_air_stream_fraction"),
        **dict.fromkeys(("Fan:ConstantVolume", "Fan:OnOff"),
                        ("maximum_flow_rate", "pressure_rise", "motor_in_airstream_fraction"))}
EFFICIENCY, MOTOR, IN_STREAM = 0.7, 0.9, 1   # EnergyPlus's defaults
SPEED = "speed_control_method"
# m3/(s m2) where EnergyPlus finds the size: 90 W/m2 of cooling, and the middle of what EnergyPlus takes for a coil of
# one speed, 4.0e-5 to 6.0e-5 m3/s a W.
USUAL_FLOW = 90 * 5e-5


def constant_fans(model):
    """[(fan, names of its flow, pressure and motor's share)]"""
    return [(fan, *keys) for kind, keys in FANS.items() for fan in model.all(kind) if fan.word(SPEED) != "continuous"]


def variable_fans(model):
    """Fans that change their flow."""
    return [*model.all("Fan:VariableVolume"), *(fan for fan in model.all("Fan:SystemModel")
                                                if fan.word(SPEED) == "continuous")]


def says(model):
    sizes = [fan.number(flow) for fan, flow, *_ in constant_fans(model)]
    return "fans" if None not in sizes else f"fans; where the file has no size {1000 * USUAL_FLOW:g} l/(s m2)"


def share_of_time(schedules, unit):
    """Of each hour that a unit's fan runs while it may: all of it, or as long as its coil."""
    mode = schedules.of(unit, MODE) if unit.text(MODE) else idf_schedules.constant(0)
    return np.where(mode > 0, 1.0, SHARE_OF_TIME)


def available(model, schedules, unit):
    """Hours in which a unit's fan may run."""
    fan = next((fan for key in FAN_OF_UNIT for fan in [model.find(unit.text(key), *FANS)] if fan), None)
    return (schedules.of(fan, "availability_schedule_name") if fan else idf_schedules.constant(1)) > 0


def load_of(model, schedules, area):
    """Of all fans, by floor area [W/m2]."""
    running = {unit.word(key): share_of_time(schedules, unit) for unit in model.all(*UNITS, *ROOM_UNITS)
               for key in FAN_OF_UNIT if unit.text(key)}
    fans = constant_fans(model)
    n_fans = len(fans) + len(variable_fans(model))
    total, heat = idf_schedules.constant(0), 0.0
    for fan, flow, pressure, in_stream in fans:
        power = fan.number(flow, USUAL_FLOW * area / n_fans, 0, 1e4) * fan.number(pressure, 0, 0, 1e5) / \
            fan.number("fan_total_efficiency", EFFICIENCY, 0.01, 1)
        motor = fan.number("motor_efficiency", MOTOR, 0.01, 1)
        time = schedules.of(fan, "availability_schedule_name")
        drawn = power / area * np.clip(time, 0, 1) * running.get(fan.name.lower(), 1)
        total += drawn
        heat += (motor + (1 - motor) * fan.number(in_stream, IN_STREAM, 0, 1)) * drawn.mean()
    return Profile(total, heat / total.mean() if total.any() else 1, "electricity")


def equipment_of(model):
    """{zone: classes and names of its equipment}"""
    found = {}
    for connection in model.all("ZoneHVAC:EquipmentConnections"):
        several = model.find(connection.text("zone_conditioning_equipment_list_name"), "ZoneHVAC:EquipmentList")
        found[connection.word("zone_name")] = {cell.lower() for group in several.rest for cell in group} \
            if several else set()
    return found


def units_of_zones(model):
    """(zone, unit) of each unit that brings outdoor air."""
    equipment = equipment_of(model)
    ventilated = {zone for zone, names in equipment.items() if VENTILATOR in names}
    for unit in model.all(*UNITS):
        zone = unit.word("controlling_zone_or_thermostat_location")
        if zone not in ventilated:
            yield zone, unit
    for unit in model.all(*ROOM_UNITS):
        yield from ((zone, unit) for zone, names in equipment.items()
                    if unit.name.lower() in names and zone not in ventilated)


def shares_of_time(model, schedules, left_out):
    """{zone: profile}; other zones have their air at all hours."""
    found = {}
    for zone, unit in units_of_zones(model):
        share = share_of_time(schedules, unit)
        if np.any((share < 1) & available(model, schedules, unit)):
            found[zone] = share
    if found:
        left_out.append(f"when the fans of {len(found)} zones run, which cycle with their coils: their outdoor air was "
                        f"taken to be {SHARE_OF_TIME:g} of what flows while they run; correct the flow \"ventilation\"")
    return found
