#!/usr/bin/python3
import math
import pathlib
import sys
from typing import Any

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

from matplotlib.axes import Axes  # noqa: E402

from vibrotrough.figures.style import plt  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

STEP = 0.005  # to which the end of a mode is looked for, in mu
FRICTIONS = [0.02 * k for k in range(1, 31)]  # of the curves


def judge_curve(run: ValidationCase, axes: Axes, k: float, slope: tuple[object, ...]) -> None:
    def at(friction: float) -> dict[str, Any]:
        return run.json("friction", "--machine-number", k, "--friction", friction, *slope)

    rows, mu = [at(friction) for friction in FRICTIONS], FRICTIONS
    x = [float(row["max_relative_displacement"]) for row in rows]
    axes.plot(mu, x, label=f"K = {k:g}")
    slides = [i for i, row in enumerate(rows) if row["mode"] == "PN"]
    worst = max(abs(x[i] - 2 * math.sqrt(max(0, 1 - (math.pi * mu[i] / (2 * k)) ** 2))) for i in slides)
    run.check(f"K = {k:g}: largest deviation from the closed form in the PN mode", worst, 0, 1e-8, because="the solver's error")
    last = k / math.sqrt(1 + math.pi**2 / 4)
    if last < mu[-1]:
        low, high = mu[slides[-1]], mu[slides[-1] + 1]
        while high - low > STEP:
            middle = (low + high) / 2
            low, high = (middle, high) if at(middle)["mode"] == "PN" else (low, middle)
        run.check(f"K = {k:g}: largest mu of the PN mode", low, last, STEP, because="the step of the search")


def main() -> None:
    run = ValidationCase(FOLDER)
    slope = ("--tan-inclination", 0.01) if run.control else ()
    figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
    for k in (0.5, 0.67, 1, 1.5, 2, 4):
        judge_curve(run, axes, k, slope)
    estimate = run.json("friction", "--machine-number", 1.5, "--max-relative-displacement", 1.9, "--uncertainty", 0.02)
    exact = 2 * 1.5 / math.pi * math.sqrt(1 - (1.9 / 2) ** 2)
    run.check("mu from X = 1.9 at K = 1.5", estimate["friction"], exact, 1e-6, because="the root's tolerance")
    axes.errorbar([estimate["friction"]], [1.9], xerr=[[estimate["friction"] - estimate["friction_low"]],
                                                       [estimate["friction_high"] - estimate["friction"]]],
                  yerr=0.02, fmt="ko", label="X = 1.9 +- 0.02 at K = 1.5")
    axes.set_xlabel("friction $\\mu$")
    axes.set_ylabel("largest relative displacement [r]")
    axes.legend()
    figure.savefig(run.output / "shake_test.png", dpi=100)
    run.finish()


if __name__ == "__main__":
    main()
