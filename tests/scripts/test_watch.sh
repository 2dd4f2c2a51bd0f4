#!/usr/bin/env bash
# status --watch follows a small posterior on two ranks from another process: lines with items, draws and
# acceptance while it runs, its status at the end; codes of a run that ends, is stopped and is not there.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/small_posterior.sh"
sed -i 's/^draws_per_round *=.*/draws_per_round = 30000/; s/^most_draws *=.*/most_draws = 3000000/' "$job"
result=$folder/result.h5
export OMP_NUM_THREADS=1
ranks=(mpirun --oversubscribe --bind-to none -np 2 "$BEMCAL_PROGRAM" run "$job" --no-report -o "$result")
pattern='^quickstart/posterior: round [0-9]+: 0 of 1 items, 0 failed, [0-9:]+ left in this round'
pattern+='( \(ends about [0-9: -]+\))?; draw [0-9]+ of 30000, acceptance 0\.[0-9]+; after [0-9]+ draws R-hat [0-9.]+, ESS [0-9]+$'
status() { "$BEMCAL_PROGRAM" status "$@"; }

"${ranks[@]}" >"$folder/said" 2>&1 & run=$!
for ((k = 0; k < 600; ++k)); do [[ -e $result.part/progress.txt ]] && break; sleep 0.1; done
[[ -e $result.part/progress.txt ]] || fail "no progress: $(cat "$folder/said")"
code=0; status "$result" --watch --every 0.2 >"$folder/watched" & watch=$!
for ((k = 0; k < 300; ++k)); do
  grep -qE "$pattern" "$folder/watched" && break
  sleep 0.2
done
status "$result" >"$folder/once" || code=$?
[[ $code == 75 ]] || fail "status of a run: exit code $code"
grep -q '^  now quickstart/posterior: round' "$folder/once" || fail "status tells no progress: $(cat "$folder/once")"
kill -TERM $(pgrep -P $run)  # both ranks
code=0; wait $run || code=$?
[[ $code == 75 ]] || fail "the run: exit code $code: $(cat "$folder/said")"
code=0; wait $watch || code=$?
[[ $code == 75 ]] || fail "watching a run that is stopped: exit code $code"
grep -qE "$pattern" "$folder/watched" ||
  fail "not the lines expected: $(cat "$folder/watched")"
grep -q -- '--resume` goes on' "$folder/watched" || fail "no status at the end: $(tail -n 3 "$folder/watched")"
[[ ! -e $result.part/progress.txt ]] || fail "the progress of a run that has ended stands there"

sed -i 's/^most_draws *=.*/most_draws = 40/; s/^draws_per_round *=.*/draws_per_round = 20/' "$job"
"${ranks[@]}" --force >"$folder/said" 2>&1 || [[ $? == 1 ]] || fail "$(cat "$folder/said")"
[[ ! -e $result.part ]] || fail "left beside the result: $(ls "$result.part")"
code=0; status "$result" --watch >"$folder/watched" || code=$?
[[ $code == 0 ]] && grep -q 'result hash' "$folder/watched" || fail "watching a whole result: exit code $code"
code=0; status "$folder/none.h5" --watch 2>"$folder/watched" || code=$?
[[ $code == 66 ]] || fail "watching nothing: exit code $code"
code=0; status "$result" --every 2 2>"$folder/watched" || code=$?
[[ $code == 64 ]] || fail "--every alone: exit code $code"
