#!/usr/bin/python3
import math
import pathlib
import shutil
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

from campaign_program import campaign_text, run_campaign  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

THROW_NUMBERS = [0.6, 0.9]
FRICTIONS = [0.05, 0.2]
HALF_ANGLE = math.radians(45)
TOLERANCE = 0.015
LINER = 0.2  # friction of one wall, where the other one has the least of FRICTIONS
PAIR = f'[[pairs]]\nmaterials = ["grains", "liner"]\nfriction = {LINER}\n'


def main() -> None:
    run = ValidationCase(FOLDER)
    run.runs.mkdir(parents=True, exist_ok=True)
    shutil.copy(FOLDER / "vee.stl", run.runs)  # the mesh lies in the folder of the campaign file
    rows = run.campaign("own-trough", {}, {"trough.throw_number": THROW_NUMBERS, "trough.friction": FRICTIONS})
    lined = run_campaign(run.program, run.runs / "lined", campaign_text(run.sections(), {"campaign.name": "lined", "trough.friction": FRICTIONS[0]},
                                                                        {"trough.throw_number": THROW_NUMBERS}) + PAIR, run.jobs)
    factor = 1 if run.control else 1 / math.sin(HALF_ANGLE)
    cases = [(row, float(row["friction"]), f"friction {row['friction']}") for row in rows]
    cases += [(row, FRICTIONS[0] if run.control else (FRICTIONS[0] + LINER) / 2, f"frictions {row['friction']} and {LINER}") for row in lined]
    points = [(float(row["throw_number"]), math.tan(math.radians(30)), factor * friction) for row, friction, _ in cases]
    theory = run.efficiencies(["throw_number", "tan_vibration_angle", "friction"], points)
    for (row, _, name), expected in zip(cases, theory):
        run.check(f"efficiency at throw number {row['throw_number']} and {name}", float(row["efficiency"]), float(expected), TOLERANCE,
                  because="the contacts are soft: their springs move the grain by a part of the slip of a cycle")
    run.finish()


if __name__ == "__main__":
    main()
