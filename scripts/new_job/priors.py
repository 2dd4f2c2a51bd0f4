"""Parameters of a first job: what nobody knows of a building, with wide priors about what is described.

Ranges are four standard deviations wide, cut at what is possible. A use of energy that the meters show to be larger
has a range that reaches there. Source of the widths: those of jobs/cambridge_loops, which hold what a box by
area and storeys leaves open; wider where a table was missing.
"""
import json
from dataclasses import dataclass

from cases.toml import number
from new_job.building import air_change

MOST_U = 9.9                   # W/(m2 K), that a job takes
SHARE_OF_LOADS = 0.5           # standard deviation of lights and equipment
LEAST_POWER = 5                # W/m2, half of what a passive house needs (10: criteria of the Passive House Institute)
USUAL_POWERS = {"heating": (100, 40), "cooling": (90, 30)}   # W/m2, and standard deviation
HEAT_CAPACITIES = (80000, 600000, 165000, 1e5)  # J/(m2 K): least, most, ISO 13790 class medium, sd
# Standard deviation of a heat capacity by layers, as a share: how deep a day reaches, and furniture, are conventions.
# Twice of it is a little more than from a class of ISO 13790, Table 12 to the next, 1.5 times as heavy.
SD_OF_LAYERS = 0.3
LEAST_OF_LAYERS = 0.5          # share of it, below which layers would have to be missing


@dataclass(frozen=True)
class Prior:
    name: str
    targets: tuple
    least: float
    most: float
    mean: float
    sd: float
    says: str
    mode: str = "replace"

    def text(self):
        mode = "" if self.mode == "replace" else f'mode = "{self.mode}"\n'
        least, most, mean, sd = (number(float(f"{value:.3g}")) for value in (self.least, self.most, self.mean, self.sd))
        return (f'[[parameter]]\nname = "{self.name}"{" " * max(1, 20 - len(self.name))}# {self.says}\n'
                f"target = {json.dumps(list(self.targets))}\n{mode}min = {least}\nmax = {most}\n"
                f'prior = {{kind = "normal", mean = {mean}, sd = {sd}}}\n')


def level(name, targets, value, sd, says, least=0.0, reach=0.0, most=1e9):
    """A number that the parameter replaces; `reach`: what the range has to hold."""
    return Prior(name, tuple(targets), max(least, value - 4 * sd), min(most, max(value + 4 * sd, reach)), value, sd,
                 says)


def shift(name, targets, width, sd, says):
    return Prior(name, tuple(targets), -width, width, 0, sd, says, "offset")


def factor(name, targets, least, most, sd, says):
    return Prior(name, tuple(targets), least, most, 1, sd, says, "factor")


def priors_of(first):
    """`first`: the job.First that is written."""
    envelope, use, zone = first.envelope, first.use, "zone.building"
    largest = max(envelope.wall, envelope.roof, envelope.floor, envelope.window)
    yield factor("envelope", ["construction.*.u_value", "glazing.window.u_value"], 0.3, min(2.5, MOST_U / largest),
                 envelope.sd, "on all U-values")
    if first.is_hourly:
        yield level("g_window", ["glazing.window.solar_transmittance"], envelope.g * 0.8, 0.2,
                    "with blinds and shade", 0.05, most=0.9)
    yield level("infiltration", [f"{zone}.flow.infiltration.air_change"], envelope.infiltration, 0.3, "[1/h]", 0.05)
    fresh = air_change(use, first.form)
    yield level("ventilation", [f"{zone}.flow.ventilation.air_change"], fresh, 0.5 * fresh + 0.2, "[1/h] in use")
    yield factor("lights_and_equipment", [f"{zone}.load.{load.name}.density" for load in first.loads
                                          if load.name in ("lights", "equipment")], 0.05, first.most_of_loads,
                 SHARE_OF_LOADS, "on both")
    for load in first.loads:
        if load.name == "people":
            yield level("people", [f"{zone}.load.people.density"], load.value, SHARE_OF_LOADS * load.value,
                        "[W/m2] in use")
        if load.name in ("base_load", "hot_water"):
            yield level(load.name, [f"{zone}.load.{load.name}.density"], load.value,
                        max(0.5 * load.value, 0.25 * load.most, 0.3), "[W/m2] at all hours", reach=load.most)
    yield from plant_priors(first, lambda key: [f"{zone}.{key}"])


def plant_priors(first, targets):
    """`targets` of a key of a zone."""
    plant = first.plant
    if plant.heating != "none" or first.has("heating") or first.has("air_temperature"):
        yield shift("heating_set_point", targets("heating_set_point"), 4, 1.2, "[K]")
        yield shift("heating_set_back", targets("heating_set_point.low"), 6, 2, "[K]")
        if first.is_hourly:
            yield from capacity(first, "heating", targets)
    if plant.efficiency_sd:
        yield Prior("heating_efficiency", ("plant.heating_efficiency",), *plant.efficiency_range, plant.efficiency,
                    plant.efficiency_sd, "seasonal, with losses of distribution")
    if plant.cooling:
        yield shift("cooling_set_point", targets("cooling_set_point"), 4, 1.5, "[K]")
        yield shift("cooling_set_back", targets("cooling_set_point.low"), 5, 2, "[K]")
        if first.is_hourly:
            yield from capacity(first, "cooling", targets)
    if plant.cooling == "electricity":
        yield level("cooling_cop", ["plant.cooling_cop"], plant.cop, 0.8, "with pumps and fans of the plant", 1.2,
                    most=max(6, 1.3 * plant.cop))
    if first.is_hourly:
        least, most, mean, sd = heat_capacities(first)
        yield Prior("heat_capacity", tuple(targets("heat_capacity")), least, most, mean, sd, "[J/(m2 K)]")


def capacity(first, mode, targets):
    """Of a file's limit, which is as uncertain as the usual one; nothing of a plant that never does it."""
    name, (usual, sd) = f"{mode}_capacity", USUAL_POWERS[mode]
    limit = getattr(first.model.whole, name) if first.model else None
    value = usual if limit is None else limit
    if value:
        yield level(name, targets(name), value, sd * value / usual, "[W/m2]", min(LEAST_POWER, value / 2))


def heat_capacities(first):
    """(least, most, mean, sd) [J/(m2 K)]: by the file's layers where there is one."""
    least, most, *_ = HEAT_CAPACITIES
    if first.model is None:
        return HEAT_CAPACITIES
    value = first.model.whole.shell.capacity(first.model.whole.area)
    return min(least, LEAST_OF_LAYERS * value), max(most, (1 + 4 * SD_OF_LAYERS) * value), value, SD_OF_LAYERS * value
