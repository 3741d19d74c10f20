"""Layers of LIGGGHTS as inputs of LAMMPS, in the frame of the trough."""

import dataclasses
import math
import pathlib
import statistics
import subprocess
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

GRAVITY = 9.81
POISSON, DENSITY, RESTITUTION = 0.35, 1400.0, 0.5
SETTLING, CYCLES, START = 7, 72, 24  # drive periods at rest; driven cycles; of these left out as start-up
PACKINGS, STUDENT = 4, 3.182  # Student's t, two-sided 95 %, three degrees of freedom


@dataclasses.dataclass(frozen=True)
class Layer:
    """A layer of three size classes on an inclined trough, in SI units."""

    amplitude: float
    tan_beta: float
    floor_friction: float
    friction: float  # between grains
    diameters: dict[float, int]  # the size classes of the deck, and their numbers
    length: float
    width: float
    modulus: float
    steps: int  # per cycle
    tan_alpha: float = 0
    rolling_friction: float = 0
    softer_spring: float = 1  # divides the stiffness of the rolling spring; its default belongs to the mean contact of the layer

    def stiffness(self) -> float:
        """Normal stiffness 4/3 Y* of two bodies of this material, for a wall given by its stiffness."""
        return 4 / 3 * self.modulus / (2 * (1 - POISSON**2))

    def shear(self) -> float:
        """Tangential stiffness 8 G* of two bodies of this material."""
        return 8 * self.modulus / (4 * (2 - POISSON) * (1 + POISSON))

    def mass(self) -> float:
        return DENSITY * math.pi / 6 * sum(number * diameter**3 for diameter, number in self.diameters.items())

    def fastest(self, throw_number: float) -> float:
        """Largest speed of the trough, m/s."""
        return 2 * math.pi * self.frequency(throw_number) * self.amplitude

    def frequency(self, throw_number: float) -> float:
        sine, cosine = math.sin(math.atan(self.tan_beta)), math.cos(math.atan(self.tan_alpha))
        return math.sqrt(throw_number * GRAVITY * cosine / (self.amplitude * sine)) / (2 * math.pi)

    def rolling_spring(self) -> float:
        """Stiffness of the rolling spring in N/m: the tangential stiffness k_t of a mean contact of the layer.

        LIGGGHTS (epsd2) has the rolling stiffness k_t R*^2 of each contact with its own k_t = 8 G* sqrt(R* overlap); LAMMPS has one
        number for all. The mean contact carries half of the layer's weight and of its inertia at five times gravity.
        """
        diameter = float(np.mean(list(self.diameters)))
        force = 2.5 * self.mass() * GRAVITY * diameter**2 / (self.length * self.width)
        overlap = (force / (self.stiffness() * math.sqrt(diameter / 4))) ** (2 / 3)
        return self.shear() * math.sqrt(diameter / 4 * overlap) / self.softer_spring


SHALLOW = Layer(6e-3, 0.5, 0.23, 0.5, {3.3e-3: 104, 3.0e-3: 105, 2.7e-3: 104}, 36e-3, 18e-3, 5e6, 3200)
# The layer of 14 diameters by which the error of soft grains was found, in validation/deep_layers: base.toml has the same for LIGGGHTS.
DEEP = Layer(4.5e-3, 0.59, 0.51, 0.3, {2.2e-3: 152, 2.0e-3: 152, 1.8e-3: 152}, 12e-3, 10e-3, 5e6, 3200, 0.043, 0.2)
DEEP_THROW_NUMBER = 2.38


def tsuji_argument(restitution: float = RESTITUTION) -> float:
    """The argument of LAMMPS's damping `tsuji` that gives the damping of LIGGGHTS for a nominal restitution.

    Both damp with alpha sqrt(m* k) v. LIGGGHTS has alpha = sqrt(5) |ln e| / sqrt(ln^2 e + pi^2) (Antypov & Elliott, EPL 94 (2011)
    50004); LAMMPS takes alpha from Tsuji's polynomial of its argument, which decreases.
    """
    wanted = math.sqrt(5) * -math.log(restitution) / math.hypot(math.log(restitution), math.pi)
    polynomial = np.polynomial.Polynomial([1.2728, -4.2783, 11.087, -22.348, 27.467, -18.022, 4.8218])
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if polynomial(middle) > wanted else (low, middle)
    return low


def contacts(layer: Layer) -> str:
    """Pair and floor: Hertz with Mindlin's tangential history, Coulomb's limit, no attraction.

    The floor is given by stiffnesses, since LAMMPS's walls of `hertz/material` have another modulus (README.md).
    """
    e = f"{tsuji_argument():.10g}"
    rolling = f" rolling sds {layer.rolling_spring():.10g} 0 {layer.rolling_friction}" if layer.rolling_friction > 0 else ""
    pair = f"hertz/material {layer.modulus:g} {e} {POISSON} tangential mindlin NULL 0 {layer.friction}{rolling}"
    floor = f"hertz {layer.stiffness():.12g} {e} tangential mindlin {layer.shear():.12g} 0 {layer.floor_friction}{rolling}"
    return f"""pair_style granular
pair_coeff * * {pair} damping tsuji limit_damping
fix floor all wall/gran granular {floor} damping tsuji limit_damping zplane 0 NULL
"""


WORLD = """units si
atom_style sphere
atom_modify map array
newton off
comm_modify vel yes
boundary p p f
"""


class Impact(NamedTuple):
    """One sphere after an impact on the floor: speed upwards and along (m/s), spin (rad/s)."""

    up: float
    along: float
    spin: float


def impact(folder: pathlib.Path, down: float, along: float) -> Impact:
    """A 3 mm sphere without gravity hits the floor."""
    text = WORLD + f"""region world block 0 0.1 0 0.1 -0.01 0.1
create_box 1 world
create_atoms 1 single 0.05 0.05 0.0016
set type 1 diameter 0.003 density {DENSITY:g}
{contacts(SHALLOW)}fix move all nve/sphere
velocity all set {along} 0 {-down}
compute spin all property/atom omegay
variable spin equal c_spin[1]
thermo_style custom step v_spin
timestep 1e-7
run 15000
print "RESULT $(vz[1]) $(vx[1]) $(v_spin)"
"""
    words = next(line for line in run(folder, "impact", text).splitlines() if line.startswith("RESULT")).split()
    return Impact(*map(float, words[1:]))


def grains(layer: Layer, seed: int) -> list[str]:
    """Lines of `create_atoms`: grains of mixed sizes on a loose grid, each shifted a little."""
    random = np.random.default_rng(seed)
    diameters = random.permutation(np.repeat(list(layer.diameters), list(layer.diameters.values())))
    largest = max(layer.diameters)
    columns, rows = int(layer.length / (1.08 * largest)), int(layer.width / (1.08 * largest))
    pitch_x, pitch_y = layer.length / columns, layer.width / rows
    lines = []
    for i, diameter in enumerate(diameters):
        x, y, z = i % columns, i // columns % rows, i // (columns * rows)
        shift = random.uniform(-largest / 33, largest / 33, 3)
        place = np.array([(x + 0.5) * pitch_x, (y + 0.5) * pitch_y, (z + 0.6) * 12 / 11 * largest]) + shift
        lines += [f"create_atoms 1 single {place[0]:.9g} {place[1]:.9g} {place[2]:.9g}",
                  f"set atom {i + 1} diameter {diameter:g} density {DENSITY:g}"]
    return lines


def simulation(layer: Layer, throw_number: float, rotation: str, seed: int, cycles: int) -> str:
    """Grains fall on the trough, rest, and are conveyed, all in one run.

    One run, since LAMMPS converts the wall's damping again at each `run`. In the frame of the trough its motion r sin(omega t) is a
    body force m r omega^2 sin(omega t); it begins when the grains are at rest on the trough.
    """
    f, steps = layer.frequency(throw_number), layer.steps
    beta, alpha = math.atan(layer.tan_beta), math.atan(layer.tan_alpha)
    return WORLD + f"""region world block 0 {layer.length} 0 {layer.width} -0.001 0.2
create_box 1 world
""" + "\n".join(grains(layer, seed)) + f"""
{contacts(layer)}neighbor {0.3 * max(layer.diameters):g} bin
neigh_modify delay 0
velocity all create 1 {seed} loop local
velocity all scale 0
fix move all {"nve" if rotation == "blocked" else "nve/sphere"}
timestep {1 / (f * steps):.12g}
variable push equal "(step>={SETTLING * steps})*{layer.amplitude * (2 * math.pi * f) ** 2:.12g}*sin(2*PI*(step%{steps})/{steps})"
variable gx equal v_push*{math.cos(beta):.12g}-{GRAVITY * math.sin(alpha):.12g}
variable gz equal v_push*{math.sin(beta):.12g}-{GRAVITY * math.cos(alpha):.12g}
variable g equal sqrt(v_gx^2+v_gz^2)
fix gravity all gravity v_g vector v_gx 0 v_gz
variable now equal step
variable x equal xcm(all,x)
variable z equal xcm(all,z)
variable energy equal ke
fix cycles all print {steps} "${{now}},${{x}},${{z}},${{energy}}" file cycles.csv screen no title "step,x,z,kinetic_energy"
thermo {steps}
thermo_modify lost error
run {(SETTLING + cycles) * steps}
"""


def half_width(means: list[float]) -> float:
    """Half-width of the 95 % interval of the mean over PACKINGS packings; NaN for one packing."""
    return STUDENT * statistics.stdev(means) / math.sqrt(PACKINGS) if len(means) == PACKINGS else math.nan


def run(folder: pathlib.Path, name: str, text: str) -> str:
    """Runs LAMMPS in `folder` and returns what it prints."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.lammps").write_text(text, encoding="utf-8")
    words = ["lmp", "-in", f"{name}.lammps", "-log", "none"]
    answer = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)
    if answer.returncode != 0:
        raise SystemExit(f"{' '.join(words)} in {folder} ended with {answer.returncode}:\n{answer.stdout[-800:]}{answer.stderr[-400:]}")
    return answer.stdout


def efficiencies(layer: Layer, folder: pathlib.Path, throw_number: float, rotation: str, seed: int,
                 cycles: int = CYCLES) -> NDArray[np.float64]:
    """The velocity efficiency of each driven cycle of one packing; a run that ended before is read, not repeated."""
    table = folder / "cycles.csv"
    fastest = layer.fastest(throw_number)

    def values() -> NDArray[np.float64] | None:
        if not table.exists():
            return None
        steps, x, _, energy = np.loadtxt(table, delimiter=",", skiprows=1, unpack=True)
        if round(steps[-1]) != (SETTLING + cycles) * layer.steps:
            return None
        if energy[SETTLING] > 1e-4 * layer.mass() * fastest**2:
            raise SystemExit(f"{folder}: the layer is not at rest when the drive begins")
        return np.diff(x[SETTLING:]) * layer.frequency(throw_number) / (fastest * math.cos(math.atan(layer.tan_beta)))

    found = values()
    if found is None:
        run(folder, "layer", simulation(layer, throw_number, rotation, seed, cycles))
        found = values()
    if found is None:
        raise SystemExit(f"{table} is incomplete")
    return found
