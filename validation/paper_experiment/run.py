#!/usr/bin/python3
import math
import pathlib
import sys
from collections.abc import Iterable, Sequence

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

from campaign_program import Row  # noqa: E402
from campaigns import BETWEEN, FREE, FRICTION, GRID  # noqa: E402
import draw  # noqa: E402
import findings  # noqa: E402
from measure import measure  # noqa: E402
from findings import Table  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

STEADY = ("finished", "not-precise")


class PointMass:
    """The point mass on the experiment's trough; the negative control tilts the trough the other way."""

    def __init__(self, run: ValidationCase) -> None:
        self.run, self.sign = run, -1 if run.control else 1

    def efficiency(self, tan_inclination: float, tan_vibration_angle: float, throw_number: float, harmonic: str) -> float:
        words = ["--tan-inclination", self.sign * tan_inclination, "--tan-vibration-angle", tan_vibration_angle,
                 "--throw-number", throw_number, "--friction", FRICTION]
        words += ["--harmonic-along", harmonic, "--harmonic-normal", harmonic]
        return self.run.json("point", *words)["velocity_efficiency"]

    def efficiencies(self, points: Iterable[Sequence[float]]) -> list[float]:
        """Of many points (tan_inclination, tan_vibration_angle, throw_number) at once."""
        columns = ["tan_inclination", "tan_vibration_angle", "throw_number", "friction"]
        asked = [(self.sign * slope, tangent, gamma, FRICTION) for slope, tangent, gamma in points]
        return list(self.run.efficiencies(columns, asked))


def number(text: str) -> float | str | None:
    """A float where the text is a number, None where nothing was measured, else the text."""
    try:
        return float(text) if text != "" else None
    except ValueError:
        return text


def numbers(rows: list[Row]) -> Table:
    """The rows of a table with their values as number() gives them."""
    return [{key: number(text) for key, text in row.items()} for row in rows]


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        measure(run)
    theory = PointMass(run)
    grid = numbers(run.table("result.csv"))
    places = [[row[key] for key in ("tan_inclination", "tan_vibration_angle", "throw_number")] for row in grid]
    for row, eta in zip(grid, theory.efficiencies(places)):
        row["theory"] = eta
    walls, waves, friction = (numbers(run.table(name)) for name in ("walls.csv", "waves.csv", "friction.csv"))
    noise = numbers(run.table("noise.csv"))
    criteria(run, grid, walls, friction)
    findings.slide_conveyors(run, grid)
    findings.spread_over_angles(run, grid)
    findings.near_two_and_a_half(run, grid)
    findings.gradient(run, grid)
    findings.side_walls(run, walls)
    findings.wiggles(run, waves)
    findings.noise(run, theory, grid, noise)
    findings.softness(run, grid, numbers(run.table("stiff.csv")))
    findings.shake_test(run, friction)
    draw.efficiency(run, theory, grid)
    draw.layer(run, walls, waves, numbers(run.table("surfaces.csv")))
    run.finish()


def size(sweep: dict[str, list[float]]) -> int:
    return math.prod(map(len, sweep.values()))


def criteria(run: ValidationCase, grid: Table, walls: Table, friction: Table) -> None:
    for grains, planned in [("blocked", size(GRID)), ("free", sum(map(size, (BETWEEN, FREE))))]:
        run.check(f"cases with {grains} rotation", sum(row["grains"] == grains for row in grid), planned, 0)
    run.check("cases that failed", sum(row["outcome"] not in (*STEADY, "not-steady", "bistable-or-slow") for row in grid), 0, 0)
    run.between("largest overlap of grains, in diameters", max(row["overlap"] for row in grid if row["overlap"]), 0, 0.1,
                because="Hertz' law holds for small overlaps; the check before a run allows as much")
    slides = [row for row in grid if row["grains"] == "blocked" and row["throw_number"] < 1 and row["efficiency"] is not None]
    run.between("blocked rotation below throw number 1: steady cases", len(slides), 12, 18)
    for row in slides:
        where = f"tan(alpha) {row['tan_inclination']}, tan(beta) {row['tan_vibration_angle']}, Gamma {row['throw_number']}"
        run.check(f"blocked, {where}: eta", row["efficiency"], row["theory"], max(0.2 * abs(row["theory"]), 0.04),
                  because="no flight and no rolling: a block with Coulomb's friction; 20 % as in the paper, 0.04 near zero for soft grains")
    for row in friction:
        if row["what"] == "block":
            run.check(f"shake test of a block, mu = {row['friction_put_in']}", row["friction"], row["friction_put_in"],
                      0.02 * row["friction_put_in"], because="its tangential spring gives way before it slides")
    middle = findings.middle_of(walls, "blocked", 0.8)
    strip = next((row["efficiency"] for row in grid if findings.is_at(row, "blocked", -0.051, 0.5, 0.8)), None)
    if strip is not None:
        run.check("middle of a 200 mm trough against a periodic strip, Gamma 0.8, blocked", middle, strip, 0.03,
                  because="what half_width asks of each")


if __name__ == "__main__":
    main()
