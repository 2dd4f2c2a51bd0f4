"""The job of a loop over one or several cases: each a building, in a file of its own.

It reads building.json, weather_train.epw, weather_test.epw and measured.csv. The weather files'
years are the periods: the first is for training, the second is held out, and what of it was not
measured is predicted only.
"""
import os

from cases.building import Manner, building_parts
from cases.folder import CaseError, days_of, read_case
from cases.parameters import ROWS, parameters
from cases.toml import section

READINGS = "measured.csv"


def periods(case, case_dir):
    """[periods] of the two weather files."""
    lines = ["[periods]"]
    for name, key in (("training", "weather_train"), ("held_out", "weather_test")):
        path = os.path.join(case_dir, case["site"][key])
        try:
            first, last = days_of(path)
        except (OSError, ValueError, IndexError) as error:
            raise CaseError(f"{path}: {error}; expected a year of EPW weather") from None
        lines.append(f'{name} = ["{first}", "{last}"]')
    return "\n".join(lines) + "\n"


def building_text(case_dir, name, interval=None):
    """A case as a building with periods and parameters of its own."""
    case = read_case(case_dir)
    readings = os.path.join(case_dir, READINGS)
    if not os.path.isfile(readings):
        raise CaseError(f"{readings}: is not there; expected the readings of the training year")
    manner = Manner(files=(readings,), place=lambda file: os.path.join(case_dir, file),
                    name=name, for_loop=True, interval=interval)
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


def write_job(case_dirs, folder, study="loop", options=None, interval=None):
    """Writes job.toml and a file for each case into `folder`; returns job.toml's path and the
    buildings' names. `interval`: of the meters, where it is not the readings' own."""
    case_dirs = [os.path.abspath(path) for path in case_dirs]
    names = names_of(case_dirs)
    texts = {f"{name}.toml": building_text(path, name, interval) for path, name in zip(case_dirs, names)}
    texts["job.toml"] = job_text(names, study, options or {})
    os.makedirs(folder, exist_ok=True)
    for file, text in texts.items():
        with open(os.path.join(folder, file), "w") as out:
            out.write(text)
    return os.path.join(folder, "job.toml"), names
