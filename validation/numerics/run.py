#!/usr/bin/python3
import dataclasses
import math
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(FOLDER), str(FOLDER.parent.parent / "postprocess")]

import numpy as np  # noqa: E402
import scipy.stats  # noqa: E402

import estimate  # noqa: E402
from vibrotrough.figures import style  # noqa: E402
import layers  # noqa: E402
import simulate  # noqa: E402
import stored  # noqa: E402
from estimate import ERRORS, Evidence, Model  # noqa: E402
from validation_case import Row, ValidationCase  # noqa: E402

# An ordinary simulation of the program: 0.05 wanted, a box of 8 x 5 diameters, 0.2 Rayleigh times; and today's bounds of its errors.
ORDINARY = {"softness": 0.08, "box": 40.0, "step": 0.2}
BOUNDS = {"softness": 4 * 0.08**2, "box": 0.03, "step": 0.01}
STATISTICS = 2.2  # Student's quantile, of about ten packings of a layer less their means
EVIDENCE = ["study", "layer", "throw_number", "depth", "change", "standard_error", *(f"{error}_size" for error in ERRORS)]
MODEL = ["error", "throw_from", "throw_to", "layers", "mean", "mean_half_width", "deviation", "deviation_least", "deviation_most", "correction", "half_width", "bound"]
JUDGED = ["study", "layer", "throw_number", "depth", "change", "correction", "half_width", "statistics", "bound"]


def own_layers(run: ValidationCase) -> list[Evidence]:
    """The layers of this study of which all eight simulations are there."""
    by_layer: dict[int, list[Row]] = {}
    for row in run.table("packings.csv"):
        by_layer.setdefault(int(row["layer"]), []).append(row)
    complete = {number: rows for number, rows in by_layer.items() if len({(row["grains"], row["box"], row["step"]) for row in rows}) == len(layers.EIGHT)}
    ratio = estimate.variance_ratio(complete)
    found = [estimate.effects_of(layer, complete[layer.number], ratio) for layer in layers.layers() if layer.number in complete]
    scatter: list[list[object]] = [["variance in the large box over that in the small one", f"{ratio:.3f}"]]
    scatter += [[f"standard deviation of a packing in the small box, layer {one.layer}, throw number {one.throw_number}", f"{value:.4f}"] for one, value in found]
    run.follows("scatter.csv", ["quantity", "value"], scatter)
    pairs = estimate.correlations(complete, list(simulate.WINDOWS))
    run.follows("pairing.csv", ["setting", "cycles", "correlation", "pairs"], [[*key, f"{one:.3f}", count] for key, (one, count) in pairs.items()])
    return [one for one, _ in found]


def write_evidence(run: ValidationCase, evidence: list[Evidence]) -> None:
    rows: list[list[object]] = []
    for one in evidence:
        for change, error, size in zip(one.change, np.sqrt(np.diag(one.covariance)), one.size, strict=True):
            rows.append([one.study, one.layer, one.throw_number, one.depth, f"{change:.5f}", f"{error:.5f}", *(f"{value:.5f}" for value in size)])
    run.follows("evidence.csv", EVIDENCE, rows)


def write_model(run: ValidationCase, model: Model) -> None:
    rows: list[list[object]] = []
    for place, (error, low, high) in enumerate(estimate.MEANS):
        k = ERRORS.index(error)
        mean = [model.means[place], model.quantile(place) * model.mean_errors[place]]
        ordinary = model.at(error, estimate.size_of(error, ORDINARY[error]), low)
        numbers = [*mean, model.deviations[k], model.least[k], model.most[k], *ordinary, BOUNDS[error]]
        rows.append([error, low, high, int(model.layers[place]), *(f"{value:.4f}" for value in numbers)])
    run.follows("model.csv", MODEL, rows)


def shifted(run: ValidationCase, evidence: list[Evidence]) -> list[Evidence]:
    """In the negative control each layer beside the accurate efficiency of the next one."""
    if not run.control:
        return evidence
    others = evidence[1:] + evidence[:1]
    return [dataclasses.replace(one, change=one.change + one.accurate - other.accurate) for one, other in zip(evidence, others, strict=True)]


def new_layers(run: ValidationCase) -> list[Evidence]:
    """The layers that were simulated to judge."""
    if not (FOLDER / "judging.csv").exists():
        return []
    by_layer: dict[int, dict[str, list[Row]]] = {}
    for row in run.table("judging.csv"):
        by_layer.setdefault(int(row["layer"]), {}).setdefault(row["simulation"], []).append(row)
    return [pair_of(layer, by_layer[layer.number]) for layer in layers.judges() if len(by_layer.get(layer.number, {})) == len(layers.TWO)]


def pair_of(layer: layers.Layer, rows: dict[str, list[Row]]) -> Evidence:
    """The ordinary simulation less the accurate one."""
    means, variances, sizes = [], [], []
    for one in layers.TWO:
        packings = rows[one.levels[0]]
        values = [estimate.efficiency(row) for row in packings]
        means.append(float(np.mean(values)))
        variances.append(float(np.var(values, ddof=1)) / len(values))
        sizes.append(np.array(estimate.sizes_of(layer, one, float(packings[0]["step_over_rayleigh"]))))
    inputs = layer.inputs
    change, variance, size = np.array([means[0] - means[1]]), np.array([[sum(variances)]]), np.array([sizes[0] - sizes[1]])
    return Evidence("judging", str(layer.number), inputs["throw_number"], inputs["depth"], change, variance, size, means[1])


def judged(evidence: list[Evidence], model: Model) -> list[list[float]]:
    """Change, correction, half-widths of statistics with numerics and without, and today's bound, of each change; the numbers of JUDGED."""
    found = []
    for one in evidence:
        for change, variance, size in zip(one.change, np.diag(one.covariance), one.size, strict=True):
            parts = [model.at(error, size[k], one.throw_number) for k, error in enumerate(ERRORS)]
            statistics = STATISTICS * math.sqrt(variance)
            bounds = [BOUNDS[error] * size[k] / estimate.size_of(error, ORDINARY[error]) for k, error in enumerate(ERRORS)]
            found.append([change, sum(one for one, _ in parts), math.hypot(statistics, *(width for _, width in parts)), statistics, math.hypot(statistics, *bounds)])
    return found


def judge(run: ValidationCase) -> None:
    evidence = [*own_layers(run), *stored.known()]
    model = estimate.model_of(evidence)
    write_evidence(run, evidence)
    write_model(run, model)
    groups = {"differences of the layers of whole_interval with even numbers": stored.judging(), "judging layers": new_layers(run)}
    rows: list[list[object]] = []
    for name, chosen in groups.items():
        if not chosen:
            continue
        found = judged(shifted(run, chosen), model)
        ratios = np.array([(change - correction) / width for change, correction, width, _, _ in found])
        low, high = scipy.stats.binom.ppf([0.025, 0.975], len(ratios), 0.95)
        run.between(f"{name} within statistics and the model, of {len(ratios)}", int(np.sum(np.abs(ratios) <= 1)), low, high, because="central 95 % of the binomial distribution")
        low, high = scipy.stats.chi2.ppf([0.005, 0.995], len(ratios)) / len(ratios)
        square = float(np.mean(ratios**2)) * 1.96**2
        run.between(f"mean square of the {name}, over that of a normal distribution", square, low, high, because="central 99 % of chi-square")
        places = [[one.study, one.layer, one.throw_number, one.depth] for one in chosen for _ in one.change]
        rows += [[*place, *(f"{value:.4f}" for value in values)] for place, values in zip(places, found, strict=True)]
    run.follows("judged.csv", JUDGED, rows)
    if not run.control:
        draw(run, evidence, model)


def draw(run: ValidationCase, evidence: list[Evidence], model: Model) -> None:
    """What each error alone changes, over its number, of layers in which only one setting differs; and the means of the model."""
    figure, every = style.plt.subplots(1, 3, figsize=(9, 3), layout="constrained")
    for k, (error, axes) in enumerate(zip(ERRORS, every, strict=True)):
        rows = [
            (one.throw_number, change / size[k], error_of / size[k], one.study == "numerics")
            for one in evidence
            for change, error_of, size in zip(one.change, np.sqrt(np.diag(one.covariance)), one.size, strict=True)
            if size[k] != 0 and np.count_nonzero(size) == 1
        ]  # fmt: skip
        axes.axhline(0, color=style.GREY, linewidth=0.8)
        for own, colour, label in ((True, style.COLOURS[0], "this study"), (False, style.COLOURS[1], "other studies")):
            throw, value, width = np.array([row[:3] for row in rows if row[3] == own]).reshape(-1, 3).T
            axes.errorbar(throw, value, 1.96 * width, fmt="o", markersize=4, linewidth=0.8, color=colour, label=label)
        for (name, low, high), mean in zip(estimate.MEANS, model.means, strict=True):
            if name == error:
                axes.plot([max(low, 0.7), min(high, 3.2)], [mean, mean], color=style.GREY)
        axes.set(title=error, xlabel="throw number")
        style.plain_axes(axes)
    every[0].set_ylabel("error over its number")
    every[0].legend(fontsize=8)
    figure.savefig(run.figure("errors.png"), dpi=110)


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        simulate.simulate_all(run)
    judge(run)
    run.finish()


if __name__ == "__main__":
    main()
