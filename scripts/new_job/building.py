"""The building as it is described first: a box of one zone, its plant by the meters, its loads by use and readings."""
import math
import statistics
from dataclasses import dataclass

from new_job.uses import COOLING_SET_BACK, COOLING_SET_POINT, COOLING_SET_POINT_US, SET_BACK

PLAN_RATIO = 1.5               # length over depth; the long sides face south and north
BASE_SHARE = 0.05              # of the hours are below the base load
HOT_WATER_SHARE = 0.1          # of the days
SUMMER_PEAK = 1.1              # electricity of warm days or months over that of mild ones that says cooling
MILD = (8, 16)                 # degC, mean of a mild one
WARM = 18                      # degC, of a warm one
LEAST_WARM = 20                # days, below which months are looked at
LEAST_RISE = 0.5               # correlation with the temperature of days above RISING, that of cooling
RISING = 14                    # degC
A_DAY = 86400                  # s
L_S_TO_M3_H = 3.6
CARRIERS = ("gas", "electricity", "district")  # what plant and loads draw


@dataclass
class Form:
    area: float                # m2
    storeys: int
    height: float              # m
    glass: float               # share of the facades
    is_said: bool              # the storeys

    @property
    def storey(self):
        return self.area / self.storeys

    @property
    def facades(self):
        """{azimuth: gross area [m2]}"""
        depth = math.sqrt(self.storey / PLAN_RATIO)
        tall = self.storeys * self.height
        return {180: PLAN_RATIO * depth * tall, 270: depth * tall, 0: PLAN_RATIO * depth * tall, 90: depth * tall}


def form_of(options, use):
    storeys = options.storeys or max(1, round(math.sqrt(options.area / use.storey_area)))
    return Form(options.area, storeys, options.height or use.height, use.glass, bool(options.storeys))


@dataclass
class Plant:
    """Carriers are those of a job; `cooling` is None without any that a meter sees."""
    heating: str
    efficiency: float
    efficiency_sd: float
    efficiency_range: tuple
    heating_says: str
    cooling: str = None
    cooling_says: str = ""
    cop: float = 3             # usual


def plant_of(meters, use, place, sky, told):
    """`sky`: the weather.Weather."""
    there = {meter.quantity: meter for meter in meters}
    if "gas" in there:
        plant = Plant("gas", 0.85, 0.06, (0.6, 0.98), "a boiler, for there is a gas meter; 0.75 to 0.95 by the season")
    elif "district" in there:
        plant = Plant("district", 1, 0, (1, 1), "for there is a meter of district heat")
    elif "heating" in there:
        plant = Plant("none", 1, 0, (1, 1), "its heat is metered")
    elif "electricity" in there:
        plant = Plant("electricity", 2, 0.8, (0.9, 4.5), "for no other meter heats: 1 is resistance, 3 a heat pump")
        told.check("the heating is taken as electric, for there is no other meter: correct [plant] if it burns "
                   "something that is not metered")
    else:
        plant = Plant("none", 1, 0, (1, 1), "no meter shows it")
    add_cooling(plant, there, use, place, sky, told)
    return plant


def add_cooling(plant, there, use, place, sky, told):
    if "cooling" in there:
        plant.cooling, plant.cooling_says = "none", "its cold is metered"
        return
    if "electricity" not in there:
        plant.cooling_says = "no cooling: no meter would show it"
        return
    peak = summer_peak(there["electricity"], sky)
    if place.is_hot and use.is_cooled or peak > SUMMER_PEAK:
        plant.cooling = "electricity"
        plant.cooling_says = f"cooled, as {use_word(place)}" if place.is_hot and use.is_cooled else \
            f"cooled, for electricity when it is warm is {peak:.2f} times that when it is mild"
        told.say(f"cooling: {plant.cooling_says}")
    else:
        plant.cooling_says = "no cooling: neither use and country nor the electricity of summer say it"
        told.say(plant.cooling_says)


def use_word(place):
    return f"such buildings mostly are in {place.name}"


def summer_peak(meter, sky):
    """Mean power where it is above WARM over that where it is mild, by days or else by months; 0 where there are
    none."""
    if meter.step <= A_DAY:
        days = days_of(meter, sky)
        if sum(theta > WARM for theta, _, _ in days) >= LEAST_WARM:
            return peak_of_days(days)
    powers = {}
    for begin, value in meter.kwh():
        powers.setdefault(begin.month, []).append(value)
    return ratio([(sky.months.get(month, -99), mean(values)) for month, values in powers.items()])


def mean(values):
    return sum(values) / len(values)


def days_of(meter, sky):
    """[(outdoor temperature, mean power, whether it is a working day)]"""
    powers = {}
    for begin, value in meter.kwh():
        powers.setdefault(begin.date(), []).append(value)
    return [(sky.days[day], mean(values), day.weekday() < 5) for day, values in powers.items()
            if day in sky.days and sum(values)]


def ratio(pairs):
    """Of (temperature, power)."""
    warm = [power for theta, power in pairs if theta > WARM]
    mild = [power for theta, power in pairs if MILD[0] <= theta <= MILD[1]]
    return mean(warm) / mean(mild) if warm and mild and sum(mild) else 0


def peak_of_days(days):
    """Of working days, of which the warmer have to draw more: what only changes with time, or in holidays, does not."""
    working = [(theta, power) for theta, power, is_working in days if is_working]
    rising = [pair for pair in working if pair[0] > RISING]
    if len(rising) < LEAST_WARM or any(len(set(column)) < 2 for column in zip(*rising)):
        return 0
    return ratio(working) if statistics.correlation(*zip(*rising)) > LEAST_RISE else 0


def quantile(values, share):
    ordered = sorted(values)
    return ordered[int(share * (len(ordered) - 1))]


def densities(meter, area, periods):
    """[W/m2] of the training period's readings."""
    first, last = periods.training
    power = 1000 / area / (meter.step / 3600)
    return [value * power for begin, value in meter.kwh() if first <= begin.date() <= last] or [0]


@dataclass
class Load:
    name: str
    value: float               # W/m2
    schedule: str              # "" = always
    carrier: str               # "" = none
    says: str
    heats: bool = True
    most: float = 0            # that its range has to reach


def loads_of(use, plant, meters, area, periods):
    there = {meter.quantity: meter for meter in meters}
    loads = [Load("people", use.person_heat / use.person_area, "use", "",
                  f"{use.person_area:g} m2 and {use.person_heat:g} W a person: EN ISO 13790 Table G.12")]
    loads += [Load("lights", use.lights, "use", "electricity", "ASHRAE 90.1-2007 Table 9.5.1")] if use.lights else []
    loads.append(Load("equipment", use.equipment, "use", "electricity",
                      "ASHRAE 90.1 User's Manual" if use.lights else "EN 16798-1 Annex C, lights in it"))
    loads.append(base_load(there.get("electricity"), use, area, periods))
    if plant.heating in ("gas", "district") and plant.heating in there:
        loads.append(hot_water(there[plant.heating], use, plant.heating, area, periods))
    return loads


def base_load(meter, use, area, periods):
    """By night and at weekends."""
    if meter is None:
        return Load("base_load", 0.3 * (use.lights + use.equipment), "", "electricity",
                    "by night: 30 % of lights and equipment, a guess")
    powers = densities(meter, area, periods)
    if meter.is_hourly:
        return Load("base_load", quantile(powers, BASE_SHARE), "", "electricity",
                    "from the readings: 5 % of the hours are below", most=quantile(powers, 0.5))
    return Load("base_load", 0.4 * min(powers), "", "electricity", "from the readings: 40 % of the least one",
                most=min(powers))


def hot_water(meter, use, carrier, area, periods):
    value = use.hot_water * 1000 / 8760
    powers = densities(meter, area, periods)
    if meter.is_hourly:
        per_day = max(1, round(24 * 3600 / meter.step))
        powers = [sum(powers[k:k + per_day]) / per_day for k in range(0, len(powers) - per_day + 1, per_day)] or powers
    return Load("hot_water", value, "", carrier, f"{use.hot_water:g} kWh/(m2 a): EN ISO 13790 Table G.12; with all "
                "that is used in summer", heats=False, most=1.5 * quantile(powers, HOT_WATER_SHARE))


def set_points(use, country):
    """(heating, set-back, cooling, its set-back) [degC]"""
    cooling = COOLING_SET_POINT_US if country in ("US", "CA") else COOLING_SET_POINT
    back = SET_BACK if use.learn != "home" else use.set_point - 3
    return use.set_point, min(back, use.set_point - 2), cooling, cooling + COOLING_SET_BACK


def air_change(use, form):
    """[1/h] of ventilation while in use."""
    return use.air * L_S_TO_M3_H / form.height


def tell_of_carriers(first):
    """Meters from which nothing draws, and plant whose use no meter shows."""
    drawn = {first.plant.heating, first.plant.cooling, *(load.carrier for load in first.loads)}
    for meter in first.meters:
        if meter.quantity in CARRIERS and meter.quantity not in drawn:
            first.told.check(f"{meter.file}: {meter.column}: nothing of the job draws {meter.quantity}, so none is "
                             f"foretold; correct [plant], or write --meter {meter.file}:{meter.column}:heating if it "
                             "counts the heat that rooms get")
    for what, carrier in (("heating", first.plant.heating), ("cooling", first.plant.cooling)):
        if carrier in CARRIERS and not first.has(carrier) and not first.has(what):
            first.told.check(f"[plant]: no meter shows the {carrier} of {what}")
