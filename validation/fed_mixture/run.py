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

SHARE = 0.4  # of the fines, by mass
BEHIND_FEED = 0.05  # m, where the feed has fallen in, and from where the time is counted
EDGE = 0.27  # m, a tenth of the trough before its edge
PLACES = [0.1, 0.175, 0.25]  # m, of the criteria
FACTS = ["depth_m", "height_m", "share_out", "share_out_half_width", "outcome_open", "outcome_endless"]
ALONG = ["x_m", "time_s", "segregation", "half_width"]
OVER_TIME = ["time_s", "segregation", "half_width"]


def result_of(run: ValidationCase, name: str, answer: dict[str, str]) -> h5py.File:
    return h5py.File(run.runs / name / "cases" / answer["case"] / "result.h5")


def simulate(run: ValidationCase) -> None:
    (fed,) = run.campaign("open", {}, {})
    with result_of(run, "open", fed) as file:
        along, whole = file["materials_along"][()], file["along_trough"][()]
    fines = along[along["material"] == b"fines"]
    inside = (fines["x"] > BEHIND_FEED) & (fines["x"] < EDGE)
    depth = float(np.mean(whole["depth"][inside]))
    # How long a layer needs from the end of the feed to each place: the integral of dx / v.
    step = fines["x"][1] - fines["x"][0]
    time = np.cumsum(step / whole["velocity"][inside]) - step / whole["velocity"][inside] / 2
    height = round(1e3 * depth, 1)
    endless: dict[str, Any] = {"feed.mass_flow": None, "feed.length": None, "layer.length": "30 mm", "layer.height": f"{height} mm", "measure.packings": 12,
                               "measure.max_packings": 12, "measure.min_cycles": 40, "measure.max_cycles": 40}  # fmt: skip
    (kept,) = run.campaign("endless", endless, {})
    with result_of(run, "endless", kept) as file:
        index, frequency = file["segregation"][()], float(file["case"]["frequency"])
    shares = [flow[1] / sum(flow) for flow in outflows(run, fed)]
    width = float(np.std(shares, ddof=1) / np.sqrt(len(shares)) * 2.571)  # Student's t with 5 degrees of freedom, 95 %
    run.write_table("facts.csv", FACTS, [[f"{depth:.5f}", f"{height / 1e3:.4f}", f"{np.mean(shares):.4f}", f"{width:.4f}", fed["outcome"], kept["outcome"]]])
    run.write_table("along.csv", ALONG, [[f"{row['x']:.4f}", f"{when:.4f}", f"{row['segregation']:.4f}", f"{row['segregation_half_width']:.4f}"] for row, when in zip(fines[inside], time)])
    run.write_table("over_time.csv", OVER_TIME, [[f"{row['cycle'] / frequency:.4f}", f"{row['index_1']:.4f}", f"{row['half_width_1']:.4f}"] for row in index])


def outflows(run: ValidationCase, fed: dict[str, str]) -> list[list[float]]:
    with result_of(run, "open", fed) as file:
        return [list(packing["outflow"]) for packing in file["material_flow"].values()]


def columns(run: ValidationCase, table: str, names: list[str]) -> list[Any]:
    rows = run.table(table)
    return [np.array([float(row[name]) for row in rows]) for name in names]


def judge(run: ValidationCase) -> None:
    (facts,) = run.table("facts.csv")
    run.check("share of the fines in what leaves", float(facts["share_out"]), SHARE, float(facts["share_out_half_width"]), because="its own interval at 95 %: what is fed must leave")
    x, when, index, width = columns(run, "along.csv", ALONG)
    time, kept, kept_width = columns(run, "over_time.csv", OVER_TIME)
    sign = -1 if run.control else 1
    for place in PLACES:
        moment = np.interp(place, x, when)
        wanted, its_width = np.interp(moment, time, kept), np.interp(moment, time, kept_width)
        run.check(f"segregation index {1e3 * place:.0f} mm from the back wall, after {moment:.2f} s", float(np.interp(place, x, index)), float(sign * wanted), float(np.interp(place, x, width) + its_width), because="both intervals at 95 %")


def draw(run: ValidationCase) -> None:
    _, when, index, width = columns(run, "along.csv", ALONG)
    time, kept, kept_width = columns(run, "over_time.csv", OVER_TIME)
    figure, axes = figure_style.new_figure(layout="constrained")
    for number, (t, mean, half, words) in enumerate(((when, index, width, "open trough, place as time"), (time, kept, kept_width, "endless layer"))):
        axes.plot(t, mean, color=figure_style.COLOURS[number], label=words)
        axes.fill_between(t, mean - half, mean + half, color=figure_style.COLOURS[number], alpha=0.2, linewidth=0)
    axes.axhline(0, color=figure_style.GREY, linewidth=0.8)
    axes.set(xlabel="time since the feed  [s]", ylabel="segregation index of the fines  [-]", xlim=(0, when[-1] * 1.05), ylim=(-1, 1))
    axes.legend(fontsize=8)
    figure_style.plain_axes(axes)
    figure.savefig(run.figure("fed_mixture.png"), dpi=110)


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
