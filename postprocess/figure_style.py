"""What all figures share: colours, fonts, the corner's text, saving."""

import io
import pathlib
from collections.abc import Mapping
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from drawn_figures import write_file

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)

# Okabe and Ito's colours, told apart by the colour-blind; markers and dashes say the same in black and white.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X"]
DASHES = ["-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (3, 1)), (0, (1, 1))]
GREY = "#666666"

THROW_NUMBER = "throw number \u0393 = \u03c9\u00b2 r sin \u03b2 / (g cos \u03b1)  [-]"
EFFICIENCY = "velocity efficiency \u03b7 = v / (\u03c9 r cos \u03b2)  [-]"

class Problem(Exception):
    """An error that the user can correct; its text is one line."""


def new_figure(*shape: int, size: tuple[float, float] = (7.2, 4.8), **settings: Any) -> tuple[Figure, Any]:
    plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "vibrotrough", "font.size": 10, "axes.axisbelow": True})
    return plt.subplots(*shape, figsize=size, **settings)


def plain_axes(axes: Axes) -> None:
    axes.grid(True, color="#e5e5e5", linewidth=0.6)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def plain(text: str) -> str:
    """Keys of the campaign file as words: "grains.rolling_friction 0.1" is "grain rolling friction 0.1"."""
    return text.replace("trough.", "").replace("grains.", "grain ").replace("layer.", "layer ").replace("_", " ")


def case_title(row: Mapping[str, Any]) -> str:
    """A case by its id and what distinguishes it."""
    told = row.get("label") or f"throw number {row['throw_number']:.3g}"
    return f"case {row['case']}: {plain(told)}"


def corner(figure: Figure, attributes: Mapping[str, Any], text: str = "") -> None:
    """The campaign's name and the program's version, small, at the lower right; a remark at the lower left."""
    name = f"{attributes['campaign']}  \u00b7  Vibrotrough {attributes['program_version']}"
    figure.text(0.99, 0.01, name, ha="right", va="bottom", fontsize=7, color=GREY)
    if text:
        figure.text(0.01, 0.01, text, ha="left", va="bottom", fontsize=7, color=GREY)


def save(figure: Figure, output: pathlib.Path) -> list[pathlib.Path]:
    """Writes output.svg and output.png (the same bytes every time) and returns their paths."""
    paths = []
    for kind in ("svg", "png"):
        path = output.with_name(f"{output.name}.{kind}")
        try:
            output.parent.mkdir(parents=True, exist_ok=True)
            content = io.BytesIO()
            figure.savefig(content, format=kind, dpi=150, metadata={"Date": None} if kind == "svg" else None)
            write_file(path, content.getvalue())
        except OSError as error:
            raise Problem(f"cannot write {path} ({error.strerror}); choose another --output") from error
        paths.append(path)
    plt.close(figure)
    return paths
