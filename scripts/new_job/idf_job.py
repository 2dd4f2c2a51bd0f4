"""The text of a first job from an EnergyPlus file: its own schedules, constructions, zone and priors."""
import math
import os
from dataclasses import dataclass
from functools import partial

import numpy as np

from cases.toml import number
from new_job import building, job, priors
from new_job.idf_envelope import GROUND_CLASSES
from new_job.idf_outside import HOT_WATER
from new_job.idf_schedules import HOURS, KINDS, MONTH_DAYS, MOST_RUNS, runs_of
from new_job.job import NOT_COOLED, section

SAME_SHARE = 6                 # digits by which hours of two rooms are the same
WEEKDAYS = ("monday", "tuesday", "wednesday", "thursday", "friday")
MOST_AIR = 20                  # 1/h, that a job takes
MOST_DENSITY = 1e4            # W/m2, that a job takes
MOST_G, LEAST_SHARE, MOST_FACTOR = 0.95, 0.3, 3
OF_ROOMS = ("infiltration", "ventilation", "people", "heat_capacity")   # numbers that each room has of its own


def header(first):
    found = first.model
    n_rooms = len(found.rooms)
    yield f"# A first job, written by bemcal-batch new from {os.path.basename(found.file)}: " \
          f"{number(round(found.whole.area, 1))} m2, {number(round(found.whole.volume, 1))} m3, " \
          f"{'one zone' if n_rooms == 1 else f'{n_rooms} zones'}, {first.place.name}."
    yield "# Numbers are the file's; priors say how far they are trusted."
    yield "#"
    yield "# Look first at:"
    yield "# - the meters: quantity and unit; then `bemcal-batch check`, whose lines \"data, ...\" tell more"
    yield "# - [plant]: what heats and cools"
    yield from (f"# - check this: {line}" for line in first.told.checks)
    yield from (f"# - left out: {line}" for line in first.told.left_out)


def flows(room):
    """Profiles of air changes, by name."""
    return (("infiltration", np.minimum(room.infiltration, MOST_AIR)),
            ("ventilation", np.minimum(room.ventilation, MOST_AIR)))


def cut_air(first):
    """Tells of rooms whose air a job would not take."""
    lost = [(room, sum(float(np.maximum(profile - MOST_AIR, 0).mean()) * room.volume
                       for profile in (room.infiltration, room.ventilation))) for room in first.model.rooms]
    lost = [(room, flow) for room, flow in lost if flow > 0]
    if lost:
        first.told.check(f"air of {', '.join(room.name for room, _ in lost)}: above {MOST_AIR} 1/h, which a job takes "
                         f"at most; {sum(flow for _, flow in lost):.0f} m3/h are left out")


def profiles(room):
    """{name: profile} of all that is scheduled."""
    named = {name: profile.values for name, profile in room.loads.items()}
    named |= dict(flows(room))
    named |= {name: profile for name, profile in (("heating", room.heating), ("cooling", room.cooling))
              if profile is not None}
    return named


@dataclass
class Hours:
    """Schedules of all rooms: rooms with the same hours share one."""
    shares: dict               # {name of schedule: (365, 8, 24)}
    names: dict                # {(room, what is scheduled): name of schedule}


def hours_of(found):
    hours, known = Hours({}, {}), {}
    for room in found.rooms:
        for name, profile in profiles(room).items():
            if is_constant(profile):
                continue
            value, low = span_of(name, profile)
            shares = (profile - low) / (value - low)
            # What has no hours of its own in another room; the first room's have the plain name.
            key = name, np.round(shares, SAME_SHARE).tobytes()
            if key not in known:
                known[key] = name if name not in hours.shares else f"{name} of {room.name}"
                hours.shares[known[key]] = shares
            hours.names[room.name, name] = known[key]
    return hours


def span_of(name, profile):
    """(value where the schedule is 1, value where it is 0): there loads and air are nothing, set-points set back."""
    least, most = float(profile.min()), float(profile.max())
    return (most, least) if name == "heating" else (least, most) if name == "cooling" else (most, 0.0)


def is_constant(profile):
    return float(np.ptp(profile)) < 1e-6


def value_of(name, profile, schedule):
    """A number, or {value, low, schedule}."""
    value, low = map(rounded, span_of(name, profile))
    return value if is_constant(profile) else job.scheduled(value, low, schedule)


def day_of(values):
    """24 numbers, or one."""
    rounded = [float(f"{value:.3f}") + 0.0 for value in values]   # and no -0
    return rounded[0] if len(set(rounded)) == 1 else rounded


def week(values):
    """Rows of a section for (8, 24) values."""
    days = [day_of(day) for day in values]
    if all(day == days[0] for day in days[:7]):
        yield "every_day", days[0]
        return
    if all(day == days[0] for day in days[:5]):
        yield "weekdays", days[0]
    else:
        yield from zip(WEEKDAYS, days)
    yield "saturday", days[5]
    yield "sunday", days[6]


def month_day(day):
    """"MM-DD" of a day of the year from 0."""
    for month, n_days in enumerate(MONTH_DAYS, 1):
        if day < n_days:
            return f"{month:02}-{day + 1:02}"
        day -= n_days


def schedules(first, hours):
    summer_time = job.summer_time_of(first.options.country, first.options.state)
    for name, shares in hours.shares.items():
        runs = runs_of(shares)
        if len(runs) > MOST_RUNS:
            first.told.check(f"schedule {name}: it has {len(runs)} parts of the year; their mean was taken")
            runs = [(0, 364, shares.mean(axis=0))]
        yield schedule_text(name, runs, None if summer_time == "none" else summer_time)


def schedule_text(name, runs, summer_time):
    usual = max(runs, key=lambda run: sum(b - a + 1 for a, b, values in runs if np.allclose(values, run[2])))[2]
    holiday, sunday = day_of(usual[KINDS - 1]), day_of(usual[6])
    text = section("[[schedule]]", ("name", name), ("summer_time", summer_time), *week(usual),
                   ("holiday", holiday if holiday != sunday else None))
    for first, last, values in runs:
        if not np.allclose(values, usual):
            text += "\n" + section("[[schedule.period]]", ("dates", f"{month_day(first)}/{month_day(last)}"),
                                   *week(values))
    return text


def rounded(value, digits=4):
    return float(f"{value:.{digits}g}")


def constructions(first):
    shell = first.model.whole.shell
    for each in shell.opaque.values():
        yield section("[[construction]]", ("name", each.name),
                      ("u_value", rounded(each.u_value), "films of ASHRAE 90.1"),
                      ("solar_absorptance", rounded(each.absorptance)), ("emissivity", rounded(each.emissivity)),
                      ("external_resistance", rounded(each.film_in_sun())))
    for each in shell.glazing.values():
        yield section("[[glazing]]", ("name", each.name), ("u_value", rounded(each.u_value), each.says),
                      ("solar_transmittance", rounded(each.solar)), ("frame_fraction", 0, "the glass is the opening"))
    for name in dict.fromkeys(part.boundary for part in shell.surfaces.values() if part.boundary != "outdoors"):
        yield from ground(name, shell.grounds[name])


def ground(name, months):
    """Temperatures of the file's months, as a schedule where they differ."""
    by_day = np.repeat(months, MONTH_DAYS)[:, None, None] + np.zeros((KINDS, HOURS))
    if not is_constant(by_day):
        least, most = months.min(), months.max()
        yield schedule_text(name, runs_of((by_day - least) / (most - least)), None)
    value = rounded(months[0]) if is_constant(by_day) else \
        job.scheduled(rounded(months.max()), rounded(months.min()), name)
    yield section("[[boundary]]", ("name", name), ("temperature", value, f"by month: {GROUND_CLASSES[name][0]}"))


def set_points(first, room, names):
    """(heating, cooling) values of the job."""
    heating, _, cooling, _ = building.set_points(first.use, first.options.country)
    if room.heating is not None:
        heating = value_of("heating", room.heating, names.get((room.name, "heating")))
    if room.cooling is not None:
        cooling = value_of("cooling", room.cooling, names.get((room.name, "cooling")))
    tell_guessed(first, is_cooled(first, room))
    return heating, cooling if is_cooled(first, room) else NOT_COOLED


def is_cooled(first, room):
    """Whether something cools it below what no room reaches."""
    own = not first.model.has_thermostat if room.cooling is None else room.cooling.min() < NOT_COOLED
    return first.plant.cooling is not None and own


def tell_guessed(first, cools):
    """Set-points of a table, where the file has none."""
    guessed = [f"{mode}_set_point" for mode, is_used in (("heating", True), ("cooling", cools))
               if is_used and getattr(first.model.whole, mode) is None]
    if guessed:
        first.told.check(f"{' and '.join(guessed)}: {os.path.basename(first.model.file)} has no thermostat for it "
                         "(ZoneControl:Thermostat, HVACTemplate:Thermostat); usual ones of the use were taken: correct "
                         "them, or name the use by --use")


def zones(first, hours):
    for room in first.model.rooms:
        yield from zone(first, room, hours.names)


def zone(first, room, names):
    heating, cooling = set_points(first, room, names)
    has_cold = first.plant.cooling is not None
    yield section(
        "[[zone]]", ("name", room.name), ("floor_area", round(room.area, 2), "of the zones with a thermostat"
                                          if room is first.model.whole else ""),
        ("volume", round(room.volume, 2)),
        ("heat_capacity", rounded(room.shell.capacity(room.area), 3), "of inner layers: ISO 13790, 12.3.1"),
        ("heating_set_point", heating), ("heating_capacity", *capacity(first, room.heating_capacity, 100)),
        ("cooling_set_point", cooling, "" if has_cold else first.plant.cooling_says),
        ("cooling_capacity", *(capacity(first, room.cooling_capacity, 90) if has_cold else (0,))))
    yield from surfaces(room.shell)
    for name, profile in flows(room):
        yield section("[[zone.flow]]", ("name", name),
                      ("air_change", value_of(name, profile, names.get((room.name, name))), "1/h, of the volume"),
                      ("heat_recovery", rounded(room.heat_recovery, 3) if name == "ventilation" and room.heat_recovery
                       else None, "of its heat recovery"))
    for load in loads_in(first, room):
        profile = room.loads.get(load.name)
        yield section("[[zone.load]]", ("name", load.name),
                      ("density", value_of(load.name, profile.values, names.get((room.name, load.name)))
                       if profile else round(load.value, 2), load.says),
                      ("carrier", load.carrier or None),
                      ("heat_fraction", None if profile and profile.share > 0.999 else rounded(profile.share, 3)
                       if profile else 0))
    yield from couplings(first, room)


def capacity(first, limit, usual):
    """(value, comment) [W/m2]"""
    if limit is not None:
        return rounded(limit, 3), "W/m2, the file's limit"
    return usual if first.is_hourly else None, "W/m2, usual"


def couplings(first, room):
    """With each of the rooms that follow, behind "#": a loop takes none. Where multipliers differ, the mean."""
    rooms = first.model.rooms
    for other in rooms[rooms.index(room) + 1:]:
        conductance = (room.shell.between.get(other.name, 0) + other.shell.between.get(room.name, 0)) / 2
        if conductance:
            made = section("[[zone.coupling]]", ("zone", other.name), ("conductance", rounded(conductance), "W/K"))
            yield "".join(f"# {line}\n" for line in made.splitlines())


def loads_in(first, room):
    """The room's own, and those that no file says."""
    return [load for load in first.loads if load.name in room.loads or load.name not in first.model.whole.loads]


def surfaces(shell):
    for part in shell.surfaces.values():
        if part.area >= 0.01:
            in_sun = part.azimuth is not None
            yield section("[[zone.surface]]", ("construction", part.construction), ("area", round(part.area, 2)),
                          ("azimuth", part.azimuth), ("tilt", part.tilt if part.tilt != 90 else None),
                          ("boundary", part.boundary if part.boundary != "outdoors" else None),
                          ("adjustment", part.adjustment if part.adjustment != 1 else None,
                           "b of the zone without a thermostat behind"), ("in_sun", None if in_sun else False))
    for part in shell.windows.values():
        yield section("[[zone.window]]", ("glazing", part.construction), ("area", round(part.area, 2)),
                      ("azimuth", part.azimuth), ("tilt", part.tilt if part.tilt != 90 else None))


def targets_of(first, key, is_of=lambda room: True):
    """What sets a number of all rooms, or of some."""
    names = [room.name for room in first.model.rooms if is_of(room)]
    is_of_all = len(names) == len(first.model.rooms) > 1
    return [f"zone.{name}.{key}" for name in (["*"] if is_of_all else names)]


def envelope_priors(first):
    shell = first.model.whole.shell
    largest = max(each.u_value for each in [*shell.opaque.values(), *shell.glazing.values()])
    yield priors.factor("envelope", ["construction.*.u_value", *(["glazing.*.u_value"] if shell.glazing else [])],
                        LEAST_SHARE, min(2, priors.MOST_U / largest), first.envelope.sd, "on all U-values")
    if first.is_hourly and shell.glazing:
        yield priors.factor("g_window", ["glazing.*.solar_transmittance"], LEAST_SHARE,
                            min(1.3, MOST_G / first.envelope.g), 0.2, "blinds and shade")


def flow_priors(first):
    for name, profile in flows(first.model.whole):
        most = float(profile.max())
        yield priors.level(name, targets_of(first, f"flow.{name}.air_change"), most, 0.4 * most + 0.1, "[1/h]",
                           most=MOST_AIR)


def load_priors(first):
    of_file = first.model.whole.loads
    names = [load.name for load in first.loads if load.name in of_file and load.name != "people"]
    # Readings by the hour tell apart what has hours of its own; another meter may see hot water.
    groups = {name: [name] for name in names} if first.is_hourly else \
        {"lights_and_equipment": [name for name in names if name != HOT_WATER],
         HOT_WATER: [name for name in names if name == HOT_WATER]}
    for group, loads in groups.items():
        targets = [target for name in loads for target in load_targets(first, name)]
        if targets:
            yield priors.factor(group, targets, 0.2, min(3, most_of_loads(first, loads)), 0.3,
                                "relative to the file's")
    for load in first.loads:
        targets = load_targets(first, load.name)
        if load.name == "people":
            yield priors.level("people", targets, load.value, 0.3 * load.value, "[W/m2]")
        if load.name == HOT_WATER and HOT_WATER not in of_file:
            first.told.check(f"hot_water: the file has none that burns {load.carrier}; a usual {load.value:.2g} W/m2 of "
                             "the use was taken: write 0 where there is none")
            yield priors.level("hot_water", targets, load.value, max(0.5 * load.value, 0.25 * load.most, 0.3),
                               "[W/m2] at all hours", reach=load.most)


def most_of_loads(first, names):
    """Up to which no room's load is more than a job takes."""
    most = max(float(room.loads[name].values.max()) for room in first.model.rooms for name in names
               if name in room.loads)
    return math.floor(100 * MOST_DENSITY / rounded(most)) / 100


def load_targets(first, name):
    return targets_of(first, f"load.{name}.density",
                      lambda room: any(load.name == name for load in loads_in(first, room)))


def plant_priors(first):
    for prior in priors.plant_priors(first, lambda key: plant_targets(first, key)):
        if prior.targets and is_seen(first, prior.name):
            yield prior


def plant_targets(first, key):
    """A set-back is one of the rooms that have it; a cooling set-point of those that are cooled."""
    mode = key.partition("_")[0]     # heating or cooling
    if key == "cooling_set_point":
        return targets_of(first, key, lambda room: is_cooled(first, room))
    if not key.endswith(".low"):
        return targets_of(first, key)
    return targets_of(first, key, lambda room: not is_constant(profiles(room).get(mode, 0)))


def is_seen(first, name):
    """Whether a meter sees it."""
    return not name.startswith("cooling") or any(map(first.has, ("electricity", "cooling", "air_temperature")))


def as_factor(first, prior):
    """Of numbers that each room has of its own: the same prior on all of them, relative to its mean."""
    return priors.factor(prior.name, prior.targets, max(prior.least / prior.mean, LEAST_SHARE),
                         min(prior.most / prior.mean, MOST_FACTOR, most_factor(first, prior.name)),
                         prior.sd / prior.mean, "on each room's")


def most_factor(first, name):
    """Up to which no room's air change is more than a job takes; down to what a parameter's three digits hold."""
    most = max((float(dict(flows(room)).get(name, np.zeros(1)).max()) for room in first.model.rooms), default=0)
    return math.floor(100 * MOST_AIR / rounded(most)) / 100 if most else MOST_FACTOR


def priors_of(first):
    several = len(first.model.rooms) > 1
    for prior in (*envelope_priors(first), *flow_priors(first), *load_priors(first), *plant_priors(first)):
        of_rooms = prior.name in OF_ROOMS or any(getattr(room, prior.name, None) is not None
                                                 for room in first.model.rooms)
        yield as_factor(first, prior) if several and of_rooms and prior.mean > 0 else prior


def idf_text(first):
    cut_air(first)
    hours = hours_of(first.model)
    parts = (job.site, job.holidays, job.weather, job.periods, partial(schedules, hours=hours), constructions,
             partial(zones, hours=hours), job.plant, job.meters)
    return job.job_text(first, header, parts, priors_of)
