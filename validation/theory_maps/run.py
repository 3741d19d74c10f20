#!/usr/bin/python3
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import draw_theory_map  # noqa: E402
from validation_case import ValidationCase  # noqa: E402


def main():
    run = ValidationCase(FOLDER)
    for tan_alpha, name in ((-0.1, "decline"), (0.1, "incline")):
        path = run.output / f"{name}.h5"
        print(run.theory("map", "--x", f"throw_number=0.3:3.3:{run.points}", "--y", f"vibration_angle_deg=5:60:{run.points}",
                         "--friction", 0.35, "--tan-inclination", tan_alpha, "--output", path), end="")
        for kind in ("modes", "efficiency", "lines"):
            print(draw_theory_map.draw(path, kind, run.output / f"{name}_{kind}.png"))
        theory = draw_theory_map.TheoryMap(path)
        # Flight begins at Gamma = 1 whatever the angle: the line is located by roots, to 1e-9 of a cell. Where a third
        # mode meets it the pieces of that cell are joined at their middle, so a few cells are left out.
        height = sum(abs(y1 - y0) for x0, y0, x1, y1 in theory.lines if abs(x0 - 1) < 1e-9 and abs(x1 - 1) < 1e-9)
        run.check(f"{name}: part of the angles at which flight begins at Gamma = 1", height / 55, 1, 8 / run.points)
        # A point of the map is the point alone.
        row, column = run.points // 2, run.points // 3
        alone = run.json("point", "--throw-number", repr(float(theory.x[column])), "--vibration-angle",
                         f"{float(theory.y[row])!r} deg", "--tan-inclination", tan_alpha, "--friction", 0.35)
        run.check(f"{name}: eta of a point", theory.efficiency[row, column], alone["velocity_efficiency"], 1e-8)
    run.finish()


if __name__ == "__main__":
    main()
