"""A screen that is fed: what comes, stays, passes and leaves, size by size; no holes; and the efficiency over the feed."""

import itertools
import pathlib
from typing import Any

import h5py
import numpy as np

from figure_style import COLOURS, MARKERS, new_figure
from validation_case import ValidationCase

# A strip of 24 mm with its share of 2.5, 7.5 and 22 t/h on 1 m: thinner than a grain, a grain deep, and several.
FEEDS = [0.06, 0.18, 0.54]  # t/h
CHANGES: dict[str, Any] = {
    "trough.inclination": "-10 deg", "trough.side_wall_friction": 0, "grains.youngs_modulus": "5 MPa", "layer.length": "90 mm", "layer.height": None,
    "feed.length": "30 mm", "feed.height": "60 mm", "screen.time": None, "measure.packings": 3, "measure.max_packings": 3, "measure.min_cycles": 24,
    "measure.max_cycles": 24}  # fmt: skip
NO_HOLES = {"screen.opening": "0 mm", "screen.wire": "6 mm"}
NO_SCREEN = {"screen.opening": None, "screen.wire": None}
BALANCES = ["case", "packing", "size_mm", "fed", "held", "left", "passed", "missing_grains", "missing_mass", "mass_share_fed"]
FLOWS = ["case", "feed_t_per_h", "outcome", "efficiency", "efficiency_half_width", "through_t_per_h", "over_t_per_h", "depth_mm", "depth_half_width_mm",
         "velocity_efficiency", "velocity_half_width", "outflow_half_width"]  # fmt: skip


def balances(name: str, path: pathlib.Path) -> list[list[object]]:
    """Of each packing and size: grains at the end; of the packing: what is missing at the end of the worst cycle of what the engine itself
    counted when it fed. Without holes nothing passes, and of an open trough sizes are not known."""
    rows: list[list[object]] = []
    with h5py.File(path) as file:
        for number in file["size_cycles"]:
            table, flow, through = (file[f"{group}/{number}"][()] for group in ("size_cycles", "flow", "through"))
            masses = dict(zip(file[f"sizes/{number}"]["diameter"], file[f"sizes/{number}"]["mass"]))
            sizes = {size: table[table["diameter"] == size] for size in masses}
            there = {size: one["held"] + np.cumsum(one["left"] + one["passed"]) for size, one in sizes.items()}
            grains = np.array(list(there.values())).sum(axis=0)
            mass = np.array([masses[size] * there[size] for size in sizes]).sum(axis=0)
            missing = float(np.abs(grains - flow["fed"] - grains[0]).max())
            missing_mass = float(np.abs(mass - flow["fed_mass"] - mass[0]).max() / mass[-1])
            assert through["passed"].sum() == sum(one["passed"].sum() for one in sizes.values())
            for size, one in sizes.items():
                fed = int(there[size][-1] - there[size][0])
                rows.append([name, number, size * 1e3, fed, int(one["held"][-1]), int(one["left"].sum()), int(one["passed"].sum()), missing, missing_mass,
                             fed * masses[size] / float(flow["fed_mass"][-1])])  # fmt: skip
    return rows


def flow_row(name: str, feed: float, row: dict[str, str]) -> list[object]:
    columns = ["screening_efficiency", "screening_efficiency_half_width", "underflow_t_per_h", "outflow_t_per_h", "window_depth_mm", "window_depth_half_width_mm",
               "efficiency", "efficiency_half_width_statistics", "outflow_half_width_t_per_h"]  # fmt: skip
    return [name, feed, row["outcome"], *(row.get(column, "") for column in columns)]


def simulate(run: ValidationCase) -> None:
    cases: dict[str, dict[str, Any]] = {f"fed-{feed}": {"feed.mass_flow": f"{feed} t/h"} for feed in FEEDS}
    cases["fed-no-holes"] = {"feed.mass_flow": f"{FEEDS[1]} t/h", **NO_HOLES}
    cases["open"] = {"feed.mass_flow": f"{FEEDS[1]} t/h", **NO_SCREEN}
    flows, rows = [], []
    for name, changes in cases.items():
        (row,) = run.campaign(name, {**CHANGES, **changes}, {})
        flows.append(flow_row(name, float(changes["feed.mass_flow"].split()[0]), row))
        if name != "open":
            rows += balances(name, next((run.runs / name).glob("cases/*/result.h5")))
    run.write_table("fed_balances.csv", BALANCES, rows)
    run.write_table("fed.csv", FLOWS, flows)


def judge_balances(run: ValidationCase) -> None:
    rows = run.table("fed_balances.csv")
    numbers = [{name: float(row[name]) for name in BALANCES[1:]} for row in rows]
    damage = 1 if run.control else 0  # a grain that left is not in the table
    run.check("fed: most grains of a size that were fed, and at the end are neither held nor left nor passed, but for the one that was there at first",
              max(abs(1 + n["fed"] - n["held"] - (n["left"] - damage) - n["passed"]) for n in numbers), 0, 0.5)  # fmt: skip
    run.check("fed: most grains at the end of any cycle that the engine counted when it fed them and that are missing, or too many",
              max(n["missing_grains"] for n in numbers), 0, 0.5)  # fmt: skip
    run.check("fed: the same of the mass, relative", max(n["missing_mass"] for n in numbers), 0, 1e-6, because="radii are written with six digits")
    wanted = dict(zip((2.5, 3.5, 4.2, 4.6, 5.9), run.sections()["grains"]["mass_fractions"]))
    worst = 0.0
    for _, group in itertools.groupby(numbers, key=lambda n: n["missing_mass"]):
        sizes = list(group)
        per_mass = {round(n["size_mm"], 3): wanted[round(n["size_mm"], 3)] / n["size_mm"] ** 3 for n in sizes}
        all_fed = sum(n["fed"] for n in sizes)
        for n in sizes:
            share = per_mass[round(n["size_mm"], 3)] / sum(per_mass.values())
            worst = max(worst, abs(n["fed"] / all_fed - share) / np.sqrt(share * (1 - share) / all_fed))
    run.check("fed: largest deviation of the number of a size from the shares of the file, standard deviations of a random choice", worst, 0, 4,
              because="75 numbers of which one in 16,000 deviates so far by chance")
    run.check("fed: grains of the oversize of 5.9 mm that passed openings of 5 mm", max(n["passed"] for n in numbers if n["size_mm"] > 5), 0, 0.5)


def judge(run: ValidationCase) -> None:
    judge_balances(run)
    table = {row["case"]: row for row in run.table("fed.csv")}
    closed, trough = table["fed-no-holes"], table["open"]
    run.check("fed, no holes: t/h that pass", float(closed["through_t_per_h"]), 0, 1e-12)
    for what, value, half_width in (("flow over the edge, t/h", "over_t_per_h", "outflow_half_width"), ("depth in the window, mm", "depth_mm", "depth_half_width_mm"),
                                    ("velocity efficiency", "velocity_efficiency", "velocity_half_width")):  # fmt: skip
        run.check(f"fed, no holes: {what}, less that of an open trough", float(closed[value]) - float(trough[value]), 0,
                  float(closed[half_width]) + float(trough[half_width]), because="both intervals over three packings")
    rows = [table[f"fed-{feed}"] for feed in FEEDS]
    efficiency, width = ([float(row[name]) for row in rows] for name in ("efficiency", "efficiency_half_width"))
    if run.control:
        efficiency, width = efficiency[::-1], width[::-1]
    run.between(f"fed: efficiency of screening at {FEEDS[0]} t/h less that at {FEEDS[-1]} t/h", efficiency[0] - efficiency[-1], width[0] + width[-1], 1,
                because="a crowded screen passes a smaller share; both intervals over three packings")
    run.between("fed: least fall of the efficiency from one feed to the next larger one", -float(np.diff(efficiency).max()), 0, 1, because="means")
    draw(run)


def draw(run: ValidationCase) -> None:
    table = [row for row in run.table("fed.csv") if row["case"] in {f"fed-{feed}" for feed in FEEDS}]
    figure, axes = new_figure(size=(6.4, 4.0), layout="constrained")
    feed, efficiency, width = ([float(row[name]) for row in table] for name in ("feed_t_per_h", "efficiency", "efficiency_half_width"))
    per_width = [one / 0.024 for one in feed]
    axes.errorbar(per_width, efficiency, width, fmt=MARKERS[0] + "-", color=COLOURS[0], capsize=3)
    axes.set_xscale("log")
    axes.set_xticks(per_width, [f"{one:g}" for one in per_width])
    axes.set_xticks([], minor=True)
    axes.set_ylim(0, 1.05)
    axes.set_xlabel("feed per width of the screen  [t/h/m]")
    axes.set_ylabel("efficiency of screening  [-]")
    figure.savefig(run.figure("feed.png"), dpi=110)
