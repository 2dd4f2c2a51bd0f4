#!/usr/bin/python3
"""The package in scripts/python: jobs keep their letters, data frames their hours, results their numbers, and what
goes wrong is a bemcal.Error with the program's message and exit code."""
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
import warnings

try:
    import h5py
    import numpy as np
    import pandas as pd
    import tomlkit
    import xarray
except ImportError as lacking:
    print(f"{lacking}: skipped")
    sys.exit(77)

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "scripts" / "python"
QUICKSTART = ROOT / "jobs" / "quickstart"
sys.path.insert(0, str(PACKAGE))

import bemcal  # noqa: E402
from bemcal import ExitCode, program, readings, result  # noqa: E402

JOB = """# A job.
seed = 1        # of all

[[meter]]
name = "gas"    # by hand
quantity = "gas"
file = "old.csv"
column = "old"
time_format = "%d.%m.%Y"
unit = "kWh"

# Below stands what is uncertain.
[[parameter]]
name = "u"      # of walls
min = 1
max = 2
"""
ALTERNATE = """[[zone]]
name = "office"
[[zone.surface]]
area = 1
# glass
[[zone.window]]
area = 2
[[zone.surface]]    # the second
area = 3
"""
HOURS = pd.date_range("2021-01-01", periods=48, freq="h")


def reals(index, seed=1):
    """Readings that look like none of the faults that the program corrects."""
    return pd.Series(np.random.default_rng(seed).uniform(20, 60, len(index)).round(3), index)


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def assertRefused(self, code, pattern, work, *arguments, **more):
        with self.assertRaisesRegex(bemcal.Error, pattern) as caught:
            work(*arguments, **more)
        self.assertEqual(caught.exception.code, code)
        return caught.exception


class Jobs(Folder):
    def test_shipped_jobs_are_the_same_to_the_letter_and_as_dictionaries(self):
        files = [file for file in sorted((ROOT / "jobs").glob("*/*.toml")) if "@" not in file.read_text()]
        self.assertGreater(len(files), 20)
        for file in files:
            with self.subTest(file.name):
                text = file.read_bytes().decode()
                job = bemcal.Job.read(file)
                self.assertEqual(job.to_toml(), text)
                self.assertEqual(job.to_dict(), tomllib.loads(text))
                self.assertEqual(tomllib.loads(bemcal.Job(job.to_dict()).to_toml()), tomllib.loads(text))

    def test_what_is_changed_leaves_comments_and_order_as_they_are(self):
        job = bemcal.Job.from_toml(JOB)
        job["seed"] = np.int64(2)
        job.put("parameter.u", max=3, prior={"kind": "normal", "mean": 1.5, "sd": 0.2})
        job.add("meter", name="cold", quantity="cooling", unit="kWh")
        expected = JOB.replace("seed = 1 ", "seed = 2 ").replace("max = 2\n", "max = 3\nprior = {kind = \"normal\", "
                                                                 "mean = 1.5, sd = 0.2}\n")
        expected = expected.replace("\n# Below", "[[meter]]\nname = \"cold\"\nquantity = \"cooling\"\nunit = \"kWh\"\n"
                                    "\n# Below")
        self.assertEqual(job.to_toml(), expected)

    def test_tables_of_two_lists_that_alternate_are_not_lost(self):
        self.assertNotEqual(tomlkit.dumps(tomlkit.parse(ALTERNATE)), ALTERNATE)     # which is why they are put together
        job = bemcal.Job.from_toml(ALTERNATE)
        self.assertEqual(job.to_toml(), ALTERNATE)
        self.assertEqual(job.to_dict(), tomllib.loads(ALTERNATE))
        job["seed"] = 1
        self.assertEqual(tomllib.loads(job.to_toml()), {"seed": 1, **tomllib.loads(ALTERNATE)})
        self.assertIn("# glass\n[[zone.window]]", job.to_toml())
        self.assertIn("[[zone.surface]]    # the second", job.to_toml())

    def test_adopt_does_not_lose_them_either(self):
        (self.folder / "job.toml").write_text(ALTERNATE)
        words = f"import importlib.machinery as m; print(m.SourceFileLoader('adopt', '{ROOT}/scripts/adopt')" \
                f".load_module().read_job('{self.folder}/job.toml').unwrap())"
        done = subprocess.run([sys.executable, "-B", "-c", words], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.strip(), str(tomllib.loads(ALTERNATE)))

    def test_a_dictionary_becomes_sections_and_what_toml_does_not_know_is_named(self):
        zone = {"name": "office", "set_point": {"value": np.float64(21)}, "surface": [{"area": 1}]}
        job = bemcal.Job({"zone": [zone], "seed": 1, "site": {"latitude": 50},
                          "periods": {"training": [pd.Timestamp(2021, 1, 1).date()]}})
        self.assertEqual(job.to_dict()["periods"], {"training": ["2021-01-01"]})
        self.assertIn("[site]\nlatitude = 50", job.to_toml())
        self.assertIn("set_point = {value = 21.0}", job.to_toml())
        self.assertEqual(job.at("zone.office")["surface"][0]["area"], 1)
        self.assertRefused(ExitCode.CONFIG, "object.*expected what TOML knows", bemcal.Job, {"seed": object()})
        self.assertRefused(ExitCode.CONFIG, "is no TOML", bemcal.Job.from_toml, "seed = \n")
        self.assertRefused(ExitCode.USAGE, "no 'shop'; expected one of 'office'", job.at, "zone.shop")
        self.assertRefused(ExitCode.USAGE, "no list of tables", job.add, "site", latitude=1)
        self.assertRefused(ExitCode.NO_INPUT, "No such file", bemcal.Job.read, self.folder / "none.toml")

    def test_midnights_are_days_which_a_period_includes(self):
        def written(*times):
            return bemcal.Job({"periods": {"training": list(times)}})["periods"]["training"]
        first, last = pd.Timestamp("2021-01-01"), pd.Timestamp("2021-12-31")
        days = ["2021-01-01", "2021-12-31"]
        for kind in (pd.Timestamp, pd.Timestamp.date, pd.Timestamp.to_pydatetime, pd.Timestamp.to_datetime64,
                     lambda day: np.datetime64(day, "D")):
            self.assertEqual(written(kind(first), kind(last)), days)
        job = bemcal.Job({"periods": {"training": np.array(days, "datetime64[ns]")}, "meter": [{"name": "gas"}]})
        job.put("meter.gas", scale=[{"from": first, "to": last, "factor": 2}])
        self.assertEqual(job["periods"]["training"], days)
        self.assertEqual(job.at("meter.gas")["scale"], [{"from": days[0], "to": days[1], "factor": 2}])
        self.assertEqual(written(first, last + pd.Timedelta("12h")), ["2021-01-01 00:00:00", "2021-12-31 12:00:00"])
        for zone in ("UTC", "Europe/Berlin"):       # which the program refuses
            self.assertRegex(written(last.tz_localize(zone))[0], r"2021-12-31 00:00:00\+0[01]:00")
        for missing in (pd.NaT, np.datetime64("NaT")):
            self.assertRefused(ExitCode.CONFIG, "NaT.*expected what TOML knows", written, first, missing)
            self.assertRefused(ExitCode.CONFIG, "NaT.*expected what TOML knows", bemcal.Job, {"seed": missing})

    def test_a_list_of_tables_may_be_emptied_and_filled_again(self):
        job = bemcal.Job.from_toml("seed = 1\n\n[[meter]]\nname = \"gas\"\n\n[plant]\nheating_carrier = \"gas\"\n")
        job["meter"] = []
        job.add("meter", name="heat")
        job.add("study", kind="loop")
        job["plant"] = 1        # no job, but TOML
        self.assertEqual(tomllib.loads(job.to_toml()),
                         {"seed": 1, "plant": 1, "meter": [{"name": "heat"}], "study": [{"kind": "loop"}]})
        self.assertIn("\n\n[[study]]", job.to_toml())
        job = bemcal.Job({"meter": [], "seed": 1})
        job.add("meter", name="heat")
        self.assertEqual(job.to_toml(), "seed = 1\n\n[[meter]]\nname = \"heat\"\n")

    def test_a_meter_gets_another_file_and_loses_only_how_the_old_one_was_read(self):
        job = bemcal.Job.from_toml(JOB)
        job.meter("gas", reals(HOURS), unit="MWh", zeros="keep")
        path = job.save(self.folder / "a b.toml")
        text = path.read_text()
        self.assertIn('file = "a b_gas.csv"\ncolumn = "gas"\nunit = "MWh"\nstamp = "start"\nzeros = "keep"\n', text)
        self.assertNotIn("time_format", text)
        self.assertIn('name = "gas"    # by hand', text)
        written = pd.read_csv(self.folder / "a b_gas.csv", index_col="time", parse_dates=True)["gas"]
        np.testing.assert_array_equal(written, reals(HOURS))

    def test_nothing_is_written_over_unless_it_is_said(self):
        job = bemcal.Job.from_toml(JOB)
        job.meter("gas", reals(HOURS), unit="kWh")
        (self.folder / "job_gas.csv").write_text("mine")
        self.assertRefused(ExitCode.CANNOT_CREATE, "job_gas.csv: is there already", job.save, self.folder / "job.toml")
        self.assertFalse((self.folder / "job.toml").exists())
        job.save(self.folder / "job.toml", force=True)
        self.assertNotEqual((self.folder / "job_gas.csv").read_text(), "mine")
        self.assertEqual(sorted(os.listdir(self.folder)), ["job.toml", "job_gas.csv"])
        job.meter("a b", reals(HOURS), unit="kWh", quantity="gas")
        job.meter("a_b", reals(HOURS), unit="kWh", quantity="gas")
        self.assertRefused(ExitCode.CANNOT_CREATE, "twice", job.save, self.folder / "twice.toml")

    def test_a_file_that_another_section_reads_stays(self):
        job = bemcal.Job.from_toml(JOB + '[[meter]]\nname = "other"\nfile = "job_gas.csv"\n')
        (self.folder / "job_gas.csv").write_text("mine")
        job.meter("gas", reals(HOURS), unit="kWh")
        self.assertRefused(ExitCode.CANNOT_CREATE, "job_gas.csv: is read by another", job.save,
                           self.folder / "job.toml", force=True)
        self.assertEqual((self.folder / "job_gas.csv").read_text(), "mine")
        del job["meter"]
        self.assertEqual(os.listdir(job.save(self.folder / "new" / "job.toml").parent), ["job.toml"])

    def test_files_are_found_from_another_folder(self):
        job = bemcal.Job.read(QUICKSTART)
        bemcal.check(job.save(self.folder / "moved" / "job.toml"))
        self.assertEqual(bemcal.Job.read(QUICKSTART).to_toml(), (QUICKSTART / "quickstart.toml").read_text())

    def test_a_job_that_is_not_as_its_file_has_it_is_not_run(self):
        job = bemcal.Job.from_toml(JOB)
        self.assertRefused(ExitCode.USAGE, "no file yet", bemcal.run, job)
        job.save(self.folder / "job.toml")
        self.assertEqual(job.file(), self.folder / "job.toml")
        job["seed"] = 2
        self.assertRefused(ExitCode.USAGE, "is not as .*job.toml has it", bemcal.check, job)
        job.save(force=True)
        job.meter("gas", reals(HOURS), unit="kWh")
        self.assertRefused(ExitCode.USAGE, "is not as .*job.toml has it", bemcal.check, job)


class Frames(Folder):
    def meter(self, data, **keys):
        job = bemcal.Job({"seed": 1})
        job.meter("gas", data, unit="kWh", **keys)
        text = job.save(self.folder / "job.toml", force=True).with_name("job_gas.csv").read_text()
        return text.splitlines()

    def refuse(self, pattern, data, **keys):
        return self.assertRefused(ExitCode.DATA, "^meter gas: .*" + pattern, self.meter, data, **keys)

    def test_missing_values_are_empty_cells_and_numbers_are_whole(self):
        data = pd.Series([0.1 + 0.2, np.nan, 1e-7], HOURS[:3])
        self.assertEqual(self.meter(data), ["time,gas", f"2021-01-01 00:00:00,{0.1 + 0.2!r}", "2021-01-01 01:00:00,",
                                            "2021-01-01 02:00:00,1e-07"])

    def test_stamps_keep_their_offset_through_a_change_of_summer_time(self):
        stamps = pd.date_range("2021-03-28 01:00", periods=2, freq="h", tz="Europe/Berlin")
        self.assertEqual([line[:25] for line in self.meter(pd.Series([1.0, 2], stamps))[1:]],
                         ["2021-03-28 01:00:00+01:00", "2021-03-28 03:00:00+02:00"])

    def test_months_are_dates_and_periods_their_begins(self):
        months = pd.period_range("2021-01", periods=3, freq="M")
        lines = self.meter(pd.Series([1.0, 2, 3], months), interval="monthly")
        self.assertEqual(lines[1:], ["2021-01-01,1.0", "2021-02-01,2.0", "2021-03-01,3.0"])
        ends = pd.Series([1.0, 2, 3], pd.to_datetime(["2021-01-31", "2021-02-28", "2021-03-31"]))
        self.refuse("last days of months", ends, interval="monthly")
        for stamp in ("start", "end"):
            self.assertEqual(self.meter(ends, interval="monthly", stamp=stamp)[1], "2021-01-31,1.0")
        self.refuse("are months or bills", ends)
        weeks = pd.Series([1.0] * 28, pd.date_range("2021-01-04", periods=28)).resample("W").sum()
        self.refuse("rows are weeks", weeks)
        self.refuse("rows are weeks", weeks, stamp="end")
        for said in (self.meter(weeks.to_period("W")), self.meter(weeks.set_axis(weeks.index - pd.Timedelta("6D")),
                                                                  stamp="start")):
            self.assertEqual(said[1], "2021-01-04 00:00:00,7.0")

    def test_steps_that_differ_are_refused_and_rows_that_lack_are_not(self):
        data = reals(HOURS)
        self.assertEqual(len(self.meter(data.drop(HOURS[5:9]))), 1 + 44)
        self.assertEqual(len(self.meter(data.set_axis(HOURS.map(lambda t: t + pd.Timedelta("4min"))))), 1 + 48)
        moved = HOURS.to_numpy().copy()
        moved[7] += np.timedelta64(5, "m")          # a twelfth of the step, which the program moves
        self.assertEqual(len(self.meter(data.set_axis(moved))), 1 + 48)
        moved[7] += np.timedelta64(1, "m")
        self.refuse(r"2021-01-01 07:06:00 comes .*01:06:00 after .*resample\('[Hh]'\)",
                    data.set_axis(moved))

    def test_what_a_file_would_hide_is_refused(self):
        data = reals(HOURS)
        self.refuse("expected a DatetimeIndex", data.reset_index(drop=True))
        self.refuse(r"NaT.*: 2 of 48, the first in row 3,.*data\[data.index.notna\(\)\]",
                    data.set_axis([*HOURS[:3], pd.NaT, pd.NaT, *HOURS[5:]]))
        self.refuse("has no rows", data.iloc[:0])
        self.refuse("infinite value at 2021-01-01 03:00", data.where(HOURS != HOURS[3], np.inf))
        self.refuse("no numbers", data.astype(object).where(HOURS != HOURS[3], "off"))
        self.refuse(r"2021-01-01 00:00:00 does not come after the row before it, .*sort_index", data.iloc[[1, 0, 2]])
        self.refuse("expected one of 'a', 'b'", pd.DataFrame({"a": data, "b": data}))
        self.refuse("is a list", [1, 2])
        wall = pd.date_range("2021-10-31", periods=6, freq="h", tz="Europe/Berlin").tz_localize(None)
        self.refuse("tz_localize", pd.Series(range(6), wall))
        self.assertEqual(len(self.meter(pd.Series(range(6), wall), clock="eu")), 1 + 6)

    def test_a_column_whose_name_comes_twice_is_refused(self):
        data = reals(HOURS)
        frame = pd.concat([data.rename("b"), data.rename("a"), data.rename("b")], axis=1)
        self.refuse(r"has 2 columns 'b', number 0, 2 counted from 0; .*columns.duplicated\(\)", frame, column="b")
        self.assertEqual(len(self.meter(frame, column="a")), 1 + 48)
        self.assertEqual(len(self.meter(frame.loc[:, ~frame.columns.duplicated()], column="b")), 1 + 48)
        self.refuse("has 3 columns 'hall'", pd.concat({"hall": frame}, axis=1), column="hall")
        weather = frame.set_axis(["outdoor_temperature", "global_horizontal", "outdoor_temperature"], axis=1)
        self.assertRefused(ExitCode.DATA, "^weather: has 2 columns 'outdoor_temperature'", bemcal.Job().weather,
                           weather, 52.5, 13.4, 1)

    def test_the_site_of_weather_needs_an_offset_that_its_zone_tells(self):
        stamps = pd.date_range("2021-07-01", periods=24, freq="h")
        data = pd.DataFrame({"outdoor_temperature": 20.0, "global_horizontal": 0.0}, stamps)

        def offset(zone):
            job = bemcal.Job()
            job.weather(data.tz_localize(zone), 52.5, 13.4)
            return job["site"]["utc_offset"]
        self.assertEqual(offset("Europe/Berlin"), 1)
        self.assertEqual(offset("Asia/Kolkata"), 5.5)
        self.assertEqual(offset("Australia/Sydney"), 10)
        self.assertRefused(ExitCode.DATA, "no time zone; expected local", offset, None)
        self.assertRefused(ExitCode.DATA, "is in UTC; expected local", offset, "UTC")
        self.assertRefused(ExitCode.DATA, "has none of the columns", bemcal.Job().weather, data[[]], 1, 1)
        self.assertRefused(ExitCode.DATA, "no column 'T'", bemcal.Job().weather, data, 1, 1,
                           columns={"outdoor_temperature": "T"})


class Hours(Folder):
    """What the program read is held against what was given, over both changes of summer time."""

    def test_every_clock_ends_at_the_right_hours_of_local_standard_time(self):
        standard = pd.date_range("2021-03-01", "2021-12-01", freq="h", inclusive="left")     # CET, UTC + 1
        given = reals(standard)
        given.iloc[1000] = np.nan
        berlin = given.tz_localize("Etc/GMT-1").tz_convert("Europe/Berlin")
        clocks = {"standard": (given, {"clock": "standard"}), "utc": (berlin.tz_convert("UTC"), {}),
                  "berlin": (berlin, {}), "wall": (berlin.tz_localize(None), {"clock": "eu"}),
                  "new_york": (berlin.tz_convert("America/New_York"), {}),
                  "ends": (berlin.set_axis(berlin.index + pd.Timedelta("1h")), {"stamp": "end"})}
        job = self.job(berlin.index)
        for name, (data, keys) in clocks.items():
            job.meter(name, data, unit="kWh", quantity="electricity", **keys)
        daily = berlin.resample("D").sum()      # of calendar days, of which two have 23 and 25 h
        job.meter("daily", daily, unit="kWh", quantity="electricity", interval="daily")
        read = self.run_(job)
        for period in ("training", "autumn"):
            for name in clocks:
                with self.subTest(name, period=period):
                    hours = read.hours(name, period, "screening")["measured"]
                    np.testing.assert_array_equal(hours, given[hours.index])
            days = read.hours("daily", period, "screening")["measured"]
            np.testing.assert_allclose(days, daily.tz_localize(None)[days.index])
            air = read[f"job/screening/{period}/hourly"]["outdoor_temperature"].to_series()
            np.testing.assert_allclose(air, self.air.set_axis(standard)[air.index])
        self.assertEqual(len(read.hours("utc", "training", "screening")), 61 * 24)

    def job(self, stamps):
        """A box; the sun shines by the hour of Berlin's standard time."""
        clock = stamps.tz_convert("Etc/GMT-1").hour.to_numpy()
        self.air = pd.Series(reals(stamps, 2) / 4, stamps)
        weather = pd.DataFrame({"air": self.air, "global_horizontal": 0.0, "diffuse_horizontal": 0.0}, stamps)
        weather.loc[(clock > 8) & (clock < 16), ["global_horizontal", "diffuse_horizontal"]] = 100.0
        job = bemcal.Job({
            "periods": {"training": ["2021-03-01", "2021-04-30"], "autumn": ["2021-10-01", "2021-11-30"]},
            "run": {"warm_up_days": 0}, "construction": [{"name": "wall", "u_value": 0.8}], "plant": {},
            "zone": [{"name": "box", "floor_area": 1000, "volume": 3000, "heating_set_point": 20,
                      "cooling_set_point": 26, "flow": [{"name": "infiltration", "air_change": 0.5}],
                      "surface": [{"construction": "wall", "area": 500, "azimuth": 180}],
                      "load": [{"name": "equipment", "density": 40, "carrier": "electricity"}]}],
            "study": [{"kind": "screening", "n_points": 8}],
            "parameter": [{"name": "u", "target": "construction.wall.u_value", "min": 0.5, "max": 1.5}]})
        sun = {name: {"column": name, "unit": "W/m2"} for name in ("global_horizontal", "diffuse_horizontal")}
        job.weather(weather, 52.5, 13.4, columns={"outdoor_temperature": "air", **sun})
        return job

    def run_(self, job):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", bemcal.NotReached)      # of readings that are random
            return bemcal.run(job.save(self.folder / "job.toml"), output=self.folder / "job.h5")


def small_job(path):
    """The quickstart with half a year, six parameters, and all of its studies that are quick."""
    job = bemcal.Job.read(QUICKSTART)
    job["periods"] = {"training": ["2021-01-01", "2021-06-30"], "held_out": ["2021-07-01", "2021-08-31"]}
    few = ["lights", "equipment", "base_load", "cooling_COP", "heating_set_point", "infiltration"]
    job["study"] = [
        {"kind": "screening", "n_points": 16},
        {"kind": "posterior", "sampler": "random_walk", "meters": ["electricity"], "parameters": few[:2],
         "n_chains": 2, "warm_up": 10, "draws_per_round": 10, "most_draws": 20, "n_predictive": 10},
        {"kind": "loop", "meters": ["electricity"], "parameters": few, "most_effects": 1, "try_structures": False,
         "functions": False, "generic": False}]
    return job.save(path)


class Runs(Folder):
    @classmethod
    def setUpClass(cls):
        cls.place = pathlib.Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.place)
        cls.job = small_job(cls.place / "small.toml")
        with warnings.catch_warnings(record=True) as cls.warned:
            warnings.simplefilter("always")
            cls.result = bemcal.run(cls.job, output=cls.place / "small.h5")
        cls.file = h5py.File(cls.result.path)
        cls.addClassCleanup(cls.file.close)

    def stored(self, path):
        dataset = self.file["small/" + path]
        return dataset.asstr()[()] if h5py.check_string_dtype(dataset.dtype) else dataset[()]

    def test_a_missed_target_is_a_warning_and_stands_in_the_result(self):
        warned = [each for each in self.warned if each.category is bemcal.NotReached]
        self.assertEqual(len(warned), 1)
        self.assertRegex(str(warned[0].message), "small/posterior: not converged")
        self.assertEqual(warned[0].filename, __file__)
        self.assertIn("small/posterior", self.result.shortfalls)

    def test_studies_have_kinds_and_datasets_names_in_place_of_axes(self):
        self.assertEqual(self.result.stages, {"small/loop": "loop", "small/posterior": "posterior",
                                              "small/screening": "screening"})
        best = self.result["screening"]["best_parameters"]
        self.assertEqual(best.dims, ("rank", "parameter"))
        self.assertEqual(list(best["parameter"].to_numpy()), list(self.stored("screening/parameter")))
        np.testing.assert_array_equal(best, self.stored("screening/best_parameters"))
        gas = self.result["small/loop/held_out/electricity"]["simulated"].sel(model="after", time="2021-07-02 05:00")
        self.assertEqual(float(gas), self.stored("loop/held_out/electricity/simulated")[2, 29])
        self.assertEqual(self.result["small/loop/held_out"]["outdoor_temperature"].attrs["units"], "degC")
        self.assertIn("small/loop/held_out", self.result)
        self.assertRefused(ExitCode.USAGE, "no study or group 'grid'; its studies are small/loop",
                           self.result.__getitem__, "grid")

    def test_groups_keep_their_attributes(self):
        run = self.result["run"].attrs
        self.assertEqual(run, {name: str(value) for name, value in self.file["run"].attrs.items()})
        self.assertEqual(run, self.result.run)
        self.assertGreater(len(run), 10)
        run.clear()
        self.assertEqual(self.result["run"].attrs, self.result.run)

    def test_a_group_is_found_below_the_only_study_of_a_name_or_kind(self):
        for short, group in {"posterior/training": "training", "loop/held_out/electricity": "held_out/electricity",
                             "posterior/posterior": "posterior"}.items():
            stage = short.split("/")[0]
            self.assertTrue(self.result[short].identical(self.result[f"small/{stage}/{group}"]))
        self.assertRefused(ExitCode.USAGE, "small/loop/later is not in .*; expected one of: small/loop/held_out, ",
                           self.result.__getitem__, "loop/later")
        self.assertRefused(ExitCode.USAGE, "no study or group 'grid/training'; its studies are small/loop",
                           self.result.__getitem__, "grid/training")
        opened = bemcal.open(self.result.path)
        opened._head.kinds["shop/posterior"] = "posterior"
        self.assertRefused(ExitCode.USAGE, "several studies 'posterior': small/posterior, shop/posterior",
                           opened.__getitem__, "posterior/training")

    def test_effects_are_those_of_the_file(self):
        effects = self.result.effects
        self.assertEqual(list(effects.index), list(self.stored("loop/effect")))
        self.assertEqual(len(effects), 1)
        for column in ("unit", "hook", "separates"):
            self.assertEqual(effects[column].iloc[0], self.stored(f"loop/effect_{column}")[0])
        self.assertEqual(self.stored("loop/effect_least")[0], self.stored("loop/effect_most")[0])     # hours: a choice
        self.assertTrue(effects[["coefficient", "least", "most"]].isna().all(axis=None))
        self.assertIs(bool(effects["adequate"].iloc[0]), bool(self.stored("loop/effect_adequate")[0]))
        brings = dict(zip(self.stored("loop/effect_value_of"), self.stored("loop/effect_value")))
        self.assertGreater(abs(brings["electricity"]), 0)
        self.assertEqual(effects["brings electricity [kWh]"].iloc[0], brings["electricity"])
        self.assertEqual(set(self.result.effect_values_of()["of"]), set(brings))
        members = self.stored("loop/effect_class_member")
        self.assertEqual(effects["not_told_from"].iloc[0], "; ".join(members[members != effects.index[0]]))

    def test_effects_of_the_same_name_are_told_apart(self):
        values = self.result.effect_values_of()
        self.assertEqual(list(values)[:6], ["effect", "of", "unit", "value", "least", "most"])
        self.assertEqual(set(values["follows"]), set(self.result.effects["follows"]))
        self.assertEqual(set(values["row"]), {0})
        opened = bemcal.open(self.result.path)
        opened._read["small/loop"] = self.with_its_effect_twice(opened["small/loop"])
        effects, values = opened.effects, opened.effect_values_of()
        self.assertEqual(effects.index[0], effects.index[1])
        self.assertEqual(list(effects["follows"]), ["days", "nights"])
        self.assertEqual(list(values["follows"]), ["days", "days", "days", "nights"])
        self.assertEqual(list(effects["brings electricity [kWh]"]), list(values["value"][[0, 3]]))
        self.assertTrue(np.isnan(effects["brings cost [currency]"].iloc[1]))        # which is left out
        joined = values.join(effects.reset_index()[["hook", "follows"]], on="row", rsuffix="_2")
        self.assertEqual(list(joined["follows"]), list(joined["follows_2"]))

    @staticmethod
    def with_its_effect_twice(loop):
        """The second brings only what the first value is of: three times as much."""
        loop = loop.isel(effect=[0, 0], effect_value=[0, 1, 2, 0])
        return loop.assign(effect_shape=("effect", ["days", "nights"]),
                           effect_value_effect=("effect_value", [0, 0, 0, 1]),
                           effect_value=loop["effect_value"] * xarray.DataArray([1, 1, 1, 3], dims="effect_value"))

    def test_measurements_are_those_of_the_file(self):
        measurements = self.result.measurements_of()
        for column, stored in (("question", "_question"), ("measure", ""), ("weeks", "_weeks"), ("then", "_then")):
            self.assertEqual(list(measurements[column]), list(self.stored(f"loop/measurement{stored}")))
        self.assertEqual(list(measurements["advised"]), list(self.stored("loop/measurement_advised") == 1))

    def test_errors_are_those_of_the_file_where_something_is_measured(self):
        errors, fit = self.result.errors, self.stored("loop/fit")
        self.assertEqual(list(errors.columns), ["plain", "before", "after"])
        self.assertEqual(errors.loc[("held_out", "electricity", "hourly", "cv_rmse"), "after"], fit[2, 1, 0, 0, 1])
        self.assertEqual(errors.loc[("training", "electricity", "monthly", "nmbe"), "plain"], fit[0, 0, 1, 0, 2])
        self.assertEqual(list(errors.index.names), ["period", "meter", "resolution", "metric"])
        self.assertEqual(len(errors), 2 * 2 * 4)

    def test_errors_of_a_screening_are_those_of_nominal_and_best(self):
        errors, fit = self.result.errors_of("screening"), self.stored("screening/fit")
        metric = list(self.stored("screening/metric")).index("cv_rmse")
        self.assertEqual(list(errors.columns), ["nominal", "best"])
        self.assertEqual(errors.loc[("held_out", "cooling", "interval", "cv_rmse"), "best"], fit[1, 1, 0, metric])
        self.assertEqual(errors.loc[("training", "heating", "monthly", "cv_rmse"), "nominal"],
                         self.stored("screening/monthly_fit")[0, 0, 1, metric])
        self.assertRefused(ExitCode.USAGE, "kind 'posterior'; expected a loop or a screening", self.result.errors_of,
                           "posterior")
        self.assertRefused(ExitCode.USAGE, "kind 'screening'; expected a loop", self.result.effects_of, "screening")

    def test_hours_have_readings_models_and_their_interval(self):
        hours = self.result.hours("electricity", "held_out")
        self.assertEqual(list(hours), ["measured", "plain", "before", "after", "predicted_q05", "predicted_q95"])
        self.assertEqual(hours.index[0], pd.Timestamp("2021-07-01"))
        self.assertEqual(len(hours), 62 * 24)
        readings_ = pd.read_csv(QUICKSTART / "measured_2021_2022.csv", index_col="time", parse_dates=True)
        measured = hours["measured"].dropna()
        np.testing.assert_array_equal(measured, readings_["electricity_kWh"][measured.index])
        np.testing.assert_array_equal(hours["before"], self.stored("loop/held_out/electricity/simulated")[1])
        self.assertEqual(list(self.result.hours("electricity", "training", "posterior"))[:3],
                         ["measured", "nominal", "predicted_mean"])
        self.assertEqual(list(self.result.hours("cooling", "training", "screening")), ["measured", "nominal", "best"])
        self.assertRefused(ExitCode.USAGE, "expected a meter and a period of: small/loop/held_out/electricity",
                           self.result.hours, "gas", "held_out")

    def test_draws_have_chain_and_draw_first_and_are_what_arviz_takes(self):
        groups = self.result.posterior()
        if not isinstance(groups, dict):
            self.assertEqual(groups.posterior["lights"].dims, ("chain", "draw"))
            return
        self.assertEqual(list(groups), list(result.DRAWS))
        for group in ("posterior", "sample_stats", "prior", "posterior_predictive"):
            for variable in groups[group].data_vars.values():
                self.assertEqual(variable.dims[:2], ("chain", "draw"))
        self.assertEqual(groups["posterior"]["lights"].shape, (2, 20))
        self.assertEqual(groups["posterior"]["lights"].attrs["units"], "W/m2")
        np.testing.assert_array_equal(groups["posterior"]["lights"], self.stored("posterior/posterior/lights"))
        self.assertEqual(groups["observed_data"]["electricity"]["time_electricity"].dtype.kind, "M")

    def test_xarray_itself_reads_the_same_names(self):
        try:
            own = xarray.open_dataset(self.result.path, group="small/loop", engine="h5netcdf")
        except (ImportError, ValueError):
            self.skipTest("no h5netcdf")
        self.assertEqual(dict(self.result["small/loop"].sizes), dict(own.sizes))
        self.assertEqual({name: each.dims for name, each in self.result["small/loop"].variables.items()},
                         {name: each.dims for name, each in own.variables.items()})

    def test_csv_files_are_those_of_the_program_and_nothing_is_written_over(self):
        place, other = self.folder / "csv", self.folder / "other"
        files = self.result.to_csv(place)
        program.asked(["report", str(self.result.path), "--csv", str(other)])
        self.assertEqual([file.relative_to(place) for file in files],
                         sorted(file.relative_to(other) for file in other.rglob("*.csv")))
        for file in files:
            self.assertEqual(file.read_bytes(), (other / file.relative_to(place)).read_bytes())
        first = pd.read_csv(place / "small/screening/rank.csv").filter(like="best_parameters").iloc[0, 0]
        self.assertEqual(first, self.stored("screening/best_parameters")[0, 0])
        self.assertIn("outdoor_temperature [degC]", pd.read_csv(place / "small/loop/held_out/time.csv").columns)
        self.assertRefused(ExitCode.CANNOT_CREATE, "is there already", self.result.to_csv, place)
        (place / "mine.txt").write_text("kept")
        self.assertEqual(self.result.to_csv(place, force=True), files)
        self.assertEqual((place / "mine.txt").read_text(), "kept")

    def test_tables_are_tidy(self):
        tables = {"/".join(names): table for names, table in self.result.tables()}
        for name in ("small/loop/errors", "small/loop/effects", "small/loop/held_out/electricity/hours",
                     "small/screening/rank_by_parameter", "small/posterior/posterior/chain_by_draw"):
            self.assertIn(name, tables)
        best = tables["small/screening/rank_by_parameter"]
        self.assertEqual(best["best_parameters"].iloc[0], self.stored("screening/best_parameters")[0, 0])

    def test_parquet_takes_a_library_that_is_named(self):
        if result.is_installed("pyarrow"):
            self.result.to_parquet(self.folder / "parquet")
            best = pd.read_parquet(self.folder / "parquet/small/screening/rank_by_parameter.parquet")
            self.assertEqual(best["best_parameters"].iloc[0], self.stored("screening/best_parameters")[0, 0])
        else:
            self.assertRefused(ExitCode.NO_INPUT, "pip install \"pyarrow", self.result.to_parquet, self.folder / "p")

    def test_the_program_writes_parquet_by_the_package(self):
        folder = self.folder / "by_the_program"
        done = subprocess.run([program.find(), "report", self.result.path, "--parquet", folder], text=True,
                              capture_output=True, check=False)
        if result.is_installed("pyarrow"):
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue((folder / "small/screening/rank_by_parameter.parquet").exists())
        else:
            self.assertEqual((done.returncode, folder.exists()), (ExitCode.NO_INPUT, False))
            self.assertIn("pip install \"pyarrow", done.stderr)

    def test_tables_page_and_pictures_are_those_of_the_program_and_its_script(self):
        self.assertIn("effect found", self.result.report())
        page = self.result.page(self.folder / "page.html", stage="small/loop")
        self.assertIn('content="bemcal-batch"', page.read_text(encoding="utf-8"))
        self.assertRefused(ExitCode.CANNOT_CREATE, "is there already", self.result.page, page)
        self.assertRefused(ExitCode.CANNOT_CREATE, "the result itself", self.result.page, self.result.path, force=True)
        with self.assertRaisesRegex(bemcal.Error, "small/loop"):
            self.result.page(self.folder / "other.html", stage="shop/loop")
        if (ROOT / "scripts" / "result_report").exists():
            pictures = self.result.plot(self.folder / "pictures", stage="small/loop")
            self.assertTrue(pictures and all(picture.suffix == ".svg" for picture in pictures))
            self.assertRefused(ExitCode.CANNOT_CREATE, "is there already; force=True", self.result.plot,
                               self.folder / "pictures")
            whole = pictures[0].read_text()
            pictures[0].write_text("old")
            (self.folder / "pictures" / "mine.svg").write_text("kept")
            self.assertEqual(self.result.plot(self.folder / "pictures", stage="small/loop", force=True), pictures)
            self.assertEqual(len(pictures[0].read_text()), len(whole))
            self.assertEqual((self.folder / "pictures" / "mine.svg").read_text(), "kept")
        else:
            self.assertRefused(ExitCode.NO_INPUT, "result_report was not found", self.result.plot, self.folder / "new")

    def test_what_readme_shows_runs(self):
        shutil.copy(self.result.path, self.folder / "office.h5")
        shown = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)
        self.assertEqual(len(shown), 1)
        done = subprocess.run([sys.executable, "-B", "-c", shown[0].replace('"gas"', '"electricity"')], cwd=self.folder,
                              env={**os.environ, "PYTHONPATH": str(PACKAGE)}, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("small/loop", done.stdout)

    def test_status_tells_the_hash(self):
        status = bemcal.status(self.result)
        self.assertTrue(status.is_complete)
        self.assertEqual(status.hash, self.file.attrs["result_hash"])
        self.assertEqual(self.result.attributes["result_hash"], status.hash)
        self.assertEqual(self.result.run["n_ranks"], "1")

    def test_a_first_job_is_written_from_files_and_little_else(self):
        given = {"weather": [QUICKSTART / "weather_2021_2022.csv"], "meters": [QUICKSTART / "measured_2021_2022.csv"],
                 "area": 3000, "built": 1990, "place": "ES", "site": (40, -3.7)}
        new = bemcal.new(self.folder / "first.toml", use="office", storeys=3, **given)
        self.assertEqual([meter["name"] for meter in new["meter"]], ["electricity", "cooling", "heat"])
        self.assertEqual(new.path, self.folder / "first.toml")
        bemcal.check(new)
        self.assertRefused(ExitCode.USAGE, "expected one of office", bemcal.new, self.folder / "other.toml",
                           use="palace", **given)
        self.assertRefused(ExitCode.USAGE, "leave it out beside --idf", bemcal.new, self.folder / "other.toml",
                           idf=self.folder / "house.idf", **given)
        self.assertRefused(ExitCode.USAGE, "--use: is left out", bemcal.new, self.folder / "other.toml", **given)

    def test_a_job_is_adopted_beside_the_old_one(self):
        new = bemcal.adopt(self.result, self.job, self.place / "adopted.toml", keep_priors=True)
        self.assertEqual(new.path, self.place / "adopted.toml")
        self.assertIn("as the loop left it", new.to_toml())
        bemcal.check(new)
        self.assertRefused(ExitCode.CANNOT_CREATE, "adopted.toml: is there already", bemcal.adopt, self.result,
                           self.job, self.place / "adopted.toml")

    def test_a_file_that_is_written_anew_is_not_mixed_with_the_old_one(self):
        copy = self.folder / "copy.h5"
        shutil.copy(self.result.path, copy)
        opened = bemcal.open(copy)
        os.utime(copy, ns=(1, 1))
        self.assertRefused(ExitCode.DATA, "open it again", opened.__getitem__, "loop")


class Failures(Folder):
    def job(self, **studies):
        job = bemcal.Job.read(QUICKSTART)
        job["study"] = [{"kind": "screening", "n_points": 64, "points_per_item": 8, **studies}]
        return job.save(self.folder / "job.toml")

    def run_(self, job, **more):
        return bemcal.run(job, output=self.folder / "job.h5", **more)

    def test_messages_and_codes_are_the_programs(self):
        self.assertRefused(ExitCode.NO_INPUT, "none.toml", bemcal.run, self.folder / "none.toml")
        error = self.assertRefused(ExitCode.CONFIG, r"job.toml:\d+.*n_pints", self.run_, self.job(n_pints=3))
        self.assertNotIn("bemcal-batch:", str(error))
        self.assertIn("bemcal-batch:", error.said)
        self.assertRefused(ExitCode.CONFIG, r"job.toml:\d+.*n_pints", bemcal.check, self.folder / "job.toml")

    def test_a_result_is_not_written_over_and_an_unfinished_run_goes_on(self):
        job = self.job()
        self.assertRefused(ExitCode.MORE_TO_DO, "stopped; .* go on with", self.run_, job, stop_after=1e-9)
        self.assertFalse(bemcal.status(self.folder / "job.h5").is_complete)
        self.assertRefused(ExitCode.CANNOT_CREATE, "job.h5", self.run_, job)
        done = self.run_(job, resume=True)
        self.assertEqual(done.stages, {"job/screening": "screening"})
        self.assertEqual(self.run_(job, resume=True).path, done.path)
        self.assertRefused(ExitCode.CANNOT_CREATE, "job.h5", self.run_, job)
        if shutil.which("mpirun"):
            first = bemcal.status(done).hash
            self.assertEqual(bemcal.status(self.run_(job, force=True, ranks=2)).hash, first)

    def test_a_run_whose_items_fail_is_an_error_though_its_result_is_there(self):
        job = bemcal.Job({"seed": 1, "study": [{"kind": "sensitivity", "n_base": 8}], "simulator": {
            "command": ["false", "@u@"], "parameter": [{"name": "u", "min": 1, "max": 2}], "keep": "none",
            "output": [{"name": "heat", "pattern": "([0-9]+)"}]}})
        job = job.save(self.folder / "job.toml")
        error = self.assertRefused(ExitCode.DATA, "simulations failed", self.run_, job)
        self.assertNotIn("wrote", str(error))
        self.assertEqual(bemcal.open(self.folder / "job.h5").stages, {"sensitivity": "sensitivity"})

    def test_arguments_that_cannot_be_are_refused(self):
        self.assertRefused(ExitCode.USAGE, "ranks=0", bemcal.run, "job.toml", ranks=0)
        self.assertRefused(ExitCode.NO_INPUT, "no such program", bemcal.check, "job.toml", program="/nowhere/bemcal")
        self.assertRefused(ExitCode.USAGE, "threads", bemcal.run, "job.toml", threads=-1)

    def test_a_file_that_is_damaged_is_an_error_wherever_it_is(self):
        whole = self.run_(self.job()).path
        data = whole.read_bytes()
        damaged = self.folder / "damaged.h5"
        self.assertRefused(ExitCode.NO_INPUT, "no such file", bemcal.open, damaged)
        for text in (b"", b"no HDF5", data[:len(data) // 2], data[:-1]):
            damaged.write_bytes(text)
            self.assertRefused(ExitCode.DATA, "damaged.h5: damaged", bemcal.open, damaged)
        rng, n_refused = random.Random(1), 0
        for _ in range(25):
            bad = bytearray(data)
            for _ in range(200):
                bad[rng.randrange(len(bad))] ^= 1 << rng.randrange(8)
            damaged.write_bytes(bad)
            self.assertRefused(ExitCode.DATA, "damaged", bemcal.status, damaged)
            try:
                opened = bemcal.open(damaged)
                for group in opened._head.groups:
                    opened[group].load()
            except bemcal.Error as error:
                n_refused += 1
                self.assertIn(error.code, (ExitCode.DATA, ExitCode.USAGE))
        self.assertGreater(n_refused, 5)

    def test_what_is_no_result_is_said(self):
        other = self.folder / "other.h5"
        h5py.File(other, "w").close()
        self.assertRefused(ExitCode.DATA, "no complete result of bemcal-batch", bemcal.open, other)


class Package(Folder):
    def test_codes_and_version_are_those_of_the_program(self):
        header = (ROOT / "src" / "base" / "error.hpp").read_text()
        codes = {name.upper(): int(code) for name, code in re.findall(r"^    (\w+) = (\d+),", header, re.MULTILINE)}
        self.assertEqual({code.name: code.value for code in ExitCode}, codes)
        self.assertTrue(all(code.meaning for code in ExitCode))
        self.assertEqual(program.asked(["--version"]).split()[-1], bemcal.__version__)
        self.assertIn("best_parameters", bemcal.describe("results"))

    def test_a_message_is_the_verdict_without_news_and_without_what_mpirun_adds(self):
        said = "bemcal-batch: a: 1 stage; writing a.h5\na: 1 of 2 items\n" \
               f"bemcal-batch: wrote a.h5, result hash {'0' * 32}; its tables\n" \
               "bemcal-batch: a/posterior: not\n  converged\nbemcal-batch: wrote a.html, the same\n" \
               "-----\nmpirun detected\n-----\n"
        answer = program.Answer(1, "", said)
        self.assertEqual(answer.message, "a/posterior: not\n  converged")
        self.assertEqual(program.written(answer), "a.h5")
        self.assertEqual(program.Answer(78, "", "bemcal-batch: a.toml:1: no\n").message, "a.toml:1: no")
        self.assertIn("ended with code -9", program.Answer(-9, "", "").message)

    def test_names_of_weather_and_files_are_those_of_the_job(self):
        text = bemcal.describe("job")
        for name in (*bemcal.job.WEATHER, *bemcal.job.SOURCE_KEYS, *sum(bemcal.job.FILE_KEYS.values(), ())):
            self.assertRegex(text, rf"(?m)^ *{name}\b")
        self.assertEqual(set(readings.BY_CALENDAR) - set(re.findall(r"\w+", text)), set())

    def test_the_notebook_runs(self):
        text = (ROOT / "jobs" / "python" / "office.py").read_text()
        small = text
        for name, value in {"RANKS": 1, "N_POINTS": 32, "MOST_EFFECTS": 1}.items():
            small, n = re.subn(rf"(?m)^{name} = \d+", f"{name} = {value}", small)
            self.assertEqual(n, 1)
        small = small.replace("__file__", repr(str(ROOT / "jobs" / "python" / "office.py")))
        done = subprocess.run([sys.executable, "-B", "-c", small], cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": str(PACKAGE), "BEMCAL_PROGRAM": program.find()})
        self.assertEqual(done.returncode, 0, done.stderr)
        for said in ("office/loop: loop", "plain  before  after", "of the readings lie inside", "files in office_csv"):
            self.assertIn(said, done.stdout)
        self.assertTrue((self.folder / "office_csv" / "office" / "loop" / "effect.csv").exists())

    def test_pip_installs_it_from_the_tree(self):
        tree, place = self.folder / "tree", self.folder / "venv"
        shutil.copytree(ROOT / "scripts", tree, symlinks=True)
        made = subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", place], capture_output=True)
        if made.returncode != 0:
            self.skipTest("no venv")
        subprocess.run([place / "bin" / "pip", "install", "-q", "--no-build-isolation", "--no-deps", "--no-index",
                        tree / "python"], check=True, capture_output=True)
        shutil.rmtree(tree)
        words = "import bemcal, sys; print(bemcal.__file__); print(bemcal.status(sys.argv[1]).is_complete)"
        job = Failures.job(self)
        file = bemcal.run(job, output=self.folder / "job.h5").path
        done = subprocess.run([place / "bin" / "python", "-B", "-c", words, file], cwd="/", capture_output=True,
                              text=True, env={**os.environ, "BEMCAL_PROGRAM": program.find()})
        self.assertEqual(done.stdout.split(), [str(next(place.glob("lib/*/site-packages/bemcal/__init__.py"))), "True"],
                         done.stderr)


if __name__ == "__main__":
    unittest.main()
