"""Is a difference of two stiffnesses known with fewer packings than the value, when both have the same fillings?"""

import math

import numpy as np

import vibrotrough
from campaign_program import Row
from validation_case import Floats, ValidationCase

SOFT_MPA, STIFF_MPA = 8, 125
THROW_NUMBER = 2.4
PACKINGS = 12  # of each modulus; packing n of both is poured from the same seeds and starts with the same efficiency
COLUMNS = ["modulus_MPa", "packing", "seed", "start_efficiency", "efficiency"]
RESULTS = ["packings", "pairs", "correlation", "correlation_low", "correlation_high", "sd_soft", "sd_stiff", "sd_difference",
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


def by_packing(rows: list[Row], modulus: int) -> tuple[Floats, Floats]:
    """Efficiencies of the packings, in their order, and the efficiencies with which they started."""
    mine = sorted((row for row in rows if int(row["modulus_MPa"]) == modulus), key=lambda row: int(row["packing"]))
    return np.array([float(row["efficiency"]) for row in mine]), np.array([float(row["start_efficiency"]) for row in mine])


def correlation(soft: Floats, stiff: Floats, lost: int) -> tuple[float, float, float]:
    """Pearson's correlation with its 95 % interval by Fisher's transformation; `lost`: means that were taken off beside the common one."""
    r = float(np.corrcoef(soft, stiff)[0, 1])
    width = NORMAL_95 / math.sqrt(len(soft) - 3 - lost)
    return r, math.tanh(math.atanh(r) - width), math.tanh(math.atanh(r) + width)


def ratio(soft: Floats, stiff: Floats) -> tuple[float, float, float]:
    """Variance of the paired difference over that of the stiff value: how many packings the one needs for each of the other. With a bootstrap interval."""
    draw = np.random.default_rng(SEED)
    chosen = draw.integers(0, len(soft), (DRAWS, len(soft)))
    drawn = np.var(soft[chosen] - stiff[chosen], axis=1) / np.var(stiff[chosen], axis=1)
    low, high = np.quantile(drawn, (0.025, 0.975))
    return float(np.var(soft - stiff) / np.var(stiff)), float(low), float(high)


def results(rows: list[Row]) -> list[list[object]]:
    """RESULTS of all pairs, and with the means of the packings that started below and above the expected speed taken off."""
    soft, starts = by_packing(rows, SOFT_MPA)
    stiff, _ = by_packing(rows, STIFF_MPA)
    centred = [values - np.where(starts == starts.min(), values[starts == starts.min()].mean(), values[starts != starts.min()].mean())
               for values in (soft, stiff)]
    table: list[list[object]] = []
    for name, one, other, lost in (("as they are", soft, stiff, 0), ("less the mean of their start", *centred, 1)):
        spread = [float(np.std(values, ddof=1 + lost)) for values in (one, other, one - other)]
        table.append([name, len(one), *(f"{value:.3f}" for value in correlation(one, other, lost)), *(f"{value:.4f}" for value in spread),
                      *(f"{value:.2f}" for value in ratio(one, other))])
    return table


def judge(run: ValidationCase, table: list[list[object]]) -> None:
    _, count, r, low, high, _, _, _, packings, least, most = table[0]
    run.finding("paired fillings: the difference of two stiffnesses is known with fewer packings than the value", float(str(most)) < 1,
                f"correlation {r} ({low} to {high}) over {count} pairs of {SOFT_MPA} and {STIFF_MPA} MPa, 12 diameters, throw number {THROW_NUMBER:g}; "
                f"the difference needs {packings} ({least} to {most}) times as many packings as the stiff value")
