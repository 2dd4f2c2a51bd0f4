"""Sun position and irradiance on a tilted plane, for the generator only.

Position: Spencer's series (1971) for declination and equation of time. Plane: Hay and Davies
(1980) with an isotropic ground. Leaves out refraction and the horizon band; on purpose another
sky than the program under test uses.
"""
import numpy as np

SOLAR_CONSTANT = 1361.0  # [W/m2]


def sun_angles(times, latitude, longitude, utc_offset_h):
    """Altitude and azimuth (clockwise from north) at local standard times [rad]."""
    day_start = times.astype("datetime64[D]")
    hour = (times - day_start) / np.timedelta64(1, "s") / 3600.0
    day = (day_start - times.astype("datetime64[Y]")).astype(float)
    g = 2 * np.pi * (day + (hour - 12) / 24) / 365.0
    declination = (0.006918 - 0.399912 * np.cos(g) + 0.070257 * np.sin(g)
                   - 0.006758 * np.cos(2 * g) + 0.000907 * np.sin(2 * g)
                   - 0.002697 * np.cos(3 * g) + 0.001480 * np.sin(3 * g))
    equation = 229.18 * (0.000075 + 0.001868 * np.cos(g) - 0.032077 * np.sin(g)
                         - 0.014615 * np.cos(2 * g) - 0.040849 * np.sin(2 * g))
    solar_hour = hour + (4 * (longitude - 15 * utc_offset_h) + equation) / 60
    w = np.radians(15 * (solar_hour - 12))
    phi = np.radians(latitude)
    altitude = np.arcsin(np.sin(phi) * np.sin(declination)
                         + np.cos(phi) * np.cos(declination) * np.cos(w))
    azimuth = np.pi + np.arctan2(np.sin(w), np.cos(w) * np.sin(phi)
                                 - np.tan(declination) * np.cos(phi))
    return altitude, azimuth


def extraterrestrial_normal(times):
    """Irradiance normal to the sun outside the atmosphere [W/m2]."""
    day = (times.astype("datetime64[D]") - times.astype("datetime64[Y]")).astype(float)
    return SOLAR_CONSTANT * (1 + 0.033 * np.cos(2 * np.pi * day / 365))


def cos_incidence(altitude, azimuth, tilt_deg, plane_azimuth_deg):
    """Cosine of the angle between the sun and the plane's normal, 0 where it is behind."""
    tilt, turn = np.radians(tilt_deg), azimuth - np.radians(plane_azimuth_deg)
    cosine = np.sin(altitude) * np.cos(tilt) + np.cos(altitude) * np.sin(tilt) * np.cos(turn)
    return np.where(altitude > 0, np.maximum(cosine, 0), 0)


def plane_irradiance(weather, tilt_deg, azimuth_deg, albedo=0.2):
    """Beam and diffuse irradiance on the plane, and the beam's incidence cosine [W/m2, W/m2, -]."""
    cosine = cos_incidence(weather.altitude, weather.azimuth, tilt_deg, azimuth_deg)
    beam = weather.dni * cosine
    anisotropy = weather.dni / extraterrestrial_normal(weather.times)
    ratio = cosine / np.maximum(np.sin(weather.altitude), np.sin(np.radians(5)))
    up = (1 + np.cos(np.radians(tilt_deg))) / 2
    sky = weather.dhi * (anisotropy * ratio + (1 - anisotropy) * up)
    return beam, sky + weather.ghi * albedo * (1 - up), cosine
