#!/usr/bin/python3
"""What large layers cost: processor time, memory and disk of a run, beside what `check` forecasts, and of the export for ParaView.

    tests/bench/sizes/sizes.py build/release/src/app/vibrotrough --grains 10000 100000 300000 --ranks 1 2 --folder runs/sizes

One packing of 20 cycles, the least that a campaign can ask for, with one frame per cycle. A second call prints what was measured
before as it was, and measures the rest. With --cycles N a run is stopped after N cycles: the processor time of settling and of one
cycle (the mean from the second on, because the first is cheaper) are printed, and with them that of 20 such cycles. Nothing is exported
then.
"""

import argparse
import json
import math
import os
import signal
import subprocess
import time
from pathlib import Path

DIAMETER = 3.0  # mm
DEPTH = 4  # diameters
CAMPAIGN = """[campaign]
name = "size"

[trough]
inclination = "0 deg"
tan_vibration_angle = 0.5
amplitude = "6 mm"
throw_number = 2.0
friction = 0.23
restitution = 0.5

[grains]
diameter = "{diameter} mm"
diameter_spread = 0.1
density = "1400 kg/m3"
youngs_modulus = "0.8 MPa"
poisson_ratio = 0.35
friction = 0.5
restitution = 0.5

[layer]
length = "{length:.0f} mm"
width = "{width:.0f} mm"
height = "{height} mm"

[measure]
packings = 1
max_packings = 1
max_cycles = 20

[output]
frames_per_cycle = 1
checkpoint_cycles = 0

[run]
ranks = {ranks}
"""


def campaign_of(grains, ranks):
    """A layer of about that many grains, 1.6 times as long as it is wide."""
    # 0.0357 grains per cubic millimetre of layer at 3 mm: 10,000 grains fill 186 x 117 x 12 mm.
    area = grains / 10_000 * 186 * 117
    width = math.sqrt(area / 1.59)
    return CAMPAIGN.format(diameter=DIAMETER, length=area / width, width=width, height=DEPTH * DIAMETER, ranks=ranks)


def measured(command, log, watch=None):
    """Exit code, s on the clock, s of processor time and the largest memory of one process (bytes), engines included. `watch` is
    called with the process every half a second."""
    with log.open("w", encoding="utf-8") as output:
        begin = time.monotonic()
        process = subprocess.Popen(list(map(str, command)), stdout=output, stderr=subprocess.STDOUT)
        status, usage = None, None
        while status is None:
            time.sleep(0.5 if watch else 0)
            ended, status, usage = os.wait4(process.pid, os.WNOHANG if watch else 0)
            if not ended:
                status = None
                watch(process)
    return {"code": os.waitstatus_to_exitcode(status), "clock_s": time.monotonic() - begin, "cpu_s": usage.ru_utime + usage.ru_stime,
            "memory_bytes": usage.ru_maxrss * 1024}


def time_of_family(process):
    """s of processor time of a process and its living and ended descendants."""
    try:
        fields = Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
        children = Path(f"/proc/{process}/task/{process}/children").read_text(encoding="utf-8").split()
    except (FileNotFoundError, ProcessLookupError):
        return 0.0
    return sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK") + sum(map(time_of_family, children))


class Cycles:
    """The processor time at the start of the first cycle and at the end of each; stops the run after so many."""

    def __init__(self, output, most):
        self.output, self.most, self.times, self.has_stopped = output, most, [], False

    def __call__(self, process):
        for path in self.output.glob("cases/*/packing-1/cycles.csv"):
            # Complete lines that begin with a number; the first of them is the start of the first cycle.
            found = sum(line[0].isdigit() and line.endswith("\n") for line in path.read_text(encoding="utf-8").splitlines(keepends=True))
            self.times += [time_of_family(process.pid)] * (found - len(self.times))
        if len(self.times) > self.most and not self.has_stopped:
            self.has_stopped = True
            os.kill(process.pid, signal.SIGTERM)  # ends after the cycle that the engine is in; a second one would not wait for it


def bytes_below(folder):
    """Blocks that its files occupy; a file with two names counts once."""
    files = {(one.stat().st_ino): one.stat().st_blocks * 512 for one in folder.rglob("*") if one.is_file() and not one.is_symlink()}
    return sum(files.values())


def measure(program, grains, ranks, folder, cycles):
    folder.mkdir(parents=True)
    campaign, output = folder / "campaign.toml", folder / "run"
    campaign.write_text(campaign_of(grains, ranks), encoding="utf-8")
    check = json.loads(subprocess.run([program, "check", campaign, "--json"], capture_output=True, text=True, check=False).stdout)
    answer = {"grains": grains, "ranks": ranks, "forecast_bytes": check["expected_bytes"], "forecast_memory_bytes": check["engine_memory_bytes"],
              "forecast_cpu_s": 3600 * check["expected_core_hours"]}
    command = [program, "run", campaign, "--output", output, "--jobs", ranks]
    if cycles:
        watch = Cycles(output, cycles)
        answer["run"] = measured(command, folder / "run.log", watch)
        if len(watch.times) <= cycles:
            raise SystemExit((folder / "run.log").read_text(encoding="utf-8"))
        answer["cycles_end_at_cpu_s"] = watch.times
        answer["settling_cpu_s"] = watch.times[0]
        answer["cycle_cpu_s"] = (watch.times[cycles] - watch.times[1]) / (cycles - 1)
        return answer
    answer["run"] = measured(command, folder / "run.log")
    answer["bytes"] = bytes_below(output)
    if answer["run"]["code"] not in (0, 1):  # 1: measured, but not as precise as asked
        raise SystemExit((folder / "run.log").read_text(encoding="utf-8"))
    answer["export"] = measured([program, "export", output], folder / "export.log")
    answer["export_bytes"] = bytes_below(output) - answer["bytes"]
    return answer


def print_part(grains, ranks, one):
    settling, cycle = one["settling_cpu_s"], one["cycle_cpu_s"]
    print(f"{grains:6} {ranks:5} {settling + 20 * cycle:7.0f} ({one['forecast_cpu_s']:7.0f}): settling {settling:.0f}, a cycle {cycle:.1f};"
          f" memory {one['run']['memory_bytes'] / 1e6:.0f} MB ({one['forecast_memory_bytes'] / 1e6:.0f});"
          f" processors busy {one['run']['cpu_s'] / one['run']['clock_s']:.2f}", flush=True)


def print_whole(grains, ranks, one):
    run, export = one["run"], one["export"]
    print(f"{grains:6} {ranks:5} {run['cpu_s']:7.0f} ({one['forecast_cpu_s']:7.0f}) {run['clock_s']:8.0f}"
          f" {run['memory_bytes'] / 1e6:10.0f} ({one['forecast_memory_bytes'] / 1e6:8.0f})"
          f" {one['bytes'] / 1e6:10.0f} ({one['forecast_bytes'] / 1e6:6.0f})"
          f" {export['cpu_s']:13.0f} {export['memory_bytes'] / 1e6:10.0f} {one['export_bytes'] / 1e6:8.0f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("--grains", type=int, nargs="+", default=[10_000])
    parser.add_argument("--ranks", type=int, nargs="+", default=[1])
    parser.add_argument("--folder", type=Path, required=True)
    parser.add_argument("--cycles", type=int, choices=range(2, 20), metavar="N", help="stop each run after so many of its 20 cycles, at least 2")
    options = parser.parse_args()
    if options.cycles:
        print("grains ranks  CPU s (forecast)")
    else:
        print("grains ranks  CPU s (forecast)  clock s  memory MB (forecast)  disk MB (forecast)  export CPU s  memory MB  disk MB")
    for grains in options.grains:
        for ranks in options.ranks:
            folder = options.folder / f"{grains}-{ranks}"
            done = folder / "measured.json"
            if not done.exists():
                answer = measure(options.program.resolve(), grains, ranks, folder, options.cycles)
                done.write_text(json.dumps(answer, indent=2), encoding="utf-8")
            one = json.loads(done.read_text(encoding="utf-8"))
            (print_part if "cycle_cpu_s" in one else print_whole)(grains, ranks, one)


if __name__ == "__main__":
    main()
