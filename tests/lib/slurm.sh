# A Slurm of one node for a test, as root and without systemd: `slurm_start` sets SLURM_CONF, `slurm_stop` ends what it started. To be sourced.
# shellcheck shell=bash
slurm_start() {
    local node port=$((20000 + $$ % 10000 * 2)) program
    for program in munged slurmctld slurmd; do
        [ -x "/usr/sbin/$program" ] || skip "Slurm is not installed (munge, slurmctld, slurmd, slurm-client)"
    done
    [ "$(id -u)" = 0 ] || skip "a Slurm of one's own needs root"
    node=$(hostname -s)
    slurm=$(mktemp -d /tmp/rasp_slurm.XXXXXX) # the user munge gets into it, and a socket's name is short
    mkdir "$slurm"/{state,spool}
    chmod 755 "$slurm"
    install -d -o munge -g munge -m 0755 "$slurm/munge"
    (umask 077; head -c 1024 /dev/urandom > "$slurm/munge/key")
    chown munge:munge "$slurm/munge/key"
    runuser -u munge -- /usr/sbin/munged --key-file="$slurm/munge/key" --socket="$slurm/munge/sock" --pid-file="$slurm/munge/pid" --log-file="$slurm/munge/log" --seed-file="$slurm/munge/seed"
    cat > "$slurm/slurm.conf" << EOF
ClusterName=test
SlurmctldHost=$node(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$slurm/munge/sock
CredType=cred/munge
SlurmctldPort=$port
SlurmdPort=$((port + 1))
StateSaveLocation=$slurm/state
SlurmdSpoolDir=$slurm/spool
SlurmctldPidFile=$slurm/slurmctld.pid
SlurmdPidFile=$slurm/slurmd.pid
SlurmctldLogFile=$slurm/slurmctld.log
SlurmdLogFile=$slurm/slurmd.log
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
    export SLURM_CONF=$slurm/slurm.conf
    /usr/sbin/slurmctld && /usr/sbin/slurmd || return
    for _ in {1..100}; do
        [ "$(sinfo -h -o %t 2> /dev/null)" = idle ] && return
        sleep 0.1
    done
    skip "Slurm does not start here: $(tail -n 1 "$slurm/slurmctld.log")"
}
slurm_stop() {
    local file
    [ -n "${slurm:-}" ] || return 0
    for file in slurmd.pid slurmctld.pid munge/pid; do
        [ ! -s "$slurm/$file" ] || kill "$(cat "$slurm/$file")"
    done
    sleep 1
    rm -rf "$slurm"
}
