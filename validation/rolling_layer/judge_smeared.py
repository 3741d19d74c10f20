"""Judges the smeared laws of README.md, section 5, by what that section named before they were fitted."""

import numpy as np

import held_out
import laws
import smeared
from campaign_program import Row
from contacts import TABLE
from draw import FRICTION, Phases
from validation_case import Floats, ValidationCase

# Held-out cases whose efficiencies were known when the laws were written; the others are the blind ones.
KNOWN = ("throw number", "downhill", "uphill", "trough friction 0.6", held_out.BLOCKED)
NAMED = "smeared, geared"  # the law named in advance
LANDING = {1.7: (275.0, 300.0), 2.0: (300.0, 320.0)}  # degrees; the layer lands later at 2.0
PUSHED = (335.0, 375.0)
STEPS, CYCLES = 300, 20


def implied_scatter(curves: Phases, gamma: float, low: float, high: float) -> float:
    """sigma for which the smeared friction of the measured mean slip is nearest to the measured friction, by least squares."""
    part = curves.window("free", gamma, low, high) & (curves.column("free", gamma, "floor_grains") >= 4)
    slip = (curves.column("free", gamma, "floor_velocity") - curves.column("free", gamma, "floor_spin"))[part]
    normal = curves.column("free", gamma, "normal_force")[part]
    force = curves.column("free", gamma, "tangential_force")[part]
    trials = np.geomspace(0.01, 1, 400)
    misses = [np.sum((force + FRICTION * normal * smeared.share(slip / one)) ** 2) for one in trials]
    return float(trials[int(np.argmin(misses))])


def judge_contacts(run: ValidationCase, curves: Phases) -> None:
    """What the laws take from the measured contacts: the scatter, and that the floor grains are idlers."""
    for gamma, (low, high) in LANDING.items():
        early, late = implied_scatter(curves, gamma, low, high), implied_scatter(curves, gamma, *PUSHED)
        run.finding(f"The slips of the floor contacts scatter more after the landing than while the trough pushes (Gamma {gamma}): twice as much", early > 2 * late,
                    f"sigma {early:.3f} and {late:.3f} of omega r cos(beta)")
        for name, window in (("after the landing", (low, high)), ("while the trough pushes", PUSHED)):
            part = curves.window("free", gamma, *window)
            above = curves.column("free", gamma, "second_velocity")[part]
            miss = above - (curves.column("free", gamma, "floor_velocity") + curves.column("free", gamma, "floor_spin"))[part]
            ratio = float(np.sqrt(np.mean(miss**2) / np.mean(above**2)))
            run.finding(f"The floor grains are idlers {name} (Gamma {gamma}): the grains above move with their velocity plus their spin, to a tenth", ratio < 0.1,
                        f"rms of the difference {ratio:.2f} of the velocity of the grains above")


def judge_spin(run: ValidationCase, curves: Phases) -> None:
    """Spin and friction of each law while the trough pushes, beside the measured ones."""
    numbers = np.array(sorted(LANDING))
    one = np.ones(len(numbers))
    cases = laws.Cases(numbers, 0.5 * one, 0 * one, FRICTION * one, 0 * one, one < 0, one)
    normal = laws.normal_motion(numbers, STEPS)
    phase = np.degrees((np.arange(STEPS) + 1) * laws.TWO_PI / STEPS)
    part = (phase >= PUSHED[0]) | (phase <= PUSHED[1] - 360)
    for law in laws.SMEARED:
        _, history = laws.integrate(law, cases, STEPS, CYCLES, keep=True)
        assert history is not None
        for i, gamma in enumerate(numbers):
            spin = float(history.spin[part, i].mean())
            ratio = float(history.friction[part, i].sum() / (0.5 * normal.force[part, i].sum()))
            measured = curves.mean("free", gamma, "floor_spin", *PUSHED)
            if "geared" in law.name:
                run.finding(f"{law.name}: spin while the trough pushes between -0.03 and -0.08 (Gamma {gamma})", -0.08 <= spin <= -0.03,
                            f"{spin:+.3f}, measured {measured:+.3f}")
            run.finding(f"{law.name}: F / N above 0.19 while the trough pushes (Gamma {gamma})", ratio > 0.19,
                        f"{ratio:.3f}, measured {curves.ratio('free', gamma, *PUSHED):.3f}")


def judge_unseen(run: ValidationCase, rows: list[Row], errors: dict[str, Floats]) -> None:
    """The laws on the held-out layers that nobody had seen when they were written."""
    unseen = np.array([row["group"] not in KNOWN for row in rows])
    if not unseen.any():
        return
    score = {law: float(np.sqrt(np.mean(error[unseen] ** 2))) for law, error in errors.items()}
    for law in laws.SMEARED:
        run.finding(f"{law.name}: better than A0 on the held-out layers that were unseen when it was written", score[law.name] < score["A0"],
                    f"rms {score[law.name]:.3f}, A0 {score['A0']:.3f}, point mass {score['point mass']:.3f}; {int(unseen.sum())} layers")


def judge(run: ValidationCase, rows: list[Row], errors: dict[str, Floats]) -> None:
    """rows, errors: the held-out free layers, and prediction less measurement of each law."""
    curves = Phases(run.table(TABLE))
    judge_contacts(run, curves)
    judge_spin(run, curves)
    judge_unseen(run, rows, errors)
