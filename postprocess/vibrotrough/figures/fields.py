"""Fields of a layer by coarse graining, with their equations in vibrotrough.fields, and waves of its surface, as figures of each case.

The fields are those of the frames that output.contacts keeps the contacts of; a case without gives no figure. OUT/data/fields/ID then
holds them as HDF5 and for ParaView.
"""

import pathlib
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from .. import field_files, observables
from .. import fields as coarse_grained
from ..campaign import Case
from ..results import File
from .source import Source
from .style import COLOURS, DASHES, GREY, case_title, corner, new_figure, plain_axes, points, save

Floats = NDArray[np.float64]
MILLI = 1e3
GRAVITY = 9.81  # m/s2, of the decks
MAP_PHASES = (1 / 4, 1 / 2, 1.0)  # cycles
FEWEST_WAVES = 4  # of different length, for which the box needs about 15 diameters
SPARSE = 0.05  # solid fraction below which no velocity is drawn
STRESSES = ("contact_stress", "kinetic_stress", "convective_stress")


def plot_fields(source: Source, case: str, result: File, output: pathlib.Path) -> list[pathlib.Path]:
    packings = [one for one in Case(result.path.parent).packings() if one.has("contacts")]
    if not packings:
        return []
    try:
        fields = coarse_grained.measure(packings[0].case, packings)
    except coarse_grained.NoFields:
        return []
    folder = source.data / "fields" / case
    folder.mkdir(parents=True, exist_ok=True)
    field_files.write_hdf5(fields, folder / "fields.h5")
    field_files.write_vti(fields, folder)
    figure, axes = new_figure(2, 4, size=(11.0, 7.2), sharey=True)
    weight = float(result["case/mass_per_area"]) * GRAVITY * float(np.cos(result["case/inclination"]))
    draw_profiles(axes[0], fields, weight)
    draw_maps(figure, axes[1], fields)
    finish(figure, source, case, fields, [*zip(*axes[0, 2].get_legend_handles_labels()), *zip(*axes[0, 3].get_legend_handles_labels())])
    return save(figure, output)


def draw_profiles(axes: Any, fields: coarse_grained.Fields, weight: float) -> None:
    """The mean over the cycle, and the range of the phases in which there are grains at that height."""
    height, phases, mean = MILLI * fields.grid.z, fields.profiles(), fields.mean().profiles()
    scarce = mean["solid_fraction"][0] < 1e-3
    there = phases["solid_fraction"] >= 0.01
    for one, name, component in ((axes[0], "solid_fraction", None), (axes[1], "velocity", 0), (axes[2], "granular_temperature", None)):
        values, line = phases[name], mean[name][0]
        if component is not None:
            values, line = values[..., component], line[..., component]
        values = np.where(there, values, np.nan) if name != "solid_fraction" else values
        known = np.isfinite(values).any(axis=0)
        one.fill_betweenx(height[known], np.nanmin(values[:, known], axis=0), np.nanmax(values[:, known], axis=0), color=COLOURS[5], alpha=0.3,
                          linewidth=0, label="range over the cycle")  # fmt: skip
        one.plot(np.where(scarce, np.nan, line), height, color=COLOURS[0], label="mean over the cycle")
    parts = [mean[name][0, :, 2, 2] for name in STRESSES]
    curves = ((np.sum(parts, axis=0), "", 0), (parts[0], "stress by contacts", 1), (parts[1], "kinetic stress", 2),
              (parts[2], "stress by the mean motion", 3))  # fmt: skip
    for values, name, style in curves:
        axes[3].plot(values, height, color=COLOURS[style], linestyle=DASHES[style], label=name)
    axes[3].axvline(weight, color=GREY, linewidth=1, linestyle=DASHES[3], label="weight of the layer")
    titles = ("solid fraction  [-]", "velocity along\nthe trough  [m/s]", "granular temperature\n[m\u00b2/s\u00b2]", "normal stress  [Pa]")
    for one, title in zip(axes, titles):
        plain_axes(one)
        one.set_xlabel(title)
        one.axhline(0, color=GREY, linewidth=0.8)
    axes[0].set_xlim(left=0)
    axes[0].set_ylabel("height above the trough  [mm]")
    axes[0].set_ylim(height[0], height[~scarce][-1])


def draw_maps(figure: Figure, axes: Any, fields: coarse_grained.Fields) -> None:
    """Solid fraction with the velocity relative to the mean one at three phases, and streamlines of the mean over the cycle."""
    along, height, everything = MILLI * fields.grid.x, MILLI * fields.grid.z, dict(fields)
    largest = everything["solid_fraction"].max()
    extent = (0, MILLI * fields.grid.length, height[0] - np.diff(height[:2])[0] / 2, height[-1] + np.diff(height[:2])[0] / 2)
    places = [int(np.abs(fields.phases - phase).argmin()) for phase in MAP_PHASES]
    dense = everything["velocity"][places][everything["solid_fraction"][places] > SPARSE]
    fastest = np.linalg.norm(dense, axis=-1).max(initial=0)
    picture = None
    for one, place in zip(axes, places):
        solid, velocity = everything["solid_fraction"][place], everything["velocity"][place]
        picture = one.imshow(solid, origin="lower", extent=extent, aspect="auto", cmap="cividis", vmin=0, vmax=largest, interpolation="nearest")
        step = max(1, len(along) // 10)
        chosen = np.ix_(np.arange(step // 2, len(height), step), np.arange(step // 2, len(along), step))
        speed = np.where((solid > SPARSE)[..., None], velocity, np.nan)[chosen]
        at_x, at_z = np.meshgrid(along[chosen[1].ravel()], height[chosen[0].ravel()])
        one.quiver(at_x, at_z, speed[..., 0], speed[..., 2], color="white", pivot="mid", width=0.006, scale=8 * max(fastest, 1e-12))
        one.set_title(f"solid, t / T = {fields.phases[place]:.3g}", fontsize=points(8))
    draw_streamlines(axes[3], fields, along, height)
    for one in axes:
        one.set_xlabel("x  [mm]")
        one.set_xlim(extent[:2])
    axes[0].set_ylabel("height above the trough  [mm]")
    if picture is not None:
        picture.axes.figure.colorbar(picture, ax=axes[2], fraction=0.08, label="solid fraction  [-]")


def draw_streamlines(axes: Axes, fields: coarse_grained.Fields, along: Floats, height: Floats) -> None:
    """Of the mass, relative to the layer's mean velocity: closed ones are convection. Where psi depends on z alone, the layer shears."""
    psi, mean = coarse_grained.stream_function(fields), fields.mean()["solid_fraction"][0]
    extent = (0, MILLI * fields.grid.length, 2 * height[0] - height[1], height[-1])
    axes.imshow(mean, origin="lower", extent=extent, aspect="auto", cmap="Greys", vmin=0, vmax=1.5 * mean.max(), interpolation="nearest")
    if np.ptp(psi) > 0:
        axes.contour(along, height, np.where(mean > 0.02, psi, np.nan), levels=12, colors=COLOURS[1], linewidths=0.8)
    axes.set_title("streamlines of the mean", fontsize=points(8))


def finish(figure: Figure, source: Source, case: str, fields: coarse_grained.Fields, legend: list[tuple[Any, Any]]) -> None:
    figure.suptitle(case_title(source.row_of(case)), fontsize=points(10))
    height = figure.get_size_inches()[1]
    figure.legend(*zip(*legend), ncols=3, loc="upper center", frameon=False, fontsize=points(8), bbox_to_anchor=(0.5, 1 - 0.2 / height))
    corner(figure, source.attributes, f"width of the kernel {MILLI * fields.grid.kernel.width:.3g} mm; arrows: velocity in the trough")
    figure.tight_layout(rect=(0, 0.03, 1, 1 - 0.55 / height))


def spectrum_of(packing: Any) -> tuple[Floats, Floats, Floats] | None:
    """Wave numbers [1/m], frequencies over that of the drive, and amplitudes [m] of the waves of the surface, (frequencies, waves), from the end
    of the start-up on. None when the box or the run is too short."""
    found = observables.surface_in_layer(packing)
    if found is None:
        return None
    parts, wave_numbers, cycles = found
    start = int(packing.result["packings/cycles_discarded"][packing.number - 1])
    seen = (cycles > start) & (cycles <= packing.result_cycles)
    count = int(seen.sum()) // observables.WINDOW * observables.WINDOW  # so that half the frequency of the drive is one of the spectrum
    if count == 0:
        return None
    window = np.hanning(count + 1)[:-1]
    lines = np.fft.fft(parts[seen][-count:] * window[:, None], axis=0) / window.sum()
    half = count // 2
    both = np.abs(lines[: half + 1])
    both[1:half] += np.abs(lines[: half:-1])  # waves that travel forwards, and backwards
    frequencies = np.arange(half + 1) / count / np.diff(cycles[seen])[0]
    return wave_numbers, frequencies, 2 * both


def published_wavelength(frequency: float, depth: float) -> float:
    """Wavelength of f/2 patterns of a vertically vibrated layer, m: lambda / H = 1.0 + 1.1 (f sqrt(H / g))^-1.32 (P.B. Umbanhowar, H.L. Swinney,
    Physica A 288, 2000, 344-362), where the grains are mobile.

    @param frequency  of the drive, Hz
    @param depth      H of the layer at rest, m
    """
    return depth * (1.0 + 1.1 * (frequency * np.sqrt(depth / GRAVITY)) ** -1.32)


def plot_waves(source: Source, case: str, result: File, output: pathlib.Path) -> list[pathlib.Path]:
    packings = [one for one in Case(result.path.parent).packings() if one.has("surface.0.txt")]
    spectra = [found for one in packings if "stage_cycles/time" not in result and (found := spectrum_of(one)) is not None]
    if not spectra or len(spectra[0][0]) < FEWEST_WAVES:
        return []
    shortest = min(len(one[1]) for one in spectra)
    spectra = [one for one in spectra if len(one[1]) == shortest]
    wave_numbers, frequencies, _ = spectra[0]
    amplitudes = np.sqrt(np.mean([one[2] ** 2 for one in spectra], axis=0))
    figure, (left, right) = new_figure(1, 2, size=(9.0, 4.4))
    draw_spectrum(left, wave_numbers, frequencies, amplitudes)
    frequency = float(result["case/frequency"])
    depth = float(result["case/mass_per_area"]) / float(result["case/grain_density"]) / observables.SETTLED
    draw_half_frequency(right, wave_numbers, amplitudes[int(np.abs(frequencies - 0.5).argmin())], published_wavelength(frequency, depth))
    figure.suptitle(case_title(source.row_of(case)), fontsize=points(10))
    corner(figure, source.attributes)
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    return save(figure, output)


def draw_spectrum(axes: Axes, wave_numbers: Floats, frequencies: Floats, amplitudes: Floats) -> None:
    step_k, step_f = wave_numbers[0] / MILLI, frequencies[1]
    extent = (step_k / 2, wave_numbers[-1] / MILLI + step_k / 2, -step_f / 2, frequencies[-1] + step_f / 2)
    picture = axes.imshow(MILLI * amplitudes, origin="lower", extent=extent, aspect="auto", cmap="cividis", interpolation="nearest")
    axes.axhline(0.5, color="white", linewidth=0.8, linestyle=DASHES[1])
    axes.text(extent[1], 0.51, "f / 2 ", color="white", ha="right", va="bottom", fontsize=points(8))
    axes.set_xlabel("wave number 1 / \u03bb  [1/mm]")
    axes.set_ylabel("frequency over that of the drive  [-]")
    axes.get_figure().colorbar(picture, ax=axes, label="amplitude of the surface  [mm]")


def draw_half_frequency(axes: Axes, wave_numbers: Floats, amplitudes: Floats, published: float) -> None:
    axes.plot(wave_numbers / MILLI, MILLI * amplitudes, marker="o", markersize=4, color=COLOURS[0])
    label = f"published, vertical drive:\n\u03bb = {MILLI * published:.3g} mm, from 2.5 g on"
    axes.axvline(1 / published / MILLI, color=COLOURS[1], linestyle=DASHES[1], label=label)
    best = int(amplitudes.argmax())
    axes.set_title(f"at f / 2: strongest {MILLI * amplitudes[best]:.2g} mm, \u03bb = {MILLI / wave_numbers[best]:.3g} mm", fontsize=points(9))
    axes.set_xlabel("wave number 1 / \u03bb  [1/mm]")
    axes.set_ylabel("amplitude at f / 2  [mm]")
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    axes.legend(frameon=False, fontsize=points(8), loc="upper right")
    plain_axes(axes)
