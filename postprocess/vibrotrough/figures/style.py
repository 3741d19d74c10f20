"""What all figures share: colours, fonts, the corner's text, saving."""

import dataclasses
import io
import logging
import pathlib
import unicodedata
from collections.abc import Mapping
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .drawn import write_file

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


class WrongInput(Problem):
    """What was asked for cannot be drawn, and the program ends as with any wrong input."""


class TooNarrow(Problem):
    """A figure does not fit into the width that the user wants."""


class TooMany(WrongInput):
    """A figure has more series than can be told apart."""



@dataclasses.dataclass
class Print:
    """What figures are drawn for: a screen, or a journal."""

    formats: tuple[str, ...] = ("svg", "png")
    width: float | None = None  # m, of the whole figure; None: as wide as each figure likes
    style: pathlib.Path | None = None  # a style sheet of matplotlib


# What a file would say of the day on which it was drawn.
UNDATED = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
STEERING = ("Cc", "Cf", "Cs", "Zl", "Zp")  # categories of Unicode: control, format, half of a character, ends of lines
FORMATS = ("svg", "png", "pdf")
INCH = 0.0254  # m
USUAL_WIDTH, USUAL_FONT = 7.2, 10.0  # inches, points: those of a figure for a screen
PANELS_WIDTH = 0.15  # m, of a figure with panels beside one another, at least: below, their labels run into one another
SMALLEST_FONT = 7.0  # points, of axes and legends in print
target = Print()


class Listener(logging.Handler):
    """Keeps the lines that are logged."""

    def __init__(self, lines: list[str]) -> None:
        super().__init__()
        self.lines = lines

    def emit(self, record: logging.LogRecord) -> None:
        self.lines.extend(record.getMessage().split("\n"))


def take_style(path: pathlib.Path) -> None:
    """Reads a style sheet once, so that its mistakes are told before anything is drawn."""
    said: list[str] = []
    log, listener = logging.getLogger("matplotlib"), Listener(said)
    log.addHandler(listener)
    try:
        matplotlib.rc_params_from_file(path, fail_on_error=True, use_default_template=False)
    except (OSError, ValueError, KeyError) as error:
        said = str(error).splitlines()
    log.removeHandler(listener)
    if told := [line.strip() for line in said if line.strip()]:
        raise WrongInput(f"cannot use the style sheet {path} ({told[0]}); see matplotlib's style sheets")
    target.style = path


def new_figure(*shape: int, size: tuple[float, float] = (USUAL_WIDTH, 4.8), **settings: Any) -> tuple[Figure, Any]:
    """`size` in inches, as on a screen. In a column of a journal, letters shrink less than the figure, and its height less than
    its width, so that both stay readable.
    """
    matplotlib.rc_file_defaults()
    # A name may hold dollar signs: nothing in a figure is mathematics for matplotlib.
    plt.rcParams.update({"text.parse_math": False, "svg.fonttype": "none", "svg.hashsalt": "vibrotrough", "pdf.fonttype": 42, "font.size": USUAL_FONT,
                         "axes.axisbelow": True})  # fmt: skip
    if is_narrow() and len(shape) > 1 and shape[1] > 1:
        raise TooNarrow(f"panels beside one another need a width of {1000 * PANELS_WIDTH:.0f} mm, such as --width two-columns")
    if target.width is not None:
        share = target.width / INCH / size[0]
        plt.rcParams["font.size"] = max(SMALLEST_FONT, USUAL_FONT * min(1.0, (target.width / INCH / USUAL_WIDTH) ** 0.4))
        plt.rcParams["savefig.dpi"] = 300
        size = (target.width / INCH, size[1] * share**0.45)
    if target.style is not None:
        plt.style.use(str(target.style))
    return plt.subplots(*shape, figsize=size, **settings)


def is_narrow() -> bool:
    """Whether there is room for one panel only, such as in one column of a journal."""
    return target.width is not None and target.width < PANELS_WIDTH


def points(size: float) -> float:
    """A size of letters in a figure whose usual one is 10 points, in points of this figure."""
    return size * float(plt.rcParams["font.size"]) / USUAL_FONT


def characters_across(figure: Figure, size: float) -> int:
    """About how many letters of this size (points) fit across a figure; a letter is half as wide as its size."""
    return int(figure.get_size_inches()[0] * 72 / (0.5 * size))


def shown(text: object) -> str:
    """A text from outside, such as a path, made harmless for a terminal and a figure: what steers it is written as \\x1b or \\u202e."""

    def written(letter: str) -> str:
        number = ord(letter)
        if 0xDC80 <= number <= 0xDCFF:  # a byte of a path that is not UTF-8
            return f"\\x{number - 0xDC00:02x}"
        return f"\\x{number:02x}" if number < 0x80 else f"\\u{number:04x}"

    return "".join(written(letter) if unicodedata.category(letter) in STEERING else letter for letter in str(text))


def one_line(error: BaseException) -> str:
    """What an error says, on one line."""
    said = " ".join(str(error).split())
    return said if isinstance(error, (OSError, Problem)) else f"{type(error).__name__}: {said}" if said else type(error).__name__


def plain_axes(axes: Axes) -> None:
    axes.grid(True, color="#e5e5e5", linewidth=0.6)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def plain(text: str) -> str:
    """Keys of the campaign file as words: "grains.rolling_friction 0.1" is "grain rolling friction 0.1"."""
    return shown(text).replace("trough.", "").replace("grains.", "grain ").replace("layer.", "layer ").replace("_", " ")


def case_title(row: Mapping[str, Any]) -> str:
    """A case by its id and what distinguishes it."""
    told = row.get("label") or f"throw number {row['throw_number']:.3g}"
    return f"case {row['case']}: {plain(told)}"


def corner(figure: Figure, attributes: Mapping[str, Any], text: str = "") -> None:
    """The campaign's name and the program's version, small, at the lower right; a remark at the lower left."""
    name = f"{shown(attributes['campaign'])}  \u00b7  Vibrotrough {attributes['program_version']}"
    figure.text(0.99, 0.01, name, ha="right", va="bottom", fontsize=points(7), color=GREY)
    if text:
        figure.text(0.01, 0.01, text, ha="left", va="bottom", fontsize=points(7), color=GREY)


def save(figure: Figure, output: pathlib.Path) -> list[pathlib.Path]:
    """Writes output.svg and output.png, or what else is wanted (the same bytes every time), and returns their paths."""
    paths = []
    dpi = 150 if plt.rcParams["savefig.dpi"] == "figure" else plt.rcParams["savefig.dpi"]
    for kind in target.formats:
        path = output.with_name(f"{output.name}.{kind}")
        try:
            output.parent.mkdir(parents=True, exist_ok=True)
            content = io.BytesIO()
            figure.savefig(content, format=kind, dpi=dpi, bbox_inches=None, metadata=UNDATED.get(kind))
            write_file(path, content.getvalue())
        except OSError as error:
            raise Problem(f"cannot write {path} ({error.strerror}); choose another --output") from error
        paths.append(path)
    plt.close(figure)
    return paths
