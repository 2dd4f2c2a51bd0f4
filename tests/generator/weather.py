"""Synthetic weather in 5-minute steps: annual and daily cycles, clouds, and slow noise.

A climate is a table of means and amplitudes. Clear-sky global irradiance: Haurwitz (1945);
clouds: Kasten and Czeplak (1980); diffuse share: Erbs (1982). One seed, one weather; the years
of a run differ as real years do.
"""
from dataclasses import dataclass

import numpy as np

import sun

STEP_S = 300
STEPS_PER_HOUR = 3600 // STEP_S


@dataclass(frozen=True)
class Climate:
    latitude: float
    longitude: float
    utc_offset_h: float
    t_mean: float            # annual mean [degC]
    t_annual: float          # amplitude of the year [K]
    t_daily: float           # amplitude of a clear day [K]
    t_synoptic_winter: float  # standard deviation of the slow noise in January [K]
    t_synoptic_summer: float
    cloud_mean: float        # [-]
    cloud_spring: float      # added in March, taken off in September
    dew_gap: float           # mean air temperature minus dew point [K]
    wind_mean: float         # [m/s]


CLIMATES = {
    "hot_humid": Climate(24.8, 113.6, 8, 20.4, 9.2, 3.8, 3.8, 1.2, 0.70, 0.12, 4.6, 2.2),
    "cool_maritime": Climate(52.2, 0.1, 0, 10.4, 6.8, 3.4, 3.0, 2.4, 0.66, 0.0, 3.2, 3.9),
    "continental": Climate(47.4, 8.5, 1, 9.6, 10.1, 4.0, 4.0, 2.6, 0.62, 0.0, 3.8, 2.6),
}


@dataclass(frozen=True)
class Weather:
    """Series of [n_steps], each the value in the middle of its 5-minute step."""
    climate: Climate
    times: np.ndarray        # begin of the steps, local standard time
    theta_e: np.ndarray      # [degC]
    relative_humidity: np.ndarray  # [%]
    wind: np.ndarray         # [m/s]
    cloud: np.ndarray        # [0..1]
    ghi: np.ndarray          # [W/m2]
    dni: np.ndarray
    dhi: np.ndarray
    altitude: np.ndarray     # of the sun [rad]
    azimuth: np.ndarray


def step_times(first_day, n_days):
    """Begins of the 5-minute steps of `n_days` days."""
    n = n_days * 24 * STEPS_PER_HOUR
    return np.datetime64(first_day, "s") + np.arange(n) * np.timedelta64(STEP_S, "s")


def red_noise(rng, n_hours, time_constant_h):
    """AR(1) of unit variance, hourly, spread linearly over the 5-minute steps."""
    keep = np.exp(-1 / time_constant_h)
    white = rng.standard_normal(n_hours + 1)
    noise = np.empty(n_hours + 1)
    noise[0] = white[0]
    for k in range(1, n_hours + 1):
        noise[k] = keep * noise[k - 1] + np.sqrt(1 - keep * keep) * white[k]
    steps = np.arange(n_hours * STEPS_PER_HOUR) / STEPS_PER_HOUR
    return np.interp(steps, np.arange(n_hours + 1), noise)


def season(times):
    """1 in mid January, -1 in mid July, and the same a quarter of a year later."""
    day = (times.astype("datetime64[D]") - times.astype("datetime64[Y]")).astype(float)
    angle = 2 * np.pi * (day - 18) / 365
    return np.cos(angle), np.sin(angle)


def cloud_cover(climate, times, rng):
    n_hours = len(times) // STEPS_PER_HOUR
    _, spring = season(times)
    level = climate.cloud_mean + climate.cloud_spring * spring
    noise = 0.8 * red_noise(rng, n_hours, 36) + 0.6 * red_noise(rng, n_hours, 3)
    return 1 / (1 + np.exp(-(np.log(level / (1 - level)) + 1.6 * noise)))


def irradiance(times, altitude, cloud):
    """Global, direct normal and diffuse horizontal irradiance [W/m2]."""
    height = np.maximum(np.sin(altitude), 1e-3)
    clear = np.where(altitude > 0, 1098 * height * np.exp(-0.057 / height), 0)
    ghi = clear * (1 - 0.75 * cloud ** 3.4)
    index = np.clip(ghi / (sun.extraterrestrial_normal(times) * height), 0, 1)
    erbs = (0.9511 - 0.1604 * index + 4.388 * index ** 2 - 16.638 * index ** 3
            + 12.336 * index ** 4)
    share = np.where(index < 0.22, 1 - 0.09 * index, np.where(index > 0.8, 0.165, erbs))
    dhi = np.where(altitude > np.radians(3), share, 1) * ghi
    return ghi, (ghi - dhi) / np.maximum(height, np.sin(np.radians(3))), dhi


def air_temperature(climate, times, cloud, rng):
    n_hours = len(times) // STEPS_PER_HOUR
    winter, _ = season(times)
    hour = (times - times.astype("datetime64[D]")) / np.timedelta64(3600, "s")
    hour = np.asarray(hour, dtype=float)
    swing = climate.t_daily * (1.25 - 0.9 * cloud)
    shape = np.cos(2 * np.pi * (hour - 15) / 24) + 0.25 * np.cos(4 * np.pi * (hour - 14) / 24)
    mean, half = ((climate.t_synoptic_winter + climate.t_synoptic_summer) / 2,
                  (climate.t_synoptic_winter - climate.t_synoptic_summer) / 2)
    slow = (mean + half * winter) * red_noise(rng, n_hours, 60)
    years = times.astype("datetime64[Y]").astype(int)
    warm_year = 0.5 * rng.standard_normal(years.max() - years.min() + 1)[years - years.min()]
    return (climate.t_mean - climate.t_annual * winter + swing * shape + slow + warm_year
            + 0.5 * red_noise(rng, n_hours, 5))


def humidity(climate, theta_e, cloud, rng):
    """Relative humidity by Magnus' formula from a dew point that follows the last days [%]."""
    n_hours = len(theta_e) // STEPS_PER_HOUR
    hourly = theta_e.reshape(n_hours, STEPS_PER_HOUR).mean(axis=1)
    daily = np.repeat(hourly.reshape(-1, 24).mean(axis=1), 24)
    dew = np.interp(np.arange(len(theta_e)) / STEPS_PER_HOUR, np.arange(n_hours) + 0.5, daily)
    dew = dew - climate.dew_gap * (1.5 - cloud) + 1.2 * red_noise(rng, n_hours, 30)
    magnus = lambda t: 17.62 * t / (243.12 + t)
    return np.clip(100 * np.exp(magnus(dew) - magnus(theta_e)), 12, 100)


def synthetic_weather(climate_name, first_day, n_days, seed):
    """Weather of whole days; the same for the same arguments."""
    climate = CLIMATES[climate_name]
    rng = np.random.default_rng([seed, 1])
    times = step_times(first_day, n_days)
    middle = times + np.timedelta64(STEP_S // 2, "s")
    altitude, azimuth = sun.sun_angles(middle, climate.latitude, climate.longitude,
                                       climate.utc_offset_h)
    cloud = cloud_cover(climate, times, rng)
    ghi, dni, dhi = irradiance(times, altitude, cloud)
    theta_e = air_temperature(climate, times, cloud, rng)
    gust = red_noise(rng, len(times) // STEPS_PER_HOUR, 12)
    wind = climate.wind_mean * np.exp(0.5 * gust - 0.125) * (0.85 + ghi / 1500)
    return Weather(climate, times, theta_e, humidity(climate, theta_e, cloud, rng), wind, cloud,
                   ghi, dni, dhi, altitude, azimuth)


def hour_means(series):
    return series.reshape(-1, STEPS_PER_HOUR).mean(axis=1)


def write_weather(path, weather):
    """Hourly means as CSV; `time` is the BEGIN of the hour, local standard time."""
    times = weather.times[::STEPS_PER_HOUR]
    names = ("theta_e", "relative_humidity", "wind", "ghi", "dni", "dhi")
    columns = [hour_means(getattr(weather, name)) for name in names]
    with open(path, "w", encoding="ascii") as out:
        out.write("time,T_out_C,RH_pct,wind_ms,GHI_Wm2,DNI_Wm2,DHI_Wm2\n")
        for time, t, rh, v, ghi, dni, dhi in zip(times, *columns):
            stamp = str(time)[:16].replace("T", " ")
            out.write(f"{stamp},{t:.1f},{rh:.0f},{v:.1f},{ghi:.0f},{dni:.0f},{dhi:.0f}\n")
