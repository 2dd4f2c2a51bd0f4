"""What heats and cools in an EnergyPlus file: its machines, what they draw, and their efficiency or COP.

Of coils with several speeds the first counts. A class that is not in the tables is told, never taken as absent. Leaves
out which zones a machine serves, its curves, and what its pumps and fans draw.
"""
import os
from dataclasses import dataclass

import numpy as np

from new_job import idf_ideal
from new_job.building import Plant

# COP of a machine whose own is not read; EnergyPlus's default of most coils and chillers.
USUAL_COP = 3
# (class, field of its efficiency or COP, what it has without, carrier). A field or carrier that is "" is not in the
# class, or, of a carrier, is its fuel_type. The first that is there, and that a meter sees, is taken.
HEATERS = (("Coil:Heating:DX:SingleSpeed", "gross_rated_heating_cop", USUAL_COP, "electricity"),
           ("Coil:Heating:DX:MultiSpeed", "speed_1_gross_rated_heating_cop", USUAL_COP, ""),
           ("Coil:Heating:DX:VariableSpeed", "", USUAL_COP, "electricity"),
           ("AirConditioner:VariableRefrigerantFlow", "gross_rated_heating_cop", USUAL_COP, "electricity"),
           ("AirConditioner:VariableRefrigerantFlow:FluidTemperatureControl", "", USUAL_COP, "electricity"),
           ("AirConditioner:VariableRefrigerantFlow:FluidTemperatureControl:HR", "", USUAL_COP, "electricity"),
           ("Coil:Heating:DX:VariableRefrigerantFlow", "", USUAL_COP, "electricity"),
           ("Coil:Heating:DX:VariableRefrigerantFlow:FluidTemperatureControl", "", USUAL_COP, "electricity"),
           ("HeatPump:PlantLoop:EIR:Heating", "reference_coefficient_of_performance", USUAL_COP, "electricity"),
           ("HeatPump:WaterToWater:EquationFit:Heating", "", USUAL_COP, "electricity"),
           ("HeatPump:WaterToWater:ParameterEstimation:Heating", "", USUAL_COP, "electricity"),
           ("Coil:Heating:Fuel", "burner_efficiency", 0.8, ""), ("Coil:Heating:Gas", "burner_efficiency", 0.8, "gas"),
           ("Coil:Heating:Gas:MultiStage", "stage_1_gas_burner_efficiency", 0.8, "gas"),
           ("Boiler:HotWater", "nominal_thermal_efficiency", 0.8, ""),
           ("Boiler:Steam", "theoretical_efficiency", 0.8, ""), ("DistrictHeating", "", 1, "district"),
           ("DistrictHeating:Water", "", 1, "district"), ("DistrictHeating:Steam", "", 1, "district"),
           # Behind boilers: where both are there, these warm the loop from which heat pumps take most of their heat.
           ("Coil:Heating:WaterToAirHeatPump:EquationFit", "gross_rated_heating_cop", USUAL_COP, "electricity"),
           ("Coil:Heating:WaterToAirHeatPump:ParameterEstimation", "", USUAL_COP, "electricity"),
           ("Coil:Heating:WaterToAirHeatPump:VariableSpeedEquationFit", "", USUAL_COP, "electricity"),
           ("Coil:Heating:Electric", "efficiency", 1, "electricity"),
           ("Coil:Heating:Electric:MultiStage", "stage_1_efficiency", 1, "electricity"),
           ("ZoneHVAC:Baseboard:Convective:Electric", "efficiency", 1, "electricity"),
           ("ZoneHVAC:Baseboard:RadiantConvective:Electric", "efficiency", 1, "electricity"),
           ("ZoneHVAC:LowTemperatureRadiant:Electric", "", 1, "electricity"),
           ("ZoneHVAC:HighTemperatureRadiant", "combustion_efficiency", 0.9, ""))
COOLERS = (("Chiller:Electric:EIR", "reference_cop", USUAL_COP, "electricity"),
           ("Chiller:Electric:ReformulatedEIR", "reference_cop", USUAL_COP, "electricity"),
           ("Coil:Cooling:DX:SingleSpeed", "gross_rated_cooling_cop", USUAL_COP, "electricity"),
           ("Coil:Cooling:DX:TwoSpeed", "high_speed_gross_rated_cooling_cop", USUAL_COP, "electricity"),
           ("Coil:Cooling:DX:TwoStageWithHumidityControlMode", "", USUAL_COP, "electricity"),
           ("Coil:Cooling:DX", "", USUAL_COP, "electricity"),
           ("Chiller:Electric", "nominal_cop", USUAL_COP, "electricity"),
           ("Chiller:ConstantCOP", "nominal_cop", USUAL_COP, "electricity"),
           ("Chiller:Electric:ASHRAE205", "", USUAL_COP, "electricity"),
           ("HeatPump:PlantLoop:EIR:Cooling", "reference_coefficient_of_performance", USUAL_COP, "electricity"),
           ("HeatPump:WaterToWater:EquationFit:Cooling", "", USUAL_COP, "electricity"),
           ("HeatPump:WaterToWater:ParameterEstimation:Cooling", "", USUAL_COP, "electricity"),
           ("Coil:Cooling:DX:MultiSpeed", "speed_1_gross_rated_cooling_cop", USUAL_COP, ""),
           ("Coil:Cooling:DX:VariableSpeed", "", USUAL_COP, "electricity"),
           ("Coil:Cooling:DX:SingleSpeed:ThermalStorage", "", USUAL_COP, "electricity"),
           ("Coil:Cooling:WaterToAirHeatPump:EquationFit", "gross_rated_cooling_cop", USUAL_COP, "electricity"),
           ("Coil:Cooling:WaterToAirHeatPump:ParameterEstimation", "", USUAL_COP, "electricity"),
           ("Coil:Cooling:WaterToAirHeatPump:VariableSpeedEquationFit", "", USUAL_COP, "electricity"),
           ("AirConditioner:VariableRefrigerantFlow", "gross_rated_cooling_cop", USUAL_COP, "electricity"),
           ("AirConditioner:VariableRefrigerantFlow:FluidTemperatureControl", "", USUAL_COP, "electricity"),
           ("AirConditioner:VariableRefrigerantFlow:FluidTemperatureControl:HR", "", USUAL_COP, "electricity"),
           ("Coil:Cooling:DX:VariableRefrigerantFlow", "", USUAL_COP, "electricity"),
           ("Coil:Cooling:DX:VariableRefrigerantFlow:FluidTemperatureControl", "", USUAL_COP, "electricity"),
           *((f"Chiller:{kind}", "", USUAL_COP, "none")
             for kind in ("Absorption", "Absorption:Indirect", "EngineDriven", "CombustionTurbine")),
           ("ChillerHeater:Absorption:DirectFired", "", USUAL_COP, "none"), ("DistrictCooling", "", 1, "none"))
FUELS = {"naturalgas": "gas", "gas": "gas", "propane": "gas", "fueloilno1": "gas", "fueloilno2": "gas",
         "electricity": "electricity"}
# Of ideal loads, also heat from elsewhere.
IDEAL_FUELS = FUELS | dict.fromkeys(("districtheatingwater", "districtheatingsteam"), "district")
# EnergyPlus's own where fuel_type is empty.
USUAL_FUELS = {"coil:heating:dx:multispeed": "electricity", "coil:cooling:dx:multispeed": "electricity",
               "coil:heating:fuel": "naturalgas"}
HEATING, COOLING = "heating", "cooling"
# Beginnings of classes that heat or cool a building, and what they do where their name does not say it.
MACHINES = {"coil": (HEATING, COOLING), "chiller": (COOLING,), "chillerheater": (HEATING, COOLING),
            "boiler": (HEATING,), "heatpump": (HEATING, COOLING), "centralheatpumpsystem": (HEATING, COOLING),
            "districtheating": (HEATING,), "districtcooling": (COOLING,), "airconditioner": (HEATING, COOLING),
            "evaporativecooler": (COOLING,), "zonehvac:baseboard": (HEATING,),
            "zonehvac:lowtemperatureradiant": (HEATING,), "zonehvac:hightemperatureradiant": (HEATING,),
            "zonehvac:coolingpanel": (COOLING,), "zonehvac:hybridunitaryhvac": (HEATING, COOLING),
            "zonehvac:refrigerationchillerset": (COOLING,)}
# Of those, what has its heat or cold from another object, and what is a part of another or heats other things.
BY_OTHERS = ("coil:cooling:water", "coil:heating:water", "coil:heating:steam", "zonehvac:baseboard:convective:water",
             "zonehvac:baseboard:radiantconvective:water", "zonehvac:baseboard:radiantconvective:steam",
             "zonehvac:lowtemperatureradiant:variableflow", "zonehvac:lowtemperatureradiant:constantflow",
             "zonehvac:coolingpanel")
PARTS = ("coil:heating:desuperheater", "coil:waterheating", "coil:cooling:dx:curvefit", "coil:dx:ashrae205",
         "chillerheaterperformance", "zonehvac:lowtemperatureradiant:surfacegroup")


@dataclass
class Machines:
    """Of heating or cooling in a file."""
    known: list                # [(class, carrier, mean efficiency or COP)]
    unknown: list              # classes that are not read
    by_others: list            # classes that have their heat or cold from another object

    def __bool__(self):
        return bool(self.known or self.unknown or self.by_others)

    @property
    def classes(self):
        return [*(kind for kind, _, _ in self.known), *self.unknown, *self.by_others]


def known_machines(model, rows):
    """[(class, carrier, mean efficiency or COP)] of those in the file."""
    found = []
    for kind, key, usual, carrier in rows:
        things = model.all(kind)
        if things:
            values = [thing.number(key, usual, 0.01, 20) if key else usual for thing in things]
            fuel = carrier or FUELS.get(things[0].word("fuel_type", USUAL_FUELS.get(kind.lower(), "")), "none")
            found.append((things[0].kind, fuel, float(np.mean(values))))
    return found


def known_ideal(model, schedules, mode):
    """Likewise of ideal loads with fuels of their own, by carrier."""
    by_carrier = {}
    for fuel, value in idf_ideal.fuels_of(model, schedules, mode):
        by_carrier.setdefault(IDEAL_FUELS.get(fuel, "none"), []).append(value)
    return [(idf_ideal.SYSTEM, carrier, float(np.mean(values))) for carrier, values in by_carrier.items()]


def is_of(kind, beginnings):
    """Whether a class (in small letters) is one of some, or of their kin."""
    return next((each for each in beginnings if f"{kind}:".startswith(f"{each}:")), None)


def modes_of(kind):
    """What a class does: heating, cooling, both or nothing."""
    beginning = None if is_of(kind, PARTS) else is_of(kind, MACHINES)
    does = MACHINES.get(beginning, ())
    return tuple(mode for mode in does if f":{mode}" in kind) or does


def machines(model, schedules, mode):
    """Those of a mode."""
    rows = HEATERS if mode == HEATING else COOLERS
    tabled = {row[0].lower() for row in rows}
    others = {several[0].kind: kind for kind, several in model.objects.items()
              if mode in modes_of(kind) and kind not in tabled}
    return Machines([*known_machines(model, rows), *known_ideal(model, schedules, mode)],
                    [says for says, kind in others.items() if not is_of(kind, BY_OTHERS)],
                    [says for says, kind in others.items() if is_of(kind, BY_OTHERS)])


def is_guessed(machine, rows):
    """Whether the COP is not the file's."""
    return any(kind.lower() == machine[0].lower() and not key and usual == USUAL_COP for kind, key, usual, _ in rows)


def plant_of(found, by_meters, meters, told):
    """Carriers of the file's machines; of several kinds the one that a meter sees. `found`: a Described."""
    seen = {meter.quantity for meter in meters}
    plant = heating_of(found, by_meters, seen, told)
    cooler = found.coolers[0] if found.coolers else None
    says = why_not_cooled(found, told)
    if says:
        plant.cooling, plant.cooling_says = None, says
    elif "cooling" in seen and not (cooler and cooler[1] in seen):
        plant.cooling, plant.cooling_says = "none", "its cold is metered"
    elif cooler:
        add_cooling(found, plant, cooler, told)
    else:
        add_unread_cooling(found, plant, told)
    return plant


def add_cooling(found, plant, cooler, told):
    kind, carrier, cop = cooler
    plant.cooling, plant.cop, plant.cooling_says = carrier, cop, f"{kind} of the file"
    if carrier != "electricity" and kind.lower() != "districtcooling":
        plant.cooling = "none"
        told.check(f"[plant]: {file_of(found)} cools by {kind}, whose heat or fuel the job does not count; write "
                   "cooling_carrier and cooling_cop if a meter sees it")
    elif is_guessed(cooler, COOLERS):
        told.check(f"[plant]: the COP of {kind} is not read from {file_of(found)}; {USUAL_COP} was taken: correct "
                   "cooling_cop")
    tell_unknown(found, found.cooling_machines, "cools", told)


def file_of(found):
    return os.path.basename(found.file)


def why_not_cooled(found, told):
    """What the job says where nothing cools; "" where something does."""
    if not found.cooling_machines and not found.is_ideal:
        return "no cooling in the file"
    if found.whole.cooling_capacity == 0 and not found.coolers:
        return "its ideal loads never cool"
    if found.whole.cooling is not None or not found.has_thermostat:
        return ""
    if found.cooling_machines:
        told.check(f"[plant]: {file_of(found)} has {found.cooling_machines.classes[0]}, but its thermostats no cooling "
                   "set-point; the job does not cool: correct cooling_set_point if it does")
    return "no cooling set-point in the file"


def add_unread_cooling(found, plant, told):
    """Of ideal loads, or of classes that are not read."""
    plant.cooling, plant.cooling_says = "electricity", "ideal loads; taken as electric"
    if found.cooling_machines:
        plant.cop, plant.cooling_says = USUAL_COP, "a guess"
        told.check(f"[plant]: {file_of(found)} cools by {', '.join(found.cooling_machines.classes)}, of which no COP "
                   f"is read; electricity and a COP of {USUAL_COP} were taken: correct cooling_carrier and cooling_cop")


def tell_unknown(found, several, does, told):
    """Classes that are not in the tables, beside those that are."""
    if several.unknown:
        told.check(f"[plant]: {file_of(found)} {does} by {', '.join(several.unknown)}, too, which is not read; correct "
                   "[plant] if it does most of it")


def heating_of(found, by_meters, seen, told):
    if not found.heaters:
        if found.heating_machines and "heating" not in seen:
            told.check(f"[plant]: {file_of(found)} heats by {', '.join(found.heating_machines.classes)}, of which no "
                       f"efficiency is read; {by_meters.heating} was taken, {by_meters.heating_says}: correct "
                       "heating_carrier and heating_efficiency")
        return by_meters
    if "heating" in seen and not any(carrier in seen for _, carrier, _ in found.heaters):
        return by_meters
    kinds = list(dict.fromkeys(kind for kind, _, _ in found.heaters))
    machine = next((each for each in found.heaters if each[1] in seen), found.heaters[0])
    kind, carrier, value = machine
    if len({carrier for _, carrier, _ in found.heaters}) > 1:
        told.check(f"[plant]: {file_of(found)} heats by {', '.join(kinds)}; {carrier} was taken for all")
    if is_guessed(machine, HEATERS):
        told.check(f"[plant]: the COP of {kind} is not read from {file_of(found)}; {USUAL_COP} was taken: correct "
                   "heating_efficiency")
    tell_unknown(found, found.heating_machines, "heats", told)
    sd = 0 if carrier in ("none", "district") else max(0.08 * value, 0.05)
    most = 0.99 if carrier == "gas" else 6
    return Plant(carrier, value, sd, (max(0.3, value - 4 * sd), max(value, min(most, value + 4 * sd))),
                 f"{kind} of the file")
