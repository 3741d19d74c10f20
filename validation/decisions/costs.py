"""How many cases a surface needs that is as precise as asked: learnt, from a Sobol design without a trend, and from a grid."""

import json
import math
import pathlib
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Sequence

import numpy as np

from campaign_program import Row, campaign_table, campaign_text
from validation_case import Floats, ValidationCase

Domain = dict[str, tuple[float, float]]  # range of each key
COSTS = ["domain", "method", "cases", "largest_half_width", "half_width_of_19_in_20"]
GOAL = 0.05  # largest half-width in the domain; each case has this half-width at most, so that all cost the same
STARTS = 3  # of learning
PLACES = 256  # at which a domain is looked at
LEAST = 1e-4  # of rolling friction, which is above 0


def short(key: str) -> str:
    return key.split(".")[1]


def predict(run: ValidationCase, folder: pathlib.Path, domain: Domain, places: Floats, *options: str) -> Floats:
    """Velocity efficiency and half-width that the surface of a campaign predicts; one row per place."""
    words: list[str] = []
    for place in places:
        words += ["--at", ",".join(f"{short(key)}={float(value)!r}" for key, value in zip(domain, place))]
    command = [run.program, "predict", str(folder), *words, "--json", *options]
    answer = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return np.array([[one["efficiency"], one["half_width"]] for one in json.loads(answer)])


def scaled(domain: Domain, unit: Floats) -> Floats:
    """Places of a domain from places of the unit square."""
    low, high = np.array([(max(low, LEAST), high) for low, high in domain.values()]).T
    return np.asarray(low + (high - low) * unit)


def learn(run: ValidationCase, name: str, domain: Domain, seed: int) -> pathlib.Path:
    """Learns a surface from a start of its own for each seed, or continues; the folder of its campaign."""
    folder = run.runs / (f"{name}-learnt-{GOAL:g}" + (f"-{seed}" if seed > 1 else ""))
    text = campaign_text(run.sections(), {"campaign.name": folder.name}, {}).replace("[sweep]\n", "[domain]\n")
    text += f"seed = {seed}\n" if seed > 1 else ""
    text += "".join(f'"{key}" = {{ from = {low}, to = {high} }}\n' for key, (low, high) in domain.items())
    file = folder.with_name(folder.name + ".toml")
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")
    words = ["--half-width", str(GOAL), "--budget", "2 core-hours", "--jobs", str(run.jobs), "--quiet"]
    code = subprocess.run([run.program, "learn", str(file), "--output", str(folder), *words], check=False).returncode
    if code not in (0, 1):
        raise SystemExit(f"learning {folder.name} ended with {code}")
    return folder


def half_widths(values: Floats) -> list[float]:
    return [float(np.max(values)), float(np.quantile(values, 0.95))]


def learnt(run: ValidationCase, name: str, domain: Domain, unit: Floats, seed: int) -> list[object]:
    folder = learn(run, name, domain, seed)
    found = predict(run, folder, domain, scaled(domain, unit))[:, 1]
    return [name, f"learnt, start {seed}", len(campaign_table(run.program, folder)), *half_widths(found)]


def first_cases(folder: pathlib.Path, rows: Sequence[Row], target: pathlib.Path) -> pathlib.Path:
    """A copy of a campaign of which only these cases have a result."""
    target.mkdir()
    for file in folder.iterdir():
        if file.is_file():
            shutil.copy(file, target)
    for row in rows:
        shutil.copytree(folder / "cases" / row["case"], target / "cases" / row["case"])
    return target


def sobol(run: ValidationCase, name: str, domain: Domain, unit: Floats) -> list[object]:
    """The fewest of the first held-out points, which are a Sobol sequence, whose surface without the theory is as precise."""
    folder = run.runs / f"{name}-held-out"
    rows = campaign_table(run.program, folder)
    asked = scaled(domain, unit)
    for count in range(10, len(rows) + 1, 2):
        with tempfile.TemporaryDirectory() as place:
            part = first_cases(folder, rows[:count], pathlib.Path(place) / "part")
            found = half_widths(predict(run, part, domain, asked, "--without-theory")[:, 1])
        if found[0] <= GOAL or count == len(rows):
            break
    return [name, "Sobol without trend", count, *found]


def half_width(bias: float, sd: float) -> float:
    """The half-width that a normal error with this mean and standard deviation does not exceed in 95 %."""
    low, high = 0.0, abs(bias) + 3 * sd
    for _ in range(60):
        middle = (low + high) / 2
        inside = 0.5 * (math.erf((middle - bias) / sd / math.sqrt(2)) + math.erf((middle + bias) / sd / math.sqrt(2)))
        low, high = (low, middle) if inside >= 0.95 else (middle, high)
    return high


def grid_half_widths(values: Floats, truth: Callable[[Floats], Floats], unit: Floats, sd: float) -> Floats:
    """Half-widths of bilinear interpolation between n x n values, each with this noise, at places of the unit square."""
    n = len(values)
    at = unit * (n - 1)
    cell = np.minimum(at.astype(int), n - 2)
    (i, j), (u, v) = cell.T, (at - cell).T
    found = (1 - v) * ((1 - u) * values[i, j] + u * values[i + 1, j]) + v * ((1 - u) * values[i, j + 1] + u * values[i + 1, j + 1])
    noise = sd * np.sqrt((u**2 + (1 - u) ** 2) * (v**2 + (1 - v) ** 2))
    return np.array([half_width(float(b), float(s)) for b, s in zip(found - truth(unit), noise)])


def grid(run: ValidationCase, name: str, domain: Domain, unit: Floats) -> list[object]:
    """The smallest grid that is as precise; its cases are not simulated, but taken from the surface of the held-out points.

    Their noise is the mean of these points, their cost as well. The surface is smoother than the layer may be, in favour of the grid.
    """
    folder = run.runs / f"{name}-held-out"
    rows = campaign_table(run.program, folder)
    sd = float(np.mean([float(row["efficiency_half_width_statistics"]) for row in rows if row["efficiency_half_width_statistics"]])) / 1.96

    def truth(places: Floats) -> Floats:
        return predict(run, folder, domain, scaled(domain, places))[:, 0]

    for n in range(3, 16):
        nodes = np.array([(i, j) for i in range(n) for j in range(n)]) / (n - 1)
        found = half_widths(grid_half_widths(truth(nodes).reshape(n, n), truth, unit, sd))
        if found[0] <= GOAL:
            break
    return [name, "grid", n * n, *found]


def measure_costs(run: ValidationCase, domains: dict[str, Domain]) -> None:
    """Writes costs.csv; the held-out points have to be simulated before."""
    # An additive recurrence that fills the square evenly (M. Roberts, 2018: the powers of the plastic number).
    unit = (0.5 + np.arange(1, PLACES + 1)[:, None] * np.array([0.7548776662466927, 0.5698402909980532])) % 1
    rows = []
    for name, domain in domains.items():
        rows += [learnt(run, name, domain, unit, seed) for seed in range(1, STARTS + 1)]
        rows += [sobol(run, name, domain, unit), grid(run, name, domain, unit)]
    run.write_table("costs.csv", COSTS, rows)
