"""What ends a run with one line: the simulator's command prints it last, and the job's result keeps it."""
from new_job.refused import Refused


class Failed(Refused):
    """Where, what, why, and what to write instead."""


def read_text(path, what, encoding="utf-8"):
    try:
        with open(path, encoding=encoding, newline="") as file:
            return file.read()
    except OSError as error:
        raise Failed(f"{path}: {error.strerror}; expected {what}") from None
    except UnicodeDecodeError:
        raise Failed(f"{path}: is no text in {encoding}; expected {what}") from None
