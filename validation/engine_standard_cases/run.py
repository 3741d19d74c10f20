#!/usr/bin/python3
import math
import pathlib
import sys
from collections.abc import Mapping, Sequence

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))
sys.path.insert(0, str(FOLDER.parent / "engine_impact"))

import numpy as np  # noqa: E402
from numpy.typing import NDArray  # noqa: E402

import engine_deck  # noqa: E402
import exact  # noqa: E402
from vibrotrough.figures import style  # noqa: E402
import law  # noqa: E402
from validation_case import ValidationCase, read_table  # noqa: E402

Floats = NDArray[np.float64]
Point = tuple[int, float, float, float]  # type, x, y, z

LAW = 0.001
DEFAULT_OPTIONS = "limitForce off tangential_damping on"  # of LIGGGHTS; the negative control
FALL = {"drop": 0.4, "radius": 0.1, "mass": law.sphere_mass(0.1, 2600)}
STACK_RADIUS, STACK_MASSES, STACK_STIFFNESS = 0.0005, (law.sphere_mass(0.0005, 2e4), law.sphere_mass(0.0005, 1e4)), 1e3
SLIP_RADIUS, SLIP_MASS, SLIP_STIFFNESS, SLIP_SPEED = 0.0005, law.sphere_mass(0.0005, 1e4), 1e4, 0.1
SLIP_FRICTIONS = [0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
ALUMINA = law.Grain(0.0025, law.sphere_mass(0.0025, 4000), *law.moduli((380e9, 0.23), (70e9, 0.25)))
IMPACT_SPEED, IMPACT_FRICTION = 3.9, 0.092
LINEAR_NORMAL, LINEAR_TANGENTIAL = 1.72e7, 1.48e7  # N/m


def per_pair(name: str, types: int, values: Mapping[tuple[int, int], float], other: float) -> str:
    """The command for a property of pairs of types; `values` by (smaller type, larger type), `other` for all other pairs."""
    matrix = " ".join(repr(values.get((min(i, j), max(i, j)), other)) for i in range(1, types + 1) for j in range(1, types + 1))
    return f"fix {name} all property/global {name} peratomtypepair {types} {matrix}\n"


def springs(types: int, normal: float, tangential: float, damping: Mapping[tuple[int, int], float], friction: Mapping[tuple[int, int], float]) -> str:
    """Linear contacts: spring constants in N/m, damping in 1/s (LIGGGHTS multiplies it by the reduced mass)."""
    return (per_pair("kn", types, {}, normal) + per_pair("kt", types, {}, tangential) + per_pair("gamman", types, damping, 0.0)
            + per_pair("gammat", types, damping, 0.0) + per_pair("coefficientFriction", types, friction, 0.0))


def prepare(folder: pathlib.Path, materials: str, grains: Sequence[Point], velocities: Sequence[tuple[float, float]], floor: tuple[float, float, float]) -> None:
    """Writes what the decks include; velocities along x and z, `floor` as length, width and size of the triangles."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "materials.liggghts").write_text(materials)
    (folder / "grains.liggghts").write_text("".join(f"create_atoms {kind} single {x!r} {y!r} {z!r}\n" for kind, x, y, z in grains))
    (folder / "velocities.liggghts").write_text("".join(
        f"group one id {i + 1}\nvelocity one set {vx!r} 0 {vz!r}\ngroup one delete\n" for i, (vx, vz) in enumerate(velocities)))
    (folder / "floor.stl").write_text(engine_deck.flat_floor(*floor))


def places(count: int, spacing: float) -> list[tuple[float, float]]:
    """A row of grains, off the nodes and edges of the floor."""
    return [((i + 0.487) * spacing, 0.463 * spacing) for i in range(count)]


def damping(restitution: float, run: ValidationCase) -> float:
    """Share of critical damping; doubled in the negative control."""
    return exact.damping_ratio(restitution) * (2.0 if run.control else 1.0)


def fall(run: ValidationCase, stiffness: float, restitutions: Sequence[float], duration: float, step: float = 1e-5) -> tuple[Floats, Floats]:
    """Times, and heights of the lowest points of the grains, shape (times, grains)."""
    folder = run.own_runs() / f"fall-{stiffness:g}"
    types, omega = len(restitutions) + 1, math.sqrt(stiffness / FALL["mass"])
    values = {(i + 1, types): 2 * damping(e, run) * omega for i, e in enumerate(restitutions)}
    where = places(len(restitutions), 0.5)
    length = 0.5 * len(restitutions)
    prepare(folder, springs(types, stiffness, stiffness, values, {}),
            [(i + 1, *place, FALL["radius"] + FALL["drop"]) for i, place in enumerate(where)], [], (length, 0.5, 0.25))
    engine_deck.run_deck(folder, FOLDER / "fall.liggghts", {"types": types, "length": length, "width": 0.5, "steps": round(duration / step), "step": step})
    numbers, columns = engine_deck.read_dump(folder / "fall.dump")
    return numbers * step, columns["z"] - FALL["radius"]


def judge_fall(run: ValidationCase) -> tuple[Floats, Floats]:
    """DEM-01: the path of a grain that falls on a soft floor."""
    restitutions = [0.9, 0.8, 0.7, 0.6]
    times, height = fall(run, 1e4, restitutions, 1.0)
    omega = math.sqrt(1e4 / FALL["mass"])
    for i, e in enumerate(restitutions):
        phases = exact.bounces(FALL["drop"], omega, exact.damping_ratio(e), times[-1])
        run.check(f"DEM-01, restitution {e}: largest deviation of the height from the exact path, over the drop",
                  np.abs(height[:, i] - exact.heights(phases, times)).max() / FALL["drop"], 0, LAW,
                  because="a contact is 10,000 steps; what remains is that it is noticed up to one step late")
    return times, height


def judge_bounces(run: ValidationCase) -> None:
    """DEM-02: heights after bounces, for springs ten and a hundred times as stiff, against the springs and against a rigid floor."""
    restitutions = [1.0, 0.9, 0.8, 0.7, 0.6, 0.5]
    rigid = {}
    for stiffness, step in ((5e4, 1e-5), (5e5, 1e-5), (5e6, 4e-6)):
        times, height = fall(run, stiffness, restitutions, 2.0, step)
        omega = math.sqrt(stiffness / FALL["mass"])
        worst, far = 0.0, 0.0
        for i, e in enumerate(restitutions):
            wanted = exact.apexes(exact.bounces(FALL["drop"], omega, exact.damping_ratio(e), times[-1]))[:3]
            found = peaks(height[:, i])[:len(wanted)]
            wanted = wanted[:len(found)]
            worst = max(worst, float(np.abs(found - wanted).max()) / FALL["drop"])
            far = max(far, abs(float(found[0]) / (FALL["drop"] * e**2) - 1))
        rigid[stiffness] = far
        run.check(f"DEM-02, {stiffness:g} N/m: largest deviation of the first three heights from those of the spring, over the drop", worst, 0, LAW,
                  because="a contact is 1000 steps or more, and is noticed up to one step late")
    run.between("DEM-02: first height over that of a rigid floor (hard spheres), 5e5 N/m against 5e6 N/m: ratio of the deviations",
                rigid[5e5] / rigid[5e6], 2.0, 5.0, because="gravity acts during the contact, whose duration falls with the root of the stiffness: 3.2")


def peaks(height: Floats) -> Floats:
    """The highest points between contacts: the vertex of the parabola through the highest point of each flight and its neighbours."""
    inner = np.nonzero((height[1:-1] > 0) & (height[1:-1] >= height[:-2]) & (height[1:-1] > height[2:]))[0] + 1
    before, top, after = height[inner - 1], height[inner], height[inner + 1]
    vertex: Floats = top + (before - after) ** 2 / (8 * (2 * top - before - after))
    return vertex


def judge_stack(run: ValidationCase) -> None:
    """DEM-03: two grains between two walls, of densities 20,000 and 10,000 kg/m3."""
    folder, restitutions = run.own_runs() / "stack", [1.0, 0.9, 0.8, 0.7, 0.6, 0.5]
    types = 2 * len(restitutions) + 1
    values: dict[tuple[int, int], float] = {}
    grains: list[Point] = []
    for i, (e, (x, y)) in enumerate(zip(restitutions, places(len(restitutions), 0.003))):
        beta, lower, upper = damping(e, run), 2 * i + 1, 2 * i + 2
        reduced = STACK_MASSES[0] * STACK_MASSES[1] / sum(STACK_MASSES)
        values |= {(lower, types): 2 * beta * math.sqrt(STACK_STIFFNESS / STACK_MASSES[0]),
                   (upper, types): 2 * beta * math.sqrt(STACK_STIFFNESS / STACK_MASSES[1]),
                   (lower, upper): 2 * beta * math.sqrt(STACK_STIFFNESS / reduced)}
        grains += [(lower, x, y, 0.25 * 0.0018), (upper, x, y, 0.75 * 0.0018)]
    length = 0.003 * len(restitutions)
    prepare(folder, springs(types, STACK_STIFFNESS, STACK_STIFFNESS, values, {}), grains, [], (length, 0.003, 0.0015))
    (folder / "densities.liggghts").write_text("".join(
        f"set type {kind + 1} density {20000 if kind % 2 == 0 else 10000}\n" for kind in range(types - 1)))
    engine_deck.run_deck(folder, FOLDER / "stack.liggghts", {"types": types, "length": length, "width": 0.003})
    steps, columns = engine_deck.read_dump(folder / "stack.dump")
    times = steps * 1e-7
    for i, e in enumerate(restitutions):
        wanted = exact.stacked(STACK_RADIUS, STACK_MASSES, STACK_STIFFNESS, e, 0.0018, times)
        run.check(f"DEM-03, restitution {e}: largest deviation of both heights from the exact motion, over the radius",
                  np.abs(columns["z"][:, 2 * i:2 * i + 2] - wanted).max() / STACK_RADIUS, 0, LAW, because="a period is 6000 steps")


def judge_slip(run: ValidationCase, options: str) -> tuple[Floats, Floats, Floats]:
    """DEM-04: a grain slides, and rolls from t = 2 u0 / (7 mu g) with 5/7 of its speed."""
    folder = run.own_runs() / "slip"
    types, sink = len(SLIP_FRICTIONS) + 1, SLIP_MASS * exact.GRAVITY / SLIP_STIFFNESS
    values = {(i + 1, types): mu for i, mu in enumerate(SLIP_FRICTIONS)}
    length = 0.003 * len(SLIP_FRICTIONS)
    prepare(folder, springs(types, SLIP_STIFFNESS, SLIP_STIFFNESS, dict.fromkeys(values, 1e4), values),
            [(i + 1, *place, SLIP_RADIUS - sink) for i, place in enumerate(places(len(SLIP_FRICTIONS), 0.003))],
            [(SLIP_SPEED, 0.0)] * len(SLIP_FRICTIONS), (length, 0.003, 0.0015))
    engine_deck.run_deck(folder, FOLDER / "slip.liggghts", {"types": types, "length": length, "width": 0.003, "options": options})
    steps, columns = engine_deck.read_dump(folder / "slip.dump")
    times, speed, spin = steps * 1e-6, columns["vx"] / SLIP_SPEED, columns["omegay"] * SLIP_RADIUS / SLIP_SPEED
    friction = np.array(SLIP_FRICTIONS)
    loss = friction * exact.GRAVITY * times[:, None] / SLIP_SPEED
    run.check("DEM-04: largest deviation of the speed from max(1 - mu g t / u0, 5/7)", np.abs(speed - np.maximum(1 - loss, 5 / 7)).max(), 0, 2e-3,
              because="the tangential spring must be stretched first (mu m g / k_t) and then oscillates by about mu g sqrt(2 m / (7 k_t)) / u0 = 1e-3")
    run.check("DEM-04: largest deviation of the spin from min(5/2 mu g t / u0, 5/7)", np.abs(spin - np.minimum(2.5 * loss, 5 / 7)).max(), 0, 4e-3,
              because="the same, times 5/2 by the moment of inertia")
    ends = times[np.argmax(spin >= speed, axis=0)] * friction * exact.GRAVITY / SLIP_SPEED
    run.check("DEM-04: largest deviation of the end of slip from 2 u0 / (7 mu g), relative", np.abs(ends / (2 / 7) - 1).max(), 0, 0.01,
              because="the time is read between points 10 microseconds apart, of the 3 ms that slip lasts at the largest friction")
    return times, speed, spin


def oblique(run: ValidationCase, model: str, options: str, angles: Floats) -> tuple[Floats, Floats]:
    """DEM-05: rebound angle (degrees) and spin (rad/s) at each impact angle (degrees from the normal)."""
    folder = run.own_runs() / f"oblique-{model.partition('/')[0]}"
    if model == "hertz":
        materials = ("fix modulus all property/global youngsModulus peratomtype 380e9 70e9\nfix poisson all property/global poissonsRatio peratomtype 0.23 0.25\n"
                     + per_pair("coefficientRestitution", 2, {}, 1.0) + per_pair("coefficientFriction", 2, {}, IMPACT_FRICTION))
    else:
        materials = springs(2, LINEAR_NORMAL, LINEAR_TANGENTIAL, {}, {(1, 2): IMPACT_FRICTION})
    radians = np.radians(angles)
    prepare(folder, materials, [(1, *place, ALUMINA.radius + 1e-6) for place in places(len(angles), 0.015)],
            [(IMPACT_SPEED * math.sin(a), -IMPACT_SPEED * math.cos(a)) for a in radians], (0.015 * len(angles), 0.015, 0.0075))
    engine_deck.run_deck(folder, FOLDER / "oblique.liggghts", {"length": 0.015 * len(angles), "width": 0.015, "model": model, "options": options})
    _, columns = engine_deck.read_dump(folder / "oblique.dump")
    last = {name: values[-1] for name, values in columns.items()}
    return np.degrees(np.arctan2(last["vx"], last["vz"])), last["omegay"]


def judge_oblique(run: ValidationCase, options: str) -> dict[str, tuple[Floats, Floats, Floats]]:
    """Against the contact law, another program and the experiment; gives angles, rebound angles and spins by model."""
    other = read_table(FOLDER / "mfix.csv")
    experiment = read_table(FOLDER / "experiment.csv")
    measured = {name: np.array([(float(row["impact_angle"]), float(row["value"])) for row in experiment if row["quantity"] == name])
                for name in ("rebound_angle", "spin")}
    common = np.array([float(row["impact_angle"]) for row in other])
    angles = np.concatenate([common, measured["rebound_angle"][1:, 0], measured["spin"][:, 0]])
    results = {}
    for model, short, tolerance in (("hertz", "hertz", 0.2), ("hooke/stiffness", "linear", 0.2)):
        rebound, spin = oblique(run, model, options, angles)
        results[short] = (angles, rebound, spin)
        count = len(common)
        run.check(f"DEM-05, {short} contacts: largest difference of the rebound angle from that of MFiX, degrees",
                  np.abs(rebound[:count] - np.array([float(row[f"{short}_angle"]) for row in other])).max(), 0, tolerance,
                  because="the lever of the friction is the radius less half of the overlap here, and the radius there")
        run.check(f"DEM-05, {short} contacts: largest difference of the spin from that of MFiX, rad/s",
                  np.abs(spin[:count] - np.array([float(row[f"{short}_spin"]) for row in other])).max(), 0, 15,
                  because="the same; 620 rad/s are the largest")
    radians = np.radians(angles)
    _, along, lawful = law.impact(1 - 1e-12, IMPACT_FRICTION, IMPACT_SPEED * np.cos(radians), IMPACT_SPEED * np.sin(radians), grain=ALUMINA)
    rebound, spin = results["hertz"][1:]
    run.check("DEM-05, hertz contacts: largest deviation of the tangential speed from the contact law, over the impact speed",
              np.abs(np.tan(np.radians(rebound)) * IMPACT_SPEED * np.cos(radians) - along).max() / IMPACT_SPEED, 0, LAW, because="a contact is 1300 steps")
    run.check("DEM-05, hertz contacts: largest deviation of the spin from the contact law, rad/s", np.abs(spin - lawful).max(), 0, 1.0, because="the same")
    begin = len(common)
    angle_error = rebound[begin:begin + len(measured["rebound_angle"]) - 1] - measured["rebound_angle"][1:, 1]
    spin_error = spin[begin + len(measured["rebound_angle"]) - 1:] - measured["spin"][:, 1]
    run.finding("Kharaz et al.: the rebound angles", bool(np.abs(angle_error).max() <= 2.0),
                f"largest difference {np.abs(angle_error).max():.1f} degrees of {len(angle_error)} angles from 2 to 60 degrees")
    run.finding("Kharaz et al.: the spin after the impact", bool(np.abs(spin_error).max() <= 0.1 * measured["spin"][:, 1].max()),
                f"largest difference {np.abs(spin_error).max():.0f} rad/s of {len(spin_error)} impacts, where the largest spin is {measured['spin'][:, 1].max():.0f}")
    return results


def draw(run: ValidationCase, path: tuple[Floats, Floats], slip: tuple[Floats, Floats, Floats], impacts: Mapping[str, tuple[Floats, Floats, Floats]]) -> None:
    figure, axes = style.new_figure(1, 3, size=(14, 4.4), layout="constrained")
    times, height = path
    for i, e in enumerate([0.9, 0.8, 0.7, 0.6]):
        axes[0].plot(times, height[:, i], color=style.COLOURS[i], label=f"restitution {e}")
        phases = exact.bounces(FALL["drop"], math.sqrt(1e4 / FALL["mass"]), exact.damping_ratio(e), times[-1])
        axes[0].plot(times[::25], exact.heights(phases, times[::25]), "k.", ms=3, label="exact" if i == 0 else None)
    axes[0].set(xlabel="time [s]", ylabel="height above the floor [m]", title="DEM-01: fall on a soft floor")
    times, speed, spin = slip
    for i, mu in enumerate(SLIP_FRICTIONS[:5:2]):
        k, colour = SLIP_FRICTIONS.index(mu), style.COLOURS[i]
        axes[1].plot(times * 1e3, speed[:, k], color=colour, label=f"friction {mu}")
        axes[1].plot(times * 1e3, spin[:, k], "--", color=colour)
    axes[1].axhline(5 / 7, color="k", lw=0.8, ls=":")
    axes[1].set(xlabel="time [ms]", ylabel="speed (solid), spin \u00d7 radius (dashed) / first speed", title="DEM-04: from sliding to rolling")
    experiment = read_table(FOLDER / "experiment.csv")
    for i, (name, (angles, rebound, _)) in enumerate(impacts.items()):
        order = np.argsort(angles)
        axes[2].plot(angles[order], rebound[order], color=style.COLOURS[i], ls=style.DASHES[i], label=f"engine, {name} contacts")
    points = np.array([(float(row["impact_angle"]), float(row["value"])) for row in experiment if row["quantity"] == "rebound_angle"])
    axes[2].plot(points[:, 0], points[:, 1], "ko", fillstyle="none", label="experiment (Kharaz et al., 2001)")
    axes[2].set(xlabel="impact angle [degrees from the normal]", ylabel="rebound angle [degrees]", title="DEM-05: oblique impact")
    for part in axes:
        part.legend(fontsize=8)
        style.plain_axes(part)
    figure.savefig(run.figure("cases.png"), dpi=110)


def main() -> None:
    run = ValidationCase(FOLDER)
    options = DEFAULT_OPTIONS if run.control else engine_deck.CONTACT_OPTIONS
    path = judge_fall(run)
    judge_bounces(run)
    judge_stack(run)
    slip = judge_slip(run, options)
    impacts = judge_oblique(run, options)
    if not run.control:
        draw(run, path, slip, impacts)
    run.finish()


if __name__ == "__main__":
    main()
