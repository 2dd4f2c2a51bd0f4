"""Of which kind the values of building.json are, by their keys."""
from dataclasses import dataclass
from typing import Callable


@dataclass(frozen=True)
class Kind:
    words: str
    fits: Callable          # value -> whether it is of this kind


def is_number(value):
    """Neither true nor what JSON writes as NaN or Infinity."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < 1e300


def is_text(value):
    return isinstance(value, str)


def is_object(value):
    return isinstance(value, dict)


def list_of(fits):
    return lambda value: isinstance(value, list) and all(map(fits, value))


NUMBER = Kind("a number", is_number)
KINDS = {key: kind for keys, kind in (
    ("site geometry envelope internal ventilation plant schedules declared_closed_days "
     "domestic_hot_water channels occ equip light hvac vent", Kind("an object", is_object)),
    ("case weather_train weather_test construction slab heat_source heating_available "
     "cooling_available use", Kind("a text", is_text)),
    ("hours", Kind('"learn"', lambda value: value == "learn")),
    ("gross_floor_area_m2 air_volume_m3 SHGC_normal solar_absorptance_wall",
     Kind("a number above 0", lambda value: is_number(value) and value > 0)),
    ("wd sat sun hourly_shares cooking_shares", Kind(
        "24 numbers", lambda value: list_of(is_number)(value) and len(value) == 24)),
    ("facades", Kind("a list of objects", list_of(is_object))),
    ("list_mm_dd", Kind("a list of texts", list_of(is_text))),
    ("adiabatic", Kind("true or false", lambda value: isinstance(value, bool))),
    ("id", Kind("a number or a text", lambda value: is_number(value) or is_text(value))),
    ("cooling_setback_C", Kind('a number, or "off"', lambda value: value is None or
                               is_number(value) or is_text(value))),
) for key in keys.split()}


def kind_of(key):
    return KINDS.get(key, NUMBER)
