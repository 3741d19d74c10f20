"""The contact laws of a block, integrated without the engine: a point mass on a trough, by the velocity Verlet rule.

Units: the mass, the amplitude r in the direction of vibration and omega are 1, so that a cycle is 2 pi.
"""

import dataclasses
from collections.abc import Iterable, Sequence

import numpy
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[numpy.float64]

CYCLE = 2 * numpy.pi


@dataclasses.dataclass(frozen=True)
class Point:
    throw_number: float
    tan_vibration_angle: float
    tan_inclination: float
    friction: float


@dataclasses.dataclass(frozen=True)
class Law:
    """Normal force k d + c v, with k in m / t_c^2 and c in m / t_c, t_c the contact's duration. Along the trough a spring of
    `tangential_stiffness` (same unit as k), cut to mu |F|; or none (None): the damping c v, cut to mu |F|."""

    name: str
    stiffness: float
    damping: float
    pulls: bool = False
    tangential_stiffness: float | None = None

    @property
    def damping_ratio(self) -> float:
        return self.damping / (2 * self.stiffness**0.5)

    @property
    def restitution(self) -> float:
        """Of a law that does not pull, without gravity: m x'' = -k x - c x' ends when its force does, at x'' = 0. With the rates
        a < b of its two exponentials, e = (a / b)^((b + a) / (b - a)); 1/100 at five times the critical damping."""
        root = (self.damping_ratio**2 - 1) ** 0.5
        slow, fast = self.damping_ratio - root, self.damping_ratio + root
        return (slow / fast) ** ((fast + slow) / (fast - slow)) if root else float(numpy.exp(-2))


def column(values: Iterable[float]) -> Floats:
    return numpy.array(list(values), dtype=float)


def efficiency(pairs: Sequence[tuple[Point, Law]], contacts_per_cycle: int, steps: int, cycles: int,
               start: ArrayLike = 0) -> Floats:
    """Velocity efficiency of each cycle, shape (cycles, pairs).

    @param pairs  (Point, Law) each
    @param steps  per cycle
    @param start  speed along the trough at phase 0, in omega r, of each pair or of all; the mass begins on the trough
    """
    points, laws = [point for point, _ in pairs], [law for _, law in pairs]
    gamma, mu = column(p.throw_number for p in points), column(p.friction for p in points)
    beta, alpha = (numpy.arctan(column(p.tan_vibration_angle for p in points)),
                   numpy.arctan(column(p.tan_inclination for p in points)))
    gravity = numpy.sin(beta) / (gamma * numpy.cos(alpha))
    gravity_x, gravity_z = -gravity * numpy.sin(alpha), -gravity * numpy.cos(alpha)
    duration = CYCLE / contacts_per_cycle
    k, c = column(law.stiffness for law in laws) / duration**2, column(law.damping for law in laws) / duration
    springs = numpy.array([law.tangential_stiffness is not None for law in laws])
    kt = numpy.where(springs, column(law.tangential_stiffness or 1 for law in laws), 1) / duration**2
    least = numpy.where([law.pulls for law in laws], -numpy.inf, 0.0)
    along, across = numpy.cos(beta), numpy.sin(beta)
    step = CYCLE / steps
    place = numpy.sin(CYCLE * numpy.arange(steps + 1) / steps)
    speed = numpy.diff(place) / step
    x, z, vx, vz, spring = (numpy.zeros(len(pairs)) for _ in range(5))
    vx += numpy.asarray(start, dtype=float)
    ax, az = gravity_x, gravity_z
    means = numpy.empty((cycles, len(pairs)))
    for cycle in range(cycles):
        before = x.copy()
        for i in range(steps):
            vx += step / 2 * ax
            vz += step / 2 * az
            x += step * vx
            z += step * vz
            overlap = across * place[i + 1] - z
            slip = vx - along * speed[i]
            force = numpy.where(overlap > 0, numpy.maximum(k * overlap - c * (vz - across * speed[i]), least), 0)
            cap = mu * abs(force)
            spring = numpy.clip(numpy.where(overlap > 0, spring + step * slip, 0), -cap / kt, cap / kt)
            ax = gravity_x + numpy.where(springs, -kt * spring, numpy.clip(-c * slip, -cap, cap))
            az = gravity_z + force
            vx += step / 2 * ax
            vz += step / 2 * az
        means[cycle] = (x - before) / (CYCLE * along)
    return means
