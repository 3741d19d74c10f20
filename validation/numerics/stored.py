"""What coarser settings change in the layers of other studies."""

import pathlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.stats

from estimate import ERRORS, Evidence, size_of
from layers import SOFTEST, wave_number
from validation_case import Floats, Row, read_table

VALIDATION = pathlib.Path(__file__).resolve().parent.parent
LEVEL = 0.9875  # of the half-widths of cases, which are those of 97.5 % (src/measure/README.md)
GRAIN = 3  # mm, of all of these layers but those of whole_interval
DEEPEST = 8.5  # diameters, of whole_interval


@dataclass(frozen=True)
class Point:
    """An efficiency with one of the settings: half_width as a case has it."""

    size: float
    efficiency: float
    half_width: float
    packings: int
    area: float = 1

    def scatter(self) -> float:
        """The variance of a packing times the area of its box."""
        return self.packings * self.area * (self.half_width / float(scipy.stats.t.ppf(LEVEL, self.packings - 1))) ** 2


def variances(points: Sequence[Point]) -> Floats:
    """Of the efficiencies. Four packings tell little of how much packings scatter, so that all simulations of a layer tell it
    together; it falls with the area of the box."""
    free = np.array([point.packings - 1 for point in points])
    scatter = float(free @ [point.scatter() for point in points] / np.sum(free))
    return np.array([scatter / point.area / point.packings for point in points])


def slope(error: str, study: str, layer: str, throw_number: float, depth: float, value: float, variance: float) -> Evidence:
    """The change over a difference of 1 of the number of one error."""
    return Evidence(study, layer, throw_number, depth, np.array([value]), np.array([[variance]]), np.array([[float(one == error) for one in ERRORS]]))


def line(points: Sequence[Point]) -> tuple[float, float]:
    """Slope of the efficiency over the number, and its variance."""
    model = np.array([[1, point.size] for point in points])
    weights = 1 / variances(points)
    covariance = np.linalg.inv(model.T @ (weights[:, None] * model))
    found = covariance @ model.T @ (weights * np.array([point.efficiency for point in points]))
    return float(found[1]), float(covariance[1, 1])


def softness() -> Iterator[Evidence]:
    """Layers of deep_layers with all moduli whose wave number is no larger than here, the stiffest among them."""
    folder = VALIDATION / "deep_layers"
    groups: dict[tuple[str, str, str], list[Point]] = {}
    wave_numbers = {(row["layer"], float(row["throw_number"]), float(row["modulus_MPa"])): float(row["wave_number"]) for row in read_table(folder / "errors.csv")}
    for row in read_table(folder / "grid.csv"):
        layer, throw, modulus = f"{row['grains']}, {row['depth']} d", float(row["throw_number"]), float(row["modulus_MPa"])
        known = [(m, s) for (name, g, m), s in wave_numbers.items() if (name, g) == (layer, throw)]
        if not known or row["outcome"] not in ("finished", "not-precise"):
            continue
        s = known[0][1] * (known[0][0] / modulus) ** (1 / 3)
        if s <= SOFTEST[1]:
            point = Point(size_of("softness", s), float(row["efficiency"]), float(row["half_width"]), int(row["packings"]))
            groups.setdefault((layer, row["throw_number"], row["depth"]), []).append(point)
    for (name, throw_number, depth), points in groups.items():
        if len(points) > 1:
            yield slope("softness", "deep_layers", name, float(throw_number), float(depth), *line(points))


def boxes() -> Iterator[Evidence]:
    """Layers of convergence in boxes of several sizes."""
    groups: dict[str, list[Point]] = {}
    for row in read_table(VALIDATION / "convergence/boxes.csv"):
        size, half_width = box_size(row["length"], row["width"]), float(row["standard_error"]) * float(scipy.stats.t.ppf(LEVEL, 7))
        groups.setdefault(row["throw_number"], []).append(Point(size, float(row["efficiency"]), half_width, 8, 1 / size))
    for throw, points in groups.items():
        yield slope("box", "convergence", "boxes", float(throw), 4, *line(points))
    rows = read_table(VALIDATION / "convergence/result.csv")
    sides = {"length": lambda value: box_size(value, "18 mm"), "width": lambda value: box_size("36 mm", value)}
    varied = [(row, sides[row["variation"]](row["value"])) for row in rows if row["variation"] in sides]
    points = [point_of(row, size, 1 / size) for row, size in varied]
    yield slope("box", "convergence", "length and width", 2, 4, *line(points))


def point_of(row: Row, size: float, area: float) -> Point:
    """Of convergence, whose layers have four packings."""
    return Point(size, float(row["efficiency"]), float(row["half_width"]), 4, area)


def box_size(length: str, width: str) -> float:
    return size_of("box", float(length.removesuffix(" mm")) * float(width.removesuffix(" mm")) / GRAIN**2)


def steps() -> Iterator[Evidence]:
    """The layer of convergence."""
    rows = [row for row in read_table(VALIDATION / "convergence/result.csv") if row["variation"] == "time_step" and row["value"] != "0.4"]  # limited to 0.3
    yield slope("step", "convergence", "time step", 2, 4, *line([point_of(row, float(row["value"]), 1) for row in rows]))


AREAS = {"result.csv": {"ordinary": 40, "accurate": 160}, "deeper.csv": {"coarse": 27, "ordinary": 40, "accurate": 108}}  # of whole_interval


def pairs() -> Iterator[tuple[int, Evidence]]:
    """The layers of whole_interval, with their numbers: what the coarser settings change."""
    for table, areas in AREAS.items():
        for row in read_table(VALIDATION / "whole_interval" / table):
            yield int(row["layer"]), pair(table, row, areas)


def pair(table: str, row: Row, areas: dict[str, int]) -> Evidence:
    diameter = float(row["diameter_mm"])
    inputs = {name: float(row[name]) for name in ("throw_number", "tan_vibration_angle", "tan_inclination", "depth")} | {"amplitude": float(row["amplitude_mm"]) / diameter}
    points, sizes = [], []
    for name, area in areas.items():
        efficiency, half_width, packings, modulus = (float(row[f"{name}_{key}"]) for key in ("efficiency", "half_width", "packings", "modulus_Pa"))
        points.append(Point(0, efficiency, half_width, int(packings), area))
        s = wave_number(inputs, modulus) * (diameter / GRAIN) ** (1 / 3)  # it goes with the third root of the diameter
        sizes.append([size_of("softness", s), size_of("box", area), size_of("step", 0.2)])
    count = len(points) - 1
    less_accurate: Floats = np.column_stack([np.eye(count), -np.ones(count)])
    covariance: Floats = less_accurate @ np.diag(variances(points)) @ less_accurate.T
    change: Floats = less_accurate @ np.array([point.efficiency for point in points])
    return Evidence(f"whole_interval, {table}", row["layer"], inputs["throw_number"], inputs["depth"], change, covariance, less_accurate @ np.array(sizes), points[-1].efficiency)


def known() -> list[Evidence]:
    """Layers of 3 to 8 diameters from which the errors are estimated, of whole_interval those with odd numbers."""
    return [*(one for one in [*softness(), *boxes(), *steps()] if one.depth <= DEEPEST), *(one for number, one in pairs() if number % 2 == 1)]


def judging() -> list[Evidence]:
    """The layers of whole_interval with even numbers."""
    return [one for number, one in pairs() if number % 2 == 0]
