#!/usr/bin/python3
"""`new --idf` reads of DOE's small office and mid-rise apartment building what EnergyPlus itself reports of them.

Areas, U-values without and with films, volume, people's heat, lights, equipment and air of a year, all within ASKED but
for EXCUSED. Areas and U-values are those of EnergyPlus's envelope summary, use is summed over the hours of its year.
Surfaces by length and height have EnergyPlus's areas, azimuths and tilts.
Skipped where EnergyPlus or the buildings are not installed (tests/energyplus/idf.py, reports.py).
"""
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests" / "energyplus")]

import idf                 # noqa: E402  (found above)
import numpy as np         # noqa: E402
import reports             # noqa: E402
from new_job import idf_building, idf_geometry, idf_schedules   # noqa: E402
from new_job.idf import read_model   # noqa: E402
from new_job.weather import epw_rows, hours_of, location   # noqa: E402

BUILDINGS = {"small_office": "RefBldgSmallOfficeNew2004_Chicago.idf",
             "apartments": "RefBldgMidriseApartmentNew2004_Chicago.idf"}
WEATHER = "USA_IL_Chicago-OHare*.epw"
SKIPPED = 77
ASKED = 1                  # %
GAINS = ("people", "lights", "equipment")
SECONDS = 3600             # an hour


def parts_of(shell):
    """{part: (area, UA without films, UA with films)} of what new --idf read."""
    found = {}
    for part in shell.surfaces.values():
        name = "ground" if part.boundary == "ground" else "buffer" if part.adjustment != 1 else \
            "roof" if part.tilt < 60 else "walls"
        each = shell.opaque[part.construction]
        add(found, name, part.area, each.bare, each.u_value)
    return found


def add(found, name, area, bare, u_value):
    found[name] = found.get(name, np.zeros(3)) + area * np.array([1, bare, u_value])


def parts_reported(year, conditioned):
    """The same of EnergyPlus's tables."""
    found, inner = {}, year.table("EnvelopeSummary", "Opaque Interior")
    for row in year.table("EnvelopeSummary", "Opaque Exterior").values():
        if row.get("Zone", "").lower() in conditioned:
            tilt = float(row["Tilt"])
            add(found, "roof" if tilt < 60 else "walls" if tilt < 120 else "ground", *numbers(row))
    for row in inner.values():
        other = inner.get(row.get("Adjacent Surface"))
        if other and row["Zone"].lower() in conditioned and other["Zone"].lower() not in conditioned:
            add(found, "buffer", *numbers(row))
    return found


def numbers(row):
    return (float(row[key]) for key in ("Net Area", "U-Factor no Film", "U-Factor with Film"))


def envelope(found, year, conditioned):
    """(name, unit, ours, EnergyPlus's)"""
    ours, theirs = parts_of(found.whole.shell), parts_reported(year, conditioned)
    for name in sorted(ours | theirs):
        for k, (suffix, unit) in enumerate((("area", "m2"), ("bare", "W/K"), ("films", "W/K"))):
            if name != "buffer" or suffix != "films":    # b of the buffer is not EnergyPlus's
                yield f"{name}_{suffix}", unit, ours.get(name, np.zeros(3))[k], theirs.get(name, np.zeros(3))[k]
    windows = [row for row in year.table("EnvelopeSummary", "Exterior Fenestration").values() if row.get("Zone")]
    glass = [(part.area, found.whole.shell.glazing[part.construction]) for part in found.whole.shell.windows.values()]
    for name, unit, our, key in (("windows_area", "m2", lambda each: 1, None),
                                 ("windows_UA", "W/K", lambda each: each.u_value, "Glass U-Factor"),
                                 ("windows_gA", "m2", lambda each: each.solar, "Glass SHGC")):
        yield name, unit, sum(area * our(each) for area, each in glass), \
            sum(float(row["Area of Multiplied Openings"]) * (float(row[key]) if key else 1) for row in windows)


def mean_by(calendar, profile):
    """Mean of a profile by the days of EnergyPlus's year."""
    firsts = np.cumsum([0, *idf_schedules.MONTH_DAYS])
    return float(np.mean([
        profile[firsts[month - 1] + day - 1, idf_schedules.KIND_OF[kind.lower()], (hour - 1 + summer) % 24]
        for month, day, hour, summer, kind in calendar]))


def use(found, year, conditioned):
    calendar, alike = year.calendar(), year.multipliers()
    profiles = {"people": ("W", found.whole.loads["people"].values * found.whole.area, lambda zone: alike[zone]),
                "lights": ("W", found.whole.loads["lights"].values * found.whole.area, lambda zone: alike[zone]),
                "equipment": ("W", found.whole.loads["equipment"].values * found.whole.area, lambda zone: alike[zone]),
                "infiltration": ("m3/h", found.whole.infiltration * found.whole.volume,
                                 lambda zone: 3600 * alike[zone] * (zone in conditioned)),
                # An air system's flow is that of all zones that are alike.
                "ventilation": ("m3/h", found.whole.ventilation * found.whole.volume, lambda zone: 3600)}
    gains = np.zeros(2)
    for (name, (unit, profile, factor)), variable in zip(profiles.items(), reports.HOURLY):
        pair = np.array([mean_by(calendar, profile), np.mean(year.sums(variable, factor))])
        gains += pair * (name in GAINS)
        yield name, unit, *map(float, pair)
    yield "gains", "W", *map(float, gains)
    outside = {"outside_lights": reports.OUTSIDE[:1], "hot_water": reports.OUTSIDE[1:]}
    for name, meters in outside.items():
        if name in found.whole.loads:
            drawn = [np.mean(hours) / SECONDS for hours in map(year.hours, meters) if hours]
            yield name, "W", mean_by(calendar, found.whole.loads[name].values * found.whole.area), sum(drawn)


def rows(found, year):
    zones = year.table("InputVerificationandResultsSummary", "Zone Summary")
    conditioned = {name.lower() for name, row in zones.items() if row.get("Conditioned (Y/N)") == "Yes"}
    total = zones["Conditioned Total"]
    yield "floor_area", "m2", found.whole.area, float(total["Area"])
    yield "volume", "m3", found.whole.volume, float(total["Volume"])
    yield from envelope(found, year, conditioned)
    yield from use(found, year, conditioned)


def compare(building, found, year):
    """Prints all and returns what is too far."""
    wrong = []
    for name, unit, ours, theirs in rows(found, year):
        off = 100 * (ours / theirs - 1)
        print(f"measured {building:12} {name:14} {ours:10.2f} {unit:5} EnergyPlus {theirs:10.2f} {off:+6.2f} %")
        if not abs(off) <= ASKED:
            wrong.append(f"{building} {name}: {off:+.2f} %, above {ASKED}")
    return wrong


# A zone by length and height, whose axes are turned by 30 + 10 deg where coordinates are relative.
RECTANGLES = """Version, {version};
SimulationControl, No, No, No, Yes, No;
Building, Box, 30, Suburbs;
GlobalGeometryRules, UpperLeftCorner, {order}, {relative}, Relative, {relative};
Site:Location, Here, 41, -87, -6, 190;
SizingPeriod:DesignDay, Day, 1, 21, WinterDesignDay, -20, 0, , , Wetbulb, -20, , , , , 99000, 4, 270, No, No, No,
  ASHRAEClearSky;
Zone, Room, 10, 5, 5, 0, 1, 1;
Material, Brick, Rough, 0.24, 0.8, 1800, 900;
Construction, Wall, Brick;
Wall:Exterior, south, Wall, Room, , 180, 90, 0, 0, 0, 10, 3;
Wall:Exterior, east, Wall, Room, , 90, , 10, 0, 0, 8, 3;
Wall:Adiabatic, west, Wall, Room, , 270, 90, 0, 8, 0, 8, 3;
Wall:Underground, north, Wall, Room, , 0, 90, 10, 8, 0, 10, 3;
Roof, roof, Wall, Room, , 180, 30, 0, 0, 3, 10, 8;
Floor:GroundContact, floor, Wall, Room, , 180, , 0, 8, 0, 10, 8;
Output:SQLite, SimpleAndTabular;
"""


def rectangles(energyplus, weather):
    """What EnergyPlus says otherwise of surfaces by length and height."""
    for order, relative in (("Counterclockwise", "Relative"), ("Clockwise", "Relative"), ("Counterclockwise", "World")):
        text = RECTANGLES.format(version=reports.version_of(energyplus), order=order, relative=relative)
        with tempfile.TemporaryDirectory() as folder:
            theirs = reports.Run(energyplus, text, weather, pathlib.Path(folder), "-D").surfaces()
            zones = idf_geometry.read_zones(read_model(str(pathlib.Path(folder, "in.idf"))))
        ours = {s.given.name: (s.gross, s.azimuth, s.tilt) for s in zones["room"].surfaces}
        if set(ours) != set(theirs) or not all(np.allclose(ours[name], theirs[name], atol=0.01) for name in ours):
            yield f"rectangles, {order}, {relative}: {ours}, not {theirs}"


def main():
    energyplus = idf.program()
    if energyplus is None:
        print(idf.HOW)
        return SKIPPED
    weather = reports.file_like(energyplus, WEATHER)
    models = {building: reports.file_like(energyplus, name) for building, name in BUILDINGS.items()}
    if weather is None or None in models.values():
        print(reports.HOW)
        return SKIPPED
    wrong = list(rectangles(energyplus, weather))
    for building, model in models.items():
        with tempfile.TemporaryDirectory() as folder:
            year = reports.Year(energyplus, model, weather, pathlib.Path(folder))
            found = idf_building.read_building(str(model), hours=hours_of([str(weather)]),
                                               site=location(weather, epw_rows(str(weather))[0]), has_summer_time=True)
            wrong += compare(building, found, year)
    print("\n".join(wrong))
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
