"""The contacts at the floor over a cycle: spin and slip, forces and torques, contacts and solid fraction of the lowest grains.

Needs what `measure.rolling = true` measures (rolling/ in result.h5); a result without it gives no figure.
"""

import pathlib
import sys
import warnings
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

import vibrotrough
from figure_portraits import has
from figure_style import COLOURS, DASHES, GREY, case_title, corner, new_figure, plain_axes, points, save

if TYPE_CHECKING:
    from figures import Source

Floats = NDArray[np.float64]
Curve = tuple[str, Floats, int]

LEAST_TOUCHING = 1.0  # grains: means over fewer are those of stray grains
MICRO = 1e6


class Curves:
    """Means of the packings' curves over one cycle; values of grains and contacts have gaps where hardly one touches the floor."""

    def __init__(self, result: vibrotrough.File, packings: list[int]) -> None:
        self.result, self.packings = result, packings
        self.cycles = self["phase"] / (2 * np.pi)
        self.carried = self["floor_grains"] >= LEAST_TOUCHING

    def __getitem__(self, name: str) -> Floats:
        curves = np.array([np.asarray(self.result[f"rolling/{packing}/{name}"]) for packing in self.packings])
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # where no packing has a value, the mean has none
            return np.asarray(np.nanmean(curves, axis=0))

    def of_floor(self, name: str) -> Floats:
        return np.where(self.carried, self[name], np.nan)


def draw_curves(axes: Axes, cycles: Floats, curves: list[Curve], label: str) -> None:
    for name, values, style in curves:
        axes.plot(cycles, values, color=COLOURS[style], linestyle=DASHES[style], linewidth=1.4, label=name)
    axes.set_ylabel(label)
    axes.legend(frameon=False, fontsize=points(8))
    plain_axes(axes)


def plot_rolling(source: "Source", case: str, result: vibrotrough.File, output: pathlib.Path) -> list[pathlib.Path]:
    if "packings/rolling_problem" in result:
        for number, problem in enumerate(result["packings/rolling_problem"], start=1):
            if problem:
                print(f"figures.py: case {case}, packing {number}: {problem}", file=sys.stderr)
    packings = has(result, "rolling")
    if not packings:
        return []
    c = Curves(result, packings)
    friction = float(source.row_of(case)["friction"])
    figure, axes = new_figure(3, 2, size=(10.0, 9.0), sharex=True)
    draw_curves(axes[0][0], c.cycles, [("second diameter", c["second_velocity"], 6), ("grains on the floor", c.of_floor("floor_velocity"), 0),
                                       ("their spin \u03c9R", c.of_floor("floor_spin"), 1), ("their slip", c.of_floor("floor_slip"), 2),
                                       ("spin of the first diameter", c["first_spin"], 3)], "velocity relative to the trough  [m/s]")
    normal = c["normal_force"]
    for sign in (1, -1):
        axes[0][1].plot(c.cycles, sign * friction * normal, color=GREY, linewidth=1.0, label="\u00b1\u03bc times the normal force" if sign > 0 else None)
    draw_curves(axes[0][1], c.cycles, [("friction on the layer", -c["tangential_force"], 0), ("sum of its sizes", c["friction"], 1)], "force at the floor  [N]")
    with np.errstate(invalid="ignore", divide="ignore"):
        mobilised = np.where(normal > 0, c["friction"] / (friction * normal), np.nan)
    draw_curves(axes[1][0], c.cycles, [("sliding contacts", c.of_floor("sliding_share"), 0), ("friction over \u03bc times normal force", np.where(c.carried, mobilised, np.nan), 1)],
                "share at the floor  [-]")
    draw_curves(axes[1][1], c.cycles, [("of the floor", MICRO * c["floor_torque"], 0), ("of the other grains", MICRO * c["grain_torque"], 1)],
                "torque on the floor grains  [\u00b5N m]")
    draw_curves(axes[2][0], c.cycles, [("with other grains, of a floor grain", c.of_floor("contacts_per_floor_grain"), 0), ("of any grain", c["contacts_per_grain"], 6)],
                "contacts per grain  [-]")
    draw_curves(axes[2][1], c.cycles, [("first diameter", c["first_fraction"], 0), ("second diameter", c["second_fraction"], 6)], "solid fraction  [-]")
    for one in axes[2]:
        one.set_xlabel("time in cycles, t / T  [-]")
    figure.suptitle(case_title(source.row_of(case)), fontsize=points(10))
    corner(figure, source.attributes)
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    return save(figure, output)
