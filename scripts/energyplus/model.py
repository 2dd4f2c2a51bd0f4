"""Objects of an EnergyPlus model in its JSON form (epJSON): {class: {name: {field: value}}}.

EnergyPlus compares names without regard to case, and so does this. Values are changed in place; the file that was read
is never written over. Leaves out IDF text, which EnergyPlus itself converts (`program`).
"""
import copy
import json
import pathlib

from energyplus.failed import Failed, read_text

# Fields that EnergyPlus 9.6 renamed when it brought spaces: {new name: (old names)}.
RENAMED = {"zone_or_zonelist_or_space_or_spacelist_name": ("zone_or_zonelist_name", "zone_name")}
WITH_SPACES = (9, 6)
ZONE = "zone_or_zonelist_or_space_or_spacelist_name"


def version_of(said):
    """(major, minor) of "25.2" or "25.2.0"."""
    numbers = [int(part) for part in str(said).strip().split(".")[:2] if part.isdigit()]
    return tuple(numbers) if len(numbers) == 2 else None


class Model:
    """What is read from `path`; `says` names it in messages."""

    def __init__(self, objects, path="model"):
        self.objects, self.path = objects, path
        self.schema = None         # path of EnergyPlus's own names of classes and fields, where it is known
        self.classes = {kind.lower(): kind for kind in objects}
        self.version = version_of(self.said_version())
        if self.version is None:
            raise Failed(f'{path}: Version: {self.said_version()!r} is no version; expected one like "25.2"')

    def said_version(self):
        return next((fields.get("version_identifier") for fields in self.objects.get("Version", {}).values()), None)

    def copy(self):
        made = Model(copy.deepcopy(self.objects), self.path)
        made.schema = self.schema
        return made

    def fields_of(self, kind):
        """Names that a class may have: by the schema, else those that its objects have."""
        try:
            found = json.loads(pathlib.Path(self.schema or "").read_text(encoding="utf-8"))["properties"]
            return list(next(iter(found[self.classes[kind.lower()]]["patternProperties"].values()))["properties"])
        except (OSError, LookupError, StopIteration, ValueError):
            return list(dict.fromkeys(key for _, fields in self.all(kind) for key in fields))

    def all(self, kind):
        """[(name, fields)] of a class; empty where there is none."""
        return list(self.objects.get(self.classes.get(kind.lower(), kind), {}).items())

    def names(self, beginning):
        """Classes that begin so, as written."""
        return [kind for kind in self.objects if kind.lower().startswith(beginning.lower())]

    def find(self, kind, name):
        """Fields of an object, None where it is not there."""
        return next((fields for each, fields in self.all(kind) if each.lower() == str(name).lower()), None)

    def add(self, kind, name, fields):
        """A new object; in files before 9.6 with the names of that time."""
        if self.version < WITH_SPACES:
            fields = {RENAMED.get(key, (key,))[0]: value for key, value in fields.items()}
        kind = self.classes.setdefault(kind.lower(), kind)
        if self.find(kind, name) is not None:
            raise Failed(f"{self.path}: {kind} {name!r}: stands there already; rename it")
        self.objects.setdefault(kind, {})[name] = fields

    def remove(self, *kinds):
        for kind in kinds:
            self.objects.pop(self.classes.pop(kind.lower(), kind), None)

    def remove_beginning(self, beginning):
        self.remove(*self.names(beginning))

    def set_all(self, kind, **fields):
        """Fields of all objects of a class, one made where there is none."""
        if not self.all(kind):
            self.add(kind, f"{kind} 1", {})
        for _, own in self.all(kind):
            own.update(fields)

    def text(self):
        return json.dumps(self.objects, indent=1)

    def zones(self):
        return [name for name, _ in self.all("Zone")]

    def zones_named(self, said):
        """Zones that a name stands for: a zone, a list, a space or a list of spaces."""
        lists = {name.lower(): [row["zone_name"] for row in fields.get("zones", [])]
                 for name, fields in self.all("ZoneList")}
        spaces = {name.lower(): fields.get("zone_name", "") for name, fields in self.all("Space")}
        space_lists = {name.lower(): [spaces.get(row["space_name"].lower(), "") for row in fields.get("spaces", [])]
                       for name, fields in self.all("SpaceList")}
        key = str(said).lower()
        of_space = [spaces[key]] if key in spaces else space_lists.get(key, [])
        named = {each.lower() for each in lists.get(key, of_space or [said])}
        return [zone for zone in self.zones() if zone.lower() in named]

    def conditioned(self):
        """Zones with a thermostat."""
        found = []
        for _, fields in self.all("ZoneControl:Thermostat"):
            found += self.zones_named(fields.get("zone_or_zonelist_name") or fields.get("zone_name", ""))
        return list(dict.fromkeys(found))


def zone_of(fields):
    """What an object says of its zone, by this or an older name of the field."""
    return next((fields[key] for key in (ZONE, *RENAMED[ZONE]) if fields.get(key)), "")


def read_epjson(path):
    try:
        objects = json.loads(read_text(path, "an EnergyPlus model, .epJSON or .idf"))
    except ValueError as error:
        raise Failed(f"{path}: is no epJSON ({error}); expected JSON as EnergyPlus converts it") from None
    if not isinstance(objects, dict) or not all(
            isinstance(named, dict) and all(isinstance(fields, dict) for fields in named.values())
            for named in objects.values()):
        raise Failed(f"{path}: is no epJSON; expected classes of objects of fields")
    return Model(objects, path)
