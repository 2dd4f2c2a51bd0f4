#!/usr/bin/python3
"""The loop's bench: what it draws, what it takes for right and for false, and its figures."""
import contextlib
import dataclasses
import hashlib
import io
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
from collections import Counter
from unittest import mock

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ["BEMCAL_PROGRAM"]
sys.path.insert(0, str(ROOT / "bench"))

import bench_loop       # noqa: E402
import calendars        # noqa: E402
import case_folder      # noqa: E402
import loop_names       # noqa: E402
import loop_scores      # noqa: E402
from case import make_case  # noqa: E402
from effects import EFFECTS, INSIDE, OPERATION  # noqa: E402

CALENDAR = "as on Sunday, on the public holidays of GB"   # as a loop writes it


def digest(text):
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def found(name, members=(), adequate=True, hook="gains", driver="hour of the day",
          interval=(0, 1), shape="from 18 to 21 h"):
    return {"name": name, "shape": shape, "class": list(members), "adequate": adequate, "hook": hook,
            "driver": driver, "interval": list(interval)}


def scored(planted, effects, kind="single", after=0.5, d=20.0, decisions=()):
    errors = {"plain": {"heat_kWh": 30.0}, "before": {"heat_kWh": 20.0},
              "after": {"heat_kWh": 20.0 * after}}
    return loop_scores.Scored("case", kind, planted, list(effects), list(decisions), errors, {},
                              {name: d for name in planted}, {})


class Draws(unittest.TestCase):
    def test_all_and_the_first_of_them_have_the_same_shares(self):
        self.assertEqual(Counter(bench_loop.kinds(160)),
                         {"null": 60, "single": 60, "pair": 20, "outside": 20})
        self.assertEqual(Counter(bench_loop.kinds(8)),
                         {"null": 3, "single": 3, "pair": 1, "outside": 1})

    def test_a_case_has_what_its_kind_says(self):
        for number, kind in enumerate(bench_loop.kinds(24)):
            for of, drawn in bench_loop.DRAWN.items():
                case = bench_loop.recipe(3, number, kind, of)
                self.assertEqual(len(case.effects), sum(n for _, n in drawn[kind]))
                for table, n in drawn[kind]:
                    self.assertEqual(len(set(case.effects) & set(table)), n)
                self.assertEqual(case, bench_loop.recipe(3, number, kind, of))

    def test_what_is_not_asked_for_leaves_a_seeds_buildings_as_they_were(self):
        """Digests of effects, of descriptions, and of a fortnight's readings in spring."""
        recipes = [bench_loop.recipe(7, n, kind) for n, kind in enumerate(bench_loop.kinds(16))]
        drawn = [(case.climate, case.seed, sorted(case.effects.items())) for case in recipes]
        told = [case_folder.building(case, "case") for case in recipes]
        spring = make_case(dataclasses.replace(recipes[3], first_day="2021-05-10", n_days=14))
        read = {name: np.nan_to_num(series, nan=-1).tolist()
                for name, series in spring.measured.items()}
        self.assertEqual([digest(repr(drawn)), digest(json.dumps(told)), digest(json.dumps(read))],
                         ["78ccef06a4e06ede", "95516dbd9658e276", "276c14d463090587"])

    def test_a_handler_leaves_the_building_beside_it(self):
        for air in ("declared", "silent"):
            case = bench_loop.recipe(3, 0, "null", "usual", air)
            self.assertEqual(case.design.air_system.is_declared, air == "declared")
            without = dataclasses.replace(case.design, air_system=None)
            self.assertEqual(without, bench_loop.recipe(3, 0, "null").design)

    def test_effects_are_drawn_from_all_that_fit(self):
        drawn = Counter(name for number in range(2000)
                        for name in bench_loop.recipe(5, number, "single").effects)
        self.assertEqual(set(drawn), set(INSIDE))
        drawn = Counter(name for number in range(100)
                        for name in bench_loop.recipe(5, number, "single", "operation").effects)
        self.assertEqual(set(drawn), set(OPERATION))


class Names(unittest.TestCase):
    def test_every_effect_has_its_row(self):
        self.assertEqual(set(loop_names.RIGHT), set(EFFECTS))
        for name in [*INSIDE, *OPERATION]:
            right = loop_names.RIGHT[name]
            self.assertTrue(right.names or right.parameter, name)
            self.assertTrue(set(right.when) <= set(right.names), name)

    def test_every_name_is_the_catalogues(self):
        printed = subprocess.run([PROGRAM, "describe", "effects"], capture_output=True, text=True, check=True)
        catalogue = set(re.findall(r"^ *\d+  (.+)$", printed.stdout, re.MULTILINE))
        used = {name for right in loop_names.RIGHT.values() for name in right.names}
        self.assertEqual(used - catalogue, set())
        self.assertEqual(loop_names.ALWAYS_THERE - catalogue, set())

    def test_places_are_hooks_and_drivers(self):
        words = "".join((ROOT / "src/effects" / file).read_text() for file in ("hooks.cpp", "drivers.cpp"))
        for right in loop_names.RIGHT.values():
            for place in right.places:
                for word in place:
                    self.assertIn(f'"{word}"', words)


class Scores(unittest.TestCase):
    def test_an_air_system_is_found_by_structure_or_by_an_effect(self):
        case = scored({}, [found("blinds")])
        self.assertFalse(loop_scores.has_found_an_air_system(case))
        by_effect = scored({}, [found("economiser")])
        by_structure = dataclasses.replace(case, structure=("surfaces", "coil that dries"))
        self.assertTrue(loop_scores.has_found_an_air_system(by_effect))
        self.assertTrue(loop_scores.has_found_an_air_system(by_structure))
        self.assertTrue(loop_scores.has_none_of_an_air_system(case))
        for part in ("latent_load", "reheat"):
            self.assertFalse(loop_scores.has_none_of_an_air_system(scored({part: 0.8}, [])))

    def test_numbers_of_terminals_are_beside_the_truth(self):
        handler = {"kind": "VAV with terminal reheat", "supply": 4.0, "supply_cold": 13.0, "supply_warm": 16.0,
                   "least_flow": 0.3, "is_declared": False}
        truth = {"structure": {"air_handler": handler}, "design": {"storey_height": 3.0}}
        loop = h5py.File("none", "w", driver="core", backing_store=False)
        loop["model"] = ["plain", "after"]
        loop["parameter"] = ["supply_flow", "least_supply", "supply_temperature", loop_scores.RESET_OF_SUPPLY]
        loop["parameter_value"] = [[0, 0, 0, 0], [17.0, 1.2, 10.0, 0.35]]
        loop["parameter_prior_sd"] = [5, 0.6, 1.5, 0.15]
        np.testing.assert_allclose(loop_scores.errors_of_terminals(loop, truth), [1, 0, -2, 1], atol=1e-12)
        handler["is_declared"] = True
        self.assertEqual(loop_scores.errors_of_terminals(loop, truth), [])

    def test_the_reset_is_the_refinements(self):
        table = (ROOT / "src/effects/refinements.cpp").read_text()
        self.assertIn(f'"{loop_scores.RESET_OF_SUPPLY}"', table)

    def test_names_of_an_air_system_are_of_the_catalogue_or_the_refinements(self):
        texts = "".join(path.read_text() for path in (ROOT / "src/effects").glob("*.cpp"))
        for name in loop_names.AIR_SYSTEM:
            self.assertIn(f'"{name}"', texts)

    def test_the_planted_name_is_right(self):
        case = scored({"blinds": 0.5}, [found("blinds")])
        self.assertTrue(loop_scores.is_named(case, "blinds"))
        self.assertEqual(loop_scores.false_effects(case), [])

    def test_other_hours_are_right_of_the_days_that_they_are_said_of(self):
        hours = {**found("other hours than declared"), "shape": "hvac runs Saturdays 7 to 11 h; declared off"}
        self.assertTrue(loop_names.is_right(hours, "saturday_operation"))
        self.assertFalse(loop_names.is_right({**hours, "shape": "hvac runs Sundays 7 to 11 h; declared off"},
                                             "saturday_operation"))

    def test_a_place_without_a_name_is_right_too(self):
        case = scored({"server_heat": 2}, [found("a sentence", hook="gains", driver="constant")])
        self.assertTrue(loop_scores.is_named(case, "server_heat"))

    def test_a_step_is_right_at_its_meter_only(self):
        step = found("step of a meter", ["step of a meter"], shape="after 0.5 years, gas meter")
        for planted, is_right in (("gas_step", True), ("heating_step", False)):
            case = scored({planted: 0.1}, [step])
            self.assertEqual(loop_scores.is_named(case, planted), is_right)
            self.assertEqual(loop_scores.is_classed(case, planted), is_right)
            self.assertEqual(loop_scores.false_effects(case), [] if is_right else [step])

    def test_a_step_is_as_detectable_as_its_meter_shows(self):
        loop = h5py.File("none", "w", driver="core", backing_store=False)
        self.addCleanup(loop.close)
        loop.create_dataset("power_effect", dtype=h5py.string_dtype(), data=[
            "step of a meter (heating meter)", "step of a meter (cooling meter)"])
        loop["power_detectability"] = [60.0, 4.0]
        truth = {"effects": {"cooling_step": 0.2, "heating_step": -0.1}}
        typical = EFFECTS["cooling_step"].size
        self.assertEqual(loop_scores.detectability(loop, truth),
                         {"cooling_step": 4 * 0.2 / typical, "heating_step": 60 * 0.1 / typical})

    def test_a_class_of_at_most_three_counts_as_a_class_only(self):
        members = ["night purge", "blinds", "shade"]
        small = scored({"blinds": 0.5}, [found("night purge", members)])
        self.assertFalse(loop_scores.is_named(small, "blinds"))
        self.assertTrue(loop_scores.is_classed(small, "blinds"))
        large = scored({"blinds": 0.5}, [found("night purge", members + ["early start"])])
        self.assertFalse(loop_scores.is_classed(large, "blinds"))

    def test_another_effect_is_false_and_wrong_where_it_is_adequate(self):
        for adequate in (True, False):
            case = scored({"blinds": 0.5}, [found("blinds"), found("reheat", adequate=adequate)])
            self.assertEqual([e["name"] for e in loop_scores.false_effects(case)], ["reheat"])
            self.assertEqual(loop_scores.is_adequate_but_wrong(case), adequate)

    def test_what_is_always_there_is_false_unless_the_error_falls(self):
        for after, n in ((0.9, 0), (1.1, 1)):
            case = scored({}, [found("stack infiltration")], "null", after)
            self.assertEqual(len(loop_scores.false_effects(case)), n)

    def test_what_parameters_follow_is_one_class_with_them(self):
        bridges = [{"series": "thermal bridges", "finding": "one class with H_op", "kind": "class"}]
        ground = [{"series": "ground coupling",
                   "finding": "one class with u_floor and what else is calibrated",
                   "kind": "class"}]
        other = [{"series": "ground coupling", "finding": "an hour late", "kind": "data"}]
        for planted, decisions, is_classed in (
                ("thermal_bridge", bridges, True), ("thermal_bridge", [], False),
                ("blinds", bridges, False), ("ground", ground, True), ("ground", other, False)):
            case = scored({planted: 0.1}, [], decisions=decisions)
            self.assertEqual(loop_scores.is_classed(case, planted), is_classed)
            self.assertFalse(loop_scores.is_named(case, planted))
            self.assertFalse(loop_scores.is_in_a_found_class(case, planted))
        beside = scored({"ground": 0.1}, [found("reheat")], decisions=ground)
        self.assertFalse(loop_scores.is_classed(beside, "ground"))

    def test_a_lock_out_that_moves_no_meter_cannot_be_detected(self):
        loop = h5py.File("none", "w", driver="core", backing_store=False)
        self.addCleanup(loop.close)
        loop.create_dataset("power_effect", data=["heating locked out", "reheat"],
                            dtype=h5py.string_dtype())
        loop["power_detectability"] = [30.0, 8.0]
        truth = {"effects": {"heating_locked": 100.0, "reheat": 0.1},
                 "without_one": {"heating_locked": {"heat_kWh": 20.0}},
                 "expected_floor": {"heat_kWh": 12.0},
                 "held_out_kWh_m2": {"heat_kWh": 30.0}}
        self.assertEqual(loop_scores.detectability(loop, truth),
                         {"heating_locked": 30.0, "reheat": 4.0})
        truth["without_one"]["heating_locked"]["heat_kWh"] = 13.0
        self.assertEqual(loop_scores.detectability(loop, truth)["heating_locked"], 0)

    def test_hours_are_named_by_the_parts_that_were_drawn(self):
        hours = {"plant": {"weekday": (6.0, 18.0), "saturday": None, "sunday": None},
                 "use": {"weekday": (7.5, 20.0), "saturday": None, "sunday": None}}
        for name, is_part in (("early start", True), ("plant runs on after hours", False),
                              ("evening use", True), ("Saturdays worked", False),
                              ("blinds", False)):
            case = scored({"other_hours": 3}, [found(name)])
            case.details = {"other_hours": hours}
            self.assertEqual(loop_scores.is_named(case, "other_hours"), is_part, name)
            self.assertEqual(not loop_scores.false_effects(case), is_part, name)

    def test_a_capacity_is_named_where_it_is_nearer_to_the_truth_than_to_the_declared(self):
        for true, factor, is_named in ((140.0, 1.5, True), (140.0, 1.4, False), (35.0, 0.7, True),
                                       (35.0, 0.72, False), (35.0, 1.5, False)):
            case = scored({"undersized_plant": 0.4}, [])
            case.details = {"undersized_plant": {"heating_capacity": [70.0, true]}}
            case.calibrated = {"heating_capacity": factor}
            self.assertEqual(loop_scores.is_named(case, "undersized_plant"), is_named)

    def test_a_capacity_that_moves_no_meter_cannot_be_detected(self):
        truth = {"effects": {"oversized_plant": 2.5}, "expected_floor": {"heat_kWh": 12.0},
                 "held_out_kWh_m2": {"heat_kWh": 30.0}}
        loop = h5py.File("none", "w", driver="core", backing_store=False)
        self.addCleanup(loop.close)
        loop.create_dataset("power_effect", data=["reheat"], dtype=h5py.string_dtype())
        loop["power_detectability"] = [8.0]
        for error, is_seen in ((20.0, True), (13.0, False)):
            truth["without_one"] = {"oversized_plant": {"heat_kWh": error}}
            case = scored({"oversized_plant": 2.5}, [])
            case.detectability = loop_scores.detectability(loop, truth)
            self.assertEqual(loop_scores.is_detectable(case), is_seen)

    def test_what_a_handler_does_is_false_without_one_or_if_the_error_rises(self):
        for kind, after, n in (("VAV with terminal reheat", 0.9, 0), ("single zone", 0.9, 1),
                               ("", 0.9, 1), ("VAV with terminal reheat", 1.1, 1)):
            case = scored({}, [found("reheat")], "null", after)
            case.air_handler = kind
            self.assertEqual(len(loop_scores.false_effects(case)), n)

    def test_sizes_of_classes_and_what_is_said_to_be_so(self):
        cases = [scored({"blinds": 0.5}, [found("blinds", ["blinds", "shade", ""]),
                                          found("reheat")]),
                 scored({"moving_holidays": 1.0}, [found("holidays", shape=CALENDAR)])]
        cases[1].details = {"moving_holidays": {"country": "England"}}
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            bench_loop.print_classes(cases)
            bench_loop.print_reliability(cases)
        for text in ("loop_class_size_median 1.000 names - -", "loop_class_size_p90 1.800 names - -",
                     "loop_adequate_effects_right 66.667 %_of_3 95 0.702",
                     "loop_calendars_right 100.000 %_of_1 90 1.111"):
            self.assertIn(text, out.getvalue())

    def test_a_calendar_is_right_where_its_country_was_planted(self):
        for planted, country, is_right in (
                ("moving_holidays", "England", True), ("moving_holidays", "Zurich", False),
                ("single_holidays", None, False)):
            holidays = found("holidays", shape=CALENDAR)
            case = scored({planted: 1.0}, [holidays])
            case.details = {planted: {"country": country}} if country else {}
            self.assertEqual(loop_scores.is_right_calendar(case, holidays), is_right)
            self.assertEqual(loop_scores.false_effects(case), [])   # they are days off
        self.assertEqual(loop_scores.calendar_of(found("holidays", shape="as on Sunday")), "")

    def test_countries_of_the_truth_have_their_code(self):
        self.assertEqual(set(loop_names.CODE_OF), set(calendars.HOLIDAYS))

    def test_a_clock_is_a_decision(self):
        decision = {"finding": "the meter's clock is 1 h late"}
        self.assertTrue(loop_scores.is_named(scored({"meter_late": 1}, [], decisions=[decision]),
                                             "meter_late"))
        self.assertFalse(loop_scores.is_named(scored({"meter_late": 1}, []), "meter_late"))

    def test_the_weaker_of_two_decides_whether_both_can_be_seen(self):
        case = scored({"blinds": 0.5, "reheat": 0.2}, [])
        self.assertTrue(loop_scores.is_detectable(case))
        case.detectability["blinds"] = 4.9
        self.assertFalse(loop_scores.is_detectable(case))

    def test_closed_is_over_the_affected_channels_of_some_energy(self):
        truth = {"expected_floor": {"heat_kWh": 10, "cool_kWh": 10, "T_air_C": 0.2},
                 "without_effect": {"heat_kWh": 30, "cool_kWh": 90, "T_air_C": 0.3},
                 "held_out_kWh_m2": {"heat_kWh": 50, "cool_kWh": 1}}
        self.assertEqual(loop_scores.affected(truth, truth["without_effect"]), ["heat_kWh"])
        errors = {"plain": {"heat_kWh": 50.0}, "after": {"heat_kWh": 20.0}}
        self.assertAlmostEqual(loop_scores.closed(errors, truth, "plain", "after"), 0.75)

    def test_intervals_of_right_names_cover_or_do_not(self):
        truth = {"climate": "continental"}
        planted = {"wind_infiltration": 0.26}   # at 2.6 m/s: 0.1 1/h per m/s
        for interval, hit in (((0.05, 0.12), True), ((0.2, 0.3), False)):
            effects = [found("wind infiltration", interval=interval)]
            self.assertEqual(loop_scores.coverage(effects, planted, truth), [hit])
        self.assertEqual(loop_scores.coverage([found("blinds")], planted, truth), [])

    def test_true_parameters_are_relative_to_the_design(self):
        numbers = {name: 2.0 for name in [*loop_scores.FACTORS.values(),
                                          *loop_scores.OFFSETS.values()]}
        truth = {"design": numbers, "built": {**numbers, "u_wall": 3.0, "heating_set": 2.5}}
        true = loop_scores.true_parameters(truth)
        self.assertEqual((true["u_wall"], true["heating_set_point"], true["people"]),
                         (1.5, 0.5, 1.0))

    def test_cases_without_a_result_are_counted(self):
        with tempfile.TemporaryDirectory() as folder:
            result = pathlib.Path(folder) / "result.h5"
            h5py.File(result, "w").close()
            cases, out = {pathlib.Path("a"): "null", pathlib.Path("b"): "single"}, io.StringIO()
            with mock.patch.object(bench_loop, "run", return_value=(result, 1.0)), \
                    contextlib.redirect_stdout(out):
                for rung in bench_loop.LADDER:
                    bench_loop.judge(cases, folder, mock.Mock(ranks=1), rung)
        for name in ("loop", "loop_electricity", "loop_monthly"):
            self.assertIn(f"\n{name}_cases_without_result 2.000 of_2 - -\n", out.getvalue())

    def test_shares_of_nothing_are_unknown(self):
        self.assertTrue(np.isnan(bench_loop.share([])))
        self.assertEqual(bench_loop.share([True, False]), 50)


if __name__ == "__main__":
    unittest.main()
