"""Reads results that may be of anyone: whatever is wrong with one ends in a message and an exit code.

HDF5 crashes on some damaged files, so that a script does its work in a process of its own.
"""
import contextlib
import os
import resource
import signal
import sys

import h5py

DATA, NO_INPUT, FAILED, IO = 65, 66, 70, 74
MOST_SECONDS = 600             # of the processor
PACKING = 100                  # a packed file may unfold to so many times its size


class Refused(Exception):
    """A message for the user, and the exit code."""

    def __init__(self, message, code=DATA):
        super().__init__(message)
        self.code = code


def has(group, path):
    """Whether something lies there, in the file itself: links to elsewhere do not count."""
    for name in path.split("/"):
        if not isinstance(group, h5py.Group) or \
                not isinstance(group.get(name, getlink=True), h5py.HardLink):
            return False
        group = group[name]
    return True


def inner(group, path):
    """A group or dataset of the file itself."""
    if not has(group, path):
        raise KeyError(f"{path} is missing")
    return group[path]


def sound(dataset):
    """A dataset of the file itself, no larger than it can hold."""
    if not isinstance(dataset, h5py.Dataset) or dataset.is_virtual or dataset.external:
        raise ValueError(f"{dataset.name} is no dataset of its own")
    size = dataset.file.id.get_filesize()
    if dataset.shape is None or dataset.nbytes > PACKING * size:
        raise ValueError(f"dataset {dataset.name} has shape {dataset.shape}, more than the file can hold")
    return dataset


def texts(group, name):
    """A list of texts; [] where the dataset is not there."""
    if not has(group, name):
        return []
    values = sound(group[name]).asstr()[()]
    return [values] if isinstance(values, str) else [str(text) for text in values.ravel()]


def opened(path):
    """An open HDF5 file, to read."""
    if not os.path.exists(path):
        raise Refused(f"{path}: no such file", NO_INPUT)
    if not os.path.isfile(path):
        raise Refused(f"{path}: is no regular file", NO_INPUT)
    return h5py.File(path, "r")


@contextlib.contextmanager
def reading(path):
    """What is wrong with the file's content is refused with its name."""
    try:
        yield
    except (ArithmeticError, AttributeError, LookupError, MemoryError, OSError, RuntimeError, TypeError,
            ValueError) as error:
        what = str(error).strip("'\"") or type(error).__name__
        raise Refused(what if str(path) in what else f"{path}: damaged: {what}") from error


def code_of(name, work):
    try:
        return work() or 0
    except Refused as refused:
        print(f"{name}: {refused}", file=sys.stderr)
        return refused.code
    except OSError as error:
        print(f"{name}: {error}", file=sys.stderr)
        return IO


def limit(seconds):
    soft, hard = resource.getrlimit(resource.RLIMIT_CPU)
    most = seconds if soft == resource.RLIM_INFINITY else min(seconds, soft)
    resource.setrlimit(resource.RLIMIT_CPU, (most, hard))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(name, work):
    """Does the work in a process of its own, and ends with its exit code."""
    sys.stdout.flush()
    child = os.fork()
    if child == 0:
        limit(MOST_SECONDS)
        code = FAILED
        try:
            code = code_of(name, work)
            sys.stdout.flush()
        finally:
            if sys.exc_info()[0] is not None:
                sys.excepthook(*sys.exc_info())
            os._exit(code)
    status = os.waitpid(child, 0)[1]
    if os.WIFSIGNALED(status):
        what = signal.strsignal(os.WTERMSIG(status))
        print(f"{name}: the result is damaged, HDF5 cannot read it: {what}", file=sys.stderr)
        sys.exit(DATA)
    sys.exit(os.WEXITSTATUS(status))
