"""A job: the TOML file that says what is known and what is asked, with its comments and its order.

A Job is a mapping of sections. What it holds are the tables of tomlkit, so that a file that is read and saved again
is the same to the letter where nothing was changed. Keys, units and paths are those of `bemcal-batch describe job`
and `describe parameters`; they are checked by the program (bemcal.check), not here.
Leaves out the files of single buildings that a job names in `buildings`: each is a Job of its own.
"""
from __future__ import annotations

import os
import pathlib
import re
from typing import Any, Dict, Iterator, List, Mapping, MutableMapping, Optional, Tuple, Union

import pandas as pd
import tomlkit

from . import items, readings
from .errors import Error, ExitCode

# Where a job names files, which lie beside it unless the name says otherwise.
FILE_KEYS: Dict[Tuple[str, ...], Tuple[str, ...]] = {
    (): ("buildings",), ("weather",): ("files",), ("meter",): ("file",), ("series",): ("file",),
    ("schedule",): ("register",), ("stock",): ("table", "folder", "template"), ("study",): ("field", "runs"),
    ("simulator",): ("files",), ("simulator", "template"): ("file",)}
# Of a meter: how its former file was to be read.
SOURCE_KEYS = ("file", "column", "time", "from", "to", "estimated", "stamp", "clock", "utc_offset", "time_format",
               "decimal", "thousands", "missing", "header_line", "skip", "gaps")
WEATHER = ("outdoor_temperature", "global_horizontal", "direct_normal", "diffuse_horizontal", "wind_speed",
           "relative_humidity", "cloud_cover", "infrared")

Path = Union[str, "os.PathLike[str]"]
Named = Tuple[str, ...]


def sections_at(content: Any, names: Named) -> Iterator[MutableMapping[str, Any]]:
    """All tables of that name, of lists each."""
    if isinstance(content, list):
        for each in content:
            yield from sections_at(each, names)
    elif isinstance(content, MutableMapping):
        if not names:
            yield content
        elif names[0] in content:
            yield from sections_at(content[names[0]], names[1:])


def moved(value: Any, since: pathlib.Path, to: pathlib.Path) -> Any:
    """The name of a file, or a list of them, as it is called from another folder."""
    if isinstance(value, list):
        return [moved(each, since, to) for each in value]
    return os.path.relpath(since / value, to) if isinstance(value, str) and not os.path.isabs(value) else value


def write_fresh(path: pathlib.Path, text: str) -> None:
    """Whole or not at all."""
    fresh = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        fresh.write_text(text, encoding="utf-8", newline="")
        os.replace(fresh, path)
    finally:
        fresh.unlink(missing_ok=True)


class Job(MutableMapping[str, Any]):
    """Sections and keys of a job file. `path` is the file that holds it, or None.

        job = bemcal.Job({"seed": 1, "zone": [{"name": "office", "floor_area": 1200}]})
        job["zone"][0]["volume"] = 3600
        job.at("zone.office")["class"] = "heavy"
        job.save("office.toml")
    """

    def __init__(self, content: Optional[Mapping[str, Any]] = None) -> None:
        self._document = tomlkit.document()
        self.path: Optional[pathlib.Path] = None
        self._saved = ""
        self._given = self._as_given = ""   # as read, and as tomlkit has it
        self._files: Dict[str, str] = {}    # name of a meter, "" = the weather: its CSV file as text
        given = content or {}
        tables = {key for key, value in given.items() if isinstance(value, Mapping) or items.is_list_of_tables(value)}
        for key in sorted(given, key=lambda key: key in tables):
            self._document.append(key, items.item_of(given[key]))

    @classmethod
    def from_toml(cls, text: str) -> "Job":
        """From the text of a job file. Error (CONFIG) where it is no TOML."""
        job = cls()
        job._take(text, "job")
        return job

    @classmethod
    def read(cls, path: Path) -> "Job":
        """From a job file, or from a folder NAME with NAME.toml."""
        file = pathlib.Path(path)
        if file.is_dir():
            file = file / (file.resolve().name + ".toml")
        try:
            text = file.read_bytes().decode("utf-8")
        except OSError as error:
            raise Error(f"{file}: {error.strerror}; expected a job file", ExitCode.NO_INPUT) from None
        except UnicodeDecodeError as error:
            raise Error(f"{file}: is no UTF-8: {error.reason}; expected a job file", ExitCode.CONFIG) from None
        job = cls()
        job._take(text, str(file))
        job.path, job._saved = file, text
        return job

    def to_toml(self) -> str:
        """The job file as text, to the letter as it was read where nothing was changed. Files of `meter` and `weather`
        get their names when it is saved."""
        text = tomlkit.dumps(self._document)
        return self._given if text == self._as_given else text

    def to_dict(self) -> Dict[str, Any]:
        """In values of Python, without comments."""
        content: Dict[str, Any] = self._document.unwrap()
        return content

    def __getitem__(self, key: str) -> Any:
        return self._document[key]

    def __setitem__(self, key: str, value: Any) -> None:
        items.replace(self._document, key, value)

    def __delitem__(self, key: str) -> None:
        del self._document[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._document)

    def __len__(self) -> int:
        return len(self._document)

    def __repr__(self) -> str:
        return f"<bemcal.Job {self.path or 'not saved'}: {', '.join(self) or 'empty'}>"

    def at(self, place: str) -> Any:
        """A section by names, as parameters have it in `target`: "zone.office.load.lights", "parameter.U_wall"."""
        found: Any = self._document
        for name in place.split("."):
            if isinstance(found, list):
                named = {str(each.get("name")): each for each in found if isinstance(each, Mapping)}
                found, there = named.get(name), named
            else:
                there = dict(found) if isinstance(found, Mapping) else {}
                found = there.get(name)
            if found is None:
                raise Error(f"{place}: there is no {name!r}; expected one of {readings.names_of(list(there))}",
                            ExitCode.USAGE)
        return found

    def put(self, place: str, **keys: Any) -> None:
        """Keys of a section: job.put("zone.office.load.lights", density={"value": 9, "schedule": "lights"})."""
        section = self.at(place)
        if not isinstance(section, MutableMapping):
            raise Error(f"{place} is no section; expected the path of one, without its key", ExitCode.USAGE)
        for key, value in keys.items():
            items.put(section, key, value)

    def add(self, place: str, **keys: Any) -> Any:
        """One more table of a list: job.add("zone.office.surface", construction="wall", area=300, azimuth=180)."""
        *names, section = place.split(".")
        parent: Any = self.at(".".join(names)) if names else self._document
        if not isinstance(parent.get(section, []), list):
            raise Error(f"{place} is no list of tables; expected one such as meter, parameter or study", ExitCode.USAGE)
        if parent.get(section):
            items.append(parent[section], keys)
        else:
            items.replace(parent, section, [keys])
        return parent[section][-1]

    def meter(self, name: str, data: readings.Table, unit: str, quantity: Optional[str] = None, *,
              column: Optional[str] = None, stamp: Optional[str] = None, **keys: Any) -> None:
        """Readings of a meter, a new one or another file of one that is there.

        data      a Series, or a DataFrame and its `column`, over a DatetimeIndex of equal steps; NaN = missing. With a
                  time zone each stamp is that instant; without one it is local standard time, unless `clock` says "eu"
                  or "us". With interval="monthly" rows are months or bills
        unit      of the readings: "kWh", "kW", "m3", "degC", ... (energies are of a step, not counted on)
        quantity  what of the model it is held against: "gas", "electricity", "district", "heating", "cooling",
                  "air_temperature"; default: that of the meter that is there, else its name
        stamp     "start" or "end" of the step; default: start, but rows on last days of months and weeks have to say it
        keys      others of [[meter]]: interval, gaps="missing" (absent rows), tariff, zeros, ...
        """
        what = f"meter {name}"
        frame = readings.column_of(data, column, name, what)
        said = {} if stamp is None else {"stamp": stamp}
        self._files[name] = readings.csv_of(frame, what, {**said, **keys})
        # Without a word the program looks itself whether rows are months or quarters.
        default = {} if keys.get("interval") in readings.BY_CALENDAR else {"stamp": "start"}
        keys = {**default, **said, **keys}
        rows = [row for row in self.get("meter", []) if row.get("name") == name]
        row = rows[0] if rows else self.add("meter", name=name, quantity=quantity or name)
        more = {} if quantity is None else {"quantity": quantity}
        asked = {**more, "file": "", "column": name, "unit": unit, **keys}     # the file's name comes when it is saved
        for key in SOURCE_KEYS:
            if key not in asked:
                row.pop(key, None)
        for key, value in asked.items():
            items.put(row, key, value)
        self._saved = ""

    def weather(self, data: pd.DataFrame, latitude: float, longitude: float, utc_offset: Optional[float] = None, *,
                elevation: Optional[float] = None, columns: Optional[Mapping[str, Any]] = None,
                stamp: str = "start", **keys: Any) -> None:
        """Hourly weather in place of what the job has, and the site that it is of.

        data        a DataFrame over a DatetimeIndex, as of `meter`; NaN = missing. Its columns are called
                    outdoor_temperature [degC], global_horizontal, direct_normal, diffuse_horizontal [W/m2] (two of the
                    three), wind_speed [m/s], relative_humidity [%], cloud_cover [0 to 1], infrared [W/m2]
        latitude    [deg] north positive
        longitude   [deg] east positive
        utc_offset  local standard time minus UTC [h]; default: the job's, else that of the index's time zone
        elevation   [m]
        columns     other names: {"outdoor_temperature": "T", "direct_normal": {"column": "DNI", "unit": "kJ/m2"}}
        keys        others of [weather]: fill_gaps, gaps, sky, ...
        """
        names = columns if columns is not None else \
            {name: name for name in WEATHER if name in getattr(data, "columns", ())}
        asked = [str(name["column"] if isinstance(name, Mapping) else name) for name in names.values()]
        frame = readings.columns_of(data, asked, "weather")
        if not names:
            raise readings.refused("weather", f"has none of the columns {readings.names_of(WEATHER)}; "
                                              "columns={...} says what others are called")
        keys = {"stamp": stamp, **keys}
        text = readings.csv_of(frame, "weather", keys)
        if utc_offset is None:
            utc_offset = self.get("site", {}).get("utc_offset")
        if utc_offset is None:
            utc_offset = readings.standard_offset(frame, "weather")
        place = {"latitude": latitude, "longitude": longitude, "utc_offset": utc_offset, "elevation": elevation}
        if "site" not in self:
            self["site"] = {}
        for key, value in place.items():
            if value is not None:
                items.put(self["site"], key, value)
        section = items.section_of({"files": [], "format": "csv", **keys})
        section.append("columns", items.section_of(names))
        self["weather"] = section
        self._files[""], self._saved = text, ""

    def save(self, path: Optional[Path] = None, force: bool = False) -> pathlib.Path:
        """Writes the job, and beside it NAME_METER.csv and NAME_weather.csv of what was given by `meter` and `weather`.

        path   default: the file that the job was read from or saved to
        force  writes over files that are there; else these are an Error (CANNOT_CREATE)

        Names of other files are changed so that they are found from the new folder. Returns the path.
        """
        if path is None and self.path is None:
            raise Error("the job has no file yet; expected a path: job.save(\"office.toml\")", ExitCode.USAGE)
        file = pathlib.Path(path if path is not None else self.path)  # type: ignore[arg-type]
        sections = self._sections_of_files()
        tables = {name: file.with_name(f"{file.stem}_{re.sub(r'[^-+.0-9A-Za-z]+', '_', name or 'weather')}.csv")
                  for name in sections}
        self._refuse([file, *tables.values()], force)
        self._spare_inputs(file, list(tables.values()), list(sections.values()))
        self._move_to(file)
        for name, table in tables.items():
            sections[name]["file" if name else "files"] = table.name if name else [table.name]
        text = self.to_toml()
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            for name, table in tables.items():
                write_fresh(table, self._files[name])
            write_fresh(file, text)
        except OSError as error:
            raise Error(f"{file}: cannot be written: {error.strerror}", ExitCode.IO) from None
        self._saved = text
        return file

    def file(self) -> pathlib.Path:
        """The file that holds the job as it is now; an Error where none does."""
        if self.path is None or self.to_toml() != self._saved:
            raise Error("the job " + ("has no file yet: job.save(\"office.toml\")" if self.path is None else
                                      f"is not as {self.path} has it: job.save(force=True), or another name"),
                        ExitCode.USAGE)
        return self.path

    def _take(self, text: str, name: str) -> None:
        self._document = items.parsed(text, name)
        self._given, self._as_given = text, tomlkit.dumps(self._document)

    def _sections_of_files(self) -> Dict[str, Any]:
        """Those that are still there, of what was given by `meter` and `weather`."""
        found = {str(row.get("name")): row for row in self.get("meter", [])}
        if "weather" in self:
            found[""] = self["weather"]
        return {name: found[name] for name in self._files if name in found}

    def _spare_inputs(self, file: pathlib.Path, tables: List[pathlib.Path], own: List[Any]) -> None:
        """What a section reads that got no table by now is not written over."""
        folder = (self.path or file).parent
        for place, keys in FILE_KEYS.items():
            for section in sections_at(self._document, place):
                values = [] if any(section is each for each in own) else [section.get(key, []) for key in keys]
                for name in (name for value in values for name in (value if isinstance(value, list) else [value])):
                    if os.path.realpath(folder / str(name)) in map(os.path.realpath, tables):
                        raise Error(f"{folder / str(name)}: is read by another section of the job; expected another "
                                    "name of the job or of the meter", ExitCode.CANNOT_CREATE)

    @staticmethod
    def _refuse(files: List[pathlib.Path], force: bool) -> None:
        twice = [file for file in files if files.count(file) > 1]
        if twice:
            raise Error(f"{twice[0]}: would be written twice; expected names that differ in letters and digits",
                        ExitCode.CANNOT_CREATE)
        there = [file for file in files if file.exists()]
        if there and not force:
            raise Error(f"{there[0]}: is there already; force=True writes over it", ExitCode.CANNOT_CREATE)

    def _move_to(self, file: pathlib.Path) -> None:
        """Files beside the job that was read stay where they are, and are called from there."""
        since, to = (self.path or file).parent.resolve(), file.parent.resolve()
        self.path, self._saved = file, ""
        if since == to:
            return
        for names, keys in FILE_KEYS.items():
            for section in sections_at(self._document, names):
                for key in keys:
                    if key in section:
                        section[key] = moved(items.plain(section[key]), since, to)
