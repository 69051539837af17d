#!/bin/sh
# The document's lines for a Slurm job array, on a Slurm of one machine that lives as long as the test. With "stand-in"
# as a third argument the tasks run one after another, with the variables that Slurm would set.
. "$2/tests/recipes/common.sh"

stand_in() {
  mkdir bin
  cat > bin/sbatch << 'END'
#!/bin/sh
# sbatch --wait --array=FIRST-LAST --wrap=COMMAND
for argument in "$@"; do
  case $argument in
    --array=*) range=${argument#--array=} ;;
    --wrap=*) command=${argument#--wrap=} ;;
  esac
done
export SLURM_ARRAY_TASK_COUNT=$((${range#*-} - ${range%-*} + 1))
worst=0
for SLURM_ARRAY_TASK_ID in $(seq "${range%-*}" "${range#*-}"); do
  export SLURM_ARRAY_TASK_ID
  sh -c "$command" || worst=$?
done
exit $worst
END
  chmod +x bin/sbatch
  export PATH="$work/bin:$PATH"
}

real() {
  for program in slurmctld slurmd sbatch; do
    command -v $program > /dev/null || skip "$program is not installed (apt-get install slurm-wlm)"
  done
  [ "$(id -u)" = 0 ] || skip "slurmd starts jobs for others, and so wants to be root"
  mkdir state spool
  cat > slurm.conf << END
ClusterName=one
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmctldPort=26817
SlurmdPort=26818
SlurmUser=root
AuthType=auth/none
CredType=cred/none
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
NodeName=$(hostname) NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
  export SLURM_CONF="$work/slurm.conf"
  slurmctld -D > /dev/null 2>&1 &
  daemons=$!
  slurmd -D > /dev/null 2>&1 &
  daemons="$daemons $!"
  trap 'kill $daemons 2> /dev/null; wait; rm -rf "$work"' EXIT
  for _ in $(seq 60); do
    sinfo -h -o %T 2> /dev/null | grep -q idle && return
    sleep 0.5
  done
  cat slurmctld.log slurmd.log >&2
  skip "no Slurm starts here"
}

if [ "${3:-}" = stand-in ]; then stand_in; else real; fi
repository
recipe 1 "sbatch --wait --array=1-4 --wrap='contactscope check --shard \$SLURM_ARRAY_TASK_ID/\$SLURM_ARRAY_TASK_COUNT --out shards'"
one_part_fails
recipe 0 "sbatch --wait --array=1-4 --wrap='contactscope render hull --shard \$SLURM_ARRAY_TASK_ID/\$SLURM_ARRAY_TASK_COUNT'"
all_rendered
