"""The candidates for a criterion of softness, their fit on the grid and their judgement by other layers."""

import math
from collections.abc import Callable, Mapping

import numpy as np
import scipy.optimize

from layers import FOUND, Layer, held_out
from validation_case import Floats

GRAVITY, DENSITY, POISSON, SOLID_FRACTION = 9.81, 1400.0, 0.35, 0.58

Inputs = Mapping[str, float]  # of one layer: diameter and depth in m, throw_number, omega, alpha, modulus in Pa, flight


def drive(throw_number: float, amplitude: float, tan_beta: float, tan_alpha: float) -> tuple[float, float]:
    """omega in rad/s, and cos(alpha)."""
    beta, alpha = math.atan(tan_beta), math.atan(tan_alpha)
    return math.sqrt(throw_number * GRAVITY * math.cos(alpha) / (amplitude * math.sin(beta))), math.cos(alpha)


def inputs(layer: Layer, modulus_mpa: float) -> dict[str, float]:
    omega, cosine = drive(layer.throw_number, layer.amplitude / 1000, layer.tan_vibration_angle, layer.tan_inclination)
    return {"diameter": layer.diameter / 1000, "depth": layer.depth * layer.diameter / 1000, "throw_number": layer.throw_number,
            "omega": omega, "cosine": cosine, "modulus": modulus_mpa * 1e6, "amplitude": layer.amplitude / 1000,
            "sine": math.sin(math.atan(layer.tan_vibration_angle))}


def on_grid(depth: float, throw_number: float, modulus_mpa: float) -> dict[str, float]:
    return inputs(Layer("grid", 3, 6, depth, throw_number, 0.5, 0, 0.4, 0.5, 0), modulus_mpa)


def effective_modulus(of: Inputs) -> float:
    return of["modulus"] / (2 * (1 - POISSON**2))


def wave_number(of: Inputs) -> float:
    """omega h / c: the angle by which the trough moves on while the landing crosses the layer."""
    pressure = SOLID_FRACTION * DENSITY * of["depth"] * GRAVITY * of["cosine"] * (1 + of["throw_number"]) / 2
    speed = (effective_modulus(of) / DENSITY)**(1 / 3) * (pressure / DENSITY)**(1 / 6)
    return of["omega"] * of["depth"] / speed


def flight(of: Inputs) -> float:
    """Phase that the plastic point mass flies, rad: sin(e) of the parabola from arcsin(1 / Gamma) on; at most a whole cycle."""
    gamma = of["throw_number"]
    if gamma <= 1:
        return 0.0
    start = math.asin(1 / gamma)

    def height(phase: float) -> float:
        gone = phase - start
        return 1 / gamma + math.cos(start) * gone - gone**2 / (2 * gamma) - math.sin(phase)

    grid = np.linspace(start + 0.02, start + 2 * math.pi, 4000)
    values = [height(phase) for phase in grid]
    for i in range(1, len(grid)):
        if values[i] <= 0 < values[i - 1]:
            return float(grid[i]) - start
    return 2 * math.pi


def wave_over_contact(of: Inputs) -> float:
    return wave_number(of) / (2 * math.pi - flight(of))


def impact(of: Inputs) -> tuple[float, float]:
    """Duration and overlap over diameter of the impact of two equal grains at the trough's speed (Johnson 1985, 11.4)."""
    d, speed = of["diameter"], of["omega"] * of["amplitude"]
    mass, radius, modulus = DENSITY * math.pi / 12 * d**3, d / 4, effective_modulus(of)
    duration = 2.87 * (mass**2 / (radius * modulus**2 * speed))**0.2
    return duration, (15 * mass * speed**2 / (16 * modulus * math.sqrt(radius)))**0.4 / d


def chain(of: Inputs) -> float:
    return of["depth"] / of["diameter"] * impact(of)[0] * of["omega"]


def overlap(of: Inputs) -> float:
    return impact(of)[1]


def softness_of_modulus(of: Inputs) -> float:
    """The control: density, gravity and diameter over the modulus."""
    return DENSITY * GRAVITY * of["diameter"] / of["modulus"]


CANDIDATES: dict[str, Callable[[Inputs], float]] = {
    "wave number": wave_number, "wave over contact": wave_over_contact, "chain": chain, "overlap": overlap, "modulus": softness_of_modulus}
CONTROL = "modulus"


def power_law(measures: Floats, errors: Floats, weights: Floats) -> tuple[float, float, float]:
    """a and b of error = -a s^b by least squares with these weights, and the weighted rms of what is left."""
    scale = float(np.exp(np.mean(np.log(measures))))

    def misses(p: Floats) -> Floats:
        return np.asarray((errors + np.exp(p[0]) * (measures / scale)**p[1]) * weights)

    best = min((scipy.optimize.least_squares(misses, [math.log(0.05), b]) for b in (0.7, 1.5, 3.0)), key=lambda fit: fit.cost)
    a, b = math.exp(best.x[0]) / scale**best.x[1], float(best.x[1])
    return a, b, float(np.sqrt(np.sum(best.fun**2) / np.sum(weights**2)))


def judges() -> dict[str, Layer]:
    return {layer.name: layer for layer in [FOUND, *held_out()]}
