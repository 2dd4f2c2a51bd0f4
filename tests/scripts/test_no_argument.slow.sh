#!/usr/bin/env bash
# The installed program, started without an argument in any folder, runs the quickstart and writes
# quickstart-NNN.h5 with the next free number and its page; what stands there already is left alone.
# The README's cut of the last tables is what it prints.
set -euo pipefail
. "$(dirname "$0")/../../scripts/environment"
fail() { echo "$*" >&2; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$BEMCAL_BUILD" --prefix "$folder/prefix" >/dev/null
program=$folder/prefix/bin/bemcal-batch
mkdir "$folder/work"
cd "$folder/work"
echo mine >quickstart-001.h5
start=$SECONDS
mpirun --oversubscribe -np 2 "$program" >"$folder/log" 2>&1 || { cat "$folder/log" >&2; fail "it failed"; }
echo "$((SECONDS - start)) s on two ranks"
[[ $(cat quickstart-001.h5) == mine ]] || fail "quickstart-001.h5 was overwritten"
[[ -f quickstart-002.h5 ]] || fail "no quickstart-002.h5, but: $(ls)"
"$program" status quickstart-002.h5 | grep -qE '\b[0-9a-f]{32}\b' || fail "no result hash"
[[ $(ls -A) == $'quickstart-001.h5\nquickstart-002.h5\nquickstart-002.html' ]] || fail "left behind: $(ls -A)"
grep -q "wrote quickstart-002.html" "$folder/log" || fail "no word of the page"
# The last table is that of the errors before and after, on the held-out year.
tables=$(grep -v '^bemcal-batch: ' "$folder/log" | sed '/^$/d' | tail -n 1)
[[ $tables == *held_out*electricity*monthly* ]] || fail "the last line is: $tables"
in_one_line() { tr -s ' \n' ' '; }
printed=$(in_one_line <"$folder/log")
for part in '/^  effect found/,/^  other hours than declared (/p' '/^  error in held_out/,/^      to/p'; do
  cut=$(sed -n "$part" "$(dirname "$0")/../../README.md" | in_one_line)
  [[ -n $cut && $printed == *"$cut"* ]] || fail "README.md shows what is not printed: $cut"
done
