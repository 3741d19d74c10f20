"""The rungs: from the point mass that the theory speaks of to the layer, one change at a time."""

import pathlib

import h5py
import numpy

GRAVITY = 9.80665
ALL = [1.5, 1.7, 2.0, 2.25, 2.5, 3.0]
FEW = [1.5, 1.7, 2.0, 2.5]
PAIR = [1.7, 2.0]
BLOCKED = {"grains.rotation": "blocked"}


def grains(count):
    return {"layer.height": None, "layer.grains": count}


def deep(height):
    return {"layer.height": height}


def varied(**keys):
    return {name.replace("_", ".", 1): value for name, value in keys.items()} | {"measure.packings": 2}


# name: (changes of base.toml, throw numbers)
RUNGS = {
    "block": ({"layer.height": None, "layer.block": "point", "measure.packings": 1, "grains.diameter_spread": None}, ALL),
    "grain, blocked": (BLOCKED | grains(1), ALL),
    "grain, free": (grains(1), ALL),
    "monolayer, blocked": (BLOCKED | deep("3 mm"), ALL),
    "monolayer, free": (deep("3 mm"), ALL),
    "4 deep, blocked": (BLOCKED, ALL),
    "4 deep, free": ({}, ALL),
    "2 deep, blocked": (BLOCKED | deep("6 mm"), FEW),
    "2 deep, free": (deep("6 mm"), FEW),
    "8 deep, blocked": (BLOCKED | deep("24 mm"), FEW),
    "8 deep, free": (deep("24 mm"), FEW),
}
VARIATIONS = {
    "restitution 0.1": varied(grains_restitution=0.1, trough_restitution=0.1),
    "restitution 0.9": varied(grains_restitution=0.9, trough_restitution=0.9),
    "restitution 0.1, blocked": varied(grains_restitution=0.1, trough_restitution=0.1, grains_rotation="blocked"),
    "restitution 0.9, blocked": varied(grains_restitution=0.9, trough_restitution=0.9, grains_rotation="blocked"),
    "grain friction 0.1": varied(grains_friction=0.1),
    "grain friction 1": varied(grains_friction=1.0),
    "rolling friction 0.1": varied(grains_rotation="rolling", grains_rolling_friction=0.1),
    "rolling friction 0.5": varied(grains_rotation="rolling", grains_rolling_friction=0.5),
    "cubes": varied(grains_shape="cube", grains_diameter_spread=None),
    "trough friction 0.1": varied(trough_friction=0.1),
    "trough friction 0.1, blocked": varied(trough_friction=0.1, grains_rotation="blocked"),
    "trough friction 0.4": varied(trough_friction=0.4),
    "trough friction 0.4, blocked": varied(trough_friction=0.4, grains_rotation="blocked"),
    "tan(beta) 0.25": varied(trough_tan_vibration_angle=0.25),
    "tan(beta) 0.25, blocked": varied(trough_tan_vibration_angle=0.25, grains_rotation="blocked"),
    "tan(beta) 1": varied(trough_tan_vibration_angle=1.0),
    "tan(beta) 1, blocked": varied(trough_tan_vibration_angle=1.0, grains_rotation="blocked"),
}


def rungs():
    return RUNGS | {name: (changes, PAIR) for name, changes in VARIATIONS.items()}


def campaign_name(rung):
    return "".join(letter if letter.isalnum() or letter == "." else "-" for letter in rung)


def landing_friction(phases, landing_phase):
    """Tangential over normal impulse of the trough on the layer while it lands: from the landing until the centre of mass no
    longer falls against the trough; NaN without a landing. `phases`: the group /phases/N of a result."""
    falling = phases["velocity_z"][:] - phases["trough_velocity_z"][:]
    count = len(falling)
    if not numpy.isfinite(landing_phase):
        return numpy.nan
    begin = int(round(landing_phase / (2 * numpy.pi) * 100)) - 1
    window = [(begin + i) % count for i in range(count)]
    end = next((i for i, place in enumerate(window) if i > 1 and falling[place] >= 0), 1)
    places = window[: end + 1]
    return phases["tangential_force"][:][places].sum() / phases["normal_force"][:][places].sum()


def driven_by(phases, friction, speed_scale, time, mass, steps=8):
    """Efficiency of a point mass with Coulomb friction under the layer's own normal force, in the periodic motion: what is
    left of a difference to the layer is not the normal force's. `phases`: /phases/N; `time`: of a hundredth of a cycle."""
    push = phases["normal_force"][:] / mass * friction * time / steps
    trough = phases["trough_velocity_x"][:]
    before = numpy.roll(trough, 1)
    parts = [numpy.linspace(a, b, steps + 1)[1:] for a, b in zip(before, trough)]
    velocity, change, slipped = 0.0, 1.0, 0.0
    for _ in range(400):
        start, slipped = velocity, 0.0
        for most, there in zip(push, parts):
            for target in there:
                slip = velocity - target
                velocity = target if abs(slip) <= most else velocity - numpy.copysign(most, slip)
                slipped += (velocity - target) / steps
        change = abs(velocity - start)
        if change < 1e-9:
            break
    return slipped / len(push) / speed_scale


def explained(folder, case):
    """Means over the packings of a case's result: landing friction, largest normal force over the weight, and the efficiency
    of a point mass under the layer's own normal force. NaN where there is no result."""
    path = pathlib.Path(folder) / "cases" / case / "result.h5"
    nothing = [numpy.nan] * 3
    if not path.exists():
        return nothing
    with h5py.File(path) as result:
        here, friction = result["case"], float(result["case/friction"][()])
        frequency = float(result["case/frequency"][()]) if "frequency" in here else cycles_per_second(here)
        scale = 2 * numpy.pi * frequency * float(here["amplitude"][()]) * numpy.cos(float(here["vibration_angle"][()]))
        rows = []
        for i, (phase, mass) in enumerate(zip(result["packings/landing_phase"], result["packings/mass"])):
            phases = result[f"phases/{i + 1}"]
            rows.append([landing_friction(phases, phase), phases["normal_force"][:].max() / (mass * GRAVITY),
                         driven_by(phases, friction, scale, 0.01 / frequency, mass)])
    table = numpy.array(rows)
    return [column[numpy.isfinite(column)].mean() if numpy.isfinite(column).any() else numpy.nan for column in table.T]


def cycles_per_second(case):
    return float(numpy.sqrt(case["machine_number"][()] * GRAVITY / case["amplitude"][()])) / (2 * numpy.pi)
