"""What the ideal loads of an EnergyPlus file say beyond their outdoor air: which fuel they burn, how efficiently.

Source: EnergyPlus Input Output Reference, ZoneHVAC:IdealLoadsAirSystem. Of an efficiency that changes with time the
mean of the year is taken.
"""
import numpy as np

SYSTEM = "ZoneHVAC:IdealLoadsAirSystem"
# {mode: (field of the fuel, field of its efficiency, EnergyPlus's fuel: heat or cold from elsewhere)}
FUELS = {"heating": ("heating_fuel_type", "heating_fuel_efficiency_schedule_name", "districtheatingwater"),
         "cooling": ("cooling_fuel_type", "cooling_fuel_efficiency_schedule_name", "districtcooling")}
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
