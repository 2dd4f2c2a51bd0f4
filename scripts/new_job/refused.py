"""What ends `bemcal-batch new`, with the README's exit codes; and what it has to say beside the job."""

USAGE, DATA, NO_INPUT, EXISTS, IO = 64, 65, 66, 73, 74


def printable(text):
    """Names of files and columns may hold anything, also what moves a terminal's cursor."""
    return "".join(letter if letter.isprintable() else "?" for letter in text)


class Refused(Exception):
    """A message for the user, and the exit code."""

    def __init__(self, message, code=DATA):
        super().__init__(printable(message))
        self.code = code


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
