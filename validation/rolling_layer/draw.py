"""The figures of this case, and the mean curves over the cycle that they show."""

import numpy as np
from numpy.typing import NDArray

import vibrotrough
from campaign_program import Row
from vibrotrough.figures.style import COLOURS, MARKERS, new_figure, plain_axes
from validation_case import Floats, ValidationCase

PHASE_COLUMNS = ["grains", "throw_number", "phase_deg", "touching", "layer_velocity", "floor_velocity", "spin", "normal_force", "tangential_force"]
FRICTION = 0.23
LEAST_TOUCHING = 4  # grains on the floor for a mean over them
GRAINS = 174  # of the layer in base.toml
LEVEL = ["--tan-vibration-angle", 0.5, "--friction", FRICTION]
TICKS = [0, 90, 180, 270, 360]


def phase_rows(result: vibrotrough.File, row: Row, grains: str) -> list[list[object]]:
    """Mean curves of one case over its packings: velocities in omega r cos(beta), forces over the mean normal force (the weight)."""
    omega = 2 * np.pi * float(row["frequency_hz"])
    unit = omega * float(row["amplitude_m"]) * np.cos(np.radians(float(row["vibration_angle_deg"])))

    def mean(name: str) -> Floats:
        curves = [np.asarray(result[f"phases/{packing}/{name}"])[:100] for packing in range(1, int(row["packings"]) + 1)]
        with np.errstate(invalid="ignore"):
            return np.asarray(np.nanmean(np.array(curves), axis=0))

    phase = np.degrees(mean("phase"))
    layer = (mean("velocity_x") - mean("trough_velocity_x")) / unit
    floor, slip = mean("sliding") / unit, mean("slip") / unit
    normal, tangential = mean("normal_force"), -mean("tangential_force")  # on the layer
    weight = normal.mean()
    return [[grains, round(float(row["throw_number"]), 6), f"{phase[i]:.1f}", f"{mean_touching:.1f}", f"{layer[i]:.4f}", f"{floor[i]:.4f}",
             f"{floor[i] - slip[i]:.4f}", f"{normal[i] / weight:.4f}", f"{tangential[i] / weight:.4f}"]
            for i, mean_touching in enumerate(mean("touching"))]


class Phases:
    """phases.csv by grains and throw number; angles beyond 360 degrees continue at 0."""

    def __init__(self, rows: list[Row]) -> None:
        self.rows = rows

    def throw_numbers(self) -> list[float]:
        return sorted({float(row["throw_number"]) for row in self.rows})

    def column(self, grains: str, gamma: float, name: str) -> Floats:
        return np.array([float(row[name]) for row in self.rows if row["grains"] == grains and float(row["throw_number"]) == gamma])

    def window(self, grains: str, gamma: float, low: float, high: float) -> NDArray[np.bool_]:
        phase = self.column(grains, gamma, "phase_deg")
        return np.asarray(((phase >= low) & (phase <= high)) | (phase + 360 <= high))

    def mean(self, grains: str, gamma: float, name: str, low: float, high: float) -> float:
        return float(np.nanmean(self.column(grains, gamma, name)[self.window(grains, gamma, low, high)]))

    def ratio(self, grains: str, gamma: float, low: float, high: float) -> float:
        """Tangential over normal impulse of the trough on the layer within a window."""
        part = self.window(grains, gamma, low, high)
        return float(self.column(grains, gamma, "tangential_force")[part].sum() / self.column(grains, gamma, "normal_force")[part].sum())

    def torque(self, gamma: float, low: float, high: float) -> tuple[float, float]:
        """What hinders the spin of the free floor grains, M = -F - I w', over the spin and over N; means of a window."""
        spin, touching = self.column("free", gamma, "spin"), self.column("free", gamma, "touching")
        unit = 0.5 / gamma  # of forces: a weight is tan(beta) / Gamma in omega^2 r cos(beta) per mass
        spin_up = np.gradient(spin, 2 * np.pi / len(spin))
        torque = -self.column("free", gamma, "tangential_force") * unit - 0.4 * touching / GRAINS * spin_up
        part = self.window("free", gamma, low, high)
        return (float(torque[part].mean() / spin[part].mean()),
                float(torque[part].mean() / (unit * self.column("free", gamma, "normal_force")[part].mean())))

    def a0(self, run: ValidationCase, gamma: float, low: float, high: float) -> float:
        """The mean spin of A0 within a window."""
        phase, spin = a0_curve(run, gamma, "spin")
        return float(spin[((phase >= low) & (phase <= high)) | (phase + 360 <= high)].mean())


def a0_curve(run: ValidationCase, gamma: float, name: str) -> tuple[Floats, Floats]:
    """A column of A0's trace over the phase in degrees, in order of the phase."""
    rows = run.csv("trace", "--throw-number", gamma, *LEVEL, "--samples", 361, "--rolling-layer")
    phase = np.array([np.degrees(float(row["t"])) % 360 for row in rows])
    order = np.argsort(phase)
    return phase[order], np.array([float(row[name]) for row in rows])[order]


def phases(run: ValidationCase, curves: Phases) -> None:
    """Spin, velocity of the floor grains and of the layer, and forces over the phase, free and blocked."""
    numbers = curves.throw_numbers()
    figure, axes = new_figure(2, 2 * len(numbers), size=(6.5 * len(numbers), 6), sharex=True, sharey="row")
    for place, (grains, gamma) in enumerate((grains, gamma) for gamma in numbers for grains in ("free", "blocked")):
        upper, lower = axes[0][place], axes[1][place]
        phase = curves.column(grains, gamma, "phase_deg")
        for name, label, colour, dash in (("layer_velocity", "layer", COLOURS[6], "-"), ("floor_velocity", "floor grains", COLOURS[0], "--"),
                                          ("spin", "spin w", COLOURS[1], "-.")):
            carried = (curves.column(grains, gamma, "touching") >= LEAST_TOUCHING) | (name == "layer_velocity")
            upper.plot(phase, np.where(carried, curves.column(grains, gamma, name), np.nan), color=colour, ls=dash, label=label)
        normal, tangential = curves.column(grains, gamma, "normal_force"), curves.column(grains, gamma, "tangential_force")
        pressed = normal > 0.05
        lower.plot(phase[pressed], tangential[pressed] / normal[pressed], ".", ms=4, color=COLOURS[0], label="F / N, simulated")
        lower.plot(phase, normal / 40, color=COLOURS[5], lw=1, label="N / (40 weights)")
        if grains == "free":
            angles, spin = a0_curve(run, gamma, "spin")
            upper.plot(angles, spin, color=COLOURS[1], lw=0.8, label="spin w, A0")
            forces = a0_curve(run, gamma, "tangential_force")[1], a0_curve(run, gamma, "normal_force")[1]
            with np.errstate(invalid="ignore", divide="ignore"):
                ratio = np.where(forces[1] > 0, forces[0] / (0.5 * forces[1]), np.nan)
            lower.plot(angles, ratio, color=COLOURS[1], lw=0.8, label="F / N, A0")
        for limit in (-FRICTION, FRICTION):
            lower.axhline(limit, color="#999999", lw=0.6)
        upper.set(title=f"Γ = {gamma}, rotation {grains}", ylim=(-0.9, 2))
        lower.set(xlabel="phase ωt, degrees", xticks=TICKS, ylim=(-0.35, 0.45))
        for part in (upper, lower):
            plain_axes(part)
    axes[0][0].set_ylabel("velocity relative to the trough / (ω r cos β)")
    axes[1][0].set_ylabel("friction over normal force")
    axes[0][0].legend(frameon=False, fontsize=8)
    axes[1][0].legend(frameon=False, fontsize=8, loc="upper left")
    figure.tight_layout()
    figure.savefig(run.output / "phases.png", dpi=110)


def laws(run: ValidationCase, rows: list[Row], errors: dict[str, Floats]) -> None:
    """Predicted over measured efficiency of the held-out cases, for four laws."""
    measured = np.array([float(row["efficiency"]) for row in rows])
    width = np.array([float(row["half_width"]) for row in rows])
    figure, axes = new_figure(1, 4, size=(13, 3.9), sharey=True, sharex=True)
    for place, law in enumerate(("point mass", "A0", "compacted, dry", "path")):
        one = axes[place]
        one.errorbar(measured, measured + errors[law], xerr=width, ls="", marker=MARKERS[place], ms=5, color=COLOURS[place], lw=0.8)
        one.plot([0, 1.15], [0, 1.15], color="#999999", lw=0.8)
        one.set(title=f"{law}: rms {np.sqrt(np.mean(errors[law] ** 2)):.3f}", xlabel="η of the layer (held out)")
        plain_axes(one)
    axes[0].set_ylabel("η predicted")
    figure.tight_layout()
    figure.savefig(run.output / "laws.png", dpi=110)
