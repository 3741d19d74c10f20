#!/usr/bin/python3
import pathlib
import sys
from collections.abc import Sequence

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import numpy as np  # noqa: E402
from numpy.typing import NDArray  # noqa: E402

import engine_deck  # noqa: E402
from vibrotrough.figures import style  # noqa: E402
import law  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

Floats = NDArray[np.float64]
Steps = NDArray[np.int64]
Columns = dict[str, Floats]
Impact = tuple[float, float]  # nominal restitution, tangential over normal speed

NOMINAL = [0.3, 0.5, 0.7, 0.9, 1.0]  # the types of grain; the floor is the last type
FRICTION = 0.3
NORMAL = 0.25  # m/s
ANGLES = [0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 1.1, 1.3, 1.5, 1.75, 2, 2.5, 3, 3.5, 4, 5, 6, 8]  # tangential over normal speed
OBLIQUE = [0.5, 0.9]  # nominal restitutions of the oblique impacts
DROP = 0.01  # m
SLOWEST = 0.1  # m/s, of the bounces that are judged
LAW = 0.001


def prepare(folder: pathlib.Path, grains: list[tuple[int, float, float, float]], velocities: Sequence[tuple[float, float]] = ()) -> None:
    """Writes what the decks include: materials, grains at (type, x, y, z), their velocities (vx, vz), the floor."""
    folder.mkdir(parents=True, exist_ok=True)
    materials = engine_deck.materials(law.YOUNG, law.POISSON, NOMINAL, [FRICTION] * len(NOMINAL))
    (folder / "materials.liggghts").write_text(materials)
    (folder / "grains.liggghts").write_text("".join(f"create_atoms {kind} single {x} {y} {z}\n" for kind, x, y, z in grains))
    (folder / "velocities.liggghts").write_text("".join(
        f"group one id {i + 1}\nvelocity one set {vx} 0 {vz}\ngroup one delete\n" for i, (vx, vz) in enumerate(velocities)))
    (folder / "floor.stl").write_text(engine_deck.flat_floor(0.1, 0.1, 0.02))


def place(i: int) -> tuple[float, float]:
    """Off the mesh's nodes and edges, three diameters apart."""
    return round(0.0071 + 0.009 * (i % 10), 6), round(0.0053 + 0.009 * (i // 10), 6)


def run_bounces(folder: pathlib.Path, options: str) -> tuple[Steps, Columns]:
    prepare(folder, [(kind + 1, *place(3 * kind), law.RADIUS + DROP) for kind in range(len(NOMINAL))])
    engine_deck.run_deck(folder, FOLDER / "bounce.liggghts", {"options": options})
    return engine_deck.read_dump(folder / "bounce.dump")


def flights(z: Floats, vz: Floats) -> list[float]:
    """Apex heights above the floor of one grain's flights, each from its energy, z - R + v^2/(2g), which a flight keeps."""
    heights, now = [], []
    for height, speed in zip(z - law.RADIUS, vz):
        if height > 0:
            now.append(height + speed**2 / (2 * law.GRAVITY))
        elif now:
            heights.append(float(np.median(now)))
            now = []
    return heights


def judge_bounces(run: ValidationCase, columns: Columns) -> None:
    for kind, nominal in enumerate(NOMINAL):
        apex = np.array(flights(columns["z"][:, kind], columns["vz"][:, kind]))
        speed = np.sqrt(2 * law.GRAVITY * apex)
        judged = [i for i in range(len(speed) - 1) if speed[i] >= SLOWEST][:5]
        after = law.impact(min(nominal, 1 - 1e-12), 0, speed[judged], 0, gravity=law.GRAVITY)[0]
        run.check(f"bouncing grain, nominal restitution {nominal}: largest deviation of {len(judged)} bounces' speeds from the law",
                  np.abs(speed[1:][judged] / speed[judged] - after / speed[judged]).max(), 0, LAW,
                  because="a contact is 500 steps of the engine; 4e-4 was seen")
        if nominal == 1.0:
            run.check(f"elastic grain: height after {len(apex) - 1} bounces over the first", apex[-1] / apex[0], 1, 1e-3,
                      because="energy is kept but for the integrator's error; 3e-7 was seen")


def run_impacts(folder: pathlib.Path, options: str) -> tuple[list[Impact], Columns, Floats, Floats]:
    """Elastic and oblique impacts; the columns of the last moment, and the whole path of the elastic grain (the first)."""
    cases = [(1.0, 0.0)] + [(e, angle) for e in OBLIQUE for angle in ANGLES]
    prepare(folder, [(NOMINAL.index(e) + 1, *place(i), law.RADIUS + 1e-5) for i, (e, _) in enumerate(cases)],
            [(round(angle * NORMAL, 9), -NORMAL) for _, angle in cases])
    engine_deck.run_deck(folder, FOLDER / "impact.liggghts", {"options": options})
    steps, columns = engine_deck.read_dump(folder / "impact.dump")
    last = {name: values[-1] for name, values in columns.items()}
    return cases, last, steps * 5e-7, columns["z"][:, 0]


def judge_elastic(run: ValidationCase, last: Columns, time: Floats, z: Floats) -> None:
    """Hertz's impact in closed form: duration, largest overlap, no loss."""
    overlap = law.RADIUS - z
    run.check("elastic impact: speed after over before", last["vz"][0] / NORMAL, 1, 1e-3, because="1/1000 of a contact per step")
    run.check("elastic impact: largest overlap over Hertz's", overlap.max() / law.hertz_overlap(NORMAL), 1, 1e-3, because="the same")
    inside = np.nonzero(overlap > 0)[0]
    first, end = inside[0], inside[-1]
    begin = time[first] - overlap[first] / NORMAL
    finish = time[end] + overlap[end] / NORMAL
    run.check("elastic impact: duration over 2.868 (m^2 / (R E*^2 v))^(1/5)", (finish - begin) / law.hertz_duration(NORMAL), 1, 3e-3,
              because="the lines of the path are 1/100 of a contact apart")


def judge_oblique(run: ValidationCase, cases: list[Impact], last: Columns) -> None:
    """Against the law at every angle, and against Coulomb and the rigid body where they say it exactly."""
    e, angle = (np.array(values) for values in zip(*cases[1:]))
    vx, vz, spin = last["vx"][1:], last["vz"][1:], last["omegay"][1:]
    lawful = law.impact(e, FRICTION, NORMAL, angle * NORMAL)
    answers = (("normal", vz, lawful[0]), ("tangential", vx, lawful[1]), ("spin x R", spin * law.RADIUS, lawful[2] * law.RADIUS))
    for what, measured, expected in answers:
        run.check(f"oblique impacts: largest deviation of the {what} speed after, over the normal speed before",
                  np.abs(measured - expected).max() / NORMAL, 0, LAW, because="a contact is 1000 steps; 4e-4 was seen")
    impulse = angle * NORMAL - vx
    limit = FRICTION * (NORMAL + vz)
    run.between("oblique impacts: largest tangential impulse over Coulomb's limit", (np.abs(impulse) / limit).max(), 0, 1 + 1e-6,
                because="the cap holds in every step")
    sliding = angle > 2.5 * 3.5 * FRICTION * (1 + e)
    run.check("impacts that slide: largest deviation of the change of speed from mu (1 + e) v_n",
              np.abs(impulse[sliding] / limit[sliding] - 1).max(), 0, 0.01,
              because="the spring must be stretched first, a few hundredths of the contact at these angles")
    ratio = (0.4 * law.RADIUS * spin / impulse)[angle > 0.1]
    run.between("least lever of friction over the radius", ratio.min(), 1 - law.hertz_overlap(NORMAL) / (2 * law.RADIUS), 1,
                because="it is R - d/2, d up to the largest overlap")
    gripping = angle < FRICTION * (1 + e)
    kept = vx[gripping] / (angle[gripping] * NORMAL)
    run.finding("a grain that grips keeps 5/7 of its tangential speed, as a rigid one that rolls at the end", bool(np.abs(kept - 5 / 7).max() < 0.02),
                f"it keeps {kept.min():.3f} to {kept.max():.3f}: the tangential spring (8 G* sqrt(R d), undamped) gives back what a rigid "
                "contact would not; the law integrated by itself gives the same")


def judge_law(run: ValidationCase) -> None:
    for row in run.reference():
        lawful = law.impact(float(row["nominal"]), 0, 0.5, 0)[0][0] / 0.5
        run.check(f"law at nominal restitution {row['nominal']}", lawful, float(row["realised"]), float(row["reading_error"]),
                  because="half of the last digit")


def draw(run: ValidationCase, columns: Columns, times: Floats, cases: list[Impact], last: Columns) -> None:
    figure, (left, right) = style.new_figure(1, 2, size=(11.5, 4.6), layout="constrained")
    for kind, nominal in enumerate(NOMINAL[:4]):
        left.plot(times, (columns["z"][:, kind] - law.RADIUS) * 1e3, color=style.COLOURS[kind], ls=style.DASHES[kind],
                  label=f"nominal e = {nominal}")
        apex, speed = DROP, (2 * law.GRAVITY * DROP) ** 0.5
        time = speed / law.GRAVITY
        for _ in range(4):
            speed = law.impact(nominal, 0, speed, 0, gravity=law.GRAVITY, steps=1000)[0][0]
            time, apex = time + speed / law.GRAVITY, speed**2 / (2 * law.GRAVITY)
            if speed < SLOWEST:
                break
            left.plot([time], [apex * 1e3], "k+")
            time += speed / law.GRAVITY
    left.plot([], [], "k+", label="apex by the law")
    left.set(xlabel="time [s]", ylabel="height above the floor [mm]", xlim=(0, 0.25), ylim=(-0.2, 10.5))
    e, angle = (np.array(values) for values in zip(*cases[1:]))
    fine = np.linspace(0.02, 8, 160)
    for i, nominal in enumerate(OBLIQUE):
        vz, vx, _ = law.impact(nominal, FRICTION, NORMAL, fine * NORMAL)
        scale = FRICTION * (1 + vz.mean() / NORMAL)
        right.plot(fine / scale, vx / (fine * NORMAL), color=style.COLOURS[i], label=f"law, nominal e = {nominal}")
        these = e == nominal
        right.plot(angle[these] / scale, last["vx"][1:][these] / (angle[these] * NORMAL), style.MARKERS[i], color=style.COLOURS[i],
                   fillstyle="none", label=f"engine, nominal e = {nominal}")
    rigid = np.linspace(0.01, 15, 400)
    right.plot(rigid, np.maximum(1 - 1 / rigid, 5 / 7), "k--", lw=1, label="rigid sphere: slides, or rolls (5/7)")
    right.set(xlabel="tangential speed before / (\u03bc (1 + e) normal speed)  [-]", ylabel="tangential speed after / before  [-]", xlim=(0, 15))
    for axes in (left, right):
        axes.legend(fontsize=8)
        style.plain_axes(axes)
    figure.savefig(run.figure("impacts.png"), dpi=110)


def main() -> None:
    run = ValidationCase(FOLDER)
    options = "limitForce off tangential_damping on" if run.control else engine_deck.CONTACT_OPTIONS
    folder = run.own_runs()
    steps, columns = run_bounces(folder / "bounce", options)
    judge_bounces(run, columns)
    cases, last, time, z = run_impacts(folder / "impact", options)
    judge_elastic(run, last, time, z)
    judge_oblique(run, cases, last)
    if not run.control:
        judge_law(run)
        draw(run, columns, steps * 1e-6, cases, last)
    run.finish()


if __name__ == "__main__":
    main()
