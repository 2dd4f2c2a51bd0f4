"""Weather files: their days, where they stand, temperatures by month, and what of a CSV file is which column.

An EPW file of a typical year is refused: its days are none on which a meter was read. EPW: rows of year, month, day,
hour, minute, flags, dry bulb; the place by the last five numbers of the first line, for a name may hold a comma.
"""
import datetime as dt
import functools
import os
import re
from dataclasses import dataclass, field

from cases.toml import number
from new_job import places, tables, times
from new_job.refused import USAGE, Refused
from new_job.words import says, unit_of

HEADER = 8                     # lines of an EPW file
# What a column is, by the words of its name, the best first.
COLUMNS = (
    ("outdoor_temperature", r"t2m|t out|outdoor temp|outdoor air temp|dry ?bulb|air temp|temperature|temp|t air|"
                            r"oat|tdry|ta|t"),
    ("global_horizontal", r"ghi|global|allsky sfc sw dwn|swdown|solar|irradiance|radiation|g h"),
    ("direct_normal", r"dni|direct normal|allsky sfc sw dni|gb n|beam"),
    ("diffuse_horizontal", r"dhi|allsky sfc sw diff|gd h|diffuse"),
    ("wind_speed", r"wind ?sp|wind ms|wind km ?h|wind mph|ws10m|wind|ws"),
    ("relative_humidity", r"rh2m|rh|relative hum|humidity"),
    ("cloud_cover", r"cloud"),
)
NOT_THESE = r"dew|t2mdew|wet|t2mwet|dir\b|direction|gust|soil|ground|pressure"
NOT_GLOBAL = r"direct|direkt|diffus|normal|beam|dni|dhi"
# What an EPW file says of its source where its year was put together: a typical one, of whatever years.
TYPICAL_SOURCE = re.compile(r"\b(TMYx?|TMY\d?|IWEC\d?|IGDG|CSWD|CWEC\d*|SWEC|SWERA|TRY|CTZ\d*|CZ\d+|ISHRAE|RMY|NIWE|"
                            r"INETI|CityUHK|KISR|IMGW|CTYW|ETMY|MSI|DSY)\b")
NEEDED = ("outdoor_temperature", "global_horizontal", "direct_normal")
SUN = {"global_horizontal", "direct_normal", "cloud_cover"}
POOR = 0.05                    # share of hours without a cloud cover
CLOUDS = ((10, "%"), (8, "tenths"), (1, "oktas"), (-1, None))  # the largest value is above
SPEEDS = ((r"km ?h|kph", "km/h"), (r"mph|mi ?h", "mph"), (r"knots?|kts?|kn", "knots"))
MOST_FILLED = 48               # h, of `fill_gaps`
USUAL_FILL = 6                 # h
MISSING_SUN, MISSING_TEMPERATURE = 9999, 99.9   # in an EPW file
MOST_CELSIUS, LEAST_KELVIN = 58, 200   # of the warmest hour (the record is 56.7 degC), where no unit is said
TYPICAL = "the weather of the readings' own years is needed: an EPW of measured years (often named AMY), or a CSV " \
          "file with outdoor temperature and irradiance from a station or a reanalysis (ERA5, NSRDB, a weather service)"


@dataclass
class Weather:
    """Times are the files' own; a step is an hour in them."""
    files: list
    first: dt.datetime
    last: dt.datetime          # end of the last hour
    months: dict               # {month: mean outdoor temperature [degC]}
    latitude: float = None
    longitude: float = None
    offset: float = None       # of standard time to UTC [h]
    offset_is: str = "the EPW file's"
    is_epw: bool = True
    columns: list = field(default_factory=list)  # (key, column, unit or None)
    keys: dict = field(default_factory=dict)     # of [weather]
    holes: list = field(default_factory=list)    # (first, last) that are too long to be filled
    has_sun: bool = True
    degree_days: tuple = (0, 0)                  # cooling above 10 degC, heating below 18 degC, of a year
    days: dict = field(default_factory=dict)     # {date: mean outdoor temperature [degC]}

    @property
    def site(self):
        """(latitude, longitude, UTC offset [h])"""
        return self.latitude, self.longitude, self.offset

    def set_offset(self, place, told):
        """By the country where no file says it, by the longitude where the country has several zones."""
        if self.offset is None:
            self.offset, self.offset_is = place.offset, f"of {place.name}"
        if self.offset is None:
            self.offset = round(self.longitude / 15)
            self.offset_is = "check this: by the longitude; the country has several zones"
            told.check(f"[site] utc_offset: {self.offset:+d} h was taken by the longitude {number(self.longitude)}")


@functools.cache
def epw_rows(path):
    """(first line, lines of hours); read once, for several ask."""
    lines = tables.text_of(path).replace("\r\n", "\n").replace("\r", "\n").split("\n")
    lines = [line for line in lines if line.strip(" ,")]
    if not lines or not lines[0].upper().startswith("LOCATION"):
        raise Refused(f"{path}:1: begins with {lines[0][:20]!r} and is no EPW file; expected LOCATION" if lines else
                      f"{path}: is empty; expected an EPW file")
    start = next((k for k, line in enumerate(lines) if line.upper().startswith("DATA PERIODS")), HEADER - 1) + 1
    return lines[0], lines[start:]


def location(path, line):
    """(latitude, longitude, UTC offset)"""
    cells = [cell.strip() for cell in line.strip().rstrip(",").split(",")]
    for k in range(len(cells) - 4, 0, -1):
        try:
            latitude, longitude, offset, _ = (float(cell) for cell in cells[k:k + 4])
        except ValueError:
            continue
        if abs(latitude) <= 90 and abs(longitude) <= 180 and -12 <= offset <= 14:
            return latitude, longitude, offset
    raise Refused(f"{path}:1: has no latitude, longitude, time zone and elevation at its end")


def read_epw(path):
    """(location, [(time, temperature)]) of the hours with a temperature."""
    head, lines = epw_rows(path)
    rows = []
    for k, line in enumerate(lines, HEADER + 1):
        cells = line.split(",")
        try:
            year, month, day, hour = (int(float(cell)) for cell in cells[:4])
            time, temperature = dt.datetime(year, month, day) + dt.timedelta(hours=hour - 1), float(cells[6])
        except (ValueError, IndexError, OverflowError):
            raise Refused(f"{path}:{k}: {line[:40]!r} is no row of an EPW file; expected year, month, day, hour, ...") \
                from None
        if temperature < MISSING_TEMPERATURE:
            rows.append((time, temperature))
    if len(rows) < 24:
        raise Refused(f"{path}: has {len(rows)} hours; expected the weather of the readings' years")
    if any(b[0] < a[0] for a, b in zip(rows, rows[1:])):
        years = sorted({time.year for time, _ in rows})
        raise Refused(f"{path}: is a typical year, made of months of {years[0]} to {years[-1]}; {TYPICAL}")
    return location(path, head), rows


def tell_typical(path, told):
    """A file of measured years may have kept the first line of a typical one from which it was made."""
    source = TYPICAL_SOURCE.search(",".join(epw_rows(path)[0].split(",")[1:]).replace("-", " "))
    if source:
        told.check(f"{path}:1: its source is {source.group()}, as that of typical years; expected measured days")


def is_epw(path):
    return os.path.basename(path).lower().removesuffix(".gz").endswith(".epw")


def hours_of(paths):
    """[(time, temperature, global, direct normal, diffuse)] of EPW files; nothing of others [degC, W/m2]."""
    found = []
    for path in paths:
        if not is_epw(path):
            return []
        for line in epw_rows(path)[1]:
            cells = line.split(",")
            year, month, day, hour = (int(float(cell)) for cell in cells[:4])
            sun = (float(cell) for cell in cells[13:16])
            found.append((dt.datetime(year, month, day, hour - 1), float(cells[6]),
                          *(0 if value >= MISSING_SUN else value for value in sun)))
    return found


def day_means(rows):
    by_day = {}
    for time, theta in rows:
        by_day.setdefault(time.date(), []).append(theta)
    return {day: sum(values) / len(values) for day, values in by_day.items()}


def degree_days(means):
    """(cooling above 10 degC, heating below 18 degC) a year."""
    a_year = 365 / len(means)
    return sum(max(t - 10, 0) for t in means) * a_year, sum(max(18 - t, 0) for t in means) * a_year


def month_means(rows):
    months = {}
    for time, theta in rows:
        months.setdefault(time.month, []).append(theta)
    return {month: sum(values) / len(values) for month, values in months.items()}


def without_gaps(read, told):
    """Of files in the order of time those that follow one another: the program takes no gap between them."""
    runs = [[read[0]]]
    for one, other in zip(read, read[1:]):
        apart = other[2][0][0] - one[2][-1][0]
        runs.append([other]) if apart > times.HOUR * (1 + MOST_FILLED) else runs[-1].append(other)
    longest = max(runs, key=lambda run: sum(len(rows) for _, _, rows in run))
    for path, _, rows in (file for run in runs if run is not longest for file in run):
        told.check(f"{path}: left out: hours between it, {rows[0][0]:%Y-%m-%d} to {rows[-1][0]:%Y-%m-%d}, and "
                   f"{longest[0][0]} are absent")
    return longest


def of_epw(paths, told):
    read = sorted(((path, *read_epw(path)) for path in paths), key=lambda row: row[2][0][0])
    read = without_gaps(read, told)
    for path, *_ in read:
        tell_typical(path, told)
    rows = [row for _, _, part in read for row in part]
    latitude, longitude, offset = read[0][1]
    holes = [(a[0], b[0]) for a, b in zip(rows, rows[1:]) if b[0] - a[0] > times.HOUR * (1 + MOST_FILLED)]
    days = day_means(rows)
    weather = Weather([path for path, _, _ in read], rows[0][0], rows[-1][0] + times.HOUR, month_means(rows), latitude,
                      longitude, offset, degree_days=degree_days(days.values()), days=days, holes=holes)
    gaps = [(b[0] - a[0]) / times.HOUR - 1 for a, b in zip(rows, rows[1:]) if b[0] - a[0] > times.HOUR]
    if short := [gap for gap in gaps if gap <= MOST_FILLED]:
        weather.keys["fill_gaps"] = int(max(USUAL_FILL, *short))
        told.check(f"{read[0][0]}: {sum(short):.0f} h have no row or no temperature, in gaps of up to "
                   f"{max(short):.0f} h; temperatures are filled by straight lines, the sun by that of the days around")
    return weather


def unit_of_column(key, name, values):
    """None where it is the one that is expected."""
    most = max((value for value in values if value is not None), default=0)
    if key == "wind_speed":
        return next((unit for pattern, unit in SPEEDS if says(pattern, name, whole=True)), None)
    if key == "outdoor_temperature":
        found = unit_of(name, "air_temperature")
        if found:
            return found[0] if found[0] != "degC" else None
        return "K" if most > LEAST_KELVIN else "degF" if most > MOST_CELSIUS else None
    if key == "relative_humidity":
        return "0 to 1" if most <= 1 else None
    if key == "cloud_cover":
        return next(unit for least, unit in CLOUDS if most > least)
    return None


def weather_columns(table):
    """{key: column}, each column once."""
    found = {}
    for key, pattern in COLUMNS:
        free = [name for name in table.values if name not in found.values() and not says(NOT_THESE, name)]
        if key == "global_horizontal":
            free = [name for name in free if not says(NOT_GLOBAL, name)]
        named = (name for word in pattern.split("|") for name in free if says(word, name, whole=len(word) < 4))
        if (name := next(named, None)) is not None:
            found[key] = name
    beam = {"direct_normal", "diffuse_horizontal"}
    drop = {"global_horizontal"} if beam <= set(found) else beam
    if "outdoor_temperature" not in found:
        raise Refused(f"{table.path}: has no column of the outdoor temperature among {', '.join(table.values)}; name "
                      "one T_out_C")
    return {key: name for key, name in found.items() if key not in drop}


def series_of(parts, columns):
    """{key: [(time, value or None)]} of all files."""
    series = {key: [] for key in columns}
    for table in parts:
        for key, name in columns.items():
            numbers = tables.numbers_in(table, name) if name in table.names else None
            if numbers is None:
                raise Refused(f"{table.path}: column {name}: is not there, or has cells that are no numbers")
            series[key] += zip(table.times, numbers.values)
    return series


def without_poor_clouds(series):
    """Clouds are of no use as the only sun where they are often not there."""
    clouds = [value for _, value in series.get("cloud_cover", [])]
    if clouds and clouds.count(None) > POOR * len(clouds):
        del series["cloud_cover"]
    return series


def whole_hours(series):
    """Times at which temperature and sun are there, in order."""
    keys = NEEDED if (SUN - {"cloud_cover"}) & set(series) else (*NEEDED, "cloud_cover")
    needed = [{time for time, value in series[key] if value is not None} for key in keys if key in series]
    return sorted(set.intersection(*needed))


def of_csv(paths, country, told):
    parts = sorted((tables.read_table(path, country) for path in paths), key=lambda table: table.times[0])
    first = parts[0]
    for table in parts:
        tables.check_order(table)
    series = without_poor_clouds(series_of(parts, weather_columns(first)))
    columns = {key: name for key, name in weather_columns(first).items() if key in series}
    whole = whole_hours(series)
    if len(whole) < 24 or first.step > 3600:
        raise Refused(f"{first.path}: has {len(whole)} rows with all of {', '.join(columns.values())}, "
                      f"{first.step:g} s apart; expected hours, or a finer step")
    units = {key: unit_of_column(key, name, [value for _, value in series[key]]) for key, name in columns.items()}
    theta = [(time, to_celsius(value, units["outdoor_temperature"])) for time, value in series["outdoor_temperature"]
             if value is not None]
    days = day_means(theta)
    weather = Weather([table.path for table in parts], whole[0], whole[-1] + times.HOUR, month_means(theta),
                      is_epw=False, columns=[(key, name, units[key]) for key, name in columns.items()],
                      degree_days=degree_days(days.values()), days=days, keys=keys_of(first),
                      has_sun=bool(SUN & set(columns)))
    add_gaps(weather, whole)
    weather.keys |= marks_of(first, columns.values())
    if units["outdoor_temperature"] and not unit_of(columns["outdoor_temperature"], "air_temperature"):
        told.check(f"{first.path}: {columns['outdoor_temperature']}: was read as {units['outdoor_temperature']}, by "
                   "its size")
    if first.is_guess:
        told.check(f"{first.path}: its dates were read as {first.form}, but day and month cannot be told apart")
    return weather


def add_gaps(weather, whole):
    """Short ones are filled by the program, longer ones are holes between which periods lie."""
    gaps = [(a, b) for a, b in zip(whole, whole[1:]) if b - a > times.HOUR]
    if not gaps:
        return
    longest = max((b - a) / times.HOUR for a, b in gaps)
    weather.holes = [(a, b) for a, b in gaps if (b - a) / times.HOUR - 1 > MOST_FILLED]
    weather.keys |= {"gaps": "missing", "fill_gaps": int(min(MOST_FILLED, max(USUAL_FILL, longest)))}


def marks_of(table, columns):
    """How numbers are written."""
    read = [tables.numbers_in(table, name) for name in columns]
    marks = {"decimal": [numbers.decimal for numbers in read if numbers.decimal != "."],
             "thousands": [numbers.thousands for numbers in read if numbers.thousands]}
    return {key: found[0] for key, found in marks.items() if found}


def to_celsius(value, unit):
    return (value - 32) / 1.8 if unit == "degF" else value - 273.15 if unit == "K" else value


def keys_of(table):
    """How a file's times and numbers are read, where it does not show it."""
    keys = {}
    if len(table.time) > 1 or table.names.index(table.time[0]) > 0:
        keys["time"] = list(table.time)
    if table.form:
        keys["time_format"] = table.form
    if (stamp := tables.stamp_of(table)) == "end":
        keys["stamp"] = stamp
    if says("utc|gmt", " ".join(table.time), whole=True) and not table.has_offset:
        keys["utc_offset"] = 0
    elif not table.has_offset and table.step <= 3600 and (clock := times.clock_of(table.times)):
        keys["clock"] = clock
    return keys


def read_weather(paths, country, site, told):
    """`site`: (latitude, longitude) or None; `country`: a key of places.PLACES."""
    are_epw = {is_epw(path) for path in paths}
    if len(are_epw) > 1:
        raise Refused("--weather: has EPW and CSV files; expected one kind", USAGE)
    weather = of_epw(paths, told) if are_epw == {True} else of_csv(paths, country, told)
    if site:
        weather.latitude, weather.longitude = site
    if weather.latitude is None:
        raise Refused(f"{paths[0]}: says not where it is, as an EPW file does; add --site 52.20,0.12 (latitude and "
                      "longitude, north and east positive)", USAGE)
    weather.set_offset(places.PLACES[country], told)
    return weather
