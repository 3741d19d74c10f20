"""Vibrotrough's decks of a block with another contact law written into them, run by the engine."""

import pathlib
import re
import subprocess

import engine_deck
from contact_law import Law

SAME = r"(fix\s+\w+ all property/global {name} peratomtypepair (\d)) .*"


def set_property(deck: str, name: str, value: float) -> str:
    """The engine's property of all pairs of types."""
    return re.sub(SAME.format(name=name), lambda line: f"{line[1]}{f' {value!r}' * int(line[2]) ** 2}", deck)


def get_property(deck: str, name: str) -> float:
    return float(engine_deck.last_group(SAME.format(name=name).replace(" .*", r" (\S+)"), deck))


def steps_per_cycle(folder: pathlib.Path) -> int:
    return int(engine_deck.last_group(r"variable\s+n equal (\d+)", (folder / "in.liggghts").read_text(encoding="utf-8")))


def edit(deck: str, law: Law) -> str:
    """`law`: a contact_law.Law. The deck's own law has k = m / t_c^2 and c = 10 m / t_c."""
    duration = 10 / get_property(deck, "gamman")
    unit = get_property(deck, "kn")  # m / t_c^2
    deck = set_property(deck, "kn", unit * law.stiffness)
    deck = set_property(deck, "gamman", law.damping / duration)
    deck = set_property(deck, "gammat", law.damping / duration)
    if law.tangential_stiffness is not None:
        deck = set_property(deck, "kt", unit * law.tangential_stiffness)
        deck = deck.replace("tangential no_history", "tangential history").replace("tangential_damping on", "tangential_damping off")
    return deck.replace("limitForce on", "limitForce off") if law.pulls else deck


def run_decks(folder: pathlib.Path, law: Law) -> list[float]:
    """Runs both decks in `folder`, unless they were, and returns the centre of mass along the trough at the end of each cycle, m."""
    done = folder / "done"
    if not done.exists():
        for name in ("settle.liggghts", "in.liggghts"):
            path = folder / name
            deck = path.read_text(encoding="utf-8")
            path.with_suffix(".edited").write_text(edit(deck, law), encoding="utf-8")
            with open(path.with_suffix(".out"), "w", encoding="utf-8") as out:
                subprocess.run(["liggghts", "-in", path.with_suffix(".edited").name], cwd=folder, stdout=out, stderr=out, check=True)
        done.touch()
    return engine_deck.read_lines(folder / "cycles.csv")["x_com"].tolist()
