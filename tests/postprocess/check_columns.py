"""The figure of any two columns: what is drawn are the numbers of the table, in the unit that was asked for; mistakes are told in one line.

usage: check_columns.py SCRIPTS COLUMNS WORK
COLUMNS is the program that prints the columns as campaign.json describes them.
"""

import json
import math
import pathlib
import subprocess
import sys

SPEED_SCALE = 0.4  # m/s of an efficiency of 1
HEIGHTS = (0.006, 0.012, 0.024)  # m


def swept(key, unit):
    return {"name": key, "unit": unit, "type": "number", "meaning": "", "key": key, "report": None}


def efficiency(height, rolling_friction):
    return 0.5 + 5 * height - rolling_friction


def make_table(columns, folder, name):
    rows = [{"case": f"{height} {rolling}", "layer.height": height, "grains.rolling_friction": rolling, "efficiency": efficiency(height, rolling),
             "efficiency_half_width_statistics": 0.02, "efficiency_half_width": 0.03, "outcome": "finished", "efficiency_theory": 0.55,
             "conveying_speed_m_per_s": SPEED_SCALE * efficiency(height, rolling), "conveying_speed_half_width_m_per_s": 0.01,
             "efficiency_rolling_layer": 0.7 if rolling == 0 else None,
             "mass_flow_per_width_t_per_h_m": 20 * height / 0.006, "mass_flow_per_width_half_width_t_per_h_m": 2.0}
            for rolling in (0.0, 0.1) for height in HEIGHTS]  # fmt: skip
    rows.append({"case": "failed", "layer.height": 0.1, "grains.rolling_friction": 0.0, "efficiency": None, "outcome": "lost-grains"})
    (folder / "data").mkdir(parents=True, exist_ok=True)
    (folder / "data" / "campaign.json").write_text(json.dumps({
        "campaign": name, "program_version": "0.2.0", "rows": [], "cases": rows,
        "columns": [swept("layer.height", "m"), swept("grains.rolling_friction", "1"), *columns],
        "swept": [{"column": "layer.height"}, {"column": "grains.rolling_friction"}]}), encoding="utf-8")


def drawn_by(scripts, outputs, *asked):
    """The figure that would be saved."""
    sys.path.insert(0, str(scripts))
    from vibrotrough.figures import columns
    kept = []
    columns.save = lambda figure, path: kept.append((figure, path)) or []
    columns.plot_columns(outputs, outputs[0], *asked)
    return kept[0]


def check_numbers(scripts, outputs):
    figure, path = drawn_by(scripts, outputs, "layer.height", "conveying_speed_m_per_s", None, "m/min", 60.0)
    axes = figure.axes[0]
    assert path.name == "conveying_speed-over-height", path
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("layer height  [mm]", "conveying speed  [m/min]")
    names = [text.get_text() for text in axes.get_legend().get_texts()]
    assert names == [f"{name}, grain rolling friction {value}" for name in "ab" for value in (0, 0.1)], names
    for container, rolling in zip(axes.containers, (0.0, 0.1) * 2, strict=True):
        points, _, (bars,) = container
        for x, y, height in zip(*points.get_data(), HEIGHTS, strict=True):
            assert math.isclose(x, 1e3 * height) and math.isclose(y, 60 * SPEED_SCALE * efficiency(height, rolling))
        low, high = bars.get_segments()[0][:, 1]
        assert math.isclose(high - low, 2 * 60 * 0.01)
    # The theory and the law in the unit of the points: of the first series both, of the second the theory alone.
    models = [line for line in axes.lines if line.get_marker() in ("x", "+")]
    lines = [line.get_ydata()[0] for line in models]
    expected = [60 * SPEED_SCALE * one for one in (0.55, 0.7, 0.55)] * 2
    assert len(lines) == len(expected) and all(map(math.isclose, lines, expected)), lines
    # Dashes tell the models apart, also in black and white.
    assert [line.get_linestyle() + line.get_marker() for line in models] == ["-x", "--+", "-x"] * 2
    assert axes.get_legend().get_title().get_text() == "solid: point-mass theory; dashed: rolling-layer law"
    assert "2 of 14 cases are not known" in [text.get_text() for text in figure.texts]


def check_single_cases(scripts, outputs):
    """Where each series has only one case, the figure says which mark stands for which model."""
    figure, _ = drawn_by(scripts, outputs[:1], "layer.height", "efficiency", ["layer.height", "grains.rolling_friction"], None, 1.0)
    assert figure.axes[0].get_legend().get_title().get_text() == "cross: point-mass theory; plus: rolling-layer law"


def check_whole_interval(scripts, outputs):
    """Of an efficiency the bars are those of the whole interval."""
    figure, _ = drawn_by(scripts, outputs[:1], "layer.height", "efficiency", ["grains.rolling_friction"], None, 1.0)
    low, high = figure.axes[0].containers[0][2][0].get_segments()[0][:, 1]
    assert math.isclose(high - low, 0.06)


def check_flow_of_a_metre(scripts, outputs):
    """The mass flow of a metre of width has the bars and the models of the speed, and its name has no unit in it."""
    figure, path = drawn_by(scripts, outputs[:1], "layer.height", "mass_flow_per_width_t_per_h_m", [], None, 1.0)
    axes = figure.axes[0]
    assert path.name == "mass_flow_per_width-over-height" and axes.get_ylabel() == "mass flow per width  [t/h/m]", (path, axes.get_ylabel())
    assert axes.containers[0].has_yerr and len([line for line in axes.lines if line.get_marker() in ("x", "+")]) == 2


def check_that_only_speeds_have_a_theory(scripts, outputs):
    figure, _ = drawn_by(scripts, outputs[:1], "layer.height", "efficiency_half_width_statistics", None, None, 1.0)
    assert not [line for line in figure.axes[0].lines if line.get_marker() == "x"], "the theory of a half-width"


def check_keys_that_vary_together(scripts, outputs):
    """Keys of one [zip] make one series for each value of another key, and not one of each point."""
    path = outputs[0] / "data" / "campaign.json"
    before = path.read_text(encoding="utf-8")
    table = json.loads(before)
    for row in table["cases"]:
        row["grains.friction"] = 50 * row["layer.height"]
    table["columns"].append(swept("grains.friction", "1"))
    table["swept"].append({"column": "grains.friction"})
    path.write_text(json.dumps(table), encoding="utf-8")
    for x in ("layer.height", "grains.friction"):
        figure, _ = drawn_by(scripts, outputs[:1], x, "efficiency", None, None, 1.0)
        names = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
        assert names == [f"grain rolling friction {value}" for value in (0, 0.1)], (x, names)
    path.write_text(before, encoding="utf-8")


def check_mistakes(scripts, outputs):
    for asked, said in {("nonsense", "efficiency"): "no campaign has a column nonsense",
                        ("layer.height", "mass_flow_t_per_h"): "how wide the trough is (trough.width); draw mass_flow_per_width"}.items():  # fmt: skip
        x, y = asked
        done = subprocess.run(["/usr/bin/python3", "-B", "-m", "vibrotrough.figures.draw", outputs[0], "--output", outputs[0], "--x", x, "--y", y],
                              cwd=scripts, capture_output=True, text=True)
        assert done.returncode == 2 and said in done.stderr and done.stderr.count("\n") == 1, done.stderr


def main():
    scripts, columns, work = map(pathlib.Path, sys.argv[1:])
    described = json.loads(subprocess.run([columns], capture_output=True, check=True).stdout)
    outputs = [work / "columns" / name for name in "ab"]
    for folder in outputs:
        make_table(described, folder, folder.name)
    check_numbers(scripts, outputs)
    check_single_cases(scripts, outputs)
    check_whole_interval(scripts, outputs)
    check_that_only_speeds_have_a_theory(scripts, outputs)
    check_flow_of_a_metre(scripts, outputs)
    check_keys_that_vary_together(scripts, outputs)
    check_mistakes(scripts, outputs)


if __name__ == "__main__":
    main()
