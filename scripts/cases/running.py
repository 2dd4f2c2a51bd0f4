"""Running a job over ranks."""
import os
import subprocess

from cases.folder import CaseError

# Exit codes of the program with which it may have written a result.
TARGET_MISSED = 1  # the result is whole
SOME_FAILED = 65   # the result holds the other items
OPEN_MPI_AS_ROOT = ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM")


def environment():
    """What Open MPI and OpenMP need on one machine (scripts/environment)."""
    as_root = OPEN_MPI_AS_ROOT if os.getuid() == 0 else ()
    return {"OMP_WAIT_POLICY": "passive", **os.environ, **{name: "1" for name in as_root}}


def made_at(path):
    return os.stat(path).st_mtime_ns if os.path.exists(path) else None


def is_right(program, job, **more):
    """Whether the program can read all of the job, without a simulation. `more`: of subprocess.run."""
    command = [str(program), "check", str(job)]
    return subprocess.run(command, env=environment(), stdout=subprocess.DEVNULL,
                          **more).returncode == 0


def run(program, job, result, ranks, words=(), may_fail=False, **more):
    """Runs the job; returns the exit code. `words`: further words of the command; `may_fail`:
    whether a result without the items that failed is one; `more`: of subprocess.run. Raises
    CaseError where no result was made; its `code` is then the program's."""
    command = [str(program), "run", str(job), "-o", str(result), *words]
    if ranks > 1:
        command = ["mpirun", "-np", str(ranks), "--oversubscribe", *command]
    before = made_at(result)
    code = subprocess.run(command, env=environment(), **more).returncode
    good = (0, TARGET_MISSED, SOME_FAILED) if may_fail else (0, TARGET_MISSED)
    is_whole = code == 0 and "--resume" in words  # and was, where nothing was left to do
    is_made = made_at(result) is not None and (is_whole or made_at(result) != before)
    if code not in good or not is_made:
        error = CaseError(f"{job}: no result, exit code {code}")
        error.code = code
        raise error
    return code
