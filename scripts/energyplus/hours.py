"""What EnergyPlus is asked to report by the hour, and the meters' hours from it.

Energies are sums of EnergyPlus's meters [J -> kWh]; the room's temperature is the mean of zones with a thermostat by
their volume [degC]. Heating and cooling are heat and cold of coils and baseboards; with ideal loads what they
supply. Ideal loads have no plant: carrier and efficiency or COP of run.json turn their heat and cold into energy, but
where the model gives them a fuel (24.2 and later), which EnergyPlus counts itself. Names of meters that a version does
not know are asked for all the same, and left out by EnergyPlus.
"""
import contextlib
import csv
import datetime
import sqlite3
from dataclasses import dataclass

import numpy as np

from energyplus.failed import Failed
from energyplus.parameters import EFFICIENCIES, as_read
from energyplus.weather import HOURS
from new_job import idf_ideal, idf_schedules
from new_job.refused import Refused

KWH = 3.6e6                    # J
# Meters whose sum is one quantity; several names of one thing are of several versions.
_GAS, _HEAT = ("NaturalGas", "Gas"), ("DistrictHeatingWater", "DistrictHeatingSteam", "DistrictHeating")
SUMS = {
    "electricity": ("Electricity:Facility",),
    "gas": tuple(f"{name}:Facility" for name in _GAS),
    "district": tuple(f"{name}:Facility" for name in _HEAT),
    "heating": ("HeatingCoils:EnergyTransfer", "Baseboard:EnergyTransfer"),
    "cooling": ("CoolingCoils:EnergyTransfer",),
}
# What of each carrier heats or cools.
HEATING_PART = {"electricity": ("Heating:Electricity",), "gas": tuple(f"Heating:{name}" for name in _GAS),
                "district": tuple(f"Heating:{name}" for name in _HEAT)}
COOLING_PART = {"electricity": ("Cooling:Electricity",)}
IDEAL_HEAT = tuple(f"Heating:{name}" for name in _HEAT)
IDEAL_COLD = ("Cooling:DistrictCooling",)
TEMPERATURE = "Zone Mean Air Temperature"
QUANTITIES = (*SUMS, "air_temperature")
IDEAL = ("ZoneHVAC:IdealLoadsAirSystem", "HVACTemplate:Zone:IdealLoadsAirSystem")
# Classes of output that a run does without.
REPORTS = ("Output:", "OutputControl:Table", "OutputControl:Files", "LifeCycleCost:", "ComponentCost:")


@dataclass
class Plant:
    """What turns heat and cold of ideal loads into energy; carriers are None for other systems. `own`: of heating and
    cooling what burns fuels of the model."""
    is_ideal: bool
    heating: str = ""          # electricity, gas, district; "": heat is not metered as energy
    efficiency: float = 1
    cooling: str = ""
    cop: float = 1
    own: tuple = ()

    def scale(self, name, value):
        """By a parameter; the count of what it changed."""
        if not self.is_ideal or EFFICIENCIES.get(name, "") in ("", *self.own):
            return 0
        if name == "heating_efficiency":
            self.efficiency *= value
            return int(bool(self.heating))
        self.cop *= value
        return int(bool(self.cooling))


def own_fuels(model):
    """Of heating and cooling those whose ideal loads have a fuel or an efficiency in the model."""
    if not model.all(IDEAL[0]):
        return ()
    read = as_read(model)
    try:
        schedules = idf_schedules.Schedules(read)
        return tuple(mode for mode in idf_ideal.FUELS if idf_ideal.fuels_of(read, schedules, mode))
    except Refused as error:
        raise Failed(str(error)) from None


def plant_of(model, said):
    is_ideal = any(model.all(kind) for kind in IDEAL)
    plant = Plant(is_ideal, *(said.get(key, usual) for key, usual in (
        ("heating_carrier", "district"), ("heating_efficiency", 1), ("cooling_carrier", ""), ("cooling_cop", 1))),
                  own_fuels(model))
    for key, value in (("heating_efficiency", plant.efficiency), ("cooling_cop", plant.cop)):
        if not isinstance(value, (int, float)) or not 0 < value < 100:
            raise Failed(f"plant: {key}: {value!r}; expected a number above 0")
    plant.heating, plant.cooling = ("" if each == "none" else each for each in (plant.heating, plant.cooling))
    return plant


def names_of_meters():
    tables = (SUMS, HEATING_PART, COOLING_PART)
    return list(dict.fromkeys([*(name for table in tables for names in table.values() for name in names),
                               *IDEAL_HEAT, *IDEAL_COLD]))


def ask(model):
    """Puts these outputs in place of the model's own, which cost time."""
    for beginning in REPORTS:
        model.remove_beginning(beginning)
    for name in names_of_meters():
        model.add("Output:Meter", name, {"key_name": name, "reporting_frequency": "Hourly"})
    for zone in model.conditioned():
        model.add("Output:Variable", f"room {zone}",
                  {"key_value": zone, "variable_name": TEMPERATURE, "reporting_frequency": "Hourly"})
    model.add("Output:SQLite", "hours", {"option_type": "Simple"})


class Hours:
    """Series of all periods, by name of EnergyPlus's meter, and zones' temperatures [kWh, degC]."""

    def __init__(self, n_hours):
        self.n_hours, self.meters, self.rooms, self.zones = n_hours, {}, {}, {}
        self.seen = {}

    def series(self, table, name):
        """Made where a run brings it first, of a kind that shows what no run has filled."""
        return table.setdefault(name, np.full(self.n_hours, np.nan))

    def read(self, path, spans):
        try:
            with contextlib.closing(sqlite3.connect(f"file:{path}?mode=ro", uri=True)) as db:
                self.take(db, spans)
        except sqlite3.Error as error:
            raise Failed(f"{path}: {error}; expected hours as EnergyPlus writes them, and room on the disk") from None

    def take(self, db, spans):
        """Meters and rooms by the hour, each by one query; zones beside."""
        self.zones |= {name.upper(): (volume * times, area * times) for name, volume, area, times in db.execute(
            "SELECT ZoneName, Volume, FloorArea, Multiplier * ListMultiplier FROM Zones")}
        place = places_of_times(db, spans)
        for index, name, key, is_meter in db.execute(
                "SELECT ReportDataDictionaryIndex, Name, KeyValue, IsMeter FROM ReportDataDictionary "
                "WHERE ReportingFrequency = 'Hourly'").fetchall():
            rows = np.array(db.execute("SELECT TimeIndex, Value FROM ReportData WHERE ReportDataDictionaryIndex = ?",
                                       (index,)).fetchall(), dtype=float).reshape(-1, 2)
            at = place[rows[:, 0].astype(int)]
            if not (at >= 0).any():
                continue
            series = self.series(self.meters, name) if is_meter else self.series(self.rooms, key.upper())
            series[at[at >= 0]] = rows[at >= 0, 1] / (KWH if is_meter else 1)

    def sum(self, names):
        """Of meters that EnergyPlus knows; zeros where it knows none."""
        return sum((self.meters[name] for name in names if name in self.meters), np.zeros(self.n_hours))

    def room(self):
        weights = {zone: self.zones[zone][0] for zone in self.rooms}
        total = sum(weights.values())
        return sum(self.rooms[zone] * weight for zone, weight in weights.items()) / total

    def floor_area(self):
        """[m2] of zones with a thermostat."""
        return sum(self.zones[zone][1] for zone in self.rooms)


def places_of_times(db, spans):
    """[TimeIndex] of a weather hour its row in hours.csv; -1 of design days, warm-up and what no span has."""
    at = {}
    for span in spans:
        at |= {span.begin + k * HOURS: span.at + k for k in range(span.n_hours)}
    place = np.full(1 + db.execute("SELECT COALESCE(MAX(TimeIndex), 0) FROM Time").fetchone()[0], -1)
    for index, year, month, day, hour in db.execute(
            "SELECT t.TimeIndex, t.Year, t.Month, t.Day, t.Hour FROM Time t "
            "JOIN EnvironmentPeriods e ON e.EnvironmentPeriodIndex = t.EnvironmentPeriodIndex "
            "WHERE e.EnvironmentType = 3 AND t.IntervalType = 1 AND COALESCE(t.WarmupFlag, 0) = 0"):
        place[index] = at.get(datetime.datetime(year, month, day) + (hour - 1) * HOURS, -1)
    return place


@dataclass
class Energy:
    """One quantity's hours: `heating` and `cooling` are the parts of it that heat and cool [kWh]."""
    total: np.ndarray
    heating: np.ndarray
    cooling: np.ndarray
    is_used: bool = False      # by any part of the model


def energies(hours, plant):
    """{quantity: Energy} of all periods."""
    made = {quantity: Energy(hours.sum(names), hours.sum(HEATING_PART.get(quantity, ())),
                             hours.sum(COOLING_PART.get(quantity, ())), any(name in hours.meters for name in names))
            for quantity, names in SUMS.items()}
    made["air_temperature"] = Energy(hours.room(), np.zeros(hours.n_hours), np.zeros(hours.n_hours), True)
    if plant.is_ideal:
        convert_ideal(made, hours.sum(IDEAL_HEAT), hours.sum(IDEAL_COLD), plant)
    return made


def convert_ideal(made, heat, cold, plant):
    """But for what burns fuels of the model, whose heat or cold no meter of EnergyPlus has."""
    if "heating" not in plant.own:
        convert_heat(made, heat, plant)
    if "cooling" not in plant.own:
        convert_cold(made, cold, plant)


def convert_heat(made, heat, plant):
    district = made["district"]
    district.total, district.heating, district.is_used = district.total - heat, np.zeros_like(heat), False
    made["heating"].total, made["heating"].is_used = made["heating"].total + heat, True
    if plant.heating:
        carrier, used = made[plant.heating], heat / plant.efficiency
        carrier.total, carrier.heating, carrier.is_used = carrier.total + used, carrier.heating + used, True


def convert_cold(made, cold, plant):
    made["cooling"].total, made["cooling"].is_used = made["cooling"].total + cold, True
    if plant.cooling:
        carrier, used = made[plant.cooling], cold / plant.cop
        carrier.total, carrier.cooling, carrier.is_used = carrier.total + used, carrier.cooling + used, True


def check(hours, meters, made):
    """Every hour is there, and no meter is of what the model does not use."""
    gaps = next((name for table in (hours.meters, hours.rooms) for name, series in table.items()
                 if np.isnan(series).any()), None)
    if not hours.rooms or gaps:
        raise Failed(f"EnergyPlus reported no hour of some days ({gaps or TEMPERATURE}); expected weather of all days "
                     "of the periods, and a zone with a thermostat")
    for meter in meters:
        if not made[meter["quantity"]].is_used:
            raise Failed(f'meters: {meter["name"]}: the model uses no {meter["quantity"]}; expected another quantity, '
                         "or a plant in run.json for ideal loads")


def write(path, meters, made):
    """A header line, then a row for every hour."""
    columns = [[f"{value:.7g}" for value in made[meter["quantity"]].total] for meter in meters]
    with open(path, "w", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerow(meter["name"] for meter in meters)
        file.writelines(",".join(row) + "\n" for row in zip(*columns))
