#!/usr/bin/python3
import pathlib
import sys
import tomllib
from typing import Any

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import numpy as np  # noqa: E402

from vibrotrough.figures import style  # noqa: E402
import plant  # noqa: E402
from campaign_program import campaign_text, run_campaign  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

TASKS, REACHED, SEED = 10, 9, 20261127
MODELS = ["rolling-layer", "atlas", "point-mass"]
OBJECTIVES = ["fastest", "least-machine-number"]
CONTROL = 1.2  # of the mass flow
# A deep layer of pellets: the machine that `design` proposed by the atlas of 0.2 was simulated as it stands in engineer.toml.
ENGINEER = {
    "--grain-diameter": "3.5 mm", "--friction": "0.3", "--bulk-density": "600 kg/m3", "--width": "400 mm", "--rpm": "960", "--machine-number": "4",
}  # fmt: skip
ENGINEERS_FLOW = 12  # t/h
COLUMNS = ["task", "model", "objective", "diameter_mm", "friction", "friction_uncertainty", "rolling_friction", "wanted_t_per_h", "verdict", "machines", "core_hours",
           "stroke_mm", "rpm", "angle_deg", "depth_mm", "first_promise", "first_simulated", "probability", "again_t_per_h", "again_half_width_t_per_h"]  # fmt: skip


def task(number: int) -> dict[str, Any]:
    """A random task, in the options of `design`; its mass flow is a share of what the fastest machine carries."""
    random = np.random.default_rng([SEED, number])
    diameter = random.uniform(3, 8)
    return {
        "--grain-diameter": f"{diameter:.1f} mm",
        "--rolling-friction": f"{random.uniform(0.02, 0.2):.2f}",
        "--friction": f"{random.uniform(0.2, 0.5):.2f}",
        "--friction-uncertainty": "0.02" if number % 4 == 1 else "0",
        "--bulk-density": f"{random.uniform(500, 1000):.0f} kg/m3",
        "--width": "400 mm",
        "--layer-depth": f"{2 * diameter:.1f} mm to {diameter * random.uniform(3.2, 5.8):.1f} mm",
        "--rpm": str(random.choice([720, 960])),
        "--machine-number": f"{random.uniform(3.5, 5):.1f}",
        "--objective": OBJECTIVES[number % len(OBJECTIVES)],
        "--model": MODELS[number % len(MODELS)],
        "share": random.uniform(0.6, 0.95),
    }


def design(run: ValidationCase, options: dict[str, Any], flow: float, *words: str) -> Any:
    """What `vibrotrough design` answers for a mass flow in t/h."""
    return plant.design(run.program, options, flow, *words)[0]


def simulate_again(run: ValidationCase, number: int, campaign: pathlib.Path) -> tuple[float, float]:
    """Mass flow of a machine and its half-width, t/h, at the median of the friction: other grains, since the box is larger."""
    base = tomllib.loads(campaign.read_text(encoding="utf-8"))
    longer, wider = (f"{1.2 * float(base['layer'][key].split()[0]):.4g} mm" for key in ("length", "width"))
    text = campaign_text(base, {"layer.length": longer, "layer.width": wider}, {"trough.friction": [base["trough"]["friction"]]})
    (row,) = run_campaign(run.program, run.runs / f"again_{number}", text, run.jobs)
    return float(row["mass_flow_t_per_h"]), float(row["mass_flow_half_width_t_per_h"])


def verify(run: ValidationCase, number: int) -> list[object]:
    options = task(number)
    known = {name: value for name, value in options.items() if name != "--rolling-friction" or options["--model"] == "atlas"}
    most = design(run, known, 1e4)["models"][0]["mass_flow_t_per_h"]
    flow = float(f"{options['share'] * most:.3g}")
    folder = run.runs / f"task_{number}"
    answer = design(run, options, flow, "--verify", "--budget", "1 core-hours", "--output", str(folder), "--jobs", str(run.jobs), "--quiet")
    found = answer["verification"]
    row = [number, options["--model"], options["--objective"], options["--grain-diameter"].split()[0], options["--friction"], options["--friction-uncertainty"],
           options["--rolling-friction"], f"{flow:.4g}", found["verdict"], len(found["machines"]), f"{found['core_hours']:.3f}"]  # fmt: skip
    if not found["machines"]:
        return row + [""] * (len(COLUMNS) - len(row))
    first = min(found["machines"][0]["layers"], key=lambda layer: abs(layer["friction"] - answer["friction_median"]))
    machine = found["machines"][-1]
    again = simulate_again(run, number, pathlib.Path(machine["campaign"])) if found["verdict"] == "verified" else ("", "")
    return row + [f"{machine['stroke_mm']:.4g}", f"{machine['rpm']:.4g}", f"{machine['vibration_angle_deg']:.4g}", f"{machine['layer_depth_mm']:.4g}",
                  f"{first['promised']:.3f}", f"{first['simulated']:.3f}", f"{machine['probability']:.3f}", *(f"{value:.4g}" if value != "" else "" for value in again)]  # fmt: skip


def judge(run: ValidationCase) -> None:
    rows = run.table("tasks.csv")
    verified = [row for row in rows if row["verdict"] == "verified"]
    reached = sum(asked(run) * float(row["again_t_per_h"]) >= float(row["wanted_t_per_h"]) for row in verified)
    run.between(f"machines of {TASKS} that carry their mass flow when simulated once more", reached, REACHED, TASKS, because="each was promised with 95 %")
    run.between("core-hours of the dearest verification", max(float(row["core_hours"]) for row in rows), 0, 1, because="the budget that was given")
    judge_plant(run)
    judge_engineer(run)


def judge_plant(run: ValidationCase) -> None:
    """Machines as plants ask for them: what was promised with a probability is what the layers carry."""
    rows = [row for row in run.table("plant.csv") if row["simulated_t_per_h"]]
    low, high, simulated, width = (
        np.array([float(row[f"{name}_t_per_h"]) for row in rows]) for name in ("promised_low", "promised_high", "simulated", "simulated_half_width")
    )
    simulated = asked(run) * simulated
    middle, half = (low + high) / 2, (high - low) / 2
    held = int(np.sum(np.abs(simulated - middle) <= np.hypot(half, width)))
    run.between(f"plants: layers that carry what was promised, of {len(rows)}", held, plant.least_held(len(rows)), len(rows), because="95 % intervals: the least count of a binomial's 95 %")
    run.between("plants: mass flow over the least that was promised", float(np.min((simulated + width) / low)), 1, 2, because="no promise is confidently wrong")


def judge_engineer(run: ValidationCase) -> None:
    """A machine that `design` proposed, and that was simulated, does what is promised of it today."""
    (row,) = run.reference("engineer.csv")
    layer = tomllib.loads((FOLDER / "engineer.toml").read_text(encoding="utf-8"))["layer"]
    machine = {"--stroke": f"{row['stroke_mm']} mm", "--vibration-angle": f"{row['vibration_angle_deg']} deg", "--layer-depth": layer["height"]}
    found = design(run, ENGINEER | machine, ENGINEERS_FLOW)
    promise = found["models"][0]
    flow, width = (asked(run) * float(row[key]) for key in ("mass_flow_t_per_h", "mass_flow_half_width_t_per_h"))
    run.between("engineer's machine: mass flow less its half-width, t/h", flow - width, ENGINEERS_FLOW, 2 * ENGINEERS_FLOW, because="what was asked for")
    run.between("engineer's machine: mass flow, t/h", flow, promise["mass_flow_low_t_per_h"], promise["mass_flow_high_t_per_h"], because="the promise of `design`, 95 %")


def asked(run: ValidationCase) -> float:
    """By how much less is carried than was asked for, in the deliberate mistake."""
    return 1 / CONTROL if run.control else 1


def draw(run: ValidationCase) -> None:
    rows = [row for row in run.table("tasks.csv") if row["again_t_per_h"]]
    wanted = np.array([float(row["wanted_t_per_h"]) for row in rows])
    again, width = (np.array([float(row[key]) for row in rows]) / wanted for key in ("again_t_per_h", "again_half_width_t_per_h"))
    figure, axes = style.new_figure(layout="constrained")
    axes.axhline(1, color=style.GREY, linewidth=0.8)
    axes.errorbar([int(row["task"]) for row in rows], again, width, fmt="o", color=style.COLOURS[0])
    axes.set(xlabel="task", ylabel="mass flow, simulated once more, over the one asked for")
    style.plain_axes(axes)
    figure.savefig(run.figure("verified_designs.png"), dpi=110)


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        run.write_table("tasks.csv", COLUMNS, [verify(run, number) for number in range(1 if run.quick else TASKS)])
        run.write_table("plant.csv", plant.COLUMNS, [plant.verify(run.program, run.runs, number, run.jobs) for number in range(2 if run.quick else plant.TASKS)])
    judge(run)
    if not run.control:
        draw(run)
    run.finish()


if __name__ == "__main__":
    main()
