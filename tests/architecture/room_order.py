"""Holds the includes of src/ to the order of the rooms: a room may include only itself and rooms above it.

usage: room_order.py SOURCE_FOLDER
The order is that of the add_subdirectory calls in SOURCE_FOLDER/CMakeLists.txt. Exit code 1 and one line per
arrow that points back.
"""

import pathlib
import re
import sys
from collections.abc import Iterator


def room_order(source: pathlib.Path) -> list[str]:
    text = (source / "CMakeLists.txt").read_text()
    return re.findall(r"^add_subdirectory\((\w+)\)", text, re.MULTILINE)


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
    print("\n".join(wrong) or f"{count} includes between {len(rooms)} rooms, all upwards")
    sys.exit(1 if wrong or count == 0 else 0)


main()
