"""A table from hooks to EnergyPlus: every effect is an hourly series, and each hook says where it enters.

Three ways: a new object with the series as its schedule; a schedule of the model that a program changes (`changes`);
or the meters' hours after the run. Heat that depends on the room is added by a program from what the last time step
found. Heat of the air: 0.34 Wh/(m3 K). A facade is one of eight directions, or the roof. Left out, and told: what no
hourly series can say (a second mass), and hooks whose objects the model does not have.
"""
import csv
import dataclasses
import tomllib
from dataclasses import dataclass

import numpy as np

from energyplus import parameters
from energyplus.changes import PREFIX, Term
from energyplus.failed import Failed, read_text
from energyplus.hours import IDEAL
from energyplus.model import ZONE
from energyplus.parameters import NO_LIMIT, SET_POINTS, as_read
from new_job import idf_envelope, idf_geometry, idf_use
from new_job.refused import Refused

AIR_HEAT = 0.34                # Wh/(m3 K)
H_OUTSIDE = 25                 # W/(m2 K), 1 / 0.04 of ISO 6946: a shift of the boundary as heat on the outer face
OFF = 20                       # K, by which a set-point moves where the plant is not available
OPENS_ABOVE = 23               # degC of the room, where an effect does not say it
HALF = 0.5                     # share from which an economiser is on
HOURS_OF_ROOM = ("Zone Mean Air Temperature", "Site Outdoor Air Drybulb Temperature")
SIDES = ("north", "north-east", "east", "south-east", "south", "south-west", "west", "north-west")
ROOF_TILT = 22.5               # deg, below which a window is the roof's
GAINS = (("People", "number_of_people_schedule_name"), ("Lights", "schedule_name"), ("ElectricEquipment", "schedule_name"),
         ("GasEquipment", "schedule_name"), ("OtherEquipment", "schedule_name"))
INFILTRATION = (("ZoneInfiltration:DesignFlowRate", "schedule_name"),
                ("ZoneInfiltration:EffectiveLeakageArea", "schedule_name"),
                ("ZoneInfiltration:FlowCoefficient", "schedule_name"))
SIZES = ("Sizing:", "DesignSpecification:", "Controller:MechanicalVentilation")   # which size systems, and run none
RECOVERY = ("sensible_effectiveness_at_100_heating_air_flow", "sensible_effectiveness_at_100_cooling_air_flow",
            "sensible_effectiveness_at_75_heating_air_flow", "sensible_effectiveness_at_75_cooling_air_flow")


class CannotEnter(Exception):
    """An effect that the model has no place for, and why."""


@dataclass
class Effect:
    """`values`: one for each hour of all periods, in the hook's unit."""
    name: str
    hook: str
    is_factor: bool
    values: np.ndarray
    more: dict                 # all keys of its section

    def says(self, key):
        return str(self.more.get(key, ""))


@dataclass
class Place:
    """Where an effect enters: the model of one calendar year, and its hours of that year."""
    model: object
    changes: object
    effect: Effect
    values: np.ndarray
    of_year: object            # function from hours of the year to rows of EPW, for the outdoor air
    schedules: dict            # of run.json

    def series(self, values, said=""):
        return self.changes.add_series(f"{self.effect.name} {said}".strip(), values)


def numbers_of(path, column, rows, n_hours):
    try:
        values = np.array([float(row[column]) for row in rows])
    except (KeyError, TypeError, ValueError):
        raise Failed(f"{path}: column {column!r}: is not there or has a cell that is no number; expected {n_hours} "
                     "numbers below its name") from None
    if len(values) != n_hours or not np.all(np.isfinite(values)):
        raise Failed(f"{path}: has {len(values)} rows; expected {n_hours}, the hours of all periods, each a number")
    return values


def read_effects(folder, n_hours):
    """[Effect] of effects.toml and effects.csv; none where there is no such file."""
    path, table = folder / "effects.toml", folder / "effects.csv"
    if not path.exists():
        return []
    try:
        given = tomllib.loads(read_text(path, "a list of [[effect]]")).get("effect", [])
    except tomllib.TOMLDecodeError as error:
        raise Failed(f"{path}: {error}; expected TOML") from None
    rows = list(csv.DictReader(read_text(table, "a column for each effect").splitlines()))
    return [one_effect(path, table, each, rows, n_hours) for each in given]


def one_effect(path, table, given, rows, n_hours):
    name = given.get("name", "effect")
    for key in ("hook", "column"):
        if not isinstance(given.get(key), str):
            raise Failed(f"{path}: effect {name!r}: {key}: is missing; expected a text")
    enters = given.get("enters", "add")
    if enters not in ("add", "factor"):
        raise Failed(f'{path}: effect {name!r}: enters: {enters!r}; expected "add" or "factor"')
    return Effect(str(name), given["hook"].lower(), enters == "factor",
                  numbers_of(table, given["column"], rows, n_hours), given)


# Ways into the model ---------------------------------------------------------------------------------------------

def change_schedules(places, how, usual=1.0, times=1.0, least=None):
    """Of fields that name schedules: how is add or factor."""
    def enter(at):
        found = [(kind, name, fields, key) for kind, key in places for name, fields in at.model.all(kind)]
        change(at, found, how, at.values * times, usual, least)
    return enter


def change(at, found, how, values, usual=1.0, least=None):
    if not found:
        raise CannotEnter("the model has no object that it changes")
    series = at.series(values)
    for kind, name, fields, key in found:
        slot = at.changes.slot(kind, name, fields, key, usual)
        slot.terms.append(Term(how, series))
        slot.least = least


def rooms(at):
    found = at.model.conditioned()
    if not found:
        raise CannotEnter("the model has no zone with a thermostat")
    return found


def program(at, zone, said, lines, radiant=0.0):
    """Heat in a zone: lines that set `{heat}`."""
    heat = at.changes.heat(zone, said, radiant)
    for line in lines:
        at.changes.add_line(line.format(heat=heat))


def internal(at, zone, what):
    """Name of a number that a program of EMS may read, such as the zone's air volume."""
    name = at.changes.new_name(f"{what} {zone}")
    at.model.add("EnergyManagementSystem:InternalVariable", name,
                 {"internal_data_index_key_name": zone, "internal_data_type": what})
    return name


def sensors_of_room(at, zone):
    """(room's, outdoor) temperature."""
    room, outdoor = HOURS_OF_ROOM
    return at.changes.sensor(room, zone), at.changes.sensor(outdoor, "*")


def add_infiltration(at):
    """More air is an object of its own; less is the heat that the model's infiltration loses too much."""
    more, less = np.maximum(at.values, 0), np.minimum(at.values, 0)
    series = at.series(more, "more") if more.any() else None
    fewer = at.series(less, "less") if less.any() else None
    for zone in rooms(at):
        if series:
            at.model.add("ZoneInfiltration:DesignFlowRate", at.changes.new_name(f"{at.effect.name} {zone}"), {
                ZONE: zone, "schedule_name": series, "design_flow_rate_calculation_method": "AirChanges/Hour",
                "air_changes_per_hour": 1, "constant_term_coefficient": 1, "temperature_term_coefficient": 0,
                "velocity_term_coefficient": 0, "velocity_squared_term_coefficient": 0})
        if fewer:
            (room, outdoor), volume = sensors_of_room(at, zone), internal(at, zone, "Zone Air Volume")
            program(at, zone, at.effect.name, [f"SET {{heat}} = {AIR_HEAT} * {volume} * {outdoor} - {AIR_HEAT} * "
                                               f"{volume} * {room}",
                                               f"SET {{heat}} = {{heat}} * {at.changes.sensor('Schedule Value', fewer)}"])


def open_windows(at):
    series, above = at.series(np.maximum(at.values, 0)), at.effect.more.get("opens_above", OPENS_ABOVE)
    for zone in rooms(at):
        at.model.add("ZoneVentilation:DesignFlowRate", at.changes.new_name(f"{at.effect.name} {zone}"), {
            ZONE: zone, "schedule_name": series, "design_flow_rate_calculation_method": "AirChanges/Hour",
            "air_changes_per_hour": 1, "ventilation_type": "Natural", "constant_term_coefficient": 1,
            "temperature_term_coefficient": 0, "velocity_term_coefficient": 0, "velocity_squared_term_coefficient": 0,
            "minimum_indoor_temperature": above, "delta_temperature": 0})


def change_ventilation(how):
    """Outdoor air of ideal loads and terminals, of controllers, and ventilation of zones."""
    def enter(at):
        referred = {str(value).lower() for kind in at.model.objects if not kind.startswith(SIZES)
                    for _, fields in at.model.all(kind) for key, value in fields.items()
                    if key.startswith("design_specification_outdoor_air")}
        found = [("ZoneVentilation:DesignFlowRate", name, fields, "schedule_name")
                 for name, fields in at.model.all("ZoneVentilation:DesignFlowRate") if not name.startswith(PREFIX)]
        found += [("DesignSpecification:OutdoorAir", name, fields, "outdoor_air_schedule_name")
                  for name, fields in at.model.all("DesignSpecification:OutdoorAir") if name.lower() in referred]
        found += [("Controller:OutdoorAir", name, fields, "minimum_outdoor_air_schedule_name")
                  for name, fields in at.model.all("Controller:OutdoorAir")]
        change(at, found, how, at.values, 1.0, 0)
    return enter


def add_heat(at):
    """Heat that no meter sees, half of it radiant. EnergyPlus takes a power below 0 from a program alone."""
    more, less = np.maximum(at.values, 0), np.minimum(at.values, 0)
    if more.any():
        add_power(at, "OtherEquipment", "power_per_floor_area", more, fuel_type="None")
    if less.any():
        series = at.changes.sensor("Schedule Value", at.series(less, "less"))
        for zone in rooms(at):
            program(at, zone, at.effect.name, [f"SET {{heat}} = {internal(at, zone, 'Zone Floor Area')} * {series}"], 0.5)


def add_power(at, kind, key, values, **more):
    """An object of 1 W/m2 in each zone, whose schedule is the series."""
    series = at.series(values, "more")
    for zone in rooms(at):
        at.model.add(kind, at.changes.new_name(f"{at.effect.name} {zone}"), {
            ZONE: zone, "schedule_name": series, "design_level_calculation_method": "Watts/Area", key: 1,
            "fraction_latent": 0, "fraction_radiant": 0.5, "fraction_lost": 0, **more})


def add_equipment(at):
    """More is equipment; less is heat that is taken away, and the meter's hours afterwards."""
    more, less = np.maximum(at.values, 0), np.minimum(at.values, 0)
    if more.any():
        add_power(at, "ElectricEquipment", "watts_per_floor_area", more)
    if less.any():
        add_heat(dataclasses.replace(at, values=less))


def geometry(at):
    try:
        return idf_geometry.read_zones(as_read(at.model))
    except Refused as error:
        raise CannotEnter(f"its geometry is not read: {error}") from None


def facade_of(surface):
    return "roof" if surface.tilt < ROOF_TILT else SIDES[round(surface.azimuth / 45) % 8]


def windows(at):
    """[(zone, opening, surface)] of conditioned zones on the effect's facade."""
    conditioned, facade = {zone.lower() for zone in at.model.conditioned()}, at.effect.says("facade")
    found = [(zone.given.name, opening, surface) for key, zone in geometry(at).items() if key in conditioned
             for surface in zone.surfaces if surface.outside == "outdoors" for opening in surface.openings
             if opening.is_glass and facade in ("", facade_of(surface))]
    if not found:
        raise CannotEnter(f"there is no window{' to the ' + facade if facade else ''}")
    return found


def change_sun(at):
    """The share of the sun through windows that comes or goes, as radiant heat in the zone."""
    series, of_zone = at.changes.sensor("Schedule Value", at.series(at.values)), {}
    for zone, opening, _ in windows(at):
        of_zone.setdefault(zone, []).append(
            at.changes.sensor("Surface Window Transmitted Solar Radiation Rate", opening.given.name))
    for zone, suns in of_zone.items():
        program(at, zone, at.effect.name, ["SET {heat} = 0", *(f"SET {{heat}} = {{heat}} + {sun}" for sun in suns),
                                           f"SET {{heat}} = {{heat}} * {series}"], radiant=1.0)


def is_constant(at):
    return np.ptp(at.effect.values) < 1e-9


def change_walls(at):
    """A constant factor on U-values is that; one of time is its share of the heat that outer surfaces conduct."""
    if is_constant(at):
        for name in parameters.OPAQUE:
            parameters.scale_opaque(at.model, name, 1 + at.values.max())
        return
    series, conditioned = at.changes.sensor("Schedule Value", at.series(at.values)), set(rooms(at))
    of_zone = {}
    for kind in parameters.SURFACES[:3]:
        for name, fields in at.model.all(kind):
            zone = next(iter(at.model.zones_named(fields.get("zone_name", ""))), None)
            if zone in conditioned and fields.get("outside_boundary_condition", "").lower() == "outdoors":
                of_zone.setdefault(zone, []).append(
                    at.changes.sensor("Surface Inside Face Conduction Heat Transfer Rate", name))
    for zone, flows in of_zone.items():
        program(at, zone, at.effect.name, ["SET {heat} = 0", *(f"SET {{heat}} = {{heat}} + {flow}" for flow in flows),
                                           f"SET {{heat}} = {{heat}} * {series}"], radiant=1.0)


def change_glass(at):
    """A constant factor on U-values is that; one of time is its share of U A times the difference of temperature."""
    if is_constant(at):
        parameters.scale_windows(at.model, "u_factor", 1 + at.values.max())
        return
    series, read, of_zone = at.changes.sensor("Schedule Value", at.series(at.values)), as_read(at.model), {}
    for zone, opening, _ in windows(at):
        of_zone[zone] = of_zone.get(zone, 0) + opening.area * idf_envelope.glazing_of(read, opening.given).u_value
    for zone, conductance in of_zone.items():
        room, outdoor = sensors_of_room(at, zone)
        program(at, zone, at.effect.name, [f"SET {{heat}} = {conductance:.4f} * {outdoor} - {conductance:.4f} * {room}",
                                           f"SET {{heat}} = {{heat}} * {series}"], radiant=0.5)


def add_neighbour(at):
    """A conductance per floor area to another temperature, which the effect has to say."""
    column = at.effect.more.get("temperature")
    if not isinstance(column, (int, float)):
        raise CannotEnter("its series has the conductance, but no key says the temperature behind it")
    series = at.changes.sensor("Schedule Value", at.series(at.values))
    for zone in rooms(at):
        (room, _), area = sensors_of_room(at, zone), internal(at, zone, "Zone Floor Area")
        program(at, zone, at.effect.name, [f"SET {{heat}} = {column} * {area} - {room} * {area}",
                                           f"SET {{heat}} = {{heat}} * {series}"], radiant=0.5)


def outer(at, kinds):
    """Names of surfaces to outdoors."""
    return [name for kind in kinds for name, fields in at.model.all(kind)
            if fields.get("outside_boundary_condition", "").lower() == "outdoors"]


def warm_walls(at):
    """The shift of the boundary as heat on outer faces: K times 1 / 0.04 W/(m2 K)."""
    names = outer(at, parameters.SURFACES[:3])
    if not names:
        raise CannotEnter("the model has no opaque surface to outdoors that is described by its corners")
    series = at.series(at.values * H_OUTSIDE)
    for name in names:
        at.model.add("SurfaceProperty:HeatBalanceSourceTerm", at.changes.new_name(f"{at.effect.name} {name}"),
                     {"surface_name": name, "outside_face_heat_source_term_schedule_name": series})


def shift_air(at, component, kind, control, series):
    act, outdoor = at.changes.actuator(component, kind, control), at.changes.sensor(HOURS_OF_ROOM[1], "*")
    at.changes.add_line(f"SET {act} = {outdoor} + {series}")


def warm_windows(at):
    """The air that windows see."""
    names = [opening.given.name for _, opening, _ in windows(at)]
    series = at.changes.sensor("Schedule Value", at.series(at.values))
    for name in names:
        shift_air(at, name, "Surface", "Outdoor Air Drybulb Temperature", series)


def warm_supply(at):
    """Outdoor air that zones and air systems take in."""
    series = at.changes.sensor("Schedule Value", at.series(at.values))
    for zone in rooms(at):
        shift_air(at, zone, "Zone", "Outdoor Air Drybulb Temperature", series)
    for _, fields in at.model.all("OutdoorAir:Node"):
        shift_air(at, fields["name"], "Outdoor Air System Node", "Drybulb Temperature", series)


def usual_value(values):
    """Mean where it acts."""
    acts = values[values != 0]
    return float(acts.mean()) if len(acts) else 0.0


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


def economise(at):
    """On for all hours where its share is a half or more."""
    count = 0
    if usual_value(at.effect.values) < HALF:
        raise CannotEnter(f"its share is below {HALF}, and EnergyPlus has none or all of it")
    for _, fields in at.model.all("Controller:OutdoorAir"):
        fields["economizer_control_type"] = "DifferentialDryBulb"
        count += 1
    for _, fields in at.model.all(IDEAL[0]):
        if fields.get("design_specification_outdoor_air_object_name") and "FlowRate" in fields.get("cooling_limit", ""):
            fields["outdoor_air_economizer_type"] = "DifferentialDryBulb"
            count += 1
    if not count:
        raise CannotEnter("the model has no Controller:OutdoorAir, and no ideal loads with a limit of cooling air")


def shift_supply(at):
    found = [("SetpointManager:Scheduled", name, fields, "schedule_name") for name, fields in
             at.model.all("SetpointManager:Scheduled") if fields.get("control_variable", "Temperature") == "Temperature"]
    change(at, found, "add", at.values, 20)


def move_schedule(at):
    """A change of one of the job's schedules, by run.json's table `schedules`: {name: {hook, span}}."""
    name = at.effect.says("schedule")
    said = at.schedules.get(name)
    if said is None or said.get("hook") not in HOOKS:
        raise CannotEnter(f"run.json's \"schedules\" does not say what the job's schedule {name!r} drives")
    row, span = HOOKS[said["hook"]], said.get("span", 1)
    row.enter(Place(at.model, at.changes, at.effect, at.values * span, at.of_year, at.schedules))


def warm_outdoors(at):
    at.of_year(at.values)


def leave_out(why):
    def enter(at):
        raise CannotEnter(why)
    return enter


# After the run ------------------------------------------------------------------------------------------------------

def meter_of(effect, made, meters):
    said = effect.says("meter")
    quantity = next((meter["quantity"] for meter in meters if meter["name"] == said), said)
    if quantity not in made:
        raise CannotEnter(f"it names the meter {said!r}, which run.json does not have")
    return made[quantity]


def add_to_meter(effect, made, meters, area):
    meter_of(effect, made, meters).total += effect.values * area / 1000


def scale_meter(effect, made, meters, area):
    meter_of(effect, made, meters).total *= 1 + effect.values


def less_electricity(effect, made, meters, area):
    made["electricity"].total += np.minimum(effect.values, 0) * area / 1000


def divide(part):
    """The part of each meter that heats or cools, by an efficiency that is 1 + series times as high."""
    def after(effect, made, meters, area):
        if (effect.values <= -1).any():
            raise CannotEnter("its factor is 0 or below in some hours")
        for energy in made.values():
            change_of = getattr(energy, part) * (1 / (1 + effect.values) - 1)
            energy.total = energy.total + change_of
            setattr(energy, part, getattr(energy, part) + change_of)
    return after


@dataclass(frozen=True)
class Hook:
    """`enter` changes the model before the run, `after` the hours."""
    says: str
    enter: object = None
    after: object = None


_HEATING, _COOLING = SET_POINTS["heating_set_point"], SET_POINTS["cooling_set_point"]
_NO_HEAT, _NO_COLD = NO_LIMIT["heating_set_point"], NO_LIMIT["cooling_set_point"]
HOOKS = {
    "outdoor air": Hook("outdoor temperature of the EPW's copy", warm_outdoors),
    "supply air": Hook("outdoor temperature that zones and OutdoorAir:Node see", warm_supply),
    "opaque boundary": Hook("SurfaceProperty:HeatBalanceSourceTerm on outer faces", warm_walls),
    "window boundary": Hook("outdoor temperature that windows see", warm_windows),
    "infiltration": Hook("ZoneInfiltration:DesignFlowRate; less of it as heat", add_infiltration),
    "leakage": Hook("schedules of infiltration", change_schedules(INFILTRATION, "factor", least=0)),
    "ventilation": Hook("schedules of outdoor air and ZoneVentilation", change_ventilation("factor")),
    "venting": Hook("ZoneVentilation:DesignFlowRate, while the room is warm", open_windows),
    "opaque conductance": Hook("insulating layers; of time: a share of conducted heat", change_walls),
    "window conductance": Hook("glazing's U-value; of time: a share of U A dT", change_glass),
    "neighbour": Hook("OtherEquipment by a program, where `temperature` is said", add_neighbour),
    "second mass": Hook("left out", leave_out("a second mass is no hourly series; write an InternalMass")),
    "aperture": Hook("OtherEquipment by a program: a share of transmitted sun", change_sun),
    "heat recovery": Hook("effectiveness of ideal loads and heat exchangers", recover_heat),
    "economiser": Hook("economizer of ideal loads and Controller:OutdoorAir", economise),
    "supply temperature": Hook("SetpointManager:Scheduled", shift_supply),
    "gains": Hook("OtherEquipment", add_heat),
    "loads": Hook("schedules of people, lights and equipment", change_schedules(GAINS, "factor", least=0)),
    "lights and equipment": Hook("ElectricEquipment; less of it as heat and on the meter", add_equipment, less_electricity),
    "heating set-point": Hook("schedules of thermostats", change_schedules(_HEATING, "add", _NO_HEAT)),
    "cooling set-point": Hook("schedules of thermostats", change_schedules(_COOLING, "add", _NO_COLD)),
    "heating available": Hook("schedules of thermostats", change_schedules(_HEATING, "add", _NO_HEAT, OFF)),
    "cooling available": Hook("schedules of thermostats", change_schedules(_COOLING, "add", _NO_COLD, -OFF)),
    "operation": Hook("the schedule's own hook", move_schedule),
    "occupation": Hook("the schedule's own hook", move_schedule),
    "plant operation": Hook("the schedule's own hook", move_schedule),
    "heating efficiency": Hook("hours: the part of meters that heats", after=divide("heating")),
    "cooling cop": Hook("hours: the part of meters that cools", after=divide("cooling")),
    "meter addition": Hook("hours of the meter", after=add_to_meter),
    "meter factor": Hook("hours of the meter", after=scale_meter),
    # Schedules of a job, for `schedules` of run.json.
    "schedule of people": Hook("schedules of people", change_schedules(GAINS[:1], "add", least=0)),
    "schedule of lights": Hook("schedules of lights", change_schedules(GAINS[1:2], "add", least=0)),
    "schedule of equipment": Hook("schedules of equipment", change_schedules(GAINS[2:3], "add", least=0)),
    "schedule of ventilation": Hook("schedules of outdoor air and ZoneVentilation", change_ventilation("add")),
    "schedule of infiltration": Hook("schedules of infiltration", change_schedules(INFILTRATION, "add", least=0)),
}


def hook_of(effect):
    if effect.hook not in HOOKS:
        raise CannotEnter(f"the hook {effect.hook!r} is not known here")
    return HOOKS[effect.hook]


def enter(effects, model, changes, values_of_year, of_year, schedules, left_out):
    """Puts all into the model of one year; (effect, why) of others go to `left_out`."""
    for effect in effects:
        if effect.name in left_out:
            continue
        try:
            row = hook_of(effect)
            if row.enter:
                row.enter(Place(model, changes, effect, values_of_year(effect.values), of_year, schedules))
        except (CannotEnter, Failed, Refused) as error:
            left_out[effect.name] = f"{effect.hook}: {error}"


def change_hours(effects, made, meters, area, left_out):
    """Those that enter the meters' hours, after the run."""
    for effect in effects:
        row = HOOKS.get(effect.hook)
        if row is None or row.after is None or effect.name in left_out:
            continue
        try:
            row.after(effect, made, meters, area)
        except CannotEnter as error:
            left_out[effect.name] = f"{effect.hook}: {error}"
