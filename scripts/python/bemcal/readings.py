"""Tables of pandas as the CSV files that the program reads: a time stamp and a column for each series.

Stamps with a time zone keep their offset from UTC, by which the program finds the site's local standard time;
those without stand as they are, and the job says what clock they follow. A value that is missing is an empty
cell. Checked are here the things that a CSV file would hide: kinds of index and values, and the steps.
Leaves out what the program checks of any file: absent rows, clocks, units, zeros, spikes.
"""
from __future__ import annotations

from typing import Any, Iterable, Mapping, Optional, Sequence, Union

import numpy as np
import pandas as pd
from pandas.tseries.frequencies import to_offset

from .errors import Error, ExitCode

PART_OF_STEP = 12                       # a stamp may lie by such a part of the step beside it: the program moves it
BY_CALENDAR = ("monthly", "annual")     # intervals whose rows are months, years and bills, of any length
WALL_CLOCKS = ("eu", "us")              # clocks that repeat an hour
DAY = pd.Timedelta(days=1)
MONTH = pd.Timedelta(days=28)

Table = Union[pd.Series, pd.DataFrame]


def refused(what: str, message: str) -> Error:
    return Error(f"{what}: {message}", ExitCode.DATA)


def time_index(data: Table, what: str) -> pd.DatetimeIndex:
    """Its index as begins, of periods too."""
    index = data.index
    if isinstance(index, pd.PeriodIndex):
        index = index.to_timestamp(how="start")
    if not isinstance(index, pd.DatetimeIndex):
        raise refused(what, f"its index is a {type(index).__name__}; expected a DatetimeIndex: "
                            "data.index = pd.to_datetime(data.index)")
    if not len(index):
        raise refused(what, "has no rows; expected one for each step")
    check_stamps(index, what)
    return index


def check_stamps(index: pd.DatetimeIndex, what: str) -> None:
    """Each row has one."""
    missing = np.flatnonzero(np.asarray(index.isna()))
    if missing.size:
        raise refused(what, f"its index has stamps that are missing (NaT): {missing.size} of {len(index)}, the first "
                            f"in row {missing[0]}, counted from 0; expected one in each row: mend the texts that "
                            "pd.to_datetime could not read, or leave these rows out by data[data.index.notna()]")


def check_order(index: pd.DatetimeIndex, what: str) -> None:
    """Each time once. An hour that comes twice is that of a wall clock."""
    steps = index[1:] - index[:-1]
    wrong = np.flatnonzero(np.asarray(steps <= pd.Timedelta(0)))
    if not wrong.size:
        return
    k = int(wrong[0])
    advice = "sort_index() and drop what comes twice" if index.tz is not None else \
        'a wall clock has a zone: data.tz_localize("Europe/Berlin", ambiguous="infer"); else sort_index()'
    raise refused(what, f"{index[k + 1]} does not come after the row before it, {index[k]}; {advice}")


def check_steps(index: pd.DatetimeIndex, what: str) -> None:
    """All distances of rows are whole steps, or nearly so; days are those of the calendar."""
    steps = index[1:] - index[:-1]
    if not len(steps):
        return
    step = steps.value_counts().index[0]
    if step + step / PART_OF_STEP >= DAY and index.tz is not None:
        check_steps(index.tz_localize(None), what)
        return
    beside = np.minimum(steps % step, step - steps % step)
    wrong = np.flatnonzero(np.asarray(beside * PART_OF_STEP > step))
    if wrong.size:
        k = int(wrong[0])
        if step >= MONTH:
            raise refused(what, "its rows are months or bills; expected interval=\"monthly\"")
        raise refused(what, f"{index[k + 1]} comes {steps[k]} after the row before it, and most rows {step}; expected "
                            f"equal steps: data.resample({to_offset(step).freqstr!r}) with .sum() of energies and "
                            ".mean() of all else")


def check_values(data: pd.DataFrame, what: str) -> pd.DataFrame:
    """As numbers; NaN = missing."""
    try:
        numbers = data.astype(float)
    except (TypeError, ValueError) as error:
        raise refused(what, f"has values that are no numbers: {error}") from None
    infinite = np.isinf(numbers.to_numpy()).any(axis=1)
    if infinite.any():
        raise refused(what, f"has an infinite value at {data.index[int(np.argmax(infinite))]}; "
                            "expected NaN where a value is missing")
    return numbers


def check_months(index: pd.DatetimeIndex, what: str) -> None:
    """Of rows by the calendar, where nobody said what a stamp is: pandas' own months are called by their last day."""
    if len(index) > 1 and index.is_month_end.all():
        raise refused(what, "its stamps are last days of months; expected stamp=\"end\", or stamp=\"start\" of bills "
                            "that begin on them")


def check_weeks(index: pd.DatetimeIndex, what: str, stamp: Optional[str]) -> None:
    """pandas' own weeks are called by their last day, which ends a day later."""
    if len(index) > 1 and (index[1:] - index[:-1]).min() == 7 * DAY and \
            (stamp is None or stamp == "end" and str(index.freqstr).startswith("W-")):
        raise refused(what, "its rows are weeks, which pandas calls by their last day; expected "
                            "data.to_period(\"W\"), or stamp=\"start\" of stamps that are first days")


def stamps_of(index: pd.DatetimeIndex, by_date: bool) -> "list[str]":
    """2022-03-27 03:00:00+02:00; a date alone of months and bills."""
    if by_date:
        return [str(day) for day in index.strftime("%Y-%m-%d")]
    return [time.isoformat(sep=" ") for time in index]


def csv_of(data: pd.DataFrame, what: str, keys: Mapping[str, Any]) -> str:
    """The file. `keys` are those of the job's section, which say how it will be read."""
    index, numbers = time_index(data, what), check_values(data, what)
    is_by_calendar = keys.get("interval") in BY_CALENDAR
    if not is_by_calendar and not isinstance(data.index, pd.PeriodIndex):
        check_weeks(index, what, keys.get("stamp"))
    if keys.get("clock") not in WALL_CLOCKS or index.tz is not None:
        check_order(index, what)
        if not is_by_calendar:
            check_steps(index, what)
    if is_by_calendar and "stamp" not in keys:
        check_months(index, what)
    numbers.index = pd.Index(stamps_of(index, is_by_calendar), name="time")
    return str(numbers.to_csv(lineterminator="\n"))


def column_of(data: Table, column: Optional[str], name: str, what: str) -> pd.DataFrame:
    """One column, called `name`."""
    if isinstance(data, pd.Series):
        return data.to_frame(name)
    if not isinstance(data, pd.DataFrame):
        raise refused(what, f"is a {type(data).__name__}; expected a Series or DataFrame of pandas")
    if column is None and data.shape[1] == 1:
        column = data.columns[0]
    if column is None or column not in data.columns:
        raise refused(what, f"column={column!r}; expected one of {names_of(data.columns)}")
    check_once(data, column, what)
    return data[[column]].set_axis([name], axis=1)


def check_once(data: pd.DataFrame, column: Any, what: str) -> None:
    """A name that several columns have says none of them."""
    places = np.atleast_1d(np.arange(data.shape[1])[data.columns.get_loc(column)])
    if places.size > 1:
        raise refused(what, f"has {places.size} columns {column!r}, number {', '.join(map(str, places))} counted from "
                            "0; expected one: choose by number, data.iloc[:, [...]], or leave out what comes twice, "
                            "data.loc[:, ~data.columns.duplicated()]")


def columns_of(data: pd.DataFrame, columns: Sequence[str], what: str) -> pd.DataFrame:
    """Those of a frame, in this order."""
    if not isinstance(data, pd.DataFrame):
        raise refused(what, f"is a {type(data).__name__}; expected a DataFrame of pandas")
    lacking = [column for column in columns if column not in data.columns]
    if lacking:
        raise refused(what, f"has no column {lacking[0]!r}; it has {names_of(data.columns)}")
    for column in columns:
        check_once(data, column, what)
    return data[list(columns)]


def names_of(names: Iterable[Any]) -> str:
    return ", ".join(repr(name) for name in names) or "none"


def standard_offset(data: Table, what: str) -> float:
    """Of the time zone of an index, without summer time [h]."""
    index = time_index(data, what)
    if index.tz is None or index[0].tzname() == "UTC":
        raise refused(what, "utc_offset is not given, and "
                      + ("its index has no time zone" if index.tz is None else "its index is in UTC")
                      + "; expected local standard time minus UTC [h]: utc_offset=1 for Berlin")
    year = index[0].year
    offsets = [pd.Timestamp(year, month, 1).tz_localize(index.tz).utcoffset() for month in range(1, 13)]
    return min(offset.total_seconds() for offset in offsets if offset is not None) / 3600
