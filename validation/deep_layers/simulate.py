"""The simulations of this study: one campaign for each modulus, so that they can be run in any order and continued."""

import math
import warnings
from typing import Any

import numpy as np

import vibrotrough
from campaign_program import Row
from layers import (DEEP_MM, DEPTHS_MM, FOUND, FOUND_MODULI_MPA, GRAINS, HELD_OUT_MODULI_MPA, LONG_BOX, MODULI_MPA, SHORT_STEP,
                    THROW_NUMBERS, Layer, held_out)
from validation_case import Floats, ValidationCase

# What is kept of a case: of its row in `compare`, and means over its packings in result.h5.
COLUMNS = ["efficiency", "half_width", "outcome", "packings", "cycles", "period", "mode", "landing_deg", "transit_deg", "overlap", "core_s"]
GRID = ["study", "grains", "depth", "throw_number", "modulus_MPa", *COLUMNS]
JUDGES = ["layer", "modulus_MPa", *COLUMNS]


def transit(result: vibrotrough.File, packing: int, landing: float) -> float:
    """Phase, in degrees, from the landing to the moment when the centre of mass no longer falls towards the trough. NaN without flight."""
    if not math.isfinite(landing):
        return math.nan
    group = f"phases/{packing}/"
    falling = np.asarray(result[group + "trough_velocity_z"]) - np.asarray(result[group + "velocity_z"])
    count = len(falling)
    begin = round(landing / (2 * math.pi) * 100)
    for step in range(count):
        before, now = falling[(begin + step - 1) % count], falling[(begin + step) % count]
        if now <= 0 < before:
            return 3.6 * float(begin + step - now / (now - before)) - math.degrees(landing)
    return math.nan


def measured(run: ValidationCase, name: str, row: Row) -> list[object]:
    """COLUMNS of one case; NaN where a case has no mean."""
    path = run.runs / name / "cases" / row["case"] / "result.h5"
    numbers = [f"{float(row[key] or math.nan):.4f}" for key in ("efficiency", "efficiency_half_width_statistics")]
    known = [*numbers, row["outcome"], row["packings"]]
    if not path.is_file():
        return [*known, *["nan"] * (len(COLUMNS) - len(known))]
    result = vibrotrough.open_result(path)

    def values(quantity: str) -> Floats:
        return np.asarray(result[f"packings/{quantity}"], float)

    modes = [str(mode) for mode in np.asarray(result["packings/layer_mode"]).astype(str)]
    landings = values("landing_phase")
    transits = [transit(result, number + 1, landing) for number, landing in enumerate(landings)]
    cycles = values("cycles_discarded") + values("cycles_measured")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # no packing flies: no landing
        return [*known, f"{np.mean(cycles):.0f}", f"{np.mean(values('period_cycles')):.2f}", max(sorted(set(modes)), key=modes.count),
                f"{math.degrees(float(np.nanmean(landings))):.1f}", f"{np.nanmean(transits):.1f}",
                f"{np.mean(values('largest_overlap')):.3e}", f"{np.sum(values('core_time')):.0f}"]


def grid(run: ValidationCase, moduli: list[int]) -> None:
    """Grains x depth x throw number at each modulus, for the table grid.csv."""
    rows: list[list[object]] = []
    for modulus in moduli:
        for grains, changes in GRAINS.items():
            name = f"{grains}-{modulus}MPa"
            depths = DEEP_MM if modulus == MODULI_MPA[-1] else DEPTHS_MM
            sweep: dict[str, list[Any]] = {"layer.height": [f"{depth} mm" for depth in depths], "trough.throw_number": THROW_NUMBERS}
            table = run.campaign(name, {**changes, "grains.youngs_modulus": f"{modulus} MPa"}, sweep)
            places = [(depth // 3, gamma) for depth in depths for gamma in THROW_NUMBERS]
            rows += [["grid", grains, *place, modulus, *measured(run, name, row)] for place, row in zip(places, table)]
    run.write_table("grid.csv", GRID, rows)


def boxes_and_steps(run: ValidationCase) -> None:
    """Boxes as long as the layer is deep, and the default time step, for the table variations.csv."""
    rows: list[list[object]] = []
    for depth, length in LONG_BOX.items():
        for modulus in (8, 125):
            name = f"long-{depth}-{modulus}MPa"
            table = run.campaign(name, {"layer.length": length, "layer.height": length, "grains.youngs_modulus": f"{modulus} MPa"},
                                 {"trough.throw_number": [2.0, 2.4]})
            rows += [["long box", "free", depth, gamma, modulus, *measured(run, name, row)] for gamma, row in zip([2.0, 2.4], table)]
    name = "short-step"
    table = run.campaign(name, {"solver.rayleigh_fraction": SHORT_STEP}, {"trough.throw_number": [2.0, 2.4]})
    rows += [["short step", "free", 12, gamma, 125, *measured(run, name, row)] for gamma, row in zip([2.0, 2.4], table)]
    run.write_table("variations.csv", GRID, rows)


def judging_layers(run: ValidationCase) -> None:
    """The layers that judge the criterion, for the table judges.csv."""
    rows: list[list[object]] = []
    cases: list[tuple[Layer, list[int]]] = [(FOUND, FOUND_MODULI_MPA)] + [(layer, HELD_OUT_MODULI_MPA) for layer in held_out()]
    for layer, moduli in cases:
        name = layer.name.replace(" ", "-")
        sweep = {"grains.youngs_modulus": [f"{modulus} MPa" for modulus in moduli]}
        table = run.campaign(name, layer.changes(moduli[0]), sweep)
        rows += [[layer.name, modulus, *measured(run, name, row)] for modulus, row in zip(moduli, table)]
    run.write_table("judges.csv", JUDGES, rows)
