"""The theory of Sloot & Kruyt (1996), its extensions, and the atlas of simulated layers, for numpy arrays: the same library that the program uses.

    import vibrotrough

    one = vibrotrough.theory.solve(rpm=960, stroke_mm=9.7, vibration_angle_deg=30, friction=0.3)
    print(one.velocity_efficiency, one.conveying_speed, one.mode)       # 0-dimensional arrays; the speed in m/s

    import numpy as np
    throw_number = np.linspace(1, 3, 201)
    friction = np.array([0.2, 0.4])[:, None]
    many = vibrotrough.theory.solve(throw_number=throw_number, tan_vibration_angle=0.5, friction=friction)
    print(many.velocity_efficiency.shape)                               # (2, 201)

Inputs are those of `vibrotrough theory batch`, by name, in the unit that ends the name; numbers or arrays, which numpy spreads over each other: two of them make a map, as above. NaN says that a motion does not have that input. Needed are
one of throw_number, machine_number, frequency_hz and rpm (the last two with an amplitude), one of vibration_angle_deg and tan_vibration_angle, and friction.

A map, with the exact lines between modes:

    grid = vibrotrough.theory.map(x=("throw_number", 1, 3, 201), y=("vibration_angle_deg", 15, 45, 61), friction=0.3)
    print(grid.velocity_efficiency.shape, grid.boundaries.shape)        # (61, 201), and (pieces, 2, 2)

What layers of spheres do, from those that were simulated once for all:

    layer = vibrotrough.theory.atlas(rpm=800, stroke_mm=[8, 9, 10], vibration_angle_deg=30, friction=0.3, grain_diameter_mm=3, layer_height_mm=12)
    print(layer.conveying_speed, layer.conveying_speed_half_width)      # m/s, and half the 95 % interval
    print(layer.inside, layer.outside)                                  # what lies outside of the atlas, by name
"""

from __future__ import annotations

import difflib
import math
import warnings
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

try:
    import vibrotrough._theory as _library
except ImportError as error:
    raise ImportError(f"the compiled theory is missing ({error}); in a checkout of Vibrotrough: pip install --no-build-isolation ./postprocess") from error


# What others call the inputs.
class CoexistingMotion(NamedTuple):
    """One of the motions to which different starts lead."""

    velocity_efficiency: float  #: as of a Solution
    half_width: float  #: of its 95 % confidence interval if it has no period, else 0
    mode: str  #: phases of one period in order; "" if it has none
    period_cycles: int  #: cycles after which it repeats; 0 if it does not
    fraction: float  #: of the starts that lead to it


@dataclass(frozen=True)
class Solution:
    """The long run of many motions, in arrays of one shape."""

    velocity_efficiency: NDArray[np.float64]  #: mean relative velocity over omega r cos(beta); NaN where the rolling-layer law has not been tested
    half_width: NDArray[np.float64]  #: of its 95 % confidence interval where the motion has no period, else 0
    conveying_speed: NDArray[np.float64]  #: m/s; NaN for a motion without amplitude
    period_cycles: NDArray[np.int32]  #: cycles after which the motion repeats; 0 if it does not
    converged: NDArray[np.bool_]  #: whether a period was found
    mode_code: NDArray[np.uint64]  #: a number for each mode; equal modes have equal numbers
    motions: NDArray[np.object_] | None  #: with `starts`: a tuple of CoexistingMotion for each motion, that of the standard start first, empty for extreme inputs; else None
    cpu_seconds: float  #: processor time of all threads within the library

    @property
    def mode(self) -> NDArray[np.str_]:
        """Phases of one period in order: P slides forwards, N backwards, R rests, F flies; P' and N' are slides that start with a landing."""
        return _names_of_modes(self.mode_code)


def solve(*, jobs: int = 0, rolling_layer: bool | Mapping[str, float] = False, accept_untested: bool = False, starts: int = 0, **inputs: ArrayLike) -> Solution:
    """Solves all motions, on `jobs` threads (0: all cores).

    rolling_layer: a layer of grains that roll on the trough in place of a point mass; a mapping replaces constants of its law (torque, dry_torque, spin_inertia, stiffness, damping).
    starts: so many starts of each motion are followed, for example 64, and `motions` says to which motions they lead; 0: the standard start alone, at rest at t = 0.
    accept_untested: also answers where that law has not been tested.
    Warns of numbers that hardly any machine has, with the slip of a unit that would explain them.
    Raises ValueError for a value out of range (with the number of the motion, in the order of the flattened arrays), TypeError for an unknown name.
    """
    columns = _in_base_units(inputs, _library.columns())
    shape = np.broadcast_shapes(*(column.shape for column in columns.values()))
    flat = {name: np.broadcast_to(column, shape).ravel() for name, column in columns.items()}
    _warn_of_unusual(inputs, columns)
    found = _library.solve(flat, int(np.prod(shape)), jobs, _law(rolling_layer), accept_untested, starts)
    arrays = {name: found[name].reshape(shape) for name in ("velocity_efficiency", "half_width", "period_cycles", "converged")}
    scale = found["velocity_scale"].reshape(shape)
    return Solution(**arrays, conveying_speed=np.asarray(arrays["velocity_efficiency"] * scale), mode_code=found["mode"].reshape(shape), motions=_motions(found["motions"], shape) if starts else None, cpu_seconds=found["cpu_seconds"])


@dataclass(frozen=True)
class Map:
    """A grid over two inputs, with the lines between modes. The arrays of points have the shape (len(y), len(x))."""

    x: NDArray[np.float64]  #: values of the first axis, in the unit that ends its name
    y: NDArray[np.float64]  #: values of the second axis
    velocity_efficiency: NDArray[np.float64]  #: as of a Solution
    half_width: NDArray[np.float64]  #: as of a Solution
    period_cycles: NDArray[np.int32]  #: as of a Solution
    converged: NDArray[np.bool_]  #: as of a Solution
    mode_code: NDArray[np.uint64]  #: as of a Solution
    motions: NDArray[np.object_] | None  #: as of a Solution
    boundaries: NDArray[np.float64]  #: pieces of the lines between two modes, of shape (pieces, 2, 2): x and y of both ends
    boundary_modes: NDArray[np.str_]  #: the modes on both sides of each piece, of shape (pieces, 2)
    cpu_seconds: float  #: processor time of all threads for the points

    @property
    def mode(self) -> NDArray[np.str_]:
        """As of a Solution."""
        return _names_of_modes(self.mode_code)


def map(*, x: tuple[str, float, float, int], y: tuple[str, float, float, int], jobs: int = 0, starts: int = 0, boundaries: bool = True,
        rolling_layer: bool | Mapping[str, float] = False, accept_untested: bool = False, **fixed: float) -> Map:  # fmt: skip
    """Solves a grid over two inputs, as 'vibrotrough theory map' does, with the exact lines between modes unless `boundaries` is false.

    x, y: name of an input, first and last value, and how many values; `fixed` has the other inputs. All else is as in solve().
    Raises ValueError for a value out of range, TypeError for an unknown name.
    """
    known = _library.columns()
    numbers = _numbers(fixed)
    axes: list[tuple[str, float, float, int]] = []
    values: list[NDArray[np.float64]] = []
    factors: list[float] = []
    for name, first, last, count in (x, y):
        base, factor = _input_named(name, known)
        if base in numbers or base in (axis[0] for axis in axes):
            raise TypeError(f"{name} is given twice; an axis cannot be fixed as well")
        axes.append((base, first * factor, last * factor, int(count)))
        values.append(first + (last - first) * np.arange(int(count)) / max(int(count) - 1, 1))  # as MapAxis has them, to the last bit
        factors.append(factor)
    _warn_of_unusual([*fixed, x[0], y[0]], {**numbers, **{name: (first, last) for name, first, last, _ in axes}})
    found = _library.map(numbers, *axes, jobs, starts, boundaries, _law(rolling_layer), accept_untested)
    shape = (values[1].size, values[0].size)
    arrays = {name: found[name].reshape(shape) for name in ("velocity_efficiency", "half_width", "period_cycles", "converged")}
    rows = found["boundaries"]
    pieces = np.array([row[:4] for row in rows], dtype=np.float64).reshape(-1, 2, 2) / factors
    modes = np.array([row[4:] for row in rows], dtype=np.str_).reshape(-1, 2)
    return Map(x=values[0], y=values[1], **arrays, mode_code=found["mode"].reshape(shape), motions=_motions(found["motions"], shape) if starts else None, boundaries=pieces, boundary_modes=modes, cpu_seconds=found["cpu_seconds"])


@dataclass(frozen=True)
class AtlasAnswer:
    """What the atlas says of many layers, in arrays of one shape."""

    velocity_efficiency: NDArray[np.float64]  #: of the layer; NaN more than a quarter of a range outside, or where theory or rolling-layer law have no mean speed
    half_width: NDArray[np.float64]  #: of its 95 % interval
    conveying_speed: NDArray[np.float64]  #: m/s
    conveying_speed_half_width: NDArray[np.float64]  #: m/s
    inside: NDArray[np.bool_]  #: whether the layer lies inside of the atlas; outside, numbers are an extrapolation
    outside: NDArray[np.object_]  #: a tuple of names for each layer, those of `atlas_ranges()`, or "theory" without a mean speed
    cpu_seconds: float  #: processor time of all threads within the library


def atlas(*, grain_diameter_mm: ArrayLike, layer_height_mm: ArrayLike | None = None, depth: ArrayLike | None = None, grain_friction: ArrayLike | None = None,
          rolling_friction: ArrayLike | None = None, restitution: ArrayLike | None = None, jobs: int = 0, **inputs: ArrayLike) -> AtlasAnswer:  # fmt: skip
    """What simulated layers say of layers of spheres, as 'vibrotrough predict' does, on `jobs` threads (0: all cores).

    Of `inputs` it takes those of a point mass, as solve() names them, and always an amplitude or a stroke. The spheres have diameters that spread by 0.1.
    layer_height_mm, or depth in diameters of the grains: either; grain_friction: of grain on grain; rolling_friction: coefficient; restitution: of grains and trough.
    What of these four is left out, or NaN, is not known: it is in the middle of its range, and what it may change widens the interval, by its root mean square over the whole atlas.
    Raises ValueError for an impossible value (with the number of the layer, in the order of the flattened arrays), TypeError for an unknown name.
    """
    if depth is not None and layer_height_mm is not None:
        raise TypeError("depth and layer_height_mm are both given; leave one out")
    has = set(_library.atlas_motion_inputs())
    motion = _in_base_units(inputs, {name: column for name, column in _library.columns().items() if column[0] in has})
    diameter = np.asarray(grain_diameter_mm, dtype=np.float64)
    layer = {"grain_diameter": diameter * 1e-3}
    if layer_height_mm is not None:
        with np.errstate(divide="ignore", invalid="ignore"):  # an impossible diameter is named by the library
            layer["depth"] = np.asarray(layer_height_mm, dtype=np.float64) / diameter
    given = {"depth": depth, "grain_friction": grain_friction, "rolling_friction": rolling_friction, "restitution": restitution}
    layer |= {name: np.asarray(values, dtype=np.float64) for name, values in given.items() if values is not None}
    shape = np.broadcast_shapes(*(column.shape for column in (*motion.values(), *layer.values())))
    flat = [{name: np.broadcast_to(column, shape).ravel() for name, column in columns.items()} for columns in (motion, layer)]
    _warn_of_unusual(inputs, motion)
    found = _library.atlas(*flat, int(np.prod(shape)), jobs)
    efficiency, half_width, scale = (found[name].reshape(shape) for name in ("velocity_efficiency", "half_width", "velocity_scale"))
    outside = found["outside"].reshape(shape)
    return AtlasAnswer(efficiency, half_width, np.asarray(efficiency * scale), np.asarray(half_width * scale), np.asarray(outside == 0), _names_outside(outside), found["cpu_seconds"])


def atlas_ranges() -> dict[str, tuple[float, float]]:
    """The inputs of the atlas, without a dimension, with the ends of their ranges. The amplitude is in diameters of the grains, as is the depth."""
    return {name: (low, high) for name, low, high in _library.atlas_ranges()}


def trace(*, samples: int = 721, **inputs: float) -> dict[str, NDArray[np.float64] | NDArray[np.str_]]:
    """The curves of one motion over a period, as 'vibrotrough theory trace' prints them: in SI units where an amplitude is given, else without dimension. `phase` has the letters of Solution.mode."""
    numbers = _numbers(inputs)
    _warn_of_unusual(inputs, numbers)
    columns = _library.trace(numbers, samples)
    return {**columns, "phase": np.array(columns["phase"])}


def quantities(*, bulk_density: float = 0, layer_height: float = 0, layer_width: float = 0, **inputs: float) -> dict[str, tuple[float, str]]:
    """What an engineer needs of one motion, by name: value and unit, as 'vibrotrough theory point' prints them. Mass flow and power need bulk density (kg/m3), height and width of the layer (m)."""
    numbers = _numbers(inputs)
    _warn_of_unusual(inputs, numbers)
    rows: list[tuple[str, float, str]] = _library.quantities(numbers, bulk_density, layer_height, layer_width)
    return {name: (value, unit) for name, value, unit in rows}


def _names_of_modes(mode_code: NDArray[np.uint64]) -> NDArray[np.str_]:
    codes, where = np.unique(mode_code, return_inverse=True)
    return np.array([_library.mode(int(code)) for code in codes])[where].reshape(mode_code.shape)


def _law(rolling_layer: bool | Mapping[str, float]) -> dict[str, float] | None:
    """The constants of the law that are given; None for a point mass."""
    return dict(rolling_layer) if isinstance(rolling_layer, Mapping) else {} if rolling_layer else None


def _warn_of_unusual(names: Iterable[str], inputs: Mapping[str, ArrayLike]) -> None:
    """Looks at both ends of each column, of which a million numbers may be unusual. To be called by what the user calls."""
    given = set(names)
    columns = {name: np.asarray(column, dtype=np.float64) for name, column in inputs.items()}
    if "stroke_mm" in columns:
        columns["amplitude_m"] = columns["stroke_mm"] / 2000
    if "frequency_hz" in columns and "amplitude_m" in columns and "machine_number" not in columns:
        columns["machine_number"] = (2 * math.pi * columns["frequency_hz"]) ** 2 * columns["amplitude_m"] / 9.81
    sentences: dict[str, None] = {}
    for end in (np.fmin.reduce, np.fmax.reduce):
        of = {name: float(end(column, axis=None)) for name, column in columns.items() if column.size > 0}
        beta = math.atan(of["tan_vibration_angle"]) if "tan_vibration_angle" in of else math.radians(of.get("vibration_angle_deg", np.nan))
        frequency, amplitude, machine_number, friction = (of.get(name, np.nan) for name in ("frequency_hz", "amplitude_m", "machine_number", "friction"))
        found = _library.unusual(frequency, amplitude, machine_number, friction, beta, "stroke_mm" in given, "rpm" in given)
        sentences |= dict.fromkeys(found)
    for sentence in sentences:
        warnings.warn(sentence, UserWarning, stacklevel=3)


def _motions(found: list[list[tuple[float, float, str, int, float]]], shape: tuple[int, ...]) -> NDArray[np.object_]:
    motions = np.empty(len(found), dtype=object)
    for i, of_one in enumerate(found):
        motions[i] = tuple(CoexistingMotion(*one) for one in of_one)
    return motions.reshape(shape)


def _names_outside(bits: NDArray[np.uint32]) -> NDArray[np.object_]:
    """Each distinct number of bits becomes one tuple of names."""
    names = [*atlas_ranges(), "theory"]
    numbers, where = np.unique(bits, return_inverse=True)
    tuples = np.empty(len(numbers), dtype=object)
    for i, number in enumerate(numbers):
        tuples[i] = tuple(name for k, name in enumerate(names) if int(number) >> k & 1)
    return tuples[where.ravel()].reshape(bits.shape)


def _input_named(name: str, known: Mapping[str, tuple[str, float]]) -> tuple[str, float]:
    """The input that a name stands for, and what its numbers are multiplied with."""
    if name in known:
        return known[name]
    near = difflib.get_close_matches(name, known, 1)
    raise TypeError(f"{name} is not an input; " + (f"did you mean {near[0]}?" if near else "inputs are " + ", ".join(known)))


def _in_base_units(inputs: Mapping[str, ArrayLike], known: Mapping[str, tuple[str, float]]) -> dict[str, NDArray[np.float64]]:
    columns: dict[str, NDArray[np.float64]] = {}
    given_as: dict[str, str] = {}
    for name, values in inputs.items():
        base, factor = _input_named(name, known)
        if base in columns:
            raise TypeError(f"{given_as[base]} and {name} are both given; leave one out")
        given_as[base] = name
        try:
            columns[base] = np.asarray(values, dtype=np.float64) * factor
        except (TypeError, ValueError):
            raise TypeError(f"{name} takes numbers, in the unit that ends its name, and not {str(values):.60}") from None
    return columns


def _numbers(inputs: Mapping[str, float]) -> dict[str, float]:
    return {name: float(column) for name, column in _in_base_units(inputs, _library.columns()).items()}
