"""An air handler that supplies the zone while its plant runs: structure, not an effect.

Outdoor air is mixed with what returns from the zone, a fan warms it, coils cool or heat it.
Single zone: the flow is constant, the coils follow the zone's thermostat. VAV with terminal reheat:
the supply temperature follows a reset, the flow follows the zone between a least and the design
flow, and what the least flow cools too much is heated again at the boxes.
An economiser takes more outdoor air where that saves cooling. A cold coil dries the outdoor air.

Left out: the moisture that people add, leaks of ducts, a limit of the coils of a VAV handler, and
zones beside each other of which some heat while others cool. At night the zone is heated and cooled
without air.
"""
from dataclasses import dataclass

import numpy as np

from construction import RHO_C_AIR
from drives import humidity_ratio
from meters import LATENT_HEAT

SINGLE_ZONE, VAV = "single zone", "VAV with terminal reheat"
RESET = (5.0, 20.0)        # outdoor temperatures between which the supply's goes from warm to cold [degC]
FAN_AT_REST = 0.15         # share of a VAV fan's power that does not follow the flow
FAN_EXPONENT = 2.5         # of power over flow
HIGH_LIMIT = 18.0          # no economiser when it is warmer outside, for then the air is too moist [degC]
FREE_COOLING_BAND = 1.0    # below the cooling set-point, over which dampers of one zone open [K]
RHO_AIR = 1.2              # [kg/m3]


@dataclass(frozen=True)
class AirSystem:
    kind: str
    supply: float          # design flow [1/h]
    supply_cold: float     # when it is RESET[1] or warmer outside [degC]
    supply_warm: float     # when it is RESET[0] or colder
    fan_heat: float        # share of the fan's power that warms the air
    economiser: bool
    least_flow: float      # of VAV boxes, as a share of the design flow
    is_declared: bool      # in building.json


@dataclass(frozen=True)
class AirStep:
    """What the air does in a step: to the zone, and what is needed to reckon the coils after it."""
    outdoor: float         # to the zone at the outdoor temperature [m3/s]
    supply: float          # to the zone at the supply temperature [m3/s]
    theta_supply: float    # of a VAV handler; the coldest of a single zone [degC]
    gain: float            # to the zone's air [W]
    most_cooling: float    # that the flow can carry [W]
    theta_before: float    # of the zone [degC]


@dataclass(frozen=True)
class Coils:
    """What the handler adds to the plant's loads beside the zone's, and its fan, all [W]."""
    heating: float
    cooling: float
    fan: float


def design_flow(office):
    return office.air_system.supply * office.volume / 3600


def supply_temperature(system, theta_e):
    return float(np.interp(theta_e, RESET, (system.supply_warm, system.supply_cold)))


def fan_power(office, flow):
    design = design_flow(office)
    share = FAN_AT_REST + (1 - FAN_AT_REST) * (flow / design) ** FAN_EXPONENT
    return office.fan_power * 1000 * design * (share if office.air_system.kind == VAV else 1.0)


def fan_rise(office, flow):
    return office.air_system.fan_heat * fan_power(office, flow) / (RHO_C_AIR * flow)


def cools_freely(system, theta_e, theta_air):
    return system.economiser and theta_e < min(HIGH_LIMIT, theta_air - 1)


def mixed(theta_air, theta_e, share, recovery):
    """Temperature before fan and coils; heat is recovered from the share that leaves."""
    return theta_air + share * (1 - recovery) * (theta_e - theta_air)


def latent(d, k, outdoor, theta_coil):
    """Moisture of the outdoor air that condenses on the coil [W]."""
    moisture = d.humidity_ratio[k] - humidity_ratio(theta_coil, 100.0)
    return RHO_AIR * outdoor * max(moisture, 0.0) * LATENT_HEAT


# --- one zone

def dampers(office, d, k, theta_air):
    """Outdoor air [m3/s]: the least, or more while that cools a zone that is nearly too warm."""
    least, design = d.fresh_air[k], max(design_flow(office), d.fresh_air[k])
    if not cools_freely(office.air_system, d.theta_e[k], theta_air):
        return least
    above = (theta_air - d.cooling_set[k]) / FREE_COOLING_BAND + 1
    return least + (design - least) * min(max(above, 0.0), 1.0)


def single_zone_step(office, d, k, theta_air):
    flow, outdoor = design_flow(office), dampers(office, d, k, theta_air)
    recovery = d.recovery[k] if outdoor == d.fresh_air[k] else 0.0
    before_coil = mixed(theta_air, d.theta_e[k], outdoor / flow, recovery) + fan_rise(office, flow)
    coldest = supply_temperature(office.air_system, d.theta_e[k])
    return AirStep(outdoor * (1 - recovery), 0.0, coldest,
                   office.air_system.fan_heat * fan_power(office, flow),
                   max(RHO_C_AIR * flow * (before_coil - coldest), 0.0), theta_air)


def single_zone_coils(office, d, k, air, asked_cooling):
    flow = design_flow(office)
    if asked_cooling <= 0:
        return Coils(0.0, 0.0, fan_power(office, flow))
    before_coil = air.theta_supply + air.most_cooling / (RHO_C_AIR * flow)
    leaving = before_coil - asked_cooling / (RHO_C_AIR * flow)
    outdoor = max(air.outdoor, d.fresh_air[k])
    return Coils(0.0, latent(d, k, outdoor, leaving), fan_power(office, flow))


# --- VAV

def vav_step(office, d, k, theta_air):
    system, design = office.air_system, design_flow(office)
    least = max(system.least_flow * design, d.fresh_air[k])
    theta = supply_temperature(system, d.theta_e[k])
    more = max(design - least, 0.0)
    return AirStep(0.0, least, theta, 0.0, max(RHO_C_AIR * more * (theta_air - theta), 0.0),
                   theta_air)


def outdoor_share(system, least, theta_e, theta_air, wanted):
    """Of the flow: the least, or what brings the mixed air nearest to the wanted temperature."""
    if not cools_freely(system, theta_e, theta_air):
        return least
    return min(max((theta_air - wanted) / (theta_air - theta_e), least), 1.0)


def vav_coils(office, d, k, air, asked_cooling):
    """The handler cools or heats all its air to the supply temperature. Of that the zone has already
    asked for what cools it beyond the least flow."""
    carried = RHO_C_AIR * (air.theta_before - air.theta_supply)
    flow = air.supply + (asked_cooling / carried if carried > 0 else 0.0)
    rise = fan_rise(office, flow)
    least = d.fresh_air[k] / flow
    share = outdoor_share(office.air_system, least, d.theta_e[k], air.theta_before,
                          air.theta_supply - rise)
    recovery = d.recovery[k] if share == least else 0.0
    before_coil = mixed(air.theta_before, d.theta_e[k], share, recovery) + rise
    sensible = RHO_C_AIR * flow * (before_coil - air.theta_supply)
    cooling = max(sensible, 0.0)
    if cooling > 0:
        cooling += latent(d, k, share * flow, air.theta_supply)
    return Coils(max(-sensible, 0.0), cooling - asked_cooling, fan_power(office, flow))


# --- both

def air_step(office, d, k, theta_air):
    """None where there is no handler, or it stands still."""
    system = getattr(office, "air_system", None)
    if system is None or d.fresh_air[k] <= 0:
        return None
    return (vav_step if system.kind == VAV else single_zone_step)(office, d, k, theta_air)


def coils(office, d, k, air, asked_cooling):
    of = vav_coils if office.air_system.kind == VAV else single_zone_coils
    return of(office, d, k, air, asked_cooling)
