"""Whether outdoor air flows at all hours, or only while a coil runs.

Source: EnergyPlus Input Output Reference, Supply Air Fan Operating Mode Schedule: 0 or none is a fan that cycles with
its coil. Leaves out the zones of a unit other than the one that controls it, and units not in UNITS.
"""
import numpy as np

from new_job import idf_schedules

UNITS = ("AirLoopHVAC:UnitaryHeatCool", "AirLoopHVAC:Unitary:Furnace:HeatCool", "AirLoopHVAC:UnitarySystem",
         "AirLoopHVAC:UnitaryHeatPump:AirToAir")
ROOM_UNITS = ("ZoneHVAC:PackagedTerminalAirConditioner", "ZoneHVAC:PackagedTerminalHeatPump")
VENTILATOR = "zonehvac:energyrecoveryventilator"   # which brings a zone its air without the unit
MODE = "supply_air_fan_operating_mode_schedule_name"
# Of a year that such a fan runs: EnergyPlus's mean of the units of DOE's mid-rise apartment building in Chicago.
SHARE_OF_TIME = 0.2


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
        mode = schedules.of(unit, MODE) if unit.text(MODE) else idf_schedules.constant(0)
        if mode.min() <= 0:
            found[zone] = np.where(mode > 0, 1.0, SHARE_OF_TIME)
    if found:
        left_out.append(f"when the fans of {len(found)} zones run, which cycle with their coils: their outdoor air was "
                        f"taken to be {SHARE_OF_TIME:g} of what flows while they run; correct the flow \"ventilation\"")
    return found
