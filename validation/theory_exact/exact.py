"""Flights of a point mass that lands plastically on a trough at sin(t), gravity 1/gamma: Newton's mechanics, no solver."""

import math

SEARCH = 0.02  # rad: no flight of ours is shorter


def gap(phase: float, duration: float, gamma: float) -> float:
    """Height above the trough `duration` after leaving it at `phase`."""
    return math.sin(phase) + math.cos(phase) * duration - duration**2 / (2 * gamma) - math.sin(phase + duration)


def flight(phase: float, gamma: float) -> float:
    """Duration of the flight that starts at `phase`: the first root of the gap, by bisection to rounding."""
    duration = SEARCH
    while gap(phase, duration, gamma) > 0:
        duration += SEARCH
    low, high = duration - SEARCH, duration
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if gap(phase, middle, gamma) > 0 else (low, middle)
    return (low + high) / 2


def take_off(landing: float, gamma: float) -> float:
    """Phase at which the mass leaves: at once when the trough falls away faster than gravity, else when it next does."""
    if math.sin(landing) >= 1 / gamma:
        return landing
    first = math.asin(1 / gamma)
    return first + 2 * math.pi * math.ceil((landing - first) / (2 * math.pi))


def settled_flights(gamma: float, count: int = 4, skip: int = 400) -> list[float]:
    """Durations of `count` flights in a row, in cycles, after the start has been forgotten."""
    start, durations = math.asin(1 / gamma), []
    for i in range(skip + count):
        duration = flight(start, gamma)
        if i >= skip:
            durations.append(duration / (2 * math.pi))
        start = take_off((start + duration) % (2 * math.pi), gamma)
    return durations


def plateau(n: int) -> tuple[float, float]:
    """Throw numbers between which flights of exactly n cycles follow each other and are stable."""
    return math.sqrt(1 + (math.pi * n) ** 2), math.sqrt(4 + (math.pi * n) ** 2)
