"""Draws a map of the point-mass theory from the HDF5 file that `vibrotrough theory map` wrote.

    python3 -m vibrotrough.figures.theory_map MAP.h5 [--kind modes|efficiency|lines|iso] [--output NAME.png]

modes: the mode diagram, regions labelled, lines between modes as the program located them. efficiency: eta as colour with
the mode lines. lines: eta against x, one line per some values of y. iso: curves of equal eta. Without --kind all but lines.
Nothing is computed here but where a label fits. Writes MAP_KIND.png.
"""

import argparse
import pathlib
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.collections import LineCollection  # noqa: E402

from ..results import open_theory  # noqa: E402

WORDS = {
    "throw_number": "throw number $\\Gamma$",
    "machine_number": "machine number $K$",
    "vibration_angle_deg": "vibration angle $\\beta$ [deg]",
    "tan_vibration_angle": "$\\tan\\beta$",
    "inclination_deg": "inclination $\\alpha$ [deg]",
    "tan_inclination": "$\\tan\\alpha$",
    "friction": "friction $\\mu$",
    "restitution": "restitution $e$",
}
SMALLEST_LABELLED = 0.004  # of the map's area
LETTERS = "F flight, P slide forwards, N slide backwards, R rest; P', N' directly after a landing"


class TheoryMap:
    def __init__(self, path: pathlib.Path) -> None:
        try:
            file = open_theory(path)
        except (OSError, ValueError) as error:
            raise SystemExit(str(error)) from error
        if file.attributes["format"] != "vibrotrough theory map":
            raise SystemExit(f"{path} is not a map of the theory; make one with vibrotrough theory map")
        self.x, self.y = np.asarray(file["x"]), np.asarray(file["y"])
        self.x_name, self.y_name = file.attributes["x_name"], file.attributes["y_name"]
        self.efficiency, self.mode = np.asarray(file["velocity_efficiency"]), np.asarray(file["mode"])
        self.modes = list(file["modes"])
        self.lines = np.stack([np.asarray(file[f"boundaries/{name}"]) for name in ("x0", "y0", "x1", "y1")], axis=1)
        self.fixed = {name.removeprefix("fixed/"): float(file[name][0]) for name in file if name.startswith("fixed/")}

    def caption(self) -> str:
        return ", ".join(f"{WORDS.get(name, name)} = {value:g}" for name, value in self.fixed.items())


def draw_mode_lines(axes: Axes, theory: TheoryMap, **style: Any) -> None:
    pieces = [[(x0, y0), (x1, y1)] for x0, y0, x1, y1 in theory.lines]
    axes.add_collection(LineCollection(pieces, **style))


def innermost(region: NDArray[np.bool_]) -> tuple[int, int]:
    """The cell of a region farthest from its rim: peel the region until nothing is left."""
    rim = np.pad(region, 1)
    last = rim
    while rim.any():
        last = rim
        rim = rim & np.roll(rim, 1, 0) & np.roll(rim, -1, 0) & np.roll(rim, 1, 1) & np.roll(rim, -1, 1)
    rows, columns = np.nonzero(last[1:-1, 1:-1])
    middle = len(rows) // 2
    return rows[middle], columns[middle]


def label_regions(axes: Axes, theory: TheoryMap) -> None:
    for number in np.unique(theory.mode):
        region = theory.mode == number
        if region.mean() < SMALLEST_LABELLED:
            continue
        row, column = innermost(region)
        axes.text(theory.x[column], theory.y[row], theory.modes[number], ha="center", va="center", fontsize=9)


def frame(theory: TheoryMap, axes: Axes) -> None:
    axes.set_xlim(theory.x.min(), theory.x.max())
    axes.set_ylim(theory.y.min(), theory.y.max())
    axes.set_xlabel(WORDS.get(theory.x_name, theory.x_name))
    axes.set_ylabel(WORDS.get(theory.y_name, theory.y_name))
    axes.set_title(theory.caption(), fontsize=9)


def draw_modes(theory: TheoryMap, axes: Axes) -> None:
    draw_mode_lines(axes, theory, colors="black", linewidths=1)
    label_regions(axes, theory)
    frame(theory, axes)
    axes.figure.supxlabel(LETTERS, fontsize=8)


def draw_efficiency(theory: TheoryMap, axes: Axes) -> None:
    eta = np.where(np.isfinite(theory.efficiency), theory.efficiency, np.nan)
    image = axes.pcolormesh(theory.x, theory.y, eta, shading="gouraud", cmap="viridis")
    axes.figure.colorbar(image, ax=axes, label="velocity efficiency $\\eta$")
    draw_mode_lines(axes, theory, colors="white", linewidths=0.6)
    frame(theory, axes)


def draw_lines(theory: TheoryMap, axes: Axes) -> None:
    rows = np.unique(np.linspace(0, len(theory.y) - 1, 8).round().astype(int))
    colours = plt.get_cmap("viridis")(np.linspace(0, 0.9, len(rows)))
    for row, colour in zip(rows, colours):
        axes.plot(theory.x, theory.efficiency[row], color=colour, label=f"{theory.y[row]:.3g}")
    axes.legend(title=WORDS.get(theory.y_name, theory.y_name), fontsize=8)
    axes.set_xlabel(WORDS.get(theory.x_name, theory.x_name))
    axes.set_ylabel("velocity efficiency $\\eta$")
    axes.set_title(theory.caption(), fontsize=9)


def draw_iso(theory: TheoryMap, axes: Axes) -> None:
    eta = np.where(np.isfinite(theory.efficiency), theory.efficiency, np.nan)
    levels = np.arange(np.floor(np.nanmin(eta) * 10) / 10, np.nanmax(eta) + 0.05, 0.1)
    curves = axes.contour(theory.x, theory.y, eta, levels=levels, cmap="viridis")
    axes.clabel(curves, fmt="%.1f", fontsize=8)
    frame(theory, axes)


DRAW = {"modes": draw_modes, "efficiency": draw_efficiency, "lines": draw_lines, "iso": draw_iso}


def draw(path: pathlib.Path, kind: str, output: pathlib.Path) -> pathlib.Path:
    figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
    DRAW[kind](TheoryMap(path), axes)
    figure.savefig(output, dpi=110)
    plt.close(figure)
    return output


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("map", type=pathlib.Path)
    parser.add_argument("--kind", choices=DRAW)
    parser.add_argument("--output", type=pathlib.Path)
    options = parser.parse_args()
    kinds = [options.kind] if options.kind else ["modes", "efficiency", "iso"]
    for kind in kinds:
        default = options.map.with_name(f"{options.map.stem}_{kind}.png")
        print(draw(options.map, kind, options.output if options.output and options.kind else default))


if __name__ == "__main__":
    main()
