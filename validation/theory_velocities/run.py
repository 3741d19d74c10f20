#!/usr/bin/python3
import math
import pathlib
import sys
from typing import Any

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

from vibrotrough.figures.style import plt  # noqa: E402
from validation_case import ValidationCase  # noqa: E402


def judge_limits(run: ValidationCase, limits: dict[str, Any]) -> None:
    printed = {row["name"]: row for row in run.reference()}
    for name in ("throw_number_of_whole_cycle_flight", "best_throw_number_small_angle"):
        row = printed[name]
        run.check(name, limits[name], float(row["printed"]), float(row["reading_error"]), because="half of the last printed digit")
    best = limits["best_throw_number_small_angle"]
    run.check("the same by maximising the solver's eta", limits["best_throw_number"], best, 1e-4,
              because="a maximum is flat: eta known to 1e-9 gives its place to 1e-4 or so")
    exact = math.pi / math.sqrt(1 + math.pi**2)
    at_whole = limits["efficiency_at_whole_cycle_flight"]
    run.check("efficiency at 3.297 is pi / sqrt(1 + pi^2)", at_whole, exact, 1e-9, because="rounding")
    row = printed["efficiency_at_whole_cycle_flight"]
    run.finding(f"the paper prints {row['printed']} for the efficiency at 3.297",
                abs(at_whole - float(row["printed"])) <= float(row["reading_error"]),
                f"its own formula cos(delta) gives {exact:.4f}, as does the solver")


def draw_traces(run: ValidationCase, tangent: float, gammas: tuple[float, float]) -> None:
    """Fig. 6; in both motions the mass keeps its velocity: cos(delta) after a flight of one cycle, 1 at the optimum."""
    figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained", sharey=True)
    kept = (math.pi / math.sqrt(1 + math.pi**2), 1.0)
    for panel, gamma, velocity in zip(axes, gammas, kept):
        rows = run.csv("trace", "--throw-number", repr(gamma), "--tan-vibration-angle", tangent, "--friction", 0.35, "--samples", 721)
        time = [float(row["time_rad"]) for row in rows]
        mass = [float(row["mass_velocity_x"]) for row in rows]
        panel.plot(time, [float(row["trough_velocity_x"]) for row in rows], label="trough")
        panel.plot(time, mass, "--", label="mass")
        panel.set_title(f"$\\Gamma$ = {gamma:.3f}")
        panel.set_xlabel("$\\omega t$ [rad]")
        # The last line is of the instant after the landing.
        run.check(f"Gamma {gamma:.3f}: largest deviation of the mass's velocity in flight from {velocity:.4f}",
                  max(abs(v - velocity) for v, row in zip(mass, rows) if row["phase"] == "F"), 0, 1e-5,
                  because="tan(beta) = 1e-6 is as far from the limit")
    axes[0].set_ylabel("velocity along the trough [$\\omega r \\cos\\beta$]")
    axes[0].legend()
    figure.savefig(run.output / "velocities.png", dpi=100)


def draw_optimum(run: ValidationCase) -> None:
    figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    tangents = [0.001, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
    for mu in (0.2, 0.35, 0.5):
        answers = [run.json("limits", "--friction", mu, "--tan-vibration-angle", t) for t in tangents]
        axes.plot([mu * t for t in tangents], [a["best_throw_number"] for a in answers], label=f"$\\mu$ = {mu:g}")
        if mu == 0.5:
            run.check("best throw number at tan(beta) = mu = 0.5", answers[5]["best_throw_number"], 3.05, 0.01,
                      because="found by two independent codes to that digit")
    axes.set_xlabel("$\\mu\\,\\tan\\beta$")
    axes.set_ylabel("throw number of maximum efficiency")
    axes.legend()
    figure.savefig(run.output / "best_throw_number.png", dpi=100)


def main() -> None:
    run = ValidationCase(FOLDER)
    tangent = 0.5 if run.control else 1e-6
    limits = run.json("limits", "--friction", 0.35, "--tan-vibration-angle", tangent)
    judge_limits(run, limits)
    draw_traces(run, tangent, (limits["throw_number_of_whole_cycle_flight"], limits["best_throw_number_small_angle"]))
    if not run.control:
        draw_optimum(run)
    run.finish()


if __name__ == "__main__":
    main()
