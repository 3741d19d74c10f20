#!/usr/bin/python3
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import tomllib

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

from campaign_program import Row, campaign_text  # noqa: E402
from layers import SIMULATED, Layer, layers  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

INPUTS = ["diameter_mm", "amplitude_mm", "depth", "throw_number", "tan_vibration_angle", "tan_inclination", "friction", "grain_friction",
          "rolling_friction"]
MEASURED = ["modulus_Pa", "efficiency", "half_width", "packings", "cycles", "outcome"]


def measured(run: ValidationCase, name: str, row: Row) -> tuple[float, list[object]]:
    """Young's modulus of a case, and MEASURED."""
    scenario = tomllib.loads((run.runs / name / "cases" / row["case"] / "scenario.toml").read_text(encoding="utf-8"))
    modulus = float(str(scenario["grains"]["youngs_modulus"]).removesuffix(" Pa"))
    numbers = [f"{float(row[key] or math.nan):.4f}" for key in ("efficiency_dem", "efficiency_dem_half_width")]
    return modulus, [f"{modulus:g}", *numbers, row["packings"], row["cycles_measured"], row["outcome"]]


def simulate(run: ValidationCase, layer: Layer) -> list[object]:
    """Both simulations of a layer: a row of result.csv."""
    sweep = {"trough.throw_number": [layer.throw_number]}
    name = f"ordinary-{layer.number}"
    modulus, ordinary = measured(run, name, run.campaign(name, layer.changes(), sweep)[0])
    name = f"accurate-{layer.number}"
    _, accurate = measured(run, name, run.campaign(name, layer.accurate(modulus), sweep)[0])
    inputs = [layer.diameter, layer.amplitude, layer.depth, layer.throw_number, layer.tan_vibration_angle, layer.tan_inclination,
              layer.friction, layer.grain_friction, layer.rolling_friction]
    return [layer.number, *inputs, *ordinary, *accurate]


def cost(run: ValidationCase, layer: Layer) -> float:
    """Core-hours that the ordinary simulation of a layer will probably take, before anything is simulated."""
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(campaign_text(run.sections(), layer.changes(), {"trough.throw_number": [layer.throw_number]}))
        file.flush()
        answer = subprocess.run([run.program, "check", file.name, "--json"], capture_output=True, text=True, check=False)
    return float(json.loads(answer.stdout)["cases"][0]["expected_core_hours"])


run = ValidationCase(FOLDER)
if run.long:
    rows = []
    cheapest = sorted(layers(), key=lambda layer: cost(run, layer))[:2 if run.quick else SIMULATED]
    for layer in cheapest:
        rows.append(simulate(run, layer))
        header = ["layer", *INPUTS, *(f"ordinary_{name}" for name in MEASURED), *(f"accurate_{name}" for name in MEASURED)]
        run.write_table("result.csv", header, rows)  # after each layer: what there is can be judged
