"""Effects that no catalogue names: for each there is no right name, only a place."""
import numpy as np

from effect import Effect, density, rng_of, stepped
from office import hours
from weather import STEPS_PER_HOUR

DAY = 24 * STEPS_PER_HOUR
NEW_PROFILE = np.array(hours((0, 6, 0.15), (6, 9, 1.0), (9, 16, 0.3), (16, 23, 1.0),
                             (23, 24, 0.4)))


def runs_of_days(d, share, longest, among):
    """Steps on random runs of days, so many of those `among` which may have them."""
    rng, on = rng_of(d), np.zeros(len(d.hour), bool)
    n_days, wanted = len(d.hour) // DAY, share * among.sum()
    while on.sum() < wanted:
        first = rng.integers(n_days)
        on[first * DAY:(first + rng.integers(1, longest + 1)) * DAY] = True
        on &= among
    return on


def _tenant_change(d, office, size):
    new, on = NEW_PROFILE[d.hour.astype(int)], stepped(d)
    for use in ("people", "equipment"):
        series = getattr(d, use)
        series[on] += size * (density(d, office, use) * new - series)[on]


def _frozen_valve(d, office, size):
    first = 0.03 + 0.05 * rng_of(d).random()
    d.heating_set[(d.years >= first) & (d.years < first + 21 / 365)] += size


def _snow(d, office, size):
    d.blinds[:, runs_of_days(d, size, 9, d.theta_e < 3)] *= 0.25


def _sensor_drift(d, office, size):
    d.sensor_drift += size * np.clip(d.years, 0, None) ** 2


def _random_windows(d, office, size):
    rng = rng_of(d)
    gust = np.repeat(rng.gamma(1.0, 3.0, len(d.hour) // DAY), DAY)
    d.extra_air += gust * runs_of_days(d, size, 2, d.open_day) * ((d.hour >= 8) & (d.hour < 18))


def _heat_and_power(d, office, size):
    on = runs_of_days(d, 0.6, 5, d.theta_e < 10) & (d.hour >= 6) & (d.hour < 22)
    d.base_load[on] -= size * office.floor_area
    d.unmetered[on] += 0.8 * size * office.floor_area


EFFECTS = {
    "tenant_change": Effect("another tenant from a day of the first year on, as a share", 1.0,
                            "-", _tenant_change, 0.6, 1),
    "frozen_valve": Effect("a heating valve stuck for three weeks of the first winter", 4.0, "K",
                           _frozen_valve, 2.5, 6),
    "snow": Effect("panes under snow in runs of cold days, as a share of those", 0.4, "-", _snow,
                   0.3, 0.6),
    "sensor_drift": Effect("air temperature sensor that drifts ever faster", 0.6, "K/a2",
                           _sensor_drift, 0.3, 1),
    "random_windows": Effect("windows open on working days at random, as a share of those", 0.1,
                             "-", _random_windows, 0.05, 0.2),
    "heat_and_power": Effect("an engine makes power and heat in runs of cold days", 4.0, "W/m2",
                             _heat_and_power, 2, 6),
}
