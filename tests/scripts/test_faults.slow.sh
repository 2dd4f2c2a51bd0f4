#!/usr/bin/env bash
# What goes wrong around a run: its status while it runs, stopped and damaged; another version, changed
# data, a damaged log, a folder that cannot be written, a disk that is full.
set -euo pipefail
. "$(dirname "$0")/small_jobs.sh"
job=$jobs/quickstart/quickstart.toml
drop_posterior
sed -i -E 's/^( *n_points *=).*/\1 8192/; s/^( *points_per_item *=).*/\1 64/' "$job"
export OMP_NUM_THREADS=1
expect() {  # expect CODE WORDS COMMAND...: that exit code, and those words in what it prints
  local code=0
  "${@:3}" >"$folder/log" 2>&1 || code=$?
  [[ $code == "$1" ]] || { cat "$folder/log" >&2; fail "exit code $code instead of $1: ${*:3}"; }
  grep -qF -- "$2" "$folder/log" || { cat "$folder/log" >&2; fail "no word of '$2': ${*:3}"; }
}
expect 0 'result hash' "$BEMCAL_PROGRAM" run "$job" --no-report -o "$folder/whole.h5"
expected=$(hash_of "$folder/whole.h5")

# Running, then stopped.
result=$folder/stopped.h5
"$BEMCAL_PROGRAM" run "$job" --no-report -o "$result" >"$folder/run.log" 2>&1 &
pid=$!
for _ in $(seq 4000); do
  [[ $(stat -c %s "$result.part/rank-0.log" 2>/dev/null || echo 0) -gt 20000 ]] && break
  sleep 0.005
done
expect 75 'a run is writing it now' "$BEMCAL_PROGRAM" status "$result"
expect 73 'another run is writing there now' "$BEMCAL_PROGRAM" run "$job" --no-report -o "$result" --resume
kill -TERM "$pid"
code=0; wait "$pid" || code=$?
[[ $code == 75 ]] || fail "SIGTERM: exit code $code"
expect 75 '--resume` goes on' "$BEMCAL_PROGRAM" status "$result"
cp -r "$result.part" "$folder/kept"

# Another version, another job, other data: refused by name.
sed -i 's/^version\t.*/version\t9.9.9/' "$result.part/identity.txt"
expect 73 'it was begun by version 9.9.9, this is version' "$BEMCAL_PROGRAM" run "$job" --no-report -o "$result" --resume
cp "$folder/kept/identity.txt" "$result.part/"
data=$(sed -n 's/^file \(.*\)\t.*/\1/p' "$result.part/identity.txt" | grep -v toml | head -n 1)
cp "$(dirname "$job")/$data" "$folder/data"
if [[ $data == *.gz ]]; then
  { zcat "$folder/data"; echo; } | gzip >"$(dirname "$job")/$data"
else
  echo >>"$(dirname "$job")/$data"
fi
expect 73 "$data has changed since" "$BEMCAL_PROGRAM" run "$job" --no-report -o "$result" --resume
cp "$folder/data" "$(dirname "$job")/$data"
cp "$job" "$folder/job"
echo "# more" >>"$job"
expect 73 "$(basename "$job") has changed since" "$BEMCAL_PROGRAM" run "$job" --no-report -o "$result" --resume
cp "$folder/job" "$job"

# Damage: a byte changed or the end cut, at five places.
for place in 0.02 0.3 0.55 0.8 0.97; do
  rm -rf "$result" "$result.part"
  cp -r "$folder/kept" "$result.part"
  /usr/bin/python3 - "$result.part/rank-0.log" $place <<'END'
import os, sys
name, place = sys.argv[1], float(sys.argv[2])
at = int(os.path.getsize(name) * place)
if place > 0.9:
    os.truncate(name, at)
else:
    with open(name, "r+b") as log:
        log.seek(at)
        byte = log.read(1)[0]
        log.seek(at)
        log.write(bytes([byte ^ 0x10]))
END
  expect 75 'damaged record' "$BEMCAL_PROGRAM" status "$result"
  expect 0 'damaged records, to be done again: 1' "$BEMCAL_PROGRAM" run "$job" --no-report -o "$result" --resume
  [[ $(hash_of "$result") == "$expected" ]] || fail "another hash after damage at $place"
done

# A folder that cannot be written: root may write everywhere, nobody may not.
as_nobody=()
if [[ $(id -u) -eq 0 ]]; then as_nobody=(setpriv --reuid=65534 --regid=65534 --clear-groups); fi
mkdir "$folder/readonly"
chmod 755 "$folder"
chmod 555 "$folder/readonly"
expect 73 'cannot create the folder' "${as_nobody[@]}" "$BEMCAL_PROGRAM" run "$job" --no-report -o "$folder/readonly/a.h5"

# A full disk: what is finished is kept, and the run goes on when there is room.
if unshare --mount true 2>/dev/null; then
  mkdir "$folder/disk"
  unshare --mount bash -c '
    set -e
    mount -t tmpfs -o size=400k tmpfs "$1/disk"
    code=0; "$2" run "$3" --no-report -o "$1/disk/a.h5" >"$1/log" 2>&1 || code=$?
    [[ $code == 74 ]] || { cat "$1/log"; echo "a full disk: exit code $code"; exit 1; }
    grep -q "mend that and go on with --resume" "$1/log"
    mount -o remount,size=100m "$1/disk"
    "$2" run "$3" --no-report -o "$1/disk/a.h5" --resume >"$1/log" 2>&1
    grep -q "resuming: [1-9]" "$1/log"
    cp "$1/disk/a.h5" "$1/full.h5"' bash "$folder" "$BEMCAL_PROGRAM" "$job" || fail "a full disk: $(cat "$folder/log")"
  [[ $(hash_of "$folder/full.h5") == "$expected" ]] || fail "another hash after a full disk"
else
  echo "a full disk was not tested: no namespaces can be made here"
fi
