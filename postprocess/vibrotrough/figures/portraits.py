"""Layer and point mass over a cycle: phase portraits, and velocity and solid fraction over height.

Both need what is measured phase by phase (phases/ and profiles/ in result.h5); a result without it gives no figure.
"""

import csv
import io
import pathlib
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ..results import File
from .drawn import read_note
from .source import Source
from .style import COLOURS, DASHES, GREY, case_title, corner, new_figure, plain_axes, points, save

Floats = NDArray[np.float64]

LAYER = {"color": COLOURS[0], "linestyle": DASHES[0], "linewidth": 1.6}
POINT_MASS = {"color": COLOURS[1], "linestyle": DASHES[1], "linewidth": 1.6}
TROUGH = {"color": COLOURS[6], "linestyle": DASHES[3], "linewidth": 1.2}
MILLI = 1e3


def read_point_mass(path: pathlib.Path) -> dict[str, Floats] | None:
    """The theory's columns as arrays; None when its motion has no period."""
    try:
        rows = list(csv.DictReader(io.StringIO(read_note(path).decode())))
    except OSError:
        return None
    if not rows:
        return None
    return {name: np.array([row[name] for row in rows], dtype=float) for name in rows[0] if name != "phase"}


def without_drift(cycles: Floats, displacement: Floats) -> Floats:
    """What is left of a displacement when its mean velocity is taken away."""
    return displacement - displacement[-1] * cycles / cycles[-1]


class Layer:
    """The mean curves of one packing from phase 0 to the end of its period, the start being the end of the period."""

    def __init__(self, result: File, packing: int) -> None:
        place = f"phases/{packing}/"

        def column(name: str) -> Floats:
            return np.asarray(result[place + name])

        def closed(values: Floats) -> Floats:
            return np.concatenate([values[-1:], values])

        self.cycles = np.concatenate([[0.0], column("phase") / (2 * np.pi)])
        self.displacement = np.concatenate([[0.0], column("displacement")])
        height = column("height")
        self.lift = closed(height - height.min())
        self.velocity = closed(column("velocity_x"))
        self.trough_velocity = closed(column("trough_velocity_x"))
        self.relative_x = closed(column("velocity_x") - column("trough_velocity_x"))
        self.relative_z = closed(column("velocity_z") - column("trough_velocity_z"))
        self.force = closed(column("normal_force")) / float(result["packings/mass"][packing - 1])


def has(result: File, group: str) -> list[int]:
    """Numbers of the packings that were measured phase by phase."""
    count = len(result["packings/seed"])
    return [packing for packing in range(1, count + 1)
            if f"{group}/{packing}/phase" in result and len(result[f"{group}/{packing}/phase"]) > 1]


def plot_portraits(source: Source, case: str, result: File, output: pathlib.Path) -> list[pathlib.Path]:
    packings = has(result, "phases")
    if not packings:
        return []
    figure, axes = new_figure(2, 2, size=(8.4, 7.0))
    draw_layers(axes, [Layer(result, packing) for packing in packings])
    mass = read_point_mass(source.data / "point_mass" / f"{case}.csv")
    if mass:
        draw_point_mass(axes, mass)
    label_portraits(axes)
    finish(figure, source, case, axes[1, 0])
    return save(figure, output)


def draw_layers(axes: Any, layers: list[Layer]) -> None:
    """All packings; the first one is named."""
    for number, layer in enumerate(layers):
        style = dict(LAYER, alpha=1.0 if number == 0 else 0.35)
        name = "layer" if number == 0 else None
        drift_free = without_drift(layer.cycles, layer.displacement)
        axes[0, 0].plot(MILLI * drift_free, layer.relative_x, **style)
        axes[0, 1].plot(MILLI * layer.lift, layer.relative_z, **style)
        axes[1, 0].plot(layer.cycles, layer.velocity, label=name, **style)
        axes[1, 1].step(layer.cycles, layer.force, where="pre", **style)
    axes[1, 0].plot(layers[0].cycles, layers[0].trough_velocity, label="trough", **TROUGH)


def draw_point_mass(axes: Any, mass: dict[str, Floats]) -> None:
    cycles = mass["cycles"]
    axes[0, 0].plot(MILLI * without_drift(cycles, mass["relative_displacement_m"]), mass["relative_velocity_x_m_per_s"],
                    **POINT_MASS)
    axes[0, 1].plot(MILLI * mass["gap_m"], mass["relative_velocity_z_m_per_s"], **POINT_MASS)
    axes[1, 0].plot(cycles, mass["velocity_x_m_per_s"], label="point mass", **POINT_MASS)
    axes[1, 1].plot(cycles, mass["normal_force_n_per_kg"], **POINT_MASS)


def label_portraits(axes: Any) -> None:
    labels = [
        (axes[0, 0], "displacement without drift  [mm]", "relative velocity, along  [m/s]"),
        (axes[0, 1], "height above lowest place  [mm]", "relative velocity, normal  [m/s]"),
        (axes[1, 0], "time in cycles, t / T  [-]", "velocity along the trough  [m/s]"),
        (axes[1, 1], "time in cycles, t / T  [-]", "normal force over mass  [N/kg]"),
    ]
    for one, below, left in labels:
        plain_axes(one)
        one.set_xlabel(below)
        one.set_ylabel(left)
    axes[1, 1].text(0.42, 0.97, "the point mass's impacts are not drawn", transform=axes[1, 1].transAxes, ha="center", va="top",
                    fontsize=points(8), color=GREY)


def finish(figure: Figure, source: Source, case: str, legend_from: Axes) -> None:
    row = source.row_of(case)
    figure.suptitle(case_title(row), fontsize=points(10))
    height = figure.get_size_inches()[1]
    handles, names = legend_from.get_legend_handles_labels()
    figure.legend(handles, names, ncols=4, loc="upper center", frameon=False, fontsize=points(9), bbox_to_anchor=(0.5, 1 - 0.2 / height))
    corner(figure, source.attributes)
    figure.tight_layout(rect=(0, 0.03, 1, 1 - 0.35 / height))


def profile_of(result: File, packing: int) -> list[Floats]:
    """Heights, and for each phase (row) velocity along the trough and solid fraction over them."""
    place = f"profiles/{packing}/"
    phases = len(np.unique(np.asarray(result[place + "phase"])))
    return [np.asarray(result[place + name]).reshape(phases, -1) for name in ("height", "velocity_x", "solid_fraction")]


def plot_profiles(source: Source, case: str, result: File, output: pathlib.Path) -> list[pathlib.Path]:
    packings = has(result, "profiles")
    if not packings:
        return []
    figure, axes = new_figure(1, 2, size=(7.2, 4.4), sharey=True)
    for number, packing in enumerate(packings):
        draw_profile(axes, profile_of(result, packing), number == 0)
    row = source.row_of(case)
    scale = float(result["case/velocity_scale"])
    if row["efficiency_theory"] is not None:
        axes[0].axvline(row["efficiency_theory"] * scale, label="point mass, mean", **POINT_MASS)
    for one, below in zip(axes, ("relative velocity, along  [m/s]", "solid fraction, by grains' centres  [-]")):
        plain_axes(one)
        one.set_xlabel(below)
    axes[0].set_ylabel("height above the trough  [mm]")
    axes[1].set_xlim(left=0)
    axes[0].set_ylim(bottom=0)
    finish(figure, source, case, axes[0])
    return save(figure, output)


def draw_profile(axes: Any, profile: list[Floats], named: bool) -> None:
    """The mean over the phases, weighted by what is there, and the range of the phases of the first packing."""
    height, velocity, solid = profile
    weight = np.where(np.isfinite(velocity), solid, 0.0)
    total = weight.sum(axis=0)
    there = total > 1e-3 * total.max()
    mean = np.sum(np.nan_to_num(velocity) * weight, axis=0)[there] / total[there]
    level = MILLI * height[0][there]
    style = dict(LAYER, alpha=1.0 if named else 0.35)
    axes[0].plot(mean, level, label="layer, mean over the cycle" if named else None, marker=".", **style)
    axes[1].plot(solid.mean(axis=0)[there], level, marker=".", **style)
    if named:
        low = np.nanmin(np.where(weight > 0, velocity, np.nan)[:, there], axis=0)
        high = np.nanmax(np.where(weight > 0, velocity, np.nan)[:, there], axis=0)
        axes[0].fill_betweenx(level, low, high, color=COLOURS[5], alpha=0.3, linewidth=0, label="range over the cycle")
        axes[1].fill_betweenx(level, solid.min(axis=0)[there], solid.max(axis=0)[there], color=COLOURS[5], alpha=0.3, linewidth=0)
