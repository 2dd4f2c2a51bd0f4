#!/usr/bin/env bash
# Every shipped job passes `check`, and runs to the end when made small. Without ../shared, those
# whose data lie there are named and left out.
set -euo pipefail
. "$(dirname "$0")/small_jobs.sh"
n_run=0
lacks_shared() {  # by the log of a command that failed
  [[ ! -d $folder/shared ]] && grep -q '/shared/.*cannot be opened' "$folder/log"
}
lacks_energyplus() {  # by the job's command
  grep -q energyplus_hours "$job" && [[ -z ${ENERGYPLUS_DIR:-} ]] && ! command -v energyplus >/dev/null
}
left_out() { echo "skipped, its data are at ../shared: ${job#"$jobs"/}"; }
while read -r job; do
  if lacks_energyplus; then echo "skipped, it needs EnergyPlus: ${job#"$jobs"/}"; continue; fi
  if ! "$BEMCAL_PROGRAM" check "$job" >"$folder/log" 2>&1; then
    if lacks_shared; then left_out; continue; fi
    cat "$folder/log"
    fail "check failed: $job"
  fi
  code=0; "$BEMCAL_PROGRAM" run "$job" -o "$folder/result.h5" --force --no-report >"$folder/log" 2>&1 || code=$?
  # A stock is sound as long as its own file is: that no building can be read is found by the run.
  if [[ $code == 65 ]] && lacks_shared; then left_out; continue; fi
  # A posterior made small has not converged.
  if grep -qE '"(posterior|kennedy_ohagan)"' "$job" && [[ $code == 1 ]]; then code=0; fi
  [[ $code == 0 ]] || { cat "$folder/log"; fail "run failed with $code: $job"; }
  [[ -n $(hash_of "$folder/result.h5") ]] || fail "no result hash: $job"
  n_run=$((n_run + 1))
done < <(grep -lE '^\[\[study\]\]' "$jobs"/*/*.toml)
[[ $n_run -gt 0 ]] || fail "no job was run"
