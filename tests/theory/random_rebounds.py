#!/usr/bin/env python3
"""How often the motion of a mass that rebounds depends on its start.

random_rebounds.py COUNT prints random inputs for `vibrotrough theory batch`; random_rebounds.py --count ANSWERS.csv counts, in what that wrote with --starts, the motions that depend on their start.
"""

import csv
import math
import random
import sys


def print_inputs(count: int) -> None:
    chance = random.Random(28)
    print("throw_number,vibration_angle_deg,tan_inclination,friction,restitution")
    for _ in range(count):
        friction = chance.uniform(0.05, 0.85)
        throw_number = math.exp(chance.uniform(0, math.log(5)))
        print(throw_number, chance.uniform(10, 60), chance.uniform(-0.9, 0.9) * friction, friction, chance.uniform(0.1, 0.7), sep=",")


def count_motions(path: str) -> None:
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for low, high in [(0.1, 0.7)] + [(k / 10, (k + 1) / 10) for k in range(1, 7)]:
        these = [row for row in rows if low <= float(row["restitution"]) < high]
        several = sum(float(row["motions"]) > 1 for row in these)
        periodic = sum(row["converged"] == "true" for row in these)
        print(f"restitution {low} to {high}: {several / len(these):.1%} of {len(these)} have several motions, {periodic / len(these):.1%} have a period from rest")


if sys.argv[1] == "--count":
    count_motions(sys.argv[2])
else:
    print_inputs(int(sys.argv[1]))
