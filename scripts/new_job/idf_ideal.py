"""What the ideal loads of an EnergyPlus file say beyond their outdoor air: which fuel they burn, how efficiently, what
heat they recover, how much they give at most, and when.

Source: EnergyPlus Input Output Reference, ZoneHVAC:IdealLoadsAirSystem. Of an efficiency that changes with time the
mean of the year is taken. What is not read is told: seasons, flow limits, moisture, economizers.
"""
import math

import numpy as np

SYSTEM, TEMPLATE = "ZoneHVAC:IdealLoadsAirSystem", "HVACTemplate:Zone:IdealLoadsAirSystem"
MODES = ("heating", "cooling")
# {mode: (field of the fuel, field of its efficiency, EnergyPlus's fuel: heat or cold from elsewhere)}
FUELS = {"heating": ("heating_fuel_type", "heating_fuel_efficiency_schedule_name", "districtheatingwater"),
         "cooling": ("cooling_fuel_type", "cooling_fuel_efficiency_schedule_name", "districtcooling")}
CAPACITIES = {"heating": "maximum_sensible_heating_capacity", "cooling": "maximum_total_cooling_capacity"}
EFFECTIVENESS = 0.7            # sensible, EnergyPlus's where the field is empty
# (field, values in small letters that are told, what is left out)
TOLD = (("demand_controlled_ventilation_type", ("co2setpoint",), "outdoor air by CO2; the most of it is taken"),
        ("outdoor_air_economizer_type", ("differentialdrybulb", "differentialenthalpy"),
         "economizers; venting_air_change may stand for them"),
        ("heat_recovery_type", ("enthalpy",), "recovery of latent heat; that of sensible heat is read"),
        ("humidification_control_type", ("humidistat", "constantsupplyhumidityratio"), "humidification"),
        *((f"{mode}_limit", ("limitflowrate", "limitflowrateandcapacity"),
           f"limits of the air flow of {mode}; {mode}_capacity may stand for them") for mode in MODES))
LEAST_EFFICIENCY, MOST_EFFICIENCY = 0.01, 20     # as of other machines


def fuels_of(model, schedules, mode):
    """[(fuel in small letters, efficiency or COP)] of each; none where all leave heat or cold, as it is, to a plant
    that is not in the file."""
    fuel, key, elsewhere = FUELS[mode]
    found = [(each.word(fuel, elsewhere), efficiency_of(model, schedules, each, key)) for each in model.all(SYSTEM)]
    return found if any(pair != (elsewhere, 1) for pair in found) else []


def efficiency_of(model, schedules, system, key):
    profile = schedules.of(system, key)
    value = float(profile.mean() if np.ptp(profile) else profile.flat[0])
    if not LEAST_EFFICIENCY <= value <= MOST_EFFICIENCY:
        system.refuse(key, f"{system.text(key)!r} is {value:g} in the mean; expected a number from "
                           f"{LEAST_EFFICIENCY:g} to {MOST_EFFICIENCY:g}")
    if np.ptp(profile) > 0:
        model.checks.append(f"{system.kind}: {key}: {system.text(key)} changes over the year; its mean {value:.3g} was "
                            "taken")
    return value


def effectiveness(system):
    """Share of the sensible heat of outdoor air that a system recovers."""
    if system.word("heat_recovery_type", "none") == "none":
        return 0
    return system.number("sensible_heat_recovery_effectiveness", EFFECTIVENESS, 0, 1)


def is_by_people(system):
    """Whether outdoor air follows the people that are there."""
    return system.word("demand_controlled_ventilation_type") == "occupancyschedule"


def availability(schedules, system, *modes):
    """Profile of 1 where a system is on, and each of the modes is."""
    keys = ("availability_schedule_name", "system_availability_schedule_name",
            *(f"{mode}_availability_schedule_name" for mode in modes))
    return math.prod((schedules.of(system, key) > 0).astype(float) for key in keys)


def capacity(schedules, system, mode):
    """[W] at the most; 0 of a system that never does it, infinite without a limit or where EnergyPlus finds it."""
    if not availability(schedules, system, mode).any():
        return 0
    limited = "capacity" in system.word(f"{mode}_limit")
    return system.number(CAPACITIES[mode], math.inf, 0, 1e12) if limited else math.inf


def left_out_of(model, schedules):
    """Lines on what no job is given of them."""
    systems = model.all(SYSTEM, TEMPLATE)
    for key, values, says in TOLD:
        told = [each for each in systems if each.word(key) in values]
        if told:
            yield f"{len(told)} {told[0].kind}: {key}: {says}"
    for mode in MODES:
        told = [each for each in systems if 0 < availability(schedules, each, mode).mean() < 1]
        if told:
            on = np.mean([availability(schedules, each, mode).mean() for each in told])
            yield f"{len(told)} {told[0].kind}: {mode} is off in {1 - on:.0%} of the year; {mode}_limit of the zone, " \
                  "or a schedule, may stand for it"
        found = [each for each in systems if "capacity" in each.word(f"{mode}_limit")
                 and math.isinf(capacity(schedules, each, mode))]
        if found:
            yield f"{len(found)} {found[0].kind}: {mode} capacities that EnergyPlus finds; write {mode}_capacity"


def left_out_of_whole(model, schedules, mode):
    """Lines on limits of some zones, where all zones are one."""
    if any(math.isfinite(capacity(schedules, each, mode)) for each in model.all(SYSTEM, TEMPLATE)):
        yield f"limits of {mode} that some zones have; with --rooms each has its own"
