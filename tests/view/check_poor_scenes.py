"""Run by pvbatch: cases with no frame, with one, with frames without grains, without a periodic point mass, and with a wall all open.

usage: check_poor_scenes.py FOLDER: the subfolders none, one, no_grains, no_point_mass and walls are exports
"""

import os
import sys

from paraview.simple import FindSource, GetActiveView, GetAnimationScene, Render, ResetSession, SaveScreenshot


def open_scene(folder):
    path = os.path.join(folder, "view_case.py")
    with open(path, encoding="utf-8") as file:
        exec(compile(file.read(), path, "exec"), {"__file__": path, "__name__": "__main__"})


def points(name):
    return FindSource(name).GetDataInformation().GetNumberOfPoints()


def check_walls(folder):
    """From the floor up to where grains are, although the deck's walls may reach out of the picture."""
    names = {}
    with open(os.path.join(folder, "view_case.py"), encoding="utf-8") as file:
        exec(next(line for line in file if line.startswith("GRAIN_SPACE")), {"Any": object}, names)
    floor, top = FindSource("walls").GetDataInformation().GetBounds()[4:]
    assert top > names["GRAIN_SPACE"][3], "the sample's wall is no test of this"
    low, high = FindSource("rims of the walls").GetDataInformation().GetBounds()[4:]
    assert abs(low - floor) < 1e-9 and abs(high - names["GRAIN_SPACE"][3]) < 1e-6, (low, high)


def main(folder):
    # name: times, grains, points of the block (None: the object does not exist)
    wanted = {"none": (0, None, None), "one": (1, 500, 24), "no_grains": (1, 0, 24), "no_point_mass": (3, 500, None), "walls": (3, 500, None)}
    for name, (times, grains, block) in wanted.items():
        ResetSession()
        open_scene(os.path.join(folder, name))
        found = list(GetAnimationScene().TimeKeeper.TimestepValues or [])
        assert len(found) == times, f"{name}: times {found}"
        for source, count in (("grains", grains), ("point_mass", block)):
            if count is None:
                assert FindSource(source) is None, f"{name} has {source}"
            else:
                assert points(source) == count, f"{name}: {points(source)} points of {source}"
        wall = FindSource("rims of the walls")
        assert (points("rims of the walls") >= 4) if name == "walls" else (wall is None), name
        if name == "walls":
            check_walls(os.path.join(folder, name))
        Render()
        picture = os.path.join(folder, name + ".png")
        SaveScreenshot(picture, GetActiveView(), ImageResolution=[400, 250])
        assert os.path.getsize(picture) > 1000
        print(f"{name} opens")


main(*sys.argv[1:])
