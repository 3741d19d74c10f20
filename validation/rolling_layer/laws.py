"""The laws that compete, for many cases at once: a time-stepping (Moreau) integration that shares nothing with `vibrotrough theory`.

Lengths are in r cos(beta) along the trough and in r sin(beta) normal to it, time in 1/omega. u is the layer's velocity along the trough,
w the surface velocity of the spinning floor grains, s = u - cos t - w the slip at the floor. README.md has the equations.
"""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import smeared

Floats = NDArray[np.float64]
TWO_PI = 2 * np.pi
STIFFNESS, DAMPING, INERTIA = 14.0, 2.2, 0.10  # kappa, zeta, I: not fitted here (README.md)


@dataclass(frozen=True)
class Cases:
    """Inputs of the laws, one number per case."""

    throw_number: Floats
    tan_vibration_angle: Floats
    tan_inclination: Floats
    friction: Floats
    rolling_friction: Floats
    blocked: NDArray[np.bool_]
    grain: Floats  # diameter over that of the fitted set; only the path law uses it

    def __len__(self) -> int:
        return len(self.throw_number)


@dataclass(frozen=True)
class Law:
    """A law with its fitted constants. `torque` gives the viscous coefficient and the dry torque from (constants, n tau, compaction tau)."""

    name: str
    start: tuple[float, ...]  # constants from which a fit starts; of A0 and A1/2 those that were published
    names: tuple[str, ...]
    kind: str  # viscous, root, dry, compacted-dry, compacted-viscous, path, landing, none, smeared...
    constants: tuple[Any, ...] = field(default=())

    def fitted(self, constants: tuple[Any, ...]) -> "Law":
        return replace(self, constants=constants)

    def values(self) -> tuple[Any, ...]:
        return self.constants or self.start


# The constants of A0 and A1/2 are those of the first fit, made before this folder; the others are those of fit() with 1000 steps per cycle.
LAWS = [
    Law("soft landing", (), (), "none"),
    Law("A0", (0.61, 0.02), ("c", "mu_i"), "viscous", (0.61, 0.02)),
    Law("A1/2", (0.52,), ("c",), "root", (0.52,)),
    Law("Coulomb torque", (0.1,), ("mu_i",), "dry", (0.0173,)),
    Law("compacted, dry", (0.2,), ("mu_i",), "compacted-dry", (0.211,)),
    Law("compacted, viscous", (2.0, 0.1), ("c_1", "c_0"), "compacted-viscous", (0.507, 0.0553)),
    Law("path", (0.1,), ("d",), "path", (0.0279,)),
    Law("landing friction", (0.05,), ("mu_landing",), "landing", (0.0502,)),
]
# The second round (README.md, section 5): constants of fit() with 1000 steps per cycle and 40 cycles.
SMEARED = [
    Law("smeared", (0.15,), ("a",), "smeared", (0.00589,)),
    Law("smeared, decaying", (0.3, 0.3), ("a", "T"), "smeared-decaying", (1.01, 0.265)),
    Law("smeared, geared", (0.15,), ("a",), "smeared-geared", (0.0513,)),
    Law("smeared, geared, free torque", (0.15, 1.7), ("a", "c"), "smeared-geared-torque", (0.124, 0.755)),
    Law("smeared, geared, sinking", (0.1, 0.1), ("a", "b"), "smeared-geared-sinking", (0.0829, 5.10)),
]


@dataclass(frozen=True)
class Normal:
    """The normal motion at the ends of all steps of one period, arrays of (steps, cases)."""

    force: Floats       # n, in m omega^2 r sin(beta)
    compaction: Floats  # its elastic part, kappa^2 |y|
    sinking: NDArray[np.bool_]  # in contact, and the centre of mass still falls towards the trough
    speed: Floats       # |y'| in contact
    since: Floats       # time in contact since the landing


def normal_motion(throw_number: Floats, steps: int, cycles: int = 6) -> Normal:
    """The periodic normal motion: a spring with a damper in contact, nothing in flight. Implicit steps."""
    h = TWO_PI / steps
    y, rate = np.zeros_like(throw_number), np.zeros_like(throw_number)
    force = np.zeros((steps, len(throw_number)))
    compaction, sinking = np.zeros_like(force), np.zeros(force.shape, dtype=bool)
    speed, since, touched = np.zeros_like(force), np.zeros_like(force), np.zeros_like(y)
    spring, damper = STIFFNESS**2, 2 * DAMPING * STIFFNESS
    for cycle in range(cycles):
        for i in range(steps):
            free = rate + h * (np.sin((i + 0.5) * h) - 1 / throw_number)
            held = (free - h * spring * y) / (1 + h * (spring * h + damper))
            n = -spring * (y + h * held) - damper * held
            touching = (y + h * free < 0) & (n > 0)
            rate = np.where(touching, held, free)
            y = y + h * rate
            touched = np.where(touching, touched + h, 0)
            if cycle == cycles - 1:
                force[i] = np.where(touching, n, 0)
                compaction[i] = np.where(touching, spring * np.maximum(-y, 0), 0)
                sinking[i] = touching & (rate < 0)
                speed[i] = np.where(touching, np.abs(rate), 0)
                since[i] = touched
    return Normal(force, compaction, sinking, speed, since)


def soft_threshold(value: Floats, limit: Floats) -> Floats:
    return np.sign(value) * np.maximum(np.abs(value) - limit, 0)


def torques(law: Law, cases: Cases, force: Floats, compaction: Floats) -> tuple[Floats, Floats]:
    """Viscous coefficient and dry torque on the floor grains at one time; force and compaction are n tau and kappa^2 |y| tau."""
    zero, p = np.zeros(len(cases)), law.values()
    viscous, dry = zero, zero
    if law.kind == "viscous":
        viscous, dry = zero + p[0], p[1] * force
    elif law.kind == "root":
        viscous = p[0] * np.sqrt(force)
    elif law.kind == "dry":
        dry = p[0] * force
    elif law.kind == "compacted-dry":
        dry = p[0] * compaction
    elif law.kind == "compacted-viscous":
        viscous = p[1] + p[0] * compaction
    elif law.kind.startswith("smeared-geared"):
        viscous = zero + smeared.torque(law.kind, p)
    return viscous, dry + cases.rolling_friction * force


@dataclass
class History:
    """One period of the motion along the trough, arrays of (steps, cases)."""

    velocity: Floats  # u - cos t
    spin: Floats      # w
    friction: Floats  # F


def integrate(law: Law, cases: Cases, steps: int = 600, cycles: int = 30, keep: bool = False, shift: float = 0) -> tuple[Floats, History | None]:
    """The velocity efficiency after `cycles` cycles, the mean of the last two; and with `keep` the last period.

    `shift`: by how many radians all contact forces are late against the trough (the control with shuffled phases).
    """
    h, tau = TWO_PI / steps, cases.tan_vibration_angle
    normal = normal_motion(cases.throw_number, steps)
    g = cases.tan_inclination * tau / cases.throw_number
    blocked = cases.blocked | (law.kind in ("none", "path", "landing", "smeared", "smeared-decaying"))
    gear = 2 if law.kind.startswith("smeared-geared") else 1
    u, w, path = np.zeros(len(cases)) + 0.3, np.zeros(len(cases)), np.zeros(len(cases))
    late, dry_torque = round(shift / h), bool(np.any(cases.rolling_friction[~blocked] > 0))
    total = np.zeros(len(cases))
    kept = History(*(np.zeros((steps, len(cases))) for _ in range(3)))
    for cycle in range(cycles):
        for i in range(steps):
            n, z = normal.force[i - late] * tau, normal.compaction[i - late] * tau
            limit = cases.friction * n
            if law.kind == "landing":
                limit = np.where(normal.sinking[i - late], law.values()[0], cases.friction) * n
            viscous, dry = torques(law, cases, n, z)
            dry = np.where(blocked, np.inf, dry)
            trough = np.cos((i + 1) * h)
            a, b, m = u - h * g - trough, INERTIA * w, INERTIA + h * viscous
            if law.kind == "path":
                limit = limit * np.minimum(path / (law.values()[0] * cases.grain), 1)
                path = np.where(n > 0, path + h * np.abs(a), 0)
            if law.kind.startswith("smeared"):
                sigma = scatter_of(law, cases, normal.since[i - late], normal.speed[i - late])
                if dry_torque:
                    f = smeared.friction_with_dry_torque(lambda x: a + h * x - gear * spin_after(b - h * x, h * dry, m, blocked), limit, sigma)
                else:
                    turns = np.where(blocked, 0, gear / m)
                    f = smeared.friction(a - turns * b, h * (1 + turns), limit, sigma)
            else:
                f = np.clip(sticking_friction(a, b, m, h * dry, h), -limit, limit)
            u = u + h * (f - g)
            w = spin_after(b - h * f, h * dry, m, blocked)
            if law.kind != "viscous":
                w = np.where(n > 0, w, 0)  # the spin is gone before the landing
            if cycle >= cycles - 2:
                total += u - trough
            if keep and cycle == cycles - 1:
                kept.velocity[i], kept.spin[i], kept.friction[i] = u - trough, w, f
    return total / (2 * steps), kept if keep else None


def spin_after(momentum: Floats, dry: Floats, m: Floats, blocked: NDArray[np.bool_]) -> Floats:
    """The spin at the end of a step; the dry torque takes its impulse `dry` from the angular momentum at most."""
    return np.where(blocked, 0, soft_threshold(momentum, np.where(blocked, 0, dry)) / m)


def scatter_of(law: Law, cases: Cases, since: Floats, speed: Floats) -> Floats:
    """sigma of a smeared law; rolling friction hinders it, and grains without rotation have none."""
    free = np.where(cases.blocked, 0, np.maximum(1 - cases.rolling_friction / cases.friction, 0))
    return free * smeared.scatter(law.kind, law.values(), since, speed * cases.tan_vibration_angle)


def sticking_friction(a: Floats, b: Floats, m: Floats, dry: Floats, h: float) -> Floats:
    """The friction F that ends the slip within the step: a + h F = soft(b - h F, dry) / m."""
    locked = -a
    rest = b - locked
    side = np.where(np.isinf(dry), 0, np.sign(rest)) * np.where(np.isinf(dry), 0, dry)
    turning = ((b - side) / m - a) / (1 + 1 / m)
    return np.where(np.abs(rest) <= dry, locked, turning) / h


def repeated(cases: Cases, times: int) -> Cases:
    """The cases, `times` times one after another."""
    return Cases(*(np.tile(getattr(cases, name), times) for name in Cases.__dataclass_fields__))


def fit(law: Law, cases: Cases, efficiency: Floats, steps: int = 300, cycles: int = 14, rounds: int = 3) -> tuple[Law, float]:
    """The law with the constants of least squares, and its rms: a search on grids, each finer than the last, all trials integrated at once."""
    low, high = np.log(np.array(law.start) / 20), np.log(np.array(law.start) * 20)
    per_axis = 41 if len(law.start) == 1 else 13
    best, least = law, np.inf
    for _ in range(rounds):
        axes = [np.linspace(a, b, per_axis) for a, b in zip(low, high)]
        trials = np.exp(np.stack([grid.ravel() for grid in np.meshgrid(*axes)]))
        wide = law.fitted(tuple(np.repeat(values, len(cases)) for values in trials))
        eta, _ = integrate(wide, repeated(cases, trials.shape[1]), steps, cycles)
        rms = np.sqrt(np.mean((eta.reshape(-1, len(cases)) - efficiency) ** 2, axis=1))
        found = int(np.argmin(rms))
        if rms[found] < least:
            best, least = law.fitted(tuple(trials[:, found])), float(rms[found])
        centre, reach = np.log(np.array(best.values())), 1.5 * (high - low) / (per_axis - 1)
        low, high = centre - reach, centre + reach
    return best, least
