#!/usr/bin/env bash
# A meter that the model cannot reach over its parameters' ranges: the first line says so with the
# factor and the unit that would mend it, and the run ends with 1; a right meter ends with 0.
set -euo pipefail
. "$(dirname "$0")/small_posterior.sh"
sed -i '/^\[\[study\]\]/,$d' "$job"
printf '[[study]]\nkind = "screening"\nn_points = 256\n' >>"$job"
# The meters of heating and cooling go: they show little in January.
awk '/^\[\[meter\]\]/ { held = $0; next }
  held { skipping = !/electricity/; if (!skipping) print held; held = "" }
  skipping && /^\[/ { skipping = 0 }
  !skipping { print }' "$job" >"$folder/job.toml" && mv "$folder/job.toml" "$job"
readings=$jobs/quickstart/measured_2021_2022.csv
cp "$readings" "$folder/right.csv"
run() {  # run CODE FACTOR: of the electricity; the first line of what is printed is in $first
  local code=0
  awk -F, -v OFS=, -v factor="$2" 'NR > 1 && $2 != "" { $2 = sprintf("%.9g", $2 * factor) } { print }' \
    "$folder/right.csv" >"$readings"
  "$BEMCAL_PROGRAM" run "$job" -o "$folder/result.h5" --force --no-report >"$folder/log" 2>"$folder/errors" || code=$?
  [[ $code == "$1" ]] || { cat "$folder/log" "$folder/errors" >&2; fail "electricity times $2: exit code $code, not $1"; }
  first=$(head -n 1 "$folder/log")
}
says() { [[ $first == *"$1"* ]] || fail "the first line does not say \"$1\": $first"; }

run 0 1
[[ $first != NOT* ]] || fail "a right meter: $first"

run 1 1000  # Wh, declared as kWh
says "NOT REACHED: quickstart/data: electricity in training: metered "
says " times the most that the model reaches, "
says "read as kWh, and would lie in this range as Wh "
says "(times 1/1000)"
"$BEMCAL_PROGRAM" status "$folder/result.h5" | grep -q 'a target was missed' || fail "status is silent"

run 1 0.000231481481  # kWh/m2 of 4320 m2, declared as kWh
says " of the least that the model reaches, "
says " as kWh/m2 "
says "(times 4320)"
