"""Velocity efficiency from campaign.h5: DEM points with error bars, and the theory.

The figure is drawn over the throw number or, where that is the same in all cases, over the first swept key; the first other
swept key gives the colour, the second the marker, and each combination of the rest a panel. The theory is what the program
computed, with at least the columns throw_number, vibration_angle_deg and velocity_efficiency (a fine curve, drawn as a line)
or efficiency_theory (the theory at the cases, as `vibrotrough compare --csv` prints it, drawn as small crosses joined by a
thin line). Lines that belong to several colours are grey. Nothing of the theory is computed here.
"""

import csv
import dataclasses
import io
import itertools
import math
import pathlib
import textwrap
from collections import defaultdict
from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from ..campaign import open_campaign
from .columns import RESTITUTION_MODELS, Model, draw_models, models_of, shown_as, sweeps_restitution, words_of_models
from .drawn import read_note
from .inputs import Input, panels, split_inputs, swept_inputs
from .source import Source
from .style import (COLOURS, DASHES, EFFICIENCY, GREY, MARKERS, Problem, characters_across, corner, is_narrow, new_figure, plain_axes,
                          points, save)  # fmt: skip

Columns = dict[str, NDArray[Any]]
Pair = tuple[NDArray[np.float64], NDArray[np.float64]]  # places and efficiencies of a line
LineKey = tuple[float, float | None, float | None]  # vibration angle and inclination in degrees, friction

UNCERTAIN = "not precise or not steady"
BISTABLE = "bistable-or-slow"  # the outcome
MOST_PANELS = 6
BAND = 0.12  # opacity
APART = 0.015  # of the axis: from series to series where several have a point at one place


def read_campaign(path: pathlib.Path) -> tuple[Columns, dict[str, str], dict[str, Any]]:
    """Columns of campaign.h5 as arrays, their units, and the root attributes. Swept keys are below swept/."""
    try:
        campaign = open_campaign(path)
    except (OSError, ValueError) as error:
        raise Problem(f"cannot read {path} ({error}); give a campaign's folder") from error
    columns = {name: np.asarray(campaign[name]) for name in campaign if not name.startswith("observables/")}
    return columns, {name: campaign[name].units for name in columns}, campaign.attributes


def line_key(row: dict[str, str]) -> LineKey:
    """What is the same along the line of the theory to which a row belongs."""

    def number(name: str) -> float | None:
        return same(float(row[name])) if row.get(name) else None

    return same(float(row["vibration_angle_deg"])), number("inclination_deg"), number("friction")


def read_theory(path: pathlib.Path) -> tuple[dict[LineKey, Pair], dict[str, Any]]:
    """Lines of the theory, (throw numbers, efficiencies) by what is the same along them, and their style."""
    points: dict[LineKey, list[tuple[float, float]]] = defaultdict(list)

    try:
        rows = csv.DictReader(io.StringIO(read_note(path).decode()))
        fine = "velocity_efficiency" in (rows.fieldnames or [])
        for row in rows:
            value = row["velocity_efficiency" if fine else "efficiency_theory"]
            points[line_key(row)].append((float(row["throw_number"]), float(value) if value else math.nan))
    except (OSError, KeyError, ValueError) as error:
        raise Problem(f"cannot use {path} as a theory curve ({error!r}); see --help for its columns") from error
    lines = {}
    for key, pairs in points.items():
        places, values = np.array(sorted(pairs)).T
        lines[key] = (places, values)
    return lines, {"linewidth": 1.6} if fine else {"linewidth": 0.8, "marker": "x", "markersize": 5}


def read_rolling_layer(path: pathlib.Path) -> dict[LineKey, Pair]:
    """Lines of the rolling-layer law, of a fine curve that has them; NaN where the law was not tested."""
    points: dict[LineKey, list[tuple[float, float]]] = defaultdict(list)
    for row in csv.DictReader(io.StringIO(read_note(path).decode())):
        value = row.get("rolling_layer_efficiency")
        points[line_key(row)].append((float(row["throw_number"]), float(value) if value else math.nan))
    lines = {}
    for key, pairs in points.items():
        places, values = np.array(sorted(pairs)).T
        if np.isfinite(values).any():
            lines[key] = (places, values)
    return lines


def read_atlas(path: pathlib.Path) -> dict[LineKey, tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]]:
    """Lines of the atlas, of a fine curve that has them: throw numbers, efficiencies and half-widths of their 95 % intervals."""
    points: dict[LineKey, list[tuple[float, float, float]]] = defaultdict(list)
    for row in csv.DictReader(io.StringIO(read_note(path).decode())):
        if row.get("atlas_efficiency"):
            points[line_key(row)].append((float(row["throw_number"]), float(row["atlas_efficiency"]), float(row["atlas_half_width"])))
    lines = {}
    for key, triples in points.items():
        places, values, widths = np.array(sorted(triples)).T
        lines[key] = (places, values, widths)
    return lines


def rotates(columns: Columns) -> bool:
    """Whether any case has grains that rotate, of which the rolling-layer law speaks."""
    return not {"free", "rolling"}.isdisjoint(columns.get("grain_rotation", ()))


def same(value: float) -> float:
    """Values that differ only by rounding are one."""
    return round(value, 4)


class Series:
    """How the cases are told apart: place, colour, marker and panel of each."""

    def __init__(self, columns: Columns, units: dict[str, str], attributes: dict[str, Any]) -> None:
        self.columns, self.count = columns, len(columns["case"])
        self.over, others = split_inputs(columns, swept_inputs(columns, units, attributes))
        self.colour_by: Input | None = others[0] if others else None
        self.marker_by: Input | None = others[1] if len(others) > 1 else None
        self.panels = panels(others[2:], self.count)
        none = np.zeros(self.count, dtype=np.intp)
        self.colours = self.colour_by.groups() if self.colour_by else none
        self.markers = self.marker_by.groups() if self.marker_by else none

    def drawn_places(self) -> NDArray[np.float64]:
        """Where the points are drawn: beside one another where series have the same place, so that none hides another."""
        places, _ = self.over.places()
        kinds = sorted(set(zip(self.colours.tolist(), self.markers.tolist())))
        kind = np.array([kinds.index(one) for one in zip(self.colours.tolist(), self.markers.tolist())])
        values = np.unique(places)
        if len(values) == self.count:
            return np.asarray(places, dtype=float)
        step = min(APART * (np.ptp(places) or 1.0), 0.6 * np.diff(values).min(initial=np.inf) / len(kinds))
        return np.asarray(places + step * (kind - (len(kinds) - 1) / 2), dtype=float)

    def name(self, row: int) -> str:
        inputs = [one for one in (self.colour_by, self.marker_by) if one]
        if inputs:
            return ", ".join(one.label(row) for one in inputs)
        return f"DEM, \u03b2 = {math.degrees(self.columns['vibration_angle'][row]):.3g}\u00b0"

    def is_over_throw_number(self) -> bool:
        return self.over.key == "trough.throw_number"

    def line_of(self, row: int) -> LineKey:
        """The line of the theory that belongs to a case."""
        angle, inclination = (same(math.degrees(self.columns[name][row])) for name in ("vibration_angle", "inclination"))
        return angle, inclination, same(float(self.columns["friction"][row]))


@dataclasses.dataclass
class Kind:
    """A kind of line over the throw number. `alone` is its colour where the points have one; else it has those of the points."""

    name: str
    lines: Mapping[LineKey, Pair]
    style: dict[str, Any]
    alone: str
    bands: Mapping[LineKey, NDArray[np.float64]] = dataclasses.field(default_factory=dict)  # half-widths

    def handle(self, series: Series) -> Any:
        """What stands for it in the legend."""
        colour = GREY if series.colours.any() else self.alone
        line = Line2D([], [], color=colour, **self.style)
        return (Patch(facecolor=colour, alpha=BAND, linewidth=0), line) if self.bands else line


def kinds_of_lines(theory_file: pathlib.Path, columns: Columns, plastic: bool) -> list[Kind]:
    """What is drawn over the throw number beside the points, without what the file lacks."""
    theory, style = read_theory(theory_file)
    atlas = read_atlas(theory_file)
    kinds = [
        Kind("plastic theory" if plastic else "point-mass theory", theory, style, "#000000"),
        Kind("rolling-layer law", read_rolling_layer(theory_file) if rotates(columns) else {}, {"linewidth": 0.8}, COLOURS[1]),
        Kind("atlas, 95 % interval", {key: line[:2] for key, line in atlas.items()}, {"linewidth": 1.2, "linestyle": ":"}, COLOURS[2],
             {key: line[2] for key, line in atlas.items()}),
    ]
    return [kind for kind in kinds if kind.lines]


def colours_of(series: Series, line: LineKey, rows: list[int]) -> set[int]:
    """The colours of the cases to which a line of the theory belongs, or else of those with its vibration angle."""
    for known in (3, 1):
        found = {int(series.colours[row]) for row in rows
                 if all(one is None or one == other for one, other in zip(line[:known], series.line_of(row)))}
        if found:
            return found
    return set()


def draw_lines(axes: Axes, series: Series, rows: list[int], kind: Kind) -> None:
    """Lines over the throw number, in the colour of their cases; grey where the cases have several."""
    spare = int(series.colours.max(initial=0)) + 1
    for line, (places, efficiency) in sorted(kind.lines.items(), key=str):
        every, here = colours_of(series, line, list(range(series.count))), colours_of(series, line, rows)
        if every and not here:
            continue  # of another panel
        number = min(here, default=spare)
        spare += not here
        colour = GREY if len(here) > 1 else COLOURS[number % len(COLOURS)]
        if here and not series.colours.any():
            colour = kind.alone
        usual = "-" if len(here) > 1 else DASHES[number % len(DASHES)]
        axes.plot(places, efficiency, color=colour, **{"linestyle": usual} | kind.style)
        if kind.bands:
            half = kind.bands[line]
            axes.fill_between(places, efficiency - half, efficiency + half, color=colour, alpha=BAND, linewidth=0)


def draw_models_at_cases(axes: Axes, series: Series, rows: list[int], at_cases: dict[str, dict[str, Any]], models: Mapping[str, Model]) -> set[str]:
    """Over another input the program gives the models at the cases only. The names of those that were drawn."""
    places, _ = series.over.places()
    efficiency, drawn = shown_as({"name": "efficiency", "unit": "1", "type": "number"}), set()
    for colour, marker in sorted({(int(series.colours[row]), int(series.markers[row])) for row in rows}):
        members = sorted((row for row in rows if (series.colours[row], series.markers[row]) == (colour, marker)), key=lambda row: places[row])
        drawn |= draw_models(axes, [float(places[row]) for row in members], efficiency,
                             [at_cases.get(str(series.columns["case"][row]), {}) for row in members], COLOURS[colour % len(COLOURS)], models)
    return drawn


def draw(axes: Axes, series: Series, rows: list[int]) -> None:
    columns = series.columns
    places, (_, names) = series.drawn_places(), series.over.places()
    for colour, marker in sorted({(int(series.colours[row]), int(series.markers[row])) for row in rows}):
        members = sorted((row for row in rows if (series.colours[row], series.markers[row]) == (colour, marker)),
                         key=lambda row: places[row])
        shade = COLOURS[colour % len(COLOURS)]
        axes.errorbar(places[members], columns["efficiency"][members], yerr=columns["efficiency_half_width"][members], color=shade,
                      marker=MARKERS[(colour + marker) % len(MARKERS)], markerfacecolor=shade if marker == 0 else "white",
                      linestyle="none", capsize=3, label=series.name(members[0]))
    if names:
        axes.set_xticks(range(len(names)), names)


def draw_branches(axes: Axes, series: Series, members: list[int]) -> list[tuple[float, float]]:
    """Both branches of the cases that are bistable or slow; returns their points. Older campaigns have none."""
    columns, points, places = series.columns, [], series.drawn_places()
    for side, marker in (("below", "v"), ("above", "^")):
        efficiency = columns.get(f"efficiency_{side}", np.full(series.count, np.nan))
        rows = [row for row in members if columns["outcome"][row] == BISTABLE and np.isfinite(efficiency[row])]
        if not rows:
            continue
        axes.errorbar(places[rows], efficiency[rows], yerr=columns[f"efficiency_{side}_half_width"][rows],
                      color="#777777", marker=marker, markerfacecolor="white", linestyle="none", capsize=3,
                      label=f"bistable or slow, from {side}")
        points += [(places[row], efficiency[row]) for row in rows]
    return points


def mark_uncertain(axes: Axes, series: Series, members: list[int], branches: list[tuple[float, float]]) -> None:
    """A ring around every point that is less certain than asked for; cases without a value are counted, not hidden."""
    columns, places = series.columns, series.drawn_places()
    drawn = np.isfinite(columns["efficiency"])
    rows = [row for row in members if columns["outcome"][row] != "finished" and drawn[row]]
    points = [(places[row], columns["efficiency"][row]) for row in rows] + branches
    if points:
        axes.scatter(*np.array(points).T, s=160, facecolors="none", edgecolors="#777777", label=UNCERTAIN, zorder=1)


def add_legend(figure: Figure, grid: list[Axes], title: str, lines: dict[str, Any]) -> float:
    """Above the axes, where no point can be mistaken for a part of it; the series first, then the lines and the ring. Returns the
    share of the figure's height that it takes from panels.
    """
    found: dict[str, Any] = {}
    for axes in grid:
        for handle, name in zip(*axes.get_legend_handles_labels()):
            found.setdefault(name, handle)
    names = sorted(found | lines, key=lambda name: (name == UNCERTAIN, name in lines))
    found |= lines
    across = characters_across(figure, points(9))
    title = textwrap.fill(title, across)
    longest = max(map(len, names), default=0)
    most = max(1, min(across // (longest + 8), 3 if longest < 24 else 2))
    rows = max(1, math.ceil(len(names) / most))  # of nearly equal length
    settings: dict[str, Any] = {"frameon": False, "fontsize": points(9), "title": title, "title_fontsize": points(9), "columnspacing": 1.2,
                                "handletextpad": 0.4, "ncols": max(1, math.ceil(len(names) / rows))}
    handles = [found[name] for name in names]
    if len(grid) == 1:
        grid[0].legend(handles, names, loc="lower center", bbox_to_anchor=(0.5, 1.0), **settings)
        return 0.0
    figure.legend(handles, names, loc="upper center", bbox_to_anchor=(0.5, 1.0), **settings)
    return float((0.15 + 0.2 * (1 + rows)) / figure.get_size_inches()[1])


def label(figure: Figure, grid: list[Axes], series: Series, attributes: dict[str, Any], told: str, lines: dict[str, Any]) -> float:
    """Titles, legend and remarks; returns the share of the height that the legend takes."""
    columns = series.columns
    confidence = np.unique(columns["confidence"])
    bars = f"{100 * confidence[0]:.3g} % interval" if len(confidence) == 1 else "confidence interval"
    for axes in grid:
        axes.axhline(0.0, color="#bbbbbb", linewidth=0.8, zorder=0)
        plain_axes(axes)
    if len(grid) == 1:
        grid[0].set_xlabel(series.over.title)
        grid[0].set_ylabel(EFFICIENCY)
    else:
        figure.supxlabel(series.over.title, fontsize=points(10))
        figure.supylabel(EFFICIENCY, fontsize=points(10))
    taken = add_legend(figure, grid, f"points: DEM with {bars}{told}", lines)
    without = np.count_nonzero(~np.isfinite(columns["efficiency"]))
    remarks = [f"{without} of {series.count} cases have no mean (not steady or bistable)"] if without else []
    if len(series.panels) > len(grid):
        remarks.append(f"{len(grid)} of {len(series.panels)} combinations of the swept keys")
    corner(figure, attributes, "; ".join(remarks))
    return taken


def plot_efficiency(source: Source, output: pathlib.Path) -> list[pathlib.Path]:
    at_cases = {row["case"]: row for row in source.overview["cases"]}
    return draw_efficiency(source.directory, source.data / "theory_curves.csv", output, at_cases)


def draw_efficiency(directory: pathlib.Path, theory_file: pathlib.Path, output: pathlib.Path,
                    at_cases: dict[str, dict[str, Any]] | None = None) -> list[pathlib.Path]:
    """Draws the figure; returns the files. `at_cases` has the rows of `compare` by case, for other inputs than the throw number."""
    columns, units, attributes = read_campaign(directory / "campaign.h5")
    if len(columns.get("case", [])) == 0:
        raise Problem(f"{directory / 'campaign.h5'} holds no finished case; run the campaign first")
    series = Series(columns, units, attributes)
    models = set[str]()
    swept = str(attributes.get("swept_keys", "")).split()
    rebounds = {name: one for name, one in RESTITUTION_MODELS.items() if name == "theory with restitution" and sweeps_restitution(swept)}
    kinds = kinds_of_lines(theory_file, columns, plastic=bool(rebounds))
    if not series.is_over_throw_number():
        kinds = []
    shown = list(itertools.islice(series.panels.items(), MOST_PANELS))
    across = 1 if is_narrow() else min(len(shown), 2)
    down = -(-len(shown) // across)
    if len(shown) == 1:
        figure, axes = new_figure()
        grid = [axes]
    else:
        figure, axes = new_figure(down, across, size=(3.9 * across, 3.0 * down + 0.9), squeeze=False, sharex=True, sharey=True)
        grid = list(axes.flat)
    for one, (name, rows) in zip(grid, shown):
        if series.is_over_throw_number():
            for kind in kinds:
                draw_lines(one, series, rows, kind)
            models |= draw_models_at_cases(one, series, rows, at_cases or {}, rebounds)  # whose fine curve differs from case to case
        elif at_cases:
            models |= draw_models_at_cases(one, series, rows, at_cases, models_of(swept))
        draw(one, series, rows)
        mark_uncertain(one, series, rows, draw_branches(one, series, rows))
        one.set_title(name, fontsize=points(9)) if len(shown) > 1 else None
    for one in grid[len(shown):]:
        one.set_visible(False)
    words = words_of_models(models, grid)
    taken = label(figure, grid[:len(shown)], series, attributes, f"; {words}" if words else "", {kind.name: kind.handle(series) for kind in kinds})
    figure.tight_layout(rect=(0, 0.02, 1, 1 - taken))
    return save(figure, output)
