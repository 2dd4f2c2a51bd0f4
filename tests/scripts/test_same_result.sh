#!/usr/bin/env bash
# The quickstart, made small, has the same result hash for any number of ranks and threads and for
# each instruction set of this processor.
set -euo pipefail
. "$(dirname "$0")/small_jobs.sh"
job=$jobs/quickstart/quickstart.toml
drop_posterior
run() {  # run NAME COMMAND...: its hash
  local result=$folder/$1.h5
  "${@:2}" run "$job" --no-report -o "$result" >"$folder/log" 2>&1 || { cat "$folder/log" >&2; fail "failed: ${*:2}"; }
  hash_of "$result"
}
same() {  # same NAME COMMAND...
  local hash
  hash=$(run "$@")
  [[ $hash == "$expected" ]] || fail "$1: hash $hash, but $expected on one rank"
}
ranks=(mpirun --oversubscribe --bind-to none)
expected=$(OMP_NUM_THREADS=1 run one_rank "$BEMCAL_PROGRAM")
[[ -n $expected ]] || fail "no result hash"
same three_threads env OMP_NUM_THREADS=3 "$BEMCAL_PROGRAM"
same two_ranks env OMP_NUM_THREADS=1 "${ranks[@]}" -np 2 "$BEMCAL_PROGRAM"
same five_ranks env OMP_NUM_THREADS=1 "${ranks[@]}" -np 5 "$BEMCAL_PROGRAM"
same scalar env BEMCAL_KERNEL=scalar "$BEMCAL_PROGRAM"
if grep -qw avx2 /proc/cpuinfo; then same v3 env BEMCAL_KERNEL=v3 "$BEMCAL_PROGRAM"; fi
if grep -qw avx512vl /proc/cpuinfo; then same v4 env BEMCAL_KERNEL=v4 "$BEMCAL_PROGRAM"; fi
