#!/usr/bin/python3
import math
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import numpy as np  # noqa: E402
from numpy.typing import NDArray  # noqa: E402

import engine_deck  # noqa: E402
from vibrotrough.figures import style  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

Floats = NDArray[np.float64]

RADIUS, DENSITY, YOUNG, POISSON, GRAVITY = 0.0015, 1400.0, 5e6, 0.35, 9.81
ANGLE = math.radians(20)
FRICTIONS = [0.02, 0.05, 0.08, 0.1, 0.11, 0.14, 0.2, 0.26, 0.32, 0.355, 0.375, 0.5]
TIME_STEP = 5e-6
TOLERANCE = 2e-3  # of g sin(alpha)


def resting_overlap() -> float:
    """Hertz: 4/3 E* sqrt(R) d^1.5 carries the weight."""
    weight = DENSITY * 4 / 3 * math.pi * RADIUS**3 * GRAVITY * math.cos(ANGLE)
    return (0.75 * weight * 2 * (1 - POISSON**2) / (YOUNG * math.sqrt(RADIUS))) ** (2 / 3)


def run_incline(folder: pathlib.Path) -> tuple[NDArray[np.int64], dict[str, Floats]]:
    """Steps, and the dumped columns: grain 2 i without rotation, 2 i + 1 with it, for friction i."""
    folder.mkdir(parents=True, exist_ok=True)
    materials = engine_deck.materials(YOUNG, POISSON, [0.5] * len(FRICTIONS), FRICTIONS)
    (folder / "materials.liggghts").write_text(materials)
    lines, height = [], RADIUS - resting_overlap()
    for i in range(len(FRICTIONS)):
        lines += [f"create_atoms {i + 1} single {x} {0.0053 + 0.0071 * i:.6f} {height!r}" for x in (0.0071, 0.0571)]
    blocked, free = (" ".join(str(2 * i + k) for i in range(len(FRICTIONS))) for k in (1, 2))
    (folder / "grains.liggghts").write_text("\n".join([*lines, f"group blocked id {blocked}", f"group free id {free}"]) + "\n")
    (folder / "floor.stl").write_text(engine_deck.flat_floor(0.1, 0.1, 0.02))
    engine_deck.run_deck(folder, FOLDER / "incline.liggghts",
                         {"angle": 20, "types": len(FRICTIONS) + 1, "gx": repr(math.sin(ANGLE)), "gz": repr(-math.cos(ANGLE))})
    return engine_deck.read_dump(folder / "incline.dump")


def slopes(time: Floats, velocities: Floats) -> Floats:
    return np.polyfit(time, velocities, 1)[0]


def expected(friction: float, angle: float, rotates: bool) -> float:
    sliding = GRAVITY * (math.sin(angle) - friction * math.cos(angle))
    return max(sliding, 5 / 7 * GRAVITY * math.sin(angle) if rotates else 0.0)


def judge(run: ValidationCase, columns: dict[str, Floats], time: Floats, angle: float) -> tuple[Floats, Floats, Floats]:
    unit = GRAVITY * math.sin(ANGLE)
    blocked, free = (slopes(time, columns["vx"][:, k::2]) for k in (0, 1))
    spin = slopes(time, columns["omegay"][:, 1::2])
    for what, measured, rotates in (("without rotation", blocked, False), ("free", free, True)):
        worst = max(abs(a - expected(mu, angle, rotates)) for mu, a in zip(FRICTIONS, measured))
        run.check(f"grains {what}: largest deviation of the acceleration, in g sin(alpha)", worst / unit, 0, TOLERANCE,
                  because="overlap shortens the lever, and undamped springs swing")
    rolling = [mu > 2 / 7 * math.tan(angle) for mu in FRICTIONS]
    wanted = [5 / 7 * GRAVITY * math.sin(angle) if rolls else 2.5 * mu * GRAVITY * math.cos(angle) for mu, rolls in zip(FRICTIONS, rolling)]
    run.check("free grains: largest deviation of the spin's growth times R, in g sin(alpha)",
              max(abs(s * RADIUS - w) for s, w in zip(spin, wanted)) / unit, 0, TOLERANCE, because="the same")
    slip = free - spin * RADIUS
    slides = [mu for mu, s in zip(FRICTIONS, slip) if s > 0.01 * unit]
    threshold = {row["name"]: float(row["friction"]) for row in run.reference()}
    run.between("largest friction at which a free grain slides", max(slides), threshold["rolling"] - 0.011, threshold["rolling"],
                because="frictions 0.10 and 0.11 stand on both sides of 2/7 tan(alpha)")
    run.between("largest friction at which a grain without rotation slides", max(mu for mu, a in zip(FRICTIONS, blocked) if a > 0.01 * unit),
                threshold["sliding"] - 0.02, threshold["sliding"], because="frictions 0.355 and 0.375 stand on both sides of tan(alpha)")
    return blocked, free, spin


def judge_rest(run: ValidationCase, columns: dict[str, Floats]) -> None:
    """Grains whose friction holds them swing about a place that does not move, by no more than the contact's spring."""
    held = [2 * i for i, mu in enumerate(FRICTIONS) if mu > math.tan(ANGLE)]
    mass = DENSITY * 4 / 3 * math.pi * RADIUS**3
    stiffness = 8 * YOUNG / (4 * (2 - POISSON) * (1 + POISSON)) * math.sqrt(RADIUS * resting_overlap())
    swing = 2 * mass * GRAVITY * math.sin(ANGLE) / stiffness
    way = columns["c_way[1]"][:, held]
    third = len(way) // 3
    drift = np.abs(way[-third:].mean(axis=0) - way[third:2 * third].mean(axis=0))
    run.between("grains held by friction: largest drift of their place in 50 ms, over the spring's swing 2 m g sin(alpha) / k", drift.max() / swing,
                0, 0.5, because="a swing is at most one wide, and 25 samples leave half of that open; sliding would be 1000 times as far")
    later = np.ptp(way[third:], axis=0)
    run.between("grains held by friction: largest width of that swing", later.max() / swing, 0, 1.05,
                because="wider ones slip until they are narrow enough; the normal overlap swings a little as well")


def draw(run: ValidationCase, blocked: Floats, free: Floats, spin: Floats) -> None:
    figure, axes = style.new_figure(size=(7.2, 4.6), layout="constrained")
    unit = GRAVITY * math.sin(ANGLE)
    fine = np.linspace(0, 0.52, 500)
    for rotates, measured, name, colour in ((False, blocked, "without rotation", 0), (True, free, "free", 1)):
        look = {"color": style.COLOURS[colour]}
        axes.plot(fine, [expected(mu, ANGLE, rotates) / unit for mu in fine], style.DASHES[colour], label=f"{name}, mechanics", **look)
        axes.plot(FRICTIONS, measured / unit, style.MARKERS[colour], fillstyle="none", label=f"{name}, engine", **look)
    axes.plot(fine, np.minimum(2.5 * fine / math.tan(ANGLE), 5 / 7), ":", color=style.COLOURS[2], label="spin x R, mechanics")
    axes.plot(FRICTIONS, spin * RADIUS / unit, "^", fillstyle="none", color=style.COLOURS[2], label="spin x R, engine")
    for friction, name in ((2 / 7 * math.tan(ANGLE), "2/7 tan \u03b1"), (math.tan(ANGLE), "tan \u03b1")):
        axes.axvline(friction, color=style.GREY, lw=0.8)
        axes.text(friction, 1.02, name, ha="center", fontsize=8, color=style.GREY)
    axes.set(xlabel="friction \u03bc  [-]", ylabel="acceleration / (g sin \u03b1)  [-]", ylim=(-0.05, 1.08))
    axes.legend(fontsize=8, loc=(0.69, 0.2))
    style.plain_axes(axes)
    figure.savefig(run.figure("incline.png"), dpi=110)


def main() -> None:
    run = ValidationCase(FOLDER)
    angle = math.radians(19) if run.control else ANGLE
    steps, columns = run_incline(run.own_runs())
    blocked, free, spin = judge(run, columns, steps * TIME_STEP, angle)
    judge_rest(run, columns)
    if not run.control:
        draw(run, blocked, free, spin)
    run.finish()


if __name__ == "__main__":
    main()
