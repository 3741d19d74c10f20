#!/usr/bin/python3
import pathlib
import sys
from typing import Any

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import h5py  # noqa: E402
import numpy as np  # noqa: E402

import figure_style  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

# What differs from base.toml. The first material is that of [grains], the index is that of the other one.
CASES: dict[str, dict[str, Any]] = {
    "sizes": {"materials.1.diameter": "1.5 mm"},
    "densities": {"materials.1.density": "5600 kg/m3"},
    "intruder": {"grains.diameter": "2 mm", "materials.1.diameter": "4.5 mm", "materials.1.diameter_spread": 0, "materials.1.mass_fraction": None,
                 "materials.1.number_fraction": 0.0024, "measure.packings": 12, "measure.max_packings": 12, "layer.length": "18.5 mm", "layer.width": "18.5 mm", "layer.height": "10 mm"},
    "same": {},
    "large and heavy": {"grains.diameter": "1.5 mm", "materials.1.diameter": "3 mm", "materials.1.density": "5600 kg/m3"},
}  # fmt: skip
COLUMNS = ["case", "segregation", "half_width", "lead", "lead_half_width", "share_of_grains", "outcome"]
CURVES = ["case", "cycle", "segregation", "half_width"]
EVERY = 5  # cycles between two rows of curves.csv


def simulate(run: ValidationCase) -> None:
    rows, curves = [], []
    for name, changes in CASES.items():
        folder = name.replace(" ", "-")
        (answer,) = run.campaign(folder, changes, {})
        with h5py.File(run.runs / folder / "cases" / answer["case"] / "result.h5") as file:
            share, index = file["materials"]["number_fraction"][1], file["segregation"]
            for row in index[::EVERY]:
                curves.append([name, int(row["cycle"]), f"{row['index_1']:.4f}", f"{row['half_width_1']:.4f}"])
        numbers = [f"{float(answer[key]):.4f}" for key in ("segregation", "segregation_half_width", "material_lead", "material_lead_half_width")]
        rows.append([name, *numbers, f"{share:.4f}", answer["outcome"]])
    run.write_table("result.csv", COLUMNS, rows)
    run.write_table("curves.csv", CURVES, curves)


def judge(run: ValidationCase) -> None:
    measured = {row["case"]: row for row in run.table("result.csv")}
    for reference in run.reference():
        row, sign = measured[reference["case"]], int(reference["sign"])
        index, half_width = float(row["segregation"]) * (-1 if run.control else 1), float(row["half_width"])
        if sign == 0:
            run.check(f"{reference['words']}: index", index, 0, half_width, because="its own interval at 95 %")
        else:
            run.between(f"{reference['words']}: index times {sign}", sign * index, half_width, np.inf,
                        because="the interval at 95 % must not reach 0")
    heavy = measured["large and heavy"]
    index, half_width = float(heavy["segregation"]), float(heavy["half_width"])
    way = "stay below" if index < -half_width else "come to the top" if index > half_width else "stay mixed with them"
    run.finding("large grains that are four times as dense as the small ones sink (reverse Brazil-nut effect)", index < -half_width,
                f"they {way}: {index:.2f} +- {half_width:.2f} after 150 cycles. Which way they go depends on the "
                "excitation (Breu et al., Phys. Rev. Lett. 90, 2003, 014302)")


def draw(run: ValidationCase) -> None:
    figure, axes = figure_style.new_figure(layout="constrained")
    for name, colour in zip(CASES, figure_style.COLOURS, strict=False):
        rows = [row for row in run.table("curves.csv") if row["case"] == name]
        cycles, index, width = (np.array([float(row[key]) for row in rows]) for key in ("cycle", "segregation", "half_width"))
        axes.plot(cycles, index, color=colour, label=name)
        axes.fill_between(cycles, index - width, index + width, color=colour, alpha=0.2, linewidth=0)
    axes.axhline(0, color=figure_style.GREY, linewidth=0.8)
    axes.set(xlabel="cycles", ylabel="segregation index of the other material", ylim=(-1, 1))
    axes.legend(fontsize=8)
    figure_style.plain_axes(axes)
    figure.savefig(run.figure("segregation.png"), dpi=110)


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        simulate(run)
    judge(run)
    if not run.control:
        draw(run)
    run.finish()


if __name__ == "__main__":
    main()
