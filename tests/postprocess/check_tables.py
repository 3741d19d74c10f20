"""The figures of partition, cycles, segregation, open troughs and stages: what they draw is what the tables say, and a result without a table gives none.

usage: check_tables.py POSTPROCESS
"""

import pathlib
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, sys.argv[1])
from vibrotrough.figures import cycles, draw, residuals, tables  # noqa: E402


class Source:
    attributes = {"campaign": "sample", "program_version": "0.2.0"}
    campaign = {"case": ["abc"]}

    def row_of(self, case):
        return {"case": case, "throw_number": 2.0, "efficiency": 0.8, "efficiency_theory": None, "outcome": "finished"}


def drawn(plot, result):
    """The axes of the figure that would be saved; none when none would."""
    kept = []
    tables.save = lambda figure, path: kept.append(figure) or [path]
    plot(Source(), "abc", result, pathlib.Path("figure"))
    return kept[0].axes[0] if kept else None


def check_partition():
    result = {"partition/diameter": np.array([0.002, 0.004]), "partition/relative_diameter": np.array([0.5, 1]), "partition/stays": np.array([0.25, 1]), "partition/stays_low": np.array([0.2, 0.9]),
              "partition/stays_high": np.array([0.35, 1]), "partition/stays_by_model": np.array([0.5, 1]), "case/cut_size": np.array(0.003)}  # fmt: skip
    axes = drawn(tables.plot_partition, result)
    points, _, (bars,) = axes.containers[0]
    line = axes.lines[0]
    assert list(points.get_xdata()) == [2, 4] and points.get_linestyle() == "None"
    assert list(line.get_xdata()) == [2, 4] and list(line.get_ydata()) == [0.25, 1]
    np.testing.assert_allclose([bar[:, 1] for bar in bars.get_segments()], [[0.2, 0.35], [0.9, 1]])
    assert "d50 3 mm" in [text.get_text() for text in axes.get_legend().get_texts()]


def check_screening():
    """Efficiency over the length of screen: the end of each cycle, with its interval."""
    result = {"screening/distance": np.array([0, 0.2, 0.4]), "screening/efficiency": np.array([0, 0.6, 0.8]), "screening/efficiency_half_width": np.array([0, 0.1, np.nan])}
    axes = drawn(tables.plot_screening, result)
    assert list(axes.lines[0].get_xdata()) == [0, 0.2, 0.4] and list(axes.lines[0].get_ydata()) == [0, 0.6, 0.8]
    assert axes.get_xlabel() == "length of the screen  [m]"
    nothing = {**result, "screening/efficiency": np.full(3, np.nan)}
    assert drawn(tables.plot_screening, nothing) is None


def check_partition_through_the_opening():
    """d50 lies on the lines between the sizes; one through the opening, of which all spheres stay: 2 mm + (0.5 - 0.2) / (1 - 0.2) * (3 mm - 2 mm)."""
    result = {"partition/diameter": np.array([0.002, 0.004]), "partition/relative_diameter": np.array([2 / 3, 4 / 3]), "partition/stays_by_model": np.array([0.4, 1]),
              "case/cut_size": np.array(0.002375), **{f"partition/{name}": np.array([0.2, 1]) for name in ("stays", "stays_low", "stays_high")}}  # fmt: skip
    axes = drawn(tables.plot_partition, result)
    curves = {line.get_label(): line for line in axes.lines}
    measured, model, d50 = axes.lines[0], curves["one attempt in each cycle (Gaudin)"], curves["d50 2.38 mm"]
    np.testing.assert_allclose(np.interp(d50.get_xdata(), *measured.get_data()), d50.get_ydata())
    np.testing.assert_allclose(measured.get_xdata(), [2, 3, 4])
    assert list(measured.get_ydata()) == [0.2, 1, 1] and list(model.get_ydata()) == [0.4, 1, 1]
    # Without holes all stay.
    closed = {**result, "partition/relative_diameter": np.full(2, np.inf), "case/cut_size": np.array(np.nan)}
    assert list(drawn(tables.plot_partition, closed).lines[0].get_xdata()) == [2, 4]


def check_cycles_are_seen():
    """The interval of one packing, sixty times as wide as the cycles scatter, does not make them a straight line."""
    result = {"packings/seed": np.arange(2), "packings/cycles_discarded": np.zeros(2), "packings/efficiency": np.array([0.8, 0.8]),
              "packings/efficiency_half_width_statistics": np.array([6.0, 0.02]), "packings/verdict": ["steady", "steady"], "series/1/efficiency": np.array([0.75, 0.85, 0.8]),
              "series/2/efficiency": np.array([0.8, 0.82, 0.78])}  # fmt: skip
    kept = []
    cycles.save = lambda figure, path: kept.append(figure) or [path]
    low, high = figure_limits(kept, result)
    assert low <= 0.75 and high >= 0.85 and high - low <= 0.25, (low, high)
    # An interval that is not much wider is seen as a whole.
    result["packings/efficiency_half_width_statistics"] = np.array([0.07, 0.02])
    low, high = figure_limits(kept, result)
    assert low < 0.73 and high > 0.87, (low, high)


def check_stages():
    """Of drives in stages there is neither a mean of all cycles to draw nor a residual."""
    result = {"packings/seed": np.arange(1), "packings/cycles_discarded": np.zeros(1), "packings/efficiency": np.array([0.8]), "packings/verdict": ["steady"],
              "packings/efficiency_half_width_statistics": np.array([0.1]), "series/1/efficiency": np.array([0.75, 0.85, 0.8])}  # fmt: skip
    assert "mean and interval" in labels_of(result)
    assert labels_of({**result, "stages/start": np.zeros(1)}) == ["cycle"]
    assert residuals.plot_residuals(Source(), pathlib.Path("figure")) == []


def labels_of(result):
    kept = []
    cycles.save = lambda figure, path: kept.append(figure) or [path]
    cycles.plot_cycles(Source(), "abc", result, pathlib.Path("figure"))
    return kept[0].axes[0].get_legend_handles_labels()[1]


def figure_limits(kept, result):
    kept.clear()
    cycles.plot_cycles(Source(), "abc", result, pathlib.Path("figure"))
    return kept[0].axes[0].get_ylim()


def check_segregation():
    result = {"segregation/cycle": np.arange(3.0), "materials/name": ["grains", "fines"]}
    for number, sign in ((0, 1), (1, -1)):
        result[f"segregation/index_{number}"] = sign * np.array([0, 0.1, 0.2])
        result[f"segregation/half_width_{number}"] = np.full(3, 0.05)
    axes = drawn(tables.plot_segregation, result)
    assert list(axes.lines[1].get_ydata()) == [0, -0.1, -0.2]
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["grains", "fines"]


def check_materials_along():
    """Two panels over the place in millimetres, with a band for each material where it was."""
    result = {"materials_along/material": ["grains", "grains", "fines", "fines"], "materials_along/x": np.array([0.01, 0.03, 0.01, 0.03]),
              "materials_along/share": np.array([0.6, 1, 0.4, 0]), "materials_along/share_half_width": np.full(4, 0.1),
              "materials_along/segregation": np.array([0.5, np.nan, -0.5, np.nan]), "materials_along/segregation_half_width": np.full(4, 0.2)}  # fmt: skip
    shares, indices = drawn(tables.plot_segregation, result).get_figure().axes
    assert [list(line.get_xdata()) for line in shares.lines] == [[10, 30], [10, 30]] and list(shares.lines[1].get_ydata()) == [0.4, 0]
    assert indices.lines[1].get_ydata()[0] == -0.5 and [text.get_text() for text in shares.get_legend().get_texts()] == ["grains", "fines"]


def band_of(axes, number=0):
    """The corners of a band: those of the upper and the lower line."""
    return {tuple(corner) for corner in np.round(axes.collections[number].get_paths()[0].vertices, 12)}


def check_along():
    """Two panels over the place in millimetres, each with its band; a place without grains has no speed."""
    result = {"along_trough/x": np.array([0.01, 0.03, 0.05]), "along_trough/depth": np.array([0.012, 0.01, 0.008]), "along_trough/depth_half_width": np.array([0.001, 0.002, 0.001]),
              "along_trough/velocity": np.array([0.3, 0.4, np.nan]), "along_trough/velocity_half_width": np.array([0.05, 0.1, np.nan])}  # fmt: skip
    depth, speed = drawn(tables.plot_along, result).get_figure().axes
    np.testing.assert_allclose(depth.lines[0].get_data(), [[10, 30, 50], [12, 10, 8]])
    np.testing.assert_allclose(speed.lines[0].get_data(), [[10, 30, 50], [0.3, 0.4, np.nan]])
    assert {(10, 11), (10, 13), (30, 8), (30, 12), (50, 7), (50, 9)} <= band_of(depth)
    assert {(10, 0.25), (10, 0.35), (30, 0.3), (30, 0.5)} <= band_of(speed)
    assert depth.get_ylim()[0] == speed.get_ylim()[0] == 0


def check_residence():
    """The band lies across: at each share it is as wide as the interval of the time."""
    result = {"residence_times/share": np.array([0, 0.5, 1]), "residence_times/time": np.array([1.0, 2, 4]), "residence_times/time_half_width": np.array([0.1, 0.2, 0.5]),
              "case/residence_time": np.array(2.25)}  # fmt: skip
    axes = drawn(tables.plot_residence, result)
    np.testing.assert_allclose(axes.lines[0].get_data(), [[1, 2, 4], [0, 0.5, 1]])
    assert {(0.9, 0), (1.1, 0), (1.8, 0.5), (2.2, 0.5), (3.5, 1), (4.5, 1)} <= band_of(axes)
    assert list(axes.lines[1].get_xdata()) == [2.25, 2.25]
    # Plug flow is compared with where the mean is known; one packing has no band.
    alone = {**result, "case/residence_time": np.array(np.nan), "residence_times/time_half_width": np.full(3, np.nan)}
    axes = drawn(tables.plot_residence, alone)
    assert len(axes.lines) == 1 and axes.collections[0].get_paths() == []


def check_speed_over_stages():
    """Every cycle with its band, stages that stand still in grey, and the speed at the end of those that move."""
    result = {"stage_cycles/time": np.array([0.05, 0.15, 0.25, 0.35]), "stage_cycles/conveying_speed": np.array([0.1, 0.3, 0.2, 0]),
              "stage_cycles/conveying_speed_half_width": np.array([0.05, 0.1, 0.05, 0.01]), "stages/start": np.array([0, 0.2]), "stages/time": np.array([0.2, 0.2]),
              "stages/standstill": np.array([0.0, 1]), "stages/conveying_speed": np.array([0.3, 0]), "stages/conveying_speed_half_width": np.array([0.1, 0.01])}  # fmt: skip
    axes = drawn(tables.plot_stages, result)
    np.testing.assert_allclose(axes.lines[0].get_data(), [[0.05, 0.15, 0.25, 0.35], [0.1, 0.3, 0.2, 0]])
    assert {(0.05, 0.05), (0.05, 0.15), (0.15, 0.2), (0.15, 0.4)} <= band_of(axes)
    points, _, (bars,) = axes.containers[0]
    assert list(points.get_xdata()) == [0.2] and list(points.get_ydata()) == [0.3]
    np.testing.assert_allclose([bar[:, 1] for bar in bars.get_segments()], [[0.2, 0.4]])
    (grey,) = [patch for patch in axes.patches]
    np.testing.assert_allclose(grey.get_extents().transformed(axes.transData.inverted()).intervalx, [0.2, 0.4])
    assert [text.get_text() for text in axes.texts] == ["1", "2"]


def check_style():
    """A style sheet that is wrong ends the program as any wrong input does, before the campaign is read; of an unknown key matplotlib only warns."""
    with tempfile.TemporaryDirectory() as folder:
        style = pathlib.Path(folder, "own.mplstyle")
        for text in ("font.size: large letters\n", "no.such.key: 1\n", "font.size 12\n"):
            style.write_text(text)
            done = subprocess.run([sys.executable, "-B", "-m", "vibrotrough.figures.draw", folder, "--style", style], cwd=sys.argv[1], capture_output=True, text=True)
            assert done.returncode == 2 and done.stderr.count("\n") == 1, done.stderr
            assert f"cannot use the style sheet {style} (" in done.stderr, done.stderr


check_partition()
check_screening()
check_partition_through_the_opening()
check_cycles_are_seen()
check_stages()
check_segregation()
check_materials_along()
check_along()
check_residence()
check_speed_over_stages()
check_style()
for plot in (tables.plot_screening, tables.plot_partition, tables.plot_segregation, tables.plot_along, tables.plot_residence, tables.plot_stages):
    assert drawn(plot, {}) is None
# Each kind has a drawing function.
for kind in draw.KINDS:
    assert callable(draw.drawer(kind))
