"""The error of a model over regions of throw number, slope and depth."""

import dataclasses
import math

THROW_NUMBERS = (0.5, 1.25, 1.75, 2.1, 3.0)  # edges; the last belongs to the last region
SLOPES = (-0.1, -0.02, 0.02, 0.1)            # tan(alpha): downhill, level, uphill
DEPTHS = (2, 5, 16)                          # diameters of a grain
FEWEST = 2                                   # layers
COLUMNS = ["throw_number_from", "throw_number_to", "tan_inclination_from", "tan_inclination_to", "depth_from", "depth_to", "layers", "mean",
           "rms", "largest", "sd"]


@dataclasses.dataclass(frozen=True)
class Miss:
    """A simulated layer: where it is, and its velocity efficiency less the model's."""

    source: str
    throw_number: float
    tan_inclination: float
    depth: float
    error: float


Box = tuple[float, float, float, float, float, float]


@dataclasses.dataclass(frozen=True)
class Error:
    """What a model misses within a box of throw number, tan(alpha) and depth."""

    box: Box
    layers: int
    mean: float
    rms: float
    largest: float

    @property
    def sd(self) -> float:
        """The standard deviation of the normal error whose central 95 % is that of Student's t with the rms of so few layers.

        The quantile of Student's t: Abramowitz and Stegun, Handbook of Mathematical Functions, 26.7.5; to 1 % for two layers.
        """
        n = self.layers
        return self.rms * (1.960 + 2.372 / n + 2.82 / n**2 + 2.56 / n**3 + 1.59 / n**4) / 1.960

    def cells(self) -> list[object]:
        return [*self.box, self.layers, *(f"{value:.3f}" for value in (self.mean, self.rms, self.largest, self.sd))]


def _part(value: float, edges: tuple[float, ...]) -> tuple[float, float] | None:
    if value == edges[-1]:
        return edges[-2], edges[-1]
    return next(((low, high) for low, high in zip(edges, edges[1:]) if low <= value < high), None)


def box_of(miss: Miss) -> Box | None:
    """The box in which a layer lies; None outside of all."""
    parts = [_part(miss.throw_number, THROW_NUMBERS), _part(miss.tan_inclination, SLOPES), _part(miss.depth, DEPTHS)]
    if None in parts:
        return None
    (a, b), (c, d), (e, f) = (part for part in parts if part is not None)
    return a, b, c, d, e, f


def errors(misses: list[Miss]) -> list[Error]:
    """The errors of the boxes that hold enough layers, in order."""
    found: dict[Box, list[float]] = {}
    for miss in misses:
        box = box_of(miss)
        if box is not None:
            found.setdefault(box, []).append(miss.error)
    return [Error(box, len(all_), sum(all_) / len(all_), math.sqrt(sum(e * e for e in all_) / len(all_)), max(all_, key=abs))
            for box, all_ in sorted(found.items()) if len(all_) >= FEWEST]


def at(known: list[Error], miss: Miss) -> Error | None:
    return next((error for error in known if error.box == box_of(miss)), None)
