"""Opens an exported case in ParaView: the grains as spheres of true size, coloured by their velocity along the trough
relative to the trough, and the moving trough.

    paraview --state=FOLDER/view_case.py

works from any folder. `vibrotrough export` writes this file beside grains.pvd and trough.pvd, with the three values
below filled in; postprocess/view_case.py is its template.
"""

import os

import paraview
from paraview.simple import (
    AnnotateTimeFilter,
    ColorBy,
    GetActiveViewOrCreate,
    GetAnimationScene,
    GetColorTransferFunction,
    GetScalarBar,
    Glyph,
    Hide,
    PVDReader,
    Render,
    SetActiveSource,
    Show,
    Text,
)

CAPTION = "@CAPTION@"
FREQUENCY = "@FREQUENCY@"  # Hz, of the vibration
SPEED = "@SPEED@"  # m/s, largest speed of the trough along itself

FOLDER = os.path.dirname(os.path.abspath(__file__))
COLOURED_BY = "velocity_relative_to_trough"
MOST_SPHERES = 5000  # above, grains are drawn as Gaussian points shaded like spheres, which need no triangles
INK = [0.1, 0.1, 0.1]


def has_frames(collection):
    with open(os.path.join(FOLDER, collection), encoding="utf-8") as file:
        return "<DataSet" in file.read()


def open_collection(name):
    reader = PVDReader(registrationName=name, FileName=os.path.join(FOLDER, name + ".pvd"))
    reader.UpdatePipeline()
    return reader


def colour_by_velocity(view, shown):
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


def show_grains(view, grains):
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


def show_trough(view, trough):
    shown = Show(trough, view)
    shown.SetRepresentationType("Surface With Edges")
    shown.ColorArrayName = ["POINTS", ""]
    shown.AmbientColor = shown.DiffuseColor = [0.75, 0.77, 0.8]
    shown.EdgeColor = [0.55, 0.57, 0.6]


def show_text(view, source, where):
    shown = Show(source, view)
    shown.WindowLocation = where
    shown.Color = INK
    shown.FontSize = 16
    return shown


def annotate(view, grains):
    time = AnnotateTimeFilter(registrationName="time", Input=grains)
    time.Format = "t = {time:.4f} s"
    show_text(view, time, "Upper Left Corner")
    cycle = AnnotateTimeFilter(registrationName="cycle", Input=grains)
    cycle.Format = "t / T = {time:.2f}"
    cycle.Scale = FREQUENCY
    show_text(view, cycle, "Upper Right Corner")


def look_along_the_width(view, trough, grains):
    """From the side and a little from above, conveying to the right, with room above the layer for its flight."""
    left, right, front, back, floor, _ = trough.GetDataInformation().GetBounds()
    length, width = right - left, back - front
    height = max(grains.GetDataInformation().GetBounds()[5] - floor, 0.1 * length)
    focus = [(left + right) / 2, (front + back) / 2, floor + 0.6 * height]
    away = 3.0 * max(length, width, height)
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = focus
    view.CameraPosition = [focus[0] - 0.3 * away, focus[1] - away, focus[2] + 0.37 * away]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    # The box as seen from there: turned by 17 degrees, tilted by 19; half its larger side plus margins.
    seen_length, seen_depth = 0.96 * length + 0.29 * width, 0.96 * width + 0.29 * length
    view.CameraParallelScale = max(0.37 * seen_length, 0.85 * height + 0.17 * seen_depth)


def main():
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
    show_grains(view, grains)
    annotate(view, grains)
    look_along_the_width(view, trough, grains)
    Render(view)


main()
