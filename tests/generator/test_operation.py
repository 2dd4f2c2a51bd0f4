"""Effects that meters of real buildings showed, and the air handler: what they do to the drives and to
the meters, and that the truth says what was drawn."""
import json
import pathlib
import sys
import unittest
from dataclasses import asdict, replace

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import air_system
import calendars
import case_folder
import construction
import designs
import effects_operation
import meters
import simulate as finer
from air_system import SINGLE_ZONE, VAV, AirSystem
from case import Recipe
from drives import AVERAGE_DAYS, make_drives
from effects import EFFECTS, OPERATION, apply_effects
from office import Office
from weather import CLIMATES, STEP_S, STEPS_PER_HOUR, synthetic_weather

DAYS = 14
SUMMER, WINTER = "2021-06-28", "2021-01-04"   # Mondays
BOILER = Office(heat_source="boiler", u_wall=0.6, u_roof=0.4, u_window=1.8)
HANDLER = AirSystem(VAV, supply=4.5, supply_cold=13.5, supply_warm=16.5, fan_heat=0.9,
                    economiser=False, least_flow=0.35, is_declared=False)


def drives_of(first, effects=None, climate="continental", days=DAYS, seed=5, design=BOILER):
    """(weather, drives, what effects drew)"""
    weather = synthetic_weather(climate, first, days, seed)
    drives = make_drives(design, weather, AVERAGE_DAYS, seed, first)
    return weather, drives, apply_effects(drives, design, effects or {})


def run(first, effects=None, climate="continental", design=BOILER):
    weather, drives, _ = drives_of(first, effects, climate, design=design)
    trajectory = finer.simulate(design, weather, drives)
    return drives, trajectory, meters.true_meters(design, drives, trajectory)


def with_handler(**changed):
    return replace(BOILER, air_system=replace(HANDLER, **changed))


def hourly_heating(trajectory):
    return trajectory.asked_heating.reshape(-1, STEPS_PER_HOUR).mean(axis=1)


class Hours(unittest.TestCase):
    def spans(self, seed, size=3.0):
        return drives_of(WINTER, {"other_hours": size}, seed=seed)[2]["other_hours"]

    def test_both_ends_of_a_weekday_are_together_as_far_off_as_the_size_says(self):
        for seed in range(20):
            for who, size in (("plant", 3.0), ("use", 1.5)):
                begin, end = self.spans(seed)[who]["weekday"]
                self.assertEqual(abs(begin - 7) + abs(end - 19), size)

    def test_some_work_at_weekends(self):
        worked = [[self.spans(seed)["plant"][day] is not None for day in ("saturday", "sunday")]
                  for seed in range(40)]
        self.assertTrue(np.all(np.mean(worked, axis=0) > 0.02))
        self.assertTrue(np.all(np.mean(worked, axis=0) < 0.7))

    def test_plant_and_use_follow_the_hours_that_the_truth_says(self):
        for seed in range(6):
            _, drives, drawn = drives_of(WINTER, {"other_hours": 4.0}, seed=seed)
            for row, day in enumerate(("weekday", "saturday", "sunday")):
                on = drives.weekday == (0, 5, 6)[row]
                span = drawn["other_hours"]["plant"][day]
                runs = (drives.hour >= span[0]) & (drives.hour < span[1]) if span else False & on
                np.testing.assert_array_equal((drives.fresh_air > 1e-9)[on], runs[on])
                np.testing.assert_allclose(
                    drives.heating_set[on],
                    np.where(runs, BOILER.heating_set, BOILER.heating_setback)[on])

    def test_without_a_difference_nothing_changes(self):
        _, plain, _ = drives_of(WINTER)
        declared = {"weekday": (7, 19), "saturday": None, "sunday": None}
        for use in ("people", "equipment", "plant"):
            more = effects_operation.change(plain, BOILER, use, declared, 0.5)
            np.testing.assert_array_equal(more, 0)

    def test_days_declared_closed_stay_closed(self):
        closed = replace(BOILER, holidays=("2021-01-06",))
        _, drives, _ = drives_of(WINTER, {"other_hours": 4.0}, design=closed)
        self.assertEqual(drives.fresh_air[drives.date == np.datetime64("2021-01-06")].max(), 0)


class Holidays(unittest.TestCase):
    def test_all_are_working_days_in_order(self):
        for climate in CLIMATES:
            days = calendars.holidays_of(climate)
            self.assertTrue(np.all(np.is_busday(days)), climate)
            self.assertTrue(np.all(np.diff(days) > np.timedelta64(0, "D")), climate)

    def test_good_friday_and_easter_monday_stand_by_easter(self):
        for sunday in ("2021-04-04", "2022-04-17"):   # Easter, by the almanac
            for climate in CLIMATES:
                days = set(calendars.holidays_of(climate))
                self.assertIn(np.datetime64(sunday) - 2, days)
                if sunday != "2021-04-04" or climate != "hot_humid":
                    self.assertIn(np.datetime64(sunday) + 1, days)

    def test_most_move_from_year_to_year(self):
        for climate in CLIMATES:
            of = [{str(day)[5:] for day in calendars.holidays_of(climate)
                   if str(day).startswith(year)} for year in ("2021", "2022")]
            self.assertGreater(len(of[1] - of[0]), len(of[1]) / 2, climate)

    def test_they_are_days_off_and_the_truth_lists_them(self):
        for climate, day in (("cool_maritime", "2021-04-02"), ("hot_humid", "2021-04-06")):
            weather, drives, drawn = drives_of("2021-03-29", {"moving_holidays": 1.0}, climate)
            self.assertIn(day, drawn["moving_holidays"]["days"])
            off = drives.date == np.datetime64(day)
            self.assertEqual(drives.people[off].max(), 0)
            self.assertGreater(drives.people[drives.date == np.datetime64("2021-04-07")].max(), 0)


class OptimumStart(unittest.TestCase):
    def test_heating_begins_earlier_the_colder_the_night(self):
        _, plain, _ = drives_of(WINTER)
        _, drives, _ = drives_of(WINTER, {"optimum_start": 8.0})
        raised = (drives.heating_set > plain.heating_set).reshape(DAYS, -1).sum(axis=1) * STEP_S / 60
        night = drives.theta_e.reshape(DAYS, -1)[:, :4 * STEPS_PER_HOUR].mean(axis=1)
        wanted = np.clip(8.0 * (15 - night), 0, 300)
        is_open = drives.open_day.reshape(DAYS, -1)[:, 0]
        np.testing.assert_allclose(raised[is_open], wanted[is_open], atol=STEP_S / 60)
        self.assertEqual(raised[~is_open].max(), 0)
        self.assertGreater(np.ptp(raised[is_open]), 30)

    def test_not_after_a_warm_night_and_the_air_waits(self):
        _, plain, _ = drives_of(SUMMER, climate="hot_humid")
        _, drives, _ = drives_of(SUMMER, {"optimum_start": 8.0}, "hot_humid")
        np.testing.assert_array_equal(drives.heating_set, plain.heating_set)
        _, plain, _ = drives_of(WINTER)
        _, drives, _ = drives_of(WINTER, {"optimum_start": 8.0})
        np.testing.assert_array_equal(drives.fresh_air, plain.fresh_air)


class Capacity(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.runs = {name: run(WINTER, {name: None} if name else {})
                    for name in ("", "oversized_plant", "undersized_plant")}

    def hours_at_capacity(self, name):
        drives, trajectory, _ = self.runs[name]
        full = drives.heating_size * BOILER.heating_capacity * BOILER.floor_area
        return int((hourly_heating(trajectory) > 0.999 * full).sum())

    def test_an_oversized_plant_never_binds_and_an_undersized_one_does_on_cold_days(self):
        self.assertEqual(self.hours_at_capacity("oversized_plant"), 0)
        self.assertGreater(self.hours_at_capacity("undersized_plant"),
                           2 * self.hours_at_capacity(""))
        drives, short, _ = self.runs["undersized_plant"]
        noon = drives.open_day & (drives.hour == 10)
        self.assertLess(short.theta_air[noon].min(), BOILER.heating_set - 0.8)

    def test_the_truth_says_what_is_wrong_about_the_declared_capacity(self):
        for name in ("oversized_plant", "undersized_plant"):
            _, drives, drawn = drives_of(WINTER, {name: None})
            declared, true = drawn[name]["heating_capacity"]
            self.assertEqual(declared, BOILER.heating_capacity)
            self.assertAlmostEqual(true, drives.heating_size * declared)
            self.assertEqual(true > declared, name == "oversized_plant")


class Handler(unittest.TestCase):
    """An air handler's physics."""

    def meters_of(self, first, climate="continental", **changed):
        return run(first, climate=climate, design=with_handler(**changed))[2]

    def test_heat_in_equals_heat_stored(self):
        for kind in (SINGLE_ZONE, VAV):
            for first in (WINTER, SUMMER):
                drives, out, _ = run(first, design=with_handler(kind=kind, economiser=True))
                stored = (out.stored + finer.AIR_MULTIPLIER * construction.RHO_C_AIR
                          * BOILER.volume * out.theta_air)
                gain = (out.surface_gain + out.air_conductance * (drives.theta_e - out.theta_air)
                        + out.convective + out.air_gain
                        + out.emitted_heating - out.emitted_cooling)
                np.testing.assert_allclose(np.diff(stored), STEP_S * gain[1:],
                                           atol=1e-9 * np.abs(stored).max())

    def test_a_vav_handlers_coil_closes_its_balance(self):
        """Of a dry day: what the air carries from the mixing box to the zone is what fan and coils do."""
        design = with_handler()
        _, drives, _ = drives_of(WINTER, design=design)
        k = int(np.argmax(drives.fresh_air > 0))
        air = air_system.air_step(design, drives, k, 24.0)
        load = air_system.coils(design, drives, k, air, 0.0)
        outdoor = construction.RHO_C_AIR * drives.fresh_air[k] * (drives.theta_e[k] - 24.0)
        supplied = construction.RHO_C_AIR * air.supply * (air.theta_supply - 24.0)
        self.assertAlmostEqual(outdoor + 0.9 * load.fan + load.heating - load.cooling, supplied,
                               delta=1e-6 * abs(supplied))

    def test_what_the_zone_asks_for_beyond_the_flow_is_not_carried(self):
        design = with_handler()
        _, drives, _ = drives_of(SUMMER, design=design)
        k = int(np.argmax(drives.fresh_air > 0))
        air = air_system.air_step(design, drives, k, 26.0)
        load = air_system.coils(design, drives, k, air, air.most_cooling)
        self.assertAlmostEqual(load.fan, air_system.fan_power(design, air_system.design_flow(design)))

    def test_reset_is_warm_when_it_is_cold(self):
        for theta_e, supply in ((-5, 16.5), (5, 16.5), (12.5, 15.0), (20, 13.5), (35, 13.5)):
            self.assertAlmostEqual(air_system.supply_temperature(HANDLER, theta_e), supply)

    def test_a_vav_building_heats_again_what_its_least_flow_cools(self):
        """In rooms with few gains, in summer."""
        quiet = {"people": 2.0, "lights": 3.0, "equipment": 3.0}
        few, many = (run(SUMMER, climate="hot_humid",
                         design=replace(with_handler(least_flow=share, supply=8.0), **quiet))[2]
                     for share in (0.15, 0.8))
        self.assertEqual(few["heating"].sum(), 0)
        self.assertGreater(many["heating"].sum(), 0.05 * many["cooling"].sum())
        self.assertGreater(many["cooling"].sum(), few["cooling"].sum())

    def test_fan_heat_is_cooled_away_and_heats_in_winter(self):
        for kind in (SINGLE_ZONE, VAV):
            cold, warm = (self.meters_of(SUMMER, kind=kind, fan_heat=share) for share in (0.0, 1.0))
            self.assertGreater(warm["cooling"].sum(), cold["cooling"].sum())
            cold, warm = (self.meters_of(WINTER, kind=kind, fan_heat=share) for share in (0.0, 1.0))
            self.assertLess(warm["heating"].sum(), cold["heating"].sum())

    def test_an_economiser_saves_cooling_where_nights_are_cool(self):
        for kind in (SINGLE_ZONE, VAV):
            without, with_it = (self.meters_of("2021-05-03", kind=kind, economiser=there)
                                for there in (False, True))
            self.assertLess(with_it["cooling"].sum(), 0.99 * without["cooling"].sum())

    def test_a_cold_coil_dries_the_air_of_a_humid_climate(self):
        design = with_handler(kind=SINGLE_ZONE)
        _, humid, _ = run(SUMMER, climate="hot_humid", design=design)
        _, dry, _ = run(WINTER, climate="continental", design=design)
        self.assertGreater(humid.coil_cooling.sum(), 0.1 * humid.asked_cooling.sum())
        self.assertEqual(dry.coil_cooling.max(), 0)

    def test_an_air_handler_at_rest_is_none(self):
        drives, out, _ = run(SUMMER, design=with_handler())
        off = drives.fresh_air == 0
        for series in (out.fan, out.coil_cooling, out.air_gain):
            self.assertEqual(np.abs(series[off]).max(), 0)
        self.assertGreater(out.fan[~off].min(), 0)


class Said(unittest.TestCase):
    """What building.json and truth.json tell."""

    def test_a_description_tells_of_a_handler_or_is_silent(self):
        told = {kind: case_folder.building(Recipe("continental", WINTER, 730, 1, design), "x")
                for kind, design in (("none", BOILER), ("silent", with_handler()),
                                     ("declared", with_handler(is_declared=True)))}
        self.assertEqual(told["none"], told["silent"])
        handler = told["declared"].pop("systems")["air_handler"]
        self.assertEqual(told["declared"], told["none"])
        self.assertEqual(handler["kind"], VAV)
        self.assertAlmostEqual(handler["supply_flow_l_s_m2"], 4.5 * 3.4 / 3.6)
        self.assertEqual(handler["supply_C"], {"outdoors_5_C": 16.5, "outdoors_20_C": 13.5})

    def test_the_truth_has_what_was_drawn_and_nothing_more_where_nothing_was(self):
        weather = synthetic_weather("continental", WINTER, DAYS, 1)
        said = lambda effects, design: case_folder.beside_sizes(
            Recipe("continental", WINTER, DAYS, 1, design, effects), design, weather)
        self.assertEqual(said({"blinds": 0.5}, BOILER), {})
        self.assertEqual(said({}, with_handler())["structure"], {"air_handler": asdict(HANDLER)})
        for name in OPERATION:
            self.assertEqual(list(said({name: None}, BOILER)["details"]), [name])
            json.dumps(said({name: None}, BOILER))

    def test_handlers_are_drawn_of_both_kinds_and_take_no_effect_that_they_bring(self):
        drawn = [designs.drawn_air_system(np.random.default_rng(s), s % 2 == 0) for s in range(20)]
        self.assertEqual({air.kind for air in drawn}, {SINGLE_ZONE, VAV})
        self.assertTrue(all(air.supply_warm > air.supply_cold for air in drawn))
        for name in ("reheat", "latent_load"):
            self.assertTrue(EFFECTS[name].fits(BOILER))
            self.assertFalse(EFFECTS[name].fits(with_handler()))


if __name__ == "__main__":
    unittest.main()
