"""Smeared Coulomb friction: the mean friction of contacts whose slips scatter (README.md, section 5)."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
TORQUE = 1.7  # of the other grains on the floor grains over their spin, as measured: 1.5 to 1.9
LEAST_SCATTER = 1e-6  # omega r cos(beta); less is Coulomb's friction
NEWTON, HALVINGS = 10, 18


def exact_share(ratio: Floats) -> Floats:
    """g(q): mean cosine of the direction of q + xi, for normal xi of standard deviation 1 in both directions. Periodic trapezoids for the Bessel functions."""
    angle = np.linspace(0, np.pi, 2001)
    x = ratio**2 / 4
    values = np.exp(np.outer(x, np.cos(angle) - 1)) * (1 + np.cos(angle))
    mean = (values.sum(axis=1) - (values[:, 0] + values[:, -1]) / 2) / (len(angle) - 1)
    return np.asarray(np.sqrt(np.pi / 8) * ratio * mean)


RATIOS = np.linspace(0, 20, 4001)
SHARES = exact_share(RATIOS)
WIDTH, STEPS = RATIOS[1], np.diff(SHARES)


def share(ratio: Floats) -> Floats:
    """g of any sign, from a table; beyond it the first terms of its series, 1 - 1 / (2 q^2)."""
    size = np.abs(ratio)
    far = 1 - 0.5 / np.maximum(size, RATIOS[-1]) ** 2
    return np.asarray(np.sign(ratio) * np.where(size > RATIOS[-1], far, np.interp(size, RATIOS, SHARES)))


def friction(free: Floats, compliance: Floats, limit: Floats, scatter: Floats) -> Floats:
    """The friction F = -limit g(slip / scatter) at the end of a step in which slip = free + compliance F.

    slip + compliance limit g(slip / scatter) = free: the left-hand side is concave for slip > 0, so that Newton's method from 0 comes from the left
    and never goes too far.
    """
    least = np.maximum(scatter, LEAST_SCATTER)
    size, most, slip = np.abs(free), compliance * limit, np.zeros_like(free)
    for _ in range(NEWTON):
        ratio = slip / least
        place = np.minimum(ratio / WIDTH, len(RATIOS) - 1.001)
        index = place.astype(int)
        far = ratio > RATIOS[-1]
        value = np.where(far, 1 - 0.5 / np.maximum(ratio, 1) ** 2, SHARES[index] + (place - index) * STEPS[index])
        slope = np.where(far, 0, STEPS[index] / (least * WIDTH))
        slip += (size - slip - most * value) / (1 + most * slope)
    return np.asarray(-np.sign(free) * np.clip((size - slip) / compliance, 0, limit))


def friction_with_dry_torque(slip: Callable[[Floats], Floats], limit: Floats, scatter: Floats) -> Floats:
    """The same by bisection for a slip that grows with F in any way."""
    low, high = -limit, limit
    least = np.maximum(scatter, LEAST_SCATTER)
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        above = middle + limit * share(slip(middle) / least) > 0
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    return (low + high) / 2


def scatter(kind: str, constants: tuple[Floats | float, ...], since: Floats, agitation: Floats) -> Floats:
    """sigma of a law, before rolling friction. since: time in contact since the landing; agitation: |y'| tan(beta) in contact."""
    if kind == "smeared-decaying":
        return np.asarray(constants[0] * np.exp(-since / constants[1]))
    if kind == "smeared-geared-sinking":
        return np.asarray(constants[0] + constants[1] * agitation)
    return np.asarray(constants[0] + 0 * since)


def torque(kind: str, constants: tuple[Floats | float, ...]) -> Floats | float:
    return constants[1] if kind == "smeared-geared-torque" else TORQUE
