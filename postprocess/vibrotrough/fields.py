"""Continuum fields of a layer over x and z in the frame of the trough, phase by phase, by coarse graining.

    import vibrotrough

    case = vibrotrough.Campaign("runs/demo").cases()[0]
    fields = vibrotrough.fields.measure(case)               # of all packings that keep frames
    print(fields["solid_fraction"].shape)                   # (phases, z, x)
    print(fields.profiles()["velocity"][:, :, 0])           # (phases, z): along x, mean over x

vibrotrough.field_files writes them as HDF5 and for ParaView.

Equations (I. Goldhirsch, Granular Matter 12, 2010, 239-252, doi:10.1007/s10035-010-0181-z). With grains i of mass m_i at r_i, the kernel
phi, and f_ij the force of j on i:

    density              rho = sum_i m_i phi(r - r_i)
    velocity             V = sum_i m_i v_i phi(r - r_i) / rho
    kinetic stress       sum_i m_i v'_i v'_i phi(r - r_i),  v'_i = v_i - V(r)
    contact stress       - sum_ij f_ij b_ij int_0^1 phi(r - r_i - s b_ij) ds,  b_ij = r_j - r_i, each contact once
    temperature          T = trace(kinetic stress) / (3 rho)

Stresses are positive when they press. All fields are means over the width of the layer (y), and r is the place in the plane x, z. The kernel is
4 / (pi w^2) (1 - r^2/w^2)^3 for r < w: its integral is 1, its standard deviation in each direction is w / sqrt(10), and its integral
along a line is a polynomial. w, the width, is one mean diameter of the grains unless it is given.

The trough (T. Weinhart et al., Granular Matter 14, 2012, 289-294, doi:10.1007/s10035-012-0317-4). Its contacts are part of the stress, with b
from the centre of the grain to the point on the trough. That paper adds the force of the wall to the balance as a density phi(r - c)
at each point of contact c. Here the line of a contact with the floor goes on below c, normal to the floor, which has the same divergence:
the stress just below the floor is the force on the floor, so that its mean over a cycle is the weight of the layer. The kernel
is neither cut off nor renormalised at the floor, because then neither mass nor momentum would be conserved; up to w below the floor
there is therefore some density. Contacts with side walls end at the wall, whose forces the balance then lacks.

So mass and momentum are conserved exactly, in the frame of the trough, which moves with the acceleration a:

    d(rho V)/dt + div(contact stress + kinetic stress + rho V V) = rho (g - a)
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from .campaign import Case
from .frames import Contacts, Cycle, Frame, Packing

Floats = NDArray[np.float64]

AT_ONCE = 5000  # grains or contacts, of which each reaches a hundred points or two: 8 MB an array
CELLS_PER_WIDTH = 4  # of the grid: a sum over its points then differs from the integral by less than 1e-3
UNITS = {
    "density": ("kg/m3", "mass per volume"),
    "solid_fraction": ("1", "volume of the grains per volume"),
    "velocity": ("m/s", "mean velocity of the mass, relative to the trough"),
    "granular_temperature": ("m2/s2", "a third of the mean square of the grains' velocities relative to the mean velocity at the same moment"),
    "contact_stress": ("Pa", "stress by the forces of contacts, positive when it presses"),
    "kinetic_stress": ("Pa", "stress by the grains' velocities relative to the mean velocity at the same moment"),
    "convective_stress": ("Pa", "density times velocity times velocity"),
    "mass_flux": ("kg m-2 s-1", "density times velocity"),
}


class NoFields(ValueError):
    """A case has no fields; the text says why."""


@dataclasses.dataclass(frozen=True)
class Kernel:
    """4 / (pi w^2) (1 - r^2/w^2)^3 in the plane, in 1/m2."""

    width: float  #: w, m

    def at(self, x: Floats, z: Floats) -> Floats:
        """Its value at this distance from its centre."""
        rest = np.clip(1 - (x**2 + z**2) / self.width**2, 0, None)
        value: Floats = 4 / (np.pi * self.width**2) * rest**3
        return value

    def along(self, x: Floats, z: Floats, branch_x: Floats, branch_z: Floats) -> Floats:
        """Its mean over the line from 0 to the branch, seen from x, z: int_0^1 phi(r - s b) ds."""
        length = np.hypot(branch_x, branch_z)
        point = length < 1e-6 * self.width  # the line is across the trough: any direction will do
        length = np.where(point, 1e-6 * self.width, length)
        along_x, along_z = np.where(point, 1.0, branch_x / length), np.where(point, 0.0, branch_z / length)
        w2 = self.width**2
        rest = np.clip(1 - (x * along_z - z * along_x) ** 2 / w2, 0, None)  # of the distance from the line
        half, foot = self.width * np.sqrt(rest), x * along_x + z * along_z

        def integral(s: Floats) -> Floats:
            s = np.clip(s, -half, half)
            value: Floats = s * (rest**3 - s**2 / w2 * (rest**2 - s**2 / w2 * (0.6 * rest - s**2 / w2 / 7)))
            return value

        mean: Floats = 4 / (np.pi * w2) * (integral(length - foot) - integral(-foot)) / length
        return mean


@dataclasses.dataclass(frozen=True)
class Grid:
    """Points in the plane x, z: x repeats itself after the length of the box, z begins one width below the floor."""

    kernel: Kernel
    start: float  #: of the box in x, m
    length: float  #: of the box, m
    breadth: float  #: of the box across the trough, m
    top: float  #: m above the floor

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of points in z and x."""
        step = self.kernel.width / CELLS_PER_WIDTH
        return int(np.ceil((self.top + self.kernel.width) / step)), max(1, int(np.ceil(self.length / step)))

    @property
    def steps(self) -> tuple[float, float]:
        """Distances of the points in z and x, m."""
        return self.kernel.width / CELLS_PER_WIDTH, self.length / self.shape[1]

    @property
    def x(self) -> Floats:
        """From the start of the box, m."""
        x: Floats = (np.arange(self.shape[1]) + 0.5) * self.steps[1]
        return x

    @property
    def z(self) -> Floats:
        """Above the floor, m."""
        z: Floats = (np.arange(self.shape[0]) + 0.5) * self.steps[0] - self.kernel.width
        return z

    def sum(self, places: Floats, branches: Floats | None, values: Floats) -> Floats:
        """sum_i value_i phi(r - r_i), or the mean of phi over the branch that begins at r_i, per metre of breadth.

        @param places    x and z, m, (n, 2)
        @param branches  None, or (n, 2)
        @param values    (n, components)
        @return (z, x, components)
        """
        sums = np.zeros((self.shape[0] * self.shape[1], values.shape[1]))
        for first in range(0, len(places), AT_ONCE):
            some = slice(first, first + AT_ONCE)
            index, weight = self.weights(places[some], None if branches is None else branches[some])
            for component, one in enumerate(values[some].T):
                sums[:, component] += np.bincount(index.ravel(), (weight * one[:, None, None]).ravel(), len(sums))
        return sums.reshape(*self.shape, -1)

    def weights(self, places: Floats, branches: Floats | None) -> tuple[NDArray[np.intp], Floats]:
        """Numbers of the points that each place or branch can reach, and its kernel there per metre of breadth: (n, z, x)."""
        (rows, columns), (dz, dx), width = self.shape, self.steps, self.kernel.width
        ends = places if branches is None else places + branches
        reach = np.abs(ends - places).max(axis=0, initial=0) / 2 + width
        middle = (places + ends) / 2
        row, column = np.floor((middle[:, 1] + width) / dz), np.floor((middle[:, 0] - self.start) / dx)
        near_z, near_x = (np.arange(-n, n + 1) for n in (int(reach[1] / dz) + 1, int(reach[0] / dx) + 1))
        at_row, at_column = np.broadcast_arrays((row[:, None] + near_z)[:, :, None], (column[:, None] + near_x)[:, None, :])
        x = (at_column + 0.5) * dx + self.start - places[:, 0, None, None]
        z = (at_row + 0.5) * dz - width - places[:, 1, None, None]
        weight = self.kernel.at(x, z) if branches is None else self.kernel.along(x, z, *(branches[:, i, None, None] for i in (0, 1)))
        inside = (at_row >= 0) & (at_row < rows)
        index = (np.clip(at_row, 0, rows - 1) * columns + at_column % columns).astype(np.intp)
        return index, np.where(inside, weight, 0) / self.breadth


def outer(one: Floats, other: Floats) -> Floats:
    """Rows of tensors of two rows of vectors: (..., 3, 3)."""
    product: Floats = one[..., :, None] * other[..., None, :]
    return product


def without_mean_motion(density: Floats, flux: Floats, momentum_flux: Floats) -> Floats:
    """sum m v' v' phi = sum m v v phi - rho V V."""
    motion = outer(flux, flux) / np.where(density > 0, density, 1)[..., None, None]
    difference: Floats = momentum_flux - motion
    return difference


def moment(frame: Frame, contacts: Contacts | None, grid: Grid, densities: Mapping[int, float], trough_velocity: Floats) -> dict[str, Floats]:
    """The sums over the grains and contacts of a frame, (z, x) and components. `profile_kinetic_stress` is relative to the mean over x, (z, 3, 3)."""
    volumes = frame.volumes
    mass = volumes * np.array([densities[one] for one in frame.types])
    places, velocities = frame.positions[:, [0, 2]] - frame.trough, frame.velocities - trough_velocity
    flux = mass[:, None] * velocities
    values = np.column_stack([mass, volumes, flux, outer(flux, velocities).reshape(-1, 9)])
    sums = grid.sum(places, None, values)
    density, momentum, motion = sums[..., 0], sums[..., 2:5], sums[..., 5:].reshape(*grid.shape, 3, 3)
    kinetic = without_mean_motion(density, momentum, motion)
    found = {"density": density, "solid_fraction": sums[..., 1], "mass_flux": momentum, "kinetic_stress": kinetic, "convective_stress": motion - kinetic}
    found["profile_kinetic_stress"] = without_mean_motion(density.mean(axis=1), momentum.mean(axis=1), motion.mean(axis=1))
    if contacts is not None:
        found["contact_stress"] = contact_stress(contacts, grid, frame.trough)
    return found


def contact_stress(contacts: Contacts, grid: Grid, trough: Floats) -> Floats:
    """The stress of the contacts, (z, x, 3, 3): row the direction of the force, column that of the branch."""
    starts = contacts.places[:, [0, 2]] - trough
    force, branch = contacts.normal_force + contacts.tangential_force, contacts.branch
    stress = grid.sum(starts, branch[:, [0, 2]], -outer(force, branch).reshape(-1, 9))
    floor = (contacts.second == 0) & (-branch[:, 2] > 0.5 * np.linalg.norm(branch, axis=1))
    below = starts[floor] + branch[floor][:, [0, 2]]
    down = np.zeros((len(below), 3))
    down[:, 2] = -2 * grid.kernel.width - below[:, 1]  # ends where the grid cannot see it
    stress += grid.sum(below, down[:, [0, 2]], -outer(force[floor], down).reshape(-1, 9))
    return stress.reshape(*grid.shape, 3, 3)


class Fields(Mapping[str, Floats]):
    """Fields by name (see UNITS), (phases, z, x) and components; the mean over all frames of a phase."""

    def __init__(self, grid: Grid, phases: Floats, sums: dict[str, Floats], frames: int, case: str) -> None:
        self.grid, self.phases, self.frames, self.case = grid, phases, frames, case  # phases: in cycles, 0 < phase <= 1
        self._sums = sums

    def profiles(self) -> dict[str, Floats]:
        """The same over z, means over x."""
        sums = {name: values.mean(axis=2) for name, values in self._sums.items() if name != "profile_kinetic_stress"}
        total = sums["kinetic_stress"] + sums["convective_stress"]
        sums["kinetic_stress"] = self._sums["profile_kinetic_stress"]
        sums["convective_stress"] = total - sums["kinetic_stress"]
        return complete(sums)

    def mean(self) -> Fields:
        """The mean over the cycle, as a single phase."""
        return Fields(self.grid, np.array([1.0]), {name: one.mean(axis=0, keepdims=True) for name, one in self._sums.items()}, self.frames, self.case)

    def __getitem__(self, name: str) -> Floats:
        return complete({one: values for one, values in self._sums.items() if one != "profile_kinetic_stress"})[name]

    def __iter__(self) -> Iterator[str]:
        return (name for name in UNITS if name != "contact_stress" or name in self._sums)

    def __len__(self) -> int:
        return len(list(iter(self)))


def complete(sums: dict[str, Floats]) -> dict[str, Floats]:
    """With what follows from the sums; NaN where there are no grains: below a millionth of the largest density."""
    density = sums["density"]
    there = np.where(density > 1e-6 * density.max(), density, np.nan)
    trace = np.trace(sums["kinetic_stress"], axis1=-2, axis2=-1)
    return {**sums, "velocity": sums["mass_flux"] / there[..., None], "granular_temperature": trace / (3 * there)}


def stream_function(fields: Fields) -> Floats:
    """psi(z, x) in kg/(m s), the mean over the cycle: rho (V - U) = (-d psi/dz, d psi/dx), with U the mean velocity of the mass along x.

    Its lines are streamlines of the mass in a frame that moves with the layer; closed ones are convection. In a steady state the
    flux has no divergence, so that psi is the integral of its component along x, from the lowest z on.
    """
    mean = fields.mean()
    density, flux = mean["density"][0], mean["mass_flux"][0, :, :, 0]
    relative = flux - density * flux.sum() / density.sum()
    integral = np.cumsum(relative, axis=0) - relative / 2  # up to the points
    psi: Floats = -integral * fields.grid.steps[0]
    return psi


def densities_of(packing: Packing) -> dict[int, float]:
    """Density by type, kg/m3."""
    types = np.unique(packing.frames[0].types)
    if "materials/density" in packing.result:
        known = [float(one) for one in packing.result["materials/density"]]
        if len(known) == len(types):
            return dict(zip(types.tolist(), known))  # both in the order of the campaign file
    return {int(one): packing.value("grain_density") for one in types}


def trough_velocities(packing: Packing, phases: Floats) -> Floats:
    """Velocity of the trough at phases, in cycles, (phases, 3): by the Fourier series of what a cycle of the engine gave, m/s.

    Zero where the motion within the cycle is not kept (screens, open troughs): means over a cycle are the same."""
    known = packing.phases()
    first = np.asarray(known["phase"]) < 2 * np.pi * (1 + 1e-9)
    count = int(first.sum())
    if count == 0:
        return np.zeros((len(phases), 3))
    orders = np.arange((count - 1) // 2 + 1)
    velocities = np.zeros((len(phases), 3))
    for axis, name in ((0, "trough_velocity_x"), (2, "trough_velocity_z")):
        parts = np.fft.rfft(np.roll(np.asarray(known[name])[first], 1))[orders] / count  # begins with phase 0
        parts[1:] *= 2
        velocities[:, axis] = (parts * np.exp(2j * np.pi * np.outer(phases, orders))).real.sum(axis=1)
    return velocities


def frames_per_cycle(packing: Packing) -> int:
    steps = packing.frames.steps
    if len(steps) < 2:
        raise NoFields(f"packing {packing.number} has fewer than two frames")
    return round(packing.steps_per_cycle / (steps[1] - steps[0]))


def grid_of(frame: Frame, width: float, top: float) -> Grid:
    (start, end), (left, right) = frame.box[:2]
    return Grid(Kernel(width), float(start), float(end - start), float(right - left), top)


def measure(case: Case, packings: Sequence[Packing] | None = None, width: float | None = None, discard: int | None = None) -> Fields:
    """The fields of a case: means over the cycles of its packings that keep frames, without stresses of contacts where these were not kept.

    @param width    w, m; default: one mean diameter
    @param discard  cycles left out at the beginning; default: the start-up of each packing
    @raises NoFields when it has no frames, a drive with stages, or grains that are fed
    """
    packings = [one for one in (packings or case.packings()) if one.has("frames")]
    if not packings:
        raise NoFields(f"case {case.folder.name} keeps no frames; write output.frames_per_cycle = 20 and output.contacts = true into the campaign file")
    if "stage_cycles/time" in packings[0].result or not all(has_phases(one) for one in packings):
        raise NoFields(f"case {case.folder.name} has no periodic motion of its own, such as a drive with stages or an open trough")
    kernel_width = width or packings[0].value("grain_diameter")
    sums: dict[str, Floats] = {}
    count, number = frames_per_cycle(packings[0]), 0
    phases = np.arange(1, count + 1) / count
    grid = grid_of(packings[0].frames[0], kernel_width, 2 * kernel_width)
    for packing in packings:
        first = discard if discard is not None else int(packing.result["packings/cycles_discarded"][packing.number - 1])
        densities, velocities = densities_of(packing), trough_velocities(packing, phases)
        has_contacts = packing.has("contacts")
        for cycle in packing.cycles("frames")[first:]:
            for place, frame in enumerate(cycle.frames):
                grid = dataclasses.replace(grid, top=max(grid.top, float(frame.heights.max()) + kernel_width))
                found = moment(frame, packing.contacts.at(frame.step) if has_contacts else None, grid, densities, velocities[place])
                add(sums, found, place, count)
            number += 1
    if number == 0:
        raise NoFields(f"case {case.folder.name} has no frames behind its start-up")
    return Fields(grid, phases, {name: values / number for name, values in sums.items()}, number, case.folder.name)


def has_phases(packing: Packing) -> bool:
    try:
        return bool(packing.phases())
    except KeyError:
        return False


def add(sums: dict[str, Floats], found: dict[str, Floats], place: int, count: int) -> None:
    """Adds what was found in a frame to its phase; the grid may have grown at its top."""
    for name, values in found.items():
        if name not in sums:
            sums[name] = np.zeros((count, *values.shape))
        missing = len(values) - sums[name].shape[1]
        if missing > 0:
            sums[name] = np.pad(sums[name], [(0, 0), (0, missing)] + [(0, 0)] * (values.ndim - 1))
        sums[name][place] += values


@functools.lru_cache(maxsize=4096)  # several observables are made of the same profiles
def profiles_of_cycle(packing: Packing, number: int, top: float, with_contacts: bool) -> tuple[Floats, dict[str, Floats]]:
    """Places above the floor up to `top`, m, and the profiles over them, means over a cycle of a packing; those of `Fields`."""
    cycle = Cycle(packing, number)
    frames = cycle.frames
    velocities = trough_velocities(packing, np.array([frame.cycle for frame in frames]))
    grid = grid_of(frames[0], packing.value("grain_diameter"), top)
    densities = densities_of(packing)
    sums: dict[str, Floats] = {}
    for frame, velocity in zip(frames, velocities):
        contacts = packing.contacts.at(frame.step) if with_contacts else None
        add(sums, moment(frame, contacts, grid, densities, velocity), 0, 1)
    fields = Fields(grid, np.ones(1), {name: values / len(frames) for name, values in sums.items()}, 1, packing.case.folder.name)
    return grid.z, {name: values[0] for name, values in fields.profiles().items()}
