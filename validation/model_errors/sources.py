"""The simulated layers of the other validation cases, each with the inputs that a model of the conveying speed may know."""

import dataclasses
import math
import pathlib
from collections.abc import Callable, Iterator

from campaign_program import Row
from validation_case import read_table

VALIDATION = pathlib.Path(__file__).resolve().parent.parent
GRAVITY = 9.81
STEADY = ("finished", "not-precise")


@dataclasses.dataclass(frozen=True)
class Layer:
    """One simulated layer. Depths are in diameters of a grain; `group` is what the case calls the layer."""

    source: str
    group: str
    grains: str  # free, rolling (with rolling friction), blocked or cubes
    throw_number: float
    tan_vibration_angle: float
    tan_inclination: float
    friction: float
    rolling_friction: float
    depth: float
    efficiency: float
    half_width: float

    def rolls(self) -> bool:
        """Whether the grains roll on the trough. Rolling friction above 0.03 is more than the law is meant for."""
        return self.grains == "free" or (self.grains == "rolling" and self.rolling_friction <= 0.03)

    def does_not_roll(self) -> bool:
        return self.grains in ("blocked", "cubes") or self.rolling_friction >= 0.5


def steady(path: str) -> list[Row]:
    return [row for row in read_table(VALIDATION / path) if row.get("outcome", "finished") in STEADY]


def held_out() -> Iterator[Layer]:
    depths = {"3 deep": 3, "6 deep": 6, "16 deep": 16}
    frictions = {"trough friction 0.15": 0.15, "trough friction 0.4": 0.4, "trough friction 0.6": 0.6}
    angles = {"tan(beta) 0.35": 0.35, "tan(beta) 0.75": 0.75}
    slopes = {"downhill": -0.08, "uphill": 0.08}
    rolling = {"rolling friction 0.03": 0.03, "rolling friction 0.2": 0.2}
    for row in steady("rolling_layer/held_out.csv"):
        group = row["group"]
        grains = "blocked" if group == "blocked" else "rolling" if group in rolling else "free"
        yield Layer("rolling_layer", group, grains, float(row["throw_number"]), angles.get(group, 0.5), slopes.get(group, 0.0),
                    frictions.get(group, 0.23), rolling.get(group, 0.0), depths.get(group, 4), float(row["efficiency"]), float(row["half_width"]))


def ladder() -> Iterator[Layer]:
    """Layers of two diameters and more; the first rungs are no layers of grains on grains."""
    for row in steady("why_theory_fails/result.csv"):
        rung = row["rung"]
        if rung == "block" or rung.startswith(("grain,", "monolayer")):
            continue
        depth = float(rung.split()[0]) if "deep" in rung else 4
        resistance = float(rung.split()[-1]) if rung.startswith("rolling friction") else 0.0
        grains = "cubes" if rung == "cubes" else "blocked" if "blocked" in rung else "rolling" if resistance else "free"
        yield Layer("why_theory_fails", rung, grains, float(row["throw_number"]), 0.5, 0.0, float(row["friction"]), resistance, depth,
                    float(row["efficiency"]), float(row["half_width"]))


def paper() -> Iterator[Layer]:
    for row in steady("paper_experiment/result.csv"):
        if row["efficiency"] in ("", "nan"):
            continue
        grains = {"cube": "cubes"}.get(row["grains"], row["grains"])
        yield Layer("paper_experiment", row["grains"], grains, float(row["throw_number"]), float(row["tan_vibration_angle"]),
                    float(row["tan_inclination"]), 0.23, 0.0, 4, float(row["efficiency"]), float(row["half_width"]))


def of_speed(source: str, row: Row, machine: tuple[float, float, float, float], grains: str, per_m: float) -> Layer:
    """A layer whose speed is stored. @param machine  revolutions per minute, amplitude in m, vibration angle and inclination in degrees"""
    omega, amplitude = 2 * math.pi * machine[0] / 60, machine[1]
    beta, alpha = math.radians(machine[2]), math.radians(machine[3])
    top = omega * amplitude * math.cos(beta) * per_m
    speed, half = (float(value) for name, value in row.items() if name.startswith("speed_"))
    gamma = omega**2 * amplitude * math.sin(beta) / (GRAVITY * math.cos(alpha))
    return Layer(source, grains, grains, gamma, math.tan(beta), math.tan(alpha), float(row["friction"]), 0.0, 4, speed / top, half / top)


def krakow() -> Iterator[Layer]:
    for row in steady("krakow/result.csv"):
        yield of_speed("krakow", row, (float(row["revolutions"]), 0.00125, 30, 2), "free", 1)


def rosta() -> Iterator[Layer]:
    for row in steady("rosta/result.csv"):
        yield of_speed("rosta", row, (340, 0.012, 30, 0), row["rotation"], 100)


def second_engine() -> Iterator[Layer]:
    for row in steady("second_engine/result.csv"):
        yield Layer("second_engine", row["rotation"], row["rotation"], float(row["throw_number"]), 0.5, 0.0, 0.23, 0.0, 4,
                    float(row["efficiency"]), float(row["half_width"]))


def decisions() -> Iterator[Layer]:
    """Spheres that roll with some resistance, three diameters deep."""
    for row in steady("decisions/design.csv"):
        yield Layer("decisions", row["domain"], "rolling", float(row["throw_number"]), float(row["tan_vibration_angle"]), 0.0, 0.23,
                    float(row["rolling_friction"]), 3, float(row["efficiency"]), float(row["half_width"]))


# A further study of layers is one more function here.
SOURCES: list[Callable[[], Iterator[Layer]]] = [held_out, ladder, paper, krakow, rosta, second_engine, decisions]


def all_layers() -> list[Layer]:
    return [layer for source in SOURCES for layer in source()]
