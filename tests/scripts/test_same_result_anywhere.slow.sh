#!/usr/bin/env bash
# The quickstart, made small, has the same result hash on 1, 2, 3, 7, 16 ranks with 1 and 2 threads, on 64
# ranks, and when 4, 2 and then 7 ranks go on with each other's work.
set -euo pipefail
. "$(dirname "$0")/small_jobs.sh"
job=$jobs/quickstart/quickstart.toml
drop_posterior
sed -i -E 's/^( *n_points *=).*/\1 8192/; s/^( *points_per_item *=).*/\1 64/' "$job"
export OMP_WAIT_POLICY=passive
run() {  # run RANKS THREADS OPTIONS...
  mpirun --oversubscribe --bind-to none -np "$1" "$BEMCAL_PROGRAM" run "$job" --no-report --threads "$2" "${@:3}" >"$folder/log" 2>&1
}
OMP_NUM_THREADS=1 "$BEMCAL_PROGRAM" run "$job" --no-report -o "$folder/one.h5" >"$folder/log" 2>&1
expected=$(hash_of "$folder/one.h5")
[[ -n $expected ]] || fail "no result hash"
for shape in 1x1 1x2 2x1 2x2 3x1 3x2 7x1 7x2 16x1 16x2 64x1; do
  run "${shape%x*}" "${shape#*x}" -o "$folder/shape.h5" --force || { cat "$folder/log" >&2; fail "failed: $shape"; }
  [[ $(hash_of "$folder/shape.h5") == "$expected" ]] || fail "another hash on $shape ranks x threads"
done

result=$folder/resumed.h5
for ranks in 4 2; do  # stopped once a third more is done
  before=$(cat "$result".part/*.log 2>/dev/null | wc -c)
  run $ranks 1 -o "$result" --resume &
  launcher=$!
  for _ in $(seq 4000); do
    [[ $(cat "$result".part/*.log 2>/dev/null | wc -c) -gt $((before + 20000)) ]] && break
    sleep 0.005
  done
  kill -USR1 "$(pgrep -P $launcher | tail -n 1)" 2>/dev/null || true
  code=0; wait $launcher || code=$?
  [[ $code == 75 ]] || fail "stopped on $ranks ranks: exit code $code"
done
run 7 1 -o "$result" --resume
grep -q 'resuming: [1-9]' "$folder/log" || fail "nothing was resumed"
[[ $(hash_of "$result") == "$expected" ]] || fail "another hash after 4, 2 and 7 ranks"
