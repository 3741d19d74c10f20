#!/usr/bin/python3
import math
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

from matplotlib.axes import Axes  # noqa: E402
import numpy as np  # noqa: E402

from vibrotrough.figures import theory_map  # noqa: E402
from vibrotrough.figures.style import plt  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

TOP = 3.3  # throw number of the uppermost row


def judge(run: ValidationCase, axes: Axes, mu: float, beta: float) -> None:
    slope = "0.15:-0.15" if run.control else "-0.15:0.15"
    path = run.output / f"mu_{mu:g}_beta_{beta}.h5"
    run.theory("map", "--x", f"tan_inclination={slope}:{run.points}", "--y", f"throw_number=0.5:{TOP}:{run.points}",
               "--friction", mu, "--vibration-angle", f"{beta} deg", "--output", path)
    theory = theory_map.TheoryMap(path)
    tan_alpha = -theory.x if run.control else theory.x  # what the axis is taken for
    theory_map.draw_iso(theory, axes)
    axes.set_title(f"$\\mu$ = {mu:g}, $\\beta$ = {beta} deg")
    rise = (theory.efficiency[:, 1:] - theory.efficiency[:, :-1]).max()
    run.check(f"mu {mu:g}, beta {beta}: largest rise of eta per step uphill", max(rise, 0), 0, 1e-8,
              because="the solver's error; where a flight fills the cycle eta may rest equal")
    exact = math.pi / TOP * (1 - tan_alpha * math.tan(math.radians(beta)))
    run.check(f"mu {mu:g}, beta {beta}: largest deviation from Eqs. 15 and 16 at Gamma = {TOP:g}",
              np.abs(theory.efficiency[-1] - exact).max(), 0, 1e-8, because="the solver's error")


def main() -> None:
    run = ValidationCase(FOLDER)
    figure, axes = plt.subplots(2, 2, figsize=(11, 8), layout="constrained")
    for i, mu in enumerate((0.2, 0.3)):
        for j, beta in enumerate((30, 45)):
            judge(run, axes[i, j], mu, beta)
    figure.savefig(run.output / "iso_curves.png", dpi=100)
    run.finish()


if __name__ == "__main__":
    main()
