#!/usr/bin/python3
"""A posterior's groups open in xarray as ArviZ wants them, and in ArviZ where it is installed."""
import os
import pathlib
import subprocess
import sys
import tempfile

try:
    import xarray
except ImportError:
    print("no xarray: skipped")
    sys.exit(77)

HERE = pathlib.Path(__file__).resolve().parent
GROUPS = ["posterior", "sample_stats", "prior", "observed_data", "posterior_predictive"]


def make_result(path):
    """Runs the small posterior; it misses its target, which is exit code 1."""
    run = subprocess.run(
        ["bash", "-c", f'. "{HERE}/small_posterior.sh"; "$BEMCAL_PROGRAM" run "$job" --no-report -o "{path}"'],
        env=os.environ | {"OMP_NUM_THREADS": "1"}, capture_output=True, text=True, check=False)
    assert run.returncode == 1, run.stdout + run.stderr


def check_groups(groups):
    draws = groups["posterior"]
    for name in ["lights", "equipment"]:
        assert draws[name].dims == ("chain", "draw"), draws
        assert draws[name].shape == (4, 60), draws
        assert draws[name].attrs["units"] == "W/m2", draws[name].attrs
        assert groups["prior"][name].dims == ("chain", "draw"), groups["prior"]
    assert (draws.lights > 7).all() and (draws.lights < 11).all()
    assert groups["sample_stats"].lp.shape == (4, 60), groups["sample_stats"]
    observed = groups["observed_data"].electricity
    predicted = groups["posterior_predictive"].electricity
    assert observed.shape == (31 * 24,), observed
    assert predicted.dims[:2] == ("chain", "draw") and predicted.shape[2] == 31 * 24, predicted


def check_arviz(groups):
    try:
        import arviz
    except ImportError:
        print("no arviz: its part is skipped")
        return
    summary = arviz.summary(arviz.InferenceData(**groups))
    assert abs(summary["mean"]["lights"] - float(groups["posterior"].lights.mean())) < 0.01


with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder) / "posterior.h5"
    make_result(file)
    opened = {name: xarray.open_dataset(file, group=f"quickstart/posterior/{name}") for name in GROUPS}
    check_groups(opened)
    check_arviz(opened)
