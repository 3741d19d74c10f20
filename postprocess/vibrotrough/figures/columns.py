"""Any column of `vibrotrough compare` over any other, of one campaign or several: `vibrotrough plot DIR --x COLUMN --y COLUMN`."""

import dataclasses
import json
import math
import pathlib
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from .drawn import read_note
from .inputs import SYMBOLS, UNITS, split_inputs
from .source import Source
from .style import COLOURS, EFFICIENCY, GREY, MARKERS, Problem, TooMany, WrongInput, corner, new_figure, one_line, plain, plain_axes, points, save, shown

Row = dict[str, Any]
Floats = NDArray[np.float64]
Model = tuple[str, str, str, str, str]  # column, line and mark, and the words for these

# What theory, law and atlas say of the same case, as efficiencies of the table; their lines and marks, and the words for these.
MODELS: dict[str, Model] = {
    "point-mass theory": ("efficiency_theory", "-", "x", "solid", "cross"),
    "rolling-layer law": ("efficiency_rolling_layer", "--", "+", "dashed", "plus"),
    "atlas": ("efficiency_atlas", ":", "*", "dotted", "star"),
}
# A sweep of the restitution is drawn beside both theories.
RESTITUTION_MODELS: dict[str, Model] = {
    "plastic theory": MODELS["point-mass theory"],
    "theory with restitution": ("efficiency_theory_restitution", "-.", "P", "dash-dotted", "thick plus"),
}
# Quantities that are an efficiency times a number that is known of each case.
OF_EFFICIENCY = ("efficiency", "conveying_speed", "mass_flow", "mass_flow_per_width")
MOST_SERIES = 24


@dataclasses.dataclass
class Shown:
    """A column and how its numbers are shown."""

    column: Mapping[str, Any]
    unit: str
    factor: float

    @property
    def name(self) -> str:
        return str(self.column["name"])

    @property
    def is_number(self) -> bool:
        return self.column["type"] != "text"

    @property
    def title(self) -> str:
        if self.name == "efficiency":
            return EFFICIENCY
        symbol = SYMBOLS.get(str(self.column.get("key") or ""))
        if symbol and self.factor == 1 and f"[{'-' if self.unit == '1' else self.unit}]" in symbol[0]:
            return symbol[0]
        return f"{plain(base_name(self.column))}  [{'-' if self.unit == '1' else self.unit}]" if self.is_number else plain(self.name)

    def of(self, row: Row) -> float:
        value = row.get(self.name)
        return math.nan if not isinstance(value, (int, float)) else self.factor * value


def suffix_of(column: Mapping[str, Any]) -> str:
    """The unit at the end of a column's name, "_m_per_s"."""
    # One fraction of several units has one "per".
    words = {"/h/m": "_per_h_m", "/": "_per_", "degree": "deg", "minute": "min", " ": "_"}
    unit = str(column["unit"]).lower()
    for old, new in words.items():
        unit = unit.replace(old, new)
    return "" if unit == "1" else f"_{unit}"


def base_name(column: Mapping[str, Any]) -> str:
    """The name of a column without its unit."""
    return str(column["name"]).removesuffix(suffix_of(column))


def find_column(name: str, tables: Iterable["Table"]) -> Mapping[str, Any]:
    """A column by the name that `compare` gives it."""
    for table in tables:
        for column in table.columns:
            if column["name"] == name:
                return column
    raise WrongInput(f"no campaign has a column {shown(name)}; call this by 'vibrotrough plot DIR', which knows all names")


def shown_as(column: Mapping[str, Any], unit: str | None = None, factor: float = 1.0) -> Shown:
    """A column in the unit that is asked for, with the factor to it, or in the one in which people read it."""
    own = str(column["unit"])
    if unit is not None:
        return Shown(column, unit, factor)
    if own in UNITS and column["type"] == "number":
        return Shown(column, *UNITS[own])
    return Shown(column, "\u00b0" if own == "degree" else own, 1.0)


@dataclasses.dataclass
class Table:
    """The rows of `compare` of one campaign."""

    name: str
    columns: list[Mapping[str, Any]]
    rows: list[Row]
    swept: list[str]  # names of the columns of swept keys
    attributes: Mapping[str, Any]


def read_table(output: pathlib.Path) -> Table:
    """Of the folder with what the program wrote for the figures."""
    path = output / "data" / "campaign.json"
    try:
        overview = json.loads(read_note(path))
        return Table(shown(overview["campaign"]), overview["columns"], overview["cases"], [str(one["column"]) for one in overview["swept"]],
                     {"campaign": overview["campaign"], "program_version": overview["program_version"]})
    except Exception as error:  # whatever a file holds that this program did not write
        raise Problem(f"cannot read {path} ({one_line(error)}); call it by 'vibrotrough plot DIR'") from error


def half_width_name(column: Mapping[str, Any]) -> str:
    """The column with half the interval of a number, as far as the table has one."""
    return f"{base_name(column)}_half_width{suffix_of(column)}"


def half_width(y: Shown, row: Row) -> float:
    """Half the interval of a number; NaN where the table has none."""
    value = row.get(half_width_name(y.column))
    return math.nan if not isinstance(value, (int, float)) else y.factor * value


def grouping(table: Table, x: Shown, by: Sequence[str] | None) -> list[Mapping[str, Any]]:
    """The columns that tell the series apart: those that are asked for, or the swept keys that are not on the axis."""
    if by is not None:
        return [find_column(one, [table]) for one in by]
    swept = sorted((one for one in table.columns if one["name"] in table.swept), key=lambda one: bool(one["name"] != x.name))
    kept: list[Mapping[str, Any]] = []  # of those that vary together, as in [zip], the first one
    for one in swept:
        if not any(vary_together(one, other, table.rows) for other in kept):
            kept.append(one)
    return [one for one in kept if one["name"] != x.name and len({str(row.get(one["name"])) for row in table.rows}) > 1]


def vary_together(one: Mapping[str, Any], other: Mapping[str, Any], rows: Iterable[Row]) -> bool:
    """Whether each value of one column goes with a single value of the other."""
    pairs = {(str(row.get(one["name"])), str(row.get(other["name"]))) for row in rows}
    return len(pairs) == len({first for first, _ in pairs}) == len({second for _, second in pairs})


def label_of(row: Row, columns: Iterable[Mapping[str, Any]]) -> str:
    words = []
    for column in columns:
        one = shown_as(column)
        value = f"{one.of(row):.4g}" if one.is_number else shown(row.get(one.name))
        words.append(f"{plain(base_name(column))} {value}" + ("" if one.unit == "1" else f" {one.unit}"))
    return ", ".join(words)


def sweeps_restitution(swept: Iterable[str]) -> bool:
    """Whether the restitution of grains on the trough is among these keys."""
    return any(key.endswith(("trough.restitution", "trough_restitution")) for key in swept)


def models_of(swept: Iterable[str]) -> dict[str, Model]:
    """The models that are drawn beside a campaign that sweeps these keys."""
    if not sweeps_restitution(swept):
        return MODELS
    return RESTITUTION_MODELS | {name: one for name, one in MODELS.items() if name != "point-mass theory"}


def draw_models(axes: Axes, places: list[float], y: Shown, rows: list[Row], colour: str, models: Mapping[str, Model]) -> set[str]:
    """The theory, the law and the atlas at the cases, joined by lines. The names of those that were drawn."""
    drawn = set()
    for name, (column, dash, mark, _, _) in models.items():
        values = []
        for row in rows:
            model, known = row.get(column), row.get("efficiency")
            # What a case's number is times its efficiency is the same for the model.
            scale = 1.0 if y.name == "efficiency" else y.of(row) / known / y.factor if known else math.nan
            values.append(math.nan if model is None else y.factor * scale * model)
        if np.isfinite(values).any():
            axes.plot(places, values, color=colour, linestyle=dash, linewidth=1.0, marker=mark, markersize=4)
            drawn.add(name)
    return drawn


def words_of_models(drawn: set[str], panels: Iterable[Axes]) -> str:
    """Which line is which model, or which mark where no series has more than one case."""
    models = RESTITUTION_MODELS | MODELS
    marks = {mark for _, _, mark, _, _ in models.values()}
    has_lines = any(line.get_marker() in marks and len(line.get_xdata()) > 1 for one in panels for line in one.lines)
    return "; ".join(f"{line if has_lines else mark}: {name}" for name, (_, _, _, line, mark) in models.items() if name in drawn)


def series_of(tables: list[Table], x: Shown, by: Sequence[str] | None) -> dict[str, list[Row]]:
    found: dict[str, list[Row]] = {}
    for table in tables:
        columns = grouping(table, x, by)
        for row in table.rows:
            words = [one for one in (table.name if len(tables) > 1 else "", label_of(row, columns)) if one]
            found.setdefault(", ".join(words), []).append(row)
    if len(found) > MOST_SERIES:
        raise TooMany(f"there are {len(found)} series, and {MOST_SERIES} can be told apart; choose with --by what tells them apart")
    return found


def why_nothing(tables: list[Table], x: Shown, y: Shown) -> str:
    """Why no case can be drawn."""
    rows = [row for table in tables for row in table.rows]
    for one in (y, x):
        if not any(math.isfinite(one.of(row)) for row in rows):
            if base_name(one.column) == "mass_flow":
                return f"no case has {one.name}, because the campaign does not say how wide the trough is (trough.width); draw mass_flow_per_width"
            return f"no case has {one.name}"
    return f"no case has both {x.name} and {y.name}"


def plot_columns(outputs: list[pathlib.Path], target: pathlib.Path, x_name: str, y_name: str, by: Sequence[str] | None,
                 unit: str | None, factor: float, kind: str | None = None) -> list[pathlib.Path]:
    """Draws the figure; returns the files, which are called after `kind` or the columns. @raises Problem when a column is not there
    or holds no numbers
    """
    tables = [read_table(output) for output in outputs]
    x, y = shown_as(find_column(x_name, tables)), shown_as(find_column(y_name, tables), unit, factor)
    figure, axes = new_figure()
    plain_axes(axes)
    models: set[str] = set()
    left_out = drawn = 0
    swept = {name for table in tables for name in table.swept}
    series = series_of(tables, x, by)
    for number, (name, members) in enumerate(series.items()):
        rows = sorted((row for row in members if math.isfinite(x.of(row)) and math.isfinite(y.of(row))), key=x.of)
        left_out += len(members) - len(rows)
        drawn += len(rows)
        if not rows:
            continue
        colour, bars = COLOURS[number % len(COLOURS)], np.array([half_width(y, row) for row in rows])
        axes.errorbar([x.of(row) for row in rows], [y.of(row) for row in rows], yerr=bars if np.isfinite(bars).any() else None, color=colour,
                      marker=MARKERS[(number + number // len(COLOURS)) % len(MARKERS)], linestyle="none", capsize=3, label=name)
        if base_name(y.column) in OF_EFFICIENCY:
            models |= draw_models(axes, [x.of(row) for row in rows], y, rows, colour, models_of(swept))
    if not drawn:
        raise WrongInput(why_nothing(tables, x, y))
    axes.set_xlabel(x.title)
    axes.set_ylabel(y.title)
    lines = words_of_models(models, [axes])
    if len(series) > 1:
        axes.legend(frameon=False, fontsize=points(8), loc="best", title=lines or None, title_fontsize=points(8))
    elif lines:
        axes.set_title(lines, fontsize=points(8), color=GREY)
    corner(figure, tables[0].attributes, f"{left_out} of {left_out + drawn} cases are not known" if left_out else "")
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    return save(figure, target / (kind or f"{base_name(y.column)}-over-{base_name(x.column).rpartition('.')[2]}"))


def plot_speed(source: Source, output: pathlib.Path) -> list[pathlib.Path]:
    return plot_for_machine(source, output, ("conveying_speed_m_per_s",))


def plot_mass_flow(source: Source, output: pathlib.Path) -> list[pathlib.Path]:
    return plot_for_machine(source, output, ("mass_flow_t_per_h", "mass_flow_per_width_t_per_h_m"))


def plot_for_machine(source: Source, output: pathlib.Path, columns: Sequence[str]) -> list[pathlib.Path]:
    """The first of these columns that is known of any case, over the input over which the efficiency is drawn; nothing where none is."""
    column = source.known_column(columns)
    if column is None:
        return []
    over, others = split_inputs(source.campaign, source.inputs)
    return plot_columns([source.output], source.output, source.column_of(over.key), column, [source.column_of(one.key) for one in others], None, 1.0,
                        output.name)
