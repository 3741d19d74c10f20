"""What the theory misses: measured minus theoretical velocity efficiency, over the throw number and a second input."""

import itertools
import pathlib
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

import vibrotrough
from figure_style import COLOURS, INPUTS, MARKERS, THROW_NUMBER, corner, new_figure, plain_axes, save

if TYPE_CHECKING:
    from figures import Source

Floats = NDArray[np.float64]

MOST_PANELS = 12
RESIDUAL = "residual \u0394\u03b7 = \u03b7 (DEM) \u2212 \u03b7 (theory)  [-]"


def varied_inputs(campaign: vibrotrough.Campaign) -> list[str]:
    """Inputs with more than one value, the vibration angle first."""
    found = []
    for name in INPUTS:
        values = np.asarray(campaign[name], dtype=float) if name in campaign else np.array([])
        if len(np.unique(np.round(values[np.isfinite(values)], 12))) > 1:
            found.append(name)
    return found


def residuals(source: "Source") -> Floats:
    """Measured minus theory for each row of campaign.h5; NaN where one of them is not known."""
    values = []
    for case in source.campaign["case"]:
        row = source.row_of(case)
        known = row["efficiency_dem"] is not None and row["efficiency_theory"] is not None
        values.append(row["efficiency_dem"] - row["efficiency_theory"] if known else np.nan)
    return np.array(values)


def plot_residuals(source: "Source", output: pathlib.Path) -> list[pathlib.Path]:
    varied = varied_inputs(source.campaign)
    values = residuals(source)
    if not varied:
        figure = draw_line(source, values)
    else:
        figure = draw_maps(source, values, varied[0], varied[1:])
    missing = np.count_nonzero(~np.isfinite(values))
    corner(figure, source.attributes, f"{missing} of {len(values)} cases have no residual" if missing else "")
    return save(figure, output)


def draw_line(source: "Source", values: Floats) -> Figure:
    """Only the throw number is varied: residuals with their error bars."""
    figure, axes = new_figure(size=(7.2, 3.6))
    plain_axes(axes)
    axes.axhline(0.0, color="#888888", linewidth=1.0)
    axes.errorbar(source.campaign["throw_number"], values, yerr=source.campaign["efficiency_half_width"],
                  color=COLOURS[0], marker=MARKERS[0], linestyle="none", capsize=3)
    # The interval of a single short packing is infinite: it has no error bar that could be drawn.
    widths = np.nan_to_num(source.campaign["efficiency_half_width"], posinf=0.0)
    reach = 1.15 * np.nanmax(np.append(np.abs(values) + widths, 0.05))
    axes.set_ylim(-reach, reach)
    axes.set_xlabel(THROW_NUMBER)
    axes.set_ylabel(RESIDUAL)
    for text, at, anchor in (("layer faster than theory", 0.98, "top"), ("layer slower than theory", 0.02, "bottom")):
        axes.text(0.99, at, text, transform=axes.transAxes, ha="right", va=anchor, fontsize=8, color="#666666")
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    return figure


def panels(campaign: vibrotrough.Campaign, others: list[str]) -> dict[str, list[int]]:
    """Rows of each combination of the further inputs, with its name."""
    keys = list(zip(*(np.round(np.asarray(campaign[name], dtype=float), 12) for name in others))) if others else []
    if not keys:
        return {"": list(range(campaign.cases))}
    found: dict[str, list[int]] = {}
    for row, key in enumerate(keys):
        name = ", ".join(INPUTS[other][1].format(INPUTS[other][3] * value) for other, value in zip(others, key))
        found.setdefault(name, []).append(row)
    return found


def draw_maps(source: "Source", values: Floats, second: str, others: list[str]) -> Figure:
    """A square per case, coloured and with its number; colours from purple (slower) to orange (faster)."""
    campaign = source.campaign
    title, _, unit, factor = INPUTS[second]
    groups = panels(campaign, others)
    shown = list(itertools.islice(groups.items(), MOST_PANELS))
    across = min(len(shown), 2)
    down = -(-len(shown) // across)
    figure, grid = new_figure(down, across, size=(4.0 * across + 1.6, 3.4 * down + 0.5), squeeze=False, sharex=True,
                              sharey=True, layout="constrained")
    reach = max(np.nanmax(np.abs(values), initial=0.0, where=np.isfinite(values)), 0.05)
    for axes, (name, rows) in zip(grid.flat, shown):
        x, y = np.asarray(campaign["throw_number"])[rows], factor * np.asarray(campaign[second], dtype=float)[rows]
        image = draw_panel(axes, x, y, values[rows], reach)
        axes.set_title(name, fontsize=9)
    for axes in grid.flat[len(shown):]:
        axes.set_visible(False)
    figure.supxlabel(THROW_NUMBER, fontsize=10)
    figure.supylabel(f"{title}  [{unit}]", fontsize=10)
    figure.colorbar(image, ax=grid, label=RESIDUAL)
    figure.get_layout_engine().set(rect=(0, 0.04, 1, 0.96))
    if len(groups) > len(shown):
        figure.suptitle(f"{len(shown)} of {len(groups)} combinations", fontsize=9)
    return figure


def draw_panel(axes: Axes, x: Floats, y: Floats, values: Floats, reach: float) -> Any:
    known = np.isfinite(values)
    image = axes.scatter(x[known], y[known], c=values[known], marker="s", s=420, cmap="PuOr_r", vmin=-reach, vmax=reach,
                         edgecolors="#555555", linewidths=0.5)
    axes.scatter(x[~known], y[~known], marker="x", color="#555555", s=60)
    for column, row, value in zip(x[known], y[known], values[known]):
        ink = "white" if abs(value) > 0.6 * reach else "black"
        axes.annotate(f"{value:+.2f}", (column, row), ha="center", va="center", fontsize=6.5, color=ink)
    axes.margins(0.12)
    axes.grid(True, color="#e5e5e5", linewidth=0.6)
    return image
