#!/usr/bin/python3
import json
import math
import pathlib
import subprocess
import sys
import tomllib
from typing import Any

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import h5py  # noqa: E402

from campaign_program import Row, campaign_table, campaign_text  # noqa: E402
from figure_style import COLOURS, MARKERS, new_figure  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

LOW, HIGH = 20, 30  # mm, height of the feed
FIRST_FEEDS = {LOW: 0.28, HIGH: 0.48}  # t/h, with which a search begins
PRECISION = 0.1
BOX = {"layer.length": "45 mm", "feed.mass_flow": None, "feed.length": None, "feed.height": None}
FEEDS = ["height_mm", "feed_t_per_h", "search", "carried", "outcome", "message", "depth_mm", "greatest_depth_mm"]
BOXES = ["what", "depth_mm", "efficiency", "half_width", "flow_t_per_h", "outcome"]


def changes(height: int) -> dict[str, Any]:
    return {"feed.height": f"{height} mm"}


def search(run: ValidationCase, height: int, feed: float) -> list[list[object]]:
    """What `vibrotrough capacity` tries; it ends with an error when one side of the capacity stays unknown."""
    folder = run.runs / f"search-{height}"
    folder.parent.mkdir(parents=True, exist_ok=True)
    file = folder.with_name(f"search-{height}.toml")
    first = {"campaign.name": folder.name, "feed.mass_flow": f"{feed} t/h"}
    file.write_text(campaign_text(run.sections(), changes(height) | first, {}), encoding="utf-8")
    command = [run.program, "capacity", str(file), "--output", str(folder), "--precision", str(PRECISION), "--jobs", str(run.jobs), "--json"]
    tried = json.loads(subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout)["feeds"]
    endings = {round(3.6 * one["mass_flow_kg_per_s"], 6): (int(one["carried"]), one["outcome"], one["message"]) for one in tried}
    return [[height, feed, "search", *endings[feed], *depths] for feed, depths in sorted(depths_of(run, folder).items())]


def depths_of(run: ValidationCase, folder: pathlib.Path) -> dict[float, list[object]]:
    """Of each feed, t/h: the depth in the window and the greatest one along the trough, mm; empty when it has no result."""
    return {feed_of(folder, row): depths_in(folder, row) for row in campaign_table(run.program, folder)}


def feed_of(folder: pathlib.Path, row: Row) -> float:
    scenario = tomllib.loads((folder / "cases" / row["case"] / "scenario.toml").read_text(encoding="utf-8"))
    return round(3.6 * float(scenario["feed"]["mass_flow"].split()[0]), 6)


def depths_in(folder: pathlib.Path, row: Row) -> list[object]:
    if not row["window_depth_mm"]:
        return ["", ""]
    with h5py.File(folder / "cases" / row["case"] / "result.h5") as file:
        return [f"{float(row['window_depth_mm']):.3f}", f"{1e3 * float(file['along/1']['depth'].max()):.3f}"]


class Capacity:
    """What the rows of feeds.csv say of one height."""

    def __init__(self, rows: list[Row], height: int) -> None:
        own = [row for row in rows if int(row["height_mm"]) == height and row["search"] == "search"]
        self.refused = min(float(row["feed_t_per_h"]) for row in own if row["carried"] == "0")
        best = max((row for row in own if row["carried"] == "1" and float(row["feed_t_per_h"]) < self.refused), key=lambda row: float(row["feed_t_per_h"]))
        self.height, self.carried = height, float(best["feed_t_per_h"])
        self.depth, self.greatest = float(best["depth_mm"]), float(best["greatest_depth_mm"])
        self.value = math.sqrt(self.carried * self.refused)
        # The depths grow with the feed, from that of the largest one carried to that at the capacity.
        self.clearance = height - self.greatest * self.value / self.carried

    def depth_at(self, height: int) -> float:
        """mm, the depth in the window that the balances of mass and momentum say for another height of the feed."""
        return (height - self.clearance) * self.depth / self.greatest


def simulate(run: ValidationCase) -> None:
    rows = [row for height, feed in FIRST_FEEDS.items() for row in search(run, height, feed)]
    texts = [{name: str(value) for name, value in zip(FEEDS, row)} for row in rows]
    low, high = Capacity(texts, LOW), Capacity(texts, HIGH)
    for name, feed in (("below", 0.8 * low.carried), ("above", 1.2 * low.refused)):
        folder = run.runs / name
        for row in run.campaign(name, changes(LOW) | {"feed.mass_flow": f"{feed:.4g} t/h"}, {}):
            rows.append([LOW, feed_of(folder, row), name, "", row["outcome"], "", *depths_in(folder, row)])
    run.write_table("feeds.csv", FEEDS, rows)
    boxes = []
    for name, depth in (("low", low.depth), ("high", high.depth), ("predicted", low.depth_at(HIGH))):
        (row,) = run.campaign(f"box-{name}", BOX | {"layer.height": f"{depth:.3f} mm"}, {})
        boxes.append([name, f"{depth:.3f}", *(f"{float(row[column]):.4f}" for column in ("efficiency", "efficiency_half_width_statistics", "mass_flow_t_per_h")), row["outcome"]])
    run.write_table("boxes.csv", BOXES, boxes)


def judge(run: ValidationCase) -> None:
    rows = run.table("feeds.csv")
    low, high = Capacity(rows, LOW), Capacity(rows, HIGH)
    flows = {row["what"]: float(row["flow_t_per_h"]) for row in run.table("boxes.csv")}
    endings = {row["search"]: row["outcome"] for row in rows if row["search"] != "search"}
    draw(run, low, high, flows)
    found = {"low": low, "high": high}
    if run.control:
        found = {"low": high, "high": low}
        endings = {"below": endings["above"], "above": endings["below"]}
    for name, one in found.items():
        run.between(f"search at the {name} feed: smallest feed that is refused over the largest that is carried", one.refused / one.carried, 1, 1 + PRECISION + 1e-9)
        run.check(f"{name} feed: largest flow that is carried over that of a periodic box of the depth in the window", one.carried / flows[name], 1, 0.1,
                  because="one packing of each, and the edge is near")  # fmt: skip
    run.check("capacity at the high feed over that predicted from the low one", found["high"].value / flows["predicted"], 1, 0.15, because="5 % of each search, and 10 % of the law")
    run.check("a feed 20 % below the largest that is carried: carried", int(endings["below"] == "finished"), 1, 0)
    run.check("a feed 20 % above the smallest that is refused: overfull", int(endings["above"] == "overfull"), 1, 0)


def draw(run: ValidationCase, low: Capacity, high: Capacity, flows: dict[str, float]) -> None:
    figure, axes = new_figure(size=(6.4, 4.0), layout="constrained")
    for number, one in enumerate((low, high)):
        label = None if number else "search: carried to refused"
        axes.errorbar([one.height], [one.value], [[one.value - one.carried], [one.refused - one.value]], fmt=MARKERS[0], color=COLOURS[0], capsize=4, label=label)
    axes.plot([LOW, HIGH], [flows["low"], flows["high"]], MARKERS[1], fillstyle="none", color=COLOURS[1], label="periodic box of the depth in the window")
    axes.plot([HIGH], [flows["predicted"]], MARKERS[2], fillstyle="none", color=COLOURS[2], label=f"predicted from {LOW} mm")
    line = [low.clearance, 1.1 * HIGH]
    axes.plot(line, [low.value * (height - low.clearance) / (LOW - low.clearance) for height in line], "--", color="0.6", label="proportional to the room below the feed")
    axes.set_xlim(0, 1.1 * HIGH)
    axes.set_ylim(bottom=0)
    axes.set_xlabel("height of the feed above the floor  [mm]")
    axes.set_ylabel("capacity  [t/h]")
    axes.legend()
    figure.savefig(run.figure("capacity.png"), dpi=110)


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        simulate(run)
    judge(run)
    run.finish()


if __name__ == "__main__":
    main()
