"""What the packings of a case wrote, as arrays: frames of the grains, contacts, and tables; and how a person defines an observable of them.

    import vibrotrough

    campaign = vibrotrough.Campaign("pellets.toml")
    case = campaign.cases()[0]
    frames = case.frames(1)                                 # of packing 1; read one by one as they are asked for
    frame = frames[-1]
    print(frame.cycle, frame.positions[:, 2].mean() - frame.trough[1])
    print(case.contacts(1)[-1].normal_force)

    import numpy as np

    @vibrotrough.observable(unit="m")
    def height_of_the_layer(cycle):
        '''Mean height of the grains above the trough.'''
        return np.mean([frame.heights.mean() for frame in cycle.frames])

    @vibrotrough.observable(unit="m/s", over=("height", "m"))
    def velocity_profile(cycle):
        '''Mean velocity of the grains along the trough in three slabs of 3 mm.'''
        edges = np.array([0, 0.003, 0.006, 0.009])
        slabs = np.concatenate([np.digitize(frame.heights, edges) for frame in cycle.frames])
        velocities = np.concatenate([frame.velocities[:, 0] for frame in cycle.frames])
        return (edges[1:] + edges[:-1]) / 2, [velocities[slabs == slab].mean() for slab in (1, 2, 3)]

`vibrotrough observe` measures such functions in every packing and makes means with intervals of them. Lengths are in m, times in s, forces
in N. x is along the trough, y across, z normal to it; positions are those of the engine, relative to the ground.
"""

from __future__ import annotations

import dataclasses
import functools
import pathlib
from collections.abc import Callable, Iterator, Sequence
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from .results import Array, read_regular

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

NEEDS = ("frames", "contacts", "cycles")  # anything else is the name of a file in the packing's folder


class GrainsChangeError(ValueError):
    """The frames of a packing do not have the same grains, as on a screen. `vibrotrough observe` leaves the packing out."""


@dataclasses.dataclass(frozen=True)
class Observable:
    """What `observable` says of a function."""

    name: str
    unit: str
    meaning: str
    needs: str
    of: str
    over: str
    over_unit: str
    function: Callable[[Any], Any]


def observable(unit: str = "1", *, needs: str = "frames", of: str = "cycle", over: tuple[str, str] | None = None) -> Callable[[Any], Any]:
    """Makes a function an observable, which `vibrotrough observe` measures. Its name is the observable's, the first line of its docstring
    says what it is.

    @param unit   of what it returns, such as "m/s"; "1" for pure numbers
    @param needs  "frames", "contacts" (with frames), "cycles" (cycles.csv alone), or the name of a file that engine.templates write, such
                  as "own.*.csv" (see Packing.table)
    @param of     "cycle": the function is called with each Cycle and returns its number; "packing": it is called once with each Packing and
                  returns an array with one number for each cycle, NaN at the beginning where it is not defined yet, or None where it
                  does not apply
    @param over   name and unit of the axis of a curve, such as ("height", "m"): the function then returns two arrays, where the points
                  are and their values, with `of="packing"` a row of values for each cycle. NaN is a point without a value
    """

    def mark(function: Callable[[Any], Any]) -> Callable[[Any], Any]:
        lines = (function.__doc__ or "").strip().splitlines() or [""]
        function._observable = Observable(function.__name__, unit, lines[0].strip(), needs, of, *(over or ("", "")), function)  # type: ignore[attr-defined]
        return function

    return mark


@dataclasses.dataclass(frozen=True)
class Frame:
    """The grains at one moment, in the order of their numbers `ids`, which are the same in all frames."""

    step: int  #: of the engine
    cycle: float  #: since the trough began to move
    time: float  #: s
    trough: Floats  #: m, displacement of the trough from rest: x, z
    box: Floats  #: m, a row of lower and upper bound for x, y and z
    ids: Integers
    types: Integers  #: 1: the grains of [grains]; 2 and perhaps 3: the trough; further ones: those of [[materials]]
    positions: Floats  #: m, (grains, 3), inside the box
    velocities: Floats  #: m/s, (grains, 3), relative to the ground
    radii: Floats  #: m
    spins: Floats  #: rad/s, (grains, 3)

    def __repr__(self) -> str:
        return f"<Frame: step {self.step}, cycle {self.cycle:.6g}, {self.time:.6g} s, {len(self.ids)} grains>"

    @property
    def heights(self) -> Floats:
        """Heights of the centres above the floor of the trough, m."""
        heights: Floats = self.positions[:, 2] - self.trough[1]
        return heights

    @property
    def volumes(self) -> Floats:
        """Volumes of the spheres, m3."""
        volumes: Floats = 4 / 3 * np.pi * self.radii**3
        return volumes

    @property
    def floor_area(self) -> float:
        """Area of the box along and across the trough, m2."""
        return float(np.prod(self.box[:2, 1] - self.box[:2, 0]))


@dataclasses.dataclass(frozen=True)
class Contacts:
    """The contacts at one moment. The engine evaluates the forces once more for them, with the speeds at the whole step."""

    step: int
    first: Integers  #: number of the first grain
    second: Integers  #: number of the second grain; 0 for the trough
    branch: Floats  #: m, (contacts, 3), from the centre of the first grain to that of the second, or to the point on the trough
    places: Floats  #: m, (contacts, 3), centre of the first grain
    normal_force: Floats  #: N, (contacts, 3), on the first grain
    tangential_force: Floats  #: N, (contacts, 3), on the first grain
    overlap: Floats  #: m

    def __repr__(self) -> str:
        return f"<Contacts: step {self.step}, {np.count_nonzero(self.second)} of grains, {np.count_nonzero(self.second == 0)} with the trough>"


def _dump(path: pathlib.Path) -> tuple[int, Floats, list[str], Floats]:
    """Step, bounds of the box, names of the columns and rows of a text dump. @raises ValueError when it is not a whole one"""
    lines = read_regular(path).decode("ascii", "replace").split("\n", 9)
    if len(lines) < 10 or not lines[8].startswith("ITEM: ") or not lines[4].startswith("ITEM: BOX BOUNDS"):
        raise ValueError(f"{path} is not a whole dump of the engine")
    names = lines[8].split()[2:]
    try:
        values = np.array(lines[9].split(), dtype=float).reshape(int(lines[3]), len(names))
        return int(lines[1]), np.array([line.split() for line in lines[5:8]], dtype=float), names, values
    except ValueError as error:
        raise ValueError(f"{path} is not a whole dump of the engine ({error})") from None


def _table(path: pathlib.Path) -> dict[str, Floats]:
    """A file of numbers by columns. A line without an end is left out. @raises ValueError when it holds something else"""
    lines = [line for line in read_regular(path).decode("utf-8", "replace").split("\n")[:-1] if line]
    rows = [line for line in lines if line[0] != "#"]
    if rows and "," not in rows[0]:  # of fix ave/time, whose last comment names the columns
        comments = [line for line in lines if line[0] == "#"]
        names = ["step" if one == "TimeStep" else one for one in comments[-1][1:].split()] if comments else []
        words = [line.split() for line in rows]
    else:
        names, words = rows[0].split(",") if rows else [], [line.split(",") for line in rows[1:]]
    try:
        values = np.array([list(map(float, row)) for row in words]).reshape(len(words), len(names))
    except ValueError as error:
        raise ValueError(f"{path} is not a table of numbers below their names ({error})") from None
    return {one: values[:, i] for i, one in enumerate(names)}


class Frames(Sequence[Frame]):
    """The frames of a packing, from the start of its drive on; each is read when it is asked for."""

    def __init__(self, packing: Packing) -> None:
        self._packing = packing
        if not packing.has("frames"):
            raise FileNotFoundError(f"packing {packing.number} of {packing.case.folder} kept no frames; write output.frames_per_cycle = 20 and "
                                    'output.frame_packings = "all" into the campaign file, and run it into a new folder')
        table = packing.table("dump/frames.csv")
        steps = [int(step) for step in table["step"]]
        self._steps = [step for step in steps if packing.file(f"dump/frames.{step}.dump").is_file()]
        # A last frame that the engine did not finish has no dump behind its line, and no part in the result.
        ended = packing.result_cycles * packing.steps_per_cycle
        if self._steps != steps and (self._steps != steps[:-1] or steps[-1] <= ended):
            raise ValueError(f"{packing.folder / 'dump'} lacks {len(steps) - len(self._steps)} of its {len(steps)} frames, so that a mean over the others "
                             "would be another one; put them back, or run the campaign into a new folder")  # fmt: skip
        self._trough = {int(step): np.array([x, z]) for step, x, z in zip(table["step"], table["trough_x"], table["trough_z"])}
        self._read = functools.lru_cache(maxsize=64)(self._read_frame)

    @property
    def steps(self) -> list[int]:
        """The time steps of the engine at which the frames are."""
        return self._steps

    def _read_frame(self, step: int) -> Frame:
        path = self._packing.file(f"dump/frames.{step}.dump")
        found, box, names, values = _dump(path)
        column = {name: values[:, i] for i, name in enumerate(names)}
        if found != step or not {"id", "type", "x", "vx", "radius", "omegax"} <= column.keys():
            raise ValueError(f"{path} is not a frame of this packing")
        order = np.argsort(column["id"])
        x, v, spin = (np.column_stack([column[start + axis] for axis in "xyz"])[order] for start in ("", "v", "omega"))
        cycle = step / self._packing.steps_per_cycle
        time = float(np.interp(cycle, np.arange(len(self._packing.times)), self._packing.times))
        return Frame(step, cycle, time, self._trough[step], box, column["id"][order].astype(int), column["type"][order].astype(int), x, v,
                     column["radius"][order], spin)  # fmt: skip

    def __len__(self) -> int:
        return len(self._steps)

    @overload
    def __getitem__(self, place: int) -> Frame: ...
    @overload
    def __getitem__(self, place: slice) -> list[Frame]: ...
    def __getitem__(self, place: int | slice) -> Frame | list[Frame]:
        if isinstance(place, slice):
            return [self._read(step) for step in self._steps[place]]
        return self._read(self._steps[place])

    def at(self, step: int) -> Frame:
        """The frame of a time step of the engine. @raises KeyError when there is none"""
        if step not in self._trough:
            raise KeyError(f"there is no frame of step {step}")
        return self._read(step)

    def unwrapped(self) -> Iterator[Floats]:
        """The positions in each frame, m, (grains, 3), as if the box did not repeat itself: a grain that leaves at one end goes on beyond it.

        Between two frames a grain may move by half the box relative to the layer, which moves at its mean velocity in each cycle: the
        engine knows that of every layer, but wraps the centre of mass of rigid clumps.
        @raises GrainsChangeError when grains come or go
        """
        series, known = self._packing.table("cycles.csv"), np.diff(self._packing.times)
        lengths = np.resize(known, len(series["step"]) - 1)  # of the cycles, s
        lengths[len(known) :] = known[-1]  # those behind the result
        way = np.append(0, np.cumsum(series["mean_vx"][1:] * lengths))
        places, before = np.empty((0, 3)), None
        for frame in self:
            if before is None:
                places = frame.positions.copy()
            elif not np.array_equal(frame.ids, before.ids):
                raise GrainsChangeError("grains come or go, so that they have no way through all frames")
            else:
                carried = np.zeros(3)
                carried[0] = np.diff(np.interp([before.step, frame.step], series["step"], way))[0]
                moved = frame.positions - before.positions - carried
                box = frame.box[:, 1] - frame.box[:, 0]
                moved[:, :2] -= box[:2] * np.round(moved[:, :2] / box[:2])
                places = places + moved + carried
            before = frame
            yield places


class ContactFrames(Sequence[Contacts]):
    """The contacts of a packing in each of its frames; read when they are asked for."""

    def __init__(self, packing: Packing) -> None:
        self._packing, self._frames = packing, packing.frames
        if not packing.has("contacts"):
            raise FileNotFoundError(f"packing {packing.number} of {packing.case.folder} kept no contacts; write output.contacts = true into the "
                                    "campaign file, and run it into a new folder")

    def __len__(self) -> int:
        return len(self._frames)

    @overload
    def __getitem__(self, place: int) -> Contacts: ...
    @overload
    def __getitem__(self, place: slice) -> list[Contacts]: ...
    def __getitem__(self, place: int | slice) -> Contacts | list[Contacts]:
        steps = self._frames.steps[place]
        return [self.at(step) for step in steps] if isinstance(steps, list) else self.at(steps)

    def at(self, step: int) -> Contacts:
        """The contacts of the frame at a time step of the engine. @raises OSError when they were not kept"""
        # Both have two places, three numbers, normal and tangential force, and the overlap.
        _, box, _, pairs = _dump(self._packing.file(f"dump/contacts.{step}.dump"))
        _, _, _, floor = _dump(self._packing.file(f"dump/trough_contacts.{step}.dump"))
        pairs, floor = pairs.reshape(-1, 16), floor.reshape(-1, 16)
        branch = pairs[:, 3:6] - pairs[:, 0:3]
        length = (box[:, 1] - box[:, 0])[:2]
        branch[:, :2] -= length * np.round(branch[:, :2] / length)  # to the image that is touched
        first = np.concatenate([pairs[:, 6], floor[:, 8]]).astype(int)
        second = np.concatenate([pairs[:, 7], np.zeros(len(floor))]).astype(int)
        both = np.concatenate([pairs, floor])
        return Contacts(step, first, second, np.concatenate([branch, floor[:, 0:3] - floor[:, 3:6]]),
                        np.concatenate([pairs[:, 0:3], floor[:, 3:6]]), both[:, 9:12], both[:, 12:15], both[:, 15])  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Cycle:
    """One cycle of a packing's drive."""

    packing: Packing
    number: int  #: from 1

    @property
    def frames(self) -> list[Frame]:
        """Its frames: those after its start, until its end."""
        n = self.packing.steps_per_cycle
        return [self.packing.frames.at(step) for step in self.packing.frames.steps if (self.number - 1) * n < step <= self.number * n]

    @property
    def start(self) -> Frame:
        """The frame at its start, which is the last one of the cycle before."""
        return self.packing.frames.at((self.number - 1) * self.packing.steps_per_cycle)

    @property
    def contacts(self) -> list[Contacts]:
        """Those of its frames."""
        return [self.packing.contacts.at(frame.step) for frame in self.frames]


class Packing:
    """One packing of a case: `case` gives its result, `number` counts from 1."""

    def __init__(self, case: Any, number: int) -> None:
        self.case, self.number, self.result = case, number, case.result
        self.folder: pathlib.Path = case.folder / f"packing-{number}"
        result = self.result
        if not 1 <= number <= len(result["packings/seed"]):
            raise KeyError(f"{result.path} has no packing {number}")
        place = number - 1
        self.steps_per_cycle = int(result["packings/steps_per_cycle"][place])
        self.time_step = float(result["packings/time_step"][place])  # s, of the engine
        self.result_cycles = int(result["packings/cycles_discarded"][place] + result["packings/cycles_measured"][place])

    @functools.cached_property
    def times(self) -> Floats:
        """Ends of cycle 0, 1, 2, ... of the result, s."""
        if "stage_cycles/time" not in self.result:
            return np.arange(self.result_cycles + 1) * self.steps_per_cycle * self.time_step
        ends = [0.0]  # of a drive with stages the middles of the cycles are known
        for middle in self.result["stage_cycles/time"]:
            ends.append(2 * float(middle) - ends[-1])
        return np.array(ends)

    def value(self, name: str) -> float:
        """A number of the case's result, such as "grain_diameter" or "velocity_scale". @raises KeyError"""
        return float(self.result[f"case/{name}"])

    def file(self, name: str) -> pathlib.Path:
        """The path of a file in the packing's folder."""
        return self.folder / name

    def table(self, name: str) -> dict[str, Floats]:
        """A table in the packing's folder by columns: "cycles.csv", or what commands of engine.templates wrote with `fix print` (commas between the
        numbers, and between the names in a first line) or with `fix ave/time` (its own form; TimeStep is called "step").

        The engine begins anew at each checkpoint and opens the files of `fix print` and `fix ave/time` anew. Give them a name with ${now}, such
        as own.${now}.csv, and read "own.*.csv": all parts are put together, and a step that is there twice, because the packing
        was interrupted and continued, counts once, with its last line. @raises OSError when there is no such file
        """
        parts = list(self.folder.glob(name)) if "*" in name else [self.file(name)]
        parts.sort(key=lambda one: [int(word) if word.isdigit() else 0 for word in one.name.split(".")])  # by the step of their start
        tables = [_table(part) for part in parts]
        if not tables:
            raise FileNotFoundError(f"{self.file(name)} is not there")
        names = list(tables[0])
        rows = np.concatenate([np.column_stack([part[one] for one in names]).reshape(-1, len(names)) for part in tables])
        if "step" in names:
            step = rows[:, names.index("step")]
            last = {one: place for place, one in enumerate(step)}  # later lines win
            rows = rows[[last[one] for one in sorted(last)]]
        return {one: rows[:, i] for i, one in enumerate(names)}

    @functools.cached_property
    def frames(self) -> Frames:
        """@raises OSError when the packing kept none"""
        return Frames(self)

    @functools.cached_property
    def contacts(self) -> ContactFrames:
        """@raises OSError when the packing kept no contacts"""
        return ContactFrames(self)

    def phases(self) -> dict[str, Array]:
        """As Case.phases()."""
        phases: dict[str, Array] = self.case.phases(self.number)
        return phases

    def has(self, what: str) -> bool:
        """Whether it has what an observable needs."""
        if what in ("frames", "contacts"):
            return self.file("dump/frames.csv").is_file() and (what == "frames" or any(self.file("dump").glob("contacts.*.dump")))
        return any(one.is_file() for one in self.folder.glob("cycles.csv" if what == "cycles" else what))

    def cycles(self, needs: str = "cycles") -> list[Cycle]:
        """Its cycles that the result is made of, as far as there are frames when these are needed."""
        count = self.result_cycles
        if needs in ("frames", "contacts"):
            known = set(self.frames.steps)
            count = next((k for k in range(count + 1) if k * self.steps_per_cycle not in known), count + 1) - 1
        return [Cycle(self, k) for k in range(1, count + 1)]
