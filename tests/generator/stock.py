"""A made stock: buildings of one form in many sizes at several weather stations, a file of hourly gas
each, and among them some that are broken, in ten ways.

The readings follow degree-hours, use by the clock and chance; no simulation, as only the machinery is
tried with them. The same for the same arguments.
"""
import gzip
from dataclasses import dataclass, field

import numpy as np

import weather

YEAR = "2022"
HOURS = 8760
CLIMATES = sorted(weather.CLIMATES)

BUILDING = """\
[weather]
files = ["@weather@"]
format = "csv"
[weather.columns]
outdoor_temperature = "T_out_C"
global_horizontal = "GHI_Wm2"
[site]
latitude = @latitude@
longitude = @longitude@
utc_offset = @utc_offset@
[periods]
training = ["2022-01-01", "2022-12-31"]
[[schedule]]
name = "day"
weekdays = [0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0]
weekend = 0
[[construction]]
name = "wall"
u_value = @u_wall@
[[construction]]
name = "roof"
u_value = 0.5
[[glazing]]
name = "window"
u_value = 2.8
solar_transmittance = 0.6
[[zone]]
name = "house"
floor_area = @floor_area@
volume = @volume@
class = "medium"
heating_set_point = {value = 21, low = 17, schedule = "day"}
cooling_set_point = 60
cooling_capacity = 0
    [[zone.surface]]
    construction = "roof"
    area = @roof@
    azimuth = 0
    tilt = 0
    [[zone.surface]]
    construction = "wall"
    area = @wall@
    azimuth = 0
    [[zone.surface]]
    construction = "wall"
    area = @wall@
    azimuth = 180
    [[zone.window]]
    glazing = "window"
    area = @window@
    azimuth = 0
    [[zone.window]]
    glazing = "window"
    area = @window@
    azimuth = 180
    [[zone.flow]]
    name = "infiltration"
    air_change = 0.5
    [[zone.load]]
    name = "gains"
    density = {value = 8, low = 2, schedule = "day"}
[plant]
heating_carrier = "gas"
heating_efficiency = 0.9
[[meter]]
name = "gas"
quantity = "gas"
file = "@meter@"
column = "kwh"
unit = "kWh"
[[parameter]]
name = "infiltration"
target = "zone.house.flow.infiltration.air_change"
min = 0.1
max = 2.0
[[parameter]]
name = "wall"
target = "construction.*.u_value"
mode = "factor"
min = 0.5
max = 2.0
[[parameter]]
name = "set_point"
target = ["zone.house.heating_set_point", "zone.house.heating_set_point.low"]
mode = "offset"
min = -2
max = 2
[[parameter]]
name = "gains"
target = "zone.house.load.gains.density"
min = 0
max = 20
"""

COLUMNS = ("name", "weather", "latitude", "longitude", "utc_offset", "floor_area", "volume", "roof", "wall",
           "window", "u_wall", "meter")
WAYS = ("missing meter file", "meter file cut off", "empty meter file", "no such column", "a word for a number",
        "negative floor area", "missing weather", "u_wall is a word", "name of another", "no reading")


@dataclass
class Stock:
    folder: object
    lines: list                                  # of cells by column
    broken: dict = field(default_factory=dict)   # line index: way

    def write_table(self):
        rows = [",".join(COLUMNS)] + [",".join(str(line[c]) for c in COLUMNS) for line in self.lines]
        (self.folder / "buildings.csv").write_text("\n".join(rows) + "\n")


def write_stations(folder, n_stations, seed):
    """Weather files; (name, climate, hourly temperatures) of each."""
    stations = []
    for k in range(n_stations):
        climate = CLIMATES[k % len(CLIMATES)]
        made = weather.synthetic_weather(climate, f"{YEAR}-01-01", 365, seed + k)
        weather.write_weather(folder / f"station_{k:02}.csv", made)
        stations.append((f"station_{k:02}.csv", made.climate, weather.hour_means(made.theta_e)))
    return stations


def stamps():
    hours = np.datetime64(f"{YEAR}-01-01T00", "h") + np.arange(HOURS)
    return [str(hour).replace("T", " ") + ":00" for hour in hours]


def readings(rng, area, theta_e):
    """Gas by the hour [kWh]."""
    hour = np.arange(HOURS) % 24
    day = np.where((hour >= 6) & (hour < 18), 1.0, 0.6)
    base = rng.uniform(14, 18)
    gas = area / 1000 * rng.uniform(1.5, 4) * np.maximum(base - theta_e, 0) * day
    gas = gas * np.repeat(rng.uniform(0.75, 1.25, HOURS // 24), 24)  # people differ from day to day
    gas = (gas + area / 1000 * rng.uniform(0.5, 2)) * rng.uniform(0.85, 1.15, HOURS)
    return np.round(gas, 2)


def write_readings(path, times, values, head="time,kwh"):
    text = head + "\n" + "\n".join(map("%s,%s".__mod__, zip(times, values.tolist()))) + "\n"
    path.write_bytes(gzip.compress(text.encode(), 1, mtime=0))


def line_of(rng, k, station):
    name, climate, _ = station
    area = float(np.round(rng.uniform(400, 4000), 1))
    side = area ** 0.5
    return {"name": f"h{k:05}", "weather": name, "latitude": climate.latitude, "longitude": climate.longitude,
            "utc_offset": climate.utc_offset_h, "floor_area": area, "volume": round(3 * area, 1),
            "roof": round(area / 2, 1), "wall": round(6 * side, 1), "window": round(2 * side, 1),
            "u_wall": round(rng.uniform(0.3, 1.5), 2), "meter": f"h{k:05}.csv.gz"}


def spoil(stock, k, way, times):
    line, path = stock.lines[k], stock.folder / stock.lines[k]["meter"]
    if way == 0:
        path.unlink()
    elif way == 1:
        path.write_bytes(path.read_bytes()[:5000])
    elif way == 2:
        path.write_bytes(b"")
    elif way == 3:
        write_readings(path, times, np.ones(HOURS), "time,gas")
    elif way == 4:
        text = gzip.decompress(path.read_bytes()).decode().split("\n")
        text[4000] = text[4000].split(",")[0] + ",broken"
        path.write_bytes(gzip.compress("\n".join(text).encode(), 1, mtime=0))
    elif way == 5:
        line["floor_area"] = -line["floor_area"]
    elif way == 6:
        line["weather"] = "nowhere.csv"
    elif way == 7:
        line["u_wall"] = "unknown"
    elif way == 8:
        line["name"] = stock.lines[k - 1]["name"]
    else:
        write_readings(path, times, np.full(HOURS, np.nan))
    stock.broken[k] = way


def make(folder, n_buildings, n_stations, seed=1, broken_share=0.03):
    """Table, template, weather and readings; every way of being broken comes, if enough are."""
    rng = np.random.default_rng([seed, 7])
    stations, times = write_stations(folder, n_stations, seed), stamps()
    (folder / "building.toml").write_text(BUILDING)
    stock = Stock(folder, [])
    for k in range(n_buildings):
        station = stations[k % n_stations]
        stock.lines.append(line_of(rng, k, station))
        write_readings(folder / stock.lines[k]["meter"], times,
                       readings(rng, stock.lines[k]["floor_area"], station[2]))
    n_broken = round(broken_share * n_buildings)
    for nth, k in enumerate(sorted(rng.choice(np.arange(1, n_buildings), n_broken, replace=False))):
        spoil(stock, int(k), nth % len(WAYS), times)
    stock.write_table()
    return stock


def change(stock, share, seed=2):
    """Readings of some sound buildings differ; their line indices."""
    rng = np.random.default_rng([seed, 8])
    near_broken = {k for b in stock.broken for k in (b - 1, b)}
    sound = [k for k in range(len(stock.lines)) if k not in near_broken]
    chosen = sorted(int(k) for k in rng.choice(sound, max(round(share * len(stock.lines)), 1), replace=False))
    times = stamps()
    for k in chosen:
        path = stock.folder / stock.lines[k]["meter"]
        text = gzip.decompress(path.read_bytes()).decode().split("\n")[1:-1]
        values = np.array([float(row.split(",")[1]) for row in text])
        write_readings(path, times, np.round(values * 1.1, 2))
    return chosen


def job_text(n_points):
    return (f"name = \"made\"\nseed = 5\n[stock]\ntable = \"buildings.csv\"\ntemplate = \"building.toml\"\n"
            f"[[study]]\nkind = \"screening\"\nn_points = {n_points}\n")
