"""How well the atlas predicts layers of other studies: of validation/whole_interval, decisions and deep_layers."""

import math
from typing import Any

import numpy as np
import scipy.stats

import design
import run as atlas
from campaign_program import campaign_text, toml_value
from validation_case import ValidationCase, read_table

ACCURATE = ["throw_number", "tan_inclination", "depth", "efficiency", "half_width", "ordinary", "atlas", "atlas_half_width"]
DEEP_LAYERS = ["grains", "depth", "throw_number", "efficiency", "half_width", "atlas", "atlas_half_width"]
DECISIONS = ["domain", "throw_number", "efficiency", "half_width", "theory", "atlas", "atlas_half_width"]


def judge(run: ValidationCase) -> dict[str, object]:
    """Scores by name."""
    return judge_accurate(run) | judge_decisions(run) | judge_deep_layers(run)


def predict_accurate(run: ValidationCase) -> list[list[object]]:
    """Predictions of the layers of validation/whole_interval that were simulated with stiff grains in a large box; rows of ACCURATE."""
    folder = atlas.FOLDER.parent / "whole_interval"
    layers = [row for table in ("result.csv", "deeper.csv") for row in read_table(folder / table) if row["accurate_outcome"] in atlas.STEADY]
    columns = {name: np.array([float(row.get(name, "nan")) for row in layers]) for name in design.RANGES}
    columns["amplitude"] = np.array([float(row["amplitude_mm"]) / float(row["diameter_mm"]) for row in layers])
    columns["restitution"] = np.full(len(layers), 0.5503)  # of its base.toml
    text = atlas.campaign_of(run, columns, {"grains.rotation": None})
    text += f'"grains.rotation" = {toml_value(["rolling" if one > 0 else "free" for one in columns["rolling_friction"]])}\n'
    return [
        [*(row[key] for key in ACCURATE[:3]), row["accurate_efficiency"], row["accurate_half_width"], row["ordinary_efficiency"], f"{answer['efficiency']:.4f}", f"{answer['half_width']:.4f}"]
        for row, answer in zip(layers, run.of_file("predict", text), strict=True)
    ]


def judge_accurate(run: ValidationCase) -> dict[str, object]:
    """Whether the interval holds without the numerical errors of the atlas' own layers; scores by name."""
    run.follows("accurate.csv", ACCURATE, predict_accurate(run))
    rows = [{key: float(row[key]) for key in ACCURATE} for row in run.table("accurate.csv")]
    error = np.array([row["efficiency"] - row["atlas"] for row in rows])
    whole = np.array([math.hypot(row["half_width"], row["atlas_half_width"]) for row in rows])
    if run.control:
        error = np.array([row["efficiency"] for row in rows]) - np.roll([row["atlas"] for row in rows], 1)
    held = int(np.sum(np.abs(error) <= whole))
    least = int(scipy.stats.binom.ppf(0.025, len(rows), 0.95))
    run.between(f"layers with stiff grains in a large box within their intervals, of {len(rows)}", held, least, len(rows),
                because="numerical errors count only as far as the layers of the atlas have them in common; more than expected may lie within")
    width = float(np.mean([row["atlas_half_width"] for row in rows]))
    return {"accurate": len(rows), "accurate_held": held, "accurate_rms": f"{math.sqrt(float(np.mean(error**2))):.3f}", "accurate_width": f"{width:.3f}"}


def predict_decisions(run: ValidationCase) -> list[list[object]]:
    """Predictions of the layers that judged the surfaces of validation/decisions, those of them that lie inside of the atlas."""
    folder = atlas.FOLDER.parent / "decisions"
    layers = [row for row in read_table(folder / "held_out.csv") if row["surface"].startswith("24") and row["outcome"] in atlas.STEADY]
    text = campaign_text(run.sections(str(folder / "base.toml")), {}, {}).replace("[sweep]", "[zip]")
    for key, column in (("trough.throw_number", "throw_number"), ("trough.tan_vibration_angle", "tan_vibration_angle"), ("grains.rolling_friction", "rolling_friction")):
        text += f'"{key}" = {toml_value([float(row[column]) for row in layers])}\n'
    return [
        [row["domain"], *(f"{float(row[key]):.4f}" for key in ("throw_number", "efficiency", "half_width", "theory")), f"{answer['efficiency']:.4f}", f"{answer['half_width']:.4f}"]
        for row, answer in zip(layers, run.of_file("predict", text), strict=True)
        if answer["inside"]
    ]


def judge_decisions(run: ValidationCase) -> dict[str, object]:
    """How well the atlas predicts the layers of validation/decisions; scores by name."""
    run.follows("decisions.csv", DECISIONS, predict_decisions(run))
    others = [{key: float(row[key]) for key in DECISIONS[1:]} for row in run.table("decisions.csv")]
    inside = sum(abs(row["efficiency"] - row["atlas"]) <= math.hypot(row["half_width"], row["atlas_half_width"]) for row in others)
    rms = {key: math.sqrt(float(np.mean([(row["efficiency"] - row[key]) ** 2 for row in others]))) for key in ("atlas", "theory")}
    run.finding("we: the layers of validation/decisions lie within their intervals, too", bool(inside >= scipy.stats.binom.ppf(0.025, len(others), 0.95)),
                f"{inside} of {len(others)}; root mean square {rms['atlas']:.3f}, of the point mass {rms['theory']:.3f}")
    return {"decisions": len(others), "decisions_held": inside, "decisions_rms": f"{rms['atlas']:.3f}", "decisions_rms_theory": f"{rms['theory']:.3f}"}


def predict_deep_layers(run: ValidationCase) -> list[list[object]]:
    """Predictions of the grid of validation/deep_layers, of the stiffest grains of each layer that is deeper than 6 diameters."""
    folder = atlas.FOLDER.parent / "deep_layers"
    layers = [row for row in read_table(folder / "grid.csv") if row["modulus_MPa"] == "500" and row["outcome"] in atlas.STEADY]
    zipped: dict[str, list[Any]] = {
        "trough.throw_number": [float(row["throw_number"]) for row in layers], "layer.diameters": [float(row["depth"]) for row in layers],
        "grains.rotation": [row["grains"] for row in layers], "grains.rolling_friction": [0.2 if row["grains"] == "rolling" else 0.0 for row in layers],
    }  # fmt: skip
    changes = {"grains.youngs_modulus": "500 MPa", "layer.height": None}
    text = campaign_text(run.sections(str(folder / "base.toml")), changes, {}).replace("[sweep]", "[zip]")
    text += "".join(f'"{key}" = {toml_value(values)}\n' for key, values in zipped.items())
    return [
        [*(row[key] for key in DEEP_LAYERS[:-2]), f"{answer['efficiency']:.4f}", f"{answer['half_width']:.4f}"]
        for row, answer in zip(layers, run.of_file("predict", text), strict=True)
        if answer["inside"]
    ]


def judge_deep_layers(run: ValidationCase) -> dict[str, object]:
    """How well the atlas predicts the layers of validation/deep_layers; scores by name."""
    run.follows("deep_layers.csv", DEEP_LAYERS, predict_deep_layers(run))
    rows = [{key: float(row[key]) for key in DEEP_LAYERS[1:]} for row in run.table("deep_layers.csv")]
    errors = [row["efficiency"] - row["atlas"] for row in rows]
    held = sum(abs(error) <= math.hypot(row["half_width"], row["atlas_half_width"]) for error, row in zip(errors, rows, strict=True))
    rms = math.sqrt(float(np.mean(np.square(errors))))
    run.finding("we: the layers of validation/deep_layers of 12 and 20 diameters lie within their intervals", bool(held >= scipy.stats.binom.ppf(0.025, len(rows), 0.95)),
                f"{held} of {len(rows)}; root mean square {rms:.3f}")
    return {"deep_layers": len(rows), "deep_layers_held": held, "deep_layers_rms": f"{rms:.3f}"}
