"""Effects of weather, envelope and air."""
import numpy as np

from effect import Effect, add_neighbour, days_of_year, night, stepped

NEIGHBOUR = 16.0   # [degC]
SOUTH = 0          # row of the facades


def _heat_island(d, office, size):
    d.theta_e += size * np.where(night(d), 1.6, 0.4)


def _station_bias(d, office, size):
    d.theta_e += size


def _station_in_sun(d, office, size):
    d.theta_e -= size * d.ghi


def _roof_sun(d, office, size):
    d.roof_sun *= 1 + size


def _sky_loss(d, office, size):
    d.sky_factor *= 1 + size


def _wind_infiltration(d, office, size):
    d.wind_share *= 1 + size / (0.3 * office.infiltration)


def _stack_infiltration(d, office, size):
    d.stack += size


def _window_opening(d, office, size):
    d.opening[d.open_day & (d.hour >= 8) & (d.hour < 19)] += size
    d.opening_above = 23.5


def _night_ventilation(d, office, size):
    d.opening[(d.hour < 7) | (d.hour >= 20)] += size


def _exhaust_fan(d, office, size):
    on = d.open_day & (d.hour >= 18) & (d.hour < 21)
    d.extra_air[on] += size
    d.base_load[on] += 0.4 * size * office.volume / 3600 * 1000


def _heat_recovery(d, office, size):
    d.recovery[d.theta_e < 15] = size


def _thermal_bridge(d, office, size):
    add_neighbour(d, size * office.floor_area, d.theta_e)


def _ground(d, office, size):
    add_neighbour(d, size * office.floor_area, d.theta_ground)


def _neighbour(d, office, size):
    add_neighbour(d, size * office.floor_area, np.full(len(d.hour), NEIGHBOUR))


def _facade_shading(d, office, size):
    d.blinds[SOUTH, days_of_year(d, 290, 60)] *= 1 - size


def _blinds(d, office, size):
    d.blinds *= 1 - size * d.bright


def _soiling(d, office, size):
    d.blinds *= 1 - size * np.clip(d.years, 0, None)


def _retrofit(d, office, size):
    d.envelope_factor, d.envelope_from = 1 - size, int(np.argmax(stepped(d)))


EFFECTS = {
    "heat_island": Effect("air at the building warmer than at the station, most at night", 1.0,
                          "K", _heat_island, 0.5, 3, True),
    "station_bias": Effect("air at the building warmer than at the station, always", 1.5, "K",
                           _station_bias, 0.5, 2.5, True),
    "station_in_sun": Effect("the sun warms the station's thermometer", 0.005, "K m2/W",
                             _station_in_sun, 0.002, 0.008),
    "roof_sun": Effect("a darker roof: absorbs more of the sun, as a share", 0.4, "-",
                       _roof_sun, 0.2, 0.6),
    "sky_loss": Effect("more long-wave loss to the sky, as a share", 1.0, "-", _sky_loss, 0.5, 2),
    "wind_infiltration": Effect("leaks that the wind drives", 0.3, "1/h at mean wind",
                                _wind_infiltration, 0.1, 0.5),
    "stack_infiltration": Effect("leaks that warm air drives", 0.08, "1/h per K^0.5",
                                 _stack_infiltration, 0.04, 0.12),
    "window_opening": Effect("windows opened by day above 23.5 degC", 2.0, "1/h",
                             _window_opening, 1, 5),
    "night_ventilation": Effect("windows left open on warm nights", 2.0, "1/h",
                                _night_ventilation, 0.8, 3),
    "exhaust_fan": Effect("a fan on weekday evenings, 18 to 21 h", 2.0, "1/h", _exhaust_fan,
                          1, 4),
    "heat_recovery": Effect("heat recovery of the fresh air below 15 degC", 0.5, "-",
                            _heat_recovery, 0.3, 0.8),
    "thermal_bridge": Effect("conductance to outdoors that no drawing shows", 0.1, "W/(m2 K)",
                             _thermal_bridge, 0.05, 0.16),
    "ground": Effect("conductance to the ground, which follows the seasons late", 0.15,
                     "W/(m2 K)", _ground, 0.05, 0.2),
    "neighbour": Effect("conductance to a neighbour at 16 degC", 0.15, "W/(m2 K)", _neighbour,
                        0.06, 0.3),
    "facade_shading": Effect("the south facade in shade from mid October to February, share of "
                             "the sun kept out", 0.6, "-", _facade_shading, 0.3, 0.9),
    "blinds": Effect("blinds drawn where a facade is bright, share of the sun kept out", 0.6,
                     "-", _blinds, 0.3, 0.8),
    "soiling": Effect("panes that let in less every year", 0.15, "1/a", _soiling, 0.1, 0.3),
    "retrofit": Effect("insulation added on a day of the first year: conductance lost", 0.25, "-",
                       _retrofit, 0.12, 0.35),
}
