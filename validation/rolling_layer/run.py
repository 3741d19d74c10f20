#!/usr/bin/python3
import itertools
import math
import pathlib
import sys
from collections.abc import Mapping
from typing import Any

import numpy as np

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import contacts  # noqa: E402
import draw  # noqa: E402
import held_out  # noqa: E402
import judge_smeared  # noqa: E402
import tables  # noqa: E402
import vibrotrough  # noqa: E402
from campaign_program import Row  # noqa: E402
from validation_case import Floats, ValidationCase, read_table  # noqa: E402

COLUMNS = ["group", "throw_number", "efficiency", "half_width", "packings", "outcome", "modulus_MPa"]
PHASES: dict[str, list[Any]] = {"grains.rotation": ["free", "blocked"], "trough.throw_number": [1.7, 2.0]}
FEW_PACKINGS = {"measure.half_width": 0.2, "measure.packings": 2, "measure.max_packings": 2}
ALSO_SHOWN = 1.9
POINT_MASS = "point mass"
HOLDS, REFUTED = 0.06, 0.10
THEORIES: dict[str, Mapping[str, float] | None] = {"A0": {}, POINT_MASS: None, "soft landing": {"torque": math.inf}}


def measure(run: ValidationCase) -> None:
    """Simulates what is held out; of four layers and of two of the held-out groups the mean curves over the cycle are kept, too."""
    rows, curves = [], []
    table = run.campaign("phases", FEW_PACKINGS, PHASES)
    for (rotation, _), row in zip(itertools.product(*PHASES.values()), table):
        curves += phase_rows(run, "phases", row, rotation)
    for group, (changes, numbers) in held_out.HELD_OUT.items():
        name, stiff = held_out.campaign_name(group), held_out.STIFF_LAYERS.get(group, [])
        soft = [gamma for gamma in (numbers[:1] if run.quick else numbers) if gamma not in stiff]
        for row in run.campaign(name, changes, {"trough.throw_number": soft}) if soft else []:
            rows.append(measured(run, name, group, row))
            if rows[-1][1] == ALSO_SHOWN and group in ("throw number", held_out.BLOCKED):
                curves += phase_rows(run, name, row, "blocked" if group == held_out.BLOCKED else "free")
        rows += [] if run.quick else measure_stiff(run, group)
        run.write_table("held_out.csv", COLUMNS, rows)  # after each group: what there is can be judged
        run.write_table("phases.csv", draw.PHASE_COLUMNS, curves)


def measure_stiff(run: ValidationCase, group: str) -> list[list[object]]:
    """The layers of a group that need stiffer grains than base.toml has."""
    name, numbers = held_out.campaign_name(group) + "-stiff", held_out.STIFF_LAYERS.get(group, [])
    changes = {**held_out.HELD_OUT[group][0], **held_out.STIFF}
    return [measured(run, name, group, row) for row in run.campaign(name, changes, {"trough.throw_number": numbers})] if numbers else []


def measured(run: ValidationCase, campaign: str, group: str, row: Row) -> list[object]:
    """COLUMNS of one case."""
    result = vibrotrough.open_result(run.runs / campaign / "cases" / row["case"] / "result.h5")
    modulus = float(result["case/grain_youngs_modulus"]) / 1e6
    return [group, round(float(row["throw_number"]), 6), row["efficiency"], row["efficiency_half_width_statistics"], row["packings"], row["outcome"],
            f"{modulus:g}"]


def phase_rows(run: ValidationCase, campaign: str, row: Row, rotation: str) -> list[list[object]]:
    """Mean curves over the cycle of one case."""
    return draw.phase_rows(vibrotrough.open_result(run.runs / campaign / "cases" / row["case"] / "result.h5"), row, rotation)


def score_tables(run: ValidationCase) -> None:
    """The table of README.md section 4: rms against stored tables, without a refit."""
    score: dict[str, dict[str, float]] = {}
    for name, (points, efficiency) in tables.sets(blocked=run.control).items():
        score[name] = {law: tables.rms(tables.solve(run, points, constants) - efficiency) for law, constants in THEORIES.items()}
    print("rms of eta:", {name: {law: round(value, 3) for law, value in row.items()} for name, row in score.items()})
    run.follows("scores.csv", ["law", *score], [[law, *(f"{row[law]:.3f}" for row in score.values())] for law in (POINT_MASS, "soft landing", "A0")])
    for name, most in (("level (fit)", 0.03), ("paper, 1.5-2", 0.075), ("krakow", 0.06)):
        run.between(f"rms of A0's efficiency, {name}", score[name]["A0"], 0, most, "the first fit had 0.023, 0.061 and 0.041; packings scatter by 0.02")
        run.between(f"rms of A0 over that of the point mass, {name}", score[name]["A0"] / score[name][POINT_MASS], 0, 0.5, "the better theory, by a factor of two")
    below = score["paper, < 1"]
    run.finding("The rolling-layer law holds below throw number 1, too", below["A0"] < below[POINT_MASS] / 2,
                f"rms {below['A0']:.3f}, point mass {below[POINT_MASS]:.3f}")


def refit(run: ValidationCase) -> None:
    """Fits c and mu_i to the level cases by the program; the 95 % region of both, and the fits that leave one case out."""
    points, efficiency = tables.level("4 deep, blocked" if run.control else "4 deep, free")
    torques, dry = np.linspace(0.30, 0.85, 12), np.linspace(0, 0.06, 7)
    squares = np.array([[(tables.solve(run, points, {"torque": c, "dry_torque": m}) - efficiency) ** 2 for m in dry] for c in torques])
    total = squares.sum(axis=2)

    def best(sums: Floats) -> tuple[float, float]:
        i, j = np.unravel_index(np.argmin(sums), sums.shape)
        return float(torques[i]), float(dry[j])

    c, m = best(total)
    most = total.min() * (1 + 2 / 4 * 6.944)  # F distribution, 2 and 4 degrees of freedom, 95 %
    where = np.argwhere(total <= most)
    left_out = [best(total - squares[:, :, k]) for k in range(len(points))]
    print(f"fit: c = {c:.2f} ({torques[where[:, 0]].min():.2f} to {torques[where[:, 0]].max():.2f}), mu_i = {m:.2f} ({dry[where[:, 1]].min():.2f} to "
          f"{dry[where[:, 1]].max():.2f}), rms {math.sqrt(total.min() / 6):.3f}; without one case: {[f'{a:.2f}, {b:.2f}' for a, b in left_out]}")
    run.follows("fit.csv", ["c", "c_low", "c_high", "mu_i", "mu_i_low", "mu_i_high", "rms", "c_left_out"],
                [[f"{c:.2f}", f"{torques[where[:, 0]].min():.2f}", f"{torques[where[:, 0]].max():.2f}", f"{m:.2f}", f"{dry[where[:, 1]].min():.2f}",
                  f"{dry[where[:, 1]].max():.2f}", f"{math.sqrt(total.min() / 6):.3f}", f"{max(abs(a - c) for a, _ in left_out):.2f}"]])
    published = float(np.sum((tables.solve(run, points, {}) - efficiency) ** 2))
    run.between("sum of squares of the published constants over that of the best fit to the level cases", published / total.min(), 0, most / total.min(),
                "the 95 % region of the two constants (F distribution)")


def free_rows(run: ValidationCase) -> list[Row]:
    """Held-out cases by which the laws are judged: measured, free to rotate, from throw number 1.25 to 2.6."""
    low, high = held_out.JUDGED
    return [row for row in run.table("held_out.csv") if row["efficiency"] and row["group"] != held_out.BLOCKED and low <= float(row["throw_number"]) <= high]


def judge_laws(run: ValidationCase) -> None:
    predicted = {(row["group"], float(row["throw_number"])): row for row in read_table(FOLDER / "predictions.csv")}
    rows = free_rows(run)
    measured = np.array([float(row["efficiency"]) for row in rows])
    inputs = [held_out.inputs(row["group"], float(row["throw_number"])) for row in rows]
    errors = {POINT_MASS: tables.solve(run, [one[:4] for one in inputs], None) - measured}
    for law in list(predicted[next(iter(predicted))])[2:]:
        errors[law] = np.array([float(predicted[(row["group"], float(row["throw_number"]))][law]) for row in rows]) - measured
    points, efficiency = tables.level("4 deep, free")
    line = np.polyfit([point[0] for point in points], efficiency, 1)
    errors["line in Gamma"] = np.polyval(line, [one[0] for one in inputs]) - measured
    score = {law: tables.rms(error) for law, error in errors.items()}
    print("held-out rms:", {law: f"{score[law]:.3f} (mean {errors[law].mean():+.3f}, largest {errors[law][np.argmax(abs(errors[law]))]:+.3f})" for law in score})
    point = score[POINT_MASS]
    reference = score["soft landing"] if run.control else score["A0"]
    run.between("held-out rms of A0 over that of the point mass", reference / point, 0, 0.5, "the better theory, by a factor of two")
    run.between("held-out rms of A0 over that of A0 with forces a quarter of a cycle late", reference / score["A0 a quarter late"], 0, 0.5,
                "the same constants with shuffled phases")
    for law in score:
        if law not in (POINT_MASS, "A0 a quarter late"):
            verdict = True if score[law] <= HOLDS else False if score[law] > REFUTED else None
            run.finding(f"{law}: predicts {len(rows)} held-out free layers", verdict,
                        f"rms of eta {score[law]:.3f}, point mass {point:.3f}; it holds up to {HOLDS}, is refuted above {REFUTED}")
    draw.laws(run, rows, errors)
    judge_smeared.judge(run, rows, errors)


def judge_phases(run: ValidationCase) -> None:
    curves = draw.Phases(run.table("phases.csv"))
    for gamma in curves.throw_numbers():
        rolling = curves.mean("free", gamma, "spin", 275, 300) / curves.mean("free", gamma, "floor_velocity", 275, 300)
        run.finding(f"After the landing the floor grains roll (275 to 300 degrees, Gamma {gamma}): their spin is above half of their velocity",
                    rolling > 0.5, f"{rolling:.2f} of it, F/N {curves.ratio('free', gamma, 275, 300):+.3f}")
        pushed = curves.ratio("free", gamma, 335, 375)
        run.finding(f"While the trough pushes forwards the floor grains roll backwards with F/N below mu (335 to 15 degrees, Gamma {gamma})",
                    pushed < 0.2, f"F/N {pushed:+.3f} of mu = 0.23, spin {curves.mean('free', gamma, 'spin', 335, 375):+.3f}, A0 {curves.a0(run, gamma, 335, 375):+.3f}")
        early, late = curves.torque(gamma, 286, 294), curves.torque(gamma, 340, 350)
        presses = curves.mean("free", gamma, "normal_force", 286, 294) > 1  # else it has not landed yet, and there is no torque to judge
        run.finding(f"The torque against the spin grows with the compaction of the layer, 5 times or more from 290 to 345 degrees (Gamma {gamma})",
                    late[0] > 5 * early[0] if presses else None, f"M / w {early[0]:.2f} and {late[0]:.2f}, M / N {early[1]:+.3f} and {late[1]:+.3f}; A0 has M / w = 0.61")
        run.between(f"control: F / N of the layer without rotation while it slips back (310 to 375 degrees, Gamma {gamma})",
                    curves.ratio("blocked", gamma, 310, 375), 0.225, 0.235, "sliding contacts: mu = 0.23")
    draw.phases(run, curves)


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        measure(run)
    score_tables(run)
    refit(run)
    judge_laws(run)
    judge_phases(run)
    contacts.judge_contacts(run)
    run.finish()


if __name__ == "__main__":
    main()
