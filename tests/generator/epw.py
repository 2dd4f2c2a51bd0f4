"""EPW files from synthetic weather, one for each calendar year, packed.

A row has the means of the hour that ends at its time; temperature, humidity and wind are those at that time. Source:
EnergyPlus, Auxiliary Programs, EPW. Columns that EnergyPlus does not use hold the codes of missing values.
"""
import gzip

import numpy as np

from weather import STEPS_PER_HOUR

PRESSURE = 101325              # Pa, at sea level
SIGMA = 5.67e-8                # W/(m2 K4)
SOURCES = "?9" * 19
# Wind direction to the end of a row, and what stands between and behind.
WIND_DIRECTION, TAIL = 230, "9999,99999,9,999999999,999,0.100,0,88,0.2,0,0"


def hour_means(series):
    return series.reshape(-1, STEPS_PER_HOUR).mean(axis=1)


def hour_ends(series):
    """The value at the end of each hour."""
    steps = np.append(series, series[-1])
    return (steps[STEPS_PER_HOUR - 1:-1:STEPS_PER_HOUR] + steps[STEPS_PER_HOUR::STEPS_PER_HOUR]) / 2


def dew_point(theta, humidity):
    """[degC] by Magnus' formula."""
    gamma = np.log(np.maximum(humidity, 1) / 100) + 17.62 * theta / (243.12 + theta)
    return 243.12 * gamma / (17.62 - gamma)


def sky_radiation(theta, dew, cloud):
    """[W/m2] horizontal, by Clark and Allen: EnergyPlus Engineering Reference, Sky Radiation Modeling."""
    n = 10 * cloud
    clear = 0.787 + 0.764 * np.log((dew + 273.15) / 273)
    return clear * (1 + 0.0224 * n - 0.0035 * n**2 + 0.00028 * n**3) * SIGMA * (theta + 273.15)**4


def header(climate, first, last):
    ground = ",".join(f"{climate.t_mean - 0.7 * climate.t_annual * np.cos(2 * np.pi * (month - 2.5) / 12):.1f}"
                      for month in range(12))
    return [f"LOCATION,Made up,-,-,synthetic,999999,{climate.latitude},{climate.longitude},{climate.utc_offset_h},0",
            "DESIGN CONDITIONS,0", "TYPICAL/EXTREME PERIODS,0", f"GROUND TEMPERATURES,1,0.5,,,,{ground}",
            "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0", "COMMENTS 1,made by tests/generator", "COMMENTS 2,",
            f"DATA PERIODS,1,1,Data,{first:%A},{first.month}/{first.day},{last.month}/{last.day}"]


def rows(weather):
    """[(time at which the hour begins, text)]"""
    begins = weather.times[::STEPS_PER_HOUR].astype("datetime64[s]").astype(object)
    theta, humidity, wind, cloud = map(hour_ends, (weather.theta_e, weather.relative_humidity, weather.wind,
                                                   weather.cloud))
    sun = [hour_means(series) for series in (weather.ghi, weather.dni, weather.dhi)]
    dew = dew_point(theta, humidity)
    sky = sky_radiation(theta, dew, cloud)
    for k, time in enumerate(begins):
        tenths = round(10 * float(cloud[k]))
        yield time, (f"{time:%Y,%-m,%-d},{time.hour + 1},60,{SOURCES},{theta[k]:.1f},{dew[k]:.1f},{humidity[k]:.0f},"
                     f"{PRESSURE},9999,9999,{sky[k]:.0f},{sun[0][k]:.0f},{sun[1][k]:.0f},{sun[2][k]:.0f},999999,999999,"
                     f"999999,9999,{WIND_DIRECTION},{wind[k]:.1f},{tenths},{tenths},{TAIL}")


def write_epw(path, weather, year):
    """The rows of one year."""
    of_year = [(time, text) for time, text in rows(weather) if time.year == year]
    lines = [*header(weather.climate, of_year[0][0], of_year[-1][0]), *(text for _, text in of_year)]
    with open(path, "wb") as file, gzip.GzipFile("", "wb", 9, file, mtime=0) as packed:
        packed.write(("\n".join(lines) + "\n").encode())
