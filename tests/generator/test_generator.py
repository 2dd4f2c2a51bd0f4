"""The generator itself: its balance closes, effects change what they should, seeds decide."""
import copy
import json
import pathlib
import sys
import tempfile
import tomllib
import unittest

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "scripts")]

import case_folder
import construction
import designs
import house
import meters
import office as office_model
import school
import simulate as finer
import sun
from case import Recipe
from cases import loop_job
from drives import AVERAGE_DAYS, DayNoise, make_drives
from effect import rng_of
from effects import EFFECTS, INSIDE, OUTSIDE, apply_effects
from office import Office, as_built
from quickstart import RECIPE, days_of
from weather import CLIMATES, STEP_S, STEPS_PER_HOUR, synthetic_weather

FIRST = "2021-11-01"
SUMMER = "2021-06-28"   # a Monday
WINTER = "2021-01-04"
A_YEAR_BEFORE = {SUMMER: "2020-06-28", WINTER: "2020-01-04", FIRST: "2020-11-01"}
BOILER = Office(heat_source="boiler")
DAYS = 14


def run(first=FIRST, effects=None, seed=5, noise=AVERAGE_DAYS, design=Office(), since=None):
    """Drives, trajectory and true meters of a fortnight, `since` when it is measured."""
    weather = synthetic_weather("hot_humid", first, DAYS, seed)
    drives = make_drives(design, weather, noise, seed, since or first)
    apply_effects(drives, design, effects or {})
    trajectory = finer.simulate(design, weather, drives)
    return drives, trajectory, meters.true_meters(design, drives, trajectory)


class Weather(unittest.TestCase):
    def test_sun_stands_at_the_colatitude_at_noon_of_the_equinox(self):
        noon = np.array(["2021-03-20T12:08"], "datetime64[s]")   # equation of time: -7.5 min
        altitude, azimuth = sun.sun_angles(noon, 50.0, 15.0, 1)
        self.assertAlmostEqual(np.degrees(altitude[0]), 40.0, delta=0.5)  # Spencer's error
        self.assertAlmostEqual(np.degrees(azimuth[0]), 180.0, delta=1.0)

    def test_global_irradiance_is_beam_plus_diffuse(self):
        w = synthetic_weather("hot_humid", FIRST, DAYS, 1)
        high = w.altitude > np.radians(4)
        np.testing.assert_allclose(w.ghi[high], (w.dni * np.sin(w.altitude) + w.dhi)[high])

    def test_horizontal_plane_sees_the_global_irradiance(self):
        w = synthetic_weather("hot_humid", FIRST, DAYS, 1)
        beam, diffuse, _ = sun.plane_irradiance(w, 0.0, 0.0)
        high = w.altitude > np.radians(6)
        np.testing.assert_allclose((beam + diffuse)[high], w.ghi[high])

    def test_a_seed_makes_one_weather(self):
        first, again, other = (synthetic_weather("hot_humid", FIRST, DAYS, s).theta_e
                               for s in (1, 1, 2))
        np.testing.assert_array_equal(first, again)
        self.assertGreater(np.abs(first - other).max(), 1)


class Network(unittest.TestCase):
    def test_layers_have_the_u_value(self):
        layers = office_model.insulated(0.5, [("brick", 0.2), ("plaster", 0.02)], 1)
        r = sum(d / construction.MATERIALS[m][0] for m, d in layers)
        self.assertAlmostEqual(1 / (r + 0.05 + 0.13), 0.5)

    def test_without_sources_every_temperature_settles_at_the_surroundings(self):
        design = Office()
        net = construction.make_network(office_model.opaque_elements(design),
                                        office_model.windows(design))
        held = 20 * (net.air + net.outdoor + net.sky + net.ground)
        np.testing.assert_allclose(np.linalg.solve(net.conduction, held), 20)

    def test_finer_than_five_nodes(self):
        design = Office()
        net = construction.make_network(office_model.opaque_elements(design),
                                        office_model.windows(design))
        self.assertGreater((net.capacity > 0).sum(), 30)


class Balance(unittest.TestCase):
    def test_heat_in_equals_heat_stored(self):
        for first in (FIRST, SUMMER):
            drives, out, _ = run(first, {"heat_island": 1.0, "night_ventilation": 2.0})
            air = finer.AIR_MULTIPLIER * construction.RHO_C_AIR * Office().volume
            stored = out.stored + air * out.theta_air
            gain = (out.surface_gain + out.air_conductance * (drives.theta_e - out.theta_air)
                    + out.convective + out.emitted_heating - out.emitted_cooling)
            np.testing.assert_allclose(np.diff(stored), STEP_S * gain[1:],
                                       atol=1e-9 * np.abs(stored).max())

    def test_heat_in_equals_heat_stored_with_a_neighbour_and_while_insulation_is_added(self):
        drives, *_ = run(FIRST)
        days = int(365 * rng_of(drives).uniform(0.3, 0.7)) - DAYS // 2
        drives, out, _ = run(FIRST, {"neighbour": 0.2, "retrofit": 0.3},
                             since=np.datetime64(FIRST) - days)
        self.assertGreater(drives.envelope_from, 0)
        stored = (out.stored + finer.AIR_MULTIPLIER * construction.RHO_C_AIR * Office().volume
                  * out.theta_air)
        gain = (out.surface_gain + out.air_conductance * (drives.theta_e - out.theta_air)
                + drives.neighbour * (drives.theta_neighbour - out.theta_air)
                + out.convective + out.emitted_heating - out.emitted_cooling)
        np.testing.assert_allclose(np.diff(stored), STEP_S * gain[1:],
                                   atol=1e-9 * np.abs(stored).max())

    def test_the_emitters_give_what_the_plant_delivers(self):
        _, out, _ = run(SUMMER)
        kept = finer.TAU_COOLING * out.emitted_cooling[-1]
        self.assertAlmostEqual(out.asked_cooling.sum() * STEP_S
                               / (out.emitted_cooling.sum() * STEP_S + kept), 1, places=9)

    def test_the_room_is_held_at_the_set_points_at_noon(self):
        drives, out, _ = run(SUMMER)
        noon = drives.open_day & (drives.hour == 12)
        above = out.theta_air[noon] - Office().cooling_set
        self.assertLess(np.abs(above).max(), finer.BAND)


class Effects(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.plain = {first: run(first, since=A_YEAR_BEFORE[first], design=BOILER)[2]
                     for first in (SUMMER, WINTER)}
        cls.summer = run(SUMMER)[2]

    def test_there_is_none_by_default(self):
        self.assertEqual(run.__defaults__[1], None)
        self.assertEqual(type(RECIPE)("hot_humid", FIRST, 1, 1, Office()).effects, {})

    def test_each_changes_the_drives_of_a_year_in_some_climate(self):
        changed = {climate: self.changed_drives(climate) for climate in CLIMATES}
        for name in EFFECTS:
            self.assertTrue(any(names[name] for names in changed.values()), name)

    def changed_drives(self, climate):
        """{effect: fields of the drives that it changes}"""
        weather = synthetic_weather(climate, "2021-01-01", 365, 5)
        plain = make_drives(BOILER, weather, AVERAGE_DAYS, 5, "2021-01-01")
        changed = {}
        for name in EFFECTS:
            drives = copy.deepcopy(plain)
            apply_effects(drives, BOILER, {name: None})
            changed[name] = [field for field, value in vars(plain).items()
                             if not np.array_equal(value, getattr(drives, field))]
        return changed

    def test_sizes_are_drawn_from_the_plausible_range(self):
        rng = np.random.default_rng(1)
        for name, effect in EFFECTS.items():
            sizes = [effect.draw(rng) for _ in range(20)]
            self.assertTrue(all(effect.least <= abs(size) <= effect.most for size in sizes), name)
            self.assertTrue(effect.least <= effect.size <= effect.most, name)
            self.assertEqual(min(sizes) < 0, effect.either_sign, name)

    def test_some_are_of_kinds_that_no_catalogue_has(self):
        self.assertEqual(set(INSIDE) & set(OUTSIDE), set())
        self.assertGreaterEqual(len(OUTSIDE), 6)

    def test_degraded_cop_changes_electricity_only(self):
        now = run(SUMMER, {"degraded_cop": None})[2]
        np.testing.assert_array_equal(now["cooling"], self.summer["cooling"])
        self.assertGreater(now["electricity"].sum(), self.summer["electricity"].sum())

    def test_saturday_operation_shows_on_saturday_first(self):
        now = run(SUMMER, {"saturday_operation": 5.0})[2]
        np.testing.assert_array_equal(now["cooling"][:5 * 24], self.summer["cooling"][:5 * 24])
        saturday = slice(5 * 24 + 7, 5 * 24 + 12)
        self.assertGreater(now["cooling"][saturday].sum(), 0)
        self.assertEqual(self.summer["cooling"][saturday].sum(), 0)

    def test_signs(self):
        more = {"exhaust_fan": (WINTER, "heating", 1), "server_heat": (SUMMER, "cooling", 1),
                "heat_island": (SUMMER, "cooling", 1), "blinds": (SUMMER, "cooling", -1),
                "wind_infiltration": (WINTER, "heating", 1),
                "stack_infiltration": (WINTER, "heating", 1),
                "latent_load": (SUMMER, "cooling", 1), "roof_sun": (SUMMER, "cooling", 1),
                "night_ventilation": (SUMMER, "cooling", -1), "sky_loss": (WINTER, "heating", 1),
                "heat_recovery": (WINTER, "heating", -1), "retrofit": (WINTER, "heating", -1),
                "thermal_bridge": (WINTER, "heating", 1), "early_start": (WINTER, "heating", 1),
                "reheat": (SUMMER, "heating", 1), "cop_temperature": (SUMMER, "electricity", 1),
                "demand_response": (SUMMER, "cooling", -1), "gas_step": (WINTER, "gas", 1),
                "part_load": (WINTER, "gas", 1), "standing_losses": (SUMMER, "gas", 1),
                "hot_water": (SUMMER, "gas", 1), "degraded_boiler": (WINTER, "gas", 1),
                "frozen_valve": (WINTER, "heating", 0), "snow": (SUMMER, "cooling", 0),
                "heat_and_power": (WINTER, "electricity", -1)}
        for name, (first, meter, sign) in more.items():
            now = run(first, {name: None}, since=A_YEAR_BEFORE[first], design=BOILER)[2]
            change = now[meter].sum() - self.plain[first][meter].sum()
            self.assertEqual(np.sign(change), sign, name)

    def test_a_late_clock_moves_the_record(self):
        now = run(SUMMER, {"meter_late": 1.0})[2]
        np.testing.assert_array_equal(now["cooling"][1:], self.summer["cooling"][:-1])

    def test_shifted_schedules_come_later(self):
        plain, now = run(SUMMER)[0], run(SUMMER, {"schedule_shift": 0.5})[0]
        steps = STEPS_PER_HOUR // 2
        np.testing.assert_array_equal(now.people[steps:], plain.people[:-steps])


class Meters(unittest.TestCase):
    def test_noise_has_the_stated_size(self):
        noise = meters.MeterNoise(gap_share=0.0)
        shown = meters.read_meter(np.full(8760, 1000.0), noise, np.random.default_rng(1))
        expected = 1000 * np.sqrt(0.02 ** 2 + 0.025 ** 2 + 0.008 ** 2)
        self.assertAlmostEqual(shown.std(), expected, delta=0.1 * expected)
        np.testing.assert_array_equal(shown, np.round(shown))

    def test_a_sensor_has_the_stated_noise_and_steps(self):
        shown = meters.read_sensor(np.full(8760, 21.03), np.random.default_rng(1))
        there = shown[~np.isnan(shown)]
        self.assertAlmostEqual(there.std(), np.hypot(0.08, 0.12), delta=0.02)
        np.testing.assert_allclose(there, np.round(there, 1))

    def test_only_a_boiler_burns_gas(self):
        self.assertEqual(set(self.names(Office())), {"electricity", "cooling", "heating"})
        self.assertEqual(set(self.names(BOILER)), {"electricity", "cooling", "heating", "gas"})

    def names(self, design):
        return run(SUMMER, design=design)[2]

    def test_gaps_have_the_stated_share(self):
        shown = meters.read_meter(np.full(8760, 50.0), meters.MeterNoise(),
                                  np.random.default_rng(2))
        self.assertAlmostEqual(np.isnan(shown).mean(), 0.008, delta=0.004)

    def test_a_seed_makes_one_building_and_one_record(self):
        self.assertEqual(as_built(Office(), 3), as_built(Office(), 3))
        self.assertNotEqual(as_built(Office(), 3), as_built(Office(), 4))
        first, again, other = (run(seed=s, noise=DayNoise())[2]["electricity"] for s in (1, 1, 2))
        np.testing.assert_array_equal(first, again)
        self.assertGreater(np.abs(first - other).max(), 0)

    def test_holidays_are_days_off(self):
        self.assertIn("2021-10-03", days_of(("2021-10-01/2021-10-07",)))
        design = Office(holidays=("2021-06-29",))
        _, _, metered = run(SUMMER, design=design)
        self.assertEqual(metered["cooling"][24:48].sum(), 0)
        self.assertGreater(metered["cooling"][48:72].sum(), 0)


class House(unittest.TestCase):
    """A winter week of paper 3's house."""
    TRUTH = {"lighting": 5.0, "appliances": 6.0, "set_point_lounge": 17.0, "set_point_rooms": 16.0,
             "air_change": 3.0}

    @classmethod
    def setUpClass(cls):
        cls.weather = synthetic_weather("cool_maritime", WINTER, 7, 1)

    def week(self, fuel, **changed):
        """kWh of both zones."""
        return sum(house.energies(zone, self.weather, AVERAGE_DAYS, 1)[fuel].sum()
                   for zone in house.zones_of(self.TRUTH | changed, {}))

    def test_lights_appliances_and_pumps_make_the_electricity(self):
        daily = sum(self.TRUTH[name] * sum(hours) for name, hours in
                    (("lighting", house.LIT), ("appliances", house.USED)))
        pumps = self.week("electricity") - 84 * 7 * daily / 1000
        heat = sum(house.energies(zone, self.weather, AVERAGE_DAYS, 1)["heating"].sum()
                   for zone in house.zones_of(self.TRUTH, {}))
        self.assertAlmostEqual(pumps / heat, meters.PUMP_SHARE, places=6)

    def test_gas_rises_with_set_points_and_air_and_falls_with_gains(self):
        plain = self.week("gas")
        for name, change in (("set_point_lounge", 1), ("set_point_rooms", 1), ("air_change", 1),
                             ("lighting", -1), ("appliances", -1)):
            more = self.week("gas", **{name: self.TRUTH[name] + change})
            self.assertGreater(more, plain, name)

    def test_a_seed_draws_one_house_within_the_first_grid(self):
        (first, _), (again, _), (other, _) = (house.drawn_house(s) for s in (1, 1, 2))
        self.assertEqual(first, again)
        for name, (least, most) in house.RANGES.items():
            self.assertTrue(least < first[name] < most, name)
            self.assertNotEqual(first[name], other[name])

    def test_the_bill_is_of_the_days_after_the_settling_ones(self):
        weather = synthetic_weather("cool_maritime", WINTER, house.SETTLING_DAYS + 1, 1)
        zones = house.zones_of(self.TRUTH, {})
        last = [house.energies(zone, weather, AVERAGE_DAYS, 2 + k)["gas"][-24:].sum()
                for k, zone in enumerate(zones)]
        self.assertEqual(house.bill_of(zones, weather, 1, AVERAGE_DAYS)["gas"], round(sum(last)))


class School(unittest.TestCase):
    TRUTH = {"exponent": 1.3, "nominal_power": 2000.0, "radiator_capacity": 1e5,
             "maximum_flow": 0.04}

    def test_radiator_gives_its_nominal_power_at_sixty_kelvin(self):
        radiator = school.RadiatorRow({**self.TRUTH, "maximum_flow": 0.4,
                                       "radiator_capacity": 2e6}, 80.0)
        for _ in range(50):
            heat = radiator.step(80.0, 20.0)
        self.assertAlmostEqual(heat, 2000.0, delta=30)   # the water cools by 1.2 K

    def test_radiator_gives_the_heat_that_it_had_stored(self):
        radiator = school.RadiatorRow(self.TRUTH, 60.0)
        given = sum(radiator.step(None, 20.0) for _ in range(400)) * STEP_S
        left = sum(theta - 20.0 for theta in radiator.elements) / school.ELEMENTS
        self.assertAlmostEqual(given, 1e5 * (40.0 - left), delta=1.0)

    def test_supply_follows_the_curve_the_schedule_and_the_set_back(self):
        truth = {"a": -1.0, "b": 50.0, "c": 42.0, "d": 22.0}
        supply = lambda *state: school.supply_of(truth, *state)
        self.assertEqual(supply(True, True, 5.0, 20.0), 45.0)
        self.assertEqual(supply(True, True, 12.0, 20.0), 42.0)
        self.assertEqual(supply(False, True, 5.0, 13.9), 22.0)
        self.assertIsNone(supply(False, True, 5.0, 14.1))
        self.assertIsNone(supply(False, False, 5.0, 13.9))

    def test_shipped_truth_is_that_of_the_first_seed(self):
        shipped = json.loads((HERE.parents[1] / "jobs/paper2_school/truth.json").read_text())
        drawn = school.drawn_school(shipped["seed"]).truth
        for name, value in drawn.items():
            self.assertAlmostEqual(shipped[name] / value, 1.0, delta=1e-3)

    def test_heat_to_the_walls_reaches_the_air(self):
        room = school.drawn_school(1)
        network = construction.make_network(room.elements, room.windows)
        zone = finer.Zone(network, 1e6, 20.0)
        zone.on_star = zone.solved[:, network.star]
        held = 20.0 * (zone.solved @ (network.outdoor + network.sky + network.ground))
        for _ in range(3):   # all at 20 degC: nothing moves without heat
            school.heat_step(zone, 0.0, 0.3, (held, held @ zone.air, 0.0), (50.0, 20.0), (9.0, 20.0))
        self.assertAlmostEqual(zone.theta_air, 20.0, places=6)
        school.heat_step(zone, 1000.0, 1.0, (held, held @ zone.air, 0.0), (50.0, 20.0), (9.0, 20.0))
        self.assertGreater(zone.theta_air, 20.001)


class Folder(unittest.TestCase):
    def test_a_seed_draws_one_design_within_its_ranges(self):
        first, again, other = (designs.drawn_design(np.random.default_rng(s)) for s in (1, 1, 2))
        self.assertEqual(first, again)
        self.assertNotEqual(first, other)
        for name, (least, most) in designs.RANGES.items():
            self.assertTrue(least <= getattr(first[1], name) <= most, name)

    def test_drawn_effects_fit_the_design(self):
        heat_pump = Office()
        drawn = designs.drawn_effects(np.random.default_rng(1), heat_pump, INSIDE, 30)
        self.assertEqual(len(drawn), 30)
        self.assertTrue(all(INSIDE[name].fits(heat_pump) for name in drawn))
        self.assertFalse(INSIDE["gas_step"].fits(heat_pump))

    def test_description_and_weather_become_a_job(self):
        recipe = Recipe("continental", "2021-01-01", 730, 1, Office(heat_source="boiler"))
        weather = synthetic_weather("continental", "2021-01-01", 2, 1)
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            (folder / "building.json").write_text(json.dumps(
                case_folder.building(recipe, "office")))
            for k, name in enumerate(("train", "test")):
                case_folder.write_epw(folder / f"weather_{name}.epw", weather, 24 * k, 24 * k + 24)
            case_folder.write_readings(
                folder / "measured.csv", weather.times[::STEPS_PER_HOUR][:24],
                {"heat_kWh": np.arange(24.0), "gas_kWh": np.full(24, np.nan)})
            job, _ = loop_job.write_job([folder], folder / "job")
            text = next(pathlib.Path(job).parent.glob(f"{folder.name}.toml")).read_text()
            readings = (folder / "measured.csv").read_text().splitlines()
            epw = (folder / "weather_test.epw").read_text().splitlines()
        building = tomllib.loads(text)
        self.assertEqual(building["periods"]["held_out"], ["2021-01-02", "2021-01-02"])
        self.assertEqual(building["plant"]["heating_carrier"], "gas")
        self.assertEqual(readings[1], "2021-01-01T01:00:00,0,")
        self.assertEqual(len(epw), 8 + 24)
        self.assertEqual(epw[8].split(",")[:5], ["2021", "1", "2", "1", "60"])

    def test_the_floor_with_soil_conducts_as_the_network_does(self):
        net = construction.make_network([e for e in office_model.opaque_elements(Office())
                                         if e.ground], [])
        held = 1.0 * net.air   # air and star at 1 K, ground at 0
        x = np.linalg.solve(net.conduction, held)
        flow = (net.ground * x).sum() / Office().footprint
        self.assertAlmostEqual(flow, 1 / (1 / case_folder.ground_u_value(Office())
                                          + 1 / 1.5 - 1 / (1.5 + 5.1)), delta=0.01)


if __name__ == "__main__":
    unittest.main()
