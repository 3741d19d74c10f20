#!/usr/bin/python3
import math
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

from campaign_program import Row  # noqa: E402
from vibrotrough.figures import theory_map  # noqa: E402
from validation_case import ValidationCase  # noqa: E402


def judge_threshold(run: ValidationCase, friction: float, reading: Row) -> None:
    path = run.output / "small_angles.h5"
    run.theory("map", "--x", f"machine_number=0.3:3:{run.points}", "--y", f"vibration_angle_deg=0:10:{run.points}",
               "--friction", friction, "--output", path)
    print(theory_map.draw(path, "modes", run.output / "small_angles_modes.png"))
    theory = theory_map.TheoryMap(path)
    pn = theory.modes.index("PN")
    first = min(x for x, mode in zip(theory.x, theory.mode[0]) if mode == pn)
    exact = 0.35 * math.sqrt(1 + math.pi**2 / 4)
    run.check("first K of the PN mode in the map at beta = 0", first, exact, theory.x[1] - theory.x[0], because="a cell of the map")
    limits = run.json("limits", "--friction", friction)
    run.check("K of the PN mode, exact", limits["pn_machine_number_level_small_angle"], exact, 1e-9, because="rounding")
    off = abs(limits["pn_machine_number_level_small_angle"] - float(reading["value"]))
    run.finding("the paper reads K = 0.67 off its Fig. 7", off <= float(reading["reading_error"]),
                f"exactly {exact:.3f}; within the reading error of {reading['reading_error']}")


def main() -> None:
    run = ValidationCase(FOLDER)
    printed = {row["name"]: row for row in run.reference()}
    friction = 0.30 if run.control else 0.35
    judge_threshold(run, friction, printed["pn_machine_number_read_off_fig_7"])
    limits = run.json("limits", "--friction", friction, "--tan-inclination", -0.1)
    row = printed["small_angle_efficiency"]
    run.check("eta for small angles, Eq. 21", limits["small_angle_efficiency"], float(row["value"]), float(row["reading_error"]),
              because="half of the last printed digit")
    for tan_alpha in (-0.1, 0.1):  # antisymmetric in the inclination
        point = run.json("point", "--throw-number", 1, "--tan-vibration-angle", 1e-6, "--tan-inclination", tan_alpha,
                         "--friction", friction)
        run.check(f"eta of the solver at tan(alpha) = {tan_alpha:g}", point["velocity_efficiency"],
                  -math.sin(math.pi * tan_alpha / 0.7), 1e-5, because="tan(beta) = 1e-6, K = 1e6 is as far from the limit")
    for gamma in (0.6, 0.8, 1.0):
        options = ("--tan-vibration-angle", 0.2, "--tan-inclination", -0.05, "--friction", friction, "--throw-number", gamma)
        closed = run.json("limits", *options)["pn_closed_form"]["velocity_efficiency"]
        run.check(f"Eq. 20 at Gamma = {gamma:g}", closed, run.json("point", *options)["velocity_efficiency"], 1e-9,
                  because="closed form and solver, both to rounding")
    run.finish()


if __name__ == "__main__":
    main()
