"""Calls a person's functions with the packings of a campaign, for `vibrotrough observe`, which makes means and intervals of what they return.

usage: python3 -m vibrotrough.observe list|measure WORK

The program leaves in the folder WORK: source.py, the text whose functions the person has allowed, and request.json: `file`, where the text
comes from; `only`, the names that are wanted (all when empty); `cases`, the folders of finished cases. `list` writes list.json, what the
functions say of themselves; `measure` writes ID.json for each case. Exit code 2 with a message when the person has to change something.
"""

from __future__ import annotations

import json
import linecache
import math
import os
import pathlib
import sys
import time
import traceback
import types
from collections.abc import Iterator
from typing import Any

import numpy as np

from .campaign import Case
from .frames import Floats, GrainsChangeError, Observable, Packing

Curve = tuple[list[float], list[list[float | None]]]  # where the points are (none for a number); for each cycle, the values


class Refused(Exception):
    """The person has to change something; the text is one line."""


def load(work: pathlib.Path, file: str) -> list[Observable]:
    """Runs the text and returns its observables. @raises Refused"""
    source = (work / "source.py").read_bytes()
    text = source.decode("utf-8")
    linecache.cache[file] = (len(text), None, text.splitlines(True), file)  # for tracebacks
    module = types.ModuleType("observables_of_a_person")
    module.__file__ = file
    sys.modules[module.__name__] = module
    with_traceback(file, "cannot be run", lambda: exec(compile(source, file, "exec"), module.__dict__))
    found = [value._observable for value in vars(module).values() if isinstance(getattr(value, "_observable", None), Observable)]
    if not found:
        raise Refused(f"{file} defines no observable; write @vibrotrough.observable(unit=\"m/s\") above a function, "
                      "and see 'vibrotrough observe --examples'")  # fmt: skip
    for one in found:
        if not one.meaning:
            raise Refused(f"{file}: {one.name} has no docstring; its first line says what is measured")
        if one.of not in ("cycle", "packing"):
            raise Refused(f"{file}: {one.name} is of=\"{one.of}\"; write of=\"cycle\" or of=\"packing\"")
    return found


def with_traceback(file: str, what: str, call: Any) -> Any:
    """What a person's code returns. @raises Refused after its traceback was shown, from the person's first line on
    @raises GrainsChangeError as the code does"""
    try:
        return call()
    except (KeyboardInterrupt, GrainsChangeError):
        raise
    except BaseException as error:  # also SystemExit: it is not for the person's code to end the program
        frames = traceback.extract_tb(error.__traceback__)
        own = next((i for i, one in enumerate(frames) if one.filename == file), len(frames))
        print("Traceback of your code (most recent call last):", file=sys.stderr)
        sys.stderr.writelines(traceback.format_list(frames[own:]))
        *lines, said = traceback.format_exception_only(type(error), error)  # before the message, a syntax error has its line
        sys.stderr.writelines(lines)
        raise Refused(f"{file}: {what}: {' '.join(said.split())}") from None


def numbers(value: object, dimensions: int, what: str, wanted: str) -> Floats:
    """The value as an array of that many dimensions. @raises Refused"""
    try:
        if value is None:  # which NumPy would take for NaN
            raise TypeError
        array = np.ma.asarray(value, dtype=float).filled(np.nan)  # what is masked has no value
    except (TypeError, ValueError):
        raise Refused(f"{what} returned {type(value).__name__}; {wanted}") from None
    except OverflowError:
        raise Refused(f"{what} returned a number that is too large; {wanted}") from None
    if array.ndim != dimensions:
        raise Refused(f"{what} returned an array of shape {array.shape}; {wanted}")
    return array


def curve(value: object, dimensions: int, what: str, wanted: str) -> tuple[Floats, Floats]:
    """Where the points are, and the values. @raises Refused"""
    if not isinstance(value, tuple) or len(value) != 2:
        raise Refused(f"{what} returned {type(value).__name__}; {wanted}")
    at, values = numbers(value[0], 1, what, wanted), numbers(value[1], dimensions, what, wanted)
    if len(at) == 0 or values.shape[-1] != len(at):
        raise Refused(f"{what} returned {len(at)} places and values of shape {values.shape}; {wanted}")
    if not np.isfinite(at).all() or np.isinf(values).any():
        raise Refused(f"{what} returned a place that is not finite or a value that is infinite; {wanted}")
    return at, values


class Measurement:
    """An observable in one packing."""

    def __init__(self, one: Observable, file: str, packing: Packing) -> None:
        self.one, self.file, self.packing = one, file, packing
        self.place = f"{one.name} in case {packing.case.folder.name}, packing {packing.number}"

    def call(self, argument: object, where: str) -> Any:
        return with_traceback(self.file, f"{where} failed", lambda: self.one.function(argument))

    def of_cycles(self, cycles: list[Any]) -> Curve:
        """The function is called with each cycle."""
        rows: list[Floats] = []
        at: Floats | None = None
        for cycle in cycles:
            where = f"{self.place}, cycle {cycle.number}"
            value = self.call(cycle, where)
            if not self.one.over:
                rows.append(numbers(value, 0, where, "return one number").reshape(1))
                continue
            places, row = curve(value, 1, where, "return two arrays of one length: where the points are, and the values")
            if at is not None and not np.array_equal(at, places):
                raise Refused(f"{where} returned other places than in the cycle before; return the same ones in every cycle")
            at = places
            rows.append(row)
        return self.checked(at, np.array(rows))

    def of_packing(self, count: int) -> Curve | None:
        """The function is called once; it may return None where it does not apply."""
        value = self.call(self.packing, self.place)
        if value is None:
            return None
        if self.one.over:
            wanted = f"return two arrays: where the points are, and a row of values for each of the {count} cycles"
            at, values = curve(value, 2, self.place, wanted)
        else:
            wanted = f"return an array with a number for each of the {count} cycles"
            at, values = None, numbers(value, 1, self.place, wanted).reshape(-1, 1)
        if len(values) != count:
            raise Refused(f"{self.place} returned values for {len(values)} cycles; {wanted}")
        return self.checked(at, values)

    def checked(self, at: Floats | None, values: Floats) -> Curve:
        """@raises Refused where a number is not one, or there is no value at all"""
        if np.isnan(values).all():
            raise Refused(f"{self.place} returned NaN for all cycles; return finite numbers" +
                          (", or None where it does not apply" if self.one.of == "packing" else ""))  # fmt: skip
        bad = np.isinf(values)
        if at is None:  # NaN at the beginning is a number that is not defined yet
            bad |= np.isnan(values) & np.logical_or.accumulate(np.isfinite(values))
        if bad.any():
            raise Refused(f"{self.place}, cycle {int(np.argmax(bad.any(axis=1))) + 1} returned {values[bad][0]:g}, which is not a finite number")
        rows = [[None if math.isnan(value) else float(value) for value in row] for row in values]
        return ([] if at is None else list(map(float, at))), rows

    def values(self) -> Curve | None:
        """None where the packing does not have what the observable needs."""
        if not self.packing.has(self.one.needs):
            return None
        cycles = self.packing.cycles(self.one.needs)
        if not cycles:
            return None
        try:
            return self.of_cycles(cycles) if self.one.of == "cycle" else self.of_packing(len(cycles))
        except GrainsChangeError:
            return None


class Progress:
    """How far it is, in one line of a terminal, once it takes longer than a second."""

    def __init__(self, steps: int) -> None:
        self.steps, self.done, self.shown_at = steps, 0, time.monotonic()

    def step(self, what: str) -> None:
        if sys.stderr.isatty() and time.monotonic() > self.shown_at + 1:
            print(f"\r{self.done} of {self.steps}: {what}\x1b[K", end="", file=sys.stderr, flush=True)
            self.shown_at = time.monotonic()
        self.done += 1

    def close(self) -> None:
        if sys.stderr.isatty():
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)


def measured(one: Observable, file: str, packings: list[Packing], progress: Progress) -> dict[str, Any]:
    """The values in all packings that have what it needs. @raises Refused"""
    at: list[float] | None = None
    found: list[dict[str, Any]] = []
    for packing in packings:
        progress.step(f"{one.name} in case {packing.case.folder.name}, packing {packing.number}")
        values = Measurement(one, file, packing).values()
        if values is None:
            continue
        if at is not None and at != values[0]:
            raise Refused(f"{one.name} has other places in packing {packing.number} of case {packing.case.folder.name} than in the packing before; "
                          "return the same ones in every packing of a case")  # fmt: skip
        at = values[0]
        found.append({"number": packing.number, "cycles": values[1]})
    return {"at": at or [], "packings": found, "has_needs": any(packing.has(one.needs) for packing in packings)}


def packings_of(folder: str) -> list[Packing]:
    case = Case(pathlib.Path(folder))
    return [case.packing(number + 1) for number in range(len(case.result["packings/seed"]))]


def answers(request: dict[str, Any], observables: list[Observable]) -> Iterator[tuple[str, dict[str, Any]]]:
    """For each case, its id and what was measured."""
    progress: Progress | None = None
    for folder in request["cases"]:
        packings = packings_of(folder)
        progress = progress or Progress(len(request["cases"]) * len(packings) * len(observables))
        yield pathlib.Path(folder).name, {one.name: measured(one, request["file"], packings, progress) for one in observables}
    if progress:
        progress.close()


def main() -> int:
    os.dup2(2, 1)  # what a person's code prints must not stand within the answer of the program
    task, work = sys.argv[1], pathlib.Path(sys.argv[2])
    request = json.loads((work / "request.json").read_text(encoding="utf-8"))
    observables = load(work, request["file"])
    if task == "list":
        rows = [{"name": one.name, "unit": one.unit, "meaning": one.meaning, "needs": one.needs, "over": one.over, "over_unit": one.over_unit}
                for one in observables]  # fmt: skip
        (work / "list.json").write_text(json.dumps(rows), encoding="utf-8")
        return 0
    wanted = [one for one in observables if one.name in request["only"]]
    for case, answer in answers(request, wanted):
        (work / f"{case}.json").write_text(json.dumps(answer), encoding="utf-8")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (Refused, OSError, ValueError) as refused:
        print(f"vibrotrough: {' '.join(str(refused).split())}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)
