#!/usr/bin/python3
"""A made stock, night after night: broken buildings are failed items with reasons, the same hash on 1, 2
and 3 ranks and after a kill, and a second night does what has changed and nothing else. Its page holds
10,000 buildings, opens and sorts at once, and shows a hostile name as a name."""
import csv
import html
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import h5py
import numpy as np

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "generator"))

import stock as made  # noqa: E402

PROGRAM = os.environ["BEMCAL_PROGRAM"]
BUILDINGS, STATIONS, POINTS = 60, 3, 32
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMP_WAIT_POLICY": "passive", "OMP_NUM_THREADS": "1"}


def command(ranks, *words):
    launch = ["mpirun", "-np", str(ranks), "--oversubscribe", "--bind-to", "none"] if ranks > 1 else []
    return [*launch, PROGRAM, *map(str, words)]


def texts(result, name):
    with h5py.File(result) as file:
        return [text.decode() for text in file[f"stock/{name}"][:]]


def hash_of(result):
    out = subprocess.run(command(1, "status", result), capture_output=True, text=True, check=True).stdout
    return re.search(r"result hash (\w+)", out).group(1)


class Nights(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.holder.name)
        cls.stock = made.make(cls.folder, BUILDINGS, STATIONS, seed=3, broken_share=10 / BUILDINGS)
        cls.job = cls.folder / "made.toml"
        cls.job.write_text(made.job_text(POINTS) + "[output]\nmax_failed_share = 0.5\n")
        cls.first = cls.run_night("night-1.h5")

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    @classmethod
    def run_night(cls, name, *words, ranks=1, code=0):
        result = cls.folder / name
        done = subprocess.run(command(ranks, "run", cls.job, "-o", result, *words), env=ENVIRONMENT,
                              capture_output=True, text=True, cwd=cls.folder)
        assert done.returncode == code, f"exit code {done.returncode}: {done.stderr}"
        return result

    def test_a_broken_building_is_a_failed_item_with_its_reason(self):
        status, reasons = texts(self.first, "stock_status"), texts(self.first, "stock_reason")
        said = ["cannot be opened", "cut off", "is empty", "has no column", "is not a number", "floor_area",
                "nowhere.csv", "Error while parsing", "another line has the name", "has no reading"]
        self.assertEqual(set(self.stock.broken.values()), set(range(len(made.WAYS))))
        for k, way in self.stock.broken.items():
            self.assertEqual(status[k], "failed", made.WAYS[way])
            self.assertIn(said[way], reasons[k], made.WAYS[way])
        for k in set(range(BUILDINGS)) - set(self.stock.broken):
            self.assertEqual((status[k], reasons[k]), ("calibrated", ""))

    def test_the_hash_is_the_same_on_any_ranks_and_after_a_kill(self):
        expected = hash_of(self.first)
        for ranks in (2, 3):
            self.assertEqual(hash_of(self.run_night(f"ranks-{ranks}.h5", ranks=ranks)), expected)
        result = self.folder / "killed.h5"
        run = subprocess.Popen(command(1, "run", self.job, "-o", result), env=ENVIRONMENT, cwd=self.folder,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        log = pathlib.Path(f"{result}.part/rank-0.log")
        while run.poll() is None and (not log.exists() or log.stat().st_size < 20000):
            time.sleep(0.002)
        run.send_signal(signal.SIGKILL)
        run.wait()
        self.assertFalse(result.exists())
        self.run_night("killed.h5", "--resume", ranks=2)
        self.assertEqual(hash_of(result), expected)

    def test_a_building_does_not_depend_on_the_others(self):
        lines = (self.folder / "buildings.csv").read_text().split("\n")
        keep = next(k for k in range(5, BUILDINGS) if not {k, k + 1} & set(self.stock.broken))
        (self.folder / "one.csv").write_text(f"{lines[0]}\n{lines[keep + 1]}\n")
        job = self.folder / "one.toml"
        job.write_text(self.job.read_text().replace("buildings.csv", "one.csv"))
        subprocess.run(command(1, "run", job, "-o", self.folder / "one.h5"), env=ENVIRONMENT, check=True,
                       capture_output=True)
        with h5py.File(self.first) as all_of, h5py.File(self.folder / "one.h5") as one:
            mine = all_of["stock/stock_values_of"][:] == keep
            self.assertEqual(list(all_of["stock/stock_value"][:][mine]), list(one["stock/stock_value"][:]))

    def test_the_table_and_the_history_have_a_line_for_each_building(self):
        with open(self.folder / "night-1.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), BUILDINGS)
        self.assertEqual(sum(row["status"] == "failed" for row in rows), len(self.stock.broken))
        with open(self.folder / "made-history.csv", newline="", encoding="utf-8") as file:
            nights = [row["night"] for row in csv.DictReader(file)]
        self.assertEqual(nights.count("night-1"), BUILDINGS)

    def test_the_page_stands_alone_and_names_the_failed(self):
        page = (self.folder / "night-1.html").read_text(encoding="utf-8")
        self.assertNotRegex(page, r"(src|href)=\"(?!data:|#)")
        for k, way in self.stock.broken.items():
            if way != 8:
                self.assertIn(self.stock.lines[k]["name"], page)


class ChangedSince(unittest.TestCase):
    def test_a_building_whose_file_has_changed_is_done_again_by_resume(self):
        with tempfile.TemporaryDirectory() as holder:
            folder = pathlib.Path(holder)
            stock = made.make(folder, 12, 2, seed=6, broken_share=0)
            job, result, whole = folder / "made.toml", folder / "stopped.h5", folder / "whole.h5"
            job.write_text(made.job_text(POINTS))
            run = lambda *words: subprocess.run(command(1, "run", job, "--no-report", "-o", *words), env=ENVIRONMENT,
                                                capture_output=True, text=True)
            # With a failed building the log stays; without the result the run is one that was killed at its end.
            last = folder / stock.lines[-1]["meter"]
            readings = last.read_bytes()
            last.write_bytes(b"")
            job.write_text(job.read_text() + "[output]\nmax_failed_share = 0.5\n")
            self.assertEqual(run(result).returncode, 0)
            result.unlink()
            template = folder / "building.toml"
            template.write_text(made.BUILDING + "# another\n")
            refused = run(result, "--resume")
            self.assertNotEqual(refused.returncode, 0)
            self.assertIn("building.toml has changed since", refused.stderr)
            template.write_text(made.BUILDING)

            last.write_bytes(readings)
            (changed,) = made.change(stock, 1 / 12)
            again = run(result, "--resume")
            self.assertEqual(again.returncode, 0, again.stderr)
            for k in (changed, 11):
                line = stock.lines[k]
                self.assertIn(f"doing again: {line['name']}: {line['meter']} has changed since", again.stderr)
            self.assertEqual(again.stderr.count("doing again: "), len({changed, 11}))
            self.assertEqual(run(whole).returncode, 0)
            self.assertEqual(hash_of(result), hash_of(whole))


class SecondNight(unittest.TestCase):
    def test_only_what_has_changed_is_done_again_from_where_it_was(self):
        with tempfile.TemporaryDirectory() as holder:
            folder = pathlib.Path(holder)
            stock = made.make(folder, 20, 2, seed=4, broken_share=0.1)
            job = folder / "made.toml"
            job.write_text(made.job_text(POINTS) + "[output]\nmax_failed_share = 0.5\n")
            run = lambda *words: subprocess.run(command(1, "run", job, "--no-report", *words), env=ENVIRONMENT,
                                                check=True, capture_output=True)
            first, second, third = (folder / f"night-{k}.h5" for k in (1, 2, 3))
            run("-o", first)
            changed = made.change(stock, 0.1)
            run("-o", second, "--after", first)
            status, cause = texts(second, "stock_status"), texts(second, "stock_cause")
            for k in range(20):
                if k in changed:
                    self.assertEqual(status[k], "calibrated")
                    self.assertEqual(cause[k], "data: " + stock.lines[k]["meter"])
                else:
                    self.assertEqual(status[k], "failed" if k in stock.broken else "unchanged")
                    self.assertEqual(cause[k], "")
            with h5py.File(first) as one, h5py.File(second) as two:
                of, value = one["stock/stock_values_of"][:], one["stock/stock_value"][:]
                again = two["stock/stock_values_of"][:], two["stock/stock_value"][:]
                for k in set(range(20)) - set(changed):
                    self.assertEqual(list(value[of == k]), list(again[1][again[0] == k]))
            # What starts from the night before is not worse than that on the same data.
            with h5py.File(second) as two:
                for k, before, after in zip(two["stock/stock_fits_of"][:], two["stock/stock_fit_before"][:],
                                            two["stock/stock_fit_cv_rmse"][:]):
                    if k in changed:
                        self.assertLessEqual(after, before)
            # How a night is run makes nothing due, nor does a comment.
            text = job.read_text()
            limited = "# of a district\n" + text.replace("[stock]", "[stock]\nbudget = 1")
            job.write_text(limited)
            run("-o", third, "--after", second)
            self.assertEqual(set(texts(third, "stock_status")), {"unchanged", "failed"})
            third.unlink()
            # A budget of one building: the others wait, then come first.
            job.write_text(limited.replace("[stock]", "[stock]\nwindow_days = 300"))
            run("-o", third, "--after", second)
            status = texts(third, "stock_status")
            self.assertEqual(status.count("calibrated") + (texts(third, "stock_cause")[
                min(stock.broken)] != "" and status[min(stock.broken)] == "failed"), 1)
            self.assertGreater(status.count("postponed"), 10)


STATUSES = ("calibrated", "unchanged", "postponed", "failed")
HOSTILE = ("</script><script>document.title='broken'</script>", "<img src=x onerror=\"document.title='broken'\">",
           "\"'&lt;b&gt; \u2028\u202e {{ 7*7 }}", "stock", ".", "../x//y")
SMALL_POSTERIOR = """[[study]]
kind = "posterior"
sampler = "random_walk"
discrepancy = false
n_chains = 4
warm_up = 40
draws_per_round = 20
most_draws = 60
target_ess = 1000000
n_predictive = 20
"""
MANY, DAYS = 10000, 180
MOST_BYTES, MOST_SECONDS = 8e6, 20     # of the page of so many buildings
OPENS, SORTS = 2.0, 0.3                # [s] of the page in a browser, on a machine that does nothing else
SLACK = 3                              # times more on one that does
# What a test adds to the page: when all was drawn, how long each heading's click takes, and what then stands there.
MEASURE = """
addEventListener("load", () => {
  const lines = document.getElementById("lines"), rows = () => [...lines.querySelectorAll("tbody th")];
  const said = {"opened": (lines.getBoundingClientRect(), performance.now() / 1000), "sorts": []};
  const names = () => {
    const [first, last] = [0, lines.scrollHeight].map((top) => {
      lines.scrollTop = top;
      lines.dispatchEvent(new Event("scroll"));
      return rows().map((row) => row.textContent);
    });
    return [first[0], last.at(-1)];
  };
  said.drawn = rows().length;
  for (const head of lines.querySelectorAll("thead th"))
    for (let click = 0; click < 2; ++click) {
      const begin = performance.now();
      head.querySelector("button").click();
      lines.getBoundingClientRect();
      said.sorts.push([head.dataset.key, head.getAttribute("aria-sort"), (performance.now() - begin) / 1000,
                       ...names()]);
    }
  const count = (id, value) => {
    document.getElementById(id).value = value;
    document.getElementById(id).dispatchEvent(new Event("input"));
    return document.getElementById("count").textContent;
  };
  said.failed = count("status", "failed");
  count("status", "");
  said.found = count("text", "ONERROR");
  said.name = rows()[0].textContent;
  dispatchEvent(new Event("beforeprint"));
  count("text", "");
  said.printed = rows().length;
  said.title = document.title;
  const told = document.createElement("pre");
  told.id = "told";
  told.textContent = JSON.stringify(said);
  document.body.append(told);
});
"""


def made_night(path, n):
    """A result of n buildings that no run made: datasets as `bemcal-batch describe results` has them."""
    rng = np.random.default_rng(7)
    k = np.arange(n)
    status = [STATUSES[place] for place in rng.choice(4, n, p=(0.2, 0.7, 0.08, 0.02))]
    names = [f"building {place:05}" for place in rng.permutation(n)]
    names[1:1 + len(HOSTILE)] = HOSTILE
    season = 60 + 40 * np.cos(2 * np.pi * np.arange(DAYS) / 365)
    daily = rng.lognormal(2, 1, (n, 1)) * season * rng.uniform(0.7, 1.3, (n, DAYS))
    daily[:, 90:93] = np.nan
    errors = rng.lognormal(-1.5, 0.4, (n, 2, 2))
    with_effect, found = k[k % 7 == 0], ("found: wind, 0.083 1/h per m/s", "one value for 30 h", "zeros fill a gap")
    findings = [(place, found[0]) for place in with_effect] + [(place, found[1 + place % 2]) for place in k]
    text = {"building": names, "status": status, "cause": [""] * n,
            "reason": ["gas.csv: cannot be opened" if one == "failed" else "" for one in status],
            "drift": ["wall moved by 0.31 of its range" if place % 50 == 0 else "" for place in k],
            "told": ["ended: wind <infiltration>, on 2022-03-04" if place % 200 == 0 else "" for place in k],
            "common_effect": ["wind <infiltration>", "sun on walls"], "common_unit": ["1/h per m/s", "K"],
            "effect": ["<stack> infiltration", "sun on walls"],
            "effect_by_stock": ["wind <infiltration>", "sun on walls"],
            "undecided": ["weather <station>" if place == 5 else "" for place in k],
            "all_effect": ["<station> offset", "sun"], "all_unit": ["K", "K/(W/m2)"],
            "all_section": ['[[effect]]\nname = "<station> offset"\n', ""],
            "fit_meter": ["gas"] * (2 * n), "fit_period": ["training", "recent"] * n,
            "finding_series": ["gas"] * len(findings), "finding": [what for _, what in findings],
            "finding_action": ["masked" if "zeros" in what else "kept" for _, what in findings],
            "value_parameter": ["wall"] * n, "value_unit": ["1"] * n}
    numbers = {"age": k % 30, "daily_start": np.full(n, 19358), "daily_n": np.full(n, DAYS), "daily": daily.ravel(),
               "fits_of": np.repeat(k, 2), "fit_before": errors[:, :, 0].ravel(),
               "fit_cv_rmse": errors[:, :, 1].ravel(), "fit_nmbe": np.zeros(2 * n),
               "effects_of": [3, 4], "effect_by_stock_probability": [0.93, 0.99],
               "all_n": [300, 290], "all_mean": [-0.64, 0.0001], "all_sd": [0.06, 0.0001], "all_spread": [0.3, 0.001],
               "all_probability": [0.93, 0.01], "undecided_probability": np.where(k == 5, 0.81, np.nan),
               "common_expected": [66.42, 0.9],
               "common_n": [61, 1], "common_of": [312, 312], "common_q25": [0.01, 1], "common_median": [0.02, 1],
               "common_q75": [0.04, 1], "values_of": k, "value": np.ones(n), "value_low": np.ones(n),
               "value_high": np.ones(n),
               "value_moved": np.zeros(n), "findings_of": [place for place, _ in findings]}
    with h5py.File(path, "w") as file:
        group = file.create_group("stock")
        file.attrs["title"] = HOSTILE[0]
        for name, values in text.items():
            group.create_dataset(f"stock_{name}", data=values, dtype=h5py.string_dtype())
        for name, values in numbers.items():
            group[f"stock_{name}"] = np.asarray(values, float)
    return names, errors[:, 1, 1]


def data_of(page):
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.S).group(1))


class ManyBuildings(unittest.TestCase):
    """A made night of so many buildings, and its page."""

    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.holder.name)
        cls.names, cls.recent = made_night(cls.folder / "many.h5", MANY)
        begin = time.monotonic()
        cls.page = cls.write("many.h5", "many.html")
        cls.seconds = time.monotonic() - begin

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    @classmethod
    def write(cls, result, page):
        subprocess.run([ROOT / "scripts" / "stock_report", cls.folder / result, cls.folder / page], check=True,
                       capture_output=True)
        return (cls.folder / page).read_text(encoding="utf-8")


class Page(ManyBuildings):
    def test_what_the_stock_names_is_told(self):
        common = self.page[self.page.index("Effects in common"):self.page.index("Named by the stock")]
        self.assertIn('<th>wind &lt;infiltration&gt;<td>in 61 of 312<td class="n">66.4', common)
        self.assertNotIn("sun on walls", common)    # in one building
        place = self.page[self.page.index("What all share"):self.page.index("Named by the stock")]
        self.assertIn('<th>&lt;station&gt; offset<td class="n">300<td class="n">−0.64', place)
        self.assertEqual(place.count("[[effect]]"), 1)    # of the probable one alone
        named = self.page[self.page.index("Named by the stock"):]
        rows = re.findall(r"<tr><th>([^<]*)<td>([^<]*)<td>([^<]*)<td class=\"n\">([^<]*)</tr>", named)[:2]
        self.assertEqual([tuple(map(html.unescape, row[1:])) for row in rows],
                         [("<stack> infiltration", "wind <infiltration>", "0.93"),
                          ("no name", "weather <station>", "0.81")])
        self.assertEqual([html.unescape(row[0]) for row in rows], [self.names[3], self.names[5]])

    def test_it_is_small_made_soon_and_the_same_again(self):
        print(f"measured: page of {MANY} buildings: {len(self.page.encode()) / 1e6:.2f} MB in {self.seconds:.1f} s")
        self.assertLessEqual(len(self.page.encode()), MOST_BYTES)
        self.assertLessEqual(self.seconds, MOST_SECONDS)
        self.assertTrue(self.write("many.h5", "again.html") == self.page)

    def test_it_holds_what_the_result_does(self):
        data = data_of(self.page)
        self.assertTrue(data["name"] == self.names)
        np.testing.assert_allclose(data["last"], 100 * self.recent, atol=0.051)
        with h5py.File(self.folder / "many.h5") as file:
            daily = file["stock/stock_daily"][:].reshape(MANY, DAYS)
        np.testing.assert_allclose(data["mean"], np.nanmean(daily, axis=1), atol=0.051)
        shown = np.array([[data["levels"].find(day) for day in row] for row in data["measured"][:50]])
        share = daily[:50] / np.nanmax(daily[:50], axis=1)[:, None]
        np.testing.assert_array_equal(shown == -1, np.isnan(share))
        np.testing.assert_allclose(np.where(shown < 0, np.nan, shown) / (len(data["levels"]) - 1), share, atol=0.01)
        self.assertEqual((data["effects"][7], data["effects"][8]), ("wind, 0.083 1/h per m/s", ""))
        self.assertEqual(set(data["findings"]), {1})

    def test_it_tells_what_has_changed_and_what_many_have(self):
        text = " ".join(html.unescape(re.sub(r"<[^>]+>", " ", self.page)).split())
        self.assertIn(f"{MANY // 200} changed", text)
        self.assertIn("ended: wind <infiltration>, on 2022-03-04", text)
        self.assertIn("wind <infiltration> in 61 of 312 66.4 0.02 0.01 to 0.04 1/h per m/s", text)
        self.assertNotIn("in 1 of 312", text)

    def test_each_status_is_counted_once_and_an_effect_is_no_finding_in_the_data(self):
        text = " ".join(html.unescape(re.sub(r"<[^>]+>", " ", self.page)).split())
        lead = text[text.index(f"{MANY} buildings:"):text.index("Errors are CV(RMSE)")]
        self.assertEqual(lead.count("failed"), 1)
        self.assertNotRegex(lead, r"\b0 ")
        self.assertIn("found: wind", text[text.index("Effects found"):text.index("Other findings in the data")])
        self.assertNotIn("found: wind", text[text.index("Other findings in the data"):])

    def test_a_hostile_name_is_only_a_name(self):
        outside = re.sub(r"<script[ >].*?</script>", "", self.page, flags=re.S)
        self.assertEqual(self.page.count("<script"), 2)
        for sign in ("<img src=x", "</script><script>document"):
            self.assertEqual(self.page.count(sign), 0, sign)
        self.assertGreater(outside.count(html.escape(HOSTILE[0]).replace("&#x27;", "&#39;")), 0)
        self.assertRegex(self.page[:2000], r"default-src 'none';[^\"]*script-src 'sha256-[A-Za-z0-9+/=]+'\"")

    def test_without_scripts_it_names_the_table(self):
        self.assertIn("many.csv", self.without_script(self.page))
        (self.folder / "many.csv").write_text("name,floor_area\n")
        (self.folder / "many-table.csv").write_text("building,status,cause\n")
        self.assertIn("many-table.csv", self.without_script(self.write("many.h5", "other.html")))

    @staticmethod
    def without_script(page):
        return re.search("<noscript>(.*?)</noscript>", page, re.S).group(1)

    def test_of_whole_results_the_foretold_days_are_drawn(self):
        made.make(self.folder, 2, 1, seed=3, broken_share=0)
        job = made.job_text(POINTS).replace("[stock]", "[stock]\nkeep_results = true")
        self.check_foretold("screening", job, "simulated")
        screening = job[job.index("[[study]]"):]
        self.check_foretold("posterior", job.replace(screening, SMALL_POSTERIOR), "predicted_mean")

    def check_foretold(self, kind, text, foretold):
        job, result = self.folder / f"{kind}.toml", self.folder / f"{kind}.h5"
        job.write_text(text)
        subprocess.run(command(1, "run", job, "--no-report", "-o", result), env=ENVIRONMENT, check=True,
                       capture_output=True)
        data = data_of(self.write(result.name, f"{kind}.html"))
        for k, name in enumerate(data["name"]):
            with h5py.File(result) as file:
                gas = file[f"{name}/{kind}/training/gas"]
                hours = np.atleast_2d(gas[foretold])[-1], gas["measured"][:]
            simulated, measured = (values.reshape(-1, 24).sum(axis=1)[-DAYS:] for values in hours)
            step = (data["most"][k] - data["least"][k]) / (len(data["levels"]) - 1)
            for series, daily in (("foretold", simulated), ("measured", measured)):
                shown = [data["levels"].index(day) for day in data[series][k]]
                np.testing.assert_allclose(np.multiply(shown, step), daily, atol=0.6 * step + 1)
            self.assertNotEqual(data["foretold"][k], data["measured"][k])

    def test_a_list_that_is_too_short_is_refused(self):
        shutil.copy(self.folder / "many.h5", self.folder / "short.h5")
        with h5py.File(self.folder / "short.h5", "r+") as file:
            file["stock/stock_daily_n"][-1] = DAYS + 1
        done = subprocess.run([ROOT / "scripts" / "stock_report", self.folder / "short.h5", self.folder / "x.html"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 65)
        self.assertIn("daily sums left", done.stderr)


BROWSER = shutil.which("chromium")


@unittest.skipUnless(BROWSER, "no chromium is installed")
class Browser(ManyBuildings):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.page = cls.page.replace("</body>", f"<script>{MEASURE}</script></body>")
        # The page's policy lets no script but its own run: the one that measures needs it taken away.
        cls.told = cls.opened(re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", cls.page))

    @classmethod
    def opened(cls, text):
        """What the measuring script told; None where it did not run."""
        (cls.folder / "open.html").write_text(text, encoding="utf-8")
        done = subprocess.run([BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--window-size=1280,900",
                               f"--user-data-dir={cls.folder / 'profile'}", "--dump-dom",
                               f"file://{cls.folder / 'open.html'}"], capture_output=True, text=True, timeout=120)
        told = re.search(r'<pre id="told">(.*?)</pre>', done.stdout, re.S)
        return json.loads(html.unescape(told.group(1))) if told else None

    def test_it_opens_and_sorts_at_once(self):
        slowest = max(seconds for _, _, seconds, *_ in self.told["sorts"])
        print(f"measured: page of {MANY} buildings opens in {self.told['opened']:.2f} s, slowest sort {slowest:.3f} s")
        self.assertLess(self.told["opened"], SLACK * OPENS)
        self.assertLess(slowest, SLACK * SORTS)
        self.assertLess(self.told["drawn"], 100)

    def test_a_heading_sorts_both_ways(self):
        told = {(key, direction): ends for key, direction, _, *ends in self.told["sorts"]}
        keys = ("name", "status", "mean", "start", "training", "last", "drift", "nights", "findings", "effects")
        self.assertEqual(set(told), {(key, way) for key in keys for way in ("ascending", "descending")})
        order = [self.names[k] for k in np.argsort(np.round(100 * self.recent, 1), kind="stable")]
        low, high = told["last", "ascending"], told["last", "descending"]
        error = dict(zip(self.names, np.round(100 * self.recent, 1)))
        self.assertEqual([error[name] for name in low], [error[order[0]], error[order[-1]]])
        self.assertEqual([error[name] for name in high], [error[order[-1]], error[order[0]]])
        self.assertEqual(told["name", "ascending"][1], max(self.names))
        self.assertEqual(told["name", "descending"][0], told["name", "ascending"][1])

    def test_it_filters_by_text_and_by_status(self):
        with h5py.File(self.folder / "many.h5") as file:
            failed = sum(one == "failed" for one in file["stock/stock_status"].asstr()[:])
        self.assertEqual(self.told["failed"], f"{failed} of {MANY}")
        self.assertEqual(self.told["found"], f"1 of {MANY}")

    def test_a_hostile_name_runs_nothing(self):
        self.assertEqual(self.told["name"], HOSTILE[1])
        self.assertEqual(self.told["title"], f"{HOSTILE[0]}: many")

    def test_the_first_hundred_lines_are_printed(self):
        self.assertEqual(self.told["printed"], 100)

    def test_its_policy_keeps_other_scripts_out(self):
        self.assertIsNone(self.opened(self.page))


if __name__ == "__main__":
    unittest.main()
