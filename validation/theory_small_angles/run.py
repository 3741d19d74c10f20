#!/usr/bin/python3
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import math  # noqa: E402

import draw_theory_map  # noqa: E402
from validation_case import ValidationCase  # noqa: E402


def main():
    run = ValidationCase(FOLDER)
    path = run.output / "small_angles.h5"
    run.theory("map", "--x", f"machine_number=0.3:3:{run.points}", "--y", f"vibration_angle_deg=0:10:{run.points}",
               "--friction", 0.35, "--output", path)
    print(draw_theory_map.draw(path, "modes", run.output / "small_angles_modes.png"))
    theory = draw_theory_map.TheoryMap(path)
    # At beta = 0 the PN mode begins at K = mu sqrt(1 + pi^2/4); the paper reads 0.67 off its figure. The map's line, to a cell.
    pn = theory.modes.index("PN")
    first = min(x for x, mode in zip(theory.x, theory.mode[0]) if mode == pn)
    exact = 0.35 * math.sqrt(1 + math.pi**2 / 4)
    run.check("first K of the PN mode in the map at beta = 0", first, exact, theory.x[1] - theory.x[0])
    limits = run.json("limits", "--friction", 0.35, "--tan-inclination", -0.1)
    run.check("eta for small angles, Eq. 21 (0.434)", limits["small_angle_efficiency"], 0.434, 0.0005)
    # tan(beta) = 1e-6 at Gamma = 1 is K = 1e6: the solver against Eq. 21, antisymmetric in the inclination.
    for tan_alpha in (-0.1, 0.1):
        point = run.json("point", "--throw-number", 1, "--tan-vibration-angle", 1e-6, "--tan-inclination", tan_alpha,
                         "--friction", 0.35)
        exact = -math.sin(math.pi * tan_alpha / 0.7)
        run.check(f"eta of the solver at tan(alpha) = {tan_alpha:g}", point["velocity_efficiency"], exact, 1e-5)
    # Eq. 20 in closed form against the solver.
    for gamma in (0.6, 0.8, 1.0):
        options = ("--tan-vibration-angle", 0.2, "--tan-inclination", -0.05, "--friction", 0.35, "--throw-number", gamma)
        closed = run.json("limits", *options)["pn_closed_form"]["velocity_efficiency"]
        run.check(f"Eq. 20 at Gamma = {gamma:g}", closed, run.json("point", *options)["velocity_efficiency"], 1e-9)
    run.finish()


if __name__ == "__main__":
    main()
