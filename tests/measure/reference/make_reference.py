#!/usr/bin/env python3
"""Makes reference.csv: the velocity efficiency per cycle of 40 packings at each of six throw numbers.

    make_reference.py PROGRAM WORK_FOLDER [JOBS]

PROGRAM is vibrotrough. The packings start in turn below and above the expected speed, as in a campaign, but all of
them run for 150 cycles whatever comes out. A second table, from_rest.csv, has packings that start at rest and run for 48 cycles, to
show what the starts save. Both take about an hour on one core. A table is written beside this script after
each packing, and only those packings are run that are not in it yet, so that the script continues where it was stopped.
"""
import csv
import math
import os
import re
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent


@dataclass
class Table:
    """A table to be made: its file, the cycles of a packing, and the packings at each throw number."""

    path: Path
    cycles: int
    packings: int
    from_rest: bool

    def start(self, packing: int) -> str:
        return "rest" if self.from_rest else "below" if packing % 2 else "above"


TABLES = [Table(HERE / "reference.csv", 150, 40, False), Table(HERE / "from_rest.csv", 48, 8, True)]
# Efficiencies that a few packings showed beforehand; the starts are 0.25 below and 0.05 above them.
EXPECTED = {0.8: 0.16, 1.2: 0.25, 1.5: 0.50, 1.7: 0.67, 2.0: 0.81, 3.0: 0.93}


def rows_there(table: Table) -> dict[tuple[float, int], list[str]]:
    """The rows of the table's file by throw number and packing."""
    if not table.path.exists():
        return {}
    with open(table.path, newline="") as file:
        return {(float(row[0]), int(row[1])): row for row in list(csv.reader(file))[1:]}


def write_rows(table: Table, rows: dict[tuple[float, int], list[str]]) -> None:
    part = table.path.with_suffix(".part")
    with open(part, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["throw_number", "packing", "start", *range(1, table.cycles + 1)])
        writer.writerows(rows[key] for key in sorted(rows))
    part.replace(table.path)


def start_of(table: Table, throw_number: float, packing: int) -> float:
    expected = EXPECTED[throw_number]
    return {"rest": 0.0, "below": max(0.0, expected - 0.25), "above": expected + 0.05}[table.start(packing)]


def simulate(table: Table, folder: Path, throw_number: float, packing: int, settled: Path) -> list[float]:
    deck = (folder / "in.liggghts").read_text()
    frequency = float(re.search(r"frequency ([0-9.e+-]+) Hz", deck).group(1))
    amplitude = 0.006 * math.cos(math.atan(0.5))
    cycles = folder / "cycles.csv"

    def positions() -> list[float]:
        if not cycles.exists():
            return []
        lines = cycles.read_text().splitlines()
        return [float(line.split(",")[2]) for line in lines if line[:1].isdigit()]

    if len(positions()) != table.cycles + 1:
        speed = start_of(table, throw_number, packing) * 2 * math.pi * frequency * amplitude
        marker = "# --- drive"
        # The program's own start and number of cycles, which would end the run after the first round, are left out.
        deck = re.sub(r'(?m)^if "\$\{done\} == 0" then "velocity all set .*\n', "", deck)
        (folder / "control.in").write_text(f"variable stop equal ${{done}}>={table.cycles}\n")
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
    assert len(x) == table.cycles + 1, folder
    return [(b - a) / (2 * math.pi * amplitude) for a, b in zip(x, x[1:])]


def make(table: Table, program: str, work: Path, jobs: int) -> None:
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

    rows = rows_there(table)
    lock = threading.Lock()

    def run(item: tuple[int, float, int]) -> None:
        case, throw_number, packing = item
        folder = work / f"case-{case:03d}" / f"packing-{packing}"
        values = simulate(table, folder, throw_number, packing, work / f"settled-{packing}.restart")
        with lock:
            rows[throw_number, packing] = [str(throw_number), str(packing), table.start(packing), *(f"{value:.4f}" for value in values)]
            write_rows(table, rows)
        later = values[len(values) // 3:]
        print(f"{throw_number} packing {packing} from {table.start(packing)}: {sum(later) / len(later):.3f}", flush=True)

    items = [(case + 1, gamma, packing) for packing in range(1, table.packings + 1) for case, gamma in enumerate(EXPECTED)]
    missing = [item for item in items if (item[1], item[2]) not in rows]
    with ThreadPoolExecutor(jobs) as pool:
        list(pool.map(settle, sorted({packing for _, _, packing in missing})))
        list(pool.map(run, missing))


def main() -> None:
    program, work = sys.argv[1], Path(sys.argv[2])
    jobs = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    for table in TABLES:
        make(table, program, work / table.path.stem, jobs)


if __name__ == "__main__":
    main()
