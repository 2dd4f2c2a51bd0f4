"""Values of Python as the sections and keys of a job file.

A dictionary of plain values inside of a section stands in a line, {value = 21, schedule = "work"}; a list of
dictionaries becomes tables of a list, [[zone]]. Source: TOML 1.0; tomlkit writes it and keeps comments.
Leaves out what TOML has no word for: an Error names it.
"""
from __future__ import annotations

import datetime
import os
from typing import Any, List, Mapping, Optional, Sequence

import numpy as np
import tomlkit
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import AoT, InlineTable, Item, Table

from . import _job_text
from .errors import Error, ExitCode

MIDNIGHT = datetime.time()


def of_numpy(value: Any) -> Any:
    """As a value of Python. Times are so whatever their resolution is; NaT becomes None."""
    if not isinstance(value, (np.generic, np.ndarray)):
        return value
    return (value.astype("datetime64[us]") if value.dtype.kind == "M" else value).tolist()


def is_missing(time: datetime.datetime) -> bool:
    """NaT, which alone is not itself."""
    return time != time


def is_time_of_day(value: Any) -> bool:
    """No midnight, or one with a time zone: the program refuses that."""
    if not isinstance(value, datetime.datetime) or is_missing(value):
        return False
    return value.tzinfo is not None or value.time() != MIDNIGHT


def time_text(time: datetime.datetime, is_day: bool) -> Optional[str]:
    """None of NaT, which TOML does not know."""
    if is_missing(time):
        return None
    return time.date().isoformat() if is_day else time.isoformat(sep=" ")


def plain(value: Any) -> Any:
    """As TOML knows it: numbers of numpy, days and times (as texts, which the job's are) and paths.

    A midnight is a day, which a period that ends with it includes; beside times of day it is one of these."""
    value = of_numpy(value)
    if isinstance(value, datetime.datetime):
        return time_text(value, is_day=not is_time_of_day(value))
    if isinstance(value, datetime.date):
        return value.isoformat()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, (list, tuple)):
        return plain_list([of_numpy(each) for each in value])
    return value


def plain_list(values: Sequence[Any]) -> List[Any]:
    are_times = any(map(is_time_of_day, values))
    return [time_text(each, is_day=False) if are_times and isinstance(each, datetime.datetime) else plain(each)
            for each in values]


def is_list_of_tables(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(each, Mapping) for each in value)


def is_flat(value: Mapping[str, Any]) -> bool:
    return not any(isinstance(each, Mapping) or is_list_of_tables(each) for each in value.values())


def section_of(content: Mapping[str, Any]) -> tomlkit.items.Table:
    """[a section]; its own keys come before its tables, as TOML has it."""
    table = tomlkit.table()
    later = {}
    for key, value in content.items():
        if is_list_of_tables(value) or isinstance(value, Mapping) and not is_flat(value):
            later[key] = value
        else:
            table.append(key, in_line(value))
    for key, value in later.items():
        table.append(key, item_of(value))
    return table


def in_line(value: Any) -> Item:
    """A table as {...}, a list of these as [{...}]; all else as it is."""
    if isinstance(value, Mapping) and not isinstance(value, InlineTable):
        table = tomlkit.inline_table()
        for key, each in value.items():
            table.append(key, in_line(each))
        return table
    if is_list_of_tables(value):
        rows = tomlkit.array()
        for each in value:
            rows.append(in_line(each))
        return rows
    return item_of(value)


def put(section: Any, key: str, value: Any) -> None:
    """A key of a section, in its place or behind the last one; comments above the next section stay there."""
    is_in_line = isinstance(section, InlineTable)
    item = in_line(value) if is_in_line or isinstance(value, Mapping) else item_of(value)
    last = [each for each, _ in section.value.body if each is not None][-1:]
    if key in section or is_in_line or not last or isinstance(section[last[0]], (AoT, Table)):
        section[key] = item
    else:
        section.value._insert_after(last[0], key, item)     # tomlkit's own way would be behind the comments


def replace(parent: Any, key: str, value: Any) -> None:
    """A section, key or list of tables. One that is of another kind than before goes where its kind stands: tomlkit
    would leave keys behind tables."""
    are_none = isinstance(value, list) and not value and isinstance(parent.get(key), AoT)
    item = tomlkit.aot() if are_none else item_of(value)
    if key in parent and (isinstance(item, (AoT, Table)) != isinstance(parent[key], (AoT, Table)) or not parent[key]):
        del parent[key]
    parent[key] = item


def append(rows: Any, keys: Mapping[str, Any]) -> None:
    """One more table of a list. Comments below the last one are meant for what follows: they stay last."""
    if not isinstance(rows, AoT):
        rows.append(in_line(keys))
        return
    row = section_of(keys)
    body = rows[-1].value.body if len(rows) else []
    while body and body[-1][0] is None:
        row.value.body.insert(len(keys), body.pop())
    rows.append(row)


def item_of(value: Any) -> Item:
    """What stands for a value of Python in a job file; one of tomlkit stands for itself."""
    if isinstance(value, Item):
        return value
    if isinstance(value, Mapping):
        return section_of(value)
    if is_list_of_tables(value):
        tables = tomlkit.aot()
        for each in value:
            tables.append(section_of(each))
        return tables
    try:
        item: Item = tomlkit.item(plain(value))
        return item
    except (TypeError, ValueError, TOMLKitError):
        raise Error(f"{value!r} is a {type(value).__name__}; expected what TOML knows: texts, numbers, true or false, "
                    "dates, lists and tables", ExitCode.CONFIG) from None


def parsed(text: str, name: str) -> tomlkit.TOMLDocument:
    try:
        document: tomlkit.TOMLDocument = _job_text.parse(text)
        return document
    except (ValueError, TOMLKitError) as error:
        raise Error(f"{name}: is no TOML that can be changed: {error}", ExitCode.CONFIG) from None
