#!/usr/bin/python3
import math
import pathlib
import shutil
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

from validation_case import ValidationCase  # noqa: E402

THROW_NUMBERS = [0.6, 0.9]
FRICTIONS = [0.05, 0.2]
HALF_ANGLE = math.radians(45)
TOLERANCE = 0.015


def main() -> None:
    run = ValidationCase(FOLDER)
    run.runs.mkdir(parents=True, exist_ok=True)
    shutil.copy(FOLDER / "vee.stl", run.runs)  # the mesh lies in the folder of the campaign file
    rows = run.campaign("own-trough", {}, {"trough.throw_number": THROW_NUMBERS, "trough.friction": FRICTIONS})
    factor = 1 if run.control else 1 / math.sin(HALF_ANGLE)
    points = [(float(row["throw_number"]), math.tan(math.radians(30)), factor * float(row["friction"])) for row in rows]
    theory = run.efficiencies(["throw_number", "tan_vibration_angle", "friction"], points)
    for row, expected in zip(rows, theory):
        run.check(f"efficiency at throw number {row['throw_number']} and friction {row['friction']}", float(row["efficiency"]), float(expected), TOLERANCE,
                  because="the contacts are soft: their springs move the grain by a part of the slip of a cycle")
    run.finish()


if __name__ == "__main__":
    main()
