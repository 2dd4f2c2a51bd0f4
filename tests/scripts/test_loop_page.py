#!/usr/bin/python3
"""The page of a loop needs nothing else, and says what the numbers say."""
import html.parser
import math
import pathlib
import re
import sys
import tempfile
import types
import unittest

import h5py
import numpy as np

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(pathlib.Path(__file__).parent)]

import fake_loop_result  # noqa: E402
import fake_simulator  # noqa: E402
from report import beside, meters, page, pictures, regression, result, stored, studies, words  # noqa: E402
from report import loop as loop_page  # noqa: E402

THREE = {"air": "degC", "electricity": "kWh", "gas": "kWh"}
ONE = {"gas": "kWh"}
VOID = {"meta", "img", "br", "link"}
MAY_STAY_OPEN = {"td", "th", "dt", "dd"}
FOUR_WEEKS = 28 * 24           # h


def html_of(file):
    return page.html_of(stored.read(file))


class Page(html.parser.HTMLParser):
    """Words, images and what the page refers to."""

    def __init__(self, text):
        super().__init__()
        self.images, self.references, self.words, self.open = [], [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag == "img":
            self.images.append(attributes)
        self.references += [attributes[key] for key in ("src", "href", "srcset")
                            if key in attributes]
        if tag not in VOID | MAY_STAY_OPEN:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-1:]}"
        self.open.pop()

    def handle_data(self, data):
        if not self.open or self.open[-1] not in ("style", "script"):
            self.words.append(data)

    @property
    def text(self):
        return " ".join(" ".join(self.words).split())


class LoopReport(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.file = fake_loop_result.write(cls.folder / "office.h5", channels=THREE)
        cls.loop = result.read(cls.file)
        cls.html = html_of(cls.file)
        cls.page = Page(cls.html)

    def small(self, name, **options):
        return fake_loop_result.write(self.folder / name, channels=ONE, **options)

    def test_the_page_needs_nothing_else(self):
        self.assertEqual(self.page.open, [])
        for reference in self.page.references:
            self.assertTrue(reference.startswith("data:"), reference[:80])
        bare = re.sub(r"data:[^\"]*", "", self.html)
        for request in ("http:", "https:", "@import", "url(", "<script", "<link"):
            self.assertNotIn(request, bare)
        self.assertLess(len(self.html), 3e6)

    def test_every_picture_says_in_words_what_it_shows(self):
        self.assertGreaterEqual(len(self.page.images), 6 * len(self.loop.channels))
        alts = [image["alt"] for image in self.page.images]
        self.assertEqual(len(set(alts)), len(alts))
        for alt in alts:
            self.assertGreater(len(alt), 40, alt)

    def test_every_channel_has_its_errors_and_pictures(self):
        for row in self.loop.errors():
            self.assertIn(f"{row.channel} {row.resolution} {words.error_of(row, result.PLAIN)}",
                          self.page.text)
        for channel in self.loop.channels:
            self.assertTrue(any(channel in image["alt"] for image in self.page.images), channel)

    def test_what_is_not_known_is_a_dash(self):
        said = self.page.text + " ".join(image["alt"] for image in self.page.images)
        self.assertNotRegex(said, r"(?i)\b(nan|inf|none)\b")
        self.assertRegex(self.page.text, r"thermostat_band .* – – [^–]* K ")

    def test_errors_are_those_of_the_stored_series(self):
        row = next(row for row in self.loop.judged_errors() if row.channel == "gas")
        series = self.loop.series["gas"]
        error = series.residual(result.AFTER)
        self.assertAlmostEqual(row.error[result.AFTER], 100 * np.sqrt(np.nanmean(error**2))
                               / np.nanmean(series.measured))
        row = next(row for row in self.loop.judged_errors() if row.channel == "air")
        self.assertEqual(row.unit, "K")
        self.assertAlmostEqual(row.bias[result.PLAIN],
                               np.nanmean(self.loop.series["air"].residual(result.PLAIN)))

    def test_the_first_paragraph_names_effects_errors_and_what_is_left(self):
        lead = self.page.text[:1500]
        for phrase in ("Two effects were found", "wind infiltration (0.083 1/h per m/s; probability 0.81; "
                       "or else stack infiltration (0.12) or outdoor shift (0.06))", "cannot tell for sure",
                       "the nearest one: blind control (its probability is below 0.9)",
                       "in held_out, which the search has not seen, the error fell for",
                       "it stayed the same for electricity", "Not explained:", "9 % for gas"):
            self.assertIn(phrase, lead)

    def test_hours_that_nobody_wrote_down_are_said_before_the_structure(self):
        text = " ".join(self.page.text.split())
        said = "Schedule work: Monday to Friday 8 to 19 h, Saturdays off; learned, nobody declared it."
        self.assertIn(said + " Plain has the usual hours of the use", text)
        self.assertLess(text.index(said), text.index("Before any effect"))

    def test_hours_in_place_of_declared_ones_have_no_interval(self):
        effect = types.SimpleNamespace(name="other hours than declared", coefficient=1.0, least=1.0, most=1.0,
                                       unit="-", shape="plant runs Saturdays off; declared 8 to 13 h", others=[],
                                       probability=math.nan)
        self.assertEqual(words.found_one(effect),
                         "other hours than declared (plant runs Saturdays off; declared 8 to 13 h)")
        self.assertEqual(words.coefficient(effect), "none: it is there or not")

    def test_a_function_is_drawn_over_what_it_follows_with_its_interval(self):
        drawn = pictures.functions(self.loop)
        self.assertEqual(len(drawn), 4)         # the fifth follows nothing
        for one, function in zip(drawn, self.loop.functions):
            self.assertEqual(one.title.lower(), function.name)
            k = max(range(len(function.points)), key=lambda p: abs(function.points[p].value))
            point = function.points[k]
            self.assertIn(f"{words.number(point.value)}, its 90 % interval is {words.number(point.least)} to "
                          f"{words.number(point.most)}", one.alt)
            self.assertIn(one.uri, self.html)

    def test_a_regression_stands_beside_the_models_and_has_its_own_errors(self):
        errors = beside.regression_errors(self.loop)
        self.assertEqual({channel for channel, *_ in errors}, {"electricity", "gas"})
        for channel in ("electricity", "gas"):
            training, held_out = (beside.readings(self.loop.all_series[period][channel])
                                  for period in self.loop.periods)
            fit = regression.Regression(regression.choose_plan(*training), *training)
            simulated, measured = fit.predict(*held_out[:2]), held_out[2]
            self.assertAlmostEqual(errors[channel, "held_out", "hourly"], 100 * np.sqrt(
                np.mean((simulated - measured)**2)) / measured.mean())
            self.assertIn(f"{channel} {errors[channel, 'held_out', 'hourly']:.1f} % (after: ", self.page.text)

    def test_without_held_out_readings_it_says_so(self):
        file = self.small("training.h5", held_out=False)
        self.assertEqual(result.read(file).judged, "training")
        text = Page(html_of(file)).text
        self.assertIn("No readings were held out", text)
        self.assertIn("No held-out readings.", text)

    def test_finding_nothing_is_a_result(self):
        text = Page(html_of(self.small("none.h5", found=0))).text
        self.assertIn("No effect was found that the description of office lacks: the candidate that stood out from "
                      "noise did not pass; most evidence had meter drift, gas (rejected: the held-out score falls).",
                      text)
        self.assertIn("None that passes.", text)

    def test_why_there_is_no_effect_follows_the_verdicts(self):
        def of(*steps):
            return words.why_none(types.SimpleNamespace(steps=[types.SimpleNamespace(
                effect=name, gain=gain, threshold=20, verdict=verdict) for name, gain, verdict in steps]))
        self.assertEqual(of(("wind", 20, "evidence below what noise shows"), ("", 0, "nothing passes")),
                         "no candidate stood out from noise")
        self.assertEqual(of(("wind", 21, "coefficient not plausible"), ("shade", 30, "accepted")),
                         "two candidates stood out from noise, and none of them stayed; most evidence had shade (it "
                         "passed at first)")

    def test_a_change_that_the_digits_do_not_show_is_none(self):
        def row(name, before, after, unit):
            errors = np.array([np.nan, before, after])
            return types.SimpleNamespace(channel=name, unit=unit, resolution="hourly", error=errors,
                                         removed=lambda since, until: 1 - errors[until] / errors[since])
        said = words.changes([row("air", 0.174, 0.168, "K"), row("gas", 20, 10, "%")], result.BEFORE, result.AFTER)
        self.assertEqual(said, "the error fell for gas by 50 % (from 20.0 to 10.0 %); it stayed the same for air")
        self.assertIn("of readings whose mean is near 0", words.changes(
            [row("heat", 892.2, 961.2, "%")], result.BEFORE, result.AFTER))

    def by_month(self, name, readings=True):
        """Read by four weeks, of which the result has the readings, or has not."""
        file = fake_loop_result.write(self.folder / name, channels=ONE)
        with h5py.File(file, "a") as stored:
            for period in fake_loop_result.BEGIN:
                gas, times = stored[f"office/loop/{period}/gas"], stored[f"office/loop/{period}/time"][()]
                gas["measured"][:] = np.nan
                if not readings:
                    continue
                edges = times[::FOUR_WEEKS]
                gas["reading_begin"], gas["reading_end"] = edges[:-1], edges[1:]
                gas["reading_measured"] = np.full(edges.size - 1, 1234.0)
            stored["office/loop/fit"][:, :, 0] = np.nan
        return file

    def test_a_period_that_overlaps_training_is_not_unseen(self):
        file = fake_loop_result.write(self.folder / "overlap.h5", channels=ONE)
        with h5py.File(file, "a") as stored:
            stored["office/loop/held_out/time"][:] -= 180 * 86400
        text = Page(html_of(file)).text
        self.assertIn("in held_out, which overlaps training, the error fell", text)
        self.assertIn("On held_out, which overlaps training.", text)
        self.assertNotIn("has not seen", text)

    def test_a_name_is_told_from_the_programs_chance_on(self):
        header = (pathlib.Path(__file__).resolve().parents[2] / "src" / "loop" / "decisions.hpp").read_text()
        self.assertIn(f"enough_chance = {loop_page.TOLD};", header)

    def test_bills_are_drawn_beside_the_hours_that_they_sum(self):
        loop = result.read(self.by_month("bills.h5"))
        meter, = meters.of_loop(loop)
        series = loop.series["gas"]
        self.assertAlmostEqual(meter.models["after"][1], series.simulated[2][FOUR_WEEKS:2 * FOUR_WEEKS].sum(), 6)
        self.assertEqual(meter.measured[0], 1234)
        text = html_of(self.by_month("bills_again.h5"))
        self.assertIn("Bills: gas", text)
        self.assertNotIn("Hardly read in this period", text)

    def test_a_channel_that_is_read_by_the_month_has_errors_and_no_pictures(self):
        file = self.by_month("monthly.h5", readings=False)
        loop = result.read(file)
        self.assertEqual([row.resolution for row in loop.judged_errors()], ["monthly"])
        self.assertEqual(pictures.of_channel(loop, 0), [])
        self.assertIn("Hardly read in this period", html_of(file))

    def test_what_parameters_do_nearly_as_well_stands_together(self):
        self.assertIn("do nearly the same as (told apart only where large): effect 38.", self.page.text)
        self.assertNotIn("one class with u_floor", self.page.text)

    def test_a_parameter_at_an_end_is_said_beside_the_parameters(self):
        self.assertIn("One ends at an end of the range or far from the prior: thermostat_band (at the upper end "
                      "of its range: 0.5 K).", self.page.text)
        self.assertNotIn("may stand for what the description lacks thermostat", self.page.text)

    def test_a_setting_that_the_readings_deny_is_said_first(self):
        self.assertIn("By the readings the heating set-back is 19.3 (18.9 to 19.7) °C and not the 16 that are "
                      "described. Two effects were found", self.page.text)

    def test_limits_and_kinds_are_those_of_the_result(self):
        file = fake_loop_result.write(self.folder / "limits.h5", channels=ONE)
        with h5py.File(file, "a") as stored:
            study = stored["office/loop"]
            study["least_detectability"][()], study["same_signature"][()] = 1e9, 0.5
            study["decision_kind"][:] = ["class", "data", "parameter"]
        loop = result.read(file)
        self.assertEqual(loop_page.power_rows(loop), [])
        self.assertEqual(words.followed(loop), [])
        self.assertEqual([row[1] for row in loop_page.decision_rows(loop)], ["one class with u_floor"])
        text = Page(html_of(file)).text
        self.assertIn("detectability below 1e+09", text)
        self.assertIn("correlation of 0.5 or more", text)

    def test_a_result_of_before_lists_kinds_and_limits_were_stored_looks_the_same(self):
        file = fake_loop_result.write(self.folder / "older.h5", channels=ONE)
        with h5py.File(file, "a") as stored:        # which says nothing of ends of parameters
            stored["office/loop/decision_kind"][2] = "data"
            del stored["office/loop/effect_class_probability"]
        now = html_of(file)
        with h5py.File(file, "a") as stored:
            for name in ("effect_class_of", "effect_class_member", "decision_kind",
                         "power_alias_kind", "least_detectability", "same_signature"):
                del stored["office/loop"][name]
        self.assertEqual(html_of(file), now)

    def test_a_doubt_that_is_not_stored_is_not_made_up(self):
        file = fake_loop_result.write(self.folder / "doubt.h5", channels=ONE)
        with h5py.File(file, "a") as stored:
            del stored["office/loop/effect_doubt"]
        text = Page(html_of(file)).text
        self.assertIn("the nearest one: blind control.", text)

    def test_what_a_result_lacks_is_left_out(self):
        file = fake_loop_result.write(self.folder / "lean.h5", channels=ONE)
        with h5py.File(file, "a") as stored:
            for name in list(stored["office/loop"]):
                if name.startswith(("power", "localisation", "candidate", "decision", "unexplained",
                                    "noise")):
                    del stored["office/loop"][name]
            for period in fake_loop_result.BEGIN:
                del stored[f"office/loop/{period}/outdoor_temperature"]
        text = html_of(file)
        self.assertNotIn("Against outdoor temperature", text)
        self.assertNotIn("What these data can show", text)

    def test_of_a_loop_around_a_program_its_runs_and_what_was_given_to_it_are_shown(self):
        path = self.small("around.h5")
        self.assertNotIn("It ran", Page(html_of(path)).text)
        fake_simulator.add_to(path)
        text = Page(html_of(path)).text
        self.assertIn("It ran 3 times: 2 design, 1 calibration; 1 failed.", text)
        self.assertIn("Unseen ones were foretold within (CV(RMSE)): gas 2.5 %.", text)
        self.assertIn("It could not take: blinds: there are none.", text)
        self.assertIn("no better with it", text)
        self.assertIn("Parameters of the twin", text)

    def test_names_of_a_job_are_text_and_not_markup(self):
        file = self.small("markup.h5", stage="a <b> & c/loop")
        self.assertIn("<h1>a &lt;b&gt; &amp; c</h1>", html_of(file))

    def test_a_study_is_known_by_its_kind_and_in_version_0_1_0_by_what_it_stores(self):
        with h5py.File(self.folder / "kinds.h5", "w") as file:
            for path, kind in (("a/first", "loop"), ("a/second", "screening"), ("b/posterior", "dream")):
                fake_loop_result.text(file.create_group(path), "kind", kind)
            file["a/second/structure_chosen"] = "a dataset that another kind stores"
            file["b/posterior/posterior/kind"] = [1.0, 2.0]
            self.assertEqual(studies.of_kind(file, "loop"), ["a/first"])
            self.assertEqual(studies.of_kind(file, "loop", "screening"), ["a/first", "a/second"])
            for path in ("a/first", "a/second", "b/posterior"):
                del file[path]["kind"]
            del file["b/posterior/posterior/kind"]
            self.assertEqual(studies.of_kind(file, "loop"), ["a/second"])


class Numbers(unittest.TestCase):
    def test_the_autocorrelation_of_a_wave_is_a_wave_in_spite_of_gaps(self):
        hours = np.arange(24 * 60)
        wave = np.sin(2 * np.pi * hours / 24)
        wave[::7] = np.nan
        values = pictures.autocorrelation(wave, [12, 24])
        np.testing.assert_allclose(values, [-1, 1], atol=0.05)

    def test_hours_and_months_are_those_of_the_clock(self):
        time = np.datetime64("2021-01-01", "s").astype(float) + 3600 * np.arange(8760.0)
        month = time.astype("datetime64[s]").astype("datetime64[M]").astype(int) % 12
        simulated = np.where((month == 1) & (np.arange(8760) % 24 == 5), 3.0, 0.0)
        series = result.Series(time, np.zeros(8760), simulated[None], np.array([]))
        cells = pictures.hour_and_month(series, 0)
        self.assertEqual(cells[5, 1], 3)
        self.assertEqual(cells.sum(), 3)

    def test_a_typical_week_begins_on_monday_and_winter_in_december(self):
        time = np.array(["2021-11-30T23", "2021-12-01T00", "2021-06-06T05", "2021-03-01T00"],
                        "datetime64[s]").astype(float)
        # A Tuesday's last hour of autumn, a Wednesday's first of winter, a Sunday, a Monday.
        self.assertEqual(pictures.season_and_hour(time).tolist(),
                         [3 * 168 + 47, 48, 2 * 168 + 149, 168])

    def test_a_weeks_first_day_is_a_monday(self):
        time = np.datetime64("2021-01-01", "s").astype(float) + 3600 * np.arange(24 * 30.0)
        series = result.Series(time, np.ones(720), np.ones((3, 720)), np.array([]))
        days = [np.datetime64(int(time[week.start]), "s").astype("datetime64[D]") for week in
                pictures.weeks_of(series)]
        self.assertEqual(str(days[0]), "2021-01-04")
        self.assertEqual(len(days), 3)

    def test_numbers_are_short_and_have_a_true_minus(self):
        self.assertEqual(words.number(0.08312), "0.0831")
        self.assertEqual(words.number(-12345.6), "−12346")
        self.assertEqual(words.number(float("nan")), "–")
        self.assertEqual(words.fixed(-0.001, 2), "0.00")
        self.assertEqual(words.signed(0.5, 1), "+0.5")
        self.assertEqual(words.listed(["a", "b", "c"]), "a, b and c")


if __name__ == "__main__":
    unittest.main()
