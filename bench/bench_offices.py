#!/usr/bin/python3
"""Unseen offices: each of the ten in jobs/offices_pooled is left out in turn, and predicted from
its description and weather by what the other nine tell; gd_11 is predicted from all ten.

Cooling + heating, hour by hour and by month, against the readings of both years: CV(RMSE) with the
design values and after calibration, and the share of hours within the 90 % interval: of all, and of
those in which something was metered. Errors were learned of hours in which a meter is in use: the
sum's interval is that of the meter with the larger prediction. Prints a table, with each posterior's largest rank R-hat and fewest effective draws (of
one that has not converged they say how far it is), then lines `name value unit reference ratio`,
and writes gd_11.csv. Needs the readings in ../shared.

The job's chains are one item of work, of one thread; as many offices as there are cores are left
out at a time. BEMCAL_PROGRAM may name another program than the release build's.

    bench_offices.py [--only gd_03 ...] [--set KEY=VALUE ...] [--at-once N] [--csv FILE]
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

import h5py
import numpy
import pandas

import large_job

JOB = large_job.ROOT / "jobs" / "offices_pooled" / "job.toml"
CASES = large_job.ROOT.parent / "shared" / "cases" / "guangdong_offices"
OFFICES = [f"gd_{k:02d}" for k in range(1, 11)]
KEPT_BACK = "gd_11"
NOT_CONVERGED = 1  # of the program; its result is whole
COLUMNS = ("office", "design hourly", "hourly", "design monthly", "monthly", "bias", "coverage",
           "coverage > 0", "R-hat", "ESS")


def job_without(office, folder, changes):
    """The job with that office unseen, and with other values of its study's keys."""
    text = JOB.read_text()
    text = re.sub(r'"(gd_\d\d\.toml)"', lambda m: f'"{JOB.parent / m[1]}"', text)
    text = re.sub(r"(?m)^unseen = .*", f'unseen = ["{office}"]', text)
    for change in changes:
        key, value = change.split("=", 1)
        text = re.sub(rf"(?m)^{key} = .*", f"{key} = {value}", text)
    if office != KEPT_BACK:
        text = re.sub(rf'(?m)^.*/{KEPT_BACK}\.toml",?\n', "", text)
    job = pathlib.Path(folder) / f"without_{office}.toml"
    job.write_text(text)
    return job


def run(job):
    result = job.with_suffix(".h5")
    done = subprocess.run([large_job.PROGRAM, "run", job, "--no-report", "-o", result, "--threads", "1"],
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if done.returncode not in (0, NOT_CONVERGED):
        sys.exit(f"bench_offices: {job}: exit code {done.returncode}\n{done.stderr}")
    return result


def meter_of(file, office, meter):
    """An office's meter, of all periods in the order of time."""
    def table(group):
        return pandas.DataFrame({leaf: values[:] for leaf, values in group.items()
                                 if isinstance(values, h5py.Dataset) and values.shape})
    found = [table(period[meter]) for period in file["posterior"][office].values()]
    hours = pandas.concat(found).sort_values("time")
    return hours.set_index(pandas.to_datetime(hours.time, unit="s"))


def prediction(result, office):
    """Cooling + heating [kWh] by hour: design values, mean, 5 % and 95 % quantile."""
    with h5py.File(result) as file:
        cold, heat = (meter_of(file, office, meter) for meter in ("cold", "heat"))
    total = {leaf: cold[leaf] + heat[leaf] for leaf in ("nominal", "predicted_mean")}
    heats = heat["predicted_mean"] > cold["predicted_mean"]
    for leaf in ("predicted_q05", "predicted_q95"):
        off = [meter[leaf] - meter["predicted_mean"] for meter in (heat, cold)]
        total[leaf] = (total["predicted_mean"] + numpy.where(heats, *off)).clip(lower=0)
    return pandas.DataFrame(total | {"heat": heat["predicted_mean"],
                                     "cool": cold["predicted_mean"]})


def convergence(result):
    """Largest rank R-hat, fewest effective draws of all unknowns."""
    with h5py.File(result) as file:
        of = {name: file["posterior"][name][:] for name in ("rhat_rank", "ess_bulk", "ess_tail")}
    return [of["rhat_rank"].max(), min(of["ess_bulk"].min(), of["ess_tail"].min())]


def measured(office):
    table = pandas.read_csv(CASES / office / "measured.csv", parse_dates=[0], index_col=0)
    table.index -= pandas.Timedelta(hours=1)
    return table.heat_kWh + table.cool_kWh


def cv_rmse(simulated, readings):
    return 100 * numpy.sqrt(((simulated - readings) ** 2).mean()) / readings.mean()


def by_month(series):
    return series.groupby([series.index.year, series.index.month]).sum()


def errors_of(predicted, readings):
    """Of the hours with both readings, and of their sums by month."""
    predicted, readings = predicted[readings.notna()], readings.dropna()
    mean = predicted.predicted_mean
    within = (readings >= predicted.predicted_q05) & (readings <= predicted.predicted_q95)
    return [cv_rmse(predicted.nominal, readings), cv_rmse(mean, readings),
            cv_rmse(by_month(predicted.nominal), by_month(readings)),
            cv_rmse(by_month(mean), by_month(readings)),
            100 * (mean.sum() / readings.sum() - 1), 100 * within.mean(),
            100 * within[readings > 0].mean()]


def predicted_without(office, changes):
    with tempfile.TemporaryDirectory() as folder:
        result = run(job_without(office, folder, changes))
        return prediction(result, office), convergence(result)


def row_of(office, predicted, converged):
    row = [*errors_of(predicted, measured(office)), *converged]
    print(f"{office:<8}" + "".join(f"{value:15.1f}" for value in row[:-2]) +
          f"{row[-2]:15.3f}{row[-1]:15.0f}", flush=True)
    return row


def print_results(rows):
    errors = numpy.array(list(rows.values()))
    median = numpy.median(errors, axis=0)
    print(f"{'median':<8}" + "".join(f"{value:15.1f}" for value in median[:-2]))
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    better = int((errors[:, 1] < errors[:, 0]).sum())
    for name, value, unit, reference in (
            ("offices_hourly", median[1], "%", 30), ("offices_monthly", median[3], "%", 15),
            ("offices_hourly_design", median[0], "%", 153.98),
            ("offices_monthly_design", median[2], "%", 33.13),
            ("offices_better_than_design", better, "offices", 8),
            ("offices_coverage", median[5], "%", 90),
            ("offices_coverage_in_use", median[6], "%", 90),
            ("offices_worst_rhat", errors[:, 7].max(), "-", 1.01),
            ("offices_least_ess", errors[:, 8].min(), "draws", 400),
            ("offices_processor_time", (used.ru_utime + used.ru_stime) / 60, "min", 20)):
        print(f"{name} {value:.2f} {unit} {reference} {value / reference:.3f}")


def write_kept_back(predicted, path):
    table = pandas.DataFrame({"heat_kWh": predicted.heat, "cool_kWh": predicted.cool,
                              "q05": predicted.predicted_q05, "q95": predicted.predicted_q95})
    table.index = (predicted.index + pandas.Timedelta(hours=1)).strftime("%Y-%m-%dT%H:%M:%S")
    pathlib.Path(path).parent.mkdir(parents=True, exist_ok=True)
    table.to_csv(path, index_label="timestamp", float_format="%.3f")
    print(f"wrote {path}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--only", nargs="*", default=OFFICES, help="leave these out only")
    parser.add_argument("--set", nargs="*", default=[], help="other values of the study's keys")
    parser.add_argument("--at-once", type=int, default=len(os.sched_getaffinity(0)),
                        help="offices at a time; default: the cores")
    parser.add_argument("--csv", help="predict gd_11 into this file")
    options = parser.parse_args()
    if not CASES.exists():
        print(f"skipped: no readings in {CASES}")
        return
    print(f"{COLUMNS[0]:<8}" + "".join(f"{name:>15}" for name in COLUMNS[1:]))
    offices = [*options.only, KEPT_BACK]
    rows = {}
    with concurrent.futures.ThreadPoolExecutor(options.at_once) as pool:
        runs = {office: pool.submit(predicted_without, office, options.set) for office in offices}
        for office in options.only:
            rows[office] = row_of(office, *runs[office].result())
        kept_back, _ = runs[KEPT_BACK].result()
        print_results(rows)
        write_kept_back(kept_back,
                        options.csv or large_job.ROOT / "build" / "bench" / "gd_11.csv")


if __name__ == "__main__":
    main()
