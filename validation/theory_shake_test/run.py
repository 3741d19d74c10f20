#!/usr/bin/python3
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import math  # noqa: E402

import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from validation_case import ValidationCase  # noqa: E402


def main():
    run = ValidationCase(FOLDER)
    figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
    for k in (0.5, 0.67, 1, 1.5, 2, 4):
        rows = run.csv("friction", "--machine-number", k, "--friction", "0.02:0.6:117")
        mu = [float(row["friction"]) for row in rows]
        x = [float(row["max_relative_displacement"]) for row in rows]
        axes.plot(mu, x, label=f"K = {k:g}")
        # In the PN mode X = 2 sqrt(1 - (pi mu / (2 K))^2), Eqs. 10 and 20 at beta = 0, alpha = 0.
        worst = max((abs(x[i] - 2 * math.sqrt(1 - (math.pi * mu[i] / (2 * k)) ** 2))
                     for i, row in enumerate(rows) if row["mode"] == "PN"), default=0)
        run.check(f"K = {k:g}: largest deviation from the closed form in the PN mode", worst, 0, 1e-8)
    estimate = run.json("friction", "--machine-number", 1.5, "--max-relative-displacement", 1.9, "--uncertainty", 0.02)
    exact = 2 * 1.5 / math.pi * math.sqrt(1 - (1.9 / 2) ** 2)
    run.check("mu from X = 1.9 at K = 1.5", estimate["friction"], exact, 1e-6)
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
