#!/usr/bin/python3
"""Simulates the layers of the wider domain, four at a time, and writes wider.csv each time.

Layers that stand in the table are not simulated again, so that a later run goes on where this one stopped:
wider.py --runs DIR --jobs 1 (with --quick only four layers).
"""

import pathlib
import sys
from typing import Any

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(FOLDER), str(FOLDER.parent.parent / "postprocess")]

import h5py  # noqa: E402
import numpy as np  # noqa: E402

import design  # noqa: E402
import run as atlas  # noqa: E402
from campaign_program import run_campaign  # noqa: E402
from validation_case import ValidationCase, read_table  # noqa: E402

TABLE = "wider.csv"
AT_ONCE = 4  # layers, after which the table is written
# How the layer lands, its depth in motion (twice the mean height of its centre of mass, in diameters), and what it cost.
LANDING = ["effective_restitution", "landing_phase", "depth_in_motion", "core_seconds"]
COLUMNS = ["campaign", *atlas.COLUMNS, *LANDING]
# What differs from base.toml. Layers that cost more are left for another machine: they end as not-precise.
CHANGES: dict[str, Any] = {"measure.max_core_time": "20 minutes"}
# Sobol sequences and the layers that judge them by turns, the cheap ones first.
ORDER = ["new0", "random0", "climbing0", "random1", "new1", "climbing1", "random2", "new2", "climbing2", "random3", "new3",
         "new_deep0", "random_deep0", "new_deep1"]  # fmt: skip


def stored() -> list[list[object]]:
    path = FOLDER / TABLE
    return [list(row.values()) for row in read_table(path)] if path.exists() else []


def changes_of(name: str) -> dict[str, Any]:
    """What a campaign changes in base.toml."""
    return CHANGES | (atlas.PRECISE if name.startswith("random") and "deep" not in name else {})


def numbers_of(throw_number: object, depth: object) -> tuple[float, float]:
    """What tells a layer from all others; ids differ from one version of the program to the next."""
    return round(float(str(throw_number)), 4), round(float(str(depth)), 4)


def layers_of(columns: design.Columns) -> list[tuple[float, float]]:
    return [numbers_of(*pair) for pair in zip(columns["throw_number"], columns["depth"], strict=True)]


def missing(columns: design.Columns) -> design.Columns:
    """The layers that the table does not have."""
    known = {numbers_of(row["throw_number"], row["depth"]) for row in read_table(FOLDER / TABLE)} if (FOLDER / TABLE).exists() else set()
    return {name: values[[layer not in known for layer in layers_of(columns)]] for name, values in columns.items()}


def simulate(run: ValidationCase, name: str, columns: design.Columns) -> list[list[object]]:
    """Rows of COLUMNS of the layers that are done."""
    changes = changes_of(name)
    todo = missing(columns)
    part = {key: values[:AT_ONCE] for key, values in todo.items()}
    if not len(part["depth"]):
        return []
    folder = run.runs / f"{name}-{len(todo['depth'])}"
    rows = run_campaign(run.program, folder, atlas.campaign_of(run, part, changes), run.jobs)
    return [[name, *atlas.row_of(run, row), *load_of(folder, row), *landing_of(folder, row)] for row in rows]


def load_of(folder: pathlib.Path, row: dict[str, str]) -> list[str]:
    """What a layer did to its trough; nothing of one without a mean."""
    return atlas.load_of(folder, row["case"]) if row["efficiency"] else [""] * len(atlas.LOAD)


def landing_of(folder: pathlib.Path, row: dict[str, str]) -> list[str]:
    """The values of LANDING."""
    with h5py.File(folder / "cases" / row["case"] / "result.h5") as file:
        case, phases = file["case"], file["phases"]
        height = np.mean([np.mean(phases[packing]["height"]) for packing in phases])
        depth = 2000 * height / design.DIAMETER
        return [f"{float(case['effective_restitution']):.4f}", f"{float(case['landing_phase']):.4f}", f"{depth:.4f}", f"{float(case['core_time']):.0f}"]


def predict(run: ValidationCase) -> None:
    """What the atlas says of the layers of the table, beyond its ranges."""
    answers: dict[tuple[float, float], dict[str, Any]] = {}
    for name, columns in design.wider_campaigns().items():
        text = atlas.campaign_of(run, columns, changes_of(name))
        answers |= dict(zip(layers_of(columns), run.of_file("predict", text), strict=True))
    rows = read_table(FOLDER / TABLE)
    keys = ["campaign", "case", "outcome", "throw_number", "tan_inclination", "amplitude", "depth", "theory", "rolling_layer", "efficiency", "half_width"]
    found = [answers[numbers_of(row["throw_number"], row["depth"])] for row in rows]
    values = [[*(row[key] for key in keys), *(f"{answer[key]:.4f}" for key in ("efficiency", "half_width"))] for row, answer in zip(rows, found, strict=True)]
    run.write_table("wider_predicted.csv", [*keys, "atlas", "atlas_half_width"], values)


def simulate_all(run: ValidationCase) -> None:
    """The layers that are not in the table; with --quick only four."""
    campaigns = design.wider_campaigns()
    for name in ORDER:
        while rows := simulate(run, name, campaigns[name]):
            run.write_table(TABLE, COLUMNS, [*stored(), *rows])
            if run.quick:
                return


def main() -> None:
    run = ValidationCase(FOLDER)
    simulate_all(run)
    predict(run)


if __name__ == "__main__":
    main()
