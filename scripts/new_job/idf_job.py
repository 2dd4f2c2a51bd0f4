"""The text of a first job from an EnergyPlus file: its own schedules, constructions, zone and priors."""
import os

import numpy as np

from cases.toml import number
from new_job import building, job, priors
from new_job.idf_schedules import KINDS, MONTH_DAYS, runs_of
from new_job.job import NOT_COOLED, section

MOST_RUNS = 26                 # parts of the year with schedules of their own; more are one mean
WEEKDAYS = ("monday", "tuesday", "wednesday", "thursday", "friday")
HEAT_CAPACITIES = (80000, 600000)  # J/(m2 K), to which the capacity of the layers is cut
MOST_AIR = 20                  # 1/h, that a job takes
MOST_G, LEAST_SHARE = 0.95, 0.3


def header(first):
    found = first.model
    yield f"# A first job, written by bemcal-batch new from {os.path.basename(found.file)}: " \
          f"{number(round(found.area, 1))} m2, {number(round(found.volume, 1))} m3, one zone, {first.place.name}."
    yield "# Numbers are the file's; priors say how far they are trusted."
    yield "#"
    yield "# Look first at:"
    yield "# - the meters: quantity and unit; then `bemcal-batch check`, whose lines \"data, ...\" tell more"
    yield "# - [plant]: what heats and cools"
    yield from (f"# - check this: {line}" for line in first.told.checks)
    yield from (f"# - left out: {line}" for line in first.told.left_out)


def flows(found):
    """Profiles of air changes, by name."""
    return (("infiltration", np.minimum(found.infiltration, MOST_AIR)),
            ("ventilation", np.minimum(found.ventilation, MOST_AIR)))


def profiles(first):
    """{name of schedule: profile} of all that is scheduled."""
    found = first.model
    named = {name: profile.values for name, profile in found.loads.items()}
    named |= dict(flows(found))
    named |= {name: profile for name, profile in (("heating", found.heating), ("cooling", found.cooling))
              if profile is not None}
    return named


def span_of(name, profile):
    """(value where the schedule is 1, value where it is 0): there loads and air are nothing, set-points set back."""
    least, most = float(profile.min()), float(profile.max())
    return (most, least) if name == "heating" else (least, most) if name == "cooling" else (most, 0.0)


def is_constant(profile):
    return float(np.ptp(profile)) < 1e-6


def value_of(name, profile):
    """A number, or {value, low, schedule}."""
    value, low = map(rounded, span_of(name, profile))
    return value if is_constant(profile) else job.scheduled(value, low, name)


def hours(values):
    """24 numbers, or one."""
    rounded = [float(f"{value:.3f}") + 0.0 for value in values]   # and no -0
    return rounded[0] if len(set(rounded)) == 1 else rounded


def week(values):
    """Rows of a section for (8, 24) values."""
    days = [hours(day) for day in values]
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


def schedules(first):
    summer_time = job.summer_time_of(first.options.country, first.options.state)
    for name, profile in profiles(first).items():
        if is_constant(profile):
            continue
        value, low = span_of(name, profile)
        shares = (profile - low) / (value - low)
        runs = runs_of(shares)
        if len(runs) > MOST_RUNS:
            first.told.check(f"schedule {name}: it has {len(runs)} parts of the year; their mean was taken")
            runs = [(0, 364, shares.mean(axis=0))]
        yield schedule_text(name, runs, None if summer_time == "none" else summer_time)


def schedule_text(name, runs, summer_time):
    usual = max(runs, key=lambda run: sum(b - a + 1 for a, b, values in runs if np.allclose(values, run[2])))[2]
    holiday, sunday = hours(usual[KINDS - 1]), hours(usual[6])
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
    shell = first.model.shell
    for each in shell.opaque.values():
        yield section("[[construction]]", ("name", each.name), ("u_value", rounded(each.u_value), "films of ISO 6946"),
                      ("solar_absorptance", rounded(each.absorptance)), ("emissivity", rounded(each.emissivity)),
                      ("external_resistance", each.r_outside))
    for each in shell.glazing.values():
        yield section("[[glazing]]", ("name", each.name), ("u_value", rounded(each.u_value), each.says),
                      ("solar_transmittance", rounded(each.solar)), ("frame_fraction", 0, "the glass is the opening"))
    if any(part.boundary == "ground" for part in shell.surfaces.values()):
        yield section("[[boundary]]", ("name", "ground"),
                      ("temperature", rounded(shell.ground), "mean of Site:GroundTemperature:BuildingSurface"))


def capacity(found):
    """[J/(m2 K)]"""
    return min(max(found.shell.heat_capacity / found.area, HEAT_CAPACITIES[0]), HEAT_CAPACITIES[1])


def set_points(first):
    """(heating, cooling) values of the job."""
    found, usual = first.model, building.set_points(first.use, first.options.country)
    heating = usual[0] if found.heating is None else value_of("heating", found.heating)
    is_cooled = first.plant.cooling is not None and found.cooling is not None
    return heating, value_of("cooling", found.cooling) if is_cooled else NOT_COOLED


def zone(first):
    found, is_cooled = first.model, first.plant.cooling is not None
    heating, cooling = set_points(first)
    yield section(
        "[[zone]]", ("name", "building"), ("floor_area", round(found.area, 2), "of the zones with a thermostat"),
        ("volume", round(found.volume, 2)),
        ("heat_capacity", rounded(capacity(found), 3), "of inner layers: ISO 13790, 12.3.1"),
        ("heating_set_point", heating), ("heating_capacity", 100 if first.is_hourly else None, "W/m2, usual"),
        ("cooling_set_point", cooling, "" if is_cooled else first.plant.cooling_says),
        ("cooling_capacity", (90 if first.is_hourly else None) if is_cooled else 0))
    yield from surfaces(found.shell)
    for name, profile in flows(found):
        yield section("[[zone.flow]]", ("name", name), ("air_change", value_of(name, profile), "1/h, of the volume"))
    for load in first.loads:
        profile = found.loads.get(load.name)
        yield section("[[zone.load]]", ("name", load.name),
                      ("density", value_of(load.name, profile.values) if profile else round(load.value, 2), load.says),
                      ("carrier", load.carrier or None),
                      ("heat_fraction", None if profile and profile.share > 0.999 else rounded(profile.share, 3)
                       if profile else 0))


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


def priors_of(first):
    found, zone_name = first.model, "zone.building"
    largest = max(each.u_value for each in [*found.shell.opaque.values(), *found.shell.glazing.values()])
    yield priors.factor("envelope", ["construction.*.u_value", *(["glazing.*.u_value"] if found.shell.glazing else [])],
                        LEAST_SHARE, min(2, priors.MOST_U / largest), first.envelope.sd, "on all U-values")
    if first.is_hourly and found.shell.glazing:
        yield priors.factor("g_window", ["glazing.*.solar_transmittance"], LEAST_SHARE,
                            min(1.3, MOST_G / first.envelope.g), 0.2, "blinds and shade")
    for name, profile in flows(found):
        most = float(profile.max())
        yield priors.level(name, f"{zone_name}.flow.{name}.air_change", most, 0.4 * most + 0.1, "[1/h]",
                           most=MOST_AIR)
    names = [load.name for load in first.loads if load.name not in ("people", "hot_water")]
    if names:
        yield priors.factor("lights_and_equipment", [f"{zone_name}.load.{name}.density" for name in names], 0.2, 3, 0.3,
                            "on all")
    for load in first.loads:
        if load.name == "people":
            yield priors.level("people", f"{zone_name}.load.people.density", load.value, 0.3 * load.value, "[W/m2]")
        if load.name == "hot_water":
            yield priors.level("hot_water", f"{zone_name}.load.hot_water.density", load.value,
                               max(0.5 * load.value, 0.25 * load.most, 0.3), "[W/m2] at all hours", reach=load.most)
    yield from (prior for prior in priors.plant_priors(first, zone_name) if has_part(first, prior.name))


def has_part(first, name):
    """Whether the job has what a prior of the plant is for, and a meter that sees it."""
    if name.startswith("cooling") and not any(map(first.has, ("electricity", "cooling", "air_temperature"))):
        return False
    if name.endswith("set_back"):
        profile = first.model.heating if name.startswith("heating") else first.model.cooling
        return profile is not None and not is_constant(profile)
    return True


PARTS = (job.site, job.holidays, job.weather, job.periods, schedules, constructions, zone, job.plant, job.meters)


def idf_text(first):
    return job.job_text(first, header, PARTS, priors_of)
