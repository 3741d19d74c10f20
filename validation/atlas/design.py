"""The layers of the atlas, in an order of which every beginning fills the domain, and those that judge it."""

import math

import numpy as np
from numpy.typing import NDArray

# Inputs without a dimension and their ranges: those of src/atlas/tables.cpp, as a test of the atlas makes sure.
RANGES = {
    "throw_number": (0.7, 3.2), "tan_vibration_angle": (0.3, 1.0), "tan_inclination": (-0.1, 0.1), "friction": (0.15, 0.6),
    "amplitude": (0.5, 4.0), "depth": (3.0, 6.0), "grain_friction": (0.3, 0.8), "rolling_friction": (0.0, 0.2), "restitution": (0.3, 0.8),
}  # fmt: skip
DIAMETER = 3  # mm, of base.toml
CHUNK = 16  # layers of a campaign
SEED = 20261126  # of the layers that judge


def evenly(count: int, start: int) -> NDArray[np.float64]:
    """Points `start` to `start + count` of the additive recurrence with the generalised golden ratio, in the unit cube
    (M. Roberts, The unreasonable effectiveness of quasirandom sequences, 2018)."""
    dimensions, ratio = len(RANGES), 2.0
    for _ in range(60):
        ratio = (1 + ratio) ** (1 / (dimensions + 1))
    steps = np.array([ratio ** -(k + 1) for k in range(dimensions)])
    return (0.5 + np.outer(np.arange(start + 1, start + count + 1), steps)) % 1


def at_random(count: int) -> NDArray[np.float64]:
    return np.random.default_rng(SEED).random((count, len(RANGES)))


def keys_of(unit: NDArray[np.float64]) -> dict[str, list[str] | list[float]]:
    """{key of the campaign file: its values} of points of the unit cube."""
    columns = {name: low + (high - low) * unit[:, k] for k, (name, (low, high)) in enumerate(RANGES.items())}
    short = {name: [f"{value:.4f}" for value in values] for name, values in columns.items()}
    numbers = {name: [float(value) for value in values] for name, values in short.items()}
    return {
        "trough.throw_number": numbers["throw_number"],
        "trough.tan_vibration_angle": numbers["tan_vibration_angle"],
        "trough.inclination": [f"{math.degrees(math.atan(value)):.4f} deg" for value in columns["tan_inclination"]],
        "trough.friction": numbers["friction"],
        "trough.amplitude": [f"{DIAMETER * value:.4f} mm" for value in columns["amplitude"]],
        "layer.diameters": numbers["depth"],
        "grains.friction": numbers["grain_friction"],
        "grains.rolling_friction": numbers["rolling_friction"],
        "grains.restitution": numbers["restitution"],
        "trough.restitution": numbers["restitution"],
    }
