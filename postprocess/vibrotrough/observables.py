"""Quantities that ship with the program, measured by `vibrotrough observe DIR`: examples for your own.

Copy this file (`vibrotrough observe --examples > my_observables.py`), keep what you need and change it. Each function that is marked as an
observable gets a cycle or a whole packing; help(vibrotrough.observable) and help(vibrotrough.frames) explain what these have.
"""

import numpy as np

import vibrotrough

SETTLED = 0.58  # solid fraction of a settled layer, if its height is taken as twice the height of its centre of mass, as the program does


def bins_over_height(packing):
    """Edges of slabs of one mean diameter, m, up to twice the height of the layer at rest: the same for all packings of a case."""
    diameter = packing.value("grain_diameter")
    height = packing.value("mass_per_area") / packing.value("grain_density") / SETTLED
    if not np.isfinite(height):  # grains leave, and the mass at rest is unknown: that of the first frame
        height = packing.frames[0].volumes.sum() / packing.frames[0].floor_area / SETTLED
    return diameter * np.arange(int(np.ceil(2 * height / diameter)) + 1)


@vibrotrough.observable(unit="m/s", of="packing")
def speed_of_grains(packing):
    """Mean velocity of the grains along the trough over a cycle, each with its volume: the conveying speed, from the frames."""
    n, place = packing.steps_per_cycle, {}
    for frame, positions in zip(packing.frames, packing.frames.unwrapped()):
        if frame.step % n == 0:  # at the ends of cycles, where the trough is back in its place
            place[frame.step // n] = np.average(positions[:, 0], weights=frame.volumes)
    return [(place[k] - place[k - 1]) / (packing.times[k] - packing.times[k - 1]) for k in (cycle.number for cycle in packing.cycles("frames"))]


@vibrotrough.observable(of="packing")
def segregation_index(packing):
    """Height of the last material's grains, or of the larger half of the grains, above all others over half the layer's height: 1 on top."""
    first = packing.frames[0]
    by_type = np.ptp(first.types) > 0
    if not by_type and np.ptp(first.radii) <= 1e-6 * first.radii.max():
        return None  # all grains are alike: there is nothing to measure
    middle, largest = np.median(first.radii), first.radii.max()

    def is_chosen(frame):
        if by_type:
            return frame.types == first.types.max()
        return frame.radii > middle if middle < largest else frame.radii == largest

    def index(frame):
        chosen = is_chosen(frame)  # grains may come and go
        if chosen.all() or not chosen.any():
            raise vibrotrough.GrainsChangeError("one of the two kinds of grains has left")
        heights, weights = frame.positions[:, 2], frame.volumes  # those of one material, whatever its density, have one mean height
        half_height = weights.sum() / frame.floor_area / SETTLED / 2
        return (np.average(heights[chosen], weights=weights[chosen]) - np.average(heights[~chosen], weights=weights[~chosen])) / half_height

    return [index(cycle.frames[-1]) for cycle in packing.cycles("frames")]


@vibrotrough.observable(unit="m2/s2")
def granular_temperature_of_frames(cycle):
    """A third of the mean square of the grains' velocities relative to the mean at their height (slabs of one diameter)."""
    edges = bins_over_height(cycle.packing)
    squares, freedom = 0.0, 0
    for frame in cycle.frames:
        slab = np.digitize(frame.heights, edges)
        for one in np.unique(slab):
            velocities = frame.velocities[slab == one]
            squares += ((velocities - velocities.mean(axis=0)) ** 2).sum()
            freedom += 3 * (len(velocities) - 1)  # the mean of n grains takes one of them: without bias in thin slabs
    return squares / freedom


def ends_of_cycles(packing):
    """Positions of the grains at the end of cycle 0, 1, ... relative to the centre of the layer, m: (cycles + 1, grains, 3)."""
    frames = packing.frames
    ends = [positions for step, positions in zip(frames.steps, frames.unwrapped()) if step % packing.steps_per_cycle == 0]
    places = np.array(ends[:len(packing.cycles("frames")) + 1])
    weights = frames[0].volumes
    return places - np.average(places, axis=1, weights=weights)[:, None, :]


@vibrotrough.observable(unit="m2", of="packing", over=("lag", "s"))
def mean_squared_displacement(packing):
    """Mean squared displacement of the grains within the layer over the time lag, at the ends of cycles."""
    places = ends_of_cycles(packing)
    count = len(places) - 1
    lags = np.arange(1, min(10, max(1, count // 3)) + 1)
    rows = np.full((count, len(lags)), np.nan)  # NaN at the beginning, while a lag does not fit: left out like start-up
    for i, lag in enumerate(lags):
        rows[lag - 1:, i] = ((places[lag:] - places[:-lag]) ** 2).sum(axis=2).mean(axis=1)
    return lags * packing.steps_per_cycle * packing.time_step, rows


@vibrotrough.observable(unit="m2/s", of="packing")
def dispersion(packing):
    """Coefficient of dispersion along the trough: variance of the grains' displacements within the layer in five cycles over twice their time."""
    places = ends_of_cycles(packing)
    lag = min(5, max(1, (len(places) - 1) // 3))
    values = np.full(len(places) - 1, np.nan)
    values[lag - 1:] = (places[lag:, :, 0] - places[:-lag, :, 0]).var(axis=1) / (2 * lag * packing.steps_per_cycle * packing.time_step)
    return values


@vibrotrough.observable(needs="contacts")
def coordination_number(cycle):
    """Mean contacts per grain, with other grains (counted for both) and with the trough, over the frames of a cycle."""
    counts = [2 * (contacts.second > 0).sum() + (contacts.second == 0).sum() for contacts in cycle.contacts]
    return np.sum(counts) / sum(len(frame.positions) for frame in cycle.frames)


@vibrotrough.observable(needs="contacts", over=("force over mean force", "1"))
def force_distribution(cycle):
    """Probability density of the normal forces between grains over their mean, of all contacts in the frames of a cycle."""
    edges = np.linspace(0, 6, 25)
    forces = np.concatenate([np.linalg.norm(one.normal_force[one.second > 0], axis=1) for one in cycle.contacts])
    if len(forces) == 0:
        return (edges[:-1] + edges[1:]) / 2, np.full(len(edges) - 1, np.nan)
    share, _ = np.histogram(forces / forces.mean(), edges)
    return (edges[:-1] + edges[1:]) / 2, share / len(forces) / np.diff(edges)


def profile(cycle, take, with_contacts=False):
    """Heights, and what `take` makes of the coarse-grained profiles in the frame of the trough: see help(vibrotrough.fields)."""
    height, found = vibrotrough.fields.profiles_of_cycle(cycle.packing, cycle.number, bins_over_height(cycle.packing)[-1], with_contacts)
    return height, take(found)


@vibrotrough.observable(over=("height", "m"))
def solid_fraction_profile(cycle):
    """Volume of the grains per volume over the height above the trough, by coarse graining with a kernel of one diameter."""
    return profile(cycle, lambda found: found["solid_fraction"])


@vibrotrough.observable(unit="m/s", over=("height", "m"))
def velocity_profile(cycle):
    """Mean velocity along the trough and relative to it, of the mass, over the height above it."""
    return profile(cycle, lambda found: found["velocity"][:, 0])


@vibrotrough.observable(unit="m2/s2", over=("height", "m"))
def temperature_profile(cycle):
    """Granular temperature over the height above the trough: a third of the mean square of velocities relative to the mean at that height and moment."""
    return profile(cycle, lambda found: found["granular_temperature"])


@vibrotrough.observable(unit="Pa", needs="contacts", over=("height", "m"))
def stress_profile(cycle):
    """Normal stress by contacts and by velocities relative to the trough, over the height above it; the lowest is the force on the floor."""
    return profile(cycle, lambda found: sum(found[name][:, 2, 2] for name in ("contact_stress", "kinetic_stress", "convective_stress")), with_contacts=True)


def surface_snapshots(folder):
    """Steps, middles of the columns [m] and heights of the surface [m], a row for each snapshot that the engine wrote of the surface along
    the trough (surface.STEP.txt, a file for each start of the engine; what a later start repeated replaces the earlier one)."""
    heights, places = {}, np.empty(0)
    for path in sorted(folder.glob("surface.*.txt"), key=lambda one: int(one.name.split(".")[1])):
        lines = [line.split() for line in vibrotrough.read_regular(path).decode("ascii").splitlines() if not line.startswith("#")]
        row = 0
        while row < len(lines):
            columns = int(lines[row][1])
            table = lines[row + 1:row + 1 + columns]
            if len(table) == columns:
                values = np.array(table, dtype=float)
                places = values[:, 1]
                heights[int(lines[row][0])] = 2.0 * values[:, 4]  # a column is twice as high as its grains' mean
            row += 1 + columns
    steps = sorted(heights)
    return np.array(steps), places, np.array([heights[step] for step in steps])


def wave_parts(places, heights, length):
    """Fourier components of the surface in a box of this length, (snapshots, waves): the one with n waves in the box is column n - 1, and
    twice its size is the amplitude."""
    numbers = np.arange(1, len(places) // 2)
    deviation = heights - heights.mean(axis=1, keepdims=True)
    return deviation @ np.exp(-2j * np.pi * np.outer(places, numbers) / length) / len(places)


@vibrotrough.observable(unit="m", needs="surface.0.txt", of="packing")
def surface_waves(packing):
    """Amplitude of the strongest wave of the surface along the trough: root mean square over the ten phases, seen in three cycles."""
    steps, places, heights = surface_snapshots(packing.folder)
    if len(places) < 4:
        return None  # the box is too short for a wave
    length = len(places) * (places[1] - places[0])
    squares = (2 * np.abs(wave_parts(places, heights, length))) ** 2
    strongest = squares[:, squares.mean(axis=0).argmax()]
    count = len(packing.cycles())
    values = np.full(count, np.nan)  # NaN at the beginning: left out like start-up
    for k in range(3, count + 1):
        seen = (steps > (k - 3) * packing.steps_per_cycle) & (steps <= k * packing.steps_per_cycle)
        values[k - 1] = np.sqrt(strongest[seen].mean())
    return values


WINDOW = 20  # snapshots, which are six cycles: three periods of half the frequency of the drive


def surface_in_layer(packing):
    """Waves of the surface as wave_parts gives them, but in a frame that moves with the layer from cycle to cycle; their numbers in the
    box over its length [1/m], and the times of the snapshots in cycles. None when the box is too short for a wave."""
    steps, places, heights = surface_snapshots(packing.folder)
    if len(places) < 4 or len(steps) < WINDOW:
        return None
    length = len(places) * (places[1] - places[0])
    parts = wave_parts(places, heights, length)
    wave_numbers = np.arange(1, parts.shape[1] + 1) / length
    series = packing.table("cycles.csv")
    way = np.append(0, np.cumsum(series["mean_vx"][1:])) * packing.steps_per_cycle * packing.time_step
    moved = np.interp(steps, series["step"], way)
    return parts * np.exp(2j * np.pi * np.outer(moved, wave_numbers)), wave_numbers, steps / packing.steps_per_cycle


def half_frequency_parts(packing):
    """Wave numbers [1/m], and for each cycle the amplitude of the waves with half the frequency of the drive, standing or not, seen in the six
    cycles that end: (cycles, waves), NaN before. None as above."""
    found = surface_in_layer(packing)
    if found is None:
        return None
    parts, wave_numbers, cycles = found
    amplitudes = np.full((len(packing.cycles()), len(wave_numbers)), np.nan)
    for k in range(6, len(amplitudes) + 1):
        seen = (cycles > k - 6 + 1e-9) & (cycles <= k + 1e-9)
        turn = np.exp(1j * np.pi * cycles[seen])
        amplitudes[k - 1] = 2 * (abs((parts[seen] * turn[:, None]).mean(axis=0)) + abs((parts[seen] / turn[:, None]).mean(axis=0)))
    return wave_numbers, amplitudes


@vibrotrough.observable(unit="m", needs="surface.0.txt", of="packing")
def half_frequency_waves(packing):
    """Amplitude of the strongest wave of the surface along the trough that repeats itself after two cycles, seen in six cycles."""
    found = half_frequency_parts(packing)
    return None if found is None else found[1].max(axis=1)


@vibrotrough.observable(unit="m", needs="surface.0.txt", of="packing")
def half_frequency_wavelength(packing):
    """Wavelength of half_frequency_waves, which says whether there are any; the box holds a whole number of them."""
    found = half_frequency_parts(packing)
    if found is None:
        return None
    wave_numbers, amplitudes = found
    known = np.isfinite(amplitudes).all(axis=1)
    lengths = np.full(len(amplitudes), np.nan)
    lengths[known] = 1 / wave_numbers[amplitudes[known].argmax(axis=1)]
    return lengths
