#!/usr/bin/python3
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Iterable

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import numpy as np  # noqa: E402
import scipy.stats  # noqa: E402

from campaign_program import Row, campaign_text  # noqa: E402
from differences import Difference, between_boxes, between_moduli  # noqa: E402
from vibrotrough.figures.style import COLOURS, plt  # noqa: E402
from layers import (ACCURATE_BOX, ACCURATE_HALF_WIDTH, BOX, COARSE_BOX, COARSER, DEEPER_HALF_WIDTH, FINER, FIRST, SIMULATED,  # noqa: E402
                    Layer, deeper_layers, layers)
from validation_case import Floats, ValidationCase  # noqa: E402

INPUTS = ["diameter_mm", "amplitude_mm", "depth", "throw_number", "tan_vibration_angle", "tan_inclination", "friction", "grain_friction",
          "rolling_friction"]
MEASURED = ["modulus_Pa", "efficiency", "half_width", "packings", "cycles", "outcome"]


SUMMARY = ["layers", "covered", "by_statistics", "mean", "largest", "rms", "rms_bound", "rms_statistics", "least_depth", "most_depth"]


def measured(run: ValidationCase, name: str, row: Row) -> tuple[float, list[object]]:
    """Young's modulus of a case, and MEASURED."""
    scenario = tomllib.loads((run.runs / name / "cases" / row["case"] / "scenario.toml").read_text(encoding="utf-8"))
    modulus = float(str(scenario["grains"]["youngs_modulus"]).removesuffix(" Pa"))
    numbers = [f"{float(row[key] or math.nan):.4f}" for key in ("efficiency", "efficiency_half_width_statistics")]
    return modulus, [f"{modulus:g}", *numbers, row["packings"], row["cycles_measured"], row["outcome"]]


def simulate(run: ValidationCase, layer: Layer) -> list[object]:
    """Both simulations of a layer: a row of result.csv."""
    modulus, ordinary = simulated(run, layer, f"ordinary-{layer.number}", layer.changes())
    _, accurate = simulated(run, layer, f"accurate-{layer.number}", layer.accurate(modulus))
    return [layer.number, *inputs(layer), *ordinary, *accurate]


def simulate_deeper(run: ValidationCase, layer: Layer) -> list[object]:
    """The three simulations of a deeper layer: a row of deeper.csv."""
    modulus, ordinary = simulated(run, layer, f"deeper-{layer.number}", layer.with_numerics(BOX, None, DEEPER_HALF_WIDTH))
    coarse, accurate = (simulated(run, layer, f"{name}-{layer.number}", layer.with_numerics(box, factor * modulus, half_width))[1]
                        for name, box, factor, half_width in (("deeper-coarse", COARSE_BOX, COARSER, DEEPER_HALF_WIDTH),
                                                              ("deeper-accurate", ACCURATE_BOX, FINER, ACCURATE_HALF_WIDTH)))
    return [layer.number, *inputs(layer), *coarse, *ordinary, *accurate]


def simulated(run: ValidationCase, layer: Layer, name: str, changes: dict[str, object]) -> tuple[float, list[object]]:
    """Young's modulus of one simulation, and MEASURED."""
    return measured(run, name, run.campaign(name, changes, {"trough.throw_number": [layer.throw_number]})[0])


def inputs(layer: Layer) -> list[object]:
    """INPUTS of a layer."""
    return [layer.diameter, layer.amplitude, layer.depth, layer.throw_number, layer.tan_vibration_angle, layer.tan_inclination,
            layer.friction, layer.grain_friction, layer.rolling_friction]


def check(run: ValidationCase, changes: dict[str, object], throw_number: float) -> dict[str, float]:
    """What `vibrotrough check` says of a layer before anything is simulated."""
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(campaign_text(run.sections(), changes, {"trough.throw_number": [throw_number]}))
        file.flush()
        answer = subprocess.run([run.program, "check", file.name, "--json"], capture_output=True, text=True, check=False)
    case: dict[str, float] = json.loads(answer.stdout)["cases"][0]
    return case


def cheapest_first(run: ValidationCase, chosen: list[Layer]) -> list[Layer]:
    """In the order of what the program forecasts that they cost."""
    return sorted(chosen, key=lambda layer: check(run, layer.changes(), layer.throw_number)["expected_core_hours"])


def simulations(run: ValidationCase) -> None:
    """The layers that were simulated first, and those that will probably cost least, for result.csv; the deeper ones for deeper.csv.

    The tables are written after each layer: what there is can be judged.
    """
    first = layers()[:FIRST]
    chosen = first + cheapest_first(run, layers()[FIRST:])
    rows = []
    for layer in chosen[:1 if run.quick else SIMULATED]:
        rows.append(simulate(run, layer))
        run.write_table("result.csv", header("ordinary", "accurate"), rows)
    rows = []
    for layer in cheapest_first(run, deeper_layers())[:1 if run.quick else None]:
        rows.append(simulate_deeper(run, layer))
        run.write_table("deeper.csv", header("coarse", "ordinary", "accurate"), rows)


def header(*simulations_of_a_layer: str) -> list[str]:
    return ["layer", *INPUTS, *(f"{simulation}_{name}" for simulation in simulations_of_a_layer for name in MEASURED)]


def least_covered(count: int) -> int:
    """The fewest of so many layers that an interval of 95 % covers in nineteen of twenty studies."""
    return int(scipy.stats.binom.ppf(0.05, count, 0.95))


def draw(run: ValidationCase, differences: Floats, statistics: Floats, bounds: Floats) -> None:
    figure, axes = plt.subplots(figsize=(7, 3.6))
    places = np.arange(len(differences))
    axes.axhline(0, color="#999999", linewidth=0.8)
    axes.errorbar(places, np.zeros(len(places)), yerr=np.hypot(statistics, bounds), color="#bbbbbb", linestyle="none",
                  capsize=4, linewidth=5, label="statistics and numerics of both simulations")
    axes.errorbar(places, np.zeros(len(places)), yerr=statistics, color="#777777", linestyle="none", capsize=4,
                  label="statistics of both simulations")
    axes.plot(places, differences, color=COLOURS[0], marker="o", linestyle="none", label="ordinary less accurate")
    axes.set_xlabel("layer, in the order of the table")
    axes.set_ylabel("velocity efficiency \u03b7  [-]")
    axes.legend(frameon=False, fontsize=8)
    figure.tight_layout()
    figure.savefig(run.figure("intervals.png"), dpi=150)


def judge(run: ValidationCase) -> None:
    """The layers of section 2."""
    rows = run.table("result.csv")
    found = [compared(run, layers()[int(row["layer"]) - 1], row, "ordinary", accurate) for row, accurate in beside_accurate(run, rows)]
    differences, statistics, bounds = (np.array(values) for values in zip(*((one.difference, one.statistics, one.bound()) for one in found)))
    covered, alone = sum(one.is_covered() for one in found), sum(abs(one.difference) <= one.statistics for one in found)
    judged(run, "layers that the whole interval covers", found)
    sizes = [float(np.sqrt(np.mean(values**2))) for values in (differences, bounds, statistics)]
    depths = [float(row["depth"]) for row in rows]
    run.follows("summary.csv", SUMMARY, [[len(rows), covered, alone, f"{np.mean(differences):.4f}", f"{np.max(np.abs(differences)):.4f}",
                                          *(f"{size:.4f}" for size in sizes), f"{min(depths):g}", f"{max(depths):g}"]])
    run.finding("the bounds are not too wide: the whole interval covers at most 98 %", covered <= 0.98 * len(rows), f"{covered} of {len(rows)}")
    run.finding("statistics alone cover less than 93 %", alone < 0.93 * len(rows), f"{alone} of {len(rows)}")
    run.finding("the numerical errors are as large as their bounds: their rms is at least a third of that of the bounds",
                sizes[0] >= sizes[1] / 3, f"rms difference {sizes[0]:.4f}, mean {np.mean(differences):+.4f}, rms bound {sizes[1]:.4f}, "
                f"rms half-width of the statistics of both {sizes[2]:.4f}")
    judge_deeper(run, found)
    if not run.control:
        draw(run, differences, statistics, bounds)


def judge_deeper(run: ValidationCase, shallow: list[Difference]) -> None:
    """The layers of section 4, the choice of a tighter bound of the box, and how often the whole interval holds altogether."""
    rows = run.table("deeper.csv")
    coarse, ordinary = ([compared(run, deeper_layers()[int(row["layer"]) - 1], row, name, accurate) for row, accurate in beside_accurate(run, rows)]
                        for name in ("coarse", "ordinary"))
    judged(run, "deeper layers, coarse: covered", coarse)
    judged(run, "deeper layers, ordinary: covered", ordinary)
    is_odd = [int(row["layer"]) % 2 == 1 for row in rows]
    known = [*between_boxes(), *shallow, *(one for one, odd in zip(coarse + ordinary, is_odd * 2) if odd)]
    factor = next(tenths / 10 for tenths in range(11) if sum(one.is_covered(tenths / 10) for one in known) >= 0.95 * len(known) or tenths == 10)
    others = [one for one, odd in zip(coarse + ordinary, is_odd * 2) if not odd]
    run.finding("the factor of the box's bound that the layers with odd numbers choose holds for those with even numbers",
                sum(one.is_covered(factor) for one in others) >= least_covered(len(others)),
                f"{factor:g}; {sum(one.is_covered(factor) for one in others)} of {len(others)} of the latter")
    groups: dict[str, list[Difference]] = {}
    for one in (*between_moduli(), *between_boxes(), *shallow, *ordinary, *coarse):
        groups.setdefault(one.study, []).append(one)
    everything = [one for group in groups.values() for one in group]
    table = [[study, len(group), sum(one.is_covered() for one in group), sum(abs(one.difference) <= one.statistics for one in group),
              f"{rms(one.difference for one in group):.4f}", f"{rms(one.statistics for one in group):.4f}", f"{rms(one.bound() for one in group):.4f}"]
             for study, group in [*groups.items(), ("all", everything)]]
    run.follows("coverage.csv", ["study", "differences", "covered", "by_statistics", "rms", "rms_statistics", "rms_bound"], table)
    if not run.control:
        share = sum(one.is_covered() for one in everything) / len(everything)
        run.finding("statistics and numerics together cover 93 to 98 % of all differences that are stored", 0.93 <= share <= 0.98,
                    f"{100 * share:.1f} % of {len(everything)}")


def beside_accurate(run: ValidationCase, rows: list[Row]) -> list[tuple[Row, Row]]:
    """Each row with the one that has its accurate simulation: itself, but the next one in the negative control."""
    return list(zip(rows, rows[1:] + rows[:1] if run.control else rows))


def compared(run: ValidationCase, layer: Layer, row: Row, name: str, accurate: Row) -> Difference:
    """A simulation of a layer beside the accurate one, with the program's bounds of its numerical errors."""
    modulus = float(row[f"{name}_modulus_Pa"])
    bounds = check(run, layer.with_numerics(COARSE_BOX if name == "coarse" else BOX, modulus, DEEPER_HALF_WIDTH), layer.throw_number)
    efficiency, half_width = ([float(one[f"{of}_{what}"]) for one, of in ((row, name), (accurate, "accurate"))] for what in ("efficiency", "half_width"))
    study = f"section {2 if 'coarse_efficiency' not in row else 4}, {name}"
    return Difference(study, efficiency[0] - efficiency[1], math.hypot(*half_width), bounds["softness_error"], bounds["box_error"], bounds["time_step_error"])


def judged(run: ValidationCase, what: str, found: list[Difference]) -> None:
    run.between(what, sum(one.is_covered() for one in found), least_covered(len(found)), len(found),
                f"of {len(found)}; 95 % covers fewer in one of twenty studies")


def rms(values: Iterable[float]) -> float:
    return float(np.sqrt(np.mean(np.square(list(values)))))


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        simulations(run)
    judge(run)
    run.finish()


if __name__ == "__main__":
    main()
