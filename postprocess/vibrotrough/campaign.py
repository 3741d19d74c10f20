"""A campaign from its file: plan, run, table, cases. Every number comes from the program, which this module starts.

    import vibrotrough

    campaign = vibrotrough.Campaign("pellets.toml")             # its results are in runs/pellets, or in the folder `output`
    print(campaign.plan())                                      # the cases and what they will cost
    campaign.run(jobs=2)                                        # simulates what is missing; shows how far it is
    print(campaign.table()[["throw_number", "conveying_speed_m_per_s"]])
    case = campaign.cases()[0]                                  # or campaign.case(ID)
    print(case["packings/efficiency"], case.phases(1)["velocity_x"])
    print(case.frames(1)[-1].positions)                         # where the campaign keeps frames; see help(vibrotrough.frames)

    demo = vibrotrough.Campaign("runs/demo")                    # a campaign that was run before, by its folder
    vibrotrough.table([campaign, demo])                         # the rows of several campaigns, with their names

Tables are pandas.DataFrame where pandas is installed, else lists of dicts.
"""

from __future__ import annotations

import functools
import json
import os
import pathlib
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .frames import ContactFrames, Frames, Packing
from .results import Array, File, open_result

Progress = Callable[[dict[str, Any]], None]


class ProgramError(Exception):
    """The program refused or failed; the text is what it said, and `code` its exit code."""

    def __init__(self, said: str, code: int) -> None:
        super().__init__(said)
        self.code = code


def find_program(program: str | os.PathLike[str] | None = None) -> str:
    """The program: the one that is given, that of the checkout in which this module lies, or `vibrotrough` on the PATH.
    @raises FileNotFoundError when there is none"""
    built = pathlib.Path(__file__).resolve().parents[2] / "build" / "release" / "src" / "app" / "vibrotrough"
    found = shutil.which(os.fspath(program)) if program else str(built) if built.is_file() else shutil.which("vibrotrough")
    if found is None:
        raise FileNotFoundError(f"{program or 'vibrotrough'} was not found; install it, or give its path as program=")
    return found


def ask(program: str, *words: str | os.PathLike[str], allowed: Sequence[int] = (0,)) -> Any:
    """What the program answers in JSON. @param allowed  exit codes with which it has an answer. @raises ProgramError with its message"""
    done = subprocess.run([program, *(os.fspath(word) for word in words), "--json"], capture_output=True, text=True, check=False)
    if done.returncode not in allowed:
        raise ProgramError(done.stderr.strip() or done.stdout.strip(), done.returncode)
    return json.loads(done.stdout)


def as_table(rows: list[dict[str, Any]]) -> Any:
    """A DataFrame, with the cases' ids as its index, where pandas is installed; else the rows."""
    try:
        import pandas
    except ImportError:
        return rows
    frame = pandas.DataFrame(rows)
    return frame.set_index("case") if "case" in frame else frame


class Line:
    """Shows how far a run is in one line, which a notebook or a terminal writes again and again."""

    def __init__(self) -> None:
        self._length = 0

    def __call__(self, event: dict[str, Any]) -> None:
        if event.get("event") != "progress":
            return
        text = f"{event['finished']} cases done, {event['running']} running, {event['left']} left"
        if event["time_to_go_s"] is not None:
            text += f"; about {event['time_to_go_s']:.0f} s to go"
        print("\r" + text.ljust(self._length), end="", file=sys.stderr, flush=True)
        self._length = len(text)

    def close(self) -> None:
        if self._length:
            print(file=sys.stderr)


class Case(Mapping[str, Array]):
    """One case: the arrays of its result by name, and what its packings wrote. Its result is read once, where it is first asked for."""

    def __init__(self, folder: pathlib.Path) -> None:
        self.folder = folder

    def __repr__(self) -> str:
        return f"<Case {self.folder.name} in {self.folder.parent.parent}>"

    @functools.cached_property
    def result(self) -> File:
        """result.h5, with the series of cycles of each packing. @raises OSError when the case has none yet"""
        return open_result(self.folder)

    def __getitem__(self, name: str) -> Array:
        return self.result[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.result)

    def __len__(self) -> int:
        return len(self.result)

    def packings(self) -> list[Packing]:
        """What each packing of its result wrote. @raises OSError when the case has none yet"""
        return [self.packing(1 + place) for place in range(len(self["packings/seed"]))]

    def packing(self, packing: int) -> Packing:
        """What one of its packings wrote; packings count from 1. @raises KeyError when the result has none of this number"""
        return Packing(self, packing)

    def frames(self, packing: int = 1) -> Frames:
        """The frames of a packing, which output.frames_per_cycle keeps: positions, velocities, radii and types of the grains as arrays.
        @raises OSError when the packing kept none"""
        return self.packing(packing).frames

    def contacts(self, packing: int = 1) -> ContactFrames:
        """The contacts in these frames with their forces, which output.contacts keeps. @raises OSError when the packing kept none"""
        return self.packing(packing).contacts

    def phases(self, packing: int) -> dict[str, Array]:
        """The motion of layer and trough over the cycle, averaged over the cycles that count: the columns of the packing's phases.
        @raises KeyError when the packing has none"""
        result, start = self.result, f"phases/{packing}/"
        found = {name.removeprefix(start): result[name] for name in result if name.startswith(start)}
        if not found:
            raise KeyError(f"{result.path} has no phases of packing {packing}")
        return found


def case_in(campaign: pathlib.Path, case: object) -> Case:
    folder = campaign / "cases" / str(case)
    if not folder.is_dir():
        raise KeyError(f"{campaign} has no case {case}")
    return Case(folder)


class CampaignFile(File):
    """campaign.h5: one array per column, one element per case with a result."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        super().__init__(path, "vibrotrough campaign")

    @property
    def cases(self) -> int:
        """Number of cases in the table."""
        return len(self["case"]) if "case" in self else 0

    def case(self, case: object) -> Case:
        """A case by its id. @raises KeyError when the campaign has none of this id"""
        return case_in(self.path.parent, case)

    def rows(self, **conditions: Any) -> NDArray[np.intp]:
        """Row numbers where every named column has the value (floats to 1e-9), e.g. rows(outcome="finished")."""
        keep = np.ones(self.cases, dtype=bool)
        for name, value in conditions.items():
            column = np.asarray(self[name])
            keep &= column == value if column.dtype.kind in "OU" else np.isclose(column, value, rtol=1e-9, atol=0)
        return np.flatnonzero(keep)

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame with one row per case and one column per quantity, indexed by the case's id.

        Swept keys are columns such as "swept/grains.rolling_friction". `attrs["units"]` and `attrs["descriptions"]` are dicts by column.
        """
        import pandas  # only this function needs it

        columns = [name for name in self if name != "case" and "/curve/" not in name and self[name].ndim == 1 and len(self[name]) == self.cases]
        frame = pandas.DataFrame({name: np.asarray(self[name]) for name in columns}, index=pandas.Index(list(self["case"]), name="case"))
        frame.attrs["units"] = {name: self[name].units for name in columns}
        frame.attrs["descriptions"] = {name: self[name].description for name in columns}
        return frame


def open_campaign(path: str | os.PathLike[str]) -> CampaignFile:
    """A campaign from its folder or its campaign.h5."""
    path = pathlib.Path(path)
    return CampaignFile(path / "campaign.h5" if path.is_dir() else path)


class Campaign:
    """A campaign file and the folder of its results; or, in place of the file, the folder of a campaign that was run before."""

    def __init__(self, file: str | os.PathLike[str], output: str | os.PathLike[str] | None = None,
                 program: str | os.PathLike[str] | None = None) -> None:  # fmt: skip
        self.file, self.program = pathlib.Path(file), find_program(program)
        if (self.file / "campaign.toml").is_file():
            self.file, output = self.file / "campaign.toml", output or self.file
        name = ask(self.program, "plan", self.file)["campaign"]  # which also says what is wrong with the file
        self.folder = pathlib.Path(output) if output else pathlib.Path("runs") / str(name)

    def __repr__(self) -> str:
        return f"<Campaign {self.file}, results in {self.folder}>"

    def plan(self) -> Any:
        """The cases, with the core time that each will probably take. @raises ProgramError when the file has a mistake"""
        return as_table(ask(self.program, "plan", self.file, "--output", self.folder)["cases"])

    def check(self) -> list[dict[str, Any]]:
        """The findings of `vibrotrough check` that are not fine, each with the number of its case."""
        answer = ask(self.program, "check", self.file, allowed=(0, 1, 2))
        return [{"case": case["case"], **finding} for case in answer["cases"] for finding in case["findings"] if finding["severity"] != "fine"]

    def predict(self) -> list[dict[str, Any]]:
        """What the atlas of simulated layers says of each case before it is simulated: efficiency, half_width (95 %), and what lies outside"""
        answer: list[dict[str, Any]] = ask(self.program, "predict", self.file)
        return answer

    def run(self, jobs: int | None = None, progress: Progress | None = None, options: Sequence[str] = ()) -> bool:
        """Simulates what is not finished. A stop, also by Ctrl-C, loses nothing: the next call continues.

        @param progress  is called with each event of `run --progress json`; None shows one line
        @param options   further options of `vibrotrough run`, such as "--accept-findings"
        @returns whether all cases are finished; else the table says what is with the others
        @raises ProgramError when nothing could be simulated
        """
        words = [self.program, "run", os.fspath(self.file), "--output", os.fspath(self.folder), "--progress", "json", *options]
        words += ["--jobs", str(jobs)] if jobs else []
        show, said = progress or Line(), []
        with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
            assert process.stderr is not None
            try:
                for line in process.stderr:
                    if line.startswith("{"):
                        show(json.loads(line))
                    else:
                        said.append(line)
            except BaseException:  # a notebook interrupts Python alone: the program ends its engines, too
                process.terminate()
                process.stderr.read()
                raise
        if isinstance(show, Line):
            show.close()
        if process.returncode not in (0, 1):
            raise ProgramError("".join(said).strip(), process.returncode)
        return process.returncode == 0

    def status(self) -> dict[str, Any]:
        """What `vibrotrough status` says: how many cases are finished, running and left, and each case. @raises ProgramError"""
        answer: dict[str, Any] = ask(self.program, "status", self.folder)
        return answer

    def table(self) -> Any:
        """The rows of `vibrotrough compare`: results beside the theory. @raises ProgramError when nothing was run"""
        return as_table(ask(self.program, "compare", self.folder, allowed=(0, 1)))

    def results(self) -> CampaignFile:
        """campaign.h5: all cases with results, with units. @raises OSError when there are none"""
        return open_campaign(self.folder)

    def cases(self) -> list[Case]:
        """Its cases that have results, in the order of its table. @raises OSError when there are none"""
        return [self.case(case) for case in self.results()["case"]]

    def case(self, case: object) -> Case:
        """A case by its id. @raises KeyError when the campaign has none of this id"""
        return case_in(self.folder, case)


def table(campaigns: Iterable[Campaign | str | os.PathLike[str]], program: str | os.PathLike[str] | None = None) -> Any:
    """The rows of several campaigns, of which each may be a Campaign or the folder of one, with the column `campaign`.
    @raises ProgramError when one of them has no results"""
    rows = []
    for one in campaigns:
        folder = one.folder if isinstance(one, Campaign) else pathlib.Path(one)
        used = one.program if isinstance(one, Campaign) else find_program(program)
        rows += [{"campaign": folder.name, **row} for row in ask(used, "compare", folder, allowed=(0, 1))]
    return as_table(rows)
