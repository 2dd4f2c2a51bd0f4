"""What ends `bemcal-batch new`, with the README's exit codes; and what it has to say beside the job."""

from report import refused
from report.refused import DATA, EXISTS, IO, NO_INPUT, USAGE

__all__ = ["DATA", "EXISTS", "IO", "NO_INPUT", "USAGE", "Refused", "Told", "printable"]


def printable(text):
    """Names of files and columns may hold anything, also what moves a terminal's cursor."""
    return "".join(letter if letter.isprintable() else "?" for letter in text)


class Refused(refused.Refused):
    """Of names that may be anything."""

    def __init__(self, message, code=DATA):
        super().__init__(printable(message), code)


class Told:
    """Lines for the terminal; those to be checked also go into the job."""

    def __init__(self):
        self.found, self.checks, self.left_out = [], [], []

    def say(self, line):
        self.found.append(printable(line))

    def leave_out(self, line):
        """Something in a file that the job does not have."""
        self.left_out.append(printable(line))

    def check(self, line):
        """Something that was guessed."""
        if printable(line) not in self.checks:
            self.checks.append(printable(line))
