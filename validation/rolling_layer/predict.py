#!/usr/bin/python3
"""Writes predictions.csv: the efficiency that each law predicts for each held-out case. Run before the simulations; the smeared laws came later (README.md,
section 5)."""

import csv
import pathlib

import numpy as np

import held_out
import laws

FOLDER = pathlib.Path(__file__).resolve().parent
QUARTER = np.pi / 2
LATE = "A0 a quarter late"
STEPS, CYCLES = 1000, 20
SMEARED_CYCLES = 40  # smeared friction settles slowly where flights are long


def held_out_cases() -> tuple[list[tuple[str, float]], laws.Cases]:
    """Group and throw number of each held-out case, and the same for the laws."""
    names = [(group, gamma) for group, (_, numbers) in held_out.HELD_OUT.items() for gamma in numbers]
    columns = list(zip(*(held_out.inputs(group, gamma) for group, gamma in names)))
    numbers = [np.array(column, dtype=float) for column in columns]
    return names, laws.Cases(numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5] > 0, numbers[6])


def predictions(cases: laws.Cases) -> dict[str, laws.Floats]:
    """Efficiencies by the name of the law, the control with late forces included."""
    answers = {law.name: laws.integrate(law, cases, STEPS, CYCLES)[0] for law in laws.LAWS}
    late = next(law for law in laws.LAWS if law.name == "A0")
    later = {law.name: smeared_predictions(law, cases) for law in laws.SMEARED}
    return answers | {LATE: laws.integrate(late, cases, STEPS, CYCLES, shift=QUARTER)[0]} | later


def smeared_predictions(law: laws.Law, cases: laws.Cases) -> laws.Floats:
    """Cases with rolling friction apart from the others, because they take ten times as long."""
    efficiency = np.zeros(len(cases))
    for part in (cases.rolling_friction > 0, cases.rolling_friction == 0):
        chosen = laws.Cases(*(getattr(cases, name)[part] for name in laws.Cases.__dataclass_fields__))
        efficiency[part] = laws.integrate(law, chosen, STEPS, SMEARED_CYCLES)[0]
    return efficiency


def main() -> None:
    names, cases = held_out_cases()
    answers = predictions(cases)
    with (FOLDER / "predictions.csv").open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["group", "throw_number", *answers])
        for i, (group, gamma) in enumerate(names):
            table.writerow([group, gamma, *(f"{values[i]:.4f}" for values in answers.values())])


if __name__ == "__main__":
    main()
