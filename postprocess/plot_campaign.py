#!/usr/bin/python3
"""Draws velocity efficiency against throw number from campaign.h5: DEM points with error bars, one colour per vibration
angle, over the theory's lines.

    plot_campaign.py DIR [--theory FILE.csv] [--output NAME]

DIR holds campaign.h5. FILE.csv is what the program computed of the theory, with at least the columns throw_number,
vibration_angle_deg and velocity_efficiency (a fine curve, drawn as a line) or efficiency_theory (the theory at the cases,
as `vibrotrough compare --csv` prints it, drawn as small crosses joined by a thin line). Several angles, and where there are
columns inclination_deg or friction several of those, stand one below the other. Nothing of the theory is computed here.
Writes NAME.svg and NAME.png, by default DIR/report/efficiency.
"""

import argparse
import csv
import math
import pathlib
import sys
from collections import defaultdict
from typing import Any

import h5py
import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from figure_style import COLOURS, DASHES, EFFICIENCY, INPUTS, MARKERS, THROW_NUMBER, Problem, corner, new_figure, plain_axes, save


Columns = dict[str, NDArray[Any]]
Lines = dict[float, list[NDArray[np.float64]]]  # by vibration angle

UNCERTAIN = "not precise or not steady"
BISTABLE = "bistable-or-slow"  # the outcome


def read_campaign(path: pathlib.Path) -> tuple[Columns, dict[str, Any]]:
    """Columns of campaign.h5 as arrays, and its root attributes."""
    try:
        with h5py.File(path) as file:
            columns = {
                name: data.asstr()[:] if h5py.check_string_dtype(data.dtype) else data[:] for name, data in file.items()
            }
            return columns, dict(file.attrs)
    except OSError as error:
        raise Problem(f"cannot read {path} ({error}); give a campaign's folder") from error


def read_theory(path: pathlib.Path) -> tuple[Lines, dict[str, Any]]:
    """Lines of the theory: vibration angle in degrees (rounded) -> list of (throw numbers, efficiencies), and their style."""
    points = defaultdict(list)
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = csv.DictReader(file)
            fine = "velocity_efficiency" in (rows.fieldnames or [])
            for row in rows:
                key = (row["vibration_angle_deg"], row.get("inclination_deg"), row.get("friction"))
                value = row["velocity_efficiency" if fine else "efficiency_theory"]
                points[key].append((float(row["throw_number"]), float(value) if value else math.nan))
    except (OSError, KeyError, ValueError) as error:
        raise Problem(f"cannot use {path} as a theory curve ({error!r}); see --help for its columns") from error
    lines = defaultdict(list)
    for key, pairs in points.items():
        lines[same_angle(float(key[0]))].append(np.array(sorted(pairs)).T)
    return lines, {"linewidth": 1.6} if fine else {"linewidth": 0.8, "marker": "x", "markersize": 5}


def read_rolling_layer(path: pathlib.Path) -> Lines:
    """Lines of the rolling-layer law by vibration angle, of a fine curve that has them; NaN where the law was not tested."""
    points = defaultdict(list)
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            value = row.get("rolling_layer_efficiency")
            key = (row["vibration_angle_deg"], row.get("inclination_deg"), row.get("friction"))
            points[key].append((float(row["throw_number"]), float(value) if value else math.nan))
    lines = defaultdict(list)
    for key, pairs in points.items():
        curve = np.array(sorted(pairs)).T
        if np.isfinite(curve[1]).any():
            lines[same_angle(float(key[0]))].append(curve)
    return lines


def rotates(columns: Columns) -> bool:
    """Whether any case has grains that rotate freely, of which the rolling-layer law speaks."""
    return "free" in columns.get("grain_rotation", np.array([]))


def same_angle(degrees: float) -> float:
    """Angles that differ only by rounding are one."""
    return round(degrees, 4)


def series_of(columns: Columns) -> dict[str, list[int]]:
    """What the cases differ in besides throw number and vibration angle, for the legend: rows -> label."""
    shown = {name: (form, factor) for name, (_, form, _, factor) in INPUTS.items() if name != "vibration_angle"}
    varied = [name for name in shown if len(np.unique(columns[name][np.isfinite(columns[name])])) > 1]
    groups = defaultdict(list)
    for row in range(len(columns["case"])):
        groups[tuple(columns[name][row] for name in varied)].append(row)
    return {
        ", ".join(shown[name][0].format(shown[name][1] * value) for name, value in zip(varied, key)): rows
        for key, rows in sorted(groups.items())
    }


def draw(axes: Axes, columns: Columns, theory: Lines, style: dict[str, Any], rolling: Lines) -> None:
    angles = np.array([same_angle(angle) for angle in np.degrees(columns["vibration_angle"])])
    every_angle = sorted(set(angles) | set(theory))
    for index, angle in enumerate(every_angle):
        colour, dash = COLOURS[index % len(COLOURS)], DASHES[index % len(DASHES)]
        for throw_number, efficiency in theory.get(angle, []):
            axes.plot(throw_number, efficiency, color=colour, linestyle=dash, **style)
        for throw_number, efficiency in rolling.get(angle, []):
            axes.plot(throw_number, efficiency, color=colour, linestyle=dash, linewidth=0.8, alpha=0.7)
        for number, (label, rows) in enumerate(series_of(columns).items()):
            rows = [row for row in rows if angles[row] == angle]
            if not rows:
                continue
            rows.sort(key=lambda row: columns["throw_number"][row])
            name = f"\u03b2 = {angle:.3g}\u00b0"
            axes.errorbar(
                columns["throw_number"][rows],
                columns["efficiency"][rows],
                yerr=columns["efficiency_half_width"][rows],
                color=colour,
                marker=MARKERS[(index + number) % len(MARKERS)],
                markerfacecolor=colour if number == 0 else "white",
                linestyle="none",
                capsize=3,
                label=f"{name}, {label}" if label else name,
            )


def draw_branches(axes: Axes, columns: Columns) -> list[tuple[float, float]]:
    """Both branches of the cases that are bistable or slow; returns their points. Older campaigns have none."""
    points = []
    for side, marker in (("below", "v"), ("above", "^")):
        efficiency = columns.get(f"efficiency_{side}", np.full(len(columns["case"]), np.nan))
        rows = [row for row, outcome in enumerate(columns["outcome"]) if outcome == BISTABLE and np.isfinite(efficiency[row])]
        if not rows:
            continue
        axes.errorbar(columns["throw_number"][rows], efficiency[rows], yerr=columns[f"efficiency_{side}_half_width"][rows],
                      color="#777777", marker=marker, markerfacecolor="white", linestyle="none", capsize=3,
                      label=f"bistable or slow, from {side}")
        points += [(columns["throw_number"][row], efficiency[row]) for row in rows]
    return points


def mark_uncertain(axes: Axes, columns: Columns, branches: list[tuple[float, float]]) -> None:
    """A ring around every point that is less certain than asked for; cases without a value are counted, not hidden."""
    drawn = np.isfinite(columns["efficiency"])
    rows = [row for row, outcome in enumerate(columns["outcome"]) if outcome != "finished" and drawn[row]]
    points = [(columns["throw_number"][row], columns["efficiency"][row]) for row in rows] + branches
    if points:
        axes.scatter(
            *np.array(points).T,
            s=160,
            facecolors="none",
            edgecolors="#777777",
            label=UNCERTAIN,
            zorder=1,
        )


def label(axes: Axes, columns: Columns, attributes: dict[str, Any], theory: Lines, rolling: Lines) -> None:
    confidence = np.unique(columns["confidence"])
    bars = f"{100 * confidence[0]:.3g} % interval" if len(confidence) == 1 else "confidence interval"
    axes.set_xlabel(THROW_NUMBER)
    axes.set_ylabel(EFFICIENCY)
    axes.axhline(0.0, color="#bbbbbb", linewidth=0.8, zorder=0)
    plain_axes(axes)
    title = f"points: DEM with {bars}" + ("; lines: point-mass theory" if theory else "") + ("; thin: rolling-layer law" if rolling else "")
    # Above the axes, where no point can be mistaken for a part of it; the series first, then the ring.
    handles, names = axes.get_legend_handles_labels()
    order = sorted(range(len(names)), key=lambda index: names[index] == UNCERTAIN)
    axes.legend([handles[index] for index in order], [names[index] for index in order], frameon=False, fontsize=9, title=title,
                title_fontsize=9, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=min(len(names), 3), columnspacing=1.2,
                handletextpad=0.4)
    without = np.count_nonzero(~np.isfinite(columns["efficiency"]))
    corner(axes.figure, attributes, f"{without} of {len(columns['case'])} cases have no mean (not steady or bistable)" if without else "")


def plot_efficiency(directory: pathlib.Path, theory_file: pathlib.Path | None, output: pathlib.Path) -> list[pathlib.Path]:
    """Draws the figure; returns the files."""
    columns, attributes = read_campaign(directory / "campaign.h5")
    if len(columns.get("case", [])) == 0:
        raise Problem(f"{directory / 'campaign.h5'} holds no finished case; run the campaign first")
    theory, style = read_theory(theory_file) if theory_file else ({}, {})
    rolling = read_rolling_layer(theory_file) if theory_file and rotates(columns) else {}
    figure, axes = new_figure()
    draw(axes, columns, theory, style, rolling)
    mark_uncertain(axes, columns, draw_branches(axes, columns))
    label(axes, columns, attributes, theory, rolling)
    figure.tight_layout(rect=(0, 0.02, 1, 1))
    return save(figure, output)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path, metavar="DIR", help="a campaign's folder, with campaign.h5")
    parser.add_argument("--theory", type=pathlib.Path, metavar="FILE.csv", help="theory curve made by vibrotrough")
    parser.add_argument("--output", type=pathlib.Path, metavar="NAME", help="path of the figures without .svg and .png")
    options = parser.parse_args()

    output = options.output or options.directory / "report" / "efficiency"
    for path in plot_efficiency(options.directory, options.theory, output):
        print(path)


if __name__ == "__main__":
    try:
        main()
    except Problem as problem:
        sys.exit(f"plot_campaign.py: {problem}")
