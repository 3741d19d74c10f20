"""What the cases of a campaign differ in: the swept keys of the campaign file, with the names and units of the figures."""

import dataclasses
import math
from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from .style import THROW_NUMBER, plain


class Columns(Protocol):
    """Columns of campaign.h5 by name."""

    def __getitem__(self, name: str, /) -> NDArray[Any]: ...

# Keys with a symbol: title of an axis, how a value is written in a legend. Others are called as in the campaign file.
SYMBOLS = {
    "trough.throw_number": (THROW_NUMBER, "\u0393 = {}"),
    "trough.machine_number": ("machine number K = \u03c9\u00b2 r / g  [-]", "K = {}"),
    "trough.vibration_angle": ("vibration angle \u03b2  [\u00b0]", "\u03b2 = {}\u00b0"),
    "trough.tan_vibration_angle": ("tan \u03b2  [-]", "tan \u03b2 = {}"),
    "trough.inclination": ("inclination \u03b1  [\u00b0]", "\u03b1 = {}\u00b0"),
    "trough.tan_inclination": ("tan \u03b1  [-]", "tan \u03b1 = {}"),
    "trough.friction": ("friction of grain on trough \u03bc  [-]", "\u03bc = {}"),
    "trough.amplitude": ("amplitude r  [mm]", "r = {} mm"),
}
UNITS = {"m": ("mm", 1e3), "rad": ("\u00b0", math.degrees(1.0)), "Pa": ("MPa", 1e-6)}  # from SI to what people read
STROKE = ("trough.amplitude", "trough.stroke")  # set it as well, where the frequency is the same
DRIVE = ("trough.throw_number", "trough.machine_number", "trough.frequency")  # set the speed of the drive, that is, the throw number


@dataclasses.dataclass
class Input:
    """A swept key and its value in each case, in the unit of the figures; texts stay texts."""

    key: str
    title: str
    form: str
    values: NDArray[Any]

    @property
    def is_text(self) -> bool:
        return self.values.dtype.kind not in "fiu"

    def label(self, row: int) -> str:
        """\"name = value unit\" of a case."""
        value = self.values[row]
        return self.form.format(value if self.is_text else f"{float(value):.4g}")

    def places(self) -> tuple[NDArray[np.float64], list[str]]:
        """Places on an axis. Texts stand side by side, with their names; numbers have none."""
        if not self.is_text:
            return np.asarray(self.values, dtype=float), []
        names = sorted(set(map(str, self.values)))
        return np.array([names.index(str(value)) for value in self.values], dtype=float), names

    def groups(self) -> NDArray[np.intp]:
        """A number for each case: equal where the values are equal but for rounding."""
        values = self.values if self.is_text else np.round(np.asarray(self.values, dtype=float), 9)
        found: NDArray[np.intp] = np.unique(values, return_inverse=True)[1]
        return found


def make_input(key: str, values: NDArray[Any], units: str) -> Input:
    unit, factor = UNITS.get(units, (units, 1.0))
    name = plain(key)
    usual = f"{name} = {{}}" + ("" if unit == "1" else unit if unit == "\u00b0" else f" {unit}")
    title, form = SYMBOLS.get(key, (f"{name}  [{'-' if unit == '1' else unit}]", usual))
    if values.dtype.kind in "fiu":
        values = np.asarray(values, dtype=float) * factor
    else:
        values, title = np.asarray(values, dtype=str), name
    return Input(key, title, form, values)


def swept_inputs(columns: Columns, units: Mapping[str, str], attributes: Mapping[str, Any]) -> list[Input]:
    """The swept keys that still differ between the cases of the file, in the order of the campaign file."""
    found = []
    for key in str(attributes.get("swept_keys", "")).split():
        one = make_input(key, np.asarray(columns[f"swept/{key}"]), units[f"swept/{key}"])
        if len(set(one.groups())) > 1:
            found.append(one)
    return found


def split_inputs(columns: Columns, inputs: list[Input]) -> tuple[Input, list[Input]]:
    """The input over which figures are drawn, and the others. It is the throw number where that varies, else the first
    swept number. A swept stroke is not among the others where the throw number follows from it: each would have one point.
    """
    gamma = Input("trough.throw_number", *SYMBOLS["trough.throw_number"], np.asarray(columns["throw_number"], dtype=float))
    numbers = [one for one in inputs if not one.is_text]
    if len(set(np.round(gamma.values, 9))) > 1 or not numbers:
        follow = DRIVE if {one.key for one in inputs} & set(DRIVE) else STROKE
        drive_first = sorted(inputs, key=lambda one: one.key not in follow)
        return gamma, [one for one in independent(drive_first) if one.key not in follow]
    return numbers[0], independent(sorted(inputs, key=lambda one: one is not numbers[0]))[1:]


def independent(inputs: list[Input]) -> list[Input]:
    """Without swept keys that vary together with an earlier one, as those of [zip] do: they would make a series of each point."""
    kept: list[Input] = []
    for one in inputs:
        if not any(vary_together(one, other) for other in kept):
            kept.append(one)
    return kept


def vary_together(one: Input, other: Input) -> bool:
    first, second = one.groups().tolist(), other.groups().tolist()
    return len(set(zip(first, second))) == len(set(first)) == len(set(second))


def panels(others: list[Input], rows: int) -> dict[str, list[int]]:
    """Cases by their values of the inputs, with a name for each combination; one nameless panel without inputs."""
    if not others:
        return {"": list(range(rows))}
    found: dict[tuple[int, ...], list[int]] = {}
    for row in range(rows):
        found.setdefault(tuple(int(one.groups()[row]) for one in others), []).append(row)
    return {", ".join(one.label(members[0]) for one in others): members for _, members in sorted(found.items())}
