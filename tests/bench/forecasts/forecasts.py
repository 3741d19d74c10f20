#!/usr/bin/python3
"""What `plan` forecasts of each campaign that `init` writes, and the processor time that the campaign then takes.

    tests/bench/forecasts/forecasts.py build/release/src/app/vibrotrough --folder runs/forecasts

Prints CSV. The first forecast supposes 5 million grain-steps per second, the others what the last campaign of plain layers had: the
folder has a cache of its own. All ten take three quarters of an hour on one core. A second call goes on with what is left; forecasts are
kept as they were before the first packing.
"""

import argparse
import json
import os
import subprocess
from pathlib import Path

import h5py

KINDS = ["pellets", "paper", "rotation", "chute", "open", "mixture", "screen", "fed-screen", "stages", "design"]


def called(*command):
    return subprocess.run(list(map(str, command)), check=True, capture_output=True, text=True).stdout


def forecast(program, campaign, runs):
    """What `plan` says before the first packing: core-seconds, and the grain-steps per second that it supposes."""
    kept = campaign.with_suffix(".json")
    if not kept.exists():
        called(program, "init", campaign.stem, "--output", campaign)
        kept.write_text(called(program, "plan", campaign, "--output", runs, "--json"))
    said = json.loads(kept.read_text())
    return said["core_time_s"], said["speed_grain_steps_per_s"]


def spent(program, campaign, runs):
    """core-seconds, settling included"""
    # Codes above 1 are errors; 1 says that a case is not precise, and its cost counts as well.
    done = subprocess.run([program, "run", campaign, "--output", runs, "--jobs", "1", "--quiet", "--accept-findings"])
    if done.returncode > 1:
        raise SystemExit(f"{campaign} ended with {done.returncode}")
    seconds = 0.0
    for result in runs.glob("cases/*/result.h5"):
        with h5py.File(result) as file:
            seconds += float(file["packings"]["core_time"][()].sum())
    return seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--folder", type=Path, required=True)
    parser.add_argument("--kinds", nargs="+", default=KINDS, choices=KINDS, help="default: all")
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    os.environ["XDG_CACHE_HOME"] = str(given.folder.resolve() / "cache")
    print("campaign,grain_steps_per_second,forecast_core_seconds,spent_core_seconds,ratio")
    for kind in given.kinds:
        campaign, runs = given.folder / f"{kind}.toml", given.folder / kind
        before, speed = forecast(given.program, campaign, runs)
        after = spent(given.program, campaign, runs)
        print(f"{kind},{speed:.3g},{before:.0f},{after:.0f},{after / before:.2f}", flush=True)


if __name__ == "__main__":
    main()
