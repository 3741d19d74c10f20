"""The layers of the atlas, in an order of which every beginning fills the domain, and those that judge it."""

import math

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

# Inputs without a dimension and their ranges: those of src/atlas/tables.cpp, as a test of the atlas makes sure.
RANGES = {
    "throw_number": (0.7, 3.2), "tan_vibration_angle": (0.3, 1.0), "tan_inclination": (-0.1, 0.1), "friction": (0.15, 0.6),
    "amplitude": (0.5, 4.0), "depth": (3.0, 6.0), "grain_friction": (0.3, 0.8), "rolling_friction": (0.0, 0.2), "restitution": (0.3, 0.8),
}  # fmt: skip
DIAMETER = 3  # mm, of base.toml
CHUNK = 16  # layers of a campaign
SEED = 20261126  # of the layers that judge, and of the Sobol sequences
# Campaigns of the atlas' own layers: of the additive recurrence, of a Sobol sequence over the whole domain, and of one over the part
# in which the first campaigns left the largest errors, uphill and weakly thrown.
RECURRENCE, WHOLE, UPHILL = 5, 4, 2
UPHILL_PART = {"throw_number": (0.7, 2.2), "tan_inclination": (0.0, 0.1)}


def own_layers(campaign: int) -> NDArray[np.float64]:
    """The layers of a campaign, points of the unit cube."""
    if campaign < RECURRENCE:
        return recurrence(CHUNK, CHUNK * campaign)
    if campaign < RECURRENCE + WHOLE:
        return sobol(WHOLE * CHUNK, SEED)[CHUNK * (campaign - RECURRENCE) :][:CHUNK]
    low, high = (np.array([to_unit(name, UPHILL_PART.get(name, RANGES[name])[end]) for name in RANGES]) for end in (0, 1))
    return low + (high - low) * sobol(UPHILL * CHUNK, SEED + 1)[CHUNK * (campaign - RECURRENCE - WHOLE) :][:CHUNK]


def to_unit(name: str, value: float) -> float:
    low, high = RANGES[name]
    return (value - low) / (high - low)


def sobol(count: int, seed: int) -> NDArray[np.float64]:
    return np.asarray(qmc.Sobol(len(RANGES), seed=seed).random(count))


def recurrence(count: int, start: int) -> NDArray[np.float64]:
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
