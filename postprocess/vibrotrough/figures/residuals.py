"""What the theory misses: measured minus theoretical velocity efficiency, over the throw number and the swept keys."""

import itertools
import pathlib
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from .inputs import Input, panels, split_inputs
from .source import Source
from .style import COLOURS, MARKERS, corner, new_figure, plain_axes, points, save

Floats = NDArray[np.float64]

MOST_PANELS = 12
RESIDUAL = "residual \u0394\u03b7 = \u03b7 (DEM) \u2212 \u03b7 (theory)  [-]"


def residuals(source: Source) -> Floats:
    """Measured minus theory for each row of campaign.h5; NaN where one of them is not known."""
    values = []
    for case in source.campaign["case"]:
        row = source.row_of(case)
        known = row["efficiency"] is not None and row["efficiency_theory"] is not None
        values.append(row["efficiency"] - row["efficiency_theory"] if known else np.nan)
    return np.array(values)


def plot_residuals(source: Source, output: pathlib.Path) -> list[pathlib.Path]:
    """No figure when no case has a residual, as with drives in stages only."""
    values = residuals(source)
    if not np.isfinite(values).any():
        return []
    over, others = split_inputs(source.campaign, source.inputs)
    figure = draw_maps(source, over, others, values) if others else draw_line(source, over, values)
    missing = np.count_nonzero(~np.isfinite(values))
    corner(figure, source.attributes, f"{missing} of {len(values)} cases have no residual" if missing else "")
    return save(figure, output)


def draw_line(source: Source, over: Input, values: Floats) -> Figure:
    """Only one input is varied: residuals with their error bars."""
    figure, axes = new_figure(size=(7.2, 3.6))
    plain_axes(axes)
    axes.axhline(0.0, color="#888888", linewidth=1.0)
    half_width = np.asarray(source.campaign["efficiency_half_width"], dtype=float)
    axes.errorbar(over.places()[0], values, yerr=half_width, color=COLOURS[0], marker=MARKERS[0], linestyle="none", capsize=3)
    bounded = np.where(np.isfinite(half_width), half_width, 0.0)
    reach = 1.15 * np.nanmax(np.append(np.abs(values) + bounded, 0.05))
    axes.set_ylim(-reach, reach)
    axes.set_xlabel(over.title)
    axes.set_ylabel(RESIDUAL)
    for text, at, anchor in (("layer faster than theory", 0.98, "top"), ("layer slower than theory", 0.02, "bottom")):
        axes.text(0.99, at, text, transform=axes.transAxes, ha="right", va=anchor, fontsize=points(8), color="#666666")
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    return figure


def draw_maps(source: Source, over: Input, others: list[Input], values: Floats) -> Figure:
    """A square per case, coloured and with its number; colours from purple (slower) to orange (faster)."""
    second = others[0]
    groups = panels(others[1:], source.campaign.cases)
    shown = list(itertools.islice(groups.items(), MOST_PANELS))
    across = min(len(shown), 2)
    down = -(-len(shown) // across)
    figure, grid = new_figure(down, across, size=(4.0 * across + 1.6, 3.4 * down + 0.5), squeeze=False, sharex=True,
                              sharey=True, layout="constrained")
    reach = max(np.nanmax(np.abs(values), initial=0.0, where=np.isfinite(values)), 0.05)
    (x, x_names), (y, y_names) = over.places(), second.places()
    for axes, (name, rows) in zip(grid.flat, shown):
        image = draw_panel(axes, x[rows], y[rows], values[rows], reach)
        axes.set_title(name, fontsize=points(9))
        if x_names:
            axes.set_xticks(range(len(x_names)), x_names)
        if y_names:
            axes.set_yticks(range(len(y_names)), y_names)
    for axes in grid.flat[len(shown):]:
        axes.set_visible(False)
    figure.supxlabel(over.title, fontsize=points(10))
    figure.supylabel(second.title, fontsize=points(10))
    figure.colorbar(image, ax=grid, label=RESIDUAL)
    figure.get_layout_engine().set(rect=(0, 0.04, 1, 0.96))
    if len(groups) > len(shown):
        figure.suptitle(f"{len(shown)} of {len(groups)} combinations", fontsize=points(9))
    return figure


def draw_panel(axes: Axes, x: Floats, y: Floats, values: Floats, reach: float) -> Any:
    known = np.isfinite(values)
    image = axes.scatter(x[known], y[known], c=values[known], marker="s", s=420, cmap="PuOr_r", vmin=-reach, vmax=reach,
                         edgecolors="#555555", linewidths=0.5)
    axes.scatter(x[~known], y[~known], marker="x", color="#555555", s=60)
    for column, row, value in zip(x[known], y[known], values[known]):
        ink = "white" if abs(value) > 0.6 * reach else "black"
        axes.annotate(f"{value:+.2f}", (column, row), ha="center", va="center", fontsize=points(6.5), color=ink)
    axes.margins(0.12)
    axes.grid(True, color="#e5e5e5", linewidth=0.6)
    return image
