#!/usr/bin/python3
"""`fmu_hours` runs an FMU that is built here, a room of one node in C: its hours are those of the same equation in
Python, with parameters, effects and periods; what is wrong ends in one line. Skipped where FMPy is not installed.
"""
import csv
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
RUNNER = ROOT / "scripts" / "fmu_hours"
VENV = ROOT / "build" / "fmpy"
PYTHON = os.environ.get("FMPY_PYTHON", str(VENV / "bin" / "python3"))
HOW = f"no FMPy: /usr/bin/python3 -m venv {VENV} && {VENV}/bin/pip install fmpy, or name its Python in FMPY_PYTHON"
SKIPPED, WRONG = 77, 65
HEAT_CAPACITY, AREA, DAY, STEP = 2e7, 100, 86400, 900   # J/K, m2, s
VARIABLES = ("heat_loss", "gains", "heating_set_point", "heat", "air")   # W/K, W/m2, K, kW, degC

CODE = """
#include <math.h>
#include <stdlib.h>
#include "fmi2FunctionTypes.h"
typedef struct { double value[5]; } Room;
fmi2Component fmi2Instantiate(fmi2String a, fmi2Type b, fmi2String c, fmi2String d, const fmi2CallbackFunctions* e,
                              fmi2Boolean f, fmi2Boolean g) {
    Room* room = calloc(1, sizeof *room);
    room->value[0] = 200;
    room->value[4] = 20;
    return room;
}
void fmi2FreeInstance(fmi2Component c) { free(c); }
fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean a, fmi2Real b, fmi2Real t, fmi2Boolean d, fmi2Real e) {
    return fmi2OK;
}
fmi2Status fmi2EnterInitializationMode(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2Terminate(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference* at, size_t n, const fmi2Real* values) {
    for (size_t k = 0; k < n; ++k) ((Room*)c)->value[at[k]] = values[k];
    return fmi2OK;
}
fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference* at, size_t n, fmi2Real* values) {
    for (size_t k = 0; k < n; ++k) values[k] = ((Room*)c)->value[at[k]];
    return fmi2OK;
}
fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean a) {
    double* v = ((Room*)c)->value;
    const double outdoor = 5 - 10 * cos(2 * acos(-1) * time / 86400), per_step = 2e7 / step;
    const double set_point = 20 + v[2];
    v[4] = (per_step * v[4] + v[0] * outdoor + 100 * v[1]) / (per_step + v[0]);
    v[3] = v[4] < set_point ? (set_point - v[4]) * (per_step + v[0]) / 1000 : 0;
    if (v[4] < set_point) v[4] = set_point;
    return v[0] < 0 ? fmi2Error : fmi2OK;
}
"""


# FMPy looks for all functions; those of no use here only have to be there.
UNUSED = """GetTypesPlatform GetVersion SetDebugLogging Reset GetInteger GetBoolean GetString SetInteger SetBoolean
    SetString GetFMUstate SetFMUstate FreeFMUstate SerializedFMUstateSize SerializeFMUstate DeSerializeFMUstate
    CancelStep GetDirectionalDerivative SetRealInputDerivatives GetRealOutputDerivatives GetStatus GetRealStatus
    GetIntegerStatus GetBooleanStatus GetStringStatus""".split()


def description():
    said = {"heat_loss": 'causality="parameter" variability="tunable"', "heat": 'causality="output"',
            "air": 'causality="output"'}
    start = {"heat_loss": ' start="200"', "gains": ' start="0"', "heating_set_point": ' start="0"'}
    lines = [f"""<ScalarVariable name="{name}" valueReference="{k}" {said.get(name, 'causality="input"')}>"""
             f"<Real{start.get(name, '')}/></ScalarVariable>" for k, name in enumerate(VARIABLES)]
    return ('<?xml version="1.0" encoding="UTF-8"?>'
            '<fmiModelDescription fmiVersion="2.0" modelName="room" guid="{room}">'
            '<CoSimulation modelIdentifier="room" canHandleVariableCommunicationStepSize="true"/>'
            f'<ModelVariables>{"".join(lines)}</ModelVariables><ModelStructure><Outputs><Unknown index="4"/>'
            '<Unknown index="5"/></Outputs></ModelStructure></fmiModelDescription>')


def build(path):
    """The FMU, for this machine."""
    headers = subprocess.run([PYTHON, "-c", "import fmpy, os; print(os.path.dirname(fmpy.__file__))"],
                             capture_output=True, text=True, check=True).stdout.strip()
    with tempfile.TemporaryDirectory() as folder:
        source, library = pathlib.Path(folder, "room.c"), pathlib.Path(folder, "room.so")
        source.write_text(CODE + "".join(f"int fmi2{name}(void) {{ return 3; }}\n" for name in UNUSED))
        subprocess.run(["cc", "-shared", "-fPIC", f"-I{headers}/c-code", source, "-lm", "-o", library], check=True)
        with zipfile.ZipFile(path, "w") as file:
            file.writestr("modelDescription.xml", description())
            file.write(library, "binaries/linux64/room.so")


def room(n_hours, second, heat_loss=200.0, gains=None, shift=None):
    """(heat, air) by the hour."""
    air, per_step, rows = 20.0, HEAT_CAPACITY / STEP, []
    for hour in range(n_hours):
        sums = np.zeros(2)
        for k in range(3600 // STEP):
            outdoor = 5 - 10 * math.cos(2 * math.pi * (second + 3600 * hour + STEP * k) / DAY)
            more = 0 if gains is None else gains[hour]
            set_point = 20 + (0 if shift is None else shift[hour])
            air = (per_step * air + heat_loss * outdoor + AREA * more) / (per_step + heat_loss)
            heat = max(set_point - air, 0) * (per_step + heat_loss) / 1000
            air = max(air, set_point)
            sums += (heat, air)
        rows.append(sums * STEP / 3600)
    return np.array(rows)


class Hours(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "periods.csv").write_text("period,first,last\na,2021-12-31,2022-01-02\n"
                                                 "b,2021-03-01,2021-03-01\n")
        self.given = {"fmu": "room.fmu", "periods": "periods.csv", "parameters": {"heat_loss": 250},
                      "meters": [{"name": "gas", "output": "heat"}, {"name": "room", "output": "air"}]}

    def call(self, python=PYTHON):
        (self.folder / "run.json").write_text(json.dumps(self.given))
        return subprocess.run([python, RUNNER, "run.json"], cwd=self.folder, capture_output=True, text=True,
                              check=False)

    def fails(self, *words, python=PYTHON):
        done = self.call(python)
        self.assertEqual((done.returncode, done.stdout), (WRONG, ""), done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertFalse((self.folder / "hours.csv").exists())


class WithoutFmpy(Hours):
    def test_it_is_told(self):
        bare = pathlib.Path("/usr/bin/python3")
        if subprocess.run([bare, "-c", "import fmpy"], capture_output=True, check=False).returncode:
            self.fails("No module named 'fmpy'", "pip install fmpy", python=bare)

    def test_bad_run_files(self):
        good = dict(self.given)
        for change, words in (({"fmus": 1}, ["fmus", "the nearest: 'fmu'"]), ({"meters": [1]}, ["meters", "output"]),
                              ({"step": 7}, ["step: 7"]), ({"parameters": 1}, ["parameters", "dict"]),
                              ({"periods": "none.csv"}, ["none.csv"])):
            with self.subTest(change):
                self.given = {**good, **change}
                self.fails(*words, python="/usr/bin/python3")


class Room(Hours):
    @classmethod
    def setUpClass(cls):
        cls.made = pathlib.Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.made)
        build(cls.made / "room.fmu")

    def setUp(self):
        super().setUp()
        shutil.copy(self.made / "room.fmu", self.folder)

    def rows(self):
        done = self.call()
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.folder / "hours.csv", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        self.assertEqual(rows[0], ["gas", "room"])
        return np.array(rows[1:], float)

    def test_hours_are_those_of_the_equation(self):
        expected = np.vstack([room(72, 364 * DAY, 250), room(24, 59 * DAY, 250)])
        np.testing.assert_allclose(self.rows(), expected, rtol=1e-6)
        self.given["warm_up_days"] = 2
        expected = np.vstack([room(120, 362 * DAY, 250)[48:], room(72, 57 * DAY, 250)[48:]])
        np.testing.assert_allclose(self.rows(), expected, rtol=1e-6)

    def test_effects_are_inputs_by_their_names(self):
        hours = np.arange(96)
        series = {"heating set-point": 2.0 * (hours % 24 >= 18), "gains": 5.0 * (hours % 24 < 6),
                  "aperture": hours * 0.1}
        sections = [(hook, k) for k, hook in enumerate(series)] + [("gains", 1)]
        (self.folder / "effects.toml").write_text("".join(
            f'[[effect]]\nname = "e{k}"\nhook = "{hook}"\nunit = "-"\nenters = "add"\ncolumn = "c{k}"\n'
            for hook, k in sections))
        np.savetxt(self.folder / "effects.csv", np.transpose(list(series.values())), delimiter=",", comments="",
                   header="c0,c1,c2")
        shift, gains = series["heating set-point"], 2 * series["gains"]     # twice the same input
        expected = np.vstack([room(72, 364 * DAY, 250, gains, shift), room(24, 59 * DAY, 250, gains[72:], shift[72:])])
        np.testing.assert_allclose(self.rows(), expected, rtol=1e-6)
        self.assertEqual((self.folder / "effects_left_out.txt").read_text(),
                         "e2: aperture: the FMU has no input aperture\n")

    def test_what_is_wrong_is_told(self):
        good = dict(self.given)
        for change, words in (({"parameters": {"heat_los": 1}}, ["parameters: 'heat_los'", "nearest: 'heat_loss'"]),
                              ({"meters": [{"name": "x", "output": "gains"}]}, ["'gains' is no output", "'heat'"]),
                              ({"parameters": {"heat_loss": -1}}, ["room.fmu", "expected an FMU for this system"]),
                              ({"fmu": "gone.fmu"}, ["gone.fmu"]), ({"fmu": "periods.csv"}, ["periods.csv"])):
            with self.subTest(change):
                self.given = {**good, **change}
                self.fails(*words)


if __name__ == "__main__":
    has_fmpy = pathlib.Path(PYTHON).exists() and subprocess.run(
        [PYTHON, "-c", "import fmpy"], capture_output=True, check=False).returncode == 0
    if not has_fmpy:
        ended = unittest.main(argv=[sys.argv[0], "WithoutFmpy"], exit=False)
        print(f"skipped: {HOW}")
        sys.exit(SKIPPED if ended.result.wasSuccessful() else 1)
    unittest.main()
