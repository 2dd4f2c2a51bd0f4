"""How a script ends: a message for the user and an exit code, never a traceback.

Source: BSD's sysexits; README.md says what each code means. Without h5py, for scripts that read no result.
"""
import argparse
import os
import sys
import traceback

USAGE, DATA, NO_INPUT, FAILED, EXISTS, IO, CONFIG = 64, 65, 66, 70, 73, 74, 78


class Refused(Exception):
    """A message for the user, and the exit code."""

    def __init__(self, message, code=DATA):
        super().__init__(message)
        self.code = code


class Parser(argparse.ArgumentParser):
    """Of a command line, whose mistakes are a line and USAGE."""

    def error(self, message):
        self.exit(USAGE, f"{self.prog}: {message}; {self.prog} --help lists all\n")


def code_of(name, work):
    """Does the work; the exit code."""
    try:
        return work() or 0
    except Refused as refused:
        print(f"{name}: {refused}", file=sys.stderr)
        return refused.code
    except OSError as error:
        print(f"{name}: {f'{error.filename}: {error.strerror}' if error.filename else error}", file=sys.stderr)
        return IO
    except Exception as error:  # noqa: BLE001  (a mistake of ours)
        at = traceback.extract_tb(error.__traceback__)[-1]
        print(f"{name}: {type(error).__name__}: {error} ({os.path.basename(at.filename)}:{at.lineno}); an error in the "
              "program: expected a result or a message", file=sys.stderr)
        return FAILED


def run(name, work):
    """Does the work, and ends with its exit code."""
    sys.exit(code_of(name, work))
