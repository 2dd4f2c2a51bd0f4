"""The job of a school room calibrated in stages on fortnights of 10-minute air temperature, as paper
2 does it where no supply temperature is measured: 1 unoccupied and passive (August), 3 occupied
and passive (spring), 4 occupied and heated (autumn); judged on a fortnight in May and one in
December that no stage has seen.

Reads building.json, the training year's weather and measured_10min.csv.
"""
import json
import os

from cases.building import Manner, building_parts
from cases.folder import days_of, read_case
from cases.parameters import ROWS, STRUCTURE, Row, parameters
from cases.toml import section, texts

READINGS = "measured_10min.csv"
FORTNIGHTS = {"training": ("08-06", "08-19"), "spring": ("04-24", "05-07"),
              "autumn": ("11-06", "11-19"), "may": ("05-15", "05-28"),
              "december": ("12-04", "12-17")}

SECOND_MASS = [
    Row("second_mass_conductance", "replace", 0, 10, None, None,
        ["zone.zone.second_mass_conductance"]),
    Row("second_mass_capacity", "replace", 20000, 1e6, None, None, ["zone.zone.second_mass_capacity"])]

# name: (stage it starts from, period, parameters)
ENVELOPE = ["u_wall", "u_roof", "u_floor", "u_window", "solar_transmittance", "absorptance",
            "infiltration", "equipment", "heat_capacity", "air_capacity",
            "second_mass_conductance", "second_mass_capacity"]
OCCUPIED = ["people", "lights", "equipment", "ventilation", "solar_transmittance", "infiltration"]
HEATING = ["heating_set_point", "heating_setback", "heating_capacity", "thermostat_band",
           "emitter_lag"]
STAGES = {"envelope": ("initial", "training", ENVELOPE),
          "occupied_passive": ("envelope", "spring", OCCUPIED),
          "occupied_heated": ("envelope", "autumn", OCCUPIED + HEATING)}
VALIDATION = {"may": "occupied_passive", "december": "occupied_heated"}


def periods(year):
    return "\n".join(["[periods]"] + [f'{name} = ["{year}-{first}", "{year}-{last}"]'
                                      for name, (first, last) in FORTNIGHTS.items()]) + "\n"


def studies(names, options):
    """`names`: of the case's parameters."""
    yield section("[[study]]", kind="stages", meters=texts(["air"]), accuracy=0.35,
                  objective="likelihood", independent_hours=24, **options)
    for name, (start, period, wanted) in STAGES.items():
        yield section("[[study.stage]]", name=name, periods=texts([period]), **{"from": start},
                      parameters=texts([each for each in wanted if each in names]))
    for period, stage in VALIDATION.items():
        yield section("[[study.validation]]", period=period, stage=stage)


def job_text(case_dir, options):
    case_dir = os.path.abspath(case_dir)
    case = read_case(case_dir)
    case["site"]["weather_test"] = case["site"]["weather_train"]
    manner = Manner(files=(os.path.join(case_dir, READINGS),), interval="step",
                    place=lambda name: os.path.join(case_dir, name), for_loop=True)
    parts = list(building_parts(case, case_dir, manner))
    weather = case["site"]["weather_train"]
    doubled = json.dumps([manner.place(weather)] * 2)
    parts = [part.replace(doubled, json.dumps([manner.place(weather)])) for part in parts]
    rows = list(parameters(case, ROWS + STRUCTURE + SECOND_MASS, base_load=True))
    names = [json.loads(line.split(" = ")[1]) for row in rows for line in row.splitlines()
             if line.startswith("name = ")]
    year = days_of(os.path.join(case_dir, weather))[0].year
    return "\n".join(["seed = 1", *parts, section("[run]", step=600, warm_up_days=21),
                      periods(year), *rows, *studies(names, options)])
