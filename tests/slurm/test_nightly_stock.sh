#!/usr/bin/env bash
# The nightly job of a stock goes on from the newest earlier night: only what has changed since is done.
. "$(dirname "$0")/case.sh"
/usr/bin/python3 -B - "$here/../generator" <<'PYTHON'
import pathlib, sys
sys.path.insert(0, sys.argv[1])
import stock as made
folder = pathlib.Path(".")
stock = made.make(folder, 6, 2, seed=8, broken_share=0)
(folder / "houses.toml").write_text(made.job_text(16))
PYTHON
run() { "$BEMCAL_PROGRAM" run houses.toml --no-report -o "$@" >log 2>&1 || { cat log >&2; fail "failed: $*"; }; }
run houses-2020-01-01.h5
sed -i -E '2s/^([^,]*,[^,]*,[^,]*,[^,]*,[^,]*,)[0-9.]+/\1777/' buildings.csv
run houses-2020-01-02.h5 --after houses-2020-01-01.h5
sed -i -E '3s/^([^,]*,[^,]*,[^,]*,[^,]*,[^,]*,)[0-9.]+/\1888/' buildings.csv

id=$(sbatch --parsable -o night.out --ntasks=2 --cpus-per-task=1 --mem=1000 --time=10 \
  "$root/jobs/slurm/nightly.sbatch" houses.toml)
await 100 "the night ends" "ended $id"
[[ $(field "$id" JobState) == COMPLETED ]] || fail "the night: $(tail -n 5 night.out)"
table=$(compgen -G 'houses-20[2-9]?-??-??.csv' | grep -v houses-2020 || true)
[[ -f $table ]] || fail "no table of the night: $(cat night.out)"
# After the second night only the third line is another; after the first, two would be.
[[ $(grep -c ',calibrated,line,' "$table") == 1 ]] || fail "done again: $(cat "$table")"
[[ $(grep -c ',unchanged,,' "$table") == 5 ]] || fail "not left alone: $(cat "$table")"
