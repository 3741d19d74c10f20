#!/usr/bin/python3
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import numpy as np  # noqa: E402
from numpy.typing import NDArray  # noqa: E402

from vibrotrough.figures import theory_map  # noqa: E402
from vibrotrough.figures.theory_map import TheoryMap  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

Floats = NDArray[np.float64]

FRICTION = 0.35


def slide_thresholds(tan_beta: Floats, tan_alpha: float) -> tuple[Floats, Floats]:
    """Throw numbers above which a positive and a negative slide can start from rest, Eqs. 7 and 8."""
    positive = (FRICTION + tan_alpha) * tan_beta / (1 + FRICTION * tan_beta)
    negative = (FRICTION - tan_alpha) * tan_beta / (1 - FRICTION * tan_beta)
    return positive, negative


def impossible_cells(theory: TheoryMap, tan_alpha: float) -> tuple[int, int]:
    """Cells below Gamma = 1 with a slide that cannot start, and cells at rest where one must."""
    gamma, beta = np.meshgrid(theory.x, np.radians(theory.y))
    positive, negative = slide_thresholds(np.tan(beta), tan_alpha)
    mode = np.array(theory.modes)[theory.mode]
    has_p, has_n = np.char.find(mode, "P") >= 0, np.char.find(mode, "N") >= 0
    below = gamma < 1
    slides = below & ((has_p & (gamma < positive)) | (has_n & (gamma < negative)))
    rests = below & ~has_p & ~has_n & ((gamma > positive) | (gamma > negative))
    return int(slides.sum()), int(rests.sum())


def judge(run: ValidationCase, name: str, tan_alpha: float, friction: float) -> None:
    path = run.output / f"{name}.h5"
    print(run.theory("map", "--x", f"throw_number=0.3:3.3:{run.points}", "--y", f"vibration_angle_deg=5:60:{run.points}",
                     "--friction", friction, "--tan-inclination", tan_alpha, "--output", path), end="")
    for kind in ("modes", "efficiency", "lines"):
        print(theory_map.draw(path, kind, run.output / f"{name}_{kind}.png"))
    theory = theory_map.TheoryMap(path)
    height = sum(abs(y1 - y0) for x0, y0, x1, y1 in theory.lines if abs(x0 - 1) < 1e-9 and abs(x1 - 1) < 1e-9)
    run.check(f"{name}: part of the angles at which flight begins at Gamma = 1", height / 55, 1, 8 / run.points,
              because="lines are located to 1e-9; where a third mode meets it the pieces of a cell are joined at their middle")
    slides, rests = impossible_cells(theory, tan_alpha)
    run.check(f"{name}: cells with a slide that cannot start (Eqs. 7, 8)", slides, 0, 0, because="exact")
    run.check(f"{name}: cells at rest where a slide must start", rests, 0, 0, because="exact")
    row, column = run.points // 2, run.points // 3
    alone = run.json("point", "--throw-number", repr(float(theory.x[column])), "--vibration-angle",
                     f"{float(theory.y[row])!r} deg", "--tan-inclination", tan_alpha, "--friction", friction)
    run.check(f"{name}: eta of a point", theory.efficiency[row, column], alone["velocity_efficiency"], 1e-8,
              because="the solver's error")


def main() -> None:
    run = ValidationCase(FOLDER)
    friction = 0.30 if run.control else FRICTION
    judge(run, "decline", -0.1, friction)
    judge(run, "incline", 0.1, friction)
    run.finish()


if __name__ == "__main__":
    main()
