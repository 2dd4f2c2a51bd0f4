"""The text of a first job: sections in the order in which a person reads them, with where each number is from."""
import json
import os
from dataclasses import dataclass

from cases.toml import number, numbers
from new_job import building
from new_job.places import STATES, are_holidays_known, summer_time_of
from new_job.priors import priors_of
from new_job.refused import printable

NOT_COOLED = 60                # degC, a set-point that no room reaches
HALF_CLOUDED = 0.5             # cloud cover, where the weather has no sun
USUAL = {"office": (7, 18), "home": (6, 22), "school": (7, 16), "shop": (9, 20)}  # hours, without hourly meters
COMMENT_AT = 44
LEAST_BILLS = 24               # of training, for effects to be tried: with 12 a trend was taken that was none


@dataclass
class First:
    """All that the job is made of."""
    options: object
    use_name: str
    use: object
    place: object
    envelope: object
    form: object
    weather: object
    meters: list
    periods: object
    plant: object
    loads: list
    told: object
    model: object = None       # idf_building.Described, where an EnergyPlus file was read

    @property
    def is_hourly(self):
        return any(meter.is_hourly for meter in self.meters)

    def has(self, quantity):
        return any(meter.quantity == quantity for meter in self.meters)

    @property
    def most_of_loads(self):
        """Largest factor on lights and equipment: what the electricity meter shows, and half again."""
        declared = sum(load.value for load in self.loads if load.name in ("lights", "equipment"))
        meter = next((meter for meter in self.meters if meter.quantity == "electricity"), None)
        peak = building.quantile(building.densities(meter, self.form.area, self.periods), 0.98) if meter else 0
        return max(3, 1.5 * peak / declared)


def text(value):
    """A value of TOML."""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(text(each) for each in value) + "]"
    return number(value)


class Raw(str):
    """TOML as it stands."""


def section(heading, *rows):
    """Rows of (key, value[, comment]); None is left out."""
    lines = [heading]
    for key, value, *comment in rows:
        if value is None:
            continue
        line = f"{key} = {value if isinstance(value, Raw) else text(value)}"
        says = printable(comment[0]) if comment and comment[0] else ""
        lines.append(f"{line:{COMMENT_AT - 2}}  # {says}" if says else line)
    return "\n".join(lines) + "\n"


def scheduled(value, low, schedule):
    of_low = f"low = {number(low)}, " if low else ""
    return Raw(f'{{value = {number(value)}, {of_low}schedule = "{schedule}"}}')


def path_from(job, file):
    return os.path.relpath(os.path.abspath(file), os.path.dirname(os.path.abspath(job))).replace(os.sep, "/")


def header(first):
    o, told = first.options, first.told
    yield f"# A first job, written by bemcal-batch new: {first.use_name}, {number(o.area)} m2, built {o.built}, " \
          f"{first.place.name}."
    yield "# It is a box of one zone. Numbers are from tables by use, age and country, as said beside each."
    yield "# Priors are wide."
    yield "#"
    yield "# Look first at:"
    yield "# - the meters: quantity and unit; then `bemcal-batch check`, whose lines \"data, ...\" tell more"
    yield f"# - form: {first.form.storeys} storeys" + ("" if first.form.is_said else " (guessed)") + \
          ", glass, and which facades have neighbours"
    yield "# - [plant]: what heats and cools; windows that were replaced; hours, if they are known"
    yield from (f"# - check this: {line}" for line in told.checks)


def site(first):
    if first.weather.is_epw and not first.options.site:
        return
    weather = first.weather
    yield section("[site]", ("latitude", weather.latitude, "--site" if first.options.site else "the EPW file's"),
                  ("longitude", weather.longitude), ("utc_offset", weather.offset, weather.offset_is))


def holidays(first):
    o = first.options
    years = [day.year for period in (first.periods.training, first.periods.held_out) for day in period]
    if are_holidays_known(o.country, min(years), max(years)):
        yield section("[holidays]", ("country", o.country),
                      ("state", o.state if o.state and o.country in STATES else None))


def weather(first):
    w = first.weather
    yield section("[weather]", ("files", [path_from(first.options.job, file) for file in w.files]),
                  ("format", None if w.is_epw else "csv"),
                  *((key, value) for key, value in w.keys.items() if key != "stamp"), ("stamp", w.keys.get("stamp")))
    if w.is_epw:
        return
    lines = ["[weather.columns]"]
    for key, column, unit in w.columns:
        lines.append(f"{key} = {text(column)}" if not unit else
                     f"{key} = {{column = {text(column)}, unit = {text(unit)}}}")
    if not w.has_sun:
        lines.append(f"cloud_cover = {{column = {text(w.columns[0][1])}, factor = 0, offset = {HALF_CLOUDED}}}  "
                     "# check this: no sun in the file; half a sky of clouds at all hours")
    yield "\n".join(lines) + "\n"


def periods(first):
    p = first.periods
    yield section("[periods]", ("training", [str(day) for day in p.training], p.says),
                  ("held_out", [str(day) for day in p.held_out]))


def schedules(first):
    summer_time = summer_time_of(first.options.country, first.options.state)
    summer_time = None if summer_time == "none" else summer_time
    for name, says in (("use", "people, lights, equipment"), ("plant", "set-points, ventilation")):
        if first.is_hourly:
            yield section("[[schedule]]", ("name", name, says), ("hours", "learn", "the loop finds when it is 1"),
                          ("use", first.use.learn), ("summer_time", summer_time))
            continue
        begin, end = USUAL[first.use.learn]
        day = Raw(numbers([float(begin <= hour < end) for hour in range(24)]))
        at_weekend = first.use.learn in ("home", "shop")
        yield section("[[schedule]]", ("name", name, f"{says}; usual hours, for no meter is read by the hour"),
                      ("weekdays", day), ("weekend", day if at_weekend else 0), ("summer_time", summer_time))


def constructions(first):
    e = first.envelope
    for name, value in (("wall", e.wall), ("roof", e.roof), ("ground_floor", e.floor)):
        yield section("[[construction]]", ("name", name), ("u_value", value, e.says))
    yield section("[[glazing]]", ("name", "window"), ("u_value", e.window, e.says),
                  ("solar_transmittance", e.g, "by the number of panes: EN ISO 13790 Table G.1"))


def zone(first):
    form, use, plant = first.form, first.use, first.plant
    heating, back, cooling, cooling_back = building.set_points(use, first.options.country)
    cooled = plant.cooling is not None
    yield f"# {number(round(form.storey, 1))} m2 a storey, {building.PLAN_RATIO:g} times as long as deep, long sides " \
          f"to south and north; {form.glass:.0%} glass (usual of the use)."
    yield section(
        "[[zone]]", ("name", "building"), ("floor_area", form.area, "--area"),
        ("volume", round(form.area * form.height, 1), f"{number(form.height)} m a storey"),
        ("class", "medium", "thermal mass: ISO 13790, Table 12"),
        ("heating_set_point", scheduled(heating, back, "plant"), "EN ISO 13790 G.12 and 1 K; set-back usual"),
        ("heating_capacity", 100 if first.is_hourly else None, "W/m2, usual"),
        ("cooling_set_point", scheduled(cooling, cooling_back, "plant") if cooled else NOT_COOLED,
         "EN 16798-1 category II" if cooled and cooling == building.COOLING_SET_POINT else
         "DOE reference buildings" if cooled else plant.cooling_says),
        ("cooling_capacity", (90 if first.is_hourly else None) if cooled else 0))
    yield from surfaces(first)
    yield section("[[zone.flow]]", ("name", "infiltration"), ("air_change", first.envelope.infiltration, "by age"))
    yield section("[[zone.flow]]", ("name", "ventilation"),
                  ("air_change", scheduled(round(building.air_change(use, form), 2), 0, "plant"),
                   f"{number(use.air)} l/(s m2): ASHRAE 62.1-2019"))
    for load in first.loads:
        value = round(load.value, 2)
        yield section("[[zone.load]]", ("name", load.name),
                      ("density", scheduled(value, 0, load.schedule) if load.schedule else value, load.says),
                      ("carrier", load.carrier or None), ("heat_fraction", None if load.heats else 0))


def surfaces(first):
    form = first.form
    for azimuth, area in form.facades.items():
        yield section("[[zone.surface]]", ("construction", "wall"), ("area", round(area * (1 - form.glass), 1)),
                      ("azimuth", azimuth))
        yield section("[[zone.window]]", ("glazing", "window"), ("area", round(area * form.glass, 1)),
                      ("azimuth", azimuth))
    yield section("[[zone.surface]]", ("construction", "roof"), ("area", round(form.storey, 1)), ("azimuth", 0),
                  ("tilt", 0))
    yield section("[[zone.surface]]", ("construction", "ground_floor"), ("area", round(form.storey, 1)),
                  ("adjustment", 0.5, "half of the loss to outdoors"), ("in_sun", False))


def plant(first):
    p = first.plant
    yield section("[plant]", ("heating_carrier", p.heating, p.heating_says),
                  ("heating_efficiency", float(f"{p.efficiency:.3g}") if p.heating != "none" else None),
                  ("cooling_carrier", p.cooling or "none", p.cooling_says),
                  ("cooling_cop", float(f"{p.cop:.3g}") if p.cooling == "electricity" else None))


def meters(first):
    for meter in first.meters:
        files = [path_from(first.options.job, file) for file in meter.files]
        yield section("[[meter]]", ("name", meter.name), ("quantity", meter.quantity),
                      ("interval", meter.interval if meter.interval != "hourly" else None),
                      ("file", files if meter.more else files[0], "; ".join(meter.comments)),
                      ("column", meter.column), ("unit", meter.unit),
                      ("factor", meter.factor if meter.factor != 1 else None), *meter.keys.items())


def study(first):
    begin, end = first.periods.training
    n_bills = max(sum(begin <= time.date() <= end for time, _ in meter.read()) for meter in first.meters)
    too_few = n_bills < LEAST_BILLS
    return section("[[study]]", ("kind", "loop", "what does the building do that is not described here?"),
                   ("most_effects", 0 if too_few else None, f"{n_bills} bills show no effect that can be believed"),
                   ("functions", False if too_few else None))


PARTS = (site, holidays, weather, periods, schedules, constructions, zone, plant, meters)


def job_text(first, head=header, parts_of=PARTS, priors=priors_of):
    # The header comes last, for the parts add to what is to be checked.
    parts = [*(part for of in parts_of for part in of(first)), *(prior.text() for prior in priors(first)),
             study(first)]
    return "\n".join([*head(first), "seed = 1", "", *parts])
