"""Tables of other cases on which the laws are fitted and scored, and the law as `vibrotrough theory --rolling-layer` solves it."""

import math
import pathlib
from collections.abc import Mapping

import numpy as np

from validation_case import Floats, ValidationCase, read_table

INPUTS = ["throw_number", "tan_vibration_angle", "tan_inclination", "friction"]
VALIDATION = pathlib.Path(__file__).resolve().parent.parent
GRAVITY = 9.81

Points = list[tuple[float, float, float, float]]  # INPUTS
Set = tuple[Points, Floats]                       # and the efficiencies of the layers


def level(rung: str) -> Set:
    """The six level cases of a rung of why_theory_fails."""
    rows = [row for row in read_table(VALIDATION / "why_theory_fails/result.csv") if row["rung"] == rung]
    points = [(float(row["throw_number"]), 0.5, 0.0, float(row["friction"])) for row in rows]
    return points, np.array([float(row["efficiency"]) for row in rows])


def paper(low: float, high: float, grains: str) -> Set:
    """Cases of paper_experiment between two throw numbers; the mean over packings where a case is not steady."""
    points, efficiencies = [], []
    for row in read_table(VALIDATION / "paper_experiment/result.csv"):
        if row["grains"] == grains and low <= float(row["throw_number"]) <= high:
            points.append((float(row["throw_number"]), float(row["tan_vibration_angle"]), float(row["tan_inclination"]), 0.23))
            efficiencies.append(float(np.mean([float(value) for value in row["packings"].split()])))
    return points, np.array(efficiencies)


def krakow() -> Set:
    """The nine simulated layers of krakow: 1.25 mm at 30 degrees, 2 degrees uphill."""
    points, efficiencies = [], []
    alpha, beta, amplitude = math.radians(2), math.radians(30), 0.00125
    for row in read_table(VALIDATION / "krakow/result.csv"):
        omega = 2 * math.pi * float(row["revolutions"]) / 60
        gamma = omega**2 * amplitude * math.sin(beta) / (GRAVITY * math.cos(alpha))
        points.append((gamma, math.tan(beta), math.tan(alpha), float(row["friction"])))
        efficiencies.append(float(row["speed_m_per_s"]) / (omega * amplitude * math.cos(beta)))
    return points, np.array(efficiencies)


def sets(blocked: bool) -> dict[str, Set]:
    """The sets of the table in README.md by name; those of layers without rotation for the negative control."""
    grains = "blocked" if blocked else "free"
    return {"level (fit)": level(f"4 deep, {grains}"), "paper, 1.25-3": paper(1.25, 3, grains), "paper, 1.5-2": paper(1.5, 2, grains),
            "paper, 2.5-3": paper(2.5, 3, grains), "paper, < 1": paper(0, 0.99, grains), "krakow": krakow()}


def solve(run: ValidationCase, points: Points, law: Mapping[str, float] | None) -> Floats:
    """The theory's efficiencies, of the point mass or, with constants, of a rolling layer."""
    words = [] if law is None else ["--rolling-layer", ",".join(f"{name}={float(value)!r}" for name, value in law.items())]
    if law is not None and not law:
        words = ["--rolling-layer"]
    return run.efficiencies(INPUTS, points, words + ([] if law is None else ["--accept-untested"]))


def rms(difference: Floats) -> float:
    return float(np.sqrt(np.mean(difference**2)))
