#!/usr/bin/python3
import math
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import h5py  # noqa: E402
import numpy as np  # noqa: E402

from campaign_program import campaign_text  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

THROW_NUMBERS = [1.5, 2.0, 2.5]
# A few seconds: whether every grain is held or has left.
SHORT = {"layer.length": "80 mm", "feed.length": "20 mm", "feed.mass_flow": "0.08 t/h", "measure.packings": 1, "measure.max_packings": 1, "measure.half_width": 1.0,
         "measure.min_cycles": None, "measure.max_cycles": 20}  # fmt: skip
PERIODIC = {"layer.length": "40 mm", "feed.mass_flow": None, "feed.length": None, "measure.min_cycles": None}
COLUMNS = ["throw_number", "efficiency", "half_width", "depth_mm", "inflow_t_per_h", "outflow_t_per_h", "window_flow_t_per_h", "residence_s", "spread_s", "peclet", "outcome",
           "periodic_efficiency", "periodic_half_width", "periodic_outcome"]  # fmt: skip

# So much that the layer is as deep as those of the atlas. At throw number 1.5 it would be deeper still, and cost as much as all others.
DEEPER = {"feed.mass_flow": "0.28 t/h", "grains.youngs_modulus": None, "measure.max_packings": 4}  # such a layer is too soft with 10 MPa
DEEPER_AT = {"trough.throw_number": THROW_NUMBERS[1:]}
DEEPER_COLUMNS = ["throw_number", "efficiency", "half_width", "depth_mm", "outcome"]

WIDTH, SIDE, TOP = 20, 6, 60  # mm, of a V that is so high at its sides, with upright walls above
WINDOW = [0.11, 0.2]  # m, within the window where the speed is measured
VEE = ["efficiency", "half_width", "level_mm", "outcome", "periodic_efficiency", "periodic_half_width", "periodic_outcome"]


def vee(run: ValidationCase, name: str, length: int) -> dict[str, object]:
    """The changes for a V of this length (mm), whose mesh is put where the campaign file will be."""
    text = "solid vee\n"
    for wall in (0, WIDTH):
        top, side, bottom = ([(x, y, z) for x in (0, length)] for y, z in ((wall, TOP), (wall, SIDE), (WIDTH / 2, 0)))
        for corners in ((*side, bottom[1]), (side[0], *reversed(bottom)), (*top, side[1]), (top[0], *reversed(side))):
            text += "facet normal 0 0 1 outer loop " + " ".join(f"vertex {x:g} {y:g} {z:g}" for x, y, z in corners) + " endloop endfacet\n"
    run.runs.mkdir(parents=True, exist_ok=True)
    (run.runs / f"{name}.stl").write_text(text + "endsolid vee\n", encoding="ascii")
    return {"trough.side_wall_friction": None, "trough.mesh": f"{name}.stl", "trough.mesh_unit": "mm", "layer.length": f"{length} mm"}


def simulate_vee(run: ValidationCase) -> None:
    (row,) = run.campaign("open-vee", vee(run, "open-vee", 240), {})
    with h5py.File(run.runs / "open-vee" / "cases" / row["case"] / "result.h5") as file:
        tables = [table[()] for table in file["along"].values()]
    level = float(np.mean([table["level"][(table["x"] > WINDOW[0]) & (table["x"] < WINDOW[1])] for table in tables]))
    (box,) = run.campaign("periodic-vee", {**PERIODIC, **vee(run, "periodic-vee", 40), "layer.height": f"{1e3 * level:.3f} mm"}, {})
    numbers = [[f"{float(one[name]):.4f}" for name in ("efficiency", "efficiency_half_width")] for one in (row, box)]
    run.write_table("vee.csv", VEE, [[*numbers[0], f"{1e3 * level:.3f}", row["outcome"], *numbers[1], box["outcome"]]])


def simulate_deeper(run: ValidationCase) -> None:
    rows = run.campaign("deeper", DEEPER, DEEPER_AT)
    numbers = ["efficiency", "efficiency_half_width", "window_depth_mm"]
    run.write_table("deeper.csv", DEEPER_COLUMNS, [[row["throw_number"], *(f"{float(row[name]):.4f}" for name in numbers), row["outcome"]] for row in rows])


def judge_deeper(run: ValidationCase) -> None:
    """Against the atlas, which knows the depth of a fed layer from its own speed alone."""
    answers = run.of_file("predict", campaign_text(run.sections(), DEEPER, DEEPER_AT))
    for row, answer in zip(run.table("deeper.csv"), answers, strict=True):
        at = f"at throw number {row['throw_number']}"
        both = math.hypot(float(row["half_width"]), answer["half_width"])
        run.check(f"efficiency of the layer that is fed deeper less that of the atlas {at}", float(row["efficiency"]) - answer["efficiency"], 0, both, because="both intervals, in squares")
        depth, half_width = 1e3 * answer["fed_depth_m"], 1e3 * answer["fed_depth_half_width_m"]
        run.check(f"its depth less that of the atlas {at}, mm", float(row["depth_mm"]) - depth, 0, half_width, because="the interval of the atlas")


def simulate(run: ValidationCase) -> None:
    simulate_vee(run)
    simulate_deeper(run)
    rows = []
    for row in run.campaign("open", {}, {"trough.throw_number": THROW_NUMBERS}):
        throw_number = float(row["throw_number"])
        changes = {**PERIODIC, "trough.throw_number": throw_number, "layer.height": f"{float(row['window_depth_mm']):.3f} mm"}
        (box,) = run.campaign(f"periodic-{throw_number}", changes, {})
        numbers = ["efficiency", "efficiency_half_width", "window_depth_mm", "inflow_t_per_h", "outflow_t_per_h", "mass_flow_t_per_h", "residence_time_s", "residence_spread_s", "peclet"]
        rows.append([row["throw_number"], *(f"{float(row[name]):.4f}" for name in numbers), row["outcome"],
                     *(f"{float(box[name]):.4f}" for name in numbers[:2]), box["outcome"]])  # fmt: skip
    run.write_table("result.csv", COLUMNS, rows)


def check_balance(run: ValidationCase) -> None:
    (row,) = run.campaign("losing" if run.control else "short", SHORT, {}, ["--liggghts", str(FOLDER / "losing-liggghts")] if run.control else [])
    run.check("cases in which grains are missing", int(row["outcome"] == "lost-grains"), 0, 0, because="grains are counted")


def judge(run: ValidationCase) -> None:
    check_balance(run)
    for row in run.table("result.csv"):
        at = f"at throw number {row['throw_number']}"
        numbers = {name: float(value) for name, value in row.items() if "outcome" not in name}
        run.check(f"outflow over inflow {at}", numbers["outflow_t_per_h"] / numbers["inflow_t_per_h"], 1, 0.03, because="the hold-up still fluctuates over the cycles that were kept")
        run.check(f"speed times mass per length over outflow {at}", numbers["window_flow_t_per_h"] / numbers["outflow_t_per_h"], 1, 0.03, because="the window and the edge see the same grains at other times")
        run.check(f"efficiency of the open trough less that of the periodic box {at}", numbers["efficiency"] - numbers["periodic_efficiency"], 0, numbers["half_width"] + numbers["periodic_half_width"],
                  because="both intervals hold statistics and numerics")  # fmt: skip
    (row,) = run.table("vee.csv")
    run.check("efficiency of the open V less that of the periodic one", float(row["efficiency"]) - float(row["periodic_efficiency"]), 0, float(row["half_width"]) + float(row["periodic_half_width"]),
              because="both intervals hold statistics and numerics")  # fmt: skip
    judge_deeper(run)


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        simulate(run)
    judge(run)
    run.finish()


if __name__ == "__main__":
    main()
