"""A whole case: weather, an office as built, its meters with errors, and the truth about it."""
from dataclasses import dataclass, field, fields

import numpy as np

from drives import AVERAGE_DAYS, DayNoise, make_drives
from effects import EFFECTS, apply_effects
from meters import read_meters, true_meters
from office import Office, as_built
from simulate import part_of, simulate
from weather import STEPS_PER_HOUR, synthetic_weather

SETTLING_DAYS = 60  # simulated before the first measured day, then left out


@dataclass(frozen=True)
class Recipe:
    climate: str
    first_day: str
    n_days: int
    seed: int
    design: Office
    effects: dict = field(default_factory=dict)  # name -> size, None = the table's


@dataclass
class Case:
    recipe: Recipe
    built: Office
    weather: object          # of the measured days
    times: np.ndarray        # begins of the hours
    true: dict               # meter -> [n_hours] kWh
    measured: dict           # meter -> [n_hours] kWh, NaN = missing


def meters_of(recipe, built, weather, noise, effects):
    """Hourly true energy of the measured days."""
    drives = make_drives(built, weather, noise, recipe.seed, recipe.first_day)
    apply_effects(drives, built, effects)
    hourly = true_meters(built, drives, simulate(built, weather, drives))
    return {name: series[SETTLING_DAYS * 24:] for name, series in hourly.items()}


def weather_of(recipe):
    """Weather with the settling days before the measured ones."""
    first = np.datetime64(recipe.first_day) - SETTLING_DAYS
    return synthetic_weather(recipe.climate, first, recipe.n_days + SETTLING_DAYS, recipe.seed)


def make_case(recipe, noise=DayNoise()):
    built = as_built(recipe.design, recipe.seed)
    weather = weather_of(recipe)
    true = meters_of(recipe, built, weather, noise, recipe.effects)
    first = SETTLING_DAYS * 24 * STEPS_PER_HOUR
    measured_weather = part_of(weather, first, len(weather.times))
    return Case(recipe, built, measured_weather, measured_weather.times[::STEPS_PER_HOUR], true,
                read_meters(true, recipe.seed))


def cv_rmse(simulated, measured):
    """CV(RMSE) over the hours that have a reading [%]."""
    there = ~np.isnan(measured)
    error = (simulated - measured)[there]
    return float(100 * np.sqrt((error ** 2).mean()) / measured[there].mean())


def truth_of(case):
    """What only the generator knows; errors are of the last year, which jobs hold out."""
    recipe = case.recipe
    last = case.times >= case.times[-1].astype("datetime64[Y]").astype(case.times.dtype)
    weather = weather_of(recipe)
    expected = meters_of(recipe, case.built, weather, AVERAGE_DAYS, recipe.effects)
    plain = meters_of(recipe, case.built, weather, AVERAGE_DAYS, {})
    floor = lambda series: {name: round(cv_rmse(series[name][last], case.measured[name][last]), 2)
                            for name in case.measured}
    numbers = {f.name: round(getattr(case.built, f.name), 4) for f in fields(case.built)
               if isinstance(getattr(case.built, f.name), float)}
    return {"seed": recipe.seed, "climate": recipe.climate,
            "effects": {name: {"meaning": EFFECTS[name].meaning, "unit": EFFECTS[name].unit,
                               "size": EFFECTS[name].size if size is None else size}
                        for name, size in recipe.effects.items()},
            "true_parameters": numbers,
            "held_out_cv_rmse_percent": {"noise_floor": floor(case.true),
                                         "expected_floor": floor(expected),
                                         "true_parameters_no_effect": floor(plain)}}
