"""One impact of a sphere on a flat floor: the documented contact law, integrated without engine or program, and closed forms.

Normal force max(0, 4/3 E* sqrt(R d) d + 2 sqrt(5/6) |b| sqrt(2 E* sqrt(R d) m) d'), b = ln e / sqrt(ln^2 e + pi^2) (Tsuji, Tanaka &
Ishida, Powder Technology 71, 1992); tangential spring 8 G* sqrt(R d) that slips at mu F; lever R - d/2. SI units.
"""

import dataclasses
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

RADIUS, DENSITY, YOUNG, POISSON, GRAVITY = 0.0015, 1400.0, 5e6, 0.35, 9.81


@dataclasses.dataclass(frozen=True)
class Grain:
    """A sphere and its contact with the floor: radius (m), mass (kg), effective moduli E* and G* (Pa)."""

    radius: float
    mass: float
    e_star: float
    g_star: float


def moduli(grain: tuple[float, float], floor: tuple[float, float]) -> tuple[float, float]:
    """E* and G* (Pa) of two materials, each given by its Young's modulus (Pa) and Poisson's ratio; Johnson, sections 4.2 and 7.3."""
    e_star = 1 / sum((1 - poisson**2) / young for young, poisson in (grain, floor))
    g_star = 1 / sum(2 * (2 - poisson) * (1 + poisson) / young for young, poisson in (grain, floor))
    return e_star, g_star


def sphere_mass(radius: float, density: float) -> float:
    return density * 4 / 3 * math.pi * radius**3


GRAIN = Grain(RADIUS, sphere_mass(RADIUS, DENSITY), *moduli((YOUNG, POISSON), (YOUNG, POISSON)))


def hertz_duration(speed: float, grain: Grain = GRAIN) -> float:
    """Of an elastic impact: Johnson, Contact Mechanics (1985), Eq. 11.24, with the constant from its integral."""
    constant = 0.8 * math.gamma(0.4) * math.sqrt(math.pi) / math.gamma(0.9) * (15 / 16) ** 0.4  # 2.868
    return constant * (grain.mass**2 / (grain.radius * grain.e_star**2 * speed)) ** 0.2


def hertz_overlap(speed: float) -> float:
    """Largest overlap of an elastic impact: m v^2 / 2 = 8/15 E* sqrt(R) d^(5/2)."""
    return (15 * GRAIN.mass * speed**2 / (16 * GRAIN.e_star * math.sqrt(RADIUS))) ** 0.4


def impact(restitution: ArrayLike, friction: ArrayLike, normal: ArrayLike, tangential: ArrayLike, gravity: float = 0.0,
           steps: int = 4000, shortening: float = 0.5, grain: Grain = GRAIN) -> list[Floats]:
    """Arrays of nominal restitution, friction and speeds before; gives normal speed, tangential speed and spin after.

    `shortening`: share of the overlap by which the lever of the friction is shorter than the radius; 0.5 in LIGGGHTS, 0 in LAMMPS.
    """
    e, mu, w, v = (np.array(a, dtype=float) for a in np.broadcast_arrays(*map(np.atleast_1d, (restitution, friction, normal, tangential))))
    log = np.log(e)
    damping = 2 * math.sqrt(5 / 6) * np.abs(log) / np.hypot(log, math.pi)
    dt = 1.6 * max(hertz_duration(speed, grain) for speed in set(w.tolist())) / steps
    state = [np.zeros_like(w), w, v, np.zeros_like(w), np.zeros_like(w)]  # overlap, speed inward, along, spin, spring
    done = [np.full_like(w, np.nan) for _ in range(3)]
    for _ in range(100 * steps):
        middle = [a + dt / 2 * b for a, b in zip(state, rates(state, damping, mu, gravity, shortening, grain)[0])]
        change, limit, normal = rates(middle, damping, mu, gravity, shortening, grain)
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


def rates(state: Sequence[Floats], damping: Floats, mu: Floats, gravity: float, shortening: float,
          grain: Grain) -> tuple[tuple[Floats, ...], Floats, Floats]:
    """Time derivatives of the state, the spring's length at which the contact slips, and the normal force."""
    overlap, inward, along, spin, spring = state
    contact = np.sqrt(grain.radius * np.maximum(overlap, 0))
    normal = np.maximum(0, 4 / 3 * grain.e_star * contact * overlap + damping * np.sqrt(2 * grain.e_star * contact * grain.mass) * inward)
    stiffness = 8 * grain.g_star * contact
    limit = np.divide(mu * normal, stiffness, out=np.zeros_like(normal), where=stiffness > 0)
    tangential = stiffness * np.clip(spring, -limit, limit)
    inertia = 0.4 * grain.mass * grain.radius**2
    lever = grain.radius - shortening * overlap
    return (inward, gravity - normal / grain.mass, -tangential / grain.mass, tangential * lever / inertia, along - spin * lever), limit, normal


def rigid_tangential(friction: Floats, restitution: Floats, normal: Floats, tangential: Floats) -> Floats:
    """Tangential speed after the impact of a rigid sphere without spin: it slides all the time, or rolls at the end (5/7)."""
    return np.maximum(tangential - friction * (1 + restitution) * normal, 5 / 7 * tangential)
