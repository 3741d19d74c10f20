"""Which figure was drawn from which data, and how files are written and figures put into a page.

OUT/figures.json names every figure with the SHA-256 of the data that it was drawn from and of its own bytes. A report shows a
figure only when both are what they should be: a figure of an earlier state of the campaign, or one that somebody else put
there, is not shown.
"""

import fcntl
import glob
import hashlib
import json
import os
import pathlib
import xml.etree.ElementTree as ElementTree
from typing import Any

import vibrotrough

SVG = "http://www.w3.org/2000/svg"
LINK = "{http://www.w3.org/1999/xlink}href"
# What matplotlib draws with. Anything else, above all a script, is not put into a page.
ELEMENTS = {"svg", "g", "defs", "path", "text", "tspan", "use", "clipPath", "rect", "circle", "line", "polygon", "polyline",
            "style", "image", "title", "linearGradient", "stop", "pattern"}  # fmt: skip
LARGEST_NOTE = 64 << 20  # bytes

ElementTree.register_namespace("", SVG)
ElementTree.register_namespace("xlink", "http://www.w3.org/1999/xlink")


def remove_remains(path: pathlib.Path) -> None:
    """Removes what processes that were killed left of a file. One that still writes holds its lock."""
    for part in path.parent.glob(glob.escape(f".{path.name}.part-") + "*"):
        if not part.name.rpartition("-")[2].isdigit():
            continue  # a person's
        try:
            number = os.open(part, os.O_WRONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
        except OSError:
            continue
        try:
            fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
            part.unlink(missing_ok=True)
        except OSError:
            pass
        finally:
            os.close(number)


def write_file(path: pathlib.Path, content: bytes) -> None:
    """Writes a file that appears whole or not at all, and never through a symbolic link: one of its name is replaced."""
    remove_remains(path)
    part = path.with_name(f".{path.name}.part-{os.getpid()}")
    part.unlink(missing_ok=True)
    try:
        with open(os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW, 0o666), "wb") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            file.write(content)
        os.replace(part, path)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


def read_note(path: pathlib.Path) -> bytes:
    """A file of facts. A pipe, which would never end, and a file that is far too long are refused with OSError."""
    return vibrotrough.read_regular(path, LARGEST_NOTE)


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
    """OUT/figures.json: {file name: {"data": digest, "file": digest}}."""

    def __init__(self, output: pathlib.Path) -> None:
        self.output = output
        try:
            found = json.loads(read_note(output / "figures.json"))
        except (OSError, ValueError):
            found = {}
        self.known: dict[str, Any] = found if isinstance(found, dict) else {}

    def remember(self, paths: list[pathlib.Path], data: str) -> None:
        for path in paths:
            self.known[path.name] = {"data": data, "file": hashlib.sha256(path.read_bytes()).hexdigest()}
        write_file(self.output / "figures.json", (json.dumps(self.known, indent=1, sort_keys=True) + "\n").encode())

    def read(self, name: str, data: str) -> bytes | None:
        """The bytes of a figure that was drawn from this data; None when there is none."""
        try:
            content = read_note(self.output / name)
        except OSError:
            return None
        return content if self.known.get(name) == {"data": data, "file": hashlib.sha256(content).hexdigest()} else None


def is_harmless(element: ElementTree.Element) -> bool:
    """Whether an element of an SVG only draws."""
    kind = element.tag.removeprefix(f"{{{SVG}}}")
    links = [value for name, value in element.attrib.items() if name in (LINK, "href")]
    words = " ".join([element.text or "" if kind == "style" else "", *element.attrib.values()]).replace("url(#", "")
    return (
        kind in ELEMENTS
        and not any(name.lower().startswith("on") for name in element.attrib)
        and all(value.startswith(("#", "data:image/png;base64,")) for value in links)
        and "url(" not in words
        and "@import" not in words
    )


def drawing_of(svg: bytes) -> str | None:
    """The SVG as an element of a page, written anew from what was understood of it; None when it does more than draw."""
    try:
        root = ElementTree.fromstring(svg)
    except ElementTree.ParseError:
        return None
    for parent in root.iter():
        for child in [one for one in parent if one.tag == f"{{{SVG}}}metadata"]:
            parent.remove(child)
    if root.tag != f"{{{SVG}}}svg" or not all(is_harmless(element) for element in root.iter()):
        return None
    return ElementTree.tostring(root, encoding="unicode")
