"""EnergyPlus as a program: where it is, its version, conversion of IDF, a run, and its own words where it fails.

Found by the key `energyplus` of run.json, else by ENERGYPLUS_DIR, else on PATH. HVACTemplate objects are expanded by
EnergyPlus's own ExpandObjects. Leaves out the Runtime API: a process may fail without harm.
"""
import os
import pathlib
import re
import shutil
import subprocess

from energyplus.failed import Failed, read_text
from energyplus.model import read_epjson, version_of
from new_job import idf_text

MOST_WORDS = 300               # letters of a message of EnergyPlus that are passed on
MOST_MESSAGES = 3              # of eplusout.err
CONTINUED = "**   ~~~   **"    # a line that goes on with the one above
CONVERTER = "ConvertInputFormat"
UPDATER = "IDFVersionUpdater"


def help_of(version):
    """How a version is found; `without_a_job` knows its beginning."""
    folder = f"/usr/local/EnergyPlus-{'-'.join(map(str, version))}-0"
    return f'write "energyplus": "{folder}" in run.json.in, set ENERGYPLUS_DIR to its folder, such as {folder}, or ' \
           "put it on PATH"


HELP = help_of((25, 2))
IN_RUN_FILE = r'write "energyplus": "[^"]*" in run\.json\.in, '


def without_a_job(error):
    """A message without the run file, where none is there yet."""
    return re.sub(IN_RUN_FILE, "", str(error))


def as_program(said):
    path = pathlib.Path(said).expanduser()
    return path / "energyplus" if path.is_dir() else path


def find_program(said=""):
    """The program as a path, links followed, for its tables lie beside it."""
    for where, place in (("energyplus", said), ("ENERGYPLUS_DIR", os.environ.get("ENERGYPLUS_DIR", ""))):
        if place:
            path = as_program(place)
            if not os.access(path, os.X_OK):
                raise Failed(f"{where}: {path} is no program that can be run; {HELP}")
            return path.resolve()
    found = shutil.which("energyplus")
    if found is None:
        raise Failed(f"EnergyPlus was not found; {HELP}")
    return pathlib.Path(found).resolve()


def run(words, folder):
    try:
        return subprocess.run([str(word) for word in words], cwd=folder, capture_output=True, text=True, check=False,
                              errors="replace", stdin=subprocess.DEVNULL)
    except OSError as error:
        raise Failed(f"{words[0]}: {error.strerror}; {HELP}") from None


def program_version(program):
    """(major, minor)"""
    said = run([program, "--version"], ".").stdout
    match = re.search(r"EnergyPlus.*?(\d+)\.(\d+)", said)
    if match is None:
        line = said.strip().partition("\n")[0]
        raise Failed(f"{program}: is not EnergyPlus: to --version it says {line[:80]!r}; {HELP}")
    return int(match[1]), int(match[2])


def dotted(version):
    return ".".join(map(str, version))


def transition(version):
    return "V" + "-".join(map(str, version)) + "-0"


def check_version(path, version, program):
    """A model of another version than the program: EnergyPlus would misread its fields."""
    own = program_version(program)
    if version == own:
        return
    how = (f"bring it up to date by EnergyPlus's {UPDATER} (programs Transition-{transition(version)}-to-... up to "
           f"{transition(own)})" if version < own else f"use EnergyPlus {dotted(version)}: {help_of(version)}")
    raise Failed(f"{path}: Version: is {dotted(version)}, but {program} is EnergyPlus {dotted(own)}; {how}")


def version_in(path):
    """Of a file as it lies there."""
    if str(path).lower().endswith(".idf"):
        return idf_version(path, read_text(path, "an EnergyPlus model, .epJSON or .idf", "latin-1"))
    return read_epjson(path).version


def idf_version(path, text):
    match = re.search(r"^\s*version\s*,[^;]*?([\d.]+)\s*;", re.sub(r"!.*", "", text), re.IGNORECASE | re.MULTILINE)
    if match is None or version_of(match[1]) is None:
        raise Failed(f"{path}: has no object Version with a number; expected one like Version, 25.2;")
    return version_of(match[1])


def messages(text, level):
    """Those of eplusout.err of a level, each with the lines that go on with it."""
    found, is_open = [], False
    for line in text.splitlines():
        start = re.match(r"\s*\*+\s*(\w+)\s*\*+\s*(.*)", line)
        if start and start[1] == level:
            found.append(start[2])
        elif is_open and CONTINUED in line:
            found[-1] += " " + line.partition(CONTINUED)[2]
        is_open = bool(found) and (bool(start and start[1] == level) or is_open and CONTINUED in line)
    return [" ".join(each.split())[:MOST_WORDS] for each in found]


def severe_words(text):
    """The first severe messages of eplusout.err; where there is none the fatal one."""
    found = messages(text, "Severe") or messages(text, "Fatal")
    more = f" (and {len(found) - MOST_MESSAGES} more)" if len(found) > MOST_MESSAGES else ""
    return "; ".join(found[:MOST_MESSAGES]) + more


def severe_of(folder):
    """Of a run, also of one that went on."""
    try:
        return severe_words((folder / "eplusout.err").read_text(errors="replace"))
    except OSError:
        return ""


def complain(folder, done, what, rest=""):
    """EnergyPlus's own words, from eplusout.err or from what it printed; `rest`: where more of them are."""
    printed = (done.stderr or done.stdout).strip().splitlines()
    said = severe_of(folder) or (printed[-1][:MOST_WORDS] if printed else "it says nothing")
    raise Failed(f"EnergyPlus {what}, {how_ended(done.returncode)}: {said}{rest}")


def how_ended(code):
    return f"exit code {code}" if code >= 0 else f"signal {-code}"


def simulate(program, model_file, weather, folder):
    """Runs in `folder`, which is made; eplusout.sql lies there afterwards."""
    folder.mkdir(parents=True, exist_ok=True)
    done = run([program, "-d", folder, "-w", weather, model_file], folder)
    if done.returncode or not (folder / "eplusout.sql").is_file():
        complain(folder, done, f"failed in {folder.name}", f"; all that it says is in {folder.name}/eplusout.err")


def convert(program, source, folder):
    """The file in its other form, IDF or epJSON, in `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    tool = program.parent / CONVERTER      # which also takes templates
    words = [tool, "-o", folder] if os.access(tool, os.X_OK) else [program, "--convert-only", "-d", folder]
    done = run([*words, source], folder)
    ending = ".epJSON" if source.suffix.lower() == ".idf" else ".idf"
    made = folder / (source.stem + ending)
    if done.returncode or not made.is_file():
        complain(folder, done, f"could not convert {source.name}")
    return made


def expand(program, source, folder):
    """HVACTemplate objects of an IDF as the objects that they stand for."""
    expander, tables = program.parent / "ExpandObjects", program.parent / "Energy+.idd"
    if not expander.is_file():
        raise Failed(f"{source.name}: has HVACTemplate objects, but {expander} is not there; expand them elsewhere")
    shutil.copyfile(source, folder / "in.idf")
    if not (folder / "Energy+.idd").exists():
        (folder / "Energy+.idd").symlink_to(tables)
    done = run([expander], folder)
    made = folder / "expanded.idf"
    if not made.is_file():
        said = (folder / "expandedidf.err").read_text(errors="replace") if (folder / "expandedidf.err").is_file() \
            else done.stdout
        raise Failed(f"{source.name}: ExpandObjects failed: {' '.join(said.split())[:MOST_WORDS]}")
    return made


def read_model(program, path, folder):
    """The Model of an IDF or epJSON file, its templates expanded; what that needs is written to `folder`."""
    path = pathlib.Path(path)
    folder = pathlib.Path(folder).resolve()
    if path.suffix.lower() != ".idf":
        model = read_epjson(path)
        check_version(path, model.version, program)
        if not model.names("HVACTemplate:"):
            return model
        idf = convert(program, path.resolve(), folder)
    else:
        try:
            text, _ = idf_text.decoded(path.read_bytes())
        except OSError as error:
            raise Failed(f"{path}: {error.strerror}; expected an EnergyPlus model, .epJSON or .idf") from None
        check_version(path, idf_version(path, text), program)
        folder.mkdir(parents=True, exist_ok=True)
        idf = folder / path.name
        if not idf.exists():
            idf.write_text(text, encoding="utf-8")     # whatever it was
        if "hvactemplate:" not in text.lower():
            return read_epjson(convert(program, idf, folder))
    return read_epjson(convert(program, expand(program, idf, folder), folder))
