#!/usr/bin/python3
"""A stand-in for EnergyPlus: it takes the same words and writes an eplusout.sql whose numbers can be foretold.

Electricity:Facility of an hour is its number in the year [kWh], gas a tenth of that, a room's temperature the EPW's.
The name of the model's Building says what goes wrong: "severe", "silent".
"""
import datetime
import json
import pathlib
import shutil
import sqlite3
import sys

VERSION = "25.2"
KWH = 3.6e6
VOLUMES = {"SOUTH ROOM": 300, "NORTH ROOM": 100}
ROOM_STEP = {"SOUTH ROOM": 4, "NORTH ROOM": 0}   # K above outdoors


def spans(model):
    for fields in model["RunPeriod"].values():
        begin = datetime.datetime(fields["begin_year"], fields["begin_month"], fields["begin_day_of_month"])
        end = datetime.datetime(fields["end_year"], fields["end_month"], fields["end_day_of_month"])
        yield begin, ((end - begin).days + 1) * 24


def temperatures(path):
    rows = [line.split(",") for line in pathlib.Path(path).read_text(encoding="latin-1").splitlines()[8:]]
    return {(int(row[1]), int(row[2]), int(row[3])): float(row[6]) for row in rows}


def tables(db):
    db.executescript(
        "CREATE TABLE Time (TimeIndex INTEGER, Year INTEGER, Month INTEGER, Day INTEGER, Hour INTEGER, Minute INTEGER, "
        "Dst INTEGER, Interval INTEGER, IntervalType INTEGER, WarmupFlag INTEGER, EnvironmentPeriodIndex INTEGER);"
        "CREATE TABLE EnvironmentPeriods (EnvironmentPeriodIndex INTEGER, EnvironmentType INTEGER);"
        "CREATE TABLE ReportDataDictionary (ReportDataDictionaryIndex INTEGER, IsMeter INTEGER, KeyValue TEXT, "
        "Name TEXT, ReportingFrequency TEXT);"
        "CREATE TABLE ReportData (TimeIndex INTEGER, ReportDataDictionaryIndex INTEGER, Value REAL);"
        "CREATE TABLE Zones (ZoneName TEXT, Volume REAL, FloorArea REAL, Multiplier REAL, ListMultiplier REAL);")
    db.executemany("INSERT INTO EnvironmentPeriods VALUES (?, ?)", [(1, 1), (2, 3)])
    db.executemany("INSERT INTO Zones VALUES (?, ?, 100, 1, 1)", VOLUMES.items())
    names = [(1, 1, "", "Electricity:Facility"), (2, 1, "", "NaturalGas:Facility"), (3, 1, "", "Heating:NaturalGas"),
             *((4 + k, 0, room, "Zone Mean Air Temperature") for k, room in enumerate(VOLUMES))]
    db.executemany("INSERT INTO ReportDataDictionary VALUES (?, ?, ?, ?, 'Hourly')", names)


def write(folder, model, weather):
    theta, index = temperatures(weather), 0
    with sqlite3.connect(folder / "eplusout.sql") as db:
        tables(db)
        db.execute("INSERT INTO Time VALUES (0, 2021, 1, 21, 1, 0, 0, 60, 1, 0, 1)")   # of a design day
        db.execute("INSERT INTO ReportData VALUES (0, 1, 1e30)")
        for begin, n_hours in spans(model):
            for k in range(n_hours):
                index, time = index + 1, begin + datetime.timedelta(hours=k)
                number = (time - datetime.datetime(time.year, 1, 1)) / datetime.timedelta(hours=1)
                outdoor = theta[time.month, time.day, time.hour + 1]
                db.execute("INSERT INTO Time VALUES (?, ?, ?, ?, ?, 0, 0, 60, 1, 0, 2)",
                           (index, time.year, time.month, time.day, time.hour + 1))
                values = [number * KWH, number * KWH / 10, number * KWH / 20,
                          *(outdoor + step for step in ROOM_STEP.values())]
                db.executemany("INSERT INTO ReportData VALUES (?, ?, ?)",
                               [(index, at, value) for at, value in enumerate(values, 1)])


def main(words):
    if words == ["--version"]:
        print(f"EnergyPlus, Version {VERSION}.0-stub")
        return
    folder, source = pathlib.Path(words[words.index("-d") + 1]), pathlib.Path(words[-1])
    if "--convert-only" in words:
        if source.suffix == ".idf":
            shutil.copy(pathlib.Path(__file__).parent / "model.epJSON", folder / f"{source.stem}.epJSON")
        else:
            (folder / f"{source.stem}.idf").write_text(f"Version, {VERSION};\n")
        return
    model = json.loads(source.read_text())
    said = next(iter(model["Building"])).lower()
    if said == "severe":
        (folder / "eplusout.err").write_text("   ** Warning ** mild\n   ** Severe  ** the roof leaks\n"
                                             "   **   ~~~   ** a lot\n   **  Fatal  ** the end\n")
        sys.exit(1)
    if said != "silent":
        write(folder, model, words[words.index("-w") + 1])


if __name__ == "__main__":
    main(sys.argv[1:])
