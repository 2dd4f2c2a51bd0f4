#!/usr/bin/env bash
# A job array adds chains to one posterior; `report` of all results puts them together. A nightly job
# submits itself for the next night.
small=small_posterior
. "$(dirname "$0")/case.sh"
resources=(--cpus-per-task=1 --mem=1000 --time=10)
id=$(sbatch --parsable -o 'chains-%a.out' --array=0-2 "${resources[@]}" "$root/jobs/slurm/chains_array.sbatch" "$job" 4)
await 200 "the array ends" "ended $id"
[[ $(field "$id" JobState) == COMPLETED ]] || fail "the array: $(tail -n 5 chains-*.out)"
"$BEMCAL_PROGRAM" report quickstart-0.h5 quickstart-1.h5 quickstart-2.h5 >report
grep -q 'NOT CONVERGED: 12 chains of 60 draws' report || fail "the chains were not put together: $(cat report)"

id=$(sbatch --parsable -o night.out --ntasks=1 "${resources[@]}" "$root/jobs/slurm/nightly.sbatch" "$job")
await 100 "the night ends" "ended $id"
compgen -G 'quickstart-20*.h5' >/dev/null || fail "no result of the night: $(cat night.out)"
next=$(squeue -h -n bemcal-nightly -t PENDING -o %i)
[[ -n $next ]] || fail "the next night was not submitted: $(cat night.out)"
[[ $(field "$next" StartTime) > $(date +%FT%T) ]] || fail "the next night begins at $(field "$next" StartTime)"
