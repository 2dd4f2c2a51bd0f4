#!/usr/bin/env bash
# Ends what cluster_up.sh started in a folder, and what its jobs left behind, each by its pid; then
# removes the folder. Does nothing where there is none.
# Usage: cluster_down.sh FOLDER
set -uo pipefail
folder=$(realpath -m "$1")
[[ -e $folder/slurm.conf ]] || exit 0
. "$folder/environment"
timeout 5 scancel -u "$(id -un)" 2>/dev/null
for _ in $(seq 30); do
  [[ -z $(timeout 5 squeue -h -o %i 2>/dev/null) ]] && break
  sleep 0.1
done

# A pid may be another's by now: its name must still be that of the daemon.
is_daemon() { local comm; read -r comm 2>/dev/null <"/proc/$1/comm" && [[ $comm == "$2" ]]; }
stop() {  # stop NAME: of the file with its pid
  local pid name=${1%%-*}
  pid=$(cat "$folder/run/$1.started" 2>/dev/null) || return 0
  is_daemon "$pid" "$name" || return 0
  kill -TERM "$pid"
  for _ in $(seq 100); do is_daemon "$pid" "$name" || return 0; sleep 0.1; done
  kill -KILL "$pid"
}
stop slurmd-node1
stop slurmd-node2
stop slurmctld

# Steps and processes of this cluster's jobs, known by their environment: its configuration and a job.
for environ in $(grep -lzxF "SLURM_CONF=$folder/slurm.conf" /proc/[0-9]*/environ 2>/dev/null); do
  pid=${environ#/proc/}
  pid=${pid%/environ}
  is_daemon "$pid" slurmstepd || grep -qz '^SLURM_JOB_ID=' "$environ" 2>/dev/null || continue
  echo "cluster_down.sh: ends process $pid, left by a job" >&2
  kill -KILL "$pid" 2>/dev/null
done
stop munged
rm -rf "$folder"
