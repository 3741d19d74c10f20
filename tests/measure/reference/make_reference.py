#!/usr/bin/env python3
"""Makes reference.csv: the velocity efficiency per cycle of 40 packings at each of six throw numbers.

    make_reference.py PROGRAM WORK_FOLDER [JOBS]

PROGRAM is vibrotrough. The packings start in turn below and above the expected speed, as in a campaign, but all of
them run for 150 cycles whatever comes out. It takes about an hour on one core, continues where it was stopped (a
packing that is complete is not run again) and writes reference.csv beside this script when all are there.
"""
import csv
import math
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
CYCLES = 150
# Efficiencies that a few packings showed beforehand; the starts are 0.25 below and 0.05 above them.
EXPECTED = {0.8: 0.16, 1.2: 0.25, 1.5: 0.50, 1.7: 0.67, 2.0: 0.81, 3.0: 0.93}


def start_of(throw_number: float, packing: int) -> float:
    expected = EXPECTED[throw_number]
    return max(0.0, expected - 0.25) if packing % 2 else expected + 0.05


def simulate(folder: Path, throw_number: float, packing: int, settled: Path) -> list[float]:
    deck = (folder / "in.liggghts").read_text()
    frequency = float(re.search(r"frequency ([0-9.e+-]+) Hz", deck).group(1))
    amplitude = 0.006 * math.cos(math.atan(0.5))
    cycles = folder / "cycles.csv"

    def positions() -> list[float]:
        if not cycles.exists():
            return []
        lines = cycles.read_text().splitlines()
        return [float(line.split(",")[2]) for line in lines if line[:1].isdigit()]

    if len(positions()) != CYCLES + 1:
        speed = start_of(throw_number, packing) * 2 * math.pi * frequency * amplitude
        marker = "# --- drive"
        started = deck.replace(marker, f"velocity all set {speed} NULL NULL\n{marker}", 1)
        # No checkpoints: a run that continues at one would set the speed again.
        started = re.sub(r"\nvariable +due .*?jump +SELF begin\n", "\njump SELF cycle\n", started, flags=re.S)
        (folder / "started.liggghts").write_text(started)
        (folder / "settled.restart").unlink(missing_ok=True)
        os.link(settled, folder / "settled.restart")
        subprocess.run(["liggghts", "-in", "started.liggghts"], cwd=folder, stdout=subprocess.DEVNULL, check=True)
        for heavy in folder.glob("phases.csv"):
            heavy.unlink()
    x = positions()
    assert len(x) == CYCLES + 1, folder
    return [(b - a) / (2 * math.pi * amplitude) for a, b in zip(x, x[1:])]


def main() -> None:
    program, work = sys.argv[1], Path(sys.argv[2])
    jobs = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    if not (work / "case-001").exists():
        subprocess.run([program, "deck", str(HERE / "campaign.toml"), "--output", str(work)], check=True,
                       stdout=subprocess.DEVNULL)

    def settle(packing: int) -> Path:
        folder = work / "case-001" / f"packing-{packing}"
        settled = work / f"settled-{packing}.restart"
        if not settled.exists():
            subprocess.run(["liggghts", "-in", "settle.liggghts"], cwd=folder, stdout=subprocess.DEVNULL, check=True)
            (folder / "settled.restart").rename(settled)
        return settled

    def run(item: tuple[int, float, int]) -> list[object]:
        case, throw_number, packing = item
        folder = work / f"case-{case:03d}" / f"packing-{packing}"
        values = simulate(folder, throw_number, packing, work / f"settled-{packing}.restart")
        print(f"{throw_number} packing {packing}: {sum(values[50:]) / 100:.3f}", flush=True)
        start = "below" if packing % 2 else "above"
        return [throw_number, packing, start, *(f"{value:.4f}" for value in values)]

    with ThreadPoolExecutor(jobs) as pool:
        list(pool.map(settle, range(1, 41)))
        items = [(case + 1, gamma, packing) for packing in range(1, 41) for case, gamma in enumerate(EXPECTED)]
        rows = sorted(pool.map(run, items), key=lambda row: (row[0], row[1]))
    with open(HERE / "reference.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["throw_number", "packing", "start", *range(1, CYCLES + 1)])
        writer.writerows(rows)


if __name__ == "__main__":
    main()
