"""Objects of an EnergyPlus input file, as text (IDF) or as JSON (epJSON), by class and by name of field.

Source: EnergyPlus Input Output Reference. Names of fields are those of epJSON; `idf_fields.py` lays them out for IDF.
Classes and names of objects are held in small letters, as EnergyPlus compares them. Leaves out ranges and defaults of
the schema, macros (##include) and HVACTemplate's expansion. A decimal comma is found only where it makes an object
longer than its class.
"""
import json
import re
from dataclasses import dataclass, field

from new_job import idf_text
from new_job.idf_fields import FIELDS, FORMER, MOST_FIELDS, REST, SINCE, UNTIL, WHOLE
from new_job.refused import DATA, Refused

OLDEST, NEWEST = (8, 9), (26, 9)   # versions whose fields are known here
COUNTED = (25, 2)              # the version whose numbers of fields are known: later classes may have more
ADVICE = f"EnergyPlus {OLDEST[0]}.{OLDEST[1]} to {NEWEST[0]}.x"
AUTO = ("", "autocalculate", "autosize")


@dataclass
class Object:
    file: str
    kind: str                  # class as written
    fields: dict               # {name of field: text}
    rest: list = field(default_factory=list)   # groups of values that repeat: vertices, weeks, ...

    @property
    def name(self):
        return self.fields.get("name", "")

    def says(self, key):
        return f'{self.file}: {self.kind} "{self.name}": {key}'

    def refuse(self, key, why):
        raise Refused(f"{self.says(key)}: {why}", DATA)

    def text(self, key, default=""):
        return self.fields.get(key, "") or default

    def word(self, key, default=""):
        """In small letters, for comparison."""
        return self.text(key, default).lower()

    def number(self, key, default=None, least=-1e12, most=1e12):
        """Of a field; `default` where it is empty or left to EnergyPlus."""
        said = self.word(key)
        return default if said in AUTO else number_of(self, key, said, least, most)


def number_of(thing, key, said, least=-1e12, most=1e12):
    try:
        value = float(said)
    except ValueError:
        thing.refuse(key, f"{said!r} is no number; expected one from {least:g} to {most:g}")
    if not least <= value <= most:
        thing.refuse(key, f"{said} is out of range; expected a number from {least:g} to {most:g}")
    return value


class Model:
    """All objects of a file."""

    def __init__(self, file, objects):
        self.file, self.objects = file, {}
        self.checks = []           # what was guessed of the file
        for each in objects:
            self.objects.setdefault(each.kind.lower(), []).append(each)
        self.by_name = {kind: {each.name.lower(): each for each in several}
                        for kind, several in self.objects.items()}

    def all(self, *kinds):
        return [each for kind in kinds for each in self.objects.get(kind.lower(), [])]

    def find(self, name, *kinds):
        """None where no such object is there."""
        return next((self.by_name[kind.lower()][name.lower()] for kind in kinds
                     if name.lower() in self.by_name.get(kind.lower(), {})), None)

    def need(self, by, key, *kinds):
        """The object that a field names."""
        found = self.find(by.text(key), *kinds)
        if found is None:
            by.refuse(key, f"names {by.text(key)!r}, which is not in the file; expected the name of a "
                           f"{' or '.join(kinds)}")
        return found


def split_objects(path, text):
    """Lists of texts, the class first."""
    bare = "\n".join(line.partition("!")[0] for line in text.splitlines())
    *whole, last = bare.split(";")
    if last.strip():
        raise Refused(f"{path}: {last.strip().split(',')[0][:60]!r}: the file ends within this object; expected a ;")
    return [[" ".join(cell.split()) for cell in each.split(",")] for each in whole if each.strip()]


def version_of(path, said):
    match = re.match(r"(\d+)\.(\d+)", str(said))
    version = (int(match[1]), int(match[2])) if match else None
    if version is None or not OLDEST <= version <= NEWEST:
        raise Refused(f"{path}: Version: {said!r} is not read here; expected {ADVICE} (EnergyPlus's "
                      "IDFVersionUpdater brings older files up to date)")
    return version


def fields_in(kind, version):
    """Names of a class's fields in their order, in that version."""
    return [name for name in FIELDS[kind]
            if SINCE.get((kind, name), OLDEST) <= version <= UNTIL.get((kind, name), NEWEST)]


def of_row(path, row, version):
    kind, values = row[0].lower(), row[1:]
    if kind not in FIELDS:
        return Object(path, row[0], {"name": values[0] if values else ""})
    names = fields_in(kind, version)
    fields, tail = dict(zip(names, values)), values[len(names):]
    width = len(REST[kind][1]) if kind in REST else 1
    return Object(path, row[0], fields, [tail[k:k + width] for k in range(0, len(tail), width)])


def refuse_more(path, row, version):
    """An object with more fields than its class has: a comma within a number would shift all behind it."""
    kind, values = row[0].lower(), row[1:]
    while values and not values[-1]:
        values = values[:-1]
    most = len(fields_in(kind, version)) if kind in WHOLE else MOST_FIELDS.get(kind, len(values))
    if len(values) > most and version <= COUNTED:
        raise Refused(f'{path}: {row[0]} "{values[0]}": has {len(values)} fields; expected {most} at most. A number '
                      "has a point, no comma: 10.76")


def objects_of_idf(path, checks):
    rows = split_objects(path, idf_text.of_idf(path, checks))
    said = next((row[1] for row in rows if row[0].lower() == "version" and len(row) > 1), None)
    if said is None:
        raise Refused(f"{path}: has no object Version; expected an input file of {ADVICE}")
    version = version_of(path, said)
    for row in rows:
        refuse_more(path, row, version)
    return [of_row(path, row, version) for row in rows]


def text_of(value):
    return "" if value is None else str(value)


def of_json(path, kind, name, given):
    key, columns = REST.get(kind.lower(), ("", ()))
    fields = {"name": name} | {each: text_of(value) for each, value in given.items() if not isinstance(value, list)}
    for ours, others in FORMER.items():
        if ours in FIELDS.get(kind.lower(), ()) and ours not in fields:
            fields[ours] = next((fields[other] for other in others if other in fields), "")
    groups = given.get(key, [])
    return Object(path, kind, fields, [[text_of(group.get(column)) for column in columns] for group in groups])


def objects_of_json(path):
    try:
        given = json.loads(idf_text.of_json(path))
        said = next(iter(given["Version"].values()))["version_identifier"]
    except (ValueError, LookupError, AttributeError, TypeError, StopIteration, RecursionError) as error:
        raise Refused(f"{path}: is no epJSON file ({type(error).__name__}: {error}); expected JSON with "
                      "Version") from None
    version_of(path, said)
    try:
        return [of_json(path, kind, name, fields) for kind, named in given.items() for name, fields in named.items()]
    except (AttributeError, TypeError):
        raise Refused(f"{path}: is no epJSON file; expected classes of objects of fields") from None


def read_model(path):
    is_json = path.lower().endswith((".epjson", ".json"))
    checks = []
    model = Model(path, objects_of_json(path) if is_json else objects_of_idf(path, checks))
    model.checks += checks
    return model
