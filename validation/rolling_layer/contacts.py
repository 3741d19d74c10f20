"""What `measure.rolling` says about the four layers of phases.csv: contacts at the floor over the cycle, their table, figure and findings."""

import warnings

import numpy as np

import vibrotrough
from campaign_program import Row
from draw import FRICTION, LEAST_TOUCHING, TICKS, Phases
from figure_style import COLOURS, new_figure, plain_axes
from validation_case import Floats, ValidationCase

TABLE = "contacts.csv"
MEASURED = {"measure.rolling": True}
GRAVITY = 9.81
DIAMETER = 0.003  # m, mean of base.toml
VELOCITIES = ("floor_velocity", "floor_spin", "first_spin", "second_velocity")
FORCES = ("normal_force", "tangential_force", "friction")
TORQUES = ("floor_torque", "grain_torque")
PLAIN = ("floor_grains", "floor_contacts", "sliding_share", "contacts_per_floor_grain", "first_fraction", "second_fraction")
NAMES = PLAIN + VELOCITIES + FORCES + TORQUES
COLUMNS = ["grains", "throw_number", "phase_deg", *NAMES]


def contact_rows(result: vibrotrough.File, row: Row, grains: str) -> list[list[object]]:
    """Mean curves of one case over its packings: velocities in omega r cos(beta), forces in weights, torques in weights times d / 2. The
    tangential force is the floor's on the layer, as in phases.csv."""
    unit = 2 * np.pi * float(row["frequency_hz"]) * float(row["amplitude_m"]) * np.cos(np.radians(float(row["vibration_angle_deg"])))
    weight = float(np.mean(np.asarray(result["packings/mass"]))) * GRAVITY
    scale = {**dict.fromkeys(PLAIN, 1.0), **dict.fromkeys(VELOCITIES, unit), **dict.fromkeys(FORCES, weight),
             **dict.fromkeys(TORQUES, weight * DIAMETER / 2), "tangential_force": -weight}

    def mean(name: str) -> Floats:
        curves = [np.asarray(result[f"rolling/{packing}/{name}"]) for packing in range(1, int(row["packings"]) + 1)]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # where no packing has a value, the mean has none
            return np.asarray(np.nanmean(np.array(curves), axis=0))

    phase = np.degrees(mean("phase"))
    curves = [mean(name) / scale[name] for name in NAMES]
    return [[grains, round(float(row["throw_number"]), 6), f"{phase[i]:.1f}", *(f"{curve[i]:.4f}" for curve in curves)] for i in range(len(phase))]


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
    curves = Phases(run.table(TABLE))
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
