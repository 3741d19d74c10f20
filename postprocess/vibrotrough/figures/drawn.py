"""Which figures there are, which was drawn from which data, and how files are written and figures put into a page.

kinds.json has a row for each kind of figure: its drawing function is plot_KIND of the module.

OUT/figures.json names every figure with the SHA-256 of the data that it was drawn from. A report shows no figure of an earlier
state of the campaign.
"""

import dataclasses
import hashlib
import json
import os
import pathlib
import xml.etree.ElementTree as ElementTree
from typing import Any

from ..results import read_regular

SVG = "http://www.w3.org/2000/svg"
LARGEST_NOTE = 64 << 20  # bytes

@dataclasses.dataclass(frozen=True)
class Kind:
    """A kind of figure."""

    kind: str  # what --only takes
    module: str  # that has its drawing function
    file: str  # that it is drawn from: result.h5 for one of each case, else a file of the campaign
    title: str

    @property
    def is_of_case(self) -> bool:
        return self.file == "result.h5"


KINDS = [Kind(**row) for row in json.loads(pathlib.Path(__file__).with_name("kinds.json").read_text(encoding="utf-8"))]

ElementTree.register_namespace("", SVG)
ElementTree.register_namespace("xlink", "http://www.w3.org/1999/xlink")


def write_file(path: pathlib.Path, content: bytes) -> None:
    """Writes a file that appears whole or not at all."""
    part = path.with_name(f".{path.name}.part-{os.getpid()}")
    try:
        part.write_bytes(content)
        os.replace(part, path)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


def read_note(path: pathlib.Path) -> bytes:
    """A file of facts. A pipe, which would never end, and a file that is far too long are refused with OSError."""
    return read_regular(path, LARGEST_NOTE)


def digest_of_data(directory: pathlib.Path, output: pathlib.Path, case: str | None = None) -> str:
    """SHA-256 of what a figure is drawn from: the tables of the campaign, for a case's own figure also its result."""
    overview = json.loads(read_note(output / "data" / "campaign.json"))
    overview.pop("written", None)
    data = hashlib.sha256(json.dumps(overview, sort_keys=True).encode())
    paths = [directory / "campaign.h5", output / "data" / "theory_curves.csv", directory / "numerics.json"]
    if case is not None:
        paths += [directory / "cases" / case / "result.h5", output / "data" / "point_mass" / f"{case}.csv"]
    for path in paths:
        data.update(hashlib.sha256(path.read_bytes() if path.is_file() else b"").digest())
    return data.hexdigest()


class DrawnFigures:
    """OUT/figures.json: {file name: digest of its data}."""

    def __init__(self, output: pathlib.Path) -> None:
        self.output = output
        try:
            found = json.loads(read_note(output / "figures.json"))
        except (OSError, ValueError):
            found = {}
        self.known: dict[str, Any] = found if isinstance(found, dict) else {}

    def remember(self, paths: list[pathlib.Path], data: str) -> None:
        for path in paths:
            self.known[path.name] = data
        write_file(self.output / "figures.json", (json.dumps(self.known, indent=1, sort_keys=True) + "\n").encode())

    def read(self, name: str, data: str) -> bytes | None:
        """The bytes of a figure that was drawn from this data; None when there is none."""
        try:
            return read_note(self.output / name) if self.known.get(name) == data else None
        except OSError:
            return None


def drawing_of(svg: bytes) -> str:
    """The SVG as an element of a page."""
    root = ElementTree.fromstring(svg)
    for parent in root.iter():
        for child in [one for one in parent if one.tag == f"{{{SVG}}}metadata"]:
            parent.remove(child)
    return ElementTree.tostring(root, encoding="unicode")
