"""Training and held-out days: what all meters and the weather have in common, the last part held out.

With two years the last one is held out, and the year before it trains (of days two, of bills three: more would be of
another building than today's). With less, three quarters train.
"""
import datetime as dt
from dataclasses import dataclass

from new_job.refused import Refused
from new_job.times import span
from new_job.weather import TYPICAL

DAY = dt.timedelta(days=1)
TRAINING_YEARS = {"hourly": 1, "daily": 2, "monthly": 3, "annual": 6}
TWO_YEARS = 700                # days
A_YEAR = 365
LEAST = {"hourly": 56, "daily": 90, "monthly": 240, "annual": 1000}  # days


@dataclass
class Periods:
    """First and last days."""
    training: tuple
    held_out: tuple
    says: str


def whole_days(first, last):
    """(first day, last day) that lie within two times."""
    begin = first.date() if first.time() == dt.time() else first.date() + DAY
    return begin, last.date() - DAY


def common_days(meters, weather):
    """Of the weather's longest stretch without a hole, and of all meters."""
    of_meters = max(meter.first for meter in meters), min(meter.last for meter in meters)
    edges = [weather.first, *(time for hole in weather.holes for time in hole), weather.last]
    stretches = [(max(a, of_meters[0]), min(b, of_meters[1])) for a, b in zip(edges[::2], edges[1::2])]
    best = max(stretches, key=lambda stretch: stretch[1] - stretch[0])
    return *whole_days(*best), of_meters


def without_strays(meters, weather, told):
    """Meters that share days with the weather; the others are left out, and told."""
    kept = [meter for meter in meters if min(meter.last, weather.last) - max(meter.first, weather.first) > DAY]
    if not kept:
        read = span(min(meter.first for meter in meters), max(meter.last for meter in meters))
        raise Refused(f"{', '.join(weather.files)}: is of {span(weather.first, weather.last)}, but the readings are of "
                      f"{read}: no day is in both; {TYPICAL}")
    while len(kept) > 1:
        first, last, _ = common_days(kept, weather)
        if (last - first).days >= LEAST[slowest(kept)]:
            break
        shortest = min(kept, key=lambda meter: meter.last - meter.first)
        kept.remove(shortest)
    for meter in meters:
        if meter not in kept:
            told.check(f"{meter.file}: {meter.column}: left out, for it has too few days in common with the weather "
                       "and the other meters")
    return kept


def slowest(meters):
    return max((meter.interval for meter in meters), key=list(TRAINING_YEARS).index)


def years_before(day, n):
    try:
        return day.replace(year=day.year - n)
    except ValueError:                               # 29 February
        return day.replace(year=day.year - n, day=28)


def choose_periods(meters, weather):
    first, last, of_meters = common_days(meters, weather)
    interval, n_days = slowest(meters), (last - first).days + 1
    if n_days < LEAST[interval]:
        n_read = (of_meters[1] - of_meters[0]).days
        advice = TYPICAL if n_read >= LEAST[interval] else f"the readings have {n_read} days alone"
        raise Refused(f"{', '.join(weather.files)}: {span(weather.first, weather.last)}: has {max(n_days, 0)} days in "
                      f"common with the readings ({span(*of_meters)}); expected {LEAST[interval]} or more of "
                      f"{interval} readings; {advice}")
    if n_days >= TWO_YEARS:
        begin = years_before(last + DAY, 1)
        begin = dt.date(last.year, 1, 1) if last.month == 12 and last.day > 20 else begin
        start = max(first, years_before(begin, TRAINING_YEARS[interval]))
        says = "the last year is held out"
        says += f"; days from {first} to {start - DAY} are not used" if (start - first).days > 31 else ""
    else:
        trained = 365 if n_days >= A_YEAR + 90 else int(n_days * 0.75)
        start, begin = first, first + trained * DAY
        says = "three quarters train" if trained < 365 else "a year trains"
        begin = begin.replace(day=1) if begin.day < 16 and n_days > 300 else begin
    return Periods((start, begin - DAY), (begin, last), says)
