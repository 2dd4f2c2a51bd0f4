"""Starts the program `bemcal-batch` and gives its answer, or its message as an Error.

A path in an argument is a file of the user; `program` names another program than the one found: that of
$BEMCAL_PROGRAM, of PATH, of the checkout that the package lies in, or of its installation.
Leaves out batch systems: jobs/slurm has scripts for these.
"""
from __future__ import annotations

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, List, Optional, Sequence, Tuple, Union

from .errors import Error, ExitCode, NotReached

if TYPE_CHECKING:
    from .job import Job
    from .result import Result

NAME = "bemcal-batch"
HERE = pathlib.Path(__file__).resolve().parent
SCRIPTS = HERE.parents[1]                                       # of a checkout, or of an installation by CMake
HAS_SCRIPTS = (SCRIPTS / "report").is_dir()                     # pip installs the package alone
PROGRAMS = [SCRIPTS.parent / "build" / "release" / NAME,        # of a checkout
            SCRIPTS.parents[2] / "bin" / NAME] if HAS_SCRIPTS else []     # of an installation
OPEN_MPI_AS_ROOT = ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM")
# What a run says of its result, which lies where its output, its job's [output] or its job's name puts it.
WROTE = re.compile(r"^wrote (.+), result hash [0-9a-f]{32}", re.MULTILINE)
COMPLETE = re.compile(r"^(.+) is complete already: nothing to do$", re.MULTILINE)

Path = Union[str, "os.PathLike[str]"]


@dataclass(frozen=True)
class Answer:
    """How the program ended, and what it wrote to its two streams."""
    code: int
    out: str
    said: str

    @property
    def sayings(self) -> List[str]:
        """Each without the program's name; what mpirun adds is left out."""
        own = self.said.split("\n-----", 1)[0]
        return [text.strip() for text in re.split(rf"^{NAME}: ", own, flags=re.MULTILINE) if text.strip()]

    @property
    def message(self) -> str:
        """What stands behind the news of a result, or else what was said last."""
        after = [k for k, text in enumerate(self.sayings) if WROTE.match(text)]
        verdict = [text for text in self.sayings[after[-1] + 1:] if not text.startswith(("wrote ", "no page"))] \
            if after else []
        return "\n".join(verdict or self.sayings[-1:]) or f"{NAME} ended with code {self.code} and said nothing"

    def error(self) -> Error:
        return Error(self.message, self.code, self.said)


@dataclass(frozen=True)
class Status:
    """What `bemcal-batch status` says of a result."""
    text: str
    is_complete: bool

    @property
    def hash(self) -> str:
        """Over all but times, host and dates; "" of a run that is not complete."""
        found = re.search(r"\b[0-9a-f]{32}\b", self.text)
        return found.group() if found else ""


def find(program: Optional[Path] = None) -> str:
    """Path of the program. Error (NO_INPUT) where there is none, or none at the place that is named."""
    named = program or os.environ.get("BEMCAL_PROGRAM")
    if named:
        found = shutil.which(os.fspath(named))
        if found is None:
            raise Error(f"{os.fspath(named)}: no such program; expected the path of {NAME}", ExitCode.NO_INPUT)
        return found
    places = [shutil.which(NAME), *PROGRAMS]
    for place in places:
        if place is not None and os.access(place, os.X_OK):
            return os.fspath(place)
    raise Error(f"{NAME} was not found on {' or at '.join(['PATH', *map(str, PROGRAMS)])}; build it as README.md "
                "says, or name it: program=..., or BEMCAL_PROGRAM in the environment", ExitCode.NO_INPUT)


def environment() -> "dict[str, str]":
    """What Open MPI and OpenMP need on one machine (scripts/environment)."""
    as_root = OPEN_MPI_AS_ROOT if os.getuid() == 0 else ()
    return {"OMP_WAIT_POLICY": "passive", **os.environ, **{name: "1" for name in as_root}}


def on_ranks(command: List[str], ranks: int) -> List[str]:
    if ranks == 1:
        return command
    if ranks < 1:
        raise Error(f"ranks={ranks}: expected 1 or more", ExitCode.USAGE)
    launcher = shutil.which("mpirun")
    if launcher is None:
        raise Error(f"ranks={ranks}: takes mpirun, which is not on PATH (Debian: openmpi-bin); ranks=1 does without",
                    ExitCode.NO_INPUT)
    return [launcher, "-np", str(ranks), *command]


def followed(process: "subprocess.Popen[str]", echo: bool) -> str:
    """What it says, until it ends. An interrupt stops it as a time limit does: what is finished is kept."""
    assert process.stderr is not None
    lines = []
    try:
        for line in process.stderr:
            lines.append(line)
            if echo:
                print(line, end="", flush=True)
        process.wait()
    except KeyboardInterrupt:
        process.terminate()
        process.wait()
        raise
    return "".join(lines)


def start(words: Sequence[str], program: Optional[Path] = None, ranks: int = 1, echo: bool = False) -> Answer:
    """Runs the program with these words to its end. `echo`: prints what it prints."""
    command = on_ranks([find(program), *words], ranks)
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as out:
        try:
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.PIPE,
                                       env=environment(), encoding="utf-8", errors="replace")
        except OSError as error:
            raise Error(f"{command[0]}: does not start: {error.strerror}", ExitCode.OS) from None
        with process:
            said = followed(process, echo)
        out.seek(0)
        text = out.read()
    if echo:
        print(text, end="")
    return Answer(process.returncode, text, said)


def asked(words: Sequence[str], program: Optional[Path] = None) -> str:
    """What it prints; an Error unless it ends with 0."""
    answer = start(words, program)
    if answer.code != ExitCode.OK:
        raise answer.error()
    return answer.out


def job_file(job: Union["Job", Path]) -> str:
    """Of a Job the file that holds it as it is."""
    from .job import Job
    return os.fspath(job.file() if isinstance(job, Job) else job)


def result_file(result: Union["Result", Path]) -> str:
    from .result import Result
    return os.fspath(result.path if isinstance(result, Result) else result)


def options(**given: object) -> List[str]:
    """--name of what is True, --name VALUE of other values; None and False are left out."""
    words: List[str] = []
    for name, value in given.items():
        if value is None or value is False:
            continue
        words.append("--" + name.replace("_", "-"))
        if value is not True:
            words.append(os.fspath(value) if isinstance(value, os.PathLike) else str(value))
    return words


def written(answer: Answer) -> Optional[str]:
    """The result that a run says it wrote, or that was complete before."""
    found = [match for text in answer.sayings for match in [WROTE.match(text) or COMPLETE.match(text)] if match]
    return found[-1].group(1) if found else None


def run(job: Union["Job", Path], ranks: int = 1, output: Optional[Path] = None, force: bool = False,
        resume: bool = False, *, threads: Optional[int] = None, stop_after: Optional[float] = None,
        item_seconds: Optional[float] = None, first_chain: Optional[int] = None, after: Optional[Path] = None,
        rerun_failed: bool = False, page: bool = False, echo: bool = False,
        program: Optional[Path] = None) -> "Result":
    """Runs a job: `bemcal-batch run`. `job` is a file, a folder NAME with NAME.toml, or a Job that was saved.

    ranks         MPI processes, started by mpirun
    output        the result file; default: that of the job, else its name with .h5 in the working folder
    force         writes over a result, drops an unfinished run
    resume        goes on with an unfinished run
    threads       of each rank; default: its share of the cores
    stop_after    begins nothing more after so many seconds; then the Error has code MORE_TO_DO
    item_seconds  an item that takes longer counts as failed
    first_chain   number of a posterior's first chain, for runs that are put together
    after         of a stock: result of the last night
    rerun_failed  does only the items again that failed
    page          also writes the page with pictures beside the result
    echo          prints what the program prints, while it runs

    A run that misses a target (not converged, say) gives its Result and warns with NotReached; every other
    ending but 0 is an Error with the program's message and exit code. Where only some items failed (DATA), the result
    was written: bemcal.open gives it.
    """
    from .result import open_result
    words = ["run", job_file(job), *options(
        output=output, force=force, resume=resume, threads=threads, stop_after=stop_after,
        item_seconds=item_seconds, first_chain=first_chain, after=after, rerun_failed=rerun_failed,
        no_report=not page)]
    answer = start(words, program, ranks, echo)
    file = written(answer)
    if answer.code not in (ExitCode.OK, ExitCode.NOT_REACHED) or file is None:
        raise answer.error()
    if answer.code == ExitCode.NOT_REACHED:
        warnings.warn(answer.message, NotReached, stacklevel=2)
    return open_result(file)


def check(job: Union["Job", Path], *, slurm: bool = False, nodes: Optional[int] = None,
          cores_per_node: Optional[int] = None, program: Optional[Path] = None) -> str:
    """Reads everything and simulates nothing: the plan, the memory and the time, as text.

    slurm: what to ask Slurm for in place of it, as #SBATCH lines. What is wrong with the job is an Error.
    """
    words = options(slurm=slurm, nodes=nodes, cores_per_node=cores_per_node)
    return asked(["check", job_file(job), *words], program)


def status(result: Union["Result", Path], *, program: Optional[Path] = None) -> Status:
    """Whether a result is complete, or how far its run is. One that is damaged is an Error (DATA)."""
    file = result_file(result)
    answer = start(["status", file], program)
    if answer.code == ExitCode.DATA and answer.out:
        raise Error(answer.out.strip(), answer.code, answer.said)
    if answer.code not in (ExitCode.OK, ExitCode.MORE_TO_DO):
        raise answer.error()
    return Status(answer.out, answer.code == ExitCode.OK)


def adopt(result: Union["Result", Path], job: Union["Job", Path], output: Path, *, stage: Optional[str] = None,
          keep_priors: bool = False, force: bool = False, program: Optional[Path] = None) -> "Job":
    """The job anew, with what its loop found, written to `output` beside it.

    stage        BUILDING/STUDY where the result has several loops
    keep_priors  keeps the job's own priors, for another study of the same readings
    """
    from .job import Job
    asked(["adopt", result_file(result), job_file(job), "--output", os.fspath(output),
           *options(stage=stage, keep_priors=keep_priors, force=force)], program)
    return Job.read(output)


def new(job: Path, *, weather: Sequence[Path], meters: Sequence[Path], place: str, area: Optional[float] = None,
        use: Optional[str] = None, built: Optional[int] = None, idf: Optional[Path] = None, rooms: bool = False,
        simulator: bool = False, site: Optional[Tuple[float, float]] = None, storeys: Optional[int] = None,
        height: Optional[float] = None, force: bool = False, program: Optional[Path] = None) -> "Job":
    """A first job, written to `job`: `bemcal-batch new`. Look at its lines "check this" first.

    weather    EPW files of measured years, or CSV files
    meters     files of readings, each perhaps with :COLUMN:QUANTITY:UNIT behind it
    place      country, perhaps with a state: "GB", "US-NY"
    area       heated or cooled floor area [m2]
    use        "office", "school", "apartments", ...
    built      the year in which it was built, or its envelope renewed
    idf        EnergyPlus's .idf or .epJSON, in place of area, use and built
    rooms      with idf: a zone for each of its zones; default: one
    simulator  with idf: the job runs that EnergyPlus model, too
    site       latitude and longitude [deg]; default: as the EPW file says
    height     of a storey [m]
    """
    from .job import Job
    words = ["new", os.fspath(job), *(f"--weather={os.fspath(file)}" for file in weather),
             *(f"--meter={os.fspath(file)}" for file in meters), f"--place={place}",
             *([f"--site={site[0]},{site[1]}"] if site else [])]
    asked([*words, *options(area=area, use=use, built=built, idf=idf, rooms=rooms, simulator=simulator,
                            storeys=storeys, height=height, force=force)], program)
    return Job.read(job)


def describe(topic: str, *more: str, program: Optional[Path] = None) -> str:
    """What `bemcal-batch describe` prints of job, results, parameters, structure, effects or holidays."""
    return asked(["describe", topic, *more], program)


def script(name: str, program: Optional[Path] = None) -> pathlib.Path:
    """scripts/NAME beside the package, or beside the program."""
    folders = [SCRIPTS]
    if not HAS_SCRIPTS:
        own = pathlib.Path(find(program)).resolve().parent
        folders = [own.parent / "share" / "bemcal" / "scripts", own.parents[1] / "scripts"]
    for folder in folders:
        if (folder / name).is_file():
            return folder / name
    raise Error(f"scripts/{name} was not found in {' or '.join(map(str, folders))}; cmake --install puts it there",
                ExitCode.NO_INPUT)


def run_script(path: pathlib.Path, words: Sequence[str]) -> str:
    """What a script prints, by this Python; an Error unless it ends with 0."""
    done = subprocess.run([sys.executable, os.fspath(path), *words], stdin=subprocess.DEVNULL, capture_output=True,
                          encoding="utf-8", errors="replace", env=environment(), check=False)
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines() or [f"{path} ended with code {done.returncode}"]
        raise Error(lines[-1].removeprefix(f"{path.name}: "), done.returncode, done.stderr)
    return done.stdout
