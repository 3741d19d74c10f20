#!/usr/bin/python3
import math
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

import h5py  # noqa: E402
import numpy as np  # noqa: E402

import fed  # noqa: E402
from campaign_program import Row  # noqa: E402
from figure_style import COLOURS, MARKERS, new_figure  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

SIZES = ["diameter_mm", "number", "stays", "stays_half_width", "stays_by_model", "attempts", "half_time_s", "half_time_half_width_s"]
LIMITS = {"closed": "0 mm", "wide": "11 mm", "narrow": "2 mm"}  # openings, one packing each


def result_of(run: ValidationCase, name: str) -> pathlib.Path:
    return next((run.runs / name).glob("cases/*/result.h5"))


def balances(name: str, path: pathlib.Path) -> list[list[object]]:
    """Of each packing: grains and mass at first, and what is missing at the end of the worst cycle."""
    rows: list[list[object]] = []
    with h5py.File(path) as file:
        for number in file["screen"]:
            table, sizes, passed = (file[f"{group}/{number}"][()] for group in ("screen", "sizes", "passed"))
            grains, mass = table["held"] + np.cumsum(table["passed"]), table["held_mass"] + np.cumsum(table["passed_mass"])
            by_size = [np.isclose(passed["diameter"], d, rtol=1e-6).sum() for d in sizes["diameter"]]
            rows.append([name, number, int(grains[0]), int(sizes["passed"].sum()), float(np.abs(grains - sizes["number"].sum()).max()),
                         float(np.abs(mass / (sizes["number"] * sizes["mass"]).sum() - 1).max()), float(np.abs(by_size - sizes["passed"]).max())])
    return rows


def centres(path: pathlib.Path) -> list[float]:
    with h5py.File(path) as file:
        return [float(x) for x in file["cycle_ends/1"]["centre_of_mass_x"]]


def simulate(run: ValidationCase) -> None:
    run.campaign("base", {}, {})
    for name, opening in LIMITS.items():
        run.campaign(name, {"screen.opening": opening, "measure.packings": 1}, {})
    no_screen = {"screen.opening": None, "screen.wire": None, "screen.time": None}
    run.campaign("plain", no_screen | {"measure.packings": 1, "measure.max_packings": 1, "measure.min_cycles": 29, "measure.max_cycles": 29}, {})
    rows = [row for name in ("base", *LIMITS) for row in balances(name, result_of(run, name))]
    run.write_table("balances.csv", ["case", "packing", "grains", "passed", "missing_grains", "missing_mass", "missing_by_size"], rows)
    with h5py.File(result_of(run, "base")) as file:
        table = file["partition"][()]
        run.write_table("sizes.csv", SIZES, [[row["diameter"] * 1e3, int(row["number"]), *(float(row[name]) for name in ("stays", "stays_half_width", "stays_by_model", "attempts", "half_time", "half_time_half_width"))]
                                             for row in table])
    run.write_table("closed.csv", ["cycle", "closed_x_m", "plain_x_m"],
                    [[k, *pair] for k, pair in enumerate(zip(centres(result_of(run, "closed")), centres(result_of(run, "plain"))))])


def judge_balances(run: ValidationCase) -> None:
    rows = run.table("balances.csv")
    lost = 1 if run.control else 0
    run.check("most grains that are missing at the end of any cycle", max(float(row["missing_grains"]) for row in rows) + lost, 0, 0.5)
    run.check("mass that is missing, relative", max(float(row["missing_mass"]) for row in rows), 0, 1e-9, because="sums of the engine")
    run.check("grains of any size that are counted twice or not", max(float(row["missing_by_size"]) for row in rows), 0, 0.5)
    passed = {row["case"]: float(row["passed"]) / float(row["grains"]) for row in rows}
    for name, share in (("closed", 0), ("narrow", 0), ("wide", 1)):
        run.check(f"share that passes openings of {LIMITS[name]}", passed[name], share, 1e-9)


def judge_sizes(run: ValidationCase, rows: list[Row]) -> None:
    run.check("share of the oversize of 5.9 mm that stays", float(rows[-1]["stays"]), 1, 1e-12)
    times = [float(row["half_time_s"]) for row in rows[:-1]]
    times = times[::-1] if run.control else times
    known = [time for time in times if math.isfinite(time)]
    run.between("near-size grains pass slower: least difference of the half times of neighbouring undersizes, s", float(np.diff(known).min()), 0, math.inf,
                because="Gaudin's probability falls with the size")
    attempts = [float(row["attempts"]) for row in rows[:-1] if math.isfinite(float(row["attempts"]))]
    run.finding("one attempt per cycle explains what stays of each size", bool(attempts) and all(0.5 < n < 2 for n in attempts),
                "attempts per cycle that the model needs: " + ", ".join(f"{float(row['attempts']):.2f} at {float(row['diameter_mm']):g} mm" for row in rows[:-1]))


def draw(run: ValidationCase, rows: list[Row]) -> None:
    figure, axes = new_figure(size=(6.4, 4.0), layout="constrained")
    size = [float(row["diameter_mm"]) for row in rows]
    stays, width = ([float(row[name]) for row in rows] for name in ("stays", "stays_half_width"))
    # A share is from 0 to 1, and so is its interval.
    ends = [[min(error, share) for share, error in zip(stays, width)], [min(error, 1 - share) for share, error in zip(stays, width)]]
    axes.errorbar(size, stays, ends, fmt=MARKERS[0], color=COLOURS[0], label="simulated")
    axes.plot(size, [float(row["stays_by_model"]) for row in rows], MARKERS[1] + "--", color=COLOURS[1], label="Gaudin, one attempt per cycle")
    axes.axvline(5, color="0.7", lw=1)
    axes.set_xlabel("diameter  [mm]")
    axes.set_ylabel("share that stays  [-]")
    axes.legend()
    figure.savefig(run.figure("partition.png"), dpi=110)


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        simulate(run)
        fed.simulate(run)
    judge_balances(run)
    pairs = [(float(row["closed_x_m"]), float(row["plain_x_m"])) for row in run.table("closed.csv")]
    run.check("no holes: largest distance of the centres of mass on a screen without holes and on the plain floor, m", max(abs(a - b) for a, b in pairs), 0, 1e-12,
              because="the commands that move the grains are the same")
    rows = run.table("sizes.csv")
    judge_sizes(run, rows)
    draw(run, rows)
    fed.judge(run)
    run.finish()


if __name__ == "__main__":
    main()
