#!/usr/bin/python3
import math
import pathlib
import sys

import h5py
import numpy as np
from numpy.typing import NDArray
from scipy.stats import t as student

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent.parent / "postprocess"))

from campaign_program import Row  # noqa: E402
from validation_case import ValidationCase  # noqa: E402

Floats = NDArray[np.float64]

AMPLITUDES = ["3.3", "4.4", "5.5"]  # mm
FREQUENCY, COSINE = 15.0, math.cos(math.radians(30))
ONE_PACKING = {"measure.packings": 1, "measure.max_packings": 1, "measure.half_width": 1.0, "measure.max_cycles": 24}
ONE_STAGE = {"stages.1.cycles": 48}
CHANGES = {"measure.packings": 4, "stages.1.cycles": 30, "stages.2.cycles": 40, "stages.2.amplitude": "3.3 mm", "stages.3.cycles": 35, "stages.3.ramp_cycles": 5, "stages.3.amplitude": "5.5 mm",
           "stages.4.cycles": 15, "stages.4.standstill": True}  # fmt: skip
BEFORE, RAMP, LOW, HIGH = 20, 84, 2.75, 6.05  # cycles, cycles, mm, mm
RAMPS = {"measure.packings": 4, "stages.1.cycles": BEFORE, "stages.1.amplitude": f"{LOW} mm", "stages.2.cycles": RAMP, "stages.2.ramp_cycles": RAMP, "stages.2.amplitude": f"{HIGH} mm",
         "stages.3.cycles": RAMP, "stages.3.ramp_cycles": RAMP, "stages.3.amplitude": f"{LOW} mm"}  # fmt: skip
HALF_WINDOW = 5  # cycles before and after the amplitude that is looked at
# A sweep of the frequency through take-off: throw numbers, of which the square root is proportional to the frequency at 4.4 mm.
SLOW, FAST, THROW_NUMBERS = 0.7, 1.6, ["0.85", "1.00", "1.20"]
CONTROL_OF_SWEEP = dict(zip(THROW_NUMBERS, THROW_NUMBERS[1:] + THROW_NUMBERS[:1], strict=True))
SWEEP_COLUMNS = ["drive", "throw_number", "efficiency", "half_width"]
COLUMNS = ["drive", "amplitude_mm", "efficiency", "half_width"]
CONTROL = {"3.3": "5.5", "4.4": "3.3", "5.5": "4.4"}  # the negative control: another drive


def scale(amplitude_mm: str) -> float:
    """omega r cos(beta), m/s."""
    return 2 * math.pi * FREQUENCY * float(amplitude_mm) * 1e-3 * COSINE


def hertz(throw_number: float) -> float:
    """Frequency of a throw number at 4.4 mm, 30 degrees, downhill by 3 degrees."""
    return math.sqrt(throw_number * 9.81 * math.cos(math.radians(3)) / (4.4e-3 * math.sin(math.radians(30)))) / (2 * math.pi)


def result(run: ValidationCase, name: str) -> h5py.File:
    (path,) = (run.runs / name).glob("cases/*/result.h5")
    return h5py.File(path)


def places(run: ValidationCase, name: str) -> Floats:
    """Where the centre of mass of each packing is at the end of each cycle, m."""
    with result(run, name) as file:
        ends = file["cycle_ends"]
        return np.array([ends[packing]["centre_of_mass_x"][:] for packing in sorted(ends, key=int)])


def of_packings(values: Floats) -> list[str]:
    """Mean and half-width at 95 % of the values of packings."""
    width = student.ppf(0.975, len(values) - 1) * values.std(ddof=1) / math.sqrt(len(values))
    return [f"{values.mean():.5f}", f"{width:.5f}"]


def speeds_in_stages(run: ValidationCase, name: str, drives: list[tuple[str, str]]) -> list[list[object]]:
    with result(run, name) as file:
        stages = file["stages"][:]
    return [[drive, amplitude, f"{stage['conveying_speed'] / scale(amplitude):.5f}", f"{stage['conveying_speed_half_width'] / scale(amplitude):.5f}"]
            for (drive, amplitude), stage in zip(drives, stages, strict=True)]  # fmt: skip


def speeds_in_ramps(run: ValidationCase) -> list[list[object]]:
    x = places(run, "ramps")
    rows: list[list[object]] = []
    for amplitude in AMPLITUDES:
        share = (float(amplitude) - LOW) / (HIGH - LOW)
        middles = [BEFORE + round(share * RAMP), BEFORE + RAMP + round((1 - share) * RAMP)]
        up, down = ((x[:, m + HALF_WINDOW] - x[:, m - HALF_WINDOW]) * FREQUENCY / (2 * HALF_WINDOW) / scale(amplitude) for m in middles)
        rows += [[name, amplitude, *of_packings(values)] for name, values in (("ramp up", up), ("ramp down", down), ("both ramps", (up + down) / 2))]
    return rows


def simulate_take_off(run: ValidationCase) -> None:
    """In a ramp that is linear in time the throw number is linear in the cycles: f^2 = f_0^2 + n (f_1^2 - f_0^2) / N."""
    steady = run.campaign("take-off", {}, {"trough.frequency": [f"{hertz(float(number)):.5f} Hz" for number in THROW_NUMBERS]})
    rows: list[list[object]] = [["steady", number, row["efficiency"], row["efficiency_half_width_statistics"]] for number, row in zip(THROW_NUMBERS, steady, strict=True)]
    slow, fast = (f"{hertz(number):.5f} Hz" for number in (SLOW, FAST))
    sweep = {"measure.packings": 4, "stages.1.cycles": BEFORE, "stages.1.frequency": slow}
    for stage, frequency in ((2, fast), (3, slow)):
        sweep |= {f"stages.{stage}.cycles": RAMP, f"stages.{stage}.ramp_cycles": RAMP, f"stages.{stage}.frequency": frequency}
    run.campaign("sweep", sweep, {})
    x = places(run, "sweep")
    stroke = 2 * math.pi * 4.4e-3 * COSINE  # m per cycle at a velocity efficiency of 1
    for number in THROW_NUMBERS:
        share = (float(number) - SLOW) / (FAST - SLOW)
        middles = [BEFORE + round(share * RAMP), BEFORE + RAMP + round((1 - share) * RAMP)]
        up, down = ((x[:, m + HALF_WINDOW] - x[:, m - HALF_WINDOW]) / (2 * HALF_WINDOW) / stroke for m in middles)
        rows += [[name, number, *of_packings(values)] for name, values in (("up", up), ("down", down), ("both", (up + down) / 2), ("up less down", up - down))]
    run.write_table("take_off.csv", SWEEP_COLUMNS, rows)


def simulate(run: ValidationCase) -> None:
    steady = run.campaign("steady", {}, {"trough.amplitude": [f"{amplitude} mm" for amplitude in AMPLITUDES]})
    rows: list[list[object]] = [["steady", amplitude, row["efficiency"], row["efficiency_half_width_statistics"]] for amplitude, row in zip(AMPLITUDES, steady, strict=True)]
    run.campaign("single", ONE_PACKING, {})
    run.campaign("single-stage", {**ONE_PACKING, "measure.max_packings": None, "measure.max_cycles": None, "stages.1.cycles": 24}, {})
    run.campaign("one-stage", ONE_STAGE, {})
    (changes,) = run.campaign("changes", CHANGES, {})
    run.campaign("ramps", RAMPS, {})
    differences = np.diff(places(run, "single")) - np.diff(places(run, "single-stage"))
    rows.append(["single packing, largest difference", "4.4", f"{np.abs(differences).max() * FREQUENCY / scale('4.4'):.3g}", 0])
    rows += speeds_in_stages(run, "one-stage", [("one stage", "4.4")])
    rows += speeds_in_stages(run, "changes", [("from rest", "4.4"), ("at once", "3.3"), ("with a ramp", "5.5"), ("standstill", "5.5")])
    rows += speeds_in_ramps(run)
    run.write_table("result.csv", COLUMNS, rows)
    simulate_take_off(run)
    run.write_table("time.csv", ["time_to_speed_s", "half_width_s"], [[changes["time_to_speed_s"], changes["time_to_speed_half_width_s"]]])


def judge(run: ValidationCase) -> None:
    rows = {(row["drive"], row["amplitude_mm"]): row for row in run.table("result.csv")}
    (time,) = run.table("time.csv")

    def numbers(row: Row) -> tuple[float, float]:
        return float(row["efficiency"]), float(row["half_width"])

    def steady(amplitude: str) -> tuple[float, float]:
        return numbers(rows["steady", CONTROL[amplitude] if run.control else amplitude])

    # Efficiency that the layer lags behind: the steady speeds change while the ramp goes from 3.3 to 5.5 mm.
    change = (steady("5.5")[0] * scale("5.5") - steady("3.3")[0] * scale("3.3")) / (RAMP * (5.5 - 3.3) / (HIGH - LOW))
    for (drive, amplitude), row in rows.items():
        value, width = numbers(row)
        if drive == "single packing, largest difference":
            run.check("largest difference of the efficiency in a cycle, one stage against none", value, 0, 0, because="the commands of each cycle are the same")
        elif drive == "standstill":
            run.between("speed at the end of the standstill over that of the trough before, with its interval", abs(value) + width, 0, 1e-3, because="friction holds a layer on 3 degrees")
        elif drive != "steady":
            lag = abs(change) * FREQUENCY * float(time["time_to_speed_s"]) / 3 / scale(amplitude) if drive in ("ramp up", "ramp down") else 0
            expected, other = steady(amplitude)
            run.check(f"efficiency {drive} at {amplitude} mm less that of the steady drive", value - expected, 0, width + other + lag,
                      because="both intervals, and the lag of one way" if lag else "both intervals")  # fmt: skip


def judge_take_off(run: ValidationCase) -> None:
    rows = {(row["drive"], row["throw_number"]): (float(row["efficiency"]), float(row["half_width"])) for row in run.table("take_off.csv")}
    (time,) = run.table("time.csv")
    first, last = ((rows["steady", number][0] * hertz(float(number)), float(number)) for number in (THROW_NUMBERS[0], THROW_NUMBERS[-1]))
    per_cycle = (last[0] - first[0]) / (last[1] - first[1]) * (FAST - SLOW) / RAMP  # of efficiency times frequency, 1/s
    for number in THROW_NUMBERS:
        steady, width = rows["steady", CONTROL_OF_SWEEP[number] if run.control else number]
        lag = abs(per_cycle) * float(time["time_to_speed_s"]) / 3
        for drive, more in (("up", lag), ("down", lag), ("both", 0.0)):
            value, own = rows[drive, number]
            run.check(f"efficiency of the sweep, {drive}, at throw number {number} less that of the steady drive", value - steady, 0, width + own + more,
                      because="both intervals, and the lag of one way" if more else "both intervals")  # fmt: skip
        value, own = rows["up less down", number]
        run.check(f"efficiency up less down at throw number {number}", value, 0, own + 2 * lag, because="its interval, and the lag of both ways: else a hysteresis")


def main() -> None:
    run = ValidationCase(FOLDER)
    if run.long:
        simulate(run)
    judge(run)
    judge_take_off(run)
    run.finish()


if __name__ == "__main__":
    main()
