"""Many points of the theory at once: what `vibrotrough theory batch` answers, for scripts of validation/."""

import csv

import numpy as np


def efficiencies(run, name, columns, points):
    """Velocity efficiency at each of `points` (rows of numbers, inputs named by `columns`); files NAME.csv in the case's runs."""
    run.runs.mkdir(parents=True, exist_ok=True)
    questions, answers = (run.runs / f"{name}{ending}.csv" for ending in ("", "_answers"))
    lines = [",".join(columns)] + [",".join(repr(float(value)) for value in point) for point in points]
    questions.write_text("\n".join(lines) + "\n", encoding="utf-8")
    run.theory("batch", questions, "--output", answers)
    with open(answers, encoding="utf-8") as file:
        return np.array([float(row["velocity_efficiency"]) for row in csv.DictReader(file)])
