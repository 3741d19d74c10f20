#!/usr/bin/python3
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from validation_case import ValidationCase  # noqa: E402

SMALL = ("--tan-vibration-angle", 1e-6, "--friction", 0.35)


def main():
    run = ValidationCase(FOLDER)
    limits = run.json("limits", "--friction", 0.35, "--tan-vibration-angle", 1e-6)
    whole, best = limits["throw_number_of_whole_cycle_flight"], limits["best_throw_number_small_angle"]
    run.check("throw number of maximum efficiency (2.975)", best, 2.975, 0.0006)
    run.check("the same by maximising the solver's eta", limits["best_throw_number"], best, 1e-4)
    run.check("efficiency at 3.297 (the paper prints 0.954)", limits["efficiency_at_whole_cycle_flight"], 0.9529, 5e-5)
    figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained", sharey=True)
    for panel, gamma in zip(axes, (whole, best)):
        rows = run.csv("trace", "--throw-number", repr(gamma), *SMALL, "--samples", 721)
        time = [float(row["time_rad"]) for row in rows]
        panel.plot(time, [float(row["trough_velocity_x"]) for row in rows], label="trough")
        panel.plot(time, [float(row["mass_velocity_x"]) for row in rows], "--", label="mass")
        panel.set_title(f"$\\Gamma$ = {gamma:.3f}")
        panel.set_xlabel("$\\omega t$ [rad]")
    axes[0].set_ylabel("velocity along the trough [$\\omega r \\cos\\beta$]")
    axes[0].legend()
    figure.savefig(run.output / "velocities.png", dpi=100)

    figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    for mu in (0.2, 0.35, 0.5):
        tangents = [0.001, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
        answers = [run.json("limits", "--friction", mu, "--tan-vibration-angle", t) for t in tangents]
        axes.plot([mu * t for t in tangents], [a["best_throw_number"] for a in answers], label=f"$\\mu$ = {mu:g}")
        if mu == 0.5:
            run.check("best throw number at tan(beta) = mu = 0.5", answers[5]["best_throw_number"], 3.05, 0.01)
    axes.set_xlabel("$\\mu\\,\\tan\\beta$")
    axes.set_ylabel("throw number of maximum efficiency")
    axes.legend()
    figure.savefig(run.output / "best_throw_number.png", dpi=100)
    run.finish()


if __name__ == "__main__":
    main()
