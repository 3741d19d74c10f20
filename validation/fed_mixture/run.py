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
PLACES = [0.1, 0.25]  # m, between which the change of the index is judged
FACTS = ["depth_m", "height_m", "share_out", "share_out_half_width", "change_fed", "change_fed_half_width", "change_endless", "change_endless_half_width", "outcome_open", "outcome_endless"]
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
    with result_of(run, "open", fed) as file:
        flows = [table["outflow"] for table in file["material_flow"].values()]
        tables = [table[()] for table in file["material_along"].values()]
    at_places = np.interp(PLACES, fines["x"][inside], time)
    with result_of(run, "endless", kept) as file:
        index, frequency = file["segregation"][()], float(file["case"]["frequency"][0])
        ends = [table[()] for table in file["material_ends"].values()]
    fed_changes = [np.diff(np.interp(PLACES, *(table[name][len(table) // 2 :] for name in ("x", "segregation"))))[0] for table in tables]
    kept_changes = [np.diff(np.interp(at_places, np.arange(len(one)) / frequency, (one["z_1"] - one["z_0"]) / (height / 2e3)))[0] for one in ends]
    numbers = [f"{number:.4f}" for values in ([flow[1] / sum(flow) for flow in flows], fed_changes, kept_changes) for number in mean_and_half_width(values)]
    run.write_table("facts.csv", FACTS, [[f"{depth:.5f}", f"{height / 1e3:.4f}", *numbers, fed["outcome"], kept["outcome"]]])
    run.write_table("along.csv", ALONG, [[f"{row['x']:.4f}", f"{when:.4f}", f"{row['segregation']:.4f}", f"{row['segregation_half_width']:.4f}"] for row, when in zip(fines[inside], time)])
    run.write_table("over_time.csv", OVER_TIME, [[f"{row['cycle'] / frequency:.4f}", f"{row['index_1']:.4f}", f"{row['half_width_1']:.4f}"] for row in index])


def mean_and_half_width(values: list[float]) -> tuple[float, float]:
    """Of packings, by Student's t at 95 %."""
    student = {6: 2.571, 12: 2.201}[len(values)]
    return float(np.mean(values)), student * float(np.std(values, ddof=1)) / len(values) ** 0.5


def columns(run: ValidationCase, table: str, names: list[str]) -> list[Any]:
    rows = run.table(table)
    return [np.array([float(row[name]) for row in rows]) for name in names]


def judge(run: ValidationCase) -> None:
    (facts,) = run.table("facts.csv")
    run.check("share of the fines in what leaves", float(facts["share_out"]), SHARE, float(facts["share_out_half_width"]), because="its own interval at 95 %: what is fed must leave")
    names = ["change_fed", "change_fed_half_width", "change_endless", "change_endless_half_width"]
    change, width, kept, kept_width = (float(facts[name]) for name in names)
    run.between("change of the segregation index of the fines from 100 to 250 mm", (-1 if run.control else 1) * change, -np.inf, -width, because="the interval at 95 % must not reach 0: small grains sink (validation/mixtures)")
    rows = run.table("along.csv")
    first, start = float(rows[0]["segregation"]), float(run.table("over_time.csv")[0]["segregation"])
    run.finding("both layers begin equally mixed", abs(first - start) < 0.05, f"the index is {first:.2f} behind the feed and {start:.2f} in the poured layer: grains separate while they fall in and while they are poured")
    run.finding("both separate equally fast", abs(change - kept) < width + kept_width,
                f"in the time from 100 to 250 mm the index changes by {change:.3f} +- {width:.3f} in the open trough and by {kept:.3f} +- {kept_width:.3f} in the endless layer")  # fmt: skip


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
