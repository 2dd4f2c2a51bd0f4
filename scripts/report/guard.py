"""Reads results that may be of anyone: whatever is wrong with one ends in a message and an exit code.

HDF5 crashes on some damaged files and comes to no end on others, so that a file is read in a process of its own.
That process alone has a limit of time: what is made of the content afterwards may take long.
"""
import contextlib
import math
import multiprocessing
import os
import resource
import signal
import traceback

import h5py

from .refused import FAILED, NO_INPUT, Refused

# Of the processor. h5py takes milliseconds for a small result, and reads one of the smallest groups, the slowest
# that there is, at 2.6 MB/s.
LEAST_SECONDS, BYTES_A_SECOND = 3, 5e5
PACKING = 100                  # a packed file may unfold to so many times its size


def has(group, path):
    """Whether something lies there, in the file itself: links to elsewhere do not count, nor ".", the group."""
    for name in path.split("/"):
        if name == "." or not isinstance(group, h5py.Group) or \
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


def size_of(path):
    """Of a file that is there [bytes]."""
    if not os.path.exists(path):
        raise Refused(f"{path}: no such file", NO_INPUT)
    if not os.path.isfile(path):
        raise Refused(f"{path}: is no regular file", NO_INPUT)
    return os.path.getsize(path)


@contextlib.contextmanager
def reading(path):
    """What is wrong with the file's content is refused with its name."""
    try:
        yield
    except (ArithmeticError, AttributeError, LookupError, MemoryError, OSError, RuntimeError, TypeError,
            ValueError) as error:
        what = str(error.args[0] if isinstance(error, KeyError) and error.args else error) or type(error).__name__
        raise Refused(what if str(path) in what else f"{path}: damaged: {what}") from error


def set_apart(seconds):
    """Limits this process. It leaves no core file and says nothing, as h5py does of what it frees, libc of a crash."""
    soft, hard = resource.getrlimit(resource.RLIMIT_CPU)
    most = seconds if soft == resource.RLIM_INFINITY else min(seconds, soft)
    resource.setrlimit(resource.RLIMIT_CPU, (most, hard))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    nothing = os.open(os.devnull, os.O_WRONLY)
    for stream in (1, 2):
        os.dup2(nothing, stream)


def send(answer, path, read, seconds):
    """What is read, or why it is refused."""
    set_apart(seconds)
    try:
        with reading(path), h5py.File(path, "r") as file:
            answer.send(read(file))
    except Refused as refused:
        answer.send(refused)
    except Exception:  # a mistake of ours
        answer.send(Refused(traceback.format_exc(), FAILED))


def ending(code, seconds):
    """What happened to a process that did not come to its end."""
    if code == -signal.SIGXCPU:
        return f"HDF5 comes to no end with it and was stopped after {seconds} s of the processor"
    return "HDF5 cannot read it: " + (signal.strsignal(-code) if code < 0 else "it failed")


def read_apart(path, read):
    """What `read` makes of an open file, without anything of HDF5 in it."""
    seconds = math.ceil(LEAST_SECONDS + size_of(path) / BYTES_A_SECOND)
    answer, end = multiprocessing.Pipe(duplex=False)
    reader = multiprocessing.get_context("fork").Process(
        target=send, args=(end, path, read, seconds), daemon=True)
    reader.start()
    end.close()
    try:
        said = answer.recv()
    except (EOFError, OSError):
        said = None
    reader.join()
    if reader.exitcode != 0:
        raise Refused(f"{path}: damaged: {ending(reader.exitcode, seconds)}; run its job again, or take a copy "
                      "of the file")
    if isinstance(said, Refused):
        raise said
    return said
