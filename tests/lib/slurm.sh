# A Slurm of one node for a test, as root and without systemd: `start FOLDER` sets SLURM_CONF, `stop FOLDER` ends what it started. To be sourced.
# shellcheck shell=bash
slurm_start() {
    local node port=$((20000 + $$ % 10000 * 2)) program
    for program in munged slurmctld slurmd; do
        [ -x "/usr/sbin/$program" ] || skip "Slurm is not installed (munge, slurmctld, slurmd, slurm-client)"
    done
    [ "$(id -u)" = 0 ] || skip "a Slurm of one's own needs root"
    node=$(hostname -s)
    mkdir -p "$1"/{state,spool}
    chmod 755 "$1"
    install -d -o munge -g munge -m 0755 "$1/munge"
    (umask 077; head -c 1024 /dev/urandom > "$1/munge/key")
    chown munge:munge "$1/munge/key"
    runuser -u munge -- /usr/sbin/munged --key-file="$1/munge/key" --socket="$1/munge/sock" --pid-file="$1/munge/pid" --log-file="$1/munge/log" --seed-file="$1/munge/seed"
    cat > "$1/slurm.conf" << EOF
ClusterName=test
SlurmctldHost=$node(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$1/munge/sock
CredType=cred/munge
SlurmctldPort=$port
SlurmdPort=$((port + 1))
StateSaveLocation=$1/state
SlurmdSpoolDir=$1/spool
SlurmctldPidFile=$1/slurmctld.pid
SlurmdPidFile=$1/slurmd.pid
SlurmctldLogFile=$1/slurmctld.log
SlurmdLogFile=$1/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
SchedulerParameters=batch_sched_delay=0,sched_interval=1
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
EOF
    export SLURM_CONF=$1/slurm.conf
    /usr/sbin/slurmctld && /usr/sbin/slurmd || return
    for _ in {1..100}; do
        [ "$(sinfo -h -o %t 2> /dev/null)" = idle ] && return
        sleep 0.1
    done
    skip "Slurm does not start here: $(tail -n 1 "$1/slurmctld.log")"
}
slurm_stop() {
    local file
    for file in slurmd.pid slurmctld.pid munge/pid; do
        [ ! -s "$1/$file" ] || kill "$(cat "$1/$file")"
    done
}
