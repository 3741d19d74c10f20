#!/usr/bin/python3
import pathlib
import statistics
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from campaign_program import CampaignValidation  # noqa: E402

NUMBERS = [0.5, 0.8, 1.1, 1.3, 1.5, 1.7, 2.0, 2.25, 2.5, 2.75, 3.0]
TANGENTS, FRICTIONS, SLOPES = [0.25, 0.5, 1.0], [0.18, 0.23], [-0.05, 0.0, 0.05]
# A point is near a change of mode, or near a knee, when the theory's own answer within 2 % of the throw number differs by
# more than this from a straight line through it.
KNEE = 0.01


def theory(run, gamma, row):
    answer = run.theory_point(gamma, row)
    return answer["velocity_efficiency"], answer["mode"]


def near_a_change(run, row):
    gamma = float(row["throw_number"])
    around = [theory(run, gamma * (1 + shift), row) for shift in (-0.02, -0.01, 0, 0.01, 0.02)]
    if len({mode for _, mode in around}) > 1:
        return True
    values = [eta for eta, _ in around]
    bend = max(abs(values[i] - (values[0] + (values[4] - values[0]) * i / 4)) for i in range(5))
    return bend > KNEE


def main():
    run = CampaignValidation("A rigid block simulated against the point-mass theory", FOLDER)
    numbers = [0.8, 2.5] if run.quick else NUMBERS
    tangents, frictions, slopes = ([0.5], [0.23], [0.0]) if run.quick else (TANGENTS, FRICTIONS, SLOPES)
    table = run.campaign("grid", {}, {"trough.tan_inclination": slopes, "trough.friction": frictions,
                                      "trough.tan_vibration_angle": tangents, "trough.throw_number": numbers})
    rows = []
    for row in table:
        if not row["efficiency_dem"] or not row["efficiency_theory"]:
            rows.append([row, None, near_a_change(run, row)])
            continue
        rows.append([row, float(row["efficiency_dem"]) - float(row["efficiency_theory"]), near_a_change(run, row)])
    run.write_table("result.csv", ["throw_number", "vibration_angle_deg", "inclination_deg", "friction", "efficiency_block",
                                   "efficiency_theory", "difference", "mode", "near_a_change", "outcome"],
                    [[r["throw_number"], r["vibration_angle_deg"], r["inclination_deg"], r["friction"], r["efficiency_dem"],
                      r["efficiency_theory"], "" if d is None else f"{d:+.4f}", r["mode_theory"], int(near), r["outcome"]]
                     for r, d, near in rows])
    away = [abs(d) for _, d, near in rows if d is not None and not near]
    near = [abs(d) for _, d, near in rows if d is not None and near]
    print(f"{len(away)} cases away from changes of mode, {len(near)} near them, "
          f"{sum(d is None for _, d, _ in rows)} without a steady mean")
    run.check("median |difference|, away from changes of mode", statistics.median(away), 0, 0.006)
    run.check("largest |difference|, away from changes of mode", max(away), 0, 0.02)
    if near:
        print(f"near changes of mode: median {statistics.median(near):.4f}, largest {max(near):.4f}")
    stiffness(run)
    draw(run, rows)
    run.finish()


def stiffness(run):
    """Where the block differs from the theory: does a stiffer contact bring it nearer?"""
    sweep = {"trough.throw_number": [1.7, 2.0] if not run.quick else [2.0],
             "solver.block_stiffness": [100, 300, 1000] if not run.quick else [100, 300]}
    rows = run.campaign("stiffness", {"trough.friction": 0.23, "trough.tan_vibration_angle": 0.25}, sweep)
    stiff = [(g, s) for g in sweep["trough.throw_number"] for s in sweep["solver.block_stiffness"]]
    run.write_table("stiffness.csv", ["throw_number", "contacts_per_cycle", "efficiency_block", "efficiency_theory", "outcome"],
                    [[g, s, row["efficiency_dem"], row["efficiency_theory"], row["outcome"]] for (g, s), row in zip(stiff, rows)])


def draw(run, rows):
    figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    for near, colour, marker, label in [(False, "#0072B2", "o", "away from changes of mode"),
                                        (True, "#D55E00", "x", "near a change of mode or a knee")]:
        here = [(r, d) for r, d, n in rows if n == near and d is not None]
        axes[0].plot([float(r["efficiency_theory"]) for r, _ in here], [float(r["efficiency_dem"]) for r, _ in here], marker,
                     ls="", color=colour, ms=5, label=label)
        axes[1].plot([float(r["throw_number"]) for r, _ in here], [d for _, d in here], marker, ls="", color=colour, ms=5)
    axes[0].axline((0, 0), slope=1, color="#999999", lw=0.8)
    axes[0].set(xlabel="efficiency, theory", ylabel="efficiency, rigid block in DEM")
    axes[1].axhline(0, color="#999999", lw=0.8)
    axes[1].set(xlabel="throw number Γ", ylabel="block - theory")
    axes[0].legend(frameon=False)
    figure.savefig(run.output / "block.png", dpi=120)


if __name__ == "__main__":
    main()
