"""The simulations of this case: what is varied on base.toml."""

from typing import Any

FRICTION = 0.23  # of base.toml, grain on trough
SLOPES = [-0.051, 0.046]
TANGENTS = [0.25, 0.5, 1.0]
NUMBERS = [0.6, 0.8, 0.95, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0]
GRID = {"trough.tan_inclination": SLOPES, "trough.tan_vibration_angle": TANGENTS, "trough.throw_number": NUMBERS}
BETWEEN = {**GRID, "trough.throw_number": [1.25, 1.5, 1.75, 2.0]}
FREE = {**GRID, "trough.throw_number": [0.6, 0.8, 2.5, 3.0]}
# Every cycle is wanted of these, not only as many as their mean needs.
WHOLE = {"measure.packings": 1, "measure.max_packings": 1, "measure.half_width": 0.0005, "measure.max_core_time": None}
WIDE = {**WHOLE, "layer.width": "200 mm", "layer.length": "28 mm", "layer.height": "10.5 mm", "measure.max_cycles": 40,
        "output.frames_per_cycle": 10}

# Layers whose grains of 5 MPa are far too soft by the program's rule (s^2 above half of measure.half_width, validation/deep_layers). They are
# simulated once more, with the modulus that the program chooses and the time step of deep_layers, where no effect of it was seen.
STIFF: dict[str, Any] = {"grains.youngs_modulus": None, "solver.rayleigh_fraction": 0.35, "measure.max_core_time": None}
BOTH_ROTATIONS = {"grains.rotation": ["free", "blocked"]}

CAMPAIGNS: dict[str, tuple[dict[str, Any], dict[str, list[Any]]]] = {
    "free_1.25_to_2": ({}, BETWEEN),
    "free": ({}, FREE),
    "blocked": ({"grains.rotation": "blocked"}, GRID),
    "cube": ({"grains.shape": "cube", "grains.diameter_spread": 0, "layer.height": "10.5 mm"},
             {"trough.tan_inclination": SLOPES, "trough.throw_number": [0.8]}),
    "stiff_0.25": (STIFF, {**BOTH_ROTATIONS, **GRID, "trough.tan_vibration_angle": [0.25],
                           "trough.throw_number": [gamma for gamma in NUMBERS if gamma >= 1.25]}),
    "stiff_0.5": (STIFF, {**BOTH_ROTATIONS, **GRID, "trough.tan_vibration_angle": [0.5], "trough.throw_number": [2.5, 3.0]}),
    # Where the blocked layer is furthest from the theory below throw number 1: is it the softness of the grains?
    "stiff": ({"grains.rotation": "blocked", "trough.tan_inclination": 0.046, "trough.tan_vibration_angle": 1.0,
               "trough.throw_number": 0.95, "measure.half_width": 0.01},
              {"grains.youngs_modulus": ["1 MPa", "20 MPa"]}),
    "noise": ({"trough.harmonics": ["25, 0.2, 0 deg"]},
              {"grains.rotation": ["free", "blocked"], "trough.throw_number": [0.8, 1.5, 2.0, 2.5, 3.0]}),
    "walls": ({**WIDE, "trough.side_wall_friction": 0.23},
              {"grains.rotation": ["blocked", "free"], "trough.throw_number": [0.8, 2.0]}),
    "waves": ({**WHOLE, "layer.length": "168 mm", "measure.max_cycles": 60},
              {"trough.throw_number": [1.5, 1.75, 2.0, 2.5, 3.0, 3.5]}),
}

# To try the script: the last case of each campaign, and few cycles.
QUICK = {"measure.packings": 1, "measure.max_packings": 1, "measure.max_cycles": 20, "measure.half_width": 0.5}
