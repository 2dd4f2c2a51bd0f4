#!/usr/bin/env bash
# What a scheduler does to a job: a node that dies, too much memory, a time that is over without a
# warning. The log that was there is resumed from; the hash is the undisturbed run's.
. "$(dirname "$0")/case.sh"
size 131072
expected=$(whole)
resources=(--nodes=2 --ntasks-per-node=1 --cpus-per-task=1 --mem=1000)

n_items() { { "$BEMCAL_PROGRAM" status "$1" || true; } | awk '/done/ { n += $2 } END { print n + 0 }'; }
# resumed RESULT N: the run went on with at least N items, and ended with the expected hash
resumed() {
  local n
  n=$(sed -n 's/.*resuming: \([0-9]*\) items.*/\1/p' "${1%.h5}.out" | tail -n 1)
  [[ ${n:-0} -ge $2 ]] || fail "$1: $2 items were finished, but ${n:-0} are resumed"
  [[ $(hash_of "$1") == "$expected" ]] || fail "$1: another hash"
}

# The time is over (here by scancel, which sends the same SIGTERM), and no signal came before.
id=$(sbatch --parsable -o time.out --no-requeue "${resources[@]}" --signal=B:USR1@0 \
  "$root/jobs/slurm/several_nodes.sbatch" "$job" time.h5)
await 60 "the job begins" 'begun time.h5 20000'
scancel $id
await 30 "it ends" "ended $id"
[[ ! -e time.h5 ]] || fail "a cancelled run left a result"
n=$(n_items time.h5)
[[ $n -gt 0 ]] || fail "nothing was kept"
srun "${resources[@]}" bemcal-batch run "$job" -o time.h5 --resume >time.out 2>&1
resumed time.h5 "$n"

# Memory: the program itself needs little, so that a companion in the same job takes too much.
id=$(sbatch --parsable -o memory.out --no-requeue --nodes=1 --ntasks=2 --cpus-per-task=1 --mem=600 --wrap "
  mpirun bemcal-batch run $job -o memory.h5 &
  while [[ \$(cat memory.h5.part/rank-*.log 2>/dev/null | wc -c) -lt 20000 ]]; do sleep 0.05; done
  head -c 900m /dev/zero | tail -c 800m | sleep 30 & wait")
await 60 "the job is ended for its memory" "ended $id"
[[ $(field $id JobState) =~ FAILED|OUT_OF_MEMORY|CANCELLED ]] || fail "memory: state $(field $id JobState)"
[[ ! -e memory.h5 ]] || fail "memory: the run ended before it was ended"
n=$(n_items memory.h5)
[[ $n -gt 0 ]] || fail "memory: nothing was kept"
srun "${resources[@]}" bemcal-batch run "$job" -o memory.h5 --resume >memory.out 2>&1
resumed memory.h5 "$n"

# A node dies: its daemon, the step's daemons and the rank are gone at once. Slurm notices after 10 s
# and puts the job back into the queue.
id=$(sbatch --parsable -o node.out "${resources[@]}" "$root/jobs/slurm/several_nodes.sbatch" "$job" node.h5)
await 60 "the job begins" 'begun node.h5 20000'
daemon=$(cat "$folder/cluster/run/slurmd-node2.started")
namespace=$(readlink "/proc/$daemon/ns/uts")
for process in /proc/[0-9]*; do
  [[ $(readlink "$process/ns/uts" 2>/dev/null) == "$namespace" ]] && kill -KILL "${process#/proc/}" 2>/dev/null
done
await 60 "the job is put back" "[[ \$(field $id Restarts) -ge 1 ]]"
n=$(n_items node.h5)
[[ $n -gt 0 ]] || fail "node: nothing was kept"
[[ ! -e node.h5 ]] || fail "node: a broken run left a result"
# One node is left: the run goes on there.
scancel $id
await 30 "it ends" "ended $id"
srun --nodes=1 --ntasks=2 --mem=1000 -w node1 bemcal-batch run "$job" -o node.h5 --resume >node.out 2>&1
resumed node.h5 "$n"
