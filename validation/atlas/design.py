"""The layers of the atlas, in an order of which every beginning fills the domain, and those that judge it."""

import math

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

# Inputs without a dimension and the ranges of the first layers.
RANGES = {
    "throw_number": (0.7, 3.2), "tan_vibration_angle": (0.3, 1.0), "tan_inclination": (-0.1, 0.1), "friction": (0.15, 0.6),
    "amplitude": (0.5, 4.0), "depth": (3.0, 20.0), "grain_friction": (0.3, 0.8), "rolling_friction": (0.0, 0.2), "restitution": (0.3971, 0.8081),
}  # fmt: skip
DIAMETER = 3  # mm, of base.toml
CHUNK = 16  # layers of a campaign
SEED = 20261126  # of the layers that judge, and of the Sobol sequences
Part = dict[str, tuple[float, float]]  # ranges that differ from RANGES
Columns = dict[str, NDArray[np.float64]]  # values of each input
SHALLOW: Part = {"depth": (3.0, 6.0)}
UPHILL: Part = {**SHALLOW, "throw_number": (0.7, 2.2), "tan_inclination": (0.0, 0.1)}
USUAL: Part = {**SHALLOW, "throw_number": (1.0, 2.4)}
DEEP: Part = {"depth": (6.0, 20.0)}
# Campaigns of the atlas' own layers: of the additive recurrence, then of Sobol sequences, each over a part of the domain: shallow layers
# everywhere, where the first campaigns left the largest errors, and where most troughs run, and deep layers, each of which takes minutes.
RECURRENCE = 5
SEQUENCES: list[tuple[int, Part, int]] = [(4, SHALLOW, SEED), (2, UPHILL, SEED + 1), (4, USUAL, SEED + 3), (2, DEEP, SEED + 2)]  # campaigns, part, seed

# The wider domain, where plants are: the ranges of src/atlas/tables.cpp, but for layers that climb more than 0.1, of which too few are
# simulated. Amplitudes are drawn evenly by their logarithm.
WIDER = {**RANGES, "tan_inclination": (-0.18, 0.18), "amplitude": (0.1, 4.0), "depth": (2.0, 20.0)}
LEAST_GRIP = 0.03  # friction less |tan(inclination)|: without grip a layer slides down ever faster, and has no mean speed
WIDER_SEED = 20261128
DRAWN = 1024  # points of a sequence, from which layers are chosen in their order
NEW: Part = {"depth": (2.0, 6.0)}  # only what lies outside of RANGES
CLIMBING: Part = {"depth": (2.0, 6.0), "throw_number": (0.7, 1.4), "tan_inclination": (0.0, 0.18)}
NEW_DEEP: Part = {"depth": (6.0, 20.0)}  # only what lies outside of RANGES
WIDER_OWN: list[tuple[str, int, Part, int]] = [("new", 4, NEW, WIDER_SEED), ("climbing", 3, CLIMBING, WIDER_SEED + 1), ("new_deep", 2, NEW_DEEP, WIDER_SEED + 2)]
WIDER_RANDOM: list[tuple[str, int, Part, int]] = [("random", 4, NEW, WIDER_SEED + 3), ("random_deep", 1, NEW_DEEP, WIDER_SEED + 4)]  # they judge; no choice rests on them


def wider_campaigns() -> dict[str, Columns]:
    """The layers of each campaign of the wider domain: of Sobol sequences, and random ones."""
    found: dict[str, Columns] = {}
    for name, campaigns, part, seed in WIDER_OWN + WIDER_RANDOM:
        every = wider(CHUNK * campaigns, part, seed, is_random=name.startswith("random"))
        found |= {f"{name}{k}": {key: values[CHUNK * k : CHUNK * (k + 1)] for key, values in every.items()} for k in range(campaigns)}
    return found


def wider(count: int, part: Part, seed: int, is_random: bool) -> Columns:
    """The first layers of a sequence over a part of the wider domain that have grip."""
    unit = np.random.default_rng(seed).random((DRAWN, len(WIDER))) if is_random else sobol(DRAWN, seed)
    columns = {name: low + (high - low) * unit[:, k] for k, (name, (low, high)) in enumerate((WIDER | part).items())}
    least, most = WIDER["amplitude"]
    columns["amplitude"] = least * (most / least) ** ((columns["amplitude"] - least) / (most - least))
    chosen = columns["friction"] >= np.abs(columns["tan_inclination"]) + LEAST_GRIP
    if part is not CLIMBING:
        chosen &= np.any([(columns[name] < low) | (columns[name] > high) for name, (low, high) in RANGES.items()], axis=0)
    return {name: values[chosen][:count] for name, values in columns.items()}


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


def sobol(count: int, seed: int, dimensions: int = len(RANGES)) -> NDArray[np.float64]:
    return np.asarray(qmc.Sobol(dimensions, seed=seed).random(count))


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


def columns_of(unit: NDArray[np.float64]) -> Columns:
    """The inputs at points of the unit cube."""
    return {name: low + (high - low) * unit[:, k] for k, (name, (low, high)) in enumerate(RANGES.items())}


def keys_of(columns: Columns) -> dict[str, list[str] | list[float]]:
    """{key of the campaign file: its values} of layers."""
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
