#!/usr/bin/python3
import math
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import numpy as np  # noqa: E402
from numpy.typing import NDArray  # noqa: E402

from vibrotrough.figures import style  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

FRICTION, RATIO = 0.3, 0.5  # friction; acceleration of the second harmonic over that of the first
PHASES = [0.0, 45.0, 90.0, 130.0, 180.0, 270.0]  # degrees, of the second harmonic
STRENGTHS = [0.5, 1.0, 3.0, 10.0]  # machine numbers K = omega^2 r / g
ROUNDING = 1e-9
COLUMNS = ["throw_number", "vibration_angle_deg", "friction", "inclination_deg", "along_phase_deg", "restitution"]


def horizontal(run: ValidationCase, strength: float, order: int, phase: float) -> float:
    """Velocity efficiency on a level trough that is shaken along itself: its acceleration is -sin(theta) - RATIO sin(order theta + phase)."""
    phase += 40 if run.control else 0
    words = ["--machine-number", strength, "--vibration-angle", "0 deg", "--friction", FRICTION]
    return float(run.json("point", *words, "--harmonic-along", f"{order},{RATIO},{phase} deg")["velocity_efficiency"])


def median_velocity(order: int, phase: float) -> float:
    """The median over a cycle of the trough's velocity over omega r: cos(theta) + RATIO / order cos(order theta + phase)."""
    theta = (np.arange(200000) + 0.5) * (2 * math.pi / 200000)
    return float(np.median(np.cos(theta) + RATIO / order * np.cos(order * theta + math.radians(phase))))


def circular(run: ValidationCase, throw_numbers: NDArray[np.float64], friction: float, inclination: float, phase: float = 90.0,
             restitution: float = 0.0) -> NDArray[np.float64]:
    """Velocity efficiency of a circular drive: equal amplitudes along and normal to the trough."""
    points = [(gamma, 45.0, friction, inclination, phase, restitution) for gamma in throw_numbers]
    return run.efficiencies(COLUMNS, points)


def judge_horizontal(run: ValidationCase) -> None:
    odd = [horizontal(run, strength, 3, phase) for strength in STRENGTHS for phase in PHASES]
    run.between("two frequencies 1 : 3, whose second half cycle is the first one reversed: largest efficiency", max(abs(value) for value in odd), 0, ROUNDING,
                because="what is conveyed in one half is carried back in the other; rounding")
    for strength in STRENGTHS:
        reversed_sum = horizontal(run, strength, 2, 30.0) + horizontal(run, strength, 2, 210.0)
        run.check(f"two frequencies 1 : 2, K = {strength:g}: efficiency, and that of the reversed drive, add up to", reversed_sum, 0, ROUNDING,
                  because="the reversed drive is the mirror image, half a cycle later; rounding")
    for phase in PHASES:
        run.check(f"strong shaking (K = 3000), phase {phase:g} degrees: efficiency", horizontal(run, 3000.0, 2, phase), median_velocity(2, phase), 1e-3,
                  because="friction hardly changes the mass's velocity V within a cycle; it is balanced when the trough is faster than V for half of "
                          "the time. The velocity still changes by mu / K = 1e-4 of the trough's")


def judge_circular(run: ValidationCase) -> None:
    numbers = np.array([0.5, 1.0, 1.5, 2.5, 3.3])
    mirrored = circular(run, numbers, 0.4, 0.0) + circular(run, numbers, 0.4, 0.0, phase=-90.0)
    run.between("circular drive, level: efficiency and that of the opposite sense of rotation add up to, at most", float(np.abs(mirrored).max()), 0, ROUNDING,
                because="the mirror image; rounding")


def minima(values: NDArray[np.float64]) -> list[int]:
    """Indices of the local minima that lie 0.02 or more below both neighbouring maxima."""
    found = []
    for i in range(1, len(values) - 1):
        if values[i] <= values[i - 1] and values[i] < values[i + 1] and max(values[: i + 1]) - values[i] > 0.02 and max(values[i:]) - values[i] > 0.02:
            found.append(i)
    return found


def reversal(run: ValidationCase, friction: float) -> float:
    """The inclination in degrees beyond which a circular drive of throw number 1 conveys backwards."""
    low, high = 0.0, 20.0
    for _ in range(14):
        middle = (low + high) / 2
        forwards = circular(run, np.array([1.0]), friction, middle)[0] > 0
        low, high = (middle, high) if forwards else (low, middle)
    return low


def findings(run: ValidationCase, numbers: NDArray[np.float64], level: NDArray[np.float64], inclined: NDArray[np.float64]) -> None:
    second = [horizontal(run, strength, 2, 90.0) for strength in STRENGTHS]
    run.finding("two frequencies move a body on a laterally shaken surface when the second half cycle is not the first one reversed, and the reversed drive "
                "moves it the other way (Hashemi et al. 2022)", min(abs(value) for value in second) > 0.01,
                "frequencies 1 : 2, phase 90 degrees: " + ", ".join(f"{value:.3f} at K = {strength:g}" for strength, value in zip(STRENGTHS, second))
                + "; 1 : 3: 0 for all phases; reversed drives: the opposite to rounding")
    weak, strong = horizontal(run, 300.0, 2, 90.0), horizontal(run, 3000.0, 2, 90.0)
    kept = horizontal(run, 3000.0, 2, 0.0)
    run.finding("as the oscillation becomes stronger the speed may reach a limit, so that the efficiency vanishes, but a suitable forcing keeps a finite efficiency "
                "(Maza-Cuello & Maza 2024)", abs(10 * strong / weak - 1) < 0.02 and abs(kept) > 0.2,
                f"with a phase of 90 degrees a tenfold acceleration divides the efficiency by {weak / strong:.1f} (K = 300 to 3000), with 0 degrees it is {kept:.3f} at K = 3000; "
                "in the limit the efficiency is the median of the trough's velocity")
    low, high = minima(level), minima(inclined)
    run.finding("a circular drive has optimal and least efficiencies over the throw number, and one more minimum when the trough is inclined (El hor 2017)",
                any(min((abs(i - j) for j in low), default=99) > 20 for i in high),
                f"friction 0.2: minima at {', '.join(f'{numbers[i]:.2f}' for i in low)} on a level trough, at {', '.join(f'{numbers[i]:.2f}' for i in high)} at 3 degrees uphill")
    angles = {mu: reversal(run, mu) for mu in (0.1, 0.2, 0.4)}
    run.finding("beyond an inclination that depends on friction a circular drive conveys backwards (El hor 2017)", len({round(a, 2) for a in angles.values()}) == 3,
                "throw number 1: " + ", ".join(f"{angle:.1f} degrees for friction {mu:g}" for mu, angle in angles.items()))
    back = [float(gamma) for gamma, value in zip(numbers, level) if value < -0.05]
    bead = circular(run, numbers, 0.2, 0.0, restitution=0.8)
    run.finding("on a circular drive a granular layer reverses, a single bead does not (Grochowski et al. 2004; only cited by others, not read)", None,
                f"plastic point mass, friction 0.2: backwards for throw numbers {min(back):.2f} to {max(back):.2f}; with restitution 0.8 the least efficiency is "
                f"{np.nanmin(bead):.2f}")


def draw(run: ValidationCase, numbers: NDArray[np.float64], level: NDArray[np.float64], inclined: NDArray[np.float64]) -> None:
    figure, panels = style.new_figure(1, 2, size=(11, 4.2), layout="constrained")
    strengths = run.drawn(np.geomspace(0.2, 300, 40).tolist())
    for i, phase in enumerate((0.0, 45.0, 90.0)):
        panels[0].semilogx(strengths, [horizontal(run, k, 2, phase) for k in strengths], style.DASHES[i], color=style.COLOURS[i],
                           label=f"phase {phase:g}\u00b0")
        panels[0].axhline(median_velocity(2, phase), color=style.COLOURS[i], lw=0.6)
    panels[0].set(title=f"shaken horizontally, frequencies 1 : 2, \u03bc = {FRICTION}", xlabel="machine number K = \u03c9\u00b2 r / g  [-]",
                  ylabel="speed over \u03c9 r  [-]")
    for i, (values, label) in enumerate(((level, "level"), (inclined, "3\u00b0 uphill"))):
        panels[1].plot(numbers, values, style.DASHES[i], color=style.COLOURS[i], label=label)
    panels[1].set(title="circular drive, \u03bc = 0.2", xlabel=style.THROW_NUMBER, ylabel="velocity efficiency \u03b7  [-]")
    for axes in panels:
        style.plain_axes(axes)
        axes.legend(fontsize=8)
    figure.savefig(run.figure("drives.png"), dpi=110)


def main() -> None:
    run = ValidationCase(FOLDER)
    judge_horizontal(run)
    judge_circular(run)
    if not run.control:
        numbers = np.arange(0.2, 6.0, 0.05)
        level, inclined = circular(run, numbers, 0.2, 0.0), circular(run, numbers, 0.2, 3.0)
        findings(run, numbers, level, inclined)
        draw(run, numbers, level, inclined)
    run.finish()


if __name__ == "__main__":
    main()
