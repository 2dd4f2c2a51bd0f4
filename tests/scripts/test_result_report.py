#!/usr/bin/python3
"""scripts/result_report makes a page of every kind of study: each picture says in words what it shows, the same file
gives the same bytes, and what a result lacks or has damaged is left out or told."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import h5py
import numpy as np

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(pathlib.Path(__file__).parent)]

import fake_loop_result  # noqa: E402
import fake_results  # noqa: E402
from report import answers, chains, kinds, meters, page, picture, savings, screening, sobol  # noqa: E402
from report import staged, stored, theme  # noqa: E402
from report import words as report_words  # noqa: E402
from test_loop_page import Page  # noqa: E402

DAMAGE = "do not fit together"
# What is known before any simulation.
OF_THE_JOB = {"parameter_least", "parameter_most", "time", "threshold", "error_level", "quantile", "comfort_limit",
              "simulated_period", "n_failed", "target_measured", "field_input", "field_measured", "measured",
              "grid_value", "grid_parameter", "grid_points", "neighbour", "stage_points", "outdoor_temperature",
              "round_end", "best_point", "calibration_least", "calibration_most"}
LETTER = 0.5                   # width of a letter, of its size
PROGRAM = os.environ.get("BEMCAL_PROGRAM", str(ROOT / "build" / "release" / "bemcal-batch"))
# What each study of fake_results must have, by a word of the titles of its pictures and tables.
PICTURES = {
    "sensitivity": ("heating", "electricity", "Total order of all outputs"),
    "office_hour_sensitivity": ("Q_HC",),
    "hourly_sensitivity": ("whole series", "by hour of the day", "by hour and month"),
    "screening": ("Errors at the meter", "Errors by the month", "Parameters against the error",
                  "Where the best points lie", "gas: training and held_out", "A typical week: gas",
                  "Energy signature: gas", "Load-duration curve: gas", "Bills: bills"),
    "grid": ("Nearest point of each stage", "Errors of the points", "Values tried and kept", "What matters",
             "what became of the parameters"),
    "optimisation": ("Front: electricity and gas", "Where they lie in their ranges", "Targets"),
    "one_objective": ("The best point so far", "Where the best point lies", "Energy signature: gas"),
    "stages": ("Values by stage", "Errors before and after", "How large the errors are", "A typical week: air, may",
               "Duration curve: air, may", "Readings within", "Values"),
    "posterior": ("Before and after the data", "Pairs", "Traces", "Rank histograms", "Unknowns", "Errors: CV(RMSE)",
                  "Readings among the draws", "A typical week: gas", "Energy signature: gas", "Bills: bills"),
    "kennedy_ohagan": ("Predictions at the field points", "Over the known inputs", "What the simulator lacks",
                       "Before and after the data", "Pairs", "Traces", "Unknowns"),
    "retrofit": ("Energy saved", "What each scenario saves", "Energy before and after", "Comfort"),
}


def titles(section):
    return [one.title for part in section.parts for one in part.pictures + part.tables]


def run(*words):
    return subprocess.run([ROOT / "scripts" / "result_report", *words], capture_output=True, text=True)


class EveryKind(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.file = fake_results.write(cls.folder / "made.h5")
        cls.result = stored.read(cls.file)
        cls.sections = page.sections_of(cls.result)
        cls.html = page.html_of(cls.result, cls.sections)
        cls.page = Page(cls.html)

    def of(self, name):
        return next(section for section in self.sections if section.name == name)

    def test_each_kind_of_a_job_has_a_row_in_the_table(self):
        kinds_made = {study.kind for study in self.result.studies}
        self.assertEqual(kinds_made | {"loop"}, set(kinds.KINDS))
        if os.access(PROGRAM, os.X_OK):
            said = subprocess.run([PROGRAM, "describe", "job"], capture_output=True, text=True, check=True).stdout
            words = re.search(r"\n  kind +required +one of (sensitivity, [a-z_, ]+)", said).group(1)
            self.assertEqual(set(words.split(", ")), set(kinds.KINDS))

    def test_what_the_table_asks_for_is_in_the_layout(self):
        if not os.access(PROGRAM, os.X_OK):
            self.skipTest("no program")
        said = subprocess.run([PROGRAM, "describe", "results"], capture_output=True, text=True, check=True).stdout
        known = {line.split()[0] for line in said.splitlines() if line}
        asked = {name for kind in kinds.KINDS.values() for part in kind.parts for name in part.needs}
        self.assertEqual(asked - known, set())
        with h5py.File(self.file) as file:
            leaves = set()
            file.visititems(lambda name, item: leaves.add(name) if isinstance(item, h5py.Dataset) else None)
        made = {name.rpartition("/")[2] for name in leaves if "/posterior/posterior/" not in name
                and not re.search(r"/(posterior|prior)/[^/]*$", name)}
        self.assertEqual(made - known, set())

    def test_every_study_has_its_pictures_and_tables(self):
        for name, words in PICTURES.items():
            there = titles(self.of(name))
            for word in words:
                self.assertTrue(any(word in title for title in there), f"{name}: {word} is not among {there}")

    def test_nothing_sound_is_told_as_damaged(self):
        self.assertNotIn(DAMAGE, self.html)
        self.assertNotIn("Damaged", self.html)

    def test_every_study_begins_with_its_answer(self):
        for section in self.sections:
            self.assertGreater(len(section.answer), 20, section.name)
            self.assertTrue(section.answer.endswith("."), section.answer)
        self.assertIn("What matters most", self.of("sensitivity").answer)
        self.assertIn("The nearest point misses electricity by 0.25 % and gas by 0.31 %. It has infiltration 0.55 1/h",
                      self.of("grid").answer)
        self.assertEqual(self.of("retrofit").answer, "Saved over 2015-01-01 to 2015-12-31 (365 days), with the 5 to 95 "
                         "% quantile: new windows 5500 kWh of gas (4950 to 6050); heat pump 22000 kWh of gas (19800 to "
                         "24200), but electricity rises by 5000 kWh (4500 to 5500) and too_cold by 5 h (4.5 to 5.5); "
                         "warmer nothing, but gas rises by 1100 kWh (990 to 1210).")
        self.assertEqual(self.of("posterior").answer, "Of 3 calibrated inputs the data narrow these: infiltration; "
                         "the data tell these only together with others: heat_capacity_of_the_second_mass; the data "
                         "say nothing of these: set_point.")

    def test_a_period_is_unseen_only_where_it_lies_apart_from_training(self):
        """Its readings from half a year earlier on, or no times at all."""
        study = next(study for study in self.result.studies if study.kind == "screening")
        self.assertIn("CV(RMSE) in held_out, which it has not seen, went so", answers.answer(study))

        def moved(seconds):
            return {path: values + seconds if path.startswith("held_out/") and path.endswith("/time") else values
                    for path, values in study.values.items()}
        for values, words in ((moved(-180 * meters.DAY), "in held_out, which overlaps training, went so"),
                              ({path: each for path, each in study.values.items() if not path.endswith("/time")},
                               "in held_out went so")):
            said = answers.answer(stored.Study(study.path, study.kind, values, periods=study.periods))
            self.assertIn(words, said)

    def test_stages_are_told_before_and_after_without_what_stands_beside(self):
        """All parameters at once and other studies are versions too, behind those of the stages."""
        section = self.of("stages")
        alts = {one.title: one.alt for one in section.pictures}
        self.assertIn("in may from 0.60 to 0.30 K", section.answer)
        self.assertIn("infiltration 0.12; set_point 18.4; heat_capacity", alts["Values by stage"])
        self.assertIn("may, air from 0.6 (before) to 0.3 (after)", alts["Errors before and after"])
        self.assertIn("may half below 0.2", alts["How large the errors are"])
        within = next(table for part in section.parts for table in part.tables if table.title.startswith("Readings"))
        self.assertIn(["may", "air", "50", "80", "50", "80"], within.rows)
        largest = alts["Duration curve: air, may"]
        self.assertRegex(largest, r"measured \S+ °C, before \S+ °C, after \S+ °C\.")

    def test_every_picture_says_in_words_what_it_shows(self):
        pictures = [one for section in self.sections for one in section.pictures]
        self.assertEqual(len(self.page.images), len(pictures))
        for section in self.sections:
            alts = [one.alt for one in section.pictures]
            self.assertEqual(len(set(alts)), len(alts), section.name)
        for one in pictures:
            self.assertGreater(len(one.alt), 40, one.alt)
            self.assertNotRegex(one.alt, r"(?i)\b(nan|inf|none)\b")
        self.assertNotRegex(self.page.text, r"(?i)\b(nan|inf)\b")

    def test_the_page_needs_nothing_else_and_is_small(self):
        self.assertEqual(self.page.open, [])
        for reference in self.page.references:
            self.assertRegex(reference, "^(data:|#)")
        bare = re.sub(r"data:[^\"]*", "", self.html)
        for request in ("http:", "https:", "@import", "url(", "<script", "<link"):
            self.assertNotIn(request, bare)
        self.assertLess(len(self.html), 3e6)

    def test_no_words_lie_beyond_their_picture(self):
        """As far as it can be told without a font."""
        n = 0
        for section in self.sections:
            for one in section.pictures:
                width, height = (float(number) for number in re.search(r'viewBox="0 0 (\S+) (\S+)"', one.svg).groups())
                for begin, line, end_of in words_in(one.svg):
                    where = f"{section.name}: {one.title}: {begin:.0f} to {end_of:.0f} of {width:.0f}"
                    self.assertGreaterEqual(begin, -2, where)
                    self.assertLessEqual(end_of, width + 2, where)
                    self.assertTrue(0 <= line <= height + 1, where)
                    n += 1
        self.assertGreater(n, 500)

    def test_the_same_file_gives_the_same_bytes(self):
        self.assertEqual(page.html_of(stored.read(self.file)), self.html)

    def test_figures_are_files_that_stand_alone(self):
        out, figures = self.folder / "a.html", self.folder / "figures"
        done = run(self.file, out, "--stage", "office/grid", "--stage", "office/screening", "--figures", figures)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        names = sorted(path.name for path in figures.iterdir())
        self.assertEqual(len(names), len(Page(out.read_text(encoding="utf-8")).images))
        self.assertIn("grid-values-tried-and-kept.svg", names)
        for path in figures.iterdir():
            svg = path.read_text(encoding="utf-8")
            self.assertTrue(svg.startswith("<?xml"))
            self.assertNotIn("var(--", svg)
            self.assertIn("<title>", svg)
            for marker in theme.COLOURS:
                self.assertNotIn(marker, svg)

    def test_a_stage_or_a_building_can_be_chosen(self):
        self.assertEqual([study.name for study in stored.read(self.file, ["office/grid"]).studies], ["grid"])
        self.assertEqual(len(stored.read(self.file, ["office"]).studies), len(fake_results.STUDIES))
        done = run(self.file, self.folder / "b.html", "--stage", "shop/grid")
        self.assertEqual(done.returncode, 65)
        self.assertIn("has no study shop/grid; those that it has: office/", done.stderr)
        self.assertFalse((self.folder / "b.html").exists())

    def test_the_result_is_never_written_over(self):
        before = self.file.read_bytes()
        done = run(self.file, self.file)
        self.assertEqual(done.returncode, 64)
        self.assertIn("is the result itself", done.stderr)
        self.assertEqual(self.file.read_bytes(), before)

    def test_what_a_study_lacks_is_left_out(self):
        """Half of the datasets away, in as many ways as tell all of them apart: nothing ends."""
        for study in self.result.studies:
            for bit in range(len(study.values).bit_length()):
                for side in (0, 1):
                    half = {path: values for k, (path, values) in enumerate(sorted(study.values.items()))
                            if (k >> bit) & 1 == side}
                    lean = stored.Study(study.path, study.kind, half, study.units, outdoor=study.outdoor,
                                        periods=study.periods)
                    with unittest.mock.patch.object(theme, "svg_of", lambda drawn: "<svg>"):
                        section = page.section_of(lean, study.name)
                    self.assertTrue(section.parts or section.remarks, study.name)

    def test_a_study_all_of_which_failed_has_no_empty_pictures(self):
        """What follows from simulations is NaN then."""
        for study in self.result.studies:
            failed = {path: values if isinstance(values, list) or path.rpartition("/")[2] in OF_THE_JOB
                      else np.full_like(values, np.nan) for path, values in study.values.items()}
            section = page.section_of(stored.Study(study.path, study.kind, failed, study.units,
                                                   outdoor=study.outdoor, periods=study.periods), study.name)
            self.assertEqual(section.pictures, [], study.name)
            self.assertEqual([part.sentences for part in section.parts], [], study.name)
            self.assertTrue(section.remarks, study.name)

    def test_damage_in_one_study_is_a_sentence_and_the_others_stay(self):
        file = fake_results.write(self.folder / "damaged.h5", ("grid", "sensitivity"))
        with h5py.File(file, "a") as stored_file:
            del stored_file["office/grid/stage_points"]
            stored_file.create_dataset("office/grid/stage_points", (1 << 40,), "f8", chunks=(1024,))
        out = self.folder / "damaged.html"
        done = run(file, out)
        self.assertEqual(done.returncode, 0, done.stderr)
        text = Page(out.read_text(encoding="utf-8")).text
        self.assertIn("Damaged: this study cannot be read", text)
        self.assertIn("more than the file can hold", text)
        self.assertIn("Total order of all outputs", text)

    def test_numbers_that_do_not_fit_are_a_sentence(self):
        file = fake_results.write(self.folder / "unfit.h5", ("sensitivity",))
        with h5py.File(file, "a") as stored_file:
            del stored_file["office/sensitivity/total_order"]
            stored_file["office/sensitivity/total_order"] = [1.0, 2.0]
        done = run(file, self.folder / "unfit.html")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(DAMAGE, (self.folder / "unfit.html").read_text(encoding="utf-8"))
        self.assertNotIn("Traceback", done.stderr)

    def test_a_file_without_a_study_is_refused(self):
        with h5py.File(self.folder / "empty.h5", "w") as file:
            fake_loop_result.text(file.create_group("stock"), "kind", "stock")
        done = run(self.folder / "empty.h5", self.folder / "empty.html")
        self.assertEqual(done.returncode, 65)
        self.assertIn("has no finished study with pictures", done.stderr)

    def test_what_fell_short_or_failed_is_told_first(self):
        text = self.page.text
        self.assertIn("Falls short: not converged: rank R-hat is up to 1.9.", text)
        self.assertIn("Failed: 2 simulations.", text)

    def test_a_loop_stands_among_the_others(self):
        file = fake_results.write(self.folder / "with_loop.h5", ("sensitivity",))
        fake_loop_result.write(self.folder / "loop.h5", channels={"gas": "kWh"})
        with h5py.File(file, "a") as both, h5py.File(self.folder / "loop.h5") as loop:
            loop.copy("office/loop", both["office"])
        sections = page.sections_of(stored.read(file))
        self.assertEqual([section.name for section in sections], ["loop", "sensitivity"])
        names = [name for name, _ in page.figures_of(sections)]
        self.assertIn("loop-gas-autocorrelation.svg", names)
        self.assertIn("loop-energy-signature-gas.svg", names)
        self.assertEqual(len(names), len(set(names)))


def words_in(svg):
    """(where it begins, its line, where it ends) of every text that lies level."""
    before = {"start": 0, "middle": 0.5, "end": 1}
    for style, place, words in re.findall(r'<text style="([^"]*)"([^>]*)>([^<]*)</text>', svg):
        turned = re.search(r"rotate\((-?[\d.]+)", place)
        if turned and float(turned.group(1)) % 360:
            continue
        at = re.search(r"translate\((\S+) (\S+)\)", place) or re.search(r'x="(\S+)" y="(\S+)"', place)
        x, y = (float(number) for number in at.groups())
        long = LETTER * float(re.search(r"([\d.]+)px", style).group(1)) * len(words)
        anchor = re.search(r"text-anchor: (\w+)", style)
        begin = x - before[anchor.group(1) if anchor else "start"] * long
        yield begin, y, begin + long


class Numbers(unittest.TestCase):
    def test_of_very_many_points_a_sample_is_read_and_the_best_one_stays(self):
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch.object(stored, "MOST_POINTS", 150):
            study = stored.read(fake_results.write(pathlib.Path(folder) / "many.h5", ("screening",))).studies[0]
        self.assertEqual({len(study.numbers(name)) for name in ("points", "score", "cv_rmse")}, {134})
        self.assertEqual(len(study.numbers("training/gas/measured")), 8760)
        drawn = list(screening.parameters(study))
        self.assertIn("Of 400 points 134 were read", drawn[0].caption)
        best = 100 * study.numbers("best_cv_rmse")[0, :, 0]
        said = next(one for one in screening.held_out(study) if one.title.startswith("gas")).alt
        self.assertIn(f"the best point has {best[0]:.1f} and {best[1]:.1f} %", said)

    def test_a_number_has_the_digits_that_its_standard_deviation_knows(self):
        self.assertEqual(report_words.plus_minus(496461.2, 23324), "496000 ± 23000")
        self.assertEqual(report_words.plus_minus(2.0, 0.19), "2.00 ± 0.19")
        self.assertEqual(report_words.plus_minus(-0.00279, 0.00204), "−0.0028 ± 0.0020")
        self.assertEqual(report_words.plus_minus(10.0, 0.0997), "10.00 ± 0.10")
        self.assertEqual(report_words.plus_minus(0, 0.016), "0.000 ± 0.016")
        self.assertEqual(report_words.plus_minus(1.5, 0), "1.5 ± 0")
        self.assertEqual(report_words.number(1.34e6), "1340000")

    def test_units_and_texts_of_the_program_have_the_signs_of_a_page(self):
        self.assertEqual(report_words.unit_said("W/(m2 K)"), "W/(m² K)")
        self.assertEqual(report_words.unit_said("1/(K)"), "1/K")
        self.assertEqual(picture.unit_words("degC"), " [°C]")
        self.assertEqual(picture.unit_words("of the runs"), "")
        self.assertEqual(report_words.said("above 15 degC at 400 W/m2 (correlation -0.96), 2022-08-12, T-2"),
                         "above 15 °C at 400 W/m² (correlation −0.96), 2022-08-12, T-2")

    def test_best_points_give_no_probability(self):
        with tempfile.TemporaryDirectory() as folder:
            study = stored.read(fake_results.write(pathlib.Path(folder) / "made.h5", ("retrofit",))).studies[0]
        said = list(savings.table(study))
        self.assertEqual((len(said), said[0].head[3][0]), (2, "5 to 95 % quantile"))
        self.assertIn("not what the model gets wrong", said[1])
        study.kinds = {"office/posterior": "screening"}
        table, sentence = savings.table(study)
        self.assertEqual(table.head[3][0], "5 to 95 % of the best points")
        self.assertIn("not a probability", sentence)

    def test_a_median_error_beyond_the_levels_is_told_as_beyond_them(self):
        level, shares = np.array([0.1, 1.0, 5.0]), np.array([0.2, 0.5, 0.9])
        self.assertEqual(staged.half_below(shares, level), "half below 1")
        self.assertEqual(staged.half_below(shares / 2, level), "fewer than half below 5")

    def test_what_rounding_leaves_is_no_saving(self):
        with tempfile.TemporaryDirectory() as folder:
            study = stored.read(fake_results.write(pathlib.Path(folder) / "made.h5", ("retrofit",))).studies[0]
        rows = [row for row in next(savings.table(study)).rows if row[0] == "as is"]
        self.assertEqual([row[2:4] for row in rows], [["0", "0 to 0"]] * 4)
        study.values["scenario"], study.values["saving_quantile"] = ["as is"], study.values["saving_quantile"][:1]
        self.assertEqual(answers.answer(study),
                         "No scenario changes anything over 2015-01-01 to 2015-12-31 (365 days).")

    def test_a_saving_at_one_point_has_no_interval(self):
        with tempfile.TemporaryDirectory() as folder:
            study = stored.read(fake_results.write(pathlib.Path(folder) / "made.h5", ("retrofit",))).studies[0]
        study.values["points"] = np.ones((1, 3))
        self.assertIn("): new windows 5500 kWh of gas; heat pump 22000 kWh of gas, but electricity rises by 5000 kWh "
                      "and too_cold by 5 h;", answers.answer(study))

    def test_the_size_of_residuals_says_what_it_is_of(self):
        """Kelvins of a temperature, a share of the mean of anything else; it is stored without a unit."""
        names = [f"{meter}_{part}" for meter in ("gas", "room") for part in ("constant", "share", "timescale")]
        study = stored.Study("b/p", "posterior", {
            "unknown": ["wall", *names], "unknown_unit": ["W/(m2 K)", *["-", "-", "readings"] * 2],
            "data_finding": ["determined"] * 7, "training/gas/measured": np.ones(3),
            "training/room/measured": np.ones(3), "training/gas/all/validation_fit": np.ones(1),
            "training/room/all/validation_fit": np.ones(1), "training/gas/all/metric": ["n"],
            "training/room/all/metric": ["n"]}, {"training/gas/measured": "kWh", "training/room/measured": "degC"})
        units = chains.units_of(study)
        self.assertEqual([units["gas_constant"], units["room_constant"]], ["-", "K"])
        said, = chains.meanings(study.texts("unknown"))
        for words in ("as a share of the mean reading", "of a temperature in K", "METER_share", "METER_timescale"):
            self.assertIn(words, said)
        self.assertEqual(answers.answer(study), "Of 1 calibrated input the data narrow these: wall.")

    def test_indices_of_hours_are_weighted_by_their_variance(self):
        cells = sobol.weighted(np.array([[0.2], [0.8], [np.nan]]), np.array([1.0, 3.0, 5.0]), np.array([0, 0, 1]), 3)
        np.testing.assert_allclose(cells[0], [0.65])
        self.assertTrue(np.isnan(cells[1:]).all())

    def test_days_of_the_signature_are_whole_and_sums(self):
        time = 3600 * np.arange(48.0)
        measured = np.ones(48)
        measured[30:] = np.nan
        meter = meters.Meter("gas", "p", "kWh", time, measured, {"best": np.ones(48)}, np.arange(48.0), np.array([]))
        energy, outdoor = meters.daily(meter, measured)
        np.testing.assert_allclose([*energy, *outdoor], [24, 11.5])

    def test_outdoor_temperature_is_the_mean_of_the_step(self):
        hours = (3600 * np.arange(48.0), np.arange(48.0))
        np.testing.assert_allclose(meters.at_steps(hours, np.array([0.0, 86400.0]), 86400), [11.5, 35.5])
        np.testing.assert_allclose(meters.at_steps(hours, np.array([0.0, 1800.0, 3600.0]), 1800), [0, 0, 1])

    def test_the_place_of_a_meter_is_read_from_its_path(self):
        self.assertEqual(meters.place_of("training/gas"), ("", "training", "gas"))
        self.assertEqual(meters.place_of("gd_01/judged/heat"), ("gd_01", "judged", "heat"))
        self.assertEqual(meters.place_of("validation/may/periods/may/air"), ("validation/may", "may", "air"))

    def test_a_long_name_keeps_its_begin_and_end(self):
        self.assertEqual(picture.short("a" * 24), "a" * 24)
        said = picture.short("second_mass_conductance_of_the_floor")
        self.assertLessEqual(len(said), 24)
        self.assertTrue(said.startswith("second_mass") and said.endswith("the_floor"))


if __name__ == "__main__":
    unittest.main()
