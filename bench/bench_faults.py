#!/usr/bin/python3
"""What faults cost: ranks and whole jobs that are killed, logs that are damaged.

Usage: bench_faults.py [--ranks 20] [--jobs 300] [--damage 200] [--seed 1]

Every trial runs a small screening on three ranks, breaks it at a random moment or place, and resumes it.
What the logs hold is read here without the program's help (a record: mark, key, length, checksum, answer)
and compared with the logs of an undisturbed run, record by record. An item is lost if its whole record
was in a log when the fault came and the program did not resume with it; a row is false if its answer is
another than the undisturbed run's. Prints `name value unit reference ratio`.
"""
import argparse
import os
import pathlib
import random
import re
import shutil
import signal
import statistics
import struct
import subprocess
import tempfile
import time

import large_job

MARK = b"\x89bemitem"
HEADER = struct.Struct("<8siiQQQ")  # mark, stage, item, start, length, checksum
RANKS = 3


def small_job(folder):
    """A screening of 128 items of a few milliseconds each."""
    job = large_job.copy_quickstart(folder)
    text = re.sub(r"(?s)# The ten that matter.*", "", job.read_text())
    for key, value in (("n_base", 16), ("n_points", 16384), ("points_per_item", 128)):
        text = re.sub(rf"(?m)^({key} *=).*", rf"\1 {value}", text)
    job.write_text(text)
    return job


def spans(data):
    """(begin, end, key, answer) of the whole records of a log."""
    at = 0
    while at + HEADER.size <= len(data):
        mark, stage, item, start, length, _ = HEADER.unpack_from(data, at)
        end = at + HEADER.size + length
        if mark == MARK and end <= len(data):
            yield at, end, (stage, item, start), bytes(data[at + HEADER.size:end])
            at = end
        else:
            at = data.find(MARK, at + 1)
            if at < 0:
                return


def records(part):
    """{key: answer} of the whole records in a folder's logs."""
    return {key: answer for log in sorted(part.glob("rank-*.log"))
            for _, _, key, answer in spans(log.read_bytes())}


class Trials:
    def __init__(self, folder, seed):
        self.folder = folder
        self.random = random.Random(seed)
        self.job = small_job(folder)
        self.lost = self.false = self.broken = 0
        self.to_end = []  # seconds from the fault to the end of mpirun
        self.prepare()

    def command(self, result, *options, ranks=RANKS):
        return ["mpirun", "-np", str(ranks), "--oversubscribe", "--bind-to", "none",
                large_job.PROGRAM, "run", self.job, "--no-report", "-o", result, "--threads", "1", *options]

    def start(self, result, *options):
        return subprocess.Popen(self.command(result, *options), stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL, start_new_session=True)

    def hash_of(self, result):
        text = subprocess.run([large_job.PROGRAM, "status", result], capture_output=True, text=True).stdout
        found = re.search(r"result hash ([0-9a-f]{32})", text)
        return found[1] if found else ""

    def prepare(self):
        """The undisturbed run's hash, duration and records; a second link keeps its log."""
        result = self.folder / "whole.h5"
        begin = time.perf_counter()
        subprocess.run(self.command(result, ranks=RANKS), check=True, capture_output=True)
        self.seconds = time.perf_counter() - begin
        self.hash = self.hash_of(result)
        alone = self.folder / "alone.h5"
        run = subprocess.Popen([large_job.PROGRAM, "run", self.job, "--no-report", "-o", alone, "--threads", "2"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        kept = self.folder / "kept"
        kept.mkdir()
        while not (kept / "rank-0.log").exists():
            try:
                os.link(self.folder / "alone.h5.part" / "rank-0.log", kept / "rank-0.log")
            except FileNotFoundError:
                time.sleep(0.001)
        run.wait()
        self.truth = records(kept)

    def resume(self, result, expected):
        """Goes on with what is there. expected: the records to be resumed with, those and no others."""
        self.false += sum(self.truth.get(key) != answer for key, answer in expected.items())
        run = subprocess.run(self.command(result, "--resume", ranks=2), capture_output=True, text=True)
        found = re.search(r"resuming: (\d+) items", run.stderr)
        n_resumed = int(found[1]) if found else 0
        self.lost += max(0, len(expected) - n_resumed)
        self.false += max(0, n_resumed - len(expected))
        self.broken += run.returncode != 0 or self.hash_of(result) != self.hash

    def begun(self, result):
        """Starts a run, and waits for a random moment after its first items."""
        run = self.start(result)
        part = pathlib.Path(f"{result}.part")
        while run.poll() is None and not any(log.stat().st_size for log in part.glob("rank-*.log")):
            time.sleep(0.002)
        time.sleep(self.random.uniform(0, 0.6 * self.seconds))
        return run, part

    def clear(self):
        for path in self.folder.glob("trial.h5*"):
            shutil.rmtree(path) if path.is_dir() else path.unlink()

    def kill(self, whole_job):
        """kill -9 of one rank, or of mpirun and all ranks. Returns whether there was something left."""
        self.clear()
        result = self.folder / "trial.h5"
        run, part = self.begun(result)
        ranks = [int(pid) for pid in
                 subprocess.run(["pgrep", "-P", str(run.pid)], capture_output=True, text=True).stdout.split()]
        if run.poll() is not None or not ranks:
            run.wait()
            return False
        before = records(part)
        begin = time.perf_counter()
        for pid in [run.pid, *ranks] if whole_job else [self.random.choice(ranks)]:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        code = run.wait()
        self.to_end.append(time.perf_counter() - begin)
        if result.exists():  # it was done in this moment
            return False
        self.broken += code == 0
        after = records(part)
        self.lost += sum(key not in after for key in before)
        self.resume(result, after)
        return True

    def damage(self, stopped):
        """A bit changed, or the end cut, at a random place of a random log."""
        self.clear()
        result, part = self.folder / "trial.h5", self.folder / "trial.h5.part"
        shutil.copytree(stopped, part)
        log = self.random.choice([log for log in sorted(part.glob("rank-*.log")) if log.stat().st_size])
        before = records(part)
        data = bytearray(log.read_bytes())
        at, cut = self.random.randrange(len(data)), self.random.random() < 0.5
        hit = {key for begin, end, key, _ in spans(data) if at < end and (cut or begin <= at)}
        if cut:
            del data[at:]
        else:
            data[at] ^= 1 << self.random.randrange(8)
        log.write_bytes(data)
        self.resume(result, {key: answer for key, answer in before.items() if key not in hit})

    def stopped_part(self):
        """A copy of the logs of a run that was stopped half-way."""
        while True:
            self.clear()
            run, part = self.begun(self.folder / "trial.h5")
            os.kill(run.pid, signal.SIGUSR1)
            if run.wait() == 75 and len(records(part)) > 10:
                return shutil.copytree(part, self.folder / "stopped")

    def report(self, name, n):
        print(f"{name}_trials {n} 1 - -")
        print(f"{name}_items_lost {self.lost} 1 0 -")
        print(f"{name}_false_rows {self.false} 1 0 -")
        print(f"{name}_not_resumed_to_the_same_hash {self.broken} 1 0 -", flush=True)
        if self.to_end:
            print(f"{name}_longest_end {max(self.to_end):.2f} s 3 {3 / max(self.to_end):.2f}")
            print(f"{name}_median_end {statistics.median(self.to_end):.2f} s - -", flush=True)
        self.lost = self.false = self.broken = 0
        self.to_end = []


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, n in (("ranks", 20), ("jobs", 300), ("damage", 200), ("seed", 1)):
        parser.add_argument(f"--{name}", type=int, default=int(os.environ.get(f"BEMCAL_BENCH_{name.upper()}", n)))
    wanted = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        trials = Trials(pathlib.Path(folder), wanted.seed)
        for name, n, whole_job in (("rank", wanted.ranks, False), ("job", wanted.jobs, True)):
            done = 0
            while done < n:
                done += trials.kill(whole_job)
            if n:
                trials.report(f"kill_{name}", n)
        if wanted.damage:
            stopped = trials.stopped_part()
            for _ in range(wanted.damage):
                trials.damage(stopped)
            trials.report("damage", wanted.damage)


if __name__ == "__main__":
    main()
