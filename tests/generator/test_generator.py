"""The generator itself: its balance closes, effects change what they should, seeds decide."""
import pathlib
import sys
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import construction
import meters
import office as office_model
import simulate as finer
import sun
from drives import AVERAGE_DAYS, DayNoise, make_drives
from effects import EFFECTS, apply_effects
from office import Office, as_built
from quickstart import RECIPE, days_of
from weather import STEP_S, STEPS_PER_HOUR, synthetic_weather

FIRST = "2021-11-01"
SUMMER = "2021-06-28"   # a Monday
DAYS = 14


def run(first=FIRST, effects=None, seed=5, noise=AVERAGE_DAYS, design=Office()):
    """Drives, trajectory and true meters of a fortnight."""
    weather = synthetic_weather("hot_humid", first, DAYS, seed)
    drives = make_drives(design, weather, noise, seed, first)
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
        cls.summer, cls.winter = run(SUMMER)[2], run("2021-01-04")[2]

    def test_there_is_none_by_default(self):
        self.assertEqual(run.__defaults__[1], None)
        self.assertEqual(type(RECIPE)("hot_humid", FIRST, 1, 1, Office()).effects, {})

    def test_each_changes_some_meter_in_some_season(self):
        for name in EFFECTS:
            changed = 0.0
            for first, plain in ((SUMMER, self.summer), ("2021-01-04", self.winter)):
                meters_now = run(first, {name: None})[2]
                changed += sum(np.abs(meters_now[m] - plain[m]).sum() for m in plain)
            if name != "closed_weeks":   # 20 July is in neither fortnight
                self.assertGreater(changed, 1, name)

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
        more = {"exhaust_fan": ("2021-01-04", "heating", 1), "server_heat": (SUMMER, "cooling", 1),
                "heat_island": (SUMMER, "cooling", 1), "blinds": (SUMMER, "cooling", -1),
                "wind_infiltration": ("2021-01-04", "heating", 1),
                "latent_load": (SUMMER, "cooling", 1),
                "night_ventilation": (SUMMER, "cooling", -1)}
        for name, (first, meter, sign) in more.items():
            plain = self.summer if first == SUMMER else self.winter
            now = run(first, {name: None})[2]
            self.assertGreater(sign * (now[meter].sum() - plain[meter].sum()), 0, name)


class Meters(unittest.TestCase):
    def test_noise_has_the_stated_size(self):
        noise = meters.MeterNoise(gap_share=0.0)
        shown = meters.read_meter(np.full(8760, 1000.0), noise, np.random.default_rng(1))
        expected = 1000 * np.sqrt(0.02 ** 2 + 0.025 ** 2 + 0.008 ** 2)
        self.assertAlmostEqual(shown.std(), expected, delta=0.1 * expected)
        np.testing.assert_array_equal(shown, np.round(shown))

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


if __name__ == "__main__":
    unittest.main()
