"""Opens an exported case in ParaView: the grains as spheres of true size, coloured by their velocity along the trough
relative to the trough, the moving trough, the point mass of the theory as a block on its own lane in front, the phase of
the vibration, and beside them the layer's velocity and solid fraction over height.

    paraview --state=FOLDER/view_case.py

works from any folder. `vibrotrough export` writes this file beside the .pvd files, with the three values below filled in;
postprocess/view_case.py is its template.
"""

from __future__ import annotations

import os
from typing import Any

import paraview
from paraview.simple import (
    AnnotateTimeFilter,
    AssignViewToLayout,
    ColorBy,
    CreateLayout,
    CreateView,
    GetActiveViewOrCreate,
    GetAnimationScene,
    GetColorTransferFunction,
    GetLayout,
    GetScalarBar,
    Glyph,
    Hide,
    PVDReader,
    PythonAnnotation,
    Render,
    SetActiveSource,
    SetActiveView,
    Show,
    Text,
    Transform,
)

CAPTION = "@CAPTION@"
FREQUENCY = "@FREQUENCY@"  # Hz, of the vibration
SPEED: Any = "@SPEED@"  # m/s, largest speed of the trough along itself

FOLDER = os.path.dirname(os.path.abspath(__file__))
COLOURED_BY = "velocity_relative_to_trough"
MOST_SPHERES = 5000  # above, grains are drawn as Gaussian points shaded like spheres, which need no triangles
INK = [0.1, 0.1, 0.1]


def has_frames(collection: str) -> bool:
    with open(os.path.join(FOLDER, collection), encoding="utf-8") as file:
        return "<DataSet" in file.read()


def open_collection(name: str) -> Any:
    reader = PVDReader(registrationName=name, FileName=os.path.join(FOLDER, name + ".pvd"))
    reader.UpdatePipeline()
    return reader


def colour_by_velocity(view: Any, shown: Any) -> None:
    """Blue where grains lag behind the trough, red where they run ahead, to twice the trough's largest speed."""
    ColorBy(shown, ("POINTS", COLOURED_BY, "X"))
    colours = GetColorTransferFunction(COLOURED_BY)
    colours.ApplyPreset("Cool to Warm", True)
    colours.AutomaticRescaleRangeMode = "Never"
    colours.RescaleTransferFunction(-2.0 * SPEED, 2.0 * SPEED)
    bar = GetScalarBar(colours, view)
    bar.Title = "velocity along the trough, relative to it, m/s"
    bar.ComponentTitle = ""
    bar.Orientation = "Horizontal"
    bar.WindowLocation = "Lower Center"
    bar.ScalarBarLength = 0.4
    bar.AutomaticLabelFormat = 0
    bar.LabelFormat = bar.RangeLabelFormat = "%.2f"
    bar.TitleColor = bar.LabelColor = INK
    bar.TitleFontSize = 16
    bar.LabelFontSize = 15
    shown.SetScalarBarVisibility(view, True)


def show_grains(view: Any, grains: Any) -> None:
    if grains.GetDataInformation().GetNumberOfPoints() > MOST_SPHERES:
        shown = Show(grains, view)
        shown.SetRepresentationType("Point Gaussian")
        shown.ShaderPreset = "Sphere"
        shown.ScaleByArray = 1
        shown.SetScaleArray = ["POINTS", "radius"]
        shown.UseScaleFunction = 0
        shown.GaussianRadius = 1.0
    else:
        # The sphere source has diameter 1, so twice the radius as the scale gives the true size.
        spheres = Glyph(registrationName="spheres", Input=grains, GlyphType="Sphere")
        spheres.OrientationArray = ["POINTS", "No orientation array"]
        spheres.ScaleArray = ["POINTS", "radius"]
        spheres.ScaleFactor = 2.0
        spheres.GlyphMode = "All Points"
        spheres.GlyphType.ThetaResolution = 20
        spheres.GlyphType.PhiResolution = 20
        Hide(grains, view)
        shown = Show(spheres, view)
        SetActiveSource(grains)
    colour_by_velocity(view, shown)


def show_trough(view: Any, trough: Any) -> None:
    shown = Show(trough, view)
    shown.SetRepresentationType("Surface With Edges")
    shown.ColorArrayName = ["POINTS", ""]
    shown.AmbientColor = shown.DiffuseColor = [0.75, 0.77, 0.8]
    shown.EdgeColor = [0.55, 0.57, 0.6]


def show_text(view: Any, source: Any, where: str) -> Any:
    shown = Show(source, view)
    shown.WindowLocation = where
    shown.Color = INK
    shown.FontSize = 16
    return shown


def show_point_mass(view: Any, trough: Any) -> tuple[Any, Any]:
    """The theory's block on a lane that is the trough once more, narrower and in front of it."""
    block = open_collection("point_mass")
    lane = Transform(registrationName="lane of the point mass", Input=trough)
    _, _, front, back, _, _ = trough.GetDataInformation().GetBounds()
    left_of_block, right_of_block = block.GetDataInformation().GetBounds()[2:4]
    edge = right_of_block - left_of_block
    low, high = left_of_block - 0.3 * edge, right_of_block + 0.3 * edge
    lane.Transform.Scale = [1.0, (high - low) / (back - front), 1.0]
    lane.Transform.Translate = [0.0, low - front * (high - low) / (back - front), 0.0]
    show_trough(view, lane)
    shown = Show(block, view)
    shown.SetRepresentationType("Surface With Edges")
    shown.EdgeColor = INK
    ColorBy(shown, ("POINTS", COLOURED_BY, "X"))
    return block, lane


def annotate(view: Any, grains: Any, block: Any) -> None:
    time = AnnotateTimeFilter(registrationName="time", Input=grains)
    time.Format = "t = {time:.4f} s"
    show_text(view, time, "Upper Left Corner")
    cycle = PythonAnnotation(registrationName="cycle and phase", Input=grains)
    cycle.ArrayAssociation = "Field Data"
    cycle.Expression = "'cycle %d, phase %3.0f deg' % (cycle[0] + 1, vibration_phase[0])"
    show_text(view, cycle, "Upper Right Corner")
    if block:
        motion = PythonAnnotation(registrationName="motion of the point mass", Input=block)
        motion.ArrayAssociation = "Field Data"
        motion.Expression = "'theory: the point mass ' + motion.GetValue(0)"
        show_text(view, motion, "Lower Left Corner")


def show_chart(layout: Any, location: int, share: float, profile: Any, what: str, axis_title: str, reach: tuple[float, float], height: float) -> int:
    """The layer's height upwards over one of its values, with axes that stay still."""
    layout_location = layout.SplitHorizontal(location, share) if location == 0 else layout.SplitVertical(location, share)
    chart = CreateView("XYChartView")
    AssignViewToLayout(view=chart, layout=layout, hint=layout_location + 1)
    shown = Show(profile, chart, "XYChartRepresentation")
    shown.AttributeType = "Point Data"
    shown.UseIndexForXAxis = 0
    shown.XArrayName = what
    shown.SeriesVisibility = ["height"]
    shown.SeriesLabel = ["height", "layer"]
    shown.SeriesColor = ["height", "0", "0.447", "0.698"]
    shown.SeriesLineThickness = ["height", "2"]
    shown.SeriesMarkerStyle = ["height", "4"]
    chart.ShowLegend = 0
    chart.BottomAxisTitleFontSize = chart.LeftAxisTitleFontSize = 14
    chart.BottomAxisTitleBold = chart.LeftAxisTitleBold = 0
    chart.BottomAxisTitle = axis_title
    chart.LeftAxisTitle = "height above the trough, m"
    chart.BottomAxisUseCustomRange = chart.LeftAxisUseCustomRange = 1
    chart.BottomAxisRangeMinimum, chart.BottomAxisRangeMaximum = reach
    chart.LeftAxisRangeMinimum, chart.LeftAxisRangeMaximum = 0.0, height
    return layout_location


def show_profile(view: Any, height: float) -> None:
    profile = open_collection("profile")
    layout = GetLayout(view)
    if layout is None:
        layout = CreateLayout(name="layout")
        AssignViewToLayout(view=view, layout=layout, hint=0)
    right = show_chart(layout, 0, 0.7, profile, "velocity_relative_to_trough_x", "velocity relative to the trough, m/s",
                       (-1.5 * SPEED, 2.0 * SPEED), height)
    show_chart(layout, right + 1, 0.5, profile, "solid_fraction", "solid fraction, 1", (0.0, 0.8), height)
    SetActiveView(view)


def look_along_the_width(view: Any, trough: Any, lane: Any, grains: Any) -> float:
    """From the side and a little from above, conveying to the right, with room above the layer for its flight."""
    left, right, front, back, floor, _ = trough.GetDataInformation().GetBounds()
    if lane:
        front = lane.GetDataInformation().GetBounds()[2]
    length, width = right - left, back - front
    height = max(grains.GetDataInformation().GetBounds()[5] - floor, 0.1 * length)
    focus = [(left + right) / 2, (front + back) / 2, floor + 0.52 * height]
    away = 3.0 * max(length, width, height)
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = focus
    view.CameraPosition = [focus[0] - 0.3 * away, focus[1] - away, focus[2] + 0.37 * away]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    # The box as seen from there: turned by 17 degrees, tilted by 19; half its larger side plus margins.
    seen_length, seen_depth = 0.96 * length + 0.29 * width, 0.96 * width + 0.29 * length
    view.CameraParallelScale = max(0.4 * seen_length, 0.78 * height + 0.25 * seen_depth)
    return height


def main() -> None:
    paraview.simple._DisableFirstRenderCameraReset()
    view = GetActiveViewOrCreate("RenderView")
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesLabelColor = INK
    if CAPTION:
        shown = show_text(view, Text(registrationName="caption", Text=CAPTION), "Any Location")
        shown.Position = [0.008, 0.91]  # below the time, whatever its length
    if not (has_frames("grains.pvd") and has_frames("trough.pvd")):
        show_text(view, Text(registrationName="note", Text="This case has no frames yet."), "Lower Left Corner")
        Render(view)
        return
    grains = open_collection("grains")
    trough = open_collection("trough")
    GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    show_trough(view, trough)
    block, lane = show_point_mass(view, trough) if has_frames("point_mass.pvd") else (None, None)
    show_grains(view, grains)
    annotate(view, grains, block)
    height = look_along_the_width(view, trough, lane, grains)
    show_profile(view, 1.8 * height)
    Render(view)


main()
