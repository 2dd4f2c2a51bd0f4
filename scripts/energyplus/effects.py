"""A table from hooks to EnergyPlus: every effect is an hourly series, and each hook says where it enters.

Three ways: a new object with the series as its schedule; a schedule of the model that a program changes (`changes`);
or the meters' hours after the run. Left out, and told: what no hourly series can say (a second mass, a
ground), and hooks whose objects the model does not have.

The twin foretells what EnergyPlus then shows, with a correlation over the hours of 0.9 or more (bench_energyplus_patch)
but where EnergyPlus has what the twin lacks: walls that pass heat on hours later, and let the sun in as they do
(`opaque conductance`), a thermostat in each room (`window conductance` in some hours). Ideal loads without a limit are
off where `heating available` is low; the twin's plant is only smaller.
"""
import csv
import tomllib
from dataclasses import dataclass

import numpy as np

from energyplus import inside, outside
from energyplus.failed import Failed, read_text
from energyplus.parameters import NO_LIMIT, SET_POINTS
from energyplus.place import CannotEnter, Effect, Place, change_schedules
from new_job.refused import Refused

OFF = 20                       # K, by which a set-point moves where the plant is not available
GAINS = (("People", "number_of_people_schedule_name"), ("Lights", "schedule_name"),
         ("ElectricEquipment", "schedule_name"), ("GasEquipment", "schedule_name"), ("OtherEquipment", "schedule_name"))
INFILTRATION = (("ZoneInfiltration:DesignFlowRate", "schedule_name"),
                ("ZoneInfiltration:EffectiveLeakageArea", "schedule_name"),
                ("ZoneInfiltration:FlowCoefficient", "schedule_name"))


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
    if not isinstance(given, list) or not all(isinstance(each, dict) for each in given):
        raise Failed(f"{path}: effect: is no list of sections; expected [[effect]]")
    rows = list(csv.DictReader(read_text(table, "a column for each effect").splitlines()))
    return [one_effect(path, table, each, rows, n_hours) for each in given]


def one_effect(path, table, given, rows, n_hours):
    name = given.get("name", "effect")
    for key in ("hook", "column"):
        if not isinstance(given.get(key), str):
            raise Failed(f"{path}: effect {name!r}: {key}: is missing; expected a text")
    enters = given.get("enters", "add")    # which of both it is the hook knows
    if enters not in ("add", "factor"):
        raise Failed(f'{path}: effect {name!r}: enters: {enters!r}; expected "add" or "factor"')
    return Effect(str(name), given["hook"].lower(), numbers_of(table, given["column"], rows, n_hours), given)


def move_schedule(at):
    """A change of one of the job's schedules, by run.json's table `schedules`: {name: {hook, span}}."""
    name = at.effect.says("schedule")
    said = at.schedules.get(name)
    if said is None or said.get("hook") not in HOOKS:
        raise CannotEnter(f"run.json's \"schedules\" does not say what the job's schedule {name!r} drives")
    row, span = HOOKS[said["hook"]], said.get("span", 1)
    row.enter(Place(at.model, at.changes, at.effect, at.values * span, at.of_year, at.schedules))


def leave_out(why):
    def enter(at):
        raise CannotEnter(why)
    return enter


def meter_of(effect, made, meters):
    """By its name, or by its quantity."""
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
    "outdoor air": Hook("outdoor temperature of the EPW's copy", outside.warm_outdoors),
    "supply air": Hook("outdoor temperature that zones and air systems take in", outside.warm_supply),
    "opaque boundary": Hook("SurfaceProperty:HeatBalanceSourceTerm on outer faces", outside.warm_walls),
    "window boundary": Hook("outdoor temperature that windows see", outside.warm_windows),
    "infiltration": Hook("ZoneInfiltration:DesignFlowRate; less of it as heat", inside.add_infiltration),
    "leakage": Hook("schedules of infiltration", change_schedules(INFILTRATION, "factor", least=0)),
    "ventilation": Hook("schedules of outdoor air and ZoneVentilation", inside.change_ventilation()),
    "venting": Hook("ZoneVentilation:DesignFlowRate, while the room is warm", inside.open_windows),
    "opaque conductance": Hook("insulating layers; of time: a share of conducted heat", outside.change_walls),
    "window conductance": Hook("glazing's U-value; of time: a share of U A dT", outside.change_glass),
    "neighbour": Hook("OtherEquipment by a program, where `temperature` is said", outside.add_neighbour),
    "ground": Hook("left out", leave_out("a ground is no hourly series; write its Site:GroundTemperature")),
    "second mass": Hook("left out", leave_out("a second mass is no hourly series; write an InternalMass")),
    "aperture": Hook("OtherEquipment by a program: a share of transmitted sun", outside.change_sun),
    "heat recovery": Hook("effectiveness of ideal loads and heat exchangers", inside.recover_heat),
    "economiser": Hook("economizer of ideal loads and Controller:OutdoorAir", inside.economise),
    "supply temperature": Hook("SetpointManager:Scheduled", inside.shift_supply),
    "gains": Hook("OtherEquipment", inside.add_heat),
    "loads": Hook("schedules of people, lights and equipment", change_schedules(GAINS, "factor", least=0)),
    "lights": Hook("schedules of lights", change_schedules(GAINS[1:2], "factor", least=0)),
    "equipment": Hook("schedules of equipment", change_schedules(GAINS[2:3], "factor", least=0)),
    "lights and equipment": Hook("ElectricEquipment; less of it as heat and on the meter", inside.add_equipment,
                                 less_electricity),
    "heating set-point": Hook("schedules of thermostats", change_schedules(_HEATING, "add", _NO_HEAT)),
    "cooling set-point": Hook("schedules of thermostats", change_schedules(_COOLING, "add", _NO_COLD)),
    "room spread": Hook("left out", leave_out("EnergyPlus has each room by itself")),
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
    "schedule of ventilation": Hook("schedules of outdoor air and ZoneVentilation", inside.change_ventilation("add")),
    "schedule of infiltration": Hook("schedules of infiltration", change_schedules(INFILTRATION, "add", least=0)),
}


def hook_of(effect):
    if effect.hook not in HOOKS:
        raise CannotEnter(f"the hook {effect.hook!r} is not known here")
    return HOOKS[effect.hook]


def enter(effects, model, changes, values_of_year, of_year, schedules, left_out):
    """Puts all into the model of one year; why others cannot enter goes to `left_out`, by `key`."""
    for effect in effects:
        if effect.key in left_out:
            continue
        try:
            row = hook_of(effect)
            if row.enter:
                row.enter(Place(model, changes, effect, values_of_year(effect.values), of_year, schedules))
        except (CannotEnter, Refused) as error:
            left_out[effect.key] = f"{effect.hook}: {error}"


def change_hours(effects, made, meters, area, left_out):
    """Those that enter the meters' hours, after the run."""
    for effect in effects:
        row = HOOKS.get(effect.hook)
        if row is None or row.after is None or effect.key in left_out:
            continue
        try:
            row.after(effect, made, meters, area)
        except CannotEnter as error:
            left_out[effect.key] = f"{effect.hook}: {error}"
