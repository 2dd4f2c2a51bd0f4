"""What a regression on outdoor temperature and the hour of the week makes of a loop's channels, fitted to the
readings of training that the loop saw. Temperatures, and what is not read by the hour, have none.
"""
import numpy as np

from report.regression import Regression, choose_plan
from report.result import HOURLY, MONTHLY

LEAST_READINGS = 1000          # a level for each hour of the week asks for six weeks


def rmse(simulated, measured):
    return np.sqrt(((simulated - measured) ** 2).mean())


def cv_rmse(simulated, measured):
    return 100 * rmse(simulated, measured) / measured.mean()


def monthly(times, values):
    months = times.astype("datetime64[s]").astype("datetime64[M]").astype(int)
    return np.array([values[months == month].sum() for month in np.unique(months)])


def readings(series):
    """Hours with a reading and a temperature: times, temperatures, readings."""
    if series.outdoor.size != series.time.size:
        return np.array([], int), np.array([]), np.array([])
    there = np.isfinite(series.measured) & np.isfinite(series.outdoor)
    return series.time[there].astype(np.int64), series.outdoor[there], series.measured[there]


def regression_errors(loop):
    """{(channel, period, resolution): CV(RMSE) [%]}"""
    errors = {}
    for channel in loop.of_channels:
        training = readings(loop.all_series[loop.periods[0]][channel.name])
        if channel.unit == "degC" or training[0].size < LEAST_READINGS:
            continue
        fit = Regression(choose_plan(*training), *training)
        for period in loop.periods:
            times, outdoor, measured = readings(loop.all_series[period][channel.name])
            if times.size == 0 or not measured.mean() > 0:
                continue
            predicted = fit.predict(times, outdoor)
            errors[channel.name, period, loop.resolutions[HOURLY]] = cv_rmse(predicted, measured)
            errors[channel.name, period, loop.resolutions[MONTHLY]] = \
                cv_rmse(monthly(times, predicted), monthly(times, measured))
    return errors
