"""Draws a campaign's figures, each as SVG and PNG or as asked; `vibrotrough plot DIR` calls it.

    python3 -m vibrotrough.figures.draw DIR [--output OUT] [--only KIND] [--case ID] [--format KIND] [--width METRES] [--style FILE]

DIR holds campaign.h5 and cases/, OUT (by default DIR/report) the folder `data` with what the program computed of the
theory. Prints the path of every file it wrote. Nothing of the theory is computed here.
"""

import argparse
import concurrent.futures.process
import functools
import importlib
import multiprocessing
import os
import pathlib
import signal
import sys
import warnings
from collections.abc import Callable, Collection, Iterator

from . import columns
from .drawn import KINDS, DrawnFigures, Kind, digest_of_data
from .source import Source
from .style import FORMATS, Problem, TooMany, TooNarrow, WrongInput, one_line, plt, shown, take_style, target


def draw(source: Source, only: Collection[str], cases: Collection[str]) -> Iterator[list[pathlib.Path]]:
    """Draws one figure after another, notes what it was drawn from, and gives the paths of each."""
    drawn = DrawnFigures(source.output)
    data = digest_of_data(source.directory, source.output)
    for paths in draw_general(source, only):
        drawn.remember(paths, data)
        yield paths
    for data, figures in draw_cases(source, only, [case for case in source.campaign["case"] if not cases or case in cases]):
        for paths in figures:
            drawn.remember(paths, data)
            yield paths


Figures = tuple[str, list[list[pathlib.Path]]]  # what a case's figures were drawn from, and the files of each


def figures_of_case(source: Source, only: Collection[str], case: str) -> Figures:
    return digest_of_data(source.directory, source.output, case), list(draw_case(source, only, case))


# A process that draws knows them from the process that made it.
inherited: tuple[Source, Collection[str]] | None = None


def draw_inherited(case: str) -> Figures:
    assert inherited is not None
    return figures_of_case(*inherited, case)


def end_with_the_others() -> None:
    """Ctrl-C reaches all processes of a command: one that draws ends at once, and the first one says so."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def draw_cases(source: Source, only: Collection[str], cases: list[str]) -> Iterator[Figures]:
    """The figures of each case, in this order; as many cases are drawn at a time as there are processors."""
    global inherited
    processes = min(len(os.sched_getaffinity(0)), len(cases))
    if processes < 2:
        yield from (figures_of_case(source, only, case) for case in cases)
        return
    inherited = source, only
    with concurrent.futures.ProcessPoolExecutor(processes, multiprocessing.get_context("fork"), end_with_the_others) as pool:
        try:
            yield from pool.map(draw_inherited, cases)
        except concurrent.futures.process.BrokenProcessPool as error:
            raise Problem("a process that drew figures was ended, perhaps because memory ran out; run the command again") from error


def drawn(name: str, file: pathlib.Path, draw_one: Callable[[], list[pathlib.Path]]) -> list[pathlib.Path]:
    """Draws a figure. One that cannot be read in print, or whose file holds what cannot be drawn, is left out and named."""
    try:
        return draw_one()
    except (TooMany, TooNarrow) as problem:
        print(shown(f"vibrotrough: {name} is left out: {problem}"), file=sys.stderr)
    except Problem:
        raise
    except Exception as error:  # a file may be whole and still hold anything
        if target.style is not None:
            raise WrongInput(f"{name} cannot be drawn in the style of {target.style} ({one_line(error)}); correct the style sheet or leave --style out") from error
        print(shown(f"vibrotrough: {name} is left out: {file} cannot be drawn ({one_line(error)}); delete it, and let vibrotrough make it again"),
              file=sys.stderr)
    plt.close("all")
    return []


def drawer(kind: Kind) -> Callable[..., list[pathlib.Path]]:
    """The function that draws a kind of figure; it returns the files that it wrote, none when there is nothing to draw."""
    found: Callable[..., list[pathlib.Path]] = getattr(importlib.import_module(f"vibrotrough.figures.{kind.module}"), f"plot_{kind.kind}")
    return found


def draw_general(source: Source, only: Collection[str]) -> Iterator[list[pathlib.Path]]:
    """The figures of the campaign as a whole."""
    for kind in KINDS:
        if kind.kind in only and not kind.is_of_case:
            yield drawn(kind.kind, source.directory / kind.file, functools.partial(drawer(kind), source, source.output / kind.kind))


def draw_case(source: Source, only: Collection[str], case: str) -> Iterator[list[pathlib.Path]]:
    """The figures of one case, when its result.h5 is there and whole."""
    wanted = [kind for kind in KINDS if kind.kind in only and kind.is_of_case]
    if not wanted:
        return
    try:
        result = source.campaign.case(case).result
    except Exception as error:  # HDF5 has errors of many kinds
        print(shown(f"vibrotrough: case {case} is left out: {one_line(error)}"), file=sys.stderr)
        return
    for kind in wanted:
        name = f"{kind.kind}-{case}"
        yield drawn(name, result.path, functools.partial(drawer(kind), source, case, result, source.output / name))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    kinds = [kind.kind for kind in KINDS]
    parser.add_argument("directory", type=pathlib.Path, metavar="DIR", help="a campaign's folder, with campaign.h5")
    parser.add_argument("--output", type=pathlib.Path, metavar="OUT", help="folder of the figures")
    parser.add_argument("--only", action="append", choices=kinds, help="draw this kind only")
    parser.add_argument("--case", action="append", default=[], metavar="ID", help="single cases' figures of this one only")
    parser.add_argument("--format", action="append", choices=FORMATS, help="write this kind of file; several for several")
    parser.add_argument("--width", type=float, metavar="METRES", help="width of every figure, for print")
    parser.add_argument("--x", metavar="COLUMN", help="draw one figure: a column of 'compare' over this one")
    parser.add_argument("--y", metavar="COLUMN", help="the column that is drawn over --x")
    parser.add_argument("--by", metavar="COLUMN", help="the column that tells series apart")
    parser.add_argument("--unit", help="unit of --y")
    parser.add_argument("--factor", type=float, default=1.0, help="from the table's unit of --y to --unit")
    parser.add_argument("--with", action="append", default=[], type=pathlib.Path, metavar="OUT", dest="others", help="output of another campaign")
    parser.add_argument("--style", type=pathlib.Path, metavar="FILE", help="a style sheet of matplotlib")
    options = parser.parse_args()
    target.formats, target.width = tuple(options.format or target.formats), options.width
    if options.style is not None:
        take_style(options.style)
    # Bars of an interval that is not known are left out, of which matplotlib would warn.
    warnings.filterwarnings("ignore", message="Warning: converting a masked element to nan")
    output = options.output or options.directory / "report"
    if options.x is not None:
        figures = iter([columns.plot_columns([output, *options.others], output, options.x, options.y,
                                                    options.by and [options.by], options.unit, options.factor)])
    else:
        figures = draw(Source(options.directory, output), options.only or kinds, options.case)
    for paths in figures:
        for path in paths:
            print(shown(path), flush=True)


if __name__ == "__main__":
    try:
        main()
    except WrongInput as problem:
        print(shown(f"vibrotrough: {problem}"), file=sys.stderr)
        sys.exit(2)
    except Problem as problem:
        sys.exit(shown(f"vibrotrough: {problem}"))
