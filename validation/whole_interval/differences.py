"""Differences between two simulations of a layer that the studies store, with the program's bounds of the coarser one's numerical errors."""

import dataclasses
import math
import pathlib
from collections.abc import Callable, Iterator, Mapping
from typing import TypeVar

from validation_case import read_table

VALIDATION = pathlib.Path(__file__).resolve().parent.parent
PER_STANDARD_ERROR = 2.36  # t(0.975; 7): boxes.csv has eight packings
CONVERGENCE_BOX, CONVERGENCE_DEPTH = (12, 6), 4  # of validation/convergence, in diameters of 3 mm
DEEP_BOX = (6, 5)  # of validation/deep_layers
WAVE_NUMBERS = (0.11, 0.24)  # which divide the layers of deep_layers into stiff, middling and soft ones

Box = tuple[float, float]
Size = TypeVar("Size")


@dataclasses.dataclass(frozen=True)
class Difference:
    """The velocity efficiency of one simulation less that of a better one."""

    study: str
    difference: float
    statistics: float  # 95 % half-width of the difference
    softness: float  # bound of the program, 0 where both have the same modulus
    box: float  # bound of the program, 0 where both have the same box
    time_step: float = 0

    def bound(self) -> float:
        """The numerical errors together."""
        return math.hypot(self.softness, self.box, self.time_step)

    def is_covered(self, factor: float = 1) -> bool:
        """Whether statistics and bounds together contain it. @param factor of the bound of the box"""
        return abs(self.difference) <= math.hypot(self.statistics, self.softness, factor * self.box, self.time_step)


def softness_bound(wave_number: float) -> float:
    """4 s^2 (section 1 of the README; src/prepare/numerical_errors.hpp)."""
    return 4 * wave_number**2


def box_bound(box: Box, depth: float) -> float:
    """0.03 sqrt(40 d^2 / (L W)), and h / (12 d) times as much for deeper layers (section 1; src/prepare/numerical_errors.hpp)."""
    return 0.03 * math.sqrt(40 / (box[0] * box[1])) * max(1.0, depth / 12)


def between_boxes() -> Iterator[Difference]:
    """Everything but the box alike: convergence and its boxes, deep_layers."""
    means: dict[str, dict[float, tuple[float, float]]] = {"length": {}, "width": {}}
    for row in read_table(VALIDATION / "convergence/result.csv"):
        if row["variation"] in means:
            diameters = float(row["value"].removesuffix(" mm")) / 3
            means[row["variation"]][diameters] = float(row["efficiency"]), float(row["half_width"])
    length, width = CONVERGENCE_BOX
    yield from against_largest("convergence, boxes", means["length"], lambda side: (side, width))
    yield from against_largest("convergence, boxes", means["width"], lambda side: (length, side))
    boxes: dict[str, dict[Box, tuple[float, float]]] = {}
    for row in read_table(VALIDATION / "convergence/boxes.csv"):
        sides = float(row["length"].removesuffix(" mm")) / 3, float(row["width"].removesuffix(" mm")) / 3
        boxes.setdefault(row["throw_number"], {})[sides] = float(row["efficiency"]), PER_STANDARD_ERROR * float(row["standard_error"])
    for by_box in boxes.values():
        yield from against_largest("convergence, boxes", by_box, lambda box: box)
    for row in read_table(VALIDATION / "deep_layers/changes.csv"):
        if row["study"] == "long box":
            depth = float(row["depth"])
            yield Difference("deep_layers, boxes", -float(row["change"]), float(row["half_width"]), 0, box_bound(DEEP_BOX, depth))


def against_largest(study: str, means: Mapping[Size, tuple[float, float]],
                    box: Callable[[Size], Box]) -> Iterator[Difference]:
    """Each box against the largest."""
    largest = max(means, key=lambda size: math.prod(box(size)))
    limit, limit_width = means[largest]
    for size, (efficiency, half_width) in means.items():
        if size != largest:
            yield Difference(study, efficiency - limit, math.hypot(half_width, limit_width), 0, box_bound(box(size), CONVERGENCE_DEPTH))


def between_moduli() -> Iterator[Difference]:
    """Everything but the modulus alike: the grid and the judging layers of deep_layers, in groups of the wave number."""
    for row in read_table(VALIDATION / "deep_layers/errors.csv"):
        wave_number = float(row["wave_number"])
        group = sum(wave_number >= limit for limit in WAVE_NUMBERS)
        name = (f"below {WAVE_NUMBERS[0]}", f"{WAVE_NUMBERS[0]} to {WAVE_NUMBERS[1]}", f"from {WAVE_NUMBERS[1]}")[group]
        yield Difference(f"deep_layers, moduli, s {name}", float(row["error"]), float(row["half_width"]), softness_bound(wave_number), 0)
