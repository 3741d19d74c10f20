"""The figures of impacts, partition and segregation: what they draw is what the tables say, and a result without a table gives none.

usage: check_tables.py POSTPROCESS
"""

import math
import pathlib
import sys

import numpy as np

sys.path.insert(0, sys.argv[1])
import figure_tables  # noqa: E402


class Source:
    attributes = {"campaign": "sample", "program_version": "0.2.0"}

    def row_of(self, case):
        return {"case": case, "throw_number": 2.0}


def drawn(plot, result):
    """The axes of the figure that would be saved; none when none would."""
    kept = []
    figure_tables.save = lambda figure, path: kept.append(figure) or [path]
    plot(Source(), "abc", result, pathlib.Path("figure"))
    return kept[0].axes[0] if kept else None


def check_impacts():
    edges = 10.0 ** np.arange(-8, -6.9, 0.2)
    result = {"impact_spectrum/energy_from": edges[:-1], "impact_spectrum/energy_to": edges[1:]}
    for name in ("rate", "trough_rate"):
        result[f"impact_spectrum/{name}"] = np.array([50.0, 40, 30, 0, 10])
        result[f"impact_spectrum/{name}_half_width"] = np.array([5.0, 50, 3, 0, 1])
    axes = drawn(figure_tables.plot_impacts, result)
    values, drawn_edges, _ = axes.patches[0].get_data()
    # A class is a fifth of a decade wide; in microjoules.
    np.testing.assert_allclose(drawn_edges, 1e6 * edges)
    np.testing.assert_allclose(values[[0, 1, 2, 4]], np.array([250, 200, 150, 50.0]))
    assert math.isnan(values[3])
    for bar in axes.collections[0].get_segments():
        assert bar[0][1] > 0, bar


def check_partition():
    result = {"partition/diameter": np.array([0.002, 0.004]), "partition/stays": np.array([0.25, 1]), "partition/stays_low": np.array([0.2, 0.9]),
              "partition/stays_high": np.array([0.35, 1]), "partition/stays_by_model": np.array([0.5, 1]), "case/cut_size": np.array(0.003)}  # fmt: skip
    axes = drawn(figure_tables.plot_partition, result)
    line, _, (bars,) = axes.containers[0]
    assert list(line.get_xdata()) == [2, 4] and list(line.get_ydata()) == [0.25, 1]
    np.testing.assert_allclose([bar[:, 1] for bar in bars.get_segments()], [[0.2, 0.35], [0.9, 1]])
    assert "d50 3 mm" in [text.get_text() for text in axes.get_legend().get_texts()]


def check_segregation():
    result = {"segregation/cycle": np.arange(3.0), "materials/name": ["grains", "fines"]}
    for number, sign in ((0, 1), (1, -1)):
        result[f"segregation/index_{number}"] = sign * np.array([0, 0.1, 0.2])
        result[f"segregation/half_width_{number}"] = np.full(3, 0.05)
    axes = drawn(figure_tables.plot_segregation, result)
    assert list(axes.lines[1].get_ydata()) == [0, -0.1, -0.2]
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["grains", "fines"]


check_impacts()
check_partition()
check_segregation()
for plot in (figure_tables.plot_impacts, figure_tables.plot_partition, figure_tables.plot_segregation):
    assert drawn(plot, {}) is None
