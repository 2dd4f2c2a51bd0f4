"""What can go wrong, by the exit codes of the program (README.md, "Exit codes"). Source: BSD's sysexits."""
from __future__ import annotations

import enum
from typing import Union


class ExitCode(enum.IntEnum):
    """How the program ended; `meaning` says it in words."""
    OK = 0
    NOT_REACHED = 1
    USAGE = 64
    DATA = 65
    NO_INPUT = 66
    SOFTWARE = 70
    OS = 71
    CANNOT_CREATE = 73
    IO = 74
    MORE_TO_DO = 75
    CONFIG = 78

    @property
    def meaning(self) -> str:
        return MEANINGS[self]


MEANINGS = {
    ExitCode.OK: "done",
    ExitCode.NOT_REACHED: "written, but a target was missed: not converged, a meter beyond the model's range, "
                          "a bias beyond Guideline 14",
    ExitCode.USAGE: "command line, or an argument",
    ExitCode.DATA: "data; a result that is damaged",
    ExitCode.NO_INPUT: "an input is missing",
    ExitCode.SOFTWARE: "error in the program",
    ExitCode.OS: "no memory or threads left; resume=True goes on",
    ExitCode.CANNOT_CREATE: "output exists, is an input, or cannot be made",
    ExitCode.IO: "reading or writing failed, also of what is printed",
    ExitCode.MORE_TO_DO: "stopped; resume=True goes on",
    ExitCode.CONFIG: "job file",
}


class Error(Exception):
    """What has to be mended: the program's message, or the package's own.

    `code` is an ExitCode, or the plain number where the program ended by another one (a signal: below 0).
    `said` is all that the program wrote to its standard error.
    """

    def __init__(self, message: str, code: int, said: str = "") -> None:
        super().__init__(message)
        self.code: Union[ExitCode, int] = ExitCode(code) if code in list(ExitCode) else code
        self.said = said


class NotReached(UserWarning):
    """A run wrote its result, but missed a target (exit code 1)."""
