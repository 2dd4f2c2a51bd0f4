"""A case as a folder: building.json with the design, two years of EPW weather, measured.csv of the
first, measured_test.csv of the second, and truth.json. A year is 365 days."""
import csv
import json
from dataclasses import asdict

import numpy as np

from air_system import RESET, VAV
from case import SETTLING_DAYS, weather_of
from construction import MATERIALS
from drives import AVERAGE_DAYS, DayNoise, make_drives
from effects import EFFECTS, apply_effects
from meters import read_meters, read_sensor, true_air, true_meters
from office import AZIMUTH, FACADES, as_built, opaque_elements
from simulate import part_of, simulate
from weather import CLIMATES, STEPS_PER_HOUR, hour_means

YEAR = 8760
COLUMNS = {"air": "T_air_C", "heating": "heat_kWh", "cooling": "cool_kWh",
           "electricity": "elec_kWh", "gas": "gas_kWh"}
PERSON = 75.0            # sensible heat [W]
STEFAN_BOLTZMANN = 5.67e-8


# --- what the modeller knows

def ground_u_value(design):
    ground = next(e for e in opaque_elements(design) if e.ground)
    return 1 / (sum(d / MATERIALS[m][0] for m, d in ground.layers) + 1 / (ground.h_inside + 5.1))


def geometry(design):
    facades = [{"id": k, "azimuth_deg_from_north": AZIMUTH[f], "adiabatic": False,
                "area_m2": design.facade_area(f), "window_to_wall": design.window_share[f]}
               for k, f in enumerate(FACADES)]
    return {"gross_floor_area_m2": design.floor_area, "air_volume_m3": design.volume,
            "roof_area_exposed_m2": design.footprint, "facades": facades,
            "ground_floor_area_m2": design.footprint}


def envelope(design):
    return {"U_wall": design.u_wall, "U_roof": design.u_roof, "U_window": design.u_window,
            "SHGC_normal": design.g_window, "frame_fraction": 0.2,
            "U_ground_floor_with_1p2m_soil": ground_u_value(design), "construction": "heavy",
            "slab": "concrete", "slab_thickness_m": design.slab_thickness,
            "solar_absorptance_wall": design.absorptance_wall,
            "solar_absorptance_roof": design.absorptance_roof,
            "infiltration_ACH": design.infiltration}


def plant(design):
    boiler = design.heat_source == "boiler"
    return {"heating_set_C": design.heating_set, "heating_setback_C": design.heating_setback,
            "cooling_set_C": design.cooling_set, "cooling_setback_C": design.cooling_setback,
            "heating_capacity_W_m2": design.heating_capacity,
            "cooling_capacity_W_m2": design.cooling_capacity,
            "heat_source": "gas boiler" if boiler else "heat pump",
            "heating_efficiency": design.heating_efficiency if boiler else design.heating_cop,
            "cooling_COP": design.cooling_cop, "heating_available": "all year",
            "cooling_available": "all year"}


def systems(design):
    """What is declared of an air handler; {} where there is none, or nobody says so."""
    air = design.air_system
    if air is None or not air.is_declared:
        return {}
    per_area = design.volume / 3.6 / design.floor_area
    return {"systems": {"air_handler": {
        "kind": air.kind, "supply_flow_l_s_m2": air.supply * per_area,
        "least_flow_share": air.least_flow if air.kind == VAV else 1.0,
        "supply_C": {f"outdoors_{RESET[0]:g}_C": air.supply_warm,
                     f"outdoors_{RESET[1]:g}_C": air.supply_cold},
        "fan_heat_share": air.fan_heat, "economiser": air.economiser}}}


def building(recipe, name):
    design, climate = recipe.design, CLIMATES[recipe.climate]
    flow = design.fresh_air * design.volume / 3.6 / design.floor_area
    days = {use: dict(zip(("wd", "sat", "sun"), table)) for use, table in
            zip(("occ", "light", "equip", "hvac", "vent"),
                (design.schedules[u] for u in ("people", "lights", "equipment", "plant",
                                               "fresh_air")))}
    return {"case": name, "kind": "office", "geometry": geometry(design),
            "site": {"latitude": climate.latitude, "longitude": climate.longitude,
                     "utc_offset_h": climate.utc_offset_h, "elevation_m": 0,
                     "weather_train": "weather_train.epw", "weather_test": "weather_test.epw"},
            "envelope": envelope(design), "plant": plant(design), "schedules": days,
            "internal": {"people_per_m2": design.people / PERSON, "sensible_W_per_person": PERSON,
                         "lighting_W_m2": design.lights, "equipment_W_m2": design.equipment},
            "ventilation": {"flow_l_s_m2_peak": flow, "heat_recovery": 0.0,
                            "specific_fan_power_W_per_l_s": design.fan_power},
            "declared_closed_days": {"list_mm_dd": sorted({d[5:] for d in design.holidays})},
            "channels": {}, **systems(design)}


# --- weather

def epw_header(climate):
    ground = ",".join([f"{climate.t_mean:.2f}"] * 12)
    return [f"LOCATION,synthetic,-,-,-,999999,{climate.latitude},{climate.longitude},"
            f"{climate.utc_offset_h},0", "DESIGN CONDITIONS,0", "TYPICAL/EXTREME PERIODS,0",
            f"GROUND TEMPERATURES,1,2.0,,,,{ground}", "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0",
            "COMMENTS 1,synthetic", "COMMENTS 2,", "DATA PERIODS,1,1,Data,Friday, 1/ 1,12/31"]


def sky_infrared(weather):
    """From the sky, whose temperature is as far below the air's as clouds let it [W/m2]."""
    return STEFAN_BOLTZMANN * (weather.theta_e - 11 * (1 - weather.cloud) + 273.15) ** 4


def write_epw(path, weather, first, last):
    """Hours first .. last - 1: temperature and humidity at their ends, radiation as means."""
    ends = slice(STEPS_PER_HOUR - 1, None, STEPS_PER_HOUR)
    rows = zip(weather.times[::STEPS_PER_HOUR], weather.theta_e[ends],
               weather.relative_humidity[ends], hour_means(sky_infrared(weather)),
               hour_means(weather.ghi), hour_means(weather.dni), hour_means(weather.dhi),
               hour_means(weather.wind), hour_means(weather.cloud))
    with open(path, "w", encoding="ascii") as out:
        out.write("\n".join(epw_header(weather.climate)) + "\n")
        for begin, t, rh, ir, ghi, dni, dhi, wind, cloud in list(rows)[first:last]:
            year, month, day = str(begin)[:10].split("-")
            hour = int(str(begin)[11:13]) + 1
            out.write(f"{year},{int(month)},{int(day)},{hour},60,?,{t:.1f},99.9,{rh:.0f},101325,"
                      f"9999,9999,{ir:.0f},{ghi:.0f},{dni:.0f},{dhi:.0f},999999,999999,999999,"
                      f"9999,999,{wind:.1f},{10 * cloud:.0f},{10 * cloud:.0f},9999,99999,9,"
                      "999999999,999,0.999,999,99,0.200,0.0,1.0\n")


# --- readings and truth

def true_channels(recipe, built, weather, noise, effects):
    """{column: [n_hours]} of the measured days, without the meters' errors."""
    drives = make_drives(built, weather, noise, recipe.seed, recipe.first_day)
    apply_effects(drives, built, effects)
    run = simulate(built, weather, drives)
    hourly = {"air": true_air(drives, run), **true_meters(built, drives, run)}
    return {COLUMNS[name]: hourly[name][SETTLING_DAYS * 24:] for name in COLUMNS
            if name in hourly}


def write_readings(path, times, readings):
    """`timestamp` is the end of the hour; an empty cell is missing."""
    with open(path, "w", newline="", encoding="ascii") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(["timestamp", *readings])
        for time, *row in zip(times + np.timedelta64(3600, "s"), *readings.values()):
            writer.writerow([str(time), *("" if np.isnan(x) else f"{x:g}" for x in row)])


def error(column, predicted, measured):
    """RMSE of a temperature [K], CV(RMSE) of a meter [%]."""
    there = ~np.isnan(measured)
    rmse = np.sqrt(((predicted - measured)[there] ** 2).mean())
    return float(rmse if column == COLUMNS["air"] else 100 * rmse / measured[there].mean())


def numbers_of(office):
    return {name: value for name, value in asdict(office).items() if isinstance(value, float)}


def beside_sizes(recipe, built, weather):
    """What effects drew, and the structure, in cases that have such."""
    drives = make_drives(built, weather, AVERAGE_DAYS, recipe.seed, recipe.first_day)
    details, air = apply_effects(drives, built, recipe.effects), built.air_system
    return ({"details": details} if details else {}) | \
        ({"structure": {"air_handler": asdict(air)}} if air else {})


def energies_of(true):
    """Of the training year [kWh]."""
    return {column: float(series[:YEAR].sum()) for column, series in true.items() if column != COLUMNS["air"]}


def truth(recipe, built, weather, measured):
    """Errors of the held-out year: `expected_floor`, the best that any model can do, and those of
    the truth without the effects, and without each of them alone. Of the training year the meters'
    energies, and what each effect brings to them: with it less without it."""
    def without(names):
        effects = {name: size for name, size in recipe.effects.items() if name not in names}
        return true_channels(recipe, built, weather, AVERAGE_DAYS, effects)

    def floor(true):
        return {column: error(column, true[column][YEAR:], series[YEAR:])
                for column, series in measured.items()}

    whole, none = without(()), without(recipe.effects)
    one = {name: without((name,)) if len(recipe.effects) > 1 else none for name in recipe.effects}
    energies = energies_of(whole)
    floors = {"expected_floor": floor(whole), "without_effect": floor(none),
              "without_one": {name: floor(true) for name, true in one.items()},
              "of_the_year": {"kWh": energies,
                              "brings_kWh": {name: {column: energies[column] - less
                                                    for column, less in energies_of(true).items()}
                                             for name, true in one.items()}}}
    return {"effects": recipe.effects, "climate": recipe.climate, "seed": recipe.seed,
            "meaning": {name: EFFECTS[name].meaning for name in recipe.effects},
            "design": numbers_of(recipe.design), "built": numbers_of(built), **floors,
            **beside_sizes(recipe, built, weather),
            "held_out_kWh_m2": {column: float(np.nansum(series[YEAR:])) / built.floor_area
                                for column, series in measured.items()
                                if column != COLUMNS["air"]}}


def measured_of(recipe, true):
    """What sensor and meters show of it."""
    air = COLUMNS["air"]
    sensor = read_sensor(true[air], np.random.default_rng([recipe.seed, 5]))
    energies = {column: series for column, series in true.items() if column != air}
    return {air: sensor, **read_meters(energies, recipe.seed)}


def write_case(folder, recipe):
    """Writes the whole folder, truth.json last."""
    built, weather = as_built(recipe.design, recipe.seed), weather_of(recipe)
    shown = part_of(weather, SETTLING_DAYS * 24 * STEPS_PER_HOUR, len(weather.times))
    measured = measured_of(recipe, true_channels(recipe, built, weather, DayNoise(),
                                                 recipe.effects))
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "building.json").write_text(json.dumps(building(recipe, folder.name), indent=1))
    for name, readings, first in (("train", "measured", 0), ("test", "measured_test", YEAR)):
        write_epw(folder / f"weather_{name}.epw", shown, first, first + YEAR)
        hours = slice(first, first + YEAR)
        write_readings(folder / f"{readings}.csv", shown.times[::STEPS_PER_HOUR][hours],
                       {column: series[hours] for column, series in measured.items()})
    (folder / "truth.json").write_text(json.dumps(truth(recipe, built, weather, measured),
                                                  indent=1))
