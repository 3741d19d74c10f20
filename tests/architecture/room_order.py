"""Holds the includes of src/ to the order of the rooms: a room may include only itself and rooms above it.

usage: room_order.py SOURCE_FOLDER
The order is that of the add_subdirectory calls in SOURCE_FOLDER/CMakeLists.txt. Exit code 1 and one line per
arrow that points back. A room whose CMakeLists.txt makes targets ROOM_PART has parts, folders of these names,
which keep the order of the targets in the same way.
"""

import pathlib
import re
import sys
from collections.abc import Iterator


# What campaign/execute may know of campaign/schedule.
KNOWN_TO_EXECUTORS = ("policy", "forecast")


def room_order(source: pathlib.Path) -> list[str]:
    text = (source / "CMakeLists.txt").read_text()
    return re.findall(r"^add_subdirectory\((\w+)\)", text, re.MULTILINE)


def parts_of(source: pathlib.Path, room: str) -> list[str]:
    """The parts of a room in their order; empty for a room that is one."""
    path = source / room / "CMakeLists.txt"
    if not path.exists():
        return []
    return re.findall(rf"^vibrotrough_room\({room}_(\w+)", path.read_text(), re.MULTILINE)


def wrong_inside(source: pathlib.Path, room: str) -> Iterator[str]:
    """Arrows between the parts of a room that point back, and executors that know a certain policy."""
    parts = parts_of(source, room)
    for path in sorted((source / room).rglob("*.[ch]pp")):
        own = path.relative_to(source / room).parts[0]
        for number, line in enumerate(path.read_text().splitlines(), 1):
            found = re.match(rf'\s*#\s*include\s*"{room}/(\w+)/(\w+)', line)
            if not found or own not in parts or found.group(1) not in parts:
                continue
            if parts.index(found.group(1)) > parts.index(own):
                yield f"{path}:{number}: {room}/{own} includes {room}/{found.group(1)}, which is below it"
            if own == "execute" and found.group(1) == "schedule" and found.group(2) not in KNOWN_TO_EXECUTORS:
                yield f"{path}:{number}: an executor knows no policy but the interface"


def arrows(source: pathlib.Path, rooms: list[str]) -> Iterator[tuple[pathlib.Path, int, str, str]]:
    """(file, line number, room of the file, room it includes) for every include of another room."""
    for path in sorted(source.rglob("*.[ch]pp")):
        own = path.relative_to(source).parts[0]
        for number, line in enumerate(path.read_text().splitlines(), 1):
            found = re.match(r'\s*#\s*include\s*["<](\w+)/', line)
            if found and found.group(1) in rooms and found.group(1) != own:
                yield path, number, own, found.group(1)


def main() -> None:
    source = pathlib.Path(sys.argv[1])
    rooms = room_order(source)
    if len(rooms) < 2:
        sys.exit(f"{source}/CMakeLists.txt names no rooms")
    folders = {path.name for path in source.iterdir() if path.is_dir()}
    wrong = [f"src/{name} is not a room of src/CMakeLists.txt" for name in sorted(folders - set(rooms))]
    count = 0
    for path, number, own, other in arrows(source, rooms):
        count += 1
        if rooms.index(other) > rooms.index(own):
            wrong.append(f"{path}:{number}: {own} includes {other}, which is below it")
    for room in rooms:
        wrong += wrong_inside(source, room)
    print("\n".join(wrong) or f"{count} includes between {len(rooms)} rooms, all upwards")
    sys.exit(1 if wrong or count == 0 else 0)


main()
