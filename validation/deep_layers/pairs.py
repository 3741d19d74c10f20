"""Is a difference of two stiffnesses known with fewer packings than the value, when both have the same fillings?"""

import math

import numpy as np

import vibrotrough
from campaign_program import Row
from validation_case import Floats, ValidationCase

SOFT_MPA, STIFF_MPA = 8, 125
THROW_NUMBER = 2.4
PACKINGS = 24  # of each modulus; packing n of both is poured from the same seeds and starts with the same efficiency
COLUMNS = ["modulus_MPa", "packing", "seed", "start_efficiency", "efficiency"]
RESULTS = ["starts", "pairs", "correlation", "correlation_low", "correlation_high", "sd_soft", "sd_stiff", "sd_difference",
           "packings_ratio", "packings_ratio_low", "packings_ratio_high"]
NORMAL_95 = 1.959964
DRAWS, SEED = 4000, 20261124


def measure(run: ValidationCase) -> None:
    """The freely rotating layer of 12 diameters with both moduli, for the table pairs.csv."""
    fixed = {"measure.packings": PACKINGS, "measure.max_packings": PACKINGS, "measure.half_width": 0.05, "measure.max_cycles": 24,
             "trough.throw_number": THROW_NUMBER}
    rows: list[list[object]] = []
    table = run.campaign("pairs", fixed, {"grains.youngs_modulus": [f"{modulus} MPa" for modulus in (SOFT_MPA, STIFF_MPA)]})
    for modulus, row in zip((SOFT_MPA, STIFF_MPA), table):
        result = vibrotrough.open_result(run.runs / "pairs" / "cases" / row["case"] / "result.h5")
        seeds, starts, means = (np.asarray(result[f"packings/{name}"], float) for name in ("seed", "start_efficiency", "efficiency"))
        rows += [[modulus, number, f"{seed:.0f}", f"{start:.4f}", f"{mean:.4f}"]
                 for number, (seed, start, mean) in enumerate(zip(seeds, starts, means), 1)]
    run.write_table("pairs.csv", COLUMNS, rows)
