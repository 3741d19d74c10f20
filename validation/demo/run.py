#!/usr/bin/python3
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

from campaign_program import run_campaign  # noqa: E402
from validation_case import ValidationCase  # noqa: E402


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        table = run_campaign(run.program, run.runs, (FOLDER / "campaign.toml").read_text(encoding="utf-8"), run.jobs)
        run.write_table("result.csv", list(table[0]), [row.values() for row in table])
    for row in run.table("result.csv"):
        gamma = float(row["throw_number"])
        theory = run.json("point", "--throw-number", row["throw_number"], "--vibration-angle", row["vibration_angle_deg"] + " deg",
                          "--friction", 1.0 if run.control else row["friction"])["velocity_efficiency"]
        difference, width = float(row["efficiency"]) - theory, float(row["efficiency_half_width"])
        if gamma <= 2.0:
            run.between(f"layer less theory, Gamma {gamma} (+- {width:.3f})", difference, 0.1 + width, 0.6,
                        "the gap: a tenth beyond the interval")
        elif gamma >= 2.5:
            run.check(f"layer less theory, Gamma {gamma} (+- {width:.3f})", difference, 0, 0.08,
                      "the numerical errors are at most 0.04 together, and the scatter comes on top (validation/whole_interval)")
    run.finish()


if __name__ == "__main__":
    main()
