#!/usr/bin/python3
import math
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(FOLDER), str(FOLDER.parent.parent / "postprocess")]

import numpy as np  # noqa: E402
import scipy.stats  # noqa: E402

import estimate  # noqa: E402
import figure_style  # noqa: E402
import layers  # noqa: E402
import simulate  # noqa: E402
import stored  # noqa: E402
from estimate import ERRORS, Effects, Model  # noqa: E402
from stored import Slope  # noqa: E402
from validation_case import Floats, Row, ValidationCase, read_table  # noqa: E402

# An ordinary simulation of the program: 0.05 wanted, a box of 8 x 5 diameters, 0.2 Rayleigh times; and today's bounds of its errors.
ORDINARY = {"softness": 0.08, "box": 40.0, "step": 0.2}
BOUNDS = {"softness": 4 * 0.08**2, "box": 0.03, "step": 0.01}
SLOPES = ["error", "study", "layer", "throw_number", "depth", "slope", "standard_error"]
EFFECTS = ["layer", "throw_number", "tan_inclination", "depth", "wave_number", "packing_deviation", *(f"{error}{end}" for error in ERRORS for end in ("", "_error", "_size"))]
MODEL = ["error", "throw_from", "throw_to", "layers", "mean", "mean_half_width", "deviation", "deviation_least", "deviation_most", "correction", "half_width", "bound"]


def estimated(run: ValidationCase) -> list[Effects]:
    """The effects of each layer of which all eight simulations are there."""
    by_layer: dict[int, list[Row]] = {}
    for row in run.table("packings.csv"):
        by_layer.setdefault(int(row["layer"]), []).append(row)
    complete = {number: rows for number, rows in by_layer.items() if len({(row["grains"], row["box"], row["step"]) for row in rows}) == len(layers.EIGHT)}
    ratio = estimate.variance_ratio(complete)
    run.follows("scatter.csv", ["quantity", "value"], [["variance in the large box over that in the small one", f"{ratio:.3f}"]])
    pairs = estimate.correlations(complete, list(simulate.WINDOWS))
    run.follows("pairing.csv", ["setting", "cycles", "correlation", "pairs"], [[*key, f"{one:.3f}", count] for key, (one, count) in pairs.items()])
    return [estimate.effects_of(layer, complete[layer.number], ratio) for layer in layers.layers() if layer.number in complete]


def slopes_of(effects: list[Effects]) -> list[Slope]:
    """Of the layers of this study and of those that other studies store."""
    own = [
        Slope(error, "numerics", str(one.layer.number), one.layer.inputs["throw_number"], one.layer.inputs["depth"], one.change[k] / one.size[k], one.error[k] / one.size[k])
        for one in effects
        for k, error in enumerate(ERRORS)
    ]  # fmt: skip
    return own + stored.all_slopes()


def models_of(slopes: list[Slope]) -> dict[str, Model]:
    found = {}
    for error in ERRORS:
        columns = ([getattr(slope, name) for slope in slopes if slope.error == error] for name in ("throw_number", "value", "standard_error"))
        found[error] = estimate.model_of(error, *(np.array(column) for column in columns))
    return found


def write_estimates(run: ValidationCase, effects: list[Effects], slopes: list[Slope], models: dict[str, Model]) -> None:
    rows: list[list[object]] = []
    for one in effects:
        inputs = one.layer.inputs
        numbers = [f"{value:.5f}" for k in range(len(ERRORS)) for value in (one.change[k], one.error[k], one.size[k])]
        rows.append([one.layer.number, inputs["throw_number"], inputs["tan_inclination"], inputs["depth"], f"{one.layer.wave_number:.4f}", f"{one.deviation:.4f}", *numbers])
    run.follows("effects.csv", EFFECTS, rows)
    run.follows("slopes.csv", SLOPES, [[one.error, one.study, one.layer, one.throw_number, one.depth, f"{one.value:.3f}", f"{one.standard_error:.3f}"] for one in slopes])
    rows = []
    for error, model in models.items():
        for k, (low, high) in enumerate(model.ranges):
            numbers = [model.means[k], model.mean_half_widths[k], model.deviation, model.deviation_least, model.deviation_most]
            ordinary = [*model.at(estimate.size_of(error, ORDINARY[error]), low), BOUNDS[error]]
            rows.append([error, low, high, model.layers[k], *(f"{value:.4f}" for value in (*numbers, *ordinary))])
    run.follows("model.csv", MODEL, rows)


def standardised(run: ValidationCase, models: dict[str, Model]) -> Floats:
    """Of each judging layer, the ordinary efficiency less the accurate one less the correction, over the half-width of all of this."""
    if not (FOLDER / "judging.csv").exists():
        return np.array([])
    by_layer: dict[int, dict[str, list[Row]]] = {}
    for row in run.table("judging.csv"):
        by_layer.setdefault(int(row["layer"]), {}).setdefault(row["simulation"], []).append(row)
    complete = [layer for layer in layers.judges() if len(by_layer.get(layer.number, {})) == len(layers.TWO)]
    accurate = [by_layer[layer.number]["accurate"] for layer in complete]
    if run.control:
        accurate = accurate[1:] + accurate[:1]
    return np.array([judged(layer, {**by_layer[layer.number], "accurate": rows}, models) for layer, rows in zip(complete, accurate, strict=True)])


def judged(layer: layers.Layer, rows: dict[str, list[Row]], models: dict[str, Model]) -> float:
    """Difference of both simulations less the correction, over the 95 % half-width of statistics and numerics together."""
    sizes, means, errors, free = [], [], [], []
    for one in layers.TWO:
        packings = rows[one.levels[0]]
        values = [estimate.efficiency(row) for row in packings]
        sizes.append(estimate.sizes_of(layer, one, float(packings[0]["step_over_rayleigh"])))
        means.append(np.mean(values))
        errors.append(np.var(values, ddof=1) / len(values))
        free.append(len(values) - 1)
    welch = sum(errors) ** 2 / sum(error**2 / n for error, n in zip(errors, free, strict=True))
    numerics = [models[error].at(sizes[0][k] - sizes[1][k], layer.inputs["throw_number"]) for k, error in enumerate(ERRORS)]
    statistics = float(scipy.stats.t.ppf(0.975, welch)) * math.sqrt(sum(errors))
    return (float(means[0] - means[1]) - sum(one for one, _ in numerics)) / math.hypot(statistics, *(width for _, width in numerics))


def older_layers(run: ValidationCase, models: dict[str, Model]) -> Floats:
    """Differences of a simulation and a better one that whole_interval stores, over the half-widths that statistics and the model give."""
    found: list[float] = []
    folder = FOLDER.parent / "whole_interval"
    boxes = {"result.csv": {"ordinary": 40.0, "accurate": 160.0}, "deeper.csv": {"coarse": 27.0, "ordinary": 40.0, "accurate": 108.0}}
    for table, areas in boxes.items():
        rows = read_table(folder / table)
        for row, other in zip(rows, rows[1:] + rows[:1], strict=True):
            beside = {**row, **{key: value for key, value in other.items() if run.control and key.startswith("accurate_e")}}
            found += [older(beside, name, areas, models) for name in areas if name != "accurate"]
    return np.array(found)


def older(row: Row, name: str, areas: dict[str, float], models: dict[str, Model]) -> float:
    inputs = {**{key: float(row[key]) for key in ("throw_number", "tan_vibration_angle", "tan_inclination", "depth")}, "amplitude": float(row["amplitude_mm"]) / float(row["diameter_mm"])}
    value, statistics, size = {}, 0.0, {}
    for one in (name, "accurate"):
        value[one], half_width = float(row[f"{one}_efficiency"]), float(row[f"{one}_half_width"])
        statistics = math.hypot(statistics, half_width)
        # s goes with the diameter to the power of 1/3 less than in layers of 3 mm
        wave_number = layers.wave_number(inputs, float(row[f"{one}_modulus_Pa"])) * (float(row["diameter_mm"]) / 3) ** (1 / 3)
        size[one] = [estimate.size_of("softness", wave_number), estimate.size_of("box", areas[one]), 0.2]
    numerics = [models[error].at(size[name][k] - size["accurate"][k], inputs["throw_number"]) for k, error in enumerate(ERRORS)]
    return (value[name] - value["accurate"] - sum(one for one, _ in numerics)) / math.hypot(statistics, *(width for _, width in numerics))


def judge(run: ValidationCase) -> None:
    effects = estimated(run)
    slopes = slopes_of(effects)
    models = models_of(slopes)
    write_estimates(run, effects, slopes, models)
    ratios = older_layers(run, models)
    low = scipy.stats.binom.ppf(0.025, len(ratios), 0.95)
    run.between(f"differences stored by whole_interval within statistics and the model, of {len(ratios)}", int(np.sum(np.abs(ratios) <= 1)), low, len(ratios), because="95 % or more; their intervals are wide")
    ratios = standardised(run, models)
    if len(ratios):
        low, high = scipy.stats.binom.ppf([0.025, 0.975], len(ratios), 0.95)
        run.between(f"judging layers within their intervals, of {len(ratios)}", int(np.sum(np.abs(ratios) <= 1)), low, high, because="central 95 % of the binomial distribution")
        low, high = scipy.stats.chi2.ppf([0.005, 0.995], len(ratios)) / len(ratios)
        run.between("their mean square over what a normal distribution gives", float(np.mean(ratios**2)) * 1.96**2, low, high, because="neither too narrow nor too wide; 99 % of chi-square")
    if not run.control:
        draw(run, slopes, models)


def draw(run: ValidationCase, slopes: list[Slope], models: dict[str, Model]) -> None:
    """The slopes over the throw number, and the means of the model."""
    figure, every = figure_style.plt.subplots(1, 3, figsize=(9, 3), layout="constrained")
    for error, axes in zip(ERRORS, every, strict=True):
        axes.axhline(0, color=figure_style.GREY, linewidth=0.8)
        for own, colour, label in ((True, figure_style.COLOURS[0], "this study"), (False, figure_style.COLOURS[1], "others")):
            chosen = [one for one in slopes if one.error == error and (one.study == "numerics") == own]
            columns = ([getattr(one, name) for one in chosen] for name in ("throw_number", "value", "standard_error"))
            throw, value, width = (np.array(column) for column in columns)
            axes.errorbar(throw, value, 1.96 * width, fmt="o", markersize=4, linewidth=0.8, color=colour, label=label)
        for (low, high), mean in zip(models[error].ranges, models[error].means, strict=True):
            axes.plot([max(low, 0.7), min(high, 3.2)], [mean, mean], color=figure_style.GREY)
        axes.set(title=error, xlabel="throw number")
        figure_style.plain_axes(axes)
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
