"""Draws as vibrotrough.figures.draw does, and refuses figures in which the footer (campaign and program, in a corner) lies over an axis.

usage: watched_figures.py HIGHER POSTPROCESS ARGUMENT...     HIGHER: how far footers are moved up, to see whether the watch sees them
"""

import runpy
import sys

from matplotlib.figure import Figure

CORNER = 0.02  # of the height: texts that begin below it are footers
drawn = Figure.savefig
higher = float(sys.argv[1])


def watched(figure, *words, **options):
    renderer = figure.canvas.get_renderer()
    for text in figure.texts:
        if text.get_position()[1] >= CORNER or not text.get_text():
            continue
        if higher:
            text.set_y(higher)
        footer = text.get_window_extent(renderer)
        for axes in figure.axes:
            taken = axes.get_tightbbox(renderer)
            if taken is not None and footer.overlaps(taken):
                print(f"{text.get_text()!r} lies over an axis", file=sys.stderr)
    return drawn(figure, *words, **options)


Figure.savefig = watched
sys.argv = sys.argv[2:]
sys.path.insert(0, sys.argv[0])
runpy.run_module("vibrotrough.figures.draw", run_name="__main__", alter_sys=True)
