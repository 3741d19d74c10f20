"""A PBS of one node for tests, because PBS cannot be installed here: qsub, qstat, qselect and qdel that take the options, give the answers and fail as the
manual pages of OpenPBS say (qsub(1B), qstat(1B), qselect(1B), qdel(1B)), and a server that runs the jobs.

What the pages do not say follows what users report: an array of one task is refused, an array must be rerunnable, and the messages of errors.

A job starts in the home directory, with the script as it was when it was submitted; what it prints is copied to its place when it has ended.
"""

import fcntl
import getopt
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from contextlib import contextmanager
from pathlib import Path

# What a campaign file says to run on it.
RUN_ON_PBS = """
[run]
executor = "pbs"
[run.pbs]
queue = "workq"
time = "10 minutes"
memory = "200 MB"
"""

SERVER = "pbs"
QUEUE_LIMIT = {"workq": 3600 * 24, "short": 300}
KILLED_FOR_WALLTIME = -29


class State:
    """What the server knows, in a file that the commands and the server read and write under a lock."""

    def __init__(self, folder):
        self.folder = Path(folder)

    @contextmanager
    def open(self):
        with open(self.folder / "lock", "a") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            file = self.folder / "state.json"
            state = json.loads(file.read_text())
            yield state
            (self.folder / "state.new").write_text(json.dumps(state))
            (self.folder / "state.new").rename(file)


def fail(command, message, code):
    sys.stderr.write(f"{command}: {message}\n")
    sys.exit(code)


def task_id(job, index):
    return f"{job['number']}[{index}].{SERVER}" if job["array"] else f"{job['number']}.{SERVER}"


def job_id(job):
    return f"{job['number']}{'[]' if job['array'] else ''}.{SERVER}"


def has_ended(job):
    return all(task["state"] == "X" for task in job["tasks"])


def resources_of(words):
    """{name: value} of -l; the chunk of select as its text."""
    asked = {}
    for word in words:
        name, equals, value = word.partition("=")
        if not equals or name in asked:
            fail("qsub", "illegal -l value", 2)
        asked[name] = value
    return asked


def seconds(text):
    hours, minutes, rest = (int(part) for part in text.split(":"))
    return 3600 * hours + 60 * minutes + rest


def qsub(state, words):
    try:
        options, operands = getopt.getopt(words, "a:A:c:C:e:fhIj:J:k:l:m:M:N:o:p:P:q:r:R:S:u:v:VW:Xz")
    except getopt.GetoptError as error:
        fail("qsub", f"{error}\nusage: qsub [-a date_time] ...", 2)
    given = {name: value for name, value in options if name != "-l"}
    asked = resources_of([value for name, value in options if name == "-l"])
    if len(operands) != 1 or not Path(operands[0]).is_file():
        fail("qsub", "script file:: No such file or directory", 1)
    if not re.fullmatch(r"[A-Za-z0-9][\x21-\x7e]{0,235}", given.get("-N", "STDIN")):
        fail("qsub", "illegal -N value", 2)
    indices = [0]
    if "-J" in given:
        match = re.fullmatch(r"(\d+)-(\d+)", given["-J"])
        if not match or int(match[1]) >= int(match[2]):
            fail("qsub", "illegal -J value", 2)
        indices = list(range(int(match[1]), int(match[2]) + 1))
        if given.get("-r") == "n":
            fail("qsub", "cannot submit non-rerunable Array Job", 1)
    if not re.fullmatch(r"1:ncpus=\d+:mpiprocs=\d+(:mem=\d+mb)?", asked.get("select", "")):
        fail("qsub", "Illegal attribute or resource value for select", 1)
    queue = given.get("-q", "workq")
    if queue not in QUEUE_LIMIT:
        fail("qsub", "Unknown queue", 170)
    walltime = seconds(asked.get("walltime", "0:01:00"))
    if walltime > QUEUE_LIMIT[queue]:
        fail("qsub", "Job violates queue and/or server resource limits", 188)
    if len(indices) > state["max_array_size"]:
        fail("qsub", "Array job exceeds server or queue size limit", 1)
    if sum(len(job["tasks"]) for job in state["jobs"] if not has_ended(job)) + len(indices) > state["max_queued"]:
        fail("qsub", "would exceed complex's per-user limit of jobs in 'Q' state", 1)
    number = state["next"]
    state["next"] += 1
    cap = re.fullmatch(r"max_run_subjobs=(\d+)", given.get("-W", "max_run_subjobs=1000000"))
    if not cap:
        fail("qsub", "illegal -W value", 2)
    job = {"number": number, "array": "-J" in given, "name": given.get("-N", "STDIN"), "script": Path(operands[0]).read_text(), "folder": os.getcwd(),
           "output": given.get("-o", f"{given.get('-N', 'STDIN')}.o{number}"), "walltime": walltime, "cap": int(cap[1]), "words": words, "ncpus": int(asked["select"].split(":")[1][6:]),
           "home": os.environ.get("HOME", "/"),
           "tasks": [{"index": index, "state": "Q"} for index in indices]}  # fmt: skip
    state["jobs"].append(job)
    print(job_id(job))


def print_entry(name, attributes):
    """Lines of at most 80 characters; the next one begins with a tab."""
    print(f"Job Id: {name}")
    for key, value in attributes.items():
        line = f"    {key} = {value}"
        print("\n\t".join([line[:79], *(line[at : at + 70] for at in range(79, len(line), 70))]))
    print()


def qstat(state, words):
    options, operands = getopt.getopt(words, "EJptwxf")
    flags = {name for name, _ in options}
    if "-x" in flags and not state["history"]:
        fail("qstat", "PBS is not configured to maintain job history", 1)
    code = 0
    for operand in operands:
        number = int(re.match(r"\d+", operand)[0])
        found = [job for job in state["jobs"] if job["number"] == number and job["array"] == ("[]" in operand)]
        if not found or (has_ended(found[0]) and not state["history"]):
            sys.stderr.write(f"qstat: Unknown Job Id {operand}.{SERVER}\n")
            code = 153
            continue
        job = found[0]
        is_past = has_ended(job)
        if is_past and "-x" not in flags:
            sys.stderr.write(f"qstat: {job_id(job)} Job has finished, use -x or -H to obtain historical job information\n")
            code = 35
            continue
        common = {"Job_Name": job["name"], "Job_Owner": "tester@here", "Error_Path": f"here:{job['folder']}/err"}
        if job["array"]:
            begun = any(task["state"] != "Q" for task in job["tasks"])
            print_entry(job_id(job), common | {"job_state": "F" if is_past else "B" if begun else "Q"})
        for task in job["tasks"] if not job["array"] or "-t" in flags else []:
            shown = dict(common, job_state="F" if task["state"] == "X" and (is_past or not job["array"]) else task["state"])
            if "status" in task:
                shown["Exit_status"] = task["status"]
            if task["state"] == "Q":
                shown["comment"] = "Not Running: Insufficient amount of resource: ncpus"
            print_entry(task_id(job, task["index"]), shown)
    sys.exit(code)


def qselect(state, words):
    options, _ = getopt.getopt(words, "N:")
    for job in state["jobs"]:
        if not has_ended(job) and ("-N", job["name"]) in options:
            print(job_id(job))


def qdel(state, words):
    for word in words:
        match = re.fullmatch(r"(\d+)(?:\[(\d+)\])?", word)
        tasks = [task for job in state["jobs"] for task in job["tasks"]
                 if match and job["number"] == int(match[1]) and (not job["array"] or match[2] is None or task["index"] == int(match[2]))]  # fmt: skip
        if not tasks:
            fail("qdel", f"Unknown Job Id {word}", 1)
        for task in tasks:
            state["deleted"].append(word)
            if task["state"] == "Q":
                task["state"] = "X"
            elif task["state"] == "R":
                os.killpg(task["process"], signal.SIGTERM)


class PrivatePbs:
    """Use as a context; `path` leads to its commands."""

    def __init__(self, cpus=2, max_array_size=10000, max_queued=100000, history=True, minute=60):
        self.folder = Path(tempfile.mkdtemp(prefix="pbs", dir="/tmp"))
        self.cpus = cpus
        self.minute = minute  # what a minute of walltime lasts here, s
        self.running = {}  # (job number, index): (process, deadline)
        self.over = threading.Event()
        start = {"jobs": [], "next": 1, "max_array_size": max_array_size, "max_queued": max_queued, "history": history, "deleted": [], "answers": True}
        (self.folder / "state.json").write_text(json.dumps(start))
        self.state = State(self.folder)
        (self.folder / "bin").mkdir()
        for name in ("qsub", "qstat", "qselect", "qdel"):
            command = self.folder / "bin" / name
            command.write_text(f'#!/bin/sh\nexec {shlex.quote(sys.executable)} {shlex.quote(__file__)} {name} {self.folder} "$@"\n')
            command.chmod(0o755)
        self.path = f"{self.folder}/bin:{os.environ['PATH']}"
        self.server = threading.Thread(target=self.serve)

    def __enter__(self):
        self.server.start()
        return self

    def __exit__(self, *_):
        self.over.set()
        self.server.join()
        for process, _ in self.running.values():
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def change(self, **settings):
        """For example answers=False: the server is away, and its jobs go on."""
        with self.state.open() as state:
            state.update(settings)

    def known(self):
        with self.state.open() as state:
            return state

    def forget(self):
        """As after job_history_duration."""
        with self.state.open() as state:
            state["jobs"] = [job for job in state["jobs"] if not has_ended(job)]

    def serve(self):
        while not self.over.wait(0.05):
            with self.state.open() as state:
                for job in state["jobs"]:
                    for task in job["tasks"]:
                        self.look_after(job, task)
                for job in state["jobs"]:
                    for task in job["tasks"]:
                        self.start_if_possible(job, task)

    def look_after(self, job, task):
        process, deadline = self.running.get((job["number"], task["index"]), (None, 0))
        if process is None:
            return
        if process.poll() is None:
            if time.monotonic() > deadline:
                task["status"] = KILLED_FOR_WALLTIME
                os.killpg(process.pid, signal.SIGKILL)
            return
        code = process.returncode
        task.setdefault("status", 256 - code if code < 0 else code)  # 256 + signal
        task["state"] = "X"
        del self.running[(job["number"], task["index"])]
        spool = self.folder / f"{job['number']}.{task['index']}.OU"
        place = Path(job["folder"]) / job["output"].replace("^array_index^", str(task["index"]))
        try:
            shutil.copyfile(spool, place)
        except OSError:
            pass  # the folder has been removed

    def start_if_possible(self, job, task):
        mine = sum(number == job["number"] for number, _ in self.running)
        if task["state"] != "Q" or len(self.running) >= self.cpus or mine >= job["cap"]:
            return
        script = self.folder / f"{job['number']}.SC"
        script.write_text(job["script"])
        script.chmod(0o700)
        scratch = self.folder / f"tmp.{job['number']}.{task['index']}"
        scratch.mkdir(exist_ok=True)
        # Of the environment of qsub a job sees nothing but what -v names and a few PBS_O_ variables; the tests' engine needs its own.
        tests = {name: value for name, value in os.environ.items() if name.startswith("VIBROTROUGH_TEST_")}
        environment = dict(tests, HOME=job["home"], PATH="/usr/bin:/bin", PBS_O_WORKDIR=job["folder"], PBS_JOBID=task_id(job, task["index"]), TMPDIR=str(scratch),
                           PBS_ENVIRONMENT="PBS_BATCH", NCPUS=str(job["ncpus"]))  # fmt: skip
        if job["array"]:
            environment["PBS_ARRAY_INDEX"] = str(task["index"])
        with open(self.folder / f"{job['number']}.{task['index']}.OU", "wb") as spool:
            process = subprocess.Popen([script], cwd=job["home"], env=environment, stdin=subprocess.DEVNULL, stdout=spool,
                                       stderr=subprocess.STDOUT, start_new_session=True)  # fmt: skip
        task["state"] = "R"
        task["process"] = process.pid
        self.running[(job["number"], task["index"])] = (process, time.monotonic() + job["walltime"] * self.minute / 60)


def main():
    name, folder, *words = sys.argv[1:]
    with State(folder).open() as state:
        if not state["answers"]:
            sys.stderr.write("Connection refused\n")
            fail(name, f"cannot connect to server {SERVER} (errno=15010)", 1)
        {"qsub": qsub, "qstat": qstat, "qselect": qselect, "qdel": qdel}[name](state, words)


if __name__ == "__main__":
    main()
