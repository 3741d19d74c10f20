"""The surface of a layer along a long box: how much of it are waves, and do they turn over from cycle to cycle?"""

import pathlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

import engine_deck
from engine_deck import Floats
from vibrotrough.observables import surface_snapshots, wave_parts

CYCLES = 3  # until the same phase is seen again: a snapshot every 0.3 cycles


def displacement(path: pathlib.Path, steps: NDArray[np.int64]) -> Floats:
    """x of the centre of mass [m] at the given steps, from the hundred lines per cycle."""
    table = engine_deck.read_lines(path)
    return np.interp(steps, table["step"], table["x_com"])


def waves(packing: pathlib.Path, length: float, steps_per_cycle: int, discarded: int) -> dict[str, Any]:
    """What the surface along x does after `discarded` cycles, in a dict, lengths in m:
    `all`: amplitude of a sinusoid with the surface's whole variance; of its strongest Fourier component the `wavelength`, the
    `amplitude` (root mean square over all snapshots, and `highest` over those of the phase where it is highest), the `share`
    of the variance, and `turnover`: its correlation, in the layer's own frame, with itself three cycles later, when the same
    phase is seen again. Waves at half the frequency give -1, dunes that the layer carries +1, noise 0.
    `x`, `two`: the surface three cycles before the end and at it, in the layer's frame, at that phase."""
    steps, places, heights = surface_snapshots(packing)
    late = steps >= discarded * steps_per_cycle
    steps, heights = steps[late], heights[late]
    deviation = heights - heights.mean(axis=1, keepdims=True)
    x = displacement(packing / "phases.csv", steps)
    numbers = np.arange(1, len(places) // 2)
    parts = wave_parts(places, heights, length) * np.exp(2j * np.pi * np.outer(x, numbers) / length)  # in the frame that moves with the layer
    variances = (2 * np.abs(parts) ** 2).mean(axis=0)
    best = int(variances.argmax())
    later = {step: i for i, step in enumerate(steps)}
    pairs = [(i, later[step + CYCLES * steps_per_cycle]) for i, step in enumerate(steps)
             if step + CYCLES * steps_per_cycle in later]
    then, now = (parts[list(side), best] for side in zip(*pairs))
    turnover = (now * then.conj()).real.sum() / np.sqrt((np.abs(now) ** 2).sum() * (np.abs(then) ** 2).sum())
    phases = np.round(10 * steps / steps_per_cycle).astype(int) % 10
    by_phase = [np.sqrt(4 * (np.abs(parts[phases == phase, best]) ** 2).mean()) for phase in range(10)]
    i, j = next(pair for pair in reversed(pairs) if phases[pair[0]] == int(np.argmax(by_phase)))
    return {"wavelength": length / numbers[best], "amplitude": np.sqrt(2 * variances[best]), "highest": max(by_phase),
            "share": variances[best] / (deviation**2).mean(), "all": np.sqrt(2 * (deviation**2).mean()), "turnover": turnover,
            "x": places, "two": [in_layer(places, deviation[k], x[k] - x[i], length) for k in (i, j)]}


def in_layer(places: Floats, deviation: Floats, moved: float, length: float) -> Floats:
    """The surface at `places` of a frame that has moved with the layer."""
    return np.interp(places + moved, places, deviation, period=length)
