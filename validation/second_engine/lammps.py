"""The layer of validation/why_theory_fails as an input of LAMMPS, in the frame of the trough."""

import math
import pathlib
import subprocess
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

GRAVITY = 9.81
AMPLITUDE, TAN_BETA, FLOOR_FRICTION = 6e-3, 0.5, 0.23
DIAMETERS = {3.3e-3: 104, 3.0e-3: 105, 2.7e-3: 104}  # the three size classes of the deck, and their numbers
LENGTH, WIDTH = 36e-3, 18e-3
MODULUS, POISSON, DENSITY, FRICTION = 5e6, 0.35, 1400.0, 0.5
SETTLING, CYCLES, START = 7, 72, 24  # drive periods at rest; driven cycles; of these left out as start-up
STEPS = 3200  # per cycle, as in the deck of LIGGGHTS: 20 % of the Rayleigh time

# Normal and tangential stiffness (4/3 Y* and 8 G*) of two bodies of this material, for a wall given by its stiffness.
STIFFNESS = 4 / 3 * MODULUS / (2 * (1 - POISSON**2))
SHEAR = 8 * MODULUS / (4 * (2 - POISSON) * (1 + POISSON))


def tsuji_argument(restitution: float = 0.5) -> float:
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


def contacts() -> str:
    """Pair and floor: Hertz with Mindlin's tangential history, Coulomb's limit, no attraction.

    The floor is given by stiffnesses, since LAMMPS's walls of `hertz/material` have another modulus (README.md).
    """
    e = f"{tsuji_argument():.10g}"
    return f"""pair_style granular
pair_coeff * * hertz/material {MODULUS:g} {e} {POISSON} tangential mindlin NULL 0 {FRICTION} damping tsuji limit_damping
fix floor all wall/gran granular hertz {STIFFNESS:.12g} {e} tangential mindlin {SHEAR:.12g} 0 {FLOOR_FRICTION} damping tsuji limit_damping zplane 0 NULL
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
{contacts()}fix move all nve/sphere
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


def frequency(throw_number: float) -> float:
    sine = math.sin(math.atan(TAN_BETA))
    return math.sqrt(throw_number * GRAVITY / (AMPLITUDE * sine)) / (2 * math.pi)


def grains(seed: int) -> list[str]:
    """Lines of `create_atoms`: grains of mixed sizes on a loose grid, each shifted a little."""
    random = np.random.default_rng(seed)
    diameters = random.permutation(np.repeat(list(DIAMETERS), list(DIAMETERS.values())))
    columns, rows = 10, 5
    pitch_x, pitch_y = LENGTH / columns, WIDTH / rows
    lines = []
    for i, diameter in enumerate(diameters):
        x, y, z = i % columns, i // columns % rows, i // (columns * rows)
        shift = random.uniform(-1e-4, 1e-4, 3)
        place = np.array([(x + 0.5) * pitch_x, (y + 0.5) * pitch_y, (z + 0.6) * 3.6e-3]) + shift
        lines += [f"create_atoms 1 single {place[0]:.9g} {place[1]:.9g} {place[2]:.9g}",
                  f"set atom {i + 1} diameter {diameter:g} density {DENSITY:g}"]
    return lines


def layer(throw_number: float, rotation: str, seed: int, cycles: int) -> str:
    """Grains fall on the trough, rest, and are conveyed, all in one run.

    One run, since LAMMPS converts the wall's damping again at each `run`. In the frame of the trough its motion r sin(omega t) is a
    body force m r omega^2 sin(omega t); it begins when the grains are at rest on the trough.
    """
    f = frequency(throw_number)
    return WORLD + f"""region world block 0 {LENGTH} 0 {WIDTH} -0.001 0.2
create_box 1 world
""" + "\n".join(grains(seed)) + f"""
{contacts()}neighbor 0.0009 bin
neigh_modify delay 0
velocity all create 1 {seed} loop local
velocity all scale 0
fix move all {"nve/sphere" if rotation == "free" else "nve"}
timestep {1 / (f * STEPS):.12g}
variable push equal "(step>={SETTLING * STEPS})*{AMPLITUDE * (2 * math.pi * f) ** 2:.12g}*sin(2*PI*(step%{STEPS})/{STEPS})"
variable gx equal v_push*{math.cos(math.atan(TAN_BETA)):.12g}
variable gz equal v_push*{math.sin(math.atan(TAN_BETA)):.12g}-{GRAVITY}
variable g equal sqrt(v_gx^2+v_gz^2)
fix gravity all gravity v_g vector v_gx 0 v_gz
variable now equal step
variable x equal xcm(all,x)
variable z equal xcm(all,z)
variable energy equal ke
fix cycles all print {STEPS} "${{now}},${{x}},${{z}},${{energy}}" file cycles.csv screen no title "step,x,z,kinetic_energy"
thermo {STEPS}
thermo_modify lost error
run {(SETTLING + cycles) * STEPS}
"""


def run(folder: pathlib.Path, name: str, text: str) -> str:
    """Runs LAMMPS in `folder` and returns what it prints."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.lammps").write_text(text, encoding="utf-8")
    words = ["lmp", "-in", f"{name}.lammps", "-log", "none"]
    answer = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)
    if answer.returncode != 0:
        raise SystemExit(f"{' '.join(words)} in {folder} ended with {answer.returncode}:\n{answer.stdout[-800:]}{answer.stderr[-400:]}")
    return answer.stdout


def efficiencies(folder: pathlib.Path, throw_number: float, rotation: str, seed: int, cycles: int = CYCLES) -> NDArray[np.float64]:
    """The velocity efficiency of each driven cycle of one packing; a run that ended before is read, not repeated."""
    table = folder / "cycles.csv"

    def values() -> NDArray[np.float64] | None:
        if not table.exists():
            return None
        steps, x, _, energy = np.loadtxt(table, delimiter=",", skiprows=1, unpack=True)
        if round(steps[-1]) != (SETTLING + cycles) * STEPS:
            return None
        mass = DENSITY * math.pi / 6 * sum(number * diameter**3 for diameter, number in DIAMETERS.items())
        fastest = 2 * math.pi * frequency(throw_number) * AMPLITUDE
        if energy[SETTLING] > 1e-4 * mass * fastest**2:
            raise SystemExit(f"{folder}: the layer is not at rest when the drive begins")
        return np.diff(x[SETTLING:]) / (2 * math.pi * AMPLITUDE * math.cos(math.atan(TAN_BETA)))

    found = values()
    if found is None:
        run(folder, "layer", layer(throw_number, rotation, seed, cycles))
        found = values()
    if found is None:
        raise SystemExit(f"{table} is incomplete")
    return found
