#!/usr/bin/env bash
# USR1 to the batch script: through the shipped scripts with srun and mpirun, on one node and two, and
# through a plain `exec srun` and `exec mpirun`. All ranks end within 2 s with code 75; the shipped
# scripts requeue, and the result has the undisturbed run's hash.
. "$(dirname "$0")/case.sh"
size 131072
expected=$(whole)
resources=(--cpus-per-task=1 --mem=1000 --time=10)

# All processes of the program that write to that result.
ranks_of() { pgrep -f -- "^[^ ]*bemcal-batch run .*-o $1( |\$)" || true; }
# stop ID RESULT: signals the batch script, and says how long the ranks took to end [ms]
stop() {
  await 60 "$2 begins" "begun $2 20000"
  local begin; begin=$(now)
  scancel --signal=USR1 --batch "$1"
  await 20 "the ranks of $2 end" "[[ -z \$(ranks_of $2) ]]"
  local took; took=$(since "$begin")
  echo "$2: all ranks ended $took ms after the signal"
  [[ $took -lt 2000 ]] || fail "$2: the ranks took $took ms to end"
}

for case in one_node:srun:2 one_node:mpirun:2 several_nodes:srun:4 several_nodes:mpirun:4; do
  IFS=: read -r script launcher ranks <<<"$case"
  name=$script-$launcher
  shape=(--nodes=1 --ntasks=2)
  [[ $script == several_nodes ]] && shape=(--nodes=2 --ntasks-per-node=2)
  id=$(LAUNCHER=$launcher sbatch --parsable -o $name.out "${shape[@]}" "${resources[@]}" \
    "$root/jobs/slurm/$script.sbatch" "$job" $name.h5)
  stop $id $name.h5
  await 120 "$name goes on and ends" "ended $id"
  [[ $(field $id JobState) == COMPLETED ]] || fail "$name: state $(field $id JobState): $(tail -n 5 $name.out)"
  grep -q "$ranks ranks" $name.out || fail "$name: not on $ranks ranks: $(head -n 3 $name.out)"
  grep -q 'resuming: [1-9]' $name.out || fail "$name: nothing was resumed"
  [[ $(hash_of $name.h5) == "$expected" ]] || fail "$name: another hash"
done

for launcher in srun mpirun; do
  name=exec-$launcher
  id=$(sbatch --parsable -o $name.out --no-requeue --nodes=2 --ntasks-per-node=2 "${resources[@]}" \
    --wrap "exec $launcher bemcal-batch run $job -o $name.h5 --resume")
  stop $id $name.h5
  await 20 "$name ends" "ended $id"
  [[ $(field $id ExitCode) == 75:0 ]] || fail "$name: exit code $(field $id ExitCode): $(tail -n 5 $name.out)"
  code=0; "$BEMCAL_PROGRAM" status $name.h5 >/dev/null || code=$?
  [[ $code == 75 ]] || fail "$name: status of a stopped run: $code"
done
