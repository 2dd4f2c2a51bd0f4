#!/usr/bin/env bash
# Every shipped job passes `check`, and runs to the end when made small.
set -euo pipefail
. "$(dirname "$0")/small_jobs.sh"
n_run=0
while read -r job; do
  if ! "$BEMCAL_PROGRAM" check "$job" >"$folder/log" 2>&1; then
    if [[ ! -d $folder/shared ]] && grep -q '/shared/.*cannot be opened' "$folder/log"; then
      echo "skipped, its data are at ../shared: ${job#"$jobs"/}"
      continue
    fi
    cat "$folder/log"
    fail "check failed: $job"
  fi
  code=0; "$BEMCAL_PROGRAM" run "$job" -o "$folder/result.h5" --force --no-report >"$folder/log" 2>&1 || code=$?
  # A posterior made small has not converged.
  if grep -qE '"(posterior|kennedy_ohagan)"' "$job" && [[ $code == 1 ]]; then code=0; fi
  [[ $code == 0 ]] || { cat "$folder/log"; fail "run failed with $code: $job"; }
  [[ -n $(hash_of "$folder/result.h5") ]] || fail "no result hash: $job"
  n_run=$((n_run + 1))
done < <(grep -lE '^\[\[study\]\]' "$jobs"/*/*.toml)
[[ $n_run -gt 0 ]] || fail "no job was run"
