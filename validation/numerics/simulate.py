#!/usr/bin/python3
"""Simulates the layers one after the other and writes their table after each: simulate.py --runs DIR --jobs 1 (--quick: only one).

Layers that stand in packings.csv or judging.csv are not simulated again, so that a later run goes on where this one stopped.
"""

import pathlib
import sys
from collections.abc import Iterable

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(FOLDER), str(FOLDER.parent.parent / "postprocess")]

import h5py  # noqa: E402
import numpy as np  # noqa: E402

import layers  # noqa: E402
from campaign_program import campaign_text, run_campaign, toml_value  # noqa: E402
from validation_case import ValidationCase, read_table  # noqa: E402

# Cycles whose mean is stored: of the start-up, and of what counts.
WINDOWS = {"start": (0, 4), "early": (4, 8), "first": (8, 20), "second": (20, 32)}
MEASURED = ["case", "modulus_MPa", "step_over_rayleigh", "packing", *WINDOWS, "core_seconds"]
PACKINGS = ["layer", "grains", "box", "step", *MEASURED]
JUDGING = ["layer", "simulation", *MEASURED]


def campaign_of(run: ValidationCase, layer: layers.Layer, simulations: list[layers.Simulation]) -> str:
    text = campaign_text(run.sections(), {}, {}).replace("[sweep]", "[zip]")
    return text + "".join(f'"{key}" = {toml_value(values)}\n' for key, values in layers.keys_of(layer, simulations).items())


def simulated(run: ValidationCase, name: str, layer: layers.Layer, simulations: list[layers.Simulation]) -> list[list[object]]:
    """The simulations of a layer: a row for each packing."""
    folder = run.runs / name
    table = run_campaign(run.program, folder, campaign_of(run, layer, simulations), run.jobs)
    rows: list[list[object]] = []
    for one, row in zip(simulations, table, strict=True):
        path = folder / "cases" / row["case"] / "result.h5"
        if path.exists():  # it did not fail
            rows += [[layer.number, *one.levels, row["case"], f"{one.modulus(layer) / 1e6:g}", *packing] for packing in packings_of(path, layer, one)]
    return rows


def packings_of(path: pathlib.Path, layer: layers.Layer, one: layers.Simulation) -> list[list[object]]:
    """The rest of MEASURED of each packing."""
    rows: list[list[object]] = []
    with h5py.File(path) as file:
        for number, packing in enumerate(file["packings"], 1):
            cycles = np.asarray(file["series"][str(number)]["efficiency"])
            means = [f"{np.mean(cycles[low:high]):.5f}" for low, high in WINDOWS.values()]
            rows.append([f"{one.step(layer, packing['time_step']):.4f}", number, *means, f"{packing['core_time']:.1f}"])
    return rows


def simulate(run: ValidationCase, table: str, header: list[str], every: Iterable[layers.Layer], simulations: list[layers.Simulation]) -> bool:
    """The layers that the table does not have; whether there are further ones, with --quick."""
    path = FOLDER / table
    rows: list[list[object]] = [list(row.values()) for row in read_table(path)] if path.exists() else []
    known = {int(str(row[0])) for row in rows}
    for layer in (layer for layer in every if layer.number not in known):
        rows += simulated(run, f"{table.removesuffix('.csv')}-{layer.number}", layer, simulations)
        run.write_table(table, header, rows)
        if run.quick:
            return True
    return False


def simulate_all(run: ValidationCase) -> None:
    """First the layers from which the errors are estimated, then those that judge."""
    if not simulate(run, "packings.csv", PACKINGS, layers.layers(), layers.EIGHT):
        simulate(run, "judging.csv", JUDGING, layers.judges(), layers.TWO)


if __name__ == "__main__":
    simulate_all(ValidationCase(FOLDER))
