#!/usr/bin/python3
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

from layers import MODULI_MPA  # noqa: E402
from simulate import grid, judges, variations  # noqa: E402
from validation_case import ValidationCase  # noqa: E402


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        grid(run, MODULI_MPA)
        judges(run)
        variations(run)
    run.finish()


if __name__ == "__main__":
    main()
