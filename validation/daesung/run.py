#!/usr/bin/python3
import math
import pathlib
import sys

import numpy as np

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

from figure_style import COLOURS, MARKERS, new_figure, plain_axes  # noqa: E402
from validation_case import Floats, ValidationCase  # noqa: E402

GRAVITY = 9.81
FREQUENCY = 600 / 60  # Hz, of the maker's example
RULE = 3.81 * 600 * 0.010  # m/min
PRACTICE = (0.7 * RULE, 0.8 * RULE)
ANGLES, FRICTIONS = np.arange(20, 41, 2.5), (0.2, 0.3, 0.4, 0.5, 0.6)
COLUMNS = ["throw_number", "tan_vibration_angle", "friction"]


def speeds(run: ValidationCase, amplitude: float, words: list[str]) -> Floats:
    """Conveying speeds in m/min on a level trough, by angle (rows) and friction."""
    omega = 2 * math.pi * FREQUENCY
    beta = np.radians(ANGLES)
    gamma = omega**2 * amplitude * np.sin(beta) / GRAVITY
    points = [(gamma[i], math.tan(beta[i]), friction) for i in range(len(beta)) for friction in FRICTIONS]
    eta = run.efficiencies(COLUMNS, points, words).reshape(len(beta), len(FRICTIONS))
    return np.asarray(60 * eta * omega * amplitude * np.cos(beta)[:, None])


def rank_correlation(a: list[float], b: list[float]) -> float:
    def ranks(values: list[float]) -> Floats:
        array = np.array(values)
        return np.array([np.sum(array < value) + (np.sum(array == value) - 1) / 2 for value in values])

    return float(np.corrcoef(ranks(a), ranks(b))[0, 1])


def draw(run: ValidationCase, point: Floats, rolling: Floats, measured: list[float]) -> None:
    figure, axes = new_figure(size=(7.2, 4.2))
    for name, values, colour, marker in (("point mass", point, 6, 0), ("rolling-layer law", rolling, 1, 1)):
        axes.fill_between(ANGLES, values.min(axis=1), values.max(axis=1), color=COLOURS[colour], alpha=0.25, label=f"{name}, mu 0.2 to 0.6")
        axes.plot(ANGLES, values[:, 1], color=COLOURS[colour], marker=MARKERS[marker], ms=4, label=f"{name}, mu 0.3")
    axes.axhline(RULE, color=COLOURS[0], label="the maker's rule")
    axes.axhspan(*PRACTICE, color=COLOURS[0], alpha=0.2, label="70 to 80 % of it")
    axes.plot(np.full(len(measured), ANGLES[-1] + 1.5), measured, "_", color=COLOURS[2], ms=12, label="pilot table (drive not stated)")
    axes.set(xlabel="vibration angle, degrees (not stated)", ylabel="conveying speed, m/min", ylim=(0, 32))
    plain_axes(axes)
    axes.legend(frameon=False, fontsize=8, ncols=2, loc="lower left")
    figure.tight_layout()
    figure.savefig(run.output / "daesung.png", dpi=110)


def main() -> None:
    run = ValidationCase(FOLDER)
    amplitude = 0.005 if run.control else 0.010
    point, rolling = speeds(run, amplitude, []), speeds(run, amplitude, ["--rolling-layer", "--accept-untested"])
    for name, value in zip(("lower", "upper"), PRACTICE):
        run.between(f"{name} end of the practice range over the fastest point mass", value / float(point.max()), 0, 1,
                    "600 per minute, 10 mm, angles of 20 to 40 degrees, friction of 0.2 to 0.6, level")
    stroke = speeds(run, 0.005, [])
    run.finding("Daesung: 10 mm in v = 3.81 N S is the stroke", float(stroke.max()) >= PRACTICE[0],
                f"with an amplitude of 5 mm no angle and friction gives more than {stroke.max():.1f} m/min, the rule {RULE:.1f} and the practice {PRACTICE[0]:.1f} to {PRACTICE[1]:.1f}")
    reached = [float(values.max()) >= RULE for values in (point, rolling)]
    run.finding("Daesung: v = 3.81 N S (22.9 m/min at 600 per minute and an amplitude of 10 mm)", True if all(reached) else None,
                f"point mass {point.min():.1f} to {point.max():.1f}, rolling-layer law {rolling.min():.1f} to {rolling.max():.1f} m/min, angle and friction not stated")
    rows = [row for row in run.reference() if row["size"]]
    speed = [(float(row["slowest"]) + float(row["fastest"])) / 2 for row in run.reference()]
    sized = [(float(row["slowest"]) + float(row["fastest"])) / 2 for row in rows]
    by_depth = rank_correlation([float(row["depth"]) for row in run.reference()], speed)
    by_size = rank_correlation([float(row["size"]) for row in rows], sized)
    likely = 0.5  # two-sided 95 % for 17 ranks is 0.49
    run.finding("The theory and the law: neither depth nor grain size changes the speed (ranking of the pilot table)",
                None if max(abs(by_depth), abs(by_size)) < likely else False,
                f"rank correlation of speed with depth {by_depth:+.2f}, with grain size {by_size:+.2f}; beyond 0.5 it is not chance (17 materials)")
    draw(run, point, rolling, speed)
    run.finish()


if __name__ == "__main__":
    main()
