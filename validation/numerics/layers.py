"""The layers of this study, and the simulations of each.

A layer from which the errors are estimated is simulated eight times: with soft or stiff grains, in a small or a large box, with a
coarse or a fine time step. So each error has four pairs that differ in nothing else, and every simulation counts for all three. A layer
that judges the estimates is simulated twice.
"""

import itertools
import math
import pathlib
import sys
from dataclasses import dataclass
from typing import Any

import numpy as np

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "atlas"))

import design  # noqa: E402

SEED = 20261128
COUNT = 24  # points of the Sobol sequence, simulated in the order of what they probably cost
SHALLOWEST, DEEPEST = 3, 6  # diameters, even by the logarithm
LARGEST_AMPLITUDE = 2.5  # diameters: the stroke is shorter than the small box. The layers that judge have the atlas' amplitudes
SOFTEST = (0.09, 0.15)  # wave number of the soft grains, even by the logarithm
LEAST_MODULUS = 2e6  # Pa: softer grains overlap too much in shallow layers
NAMES = [*design.RANGES, "softness"]
GRAVITY, DENSITY, POISSON, SPREAD, SOLID_FRACTION = 9.81, 1400.0, 0.3, 0.1, 0.58  # of base.toml; the last of src/prepare


@dataclass(frozen=True)
class Layer:
    number: int
    inputs: dict[str, float]  # of the atlas
    modulus: float  # Pa, of its softest grains

    @property
    def wave_number(self) -> float:
        """Of its softest grains."""
        return wave_number(self.inputs, self.modulus)


@dataclass(frozen=True)
class Simulation:
    """One of the simulations of a layer."""

    levels: tuple[str, ...]  # names of what it has: of eight, grains, box and step; of two, its only name
    stiffer: float  # times the modulus of soft grains
    box: tuple[float, float]  # length and width in diameters
    fraction: float  # of the Rayleigh time, at most; a tenth of a contact's time is another limit
    packings: int

    def modulus(self, layer: Layer) -> float:
        return layer.modulus * self.stiffer

    def wave_number(self, layer: Layer) -> float:
        return layer.wave_number * self.stiffer ** (-1 / 3)

    def step(self, layer: Layer, seconds: float) -> float:
        """A time step over the Rayleigh time of the smallest grain (src/prepare/time_grid.cpp)."""
        shear_modulus = self.modulus(layer) / (2 * (1 + POISSON))
        radius = (1 - SPREAD) * design.DIAMETER / 2000
        return seconds * (0.1631 * POISSON + 0.8766) / (math.pi * radius * math.sqrt(DENSITY / shear_modulus))

    def keys(self, layer: Layer) -> dict[str, Any]:
        """What it changes in base.toml."""
        length, width = self.box
        return {
            "grains.youngs_modulus": f"{self.modulus(layer):.0f} Pa", "layer.length": f"{length * design.DIAMETER} mm", "layer.width": f"{width * design.DIAMETER} mm",
            "measure.packings": self.packings, "measure.max_packings": self.packings, "solver.rayleigh_fraction": self.fraction,
        }  # fmt: skip


GRAINS = {"soft": 1, "stiff": 8}  # times the modulus of soft grains: half the wave number
BOXES = {"small": ((5, 4.5), 4), "large": ((10, 9), 2)}  # with their packings: the large one costs as much for as narrow a mean
STEPS = {"coarse": 0.4, "fine": 0.1}
EIGHT = [
    Simulation((grains, box, step), GRAINS[grains], *BOXES[box][:1], STEPS[step], BOXES[box][1])
    for grains, box, step in itertools.product(GRAINS, BOXES, STEPS)
]  # fmt: skip

# The layers that judge: an ordinary simulation, as the program makes it for a half-width of 0.05, and an accurate one.
JUDGES, JUDGES_SEED = 32, SEED + 1
ORDINARY_SOFTNESS = (0.08, 0.08)  # wave number
TWO = [Simulation(("ordinary",), 1, (8, 5), 0.2, 8), Simulation(("accurate",), 8, (12, 9), 0.1, 4)]


def wave_number(inputs: dict[str, float], modulus: float) -> float:
    """s = omega h / c of validation/deep_layers: the angle by which the trough moves on while its landing crosses the layer."""
    throw, depth = inputs["throw_number"], inputs["depth"] * design.DIAMETER / 1000
    cosine, sine = math.cos(math.atan(inputs["tan_inclination"])), math.sin(math.atan(inputs["tan_vibration_angle"]))
    omega = math.sqrt(throw * GRAVITY * cosine / (inputs["amplitude"] * design.DIAMETER / 1000 * sine))
    pressure = SOLID_FRACTION * DENSITY * depth * GRAVITY * cosine * (1 + throw) / 2
    speed = (modulus / (2 * (1 - POISSON**2)) / DENSITY) ** (1 / 3) * (pressure / DENSITY) ** (1 / 6)
    return omega * depth / speed


def layers() -> list[Layer]:
    """The layers from which the errors are estimated, in the order in which they are simulated."""
    every = [layer_at(number, list(map(float, point)), SOFTEST, LARGEST_AMPLITUDE) for number, point in enumerate(design.sobol(32, SEED, len(NAMES)))]
    return sorted(every[:COUNT], key=cost)


def cost(layer: Layer) -> float:
    """Of a cycle, but for a factor: the grains, and the steps, which go with the root of the modulus."""
    period = math.sqrt(layer.inputs["amplitude"] * math.sin(math.atan(layer.inputs["tan_vibration_angle"])) / layer.inputs["throw_number"])
    return layer.inputs["depth"] * period * math.sqrt(layer.modulus)


def judges() -> list[Layer]:
    """Random layers, on which no choice rests, in the order in which they are simulated."""
    points = np.random.default_rng(JUDGES_SEED).random((JUDGES, len(NAMES)))
    every = [layer_at(number, list(map(float, point)), ORDINARY_SOFTNESS, design.RANGES["amplitude"][1]) for number, point in enumerate(points)]
    return sorted(every, key=cost)


def layer_at(number: int, point: list[float], softest: tuple[float, float], largest_amplitude: float) -> Layer:
    """A layer at a point of the unit cube."""
    unit = dict(zip(NAMES, point, strict=True))
    inputs = {name: round(low + (high - low) * unit[name], 4) for name, (low, high) in (design.RANGES | {"amplitude": (design.RANGES["amplitude"][0], largest_amplitude)}).items()}
    inputs["depth"] = round(SHALLOWEST * (DEEPEST / SHALLOWEST) ** unit["depth"], 4)
    wanted = softest[0] * (softest[1] / softest[0]) ** unit["softness"]
    modulus = max(LEAST_MODULUS, (wave_number(inputs, 1e6) / wanted) ** 3 * 1e6)  # s goes with E^(-1/3)
    return Layer(number, inputs, float(f"{modulus:.3g}"))


def keys_of(layer: Layer, simulations: list[Simulation]) -> dict[str, list[Any]]:
    """{key: values} of simulations of a layer."""
    columns = {name: np.full(len(simulations), value) for name, value in layer.inputs.items()}
    rows = [one.keys(layer) for one in simulations]
    return {**design.keys_of(columns), **{key: [row[key] for row in rows] for key in rows[0]}}
