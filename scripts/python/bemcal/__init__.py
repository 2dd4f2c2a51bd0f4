"""bemcal from Python: jobs from data frames, runs, results as xarray and pandas.

    job = bemcal.Job.read("office.toml")
    job.meter("gas", readings, unit="kWh")            # a Series with a DatetimeIndex
    result = bemcal.run(job.save("with_gas.toml"), ranks=4)
    result.errors, result.effects, result["office/posterior"]

The package computes nothing: it writes what the program `bemcal-batch` reads, starts it, and reads
what it wrote. Whatever goes wrong is a `bemcal.Error` with the program's message and exit code.
"""
from ._version import VERSION as __version__
from .errors import Error, ExitCode, NotReached
from .job import Job
from .program import Status, adopt, check, describe, new, run, status
from .result import Result
from .result import open_result as open  # as of h5py and xarray: bemcal.open

__all__ = ["Error", "ExitCode", "Job", "NotReached", "Result", "Status", "__version__", "adopt", "check",
           "describe", "new", "open", "run", "status"]
