"""Hooks of air, gains and systems.

More of something is an object of its own, whose schedule is the series; less is heat by a program. Heat of the air:
0.34 Wh/(m3 K). Leaves out moisture of what is added.
"""
import dataclasses

import numpy as np

from energyplus import parameters
from energyplus.changes import PREFIX
from energyplus.hours import IDEAL
from energyplus.model import ZONE
from energyplus.place import CannotEnter, change, internal, nodes_of, program, rooms, sensors_of_room, usual_value

AIR_HEAT = 0.34                # Wh/(m3 K)
OPENS_ABOVE = 23               # degC of the room, where an effect does not say it
HALF = 0.5                     # share from which an economiser is on
RADIANT = 0.5                  # share of added heat
SIZES = ("Sizing:", "DesignSpecification:", "Controller:MechanicalVentilation")   # which size systems, and run none
RECOVERY = ("sensible_effectiveness_at_100_heating_air_flow", "sensible_effectiveness_at_100_cooling_air_flow",
            "sensible_effectiveness_at_75_heating_air_flow", "sensible_effectiveness_at_75_cooling_air_flow")


def add_infiltration(at):
    """More air is an object of its own; less is the heat that the model's infiltration loses too much."""
    more, less = np.maximum(at.values, 0), np.minimum(at.values, 0)
    series = at.schedule(more, "more") if more.any() else None
    fewer = at.series(less, "less") if less.any() else None
    for zone in rooms(at):
        if series:
            at.model.add("ZoneInfiltration:DesignFlowRate", at.changes.new_name(f"{at.effect.name} {zone}"), {
                ZONE: zone, "schedule_name": series, "design_flow_rate_calculation_method": "AirChanges/Hour",
                "air_changes_per_hour": 1, "constant_term_coefficient": 1, "temperature_term_coefficient": 0,
                "velocity_term_coefficient": 0, "velocity_squared_term_coefficient": 0})
        if fewer:
            (room, outdoor), volume = sensors_of_room(at, zone), internal(at, zone, "Zone Air Volume")
            share = at.changes.sensor("Schedule Value", fewer)
            program(at, zone, at.effect.name,
                    [f"SET {{heat}} = {AIR_HEAT} * {volume} * {outdoor} - {AIR_HEAT} * {volume} * {room}",
                     f"SET {{heat}} = {{heat}} * {share}"])


def open_windows(at):
    series, above = at.schedule(np.maximum(at.values, 0)), at.effect.more.get("opens_above", OPENS_ABOVE)
    for zone in rooms(at):
        at.model.add("ZoneVentilation:DesignFlowRate", at.changes.new_name(f"{at.effect.name} {zone}"), {
            ZONE: zone, "schedule_name": series, "design_flow_rate_calculation_method": "AirChanges/Hour",
            "air_changes_per_hour": 1, "ventilation_type": "Natural", "constant_term_coefficient": 1,
            "temperature_term_coefficient": 0, "velocity_term_coefficient": 0, "velocity_squared_term_coefficient": 0,
            "minimum_indoor_temperature": above, "delta_temperature": 0})


def referred_air(model):
    """Names, in small letters, of outdoor air that systems follow as they run, and not only as they are sized."""
    if any(fields.get("mechanical_ventilation_controller_name") for _, fields in model.all("Controller:OutdoorAir")):
        return {name.lower() for name, _ in model.all("DesignSpecification:OutdoorAir")}
    return {str(value).lower() for kind in model.objects if not kind.startswith(SIZES)
            for _, fields in model.all(kind) for key, value in fields.items()
            if key.startswith("design_specification_outdoor_air")}


def widen_dampers(at, referred, most):
    """EnergyPlus cuts a controller's schedule at 1: more outdoor air than that is a larger minimum, times `most`, by which
    coils are sized, too.
    """
    parameters.scale(at.model, (("Controller:OutdoorAir", ("minimum_outdoor_air_flow_rate",), None),), most)
    for name, fields in at.model.all("DesignSpecification:OutdoorAir"):
        if name.lower() not in referred:
            for key in parameters.FRESH_AIR:
                if parameters.is_number(fields.get(key)):
                    fields[key] *= most


def change_ventilation(how=""):
    """Outdoor air of ideal loads and terminals, of controllers, and ventilation of zones: a share of the most that the
    model says (`add`), or of what flows (`factor`), as the effect says unless `how` does.
    """
    def enter(at):
        return move_ventilation(at, how or at.effect.says("enters") or "add")
    return enter


def move_ventilation(at, how):
    referred, dampers = referred_air(at.model), at.model.all("Controller:OutdoorAir")
    found = [("ZoneVentilation:DesignFlowRate", name, fields, "schedule_name")
             for name, fields in at.model.all("ZoneVentilation:DesignFlowRate") if not name.startswith(PREFIX)]
    found += [("DesignSpecification:OutdoorAir", name, fields, "outdoor_air_schedule_name")
              for name, fields in at.model.all("DesignSpecification:OutdoorAir") if name.lower() in referred]
    if found or not dampers:
        change(at, found, how, at.values, 1.0, 0)
    if dampers:
        most = float(max(1 + at.effect.values.max(), 1))
        widen_dampers(at, referred, most)
        found = [("Controller:OutdoorAir", name, fields, "minimum_outdoor_air_schedule_name")
                 for name, fields in dampers]
        if how == "add" and most > 1:
            change(at, found, "factor", np.full_like(at.values, 1 / most - 1), 1.0, 0)
        change(at, found, how, (1 + at.values) / most - 1 if how == "factor" else at.values / most, 1.0, 0)


def add_heat(at):
    """Heat that no meter sees, half of it radiant. EnergyPlus takes a power below 0 from a program alone."""
    more, less = np.maximum(at.values, 0), np.minimum(at.values, 0)
    if more.any():
        add_power(at, "OtherEquipment", "power_per_floor_area", more, fuel_type="None")
    if less.any():
        series = at.changes.sensor("Schedule Value", at.series(less, "less"))
        for zone in rooms(at):
            area = internal(at, zone, "Zone Floor Area")
            program(at, zone, at.effect.name, [f"SET {{heat}} = {area} * {series}"], RADIANT)


def add_power(at, kind, key, values, **more):
    """An object of 1 W/m2 in each zone, whose schedule is the series."""
    series = at.schedule(values, "more")
    for zone in rooms(at):
        at.model.add(kind, at.changes.new_name(f"{at.effect.name} {zone}"), {
            ZONE: zone, "schedule_name": series, "design_level_calculation_method": "Watts/Area", key: 1,
            "fraction_latent": 0, "fraction_radiant": RADIANT, "fraction_lost": 0, **more})


def add_equipment(at):
    """More is equipment; less is heat that is taken away, and the meter's hours afterwards."""
    more, less = np.maximum(at.values, 0), np.minimum(at.values, 0)
    if more.any():
        add_power(at, "ElectricEquipment", "watts_per_floor_area", more)
    if less.any():
        add_heat(dataclasses.replace(at, values=less))


def recover_heat(at):
    """Its mean where it acts, at all times: EnergyPlus's effectiveness follows no schedule."""
    value, count = usual_value(at.effect.values), 0
    for kind in IDEAL[:1]:
        for _, fields in at.model.all(kind):
            if not fields.get("design_specification_outdoor_air_object_name"):
                continue
            own = fields.get("sensible_heat_recovery_effectiveness", 0.7) if \
                fields.get("heat_recovery_type", "None").lower() not in ("", "none") else 0
            fields["heat_recovery_type"] = "Sensible"
            fields["sensible_heat_recovery_effectiveness"] = min(max(own + value, 0), 1)
            count += 1
    for _, fields in at.model.all("HeatExchanger:AirToAir:SensibleAndLatent"):
        for key in RECOVERY:
            if key in fields:
                fields[key] = min(max(fields[key] + value, 0), 1)
                count += 1
    if not count:
        raise CannotEnter("the model has no outdoor air of ideal loads and no heat exchanger")


def nodes_with_set_point(model):
    """What an economiser needs behind its mixing box."""
    return {node for kind in model.names("SetpointManager:") for _, fields in model.all(kind)
            for key, value in fields.items() if key.startswith("setpoint_node") for node in nodes_of(model, value)}


def economise(at):
    """On for all hours where its share is a half or more."""
    if usual_value(at.effect.values) < HALF:
        raise CannotEnter(f"its share is below {HALF}, and EnergyPlus has none or all of it")
    nodes = nodes_with_set_point(at.model)
    dampers = [fields for _, fields in at.model.all("Controller:OutdoorAir")
               if fields.get("mixed_air_node_name", "").lower() in nodes]
    ideal = [fields for _, fields in at.model.all(IDEAL[0]) if "FlowRate" in fields.get("cooling_limit", "") and
             fields.get("design_specification_outdoor_air_object_name")]
    for fields in dampers:
        fields["economizer_control_type"] = "DifferentialDryBulb"
    for fields in ideal:
        fields["outdoor_air_economizer_type"] = "DifferentialDryBulb"
    if not dampers and not ideal:
        raise CannotEnter("the model has no Controller:OutdoorAir with a set-point behind it, and no ideal loads with "
                          "a limit of cooling air")


def shift_supply(at):
    """Managers of the temperature behind an air loop; water loops are none."""
    air = {node for _, fields in at.model.all("AirLoopHVAC")
           for node in nodes_of(at.model, fields.get("supply_side_outlet_node_names", ""))}
    change(at, [("SetpointManager:Scheduled", name, fields, "schedule_name")
                for name, fields in at.model.all("SetpointManager:Scheduled")
                if fields.get("control_variable", "Temperature") == "Temperature" and
                air & nodes_of(at.model, fields.get("setpoint_node_or_nodelist_name", ""))], "add", at.values, 20)
