"""The error budget of the cases that `vibrotrough convergence` studied: statistical and numerical error side by side."""

import json
import pathlib
from typing import Any

from matplotlib.axes import Axes
from matplotlib.patches import Patch

from .drawn import read_note
from .source import Source
from .style import COLOURS, GREY, Problem, corner, new_figure, plain, plain_axes, points, save

BAR = 0.38
MOST_CASES = 12

Budget = dict[str, Any]


def read_budgets(directory: pathlib.Path, order: list[str]) -> list[Budget]:
    """The budgets of numerics.json whose cases are in `order`, in that order; empty when there is no file."""
    path = directory / "numerics.json"
    try:
        known = {budget["case"]: budget for budget in json.loads(read_note(path))["cases"]}
    except FileNotFoundError:
        return []
    except (OSError, ValueError, KeyError, TypeError, RecursionError) as error:
        raise Problem(f"cannot read {path} ({error!r}); delete it and run 'vibrotrough convergence' again") from error
    return [known[case] for case in order if case in known]


def shares(budget: Budget) -> list[float]:
    """Heights that add up to the numerical error: each part has its share of the sum of the squares of what they are below."""
    squares = [setting["bound"] ** 2 for setting in budget["settings"]]
    return [budget["numerical_error"] * square / sum(squares) if square else 0.0 for square in squares]


def draw_budget(axes: Axes, place: float, budget: Budget, colours: dict[str, str]) -> None:
    if budget["numerical_error"] is None:
        axes.annotate("unknown", (place + BAR / 2, 0), rotation=90, ha="center", va="bottom", fontsize=points(8), color=GREY)
        return
    bottom = 0.0
    for setting, height in zip(budget["settings"], shares(budget)):
        sure = abs(setting["error"]) > setting["error_half_width"]
        axes.bar(place + BAR / 2, height, BAR, bottom=bottom, color=colours[setting["setting"]] if sure else "white",
                 edgecolor=colours[setting["setting"]], hatch=None if sure else "////", linewidth=0.8)
        bottom += height
    axes.annotate(f"{bottom:.3f}", (place + BAR / 2, bottom), ha="center", va="bottom", fontsize=points(7))


def names_of(source: Source, budgets: list[Budget]) -> list[str]:
    """What tells the cases apart: the values of the swept keys, else the id."""
    rows = [source.row_of(budget["case"]) for budget in budgets]
    return [plain(row.get("label") or row["case"]).replace(", ", "\n") for row in rows]


def plot_budget(source: Source, output: pathlib.Path) -> list[pathlib.Path]:
    """Draws the figure; returns the files, none when no case was studied."""
    every = read_budgets(source.directory, [str(case) for case in source.campaign["case"]])
    budgets = every[:MOST_CASES]
    if not budgets:
        return []
    titles = {one["setting"]: one["title"] for budget in budgets for one in budget["settings"] if one["verdict"] != "left-out"}
    colours = {setting: COLOURS[number % len(COLOURS)] for number, setting in enumerate(titles)}
    figure, axes = new_figure(size=(max(5.0, 1.6 + 1.1 * len(budgets)), 4.4))
    plain_axes(axes)
    for place, budget in enumerate(budgets):
        statistical = source.row_of(budget["case"])["efficiency_half_width_statistics"]
        if statistical is not None:
            axes.bar(place - BAR / 2, statistical, BAR, color="#bbbbbb", edgecolor=GREY, linewidth=0.8)
            axes.annotate(f"{statistical:.3f}", (place - BAR / 2, statistical), ha="center", va="bottom", fontsize=points(7))
        settings = [one for one in budget["settings"] if one["verdict"] != "left-out"]
        draw_budget(axes, place, budget | {"settings": settings}, colours)
    axes.set_xlim(-0.6, len(budgets) - 0.4)
    axes.set_xticks(range(len(budgets)), names_of(source, budgets), fontsize=points(8))
    axes.set_ylabel("error of velocity efficiency \u03b7  [-]")
    axes.margins(y=0.12)
    handles = [Patch(facecolor="#bbbbbb", edgecolor=GREY, label="statistical (left bar)")]
    handles += [Patch(facecolor=colours[setting], label=title) for setting, title in titles.items()]
    handles.append(Patch(facecolor="white", edgecolor=GREY, hatch="////", label="not found: what it is below"))
    axes.legend(handles=handles, frameon=False, fontsize=points(8), loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
    left = f"; {len(every) - len(budgets)} more cases" if len(every) > len(budgets) else ""
    corner(figure, source.attributes, f"heights: shares of the sum of squares{left}")
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    return save(figure, output)
