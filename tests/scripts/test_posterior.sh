#!/usr/bin/env bash
# A short posterior: the same result for any ranks, also after a stop between rounds; a missed
# target in the exit code, in status and first in the report; chains of two runs put together.
set -euo pipefail
. "$(dirname "$0")/small_posterior.sh"
export OMP_NUM_THREADS=1
ranks=(mpirun --oversubscribe --bind-to none)
run() {  # run CODE COMMAND...: must end with that code
  local code=0
  "${@:2}" >"$folder/log" 2>&1 || code=$?
  [[ $code == "$1" ]] || { cat "$folder/log" >&2; fail "exit code $code, not $1: ${*:2}"; }
}
run 1 "$BEMCAL_PROGRAM" run "$job" --no-report -o "$folder/one.h5"
expected=$(hash_of "$folder/one.h5")
grep -q '^NOT REACHED: quickstart/posterior: not converged' "$folder/log" || fail "the target is not mentioned"
"$BEMCAL_PROGRAM" status "$folder/one.h5" | grep -q 'a target was missed' || fail "status is silent"

run 1 "${ranks[@]}" -np 3 "$BEMCAL_PROGRAM" run "$job" --no-report -o "$folder/three.h5"
[[ $(hash_of "$folder/three.h5") == "$expected" ]] || fail "another hash on three ranks"

# Stops again and again, a little later each time, on other numbers of ranks.
code=75 n=0
for seconds in 0.01 0.3 0.6 1 2 4 8 1000; do
  [[ $code == 75 ]] || break
  code=0 n=$((n % 3 + 1))
  "${ranks[@]}" -np "$n" "$BEMCAL_PROGRAM" run "$job" --no-report -o "$folder/stopped.h5" --resume \
    --stop-after "$seconds" >"$folder/log" 2>&1 || code=$?
done
[[ $code == 1 ]] || fail "the stopped run ended with $code"
[[ $(hash_of "$folder/stopped.h5") == "$expected" ]] || fail "another hash after stops"

run 1 "$BEMCAL_PROGRAM" run "$job" --no-report -o "$folder/more.h5" --first-chain 4
[[ $(hash_of "$folder/more.h5") != "$expected" ]] || fail "other chains have the same draws"
run 0 "$BEMCAL_PROGRAM" report "$folder/one.h5" "$folder/more.h5"
grep -q 'NOT CONVERGED: 8 chains of 60 draws' "$folder/log" || fail "the chains were not put together"
run 64 "$BEMCAL_PROGRAM" run "$jobs/paper1_sobol_first" -o "$folder/none.h5" --first-chain 4
