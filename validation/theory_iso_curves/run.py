#!/usr/bin/python3
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import draw_theory_map  # noqa: E402
from validation_case import ValidationCase  # noqa: E402


def main():
    run = ValidationCase(FOLDER)
    figure, axes = plt.subplots(2, 2, figsize=(11, 8), layout="constrained")
    for i, mu in enumerate((0.2, 0.3)):
        for j, beta in enumerate((30, 45)):
            path = run.output / f"mu_{mu:g}_beta_{beta}.h5"
            run.theory("map", "--x", f"tan_inclination=-0.15:0.15:{run.points}", "--y", f"throw_number=0.5:3.3:{run.points}",
                       "--friction", mu, "--vibration-angle", f"{beta} deg", "--output", path)
            theory = draw_theory_map.TheoryMap(path)
            draw_theory_map.draw_iso(theory, axes[i, j])
            axes[i, j].set_title(f"$\\mu$ = {mu:g}, $\\beta$ = {beta} deg")
            # Uphill is never faster: eta falls along every row. Where a flight fills the cycle it may rest equal.
            rise = (theory.efficiency[:, 1:] - theory.efficiency[:, :-1]).max()
            run.check(f"mu {mu:g}, beta {beta}: largest rise of eta per step uphill", max(rise, 0), 0, 1e-8)
    figure.savefig(run.output / "iso_curves.png", dpi=100)
    run.finish()


if __name__ == "__main__":
    main()
