"""The measured motion of the trough as it was read, and the cycle that the deck runs, from the files that the program writes in OUT/data/records."""

import pathlib
import textwrap
from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from .source import Source
from .style import COLOURS, GREY, characters_across, corner, new_figure, plain_axes, points, save, shown

MOST_RECORDS = 3  # drawn, each in two rows of panels
DIRECTIONS = ("along", "normal")
UNITS = {"m": ("position", "mm", 1e3), "m/s2": ("acceleration", "m/s\u00b2", 1.0)}


def plot_record(source: Source, output: pathlib.Path) -> list[pathlib.Path]:
    records = source.overview.get("records", [])
    drawn = records[:MOST_RECORDS]
    if not drawn:
        return []
    height = 0.9 + 5.0 * len(drawn)
    figure, axes = new_figure(2 * len(drawn), 2, size=(9.0, height), sharex="col", sharey="row", squeeze=False, width_ratios=(1.6, 1))
    for place, record in enumerate(drawn):
        files = [np.genfromtxt(source.data / "records" / f"{place + 1}{ending}.csv", delimiter=",", names=True) for ending in ("", "_cycle")]
        for row, direction in zip(axes[2 * place : 2 * place + 2], DIRECTIONS):
            draw_direction(row, record, files[0], files[1], direction)
        width = int(0.55 * characters_across(figure, points(8)))  # of the left panels
        told = [line for remark in record["remarks"] for line in textwrap.wrap(shown(remark), width)]
        axes[2 * place, 0].set_title("\n".join(told), fontsize=points(8), loc="left")
    axes[-1, 0].set_xlabel("time  [s]")
    axes[-1, 1].set_xlabel("time in cycles, t / T  [-]")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, ncols=4, loc="upper center", frameon=False, fontsize=points(8))
    left_out = [f"{len(drawn)} of {len(records)} records"] if len(drawn) < len(records) else []
    left_out += [f"the first {len(files[0])} of {record['samples']} samples"] if len(files[0]) < record["samples"] else []
    corner(figure, source.attributes, "; ".join(left_out))
    figure.tight_layout(rect=(0, 0.02, 1, 1 - 0.25 / height))
    return save(figure, output)


def draw_direction(axes: tuple[Axes, Axes], record: Mapping[str, Any], samples: NDArray[Any], cycle: NDArray[Any], direction: str) -> None:
    """Left the record over time, as it was read; right its cycles laid over one another, without mean and drift."""
    name, unit, factor = UNITS[record["unit"]]
    over_time, over_cycle = axes
    read, left_out, deck = (factor * samples[column] for column in (direction, f"left_out_{direction}", f"deck_{direction}"))
    used = np.isfinite(deck)
    # Points of a long record would make a large SVG.
    style = {"linestyle": "none", "marker": ".", "markersize": 3, "rasterized": True}
    over_time.plot(samples["time_s"][used], read[used], color=COLOURS[0], label="record", **style)
    if not used.all():
        over_time.plot(samples["time_s"][~used], read[~used], color=GREY, label="not used", **style)
    over_time.plot(samples["time_s"][used], (left_out + deck)[used], color=COLOURS[1], linewidth=1.0, label="cycle of the deck, with what was left out")
    over_time.plot(samples["time_s"][used], left_out[used], color=COLOURS[2], linestyle="--", linewidth=1.2, label="mean and drift, left out")
    over_cycle.plot(samples["cycles"][used] % 1, (read - left_out)[used], color=COLOURS[0], **style)
    over_cycle.plot(cycle["cycles"], factor * cycle[direction], color=COLOURS[1], linewidth=1.4)
    over_time.set_ylabel(f"{name} {'along' if direction == 'along' else 'normal to'}\nthe trough  [{unit}]")
    for one in axes:
        plain_axes(one)
        one.margins(x=0.01)
