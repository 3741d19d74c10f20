"""The velocity efficiency of every cycle of a case, packing by packing, with what was discarded as start-up shaded."""

import pathlib
from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..results import File
from .source import Source
from .style import COLOURS, DASHES, GREY, case_title, corner, new_figure, plain_axes, points, save

MOST_PACKINGS = 6  # drawn; more would be too small to read


def plot_cycles(source: Source, case: str, result: File, output: pathlib.Path) -> list[pathlib.Path]:
    packings = len(result["packings/seed"])
    shown = min(packings, MOST_PACKINGS)
    height = 1.2 + 1.35 * shown
    figure, columns = new_figure(shown, 1, size=(7.2, height), sharex=True, sharey=True, squeeze=False)
    row = source.row_of(case)
    for number, axes in enumerate(columns[:, 0]):
        draw_packing(axes, result, number, row)
    show_cycles(columns[0, 0], result, shown)
    last = columns[-1, 0]
    last.set_xlabel("cycle  [-]")
    figure.supylabel("velocity efficiency \u03b7 of each cycle  [-]", fontsize=points(10))
    handles, labels = columns[0, 0].get_legend_handles_labels()
    title = case_title(row)
    figure.legend(handles, labels, ncols=4, loc="upper center", frameon=False, fontsize=points(8), bbox_to_anchor=(0.5, 1 - 0.22 / height))
    figure.suptitle(title, fontsize=points(10), y=1 - 0.08 / height)
    note = f"{shown} of {packings} packings" if shown < packings else ""
    corner(figure, source.attributes, note)
    figure.tight_layout(rect=(0, 0.02, 1, 1 - 0.4 / height))
    return save(figure, output)


def show_cycles(axes: Axes, result: File, shown: int) -> None:
    """The interval of one short packing may be many times as wide as its cycles scatter, which would then look like a straight line."""
    cycles = np.concatenate([result[f"series/{number + 1}/efficiency"] for number in range(shown)])
    low, high = np.min(cycles), np.max(cycles)
    beyond = 0.5 * (high - low)
    bottom, top = axes.get_ylim()
    if beyond > 0 and (bottom < low - 2 * beyond or top > high + 2 * beyond):
        axes.set_ylim(max(bottom, low - beyond), min(top, high + beyond))


def draw_packing(axes: Axes, result: File, number: int, row: Mapping[str, Any]) -> None:
    efficiency = np.asarray(result[f"series/{number + 1}/efficiency"])
    discarded = int(result["packings/cycles_discarded"][number])
    mean, half_width = result["packings/efficiency"][number], result["packings/efficiency_half_width_statistics"][number]
    cycles = np.arange(1, len(efficiency) + 1)
    plain_axes(axes)
    if discarded:
        axes.axvspan(0.5, discarded + 0.5, facecolor="#dddddd", edgecolor="#999999", hatch="///", linewidth=0,
                     alpha=0.6, label="discarded start", zorder=0)
    axes.plot(cycles, efficiency, color=COLOURS[0], marker=".", markersize=3, linewidth=0.9, label="cycle")
    has_stages = "stages/start" in result  # one mean says nothing of several drives
    if np.isfinite(mean) and not has_stages:
        kept = [discarded + 0.5, len(efficiency) + 0.5]
        axes.plot(kept, [mean, mean], color=COLOURS[1], linestyle=DASHES[1], linewidth=1.6, label="mean and interval")
        if np.isfinite(half_width):
            axes.fill_between(kept, mean - half_width, mean + half_width, color=COLOURS[1], alpha=0.2, linewidth=0)
    if row["efficiency_theory"] is not None:
        axes.axhline(row["efficiency_theory"], color=COLOURS[2], linestyle=DASHES[2], linewidth=1.4, label="theory")
    # Whether a single packing is precise does not matter: what is asked for is the interval of the case.
    is_told = row["outcome"] != "finished" and result["packings/verdict"][number] == "not-steady"
    verdict = ": not-steady" if is_told else ""
    # Where a drive often ends at a standstill the low corner is taken.
    place = {"xy": (0.995, 0.95), "va": "top"} if has_stages else {"xy": (0.995, 0.05), "va": "bottom"}
    axes.annotate(f"packing {number + 1}{verdict}", **place, xycoords="axes fraction", ha="right",
                  fontsize=points(8), color=GREY, bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1})
    axes.margins(x=0.01)
