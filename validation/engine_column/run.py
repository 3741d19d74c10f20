#!/usr/bin/python3
import math
import pathlib
import re
import sys
from typing import Any

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import numpy as np  # noqa: E402

from campaign_program import campaign_text  # noqa: E402
import engine_deck  # noqa: E402
from vibrotrough.figures import style  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

Answer = tuple[dict[str, engine_deck.Floats], float, float]  # phases, normal weight (N), time step (s)

SLOPES = [0.0, -0.2]
STANDING: dict[str, Any] = {"trough.amplitude": "1 um", "trough.throw_number": 0.1}


def mass_of(deck: str, density: float) -> float:
    """From the grains that the deck's head states: '54 of diameter 0.0027 m'."""
    grains = re.findall(r"#\s+(\d+) of diameter (\S+) m", deck)
    return sum(int(count) * density * math.pi / 6 * float(diameter) ** 3 for count, diameter in grains)


def judge_packing(run: ValidationCase, folder: pathlib.Path, slope: float, gravity: float, density: float, stands: bool) -> Answer | None:
    """Settles and runs one packing's decks; judges its forces; gives the phases for the figure. `stands`: as good as no motion."""
    deck = (folder / "in.liggghts").read_text(encoding="utf-8")
    mass, time_step = mass_of(deck, density), float(engine_deck.last_group(r"timestep\s+(\S+)", deck))
    angle = math.atan(slope)
    normal = mass * gravity * (1 if run.control else math.cos(angle))
    along = mass * gravity * math.sin(angle)
    rest = engine_deck.settled(engine_deck.run_deck(folder, "settle.liggghts", wanted="VIBROTROUGH SETTLED"))
    name = f"tan(alpha) {slope:g}, {'at rest' if stands else 'throw number 2'}"
    run.check(f"{name}: mass of the layer over that of the grains stated", rest["mass"] / mass, 1, 1e-6, because="rounding in the deck")
    engine_deck.run_deck(folder, "in.liggghts")
    cycles, phases = (engine_deck.read_lines(folder / f"{table}.csv") for table in ("cycles", "phases"))
    time = (cycles["step"][-1] - cycles["step"][0]) * time_step
    ends = [np.nonzero(phases["step"] == step)[0] for step in (cycles["step"][1], cycles["step"][-1])]
    first, last = (int(found[0]) for found in ends)
    mean_z, mean_x = (cycles[f"mean_force_{axis}"][2:].mean() for axis in "zx")
    if stands:
        for axis, weight in (("z", normal), ("x", along)):
            run.check(f"{name}: force along {axis} and weight, in m g", (cycles[f"mean_force_{axis}"][-10:].mean() + weight) / (mass * gravity),
                      0, 1e-3, because="the grains still swing a little about their contacts")
        return None
    time *= (len(cycles["step"]) - 2) / (len(cycles["step"]) - 1)
    for axis, mean, weight in (("z", mean_z, normal), ("x", mean_x, along)):
        momentum = mass * (phases[f"v{axis}_com"][last] - phases[f"v{axis}_com"][first]) / time
        run.check(f"{name}: force along {axis}, weight and change of momentum over 19 cycles, in m g",
                  (mean + weight + momentum) / (mass * gravity), 0, 2e-4, because="every step's force is summed; velocities are half a step apart")
    return phases, normal, time_step


def draw(run: ValidationCase, answers: list[Answer]) -> None:
    figure, panels = style.new_figure(2, 1, size=(8, 5.6), layout="constrained", sharex=True)
    for slope, axes, (phases, normal, time_step) in zip(SLOPES, panels, answers):
        time = phases["step"] * time_step
        axes.plot(time, -phases["floor_z"] / normal, lw=0.8, color=style.COLOURS[0], label="force on the floor, means of 1/100 cycle")
        axes.axhline(-phases["floor_z"].mean() / normal, color=style.COLOURS[1], label="mean")
        axes.axhline(1, color="k", ls="--", lw=1, label="weight")
        axes.set(ylabel="force / (m g cos \u03b1)  [-]", title=f"tan \u03b1 = {slope:g}, throw number 2")
        style.plain_axes(axes)
    panels[0].legend(fontsize=8, loc="upper right")
    panels[1].set_xlabel("time [s]")
    figure.savefig(run.figure("column.png"), dpi=100)


def main() -> None:
    run = ValidationCase(FOLDER)
    gravity = float(run.reference()[0]["value"])
    base = run.sections()
    density = float(base["grains"]["density"].split()[0])
    answers: list[Answer] = []
    nothing: dict[str, Any] = {}
    for name, changes in (("rest", STANDING), ("throw", nothing))[:1 if run.control else 2]:
        text = campaign_text(base, changes, {"trough.tan_inclination": SLOPES})
        folders = engine_deck.campaign_decks(run.program, run.own_runs() / name, text)
        found = [judge_packing(run, folder, slope, gravity, density, changes == STANDING) for folder, slope in zip(folders, SLOPES)]
        answers = [answer for answer in found if answer is not None]
    if not run.control:
        draw(run, answers)
    run.finish()


if __name__ == "__main__":
    main()
