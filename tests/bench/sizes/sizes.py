#!/usr/bin/python3
"""What large layers cost: processor time, memory and disk of a run, beside what `check` forecasts, and of the export for ParaView.

    tests/bench/sizes/sizes.py build/release/src/app/vibrotrough --grains 10000 100000 300000 --ranks 1 2 --folder runs/sizes

One packing of 20 cycles, the least that a campaign can ask for, with one frame per cycle. A second call goes on where the first
was stopped, and prints what was measured before as it was.
"""

import argparse
import json
import math
import os
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


def measured(command, log):
    """Exit code, s on the clock, s of processor time and the largest memory of one process (bytes), engines included."""
    with log.open("w", encoding="utf-8") as output:
        begin = time.monotonic()
        process = subprocess.Popen(list(map(str, command)), stdout=output, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(process.pid, 0)
    return {"code": os.waitstatus_to_exitcode(status), "clock_s": time.monotonic() - begin, "cpu_s": usage.ru_utime + usage.ru_stime,
            "memory_bytes": usage.ru_maxrss * 1024}


def bytes_below(folder):
    """Blocks that its files occupy; a file with two names counts once."""
    files = {(one.stat().st_ino): one.stat().st_blocks * 512 for one in folder.rglob("*") if one.is_file() and not one.is_symlink()}
    return sum(files.values())


def measure(program, grains, ranks, folder):
    folder.mkdir(parents=True)
    campaign, output = folder / "campaign.toml", folder / "run"
    campaign.write_text(campaign_of(grains, ranks), encoding="utf-8")
    check = json.loads(subprocess.run([program, "check", campaign, "--json"], capture_output=True, text=True, check=False).stdout)
    answer = {"grains": grains, "ranks": ranks, "forecast_bytes": check["expected_bytes"], "forecast_memory_bytes": check["engine_memory_bytes"],
              "forecast_cpu_s": 3600 * check["expected_core_hours"]}
    answer["run"] = measured([program, "run", campaign, "--output", output, "--jobs", ranks], folder / "run.log")
    answer["bytes"] = bytes_below(output)
    if answer["run"]["code"] not in (0, 1):  # 1: measured, but not as precise as asked
        raise SystemExit((folder / "run.log").read_text(encoding="utf-8"))
    answer["export"] = measured([program, "export", output], folder / "export.log")
    answer["export_bytes"] = bytes_below(output) - answer["bytes"]
    return answer


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("--grains", type=int, nargs="+", default=[10_000])
    parser.add_argument("--ranks", type=int, nargs="+", default=[1])
    parser.add_argument("--folder", type=Path, required=True)
    options = parser.parse_args()
    print("grains ranks  CPU s (forecast)  clock s  memory MB (forecast)  disk MB (forecast)  export CPU s  memory MB  disk MB")
    for grains in options.grains:
        for ranks in options.ranks:
            folder = options.folder / f"{grains}-{ranks}"
            done = folder / "measured.json"
            if not done.exists():
                answer = measure(options.program.resolve(), grains, ranks, folder)
                done.write_text(json.dumps(answer, indent=2), encoding="utf-8")
            one = json.loads(done.read_text(encoding="utf-8"))
            run, export = one["run"], one["export"]
            print(f"{grains:6} {ranks:5} {run['cpu_s']:7.0f} ({one['forecast_cpu_s']:7.0f}) {run['clock_s']:8.0f}"
                  f" {run['memory_bytes'] / 1e6:10.0f} ({one['forecast_memory_bytes'] / 1e6:8.0f})"
                  f" {one['bytes'] / 1e6:10.0f} ({one['forecast_bytes'] / 1e6:6.0f})"
                  f" {export['cpu_s']:13.0f} {export['memory_bytes'] / 1e6:10.0f} {one['export_bytes'] / 1e6:8.0f}", flush=True)


if __name__ == "__main__":
    main()
