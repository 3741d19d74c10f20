"""Holds the includes of src/ to the order of the modules: a module may include only itself and modules above it.

usage: module_order.py SOURCE_FOLDER
The order is that of the add_subdirectory calls in SOURCE_FOLDER/CMakeLists.txt. Exit code 1 and one line per
arrow that points back. A module whose CMakeLists.txt makes targets MODULE_PART has parts, folders of these names,
which keep the order of the targets in the same way.
"""

import pathlib
import re
import sys
from collections.abc import Iterator


# What campaign/execute may know of campaign/schedule.
KNOWN_TO_EXECUTORS = ("policy", "forecast", "machine_speed")


def module_order(source: pathlib.Path) -> list[str]:
    text = (source / "CMakeLists.txt").read_text()
    return re.findall(r"^add_subdirectory\((\w+)\)", text, re.MULTILINE)


def parts_of(source: pathlib.Path, module: str) -> list[str]:
    """The parts of a module in their order; empty for a module that is one."""
    path = source / module / "CMakeLists.txt"
    if not path.exists():
        return []
    return re.findall(rf"^vibrotrough_module\({module}_(\w+)", path.read_text(), re.MULTILINE)


def wrong_inside(source: pathlib.Path, module: str) -> Iterator[str]:
    """Arrows between the parts of a module that point back, and executors that know a certain policy."""
    parts = parts_of(source, module)
    for path in sorted((source / module).rglob("*.[ch]pp")):
        own = path.relative_to(source / module).parts[0]
        for number, line in enumerate(path.read_text().splitlines(), 1):
            found = re.match(rf'\s*#\s*include\s*"{module}/(\w+)/(\w+)', line)
            if not found or own not in parts or found.group(1) not in parts:
                continue
            if parts.index(found.group(1)) > parts.index(own):
                yield f"{path}:{number}: {module}/{own} includes {module}/{found.group(1)}, which is below it"
            if own == "execute" and found.group(1) == "schedule" and found.group(2) not in KNOWN_TO_EXECUTORS:
                yield f"{path}:{number}: an executor knows no policy but the interface"


def arrows(source: pathlib.Path, modules: list[str]) -> Iterator[tuple[pathlib.Path, int, str, str]]:
    """(file, line number, module of the file, module it includes) for every include of another module."""
    for path in sorted(source.rglob("*.[ch]pp")):
        own = path.relative_to(source).parts[0]
        for number, line in enumerate(path.read_text().splitlines(), 1):
            found = re.match(r'\s*#\s*include\s*["<](\w+)/', line)
            if found and found.group(1) in modules and found.group(1) != own:
                yield path, number, own, found.group(1)


def main() -> None:
    source = pathlib.Path(sys.argv[1])
    modules = module_order(source)
    if len(modules) < 2:
        sys.exit(f"{source}/CMakeLists.txt names no modules")
    folders = {path.name for path in source.iterdir() if path.is_dir()}
    wrong = [f"src/{name} is not a module of src/CMakeLists.txt" for name in sorted(folders - set(modules))]
    count = 0
    for path, number, own, other in arrows(source, modules):
        count += 1
        if modules.index(other) > modules.index(own):
            wrong.append(f"{path}:{number}: {own} includes {other}, which is below it")
    for module in modules:
        wrong += wrong_inside(source, module)
    print("\n".join(wrong) or f"{count} includes between {len(modules)} modules, all upwards")
    sys.exit(1 if wrong or count == 0 else 0)


main()
