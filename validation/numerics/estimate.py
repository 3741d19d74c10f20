"""The three numerical errors of a layer from its packings, and over layers their mean and what differs from layer to layer."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.optimize
import scipy.stats

from layers import BOXES, EIGHT, Layer, Simulation
from validation_case import Floats

Row = Mapping[str, str]
ERRORS = ("softness", "box", "step")


def size_of(error: str, setting: float) -> float:
    """The number without a dimension that an error is in proportion to: s^2, with the wave number s; d^2 over the area of the box; the
    time step over the Rayleigh time of the smallest grain."""
    return {"softness": setting**2, "box": 1 / setting, "step": setting}[error]


def area(box: tuple[float, float]) -> float:
    """In squares of the diameter."""
    return box[0] * box[1]


def efficiency(row: Row) -> float:
    """Mean over the cycles that count."""
    return (float(row["first"]) + float(row["second"])) / 2


@dataclass(frozen=True)
class Evidence:
    """Changes of the efficiency of one layer by coarser settings."""

    study: str
    layer: str
    throw_number: float
    depth: float  # diameters
    change: Floats
    covariance: Floats  # of the statistics of the changes
    size: Floats  # a row for each change: the numbers of ERRORS, of the coarser settings less those of the better ones
    accurate: float = math.nan  # efficiency, of layers that judge


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


def effects_of(layer: Layer, rows: Sequence[Row], large: float) -> tuple[Evidence, float]:
    """What the coarse setting of each error changes, and the standard deviation of a packing in the small box."""
    found, inverse, rest = fitted(rows, large)
    weights = np.array([1 / large if row["box"] == "large" else 1 for row in rows])
    variance = float(np.sum(weights * rest**2)) / (len(rows) - len(found))
    by_levels = {one.levels: one for one in EIGHT}
    every = np.array([sizes_of(layer, by_levels[row["grains"], row["box"], row["step"]], float(row["step_over_rayleigh"])) for row in rows])
    is_coarse = [np.array([row[key] == level for row in rows]) for key, level in COARSE]
    size = [np.mean(every[coarse, k]) - np.mean(every[~coarse, k]) for k, coarse in enumerate(is_coarse)]
    inputs = layer.inputs
    evidence = Evidence("numerics", str(layer.number), inputs["throw_number"], inputs["depth"], found[2:], variance * inverse[2:, 2:], np.diag(size))
    return evidence, math.sqrt(variance)


def correlations(by_layer: Mapping[int, Sequence[Row]], windows: Sequence[str]) -> dict[tuple[str, str], tuple[float, int]]:
    """{(setting, window): correlation of packings of the small box that differ in one setting, and the number of pairs of
    differences}. Packings 1 and 3 start alike, and so do 2 and 4: their difference is free of the means of the simulations."""
    found: dict[tuple[str, str], tuple[float, int]] = {}
    for setting, others in (("grains", "step"), ("step", "grains")):
        for window in windows:
            pairs: list[list[float]] = []
            for rows in by_layer.values():
                value = {(row[setting], row[others], row["packing"]): float(row[window]) for row in rows if row["box"] == "small"}
                levels, fixed_at = (sorted({key[k] for key in value}) for k in (0, 1))
                pairs += [[value[level, other, first] - value[level, other, second] for level in levels] for other in fixed_at for first, second in (("1", "3"), ("2", "4"))]
            one, two = np.array(pairs).T
            found[setting, window] = float(np.sum(one * two) / math.sqrt(np.sum(one**2) * np.sum(two**2))), len(pairs)
    return found


# Ranges of throw numbers over which the mean differs; those of softness from the layers of deep_layers.
RANGES: dict[str, tuple[tuple[float, float], ...]] = {
    "softness": ((0, 1.75), (1.75, 2.65), (2.65, math.inf)), "box": ((0, math.inf),), "step": ((0, math.inf),),
}  # fmt: skip
MEANS = [(error, *limits) for error in ERRORS for limits in RANGES[error]]
LARGEST = {"softness": 6.0, "box": 6.0, "step": 0.3}  # deviations that are thought possible


@dataclass(frozen=True)
class Model:
    """An error is (mean + deviation * a number of the layer) * size: means in the order of MEANS, deviations in that of ERRORS, all with 95 %."""

    layers: Floats  # that tell of each mean
    means: Floats
    mean_errors: Floats  # standard errors
    deviations: Floats
    least: Floats
    most: Floats

    def quantile(self, place: int) -> float:
        """Student's."""
        return float(scipy.stats.t.ppf(0.975, max(1, self.layers[place] - 1)))

    def at(self, error: str, size: float, throw_number: float) -> tuple[float, float]:
        """The correction, which is zero where the mean is not significant, and the half-width (95 %) of what is left of a new layer's error."""
        place = next(k for k, (name, low, high) in enumerate(MEANS) if name == error and low <= throw_number < high)
        mean, uncertainty, quantile = float(self.means[place]), float(self.mean_errors[place]), self.quantile(place)
        is_corrected = abs(mean) > quantile * uncertainty
        left = 0.0 if is_corrected else mean
        return (mean * size if is_corrected else 0.0), quantile * abs(size) * math.sqrt(self.deviations[ERRORS.index(error)] ** 2 + uncertainty**2 + left**2)


def fixed(one: Evidence) -> Floats:
    """The part of each of MEANS in the changes."""
    columns = [one.size[:, ERRORS.index(error)] * (low <= one.throw_number < high) for error, low, high in MEANS]
    return np.array(columns).T


def fit(evidence: Sequence[Evidence], deviations: Floats) -> tuple[float, Floats, Floats]:
    """Twice the negative logarithm of the restricted likelihood of these deviations, and the means with their covariance."""
    count = len(MEANS)
    information, score, squares, volume = np.zeros((count, count)), np.zeros(count), 0.0, 0.0
    for one in evidence:
        spread = (one.size * deviations) @ (one.size * deviations).T + one.covariance
        weighted = np.linalg.solve(spread, np.column_stack([fixed(one), one.change]))
        information += fixed(one).T @ weighted[:, :-1]
        score += fixed(one).T @ weighted[:, -1]
        squares += float(one.change @ weighted[:, -1])
        volume += float(np.linalg.slogdet(spread)[1])
    covariance = np.linalg.inv(information)
    means = covariance @ score
    return squares - float(score @ means) + volume + float(np.linalg.slogdet(information)[1]), means, covariance


def model_of(evidence: Sequence[Evidence]) -> Model:
    """A mixed model: the slopes of the layers are normal around the mean of their range of throw numbers. The variance of each is its
    mean over the restricted likelihood (the others at their most likely values), all deviations being as likely beforehand, so that few
    layers do not pretend that there is none."""
    best = scipy.optimize.minimize(lambda x: fit(evidence, np.abs(x))[0], [LARGEST[error] / 10 for error in ERRORS], method="Nelder-Mead").x
    best = np.abs(best)
    found = []
    for k, error in enumerate(ERRORS):
        roots = np.linspace(0, LARGEST[error], 400)
        badness = np.array([fit(evidence, np.where(np.arange(len(ERRORS)) == k, root, best))[0] for root in roots])
        likelihood = np.exp(-(badness - badness.min()) / 2)
        likelihood /= np.sum(likelihood)
        limits = np.interp([0.025, 0.975], np.cumsum(likelihood), roots)
        found.append([math.sqrt(float(np.sum(likelihood * roots**2))), *limits])
    deviations, least, most = np.array(found).T
    _, means, covariance = fit(evidence, deviations)
    layers = np.sum([np.any(fixed(one) != 0, axis=0) for one in evidence], axis=0)
    return Model(layers, means, np.sqrt(np.diag(covariance)), deviations, least, most)
