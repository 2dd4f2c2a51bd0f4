"""A place where an effect enters: the model of one calendar year, and small steps that several hooks share.

A program of EMS adds heat from what the last time step found; schedules that it changes are in `changes`.
"""
from dataclasses import dataclass

import numpy as np

from energyplus.changes import Term

HOURS_OF_ROOM = ("Zone Mean Air Temperature", "Site Outdoor Air Drybulb Temperature")


class CannotEnter(Exception):
    """An effect that the model has no place for, and why."""


@dataclass
class Effect:
    """`values`: one for each hour of all periods, in the hook's unit."""
    name: str
    hook: str
    values: np.ndarray
    more: dict                 # all keys of its section

    @property
    def key(self):
        """(name, column): one effect may have several columns, for several schedules."""
        return self.name, self.says("column")

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

    def schedule(self, values, said=""):
        """For a field that names one."""
        return self.changes.act(self.series(values, said))


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


def nodes_of(model, said):
    """Names, in small letters, of a node or a list of nodes."""
    listed = model.find("NodeList", said) or {}
    return {str(row.get("node_name", "")).lower() for row in listed.get("nodes", [])} or {str(said).lower()}


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


def nodes_of(model, said):
    """Names, in small letters, of a node or a list of nodes."""
    listed = model.find("NodeList", said) or {}
    return {str(row.get("node_name", "")).lower() for row in listed.get("nodes", [])} or {str(said).lower()}


def usual_value(values):
    """Mean where it acts."""
    acts = values[values != 0]
    return float(acts.mean()) if len(acts) else 0.0


def is_constant(at):
    return np.ptp(at.effect.values) < 1e-9
