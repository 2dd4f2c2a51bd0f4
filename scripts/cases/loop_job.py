"""The job of a loop over one or several cases: each a building, in a file of its own.

It reads building.json, weather_train.epw, weather_test.epw and measured.csv. The weather files'
years are the periods: the first is for training, the second is held out, and what of it was not
measured is predicted only.
"""
import os

from cases.building import Manner, building_parts
from cases.folder import CaseError, days_of, read_case
from cases.meters import CHANNELS, channels
from cases.parameters import ROWS, parameters
from cases.toml import section

READINGS = "measured.csv"


def periods(case, case_dir):
    """[periods] of the two weather files."""
    lines = ["[periods]"]
    for name, key in (("training", "weather_train"), ("held_out", "weather_test")):
        first, last = days_of(os.path.join(case_dir, case["site"][key]))
        lines.append(f'{name} = ["{first}", "{last}"]')
    return "\n".join(lines) + "\n"


def building_text(case_dir, name, interval=None):
    """A case as a building with periods and parameters of its own."""
    if name == "job":
        raise CaseError(f"{case_dir}: a case cannot be called job, for its building's file would "
                        "be job.toml, which is the job's; expected a folder of another name")
    case = read_case(case_dir)
    readings = os.path.join(case_dir, READINGS)
    if not os.path.isfile(readings):
        raise CaseError(f"{readings}: is not there; expected the readings of the training year")
    manner = Manner(files=(readings,), place=lambda file: os.path.join(case_dir, file),
                    name=name, for_loop=True, interval=interval)
    if not channels(case, manner.files):
        raise CaseError(f"{readings}: has no column that is a meter; expected one or more of "
                        f"{', '.join(CHANNELS)}")
    return "\n".join([*building_parts(case, case_dir, manner), periods(case, case_dir),
                      *parameters(case, ROWS, base_load=True)])


def names_of(case_dirs):
    """The folders' names, which the results bear."""
    names = [os.path.basename(path) for path in case_dirs]
    for name in names:
        if names.count(name) > 1:
            raise CaseError(f"{name}: two folders have this name; expected different ones, "
                            "for each case's results stand in a folder of its name")
    return names


def job_text(names, study, options):
    """`options`: keys of the study."""
    files = "[\n" + "".join(f'    "{name}.toml",\n' for name in names) + "]"
    return section("seed = 1", buildings=files) + "\n" + \
        section("[[study]]", kind=study, **options)


def buildings(case_dirs, interval=None):
    """{name: text} of the cases that can be a building, and a CaseError for each of the others.
    `interval`: of the meters, where it is not the readings' own."""
    case_dirs = [os.path.abspath(path) for path in case_dirs]
    texts, errors = {}, []
    for path, name in zip(case_dirs, names_of(case_dirs)):
        try:
            texts[name] = building_text(path, name, interval)
        except CaseError as error:
            errors.append(error)
    return texts, errors


def write_files(texts, folder, study="loop", options=None):
    """Writes job.toml and a file for each building into `folder`; returns job.toml's path."""
    os.makedirs(folder, exist_ok=True)
    for name, text in {**texts, "job": job_text(texts, study, options or {})}.items():
        with open(os.path.join(folder, f"{name}.toml"), "w") as out:
            out.write(text)
    return os.path.join(folder, "job.toml")


def write_job(case_dirs, folder, study="loop", options=None, interval=None):
    """The job of cases that all have to be right; returns its path and the buildings' names."""
    texts, errors = buildings(case_dirs, interval)
    if errors:
        raise errors[0]
    return write_files(texts, folder, study, options), list(texts)
