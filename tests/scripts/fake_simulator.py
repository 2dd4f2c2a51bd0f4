"""Adds to a made loop's result what one around another program stores: two parameters, an effect of three hours."""
import h5py
import numpy as np

from fake_loop_result import text

TEXTS = {
    "simulator_parameter": ["u_wall", "leaks"], "simulator_parameter_unit": ["-", "1/h"],
    "simulator_given": ["wind infiltration", "blinds"], "simulator_given_hooks": ["infiltration", "aperture"],
    "simulator_series_hook": ["infiltration"],
    "simulator_series_unit": ["1/h"], "simulator_series_enters": ["add"], "simulator_series_facade": [""],
    "simulator_series_meter": [""], "simulator_left_out": ["blinds: there are none"],
    "simulator_run": ["design", "design", "calibration"], "simulator_run_failure": ["", "severe", ""],
    "simulator_channel": ["gas"]}
NUMBERS = {
    "simulator_parameter_least": [0.5, 0], "simulator_parameter_most": [2, 1], "simulator_parameter_plain": [1, 0.5],
    "simulator_parameter_before": [1.2, 0.4], "simulator_parameter_after": [1.25, 0.125],
    "simulator_given_scale": [0.9, 0], "simulator_series_of": [0], "simulator_series_value": [[0.1, 0.2, 0.3]],
    "simulator_run_distance": [40, np.nan, 0], "simulator_emulator_error": [2.5]}


def add_to(path, stage="office/loop"):
    with h5py.File(path, "a") as file:
        for name, values in TEXTS.items():
            text(file[stage], name, values)
        for name, values in NUMBERS.items():
            file[stage][name] = np.array(values, dtype=float)
