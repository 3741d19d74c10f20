#!/usr/bin/python3
import pathlib
import sys
from typing import Any

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))
sys.path.insert(0, str(FOLDER.parent / "engine_impact"))

import h5py  # noqa: E402
import numpy as np  # noqa: E402

import law  # noqa: E402
from campaign_program import Row  # noqa: E402
from validation_case import Floats, ValidationCase, read_table  # noqa: E402

GRAVITY, NOMINAL = 9.81, 0.5
CASES: dict[str, dict[str, Any]] = {
    "one": {"layer.grains": 1, "grains.diameter_spread": 0, "trough.throw_number": 3},
    "gas": {},
    "layer": {"trough.friction": 0.3, "grains.friction": 0.5, "trough.throw_number": 2},
}
COLUMNS = ["case", "packing", "impacts", "brief", "trough_work_J", "gain_J", "grain_energy_J", "trough_energy_J"]


def columns_of(path: pathlib.Path) -> dict[str, Floats]:
    rows = read_table(path)
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def energies(folder: pathlib.Path, mass: float, steps: int) -> list[float]:
    """Of one packing, in the two cycles in which the impacts were watched: the work of the trough on the grains, force times way of
    each of the 100 lines per cycle, and what the grains then have more in height and speed; and the energies of the impacts with
    other grains and with the trough."""
    phases, impacts = columns_of(folder / "phases.csv"), columns_of(folder / "impacts.csv")
    last = phases["step"][-1]
    at = np.flatnonzero(phases["step"] >= last - 2 * steps)
    ways = {axis: np.diff(phases[f"trough_{axis}"][at]) for axis in "xz"}
    # The forces are the layer's on the trough, means since the line before.
    work = -sum(float(np.dot(phases[f"force_{axis}"][at[1:]], ways[axis])) for axis in "xz")
    kept = phases["energy_translation"] + phases["energy_rotation"] + mass * GRAVITY * phases["z_com"]
    within = (impacts["step"] > phases["step"][at[0]]) & (impacts["step"] <= last)
    with_trough = impacts["second"] == 0
    sums = [float(impacts["energy"][within & kind].sum()) for kind in (~with_trough, with_trough)]
    return [int(within.sum()), int(impacts["brief"][within].sum()), work, float(kept[at[-1]] - kept[at[0]]), *sums]


def simulate(run: ValidationCase) -> None:
    rows: list[list[object]] = []
    for name, changes in CASES.items():
        run.campaign(name, changes, {})
        (path,) = (run.runs / name).glob("cases/*/result.h5")
        with h5py.File(path) as file:
            packings = file["packings"][()]
        for number, packing in enumerate(packings, 1):
            rows.append([name, number, *energies(path.parent / f"packing-{number}", float(packing["mass"]), int(packing["steps_per_cycle"]))])
    run.write_table("energies.csv", COLUMNS, rows)


def lost_share(nominal: float) -> float:
    """Of the energy of an impact without friction, by the contact law in closed form."""
    (after,), _, _ = law.impact(nominal, 0, 0.25, 0)
    return float(1 - (after / 0.25) ** 2)


def balance(rows: list[Row], name: str, with_neighbours: bool, lost: float) -> float:
    """Of all packings of a case: what the impacts lose over what the grains take from the trough and do not keep."""
    of_case = [{column: float(row[column]) for column in COLUMNS[2:]} for row in rows if row["case"] == name]
    energy = sum(row["trough_energy_J"] + (row["grain_energy_J"] if with_neighbours else 0) for row in of_case)
    return lost * energy / sum(row["trough_work_J"] - row["gain_J"] for row in of_case)


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        simulate(run)
    rows = run.table("energies.csv")
    lost = 1 - NOMINAL**2 if run.control else lost_share(NOMINAL)
    ratios = {name: balance(rows, name, not run.control, lost) for name in CASES}
    for name, tolerance, because in (
            ("one", 0.03, "force times way of 100 lines per cycle"),
            ("gas", 0.05, "the same; some impacts are of three grains, and some last beyond the two cycles")):
        run.check(f"{name}: energy that the impacts lose over that which the grains take from the trough and do not keep", ratios[name], 1, tolerance, because)
    run.finding("in a layer with friction at throw number 2, impacts lose less than half of what the trough puts in; sliding and lasting contacts lose the rest",
                ratios["layer"] < 0.5, f"they lose {ratios['layer']:.2f} of it")
    run.follows("balance.csv", ["case", "share"], [[name, f"{ratio:.4f}"] for name, ratio in ratios.items()])
    run.finish()


if __name__ == "__main__":
    main()
