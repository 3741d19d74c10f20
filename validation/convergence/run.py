#!/usr/bin/python3
import math
import pathlib
import sys
from typing import Any

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

from campaign_program import Row  # noqa: E402
from figure_style import plt  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

# What is varied, the values, the default among them, and the value that stands for the limit.
VARIATIONS: list[tuple[str, str, list[Any], Any, Any]] = [
    ("modulus", "grains.youngs_modulus", ["1 MPa", "5 MPa", "20 MPa", "100 MPa"], "5 MPa", "100 MPa"),
    ("time_step", "solver.rayleigh_fraction", [0.1, 0.2, 0.3, 0.4], 0.2, 0.1),
    ("length", "layer.length", ["24 mm", "36 mm", "72 mm", "144 mm"], "36 mm", "144 mm"),
    ("width", "layer.width", ["15 mm", "18 mm", "36 mm", "72 mm"], "18 mm", "72 mm"),
    ("height", "layer.height", ["6 mm", "12 mm", "24 mm"], "12 mm", "24 mm"),
]
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


def measured(row: Row) -> list[str]:
    numbers = [f"{float(row[name] or math.nan):.4f}" for name in ("efficiency_dem", "efficiency_dem_half_width")]
    return numbers + [row["outcome"], row["cycles_measured"]]


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        measure(run)
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
