#!/usr/bin/env bash
# kill -9 of a rank in the middle of a run, then --resume on another number of ranks: the same hash as
# without interruption. Also: the exit codes of what stops a run.
set -euo pipefail
. "$(dirname "$0")/small_jobs.sh"
job=$jobs/quickstart/quickstart.toml
drop_posterior
sed -i -E 's/^( *n_points *=).*/\1 8192/; s/^( *points_per_item *=).*/\1 64/' "$job"
grep -q '^ *points_per_item' "$job" || sed -i -E 's/^( *n_points *=.*)/\1\npoints_per_item = 64/' "$job"
export OMP_NUM_THREADS=1
ranks=(mpirun --oversubscribe --bind-to none)
"$BEMCAL_PROGRAM" run "$job" --no-report -o "$folder/whole.h5" >"$folder/log" 2>&1
expected=$(hash_of "$folder/whole.h5")
[[ -n $expected ]] || fail "no result hash"

# The victim is the last of the three ranks, once some of its items are in its log.
result=$folder/killed.h5
"${ranks[@]}" -np 3 "$BEMCAL_PROGRAM" run "$job" --no-report -o "$result" >"$folder/log" 2>&1 &
launcher=$!
for _ in $(seq 2000); do
  [[ $(stat -c %s "$result.part/rank-2.log" 2>/dev/null || echo 0) -gt 20000 ]] && break
  kill -0 "$launcher" 2>/dev/null || break
  sleep 0.005
done
victim=$(pgrep -P "$launcher" | tail -n 1)
kill -9 "$victim" || fail "the run was over before it could be killed"
wait "$launcher" && fail "mpirun says 0 although a rank was killed"
[[ ! -e $result ]] || fail "a killed run left a result"
code=0; "$BEMCAL_PROGRAM" status "$result" >"$folder/status" || code=$?
[[ $code == 75 ]] || fail "status of a killed run: exit code $code"
code=0; "$BEMCAL_PROGRAM" run "$job" --no-report -o "$result" >"$folder/log" 2>&1 || code=$?
[[ $code == 73 ]] || fail "an unfinished run was not refused: exit code $code"
"${ranks[@]}" -np 2 "$BEMCAL_PROGRAM" run "$job" --no-report -o "$result" --resume >"$folder/log" 2>&1
grep -q 'resuming: [1-9]' "$folder/log" || fail "nothing was resumed"
[[ $(hash_of "$result") == "$expected" ]] || fail "another hash after kill and resume"

# A signal: code 75, then resumable.
result=$folder/stopped.h5
"$BEMCAL_PROGRAM" run "$job" --no-report -o "$result" >"$folder/log" 2>&1 &
pid=$!
for _ in $(seq 2000); do
  [[ $(stat -c %s "$result.part/rank-0.log" 2>/dev/null || echo 0) -gt 20000 ]] && break
  sleep 0.005
done
kill -TERM "$pid"
code=0; wait "$pid" || code=$?
[[ $code == 75 ]] || fail "SIGTERM: exit code $code"
grep -q -e --resume "$folder/log" || fail "no word on how to go on"
"${ranks[@]}" -np 4 "$BEMCAL_PROGRAM" run "$job" --no-report -o "$result" --resume >"$folder/log" 2>&1
[[ $(hash_of "$result") == "$expected" ]] || fail "another hash after SIGTERM and resume"
