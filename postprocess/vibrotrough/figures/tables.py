"""Figures of the tables that a result has beside its motion: the partition curve of a screen, the segregation of a
mixture over time, an open trough along itself with its residence times, and the speed over the stages of a drive, each with its intervals
over the packings. A result without the table gives no figure.
"""

import pathlib

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from ..results import File
from .source import Source
from .style import COLOURS, DASHES, case_title, corner, new_figure, plain_axes, points, save

Floats = NDArray[np.float64]
SUPERSCRIPTS = str.maketrans("-0123456789", "\u207b\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079")


def column(result: File, table: str, name: str) -> Floats:
    """Empty where the result has no such table."""
    path = f"{table}/{name}"
    return np.asarray(result[path], dtype=float) if path in result else np.empty(0)


def finish(source: Source, case: str, axes: Axes, output: pathlib.Path) -> list[pathlib.Path]:
    figure = axes.get_figure()
    if axes.get_legend_handles_labels()[1]:
        axes.legend(frameon=False, fontsize=points(8))
    for one in figure.axes:
        plain_axes(one)
    axes.set_title(case_title(source.row_of(case)), fontsize=points(10))
    corner(figure, source.attributes)
    figure.tight_layout(rect=(0, 0.02, 1, 1))
    return save(figure, output)


def draw_band(axes: Axes, over: Floats, mean: Floats, half_width: Floats, number: int = 0, label: str = "") -> None:
    """A line with its interval as a band, which one packing does not have."""
    axes.plot(over, mean, color=COLOURS[number], linestyle=DASHES[number], linewidth=1.4, label=label)
    axes.fill_between(over, mean - half_width, mean + half_width, color=COLOURS[number], alpha=0.2, linewidth=0)
    axes.margins(x=0.01)


def plot_screening(source: Source, case: str, result: File, output: pathlib.Path) -> list[pathlib.Path]:
    """Of a batch on a screen: which share of the undersize has passed, over the length of screen."""
    length, efficiency, half_width = (column(result, "screening", name) for name in ("distance", "efficiency", "efficiency_half_width"))
    if len(length) == 0 or not np.isfinite(efficiency).any():
        return []
    _, axes = new_figure()
    draw_band(axes, length, efficiency, np.nan_to_num(half_width))
    axes.set(xlabel="length of the screen  [m]", ylabel="efficiency of screening  [-]", ylim=(0, 1.03))
    return finish(source, case, axes, output)


def plot_partition(source: Source, case: str, result: File, output: pathlib.Path) -> list[pathlib.Path]:
    size, stays, low, high, model = (column(result, "partition", name) for name in ("diameter", "stays", "stays_low", "stays_high", "stays_by_model"))
    if len(size) == 0:
        return []
    # d50 lies on a line that takes all spheres as large as the opening to stay.
    opening = size[0] / column(result, "partition", "relative_diameter")[0]
    corners = [at for at in range(1, len(size)) if size[at - 1] < opening < size[at]]
    along = np.insert(1e3 * size, corners, 1e3 * opening)
    _, axes = new_figure()
    axes.plot(along, np.insert(stays, corners, 1), color=COLOURS[0])
    axes.errorbar(1e3 * size, stays, [np.nan_to_num(stays - low), np.nan_to_num(high - stays)], color=COLOURS[0], linestyle="none", marker="o", markersize=4, capsize=2, label="measured")
    axes.plot(along, np.insert(model, corners, 1), color=COLOURS[2], linestyle=DASHES[2], label="one attempt in each cycle (Gaudin)")
    cut = float(result["case/cut_size"])
    if np.isfinite(cut):
        axes.plot([1e3 * cut], [0.5], color=COLOURS[1], marker="d", linestyle="none", label=f"d50 {1e3 * cut:.3g} mm")
    axes.set(xlabel="diameter of the grains  [mm]", ylabel="share that stays on the screen  [-]", ylim=(-0.03, 1.03))
    return finish(source, case, axes, output)


def plot_segregation(source: Source, case: str, result: File, output: pathlib.Path) -> list[pathlib.Path]:
    cycle = column(result, "segregation", "cycle")
    if len(cycle) == 0:
        return plot_materials_along(source, case, result, output)
    _, axes = new_figure()
    for number in range(4):
        index, half_width = (column(result, "segregation", f"{name}_{number}") for name in ("index", "half_width"))
        if len(index) == 0:
            break
        draw_band(axes, cycle, index, half_width, number, str(result["materials/name"][number]))
    axes.axhline(0, color="#999999", linewidth=0.6)
    axes.set(xlabel="cycle  [-]", ylabel="segregation index, 1 on top of the others  [-]")
    return finish(source, case, axes, output)


def plot_materials_along(source: Source, case: str, result: File, output: pathlib.Path) -> list[pathlib.Path]:
    """A mixture in an open trough: the share of each material and its segregation index along the trough."""
    place = 1e3 * column(result, "materials_along", "x")
    if len(place) == 0:
        return []
    _, panels = new_figure(2, 1, sharex=True)
    names = np.asarray(result["materials_along/material"]).astype(str)
    for axes, column_name, label in ((panels[0], "share", "share of the mass  [-]"), (panels[1], "segregation", "segregation index  [-]")):
        mean, half_width = (column(result, "materials_along", column_name + end) for end in ("", "_half_width"))
        for number, name in enumerate(dict.fromkeys(names)):
            rows = names == name
            draw_band(axes, place[rows], mean[rows], half_width[rows], number, name)
        axes.set(ylabel=label)
    panels[0].set(ylim=(-0.03, 1.03))
    panels[1].axhline(0, color="#999999", linewidth=0.6)
    panels[1].set(xlabel="distance along the trough from the back wall  [mm]", ylim=(-1.05, 1.05))
    panels[0].get_figure().align_ylabels()
    return finish(source, case, panels[0], output)


def plot_along(source: Source, case: str, result: File, output: pathlib.Path) -> list[pathlib.Path]:
    place = 1e3 * column(result, "along_trough", "x")
    if len(place) == 0:
        return []
    _, panels = new_figure(2, 1, sharex=True)
    for axes, name, factor, label in ((panels[0], "depth", 1e3, "settled depth  [mm]"), (panels[1], "velocity", 1, "speed  [m/s]")):
        mean, half_width = (factor * column(result, "along_trough", name + end) for end in ("", "_half_width"))
        draw_band(axes, place, mean, half_width)
        axes.set(ylabel=label, ylim=(min(0.0, axes.get_ylim()[0]) if name == "velocity" else 0, None))
    panels[1].set(xlabel="distance along the trough from the back wall  [mm]")
    panels[0].get_figure().align_ylabels()
    return finish(source, case, panels[0], output)


def plot_residence(source: Source, case: str, result: File, output: pathlib.Path) -> list[pathlib.Path]:
    share, time, half_width = (column(result, "residence_times", name) for name in ("share", "time", "time_half_width"))
    if len(share) == 0:
        return []
    _, axes = new_figure()
    axes.plot(time, share, color=COLOURS[0], linewidth=1.4, label="measured")
    axes.fill_betweenx(share, time - half_width, time + half_width, color=COLOURS[0], alpha=0.2, linewidth=0)
    mean = float(result["case/residence_time"])
    if np.isfinite(mean):
        axes.plot([mean, mean], [0, 1], color=COLOURS[1], linestyle=DASHES[1], linewidth=1.4, label=f"plug flow with the same mean, {mean:.3g} s")
    axes.set(xlabel="time from the feed to the edge  [s]", ylabel="share of the grains that stayed no longer  [-]", xlim=(0, None), ylim=(-0.03, 1.03))
    return finish(source, case, axes, output)


def plot_stages(source: Source, case: str, result: File, output: pathlib.Path) -> list[pathlib.Path]:
    time, speed, half_width = (column(result, "stage_cycles", name) for name in ("time", "conveying_speed", "conveying_speed_half_width"))
    if len(time) == 0:
        return []
    _, axes = new_figure()
    draw_band(axes, time, speed, half_width, label="layer, mean of each cycle")
    start, lasts, stands = (column(result, "stages", name) for name in ("start", "time", "standstill"))
    for number, (begin, length, still) in enumerate(zip(start, lasts, stands), 1):
        if still:
            axes.axvspan(begin, begin + length, color="#eeeeee", zorder=0, label="standstill" if number == 1 + np.argmax(stands) else None)
        axes.axvline(begin, color="#999999", linewidth=0.6)
        axes.text(begin + length / 2, 0.01, f"{number}", transform=axes.get_xaxis_transform(), ha="center", va="bottom", fontsize=points(8))
    steady, steady_width = (column(result, "stages", name) for name in ("conveying_speed", "conveying_speed_half_width"))
    moves = (stands == 0) & np.isfinite(steady)
    axes.errorbar((start + lasts)[moves], steady[moves], np.nan_to_num(steady_width[moves]), color=COLOURS[1], linestyle="none", marker="s", markersize=4,
                  capsize=2, label="speed at the end of a stage")  # fmt: skip
    # Room for the numbers of the stages below the curve, and for the legend above.
    low, high = axes.get_ylim()
    axes.set(xlabel="time, above it the number of the stage  [s]", ylabel="conveying speed  [m/s]", ylim=(low - 0.08 * (high - low), high + 0.3 * (high - low)))
    return finish(source, case, axes, output)
