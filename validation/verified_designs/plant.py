"""Twenty machines as plants ask for them: coarse and fine material, slopes, small strokes, fast motors, frictions that nobody knows."""

import json
import math
import pathlib
import subprocess
import time
import tomllib
from typing import Any

import numpy as np

from campaign_program import campaign_text, run_campaign

TASKS, SEED = 20, 20261128
HALF_WIDTH = 0.07  # of the simulated efficiency; a fine, deep layer would take hours for less
COLUMNS = ["task", "kind", "diameter_mm", "friction", "friction_uncertainty", "rolling_friction", "inclination_deg", "rpm", "wanted_t_per_h", "answer_s", "stroke_mm",
           "angle_deg", "depth_mm", "throw_number", "probability", "promised_t_per_h", "promised_low_t_per_h", "promised_high_t_per_h", "simulated_t_per_h",
           "simulated_half_width_t_per_h", "core_hours", "why_no_probability"]  # fmt: skip

# What is particular of each kind, in the options of `design`; everything else is drawn from the ranges of `task`.
KINDS = ["coarse", "fine", "uphill", "downhill", "small stroke", "1450 1/min", "2900 1/min", "uncertain friction"]


def task(number: int) -> dict[str, Any]:
    """A random task, in the options of `design`, with its kind and the share of what the fastest machine carries that is asked for."""
    random = np.random.default_rng([SEED, number])
    kind = KINDS[number % len(KINDS)]
    diameter, deepest = random.uniform(2, 8), random.uniform(4, 12)
    if kind == "coarse":
        diameter, deepest = random.uniform(15, 50), random.uniform(2.5, 4)
    if kind == "fine":
        diameter, deepest = random.uniform(1, 3), 20
    options = {
        "kind": kind,
        "--grain-diameter": f"{diameter:.1f} mm",
        "--rolling-friction": f"{random.uniform(0.02, 0.2):.2f}",
        "--friction": f"{random.uniform(0.2, 0.6):.2f}",
        "--friction-uncertainty": f"{random.uniform(0.03, 0.06):.3f}" if kind == "uncertain friction" else "0",
        "--inclination": {"uphill": "{:.1f} deg", "downhill": "-{:.1f} deg"}.get(kind, "0 deg").format(random.uniform(3, 8)),
        "--bulk-density": f"{random.uniform(500, 1600):.0f} kg/m3",
        "--width": f"{random.choice([300, 500, 800])} mm",
        "--layer-depth": f"{2 * diameter:.1f} mm to {deepest * diameter:.1f} mm",
        "--rpm": {"1450 1/min": "1450", "2900 1/min": "2900"}.get(kind, str(random.choice([720, 960]))),
        "--machine-number": f"{random.uniform(3.5, 5):.1f}",
        "share": random.uniform(0.5, 0.95),
    }
    if kind == "2900 1/min":
        options |= {"--stroke": "0.3 mm to 2 mm"}
    if kind == "small stroke":
        options |= {"--stroke": f"1 mm to {random.uniform(2, 4):.1f} mm", "--rpm": "1450"}
    return options


def least_held(count: int) -> int:
    """The least number of 95 % intervals, of `count`, that a binomial count falls below with less than 2.5 %."""
    shares = [math.comb(count, number) * 0.95**number * 0.05 ** (count - number) for number in range(count + 1)]
    return next(number for number in range(count + 1) if sum(shares[: number + 1]) >= 0.025)


def design(program: str, options: dict[str, Any], flow: float, *words: str) -> tuple[Any, float]:
    """What `vibrotrough design` answers for a mass flow in t/h, and how long that took, s."""
    given = [word for name, value in options.items() if name.startswith("--") for word in (name, value)]
    command = [program, "design", "--mass-flow", f"{flow:.4g} t/h", *given, "--json", *words]
    begin = time.monotonic()
    answer = subprocess.run(command, capture_output=True, text=True, check=False)
    if answer.returncode not in (0, 1):
        raise SystemExit(f"{' '.join(command)}\n{answer.stderr}")
    return json.loads(answer.stdout), time.monotonic() - begin


def simulate(program: str, folder: pathlib.Path, campaign: pathlib.Path, jobs: int) -> dict[str, str]:
    """The machine's own check campaign at the median of the friction: its row of `compare`."""
    base = tomllib.loads(campaign.read_text(encoding="utf-8"))
    (row,) = run_campaign(program, folder, campaign_text(base, {"measure.half_width": HALF_WIDTH}, {"trough.friction": [base["trough"]["friction"]]}), jobs)
    return row


def verify(program: str, runs: pathlib.Path, number: int, jobs: int) -> list[object]:
    """The row of a task: the answer, and what its machine carries where the answer has a probability."""
    options = task(number)
    most, _ = design(program, options, 1e4)
    flow = float(f"{options['share'] * most['models'][0]['mass_flow_t_per_h']:.3g}")
    runs.mkdir(parents=True, exist_ok=True)
    campaign = runs / f"plant_{number}_check.toml"
    found, seconds = design(program, options, flow, "--campaign", str(campaign), "--force")
    promise = found["models"][0]
    words = ("--grain-diameter", "--friction", "--friction-uncertainty", "--rolling-friction", "--inclination", "--rpm")
    row: list[object] = [number, options["kind"], *(options[word].split()[0] for word in words), f"{flow:.4g}", f"{seconds:.1f}", f"{found['stroke_mm']:.4g}",
                         f"{found['vibration_angle_deg']:.4g}", f"{found['layer_depth_mm']:.4g}", f"{found['throw_number']:.3f}"]  # fmt: skip
    if found["probability"] is None:
        return [*row, *[""] * (len(COLUMNS) - len(row) - 1), found["untested"]]
    result = simulate(program, runs / f"plant_{number}", campaign, jobs)
    hours = sum(json.loads(file.read_text())["core_time"] for file in (runs / f"plant_{number}").glob("cases/*/packing-*/packing.json")) / 3600
    promised = (promise[f"mass_flow{part}_t_per_h"] for part in ("", "_low", "_high"))
    simulated = (float(result[f"mass_flow{part}_t_per_h"]) for part in ("", "_half_width"))
    return [*row, f"{found['probability']:.3f}", *(f"{value:.4g}" for value in (*promised, *simulated)), f"{hours:.3f}", ""]
