"""The studies of a result, by the kind that each says it is: the word of the job file."""
import h5py

from report import guard

# What one kind alone stored in version 0.1.0, whose studies do not say their kind.
MARKS_OF_0_1_0 = {"structure_chosen": "loop", "guideline_14_count": "screening", "objective": "optimisation",
                  "series_total_order": "hourly_sensitivity", "total_order": "sensitivity", "unknown": "posterior",
                  "stage_points": "grid", "saving_quantile": "retrofit", "calibration_stage": "stages"}
STOCK = "stock"                # no study, but many buildings


def groups(file):
    found = []
    file.visititems(lambda name, item: found.append(name) if isinstance(item, h5py.Group) else None)
    return found


def kind_of(group):
    """A word of the job file; none where the group is no study."""
    said = group["kind"] if guard.has(group, "kind") else None
    if not isinstance(said, h5py.Dataset) or said.shape != () or not h5py.check_string_dtype(said.dtype):
        return None
    return said.asstr()[()]


def kind_of_0_1_0(group):
    return next((kind for mark, kind in MARKS_OF_0_1_0.items() if mark in group), None)


def kinds_in(file):
    """{path: kind} of the studies in an open HDF5 file."""
    paths = groups(file)
    says = any(kind_of(file[path]) for path in paths)
    kind = kind_of if says else kind_of_0_1_0
    found = {path: kind(file[path]) for path in paths}
    return {path: word for path, word in found.items() if word and word != STOCK}


def of_kind(file, *kinds):
    """Paths of the studies of these kinds."""
    return [path for path, kind in kinds_in(file).items() if kind in kinds]
