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
from estimate import ERRORS, Effects, Model  # noqa: E402
from validation_case import Floats, Row, ValidationCase, read_table  # noqa: E402

# An ordinary simulation of the program: 0.05 wanted, a box of 8 x 5 diameters, 0.2 Rayleigh times; and today's bounds of its errors.
ORDINARY = {"softness": 0.08, "box": 40.0, "step": 0.2}
BOUNDS = {"softness": 4 * 0.08**2, "box": 0.03, "step": 0.01}
EFFECTS = ["layer", "throw_number", "tan_inclination", "depth", "wave_number", "packing_deviation", *(f"{error}{end}" for error in ERRORS for end in ("", "_error", "_size"))]
MODEL = ["error", "layers", "mean", "mean_half_width", "significant", "deviation", "deviation_least", "deviation_most", "ordinary_correction", "ordinary_half_width", "ordinary_bound"]


def estimated(run: ValidationCase) -> list[Effects]:
    """The effects of each layer of which all eight simulations are there."""
    by_layer: dict[int, list[Row]] = {}
    for row in run.table("packings.csv"):
        by_layer.setdefault(int(row["layer"]), []).append(row)
    complete = {number: rows for number, rows in by_layer.items() if len({(row["grains"], row["box"], row["step"]) for row in rows}) == len(layers.EIGHT)}
    ratio = estimate.variance_ratio(complete)
    run.follows("scatter.csv", ["ratio", "value"], [["variance in the large box over that in the small one", f"{ratio:.3f}"]])
    run.follows("pairing.csv", ["setting", "cycles", "correlation", "pairs"],
                [[setting, window, f"{one:.3f}", count] for (setting, window), (one, count) in estimate.correlations(complete, list(simulate.WINDOWS)).items()])
    return [estimate.effects_of(layer, complete[layer.number], ratio) for layer in layers.layers() if layer.number in complete]


def models_of(effects: list[Effects]) -> dict[str, Model]:
    return {error: estimate.model_of(*(np.array([getattr(one, name)[k] / one.size[k] for one in effects]) for name in ("change", "error"))) for k, error in enumerate(ERRORS)}


def write_effects(run: ValidationCase, effects: list[Effects]) -> None:
    rows: list[list[object]] = []
    for one in effects:
        inputs = one.layer.inputs
        place = [one.layer.number, inputs["throw_number"], inputs["tan_inclination"], inputs["depth"], f"{one.layer.wave_number:.4f}", f"{one.deviation:.4f}"]
        numbers = [f"{value:.5f}" for k in range(len(ERRORS)) for value in (one.change[k], one.error[k], one.size[k])]
        rows.append([*place, *numbers])
    run.follows("effects.csv", EFFECTS, rows)


def write_model(run: ValidationCase, models: dict[str, Model]) -> None:
    rows: list[list[object]] = []
    for error, model in models.items():
        correction, width = model.at(estimate.size_of(error, ORDINARY[error]))
        spread = [f"{value:.4f}" for value in (model.mean, model.mean_half_width)]
        deviations = [f"{value:.4f}" for value in (model.deviation, model.deviation_least, model.deviation_most)]
        rows.append([error, model.layers, *spread, "yes" if model.is_significant else "no", *deviations, f"{correction:.4f}", f"{width:.4f}", f"{BOUNDS[error]:.4f}"])
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
    numerics = [models[error].at(sizes[0][k] - sizes[1][k]) for k, error in enumerate(ERRORS)]
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
    numerics = [models[error].at(size[name][k] - size["accurate"][k]) for k, error in enumerate(ERRORS)]
    return (value[name] - value["accurate"] - sum(one for one, _ in numerics)) / math.hypot(statistics, *(width for _, width in numerics))


def judge(run: ValidationCase) -> None:
    effects = estimated(run)
    models = models_of(effects)
    write_effects(run, effects)
    write_model(run, models)
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
        draw(run, effects, models)


def draw(run: ValidationCase, effects: list[Effects], models: dict[str, Model]) -> None:
    figure, every = figure_style.plt.subplots(1, 3, figsize=(9, 3), layout="constrained")
    for k, (error, axes) in enumerate(zip(ERRORS, every, strict=True)):
        size, change, width = (np.array([getattr(one, name)[k] for one in effects]) for name in ("size", "change", "error"))
        axes.axhline(0, color=figure_style.GREY, linewidth=0.8)
        axes.errorbar(size, change, 1.96 * width, fmt="o", markersize=4, linewidth=0.8, color=figure_style.COLOURS[k])
        ends = np.array([0, float(np.max(size))])
        axes.plot(ends, models[error].mean * ends, color=figure_style.GREY)
        axes.set(title=error, xlabel="difference of the setting's number")
        figure_style.plain_axes(axes)
    every[0].set_ylabel("change of the velocity efficiency")
    figure.savefig(run.figure("errors.png"), dpi=110)


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        simulate.simulate_all(run)
    judge(run)
    run.finish()


if __name__ == "__main__":
    main()
