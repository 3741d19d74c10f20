"""The wear of one impact in closed form, with Finnie's constant 1, so that it is an energy, J.

LIGGGHTS adds 2 |v| f(g) |F| dt while the grain approaches (doc/finnie-wear.pdf of LIGGGHTS 3.8, Eqs. 4.17 to 4.23), with the angle g of
the velocity v to the surface. F_n dt = m dw, whatever the law of the normal force, as the grain's normal speed falls from w_0 to 0.
"""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def angle_function(normal: Floats, tangential: Floats) -> Floats:
    """f(g) of I. Finnie, Wear 3 (1960) 87-103: sin 2g - 3 sin^2 g where tan g < 1/3, else cos^2(g) / 3."""
    square = np.maximum(normal**2 + tangential**2, 1e-300)
    shallow = (2 * normal * tangential - 3 * normal**2) / square
    return np.where(3 * normal > tangential, tangential**2 / (3 * square), shallow)


def impact(mass: float, normal: float, tangential: float, friction: float, points: int = 200_001) -> float:
    """The engine's wear of an impact in which the grain slides until it no longer approaches, or until it stops sliding.

    Friction is mu times the normal force, so that the tangential speed falls by mu times what the normal speed has lost.
    """
    w = (np.arange(points) + 0.5) * normal / points  # the middles of equal intervals
    v = np.maximum(tangential - friction * (normal - w), 0)
    force = np.hypot(1, friction)  # over the normal force
    return float(2 * mass * force * np.mean(np.hypot(w, v) * angle_function(w, v)) * normal)


def hard_impact(mass: float, normal: float, tangential: float) -> float:
    """Finnie's own law: m v^2 f(g) of the speed and the angle before the impact."""
    both = np.array([normal]), np.array([tangential])
    return float(mass * (normal**2 + tangential**2) * angle_function(*both)[0])
