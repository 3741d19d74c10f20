#!/usr/bin/python3
import math
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import numpy as np  # noqa: E402
from numpy.typing import NDArray  # noqa: E402

from campaign_program import Row  # noqa: E402
from vibrotrough.figures import style  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

Floats = NDArray[np.float64]
Reference = dict[str, tuple[float, float]]  # value and reading error by name

GRAVITY = 9.81
LIKELY = (0.2, 0.6)  # friction of bulk goods on steel
FRICTIONS = np.round(np.arange(0.02, 1.2, 0.01), 3)
STATIC = 1.5  # times the kinetic friction, for the second curve
LAYER_FRICTIONS, ROTATIONS = [0.3, 0.5], ["free", "blocked"]
LAYER_COLUMNS = ["rotation", "friction", "speed_cm_per_s", "speed_half_width", "theory_cm_per_s", "cycles", "outcome"]
AGREEMENT = 0.2  # of layers with the theory below throw number 1, Sloot & Kruyt


def speeds(run: ValidationCase, k: float, beta: float, unit: float, static: float) -> Floats:
    """Conveying speeds in cm/s over FRICTIONS; `unit`: omega r cos(beta) in m/s."""
    columns = ["machine_number", "vibration_angle_deg", "friction", "static_friction"]
    points = [(k, beta, mu, static * mu) for mu in FRICTIONS]
    return 100 * unit * run.efficiencies(columns, points)


def simulate(run: ValidationCase) -> None:
    """A layer of 3 mm spheres on the example's machine, with and without rotation."""
    lines = []
    for rotation in ROTATIONS:
        for answer in run.campaign(rotation, {"grains.rotation": rotation}, {"trough.friction": LAYER_FRICTIONS}):
            unit = 100 * 2 * math.pi * float(answer["frequency_hz"]) * float(answer["amplitude_m"])
            unit *= math.cos(math.radians(float(answer["vibration_angle_deg"])))
            names = ("efficiency", "efficiency_half_width_statistics", "efficiency_theory")
            lines.append([rotation, answer["friction"], *(f"{float(answer[name]) * unit:.3f}" for name in names), answer["cycles_measured"],
                          answer["outcome"]])
    run.write_table("result.csv", LAYER_COLUMNS, lines)


def judge_layer(run: ValidationCase, reference: Reference, layers: list[Row]) -> None:
    chart, error = reference["speed"]
    texts = [f"{one['rotation']} {float(one['speed_cm_per_s']):.1f} +- {float(one['speed_half_width']):.1f} at mu = {one['friction']}" for one in layers]
    for one in layers:
        if one["rotation"] == "blocked":
            run.check(f"simulated layer without rotation over the theory, mu = {one['friction']}", float(one["speed_cm_per_s"]) / float(one["theory_cm_per_s"]),
                      1, AGREEMENT, because="layers follow the theory to 20 % below throw number 1 (Sloot & Kruyt)")
    reached = [one for one in layers if float(one["speed_cm_per_s"]) + float(one["speed_half_width"]) >= chart - error]
    run.finding("a simulated layer of 3 mm spheres reaches the chart's speed", bool(reached), f"rotation {'; '.join(texts)} cm/s")


def judge_machine(run: ValidationCase, reference: Reference, k: float, omega: float, amplitude: float) -> None:
    wanted, error = reference["machine_factor_K"]
    run.check("K = omega^2 r / g, printed as 1.6", k, wanted, error, because="half of the last printed digit")
    wanted, error = reference["acceleration_force"]
    run.check("m omega^2 r, printed as 3423 N", reference["oscillating_mass"][0] * omega**2 * amplitude, wanted, 2 * error,
              because="half of the last printed digit, of force and of K")
    for factor, flies in ((0.995, False), (1.005, True)):
        point = run.json("point", "--machine-number", 2 * factor, "--vibration-angle", "30 deg", "--friction", 0.4)
        run.check(f"flies at K = {2 * factor:g} (the catalogue: from K = 2 at 30 degrees)", point["mode"].startswith("F"), flies, 0)


def judge_speed(run: ValidationCase, reference: Reference, plain: Floats, static: Floats) -> None:
    chart, error = reference["speed"]
    best = int(plain.argmax())
    run.check("theory's fastest speed over friction, over the chart's 20 cm/s", plain[best] / chart, 1, AGREEMENT,
              because="layers follow the theory to 20 % below throw number 1 (Sloot & Kruyt)")
    likely = (FRICTIONS >= LIKELY[0]) & (FRICTIONS <= LIKELY[1])
    low, high = plain[likely].min(), plain[likely].max()
    run.finding("ROSTA: the theoretical material speed is 20 cm/s", bool(low <= chart + error and high >= chart - error),
                f"{low:.1f} to {high:.1f} cm/s over friction 0.2 to 0.6; the chart is {100 * (chart / plain[best] - 1):.0f} % above the fastest, that "
                f"at mu = {FRICTIONS[best]:g}, and read to +- {error:g}. With static friction {STATIC:g} times the kinetic one it goes up to {static.max():.1f}")
    slipping = float(np.interp(0.7 * chart, plain[:best], FRICTIONS[:best]))
    run.finding("ROSTA: below K = 2 the speed is not exactly definable; fine dry grains slip by up to 30 %", bool(high / low > 1.3),
                f"friction alone changes it by a factor {high / low:.1f}; 30 % of slip, 14 cm/s, is friction {slipping:.2f}")


def draw(run: ValidationCase, reference: Reference, plain: Floats, static: Floats, layers: list[Row]) -> None:
    figure, axes = style.new_figure(size=(7.2, 4.4), layout="constrained")
    axes.plot(FRICTIONS, plain, color=style.COLOURS[0], label="theory")
    axes.plot(FRICTIONS, static, "--", color=style.COLOURS[2], label=f"theory, static friction {STATIC:g} times the kinetic")
    chart, error = reference["speed"]
    axes.axhspan(chart - error, chart + error, color=style.COLOURS[1], alpha=0.25, label="ROSTA's chart, with its reading error")
    axes.axhline(0.7 * chart, color=style.COLOURS[1], ls=":", label="30 % of slip")
    for i, rotation in enumerate(ROTATIONS):
        these = [one for one in layers if one["rotation"] == rotation]
        axes.errorbar([float(one["friction"]) for one in these], [float(one["speed_cm_per_s"]) for one in these],
                      yerr=[float(one["speed_half_width"]) for one in these], fmt=style.MARKERS[i + 1], color=style.COLOURS[3 + i],
                      fillstyle="none", capsize=2, label=f"simulated layer, rotation {rotation}")
    axes.axvspan(*LIKELY, color="#eeeeee", zorder=0)
    axes.text(sum(LIKELY) / 2, 0.5, "bulk goods on steel", ha="center", fontsize=8, color=style.GREY)
    axes.set(xlabel="friction \u03bc (kinetic)  [-]", ylabel="conveying speed  [cm/s]", xlim=(0, 1.2), ylim=(0, None))
    axes.legend(fontsize=8, loc="lower right", bbox_to_anchor=(1, 0.08))
    style.plain_axes(axes)
    figure.savefig(run.figure("rosta.png"), dpi=110)


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        simulate(run)
    reference = {row["name"]: (float(row["value"]), float(row["reading_error"])) for row in run.reference()}
    radius = reference["eccentric_radius"][0] / 1000
    amplitude = radius / 2 if run.control else radius
    omega, beta = 2 * math.pi * reference["revolutions"][0] / 60, reference["rocker_angle"][0]
    k, unit = omega**2 * amplitude / GRAVITY, omega * amplitude * math.cos(math.radians(beta))
    judge_machine(run, reference, k, omega, amplitude)
    plain, static = (speeds(run, k, beta, unit, factor) for factor in (1, STATIC))
    judge_speed(run, reference, plain, static)
    if not run.control:
        layers = run.table("result.csv")
        judge_layer(run, reference, layers)
        draw(run, reference, plain, static, layers)
    run.finish()


if __name__ == "__main__":
    main()
