#!/usr/bin/python3
import pathlib
import shutil
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

from validation_case import ValidationCase  # noqa: E402

THROW_NUMBERS = [1.5, 2.0, 2.5]
# A few seconds: whether every grain is held or has left.
SHORT = {"layer.length": "80 mm", "feed.length": "20 mm", "feed.mass_flow": "0.08 t/h", "measure.packings": 1, "measure.max_packings": 1, "measure.half_width": 1.0,
         "measure.min_cycles": None, "measure.max_cycles": 20}  # fmt: skip
PERIODIC = {"layer.length": "40 mm", "feed.mass_flow": None, "feed.length": None, "measure.min_cycles": None}
COLUMNS = ["throw_number", "efficiency", "half_width", "depth_mm", "inflow_t_per_h", "outflow_t_per_h", "window_flow_t_per_h", "residence_s", "spread_s", "peclet", "outcome",
           "periodic_efficiency", "periodic_half_width", "periodic_outcome"]  # fmt: skip


def simulate(run: ValidationCase) -> None:
    rows = []
    for row in run.campaign("open", {}, {"trough.throw_number": THROW_NUMBERS}):
        throw_number = float(row["throw_number"])
        changes = {**PERIODIC, "trough.throw_number": throw_number, "layer.height": f"{float(row['window_depth_mm']):.3f} mm"}
        (box,) = run.campaign(f"periodic-{throw_number}", changes, {})
        numbers = ["efficiency", "efficiency_whole_half_width", "window_depth_mm", "inflow_t_per_h", "outflow_t_per_h", "mass_flow_t_per_h", "residence_time_s", "residence_spread_s", "peclet"]
        rows.append([row["throw_number"], *(f"{float(row[name]):.4f}" for name in numbers), row["outcome"],
                     *(f"{float(box[name]):.4f}" for name in numbers[:2]), box["outcome"]])  # fmt: skip
    run.write_table("result.csv", COLUMNS, rows)


def check_balance(run: ValidationCase) -> None:
    run.runs.mkdir(parents=True, exist_ok=True)
    shutil.copy(FOLDER / "losing.liggghts", run.runs)
    losing = {"engine.extra": "losing.liggghts"} if run.control else {}
    (row,) = run.campaign("losing" if run.control else "short", {**SHORT, **losing}, {}, ["--allow-extra"] if run.control else [])
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


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        simulate(run)
    judge(run)
    run.finish()


if __name__ == "__main__":
    main()
