#!/usr/bin/python3
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import ladder  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

COLUMNS = ["rung", "throw_number", "vibration_angle_deg", "friction", "efficiency", "half_width", "efficiency_theory", "mode_theory",
           "mode_layer", "landing_friction", "peak_normal_force", "efficiency_by_normal_force", "packings", "outcome"]


def measure(run):
    rows = []
    for name, (changes, numbers) in ladder.rungs().items():
        campaign = ladder.campaign_name(name)
        for row in run.campaign(campaign, changes, {"trough.throw_number": numbers[:1] if run.quick else numbers}):
            rows.append([name] + one(run, campaign, row))
    run.write_table("result.csv", COLUMNS, rows)


def one(run, campaign, row):
    friction, peak, by_normal_force = ladder.explained(run.runs / campaign, row["case"])
    first = [row[key] for key in ("throw_number", "vibration_angle_deg", "friction", "efficiency_dem", "efficiency_dem_half_width",
                                  "efficiency_theory", "mode_theory", "mode_layer")]
    return first + [f"{friction:.4f}", f"{peak:.2f}", f"{by_normal_force:.4f}", row["packings"], row["outcome"]]


def main():
    run = ValidationCase(FOLDER)
    if run.long:
        measure(run)
    run.finish()


if __name__ == "__main__":
    main()
