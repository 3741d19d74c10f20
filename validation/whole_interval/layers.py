"""The layers of this study: random ones, drawn before anything was simulated, each simulated two or three times."""

import dataclasses
import math
import random
from collections.abc import Callable
from typing import Any

SEED, COUNT = 20261124, 40
FIRST = 3       # were simulated in the order in which they were drawn
SIMULATED = 24  # the others of these are those that cost least by the program's own forecast, whatever comes out
BOX = (8, 5)  # length and width of the ordinary box, in diameters: that of `vibrotrough init`
# What the accurate simulation of a layer changes: the modulus that the program chose, and both lengths of the box.
STIFFER, LARGER = 16, 2
ORDINARY_HALF_WIDTH, ACCURATE_HALF_WIDTH = 0.04, 0.02

# The deeper layers, which judge the tightened bound of the box: three simulations of each. `coarse` has a quarter of the modulus that the
# program chose for `ordinary`, `accurate` four times as much: 16 times the modulus and twice both lengths of the box of `coarse`.
DEEPER_SEED, DEEPER_COUNT = 20261125, 24
SHALLOWEST, DEEPEST = 4, 12  # diameters
COARSE_BOX, ACCURATE_BOX = (6, 4.5), (12, 9)
COARSER, FINER = 1 / 4, 4
DEEPER_HALF_WIDTH = 0.05


@dataclasses.dataclass(frozen=True)
class Layer:
    """A layer. Diameter and amplitude in mm."""

    number: int
    diameter: float
    amplitude: float
    depth: float  # in diameters
    throw_number: float
    tan_vibration_angle: float
    tan_inclination: float
    friction: float
    grain_friction: float
    rolling_friction: float

    def changes(self) -> dict[str, Any]:
        """What the layer changes in base.toml, with the ordinary numerics."""
        changes: dict[str, Any] = {
            "trough.tan_inclination": self.tan_inclination, "trough.amplitude": f"{self.amplitude:g} mm",
            "trough.tan_vibration_angle": self.tan_vibration_angle, "trough.friction": self.friction,
            "grains.diameter": f"{self.diameter:g} mm", "grains.friction": self.grain_friction,
            **self.box(BOX), "layer.height": f"{self.depth * self.diameter:g} mm", "measure.half_width": ORDINARY_HALF_WIDTH}
        if self.rolling_friction > 0:
            changes |= {"grains.rotation": "rolling", "grains.rolling_friction": self.rolling_friction}
        return changes

    def box(self, diameters: tuple[float, float]) -> dict[str, Any]:
        """A box of this length and width, in diameters."""
        return {f"layer.{side}": f"{count * self.diameter:g} mm" for side, count in zip(("length", "width"), diameters)}

    def accurate(self, chosen_modulus: float) -> dict[str, Any]:
        """What the layer changes in base.toml, with numerics nearer to their limits than those that the program chose (Pa)."""
        return self.with_numerics((LARGER * BOX[0], LARGER * BOX[1]), STIFFER * chosen_modulus, ACCURATE_HALF_WIDTH)

    def with_numerics(self, box: tuple[float, float], modulus: float | None, half_width: float) -> dict[str, Any]:
        """What the layer changes in base.toml, with this box (diameters), Young's modulus (Pa; None: the program chooses) and half-width."""
        return {**self.changes(), **self.box(box), "grains.youngs_modulus": f"{modulus:g} Pa" if modulus else None,
                "measure.half_width": half_width}


def layers() -> list[Layer]:
    """Random layers between 3 and 6 diameters deep: an accurate simulation of a deeper one takes an hour."""
    draw = random.Random(SEED)
    return [drawn(draw, number, lambda: round(draw.uniform(3, 6), 1)) for number in range(1, COUNT + 1)]


def deeper_layers() -> list[Layer]:
    """Random layers between 4 and 12 diameters deep, as many between 4 and 7 as between 7 and 12."""
    draw = random.Random(DEEPER_SEED)
    return [drawn(draw, number, lambda: round(math.exp(draw.uniform(math.log(SHALLOWEST), math.log(DEEPEST))), 1))
            for number in range(1, DEEPER_COUNT + 1)]


def drawn(draw: random.Random, number: int, depth: Callable[[], float]) -> Layer:
    """A random layer, of a depth that `depth` draws."""
    def between(low: float, high: float, digits: int) -> float:
        return round(draw.uniform(low, high), digits)

    diameter = between(2, 4, 1)
    return Layer(number, diameter, round(diameter * draw.uniform(0.7, 3), 1), depth(), between(1.1, 3.0, 2),
                 between(0.3, 0.9, 2), between(-0.06, 0.06, 3), between(0.2, 0.55, 2), between(0.3, 0.8, 2),
                 draw.choice([0.0, 0.0, 0.05, 0.2]))
