"""Speed of the grains over their distance from the side walls, from the frames of a wide trough."""

import pathlib

import numpy as np

from engine_deck import Floats, last_group

# mm, of the grains' centres from the nearer wall: half a diameter apart near the wall.
EDGES = np.array([0, 3.5, 5.25, 7, 8.75, 10.5, 14, 17.5, 21, 28, 40, 60, 80, 100])


def frames(folder: pathlib.Path) -> tuple[list[int], Floats, list[pathlib.Path]]:
    """Steps in order, the trough's x [m] at each, and the files."""
    table = [line.split(",") for line in (folder / "frames.csv").read_text(encoding="utf-8").splitlines()]
    trough = {int(row[0]): float(row[1]) for row in table if row[0].isdigit()}
    files = {int(last_group(r"frames\.(\d+)\.dump", path.name)): path for path in folder.glob("frames.*.dump")}
    steps = sorted(step for step in files if step in trough)
    return steps, np.array([trough[step] for step in steps]), [files[step] for step in steps]


def places(path: pathlib.Path) -> Floats:
    """x and y of all grains [m], by id."""
    table = np.loadtxt(path, skiprows=9)
    return table[np.argsort(table[:, 0])][:, 2:4]


def lateral_profile(folder: pathlib.Path, length: float, width: float, frames_per_cycle: int, discarded: int) -> tuple[Floats, Floats]:
    """Mean displacement along the trough per cycle [m] of the grains in each bin of EDGES, relative to the trough, a row per
    cycle; and the number of grains seen there. Displacements between frames are short against the box (`length`, m), so that
    the periodic image is known."""
    steps, trough, files = frames(folder)
    cycles = (len(steps) - 1) // frames_per_cycle
    sums, counts = (np.zeros((cycles, len(EDGES) - 1)) for _ in range(2))
    before = places(files[0])
    for i in range(1, cycles * frames_per_cycle + 1):
        now = places(files[i])
        moved = now[:, 0] - before[:, 0]
        moved -= length * np.round(moved / length)
        moved -= trough[i] - trough[i - 1]
        distance = 1e3 * np.minimum(before[:, 1], width - before[:, 1])
        bin_of = np.clip(np.digitize(distance, EDGES) - 1, 0, len(EDGES) - 2)
        cycle = (i - 1) // frames_per_cycle
        sums[cycle] += np.bincount(bin_of, moved, len(EDGES) - 1)
        counts[cycle] += np.bincount(bin_of, minlength=len(EDGES) - 1)
        before = now
    with np.errstate(invalid="ignore"):
        return frames_per_cycle * (sums / counts)[discarded:], counts[discarded:]
