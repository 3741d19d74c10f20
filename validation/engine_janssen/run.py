#!/usr/bin/python3
import pathlib
import sys
from typing import Any

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import numpy as np  # noqa: E402
from numpy.typing import NDArray  # noqa: E402

from campaign_program import campaign_text  # noqa: E402
import engine_deck  # noqa: E402
from vibrotrough.figures import style  # noqa: E402
from campaign_program import Row  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

Floats = NDArray[np.float64]

HEIGHTS = [9, 18, 36, 72, 108]  # mm, of the fillings
PACKINGS = {"free": 4, "blocked": 2}
GRAVITY = 9.81
LINES = 20  # of 10 ms each: the last 0.2 s of lowering
COLUMNS = ["rotation", "height_mm", "packing", "mass_kg", "centre_height_m", "floor_N", "walls_N", "wall_normal_N"]


def lowered(folder: pathlib.Path) -> tuple[float, float, float, float, float]:
    """Settles a packing, lowers the floor under it, and gives mass, height of the centre and the forces (all positive, N)."""
    rest = engine_deck.settled(engine_deck.run_deck(folder, "settle.liggghts", wanted="VIBROTROUGH SETTLED", resume=True))
    deck = (folder / "in.liggghts").read_text(encoding="utf-8")
    head = deck[:deck.index("# --- drive")]
    engine_deck.write_if_new(folder / "lower.liggghts", head + (FOLDER / "lower.liggghts").read_text(encoding="utf-8"))
    engine_deck.run_deck(folder, "lower.liggghts", resume=True)
    table = engine_deck.read_lines(folder / "lower.csv")
    floor, walls, normal = (table[name][-LINES:].mean() for name in ("floor_z", "walls_z", "walls_n"))
    return rest["mass"], rest["centre_height"], -floor, -walls, normal


def simulate(run: ValidationCase) -> None:
    base, rows = run.sections(), []
    for rotation, packings in PACKINGS.items():
        text = campaign_text(base, {"grains.rotation": rotation, "measure.packings": packings}, {"layer.height": [f"{h} mm" for h in HEIGHTS]})
        for i, folder in enumerate(engine_deck.campaign_decks(run.program, run.runs / rotation, text, resume=True)):
            row = [rotation, HEIGHTS[i // packings], i % packings + 1, *(f"{value:.9g}" for value in lowered(folder))]
            print(*row, flush=True)
            rows.append(row)
    run.write_table("result.csv", COLUMNS, rows)


def saturating(depth: Floats) -> Floats:
    """Janssen: floor force over weight, at `depth` = height over the length in which the walls take over."""
    return np.where(depth < 1e-9, 1.0, -np.expm1(-depth) / np.maximum(depth, 1e-12))


def fit_length(height: Floats, ratio: Floats) -> float:
    """The length that fits the floor's part of the weight best: least squares over a fine grid, m."""
    lengths = np.geomspace(0.2, 50, 4000) * height.max()
    lengths = np.append(lengths, np.geomspace(0.01, 0.2, 4000) * height.max())
    return lengths[np.argmin([((saturating(height / length) - ratio) ** 2).sum() for length in lengths])]


def judge_forces(run: ValidationCase, rotation: str, column: dict[str, Floats], weight: Floats, mobilised: Floats) -> None:
    """Balance and Coulomb, which hold in every packing."""
    run.check(f"{rotation}: floor and walls together over the weight, largest deviation",
              np.abs((column["floor_N"] + column["walls_N"]) / weight - 1).max(), 0, 5e-3,
              because="the grains jolt as they slip: 10 mm/s in 0.2 s is 5e-3 g")
    run.between(f"{rotation}: largest wall friction over mu times the normal force on the walls", mobilised.max(), 0, 1 + 1e-5,
                because="Coulomb holds at each contact and step, so in sums and means")


def judge(run: ValidationCase, rotation: str, rows: list[Row], base: dict[str, Any]) -> dict[str, Any]:
    """Means over the packings of each height, and Janssen's curve through them."""
    column = {name: np.array([float(row[name]) for row in rows]) for name in COLUMNS[1:]}
    width, friction = float(base["layer"]["width"].split()[0]) / 1000, base["trough"]["side_wall_friction"]
    weight = column["mass_kg"] * GRAVITY
    mobilised = column["walls_N"] / (friction * column["wall_normal_N"])
    judge_forces(run, rotation, column, weight, mobilised)
    each = [column["height_mm"] == h for h in HEIGHTS]
    height, ratio, floor = (np.array([values[these].mean() for these in each])
                            for values in (2 * column["centre_height_m"], column["floor_N"] / weight, column["floor_N"]))
    length = np.inf if run.control else fit_length(height, ratio)
    tall = mobilised[column["height_mm"] > 1000 * width].mean()
    return {"height": 2 * column["centre_height_m"], "ratio": column["floor_N"] / weight, "length": length, "width": width,
            "mobilised": tall, "k": 0 if run.control else width / (2 * length * friction * tall),
            "off": np.abs(ratio - saturating(height / length)).max(), "growth": floor[-1] / floor[-2]}


def judge_free(run: ValidationCase, answer: dict[str, Any]) -> None:
    """Spheres that roll rearrange as the floor goes down: Janssen's balance holds for them."""
    run.check("free: largest deviation of the floor's part of the weight from Janssen's curve", answer["off"], 0, 0.06,
              because="packings of a slot of six diameters differ by up to 0.12, and the mean of four is known to half of that")
    bounds = {row["name"]: float(row["value"]) for row in run.reference()}
    run.between("free: Janssen's k from the curve and the mobilised friction", answer["k"], bounds["k_active"], bounds["k_passive"],
                because="Rankine: between the active and the passive state of a filling with an angle of friction of 30 degrees")
    run.check("free: floor force of a filling of 108 mm over one of 72 mm", answer["growth"], 1, 0.15,
              because="saturation: Janssen's curve with this length says 1.04, and means of four packings differ by 10 %")
    run.finding("the walls' friction is fully mobilised, as Janssen assumes", answer["mobilised"] > 0.95,
                f"free spheres mobilise {answer['mobilised']:.2f} of it: those at the walls roll")


def judge_blocked(run: ValidationCase, answer: dict[str, Any]) -> None:
    run.check("blocked: mobilised part of the walls' friction", answer["mobilised"], 1, 1e-3, because="every contact with the walls slides")
    run.finding("Janssen's curve holds for grains that cannot rotate", answer["off"] < 0.06,
                f"they slide down as a plug that does not yield: the walls' normal force stays as the filling left it, the floor's force still grows by "
                f"{100 * (answer['growth'] - 1):.0f} % from 72 to 108 mm, and the best curve is off by {answer['off']:.2f}")


def draw(run: ValidationCase, answers: dict[str, dict[str, Any]]) -> None:
    figure, axes = style.new_figure(size=(7.2, 4.6), layout="constrained")
    fine = np.linspace(0.01, 7, 300)
    for i, (rotation, a) in enumerate(answers.items()):
        look = {"color": style.COLOURS[i]}
        axes.plot(a["height"] / a["width"], a["ratio"], style.MARKERS[i], fillstyle="none", label=f"engine, rotation {rotation}", **look)
        axes.plot(fine, saturating(fine * a["width"] / a["length"]), style.DASHES[i],
                  label=f"Janssen, k = {a['k']:.2f}, friction mobilised to {a['mobilised']:.2f}", **look)
    axes.axhline(1, color="k", ls=":", lw=1, label="liquid")
    axes.set(xlabel="filling height / distance of the walls  [-]", ylabel="force on the floor / weight  [-]", ylim=(0, 1.05), xlim=(0, 7))
    axes.legend(fontsize=8)
    style.plain_axes(axes)
    figure.savefig(run.figure("janssen.png"), dpi=110)


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        simulate(run)
    base = run.sections()
    rows = run.table("result.csv")
    answers = {rotation: judge(run, rotation, [row for row in rows if row["rotation"] == rotation], base) for rotation in PACKINGS}
    judge_free(run, answers["free"])
    judge_blocked(run, answers["blocked"])
    if not run.control:
        draw(run, answers)
    run.finish()


if __name__ == "__main__":
    main()
