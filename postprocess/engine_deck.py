"""Runs the LIGGGHTS decks that cases of validation/ bring along, and reads what the engine wrote."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

CONTACT_OPTIONS = "limitForce on tangential_damping off"  # of the campaigns' decks

Floats = NDArray[np.float64]


def pair_matrix(with_floor: Sequence[float], other: float) -> str:
    """A property of pairs of types, whose last type is the floor: `with_floor` for each type of grain, else `other`."""
    types = len(with_floor) + 1
    return " ".join(str(with_floor[min(i, j)] if max(i, j) == types - 1 and i != j else other) for i in range(types) for j in range(types))


def materials(young: float, poisson: float, restitution: Sequence[float], friction: Sequence[float]) -> str:
    """The commands for the materials of grains on a floor. `young` in Pa; `restitution` and `friction`: of each type of grain with
    the floor, 0.5 between grains."""
    types = len(restitution) + 1
    return (f"fix modulus all property/global youngsModulus peratomtype {' '.join([str(young)] * types)}\n"
            f"fix poisson all property/global poissonsRatio peratomtype {' '.join([str(poisson)] * types)}\n"
            f"fix restitution all property/global coefficientRestitution peratomtypepair {types} {pair_matrix(restitution, 0.5)}\n"
            f"fix friction all property/global coefficientFriction peratomtypepair {types} {pair_matrix(friction, 0.5)}\n")


def flat_floor(length: float, width: float, cell: float) -> str:
    """STL of the rectangle 0 to length, 0 to width (m) at z = 0 in triangles of about `cell` (m); long thin ones abort the engine."""
    columns, rows = (max(1, round(side / cell)) for side in (length, width))
    text = ["solid floor"]
    for i in range(columns):
        for j in range(rows):
            corner = [(length * (i + a) / columns, width * (j + b) / rows) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
            for triangle in ((0, 1, 2), (0, 2, 3)):
                text += ["facet normal 0 0 1", "outer loop"]
                text += [f"vertex {corner[k][0]!r} {corner[k][1]!r} 0" for k in triangle]
                text += ["endloop", "endfacet"]
    return "\n".join(text + ["endsolid floor"]) + "\n"


def screen_text(screen: pathlib.Path) -> str:
    """What the engine wrote. Its error messages may hold bytes that are not text."""
    return screen.read_text(encoding="utf-8", errors="replace")


def run_deck(folder: pathlib.Path, deck: str | pathlib.Path, variables: Mapping[str, object] | None = None,
             wanted: str = "VIBROTROUGH DONE", resume: bool = False) -> str:
    """Runs `deck` in `folder` with the variables that it names as ${name}, and returns what the engine wrote.

    The script ends when the engine fails or did not write `wanted`. `resume`: return what an earlier run of the same deck wrote.
    """
    program = shutil.which("liggghts")
    if program is None:
        raise SystemExit("there is no liggghts on the PATH; install the Debian package liggghts")
    deck = pathlib.Path(deck)
    screen = folder / f"{deck.stem}.screen"
    if resume and screen.exists() and screen.stat().st_mtime >= (folder / deck).stat().st_mtime and wanted in screen_text(screen):
        return screen_text(screen)
    command = [program, "-in", str(deck), "-log", f"{deck.stem}.log"]
    for name, value in (variables or {}).items():
        command += ["-var", name, str(value)]
    # A folder of its own for Open MPI: an engine that has just ended may still be removing its session from a shared one.
    with tempfile.TemporaryDirectory(prefix=".mpi-", dir=folder, ignore_cleanup_errors=True) as session, open(screen, "w", encoding="utf-8") as file:
        environment = {**os.environ, "OMPI_MCA_orte_tmpdir_base": session, "OMP_NUM_THREADS": "1"}
        code = subprocess.run(command, cwd=folder, stdout=file, stderr=subprocess.STDOUT, env=environment, check=False).returncode
    text = screen_text(screen)
    if code != 0 or wanted not in text:
        raise SystemExit(f"{' '.join(command)} ended with {code}; see {screen}")
    return text


def write_if_new(path: pathlib.Path, text: str) -> None:
    """Writes `text` unless the file holds it already: a file that is not touched does not make its results out of date."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def campaign_decks(program: str, folder: pathlib.Path, text: str, resume: bool = False) -> list[pathlib.Path]:
    """Renders the decks of the campaign `text` into `folder` with `vibrotrough deck` and returns the packings' folders in order.

    `resume`: keep what is there when the same campaign was rendered before.
    """
    file = folder.with_suffix(".toml")
    if resume and folder.exists() and file.exists() and file.read_text(encoding="utf-8") == text:
        return sorted(path.parent for path in folder.glob("case-*/packing-*/in.liggghts"))
    shutil.rmtree(folder, ignore_errors=True)
    folder.parent.mkdir(parents=True, exist_ok=True)
    fresh = folder.with_suffix(".new.toml")
    fresh.write_text(text, encoding="utf-8")
    answer = subprocess.run([program, "deck", str(fresh), "--output", str(folder)], capture_output=True, text=True, check=False)
    if answer.returncode != 0:
        raise SystemExit(answer.stderr)
    fresh.rename(file)
    return sorted(path.parent for path in folder.glob("case-*/packing-*/in.liggghts"))


def last_group(pattern: str, text: str) -> str:
    """What the last group of the first match of `pattern` in `text` holds; ValueError when nothing matches."""
    found = re.search(pattern, text)
    if found is None or found.lastindex is None:
        raise ValueError(f"there is no {pattern!r} in the text")
    return str(found[found.lastindex])


def settled(screen: str) -> dict[str, float]:
    """Floor force (N, along z), mass (kg) and height of the centre (m) of a settled packing, from the last line of settle.liggghts."""
    words = screen[screen.rindex("VIBROTROUGH SETTLED"):].split()
    return {name: float(words[words.index(name) + 1]) for name in ("floor_force", "mass", "centre_height")}


def read_lines(path: pathlib.Path) -> dict[str, Floats]:
    """A table that a campaign's deck wrote (cycles.csv, phases.csv): {column: array}."""
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    table = np.array([list(map(float, line.split(","))) for line in lines[1:]])
    return {name: table[:, i] for i, name in enumerate(lines[0].split(","))}


def read_dump(path: pathlib.Path) -> tuple[NDArray[np.int64], dict[str, Floats]]:
    """Steps, and the columns of a text dump sorted by id as {name: array of shape (steps, grains)}."""
    lines = path.read_text(encoding="utf-8").splitlines()
    steps: list[int] = []
    frames: list[list[list[float]]] = []
    names: list[str] = []
    at = 0
    while at < len(lines):
        steps.append(int(lines[at + 1]))
        count, names = int(lines[at + 3]), lines[at + 8].split()[2:]
        frames.append([list(map(float, line.split())) for line in lines[at + 9:at + 9 + count]])
        at += 9 + count
    table = np.array(frames)
    return np.array(steps), {name: table[:, :, i] for i, name in enumerate(names)}
