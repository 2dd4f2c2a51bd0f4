#!/usr/bin/env bash
# Starts a private two-node Slurm on this host, with all its state in one folder, and prints the
# file to source for its clients. Neither the host's Slurm nor its munge is read or written.
# Usage: . "$(cluster_up.sh FOLDER)"; ...; cluster_down.sh FOLDER
# Each node has a host name, a /dev/shm and a PMIx folder of its own (namespaces, for which it wants
# CAP_SYS_ADMIN): otherwise ranks on two nodes would meet in the same shared memory.
# CLUSTER_CPUS CPUs [4] and CLUSTER_MEMORY MB [4096] are what each node claims to have.
set -euo pipefail
folder=$(realpath -m "$1")
cpus=${CLUSTER_CPUS:-4} memory=${CLUSTER_MEMORY:-4096}
PATH=$PATH:/usr/sbin:/sbin
die() { echo "cluster_up.sh: $*" >&2; exit 1; }
for program in slurmctld slurmd sbatch munged; do
  command -v $program >/dev/null || die "$program is missing: scripts/install-packages slurm"
done
unshare --uts --mount true 2>/dev/null || die "no namespaces can be made here (CAP_SYS_ADMIN)"

umask 022
mkdir -p "$folder"/{state,log,run,pmix,ompi,spool/node1,spool/node2}
install -d -m 0700 "$folder/munge"         # munged insists on a private folder for its key
(umask 077; head -c 128 /dev/urandom >"$folder/munge/key")
chmod 0711 "$folder/run"                   # and on one for its socket that all may pass
# Ports that nobody uses: without a network namespace two clusters may run side by side.
port=$((20000 + $$ % 20000))
with_pmix=none
[[ $(ldconfig -p) == *libpmix.so.2* ]] && with_pmix=pmix
user=$(id -un)

cat >"$folder/slurm.conf" <<CONF
ClusterName=private
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort=$port
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
# A job that is requeued waits so long before it may start again (Slurm's own: 120 s).
AuthInfo=socket=$folder/run/munge.sock,cred_expire=5
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmctldPidFile=$folder/run/slurmctld.pid
SlurmdPidFile=$folder/run/slurmd-%n.pid
SlurmdSpoolDir=$folder/spool/%n
SlurmctldLogFile=$folder/log/slurmctld.log
SlurmdLogFile=$folder/log/slurmd-%n.log
# Processes are found in /proc and memory is polled: no control groups are needed.
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/linux
JobAcctGatherFrequency=task=1
JobAcctGatherParams=OverMemoryKill
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
DefMemPerCPU=$((memory / cpus))
SchedulerParameters=sched_interval=1,sched_min_interval=0,batch_sched_delay=0,bf_interval=1
SlurmdParameters=config_overrides
SwitchType=switch/none
MpiDefault=$with_pmix
ReturnToService=2
# A node that is gone is noticed after so many seconds, and its jobs are requeued.
SlurmdTimeout=10
SlurmctldTimeout=30
InactiveLimit=0
MinJobAge=600
KillWait=5
UnkillableStepTimeout=30
JobRequeue=1
AccountingStorageType=accounting_storage/none
MailProg=/bin/true
NodeName=node1 NodeHostname=node1 NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=$cpus CoresPerSocket=$cpus RealMemory=$memory State=UNKNOWN
NodeName=node2 NodeHostname=node2 NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=$cpus CoresPerSocket=$cpus RealMemory=$memory State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
echo "PMIxCliTmpDirBase=$folder/pmix" >"$folder/mpi.conf"
{ cat /etc/hosts; echo "127.0.0.1 node1 node2"; } >"$folder/hosts"   # seen by the nodes only

cat >"$folder/environment" <<ENVIRONMENT
export SLURM_CONF='$folder/slurm.conf' OMP_WAIT_POLICY=passive
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_oob_tcp_if_include=lo OMPI_MCA_btl_tcp_if_include=lo PMIX_MCA_ptl_tcp_if_include=lo
export OMPI_MCA_btl=self,vader,tcp OMPI_MCA_pml=ob1 OMPI_MCA_orte_tmpdir_base='$folder/ompi'
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none
ENVIRONMENT
. "$folder/environment"

start() {  # start NAME COMMAND...: without this terminal; its pid is kept
  setsid "${@:2}" </dev/null >>"$folder/log/$1.out" 2>&1 &
  echo $! >"$folder/run/$1.started"
}
await() {  # await SECONDS WHAT COMMAND...
  local end=$((SECONDS + $1))
  until "${@:3}" >/dev/null 2>&1; do
    if ((SECONDS >= end)); then tail -n 20 "$folder"/log/* >&2; die "$2 does not come up"; fi
    sleep 0.1
  done
}
start munged munged --foreground --force --num-threads=2 --key-file="$folder/munge/key" \
  --socket="$folder/run/munge.sock" --pid-file="$folder/run/munged.pid" \
  --log-file="$folder/log/munged.log" --seed-file="$folder/munge/seed"
await 20 munged bash -c "munge -n -S '$folder/run/munge.sock' | unmunge -S '$folder/run/munge.sock'"
start slurmctld slurmctld -D -i -f "$SLURM_CONF"
await 30 slurmctld bash -c "scontrol ping | grep -q 'is UP'"
for node in node1 node2; do
  start slurmd-$node unshare --uts --mount bash -c '
    hostname "$1" && mount --bind "$2/hosts" /etc/hosts && mount -t tmpfs tmpfs /dev/shm &&
    mount -t tmpfs tmpfs "$2/pmix" && exec slurmd -D -N "$1" -f "$2/slurm.conf"' bash $node "$folder"
done
await 40 "a node" bash -c '[[ $(sinfo -h -N -t idle -o %N | wc -l) == 2 ]]'
echo "$folder/environment"
