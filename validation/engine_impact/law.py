"""One impact of a sphere on a flat floor: the documented contact law, integrated without engine or program, and closed forms.

Normal force max(0, 4/3 E* sqrt(R d) d + 2 sqrt(5/6) |b| sqrt(2 E* sqrt(R d) m) d'), b = ln e / sqrt(ln^2 e + pi^2) (Tsuji, Tanaka &
Ishida, Powder Technology 71, 1992); tangential spring 8 G* sqrt(R d) that slips at mu F; lever R - d/2. SI units.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

RADIUS, DENSITY, YOUNG, POISSON, GRAVITY = 0.0015, 1400.0, 5e6, 0.35, 9.81
MASS = DENSITY * 4 / 3 * math.pi * RADIUS**3
INERTIA = 0.4 * MASS * RADIUS**2
E_STAR = YOUNG / (2 * (1 - POISSON**2))
G_STAR = YOUNG / (4 * (2 - POISSON) * (1 + POISSON))


def hertz_duration(speed: float) -> float:
    """Of an elastic impact: Johnson, Contact Mechanics (1985), Eq. 11.24, with the constant from its integral."""
    constant = 0.8 * math.gamma(0.4) * math.sqrt(math.pi) / math.gamma(0.9) * (15 / 16) ** 0.4  # 2.868
    return constant * (MASS**2 / (RADIUS * E_STAR**2 * speed)) ** 0.2


def hertz_overlap(speed: float) -> float:
    """Largest overlap of an elastic impact: m v^2 / 2 = 8/15 E* sqrt(R) d^(5/2)."""
    return (15 * MASS * speed**2 / (16 * E_STAR * math.sqrt(RADIUS))) ** 0.4


def impact(restitution: ArrayLike, friction: ArrayLike, normal: ArrayLike, tangential: ArrayLike, gravity: float = 0.0,
           steps: int = 4000, shortening: float = 0.5) -> list[Floats]:
    """Arrays of nominal restitution, friction and speeds before; gives normal speed, tangential speed and spin after.

    `shortening`: share of the overlap by which the lever of the friction is shorter than the radius; 0.5 in LIGGGHTS, 0 in LAMMPS.
    """
    e, mu, w, v = (np.array(a, dtype=float) for a in np.broadcast_arrays(*map(np.atleast_1d, (restitution, friction, normal, tangential))))
    log = np.log(e)
    damping = 2 * math.sqrt(5 / 6) * np.abs(log) / np.hypot(log, math.pi)
    dt = 1.6 * max(hertz_duration(speed) for speed in set(w.tolist())) / steps
    state = [np.zeros_like(w), w, v, np.zeros_like(w), np.zeros_like(w)]  # overlap, speed inward, along, spin, spring
    done = [np.full_like(w, np.nan) for _ in range(3)]
    for _ in range(100 * steps):
        middle = [a + dt / 2 * b for a, b in zip(state, rates(state, damping, mu, gravity, shortening)[0])]
        change, limit, normal = rates(middle, damping, mu, gravity, shortening)
        state = [a + dt * b for a, b in zip(state, change)]
        state[4] = np.clip(state[4], -limit, limit)  # a contact that slips keeps the spring at Coulomb's limit
        left = np.isnan(done[0]) & (state[1] < 0) & ((state[0] <= 0) | (normal == 0))
        # The force may end before the overlap does: the rest of the way up is a throw.
        upward = np.sqrt(np.maximum(0, state[1] ** 2 - 2 * gravity * np.maximum(0, state[0])))
        for kept, now in zip(done, (upward, state[2], state[3])):
            kept[left] = now[left]
        if not np.isnan(done[0]).any():
            return done
    raise ArithmeticError("a contact does not end")


def rates(state: Sequence[Floats], damping: Floats, mu: Floats, gravity: float, shortening: float) -> tuple[tuple[Floats, ...], Floats, Floats]:
    """Time derivatives of the state, the spring's length at which the contact slips, and the normal force."""
    overlap, inward, along, spin, spring = state
    contact = np.sqrt(RADIUS * np.maximum(overlap, 0))
    normal = np.maximum(0, 4 / 3 * E_STAR * contact * overlap + damping * np.sqrt(2 * E_STAR * contact * MASS) * inward)
    stiffness = 8 * G_STAR * contact
    limit = np.divide(mu * normal, stiffness, out=np.zeros_like(normal), where=stiffness > 0)
    tangential = stiffness * np.clip(spring, -limit, limit)
    lever = RADIUS - shortening * overlap
    return (inward, gravity - normal / MASS, -tangential / MASS, tangential * lever / INERTIA, along - spin * lever), limit, normal


def rigid_tangential(friction: Floats, restitution: Floats, normal: Floats, tangential: Floats) -> Floats:
    """Tangential speed after the impact of a rigid sphere without spin: it slides all the time, or rolls at the end (5/7)."""
    return np.maximum(tangential - friction * (1 + restitution) * normal, 5 / 7 * tangential)
