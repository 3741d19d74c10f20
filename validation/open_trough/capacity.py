"""The largest feed that an open trough carries, as `vibrotrough capacity` finds it: between a feed that leaves and one that piles up, and in proportion to the width."""

import json
import subprocess
from typing import Any

from campaign_program import Row, campaign_table, campaign_text
from validation_case import ValidationCase

WIDTHS = [20, 40]  # mm
PRECISION = 0.5
# A low trough: the layer may be 20 mm high. Soft grains, because there are many feeds to try.
LOW: dict[str, Any] = {"grains.youngs_modulus": "2 MPa", "layer.length": "120 mm", "feed.length": "40 mm", "feed.height": "28 mm", "measure.packings": 1,
                       "measure.max_packings": 1, "measure.half_width": 1.0, "measure.min_cycles": 30, "measure.max_cycles": 30}  # fmt: skip
COLUMNS = ["width_mm", "feed_t_per_h", "carried", "outcome", "inflow_t_per_h", "outflow_t_per_h", "depth_mm"]


def simulate(run: ValidationCase) -> None:
    rows: list[list[object]] = []
    for width in WIDTHS:
        name = f"capacity-{width}"
        changes = {**LOW, "campaign.name": name, "layer.width": f"{width} mm", "feed.mass_flow": f"{0.006 * width:g} t/h"}
        file = run.runs / f"{name}.toml"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(campaign_text(run.sections(), changes, {}), encoding="utf-8")
        command = [run.program, "capacity", str(file), "--output", str(run.runs / name), "--jobs", str(run.jobs), "--precision", str(PRECISION), "--json"]
        found = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
        table = {row["case"]: row for row in campaign_table(run.program, run.runs / name)}
        for feed in found["feeds"]:
            row = table[feed["case"]]
            rows.append([width, f"{3.6 * feed['mass_flow_kg_per_s']:.5f}", int(feed["carried"]), row["outcome"],
                         *(row.get(column, "") for column in ("inflow_t_per_h", "outflow_t_per_h", "window_depth_mm"))])  # fmt: skip
    run.write_table("capacity.csv", COLUMNS, rows)


def bracket(rows: list[Row], width: int) -> tuple[Row, Row]:
    """The largest feed that was carried, and the smallest that was not."""
    of_width = sorted((row for row in rows if int(row["width_mm"]) == width), key=lambda row: float(row["feed_t_per_h"]))
    return [row for row in of_width if row["carried"] == "1"][-1], [row for row in of_width if row["carried"] == "0"][0]


def judge(run: ValidationCase) -> None:
    rows = run.table("capacity.csv")
    found = {width: bracket(rows, width) for width in WIDTHS}
    for width, (carried, refused) in found.items():
        if run.control:
            carried, refused = refused, carried
        leaves = float(carried["outflow_t_per_h"] or 0) / float(carried["feed_t_per_h"])
        run.check(f"capacity, {width} mm wide: outflow over feed at the largest feed that is carried", leaves, 1, 0.05, because="one packing of 30 cycles")
        piles_up = 1 - float(refused["outflow_t_per_h"] or 0) / float(refused["feed_t_per_h"])
        run.between(f"capacity, {width} mm wide: share of the smallest feed that is not carried which stays in the trough, or 1 when the layer reached the feed",
                    1 if refused["outcome"] == "overfull" else piles_up, 0.05, 1)  # fmt: skip
        run.between(f"capacity, {width} mm wide: smallest feed that is not carried over the largest that is", float(refused["feed_t_per_h"]) / float(carried["feed_t_per_h"]), 1,
                    1 + PRECISION, because="the precision that was asked for")  # fmt: skip
    (narrow, too_much), (wide, too_much_for_wide) = (found[width] for width in WIDTHS)
    most = float(too_much_for_wide["feed_t_per_h"]) / float(narrow["feed_t_per_h"])
    least = float(wide["feed_t_per_h"]) / float(too_much["feed_t_per_h"])
    run.between("capacity per width with smooth side walls: least ratio of that of the wide trough to that of the narrow one", least / 2, 0, 1, because="both lie between two feeds")
    run.between("capacity per width: largest ratio", most / 2, 1, 10, because="both lie between two feeds")
