"""Draws the corner plot of a calibration: the distribution of each quantity, and of each pair.

usage: python3 -m vibrotrough.figures.corner CALIBRATION.json --output FILE.png
CALIBRATION.json is what `vibrotrough theory calibrate` and `vibrotrough calibrate` hand over: the draws of the posterior,
the intervals and the verdict.
"""

import argparse
import json
import pathlib
import sys
import textwrap
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from .style import COLOURS, GREY, new_figure, plain_axes

Floats = NDArray[np.float64]

BINS = 40


def label(quantity: dict[str, Any]) -> str:
    unit = "" if quantity["unit"] == "1" else f"  [{quantity['unit']}]"
    return quantity["name"].replace("_", " ") + unit


def levels_of(counts: Floats) -> list[float]:
    """Densities whose regions hold 95 % and 68 % of the draws, in rising order."""
    falling = np.sort(counts.ravel())[::-1]
    held = np.cumsum(falling) / falling.sum()
    levels = [float(falling[np.searchsorted(held, share)]) for share in (0.95, 0.68)]
    return levels if levels[0] < levels[1] else levels[:1]


def draw_one(axes: Axes, draws: Floats, quantity: dict[str, Any]) -> None:
    axes.hist(draws, bins=BINS, density=True, color=COLOURS[5], alpha=0.6)
    axes.axvline(quantity["median"], color=COLOURS[0], linewidth=1.2)
    for end in ("low", "high"):
        axes.axvline(quantity[end], color=COLOURS[0], linewidth=1.0, linestyle="--")
    axes.set_yticks([])
    values = f"{quantity['median']:.3g} ({quantity['low']:.3g} to {quantity['high']:.3g})"
    axes.set_title(values + ("" if quantity["identifiable"] else "\nnot identifiable"), fontsize=8)


def smoothed(counts: Floats) -> Floats:
    """The histogram averaged with its neighbours (weights 1, 2, 1, twice in each direction), so that few draws draw no islands."""
    for _ in range(2):
        for axis in (0, 1):
            padded = np.pad(counts, [(1, 1) if a == axis else (0, 0) for a in (0, 1)])
            counts = np.take(padded, range(2, padded.shape[axis]), axis) + np.take(padded, range(padded.shape[axis] - 2), axis) + 2 * counts
    return counts


def draw_pair(axes: Axes, x: Floats, y: Floats) -> None:
    axes.plot(x, y, ".", color=COLOURS[5], markersize=1.0, alpha=0.25, rasterized=True)
    counts, x_edges, y_edges = np.histogram2d(x, y, bins=25)
    if counts.max() > 0:
        counts = smoothed(counts)
        centres = [(edges[1:] + edges[:-1]) / 2 for edges in (x_edges, y_edges)]
        axes.contour(centres[0], centres[1], counts.T, levels=levels_of(counts), colors=COLOURS[0], linewidths=0.9)


def draw(data: dict[str, Any], output: pathlib.Path) -> None:
    quantities = list(data["parameters"])
    if data["model_discrepancy"] is not None:
        quantities.append(data["model_discrepancy"])
    draws = [np.array(data["draws"][quantity["name"]]) for quantity in quantities]
    count = len(quantities)
    size = 2.4 * count + 0.6
    figure, grid = new_figure(count, count, size=(max(size, 5.2), max(size, 3.4) + 0.9), squeeze=False)
    for row in range(count):
        for column in range(count):
            axes = grid[row, column]
            if column > row:
                axes.set_visible(False)
                continue
            plain_axes(axes)
            if column == row:
                draw_one(axes, draws[row], quantities[row])
            else:
                draw_pair(axes, draws[column], draws[row])
                axes.set_ylim(*np.quantile(draws[row], [0.001, 0.999]))
            if row == count - 1:
                axes.set_xlabel(label(quantities[column]), fontsize=9)
            if column == 0 and row > 0:
                axes.set_ylabel(label(quantities[row]), fontsize=9)
            axes.tick_params(labelsize=7)
    width = int(14 * figure.get_size_inches()[0])
    words = "\n".join(textwrap.wrap(" ".join(data["verdict"]), width))
    figure.text(0.02, 0.005, words, fontsize=7, color=GREY, va="bottom")
    lines = words.count("\n") + 1
    figure.tight_layout(rect=(0, 0.02 + 0.13 * lines / figure.get_size_inches()[1], 1, 1))
    # By its title a later calibration knows that it may replace the file.
    figure.savefig(output, dpi=150, metadata={"Title": "Calibration by Vibrotrough"})


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("calibration", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    if arguments.output.suffix not in (".png", ".svg", ".pdf"):
        sys.exit(f"vibrotrough: {arguments.output}: must end in .png, .svg or .pdf")
    try:
        draw(json.loads(arguments.calibration.read_text()), arguments.output)
    except OSError as error:
        sys.exit(f"vibrotrough: {error}")


if __name__ == "__main__":
    main()
