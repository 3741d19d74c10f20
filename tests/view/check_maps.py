"""Run by pvbatch: ParaView's readers open a map of the theory and the lines between its modes.

usage: check_maps.py FOLDER: with map.vti and modes.vtp
"""

import os
import sys

from paraview.simple import OpenDataFile


def open_file(folder, name):
    source = OpenDataFile(os.path.join(folder, name))
    source.UpdatePipeline()
    return source, source.GetDataInformation()


def main(folder):
    source, found = open_file(folder, "map.vti")
    assert found.GetNumberOfPoints() == 30 and found.GetBounds()[:4] == (0.5, 3.0, 10.0, 50.0), found.GetBounds()
    low, high = source.PointData["velocity_efficiency"].GetRange()
    assert 0 < low < high < 1.1, f"eta from {low} to {high}"
    assert {"mode", "period_cycles"} <= set(source.PointData.keys()), source.PointData.keys()

    _, found = open_file(folder, "modes.vtp")
    assert found.GetNumberOfCells() > 0 and 0.5 <= found.GetBounds()[0] <= found.GetBounds()[1] <= 3.0

    print("map and modes open")


main(*sys.argv[1:])
