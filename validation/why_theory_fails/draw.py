"""The figure that answers why the theory fails."""

import math
from typing import Protocol

from matplotlib.axes import Axes

import ladder
from vibrotrough.figures.style import plt
from validation_case import ValidationCase

THEORY, BLOCKED, FREE = "#000000", "#0072B2", "#D55E00"  # Okabe and Ito
STEPS = [("theory", None, THEORY), ("rigid block", "block", "#999999"), ("one sphere, no rotation", "grain, blocked", BLOCKED),
         ("layer of spheres, no rotation", "4 deep, blocked", BLOCKED), ("point mass, layer's normal force", "normal force", "#009E73"),
         ("layer of cubes, free rotation", "cubes", "#E69F00"), ("layer of spheres, free rotation", "4 deep, free", FREE)]


class Rungs(Protocol):
    """The measured table by rung and throw number; NaN where there is no number."""

    def number(self, rung: str, gamma: float, column: str = "efficiency") -> float: ...

    def span(self, rung: str, gamma: float) -> tuple[float, float]: ...

    def numbers(self, rung: str) -> list[float]: ...


def theory_line(run: ValidationCase, *options: object) -> list[tuple[float, float]]:
    rows = [(g / 100, run.json("point", "--throw-number", g / 100, "--tan-vibration-angle", 0.5, "--friction", 0.23, *options))
            for g in run.drawn(range(140, 311, 5))]
    return [(gamma, row["velocity_efficiency"]) for gamma, row in rows if row["velocity_efficiency"] is not None]


def theory_with(run: ValidationCase, rungs: Rungs, rung: str, gamma: float) -> float:
    """The theory with the landing friction measured in a layer."""
    friction = max(rungs.number(rung, gamma, "landing_friction"), 0.0)
    return run.json("point", "--throw-number", gamma, "--tan-vibration-angle", 0.5, "--friction", 0.23, "--landing-friction",
                    f"{friction:.6f}")["velocity_efficiency"]


def lines(run: ValidationCase, rungs: Rungs, axes: Axes) -> None:
    plain, smooth = theory_line(run), theory_line(run, "--landing-friction", 0)
    axes.fill_between([g for g, _ in plain], [e for _, e in plain], [e for _, e in smooth], color="#DDDDDD",
                      label="theory, from a landing without friction (top) to μ (bottom)")
    axes.plot(*zip(*plain), color=THEORY, lw=1.5, label="theory")
    for rung, colour, marker in (("4 deep, blocked", BLOCKED, "s"), ("4 deep, free", FREE, "o")):
        numbers = rungs.numbers(rung)
        eta = [rungs.number(rung, g) for g in numbers]
        axes.errorbar(numbers, eta, [rungs.number(rung, g, "half_width") for g in numbers], color=colour, ls="", lw=0.8, alpha=0.5, capsize=3)
        axes.errorbar(numbers, eta, list(zip(*[rungs.span(rung, g) for g in numbers])), color=colour, marker=marker, ls="", lw=3, label=f"simulated layer, rotation {rung.split()[-1]}")
    for rung, colour, marker in (("4 deep, blocked", BLOCKED, "s"), ("4 deep, free", FREE, "o")):
        numbers = rungs.numbers(rung)
        axes.plot(numbers, [theory_with(run, rungs, rung, g) for g in numbers], marker, mfc="none", ms=9, color=colour,
                  label=f"theory, with the landing friction of the layer, rotation {rung.split()[-1]}")
    axes.set(xlabel="throw number Γ", ylabel="velocity efficiency η", ylim=(0, 1.05), xlim=(1.4, 3.1))
    axes.legend(frameon=False, fontsize=8, loc="upper center", bbox_to_anchor=(0.45, -0.14))


def steps(rungs: Rungs, axes: Axes, gamma: float) -> None:
    for place, (_, rung, colour) in enumerate(STEPS):
        if rung is None:
            value, width = rungs.number("4 deep, free", gamma, "efficiency_theory"), 0.0
        elif rung == "normal force":
            value, width = rungs.number("4 deep, free", gamma, "efficiency_by_normal_force"), 0.0
        else:
            value, width = rungs.number(rung, gamma), rungs.number(rung, gamma, "half_width")
            axes.errorbar(value, place, xerr=[[part] for part in rungs.span(rung, gamma)], color="black", lw=3, zorder=3)
        width = 0 if math.isnan(width) else width
        axes.barh(place, value, xerr=width or None, color=colour, height=0.65, error_kw={"capsize": 3, "lw": 0.8})
        if not math.isnan(value):
            axes.text(0.02, place, f"{value:.2f}", va="center", color="white", fontsize=8)
    axes.set_yticks(range(len(STEPS)), [name for name, _, _ in STEPS])
    axes.invert_yaxis()
    axes.set(xlabel="velocity efficiency η", xlim=(0, 1), title=f"Γ = {gamma}")


def figure(run: ValidationCase, rungs: Rungs) -> None:
    drawing, axes = plt.subplots(1, 3, figsize=(13, 4.6), layout="constrained", width_ratios=[1.5, 1, 1])
    lines(run, rungs, axes[0])
    for place, gamma in zip(axes[1:], ladder.PAIR):
        steps(rungs, place, gamma)
    axes[2].set_yticklabels([])
    drawing.savefig(run.figure("ladder.png"), dpi=110)
    plt.close(drawing)
