"""The three numerical errors of a layer from its packings, and over layers their mean and what differs from layer to layer."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.optimize
import scipy.stats

from layers import BOXES, EIGHT, Layer, Simulation
from validation_case import Floats

Row = Mapping[str, str]
ERRORS = ("softness", "box", "step")


def size_of(error: str, setting: float) -> float:
    """The number without a dimension that an error is in proportion to: s^2, with the wave number s; the root of d^2 over the area of
    the box; the time step over the Rayleigh time of the smallest grain."""
    return {"softness": setting**2, "box": setting**-0.5, "step": setting}[error]


def area(box: tuple[float, float]) -> float:
    """In squares of the diameter."""
    return box[0] * box[1]


def efficiency(row: Row) -> float:
    """Mean over the cycles that count."""
    return (float(row["first"]) + float(row["second"])) / 2


@dataclass(frozen=True)
class Effects:
    """What the coarse settings of one layer change: in the order of ERRORS."""

    layer: Layer
    change: Floats  # of the efficiency
    error: Floats  # standard errors of these
    size: Floats  # of the coarse setting less that of the accurate one
    deviation: float  # of one packing in the small box
    free: int


def sizes_of(layer: Layer, one: Simulation, fraction: float) -> list[float]:
    """Of one simulation. @param fraction  of the Rayleigh time that its step really is"""
    return [size_of("softness", one.wave_number(layer)), size_of("box", area(one.box)), size_of("step", fraction)]


def design_of(rows: Sequence[Row]) -> Floats:
    """Columns of a linear model: mean, start from above, and the coarse settings, each from -1/2 to 1/2."""
    return np.array([[1, int(row["packing"]) % 2 - 0.5, *((row[key] == level) - 0.5 for key, level in COARSE)] for row in rows])


COARSE = (("grains", "soft"), ("box", "small"), ("step", "coarse"))


def fitted(rows: Sequence[Row], large: float) -> tuple[Floats, Floats, Floats]:
    """Coefficients, their covariance but for the variance, and the residuals. @param large  variance in the large box over that in the small one"""
    weights = np.array([1 / large if row["box"] == "large" else 1 for row in rows])
    model, values = design_of(rows), np.array([efficiency(row) for row in rows])
    inverse = np.linalg.inv(model.T @ (weights[:, None] * model))
    found = inverse @ model.T @ (weights * values)
    return found, inverse, values - model @ found


def variance_ratio(by_layer: Mapping[int, Sequence[Row]]) -> float:
    """The variance of packings in the large box over that in the small one, of all layers together: each box is fitted by itself."""
    found = {}
    for box in BOXES:
        squares, free = 0.0, 0
        for every in by_layer.values():
            rows = [row for row in every if row["box"] == box]
            model = design_of(rows)[:, [0, 1, 2, 4]]
            _, rest, rank, _ = np.linalg.lstsq(model, np.array([efficiency(row) for row in rows]), rcond=None)
            squares, free = squares + float(rest[0]), free + len(rows) - int(rank)
        found[box] = squares / free
    return found["large"] / found["small"]


def effects_of(layer: Layer, rows: Sequence[Row], large: float) -> Effects:
    found, inverse, rest = fitted(rows, large)
    weights = np.array([1 / large if row["box"] == "large" else 1 for row in rows])
    free = len(rows) - len(found)
    variance = float(np.sum(weights * rest**2)) / free
    by_levels = {one.levels: one for one in EIGHT}
    every = np.array([sizes_of(layer, by_levels[row["grains"], row["box"], row["step"]], float(row["step_over_rayleigh"])) for row in rows])
    size = [np.mean(every[[row[key] == level for row in rows], k]) - np.mean(every[[row[key] != level for row in rows], k]) for k, (key, level) in enumerate(COARSE)]
    return Effects(layer, found[2:], np.sqrt(variance * np.diag(inverse)[2:]), np.array(size), math.sqrt(variance), free)


@dataclass(frozen=True)
class Model:
    """An error is (mean + deviation * a number of the layer) * size. The mean is that of the range of throw numbers; with 95 % intervals."""

    ranges: tuple[tuple[float, float], ...]
    layers: tuple[int, ...]  # of each range
    means: Floats
    mean_half_widths: Floats
    deviation: float
    deviation_least: float
    deviation_most: float
    quantile: float  # Student's, of layers less means

    def at(self, size: float, throw_number: float) -> tuple[float, float]:
        """The correction, which is zero where the mean is not significant, and the half-width (95 %) of what is left of a new layer's error."""
        place = next(k for k, (low, high) in enumerate(self.ranges) if low <= throw_number < high)
        mean, half_width = float(self.means[place]), float(self.mean_half_widths[place])
        corrected = abs(mean) > half_width
        left = 0.0 if corrected else mean
        return (mean * size if corrected else 0.0), self.quantile * abs(size) * math.sqrt(self.deviation**2 + (half_width / self.quantile) ** 2 + left**2)


RANGES: dict[str, tuple[tuple[float, float], ...]] = {  # of throw numbers, over which the mean differs; those of softness from the layers of deep_layers
    "softness": ((0, 1.75), (1.75, 2.65), (2.65, math.inf)), "box": ((0, math.inf),), "step": ((0, math.inf),),
}  # fmt: skip


def model_of(error: str, throw_numbers: Floats, slopes: Floats, errors: Floats) -> Model:
    """A random-effects model: the layers' own slopes are normal around the mean of their range, and each is known with its standard error.
    The variance is its mean over the restricted likelihood, all deviations being as likely beforehand, so that few layers do not pretend that
    there is none; its interval is from Cochran's Q (Viechtbauer, Statistics in Medicine 26 (2007) 37-52), the intervals of the means from Student's t with the scatter that is seen (Knapp & Hartung, Statistics in Medicine 22 (2003) 2693-2710)."""
    inside = np.array([[low <= throw < high for low, high in RANGES[error]] for throw in throw_numbers], dtype=float)
    free = len(slopes) - inside.shape[1]

    def means_with(variance: float) -> tuple[Floats, Floats]:
        weights = 1 / (errors**2 + variance)
        return (weights * slopes) @ inside / (weights @ inside), weights

    def scatter(variance: float) -> float:
        means, weights = means_with(variance)
        return float(np.sum(weights * (slopes - inside @ means) ** 2))

    def badness(variance: float) -> float:
        weights = 1 / (errors**2 + variance)
        return scatter(variance) - float(np.sum(np.log(weights))) + float(np.sum(np.log(weights @ inside)))

    most = 100 * float(np.var(slopes) + np.max(errors) ** 2)
    roots = np.linspace(0, math.sqrt(most) / 3, 3000)
    badnesses = np.array([badness(root**2) for root in roots])
    likelihood = np.exp(-(badnesses - badnesses.min()) / 2)
    variance = float(np.sum(likelihood * roots**2) / np.sum(likelihood))
    means, weights = means_with(variance)
    quantile = float(scipy.stats.t.ppf(0.975, free))
    widths = quantile * np.sqrt(max(1.0, scatter(variance) / free) / (weights @ inside))
    least, largest = (root_of(lambda v, q=q: scatter(v) - float(scipy.stats.chi2.ppf(q, free)), most) for q in (0.975, 0.025))
    return Model(RANGES[error], tuple(int(n) for n in inside.sum(axis=0)), means, widths, math.sqrt(variance), least, largest, quantile)


def root_of(falling: Callable[[float], float], most: float) -> float:
    """The root of where a falling function of a variance is zero; zero where it begins below."""
    if falling(0) <= 0:
        return 0.0
    return math.sqrt(float(scipy.optimize.brentq(falling, 0, most))) if falling(most) < 0 else math.inf


def correlations(by_layer: Mapping[int, Sequence[Row]], windows: Sequence[str]) -> dict[tuple[str, str], tuple[float, int]]:
    """{(setting, window): correlation of packings of the small box that differ in one setting, and the number of pairs of
    differences}. Packings 1 and 3 start alike, and so do 2 and 4: their difference is free of the means of the simulations."""
    found: dict[tuple[str, str], tuple[float, int]] = {}
    for setting, others in (("grains", "step"), ("step", "grains")):
        for window in windows:
            pairs = []
            for rows in by_layer.values():
                value = {(row[setting], row[others], int(row["packing"])): float(row[window]) for row in rows if row["box"] == "small"}
                levels, fixed = ({key[k] for key in value} for k in (0, 1))
                pairs += [[value[level, other, first] - value[level, other, first + 2] for level in sorted(levels)] for other in fixed for first in (1, 2)]
            one, two = np.array(pairs).T
            found[setting, window] = float(np.sum(one * two) / math.sqrt(np.sum(one**2) * np.sum(two**2))), len(pairs)
    return found
