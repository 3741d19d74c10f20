"""The long part: runs the campaigns and writes their small tables."""

import json
import math
import pathlib
import subprocess
import sys
import tomllib
from collections.abc import Iterator

import numpy as np

from campaign_program import Row, campaign_text
from campaigns import CAMPAIGNS, QUICK
from lateral_profile import EDGES, lateral_profile
from layer_waves import waves
from validation_case import ValidationCase
from vibrotrough import File, open_result

FOLDER = pathlib.Path(__file__).resolve().parent
# `gradient` is the upper third's velocity less the lower third's, in omega r cos(beta).
COLUMNS = ["grains", "tan_inclination", "tan_vibration_angle", "throw_number", "efficiency", "half_width", "gradient", "overlap", "packings",
           "cycles", "mode", "outcome", "modulus_MPa"]
START = 20  # cycles of start-up that the profiles across and along leave out


def cases_of(run: ValidationCase, name: str) -> Iterator[tuple[Row, pathlib.Path, File | None]]:
    """Each case of a campaign: the table's row, its folder and its result.h5."""
    changes, sweep = CAMPAIGNS[name]
    if run.quick:
        changes, sweep = {**changes, **QUICK}, {key: values[-1:] for key, values in sweep.items()}
    for row in run.campaign(name, changes, sweep):
        folder = run.runs / name / "cases" / row["case"]
        result = open_result(folder) if (folder / "result.h5").exists() else None
        yield row, folder, result


def whole_cases(run: ValidationCase, name: str) -> Iterator[tuple[Row, pathlib.Path, File]]:
    """Like cases_of(), for campaigns of which every case must have a result."""
    for row, folder, result in cases_of(run, name):
        if result is None:
            sys.exit(f"case {row['case']} of {name} has no result: {row['outcome']}")
        yield row, folder, result


def measure(run: ValidationCase) -> None:
    rows = described_cases(run, ["free_1.25_to_2", "free", "blocked", "cube"])
    stiff = {place(row): row for row in described_cases(run, ["stiff_0.25", "stiff_0.5"])}
    run.write_table("soft.csv", [*COLUMNS[:4], *(f"soft_{name}" for name in COLUMNS[4:])], [row for row in rows if place(row) in stiff])
    run.write_table("result.csv", COLUMNS, [stiff.get(place(row), row) for row in rows])
    run.write_table("noise.csv", COLUMNS, described_cases(run, ["noise"]))
    walls(run)
    surface(run)
    stiffness(run)
    shake_test(run)


def described_cases(run: ValidationCase, names: list[str]) -> list[list[str]]:
    """A row per case of these campaigns."""
    return [described(row, result) for name in names for row, _, result in cases_of(run, name)]


def place(row: list[str]) -> tuple[str, ...]:
    """Which layer a row describes: the first of COLUMNS."""
    return tuple(row[:4])


def described(row: Row, result: File | None) -> list[str]:
    inputs = [f"{math.tan(math.radians(float(row[name]))):.4g}" for name in ("inclination_deg", "vibration_angle_deg")]
    inputs.append(f"{float(row['throw_number']):.4g}")
    if result is None:
        return ["", *inputs, "", "", "", "", "", "", "", row["outcome"], ""]
    shape = str(result["case/grain_shape"])
    grains = shape if shape != "sphere" else str(result["case/grain_rotation"])
    means = " ".join(f"{value:.4f}" for value in result["packings/efficiency"])
    steady = row["efficiency"] != ""
    gradients = np.asarray(result["packings/velocity_gradient"] * result["packings/efficiency"])
    gradient = gradients[~np.isnan(gradients)].mean() if steady and not np.isnan(gradients).all() else math.nan
    overlap = float(result["case/largest_overlap"] / result["case/grain_diameter"])
    eta = [f"{float(row[name]):.4f}" if steady else "" for name in ("efficiency", "efficiency_half_width_statistics")]
    return [grains, *inputs, *eta, f"{gradient:.4f}", f"{overlap:.4f}", means, row["cycles_measured"], row["layer_mode"],
            row["outcome"], f"{float(result['case/grain_youngs_modulus']) / 1e6:g}"]


def walls(run: ValidationCase) -> None:
    """Speed over the distance from the side walls, in omega r cos(beta)."""
    rows = []
    for row, folder, result in whole_cases(run, "walls"):
        scale = 2 * math.pi * float(row["amplitude_m"]) * math.cos(math.radians(float(row["vibration_angle_deg"])))
        box = tomllib.loads(str(result["scenario"][0]))["layer"]
        speed, seen = lateral_profile(folder / "packing-1" / "dump", metres(box["length"]), metres(box["width"]),
                                      CAMPAIGNS["walls"][0]["output.frames_per_cycle"], 2 if run.quick else START)
        error = speed.std(axis=0, ddof=1) / math.sqrt(len(speed))
        for i in range(len(EDGES) - 1):
            rows.append([str(result["case/grain_rotation"]), float(result["case/side_wall_friction"]),
                         f"{float(row['throw_number']):.4g}", EDGES[i], EDGES[i + 1], f"{speed[:, i].mean() / scale:.4f}",
                         f"{error[i] / scale:.4f}", int(seen[:, i].sum())])
    run.write_table("walls.csv", ["rotation", "wall_friction", "throw_number", "from_mm", "to_mm", "efficiency", "standard_error",
                                  "seen"], rows)


def metres(text: object) -> float:
    """A length of a scenario, which a result keeps in SI: a number, or a text with a unit."""
    number, unit = (str(text).split() + ["m"])[:2]
    return float(number) * {"m": 1.0, "mm": 1e-3}[unit]


def surface(run: ValidationCase) -> None:
    rows, shapes = [], []
    for row, folder, result in whole_cases(run, "waves"):
        length = metres(tomllib.loads(str(result["scenario"][0]))["layer"]["length"])
        found = waves(folder / "packing-1", length, int(result["packings/steps_per_cycle"][0]), 2 if run.quick else START)
        rows.append([f"{float(row['throw_number']):.4g}", row["efficiency"], row["frequency_hz"],
                     *(f"{1e3 * found[name]:.3f}" for name in ("all", "amplitude", "highest", "wavelength")), f"{found['share']:.3f}",
                     f"{found['turnover']:.3f}", row["layer_mode"]])
        shapes += [[f"{float(row['throw_number']):.4g}", cycle, f"{1e3 * x:.2f}", f"{1e3 * z:.3f}"]
                   for cycle, heights in enumerate(found["two"]) for x, z in zip(found["x"], heights)]
    run.write_table("waves.csv", ["throw_number", "efficiency", "frequency_hz", "unevenness_mm", "amplitude_mm",
                                  "highest_mm", "wavelength_mm", "share", "turnover", "mode"], rows)
    run.write_table("surfaces.csv", ["throw_number", "snapshot", "x_mm", "deviation_mm"], shapes)


def stiffness(run: ValidationCase) -> None:
    rows = [[float(result["case/grain_youngs_modulus"]) / 1e6, *described(row, result)[1:6]]
            for row, _, result in whole_cases(run, "stiff")]
    run.write_table("stiff.csv", ["youngs_modulus_mpa", "tan_inclination", "tan_vibration_angle", "throw_number", "efficiency",
                                  "half_width"], rows)


def shake_test(run: ValidationCase) -> None:
    """Friction from the horizontal shake test, for blocks and for layers."""
    rows = []
    text = (FOLDER / "base_block.toml").read_text(encoding="utf-8")
    rows += [["block", *one] for one in frictions(run, "shaken_block", text)]
    base = run.sections()
    for name in () if run.quick else ("free", "blocked"):
        changes = {**CAMPAIGNS[name][0], "campaign.name": "shaken_" + name}
        layer = campaign_text(base, changes, {"trough.throw_number": [0.8]})
        rows += [[name, *one] for one in frictions(run, "shaken_" + name, layer)]
    run.write_table("friction.csv", ["what", "friction_put_in", "friction", "low", "high", "machine_number", "mode"], rows)


def frictions(run: ValidationCase, name: str, text: str) -> Iterator[list[str]]:
    file, folder = run.runs / f"{name}.toml", run.runs / name
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")
    command = [run.program, "friction-test", str(file), "--output", str(folder), "--jobs", str(run.jobs)]
    if subprocess.run(command, check=False).returncode not in (0, 1):
        sys.exit(f"{' '.join(command)} failed")
    for test in json.loads((folder / "friction.json").read_text(encoding="utf-8"))["layers"]:
        values = [test[key] for key in ("grain_friction", "friction", "friction_low", "friction_high", "machine_number")]
        yield [*("" if value is None else f"{value:.4f}" for value in values), test["mode"]]
