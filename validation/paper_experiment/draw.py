"""The figures: Figs 9 and 10 of the paper by simulation, and what the layer looks like across and along."""

import numpy as np
from matplotlib.axes import Axes

from vibrotrough.figures import style
import findings
from campaigns import SLOPES, TANGENTS
from findings import Table, Theory
from validation_case import ValidationCase

WORDS = {"free": "spheres that roll", "blocked": "grains that cannot rotate"}
CURVE = np.round(np.arange(0.5, 3.101, 0.02), 3)


def efficiency(run: ValidationCase, theory: Theory, grid: Table) -> None:
    figure, axes = style.new_figure(2, len(SLOPES), size=(10.5, 8), sharex=True, sharey=True, layout="constrained")
    for column, slope in enumerate(SLOPES):
        curves = {tangent: theory.efficiencies([(slope, tangent, gamma) for gamma in CURVE]) for tangent in TANGENTS}
        for row, grains in enumerate(WORDS):
            panel = axes[row][column]
            style.plain_axes(panel)
            for i, tangent in enumerate(TANGENTS):
                panel.plot(CURVE, curves[tangent], style.DASHES[i], color=style.COLOURS[i], lw=1.2)
                points(panel, grid, grains, slope, tangent, i)
            if row == 0:
                cubes(panel, grid, slope)
                panel.set_title(f"tan α = {slope:+g}  (the paper's Fig. {9 + column})", fontsize=10)
            panel.text(0.98, 0.03, WORDS[grains], transform=panel.transAxes, ha="right", fontsize=10)
    axes[0][0].legend(frameon=False, loc="upper left", title="simulation; lines: theory")
    for panel in axes[1]:
        panel.set_xlabel(style.THROW_NUMBER)
    for line in axes:
        line[0].set(ylabel=style.EFFICIENCY, ylim=(-0.45, 1.3))
    figure.savefig(run.figure("efficiency.png"), dpi=120)


def points(panel: Axes, grid: Table, grains: str, slope: float, tangent: float, i: int) -> None:
    rows = [row for row in grid if row["grains"] == grains and row["tan_inclination"] == slope
            and abs(row["tan_vibration_angle"] - tangent) < 1e-3]
    known = [row for row in rows if row["efficiency"] is not None]
    bars(panel, known, style.MARKERS[i], style.COLOURS[i], f"tan β = {tangent:g}")
    vague = [row for row in rows if row["efficiency"] is None and findings.packings(row)]
    panel.plot([row["throw_number"] for row in vague], [findings.best_known(row) for row in vague], style.MARKERS[i],
               color=style.COLOURS[i], mfc="none", ms=6)


def bars(panel: Axes, rows: Table, marker: str, colour: str, label: str) -> None:
    """Thin: the 95 % interval, wide because of few packings; thick: from the lowest packing's mean to the highest."""
    gamma = [row["throw_number"] for row in rows]
    panel.errorbar(gamma, [row["efficiency"] for row in rows], [row["half_width"] for row in rows], fmt="none", ecolor=colour,
                   alpha=0.35, capsize=2, lw=0.8)
    means = [findings.packings(row) for row in rows]
    panel.vlines(gamma, [min(all_of) for all_of in means], [max(all_of) for all_of in means], color=colour, lw=2.5)
    panel.plot(gamma, [row["efficiency"] for row in rows], marker, color=colour, ms=5, label=label)


def cubes(panel: Axes, grid: Table, slope: float) -> None:
    rows = [row for row in grid if row["grains"] == "cube" and row["tan_inclination"] == slope and row["efficiency"] is not None]
    if rows:
        bars(panel, rows, "X", "black", "cubes, tan β = 0.5")


def layer(run: ValidationCase, walls: Table, waves: Table, surfaces: Table) -> None:
    figure, axes = style.new_figure(1, 3, size=(13, 4), layout="constrained")
    across(axes[0], walls)
    heights(axes[1], waves)
    shapes(axes[2], surfaces, waves)
    for panel in axes:
        style.plain_axes(panel)
    figure.savefig(run.figure("layer.png"), dpi=120)


def across(panel: Axes, walls: Table) -> None:
    for i, (rotation, gamma, wall) in enumerate(findings.profiles(walls)):
        rows = findings.profile_of(walls, rotation, gamma, wall)
        middle = findings.middle_of(walls, rotation, gamma, wall)
        panel.errorbar([(row["from_mm"] + row["to_mm"]) / 2 for row in rows], [row["efficiency"] / middle for row in rows],
                       [2 * row["standard_error"] / abs(middle) for row in rows], marker=style.MARKERS[i], ls=style.DASHES[i],
                       color=style.COLOURS[i], ms=4, lw=1, capsize=2, label=f"Γ = {gamma:g}, {rotation}, wall μ = {wall:g}")
    panel.set(xscale="log", ylim=(0, 1.3), xlabel="distance from the side wall [mm]", ylabel="speed / speed in the middle",
              title="(e) a trough of 200 mm")
    panel.legend(frameon=False, fontsize=8, loc="lower right")


def heights(panel: Axes, waves: Table) -> None:
    gamma = [row["throw_number"] for row in waves]
    panel.plot(gamma, [row["highest_mm"] for row in waves], "o-", color=style.COLOURS[0], label="strongest wave, at its highest [mm]")
    panel.plot(gamma, [row["turnover"] for row in waves], "s--", color=style.COLOURS[1],
               label="its correlation with itself\nthree cycles later [-]")
    panel.axhline(0, color=style.GREY, lw=0.8)
    panel.set(xlabel="throw number Γ [-]", ylim=(-1.3, 4.2), title="(f) waves along 168 mm")
    panel.legend(frameon=False, fontsize=8, loc="upper left")


def shapes(panel: Axes, surfaces: Table, waves: Table) -> None:
    numbers = sorted(row["throw_number"] for row in waves)
    for i, gamma in enumerate(numbers[::4][:2]):
        for snapshot in (0, 1):
            rows = [row for row in surfaces if row["throw_number"] == gamma and row["snapshot"] == snapshot]
            panel.plot([row["x_mm"] for row in rows], [row["deviation_mm"] + 10 * i for row in rows], style.DASHES[snapshot],
                       color=style.COLOURS[i], label=f"Γ = {gamma:g}" + (", three cycles later" if snapshot else ""))
    panel.set(xlabel="along the trough, in the layer's frame [mm]", ylabel="surface less its mean [mm], shifted",
              title="(f) the surface, twice", ylim=(-6, 22))
    panel.legend(frameon=False, fontsize=8, loc="upper left", ncol=2)
