"""Coarse-grained fields of grains and contacts that are made by hand, against the equations that define them, and waves of made surfaces.

usage: check_fields.py POSTPROCESS FOLDER

A sum over the points of the grid, a quarter of the kernel's width apart, differs from the integral by less than 6e-4 for any place of a grain:
the Fourier transform of the kernel, 384 J4(k w) / (k w)^4, at k = 2 pi / (w / 4), twice in each direction.
"""

import json
import math
import pathlib
import shutil
import subprocess
import sys

import numpy as np

sys.path.insert(0, sys.argv[1])
from vibrotrough import field_files as files  # noqa: E402
from vibrotrough import fields as cg  # noqa: E402
from vibrotrough import observables  # noqa: E402
from vibrotrough.frames import Contacts, Frame  # noqa: E402
from check_observables import DIAMETER, LENGTH, PERIOD, STEPS, WIDTH, Maker, contact_row, some_places, write_contacts  # noqa: E402

GRAVITY, DENSITY, QUADRATURE = 9.81, 1400.0, 6e-4
BOX = np.array([[0, LENGTH], [0, WIDTH], [-0.01, 0.3]])
ONE_MATERIAL = {1: DENSITY}
AREA = LENGTH * WIDTH


def a_frame(places, velocities, radii=None, types=None, trough=(0.0, 0.0)):
    count = len(places)
    radii = np.full(count, DIAMETER / 2) if radii is None else np.asarray(radii)
    return Frame(0, 0.0, 0.0, np.array(trough), BOX, np.arange(1, count + 1), np.ones(count, int) if types is None else np.asarray(types),
                 np.asarray(places, float), np.asarray(velocities, float), radii, np.zeros((count, 3)))  # fmt: skip


def some_contacts(first, second, branch, places, force):
    return Contacts(0, np.asarray(first), np.asarray(second), np.asarray(branch, float), np.asarray(places, float), np.asarray(force, float),
                    np.zeros((len(first), 3)), np.zeros(len(first)))  # fmt: skip


def a_grid(top=0.03, width=DIAMETER):
    return cg.Grid(cg.Kernel(width), 0.0, LENGTH, WIDTH, top)


def fields_of(frame, contacts=None, densities=ONE_MATERIAL, trough_velocity=np.zeros(3), grid=None):
    grid = grid or a_grid()
    found = cg.moment(frame, contacts, grid, densities, trough_velocity)
    return cg.Fields(grid, np.ones(1), {name: values[None] for name, values in found.items()}, 1, "made")


def integral(fields, values):
    """Over the box, of a map."""
    dz, dx = fields.grid.steps
    return values.sum(axis=(0, 1)) * dz * dx * WIDTH


def integral_above(grid, values):
    """int_z^infinity of a profile, at the points, by the trapezoidal rule."""
    return (np.cumsum(values[::-1], axis=0)[::-1] - values / 2) * grid.steps[0]


def check_kernel():
    """int phi dA = 1, and along() = int_0^1 phi(r - s b) ds, both against sums of 1000 points and more, whose error is below 1e-5 for a kernel with two
    continuous derivatives; also of a branch across the trough, of length 0 in the plane."""
    kernel = cg.Kernel(1.7)
    x = (np.arange(400) + 0.5) / 100 - 2
    assert math.isclose(kernel.at(x[:, None], x[None, :]).sum() * 1e-4, 1, rel_tol=1e-5)
    second = (kernel.at(x[:, None], x[None, :]) * x[:, None] ** 2).sum() * 1e-4
    assert math.isclose(second, 1.7**2 / 10, rel_tol=1e-5), "the standard deviation that the page states"
    random = np.random.default_rng(2)
    s = (np.arange(2000) + 0.5) / 2000
    for length in (3.0, 0.5, 1e-3, 1e-7, 0.0):
        for _ in range(20):
            at, branch = random.uniform(-1.5, 1.5, 2), random.normal(size=2)
            branch *= length / np.hypot(*branch)
            wanted = kernel.at(at[0] - s * branch[0], at[1] - s * branch[1]).mean()
            found = kernel.along(*(np.array(one) for one in (*at, *branch)))
            assert math.isclose(found, wanted, rel_tol=1e-5, abs_tol=1e-6), (length, found, wanted)


def check_mass():
    """The integral of the density is the mass of the grains in the box, of two materials, also of those that lie across its ends; that of the
    solid fraction is their volume, that of the flux their momentum."""
    random, places = np.random.default_rng(3), some_places(200)
    places[:40, 0] = random.uniform(-0.001, 0.001, 40) % LENGTH
    radii, types, velocities = random.uniform(0.001, 0.002, 200), np.repeat([1, 4], 100), random.normal(size=(200, 3))
    fields = fields_of(a_frame(places, velocities, radii, types), densities={1: 1400.0, 4: 2500.0})
    volumes = 4 / 3 * np.pi * radii**3
    mass = volumes * np.repeat([1400.0, 2500.0], 100)
    assert math.isclose(integral(fields, fields["density"][0]), mass.sum(), rel_tol=QUADRATURE)
    assert math.isclose(integral(fields, fields["solid_fraction"][0]), volumes.sum(), rel_tol=QUADRATURE)
    assert np.allclose(integral(fields, fields["mass_flux"][0]), mass @ velocities, rtol=0, atol=QUADRATURE * (mass @ abs(velocities)).max())


def check_a_grain_on_the_floor():
    """One grain at rest: below the floor the stress on planes parallel to it is m g / A, above the grain 0, and in between
    P_zz(z) = int_z^infinity rho g dz / A. No other component."""
    height, mass = DIAMETER / 2, DENSITY * np.pi / 6 * DIAMETER**3
    trough = (0.002, 0.004)
    place = np.array([[0.0399, 0.01, height]]) + [trough[0], 0, trough[1]]
    contacts = some_contacts([1], [0], [[0, 0, -height]], place, [[0, 0, mass * GRAVITY]])
    fields = fields_of(a_frame(place, np.zeros((1, 3)), trough=trough), contacts)
    stress, density = fields.profiles()["contact_stress"][0], fields.profiles()["density"][0]
    pressure = mass * GRAVITY / AREA
    assert math.isclose(stress[0, 2, 2], pressure, rel_tol=QUADRATURE), (stress[0, 2, 2], pressure)
    # The trapezoidal rule over a kernel of eight points across has an error of 2 % of its height, the weight.
    assert np.allclose(stress[:, 2, 2], integral_above(fields.grid, density) * GRAVITY, rtol=0, atol=0.02 * pressure)
    others = stress.copy()
    others[:, 2, 2] = 0
    assert np.abs(others).max() < 1e-12 * pressure and (fields["kinetic_stress"] == 0).all()
    assert abs(stress[fields.grid.z > height + DIAMETER, 2, 2]).max(initial=0) < 1e-12 * pressure


def check_a_lattice():
    """A simple cubic lattice of distance a whose rows along x carry the force f and whose columns carry q: far from its ends P_xx = f / a^2,
    P_zz = q / a^2, solid fraction = (pi / 6) (d / a)^3, P_xy = 0. A kernel as wide as two distances sees the lattice through its Fourier transform at
    k w = 4 pi, 384 J4(k w) / (k w)^4 < 0.004, twice."""
    a = 0.002
    at = np.stack(np.meshgrid((np.arange(20) + 0.5) * a, (np.arange(15) + 0.5) * a, (np.arange(15) + 0.5) * a, indexing="ij"), -1).reshape(-1, 3)
    f, q, numbers = 0.3, 0.7, np.arange(1, len(at) + 1)
    branches = np.concatenate([np.tile([a, 0, 0], (len(at), 1)), np.tile([0, 0, a], (len(at), 1))])
    forces = np.concatenate([np.tile([-f, 0, 0], (len(at), 1)), np.tile([0, 0, -q], (len(at), 1))])
    both = np.concatenate([numbers, numbers])
    contacts = some_contacts(both, both, branches, np.concatenate([at, at]), forces)
    fields = fields_of(a_frame(at, np.zeros_like(at), np.full(len(at), a / 2)), contacts, grid=a_grid(width=2 * a))
    inside = (fields.grid.z > 2.5 * a) & (fields.grid.z < 12 * a)
    stress = fields["contact_stress"][0][inside]
    assert np.allclose(stress[..., 0, 0], f / a**2, rtol=0.008) and np.allclose(stress[..., 2, 2], q / a**2, rtol=0.008)
    assert abs(stress[..., 0, 1]).max() < 1e-9 and np.allclose(fields["solid_fraction"][0][inside], np.pi / 6, rtol=0.008)


def check_momentum(cells=40):
    """div P = - sum_i F_i phi(r - r_i), point by point, with F_i the forces of all contacts on grain i, whatever these are: the balance of momentum
    but for what moves. Central differences on a grid of w / 40 are off by (w / 40)^2 / 6 times the third derivative, which is below
    25 times the largest slope over w^2: 0.3 % of it, and the slope of P is that of the forces' density."""
    kept, cg.CELLS_PER_WIDTH = cg.CELLS_PER_WIDTH, cells
    try:
        random, count = np.random.default_rng(5), 12
        places = some_places(count)
        places[:, 2] = random.uniform(0.0015, 0.008, count)
        first, second = np.concatenate([random.integers(1, 7, 10), [1, 2, 3]]), np.concatenate([random.integers(7, 13, 10), [0, 0, 0]])
        branch = random.normal(scale=0.001, size=(13, 3))
        branch[10:] = -np.eye(3)[2] * places[first[10:] - 1, 2][:, None] + random.normal(scale=1e-4, size=(3, 3))
        force = random.normal(size=(13, 3))
        grid = a_grid(top=0.012)
        contacts = some_contacts(first, second, branch, places[first - 1], force)
        stress = cg.contact_stress(contacts, grid, np.zeros(2))
        # The second grain is where the branch ends.
        pairs = second > 0
        ends = places[first - 1] + branch
        on_grains = grid.sum(places[first - 1][:, [0, 2]], None, force) - grid.sum(ends[pairs][:, [0, 2]], None, force[pairs])
        dz, dx = grid.steps
        divergence = (np.roll(stress, -1, axis=1) - np.roll(stress, 1, axis=1))[1:-1, ..., 0] / (2 * dx) + (stress[2:] - stress[:-2])[..., 2] / (2 * dz)
        error = abs(divergence + on_grains[1:-1]).max() / abs(on_grains).max()
        assert error < 0.02, error
    finally:
        cg.CELLS_PER_WIDTH = kept


def check_galilean_invariance():
    """Temperature and kinetic stress do not change when all grains, or the trough, move faster; the velocity does by just that, and the sum of
    kinetic and mean motion is sum m v v phi. Two grains at one place with velocities +-c in each direction have the temperature c^2."""
    random, places = np.random.default_rng(7), some_places(150)
    velocities, faster = random.normal(size=(150, 3)), np.array([0.7, -0.2, 1.1])
    one = fields_of(a_frame(places, velocities))
    for other in (fields_of(a_frame(places, velocities + faster)), fields_of(a_frame(places, velocities), trough_velocity=-faster)):
        for ours, theirs in ((dict(one), dict(other)), (one.profiles(), other.profiles())):
            # Differences of squares of velocities of 1 m/s lose the digits of the density's scale.
            scale = np.nanmax(ours["kinetic_stress"])
            assert np.allclose(ours["kinetic_stress"], theirs["kinetic_stress"], rtol=0, atol=1e-12 * scale)
            dense = ours["density"] > 1e-3 * ours["density"].max()
            assert np.allclose(ours["granular_temperature"][dense], theirs["granular_temperature"][dense], rtol=1e-9, atol=1e-9)
            assert np.allclose((theirs["velocity"] - ours["velocity"])[dense], faster, rtol=1e-9)
    c = 0.05
    pair = fields_of(a_frame(np.tile([0.02, 0.01, 0.01], (2, 1)), [[c, c, c], [-c, -c, -c]]))
    dense = pair["density"] > 0
    assert np.allclose(pair["granular_temperature"][pair["density"] > 1e-3 * pair["density"].max()], c**2, rtol=1e-9) and dense.any()


def moving_trough(t):
    return 0.0, 0.003 * math.sin(2 * math.pi * t / PERIOD)


def a_carried_layer(folder, cycles=2, per_cycle=4):
    """Four grains above one another, at rest on a trough that moves up and down: each contact carries m (g + a) of what is above."""
    heights = np.array([0.0015, 0.0045, 0.0075, 0.0105])
    places = np.column_stack([np.full(4, 0.0395), np.full(4, 0.01), heights])
    omega, mass = 2 * math.pi / PERIOD, DENSITY * np.pi / 6 * DIAMETER**3

    def grains(t):
        velocity = np.zeros((4, 3))
        velocity[:, 2] = 0.003 * omega * math.cos(omega * t)
        return places + [0, 0, moving_trough(t)[1]], velocity

    made = Maker(folder, cycles, per_cycle, np.full(4, DIAMETER / 2), grains, trough=moving_trough)
    phase = 2 * np.pi * np.arange(1, 101) / 100
    made.case.phases = lambda number: {"phase": phase, "trough_velocity_x": 0 * phase, "trough_velocity_z": 0.003 * omega * np.cos(phase)}
    for frame in range(cycles * per_cycle + 1):
        t = frame * PERIOD / per_cycle
        rise = moving_trough(t)[1]
        carried = mass * (GRAVITY - omega**2 * rise)
        pairs = [contact_row(places[i] + [0, 0, rise], places[i - 1] + [0, 0, rise], (0, 0, (4 - i) * carried), (i + 1, i, 0)) for i in (1, 2, 3)]
        floor = [contact_row((0.0395, 0.01, rise), places[0] + [0, 0, rise], (0, 0, 4 * carried), (0, 0, 1))]
        write_contacts(made, frame * STEPS // per_cycle, pairs, floor)
    made.case.packings = lambda: [made.open()]
    return made


def check_weight(folder):
    """The balance over a cycle: the mean stress at z is the weight above z. A carried layer has no velocity relative to the trough and no
    temperature, at any phase. The same by the observables of `observe`."""
    made = a_carried_layer(folder)
    fields = cg.measure(made.case)
    assert fields.frames == 2 and np.allclose(fields.phases, [0.25, 0.5, 0.75, 1])
    mean, weight = fields.mean().profiles(), 4 * DENSITY * np.pi / 6 * DIAMETER**3 * GRAVITY / AREA
    total = sum(mean[name][0, :, 2, 2] for name in ("contact_stress", "kinetic_stress", "convective_stress"))
    assert math.isclose(total[0], weight, rel_tol=QUADRATURE), (total[0], weight)
    # The dumps have all digits; the trapezoidal rule is off by 2 % of a grain's weight, as above.
    assert np.allclose(total, integral_above(fields.grid, mean["density"][0]) * GRAVITY, rtol=0, atol=0.02 * weight / 4)
    # From a Fourier series of the trough's motion.
    assert np.nanmax(abs(fields["velocity"])) < 1e-9 and np.nanmax(abs(fields["granular_temperature"])) < 1e-9
    cycle = made.open().cycles("contacts")[0]
    at, stress = observables.stress_profile(cycle)
    seen = at < fields.grid.top
    assert np.allclose(stress[seen], np.interp(at[seen], fields.grid.z, total), rtol=0, atol=1e-9 * weight)
    at, solid = observables.solid_fraction_profile(cycle)
    assert math.isclose(solid.sum() * np.diff(at)[0], 4 * np.pi / 6 * DIAMETER**3 / AREA, rel_tol=QUADRATURE)
    at, velocity = observables.velocity_profile(cycle)
    assert len(at) == len(velocity) and np.nanmax(abs(velocity)) < 1e-9 and np.isnan(velocity[-1])
    assert np.nanmax(abs(observables.temperature_profile(cycle)[1])) < 1e-9


def check_convection():
    """Grains that move in rolls, V = U + (-d psi/dz, d psi/dx) with psi = psi_0 sin(2 pi x / L) sin(pi z / H): the stream function is rho psi, but
    for the kernel, which weakens a wave of L = 13 w by (2 pi / 13)^2 / 20 = 1.2 % and one of 2 H by 1.6 %, and for the layer's ends."""
    psi0, height, a = 1e-5, 0.02, 0.001
    x, z = ((np.arange(n) + 0.5) * a for n in (40, 20))
    at = np.stack(np.meshgrid(x, [0.015], z, indexing="ij"), -1).reshape(-1, 3)
    k, q = 2 * np.pi / LENGTH, np.pi / height
    velocities = np.zeros_like(at)
    velocities[:, 0] = 0.3 - psi0 * q * np.sin(k * at[:, 0]) * np.cos(q * at[:, 2])
    velocities[:, 2] = psi0 * k * np.cos(k * at[:, 0]) * np.sin(q * at[:, 2])
    fields = fields_of(a_frame(at, velocities, np.full(len(at), a / 2)))
    psi, density = cg.stream_function(fields), fields["density"][0]
    inside = (fields.grid.z > DIAMETER) & (fields.grid.z < height - DIAMETER)
    wanted = density * psi0 * np.sin(k * fields.grid.x)[None, :] * np.sin(q * fields.grid.z)[:, None]
    error = abs(psi - wanted)[inside].max() / abs(wanted).max()
    assert error < 0.05, error


def check_files(folder):
    """What h5dump and VTK's own reader read is what was written."""
    fields = cg.measure(a_carried_layer(folder).case)
    files.write_hdf5(fields, folder / "fields.h5")
    path = files.write_vti(fields, folder)
    assert path.read_text().count("<DataSet") == 4 and "AppendedData" not in (folder / "fields.001.vti").read_text()
    if shutil.which("h5dump"):
        done = subprocess.run(["h5dump", "-d", "/profiles/contact_stress", "-s", "0,0,2,2", "-c", "1,1,1,1", "-y", "-m", "%.17g", folder / "fields.h5"],
                              capture_output=True, text=True, check=True)  # fmt: skip
        read = float(done.stdout.split("DATA {")[1].split("}")[0])
        assert read == fields.profiles()["contact_stress"][0, 0, 2, 2], done.stdout
        assert "mass per volume" in subprocess.run(["h5dump", "-A", folder / "fields.h5"], capture_output=True, text=True, check=True).stdout
    try:
        from vtk import vtkXMLImageDataReader
        from vtk.util.numpy_support import vtk_to_numpy
    except ImportError:
        print("SKIPPED: python3-vtk9 is not installed")
        return
    reader = vtkXMLImageDataReader()
    reader.SetFileName(str(folder / "fields.002.vti"))
    reader.Update()
    image, grid = reader.GetOutput(), fields.grid
    assert np.allclose(image.GetBounds(), [grid.x[0], grid.x[-1], 0, 0, grid.z[0], grid.z[-1]], rtol=1e-12)
    for name in fields:
        read = vtk_to_numpy(image.GetPointData().GetArray(name)).reshape(fields[name][1].shape)
        assert np.array_equal(read, np.nan_to_num(fields[name][1])), name


def check_refusals(folder):
    """A case without frames, or with a drive in stages, has no fields, and the reason is told; by hand with exit code 2."""
    made = a_carried_layer(folder)
    made.case.result["stage_cycles/time"] = [0.1, 0.2]
    for spoil, reason in ((lambda: None, "a drive with stages"), (lambda: (made.packing / "dump/frames.csv").unlink(), "output.frames_per_cycle = 20")):
        spoil()
        try:
            cg.measure(made.case)
        except cg.NoFields as error:
            assert reason in str(error), error
        else:
            raise AssertionError(f"was measured, without {reason}")
    for arguments, reason in (([folder / "nothing", folder], "nothing"), ([folder, folder, "--width", "-1"], "--width is a length above 0")):
        done = subprocess.run([sys.executable, "-B", "-m", "vibrotrough.field_files", *arguments], cwd=sys.argv[1], capture_output=True, text=True)
        assert done.returncode == 2 and reason in done.stderr and "Traceback" not in done.stderr, done


def check_half_frequency(folder):
    """Waves of half the frequency of the drive, standing or travelling, with amplitude and wavelength, in a layer that is conveyed; one with the
    frequency of the drive has no such part. A layer that is conveyed by way of v T in each cycle moves the waves by the same way."""
    columns, cycles, number, amplitude, moved = 16, 12, 3, 0.0005, 0.0017
    places = (np.arange(columns) + 0.5) * LENGTH / columns
    k = 2 * np.pi * number / LENGTH
    shapes = {"standing": lambda x, n: np.cos(k * x) * math.cos(math.pi * n), "travelling": lambda x, n: np.cos(k * x - math.pi * n),
              "drive": lambda x, n: np.cos(k * x) * math.cos(2 * math.pi * n)}  # fmt: skip
    for name, shape in shapes.items():
        made = Maker(folder, cycles, 1, np.full(2, 0.001), lambda t: (np.full((2, 3), 0.01) + [moved * t / PERIOD, 0, 0], np.zeros((2, 3))))
        lines = ["# Spatial-averaged data"]
        for step in range(0, cycles * STEPS + 1, 3 * STEPS // 10):
            height = 0.02 + amplitude * shape(places - moved * step / STEPS, step / STEPS)
            lines += [f"{step} {columns}"] + [f"{i + 1} {x!r} 5 700 {h / 2!r}" for i, (x, h) in enumerate(zip(map(float, places), map(float, height)))]
        made.write("surface.0.txt", "\n".join(lines) + "\n")
        found = observables.half_frequency_waves(made.open())
        assert np.isnan(found[:5]).all()
        if name == "drive":
            assert found[5:].max() < 1e-12, found
            continue
        assert np.allclose(found[5:], amplitude, rtol=1e-9), (name, found)
        assert np.allclose(observables.half_frequency_wavelength(made.open())[5:], LENGTH / number, rtol=1e-12)
        from vibrotrough.figures.fields import spectrum_of

        wave_numbers, frequencies, amplitudes = spectrum_of(made.open())
        row, column = np.unravel_index(amplitudes.argmax(), amplitudes.shape)
        assert math.isclose(frequencies[row], 0.5, rel_tol=1e-9) and math.isclose(wave_numbers[column], number / LENGTH)
        assert math.isclose(amplitudes[row, column], amplitude, rel_tol=1e-9), amplitudes[row, column]


def check_figures(folder):
    """Both figures are in the list, and their drawing functions are there."""
    from vibrotrough.figures import fields

    kinds = {row["kind"]: row for row in json.loads((pathlib.Path(sys.argv[1]) / "vibrotrough/figures/kinds.json").read_text())}
    for kind in ("fields", "waves"):
        assert kinds[kind]["module"] == "fields" and callable(getattr(fields, f"plot_{kind}"))
    # A layer of 12 mm at 15 Hz: f* = 15 sqrt(0.012 / 9.81) = 0.525, so that lambda / H = 1 + 1.1 x 2.34 = 3.58.
    assert math.isclose(fields.published_wavelength(15, 0.012), 0.012 * 3.576, rel_tol=1e-3)


def main():
    folder = pathlib.Path(sys.argv[2]) / "fields"
    for name, check in list(globals().items()):
        if name.startswith("check_"):
            check(*[folder][: check.__code__.co_argcount - len(check.__defaults__ or ())])
            print(name)
    shutil.rmtree(folder)


if __name__ == "__main__":
    main()
