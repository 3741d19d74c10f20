"""A private Slurm of one node, from Debian's packages, without systemd: munged, slurmctld and slurmd in a short
temporary folder (the munge socket's path may have 108 characters), on loopback. With accounting when asked: mariadbd and
slurmdbd in the same folder.
"""

import getpass
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from pathlib import Path

os.environ["PATH"] += ":/usr/sbin:/sbin"

# What a campaign file says to run on it.
RUN_ON_SLURM = """
[run]
executor = "slurm"
[run.slurm]
partition = "main"
time = "10 minutes"
memory = "200 MB"
"""

CONFIGURATION = """\
ClusterName=vibrotrough
SlurmctldHost={host}(127.0.0.1)
{listen}
SlurmUser={user}
SlurmdUser={user}
SlurmctldPort={controller_port}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.sock,cred_expire={requeue_delay}
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
PlugStackConfig={folder}/plugstack.conf
MailProg=/bin/true
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SchedulerParameters=batch_sched_delay=0,bf_interval=1,sched_interval=1
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=5
MinJobAge={job_age}
MaxArraySize={max_array}
MaxJobCount={max_jobs}
{accounting}
JobAcctGatherType=jobacct_gather/none
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={node_port} CPUs={cpus} RealMemory={memory} State=UNKNOWN
PartitionName=main Nodes=n1 Default=YES MaxTime=INFINITE DefaultTime=60 State=UP
PartitionName=short Nodes=n1 MaxTime=5 State=UP
"""

NO_ACCOUNTING = "AccountingStorageType=accounting_storage/none"
ACCOUNTING = """\
AccountingStorageType=accounting_storage/slurmdbd
AccountingStorageHost=127.0.0.1
AccountingStoragePort={port}
AccountingStoragePass={folder}/munge.sock"""
DATABASE_DAEMON = """\
AuthType=auth/munge
AuthInfo=socket={folder}/munge.sock
DbdHost=localhost
DbdAddr=127.0.0.1
DbdPort={port}
SlurmUser={user}
PidFile={folder}/slurmdbd.pid
LogFile={folder}/slurmdbd.log
StorageType=accounting_storage/mysql
StorageHost=127.0.0.1
StoragePort={database_port}
StorageUser=root
StorageLoc=accounting
"""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def answers(port):
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


def resolves_to_loopback(host):
    try:
        return socket.gethostbyname(host) == "127.0.0.1"
    except OSError:
        return False


def memory_of_machine():
    for line in Path("/proc/meminfo").read_text().splitlines():
        if line.startswith("MemTotal"):
            return int(line.split()[1]) * 9 // 10 // 1024
    raise AssertionError("no MemTotal in /proc/meminfo")


def wait_for(question, what, patience=300):
    deadline = time.monotonic() + patience
    while not question():
        if time.monotonic() > deadline:
            raise AssertionError(f"waited {patience} s in vain until {what}")
        time.sleep(0.05)


class PrivateSlurm:
    """Use as a context; `environment` leads Slurm's commands to it."""

    @classmethod
    def for_test(cls, test, **settings):
        """One that runs, is the Slurm of all commands from now on, and ends with the test."""
        slurm = cls(**settings)
        slurm.__enter__()
        test.addCleanup(slurm.__exit__)
        os.environ["SLURM_CONF"] = slurm.environment["SLURM_CONF"]
        test.addCleanup(os.environ.pop, "SLURM_CONF", None)
        return slurm

    def __init__(self, cpus=4, max_array=1001, accounting=False, max_jobs=10000, job_age=3600, requeue_delay=120):
        self.accounting = accounting
        for program in ("munged", "slurmctld", "slurmd", "sbatch", "squeue", *(("slurmdbd", "mariadbd") if accounting else ())):
            if shutil.which(program) is None:
                raise AssertionError(f"{program} is not installed: ./setup packages lists what the tests need")
        self.folder = Path(tempfile.mkdtemp(prefix="vt", dir="/tmp"))
        self.processes = {}
        os.chmod(self.folder, 0o755)
        self.environment = dict(os.environ, SLURM_CONF=str(self.folder / "slurm.conf"))
        host = socket.gethostname()
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        listen = "CommunicationParameters=NoCtldInAddrAny,NoInAddrAny" if resolves_to_loopback(host) else ""
        self.database_port, port = free_port(), free_port()
        told = (ACCOUNTING if accounting else NO_ACCOUNTING).format(folder=self.folder, port=port)
        (self.folder / "slurmdbd.conf").write_text(
            DATABASE_DAEMON.format(folder=self.folder, port=port, user=getpass.getuser(), database_port=self.database_port)
        )
        (self.folder / "slurmdbd.conf").chmod(0o600)
        (self.folder / "slurm.conf").write_text(
            CONFIGURATION.format(host=host, user=getpass.getuser(), folder=self.folder, listen=listen, controller_port=free_port(), node_port=free_port(),
                                 cpus=cpus, memory=memory_of_machine(), max_array=max_array, max_jobs=max_jobs, job_age=job_age, requeue_delay=requeue_delay, accounting=told)  # fmt: skip
        )
        (self.folder / "cgroup.conf").write_text("CgroupPlugin=cgroup/v1\n")
        (self.folder / "plugstack.conf").write_text("")
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)

    def __enter__(self):
        try:
            self.start_munge()
            if self.accounting:
                self.start_accounting()
            self.start_controller()
            self.start_node()
            return self
        except AssertionError as failed:
            logs = self.last_words()
            self.__exit__()
            raise AssertionError(f"{failed}\n{logs}") from None
        except BaseException:
            self.__exit__()
            raise

    def last_words(self):
        """The end of what each daemon said."""
        logs = sorted([*self.folder.glob("*.log"), *self.folder.glob("*.out")])
        return "\n".join(f"{log.name}: {log.read_text(errors='replace')[-1000:]}" for log in logs)

    def __exit__(self, *_):
        if "slurmctld" in self.processes:
            subprocess.run(["scancel", "-u", getpass.getuser()], env=self.environment, capture_output=True, timeout=300)
            ended = time.monotonic() + 60
            while self.command("squeue", "-h").stdout.strip() and time.monotonic() < ended:
                time.sleep(0.2)
        for process in reversed(list(self.processes.values())):
            process.terminate()
            try:
                process.wait(timeout=60)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        self.kill_leftovers()
        shutil.rmtree(self.folder, ignore_errors=True)

    def kill_leftovers(self):
        """slurmstepd and what it started outlive a killed slurmd; they know this cluster's configuration."""
        mark = f"SLURM_CONF={self.folder}/slurm.conf".encode()
        for process in Path("/proc").iterdir():
            if not process.name.isdigit() or int(process.name) == os.getpid():
                continue
            try:
                if mark in (process / "environ").read_bytes():
                    os.kill(int(process.name), signal.SIGKILL)
            except OSError:
                pass

    def start(self, name, *words):
        log = open(self.folder / f"{name}.out", "ab")
        self.processes[name] = subprocess.Popen(
            [name, *map(str, words)], stdin=subprocess.DEVNULL, stdout=log, stderr=log, env=self.environment
        )
        log.close()

    def start_munge(self):
        folder = self.folder
        self.start("munged", "--foreground", f"--key-file={folder}/munge.key", f"--socket={folder}/munge.sock",
                   f"--pid-file={folder}/munged.pid", f"--log-file={folder}/munged.log", f"--seed-file={folder}/munge.seed")  # fmt: skip
        wait_for(lambda: self.command("munge", "-n", "-S", folder / "munge.sock").returncode == 0, "munge answered")

    def start_accounting(self):
        """A database that lets anybody in, on loopback and for as long as the test runs."""
        data = self.folder / "database"
        user = getpass.getuser()
        data.mkdir()
        own = ["mariadbd", "--no-defaults", f"--datadir={data}", f"--user={user}", "--innodb-buffer-pool-size=16M",
               "--innodb-flush-log-at-trx-commit=0"]  # fmt: skip
        # What mariadb-install-db does, which wants another package. The first name is MariaDB 11's (Debian 13).
        scripts = [Path("/usr/share/mariadb/mariadb_system_tables.sql"), Path("/usr/share/mysql/mysql_system_tables.sql")]
        # slurmdbd would make its database, but ends when it connects again after that (Debian 13, Connector/C 3.4.10: "Number of columns
        # in result (=1) set exceeds maximum allowed number of columns (=0)").
        tables = "CREATE DATABASE accounting;\nCREATE DATABASE mysql;\nUSE mysql;\n"
        tables += next(script for script in scripts if script.is_file()).read_text()
        made = subprocess.run([*own, "--bootstrap"], input=tables, capture_output=True, text=True, timeout=300)
        if made.returncode != 0:
            raise AssertionError((made.stdout + made.stderr)[-2000:])
        self.start(*own, "--bind-address=127.0.0.1", f"--port={self.database_port}", f"--socket={self.folder}/database.sock",
                   f"--pid-file={self.folder}/database.pid", "--skip-grant-tables", "--skip-networking=0")  # fmt: skip
        wait_for(lambda: answers(self.database_port), "mariadbd answered")
        self.environment["SLURMDBD_CONF"] = str(self.folder / "slurmdbd.conf")
        self.start("slurmdbd", "-D")
        wait_for(lambda: self.command("sacctmgr", "-n", "show", "cluster").returncode == 0, "slurmdbd answered")
        self.command("sacctmgr", "-i", "add", "cluster", "vibrotrough")

    def start_controller(self, forgetful=False):
        """`forgetful`: it knows no job of before, as after a job's MinJobAge."""
        self.start("slurmctld", "-D", *(["-c"] if forgetful else []), "-f", self.folder / "slurm.conf")
        wait_for(lambda: "is UP" in self.command("scontrol", "ping").stdout, "slurmctld answered")

    def start_node(self):
        self.start("slurmd", "-D", "-N", "n1", "-f", self.folder / "slurm.conf")
        wait_for(lambda: self.command("sinfo", "-h", "-N", "-o", "%T").stdout.startswith("idle"), "the node was idle")

    def stop(self, name):
        process = self.processes.pop(name)
        process.terminate()
        process.wait(timeout=60)

    def command(self, *words):
        return subprocess.run([str(word) for word in words], env=self.environment, capture_output=True, text=True, timeout=300)
