"""Motions of grains with linear contacts in closed form, without engine or program. SI units.

The equations are those of the MFiX verification manual (National Energy Technology Laboratory), cases DEM-01 to DEM-04:
m y'' = -m g + k d - 2 beta sqrt(k m) y' while the overlap d is positive, beta = -ln e / sqrt(pi^2 + ln^2 e).
"""

import dataclasses
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

GRAVITY = 9.81


def damping_ratio(restitution: float) -> float:
    """Share of critical damping with which a linear spring and dashpot give `restitution` (without gravity)."""
    log = math.log(restitution)
    return -log / math.hypot(math.pi, log)


@dataclasses.dataclass(frozen=True)
class Phase:
    """A flight or a contact of a bouncing grain: from `begin` to `end` (s), height of its lowest point `start` (m) and `speed` (m/s) at `begin`.
    `omega` (1/s) and `beta` belong to the contact; a flight has omega = 0."""

    begin: float
    end: float
    start: float
    speed: float
    omega: float = 0.0
    beta: float = 0.0

    def at(self, time: Floats) -> tuple[Floats, Floats]:
        """Height (m) of the grain's lowest point above the floor, and its speed (m/s)."""
        t = time - self.begin
        if self.omega == 0:
            return self.start + self.speed * t - GRAVITY * t**2 / 2, self.speed - GRAVITY * t
        rest = -GRAVITY / self.omega**2
        phi, decay = self.omega * math.sqrt(1 - self.beta**2), self.beta * self.omega
        a = self.start - rest
        b = (self.speed + decay * a) / phi
        factor, sine, cosine = np.exp(-decay * t), np.sin(phi * t), np.cos(phi * t)
        return rest + factor * (a * cosine + b * sine), factor * ((b * phi - decay * a) * cosine - (a * phi + decay * b) * sine)


def contact(begin: float, speed: float, omega: float, beta: float) -> Phase:
    """The contact that begins with `speed` (negative); it ends when the overlap is zero again, found by bisection."""
    phase = Phase(begin, math.inf, 0.0, speed, omega, beta)
    low, high = 0.4 * math.pi / omega, 2 * math.pi / (omega * math.sqrt(1 - beta**2))
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if phase.at(np.array(begin + middle))[0] < 0 else (low, middle)
    return dataclasses.replace(phase, end=begin + high)


def bounces(drop: float, omega: float, beta: float, until: float) -> list[Phase]:
    """Flights and contacts in turn, from rest at `drop` above the floor, until the time `until`."""
    phases = [Phase(0.0, math.sqrt(2 * drop / GRAVITY), drop, 0.0)]
    while phases[-1].end < until:
        last = phases[-1]
        _, speed = last.at(np.array(last.end))
        if last.omega == 0:
            phases.append(contact(last.end, float(speed), omega, beta))
        else:
            phases.append(Phase(last.end, last.end + 2 * float(speed) / GRAVITY, 0.0, float(speed)))
    return phases


def heights(phases: Sequence[Phase], times: Floats) -> Floats:
    """Height of the grain's lowest point (m) at `times`."""
    ends = np.array([phase.end for phase in phases])
    return np.array([phases[int(np.searchsorted(ends, time))].at(np.array(time))[0] for time in times])


def apexes(phases: Sequence[Phase]) -> Floats:
    """Heights (m) of the highest points of the flights that begin on the floor."""
    return np.array([phase.speed**2 / (2 * GRAVITY) for phase in phases if phase.omega == 0 and phase.begin > 0])


def stacked(radius: float, masses: tuple[float, float], stiffness: float, restitution: float, wall: float, times: Floats) -> Floats:
    """Heights (m) of the centres of two grains between the floor and an upper wall at height `wall`, shape (times, 2); case DEM-03.

    They start at rest at a quarter and three quarters of `wall` and stay in contact with each other and with both walls, so that
    the motion is linear: s' = A (s - s_rest), solved by the eigenvectors of A.
    """
    beta = damping_ratio(restitution)
    between = 2 * beta * math.sqrt(stiffness * masses[0] * masses[1] / sum(masses))
    system, constant = np.zeros((4, 4)), np.zeros(4)
    system[0, 1] = system[2, 3] = 1
    for i, mass in enumerate(masses):
        own, other, row = 2 * i, 2 - 2 * i, 2 * i + 1
        at_wall = 2 * beta * math.sqrt(stiffness * mass)
        system[row, own], system[row, other] = -2 * stiffness / mass, stiffness / mass
        system[row, own + 1], system[row, other + 1] = -(at_wall + between) / mass, between / mass
    constant[1] = -GRAVITY + stiffness * (radius - 2 * radius) / masses[0]
    constant[3] = -GRAVITY + stiffness * (wall - radius + 2 * radius) / masses[1]
    rest = -np.linalg.solve(system, constant)
    start = np.array([0.25 * wall, 0, 0.75 * wall, 0]) - rest
    values, vectors = np.linalg.eig(system)
    weights = np.linalg.solve(vectors, start.astype(complex))
    states = (vectors * weights) @ np.exp(np.outer(values, times))
    return np.real(states[[0, 2]]).T + rest[[0, 2]]
