#!/usr/bin/python3
"""scripts/case_to_job writes what a case declares, and the same parameters for every case."""
import copy
import json
import pathlib
import subprocess
import tempfile
import tomllib
import unittest

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "case_to_job"
DAY = {"wd": [0] * 8 + [1] * 10 + [0] * 6, "sat": [0] * 24, "sun": [0] * 24}
OFFICE = {
    "case": "an_office",
    "site": {"latitude": 23.1, "longitude": 113.3, "utc_offset_h": 8, "elevation_m": 21,
             "weather_train": "weather_train.epw", "weather_test": "weather_test.epw"},
    "geometry": {"gross_floor_area_m2": 1000, "air_volume_m3": 3600, "roof_area_exposed_m2": 500,
                 "ground_floor_area_m2": 500, "facades": [
                     {"id": 0, "azimuth_deg_from_north": 180, "area_m2": 200,
                      "window_to_wall": 0.25, "adiabatic": False},
                     {"id": 1, "azimuth_deg_from_north": 90, "area_m2": 100,
                      "window_to_wall": 0.5, "adiabatic": True}]},
    "envelope": {"U_wall": 1, "U_roof": 0.7, "U_window": 3, "SHGC_normal": 0.5,
                 "frame_fraction": 0.2, "U_ground_floor_with_1p2m_soil": 0.5,
                 "construction": "medium", "slab": "concrete", "slab_thickness_m": 0.15,
                 "solar_absorptance_wall": 0.5, "solar_absorptance_roof": 0.7,
                 "infiltration_ACH": 0.5},
    "internal": {"people_per_m2": 0.1, "sensible_W_per_person": 75, "lighting_W_m2": 8,
                 "equipment_W_m2": 10},
    "ventilation": {"flow_l_s_m2_peak": 1, "heat_recovery": 0,
                    "specific_fan_power_W_per_l_s": 1.5},
    "plant": {"heating_set_C": 21, "heating_setback_C": 15, "cooling_set_C": 25,
              "cooling_setback_C": "off", "heating_capacity_W_m2": 40,
              "cooling_capacity_W_m2": 60, "heat_source": "gas boiler",
              "heating_efficiency": 0.9, "cooling_COP": 4, "heating_available": "all year",
              "cooling_available": "all year"},
    "schedules": {name: DAY for name in ("occ", "equip", "light", "hvac", "vent")},
    "declared_closed_days": {"list_mm_dd": ["01-01/01-03"]},
    "channels": {"T_air_C": {}, "heat_kWh": {}, "cool_kWh": {}},
}


def epw(year):
    row = f"{year},{{}},{{}},1,60,?,20" + ",0" * 28 + "\n"
    return "header\n" * 8 + row.format(1, 1) + row.format(12, 31)


def readings(year, heat):
    """First and last hour of a year, stamped at their ends."""
    return f"timestamp,heat_kWh,cool_kWh\n{year}-01-01T01:00:00,{heat},2\n" \
           f"{year + 1}-01-01T00:00:00,{heat},3\n"


class CaseToJob(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.case = copy.deepcopy(OFFICE)
        self.files = {"weather_train.epw": epw(2017), "weather_test.epw": epw(2018)}

    def run_script(self, *arguments):
        place = self.folder / "case"
        place.mkdir(exist_ok=True)
        for name, text in {**self.files, "building.json": json.dumps(self.case)}.items():
            (place / name).write_text(text)
        return subprocess.run([PROGRAM, place, *arguments], capture_output=True, text=True)

    def job(self):
        self.files.setdefault("measured.csv", readings(2017, 5))
        done = self.run_script(self.folder / "job")
        self.assertEqual(done.returncode, 0, done.stderr)
        return tomllib.loads((self.folder / "job" / "job.toml").read_text())

    def building(self):
        file = self.folder / "jobs" / "office.toml"
        done = self.run_script(file, "--building")
        self.assertEqual(done.returncode, 0, done.stderr)
        return tomllib.loads(file.read_text())

    def meter(self, job, name):
        return next(meter for meter in job["meter"] if meter["name"] == name)

    def test_declared_numbers_stand_in_the_zone(self):
        self.case["site"]["elevation_m"] = 0
        zone = self.job()["zone"][0]
        self.assertEqual(zone["cooling_set_point"], 25)
        self.assertEqual(zone["cooling_available"]["schedule"], "hvac")
        self.assertEqual(zone["heating_set_point"], {"value": 21, "low": 15, "schedule": "hvac"})
        ventilation = next(flow for flow in zone["flow"] if flow["name"] == "ventilation")
        self.assertAlmostEqual(ventilation["air_change"]["value"], 1)  # 1 l/(s m2), 3.6 m3/m2
        people = next(load for load in zone["load"] if load["name"] == "people")
        self.assertAlmostEqual(people["density"]["value"], 7.5)

    def test_reheat_is_an_air_system_in_place_of_a_fan(self):
        self.assertLessEqual(self.job().keys() & {"air_system", "structure"}, set())
        self.case["plant"]["heat_source"] = "electric reheat"
        (self.folder / "job" / "job.toml").unlink()
        job = self.job()
        unit, = job["air_system"]
        self.assertEqual(job["structure"], ["one unit for all"])
        self.assertEqual((unit["flow"], unit["volume"]), ("ventilation", "variable"))
        self.assertAlmostEqual(unit["design_flow"], 0.7 * 60 / 11 / 1200 * 3600, places=3)
        # The room gets three tenths of it, cold; 1 l/(s m2) of the supply air is from outdoors.
        thin = (1 - 2.25577e-5 * self.case["site"]["elevation_m"]) ** 5.2559
        self.assertAlmostEqual(unit["outdoor_air_change"]["value"], thin, places=5)
        least = next(flow for flow in job["zone"][0]["flow"] if flow["name"] == "ventilation")
        self.assertEqual(least["supply"], "supply")
        self.assertAlmostEqual(least["air_change"]["value"], 0.3 * unit["design_flow"] / 3.6, places=3)
        # At four tenths of its flow the fan draws what is declared, 1.5 W/m2.
        full = unit["fan_power"] * unit["design_flow"] / 3.6
        self.assertAlmostEqual(full * 0.4 ** unit["fan_exponent"], 1.5, places=3)
        self.assertNotIn("fans", {load["name"] for load in job["zone"][0]["load"]})
        names = {parameter["name"] for parameter in job["parameter"]}
        self.assertLessEqual({"supply_flow", "least_flow", "bypass_factor"}, names)
        self.assertNotIn("fans", names)
        self.assertNotIn("heating_cop", names)  # wires turn all into heat
        self.case["plant"].update(heat_source="air heat pump", heating_COP=3)
        (self.folder / "job" / "job.toml").unlink()
        self.assertIn("heating_cop", {parameter["name"] for parameter in self.job()["parameter"]})

    def test_air_is_thinner_on_a_mountain(self):
        self.case["site"]["elevation_m"] = 1500
        flows = {flow["name"]: flow["air_change"] for flow in self.job()["zone"][0]["flow"]}
        # 84.56 kPa at 1500 m, ASHRAE Fundamentals 2021, chapter 1, table 1.
        self.assertAlmostEqual(flows["infiltration"], 0.5 * 84.56 / 101.325, places=4)
        self.assertAlmostEqual(flows["ventilation"]["value"], 84.56 / 101.325, places=4)

    def test_the_fan_of_a_furnace_runs_with_the_plant_and_heats_the_room(self):
        def fans():
            load, = (each for each in self.job()["zone"][0]["load"] if each["name"] == "fans")
            return load["density"], load["heat_fraction"]
        self.assertEqual(fans(), ({"value": 1.5, "schedule": "vent"}, 0))
        self.case["plant"]["heat_source"] = "gas furnace"
        (self.folder / "job" / "job.toml").unlink()
        self.assertEqual(fans(), ({"value": 1.5, "schedule": "hvac"}, 1))

    def test_adiabatic_facades_are_left_out(self):
        zone = self.job()["zone"][0]
        self.assertEqual([window["area"] for window in zone["window"]], [50])

    def test_slabs_count_to_a_depth_of_a_tenth_of_a_metre_from_both_faces(self):
        self.assertEqual(self.job()["zone"][0]["heat_capacity"], 0.15 * 2.3e6)
        self.case["envelope"]["slab_thickness_m"] = 0.3
        self.assertEqual(self.building()["zone"][0]["heat_capacity"], 0.2 * 2.3e6)
        self.case["envelope"]["slab"] = "timber"
        (self.folder / "jobs" / "office.toml").unlink()
        self.assertNotIn("heat_capacity", self.building()["zone"][0])

    def test_readings_kept_for_judging_are_a_period_of_their_own(self):
        self.assertNotIn("held_out", self.job()["periods"])
        self.files["measured_test.csv"] = readings(2018, 5)
        (self.folder / "job" / "job.toml").unlink()
        job = self.job()
        self.assertEqual(job["periods"]["held_out"], ["2018-01-01", "2018-12-31"])
        self.assertEqual([pathlib.Path(file).name for file in self.meter(job, "cold")["file"]],
                         ["measured.csv", "measured_test.csv"])

    def test_heat_of_few_hours_is_read_by_month(self):
        self.assertNotIn("interval", self.meter(self.job(), "heat"))
        self.files["measured.csv"] = readings(2017, 0)
        (self.folder / "job" / "job.toml").unlink()
        self.assertEqual(self.meter(self.job(), "heat")["interval"], "monthly")

    def test_parameters_are_relative_and_have_the_same_names(self):
        with_cooling = self.job()["parameter"]
        for parameter in with_cooling:
            if parameter["mode"] == "factor":
                self.assertTrue(parameter["min"] < 1 < parameter["max"], parameter)
        self.case["plant"]["cooling_available"] = "none"
        (self.folder / "job" / "job.toml").unlink()
        names = [{p["name"] for p in part} for part in (with_cooling, self.job()["parameter"])]
        self.assertEqual(names[0] - names[1], {"cooling_set_point", "cooling_cop", "cooling_capacity"})

    def test_a_building_of_a_job_leaves_the_shared_sections_to_the_job(self):
        self.files["measured.csv"] = readings(2017, 0)
        building = self.building()
        for section in ("parameter", "periods", "study", "seed"):
            self.assertNotIn(section, building)
        self.assertEqual(building["weather"]["files"][0], "../case/weather_train.epw")
        self.assertNotIn("interval", self.meter(building, "heat"))
        self.assertEqual(building["holidays"], ["01-01/01-03"])

    def test_a_building_without_readings_is_predicted_only(self):
        for name in ("heat", "cold"):
            self.assertNotIn("file", self.meter(self.building(), name))
            (self.folder / "jobs" / "office.toml").unlink()
        done = self.run_script(self.folder / "job")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("has no measured.csv", done.stderr)

    def test_nothing_is_overwritten(self):
        self.building()
        self.assertNotEqual(self.run_script(self.folder / "jobs" / "office.toml",
                                            "--building").returncode, 0)


if __name__ == "__main__":
    unittest.main()
