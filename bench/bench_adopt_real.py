#!/usr/bin/python3
"""The same as bench_adopt of loops on real meters: the shipped jobs and those of ../shared/meters.

    bench_adopt_real.py [JOB...]

Each job runs in a copy of its folder, and each of its buildings is adopted there. Prints what bench_adopt does.
"""
import pathlib
import re
import shutil
import sys
import tempfile
import tomllib

sys.dont_write_bytecode = True

import bench_real_loops as real  # noqa: E402
from bench_adopt import judge, print_judged  # noqa: E402

RELATIVE = re.compile(r'"((?:\.\./)+[^"]*)"')


def copied(job, folder):
    """The job in a folder of its own, with the paths of its readings whole."""
    own = folder / f"{job.parent.name}_{job.stem}"
    shutil.copytree(job.parent, own)
    for text in own.glob("*.toml"):
        text.write_text(with_whole_paths(text.read_text(), job.parent))
    return own / job.name


def with_whole_paths(text, folder):
    return RELATIVE.sub(lambda found: f'"{(folder / found[1]).resolve()}"', text)


def by_name(job):
    """Writes each building's file anew as NAME.toml beside the job, without a study. The names."""
    names = []
    for file in tomllib.loads(job.read_text()).get("buildings", [job.name]):
        path = job.parent / file
        text = with_whole_paths(path.read_text(), path.parent).split("[[study]]")[0]
        names.append(tomllib.loads(text).get("name", path.stem))
        (job.parent / f"{names[-1]}.toml").write_text(text)
    return names


def file_of(job):
    """A job may be given as its folder, in which it is job.toml or has the folder's name."""
    return job if job.is_file() else next(job / name for name in ("job.toml", f"{job.name}.toml")
                                          if (job / name).is_file())


def main():
    asked = real.jobs_asked(__doc__)
    if not real.DATA.exists():
        print(f"skipped: no readings in {real.DATA}")
        return
    judged = {}
    with tempfile.TemporaryDirectory() as made, tempfile.TemporaryDirectory() as copies:
        for given in real.jobs_in(pathlib.Path(made), asked):
            job = copied(file_of(given), pathlib.Path(copies))
            result = job.with_suffix(".h5")
            real.run(job, result)
            judged |= judge(result, job.parent, by_name(job))
    print_judged(judged)


if __name__ == "__main__":
    main()
