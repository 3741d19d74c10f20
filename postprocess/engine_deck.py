"""Small LIGGGHTS decks of validation/: a folder's own deck, run for real, and what it dumped."""

import os
import pathlib
import shutil
import subprocess

import numpy as np

CONTACT_OPTIONS = "limitForce on tangential_damping off"  # of the campaigns' decks


def flat_floor(length, width, cell):
    """STL of the rectangle 0..length, 0..width at z = 0 m, in triangles of about `cell`: long thin ones abort the engine."""
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


def screen_text(screen):
    """What the engine wrote. Its error messages may hold bytes that are no text."""
    return screen.read_text(encoding="utf-8", errors="replace")


def run_deck(folder, deck, variables=None, wanted="VIBROTROUGH DONE", resume=False):
    """Runs `deck` in `folder` with the variables that it names as ${name}, and returns what the engine wrote; ends when it did
    not write `wanted`. `resume`: takes what an earlier run of the same deck wrote."""
    program = shutil.which("liggghts")
    if program is None:
        raise SystemExit("there is no liggghts on the PATH; install the package liggghts")
    folder, deck = pathlib.Path(folder), pathlib.Path(deck)
    screen = folder / f"{deck.stem}.screen"
    if resume and screen.exists() and screen.stat().st_mtime >= (folder / deck).stat().st_mtime and wanted in screen_text(screen):
        return screen_text(screen)
    command = [program, "-in", str(deck), "-log", f"{deck.stem}.log"]
    for name, value in (variables or {}).items():
        command += ["-var", name, str(value)]
    environment = {**os.environ, "OMPI_MCA_orte_tmpdir_base": str(folder), "OMP_NUM_THREADS": "1"}
    with open(screen, "w", encoding="utf-8") as file:
        code = subprocess.run(command, cwd=folder, stdout=file, stderr=subprocess.STDOUT, env=environment, check=False).returncode
    text = screen_text(screen)
    if code != 0 or wanted not in text:
        raise SystemExit(f"{' '.join(command)} ended with {code}; see {screen}")
    return text


def write_if_new(path, text):
    """Leaves a file that holds `text` already as it is, so that what was made from it counts."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def campaign_decks(program, folder, text, resume=False):
    """Renders the decks of the campaign `text` into `folder`, as `vibrotrough deck` does; the packings' folders, in order.
    `resume`: keeps what is there when the same campaign was rendered before."""
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


def settled(screen):
    """Floor force (N, along z), mass (kg) and height of the centre (m) of a settled packing, from settle.liggghts' last line."""
    words = screen[screen.rindex("VIBROTROUGH SETTLED"):].split()
    return {name: float(words[words.index(name) + 1]) for name in ("floor_force", "mass", "centre_height")}


def read_lines(path):
    """A table that a campaign's deck wrote (cycles.csv, phases.csv): {column: array}."""
    lines = [line for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    table = np.array([list(map(float, line.split(","))) for line in lines[1:]])
    return {name: table[:, i] for i, name in enumerate(lines[0].split(","))}


def read_dump(path):
    """Steps, and the columns of a text dump sorted by id as {name: array of shape (steps, grains)}."""
    lines = pathlib.Path(path).read_text(encoding="utf-8").splitlines()
    steps, frames, names, at = [], [], [], 0
    while at < len(lines):
        steps.append(int(lines[at + 1]))
        count, names = int(lines[at + 3]), lines[at + 8].split()[2:]
        frames.append([list(map(float, line.split())) for line in lines[at + 9:at + 9 + count]])
        at += 9 + count
    table = np.array(frames)
    return np.array(steps), {name: table[:, :, i] for i, name in enumerate(names)}
