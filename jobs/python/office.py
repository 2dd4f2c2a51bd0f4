#!/usr/bin/python3
"""An office from data frames: a job is made, run, and its result read, in cells of a notebook (# %%).

It takes the readings and the weather of jobs/quickstart. It writes into the working folder: office.toml with its CSV
files, office.h5, office.html, office_adopted.toml, and a folder office_csv. It runs in half a minute. The package must
be found: `pip install scripts/python`, or PYTHONPATH=scripts/python.
"""
# %% What it takes
import pathlib

import pandas as pd

import bemcal

DATA = pathlib.Path(__file__).resolve().parents[1] / "quickstart"
RANKS = 2
N_POINTS = 2048          # of the screening
MOST_EFFECTS = 3         # of the loop
pd.set_option("display.width", 120, "display.max_columns", 30)

# %% Readings and weather, as a data base gives them: by UTC. They are of China, which is 8 h ahead.
readings = pd.read_csv(DATA / "measured_2021_2022.csv", index_col="time", parse_dates=True)
readings = readings.tz_localize("Asia/Shanghai").tz_convert("UTC")
weather = pd.read_csv(DATA / "weather_2021_2022.csv", index_col="time", parse_dates=True).tz_localize("Asia/Shanghai")
print(readings.describe().round(1))

# %% The building: sections and keys of `bemcal-batch describe job`. A schedule has a value for each hour of the day.
WORK = [0] * 7 + [0.1, 0.6, 1, 1, 1, 0.7, 0.7, 1, 1, 1, 1, 0.25, 0.25] + [0] * 4
PLANT = [0] * 7 + [1] * 12 + [0] * 5
SIDES = {180: (473.3, 342.7), 270: (229.5, 76.5), 0: (473.3, 342.7), 90: (229.5, 76.5)}    # azimuth: wall, window [m2]
surfaces = [{"construction": "wall", "area": wall, "azimuth": azimuth} for azimuth, (wall, _) in SIDES.items()]
surfaces += [{"construction": "roof", "area": 864, "azimuth": 0, "tilt": 0},
             {"construction": "ground_floor", "area": 864, "boundary": "deep_soil"}]

job = bemcal.Job({
    "seed": 1,
    "periods": {"training": ["2021-01-01", "2021-12-31"], "held_out": ["2022-01-01", "2022-12-31"]},
    "schedule": [{"name": "work", "weekdays": WORK, "weekend": 0}, {"name": "plant", "weekdays": PLANT, "weekend": 0}],
    "construction": [{"name": "wall", "u_value": 1.5}, {"name": "roof", "u_value": 0.9},
                     {"name": "ground_floor", "u_value": 0.55}],
    "glazing": [{"name": "window", "u_value": 5.2, "solar_transmittance": 0.52}],
    "boundary": [{"name": "deep_soil", "temperature": 20.4}],
    "zone": [{
        "name": "office", "floor_area": 4320, "volume": 14688, "class": "heavy", "proportional_band": 0.8,
        "heating_set_point": {"value": 20.5, "low": 17, "schedule": "plant"},
        "cooling_set_point": {"value": 25, "low": 29, "schedule": "plant"},
        "heating_capacity": 45, "cooling_capacity": 130, "air_capacity": 12000,
        "surface": surfaces,
        "window": [{"glazing": "window", "area": window, "azimuth": azimuth}
                   for azimuth, (_, window) in SIDES.items()],
        "flow": [{"name": "infiltration", "air_change": 0.45},
                 {"name": "fresh_air", "air_change": {"value": 1.1, "schedule": "plant"}}],
        "load": [{"name": "people", "density": {"value": 8, "schedule": "work"}},
                 {"name": "lights", "density": {"value": 9, "low": 0.5, "schedule": "plant"}, "carrier": "electricity"},
                 {"name": "equipment", "density": {"value": 11, "low": 2, "schedule": "work"},
                  "carrier": "electricity"},
                 {"name": "fans", "density": {"value": 1.9, "schedule": "plant"}, "heat_fraction": 0,
                  "carrier": "electricity"}],
    }],
    "plant": {"heating_carrier": "electricity", "heating_efficiency": 3.0, "cooling_carrier": "electricity",
              "cooling_cop": 3.6},
})

# %% Weather and meters: the stamps keep their offset, and the program finds local standard time by it.
job.weather(weather, latitude=24.8, longitude=113.6, columns={
    "outdoor_temperature": "T_out_C", "direct_normal": "DNI_Wm2", "diffuse_horizontal": "DHI_Wm2",
    "wind_speed": "wind_ms", "relative_humidity": "RH_pct"})
job.meter("cooling", readings["cooling_kWh"], unit="kWh")
job.meter("electricity", readings["electricity_kWh"], unit="kWh", tariff=0.22)

# %% What is uncertain, and what is asked
UNCERTAIN = {
    "infiltration": ("zone.office.flow.infiltration.air_change", 0.2, 0.8),
    "lights": ("zone.office.load.lights.density", 7, 11),
    "equipment": ("zone.office.load.equipment.density", 8, 14),
    "base_load": ("zone.office.load.equipment.density.low", 0, 5),
    "cooling_set_point": ("zone.office.cooling_set_point", 23.5, 26.5),
    "cooling_COP": ("plant.cooling_cop", 2.8, 4.6),
    "g_window": ("glazing.window.solar_transmittance", 0.35, 0.65),
}
for name, (target, least, most) in UNCERTAIN.items():
    prior = {"kind": "normal", "mean": (least + most) / 2, "sd": (most - least) / 4}
    job.add("parameter", name=name, target=target, min=least, max=most, prior=prior)
job.add("study", kind="screening", n_points=N_POINTS)
job.add("study", kind="loop", most_effects=MOST_EFFECTS)

# %% Save, check, run. What is wrong with the job is a bemcal.Error with file, line and what to write instead.
path = job.save("office.toml", force=True)
print(bemcal.check(path))
result = bemcal.run(path, ranks=RANKS, force=True)
print(result)

# %% The best points of the screening, by parameter
screening = result["screening"]
print(screening["best_parameters"].to_pandas().head(3).round(2))
print(screening["best_score"].to_pandas().head(3))

# %% What the office does that its description does not mention, and what it brings
print(result.effects[["coefficient", "least", "most", "unit", "follows", "adequate"]])
print(result.effects.filter(like="brings").round(0))

# %% Errors of the calibrated standard, before and after the effects, in the year that was held out [%]
errors = result.errors.xs("cv_rmse", level="metric").loc["held_out"]
print((100 * errors).round(1))

# %% Hour by hour, with the 90 % interval of "after"
hours = result.hours("cooling", "held_out")
print(hours.loc["2022-07-04 06:00":"2022-07-04 20:00"].round(1))
inside = hours["measured"].between(hours["predicted_q05"], hours["predicted_q95"])[hours["measured"].notna()]
print(f"{inside.mean():.0%} of the readings lie inside")

# %% The job anew with what was found: every kind of study has these effects then, a retrofit too
adopted = bemcal.adopt(result, path, "office_adopted.toml", keep_priors=True, force=True)
print([effect["name"] for effect in adopted.get("effect", [])])

# %% The same with pictures, and everything as CSV files
print(result.page("office.html", force=True))
print(len(result.to_csv("office_csv", force=True)), "files in office_csv")
