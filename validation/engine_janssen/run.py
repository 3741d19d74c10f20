#!/usr/bin/python3
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import tomllib  # noqa: E402

import numpy as np  # noqa: E402

import engine_deck  # noqa: E402
import figure_style  # noqa: E402
from campaign_program import campaign_text  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

HEIGHTS = [9, 18, 36, 72, 108]  # mm, of the fillings
ROTATIONS = ["free", "blocked"]
PACKINGS = 2
GRAVITY = 9.81
LINES = 20  # of 10 ms each: the last 0.2 s of lowering
COLUMNS = ["rotation", "height_mm", "packing", "mass_kg", "centre_height_m", "floor_N", "walls_N", "wall_normal_N"]


def lowered(folder):
    """Settles a packing, lowers the floor under it, and gives mass, height of the centre and the forces (all positive, N)."""
    rest = engine_deck.settled(engine_deck.run_deck(folder, "settle.liggghts", wanted="VIBROTROUGH SETTLED"))
    deck = (folder / "in.liggghts").read_text(encoding="utf-8")
    head = deck[:deck.index("# --- drive")]
    (folder / "lower.liggghts").write_text(head + (FOLDER / "lower.liggghts").read_text(encoding="utf-8"), encoding="utf-8")
    engine_deck.run_deck(folder, "lower.liggghts")
    table = engine_deck.read_lines(folder / "lower.csv")
    floor, walls, normal = (table[name][-LINES:].mean() for name in ("floor_z", "walls_z", "walls_n"))
    return rest["mass"], rest["centre_height"], -floor, -walls, normal


def simulate(run):
    base, rows = tomllib.loads((FOLDER / "base.toml").read_text(encoding="utf-8")), []
    for rotation in ROTATIONS:
        text = campaign_text(base, {"grains.rotation": rotation, "measure.packings": PACKINGS}, {"layer.height": [f"{h} mm" for h in HEIGHTS]})
        for i, folder in enumerate(engine_deck.campaign_decks(run.program, run.runs / rotation, text)):
            row = [rotation, HEIGHTS[i // PACKINGS], i % PACKINGS + 1, *(f"{value:.6g}" for value in lowered(folder))]
            print(*row, flush=True)
            rows.append(row)
    run.write_table("result.csv", COLUMNS, rows)


def saturating(depth):
    """Janssen: floor force over weight, at `depth` = height over the length in which the walls take over."""
    return np.where(depth < 1e-9, 1.0, -np.expm1(-depth) / np.maximum(depth, 1e-12))


def fit_length(height, ratio):
    """The length that fits the floor's part of the weight best: least squares over a fine grid, m."""
    lengths = np.geomspace(0.2, 50, 4000) * height.max()
    lengths = np.append(lengths, np.geomspace(0.01, 0.2, 4000) * height.max())
    return lengths[np.argmin([((saturating(height / length) - ratio) ** 2).sum() for length in lengths])]


def judge(run, rotation, rows, base):
    column = {name: np.array([float(row[name]) for row in rows]) for name in COLUMNS[1:]}
    width, friction = float(base["layer"]["width"].split()[0]) / 1000, base["trough"]["side_wall_friction"]
    weight, height = column["mass_kg"] * GRAVITY, 2 * column["centre_height_m"]
    ratio = column["floor_N"] / weight
    run.check(f"{rotation}: floor and walls together over the weight, largest deviation",
              np.abs((column["floor_N"] + column["walls_N"]) / weight - 1).max(), 0, 5e-3, because="the grains jolt as they slip: 5 mm/s in 0.2 s is 2.5e-3 g")
    mobilised = column["walls_N"] / (friction * column["wall_normal_N"])
    run.between(f"{rotation}: largest wall friction over mu times the normal force on the walls", mobilised.max(), 0, 1 + 1e-6,
                because="Coulomb holds at each contact, so in the sum")
    length = np.inf if run.wrong else fit_length(height, ratio)
    run.check(f"{rotation}: largest deviation of the floor's part of the weight from Janssen's curve", np.abs(ratio - saturating(height / length)).max(), 0,
              0.06, because="a slot of six diameters: packings differ by 0.03, walls order the grains, and the free surface is a grain high")
    pressure = 0 if run.wrong else width / (2 * length * friction * mobilised[height > width].mean())
    run.between(f"{rotation}: Janssen's k from the curve and the mobilised friction", pressure, 0.3, 1.2,
                because="between Rankine's active state, 1/3 at 30 degrees, and a liquid, with 20 % for the layers at the walls")
    tall, tallest = (column["floor_N"][column["height_mm"] == h].mean() for h in HEIGHTS[-2:])
    run.check(f"{rotation}: floor force of a filling of {HEIGHTS[-1]} mm over one of {HEIGHTS[-2]} mm", tallest / tall, 1, 0.15,
              because="saturation; the weight grows by 0.5, packings differ by some 5 % in height")
    return {"height": height, "ratio": ratio, "length": length, "width": width, "mobilised": mobilised[height > width].mean(), "k": pressure}


def draw(run, answers):
    figure, axes = figure_style.new_figure(size=(7.2, 4.6), layout="constrained")
    fine = np.linspace(0.01, 7, 300)
    for i, (rotation, a) in enumerate(answers.items()):
        style = {"color": figure_style.COLOURS[i]}
        axes.plot(a["height"] / a["width"], a["ratio"], figure_style.MARKERS[i], fillstyle="none", label=f"engine, rotation {rotation}", **style)
        axes.plot(fine, saturating(fine * a["width"] / a["length"]), figure_style.DASHES[i],
                  label=f"Janssen, k = {a['k']:.2f}, friction mobilised to {a['mobilised']:.2f}", **style)
    axes.axhline(1, color="k", ls=":", lw=1, label="liquid")
    axes.set(xlabel="filling height / distance of the walls  [-]", ylabel="force on the floor / weight  [-]", ylim=(0, 1.05), xlim=(0, 7))
    axes.legend(fontsize=8)
    figure_style.plain_axes(axes)
    figure.savefig(run.figure("janssen.png"), dpi=110)


def main():
    run = ValidationCase(FOLDER)
    if run.long:
        simulate(run)
    base = tomllib.loads((FOLDER / "base.toml").read_text(encoding="utf-8"))
    rows = run.table("result.csv")
    answers = {rotation: judge(run, rotation, [row for row in rows if row["rotation"] == rotation], base) for rotation in ROTATIONS}
    if not run.wrong:
        draw(run, answers)
    run.finish()


if __name__ == "__main__":
    main()
