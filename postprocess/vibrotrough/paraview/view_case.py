"""Opens an exported case in ParaView: the grains as spheres of true size, coloured by their velocity along the trough
less the layer's mean, the moving trough, the point mass of the theory as a block on its own lane in front, the phase of
the vibration, and beside them the layer's velocity and solid fraction over height.

    paraview --state=FOLDER/view_case.py

works from any folder. `vibrotrough export` writes this file beside the .pvd files, with the values below filled in;
postprocess/vibrotrough/paraview/view_case.py is its template. `vibrotrough export --colour spin` (or height, or trough) and
`render_case.py --colour spin` colour the grains by something else.
"""

from __future__ import annotations

import math
import os
import sys
from typing import Any, NamedTuple

import paraview
from paraview.simple import (
    AnnotateTimeFilter,
    AssignViewToLayout,
    Clip,
    ColorBy,
    CreateLayout,
    CreateView,
    Delaunay2D,
    ExtractSurface,
    FeatureEdges,
    FindSource,
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
MATERIALS: Any = "@MATERIALS@"  # of a mixture: the engine's type and the name of each
SPEED: Any = "@SPEED@"  # m/s, largest speed of the trough along itself
# How far the colours reach, so that they mean the same in every frame; 0: as far as the values of the first frame shown.
VELOCITY_REACH: Any = "@VELOCITY_REACH@"  # m/s
SPIN_REACH: Any = "@SPIN_REACH@"  # over the angular frequency of the vibration
HEIGHT_REACH: Any = "@HEIGHT_REACH@"  # m
# Where the grains of all frames are, m: least and largest x, least and largest z; None: as in the first frame shown.
GRAIN_SPACE: Any = "@GRAIN_SPACE@"

FOLDER = os.path.dirname(os.path.abspath(__file__))


class Quantity(NamedTuple):
    """What the grains are coloured by: an array, how far its values reach, and whether they go both ways."""

    array: str
    title: str
    reach: float
    both_ways: bool = True
    preset: str = "Cool to Warm"
    component: tuple[str, ...] = ()


QUANTITIES = {
    "velocity": Quantity("velocity_from_mean", "velocity along the trough less the layer's mean, m/s", VELOCITY_REACH),
    "spin": Quantity("spin_over_omega", "spin across the trough over the angular frequency of the vibration, 1", SPIN_REACH),
    "height": Quantity("height", "height of the centre above the trough, m", HEIGHT_REACH, False, "Viridis (matplotlib)"),
    "size": Quantity("radius", "radius of the grains, m", 0.0, False, "Viridis (matplotlib)"),
    "material": Quantity("type", "material", 0.0),
    "trough": Quantity("velocity_relative_to_trough", "velocity along the trough, relative to it, m/s", 2.0 * SPEED, component=("X",)),
}
COLOUR = globals().get("CHOSEN_COLOUR") or "@COLOUR@"  # render_case.py chooses
MOST_SPHERES = 5000  # above, grains are drawn as Gaussian points shaded like spheres, which need no triangles
INK = [0.1, 0.1, 0.1]
# Of Okabe and Ito, told apart by the colour-blind.
MATERIAL_COLOURS = [[0.0, 0.447, 0.698], [0.902, 0.624, 0.0], [0.0, 0.62, 0.451], [0.8, 0.475, 0.655]]


def has_frames(collection: str) -> bool:
    with open(os.path.join(FOLDER, collection), encoding="utf-8") as file:
        return "<DataSet" in file.read()


def open_collection(name: str) -> Any:
    reader = PVDReader(registrationName=name, FileName=os.path.join(FOLDER, name + ".pvd"))
    reader.UpdatePipeline()
    return reader


def chosen_quantity(view: Any, grains: Any) -> Quantity:
    """What was asked for, or the velocity where the frames lack it."""
    quantity = QUANTITIES[COLOUR]
    if quantity.array in grains.PointData.keys() or grains.GetDataInformation().GetNumberOfPoints() == 0:
        return quantity
    note = f"These frames do not contain {quantity.array} (older versions wrote no spin; only mixtures have materials)."
    print("view_case.py:", note, file=sys.stderr)
    show_text(view, Text(registrationName="missing", Text=note), "Any Location").Position = [0.008, 0.81]
    return QUANTITIES["velocity"]


def range_of(quantity: Quantity, source: Any) -> tuple[float, float]:
    """Between which values the colours are; without a reach for the whole case, between those of the first frame's grains."""
    low, high = (-quantity.reach if quantity.both_ways else 0.0), quantity.reach
    if quantity.reach == 0:
        low, high = source.PointData[quantity.array].GetRange() if source.GetDataInformation().GetNumberOfPoints() else (0.0, 1.0)
        if quantity.both_ways:
            high = max(abs(low), abs(high)) or 1.0
            low = -high
    return (low, high) if low < high else (0.0, high or 1.0)


def colour_by(view: Any, shown: Any, quantity: Quantity, low: float, high: float) -> None:
    """The same colours in every frame, with few labels on the bar, which do not touch each other."""
    ColorBy(shown, ("POINTS", quantity.array, *quantity.component))
    colours = GetColorTransferFunction(quantity.array)
    bar = GetScalarBar(colours, view)
    bar.TitleColor = bar.LabelColor = INK
    bar.TitleFontSize = 16
    bar.LabelFontSize = 15
    bar.Title, bar.ComponentTitle = quantity.title, ""
    bar.Orientation, bar.WindowLocation = "Horizontal", "Lower Center"
    bar.ScalarBarLength = 0.4
    shown.SetScalarBarVisibility(view, True)
    if quantity.array == "type":
        colours.InterpretValuesAsCategories = colours.AnnotationsInitialized = 1
        colours.Annotations = [text for kind, name in MATERIALS for text in (str(kind), name)]
        colours.IndexedColors = [part for number in range(len(MATERIALS)) for part in MATERIAL_COLOURS[number]]
        return
    colours.ApplyPreset(quantity.preset, True)
    colours.AutomaticRescaleRangeMode = "Never"
    colours.RescaleTransferFunction(low, high)
    bar.AddRangeLabels = 0
    bar.UseCustomLabels = 1
    bar.CustomLabels = [low + share * (high - low) for share in (0.0, 0.25, 0.5, 0.75, 1.0)]
    bar.AutomaticLabelFormat = 0
    bar.LabelFormat = bar.RangeLabelFormat = "%.3g"


def show_grains(view: Any, grains: Any, quantity: Quantity) -> None:
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
    colour_by(view, shown, quantity, *range_of(quantity, grains))


def show_trough(view: Any, trough: Any, representation: str = "Surface With Edges") -> None:
    shown = Show(trough, view)
    shown.SetRepresentationType(representation)
    shown.ColorArrayName = ["POINTS", ""]
    shown.AmbientColor = shown.DiffuseColor = [0.75, 0.77, 0.8]
    shown.EdgeColor = [0.55, 0.57, 0.6]
    if not is_flat(trough):
        shown.Opacity = 0.35  # its own wall in front would hide the layer


def show_walls(view: Any) -> None:
    """The walls that are not part of the trough's own mesh, so clear that the layer is seen through the one in front, with their rims; not
    higher than grains ever are, since the deck's walls reach up to the top of the box and out of the picture."""
    walls = open_collection("walls")
    if GRAIN_SPACE:
        low_walls = Clip(registrationName="walls beside grains", Input=walls, ClipType="Plane")
        low_walls.ClipType.Origin, low_walls.ClipType.Normal = [0.0, 0.0, GRAIN_SPACE[3]], [0.0, 0.0, 1.0]
        walls = ExtractSurface(registrationName="surface of the walls", Input=low_walls)
    shown = Show(walls, view)
    shown.SetRepresentationType("Surface")
    shown.ColorArrayName = ["POINTS", ""]
    shown.AmbientColor = shown.DiffuseColor = [0.75, 0.77, 0.8]
    shown.Opacity = 0.15
    rims = FeatureEdges(registrationName="rims of the walls", Input=walls)
    rims.FeatureEdges = rims.NonManifoldEdges = rims.ManifoldEdges = 0
    rims.BoundaryEdges = 1
    shown = Show(rims, view)
    shown.ColorArrayName = ["POINTS", ""]
    shown.AmbientColor = shown.DiffuseColor = [0.45, 0.47, 0.5]


def is_flat(trough: Any) -> bool:
    left, right, _, _, floor, top = trough.GetDataInformation().GetBounds()
    return bool(top - floor <= 1e-6 * (right - left))


def show_text(view: Any, source: Any, where: str) -> Any:
    shown = Show(source, view)
    shown.WindowLocation = where
    shown.Color = INK
    shown.FontSize = 16
    return shown


def show_point_mass(view: Any, trough: Any, quantity: Quantity) -> tuple[Any, Any]:
    """The theory's block on a lane that is the trough once more, narrower and in front of it, without the holes of a screen, through
    which a point mass does not fall. The lane of a trough that is not flat would stand before the layer and hide it: there the
    block has none."""
    block = open_collection("point_mass")
    if not is_flat(trough):
        show_block(view, block, quantity)
        return block, None
    sheet = Delaunay2D(registrationName="trough without holes", Input=trough)
    lane = Transform(registrationName="lane of the point mass", Input=sheet)
    _, _, front, back, _, _ = trough.GetDataInformation().GetBounds()
    left_of_block, right_of_block = block.GetDataInformation().GetBounds()[2:4]
    edge = right_of_block - left_of_block
    low, high = left_of_block - 0.3 * edge, right_of_block + 0.3 * edge
    lane.Transform.Scale = [1.0, (high - low) / (back - front), 1.0]
    lane.Transform.Translate = [0.0, low - front * (high - low) / (back - front), 0.0]
    show_trough(view, lane, "Surface")
    show_block(view, block, quantity)
    return block, lane


def show_block(view: Any, block: Any, quantity: Quantity) -> None:
    shown = Show(block, view)
    shown.SetRepresentationType("Surface With Edges")
    shown.EdgeColor = INK
    if quantity.array in block.PointData.keys():
        ColorBy(shown, ("POINTS", quantity.array, *quantity.component))
    else:
        shown.ColorArrayName = ["POINTS", ""]
        shown.AmbientColor = shown.DiffuseColor = [0.75, 0.77, 0.8]


def open_contacts(view: Any) -> None:
    """The contacts as lines between centres, or to the trough, not shown at first. Press the eye beside them; the filter
    Tube, scaled by normal_force, draws force chains."""
    shown = Show(open_collection("contacts"), view)
    ColorBy(shown, ("CELLS", "normal_force"))
    shown.LineWidth = 3.0
    colours = GetColorTransferFunction("normal_force")
    colours.ApplyPreset("Viridis (matplotlib)", True)
    bar = GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = "normal force of a contact, N", ""
    bar.TitleColor = bar.LabelColor = INK
    shown.SetScalarBarVisibility(view, False)
    Hide(FindSource("contacts"), view)


def annotate(view: Any, grains: Any, block: Any) -> None:
    time = AnnotateTimeFilter(registrationName="time", Input=grains)
    time.Format = "t = {time:.4f} s"
    show_text(view, time, "Upper Left Corner")
    cycle = PythonAnnotation(registrationName="cycle and phase", Input=grains)
    cycle.ArrayAssociation = "Field Data"
    staged = "stage" in grains.FieldData.keys()
    cycle.Expression = ("'stage %d, ' % stage[0] + " if staged else "") + "'cycle %d, phase %3.0f deg' % (cycle[0] + 1, vibration_phase[0])"
    show_text(view, cycle, "Upper Right Corner")
    if block:
        motion = PythonAnnotation(registrationName="motion of the point mass", Input=block)
        motion.ArrayAssociation = "Field Data"
        motion.Expression = "'theory: the point mass ' + motion.GetValue(0)"
        show_text(view, motion, "Any Location").Position = [0.008, 0.86]  # below the caption: the colour bar needs the lower edge


def axis_labels(low: float, high: float, unit: float) -> list[str]:
    """Places along an axis and their texts, which are `unit` times as large: multiples of 1, 2 or 5 times a power of ten
    between the two ends, at most six."""
    step = 10.0 ** math.floor(math.log10((high - low) / 5))
    step *= next(digit for digit in (1, 2, 5, 10) if (high - low) / (digit * step) <= 5)
    places = [number * step for number in range(math.ceil(low / step), math.floor(high / step) + 1)]
    return [text for place in places for text in (f"{place:.9g}", f"{unit * place:.4g}")]


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
    chart.LeftAxisTitle = "height above the trough, mm"
    chart.BottomAxisUseCustomRange = chart.LeftAxisUseCustomRange = 1
    chart.BottomAxisRangeMinimum, chart.BottomAxisRangeMaximum = reach
    chart.LeftAxisRangeMinimum, chart.LeftAxisRangeMaximum = 0.0, height
    # Few and short labels: ParaView keeps less room for them than they need beside the axis's title.
    chart.LeftAxisUseCustomLabels = chart.BottomAxisUseCustomLabels = 1
    chart.LeftAxisLabels = axis_labels(0.0, height, 1000.0)
    chart.BottomAxisLabels = axis_labels(*reach, 1.0)
    chart.LeftAxisLabelFontSize = chart.BottomAxisLabelFontSize = 13
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


def look_along_the_width(view: Any, trough: Any, foremost: Any, grains: Any) -> float:
    """From the side and a little from above, conveying to the right, with room for the grains of all frames: above the layer for its
    flight, and below a screen for those that pass it. The height up to which charts must reach."""
    left, right, front, back, floor, _ = trough.GetDataInformation().GetBounds()
    if foremost:
        front = foremost.GetDataInformation().GetBounds()[2]
    low, high = floor, floor + 1.5 * (grains.GetDataInformation().GetBounds()[5] - floor)
    if GRAIN_SPACE:
        left, right = min(left, GRAIN_SPACE[0]), max(right, GRAIN_SPACE[1])
        low, high = min(low, GRAIN_SPACE[2]), max(floor, GRAIN_SPACE[3])
    length, width = right - left, back - front
    height = max(high - low, 0.15 * length)
    focus = [(left + right) / 2, (front + back) / 2, low + 0.35 * height + 0.15 * (high - low)]
    away = 3.0 * max(length, width, height)
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = focus
    view.CameraPosition = [focus[0] - 0.3 * away, focus[1] - away, focus[2] + 0.37 * away]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    # The box as seen from there: turned by 17 degrees, tilted by 19; half its larger side plus margins.
    seen_length, seen_depth = 0.96 * length + 0.29 * width, 0.96 * width + 0.29 * length
    view.CameraParallelScale = max(0.4 * seen_length, 0.52 * height + 0.25 * seen_depth)
    return max(high - floor, 0.1 * length)


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
    quantity = chosen_quantity(view, grains)
    block, lane = show_point_mass(view, trough, quantity) if has_frames("point_mass.pvd") else (None, None)
    show_grains(view, grains, quantity)
    if os.path.exists(os.path.join(FOLDER, "walls.pvd")) and has_frames("walls.pvd"):
        show_walls(view)
    if os.path.exists(os.path.join(FOLDER, "contacts.pvd")) and has_frames("contacts.pvd"):
        open_contacts(view)
    annotate(view, grains, block)
    height = look_along_the_width(view, trough, lane or block, grains)
    show_profile(view, 1.2 * height)
    Render(view)


main()
