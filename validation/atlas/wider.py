#!/usr/bin/python3
"""Simulates the layers of the wider domain, and adds them to the tables of the atlas.

Each layer is a campaign of its own, because layers of one campaign would share the modulus of the one that needs the stiffest grains.
The table is written after each; layers that stand in it are not simulated again, so that a later run goes on where this one stopped:
wider.py --runs DIR --jobs 1 (with --quick only one layer).
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
# How the layer lands, its depth in motion (twice the mean height of its centre of mass, in diameters), and what it cost.
LANDING = ["effective_restitution", "landing_phase", "depth_in_motion", "core_seconds"]
COLUMNS = ["campaign", *atlas.COLUMNS, *LANDING]
# What differs from base.toml. Layers that cost more are left for another machine: they end as not-precise.
CHANGES: dict[str, Any] = {"measure.max_core_time": "20 minutes"}
# Sobol sequences and the layers that judge them by turns, of which the dear ones come last.
ORDER = ["new0", "random0", "climbing0", "new1", "climbing1", "random1", "climbing2", "new2", "new3", "random2", "random3",
         "new_deep0", "random_deep0", "new_deep1"]  # fmt: skip
DEAR = 150  # core-seconds that `plan` foresees of an own layer


def stored() -> list[dict[str, str]]:
    path = FOLDER / TABLE
    return read_table(path) if path.exists() else []


def missing(columns: design.Columns) -> list[design.Columns]:
    """The layers that the table does not have, one by one."""
    known = {atlas.numbers_of(row["throw_number"], row["depth"]) for row in stored()}
    each = [{key: values[k : k + 1] for key, values in columns.items()} for k in range(len(columns["depth"]))]
    return [one for one in each if atlas.layers_of(one)[0] not in known]


def is_dear(run: ValidationCase, layer: design.Columns) -> bool:
    return float(run.of_file("plan", atlas.campaign_of(run, layer, CHANGES))["core_time_s"]) > DEAR


def simulate(run: ValidationCase, name: str, layer: design.Columns) -> list[object]:
    """A row of COLUMNS."""
    folder = run.runs / f"{name}-{layer['throw_number'][0]:.4f}"
    # What all layers of a campaign have in common is no column of its table; of one layer that is everything.
    given = {key: str(values[0]) for key, values in design.keys_of(layer).items()}
    row = given | run_campaign(run.program, folder, atlas.campaign_of(run, layer, CHANGES), run.jobs)[0]
    load = atlas.load_of(folder, row["case"]) if row["efficiency"] else [""] * len(atlas.LOAD)
    return [name, *atlas.row_of(run, row), *load, *landing_of(folder, row)]


def landing_of(folder: pathlib.Path, row: dict[str, str]) -> list[str]:
    """The values of LANDING; nothing of a case that failed."""
    result = folder / "cases" / row["case"] / "result.h5"
    if not result.exists():
        return [""] * len(LANDING)
    with h5py.File(result) as file:
        case, phases = file["case"], file["phases"]
        height = np.mean([np.mean(phases[packing]["height"]) for packing in phases])
        depth = 2000 * height / design.DIAMETER
        return [f"{float(case['effective_restitution']):.4f}", f"{float(case['landing_phase']):.4f}", f"{depth:.4f}", f"{float(case['core_time']):.0f}"]


def simulate_all(run: ValidationCase) -> None:
    """The layers that are not in the table; with --quick only one."""
    campaigns = design.wider_campaigns()
    for name, takes_dear in [(name, dear) for dear in (False, True) for name in ORDER]:
        for layer in missing(campaigns[name]):
            if not takes_dear and not name.startswith("random") and is_dear(run, layer):
                continue
            rows = [[row[column] for column in COLUMNS] for row in stored()]
            run.write_table(TABLE, COLUMNS, [*rows, simulate(run, name, layer)])
            if run.quick:
                return


def add_to_the_atlas(run: ValidationCase) -> None:
    """Puts the layers into the tables of the atlas, whose first layers stay."""

    def first(table: str) -> list[dict[str, str]]:
        wider = {atlas.numbers_of(row["throw_number"], row["depth"]) for row in stored()}
        return [row for row in run.table(table) if atlas.numbers_of(row["throw_number"], row["depth"]) not in wider]

    def cells(row: dict[str, str]) -> list[object]:
        return [row[column] for column in atlas.COLUMNS]

    own = [cells(row) for table in ("layers.csv", "apart.csv") for row in first(table)]
    atlas.write_layers(run, own, [(int(row["number"]), cells(row)) for row in first("held_out.csv")])


def main() -> None:
    run = ValidationCase(FOLDER)
    simulate_all(run)
    add_to_the_atlas(run)


if __name__ == "__main__":
    main()
