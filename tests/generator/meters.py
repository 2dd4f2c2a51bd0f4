"""From powers to what meters print: plant curves, hourly energy, noise, quantising, gaps."""
from dataclasses import dataclass

import numpy as np

from weather import STEPS_PER_HOUR, hour_means

LATENT_HEAT = 2.5e6   # of water vapour [J/kg]
COIL_HUMIDITY = 0.0095  # humidity ratio behind a wet cooling coil [kg/kg]
PUMP_SHARE = 0.025    # pump power per thermal power [-]


@dataclass(frozen=True)
class MeterNoise:
    """2 % white, 2.5 % AR(1), 0.8 % of the mean additive, steps of the register, gaps."""
    white: float = 0.02
    slow: float = 0.025
    keep: float = 0.85          # AR(1) coefficient from hour to hour
    additive: float = 0.008
    resolution: float = 1.0     # [kWh]
    gap_share: float = 0.008
    longest_gap: int = 30       # [h]


def part_load(ratio):
    """COP at part load over COP at full load."""
    return 0.75 + 0.60 * ratio - 0.35 * ratio ** 2


def cooling_power(office, drives, cooling):
    """Electric power of the chiller [W]: better when it is cool outside, worse at part load."""
    full = drives.cooling_size * office.cooling_capacity * office.floor_area
    cop = office.cooling_cop * (1 - 0.012 * (np.clip(drives.theta_e, 15, 40) - 30))
    if drives.cop_slope:
        cop = cop * (1 - drives.cop_slope * np.clip(drives.theta_e - 27, -15, 15))
    return cooling / (cop * drives.cop_factor * part_load(np.clip(cooling / full, 0, 1)))


def heating_power(office, drives, heating):
    """Electric power of the heat pump [W]."""
    if office.heat_source != "heat pump":
        return 0.0
    full = drives.heating_size * office.heating_capacity * office.floor_area
    cop = office.heating_cop * (1 + 0.02 * (np.clip(drives.theta_e, -5, 20) - 8))
    return heating / (cop * part_load(np.clip(heating / full, 0, 1)))


def boiler_power(office, drives, heating):
    """Gas of the boiler: a little less efficient at part load, with `part_load_loss` more so [W]."""
    full = drives.heating_size * office.heating_capacity * office.floor_area
    ratio = np.clip(heating / full, 0, 1)
    efficiency = office.heating_efficiency * drives.efficiency_factor * (0.96 + 0.04 * ratio)
    return heating / efficiency * (1 + drives.part_load_loss * np.exp(-ratio / 0.15))


def latent_cooling(drives, cooling):
    """Heat of the moisture that the coil takes out of the fresh air while it cools [W]."""
    moisture = np.maximum(drives.humidity_ratio - COIL_HUMIDITY, 0)
    return drives.latent_share * 1.2 * drives.fresh_air * moisture * LATENT_HEAT * (cooling > 0)


def true_powers(office, drives, run):
    """What flows through every meter at every step [W]."""
    cooling = run.asked_cooling + latent_cooling(drives, run.asked_cooling) + run.coil_cooling
    heating = run.asked_heating + run.coil_heating
    if drives.reheat:
        heating = heating + drives.reheat * cooling
    has_handler = getattr(office, "air_system", None) is not None
    fans = run.fan if has_handler else office.fan_power * 1000 * drives.fresh_air
    electric = (drives.lights + drives.equipment + drives.base_load + fans
                + PUMP_SHARE * (cooling + heating)
                + cooling_power(office, drives, cooling)
                + heating_power(office, drives, heating))
    powers = {"electricity": electric, "cooling": cooling, "heating": heating}
    if office.heat_source == "boiler":
        powers["gas"] = boiler_power(office, drives, heating) + drives.gas_use
    return powers


def true_meters(office, drives, run):
    """Hourly energy without any meter's error [kWh]."""
    return {name: late(hour_means(power * drives.meter_factor.get(name, 1.0)) / 1000, drives)
            for name, power in true_powers(office, drives, run).items()}


def true_air(drives, run):
    """Hourly mean of the air temperature, as a sensor without noise shows it [degC]."""
    return late(hour_means(run.theta_air + drives.sensor_drift), drives)


def late(hourly, drives):
    return np.roll(hourly, drives.hours_late)


def red(rng, n, keep):
    noise = rng.standard_normal(n)
    for k in range(1, n):
        noise[k] = keep * noise[k - 1] + np.sqrt(1 - keep ** 2) * noise[k]
    return noise


def read_meter(true, noise, rng):
    """What the meter's record shows [kWh]; NaN in gaps. A register counts whole steps."""
    n = len(true)
    factor = 1 + noise.white * rng.standard_normal(n) + noise.slow * red(rng, n, noise.keep)
    shown = true * factor + noise.additive * true.mean() * rng.standard_normal(n) * (true > 0)
    register = np.floor(np.cumsum(np.maximum(shown, 0)) / noise.resolution)
    readings = np.diff(register, prepend=0) * noise.resolution
    readings[gaps(n, noise, rng)] = np.nan
    return readings


def gaps(n, noise, rng):
    """Hours without a reading: runs of 1 to `longest_gap` hours."""
    missing = np.zeros(n, bool)
    while missing.mean() < noise.gap_share:
        first = rng.integers(n)
        missing[first:first + rng.integers(1, noise.longest_gap + 1)] = True
    return missing


def read_sensor(true, rng):
    """What a temperature sensor shows: 0.08 K white and 0.12 K slow noise, steps of 0.1 K."""
    n = len(true)
    shown = true + 0.08 * rng.standard_normal(n) + 0.12 * red(rng, n, 0.9)
    readings = np.round(shown, 1)
    readings[gaps(n, MeterNoise(), rng)] = np.nan
    return readings


def read_meters(true, seed, noise=MeterNoise()):
    return {name: read_meter(series, noise, np.random.default_rng([seed, 4, row]))
            for row, (name, series) in enumerate(true.items())}


def write_meters(path, times, readings):
    """CSV; `time` is the BEGIN of the hour, local standard time; an empty field is missing."""
    with open(path, "w", encoding="ascii") as out:
        out.write("time," + ",".join(f"{name}_kWh" for name in readings) + "\n")
        for row, time in enumerate(times):
            fields = ["" if np.isnan(s[row]) else f"{s[row]:g}" for s in readings.values()]
            out.write(str(time)[:16].replace("T", " ") + "," + ",".join(fields) + "\n")
