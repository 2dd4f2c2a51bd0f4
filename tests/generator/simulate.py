"""The finer simulation: implicit Euler in 5-minute steps over the whole network.

Since only the air node's flows change, the rest is solved once: x = A x_before + s + b theta_air
+ c phi_heating. The air balance is then linear in theta_air and in the plant's command, so the
proportional thermostat is solved exactly. Emitters lag behind the command.
"""
from dataclasses import dataclass

import numpy as np

import sun
from air_system import air_step, coils
from construction import RHO_C_AIR, make_network
from weather import STEP_S

AIR_MULTIPLIER = 3.0               # light furnishings that follow the air
BAND = 0.8                         # thermostat [K]
TAU_HEATING, TAU_COOLING = 1200.0, 420.0  # emitter lags [s]
RADIANT_HEATING = 0.25             # share of heating that reaches the surfaces first
CONVECTIVE = {"people": 0.6, "lights": 0.45, "equipment": 0.75, "unmetered": 0.7}
SUN_TO_AIR = 0.08
MONTH = 8640                       # steps of a chunk of sources


@dataclass
class Trajectory:
    """Each [n_steps]: temperatures at the ends of the steps, powers as means."""
    theta_air: np.ndarray
    asked_heating: np.ndarray      # of the plant [W]
    asked_cooling: np.ndarray
    emitted_heating: np.ndarray    # in the zone [W]
    emitted_cooling: np.ndarray
    air_conductance: np.ndarray    # to the outdoor air [W/K]
    convective: np.ndarray         # gains straight to the air [W]
    stored: np.ndarray             # heat in all capacities but the air [J]
    surface_gain: np.ndarray       # heat into the network from outside and gains [W]
    air_gain: np.ndarray           # an air handler's, to the zone's air [W]
    coil_heating: np.ndarray       # its loads beside what the zone asked for [W]
    coil_cooling: np.ndarray
    fan: np.ndarray                # its fan [W]


def transmitted_sun(window, weather, keep):
    """Sun that enters through a window [W], with its fall-off at flat angles."""
    beam, diffuse, cosine = sun.plane_irradiance(weather, *window.plane)
    tangent = np.tan(np.arccos(np.clip(cosine, 0, 1)) / 2)
    per_area = window.g_value * (beam * (1 - tangent ** 4) + 0.9 * diffuse)
    return per_area * window.area * (1 - window.frame) * keep


def sky_temperature(weather):
    """Radiant temperature of the surroundings: sky and ground in equal parts, by cloud."""
    return weather.theta_e - 5.5 * (1 - weather.cloud)


def surroundings_temperature(weather, drives):
    """The same at the building."""
    if drives.sky_factor == 1:
        return sky_temperature(weather) + drives.theta_e - weather.theta_e
    return drives.theta_e + drives.sky_factor * (sky_temperature(weather) - weather.theta_e)


def source_rows(network, elements, windows, weather, drives):
    """Heat into every node from outdoors, sky, ground, sun and radiant gains [n_steps x n]."""
    deep = weather.climate.t_mean
    rows = (np.outer(drives.theta_e, network.outdoor)
            + np.outer(surroundings_temperature(weather, drives), network.sky)
            + deep * network.ground)
    for element in (e for e in elements if e.plane):
        beam, diffuse, _ = sun.plane_irradiance(weather, *element.plane)
        share = element.absorptance * (drives.roof_sun if element.name == "roof" else 1)
        absorbed = share * element.area * (beam + diffuse)
        rows[:, network.outer[element.name]] += absorbed
    entered = sum(transmitted_sun(w, weather, keep)
                  for w, keep in zip(windows, drives.blinds))
    for element in elements:
        rows[:, network.inner[element.name]] += element.sun_share * entered
    on_star = 1 - SUN_TO_AIR - sum(e.sun_share for e in elements)
    radiant = sum(getattr(drives, k) * (1 - share) for k, share in CONVECTIVE.items())
    rows[:, network.star] += on_star * entered + radiant
    convective = sum(getattr(drives, k) * share for k, share in CONVECTIVE.items())
    return rows, convective + SUN_TO_AIR * entered


class Zone:
    """The network with its step solved, and the state."""

    def __init__(self, network, air_capacity, theta_start):
        self.use(network)
        self.air_store = air_capacity / STEP_S
        self.x = np.full(len(network.capacity), theta_start)
        self.theta_air, self.heating, self.cooling = theta_start, 0.0, 0.0

    def use(self, network):
        """Takes a network with the same nodes; the state stays."""
        solved = np.linalg.inv(np.diag(network.capacity / STEP_S) + network.conduction)
        self.solved = solved
        self.keep = solved * (network.capacity / STEP_S)
        self.b = solved @ network.air
        self.c = RADIANT_HEATING * solved[:, network.star]
        self.air_keep = network.air @ self.keep
        self.air = network.air
        self.air_own = network.air.sum() - network.air @ self.b
        self.heating_gain = 1 - RADIANT_HEATING + network.air @ self.c
        self.capacity = network.capacity
        self.lost = network.outdoor + network.sky + network.ground


def command(free, slope, set_point, capacity):
    """Power that a proportional thermostat asks for when theta = free + slope power."""
    if capacity <= 0:
        return 0.0
    sign = 1.0 if slope > 0 else -1.0
    wanted = 0.5 + sign * (set_point - free) / BAND
    share = wanted / (1 + sign * slope * capacity / BAND)
    return capacity * min(max(share, 0.0), 1.0)


def step(zone, s, air_s, loss, theta_e, convective, control):
    """One step; returns the powers asked of the plant."""
    lag_h, lag_c = STEP_S / (TAU_HEATING + STEP_S), STEP_S / (TAU_COOLING + STEP_S)
    own = zone.air_store + loss + zone.air_own
    left_h, left_c = zone.heating * (1 - lag_h), zone.cooling * (1 - lag_c)
    free = (zone.air_store * zone.theta_air + loss * theta_e + convective + air_s
            + zone.air_keep @ zone.x + zone.heating_gain * left_h - left_c) / own
    set_h, set_c, limit_h, limit_c = control
    asked_h = command(free, zone.heating_gain * lag_h / own, set_h, limit_h)
    asked_c = command(free, -lag_c / own, set_c, limit_c) if asked_h == 0 else 0.0
    zone.heating, zone.cooling = left_h + lag_h * asked_h, left_c + lag_c * asked_c
    zone.theta_air = free + (zone.heating_gain * lag_h * asked_h - lag_c * asked_c) / own
    zone.x = zone.keep @ zone.x + s + zone.b * zone.theta_air + zone.c * zone.heating
    return asked_h, asked_c


def air_loss(drives, k, volume, theta_air, air=None):
    """Conductance of all outdoor air that enters in a step; a handler brings its own [W/K]."""
    difference = theta_air - drives.theta_e[k]
    change = (drives.infiltration[k] + drives.wind_share[k] + drives.extra_air[k]
              + drives.stack * abs(difference) ** 0.5)
    if drives.opening[k] > 0 and theta_air > drives.opening_above and difference > 1:
        change += drives.opening[k]
    fresh = air.outdoor if air else drives.fresh_air[k] * (1 - drives.recovery[k])
    return RHO_C_AIR * (change * volume / 3600 + fresh)


def surroundings(drives, k, loss, air=None):
    """Conductance and temperature of outdoor air, neighbour and supplied air together."""
    other, theta = drives.neighbour[k], drives.theta_e[k]
    if other != 0:
        loss, theta = joined(loss, theta, other, drives.theta_neighbour[k])
    if air:
        loss, theta = joined(loss, theta, RHO_C_AIR * air.supply, air.theta_supply)
    return loss, theta


def joined(one, theta_one, other, theta_other):
    total = one + other
    return total, (one * theta_one + other * theta_other) / total


def run_chunk(zone, office, drives, rows, convective, first, out):
    """Steps first .. first + len(rows): fills the trajectory `out`."""
    solved_rows = rows @ zone.solved.T
    air_rows = solved_rows @ zone.air
    for i in range(len(rows)):
        k = first + i
        air = air_step(office, drives, k, zone.theta_air)
        loss = air_loss(drives, k, office.volume, zone.theta_air, air)
        control = (drives.heating_set[k], drives.cooling_set[k],
                   drives.heating_on[k] * drives.heating_size * office.heating_capacity
                   * office.floor_area,
                   drives.cooling_on[k] * drives.cooling_size * office.cooling_capacity
                   * office.floor_area)
        gain = convective[i]
        if air:
            control = (*control[:3], min(control[3], air.most_cooling))
            gain = gain + air.gain
        total, theta = surroundings(drives, k, loss, air)
        asked = step(zone, solved_rows[i], air_rows[i], total, theta, gain, control)
        if air:
            note_air(zone, office, drives, k, air, asked[1], out)
        out.asked_heating[k], out.asked_cooling[k] = asked
        out.emitted_heating[k], out.emitted_cooling[k] = zone.heating, zone.cooling
        out.theta_air[k], out.air_conductance[k] = zone.theta_air, loss
        note_balance(zone, rows[i], k, out)


def note_air(zone, office, drives, k, air, asked_cooling, out):
    load = coils(office, drives, k, air, asked_cooling)
    out.coil_heating[k], out.coil_cooling[k], out.fan[k] = load.heating, load.cooling, load.fan
    out.air_gain[k] = air.gain + RHO_C_AIR * air.supply * (air.theta_supply - zone.theta_air)


def note_balance(zone, row, k, out):
    out.stored[k] = zone.capacity @ zone.x
    out.surface_gain[k] = row.sum() - zone.lost @ zone.x


def part_of(series_owner, first, last):
    """The same dataclass with its arrays cut to [first, last)."""
    cut = {k: (v[..., first:last] if isinstance(v, np.ndarray) else v)
           for k, v in vars(series_owner).items()}
    return type(series_owner)(**cut)


def chunks(n_steps, change):
    """(first, last) of the chunks; one begins at `change`."""
    bounds = sorted({*range(0, n_steps, MONTH), change, n_steps})
    return zip(bounds[:-1], bounds[1:])


def simulate(office, weather, drives, theta_start=22.0):
    """The whole period. The first weeks still remember theta_start: leave them out."""
    elements, windows = office.opaque_elements(), office.windows()
    network = make_network(elements, windows)
    zone = Zone(network, AIR_MULTIPLIER * RHO_C_AIR * office.volume, theta_start)
    n = len(weather.times)
    out = Trajectory(*(np.zeros(n) for _ in range(13)))
    for first, last in chunks(n, drives.envelope_from):
        if first == drives.envelope_from and drives.envelope_factor != 1:
            other = office.opaque_elements(drives.envelope_factor)
            network = make_network(other, windows)
            zone.use(network)
        rows, convective = source_rows(network, elements, windows,
                                       part_of(weather, first, last), part_of(drives, first, last))
        out.convective[first:last] = convective
        run_chunk(zone, office, drives, rows, convective, first, out)
    return out
