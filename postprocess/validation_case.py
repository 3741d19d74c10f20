"""One case of validation/: its options, criteria, findings and verdict. postprocess/README.md explains how to make a case."""

import argparse
import csv
import datetime
import io
import json
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile
import time
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from campaign_program import Row, campaign_text, run_campaign

ROOT = pathlib.Path(__file__).resolve().parent.parent
USUAL_POINTS = 300
HOLDS, FAILS = 0, 4  # exit codes; 1 is a crash of the script

Floats = NDArray[np.float64]


def read_table(path: pathlib.Path) -> list[Row]:
    """Rows of a CSV file as dicts of texts; lines that begin with # are comments."""
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def today() -> str:
    return datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d")


def machine() -> str:
    """System, processor and number of cores."""
    try:
        text = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
        found = re.search(r"^model name\s*: (.*)$", text, re.MULTILINE)
    except OSError:
        found = None
    processor = found[1] if found else platform.machine()
    return f"{platform.system()}, {processor}, {os.cpu_count()} cores"


def arguments(description: str) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--program", default=str(ROOT / "build/release/src/app/vibrotrough"))
    parser.add_argument("--output", type=pathlib.Path, help="folder of tables, figures and verdict.json; default: the case's own")
    parser.add_argument("--runs", type=pathlib.Path, help="folder of simulations, which continue where they stopped; default: runs/NAME")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--long", action="store_true", help="run the simulations of a long case instead of judging its stored tables")
    parser.add_argument("--quick", action="store_true", help="with --long: run only a few cases, to try the script; this proves nothing")
    parser.add_argument("--negative-control", action="store_true", help="make the case's deliberate mistake, which its criteria must detect")
    parser.add_argument("--points", type=int, default=USUAL_POINTS, help="points per axis of a map of the theory")
    return parser.parse_args()


class ValidationCase:
    """Reads FOLDER/case.toml, runs the program, collects criteria and findings; finish() writes the verdict.

    `control` is true in the negative control, a second run with a deliberate mistake that the criteria must detect.
    """

    def __init__(self, folder: pathlib.Path) -> None:
        self.folder = folder
        self.about: dict[str, Any] = tomllib.loads((self.folder / "case.toml").read_text(encoding="utf-8"))
        options = arguments(self.about["question"])
        self.program: str = options.program
        self.jobs: int = options.jobs
        self.points: int = options.points
        self.output: pathlib.Path = options.output or self.folder
        self.runs: pathlib.Path = (options.runs or ROOT / "runs" / self.folder.name).resolve()
        self.long: bool = options.long
        self.quick: bool = options.quick
        self.control: bool = options.negative_control
        self.output.mkdir(parents=True, exist_ok=True)
        self.criteria: list[dict[str, Any]] = []
        self.findings: list[dict[str, Any]] = []
        self.begin, self.made_by = time.monotonic(), ""

    def own_runs(self) -> pathlib.Path:
        """Folder below --runs that the case and its negative control do not share."""
        return self.runs / ("negative_control" if self.control else "case")

    def sections(self, base: str = "base.toml") -> dict[str, Any]:
        """The sections of FOLDER/base.toml, a campaign without a sweep."""
        return tomllib.loads((self.folder / base).read_text(encoding="utf-8"))

    # What the program says.

    def theory(self, *words: object) -> str:
        """What `vibrotrough theory WORDS` prints."""
        return self._ask("theory", *map(str, words))

    def json(self, *words: object) -> Any:
        """What `vibrotrough theory WORDS --json` prints, as Python values."""
        return json.loads(self.theory(*words, "--json"))

    def csv(self, *words: object) -> list[Row]:
        """The rows that `vibrotrough theory WORDS` prints as CSV."""
        return list(csv.DictReader(io.StringIO(self.theory(*words))))

    def batch(self, columns: Sequence[str], points: Iterable[Sequence[float]], words: Sequence[str] = ()) -> list[Row]:
        """The rows of `vibrotrough theory batch WORDS` for `points`, rows of numbers whose inputs `columns` names."""
        lines = [",".join(columns)] + [",".join(repr(float(value)) for value in point) for point in points]
        with tempfile.TemporaryDirectory() as folder:
            questions, answers = pathlib.Path(folder, "points.csv"), pathlib.Path(folder, "answers.csv")
            questions.write_text("\n".join(lines) + "\n", encoding="utf-8")
            self.theory("batch", questions, "--output", answers, *words)
            return read_table(answers)

    def efficiencies(self, columns: Sequence[str], points: Iterable[Sequence[float]], words: Sequence[str] = ()) -> Floats:
        """The theory's velocity efficiency at each of `points`, as for batch()."""
        return np.array([float(row["velocity_efficiency"]) for row in self.batch(columns, points, words)])

    def drawn(self, numbers: Sequence[float]) -> Sequence[float]:
        """Those of the numbers at which a curve is drawn: all of them with the usual --points, and fewer with fewer points."""
        return numbers[:: max(1, USUAL_POINTS // self.points)]

    def of_file(self, command: str, text: str) -> Any:
        """What `vibrotrough COMMAND --json` says of a campaign file."""
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            file.write(text)
            file.flush()
            return json.loads(self._ask(command, file.name, "--json"))

    def _ask(self, *words: str) -> str:
        answer = subprocess.run([self.program, *words], capture_output=True, text=True, check=False)
        if answer.returncode != 0:
            raise SystemExit(f"{self.program} {' '.join(words)}\n{answer.stderr}")
        return answer.stdout

    def campaign(self, name: str, changes: Mapping[str, Any], sweep: Mapping[str, Sequence[Any]], options: Sequence[str] = ()) -> list[Row]:
        """Runs variations of FOLDER/base.toml below --runs and returns the table's rows in the order of the sweep. `options`: more of `run`."""
        text = campaign_text(self.sections(), {"campaign.name": name, **changes}, sweep)
        return run_campaign(self.program, self.runs / name, text, self.jobs, options)

    # Tables: written by a long run, and read when this run or a later one is judged.

    def reference(self, name: str = "reference.csv") -> list[Row]:
        """The rows of FOLDER/reference.csv: published or exact values."""
        return read_table(self.folder / name)

    def table(self, name: str) -> list[Row]:
        """A table that write_table() wrote: that of this run with --long or if the case is not long, else the stored one."""
        fresh = self.long or not self.about.get("long", False)
        path = (self.output if fresh else self.folder) / name
        if not fresh:  # the verdict names what made the numbers, not who judged them
            maker = path.read_text(encoding="utf-8").splitlines()[0].lstrip("# ")
            if maker not in self.made_by:
                self.made_by = f"{self.made_by}; further tables: {maker}" if self.made_by else maker
        return read_table(path)

    def write_table(self, name: str, header: Sequence[str], rows: Iterable[Iterable[object]]) -> None:
        """Writes a CSV file whose first line, a comment, says what made it."""
        with open(self.output / name, "w", encoding="utf-8", newline="") as file:
            file.write(f"# {self.provenance()}\n")
            csv.writer(file, lineterminator="\n").writerows([header, *rows])

    def follows(self, name: str, header: Sequence[str], rows: Sequence[Sequence[object]]) -> None:
        """Writes a table that follows from other tables; a criterion fails unless the stored one is the same. Not in a negative control."""
        if self.control:
            return
        if self.output.resolve() != self.folder:
            path = self.folder / name
            stored = [list(row.values()) for row in read_table(path)] if path.exists() else []
            differ = sum(old != list(map(str, new)) for old, new in zip(stored, rows)) + abs(len(stored) - len(rows))
            self.between(f"rows of {name} that differ from those that follow from the other tables now", differ, 0, 0, "--store writes it again")
        self.write_table(name, header, rows)

    def figure(self, name: str) -> pathlib.Path:
        """Where to save a figure. The negative control has an output folder of its own."""
        return self.output / name

    # Judgement.

    def check(self, what: str, value: float, expected: float, tolerance: float, because: str = "") -> None:
        """A criterion: |value - expected| <= tolerance. `because`: the reason for the tolerance."""
        self.between(what, value, expected - tolerance, expected + tolerance, because)

    def between(self, what: str, value: float, least: float, most: float, because: str = "") -> None:
        """A criterion: least <= value <= most. NaN fails."""
        value, holds = float(value), bool(least <= value <= most)
        self.criteria.append({"what": what, "value": value, "least": float(least), "most": float(most), "holds": holds,
                              "because": because})
        print(f"{'ok  ' if holds else 'FAIL'} {what}: {value:.6g}, wanted {least:.6g} to {most:.6g}")

    def finding(self, claim: str, borne_out: bool | None, measured: str) -> None:
        """A published claim and whether our measurement bears it out (None: undecided). It does not decide the verdict."""
        borne_out = None if borne_out is None else bool(borne_out)  # NumPy's truth values are not JSON's
        self.findings.append({"claim": claim, "borne_out": borne_out, "measured": measured})
        print({True: "borne out    ", False: "not borne out", None: "undecided    "}[borne_out], f"{claim}: {measured}")

    def provenance(self) -> str:
        """Date, program with its commit, and machine, for the first line of a table."""
        return f"{today()}; {self._ask('--version').splitlines()[0]}; {machine()}"

    def finish(self) -> NoReturn:
        """Writes verdict.json, except in a negative control, and exits with HOLDS or FAILS. A case without criteria fails."""
        failed = sum(not criterion["holds"] for criterion in self.criteria)
        holds = failed == 0 and bool(self.criteria)
        print("all criteria hold" if holds else f"{failed} of {len(self.criteria)} criteria fail")
        if not self.control:
            self._write_verdict(holds)
        sys.exit(HOLDS if holds else FAILS)

    def _write_verdict(self, holds: bool) -> None:
        long = self.about.get("long", False)
        verdict = {"case": self.folder.name, "holds": holds, "date": today(), "seconds": round(time.monotonic() - self.begin, 1),
                   "made_by": self.made_by or self.provenance(),
                   "command": f"vibrotrough validate {self.folder.name}" + (" --long" if long else ""),
                   "criteria": self.criteria, "findings": self.findings}
        text = json.dumps(verdict, indent=1, ensure_ascii=False) + "\n"
        (self.output / "verdict.json").write_text(text, encoding="utf-8")
