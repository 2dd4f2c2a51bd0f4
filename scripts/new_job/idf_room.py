"""The temperature of the rooms of an EnergyPlus file, which its people's sensible heat follows: a balance over the
hours of the weather.

One node, C dT/dt = H (T_outside - T) + gains, exact within the hour and held between the set-points. Parts face all
sides alike: the sun on them is the mean over azimuths. Leaves out summer time, holidays, what the sun does by the
side, and the season: what is returned is the mean of a year by the hour of working days, Saturdays, and Sundays, which
holidays are like.
"""
import math

import numpy as np

from new_job.idf_envelope import AIR, STEEP
from new_job.idf_schedules import DAYS, HOURS, KINDS, MONTH_DAYS

LEAST_HOURS = DAYS * HOURS     # of weather
INCIDENCE = 0.9                # of a window's g at all angles: ISO 13790, 11.4.2
REFLECTED = 0.2                # by the ground
START, WARM_UP = 20, 14 * 24   # degC, and hours that are not counted
FEBRUARY_29 = 2, 29
WORKING_DAYS, SUNDAY = slice(0, 5), 6


def on_walls(ghi, dni, dhi):
    """[W/m2] mean over the azimuths of what is upright."""
    sine = min(max((ghi - dhi) / dni, 0), 1) if dni > 0 else 1
    return dni * math.sqrt(1 - sine**2) / math.pi + dhi / 2 + REFLECTED * ghi / 2


def apertures(shell):
    """[m2] what takes up the sun: (upright, facing up)"""
    found = [0.0, 0.0]
    for part in shell.windows.values():
        found[part.tilt < STEEP] += INCIDENCE * shell.glazing[part.construction].solar * part.area
    for part in shell.surfaces.values():
        if part.azimuth is not None:
            made = shell.opaque[part.construction]
            found[part.tilt < STEEP] += made.absorptance * made.r_outside * made.u_value * part.area
    return found


def losses(shell):
    """{boundary: W/K}"""
    found = {"outdoors": sum(shell.glazing[part.construction].u_value * part.area for part in shell.windows.values())}
    for part in shell.surfaces.values():
        loss = shell.opaque[part.construction].u_value * part.area * part.adjustment
        found[part.boundary] = found.get(part.boundary, 0) + loss
    return found


class Balance:
    """Of a room or a building. Profiles are (365, 8, 24): air [m3/h], gains [W], set-points [degC] or None."""

    def __init__(self, shell, capacity, air, gains, set_points):
        self.of, self.upright_and_up, self.capacity = losses(shell), apertures(shell), capacity
        self.outdoors = self.of.pop("outdoors")
        self.by_air, self.gains = AIR * air, gains
        heating, cooling = set_points
        self.least = np.full(gains.shape, -np.inf) if heating is None else heating
        self.most = np.full(gains.shape, np.inf) if cooling is None else cooling
        self.earth = sum(loss * np.repeat(shell.grounds[name], MONTH_DAYS) for name, loss in self.of.items()) + \
            np.zeros(DAYS)

    def temperatures(self, hours):
        """(8, 24) means [degC] of `weather.hours_of`."""
        sums, counts = np.zeros((KINDS, HOURS)), np.zeros((KINDS, HOURS))
        hours = [hour for hour in hours if (hour[0].month, hour[0].day) != FEBRUARY_29]
        room = START
        for _, room in self.steps(hours[:WARM_UP], room):
            pass
        for at, room in self.steps(hours, room):
            sums[at] += room
            counts[at] += 1
        for table in (sums, counts):
            table[WORKING_DAYS] = table[WORKING_DAYS].sum(axis=0)
            table[-1] = table[SUNDAY]
        return sums / counts

    def steps(self, hours, room):
        """((kind of day, hour), temperature at its end) of each."""
        earth, (upright, up) = sum(self.of.values()), self.upright_and_up
        for time, theta, ghi, dni, dhi in hours:
            day = sum(MONTH_DAYS[:time.month - 1]) + time.day - 1
            at = day, time.weekday(), time.hour
            outer = self.outdoors + self.by_air[at]
            heat = outer * theta + self.earth[day] + self.gains[at] + upright * on_walls(ghi, dni, dhi) + up * ghi
            kept = math.exp(-3600 * (outer + earth) / self.capacity)
            room = room * kept + (1 - kept) * heat / max(outer + earth, 1e-9)
            room = float(min(max(room, self.least[at]), max(self.most[at], self.least[at])))
            yield at[1:], room
