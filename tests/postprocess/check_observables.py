"""The shipped observables, on frames, contacts and surfaces that are made by hand, against the equations that define them; and what the module
makes of the engine's files.

usage: check_observables.py POSTPROCESS FOLDER

The files are written with all digits, so that only the rounding of doubles is tolerated.
"""

import math
import pathlib
import shutil
import sys

import numpy as np

sys.path.insert(0, sys.argv[1])
from vibrotrough import observables  # noqa: E402
from vibrotrough.frames import Packing  # noqa: E402

STEPS, TIME_STEP = 1000, 6.5e-5  # of a cycle; s
PERIOD = STEPS * TIME_STEP
LENGTH, WIDTH, DIAMETER = 0.04, 0.03, 0.003
SETTLED = 0.58


class Result(dict):
    """What result.h5 says of the case."""

    path = pathlib.Path("result.h5")


class Case:
    def __init__(self, folder, cycles, layer=0.02):
        self.folder = folder
        self.result = Result({"packings/seed": [1], "packings/steps_per_cycle": [STEPS], "packings/time_step": [TIME_STEP],
                              "packings/cycles_discarded": [0], "packings/cycles_measured": [cycles], "case/grain_diameter": DIAMETER,
                              "case/grain_density": 1400.0, "case/mass_per_area": 1400 * SETTLED * layer})  # fmt: skip

    def phases(self, packing):
        """The trough is at rest, even where it is moved from frame to frame."""
        phase = 2 * np.pi * np.arange(1, 101) / 100
        return {"phase": phase, "trough_velocity_x": 0 * phase, "trough_velocity_z": 0 * phase}


def dump(columns, rows, what, step):
    lines = ["ITEM: TIMESTEP", str(step), f"ITEM: NUMBER OF {what}", str(len(rows)), "ITEM: BOX BOUNDS pp pp ff",
             f"0 {LENGTH!r}", f"0 {WIDTH!r}", "-0.01 0.3", f"ITEM: {'ATOMS' if what == 'ATOMS' else 'ENTRIES'} {columns} "]  # fmt: skip
    return "\n".join(lines + [" ".join(repr(float(value)) for value in row) + " " for row in rows]) + "\n"


class Maker:
    """Makes the files of a packing. `grains(time)` gives positions that go on beyond the box, and velocities."""

    def __init__(self, folder, cycles, per_cycle, radii, grains, types=None, trough=lambda time: (0.0, 0.0)):
        shutil.rmtree(folder, ignore_errors=True)
        self.packing = folder / "packing-1"
        (self.packing / "dump").mkdir(parents=True)
        self.case = Case(folder, cycles)
        types = np.ones(len(radii)) if types is None else types
        positions, way, last = [], ["step,x_com,z_com,mean_vx"], 0.0
        for frame in range(cycles * per_cycle + 1):
            step = frame * STEPS // per_cycle
            at, velocities = grains(step * TIME_STEP)
            wrapped = at.copy()
            wrapped[:, 0] %= LENGTH
            wrapped[:, 1] %= WIDTH
            rows = np.column_stack([np.arange(1, len(at) + 1), types, wrapped, velocities, radii, np.zeros((len(at), 3))])
            rows = rows[np.random.default_rng(step).permutation(len(rows))]  # the engine may write them in any order
            self.write(f"dump/frames.{step}.dump", dump("id type x y z vx vy vz radius omegax omegay omegaz", rows, "ATOMS", step))
            x, z = trough(step * TIME_STEP)
            positions.append(f"{step},{x!r},{z!r}")
            if step % STEPS == 0:  # as of clumps: the velocity is right, and the centre of mass starts again at the end of the box
                mean = float(np.average(at[:, 0], weights=np.asarray(radii) ** 3))
                way.append(f"{step},{mean % LENGTH!r},0,{(mean - last) / PERIOD!r}")
                last = mean
        self.write("dump/frames.csv", "# SI units\nstep,trough_x,trough_z\n" + "\n".join(positions) + "\n")
        self.write("cycles.csv", "\n".join(way) + "\n")

    def write(self, name, text):
        (self.packing / name).write_text(text)

    def open(self):
        return Packing(self.case, 1)


def some_places(count, seed=1):
    random = np.random.default_rng(seed)
    return random.uniform([0, 0, 0.002], [LENGTH, WIDTH, 0.02], (count, 3))


def check_speed(folder):
    """v = sum(V_i v_i) / sum(V_i): grains of two sizes that move at 0.5 and 0.2 m/s, through the periodic end many times, a frame per cycle."""
    radii = np.repeat([0.001, 0.002], 20)
    start, speed = some_places(40), np.repeat([0.5, 0.2], 20)
    cycles = 12
    # In a cycle the grains move 32 and 13 mm in a box of 40 mm, but relative to the layer's mean less than half of it.
    for per_cycle in (1, 4):
        made = Maker(folder, cycles, per_cycle, radii, lambda t: (start + np.outer(speed * t, [1, 0, 0]), np.outer(speed, [1, 0, 0])))
        found = observables.speed_of_grains(made.open())
        wanted = (1 * 0.5 + 8 * 0.2) / 9
        assert len(found) == cycles and np.allclose(found, wanted, rtol=1e-11), (found, wanted)


def check_segregation(folder):
    """S = (z_upper - z_others) / (H / 2) is 1 where the larger half lies on top, and -1 where it lies below; by material, not by size, where there
    are two. H = sum(V) / (area x solid fraction)."""
    radii = np.repeat([0.001, 0.0012], 200)
    height = (4 / 3 * np.pi * radii**3).sum() / (LENGTH * WIDTH) / SETTLED
    places = some_places(400)
    for upper, wanted in ((200, 1.0), (0, -1.0)):
        # Halves of the height, whose centres are H/2 apart.
        places[:, 2] = height / 4
        places[upper:upper + 200, 2] = 3 * height / 4
        for types in (None, np.repeat([1, 3], 200)):
            made = Maker(folder, 3, 1, radii, lambda t: (places, np.zeros((400, 3))), types)
            assert np.allclose(observables.segregation_index(made.open()), wanted, rtol=1e-12)
    made = Maker(folder, 3, 1, np.full(400, 0.001), lambda t: (places, np.zeros((400, 3))))
    assert observables.segregation_index(made.open()) is None, "grains that are all alike"


def check_temperature(folder):
    """T = sum |v - V|^2 / (3 (n - 1)) over the n grains of each slab, summed over slabs: with velocities V(z) +- c in each direction, half of
    the grains each, T = c^2 n / (n - 1), whatever the shear V(z) is."""
    count, slabs, c = 10, 4, 0.05
    places = some_places(count * slabs)
    places[:, 2] = DIAMETER * (np.repeat(np.arange(slabs), count) + 0.5)
    velocities = c * np.repeat(np.tile([1, -1], count * slabs // 2)[:, None], 3, axis=1)
    velocities[:, 0] += 30 * places[:, 2]
    made = Maker(folder, 2, 2, np.full(len(places), DIAMETER / 2), lambda t: (places, velocities))
    for cycle in made.open().cycles("frames"):
        assert math.isclose(observables.granular_temperature_of_frames(cycle), c**2 * count / (count - 1), rel_tol=1e-12)
    # Slabs are those above the trough: where it is by a diameter higher, so are the grains.
    made = Maker(folder, 2, 2, np.full(len(places), DIAMETER / 2), lambda t: (places + [0, 0, DIAMETER], velocities), trough=lambda t: (0.0, DIAMETER))
    assert math.isclose(observables.granular_temperature_of_frames(made.open().cycles("frames")[0]), c**2 * count / (count - 1), rel_tol=1e-12)


def check_displacement(folder):
    """Grains that move apart at +-u along x within a layer that is conveyed: MSD(n) = (n u T)^2, and the coefficient of dispersion over five cycles
    is (5 u T)^2 / (2 x 5 T)."""
    u, cycles = 0.01, 18
    apart = np.tile([u, -u], 15)
    start = some_places(30)
    made = Maker(folder, cycles, 2, np.full(30, 0.001), lambda t: (start + np.outer((apart + 0.3) * t, [1, 0, 0]), np.zeros((30, 3))))
    packing = made.open()
    lag, rows = observables.mean_squared_displacement(packing)
    assert np.allclose(lag, PERIOD * np.arange(1, 7), rtol=1e-12) and rows.shape == (cycles, 6)
    for n in range(1, 7):
        assert np.isnan(rows[:n - 1, n - 1]).all()
        assert np.allclose(rows[n - 1:, n - 1], (n * u * PERIOD) ** 2, rtol=1e-9), rows
    found = observables.dispersion(packing)
    assert np.isnan(found[:4]).all() and np.allclose(found[4:], (5 * u * PERIOD) ** 2 / (10 * PERIOD), rtol=1e-9)


def contact_row(first, second, force, numbers, tangential=(0, 0, 0)):
    return [*first, *second, *numbers, *force, *tangential, 1e-6]


def write_contacts(made, step, pairs, floor):
    columns = " ".join(f"c_one[{i}]" for i in range(1, 17))
    made.write(f"dump/contacts.{step}.dump", dump(columns, pairs, "ENTRIES", step))
    made.write(f"dump/trough_contacts.{step}.dump", dump(columns, floor, "ENTRIES", step))


def check_forces(folder):
    """Half of the forces 1 N, half 3 N: their mean is 2 N, so that the density is 1/2 over the width of a bin, 2, in the bins that hold 0.5 and 1.5.
    Contacts with the trough do not count."""
    made = Maker(folder, 2, 2, np.full(4, 0.001), lambda t: (np.full((4, 3), 0.01), np.zeros((4, 3))))
    for step in range(0, 2 * STEPS + 1, STEPS // 2):
        # Of the size 1 and 3, in any direction.
        pairs = [contact_row((0, 0, 0), (0, 0, 1), force, (1, 2, 0)) for force in ((1, 0, 0), (0, -1, 0), (0, 0, 3), (1, -2, 2))]
        write_contacts(made, step, pairs, [contact_row((0, 0, 0), (0, 0, 1), (0, 0, 50), (0, 0, 1))])
    for cycle in made.open().cycles("contacts"):
        at, density = observables.force_distribution(cycle)
        wanted = np.zeros(24)
        wanted[[2, 6]] = 2  # from 0.5 and from 1.5 on
        assert np.allclose(density, wanted, rtol=1e-12) and np.allclose(at[[2, 6]], [0.625, 1.625])
        assert math.isclose((density * 0.25).sum(), 1)
        assert observables.coordination_number(cycle) == 2.25  # four contacts of four grains, and one with the trough


def check_stress(folder):
    """A column of grains at rest: a plane at z carries the weight of what is above it, sum_i w_i int_z^infinity phi_1(z' - z_i) dz' / area, where phi_1 =
    128 / (35 pi w) (1 - z^2/w^2)^(7/2) is the kernel's integral along x. Once in steps over a periodic end, and on a trough that is somewhere else.
    Sums over the grid along x differ from integrals by less than 6e-4, see check_fields.py."""
    weights = np.array([1.0, 2.0, 0.5, 4.0])
    heights = np.array([0.0013, 0.0041, 0.0066, 0.0092])
    places = np.column_stack([[0.0395, 0.0005, 0.0395, 0.0005], np.full(4, 0.01), heights + 0.002])
    made = Maker(folder, 1, 2, np.full(4, 0.0015), lambda t: (places, np.zeros((4, 3))), trough=lambda t: (0.001, 0.002))
    above = np.cumsum(weights[::-1])[::-1]  # of each grain and what lies on it
    for step in (0, STEPS // 2, STEPS):
        # Each grain rests on the one below, with a sideways force that balances and a share of the weight by friction.
        pairs = []
        for i in range(1, 4):
            force, friction = np.array([0.7, 0, 0.75 * above[i]]), np.array([-0.7, 0, 0.25 * above[i]])
            upper, lower = (places[i], i + 1), (places[i - 1], i)
            first, second, sign = (upper, lower, 1) if i % 2 else (lower, upper, -1)
            pairs.append(contact_row(first[0], second[0], sign * force, (first[1], second[1], 1), sign * friction))
        write_contacts(made, step, pairs, [contact_row((0.0395, 0.01, 0.002), places[0], (0, 0, above[0]), (0, 3, 1))])
    at, stress = observables.stress_profile(made.open().cycles("contacts")[0])
    fine = DIAMETER * (np.arange(2000) + 0.5) / 1000 - DIAMETER
    kernel = 128 / (35 * np.pi * DIAMETER) * (1 - (fine / DIAMETER) ** 2) ** 3.5 * DIAMETER / 1000
    wanted = np.array([sum(weight * kernel[fine > z - height].sum() for weight, height in zip(weights, heights)) for z in at]) / (LENGTH * WIDTH)
    # A plane may lie anywhere within a thousandth of the diameter, where the kernel is highest.
    assert np.allclose(stress, wanted, rtol=0, atol=6e-4 * wanted[0] + 0.5 * kernel.max() * weights.sum() / (LENGTH * WIDTH)), (stress, wanted)
    contacts = made.open().contacts[0]
    assert np.allclose(abs(contacts.branch[:3, 0]), 0.001), "to the image that is touched"


def check_waves(folder):
    """A surface h + a(t) cos(2 pi n x / L) has waves of the amplitude a: the root mean square over the snapshots of three cycles."""
    made = Maker(folder, 6, 1, np.full(2, 0.001), lambda t: (np.full((2, 3), 0.01), np.zeros((2, 3))))
    columns, steps = 16, range(0, 6 * STEPS + 1, 3 * STEPS // 10)
    places = (np.arange(columns) + 0.5) * LENGTH / columns

    def amplitude(step):
        return 0.001 + 0.0005 * math.cos(math.pi * step / STEPS)

    def text(part):
        lines = ["# Spatial-averaged data"]
        for step in part:
            height = 0.02 + amplitude(step) * np.cos(2 * np.pi * 3 * places / LENGTH)
            lines += [f"{step} {columns}"] + [f"{i + 1} {x!r} 5 700 {h / 2!r}" for i, (x, h) in enumerate(zip(map(float, places), map(float, height)))]
        return "\n".join(lines) + "\n"

    # The run went on from a checkpoint after three cycles, and repeated what was written after it.
    made.write("surface.0.txt", text(steps[:13]) + f"{steps[13]} {columns}\n1 0.1 5")
    made.write(f"surface.{3 * STEPS}.txt", text(steps[10:]))
    found = observables.surface_waves(made.open())
    for k in range(3, 7):
        seen = [amplitude(step) for step in steps if (k - 3) * STEPS < step <= k * STEPS]
        assert math.isclose(found[k - 1], math.sqrt(np.mean(np.square(seen))), rel_tol=1e-12), (k, found)
    assert np.isnan(found[:2]).all()


def expect_missing(cure, read):
    try:
        read()
    except FileNotFoundError as error:
        assert cure in str(error), error
        return
    raise AssertionError(f"was read, without {cure}")


def check_reading(folder):
    """Frames are read when they are asked for; a damaged one is named; tables count a repeated step once."""
    start = some_places(5)
    made = Maker(folder, 2, 2, np.full(5, 0.001), lambda t: (start, np.full((5, 3), t)))
    packing = made.open()
    frames = packing.frames
    assert len(frames) == 5 and frames[2].cycle == 1 and math.isclose(frames[-1].time, 2 * PERIOD)
    assert np.allclose(frames[1].positions, start) and list(frames[1].ids) == [1, 2, 3, 4, 5]
    assert [one.step for one in frames[1:3]] == [500, 1000] and len(packing.cycles("frames")[1].frames) == 2
    assert packing.cycles("frames")[1].start.step == 1000
    assert repr(frames[1]) == f"<Frame: step 500, cycle 0.5, {PERIOD / 2:.6g} s, 5 grains>", repr(frames[1])
    # What was not kept is told at once, with the line of the campaign file that keeps it.
    expect_missing("output.contacts = true", lambda: made.open().contacts)
    kept = (made.packing / "dump/frames.csv").read_text()
    (made.packing / "dump/frames.csv").unlink()
    expect_missing('output.frame_packings = "all"', lambda: made.open().frames)
    expect_missing('output.frame_packings = "all"', lambda: made.open().contacts)
    made.write("dump/frames.csv", kept)
    made.write("dump/frames.1000.dump", (made.packing / "dump/frames.1000.dump").read_text()[:-40])
    try:
        made.open().frames[2]
    except ValueError as error:
        assert "frames.1000.dump is not a whole dump" in str(error), error
    else:
        raise AssertionError("a cut frame was read")
    made.write("own.csv", "# a comment\nstep,power\n0,1.5\n1000,2.5\n# another start\n1000,3.5\n2000,4.5\n3000,5")
    assert list(packing.table("own.csv")["power"]) == [1.5, 3.5, 4.5], "the last line of a step counts, and no half line"


def main():
    folder = pathlib.Path(sys.argv[2]) / "observables"
    for name, check in list(globals().items()):
        if name.startswith("check_"):
            check(folder)
            print(name)
    shutil.rmtree(folder)


if __name__ == "__main__":
    main()
