"""The rungs: from the point mass that the theory speaks of to the layer, one change at a time."""

from typing import Any

Changes = dict[str, Any]

ALL = [1.5, 1.7, 2.0, 2.25, 2.5, 3.0]
PAIR = [1.7, 2.0]
BLOCKED: Changes = {"grains.rotation": "blocked"}


def grains(count: int) -> Changes:
    return {"layer.height": None, "layer.grains": count}


def deep(height: str) -> Changes:
    return {"layer.height": height}


def varied(**keys: Any) -> Changes:
    return {name.replace("_", ".", 1): value for name, value in keys.items()}


# name: (changes of base.toml, throw numbers), in the order in which they are simulated
RUNGS: dict[str, tuple[Changes, list[float]]] = {
    "block": ({"layer.height": None, "layer.block": "point", "measure.packings": 1, "grains.diameter_spread": None}, ALL),
    "4 deep, blocked": (BLOCKED, ALL),
    "4 deep, free": ({}, ALL),
    "restitution 0.1": (varied(grains_restitution=0.1, trough_restitution=0.1), PAIR),
    "restitution 0.9": (varied(grains_restitution=0.9, trough_restitution=0.9), PAIR),
    "rolling friction 0.5": (varied(grains_rotation="rolling", grains_rolling_friction=0.5), PAIR),
    "grain friction 0.1": (varied(grains_friction=0.1), PAIR),
    "2 deep, blocked": (varied(grains_rotation="blocked", layer_height="6 mm"), PAIR),
    "2 deep, free": (varied(layer_height="6 mm"), PAIR),
    "8 deep, blocked": (varied(grains_rotation="blocked", layer_height="24 mm"), PAIR),
    "8 deep, free": (varied(layer_height="24 mm"), PAIR),
    "trough friction 0.1": (varied(trough_friction=0.1), PAIR),
    "rolling friction 0.1": (varied(grains_rotation="rolling", grains_rolling_friction=0.1), PAIR),
    "monolayer, blocked": (BLOCKED | deep("3 mm"), ALL),
    "monolayer, free": (deep("3 mm"), ALL),
    # Eight spheres each: a third of the floor, which does not change the layer of spheres by more than 0.01 (README).
    "cubes": (varied(grains_shape="cube", grains_diameter_spread=None, layer_length="15 mm", layer_width="13.5 mm"), ALL),
    "grain, blocked": (BLOCKED | grains(1), ALL),
    "grain, free": (grains(1), ALL),
}

# Rungs whose grains of 5 MPa are far too soft by the program's rule (s^2 above half of measure.half_width, validation/deep_layers), and at
# which throw numbers. They are simulated with the modulus that the program chooses and the time step of deep_layers, where no effect of it was
# seen. The layer of 8 diameters without rotation, and those of 4 from 2.25 on, are too soft as well, and have 5 MPa.
STIFF: Changes = {"grains.youngs_modulus": None, "solver.rayleigh_fraction": 0.35}
STIFF_LAYERS: dict[str, list[float]] = {
    "8 deep, free": PAIR,
    "8 deep, blocked": PAIR,
    "4 deep, free": [2.25, 2.5, 3.0],
    "4 deep, blocked": [2.25, 2.5, 3.0],
}


def campaign_name(rung: str) -> str:
    return "".join(letter if letter.isalnum() or letter == "." else "-" for letter in rung)
