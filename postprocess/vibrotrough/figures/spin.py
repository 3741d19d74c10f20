"""Spin and slip of the grains on the floor over a cycle, and the forces between layer and trough.

Needs what is measured phase by phase (phases/ in result.h5); a result without it gives no figure.
"""

import pathlib

import numpy as np
from numpy.typing import NDArray

from ..results import File
from .portraits import finish, has
from .source import Source
from .style import COLOURS, DASHES, GREY, new_figure, plain_axes, points, save

LEAST_TOUCHING = 1.0  # grains: means over fewer are those of stray grains


def plot_spin(source: Source, case: str, result: File, output: pathlib.Path) -> list[pathlib.Path]:
    packings = has(result, "phases")
    if not packings:
        return []
    figure, (upper, lower) = new_figure(2, 1, size=(7.2, 7.0), sharex=True)
    friction = float(source.row_of(case)["friction"])
    for packing in packings:
        def column(name: str) -> NDArray[np.float64]:
            return np.asarray(result[f"phases/{packing}/{name}"])

        cycles = column("phase") / (2 * np.pi)
        carried = column("touching") >= LEAST_TOUCHING
        floor, slip = np.where(carried, column("sliding"), np.nan), np.where(carried, column("slip"), np.nan)
        curves = [("layer", column("velocity_x") - column("trough_velocity_x"), 6), ("floor grains", floor, 0),
                  ("spin of the floor grains", floor - slip, 1), ("slip at the floor", slip, 2)]
        alpha = 1.0 if packing == packings[0] else 0.35
        for label, values, style in curves:
            upper.plot(cycles, values, color=COLOURS[style], linestyle=DASHES[style], alpha=alpha, linewidth=1.4,
                       label=label if packing == packings[0] else None)
        normal, tangential = column("normal_force"), -column("tangential_force")
        lower.step(cycles, friction * normal, where="pre", color=GREY, linewidth=1.0, alpha=alpha)
        lower.step(cycles, -friction * normal, where="pre", color=GREY, linewidth=1.0, alpha=alpha)
        lower.step(cycles, tangential, where="pre", color=COLOURS[0], linewidth=1.4, alpha=alpha)
    upper.set_ylabel("velocity relative to the trough  [m/s]")
    lower.set_ylabel("friction on the layer  [N]")
    lower.set_xlabel("time in cycles, t / T  [-]")
    lower.text(0.01, 0.97, "grey: the largest friction, \u03bc times the normal force, forwards and backwards", transform=lower.transAxes,
               va="top", fontsize=points(8), color=GREY)
    for axes in (upper, lower):
        plain_axes(axes)
    finish(figure, source, case, upper)
    return save(figure, output)
