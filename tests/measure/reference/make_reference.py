#!/usr/bin/env python3
"""Makes reference.csv: the velocity efficiency per cycle of 40 packings at each of six throw numbers.

    make_reference.py PROGRAM WORK_FOLDER [JOBS]

PROGRAM is vibrotrough. The packings start in turn below and above the expected speed, as in a campaign, but all of
them run for 150 cycles whatever comes out. It takes about an hour on one core. It writes reference.csv beside this script after
each packing, and runs only those that are not in it yet, so that it continues where it was stopped.
"""
import csv
import math
import os
import re
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
TABLE = HERE / "reference.csv"
CYCLES = 150
PACKINGS = 40
# Efficiencies that a few packings showed beforehand; the starts are 0.25 below and 0.05 above them.
EXPECTED = {0.8: 0.16, 1.2: 0.25, 1.5: 0.50, 1.7: 0.67, 2.0: 0.81, 3.0: 0.93}


def rows_there() -> dict[tuple[float, int], list[str]]:
    """The rows of reference.csv by throw number and packing."""
    if not TABLE.exists():
        return {}
    with open(TABLE, newline="") as file:
        return {(float(row[0]), int(row[1])): row for row in list(csv.reader(file))[1:]}


def write_rows(rows: dict[tuple[float, int], list[str]]) -> None:
    part = TABLE.with_suffix(".part")
    with open(part, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["throw_number", "packing", "start", *range(1, CYCLES + 1)])
        writer.writerows(rows[key] for key in sorted(rows))
    part.replace(TABLE)


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
        # The program's own start and number of cycles, which would end the run after the first round, are left out.
        deck = re.sub(r'(?m)^if "\$\{done\} == 0" then "velocity all set .*\n', "", deck)
        (folder / "control.in").write_text("variable stop equal 0\n")
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

    rows = rows_there()
    lock = threading.Lock()

    def run(item: tuple[int, float, int]) -> None:
        case, throw_number, packing = item
        folder = work / f"case-{case:03d}" / f"packing-{packing}"
        values = simulate(folder, throw_number, packing, work / f"settled-{packing}.restart")
        start = "below" if packing % 2 else "above"
        with lock:
            rows[throw_number, packing] = [str(throw_number), str(packing), start, *(f"{value:.4f}" for value in values)]
            write_rows(rows)
        print(f"{throw_number} packing {packing}: {sum(values[50:]) / (CYCLES - 50):.3f}", flush=True)

    items = [(case + 1, gamma, packing) for packing in range(1, PACKINGS + 1) for case, gamma in enumerate(EXPECTED)]
    missing = [item for item in items if (item[1], item[2]) not in rows]
    with ThreadPoolExecutor(jobs) as pool:
        list(pool.map(settle, sorted({packing for _, _, packing in missing})))
        list(pool.map(run, missing))


if __name__ == "__main__":
    main()
