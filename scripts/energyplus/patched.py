"""What EnergyPlus receives, to be read: the model with parameters and effects, its series, and a difference of lines.

Both models are written with their keys sorted, so that the unified difference shows changes alone. Leaves out run
periods and outputs, which are the run's and not the building's.
"""
import difflib
import json
import os
import pathlib

from energyplus.changes import SERIES_FILE

LINES_AROUND = 2


def lines_of(model):
    return json.dumps(model.objects, indent=1, sort_keys=True, ensure_ascii=False).splitlines(keepends=True)


def write(folder, before, after, changes, year, has_many):
    """[paths] of NAME-effects.diff, its series, and NAME-effects.epJSON as the last."""
    stem = pathlib.Path(before.path).stem + "-effects" + (f"-{year.year}" if has_many else "")
    model, series, diff = (folder / f"{stem}{ending}" for ending in (".epJSON", ".csv", ".diff"))
    made = [diff]
    if changes.series:
        changes.write_series(folder)
        os.replace(folder / SERIES_FILE, series)
        for _, fields in after.all("Schedule:File"):
            if fields["file_name"] == SERIES_FILE:
                fields["file_name"] = series.name
        made.append(series)
    lines = lines_of(after)
    model.write_text("".join(lines) + "\n", encoding="utf-8")
    diff.write_text("".join(difflib.unified_diff(lines_of(before), lines, pathlib.Path(before.path).name, model.name,
                                                 n=LINES_AROUND)), encoding="utf-8")
    return [*made, model]
