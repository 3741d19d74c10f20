#!/usr/bin/python3
import math
import pathlib
import sys
from typing import Any

import numpy as np

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import vibrotrough  # noqa: E402
from campaign_program import Row  # noqa: E402
from vibrotrough.figures.style import plt  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

# What is varied, the values, the default among them, and the value that stands for the limit.
VARIATIONS: list[tuple[str, str, list[Any], Any, Any]] = [
    ("modulus", "grains.youngs_modulus", ["1 MPa", "5 MPa", "20 MPa", "100 MPa"], "5 MPa", "100 MPa"),
    ("time_step", "solver.rayleigh_fraction", [0.1, 0.2, 0.3, 0.4], 0.2, 0.1),
    ("length", "layer.length", ["24 mm", "36 mm", "72 mm", "144 mm"], "36 mm", "144 mm"),
    ("width", "layer.width", ["15 mm", "18 mm", "36 mm", "72 mm"], "18 mm", "72 mm"),
    ("height", "layer.height", ["6 mm", "12 mm", "24 mm"], "12 mm", "24 mm"),
]
# What a box buys: eight packings of 24 cycles each, whatever their intervals are.
BOXES = [("15 mm", "13.5 mm"), ("30 mm", "13.5 mm"), ("30 mm", "27 mm"), ("60 mm", "27 mm")]
BOX_NUMBERS = [1.2, 1.5, 1.7]
FIXED_LENGTH = {"measure.packings": 8, "measure.max_packings": 8, "measure.half_width": 0.0005, "measure.max_cycles": 24}
BOX_COLUMNS = ["length", "width", "throw_number", "efficiency", "standard_error", "scatter", "core_s"]
LABELS = {"modulus": "Young's modulus", "time_step": "time step / Rayleigh time", "length": "length of the box",
          "width": "width of the box", "height": "height of the layer", "seeds": "packing"}


def measure(run: ValidationCase) -> None:
    rows = []
    for name, key, values, default, limit in VARIATIONS:
        if run.quick:
            values = [default, limit] if name == "time_step" else [default]
        table = run.campaign(name, {"measure.packings": 2, "measure.half_width": 0.1} if run.quick else {}, {key: values})
        rows += [[name, value] + measured(row) for value, row in zip(values, table)]
    seeds = run.campaign("seeds", {"measure.packings": 2 if run.quick else 12}, {"trough.throw_number": [2.0]})[0]
    rows.append(["seeds", 12] + measured(seeds))
    run.write_table("result.csv", ["variation", "value", "efficiency", "half_width", "outcome", "cycles"], rows)


def measure_boxes(run: ValidationCase) -> None:
    """Mean efficiency of eight packings, the scatter of one packing and its processor time, for each box."""
    rows: list[list[object]] = []
    for length, width in BOXES[:1] if run.quick else BOXES:
        name = f"box-{length}-{width}".replace(" ", "")
        table = run.campaign(name, {**FIXED_LENGTH, "layer.length": length, "layer.width": width}, {"trough.throw_number": BOX_NUMBERS})
        rows += [[length, width, gamma, *box_row(run.runs / name, row)] for gamma, row in zip(BOX_NUMBERS, table)]
    run.write_table("boxes.csv", BOX_COLUMNS, rows)


def box_row(folder: pathlib.Path, row: Row) -> list[str]:
    """Mean, its standard error, the standard deviation of one packing, and the mean processor time of one."""
    result = vibrotrough.open_result(folder / "cases" / row["case"] / "result.h5")
    values, times = (np.asarray(result[f"packings/{name}"], float) for name in ("efficiency", "core_time"))
    scatter = float(np.std(values, ddof=1))
    return [f"{np.mean(values):.4f}", f"{scatter / math.sqrt(len(values)):.4f}", f"{scatter:.4f}", f"{np.mean(times):.1f}"]


def judge_boxes(run: ValidationCase) -> None:
    """At equal processor time, is a larger box with fewer packings better? And does the mean depend on the box?"""
    rows = run.table("boxes.csv")
    for gamma in BOX_NUMBERS:
        mine = [row for row in rows if math.isclose(float(row["throw_number"]), gamma)]
        if len(mine) < len(BOXES):  # --quick
            continue
        cost = [float(row["scatter"])**2 * float(row["core_s"]) for row in mine]
        told = ", ".join(f"{row['length']} x {row['width']}: {value / cost[0]:.2f}" for row, value in zip(mine, cost))
        run.finding(f"A larger box with fewer packings is as precise for less processor time (throw number {gamma})", cost[-1] < cost[0] / 1.5,
                    f"scatter squared times processor time of a packing, over that of the smallest box: {told}")
        largest = mine[-1]
        off = [(float(row["efficiency"]) - float(largest["efficiency"]), math.hypot(float(row["standard_error"]), float(largest["standard_error"])))
               for row in mine[:-1]]
        told = ", ".join(f"{row['length']} x {row['width']}: {value:+.3f} ± {2.1 * error:.3f}" for row, (value, error) in zip(mine, off))
        run.finding(f"The efficiency depends on the box (throw number {gamma})", any(abs(value) > 2.1 * error for value, error in off),
                    f"less that of {largest['length']} x {largest['width']}, which is {float(largest['efficiency']):.3f}: {told}")


def measured(row: Row) -> list[str]:
    numbers = [f"{float(row[name] or math.nan):.4f}" for name in ("efficiency", "efficiency_half_width_statistics")]
    return numbers + [row["outcome"], row["cycles_measured"]]


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        measure(run)
        measure_boxes(run)
    rows = run.table("result.csv")
    found = {(row["variation"], row["value"]): row for row in rows}
    theory = run.json("point", "--throw-number", 2, "--tan-vibration-angle", 0.5, "--friction", 0.23)["velocity_efficiency"]
    for name, _, _, default, limit in VARIATIONS:
        at, goal = found[name, str(default)], found.get((name, str(limit)))
        if goal is None:  # --quick
            continue
        error = float(at["efficiency"]) - (theory if run.control else float(goal["efficiency"]))
        width = math.hypot(float(at["half_width"]), float(goal["half_width"]))
        run.check(f"{name}: default less limit (+- {width:.3f})", error, 0, 0.05,
                  "a fifth of the gap between layer and theory (0.24) that the layer is studied for")
    judge_boxes(run)
    draw(run, rows)
    run.finish()


def draw(run: ValidationCase, rows: list[Row]) -> None:
    figure, axes = plt.subplots(1, len(VARIATIONS), figsize=(13, 3), sharey=True, layout="constrained")
    for panel, (name, _, values, default, _) in zip(axes, VARIATIONS):
        here = [row for row in rows if row["variation"] == name]
        places = [list(map(str, values)).index(row["value"]) for row in here]
        panel.errorbar(places, [float(row["efficiency"]) for row in here], [float(row["half_width"]) for row in here], fmt="o", color="#0072B2",
                       capsize=3)
        panel.axvline(values.index(default), color="#999999", lw=0.8, ls=":")
        panel.set_xticks(range(len(values)), [str(value) for value in values], rotation=30)
        panel.set_title(LABELS[name], fontsize=9)
    axes[0].set_ylabel("velocity efficiency η")
    figure.savefig(run.figure("convergence.png"), dpi=120)


if __name__ == "__main__":
    main()
