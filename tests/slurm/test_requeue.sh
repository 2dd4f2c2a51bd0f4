#!/usr/bin/env bash
# sbatch, the warning signal before the end of the time, code 75, back into the queue, COMPLETED: the
# same hash as undisturbed. First by Slurm's own signal (it comes up to 30 s early), then by scancel,
# through srun and through mpirun, on one node and on two.
. "$(dirname "$0")/case.sh"

size 262144
expected=$(whole)
# The time is over after a minute, and the signal may come from 5 s on.
id=$(sbatch --parsable -o signal.out --ntasks=2 --cpus-per-task=1 --mem=1000 --time=1 --signal=B:USR1@55 \
  --export=ALL,OMP_NUM_THREADS=1 "$root/jobs/slurm/one_node.sbatch" "$job" signal.h5)
await 60 "the job begins" 'begun signal.h5 1000'
await 200 "the job ends" "ended $id"
grep -q 'stopped; what is finished is kept' signal.out || fail "it was not stopped: $(tail -n 5 signal.out)"
grep -q 'resuming: [1-9]' signal.out || fail "nothing was resumed"
[[ $(field $id JobState) == COMPLETED ]] || fail "state $(field $id JobState)"
[[ $(field $id Restarts) -ge 1 ]] || fail "it was not requeued"
[[ $(hash_of signal.h5) == "$expected" ]] || fail "another hash after Slurm's signal and requeue"
