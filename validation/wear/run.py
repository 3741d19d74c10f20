#!/usr/bin/python3
import math
import pathlib
import sys
from typing import Any

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import numpy as np  # noqa: E402
from numpy.typing import NDArray  # noqa: E402

import engine_deck  # noqa: E402
import finnie  # noqa: E402
from campaign_program import Row  # noqa: E402
from figure_style import COLOURS, MARKERS, new_figure  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

Floats = NDArray[np.float64]

RADIUS, DENSITY, YOUNG, POISSON, GRAVITY = 0.0015, 1400.0, 5e6, 0.35, 9.81
MASS = DENSITY * 4 / 3 * math.pi * RADIUS**3
RESTITUTION, FRICTION = [0.5, 1.0, 0.5], [0.0, 0.0, 0.3]  # the types of grain
SPEED = 0.25  # m/s, normal
ANGLES = [0.2, 0.5, 1, 2, 3, 4, 6, 10]  # tangential over normal speed
SLIDING = [4, 6, 10]  # well above 3.5 mu (1 + e) = 1.6, below which friction is less than mu times the normal force
SLID = 0.1  # m

NUMBERS, USUAL, OTHERS = [1.0, 1.5, 2.0, 3.0], 20, [5, 80]  # throw numbers; Young's moduli in MPa
COLUMNS = ["throw_number", "modulus_MPa", "cycles", "efficiency", "wear_rate", "wear_rate_half_width", "specific_wear", "specific_wear_half_width"]


def impacts() -> list[tuple[int, float, float]]:
    """Type of grain, normal and tangential speed of each impact."""
    smooth = [(kind, SPEED, angle * SPEED) for kind in (0, 1) for angle in ANGLES]
    return smooth + [(0, 2 * SPEED, 2 * angle * SPEED) for angle in ANGLES] + [(2, SPEED, angle * SPEED) for angle in SLIDING]


def read_wear(path: pathlib.Path) -> dict[str, Floats]:
    """The arrays of a file of LIGGGHTS' dump mesh/vtk, and the corners of the triangles as "POINTS"."""
    words = path.read_text(encoding="utf-8").split()
    arrays = {}
    for i, word in enumerate(words):
        if word == "POINTS":
            arrays[word] = np.array(words[i + 3:i + 3 + 3 * int(words[i + 1])], dtype=float).reshape(-1, 3, 3)
        elif word in ("wear", "area"):
            arrays[word] = np.array(words[i + 4:i + 4 + int(words[i + 2])], dtype=float)
    return arrays


def prepare(folder: pathlib.Path) -> None:
    """What the decks include; a grain in the middle of every second square of the floor."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "materials.liggghts").write_text(engine_deck.materials(YOUNG, POISSON, RESTITUTION, FRICTION))
    (folder / "floor.stl").write_text(engine_deck.flat_floor(0.2, 0.2, 0.01))
    grains, velocities = [], []
    for i, (kind, normal, tangential) in enumerate(impacts()):
        x, y = place(i)
        grains.append(f"create_atoms {kind + 1} single {x} {y} {RADIUS + 1e-6}\n")
        velocities.append(f"group one id {i + 1}\nvelocity one set {tangential} 0 {-normal}\ngroup one delete\n")
    (folder / "grains.liggghts").write_text("".join(grains))
    (folder / "velocities.liggghts").write_text("".join(velocities))


def place(i: int) -> tuple[float, float]:
    return round(0.006 + 0.02 * (i % 10), 6), round(0.0033 + 0.02 * (i // 10), 6)


def rest_overlap() -> float:
    """m, at which Hertz's force carries the grain's weight."""
    stiffness = 4 / 3 * YOUNG / (2 * (1 - POISSON**2)) * math.sqrt(RADIUS)
    return float((MASS * GRAVITY / stiffness) ** (2 / 3))


def simulate(run: ValidationCase) -> None:
    folder = run.runs / "impacts"
    prepare(folder)
    engine_deck.run_deck(folder, FOLDER / "impact.liggghts")
    floor = read_wear(folder / "wear.8000.vtk")
    centres, energy = floor["POINTS"].mean(axis=1), floor["wear"] * floor["area"]
    rows = []
    for i, (kind, normal, tangential) in enumerate(impacts()):
        x, y = place(i)
        near = (np.abs(centres[:, 0] - x) < 0.01) & (np.abs(centres[:, 1] - y) < 0.01)
        rows.append([RESTITUTION[kind], FRICTION[kind], normal, tangential, energy[near].sum()])
    run.write_table("impacts.csv", ["restitution", "friction", "normal_speed_m_per_s", "tangential_speed_m_per_s", "wear_J"], rows)
    engine_deck.run_deck(folder, FOLDER / "slide.liggghts", {"height": RADIUS - rest_overlap()})
    floor = read_wear(folder / "wear.100000.vtk")
    run.write_table("slide.csv", ["way_m", "wear_J"], [[SLID, (floor["wear"] * floor["area"]).sum()]])
    layers(run)


def layers(run: ValidationCase) -> None:
    rows = []
    campaigns: list[tuple[str, dict[str, Any], dict[str, list[Any]]]] = [
        ("throw-number", {}, {"trough.throw_number": NUMBERS}),
        ("longer", {"measure.min_cycles": 80, "measure.max_cycles": 80}, {"trough.throw_number": [2.0]}),
        ("modulus", {}, {"grains.youngs_modulus": [f"{modulus} MPa" for modulus in OTHERS]})]
    for name, changes, sweep in campaigns:
        for i, row in enumerate(run.campaign(name, changes, sweep)):
            modulus = OTHERS[i] if name == "modulus" else USUAL
            rows.append([row["throw_number"], modulus, int(row["cycles_measured"]) + int(row["cycles_discarded"]), row["efficiency"],
                         row["wear_rate_w_per_m2"], row["wear_rate_half_width_w_per_m2"], row["specific_wear_j_per_t_m"],
                         row["specific_wear_half_width_j_per_t_m"]])
    run.write_table("layers.csv", COLUMNS, rows)


def judge_impacts(run: ValidationCase, rows: list[Row]) -> None:
    ratios: dict[tuple[float, float], list[float]] = {}
    for row in rows:
        normal, tangential, friction = (float(row[name]) for name in ("normal_speed_m_per_s", "tangential_speed_m_per_s", "friction"))
        lawful = finnie.hard_impact(MASS, normal, tangential) if run.control else finnie.impact(MASS, normal, tangential, friction)
        ratios.setdefault((normal, friction), []).append(float(row["wear_J"]) / lawful)
    for normal in (SPEED, 2 * SPEED):
        run.check(f"impacts without friction at {normal} m/s: largest deviation of the wear from the closed form, relative",
                  np.abs(np.array(ratios[normal, 0.0]) - 1).max(), 0, 0.005, because="the approach is some 1000 steps of the engine")
    run.check("impacts that slide with friction 0.3: the same", np.abs(np.array(ratios[SPEED, 0.3]) - 1).max(), 0, 0.02,
              because="the tangential spring must be stretched before friction is mu times the normal force")


def judge_layers(run: ValidationCase, rows: list[Row]) -> None:
    usual = next(row for row in rows if float(row["throw_number"]) == 2 and row["modulus_MPa"] == str(USUAL) and row["cycles"] == "160")
    longer = next(row for row in rows if row["cycles"] == "320")
    for name in ("wear_rate", "specific_wear"):
        one, other = float(usual[name]), float(longer[name])
        width = math.hypot(float(usual[name + "_half_width"]), float(longer[name + "_half_width"]))
        run.check(f"layer, {name} of 80 cycles in each packing over that of 40: twice the time wears twice as much", other / one, 1, width / one,
                  because="the interval of both over their packings")
    run.between("layers: least specific wear of any", min(map(float, (row["specific_wear"] for row in rows))), 1e-12, math.inf, because="all wear")
    soft, hard = (float(next(row for row in rows if row["modulus_MPa"] == str(modulus))["specific_wear"]) for modulus in OTHERS)
    run.finding("the wear of a layer does not depend on the softness of its grains", abs(soft / hard - 1) < 0.1,
                f"at throw number 2 it is {soft:.4g} J/t/m at {OTHERS[0]} MPa and {hard:.4g} at {OTHERS[1]} MPa")


def draw(run: ValidationCase, rows: list[Row]) -> None:
    figure, axes = new_figure(size=(7.2, 4.4), layout="constrained")
    angles = np.geomspace(0.15, 12, 200)
    scale = MASS * SPEED**2
    degrees = np.degrees(np.arctan(1 / angles))
    axes.plot(degrees, [finnie.impact(MASS, SPEED, a * SPEED, 0, 2000) / (scale * (1 + a * a)) for a in angles], color=COLOURS[0],
              label="the engine's law in closed form")
    axes.plot(degrees, [finnie.hard_impact(MASS, SPEED, a * SPEED) / (scale * (1 + a * a)) for a in angles], color=COLOURS[1], ls="--",
              label="Finnie's law")
    smooth = [row for row in rows if float(row["friction"]) == 0 and float(row["normal_speed_m_per_s"]) == SPEED and row["restitution"] == "0.5"]
    speeds = [(float(row["normal_speed_m_per_s"]), float(row["tangential_speed_m_per_s"]), float(row["wear_J"])) for row in smooth]
    axes.plot([math.degrees(math.atan2(w, v)) for w, v, _ in speeds], [wear / (MASS * (w * w + v * v)) for w, v, wear in speeds], MARKERS[0],
              color=COLOURS[0], label="the engine, without friction")
    axes.set_xlabel("angle of the impact to the surface  [\u00b0]")
    axes.set_ylabel("wear / (k m v\u00b2)  [-]")
    axes.legend()
    figure.savefig(run.figure("impacts.png"), dpi=110)


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        simulate(run)
    rows = run.table("impacts.csv")
    judge_impacts(run, rows)
    slid = float(run.table("slide.csv")[0]["wear_J"])
    run.between("a grain that slides without impact: wear over 4 times its weight times its overlap at rest", slid / (4 * MASS * GRAVITY * rest_overlap()),
                0, 1, because="f(g) is 2 g at most, so that the wear is at most 4 times the work of pressing the grain in once")
    smooth = [row for row in rows if float(row["friction"]) == 0 and float(row["normal_speed_m_per_s"]) == SPEED and row["restitution"] == "0.5"]
    ratios = [float(row["wear_J"]) / finnie.hard_impact(MASS, SPEED, float(row["tangential_speed_m_per_s"])) for row in smooth]
    run.finding("the engine's wear of an impact is Finnie's, m v^2 f(g)", all(abs(ratio - 1) < 0.1 for ratio in ratios),
                f"it is {min(ratios):.2f} to {max(ratios):.2f} times that at 6 to 79 degrees")
    judge_layers(run, run.table("layers.csv"))
    draw(run, rows)
    run.finish()


if __name__ == "__main__":
    main()
