"""Slopes of the three errors from layers of other studies: the efficiency of simulations that differ in one setting."""

import math
import pathlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.stats

from estimate import size_of
from layers import DEEPEST, SOFTEST
from validation_case import Row, read_table

VALIDATION = pathlib.Path(__file__).resolve().parent.parent
LEVEL = 0.9875  # of the half-widths of cases, which are those of 97.5 % (src/measure/README.md)
GRAIN = 3  # mm, of all of these layers


@dataclass(frozen=True)
class Slope:
    """What an error of one layer is in proportion to its number without a dimension."""

    error: str
    study: str
    layer: str
    throw_number: float
    depth: float  # diameters
    value: float
    standard_error: float


@dataclass(frozen=True)
class Point:
    """An efficiency with one of the settings."""

    size: float
    efficiency: float
    standard_error: float


def line(points: Sequence[Point]) -> tuple[float, float]:
    """Slope of the efficiency over the number, and its standard error."""
    model = np.array([[1, point.size] for point in points])
    weights = np.array([point.standard_error**-2 for point in points])
    covariance = np.linalg.inv(model.T @ (weights[:, None] * model))
    found = covariance @ model.T @ (weights * np.array([point.efficiency for point in points]))
    return float(found[1]), math.sqrt(float(covariance[1, 1]))


def standard_error(row: Row, packings: int) -> float:
    return float(row["half_width"]) / float(scipy.stats.t.ppf(LEVEL, packings - 1))


def softness() -> Iterator[Slope]:
    """Layers of deep_layers with all moduli whose wave number is no larger than here, the stiffest among them."""
    folder = VALIDATION / "deep_layers"
    groups: dict[tuple[str, str, str], list[tuple[float, Point]]] = {}
    wave_numbers = {(row["layer"], float(row["throw_number"]), float(row["modulus_MPa"])): float(row["wave_number"]) for row in read_table(folder / "errors.csv")}
    for row in read_table(folder / "grid.csv"):
        layer, throw, modulus = f"{row['grains']}, {row['depth']} d", float(row["throw_number"]), float(row["modulus_MPa"])
        known = [(m, s) for (name, g, m), s in wave_numbers.items() if (name, g) == (layer, throw)]
        if not known or row["outcome"] not in ("finished", "not-precise"):
            continue
        s = known[0][1] * (known[0][0] / modulus) ** (1 / 3)
        if s <= SOFTEST[1]:
            point = Point(size_of("softness", s), float(row["efficiency"]), standard_error(row, int(row["packings"])))
            groups.setdefault((layer, row["throw_number"], row["depth"]), []).append((modulus, point))
    for (layer, throw, depth), points in groups.items():
        if len(points) > 1:
            yield Slope("softness", "deep_layers", layer, float(throw), float(depth), *line([point for _, point in points]))


def boxes() -> Iterator[Slope]:
    """Layers of convergence in boxes of several sizes, and the stiff ones of 12 diameters of deep_layers."""
    groups: dict[str, list[Point]] = {}
    for row in read_table(VALIDATION / "convergence/boxes.csv"):
        groups.setdefault(row["throw_number"], []).append(Point(box_size(row["length"], row["width"]), float(row["efficiency"]), float(row["standard_error"])))
    for throw, points in groups.items():
        yield Slope("box", "convergence", "boxes", float(throw), 4, *line(points))
    rows = read_table(VALIDATION / "convergence/result.csv")
    sides = {"length": lambda value: box_size(value, "18 mm"), "width": lambda value: box_size("36 mm", value)}
    points = [Point(sides[row["variation"]](row["value"]), float(row["efficiency"]), standard_error(row, 4)) for row in rows if row["variation"] in sides]
    yield Slope("box", "convergence", "length and width", 2, 4, *line(points))
    change = size_of("box", 6 * 5) - size_of("box", 20 * 5)
    for row in read_table(VALIDATION / "deep_layers/changes.csv"):
        if row["study"] == "long box" and row["depth"] == "12" and row["modulus_MPa"] == "125":
            yield Slope("box", "deep_layers", "free, 12 d", float(row["throw_number"]), 12, -float(row["change"]) / change, standard_error(row, 4) / change)


def box_size(length: str, width: str) -> float:
    return size_of("box", float(length.removesuffix(" mm")) * float(width.removesuffix(" mm")) / GRAIN**2)


def steps() -> Iterator[Slope]:
    """The layer of convergence."""
    rows = [row for row in read_table(VALIDATION / "convergence/result.csv") if row["variation"] == "time_step" and row["value"] != "0.4"]  # limited to 0.3
    yield Slope("step", "convergence", "time step", 2, 4, *line([Point(float(row["value"]), float(row["efficiency"]), standard_error(row, 4)) for row in rows]))


def all_slopes() -> list[Slope]:
    """Of layers no deeper than those of this study; the others show that its models do not hold for them."""
    return [slope for slope in [*softness(), *boxes(), *steps()] if slope.depth <= DEEPEST]
