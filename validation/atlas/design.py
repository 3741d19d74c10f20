"""The layers of the atlas, in an order of which every beginning fills the domain, and those that judge it."""

import math

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

# Inputs without a dimension and their ranges: those of src/atlas/tables.cpp, as a test of the atlas makes sure.
RANGES = {
    "throw_number": (0.7, 3.2), "tan_vibration_angle": (0.3, 1.0), "tan_inclination": (-0.1, 0.1), "friction": (0.15, 0.6),
    "amplitude": (0.5, 4.0), "depth": (3.0, 20.0), "grain_friction": (0.3, 0.8), "rolling_friction": (0.0, 0.2), "restitution": (0.3, 0.8),
}  # fmt: skip
DIAMETER = 3  # mm, of base.toml
CHUNK = 16  # layers of a campaign
SEED = 20261126  # of the layers that judge, and of the Sobol sequences
Part = dict[str, tuple[float, float]]  # ranges that differ from RANGES
SHALLOW: Part = {"depth": (3.0, 6.0)}
UPHILL: Part = {**SHALLOW, "throw_number": (0.7, 2.2), "tan_inclination": (0.0, 0.1)}
USUAL: Part = {**SHALLOW, "throw_number": (1.0, 2.4)}
DEEP: Part = {"depth": (6.0, 20.0)}
# Campaigns of the atlas' own layers: of the additive recurrence, then of Sobol sequences, each over a part of the domain: shallow layers
# everywhere, where the first campaigns left the largest errors, and where most troughs run, and deep layers, each of which takes minutes.
RECURRENCE = 5
SEQUENCES: list[tuple[int, Part, int]] = [(4, SHALLOW, SEED), (2, UPHILL, SEED + 1), (4, USUAL, SEED + 3), (2, DEEP, SEED + 2)]  # campaigns, part, seed


def own_campaigns() -> list[NDArray[np.float64]]:
    """The layers of each campaign, points of the unit cube."""
    found = [within(SHALLOW, recurrence(CHUNK, CHUNK * number)) for number in range(RECURRENCE)]
    for campaigns, part, seed in SEQUENCES:
        found += np.split(within(part, sobol(CHUNK * campaigns, seed)), campaigns)
    return found


def within(part: Part, unit: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points of the unit cube over a part of the domain as points of that over the whole."""
    low, high = (np.array([to_unit(name, part.get(name, RANGES[name])[end]) for name in RANGES]) for end in (0, 1))
    return np.asarray(low + (high - low) * unit)


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


def at_random(count: int, part: Part, seed: int = SEED) -> NDArray[np.float64]:
    return within(part, np.random.default_rng(seed).random((count, len(RANGES))))


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
