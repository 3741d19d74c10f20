"""Is a difference of two stiffnesses known with fewer packings than the value, when both have the same fillings?

From a layer of 12 diameters that is simulated with both, and the layers of why_theory_fails that were simulated again with stiffer grains:
packing n of both is poured from the same seeds and starts on the same side of the expected speed.
"""

import math
import pathlib

import numpy as np

import vibrotrough
from validation_case import Floats, ValidationCase, read_table

SOFT_MPA, STIFF_MPA, THROW_NUMBER, PACKINGS = 8, 125, 2.4, 8
STUDY = pathlib.Path(__file__).resolve().parent.parent / "why_theory_fails"
COLUMNS = ["layer", "throw_number", "soft_MPa", "stiff_MPa", "packing", "soft", "stiff"]
RESULTS = ["layers", "pairs", "correlation", "correlation_low", "correlation_high", "sd_soft", "sd_stiff", "sd_difference",
           "packings_ratio", "packings_ratio_low", "packings_ratio_high"]
NORMAL_95 = 1.959964
DRAWS, SEED = 4000, 20261124


def measure(run: ValidationCase) -> None:
    """The freely rotating layer of 12 diameters with both moduli, for the table twelve.csv."""
    fixed = {"measure.packings": PACKINGS, "measure.max_packings": PACKINGS, "measure.half_width": 0.1, "measure.max_cycles": 24,
             "trough.throw_number": THROW_NUMBER}
    means = []
    for row in run.campaign("pairs8", fixed, {"grains.youngs_modulus": [f"{modulus} MPa" for modulus in (SOFT_MPA, STIFF_MPA)]}):
        result = vibrotrough.open_result(run.runs / "pairs8" / "cases" / row["case"] / "result.h5")
        means.append([f"{value:.4f}" for value in result["packings/efficiency"]])
    run.write_table("twelve.csv", COLUMNS, [["12 deep, free", THROW_NUMBER, SOFT_MPA, STIFF_MPA, number, *pair] for number, pair in enumerate(zip(*means), 1)])


def pairs(run: ValidationCase) -> list[list[object]]:
    """COLUMNS of each packing that a layer has with both moduli."""
    stiff = {(row["rung"], row["throw_number"]): row for row in read_table(STUDY / "result.csv")}
    rows: list[list[object]] = [[row[name] for name in COLUMNS] for row in run.table("twelve.csv")]
    for old in read_table(STUDY / "soft.csv"):
        new = stiff[old["rung"], old["throw_number"]]
        both = zip(old["soft_packing_efficiencies"].split(), new["packing_efficiencies"].split())
        rows += [[old["rung"], old["throw_number"], old["soft_modulus_MPa"], new["modulus_MPa"], number, *pair] for number, pair in enumerate(both, 1)]
    return rows


def centred(rows: list[list[object]]) -> tuple[Floats, Floats, int]:
    """Soft and stiff efficiencies less the means of their layer, and the number of layers."""
    groups: dict[tuple[object, object], list[tuple[float, float]]] = {}
    for row in rows:
        groups.setdefault((row[0], row[1]), []).append((float(str(row[5])), float(str(row[6]))))
    parts = [np.array(group) - np.mean(group, axis=0) for group in groups.values()]
    together = np.concatenate(parts)
    return together[:, 0], together[:, 1], len(parts)


def ratio(soft: Floats, stiff: Floats) -> tuple[float, float, float]:
    """Variance of the paired difference over that of the stiff value, with a bootstrap interval: packings that the one needs for each of the other."""
    chosen = np.random.default_rng(SEED).integers(0, len(soft), (DRAWS, len(soft)))
    drawn = np.var(soft[chosen] - stiff[chosen], axis=1) / np.var(stiff[chosen], axis=1)
    low, high = np.quantile(drawn, (0.025, 0.975))
    return float(np.var(soft - stiff) / np.var(stiff)), float(low), float(high)


def results(rows: list[list[object]]) -> list[list[object]]:
    """RESULTS: correlation within layers, with its 95 % interval by Fisher's transformation."""
    soft, stiff, layers = centred(rows)
    free = len(soft) - layers
    r = float(np.corrcoef(soft, stiff)[0, 1])
    width = NORMAL_95 / math.sqrt(free - 2)
    interval = [math.tanh(math.atanh(r) + sign * width) for sign in (-1, 1)]
    spreads = [math.sqrt(float(np.sum(values**2)) / free) for values in (soft, stiff, soft - stiff)]
    return [[layers, len(soft), *(f"{value:.2f}" for value in (r, *interval)), *(f"{value:.4f}" for value in spreads),
             *(f"{value:.2f}" for value in ratio(soft, stiff))]]


def judge(run: ValidationCase, table: list[list[object]]) -> None:
    layers, count, r, low, high, _, _, _, packings, least, most = table[0]
    run.finding("paired fillings: the difference of two stiffnesses is known with fewer packings than the value",
                True if float(str(most)) < 1 else False if float(str(least)) > 1 else None,
                f"correlation {r} ({low} to {high}) of {count} pairs in {layers} layers of 8 and 12 diameters; the difference needs {packings} ({least} to {most}) "
                "times as many packings as the stiff value")
