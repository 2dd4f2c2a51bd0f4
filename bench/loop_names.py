"""What the generator's effects are called in the catalogue, and their coefficients there.

`names`: any of them is the right one, the first has the planted form. `places`: (hook, driver) of the
grammar where the catalogue has no name. `coefficient`: of a generator's size and truth, in the
catalogue's unit; None where the two forms differ too much to compare. Effects of no catalogue have the
names that would not be wrong. Of hours unlike the declared each part that was drawn has names (`when`).
A capacity is a parameter: it is named where it comes nearer to the truth than to what is declared. What
parameters follow at a correlation of 0.98 is one class with them:
of that a decision tells, of every building where it holds, not an effect that is found.
"""
from dataclasses import dataclass, field
from typing import Callable

CLOCK = "clock"                 # in a data decision
YEARS = 2.0                     # of a case
MEAN_WIND = {"hot_humid": 2.2, "cool_maritime": 3.9, "continental": 2.6}  # [m/s]


@dataclass(frozen=True)
class Right:
    names: tuple = ()
    places: tuple = ()
    coefficient: Callable = None
    is_decision: bool = False
    aliases: tuple = ()   # what no reading tells from it
    is_dated: bool = False   # its size is a day of the year
    meters: tuple = ()       # at which it is right
    parameter: str = ""      # that is wrong: a factor on what is declared
    when: dict = field(default_factory=dict)   # name: of the truth's details, whether it is right
    says: dict = field(default_factory=dict)   # name: what its sentence has to say

    def rows(self):
        """What the power table may call it: beside others, what is at a meter has the meter's name."""
        return [f"{name} ({meter})" for name in self.names[:1] for meter in self.meters] + \
            list(self.names[:1])


def same(size, truth):
    return size


def less(size, truth):
    return -size


def named(*names, **more):
    return Right(names, **more)


GAS = ("gas meter",)
STATION = ("urban heat island or station offset", "urban heat island at night")


CODE_OF = {"England": "GB", "Zurich": "CH", "Hong Kong": "HK"}   # of the truth's countries
OPENS, CLOSES = 7, 19    # [h], as declared: of hours that are others


def begins_earlier(hours):
    return hours["plant"]["weekday"][0] < OPENS


def ends_later(who):
    return lambda hours: hours[who]["weekday"][1] > CLOSES


def has_saturdays(hours):
    return hours["plant"]["saturday"] is not None


def has_weekends(hours):
    return has_saturdays(hours) or hours["plant"]["sunday"] is not None


PARTS_OF_HOURS = {
    "other hours than declared": lambda hours: True,
    "plant runs on after hours": ends_later("plant"), "early start": begins_earlier,
    "schedules earlier or later": lambda hours: True, "evening use": ends_later("use"),
    "Saturdays worked": has_saturdays, "Saturday mornings worked": has_saturdays,
    "plant runs on Saturday mornings": has_saturdays,
    "plant runs at weekends as on weekdays": has_weekends, "use at weekends": has_weekends,
    "loads at weekends": has_weekends, "heating set-point of some hours": lambda hours: True,
    "cooling set-point of some hours": lambda hours: True}


def step_of(meter):
    return named("step of a meter", coefficient=same, meters=(meter,))


RIGHT = {
    "heat_island": named(*STATION),
    "station_bias": named(*STATION, coefficient=same),
    "station_in_sun": named("weather sensor in the sun", coefficient=less),
    "roof_sun": named("sun on opaque elements", "sun on walls"),
    "sky_loss": named("long-wave loss to the sky"),
    "wind_infiltration": named("wind infiltration", "infiltration by strong wind",
                               coefficient=lambda size, truth: size / MEAN_WIND[truth["climate"]]),
    "stack_infiltration": named("stack infiltration", coefficient=same),
    "window_opening": named("windows opened while occupied", "windows opened in warm rooms"),
    "night_ventilation": named("night purge", "windows opened in warm rooms"),
    "exhaust_fan": named("exhaust fan on weekdays", "exhaust fan", coefficient=same),
    "heat_recovery": named("heat recovery", "heat recovery bypassed"),
    "thermal_bridge": named("thermal bridges"),
    "ground": named("ground coupling", coefficient=same),
    "neighbour": named("cold or warm neighbour", coefficient=same),
    "facade_shading": named("shade in a season", "shade"),
    "blinds": named("blinds"),
    "soiling": named("soiling of windows", coefficient=less),
    "retrofit": named("retrofit of walls", coefficient=less),
    "unmetered_people": named("gains that no meter sees", coefficient=same),
    "server_heat": named("machines that no meter sees", "gains that no meter sees",
                         places=(("gains", "constant"),), coefficient=same),
    "weekend_use": named("use at weekends", "loads at weekends"),
    "saturday_operation": named("Saturdays worked", "Saturday mornings worked",
                                "plant runs on Saturday mornings",
                                "plant runs at weekends as on weekdays", "other hours than declared",
                                says={"other hours than declared": "Saturdays"}),
    "four_day_week": named("a free weekday", coefficient=same),
    "single_holidays": named("holidays"),
    "closed_weeks": named("holidays"),
    "occupancy_trend": named("occupancy trend", coefficient=same),
    "occupancy_step": named("tenants move in or out", coefficient=same),
    "evening_load": named("evening use", coefficient=same),
    "night_equipment": named("use at night", "evening use"),
    "schedule_shift": named("schedules earlier or later"),
    "summer_time": named("summer time not applied"),
    "weekend_setback_missing": named("plant runs at weekends as on weekdays"),
    "early_start": named("early start"),
    "heating_drift": named("heating set-point drift", coefficient=same),
    "heating_curve": named("heating curve"),
    "summer_set_point": named("cooling set-point in hot weather", "summer compensation",
                              "cooling set-point of a season",
                              places=(("cooling set-point", "outdoor temperature"),)),
    "cooling_locked": named("cooling locked out", is_dated=True),
    "heating_locked": named("heating locked out", is_dated=True),
    "demand_response": named("demand response", coefficient=same),
    "reheat": named("reheat", meters=("gas meter", "electricity meter")),
    "part_load": named("part-load efficiency of heating"),
    "cop_temperature": named("COP over outdoor temperature",
                             coefficient=lambda size, truth: size / (1 + 7 * size)),
    "degraded_cop": named("drift of COP", coefficient=lambda size, truth: -size / YEARS),
    "degraded_boiler": named("drift of heating efficiency",
                             coefficient=lambda size, truth: -size / YEARS),
    "latent_load": named("latent load", "latent load on the meter of cooling"),
    "standing_losses": named("standing losses", coefficient=same, meters=GAS),
    "hot_water": named("hot water", coefficient=same, meters=GAS),
    "electricity_step": step_of("electricity meter"), "cooling_step": step_of("cooling meter"),
    "heating_step": step_of("heating meter"), "gas_step": step_of("gas meter"),
    "meter_late": named("clock of the meter", is_decision=True,
                        aliases=("schedules earlier or later",)),
    # of operation
    "other_hours": named(*PARTS_OF_HOURS, when=PARTS_OF_HOURS),
    "moving_holidays": named("holidays"),
    "optimum_start": named("early start", "heating set-point of some hours"),
    "oversized_plant": named(parameter="heating_capacity"),
    "undersized_plant": named(parameter="heating_capacity"),
    # outside the catalogue
    "tenant_change": named("tenants move in or out", "use at all hours changed", "equipment added or removed"),
    "frozen_valve": named(),
    "snow": named("snow, albedo or dirt"),
    "sensor_drift": named(),
    "random_windows": named("windows open on some days"),
    "heat_and_power": named(),
}

# What the generator always has and a 5R1C lacks: not false where the held-out error falls.
ALWAYS_THERE = {
    "wind infiltration", "infiltration by strong wind", "stack infiltration",
    "sun on opaque elements", "sun on walls", "second thermal mass", "part-load COP of cooling",
    "part-load efficiency of heating", "COP over outdoor temperature",
    "heating efficiency over outdoor temperature"}

# What an air handler does, by its kind: not false where the held-out error falls.
OF_AIR_HANDLER = {
    "single zone": {"economiser", "latent load", "latent load on the meter of cooling"},
    "VAV with terminal reheat": {"economiser", "latent load", "latent load on the meter of cooling",
                                 "reheat"}}

# By which the loop says that a building has an air system of which nobody told: a structure, or an effect of one.
AIR_SYSTEM = {"coil that dries", "terminals with reheat"}.union(*OF_AIR_HANDLER.values())


def names_of(planted, details=None):
    """Those of the planted effect, as it was drawn."""
    right = RIGHT[planted]
    return [name for name in right.names
            if details is None or right.when.get(name, lambda drawn: True)(details)]


def is_right(effect, planted, details=None):
    """Whether a found effect (a record of effects.json) is the planted one. `details`: the truth's."""
    right = RIGHT[planted]
    is_there = not right.meters or effect["shape"].endswith(right.meters)
    says_so = right.says.get(effect["name"], "") in effect["shape"]
    return (effect["name"] in names_of(planted, details) and is_there and says_so) or \
        (effect["hook"], effect["driver"]) in right.places


def is_in_class(effect, planted, details=None, most=3):
    """Whether the planted one is in the found one's class of at most `most`."""
    others = [name for name in effect["class"] if name and name != effect["name"]]
    return is_right(effect, planted, details) or effect["name"] in RIGHT[planted].aliases or (
        len(set(others) | {effect["name"]}) <= most
        and bool(set(others) & set(names_of(planted, details))))
