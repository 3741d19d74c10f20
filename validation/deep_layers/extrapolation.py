"""Do two soft layers, or one with a correction, tell the efficiency of stiff grains? Judged on the layers that are stored."""

import math
from typing import NamedTuple

import numpy as np

from campaign_program import Row
from criterion import Inputs, inputs, judges, on_grid, wave_number
from validation_case import Floats, ValidationCase

RESULTS = ["of", "method", "layers", "covered", "share", "rms", "half_width"]
PAIRS = [(2, 8), (8, 32), (32, 125)]  # MPa, on the grid
SHARE = 0.95


class Known(NamedTuple):
    """A layer at one modulus: efficiency, half-width of its interval, wave number."""

    efficiency: float
    half_width: float
    wave_number: float


class Layer(NamedTuple):
    """A layer by its moduli in MPa; the stiffest one is what the others should tell."""

    name: str
    by_modulus: dict[int, Known]

    @property
    def stiff(self) -> Known:
        return self.by_modulus[max(self.by_modulus)]

    def soft(self) -> list[Known]:
        return [self.by_modulus[modulus] for modulus in sorted(self.by_modulus)[:-1]]


def layers_of(rows: list[tuple[str, Row, Inputs]]) -> list[Layer]:
    """Rows of a table, each with the name of its layer and what the wave number knows of it."""
    found: dict[str, dict[int, Known]] = {}
    for name, row, of in rows:
        found.setdefault(name, {})[int(row["modulus_MPa"])] = Known(float(row["efficiency"]), float(row["half_width"]), wave_number(of))
    return [Layer(name, by_modulus) for name, by_modulus in found.items()]


def of_grid(rows: list[Row]) -> list[Layer]:
    return layers_of([(f"{row['grains']} {row['depth']} {row['throw_number']}", row,
                       on_grid(float(row["depth"]), float(row["throw_number"]), float(row["modulus_MPa"]))) for row in rows])


def of_judges(rows: list[Row]) -> list[Layer]:
    known = judges()
    return layers_of([(row["layer"], row, inputs(known[row["layer"]], float(row["modulus_MPa"]))) for row in rows])


def extrapolated(soft: Known, less_soft: Known, stiff: Known) -> tuple[float, float]:
    """The straight line in s^2 through two layers, at the s^2 of the stiff one, and the half-width there."""
    a, b, c = (one.wave_number**2 for one in (soft, less_soft, stiff))
    weight = (b - c) / (a - b)
    return (less_soft.efficiency + weight * (less_soft.efficiency - soft.efficiency),
            math.hypot((1 + weight) * less_soft.half_width, weight * soft.half_width))


class Tally:
    """How often an answer and its interval hold the efficiency of stiff grains."""

    def __init__(self) -> None:
        self.errors: list[float] = []
        self.widths: list[float] = []
        self.covered = 0

    def add(self, answer: tuple[float, float], stiff: Known) -> None:
        self.errors.append(answer[0] - stiff.efficiency)
        self.widths.append(answer[1])
        self.covered += abs(self.errors[-1]) <= math.hypot(answer[1], stiff.half_width)

    def cells(self) -> list[object]:
        count = len(self.errors)
        return [count, self.covered, f"{self.covered / count:.2f}", f"{np.sqrt(np.mean(np.square(self.errors))):.3f}", f"{np.median(self.widths):.3f}"]


def steps(layers: list[Layer]) -> Floats:
    """Of each soft layer: s^2 less that of the stiff one, the efficiency that it lacks, and the half-width of that."""
    return np.array([(one.wave_number**2 - layer.stiff.wave_number**2, layer.stiff.efficiency - one.efficiency,
                      math.hypot(one.half_width, layer.stiff.half_width)) for layer in layers for one in layer.soft()])


def correction(layers: list[Layer], corrected: bool) -> tuple[float, float]:
    """c and k: eta + c s^2 has the interval k s^2 beside its own, with which it holds 95 % of these layers. c = 0 unless `corrected`."""
    x, lack, width = steps(layers).T
    weights = 1 / (width**2 + x**2)
    c = float(np.sum(weights * x * lack) / np.sum(weights * x**2)) if corrected else 0.0
    needed = np.sqrt(np.maximum(0, (lack - c * x) ** 2 - width**2)) / x
    return c, float(np.quantile(needed, SHARE, method="higher"))


def judge_lines(of: str, layers: list[Layer], pairs: list[tuple[int, int]]) -> list[list[object]]:
    rows: list[list[object]] = []
    for low, high in pairs:
        line, plain = Tally(), Tally()
        for layer in layers:
            moduli = sorted(layer.by_modulus)[:-1]
            if low in moduli and high in moduli:
                soft, less_soft = layer.by_modulus[low], layer.by_modulus[high]
                line.add(extrapolated(soft, less_soft, layer.stiff), layer.stiff)
                plain.add((less_soft.efficiency, less_soft.half_width), layer.stiff)
        rows += [[of, f"line in s^2 through {low} and {high} MPa", *line.cells()], [of, f"{high} MPa as it is", *plain.cells()]]
    return rows


def judge_lines_of_judges(held_out: list[Layer]) -> list[list[object]]:
    """Any two neighbouring moduli of the layers that judge, whatever they are."""
    line, plain = Tally(), Tally()
    for layer in held_out:
        for soft, less_soft in zip(layer.soft(), layer.soft()[1:]):
            line.add(extrapolated(soft, less_soft, layer.stiff), layer.stiff)
            plain.add((less_soft.efficiency, less_soft.half_width), layer.stiff)
    return [["judging layers", "line in s^2 through two moduli", *line.cells()], ["judging layers", "the stiffer of the two as it is", *plain.cells()]]


def judge_corrections(grid: list[Layer], held_out: list[Layer]) -> tuple[list[list[object]], list[tuple[float, float]]]:
    """eta + c s^2 with the interval k s^2: each layer of the grid with c and k of the others, the judging layers with those of the whole grid."""
    rows: list[list[object]] = []
    constants = []
    for corrected, name in ((True, "eta + c s^2"), (False, "eta")):
        on_grid, on_judges = Tally(), Tally()
        for layer in grid:
            c, k = correction([other for other in grid if other is not layer], corrected)
            add_corrected(on_grid, layer, c, k)
        c, k = correction(grid, corrected)
        constants.append((c, k))
        for layer in held_out:
            add_corrected(on_judges, layer, c, k)
        rows += [["grid, each layer left out", f"{name} +- k s^2", *on_grid.cells()], ["judging layers", f"{name} +- k s^2", *on_judges.cells()]]
    return rows, constants


def add_corrected(tally: Tally, layer: Layer, c: float, k: float) -> None:
    for one in layer.soft():
        x = one.wave_number**2 - layer.stiff.wave_number**2
        tally.add((one.efficiency + c * x, math.hypot(one.half_width, k * x)), layer.stiff)


def judge(run: ValidationCase, grid: list[Layer], held_out: list[Layer]) -> list[list[object]]:
    """Findings, and the table of RESULTS with the constants as its last four rows."""
    lines = judge_lines("grid", grid, PAIRS) + judge_lines_of_judges(held_out)
    corrections, constants = judge_corrections(grid, held_out)
    shares = [float(str(row[4])) for row in lines if str(row[1]).startswith("line")]
    run.finding("a line in s^2 through two soft layers tells the efficiency of stiff grains, with an interval that holds", min(shares) >= 0.93,
                "; ".join(f"{row[0]}, {row[1]}: {row[3]} of {row[2]} covered, rms {row[5]}" for row in lines))
    (c, k), (_, plain) = constants
    held = next(row for row in corrections if row[:2] == ["judging layers", "eta + c s^2 +- k s^2"])
    run.finding("eta + c s^2 with the interval k s^2 holds the judging layers and is at most half as wide as the bound", int(str(held[3])) >= SHARE * int(str(held[2])) and k <= 2,
                f"{held[3]} of {held[2]} covered with c = {c:.2f} and k = {k:.2f}; without a correction k = {plain:.2f}, in the bound it is 4")
    return lines + corrections + [["grid", f"{name} of eta{' + c s^2' if corrected else ''} +- k s^2", "", "", "", "", f"{value:.2f}"]
                                  for corrected, pair in zip((True, False), constants) for name, value in zip("ck", pair)]
