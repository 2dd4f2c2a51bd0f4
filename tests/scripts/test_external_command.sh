#!/usr/bin/env bash
# A job whose simulator is another program: the same result on one rank and on three, points that
# fail are data, and what hangs is ended with all that it started.
set -euo pipefail
. "$(dirname "$0")/small_jobs.sh"
job=$jobs/external_command
ranks=(mpirun --oversubscribe --bind-to none)
cd "$folder"
sed -i 's#"python3"#"/usr/bin/python3"#; s/^n_base.*/n_base = 4/; s/^n_designs.*/n_designs = 4/' "$job"/*.toml
run() {  # run CODE JOB RESULT [COMMAND...]: its hash
  local code=0
  "${@:4}" "$BEMCAL_PROGRAM" run "$2" --no-report -o "$3" --force >log 2>&1 || code=$?
  [[ $code == "$1" ]] || { cat log >&2; fail "exit code $code, not $1: ${*:2}"; }
  hash_of "$3"
}
one=$(run 0 "$job/external_command.toml" one.h5)
three=$(run 0 "$job/external_command.toml" three.h5 "${ranks[@]}" -np 3)
[[ -n $one && $one == "$three" ]] || fail "hash $one on one rank, $three on three"
[[ ! -e external_command.points ]] || fail "folders of points are left over"

# The search for a measured number goes on in rounds, each from the answers before.
sed '/^\[\[study\]\]/,$d' "$job/external_command.toml" >"$job/search.toml"
printf '%s\n' '[[study]]' 'kind = "optimisation"' 'method = "pattern"' 'evaluations = 12' \
  '[[study.target]]' 'output = "heat_loss"' 'measured = 200' >>"$job/search.toml"
one=$(run 0 "$job/search.toml" one.h5)
three=$(run 0 "$job/search.toml" three.h5 "${ranks[@]}" -np 3)
[[ -n $one && $one == "$three" ]] || fail "search: hash $one on one rank, $three on three"

# Some points fail: the others count, the folders stay, the reasons are stored.
sed -i 's/^def main():/&\n    import time\n    if "9" in open(sys.argv[1]).read()[:20]: sys.exit("an odd house")/' "$job/house.py"
sed -i '/^\[simulator\]/i [output]\nmax_failed_share = 1\n' "$job/external_command.toml"
one=$(run 0 "$job/external_command.toml" one.h5)
three=$(run 0 "$job/external_command.toml" three.h5 "${ranks[@]}" -np 3)
[[ -n $one && $one == "$three" ]] || fail "with failures: hash $one on one rank, $three on three"
grep -q 'exit code 1: an odd house' log || { cat log; fail "no reason in the report"; }
[[ -n $(ls external_command.points) ]] || fail "the folders of failed points are gone"

# Every point hangs: nothing was simulated, so the batch has failed.
rm -r external_command.points
sed -i 's/^    import time/&; import subprocess; subprocess.run(["sleep", "86397"])/' "$job/house.py"
sed -i 's/^time_limit.*/time_limit = 0.3/; s/^n_base.*/n_base = 2/' "$job/external_command.toml"
run 65 "$job/external_command.toml" hangs.h5 >/dev/null
grep -q 'not done at its time limit of 0.3 s' log || { cat log; fail "nothing hung"; }
if pgrep -f 'sleep 86397' >/dev/null; then fail "what hung still runs"; fi

# Kennedy and O'Hagan's model from runs of the program.
cp "$root/jobs/external_command/house.py" "$job/house.py"
one=$(run 1 "$job/calibration.toml" one.h5)
three=$(run 1 "$job/calibration.toml" three.h5 "${ranks[@]}" -np 3)
[[ -n $one && $one == "$three" ]] || fail "calibration: hash $one on one rank, $three on three"
