"""Contacts at the floor of the four layers of phases.csv over the cycle, from the table that version 0.2 measured, with a key that later
versions do not have (measure.rolling); its figure and findings."""

import numpy as np

from draw import FRICTION, LEAST_TOUCHING, TICKS, Phases
from vibrotrough.figures.style import COLOURS, new_figure, plain_axes
from validation_case import Floats, ValidationCase

TABLE = "contacts.csv"


def draw_contacts(run: ValidationCase, curves: Phases) -> None:
    """Sliding contacts, torques and contacts per grain over the phase, free and blocked."""
    numbers = curves.throw_numbers()
    figure, axes = new_figure(3, 2 * len(numbers), size=(6.5 * len(numbers), 8), sharex=True, sharey="row")
    for place, (grains, gamma) in enumerate((grains, gamma) for gamma in numbers for grains in ("free", "blocked")):
        phase = curves.column(grains, gamma, "phase_deg")
        carried = curves.column(grains, gamma, "floor_grains") >= LEAST_TOUCHING

        def line(panel: int, values: Floats, colour: int, dash: str, label: str) -> None:
            axes[panel][place].plot(phase, np.where(carried, values, np.nan), color=COLOURS[colour], ls=dash, label=label)

        normal = curves.column(grains, gamma, "normal_force")
        with np.errstate(invalid="ignore", divide="ignore"):
            line(0, curves.column(grains, gamma, "sliding_share"), 0, "-", "share of sliding contacts")
            line(0, curves.column(grains, gamma, "friction") / (FRICTION * normal), 1, "--", "sum of friction / (\u03bc N)")
            line(0, abs(curves.column(grains, gamma, "tangential_force")) / (FRICTION * normal), 2, ":", "friction of the layer / (\u03bc N)")
        line(1, curves.column(grains, gamma, "floor_torque"), 0, "-", "of the floor")
        line(1, curves.column(grains, gamma, "grain_torque"), 1, "--", "of the other grains")
        line(2, curves.column(grains, gamma, "contacts_per_floor_grain"), 0, "-", "contacts with other grains")
        line(2, 10 * curves.column(grains, gamma, "first_fraction"), 1, "--", "10 times the solid fraction")
        axes[0][place].set(title=f"\u0393 = {gamma}, rotation {grains}", ylim=(0, 1.05))
        axes[1][place].set(ylim=(-0.8, 0.8))
        axes[2][place].set(xlabel="phase \u03c9t, degrees", xticks=TICKS, ylim=(0, 6))
        for panel in range(3):
            plain_axes(axes[panel][place])
    axes[0][0].set_ylabel("at the floor")
    axes[1][0].set_ylabel("torque on the floor grains / (weight d / 2)")
    axes[2][0].set_ylabel("floor grains")
    for panel in range(3):
        axes[panel][0].legend(frameon=False, fontsize=8)
    figure.tight_layout()
    figure.savefig(run.output / "contacts.png", dpi=110)


def torque_over_spin(curves: Phases, gamma: float, low: float, high: float) -> float:
    """-M / w of the free floor grains in a window, in the units of the laws: M is the torque of the other grains over d / 2, in omega^2 r cos(beta)
    of the layer's mass. A weight is tan(beta) / Gamma of these."""
    torque = curves.mean("free", gamma, "grain_torque", low, high) * 0.5 / gamma
    return -torque / curves.mean("free", gamma, "floor_spin", low, high)


def judge_contacts(run: ValidationCase) -> None:
    curves = Phases(run.reference(TABLE))
    for gamma in curves.throw_numbers():
        share = curves.mean("free", gamma, "sliding_share", 275, 300)
        run.finding(f"After the landing most contacts at the floor roll (275 to 300 degrees, Gamma {gamma}): less than half of them slide", share < 0.5,
                    f"{share:.2f} slide, without rotation {curves.mean('blocked', gamma, 'sliding_share', 275, 300):.2f}")
        pushed = curves.mean("free", gamma, "sliding_share", 335, 375)
        run.finding(f"While the trough pushes forwards nearly all contacts at the floor slide (335 to 15 degrees, Gamma {gamma}): nine of ten", pushed > 0.9,
                    f"{pushed:.2f} slide, without rotation {curves.mean('blocked', gamma, 'sliding_share', 335, 375):.2f}")
        early, late = torque_over_spin(curves, gamma, 286, 294), torque_over_spin(curves, gamma, 340, 350)
        presses = curves.mean("free", gamma, "normal_force", 286, 294) > 1
        run.finding(f"The measured torque of the other grains against the spin grows 5 times or more from 290 to 345 degrees (Gamma {gamma})",
                    late > 5 * early if presses else None, f"M / w {early:.2f} and {late:.2f}")
        # Without rotation every contact slides while the layer slips back: the friction is mu N in each of them.
        run.between(f"control: share of sliding contacts without rotation while the layer slips back (310 to 375 degrees, Gamma {gamma})",
                    curves.mean("blocked", gamma, "sliding_share", 310, 375), 0.9, 1, "single grains stick for a moment")
    draw_contacts(run, curves)
