#!/usr/bin/python3
"""What a run loses, or says falsely, when the disk fails, its files are damaged or mixed, or it is killed.

Usage: bench_attacks.py [--stride 1] [--every 40] [--damage 300] [--mixed 50] [--kills 100] [--seed 1]

failing   every call to the disk (write, cut, sync, close, rename: tests/support/failing.c) fails once, one after
          the other, in three jobs; --stride 7 takes each seventh
every     each k-th call fails, again and again, for k = 1, 2, ..., 40
damage    a stopped run's folder NAME.part is damaged at a random place
mixed     logs of another run, of other ranges, get into it in some way
kills     kill -9 at a random moment

A run that ends with 0 must have the undisturbed run's result and tables; one that does not must say so with a
documented code and come to them by --resume. Damage that is refused must be refused with a code, and come to the
same result by what the message advises. Prints `name value unit reference ratio`; reference: what is wanted.
"""
import argparse
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field

import bench_faults
import large_job

sys.dont_write_bytecode = True
sys.path.insert(0, str(large_job.ROOT / "tests" / "generator"))

CODES = {1, 64, 65, 66, 70, 71, 73, 74, 75, 78}
ERRORS = ("5", "28", "-1")  # EIO, ENOSPC, and half of it written


def screening(folder, wide=False):
    """64 items of a few milliseconds; `wide`: another range of a parameter, so another run."""
    job = large_job.copy_quickstart(folder)
    text = re.sub(r"(?s)\[\[study\]\]\nkind = \"sensitivity\".*?(?=\[\[study\]\])", "", job.read_text())
    for key, value in (("n_points", 2048), ("points_per_item", 32)):
        text = re.sub(rf"(?m)^({key} *=).*", rf"\1 {value}", text)
    if wide:
        text = re.sub(r"(?m)^max = 26.5", "max = 27.5", text)
    job.write_text(text)
    return job


def posterior(folder):
    """Two chains, in rounds; too short to converge, so that its own code is 1."""
    shutil.copytree(large_job.ROOT / "jobs" / "quickstart", folder / "quickstart")
    job = folder / "quickstart" / "quickstart.toml"
    head, tail = re.split(r"(?m)^# In this order", job.read_text())
    study = re.search(r"(?s)\[\[study\]\]\nkind = \"posterior\".*?(?=\n# )", tail)[0]
    for key, value in (("n_chains", 2), ("warm_up", 5), ("draws_per_round", 4), ("most_draws", 8)):
        study = re.sub(rf"(?m)^({key} *=).*", rf"\1 {value}", study)
    job.write_text(f"{head}\n{study}\nsampler = \"random_walk\"\nn_predictive = 4\n")
    return job


def stock(folder):
    """Eight buildings of a table, one of which is broken."""
    import stock as made
    made.make(folder, 8, 2, seed=3, broken_share=1 / 8)
    job = folder / "made.toml"
    job.write_text(made.job_text(32) + "[output]\nmax_failed_share = 0.5\n")
    return job


@dataclass
class Job:
    """A job and what an undisturbed run of it gives."""
    path: pathlib.Path
    code: int = 0
    hash: str = ""
    tables: dict = field(default_factory=dict)
    seconds: float = 0.0


class Attacks:
    def __init__(self, folder, seed):
        self.folder = folder
        self.random = random.Random(seed)
        self.failing = folder / "failing.so"
        self.place = folder / "place"
        source = large_job.ROOT / "tests" / "support" / "failing.c"
        subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", self.failing, source, "-ldl"], check=True)
        self.counts = dict.fromkeys(("trials", "exits_0_damaged", "codes_unknown", "not_the_same_by_resume", "lost",
                                     "false", "refused"), 0)

    def made(self, make, *arguments):
        folder = self.folder / f"job-{len(list(self.folder.glob('job-*')))}"
        folder.mkdir()
        job = Job(make(folder, *arguments))
        self.clear()
        begin = time.perf_counter()
        job.code = self.run(job).returncode
        job.seconds = time.perf_counter() - begin
        job.hash, job.tables = self.hash(), self.tables()
        assert job.code in (0, 1) and job.hash, "the undisturbed run failed"
        return job

    def clear(self):
        shutil.rmtree(self.place, ignore_errors=True)
        self.place.mkdir()

    @property
    def result(self):
        return self.place / "night.h5"

    @property
    def part(self):
        return self.place / "night.h5.part"

    def command(self, job, *options):
        return [large_job.PROGRAM, "run", job.path, "-o", self.result, "--threads", "1", "--no-report", *options]

    def run(self, job, *options, **environment):
        return subprocess.run(self.command(job, *options), capture_output=True, text=True, check=False,
                              env={**os.environ, **environment})

    def hash(self):
        """Of a result that says it is whole; else empty."""
        done = subprocess.run([large_job.PROGRAM, "status", self.result], capture_output=True, text=True, check=False)
        found = re.search(r"result hash ([0-9a-f]{32})", done.stdout)
        return found[1] if found and done.returncode == 0 else ""

    def tables(self):
        return {path.name: path.read_text() for path in self.place.glob("*.csv")}

    def is_right(self, job):
        return self.hash() == job.hash and self.tables() == job.tables

    def judge(self, job, code):
        """After a fault: right at once, or by --resume."""
        self.counts["trials"] += 1
        if code == job.code:
            self.counts["exits_0_damaged"] += not self.is_right(job)
            return
        if code not in CODES:
            self.counts["codes_unknown"] += 1
            print(f"code {code}", file=sys.stderr)
        again = self.run(job, "--resume")
        if again.returncode != job.code or not self.is_right(job):
            self.counts["not_the_same_by_resume"] += 1
            print(f"after code {code}: {again.returncode}: {again.stderr[-300:]}", file=sys.stderr)

    def fail(self, job, way, at, error):
        """way: FAIL_AT, or FAIL_EVERY."""
        self.clear()
        done = self.run(job, LD_PRELOAD=str(self.failing), FAIL_READ="1", FAIL_ERRNO=error, **{way: str(at)})
        before = self.counts.copy()
        self.judge(job, done.returncode)
        if self.counts["exits_0_damaged"] > before["exits_0_damaged"]:
            print(f"{way} {at} of {job.path.name}: code {done.returncode}, damaged", file=sys.stderr)

    def n_calls(self, job):
        self.clear()
        count = self.folder / "count"
        self.run(job, LD_PRELOAD=str(self.failing), FAIL_READ="1", FAIL_COUNT=str(count))
        return int(count.read_text())

    def stopped(self, job):
        """A copy of the folder of a run that was stopped half-way."""
        kept = self.folder / f"stopped-{job.path.stem}-{len(list(self.folder.glob('stopped-*')))}"
        for tries in range(50):
            self.clear()
            limit = job.seconds * self.random.uniform(0.3, 0.8)
            if self.run(job, "--stop-after", f"{limit:.3f}").returncode == 75 and len(bench_faults.records(self.part)) > 8:
                return pathlib.Path(shutil.copytree(self.part, kept))
        raise AssertionError("the run could not be stopped half-way")

    def restore(self, kept):
        self.clear()
        shutil.copytree(kept, self.part)

    def resume(self, job, expected):
        """Goes on with what is there. expected: how many records are sound and its own."""
        self.counts["trials"] += 1
        done = self.run(job, "--resume")
        if done.returncode in (65, 73):
            self.counts["refused"] += 1
            self.follow_advice(done.stderr)
            done = self.run(job, "--resume")
        found = re.search(r"resuming: (\d+) items", done.stderr)
        n_resumed = int(found[1]) if found else 0
        self.counts["lost"] += max(0, expected - n_resumed)
        self.counts["false"] += max(0, n_resumed - expected)
        if done.returncode != job.code or not self.is_right(job):
            self.counts["not_the_same_by_resume"] += 1
            print(f"{done.returncode}: {done.stderr[-400:]}", file=sys.stderr)

    def follow_advice(self, said):
        """What a message says to remove or move away is removed."""
        assert re.search("remove it|expected a file|move it away", said), said
        for path in self.part.iterdir():
            if path.name == "identity.txt" and "identity.txt" in said or path.is_dir():
                shutil.rmtree(path) if path.is_dir() else path.unlink()

    def damage(self, job, kept):
        """One of the ways a disk, a copy or a user spoils a file."""
        self.restore(kept)
        files = sorted(self.part.iterdir())
        file = self.random.choice([path for path in files if path.stat().st_size] or files)
        before = bench_faults.records(self.part)
        data = bytearray(file.read_bytes())
        at = self.random.randrange(len(data))
        n = self.random.randrange(1, 200)
        way = self.random.choice(("bit", "bit", "cut", "gone", "zeros", "garbage", "grown", "twice", "folder", "empty"))
        changed = {"bit": lambda: data.__setitem__(at, data[at] ^ 1 << self.random.randrange(8)),
                   "cut": lambda: data.__delitem__(slice(at, None)),
                   "zeros": lambda: data.__setitem__(slice(at, at + n), bytes(len(data[at:at + n]))),
                   "garbage": lambda: data.__setitem__(slice(at, at + n), self.random.randbytes(len(data[at:at + n]))),
                   "grown": lambda: data.__setitem__(slice(at, at), self.random.randbytes(n)),
                   "twice": lambda: data.extend(bytes(data)),
                   "empty": data.clear}
        file.unlink()
        if way == "folder":
            file.mkdir()
        elif way != "gone":
            changed[way]()
            file.write_bytes(data)
        self.resume(job, len(self.sound(before)))

    def sound(self, before):
        """The records that are there still, whole and unchanged."""
        after = {key: answer for log in self.part.glob("rank-*.log") if log.is_file()
                 for key, answer in self.findable(log.read_bytes(), before)}
        return {key for key, answer in after.items() if before.get(key) == answer}

    @staticmethod
    def findable(data, before):
        """Records that stand anywhere in the bytes as they were, header and all but the checksum."""
        at = data.find(bench_faults.MARK)
        while at >= 0:
            if at + bench_faults.HEADER.size <= len(data):
                _, stage, item, start, length, checksum = bench_faults.HEADER.unpack_from(data, at)
                answer = bytes(data[at + bench_faults.HEADER.size:at + bench_faults.HEADER.size + length])
                if before.get((stage, item, start)) == answer and checksum in Attacks.checksums:
                    yield (stage, item, start), answer
            at = data.find(bench_faults.MARK, at + 1)

    checksums = set()

    def note_checksums(self, kept):
        """Those that the program wrote: a record is sound if its is one of them."""
        for log in kept.glob("rank-*.log"):
            data = log.read_bytes()
            for begin, _, _, _ in bench_faults.spans(data):
                self.checksums.add(bench_faults.HEADER.unpack_from(data, begin)[5])

    def mix(self, job, kept, other):
        """Records of another run among ours, one way or another; ours are all there still."""
        self.restore(kept)
        ours, theirs = self.part / "rank-0.log", (other / "rank-0.log").read_bytes()
        mine = ours.read_bytes()
        cut = self.random.randrange(len(theirs))
        ends = [end for _, end, _, _ in bench_faults.spans(mine)]
        seam = self.random.choice(ends)
        ways = (lambda: (self.part / "rank-7.log").write_bytes(theirs),
                lambda: (self.part / "rank-0-2.log").write_bytes(theirs[cut:]),
                lambda: ours.write_bytes(mine + theirs),
                lambda: ours.write_bytes(theirs[:cut] + mine),
                lambda: ours.write_bytes(mine[:seam] + theirs + mine[seam:]),
                lambda: ours.write_bytes(mine[:seam] + theirs[cut:] + mine[seam:]),
                lambda: (self.part / "identity.txt").write_bytes((other / "identity.txt").read_bytes()))
        way = self.random.randrange(len(ways))
        ways[way]()
        if way == len(ways) - 1:  # the other's identity, sound: refused with its name, ours put back
            done = self.run(job, "--resume")
            self.counts["refused"] += done.returncode == 73
            self.counts["false"] += done.returncode != 73
            (self.part / "identity.txt").write_bytes((kept / "identity.txt").read_bytes())
        self.resume(job, len(ends))

    def kill(self, job):
        self.clear()
        run = subprocess.Popen(self.command(job), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(self.random.uniform(0, job.seconds))
        run.send_signal(signal.SIGKILL)
        code = run.wait()
        self.judge(job, 75 if code == -signal.SIGKILL else code)

    def report(self, name):
        for what, n in self.counts.items():
            wanted = "-" if what in ("trials", "refused") else "0"
            print(f"{name}_{what} {n} 1 {wanted} -", flush=True)
        self.counts = dict.fromkeys(self.counts, 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, n in (("stride", 1), ("every", 40), ("damage", 300), ("mixed", 50), ("kills", 100), ("seed", 1)):
        parser.add_argument(f"--{name}", type=int, default=int(os.environ.get(f"BEMCAL_BENCH_{name.upper()}", n)))
    wanted = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        attacks = Attacks(pathlib.Path(folder), wanted.seed)
        screened, chains, night = attacks.made(screening), attacks.made(posterior), attacks.made(stock)
        jobs = (screened, chains, night)
        if wanted.stride:
            for job in jobs:
                for at in range(1, attacks.n_calls(job) + 1, wanted.stride):
                    attacks.fail(job, "FAIL_AT", at, ERRORS[at // wanted.stride % 3])
            attacks.report("failing")
        if wanted.every:
            for number in range(3 * wanted.every):
                attacks.fail(jobs[number % 3], "FAIL_EVERY", number // 3 + 1, ERRORS[number // 3 % 3])
            attacks.report("every")
        kept = {job.path: attacks.stopped(job) for job in (screened,)} if wanted.damage + wanted.mixed else {}
        for folder_of_run in kept.values():
            attacks.note_checksums(folder_of_run)
        for _ in range(wanted.damage):
            attacks.damage(screened, kept[screened.path])
        if wanted.damage:
            attacks.report("damage")
        if wanted.mixed:
            other = attacks.stopped(attacks.made(screening, True))
            for _ in range(wanted.mixed):
                attacks.mix(screened, kept[screened.path], other)
            attacks.report("mixed")
        for number in range(wanted.kills):
            attacks.kill(jobs[number % 3])
        if wanted.kills:
            attacks.report("kills")


if __name__ == "__main__":
    main()
