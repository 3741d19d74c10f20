"""What surrounds the engine, measured on this machine: starts, file operations, the driver's cost, a private Slurm."""

import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
Figures = list[list[object]]


def processor_time(*words: object) -> tuple[float, float]:
    """s of the program itself without its children, and its largest memory in MB."""
    process = subprocess.Popen(list(map(str, words)), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, words))} ended with {process.returncode}")
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK"), usage.ru_maxrss / 1024


def clock(*words: str) -> float:
    begin = time.monotonic()
    subprocess.run(words, env={**os.environ, "OMPI_MCA_ess_singleton_isolated": "1"}, stdin=subprocess.DEVNULL, capture_output=True, check=True)
    return time.monotonic() - begin


def measure_driver(program: str, cases: int, folder: pathlib.Path) -> tuple[float, float]:
    """s of `run` for each case, with the stub of the tests in place of the engine, and MB."""
    sys.path.insert(0, str(ROOT / "tests/clusters"))
    sys.path.insert(0, str(ROOT / "tests/end_to_end"))
    os.environ["VIBROTROUGH_PROGRAM"] = program
    from many_cases import DRIVER_OPTIONS, campaign_of
    from trough_program import campaign_text

    stub = pathlib.Path(program).resolve().parents[2] / "tests/clusters/stub_engine"
    campaign = folder / f"{cases}.toml"
    campaign.write_text(campaign_text(*campaign_of("spheres", cases)))
    seconds, megabytes = processor_time(program, "run", campaign, "--output", folder / str(cases), "--liggghts", stub, *DRIVER_OPTIONS)
    return seconds / cases, megabytes


def measure_slurm(tasks: int) -> float:
    """Tasks that do nothing, per second, on a node that pretends to have 16 cores."""
    sys.path.insert(0, str(ROOT / "tests/clusters"))
    from private_slurm import PrivateSlurm

    with PrivateSlurm(cpus=16, max_array=tasks + 1) as slurm:
        begin = time.monotonic()
        slurm.command("sbatch", f"--array=0-{tasks - 1}", "--mem=1M", "--output=/dev/null", "--wrap", "true")
        while slurm.command("squeue", "-h", "-r", "-t", "PD,R,CG").stdout.strip():
            time.sleep(0.2)
        return tasks / (time.monotonic() - begin)


def operations_of(program: str) -> dict[str, float]:
    """The file operations of a case that clusters.slow_files counts."""
    build = pathlib.Path(program).resolve().parents[2]
    done = subprocess.run(["ctest", "--test-dir", build, "-R", "clusters.slow_files", "-V"], capture_output=True, text=True, check=True)
    return {name: float(count) for name, count in re.findall(r"(\w+): [0-9.]+ ms and ([0-9.]+) operations a case", done.stdout)}


def measure(program: str) -> Figures:
    counts = operations_of(program)
    rows: Figures = [[f"operations_of_{name}", counts[name], "file operations of a case", "clusters.slow_files"] for name in ("prepare", "work", "run")]
    rows.append(["start_of_engine", round(statistics.median(clock("liggghts", "-log", "none", "-in", "/dev/null") for _ in range(5)), 3), "s", "liggghts with an empty deck"])
    rows.append(["start_of_task", round(statistics.median(clock(program, "--version") for _ in range(5)), 3), "s", "vibrotrough --version"])
    with tempfile.TemporaryDirectory(dir="/dev/shm" if os.path.isdir("/dev/shm") else None) as name:
        for cases in (1000, 10_000):
            seconds, megabytes = measure_driver(program, cases, pathlib.Path(name))
            rows.append(["driver" if cases == 1000 else "driver_of_10000", round(seconds, 5), "s of a case", f"run, {cases} cases of the stub, files in memory"])
            rows.append([f"memory_of_{cases}", round(megabytes, 1), "MB", "the same"])
    rows.append(["tasks_per_second", round(measure_slurm(200), 1), "1/s", "200 tasks of a private Slurm on this machine"])
    return rows
