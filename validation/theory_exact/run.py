#!/usr/bin/python3
import math
import pathlib
import sys
from typing import Any

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import numpy as np  # noqa: E402

import exact  # noqa: E402
from vibrotrough.figures import style  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

SOLVER = 1e-7
EDGE = 2e-4  # in throw number, of the bisection for the plateau's begin
EXTRAPOLATION = 1e-3


class Solver:
    def __init__(self, run: ValidationCase) -> None:
        self.run, self.factor = run, 1.02 if run.control else 1.0

    def point(self, gamma: float, friction: float = 0.35, tan_beta: float = 0.5, tan_alpha: float = 0.0) -> Any:
        return self.run.json("point", "--throw-number", repr(gamma * self.factor), "--tan-vibration-angle", tan_beta,
                             "--tan-inclination", tan_alpha, "--friction", friction)


def judge_flight_numbers(run: ValidationCase, solver: Solver) -> None:
    worst = 0.0
    for gamma in (1.05, 1.2, 1.5, 1.8, 2.0, 2.4, 2.8, 3.1, 3.29):
        duration = exact.flight(math.asin(1 / gamma), gamma)
        worst = max(worst, abs(solver.point(gamma)["flight_number"] - duration / (2 * math.pi)))
    run.check("largest deviation of the flight number, Gamma 1.05 to 3.29", worst, 0, SOLVER, because="both solve the same equation")


def judge_plateau(run: ValidationCase, solver: Solver, n: int) -> None:
    begin, end = exact.plateau(n)
    worst = 0.0
    for part in (0.01, 0.3, 0.6, 0.9):
        gamma = begin + part * (end - begin)
        for tan_alpha in (-0.1, 0.0, 0.1):
            point = solver.point(gamma, tan_alpha=tan_alpha)
            exact_eta = math.pi * n / gamma * (1 - tan_alpha * 0.5)
            worst = max(worst, abs(point["velocity_efficiency"] - exact_eta), abs(point["flight_number"] - n))
    run.check(f"n = {n}: largest deviation of flight number and eta in the plateau", worst, 0, SOLVER,
              because="closed form against the solver")
    printed = {row["name"]: float(row["value"]) for row in run.reference()}
    run.check(f"n = {n}: the plateau's begin", begin_by_bisection(solver, n, begin), printed[f"plateau_{n}_begin"], EDGE,
              because="step of the bisection")
    run.check(f"n = {n}: the plateau's end", end_by_extrapolation(solver, n, end), printed[f"plateau_{n}_end"], EXTRAPOLATION,
              because="the next term of the series")


def begin_by_bisection(solver: Solver, n: int, near: float) -> float:
    """Throw number near `near` from which the solver's flights last n cycles."""
    low, high = near - 0.03, near + 0.03
    while high - low > EDGE / 4:
        middle = (low + high) / 2
        inside = abs(solver.point(middle)["flight_number"] - n) < 1e-9
        low, high = (low, middle) if inside else (middle, high)
    return (low + high) / 2


def end_by_extrapolation(solver: Solver, n: int, near: float) -> float:
    """Throw number at which two alternating flights become equal. Their difference d grows as the square root of the
    distance from there: a quadratic in d^2, at d = 0. Nearer the start is forgotten too slowly to find the period."""
    gammas, squares = [near + offset for offset in (0.02, 0.03, 0.04, 0.05)], []
    for gamma in gammas:
        flights = [phase["end_rad"] - phase["start_rad"] for phase in solver.point(gamma)["phases"] if phase["kind"] == "F"]
        squares.append((max(flights) - min(flights)) ** 2)
    return np.polyfit(squares, gammas, 2)[-1]


def judge_doubling(run: ValidationCase, solver: Solver) -> None:
    """Two alternating flights: together two cycles, the longer one as the landing equation says."""
    for gamma in (3.75, 3.8):
        point, flights = solver.point(gamma), exact.settled_flights(gamma)
        run.check(f"Gamma {gamma}: cycles until the motion repeats", point["period_cycles"], 2, 0, because="period doubling")
        run.check(f"Gamma {gamma}: longest of the alternating flights", point["flight_number"], max(flights), SOLVER,
                  because="both solve the same equation")


def judge_no_slip(run: ValidationCase, solver: Solver) -> None:
    """v = g n^2 cot(beta) / (2 f) in eta: v = eta omega r cos(beta), Gamma = omega^2 r sin(beta) / g."""
    worst, friction = 0.0, 5.0
    for gamma in (1.2, 1.6, 2.0, 2.5, 3.0):
        n = exact.flight(math.asin(1 / gamma), gamma) / (2 * math.pi)
        for tan_beta in (0.25, 0.5, 1.0):
            point = solver.point(gamma, friction, tan_beta)
            worst = max(worst, abs(point["velocity_efficiency"] - math.pi * n**2 / gamma) * friction)
    run.between("no slip: largest |eta - pi n^2 / Gamma| mu at mu = 5, that is v = g n^2 cot(beta) / (2 f)", worst, 0, 1,
                because="what is left of the slip is 1/mu, the trough's amplitude being 1")


def draw(run: ValidationCase, solver: Solver) -> None:
    gammas = sorted([1.001, 1.02] + [1.05 + 0.05 * i for i in range(119)] + [*exact.plateau(1), *exact.plateau(2)])
    gammas = list(run.drawn(gammas))
    points = [solver.point(gamma) for gamma in gammas]
    figure, (left, right) = style.new_figure(1, 2, size=(11, 4.4), layout="constrained")
    left.plot(gammas, [point["flight_number"] if point["converged"] else math.nan for point in points], color=style.COLOURS[0], label="solver, longest flight")
    some = [gamma for gamma in gammas if gamma < 4.5][::3]
    for gamma in some:
        flights = exact.settled_flights(gamma, count=2, skip=100)
        left.plot([gamma] * 2, flights, "o", color=style.COLOURS[1], markersize=3.5, fillstyle="none",
                  label="exact landing equation" if gamma == some[0] else None)
    right.plot(gammas, [point["velocity_efficiency"] for point in points], color=style.COLOURS[0],
               label="solver, $\\mu$ = 0.35, $\\tan\\beta$ = 0.5")
    for n in (1, 2):
        begin, end = exact.plateau(n)
        right.plot([begin, end], [math.pi * n / begin, math.pi * n / end], lw=5, alpha=0.5, color=style.COLOURS[1],
                   label="exact, $\\pi n/\\Gamma$" if n == 1 else None)
        for axes in (left, right):
            axes.axvspan(begin, end, color="#dddddd", zorder=0)
        left.text((begin + end) / 2, 0.02, f"{begin:.4f}\n{end:.4f}", ha="center", va="bottom", fontsize=8,
                  transform=left.get_xaxis_transform())
    left.set_ylabel("flight number n [-]")
    right.set_ylabel(style.EFFICIENCY)
    for axes in (left, right):
        axes.set_xlabel(style.THROW_NUMBER)
        axes.legend(fontsize=8)
        style.plain_axes(axes)
    figure.savefig(run.figure("flights.png"), dpi=110)


def main() -> None:
    run = ValidationCase(FOLDER)
    solver = Solver(run)
    judge_flight_numbers(run, solver)
    for n in (1, 2):
        judge_plateau(run, solver, n)
    judge_doubling(run, solver)
    judge_no_slip(run, solver)
    if not run.control:
        draw(run, solver)
    run.finish()


if __name__ == "__main__":
    main()
