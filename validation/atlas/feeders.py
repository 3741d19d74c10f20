"""A maker's 14 feeders, 1450 cycles per minute with a stroke of 4 to 6 mm, which carry 1.33 to 1.44 times as much on a decline of 10 degrees
(mean 1.40). Neither their angle, which is taken to be 20 to 30 degrees, nor their materials are known: what the atlas says of many."""

import itertools
import math

import numpy as np

import design
import run as atlas
from validation_case import ValidationCase

TURNS = 1450 / 60  # Hz
DECLINE = 10  # degrees
ANGLES, STROKES, FRICTIONS, DIAMETERS = (20, 25, 30), (4, 5, 6), (0.3, 0.4, 0.5), (2, 3, 6)  # degrees, mm, 1, mm
COLUMNS = ["vibration_angle_deg", "stroke_mm", "friction", "diameter_mm", "level", "decline", "ratio"]


def layers(inclination: float) -> design.Columns:
    """All feeders at an inclination (degrees), four diameters deep."""
    angle, stroke, friction, diameter = np.array(list(itertools.product(ANGLES, STROKES, FRICTIONS, DIAMETERS))).T
    beta, alpha, ones = np.radians(angle), math.radians(inclination), np.ones(len(angle))
    throw_number = (2 * math.pi * TURNS) ** 2 * stroke / 2000 * np.sin(beta) / (9.81 * math.cos(alpha))
    numbers = (throw_number, np.tan(beta), math.tan(alpha) * ones, friction, stroke / 2 / diameter, 4 * ones, 0.5 * ones, 0.1 * ones, 0.55 * ones)
    return dict(zip(design.RANGES, numbers, strict=True))


def predict(run: ValidationCase) -> list[list[object]]:
    """Velocity efficiencies of the feeders that lie inside of the atlas; rows of COLUMNS."""
    level, decline = (run.of_file("predict", atlas.campaign_of(run, layers(inclination), {})) for inclination in (0, -DECLINE))
    places = itertools.product(ANGLES, STROKES, FRICTIONS, DIAMETERS)
    return [
        [*place, f"{a['efficiency']:.4f}", f"{b['efficiency']:.4f}", f"{b['efficiency'] / a['efficiency']:.3f}"]
        for place, a, b in zip(places, level, decline, strict=True)
        if a["inside"] and b["inside"]
    ]


def judge(run: ValidationCase) -> None:
    run.follows("feeders.csv", COLUMNS, predict(run))
    ratios = np.array([float(row["ratio"]) for row in run.table("feeders.csv")])
    run.finding("a maker: feeders carry 1.33 to 1.44 times as much on a decline of 10 degrees", bool(1.33 <= np.mean(ratios) <= 1.44),
                f"{np.min(ratios):.2f} to {np.max(ratios):.2f} in {len(ratios)} layers, mean {np.mean(ratios):.2f}")
