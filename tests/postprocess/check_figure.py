"""Draws the sample's campaign.h5 and looks into the SVG and the PNG.

usage: check_figure.py POSTPROCESS CAMPAIGN_FOLDER WORK_FOLDER
"""

import pathlib
import sys
import xml.etree.ElementTree as ElementTree

import matplotlib.image

THEORY = """throw_number,vibration_angle_deg,velocity_efficiency
1.0,28.6479,0.1
2.0,28.6479,0.6
3.0,28.6479,
8.0,28.6479,0.7
1.0,14.0362,0.2
8.0,14.0362,0.3
"""


def elements(svg, kind):
    return ElementTree.parse(svg).iter("{http://www.w3.org/2000/svg}" + kind)


def texts(svg):
    return ["".join(element.itertext()).strip() for element in elements(svg, "text")]


def lines_in(svg, colour):
    return [path for path in elements(svg, "path") if colour in path.get("style", "") and "fill: none" in path.get("style")]


def main(scripts, campaign, work):
    sys.path.insert(0, scripts)
    from vibrotrough.figures.efficiency import draw_efficiency
    from vibrotrough.figures.style import Problem

    campaign, work = pathlib.Path(campaign), pathlib.Path(work)
    (work / "theory.csv").write_text(THEORY, encoding="utf-8")
    svg, png = work / "efficiency.svg", work / "efficiency.png"
    assert draw_efficiency(campaign, work / "theory.csv", work / "efficiency") == [svg, png]

    shown = texts(svg)
    for wanted in ("throw number \u0393", "velocity efficiency \u03b7", "\u03b2 = 28.6\u00b0", "95 % interval", "not steady",
                   "sample  \u00b7  Vibrotrough"):
        assert any(wanted in text for text in shown), f"'{wanted}' is not among {shown}"
    # The second angle has a theory line in the second colour and no points, so nothing in the legend.
    assert not any("\u03b2 = 14" in text for text in shown), shown
    assert len(lines_in(svg, "#0072b2")) > 0 and len(lines_in(svg, "#d55e00")) > 0
    picture = matplotlib.image.imread(png)
    assert picture.shape[:2] == (720, 1080) and picture[..., :3].min() < 0.1 < 0.9 < picture[..., :3].max()

    # The theory at the cases, as `vibrotrough compare --csv` prints it.
    (work / "compare.csv").write_text(
        "case,throw_number,vibration_angle_deg,inclination_deg,friction,efficiency_theory\n"
        "a,2.1,28.6479,0,0.23,0.55\nb,8.4,28.6479,0,0.23,0.61\n", encoding="utf-8")
    draw_efficiency(campaign, work / "compare.csv", work / "deep" / "er" / "efficiency")
    assert len(lines_in(work / "deep" / "er" / "efficiency.svg", "#0072b2")) > 0

    # The same campaign gives the same file, and mistakes are told.
    before = svg.read_bytes()
    draw_efficiency(campaign, work / "theory.csv", work / "efficiency")
    assert svg.read_bytes() == before, "the figure is not reproducible"
    for folder, theory in ((work / "none", work / "theory.csv"), (campaign, pathlib.Path(__file__))):
        try:
            draw_efficiency(folder, theory, work / "wrong")
        except Problem:
            continue
        raise AssertionError(f"{folder}, {theory} is drawn")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
