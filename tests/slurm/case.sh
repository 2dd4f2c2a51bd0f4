# Sourced by the tests here: a cluster of their own and the quickstart without its last studies, as
# large as the test wants. Without Slurm, or without namespaces, the test is skipped (77).
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
PATH=$PATH:/usr/sbin:/sbin
for program in slurmctld slurmd sbatch munged; do
  command -v $program >/dev/null && continue
  echo "skipped: $program is not installed (scripts/install-packages slurm)"
  exit 77
done
if ! unshare --uts --mount true 2>/dev/null; then
  echo "skipped: no namespaces can be made here (CAP_SYS_ADMIN)"
  exit 77
fi
if [[ ${BEMCAL_ON_LOOPBACK:-} != yes ]]; then
  BEMCAL_ON_LOOPBACK=yes exec "$here/on_loopback.sh" "$0" "$@"
fi
set -euo pipefail
. "$here/../scripts/${small:-small_jobs}.sh"
trap '"$here/cluster_down.sh" "$folder/cluster"; rm -rf "$folder"' EXIT
environment=$("$here/cluster_up.sh" "$folder/cluster")
. "$environment"
cd "$folder"
export OMP_NUM_THREADS=1 BEMCAL_PROGRAM PATH=$(dirname "$BEMCAL_PROGRAM"):$PATH
job=$jobs/quickstart/quickstart.toml
[[ ${small:-} ]] || drop_posterior

# size N [ITEM]: points of the screening, and of each of its items
size() { sed -i -E "s/^( *n_points *=).*/\1 $1/; s/^( *points_per_item *=).*/\1 ${2:-64}/" "$job"; }
whole() {  # the hash of an undisturbed run
  "$BEMCAL_PROGRAM" run "$job" --no-report -o whole.h5 --force >log 2>&1 || { cat log >&2; fail "failed: the undisturbed run"; }
  hash_of whole.h5
}
field() {  # field ID NAME: of the job's record; these clusters keep no accounts
  scontrol show job -o "$1" | tr ' ' '\n' | sed -n "s/^$2=//p" | head -n 1
}
await() {  # await SECONDS WHAT COMMAND...
  local end=$((SECONDS + $1))
  until eval "${@:3}" 2>/dev/null; do
    if ((SECONDS >= end)); then
      squeue >&2; tail -n 20 *.out "$folder"/cluster/log/slurmctld.log >&2
      fail "waited $1 s in vain: $2"
    fi
    sleep 0.05
  done
}
ended() { [[ $(squeue -h -j "$1" -o %T 2>/dev/null) == "" ]]; }
in_state() { [[ $(field "$1" JobState) == "$2" ]]; }
# begun FILE BYTES: the ranks' logs of that result hold so much
begun() { [[ $(cat "$1".part/rank-*.log 2>/dev/null | wc -c) -gt $2 ]]; }
now() { date +%s%N; }
since() { echo $((($(now) - $1) / 1000000)); }   # [ms]
