"""The layers of this study: the grid on which the criterion is found, and the layers that judge it."""

import dataclasses
import random
from typing import Any

MODULI_MPA = [2, 8, 32, 125, 500]
DEPTHS_MM = [9, 18, 36, 60]  # 3, 6, 12 and 20 diameters
DEEP_MM = [36, 60]           # those that are simulated with the stiffest grains, too
THROW_NUMBERS = [1.5, 2.0, 2.4, 2.9]
GRAINS: dict[str, dict[str, Any]] = {
    "free": {},
    "rolling": {"grains.rotation": "rolling", "grains.rolling_friction": 0.2},
}
# A box as long as the layer is deep, and the time step that is the program's default.
LONG_BOX = {"12": "36 mm", "20": "60 mm"}
SHORT_STEP = 0.2

HELD_OUT_SEED, HELD_OUT_LAYERS = 20261123, 8
HELD_OUT_MODULI_MPA = [4, 16, 250]  # the last one stands for stiff grains


@dataclasses.dataclass(frozen=True)
class Layer:
    """A layer that judges the criterion. Lengths in mm."""

    name: str
    diameter: float
    amplitude: float
    depth: float  # in diameters
    throw_number: float
    tan_vibration_angle: float
    tan_inclination: float
    friction: float
    grain_friction: float
    rolling_friction: float

    def changes(self, modulus_mpa: float) -> dict[str, Any]:
        """What the layer changes in base.toml."""
        d = self.diameter
        changes: dict[str, Any] = {
            "trough.inclination": None, "trough.tan_inclination": self.tan_inclination, "trough.amplitude": f"{self.amplitude:g} mm",
            "trough.throw_number": self.throw_number,
            "trough.tan_vibration_angle": self.tan_vibration_angle, "trough.friction": self.friction,
            "grains.diameter": f"{d:g} mm", "grains.friction": self.grain_friction, "grains.youngs_modulus": f"{modulus_mpa:g} MPa",
            "layer.length": f"{6 * d:g} mm", "layer.width": f"{5 * d:g} mm", "layer.height": f"{self.depth * d:g} mm"}
        if self.rolling_friction > 0:
            changes |= {"grains.rotation": "rolling", "grains.rolling_friction": self.rolling_friction}
        return changes


# The layer by which the error was found (14 diameters), with its own moduli, of which the last stands for stiff grains.
FOUND = Layer("found", 2, 4.5, 14, 2.38, 0.59, 0.043, 0.51, 0.3, 0.2)
FOUND_MODULI_MPA = [5, 20, 80, 320]


def held_out() -> list[Layer]:
    """Random layers, drawn before anything was simulated."""
    draw = random.Random(HELD_OUT_SEED)

    def between(low: float, high: float, digits: int = 3) -> float:
        return round(draw.uniform(low, high), digits)

    layers = []
    for number in range(1, HELD_OUT_LAYERS + 1):
        diameter = between(1.5, 4.5, 1)
        layers.append(Layer(f"random {number}", diameter, round(diameter * draw.uniform(1, 3), 1), between(5, 18, 1), between(1.6, 2.8, 2),
                            between(0.35, 0.8, 2), between(-0.05, 0.05), between(0.2, 0.55, 2), between(0.3, 0.7, 2),
                            draw.choice([0.0, 0.0, 0.1, 0.2])))
    return layers
