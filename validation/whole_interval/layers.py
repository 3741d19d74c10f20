"""The layers of this study: random ones, drawn before anything was simulated, each simulated twice."""

import dataclasses
import random
from typing import Any

SEED, COUNT = 20261124, 40
FIRST = 3       # were simulated in the order in which they were drawn
SIMULATED = 24  # the others of these are those that cost least by the program's own forecast, whatever comes out
BOX = (8, 5)  # length and width of the ordinary box, in diameters: that of `vibrotrough init`
# What the accurate simulation of a layer changes: the modulus that the program chose, and both lengths of the box.
STIFFER, LARGER = 16, 2
ORDINARY_HALF_WIDTH, ACCURATE_HALF_WIDTH = 0.04, 0.02


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
            **self.box(1), "layer.height": f"{self.depth * self.diameter:g} mm", "measure.half_width": ORDINARY_HALF_WIDTH}
        if self.rolling_friction > 0:
            changes |= {"grains.rotation": "rolling", "grains.rolling_friction": self.rolling_friction}
        return changes

    def box(self, factor: int) -> dict[str, Any]:
        """The box `factor` times as long and wide as the ordinary one."""
        return {f"layer.{side}": f"{factor * count * self.diameter:g} mm" for side, count in zip(("length", "width"), BOX)}

    def accurate(self, chosen_modulus: float) -> dict[str, Any]:
        """What the layer changes in base.toml, with numerics nearer to their limits than those that the program chose (Pa)."""
        return {**self.changes(), **self.box(LARGER), "grains.youngs_modulus": f"{STIFFER * chosen_modulus:g} Pa",
                "measure.half_width": ACCURATE_HALF_WIDTH}


def layers() -> list[Layer]:
    """Random layers between 3 and 6 diameters deep: an accurate simulation of a deeper one takes an hour."""
    draw = random.Random(SEED)

    def between(low: float, high: float, digits: int) -> float:
        return round(draw.uniform(low, high), digits)

    drawn = []
    for number in range(1, COUNT + 1):
        diameter = between(2, 4, 1)
        drawn.append(Layer(number, diameter, round(diameter * draw.uniform(0.7, 3), 1), between(3, 6, 1), between(1.1, 3.0, 2),
                           between(0.3, 0.9, 2), between(-0.06, 0.06, 3), between(0.2, 0.55, 2), between(0.3, 0.8, 2),
                           draw.choice([0.0, 0.0, 0.05, 0.2])))
    return drawn
