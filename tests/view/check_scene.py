"""Run by pvbatch: opens the exported sample's scene and holds what ParaView shows to the engine's dumps.

usage: check_scene.py FOLDER DUMPS PICTURE
"""

import math
import os
import sys

from paraview import servermanager
from paraview.simple import (
    FindSource,
    GetActiveView,
    GetAnimationScene,
    GetColorTransferFunction,
    GetScalarBar,
    GetViews,
    Render,
    SaveScreenshot,
)
from paraview.vtk.vtkIOImage import vtkPNGReader

STEPS = [60000, 60300, 60600]
TIME_STEP = 2.4493014e-5
OMEGA = 2 * math.pi / (3000 * TIME_STEP)
AMPLITUDE_X, AMPLITUDE_Z = 0.00536656, 0.00268328
ARRAYS = {"radius": 1, "velocity": 3, "velocity_relative_to_trough": 3, "velocity_from_mean": 1, "height": 1, "id": 1}


def open_scene(folder):
    path = os.path.join(folder, "view_case.py")
    with open(path, encoding="utf-8") as file:
        exec(compile(file.read(), path, "exec"), {"__file__": path, "__name__": "__main__"})


def read_dump(path):
    """Rows of x y z vx vy vz radius."""
    with open(path, encoding="ascii") as file:
        return [[float(word) for word in line.split()[2:]] for line in file.readlines()[9:]]


def near(found, wanted, tolerance, what):
    assert abs(found - wanted) <= tolerance, f"{what}: ParaView has {found}, wanted {wanted} +- {tolerance}"


def check_frame(step, dumps):
    time = step * TIME_STEP
    GetAnimationScene().AnimationTime = time
    Render()
    rows = read_dump(os.path.join(dumps, f"frames.{step}.dump"))
    grains = FindSource("grains").GetDataInformation()
    assert grains.GetNumberOfPoints() == len(rows) == 500, f"{grains.GetNumberOfPoints()} grains at step {step}"
    arrays = FindSource("grains").PointData
    assert {name: arrays[name].GetNumberOfComponents() for name in arrays.keys()} == ARRAYS

    # Spheres of true size extend from the smallest x - r to the largest x + r. The facets of a sphere with 20 facets per
    # turn are closer to its centre than the radius by at most 1 - cos(pi / 20) = 1.3 %: 2e-5 m of 1.65 mm.
    bounds = FindSource("spheres").GetDataInformation().GetBounds()
    for axis in range(3):
        near(bounds[2 * axis], min(row[axis] - row[6] for row in rows), 2.2e-5, f"spheres, axis {axis}, low")
        near(bounds[2 * axis + 1], max(row[axis] + row[6] for row in rows), 2.2e-5, f"spheres, axis {axis}, high")

    # Velocities below 1 m/s, single precision: 1.2e-7.
    low, high = arrays["velocity_relative_to_trough"].GetRange(0)
    trough_speed = AMPLITUDE_X * OMEGA * math.cos(OMEGA * time)
    near(low, min(row[3] for row in rows) - trough_speed, 2e-7, "relative velocity, least")
    near(high, max(row[3] for row in rows) - trough_speed, 2e-7, "relative velocity, largest")

    # The layer's mean counts each grain with its volume; the difference is written to 1/16384 m/s, so that half of it can be off.
    volumes = [row[6] ** 3 for row in rows]
    mean = sum(row[3] * volume for row, volume in zip(rows, volumes)) / sum(volumes)
    low, high = arrays["velocity_from_mean"].GetRange()
    near(low, min(row[3] for row in rows) - mean, 3.1e-5, "velocity less the mean, least")
    near(high, max(row[3] for row in rows) - mean, 3.1e-5, "velocity less the mean, largest")

    assert FindSource("grains").FieldData["cycle"].GetRange(0) == (20.0, 20.0)
    phase = 360 * (step - 60000) / 3000
    near(FindSource("grains").FieldData["vibration_phase"].GetRange(0)[0], phase, 1e-6, "phase")
    text = annotation("cycle and phase")
    assert text == f"cycle 21, phase {phase:3.0f} deg", text

    # The block of the theory rests on the trough or flies above it, in front of the layer.
    block = FindSource("point_mass").GetDataInformation()
    assert block.GetNumberOfPoints() == 24 and block.GetNumberOfCells() == 6
    text = annotation("motion of the point mass")
    assert text.removeprefix("theory: the point mass ") in ("rests", "flies", "slides forwards", "slides backwards"), text
    gap = FindSource("point_mass").FieldData["gap"].GetRange(0)[0]
    assert (gap > 0) == (text == "theory: the point mass flies"), f"{text} at a gap of {gap} m"
    near(block.GetBounds()[4], AMPLITUDE_Z * math.sin(OMEGA * time) + gap, 1e-5, "block's floor")  # the engine's wiggle
    assert block.GetBounds()[3] < 0, "the block is beside the layer"
    lane = FindSource("lane of the point mass").GetDataInformation().GetBounds()
    assert lane[2] < block.GetBounds()[2] and block.GetBounds()[3] < lane[3] < 0, f"the lane is {lane}"

    # The profile contains all grains: the solid fraction summed over slabs of half a mean diameter.
    profile = FindSource("profile").PointData
    assert profile["solid_fraction"].GetRange()[1] < 0.75 and profile["height"].GetRange()[1] < 0.1

    # Rounding: six digits of 5 mm in the table and single precision of 4 cm in the trough, 5e-9 m together.
    trough = FindSource("trough").GetDataInformation().GetBounds()
    near(trough[0], AMPLITUDE_X * math.sin(OMEGA * time), 1e-8, "trough, x")
    near(trough[4], AMPLITUDE_Z * math.sin(OMEGA * time), 1e-8, "trough, z")


def annotation(name):
    """The content of a text annotation in the scene."""
    table = servermanager.Fetch(FindSource(name))
    return table.GetColumn(0).GetValue(0)


def check_charts():
    """There are two charts beside the layer: height over velocity and height over solid fraction."""
    charts = [view for view in GetViews() if view.GetXMLName() == "XYChartView"]
    assert len(charts) == 2, f"{len(charts)} charts"
    for chart in charts:
        assert chart.LeftAxisTitle == "height above the trough, mm" and chart.BottomAxisTitle
        (shown,) = chart.Representations
        assert shown.Input == FindSource("profile") and "height" in list(shown.SeriesVisibility)


def check_colours():
    """The bar says quantity and unit, reaches as far to both sides, and most grains are within its reach."""
    colours = GetColorTransferFunction("velocity_from_mean")
    bar = GetScalarBar(colours, GetActiveView())
    assert bar.Title == "velocity along the trough less the layer's mean, m/s" and bar.Visibility == 1, bar.Title
    points = list(colours.RGBPoints)
    low, high = points[0], points[-4]
    assert low == -high, f"from {low} to {high}"
    for label, wanted in zip(bar.CustomLabels, (low, low / 2, 0.0, high / 2, high)):
        near(label, wanted, 1e-12, "label of the bar")
    values = servermanager.Fetch(FindSource("grains")).GetPointData().GetArray("velocity_from_mean")
    sizes = sorted(abs(values.GetValue(i)) for i in range(500))
    # The reach is 1, 2 or 5 times a power of ten, so at most 2.5 times what 95 % of the grains have in a mean frame.
    assert sizes[250] < high and sizes[475] > high / 5, f"{sizes[250]} {sizes[475]} of {high}"


def check_picture(path):
    """Some grains are faster than the layer, others slower: red and blue both cover a part of the picture (a correct one
    has 3 % and more of each), and no colour covers all of the grains (20 %)."""
    view = GetActiveView()
    view.ViewSize = [400, 250]
    SaveScreenshot(path, view, ImageResolution=[400, 250])
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    pixels = reader.GetOutput().GetPointData().GetScalars()
    count = pixels.GetNumberOfTuples()
    red = sum(1 for i in range(count) if pixels.GetComponent(i, 0) > 1.3 * pixels.GetComponent(i, 2))
    blue = sum(1 for i in range(count) if pixels.GetComponent(i, 2) > 1.3 * pixels.GetComponent(i, 0))
    print(f"{path}: {red} of {count} pixels are red, {blue} are blue")
    for name, seen in (("red", red), ("blue", blue)):
        assert 0.01 * count < seen < 0.2 * count, f"{path}: {seen} of {count} pixels are {name}"


def main(folder, dumps, picture):
    os.chdir("/")  # the scene must open from any folder
    open_scene(folder)
    times = list(GetAnimationScene().TimeKeeper.TimestepValues)
    assert times == [step * TIME_STEP for step in STEPS], f"times {times}"
    for step in STEPS:
        check_frame(step, dumps)
    check_charts()
    check_colours()
    check_picture(picture)


main(*sys.argv[1:])
