"""Renders an exported case to PNG with ParaView, without a window.

    pvbatch --force-offscreen-rendering render_case.py FOLDER FILE.png [--time SECONDS] [--size WIDTH HEIGHT] [--with-profile]
            [--colour velocity|spin|height|trough|size|material]

FOLDER is what `vibrotrough export` left (with view_case.py); the frame nearest to the time is drawn, by default the last.
Debian's pvbatch renders through X: put xvfb-run -a -s "-screen 0 1600x1000x24 +extension GLX -noreset" before it on a
machine without a screen. Ends with an error when a frame holds nothing.
"""

import argparse
import os

from paraview.simple import FindSource, GetActiveView, GetAnimationScene, GetLayout, Render, SaveScreenshot


def open_scene(folder: str, colour: str | None) -> None:
    """Runs the case's own scene, so that the picture is what a person sees."""
    path = os.path.join(os.path.abspath(folder), "view_case.py")
    with open(path, encoding="utf-8") as file:
        exec(compile(file.read(), path, "exec"), {"__file__": path, "__name__": "__main__", "CHOSEN_COLOUR": colour})


def go_to(time: float | None) -> float:
    scene = GetAnimationScene()
    times = list(scene.TimeKeeper.TimestepValues)
    if not times:
        raise SystemExit("render_case.py: the case has no frames; set output.frames_per_cycle and run it")
    scene.AnimationTime = times[-1] if time is None else min(times, key=lambda at: abs(at - time))
    return scene.AnimationTime


def count(name: str, time: float) -> int:
    """Points of an object; a reader that fails gives none and no error, so this is how it is noticed."""
    source = FindSource(name)
    source.UpdatePipeline(time)
    points = source.GetDataInformation().GetNumberOfPoints()
    if points == 0:
        raise SystemExit(f"render_case.py: {name} is empty at {time} s; export the case again")
    return points


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("folder")
    parser.add_argument("picture")
    parser.add_argument("--time", type=float)
    parser.add_argument("--size", type=int, nargs=2, default=[1600, 1000], metavar=("WIDTH", "HEIGHT"))
    parser.add_argument("--colour", choices=["velocity", "spin", "height", "trough", "size", "material"],
                        help="what the grains are coloured by: velocity along the trough less the layer's mean; spin across the "
                        "trough; height above it; velocity relative to it; radius; material. Default: what 'vibrotrough export' chose")  # fmt: skip
    parser.add_argument("--with-profile", action="store_true", help="draw the charts beside the layer, too")
    options = parser.parse_args()

    open_scene(options.folder, options.colour)
    view = GetActiveView()
    if options.with_profile:
        drawn = GetLayout(view)
        drawn.SetSize(options.size)
    else:
        drawn, view.ViewSize = view, options.size
    time = go_to(options.time)
    grains, nodes = count("grains", time), count("trough", time)
    Render(view)
    SaveScreenshot(options.picture, drawn, ImageResolution=options.size)
    print(f"{options.picture}: {grains} grains and {nodes} nodes of the trough at {time} s")


main()
